"""The wheel and the source distribution, as they are built and installed."""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def call(*command, **options):
    run = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, **options)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Paths of wheel and sdist; the wheel is built from the sdist."""
    for package in ("build", "hatchling"):
        pytest.importorskip(package)
    folder = tmp_path_factory.mktemp("dist")
    call("-m", "build", "--no-isolation", "--outdir", folder, ROOT)
    (wheel,), (sdist,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
    return wheel, sdist


def test_the_wheel_has_the_library_and_nothing_else(built):
    with zipfile.ZipFile(built[0]) as wheel:
        names = {name for name in wheel.namelist() if ".dist-info/" not in name}
    tree = {str(path.relative_to(ROOT)) for path in (ROOT / "mdr_core").rglob("*.py")}
    assert names == tree | {"mdr_core/py.typed"}


def test_the_sdist_has_what_the_page_and_the_tests_need(built):
    with tarfile.open(built[1]) as sdist:
        names = {name.partition("/")[2] for name in sdist.getnames()}
    needed = {"app/main.py", "assets/quantities.json", "assets/docs/conf.py", "tests/test_package.py"}
    assert needed | {"README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md"} <= names
    assert not any(name.startswith(("assets/docs/gallery/", "site/")) for name in names)


def test_the_sdist_has_nothing_of_environments_beside_the_tree(tmp_path):
    """The README makes `.venv-test` and `.venv-docs` in the tree; they have packages of the same names."""
    pytest.importorskip("hatchling")
    for name in ("pyproject.toml", ".gitignore", "README.md", "LICENSE"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    others = [
        f"{place}/lib/{name}/a.py" for place in (".venv-test", "env") for name in ("mdr_core", "tests")
    ]
    for name in ("mdr_core/a.py", "tests/a.py", *others):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    code = (
        "from hatchling.builders.sdist import SdistBuilder; "
        "print(*(file.relative_path for file in SdistBuilder('.').recurse_included_files()))"
    )
    files = call("-c", code, cwd=tmp_path).split()
    assert {name for name in files if name.endswith("a.py")} == {"mdr_core/a.py", "tests/a.py"}


def test_the_wheel_is_installed_and_imported_apart_from_the_tree(built, tmp_path):
    target = tmp_path / "installed"
    call("-m", "pip", "install", "-q", "--no-deps", "--no-index", "--target", target, built[0])
    code = "from mdr_core import *; print(abel.__file__, impact(Cone(1), Medium(1), 1, 1).restitution)"
    environment = os.environ | {"PYTHONPATH": str(target)}
    file, restitution = call("-P", "-c", code, cwd=tmp_path, env=environment).split()
    assert Path(file).is_relative_to(target)
    # Without yield and viscosity no energy is lost.
    assert float(restitution) == 1.0


def test_versions_agree():
    import mdr_core

    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.*)$", citation, re.MULTILINE)[1] == PROJECT["version"]
    assert mdr_core.__version__ == PROJECT["version"]
