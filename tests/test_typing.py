"""What an editor and a type checker see of the package, and how long it takes to import."""

import subprocess
import sys
from pathlib import Path

import pytest

import mdr_core as mdr

ROOT = Path(mdr.__file__).parents[1]
CLIENT = ROOT / "tests" / "client.py"


def run(*arguments):
    return subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=300, check=False
    )


@pytest.mark.full
def test_a_client_script_passes_a_strict_type_checker():
    """A step of `.ci/run` with a cache, which takes a third of a second instead of 13."""
    pytest.importorskip("mypy")
    strict = ("--strict", "--follow-imports=silent")
    result = run("-m", "mypy", *strict, str(CLIENT))
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.slow
def test_the_client_script_runs():
    result = run("-m", "tests.client")
    assert result.returncode == 0, result.stderr


def test_the_package_says_that_it_is_typed():
    assert (ROOT / "mdr_core" / "py.typed").exists()


def test_first_calls_need_no_package_of_scipy_for_a_trifle(tmp_path):
    """A trapezoid or a polynomial is not worth half a second, or a download in a browser."""
    calls = (
        "import sys, numpy as np, mdr_core as mdr; "
        "tip, medium = mdr.RoundedCone(0.3, 1e-7), mdr.Medium(70e9, hardness=9e9); "
        "depth = np.append(np.linspace(1e-8, 1e-6, 60), np.linspace(1e-6, 9e-7, 30)); "
        "force = mdr.indent(tip, medium, depth).force; "
        "mdr.impact(tip, medium, 1e-9, 0.1).restitution; mdr.fit_indentation(tip, depth, force); "
        "plate = mdr.Structure.beam(0.3, 50.0, 0.4, modes=5); "
        "mdr.impact(mdr.Paraboloid(8e-3), mdr.Medium(1e10), 0.05, 1.0, structure=plate).contacts; "
        "open(sys.argv[1], 'w').write('h (nm), F (mN)\\n0, 0\\n10, 1\\n20, 4\\n'); "
        "mdr.read_curve(sys.argv[1]); "
        "heavy = 'integrate', 'interpolate', 'ndimage', 'optimize'; "
        "print([n for n in heavy if 'scipy.' + n in sys.modules])"
    )
    assert run("-c", calls, str(tmp_path / "run.csv")).stdout.strip() == "[]"


def test_heavy_parts_of_scipy_wait_until_they_are_needed():
    """They are what would make the import take a second; times themselves depend on the machine."""
    heavy = (
        "import sys, mdr_core; "
        "print([n for n in ('interpolate', 'optimize', 'special') if 'scipy.' + n in sys.modules])"
    )
    assert run("-c", heavy).stdout.strip() == "[]"
