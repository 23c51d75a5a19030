"""Arguments stay the caller's: no flag of an array is set, and no result shares its memory."""

import inspect

import numpy as np
import pytest

import mdr_core as mdr

from .laws import NixGao

CONE, MEDIUM = mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0)
VISCOUS, STICKY = mdr.Medium(1e9, q_c=10.0, eta=1e3), mdr.Medium(1e9, q_c=8.0, work_of_adhesion=2e-3)
DEPTH = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 30e-9, 50))
TIME = np.linspace(0.0, 1.0, 150)
FORCE = mdr.indent(CONE, MEDIUM, DEPTH).force.copy()
ONE, TWO = np.array([1.0, 2.0]), np.array([0.2, 0.3])
RADIUS = np.linspace(0.0, 1e-6, 30)
STATE = mdr.indent(CONE, MEDIUM, 30e-9)
NOISE = np.full(150, 1e-9)


def law_of(**given):
    """The law that a medium keeps."""
    return mdr.Medium(1e9, hardness=NixGao(**given)).hardness


#: A call of every public function and class that takes arrays.
CALLS = {
    "Ball": (mdr.Ball, {"radius": 1e-6 * ONE, "mass": ONE}),
    "Cone": (mdr.Cone, {"slope": TWO}),
    "DepthPath": (mdr.scene.DepthPath, {"depth": DEPTH, "time": TIME}),
    "FlatPunch": (mdr.FlatPunch, {"radius": ONE}),
    "ForcePath": (mdr.scene.ForcePath, {"force": np.abs(FORCE), "time": TIME}),
    "HardnessLaw": (law_of, {"H0": 1e9 * ONE, "a_star": 1e-6 * ONE}),
    "Hyperboloid": (mdr.Hyperboloid, {"slope": TWO, "tip_radius": ONE}),
    "MeasuredCurve": (mdr.MeasuredCurve, {"depth": DEPTH, "force": FORCE, "time": TIME}),
    "Medium": (mdr.Medium, {"E_star": 1e9 * ONE, "q_c": ONE, "eta": ONE, "poisson": TWO}),
    "Medium.from_bodies": (mdr.Medium.from_bodies, {"E1": 1e9 * ONE, "nu1": TWO, "q_c": ONE}),
    "ParabolicPunch": (mdr.ParabolicPunch, {"radius": ONE, "cylinder_radius": TWO}),
    "Paraboloid": (mdr.Paraboloid, {"radius": ONE}),
    "PowerLaw": (mdr.PowerLaw, {"coefficient": ONE, "exponent": ONE}),
    "RoundedCone": (mdr.RoundedCone, {"tip_radius": ONE, "slope": TWO}),
    "RoundedPunch": (mdr.RoundedPunch, {"flat_radius": ONE, "edge_radius": ONE}),
    "Sampled": (mdr.Sampled, {"r": RADIUS, "z": 0.3 * RADIUS}),
    "Sampled.fit": (mdr.Sampled.fit, {"r": RADIUS, "z": 0.3 * RADIUS + 1e5 * RADIUS**2}),
    "Sphere": (mdr.Sphere, {"radius": ONE}),
    "Structure": (mdr.Structure, {"impedance": ONE, "edge": ONE, "thickness": ONE}),
    "Structure.plate": (mdr.Structure.plate, {"thickness": ONE, "E": ONE, "nu": 0.1 * TWO, "density": ONE}),
    "TruncatedCone": (mdr.TruncatedCone, {"flat_radius": ONE, "slope": TWO}),
    "TruncatedParaboloid": (mdr.TruncatedParaboloid, {"flat_radius": ONE, "radius": ONE}),
    "at_angle": (mdr.at_angle, {"speed": ONE, "angle": TWO}),
    "capture_speeds": (mdr.capture_speeds, {"profile": CONE, "medium": STICKY, "mass": 1e-12 * ONE}),
    "contact_radius": (CONE.contact_radius, {"depth": np.abs(DEPTH)}),
    "creep": (mdr.creep, {"profile": CONE, "medium": VISCOUS, "force": np.abs(FORCE), "time": TIME}),
    "yield_force": (mdr.yield_force, {"profile": mdr.Cone(TWO), "medium": MEDIUM}),
    "yield_depth": (mdr.yield_depth, {"profile": mdr.Cone(TWO), "medium": MEDIUM}),
    "fit_hardness": (mdr.fit_hardness, {"profile": CONE, "radius": 1e-7 * ONE, "E_star": 1e9}),
    "fit_indentation": (mdr.fit_indentation, {"depth": DEPTH, "force": FORCE, "force_noise": NOISE}),
    "fit_indentation of many": (
        mdr.fit_indentation,
        {"depth": np.array([DEPTH, DEPTH]), "force": np.array([FORCE, FORCE]), "q_c": 10.0 * ONE},
    ),
    "fit_indentation in time": (mdr.fit_indentation, {"depth": DEPTH, "force": FORCE, "time": TIME}),
    "fit_indentation of a list": (mdr.fit_indentation, {"depth": [DEPTH, DEPTH], "force": [FORCE, FORCE]}),
    "hardness_class": (mdr.hardness_class, {"energy": ONE, "radius": ONE**0.3, "exponent": 1.0}),
    "impact": (mdr.impact, {"mass": 1e-12 * ONE, "speed": ONE, "plastic_depth": 1e-9 * ONE}),
    "impact, viscous": (mdr.impact, {"medium": VISCOUS, "mass": 1e-12 * ONE, "speed": ONE}),
    "indent": (mdr.indent, {"depth": DEPTH}),
    "indent_in_time": (mdr.indent_in_time, {"medium": VISCOUS, "depth": DEPTH, "time": TIME}),
    "indent_to_force": (mdr.indent_to_force, {"force": np.abs(FORCE)}),
    "oblique_impact": (
        mdr.oblique_impact,
        {"mass": 1e-12 * ONE, "speed": ONE, "tangential_speed": ONE, "friction": TWO},
    ),
    "oliver_pharr": (mdr.oliver_pharr, {"depth": DEPTH, "force": FORCE}),
    "pressure": (STATE.pressure, {"r": RADIUS}),
    "stress": (STATE.stress, {"r": RADIUS, "z": RADIUS}),
    "stress_from_line_load": (
        mdr.abel.stress_from_line_load,
        {"x": RADIUS, "q": 1.0 - RADIUS / 1e-6, "r": RADIUS},
    ),
    "surface_displacement": (
        mdr.abel.surface_displacement,
        {"x": RADIUS, "u": 1.0 - RADIUS / 1e-6, "r": RADIUS},
    ),
    "yield_speed": (mdr.yield_speed, {"mass": ONE}),
}  # fmt: skip
#: Public names that take no arrays, or only through those above.
WITHOUT = {
    "ChainImpact", "CurveTable", "Foundation", "HardnessClass", "HardnessFit", "Impact", "Indentation",
    "IndentationFit", "Limit", "MDRError", "MeasuredCurves", "Motion", "ObliqueImpact",
    "OliverPharr", "Profile", "Quoted", "Remark", "Remedy", "ScalingLaw", "Scene", "Smooth",
    "TimedIndentation", "UnknownColumns", "abel", "chain_impact", "example", "read_curve", "read_curves",
    "scene", "sweep",
}  # fmt: skip


#: Beginnings of names of calls whose arrays are measurements.
FITS = "fit_indentation", "oliver_pharr"


def arrays_in(thing, seen):
    """Arrays among the attributes of a result, and of what it holds."""
    if isinstance(thing, np.ndarray):
        return [thing]
    if id(thing) in seen:
        return []
    seen.add(id(thing))
    parts = []
    if isinstance(thing, dict):
        parts = list(thing.values())
    elif isinstance(thing, list | tuple):
        parts = list(thing)
    elif type(thing).__module__.startswith("mdr_core") and not isinstance(thing, str):
        parts = list(vars(thing).values())
        parts += list(thing.to_dict().values()) if hasattr(thing, "to_dict") else []
    return [array for part in parts for array in arrays_in(part, seen)]


def copied(value):
    """New arrays, so that no call sees those of another one."""
    if isinstance(value, list):
        return [each.copy() for each in value]
    return value.copy() if isinstance(value, np.ndarray) else value


def call_of(name):
    """A function of `CALLS`, its arguments with new arrays, and others that it needs."""
    function, arguments = CALLS[name]
    parameters = inspect.signature(function).parameters
    others = {"profile": CONE, "medium": MEDIUM, "mean_pressure": 1e8 / ONE}
    others = {key: value for key, value in others.items() if key in parameters and key not in arguments}
    return function, {key: copied(value) for key, value in arguments.items()}, others


@pytest.mark.parametrize("name", CALLS)
def test_arguments_are_not_touched_and_not_kept(name):
    function, arguments, others = call_of(name)
    given = {
        key: np.array(value) for key, value in arguments.items() if isinstance(value, np.ndarray | list)
    }
    result = function(**others, **arguments)
    kept = arrays_in(result, set())
    for key, before in given.items():
        for array in arguments[key] if isinstance(arguments[key], list) else [arguments[key]]:
            assert array.flags.writeable, key
            assert not any(np.shares_memory(array, other) for other in kept), key
        np.testing.assert_array_equal(arguments[key], before)


@pytest.mark.parametrize("bad", [np.nan, "no number"])
@pytest.mark.parametrize("name", [name for name in CALLS if not name.startswith(FITS)])
def test_an_entry_that_is_no_number_is_refused_by_the_name_of_its_argument(name, bad):
    """Of each array; measurements may have samples without a number, which are left out."""
    for key, value in CALLS[name][1].items():
        if isinstance(value, np.ndarray):
            function, arguments, others = call_of(name)
            arguments[key] = [*value[:-1].tolist(), bad]
            with pytest.raises(mdr.MDRError) as refused:
                function(**others, **arguments)
            assert refused.value.argument == key


def test_every_public_name_is_here():
    """A new function or class gets its call."""
    called = {name.split(".")[0].split(",")[0].split(" ")[0] for name in CALLS}
    assert set(mdr.__all__) <= called | WITHOUT


def test_a_fit_does_not_change_with_the_data():
    """Data that are changed afterwards leave the fit as it was, and its arrays are read-only."""
    depth, force = DEPTH.copy(), FORCE.copy()
    fit = mdr.fit_indentation(CONE, depth, force)
    force[:] = 0.0
    np.testing.assert_array_equal(fit.force, FORCE)
    with pytest.raises(ValueError, match="read-only"):
        fit.force[0] = 0.0
