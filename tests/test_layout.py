"""How the package is laid out: what it shows, and that imports point down."""

import ast
import inspect
import pickle
import subprocess
import sys
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.base import lazy

from .approx import approx

PACKAGE = Path(mdr.__file__).parent
#: Folders of the kernel, which solves alone.
KERNEL = "base", "solver"
#: From the bottom up; what is of one folder may import what stands below it, and others of the folder.
ORDER = (
    "base", "solver.numerics", "solver.profiles", "solver.medium", "solver.applicability",
    "solver.foundation", "solver.contact", "solver.impacts", "solver.own", "solver.oblique", "abel", "show",
    "measurements.examples", "measurements.measured_curve",
    "measurements.files", "measurements.reading", "measurements.common",
    "measurements.unloading", "measurements.fit", "sweep", "scenes", "scene", "__init__",
)  # fmt: skip
# What the chain bears witness of: all modules of these folders, and two more.
CHECKED_FOLDERS = "solver.contact.", "solver.impacts."
CHECKED = {"solver.own.cap", "solver.profiles.radius_table"}


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        yield ".".join(path.relative_to(PACKAGE).with_suffix("").parts), path


def imported(name, tree):
    """Modules of the package that the nodes of one of them import, those for annotations included."""
    here = name.split(".")[:-1]
    found = set()
    for node in tree:
        if isinstance(node, ast.Import):
            assert not any(alias.name.startswith("mdr_core") for alias in node.names), name
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = [*here[: len(here) + 1 - node.level], *(node.module.split(".") if node.module else [])]
        parts = [".".join([*base, alias.name]) for alias in node.names]
        named = (part if {part, f"{part}.__init__"} & KNOWN else ".".join(base) for part in parts)
        found |= {each if each in KNOWN else f"{each}.__init__" for each in named}
    return found


def lazily(tree):
    """Names of `lazy` that are asked for."""
    return {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) == "lazy"
    }


FILES = dict(modules())
KNOWN = set(FILES)


# When a test asks for them: each process of a run imports all tests, and one of them runs these.
@cache
def tree_of(name):
    return ast.parse(FILES[name].read_text(encoding="utf-8"))


@cache
def imports():
    return {name: imported(name, ast.walk(tree_of(name))) for name in KNOWN}


def place(name):
    """Of a module; the empty first files of `solver` and `measurements` have none."""
    return max((n for n, each in enumerate(ORDER) if f"{name}.".startswith(f"{each}.")), default=-1)


def test_every_folder_has_its_place():
    without = {name for name in KNOWN if place(name) < 0}
    assert without == {"solver.__init__", "measurements.__init__"}
    assert {*range(len(ORDER))} <= {*map(place, KNOWN)}


def test_imports_point_down():
    upward = {(name, other) for name in KNOWN for other in imports()[name] if place(other) > place(name)}
    assert upward == set()


def test_there_is_no_circle():
    """Of modules; that one imports its own folder's first file does not count."""
    TopologicalSorter(imports()).prepare()


def test_modules_are_imported_at_the_top():
    """Not in functions; by name only what stands above, optional packages and public names."""
    by_name = set()
    for name in KNOWN:
        nodes = [*ast.walk(tree_of(name))]
        functions = (node for node in nodes if isinstance(node, ast.FunctionDef))
        assert not imported(name, (node for each in functions for node in ast.walk(each))), name
        if "import_module" in (node.id for node in nodes if isinstance(node, ast.Name)):
            by_name.add(name)
    assert by_name == {"base.lazy", "show.report", "sweep.__init__", "__init__"}


def behind(name):
    """Modules that are imported with one, itself among them; not the empty first files of folders."""
    reached, new = set(), {name}
    while new:
        reached |= new
        new = set().union(*(imports()[each] for each in new)) - reached
    return {each for each in reached if not each.endswith("__init__")}


def test_what_is_imported_lazily_is_asked_for_and_is_there():
    assert {*lazy.MODULES} == set().union(*map(lazily, map(tree_of, KNOWN)))
    stub = ast.parse((PACKAGE / "base" / "lazy.pyi").read_text(encoding="utf-8"))
    assert imported("base.lazy", stub.body) == {*lazy.MODULES.values()} <= KNOWN


def test_shapes_and_laws_of_the_library_need_no_room_for_what_users_write():
    """A sphere on the paper's medium imports nothing of the room for what users write."""
    code = (
        "import sys, mdr_core as mdr; medium = mdr.Medium(1e9, q_c=1.0, hardness=1e6); "
        "mdr.indent(mdr.Sphere(1e-6), medium, 1e-9).force; "
        "mdr.chain_impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0), 1e-9, 0.1); "
        "print(*(name for name in sys.modules if name.startswith('mdr_core.solver.own')))"
    )
    assert not python(code).split()


def test_the_chain_imports_nothing_that_it_checks():
    # What a user wrote is admitted and asked lazily.
    start = {name for name in KNOWN if name.startswith("solver.foundation.")}
    start |= {"solver.own.law", "solver.own.shape"}
    checked = CHECKED | {name for name in KNOWN if name.startswith(CHECKED_FOLDERS)}
    reached = set().union(*map(behind, start))
    # The search has gone down to the bottom.
    assert {"solver.medium.medium", "solver.profiles.profile", "base.check"} <= reached
    assert len(checked) > 25
    assert checked <= KNOWN
    assert not reached & checked


def test_only_public_names_are_shown():
    assert dir(mdr) == sorted(mdr.__all__)
    assert all(hasattr(mdr, name) for name in mdr.__all__)


@pytest.mark.parametrize("name", ["critical_force", "DepthPath", "ForcePath", "FreeImpact"])
def test_a_former_name_works_and_names_the_new_one(name):
    with pytest.warns(DeprecationWarning, match=f"{name} is mdr_core.*(yield_force|scene.{name})"):
        assert getattr(mdr, name) in (mdr.yield_force, getattr(mdr.scene, name, None))


def python(code, folder=PACKAGE.parent):
    run = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_a_public_name_imports_what_it_needs():
    code = (
        "import sys, mdr_core as mdr; mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0), 1e-9).force; "
        "print(*(name for name in sys.modules if name.startswith('mdr_core.')))"
    )
    run = {tuple(name.split(".")[1:3]) for name in python(code).split()}
    assert {folder for folder, *_ in run} <= set(KERNEL)
    assert not run & {("solver", "impacts"), ("solver", "foundation")}


def test_all_public_names_are_imported_by_a_star():
    code = "from mdr_core import *; print(abel.__name__, sweep.__name__, indent.__name__)"
    assert python(code).split() == ["mdr_core.abel", "mdr_core.sweep", "indent"]


def test_results_are_pickled_and_read_where_nothing_was_imported_yet(tmp_path):
    state = mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0), 1e-9)
    (tmp_path / "state").write_bytes(pickle.dumps(state))
    path = str(tmp_path / "state")
    code = f"import pickle; print(pickle.load(open({path!r}, 'rb')).force)"
    assert float(python(code)) == state.force


@pytest.mark.parametrize("function", [mdr.indent, mdr.indent_to_force])
def test_slow_paths_take_no_times(function):
    assert "time" not in inspect.signature(function).parameters
    state = function(mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0, eta=1.0), [1e-9, 2e-9])
    assert type(state) is mdr.Indentation


@pytest.mark.parametrize("function", [mdr.indent_in_time, mdr.creep])
@pytest.mark.parametrize("eta", [0.0, 1.0])
def test_paths_in_time_are_of_one_type(function, eta):
    path = function(
        mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0, eta=eta), [0.0, 1e-9], [0.0, 1.0], tolerance=1e-2
    )
    assert type(path) is mdr.TimedIndentation


def test_both_impacts_answer_the_same_names():
    """Besides them one has its closed form's parts and limits, the other its chain and error estimates."""
    shape, medium = mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0)
    hit, chain = mdr.impact(shape, medium, 1e-9, 0.1), mdr.chain_impact(shape, medium, 1e-9, 0.1)
    names, others = ({n for n in dir(each) if not n.startswith("_")} for each in (hit, chain))
    assert names - others == {"turning_point", "plastic_depth_increase", "fast_limit", "max_pressure"}
    assert others - names == {"error", "errors", "foundation"}
    assert hit.shape == chain.shape == ()
    for name in hit.to_dict():
        one, other = getattr(hit, name), getattr(chain, name)
        # The tolerance of the chain is 1e-6 of the depth, of which forces, areas and times are powers.
        assert other == approx(one, rel=3e-5), name
        assert isinstance(one, float | np.floating), name
