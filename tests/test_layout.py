"""How the package is laid out: what it shows, and that imports point down only."""

import ast
import inspect
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

PACKAGE = Path(mdr.__file__).parent
# From the bottom up; a module may import what stands before it.
ORDER = (
    "_errors", "_check", "_numeric", "abel", "results.quantities", "shapes.tables", "shapes.profile",
    "shapes.power",
    "shapes.tabulated", "shapes.rounded", "shapes.truncated", "shapes.sampled", "shapes.smooth", "medium",
    "results.limits", "results.report", "results.base", "results.labels",
    "results.progress", "reading",
    "foundation.refinement", "foundation.cap", "foundation.element", "foundation.grid",
    "foundation.foundation",
    "foundation.fronts", "foundation.depth_path", "foundation.force_path", "foundation.free_body",
    "foundation.impact",
    "live_interval", "quadrature", "integrals", "closed_forms", "yielding", "adhesion", "onset",
    "fields", "stress", "indentation", "paths",
    "dynamics.energy_balance", "dynamics.adhesive_impact", "dynamics.contact_time",
    "scaling", "dynamics.equation_of_motion", "dynamics.steps", "dynamics.legs", "dynamics.course",
    "dynamics.motion", "dynamics.impact",
    "dynamics.levels", "dynamics.friction", "dynamics.dry_levels", "dynamics.dry_friction",
    "dynamics.oblique_motion", "dynamics.surface", "dynamics.oblique", "dynamics.ball", "sweep",
    "fit.least_squares", "fit.oliver_pharr", "fit.measured", "fit.adhesive_curve", "fit.curve", "fit.start",
    "fit.solution", "fit.nested", "fit.remarks", "fit.figures", "fit.result", "fit.indentation",
    "fit.hardness", "drives", "scene", "results.figures", "__init__",
)  # fmt: skip
# What the chain bears witness of.
CHECKED = {
    "live_interval", "quadrature", "integrals", "closed_forms", "yielding", "adhesion", "fields",
    "indentation", "paths",
    "dynamics.impact", "dynamics.energy_balance", "dynamics.adhesive_impact", "dynamics.contact_time",
    "dynamics.equation_of_motion", "dynamics.steps", "dynamics.legs", "dynamics.course", "dynamics.motion",
    "scaling", "shapes.tabulated", "stress",
}  # fmt: skip


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        name = ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
        # Folders have no content of their own.
        if not name.endswith(".__init__"):
            yield name, path


def imports(name, path):
    """Modules of the package that one of them imports, those for annotations included.

    Plots are left out: results import `results.figures` when they are plotted.
    """
    here = name.split(".")[:-1]
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            assert not any(alias.name.startswith("mdr_core") for alias in node.names), name
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = [*here[: len(here) + 1 - node.level], *(node.module.split(".") if node.module else [])]
        parts = [".".join([*base, alias.name]) for alias in node.names]
        found |= {part if part in KNOWN else ".".join(base) for part in parts}
    return found - {"results.figures"}


KNOWN = {name for name, _ in modules()}
IMPORTS = {name: imports(name, path) for name, path in modules()}


def test_every_module_has_its_place():
    assert set(ORDER) == KNOWN
    assert len({name.split(".")[0] for name in KNOWN}) <= 27


@pytest.mark.parametrize("name", ORDER)
def test_imports_point_down(name):
    assert IMPORTS[name] <= set(ORDER[: ORDER.index(name)])


def test_the_chain_imports_nothing_that_it_checks():
    reached, new = set(), {name for name in KNOWN if name.startswith("foundation.")}
    while new:
        reached |= new
        new = set().union(*(IMPORTS[name] for name in new)) - reached
    # The search has gone down to the bottom.
    assert {"medium", "shapes.profile", "_check"} <= reached
    assert not reached & CHECKED


def test_only_public_names_are_shown():
    assert dir(mdr) == sorted(mdr.__all__)
    assert all(hasattr(mdr, name) for name in mdr.__all__)


@pytest.mark.parametrize("function", [mdr.indent, mdr.indent_to_force])
def test_slow_paths_take_no_times(function):
    assert "time" not in inspect.signature(function).parameters
    state = function(mdr.Cone(0.3), mdr.Medium(1e9, 1.0, 1.0), [1e-9, 2e-9])
    assert type(state) is mdr.Indentation


@pytest.mark.parametrize("function", [mdr.indent_in_time, mdr.creep])
@pytest.mark.parametrize("eta", [0.0, 1.0])
def test_paths_in_time_are_of_one_type(function, eta):
    path = function(mdr.Cone(0.3), mdr.Medium(1e9, 1.0, eta), [0.0, 1e-9], [0.0, 1.0], tolerance=1e-2)
    assert type(path) is mdr.TimedIndentation


def test_both_impacts_answer_the_same_names():
    """Besides them one has its closed form's parts and limits, the other its chain and error estimates."""
    shape, medium = mdr.Cone(0.3), mdr.Medium(1e9, 10.0)
    hit, chain = mdr.impact(shape, medium, 1e-9, 0.1), mdr.chain_impact(shape, medium, 1e-9, 0.1)
    names, others = ({n for n in dir(each) if not n.startswith("_")} for each in (hit, chain))
    assert names - others == {"turning_point", "plastic_depth_increase", "fast_limit"}
    assert others - names == {"error", "errors", "foundation"}
    assert hit.shape == chain.shape == ()
    for name in hit.to_dict():
        one, other = getattr(hit, name), getattr(chain, name)
        # The tolerance of the chain is 1e-6 of the depth, of which forces, areas and times are powers.
        assert other == pytest.approx(one, rel=3e-5), name
        assert isinstance(one, float | np.floating), name
