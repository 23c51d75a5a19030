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
    "_errors", "_hints", "_check", "numerics.stable", "numerics.blocks", "numerics.gauss",
    "numerics.collocation",
    "numerics.roots", "abel", "results.units", "results.quantities", "files.units",
    "files.numbers", "files.words", "files.text", "profiles.samples", "profiles.profile",
    "profiles.power", "profiles.radius_table", "profiles.rounded", "profiles.truncated", "profiles.sampled",
    "profiles.smooth", "hardness", "hardness_check", "medium", "results.limits", "results.report",
    "results.base", "results.sweep_arguments", "results.progress", "files.columns", "files.results",
    "files.several", "measured_curve", "files.curve", "files.afm", "files.workbook", "reading",
    "foundation.refinement",
    "foundation.cap", "foundation.element", "foundation.grid", "foundation.foundation",
    "foundation.fronts", "foundation.depth_path", "foundation.force_path", "foundation.free_body",
    "foundation.chain_impact", "contact.live_interval", "contact.quadrature", "contact.integrals",
    "contact.yielding", "contact.closed_forms", "contact.adhesion", "contact.onset_of_yield",
    "contact.pressure", "contact.stress", "contact.indentation", "contact.loading",
    "contact.unloading", "contact.creep_law", "contact.creep", "impacts.contact_time", "impacts.scaling",
    "impacts.equation_of_motion",
    "impacts.collocation_steps", "impacts.motion_solver", "impacts.dense_motion", "impacts.motion",
    "impacts.result", "impacts.energy_balance", "impacts.adhesive", "impacts.viscous", "impacts.impact",
    "oblique.depth_levels", "oblique.viscous_friction", "oblique.dry_levels", "oblique.dry_friction",
    "oblique.oblique_motion", "oblique.tangential_motion", "oblique.oblique_impact", "oblique.ball",
    "sweep", "fit.parameters", "fit.least_squares", "fit.errors", "fit.report", "fit.unloading",
    "fit.creep", "fit.first_contact", "fit.materials", "fit.oliver_pharr",
    "fit.hardness", "fit.measurement", "fit.model", "fit.curves", "fit.adhesion", "fit.depth_noise",
    "fit.start", "fit.solution", "fit.classes",
    "fit.nested", "fit.noise", "fit.remarks", "fit.quoted", "fit.figures", "fit.result",
    "fit.indentation", "drives", "scene", "results.figures", "results.elements", "__init__",
)  # fmt: skip
# What the chain bears witness of.
CHECKED = {
    "contact.live_interval", "contact.quadrature", "contact.integrals", "contact.yielding",
    "contact.closed_forms", "contact.adhesion", "contact.pressure", "contact.indentation",
    "contact.loading", "contact.unloading", "contact.creep_law", "contact.creep", "impacts.impact",
    "impacts.energy_balance", "impacts.adhesive",
    "impacts.contact_time", "impacts.result", "impacts.viscous", "impacts.equation_of_motion",
    "impacts.collocation_steps", "impacts.motion_solver", "impacts.dense_motion", "impacts.motion",
    "impacts.scaling", "profiles.radius_table", "contact.stress",
}  # fmt: skip


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        name = ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
        # Folders have no content of their own.
        if not name.endswith(".__init__"):
            yield name, path


def imports(name, path):
    """Modules of the package that one of them imports, those for annotations included.

    Plots are left out: results import `results.elements` when they are plotted.
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
    return found - {"results.figures", "results.elements"}


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
    assert {"medium", "profiles.profile", "_check"} <= reached
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
