"""The app as a package: imports point down, and files can be read at once."""

import ast
import subprocess
import sys
from functools import cache

import pytest

from app.common.process import _PROGRAM

from .conftest import ROOT

APP = ROOT / "app"


def loaded(code, names):
    """Modules of some names that a fresh process has after its imports."""
    command = [sys.executable, "-c", f"{code}\nimport sys\nprint(*sys.modules)", "app"]
    modules = subprocess.check_output(command, cwd=ROOT, text=True).split()
    assert len(modules) > 100
    return [each for each in modules if any(each == name or each.startswith(f"{name}.") for name in names)]


FITS = (
    "app.measurement",
    *(f"mdr_core.measurements.{name}" for name in ("fit", "files", "reading", "measured_curve")),
)


@pytest.mark.slow
def test_the_explorer_loads_no_fits_and_no_readers():
    """Nor does making its page."""
    code = "from app import explorer, security; from app.explorer import page, theory; page.Page('', False)"
    assert loaded(code, FITS) == []


PAGES = ("panel", "bokeh", "holoviews", "tornado", "app.explorer.page", "app.common.ui")


def test_a_process_that_reads_and_fits_loads_no_page():
    """It has no use for them, and a start would take a second more."""
    code = "import app.common.process, app.common.tip, app.measurement.analysis"
    assert loaded(_PROGRAM.partition("from ")[0] + code, PAGES) == []


def imported(path):
    """Full names of all that a file imports, and of what that is in."""
    package = path.relative_to(ROOT).parent.parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level] if node.level else ()
            module = ".".join((*above, *filter(None, [node.module])))
            yield from (module, *(f"{module}.{each.name}" for each in node.names))


def test_the_page_for_measurements_is_imported_where_pages_are_served_alone():
    """So the explorer, and what both pages share, do without it."""
    outside = [each for each in APP.rglob("*.py") if APP / "measurement" not in each.parents]
    inside = "app.measurement."
    found = {each for each in outside if any(f"{name}.".startswith(inside) for name in imported(each))}
    assert found == {APP / "main.py", APP / "server_lifecycle.py"}


@pytest.mark.parametrize(("folder", "most"), [("explorer", 370), ("common", 370), ("measurement", 400)])
def test_files_can_be_read_at_once(folder, most):
    for path in (APP / folder).rglob("*.py"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= most, path


@cache
def imports(path):
    """Modules of the app that one of them imports, those for annotations included."""
    found, package = set(), path.parent
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package if node.level == 1 else package.parents[node.level - 2]
            base = base / (node.module or "").replace(".", "/")
            for name in [alias.name for alias in node.names]:
                places = base / f"{name}.py", base / name / "__init__.py", base.with_suffix(".py")
                found |= {*[each for each in (*places, base / "__init__.py") if each.is_file()][:1]}
    return found - {path, APP / "__init__.py"}


def floor(path, below=()):
    assert path not in below, f"a cycle of imports at {path}"
    return 1 + max((floor(each, (*below, path)) for each in imports(path)), default=0)


def test_imports_point_down():
    floors = {path.relative_to(APP).as_posix(): floor(path) for path in APP.rglob("*.py")}
    # The seam is below the page, and above what extras bring.
    order = [floors[f"explorer/{name}.py"] for name in ("plot", "widgets", "page")]
    assert order == sorted(order)
    # What both pages use knows neither of them.
    for path in (APP / "common").glob("*.py"):
        assert all(each.parent == path.parent for each in imports(path))
