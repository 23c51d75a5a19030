"""The kernel of the paper stands alone: it solves where everything else of the package is deleted."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .approx import approx
from .test_layout import KERNEL

ROOT = Path(__file__).parents[1]
#: Folders of tests of the kernel, and those quick files of them that are run without the rest.
FOLDERS = "numerics", "profiles", "contact", "impacts", "foundation"
RUN = "test_element", "test_closed_forms", "test_scaling"

SOLVES = """
import numpy as np
import mdr_core as mdr

# Hertz, Popov (2015), section 2: F = 4/3 E* sqrt(R) d^1.5, and p0 = 2 E* a/(pi R).
ball = mdr.Paraboloid(radius=1e-3)
state = mdr.indent(ball, mdr.Medium(1e9), 1e-6)
print(state.force / (4 / 3 * 1e9 * 1e-3**0.5 * 1e-6**1.5))
print(state.pressure(0.0) / (2 * 1e9 * state.contact_radius / (np.pi * 1e-3)))
# What an impact loses is what yields, or what is viscous.
cone = mdr.Cone(slope=0.3)
for medium in mdr.Medium(1e9, q_c=10.0), mdr.Medium(1e9, eta=1.0):
    hit = mdr.impact(cone, medium, 1e-9, 0.1)
    print((hit.plastic_work + hit.viscous_work) / (0.5e-9 * 0.1**2 * (1 - hit.restitution**2)))
hit, chain = (solve(cone, mdr.Medium(1e9, q_c=10.0), 1e-9, 0.1) for solve in (mdr.impact, mdr.chain_impact))
print(chain.restitution / hit.restitution)
"""


def run(folder, *arguments):
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, capture_output=True, text=True, timeout=300, check=False
    )


@pytest.fixture(scope="module")
def kernel(tmp_path_factory):
    """A copy with the kernel and its tests alone."""
    folder = tmp_path_factory.mktemp("kernel")
    (folder / "mdr_core").mkdir()
    (folder / "tests").mkdir()
    shutil.copy(ROOT / "pyproject.toml", folder)
    hidden = shutil.ignore_patterns("__pycache__")
    for name in ("__init__", "abel"):
        shutil.copy(ROOT / "mdr_core" / f"{name}.py", folder / "mdr_core")
    shutil.copy(ROOT / "mdr_core" / "__init__.pyi", folder / "mdr_core")
    for name in KERNEL:
        shutil.copytree(ROOT / "mdr_core" / name, folder / "mdr_core" / name, ignore=hidden)
    for path in (ROOT / "tests").glob("*.py"):
        if not path.name.startswith("test_"):
            shutil.copy(path, folder / "tests")
    for name in FOLDERS:
        shutil.copytree(ROOT / "tests/solver" / name, folder / "tests/solver" / name, ignore=hidden)
    shutil.copy(ROOT / "tests/solver/__init__.py", folder / "tests/solver")
    return folder


def test_it_solves_an_indentation_impacts_and_a_chain(kernel):
    result = run(kernel, "-c", SOLVES)
    assert result.returncode == 0, result.stderr
    *exact, chain = map(float, result.stdout.split())
    # Viscous impacts have 10⁻⁸ of the energy.
    assert exact == approx([1.0] * 4, rel=1e-8)
    assert chain == approx(1.0, rel=3e-5)


def test_what_is_above_it_is_missing_there(kernel):
    result = run(kernel, "-c", "import mdr_core as mdr; mdr.read_curve")
    assert "No module named 'mdr_core.measurements'" in result.stderr


OWN_SHAPE = """
from dataclasses import dataclass
import numpy as np
import mdr_core as mdr

@dataclass(frozen=True)
class Own(mdr.Profile):
    height_at = lambda self, r: 0.1 * r
    reduced_at = lambda self, x: 0.05 * np.pi * x
    reduced_slope_at = lambda self, x: 0.05 * np.pi + 0 * x
"""
OWN_LAW = """
from dataclasses import dataclass
import mdr_core as mdr

@dataclass(frozen=True)
class Own(mdr.HardnessLaw):
    at = lambda self, a: 1e7 + 0 * a
    rate = lambda self, a: 0 * a
"""


@pytest.mark.parametrize(
    ("own", "call"),
    [
        (OWN_SHAPE, "mdr.indent(Own(), mdr.Medium(1e9), 1e-9)"),
        (OWN_SHAPE, "mdr.chain_impact(Own(), mdr.Medium(1e9, q_c=1.0), 1e-9, 0.1)"),
        (OWN_LAW, "mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9, hardness=Own()), 1e-9)"),
    ],
)
def test_what_a_user_wrote_needs_its_room(kernel, own, call):
    """It is refused by the name of what is missing, and not solved without a check."""
    missing = f"import sys; sys.modules['mdr_core.solver.own'] = None{own}"
    result = run(kernel, "-c", missing + call)
    assert "mdr_core.solver.own" in result.stderr.splitlines()[-1]


@pytest.mark.slow
def test_all_of_its_tests_are_collected_and_some_pass(kernel):
    pytest.importorskip("mpmath")
    folders = [f"tests/solver/{name}" for name in FOLDERS]
    # An error of a file that is collected is a failure, whether its tests are run or not.
    command = ("-m", "pytest", "-q", "--quick", "-p", "no:cacheprovider", "-k", " or ".join(RUN), *folders)
    passed = run(kernel, *command)
    assert passed.returncode == 0, passed.stdout
    assert re.search(r"\b[1-9]\d* passed", passed.stdout)
