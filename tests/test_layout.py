"""How the package is laid out: what it shows, what stands behind a call, and that imports point down."""

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
    "measurements.measured_curve", "measurements.files", "measurements.reading", "measurements.common",
    "measurements.unloading", "measurements.fit", "sweep", "scenes", "scene", "__init__",
)  # fmt: skip
#: Modules behind calls of the kernel, those of both first, and why.
BEHIND_BOTH = {
    "base.check": "arguments are checked",
    "base.lazy": "what stands above is imported when it is asked for",
    "base.errors": "refusals name the quantity, its value and a remedy",
    "base.read_only": "functions of users get arrays that they cannot change",
    "solver.applicability": "what goes together, and what a user wrote is admitted",
    "solver.medium.hardness": "laws of hardness, the paper's sum among them",
    "solver.medium.medium": "Medium",
    "solver.numerics.gauss": "quadrature",
    "base.remark": "remarks on a shape, and refusals",
    "base.results": "base classes of results",
    "solver.numerics.roots": "depths and radii are roots",
    "solver.profiles.profile": "Profile",
    "solver.medium.transverse_isotropy": "the modulus of a Medium of another symmetry",
}
BEHIND = {
    "solver.contact.loading": BEHIND_BOTH | {
        "solver.contact.adhesion": "the rim of a contact with adhesion",
        "solver.contact.indentation": "the result",
        "solver.contact.integrals": "forces and energies, by the class of the shape",
        "solver.contact.live_interval": "the state of a contact",
        "solver.contact.loading": "indent",
        "solver.contact.pressure": "a field of the result",
        "solver.contact.quadrature": "integrals of a shape without closed forms",
        "solver.contact.stress": "a field of the result",
        "solver.contact.yielding": "the rule of yield",
        "solver.numerics.blocks": "arrays are treated in blocks",
        "solver.numerics.stable": "differences of powers without loss of digits",
        "solver.profiles.radius_table": "contact radii of shapes that have no formula for them",
    },
    "solver.foundation.chain_impact": BEHIND_BOTH | {
        "solver.foundation.cap": "the caps of elements",
        "solver.foundation.chain_impact": "chain_impact",
        "solver.foundation.element": "a spring with its dashpot and its cap",
        "solver.foundation.foundation": "the row as users see it, in the result",
        "solver.foundation.free_body": "the motion of the body",
        "solver.foundation.fronts": "where elements come into contact and leave it",
        "solver.foundation.grid": "the places of elements",
        "solver.foundation.narrow": "a contact narrower than an element",
        "solver.foundation.refinement": "the limit for vanishing elements",
        "solver.foundation.row": "the row of elements in one state",
        "base.motions": "the motion over time, and names of the impact",
        "solver.medium.modes": "modes of a structure, which the chain refuses",
        "solver.medium.structure": "Structure",
    },
}  # fmt: skip
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


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_imports_point_down(name):
    assert all(place(other) <= place(name) for other in imports()[name])


def test_there_is_no_circle():
    """Of modules; that one imports its own folder's first file does not count."""
    TopologicalSorter(imports()).prepare()


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_modules_are_imported_at_the_top(name):
    """Not in functions, but for optional packages, and for what shows a result."""
    functions = (node for node in ast.walk(tree_of(name)) if isinstance(node, ast.FunctionDef))
    assert not imported(name, (node for each in functions for node in ast.walk(each)))
    if "import_module" in (node.id for node in ast.walk(tree_of(name)) if isinstance(node, ast.Name)):
        # What stands above, optional packages and public names.
        assert name in {"base.lazy", "show.report", "sweep.__init__", "__init__"}


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


@pytest.mark.parametrize("name", BEHIND)
def test_what_stands_behind_a_call_has_its_reason(name):
    """One who reads the call reads these: a further name is added with the words why."""
    assert behind(name) == {*BEHIND[name]}


def test_shapes_and_laws_of_the_library_need_no_room_for_what_users_write():
    """A sphere on the paper's medium imports nothing of the room for what users write."""
    code = (
        "import sys, mdr_core as mdr; medium = mdr.Medium(1e9, q_c=1.0, hardness=1e6); "
        "mdr.indent(mdr.Sphere(1e-6), medium, 1e-9).force; "
        "mdr.chain_impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=1.0), 1e-9, 0.1); "
        "print(*(name for name in sys.modules if name.startswith('mdr_core.solver.own')))"
    )
    assert not python(code).split()


def private(name):
    return name.startswith("_") and not name.startswith("__")


def names_given(tree):
    """Names that a file gives to functions, classes, variables, and attributes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr


def private_names_of_others(tree):
    """Private names that are read from other objects than `self`, or given to calls."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and private(node.attr):
            if ast.unparse(node.value) not in ("self", "cls", "super()"):
                yield node.attr
        elif isinstance(node, ast.keyword) and node.arg and private(node.arg):
            yield node.arg


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_a_private_name_of_another_object_is_used_in_its_own_file_only(name):
    """What other files call has a public name, and says what it is."""
    foreign = {*private_names_of_others(tree_of(name))} - {*names_given(tree_of(name))}
    # The functions of a named tuple have an underscore, so that fields may have any name.
    assert not foreign - {"_replace", "_fields"}


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
