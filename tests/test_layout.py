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

from .approx import approx

PACKAGE = Path(mdr.__file__).parent
#: From the bottom up; what is of one folder may import what stands below it, and others of the folder.
KERNEL = (
    "_errors", "_read_only", "_door", "_check", "numerics", "abel", "profiles", "hardness",
    "transverse_isotropy", "medium", "structure", "applicability", "foundation", "contact", "impacts",
)  # fmt: skip
ORDER = (
    *KERNEL, "own", "show", "oblique", "measured_curve", "files", "reading", "fit", "sweep_arguments",
    "sweep", "drives", "scene", "__init__",
)  # fmt: skip
#: What is asked for by `above`, the door, and why: a new name is a line here, with its reason.
DOORS = {
    "own.shape": "a user's shape is admitted, up to the contact radii that are reached",
    "own.law": "a user's law of hardness is admitted, and asked in the units of a cap",
    "own.cap": "the rule of yield of a law of which nothing is known beforehand",
    "show.report": "a result as text, table or dataset",
    "show.limits": "the limits of a result as data and in words",
    "show.plots": "a result is drawn",
    "show.hints": "an error says what is meant by a name that is not here",
    "show.progress": "a long calculation says how far it is",
    "files.tips": "a tip is read from a file",
}
#: Modules behind calls of the kernel, those of both first, and why.
BEHIND_BOTH = {
    "_check": "arguments are checked",
    "_door": "what stands above is imported when it is asked for",
    "_errors": "refusals name the quantity, its value and a remedy",
    "_read_only": "functions of users get arrays that they cannot change",
    "applicability": "what goes together, and what a user wrote is admitted",
    "hardness": "laws of hardness, the paper's sum among them",
    "medium": "Medium",
    "numerics.gauss": "quadrature",
    "numerics.remark": "remarks on a shape, and refusals",
    "numerics.results": "base classes of results",
    "numerics.roots": "depths and radii are roots",
    "profiles.profile": "Profile",
    "transverse_isotropy": "the modulus of a Medium of another symmetry",
}
BEHIND = {
    "contact.loading": BEHIND_BOTH | {
        "contact.adhesion": "the rim of a contact with adhesion",
        "contact.indentation": "the result",
        "contact.integrals": "forces and energies, by the class of the shape",
        "contact.live_interval": "the state of a contact",
        "contact.loading": "indent",
        "contact.pressure": "a field of the result",
        "contact.quadrature": "integrals of a shape without closed forms",
        "contact.stress": "a field of the result",
        "contact.yielding": "the rule of yield",
        "numerics.blocks": "arrays are treated in blocks",
        "numerics.stable": "differences of powers without loss of digits",
        "profiles.radius_table": "contact radii of shapes that have no formula for them",
    },
    "foundation.chain_impact": BEHIND_BOTH | {
        "foundation.cap": "the caps of elements",
        "foundation.chain_impact": "chain_impact",
        "foundation.element": "a spring with its dashpot and its cap",
        "foundation.foundation": "the row as users see it, in the result",
        "foundation.free_body": "the motion of the body",
        "foundation.fronts": "where elements come into contact and leave it",
        "foundation.grid": "the places of elements",
        "foundation.narrow": "a contact narrower than an element",
        "foundation.refinement": "the limit for vanishing elements",
        "foundation.row": "the row of elements in one state",
        "numerics.motions": "the motion over time, and names of the impact",
        "structure": "Structure",
    },
}  # fmt: skip
# What the chain bears witness of.
CHECKED = {
    "contact.live_interval", "contact.quadrature", "contact.integrals", "contact.yielding",
    "own.cap",
    "contact.closed_forms", "contact.adhesion", "contact.pressure", "contact.indentation",
    "contact.loading", "contact.unloading", "contact.creep_loading", "contact.creep_retreat",
    "contact.creep_states", "contact.creep", "impacts.impact",
    "impacts.energy_balance", "impacts.adhesive", "impacts.contact_time",
    "impacts.result", "impacts.viscous", "impacts.equation_of_motion",
    "impacts.collocation_steps", "impacts.motion_solver", "impacts.motion",
    "impacts.scaling", "impacts.snap", "profiles.radius_table", "contact.stress",
}  # fmt: skip


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
        found |= {part if part in KNOWN else ".".join(base) for part in parts}
    return found


def doors(tree):
    """Modules that are asked for by `above`, the door upward."""
    return {
        ast.literal_eval(node.args[0])
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "above"
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
    return ORDER.index(name.split(".")[0])


def test_every_folder_has_its_place():
    assert {name.split(".")[0] for name in KNOWN} == set(ORDER)


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
    assert doors(tree_of(name)) <= {*DOORS}
    if "import_module" in (node.id for node in ast.walk(tree_of(name)) if isinstance(node, ast.Name)):
        # `above`, optional packages and public names.
        assert name in {"_door", "show.report", "sweep", "__init__"}


def behind(name):
    """Modules that are imported with one, itself among them; not the empty first files of folders."""
    reached, new = set(), {name}
    while new:
        reached |= new
        new = set().union(*(imports()[each] for each in new)) - reached
    return {each for each in reached if not each.endswith("__init__")}


def test_all_doors_lead_somewhere():
    assert {*DOORS} == set().union(*map(doors, map(tree_of, KNOWN))) <= KNOWN


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
        "print(*(name for name in sys.modules if name.startswith('mdr_core.own')))"
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
    # What a user wrote is admitted and asked through the door.
    start = {name for name in KNOWN if name.startswith("foundation.")} | {"own.law", "own.shape"}
    reached = set().union(*map(behind, start))
    # The search has gone down to the bottom.
    assert {"medium", "profiles.profile", "_check"} <= reached
    assert CHECKED <= KNOWN
    assert not reached & CHECKED


def test_only_public_names_are_shown():
    assert dir(mdr) == sorted(mdr.__all__)
    assert all(hasattr(mdr, name) for name in mdr.__all__)


def test_type_checkers_see_the_names_that_are_found_when_they_are_asked_for():
    seen = {
        (alias.name, node.module)
        for node in ast.walk(tree_of("__init__"))
        if isinstance(node, ast.ImportFrom) and node.level and node.module != "_check"
        for alias in node.names
    }
    found = {(name, module) for module, names in mdr._MODULES.items() for name in names}
    assert seen == found | {("abel", None), ("sweep", None)}
    assert {name for name, _ in seen} == set(mdr.__all__)


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
    run = {name.split(".")[1] for name in python(code).split()}
    assert run <= set(KERNEL)
    assert not run & {"impacts", "foundation"}


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
