"""Who imports whom: the explorer no fits and no readers, a process that fits nothing of a page."""

import ast
import subprocess
import sys

import pytest

from app.common.process import _PROGRAM

from .conftest import ROOT

APP = ROOT / "app"
FITS = (
    "app.measurement",
    "mdr_core.measurements.fit",
    "mdr_core.measurements.files",
    "mdr_core.measurements.reading",
    "mdr_core.measurements.measured_curve",
)
PAGES = ("panel", "bokeh", "holoviews", "tornado", "app.explorer.page", "app.common.ui")


def loaded(code, names):
    """Modules of some names that a fresh process has after its imports."""
    command = [sys.executable, "-c", f"{code}\nimport sys\nprint(*sys.modules)", "app"]
    modules = subprocess.check_output(command, cwd=ROOT, text=True).split()
    assert len(modules) > 100
    return [each for each in modules if any(each == name or each.startswith(f"{name}.") for name in names)]


@pytest.mark.slow
def test_the_explorer_loads_no_fits_and_no_readers():
    """Nor does making its page."""
    code = "from app import explorer, security; from app.explorer import page, theory; page.Page('', False)"
    assert loaded(code, FITS) == []


def test_a_process_that_reads_and_fits_loads_no_page():
    """It has no use for them, and a start would take a second more."""
    begins = _PROGRAM.partition("from ")[0]
    assert (
        loaded(begins + "import app.common.process, app.common.tip, app.measurement.analysis", PAGES) == []
    )


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
    found = {
        each
        for each in outside
        if any(f"{name}.".startswith("app.measurement.") for name in imported(each))
    }
    assert found == {APP / "main.py", APP / "server_lifecycle.py"}
