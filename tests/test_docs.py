"""What the docstrings and the README show is true."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import mdr_core as mdr

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
ROWS = [row for row in README.splitlines() if re.match(r"\| \(\d", row)]


@pytest.mark.parametrize("module", [m.name for m in pkgutil.walk_packages(mdr.__path__, "mdr_core.")])
def test_examples_in_docstrings(module):
    if module == "mdr_core.sweep":
        pytest.importorskip("xarray")
    assert doctest.testmod(importlib.import_module(module)).failed == 0


def test_the_example_of_a_shape_of_ones_own_is_run():
    """Examples of classes count only where their module says that they are its own."""
    profile = importlib.import_module("mdr_core.shapes.profile")
    examples = [test.name for test in doctest.DocTestFinder().find(profile) if test.examples]
    assert "mdr_core.shapes.profile.Profile" in examples


def test_examples_in_the_readme():
    result = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert result.attempted > 0
    assert result.failed == 0


def test_the_curve_of_the_readme_is_plotted_and_saved(tmp_path, monkeypatch):
    for package in ("holoviews", "pandas"):
        pytest.importorskip(package)
    (block,) = re.findall(r"```python\n(import holoviews.*?)```", README, re.DOTALL)
    assert len([line for line in block.splitlines() if line]) <= 10
    monkeypatch.chdir(tmp_path)
    exec(block, {})
    assert "d, indentation depth (nm)" in (tmp_path / "curve.html").read_text(encoding="utf-8")
    assert (tmp_path / "curve.csv").read_text(encoding="utf-8").count("\n") == 202


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.split("|")[1].strip())
def test_equation_has_a_function_and_a_test(row):
    _, _, _, functions, tests, _ = row.split("|")
    for function in re.findall(r"`([^`]+)`", functions):
        thing = mdr
        for part in function.split("."):
            # Fields of a dataclass are no attributes of its class, everything named here is.
            thing = getattr(thing, part)
    named = re.findall(r"`(\w+\.py)::(\w+)`", tests)
    assert named
    for file, test in named:
        assert f"def {test}(" in (ROOT / "tests" / file).read_text(encoding="utf-8")


def test_every_equation_of_the_paper_is_in_the_table():
    numbers = set()
    for row in ROWS:
        for first, last in re.findall(r"\((\d+)\)(?:–\((\d+)\))?", row.split("|")[1]):
            numbers.update(range(int(first), int(last or first) + 1))
    assert numbers == set(range(1, 25))
