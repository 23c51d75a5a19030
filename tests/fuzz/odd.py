"""Calls that are right but for one argument, or one index."""

import numpy as np

import mdr_core as mdr

from .source import ODD, finite

CONE, MEDIUM, WET = mdr.Cone(0.3), mdr.Medium(1e9, 10.0), mdr.Medium(1e9, 10.0, 1e3)
DEPTHS, TIMES, RADII = [1e-7, 5e-8, 2e-7], [1e-3, 2e-3, 3e-3], [0.0, 1e-7, 1e-6]
PATH = mdr.indent(CONE, MEDIUM, DEPTHS)
TIMED = mdr.indent(CONE, WET, DEPTHS, time=TIMES, tolerance=1e-2)
HIT, MANY = mdr.impact(CONE, WET, 1e-9, 0.1), mdr.impact(CONE, MEDIUM, 1e-9, [0.1, 0.2])
ROW = mdr.Foundation(CONE, WET, 20, 1e-6).advance(1e-7)
SCENE = mdr.Scene(CONE, WET, mdr.FreeImpact(1e-9, 0.1))


def _slopes(function):
    """What such a shape gives where it is asked."""
    shape = mdr.Smooth(function, 1e-5)
    return shape.contact_radius(1e-8), shape.height(1e-6)


#: What is called, and arguments that are right.
CALLS = (
    (mdr.indent, {"profile": CONE, "medium": MEDIUM, "depth": DEPTHS}),
    (mdr.indent, {"profile": CONE, "medium": WET, "depth": DEPTHS, "time": TIMES, "tolerance": 1e-2}),
    (mdr.indent_to_force, {"profile": CONE, "medium": MEDIUM, "force": [1e-6, 2e-6]}),
    (mdr.indent_to_force, {"profile": CONE, "medium": WET, "force": [1e-6, 2e-6], "time": [1e-3, 2e-3],
                           "tolerance": 1e-2}),
    (mdr.impact, {"profile": CONE, "medium": WET, "mass": 1e-9, "speed": 0.1, "plastic_depth": 1e-8}),
    (mdr.chain_impact, {"profile": CONE, "medium": WET, "mass": 1e-9, "speed": 0.1, "start": ROW, "n": 20,
                        "tolerance": 1e-1}),
    (mdr.Foundation, {"profile": CONE, "medium": WET, "n": 20, "half_width": 1e-6, "nodes": (1e-7,)}),
    (ROW.advance, {"depth": 1e-7, "dt": 1e-3}),
    (HIT.motion, {"n": 5}),
    (mdr.Medium, {"E_star": 1e9, "q_c": 10.0, "eta": 1e3}),
    (mdr.Medium.from_bodies, {"E1": 1e9, "nu1": 0.3, "E2": 1e9, "nu2": 0.3, "q_c": 10.0, "eta": 1e3}),
    (mdr.Sampled, {"r": [0.0, 1e-6], "z": [0.0, 1e-6]}),
    (mdr.Sampled.convex_envelope, {"r": [0.0, 1e-6, 2e-6], "z": [0.0, 2e-6, 2.5e-6]}),
    (mdr.Sampled.from_csv, {"path": "no such file", "unit": "nm"}),
    (mdr.Smooth, {"slope_function": np.tanh, "radius": 1e-5}),
    (_slopes, {"function": np.tanh}),
    (mdr.Scene, {"profile": CONE, "medium": MEDIUM, "drive": mdr.DepthPath(1e-7)}),
    (mdr.DepthPath, {"depth": DEPTHS, "time": TIMES}),
    (mdr.ForcePath, {"force": DEPTHS, "time": TIMES}),
    (mdr.FreeImpact, {"mass": 1e-9, "speed": 0.1, "plastic_depth": 1e-8}),
    (SCENE.solve, {"model": "chain"}),
    (mdr.Scene.from_json, {"text": SCENE.to_json()}),
    (mdr.ScalingLaw, {"hardness": "a", "exponent": 1.0}),
    (mdr.hardness_class, {"energy": [1.0, 2.0], "radius": [1.0, 1.2], "exponent": 2.0}),
    (mdr.abel.reduce_slope, {"slope": np.tanh, "x": RADII}),
    (mdr.abel.height_from_reduced, {"reduced": np.square, "r": RADII}),
    (mdr.abel.kappa, {"n": 2.0}),
    (mdr.abel.stress_from_line_load, {"x": RADII, "q": [3.0, 2.0, 0.0], "r": RADII, "axis": "even",
                                      "interpolation": "cubic"}),
    (mdr.abel.line_load_from_stress, {"r": RADII, "stress": [3.0, 2.0, 0.0], "x": RADII}),
    *((part.__getitem__, {"index": 0}) for part in (PATH, TIMED, MANY)),
    *((part.entries, {"index": ()}) for part in (CONE, MEDIUM)),
    *((method, {"r": RADII}) for method in (CONE.height, CONE.reduced, CONE.contact_radius,
                                            PATH[0].pressure, PATH[0].line_load, PATH[0].surface,
                                            PATH[0].imprint, TIMED[1].line_load, TIMED[1].pressure)),
)  # fmt: skip


def one_odd(source):
    """One of the arguments is anything, and the rest is right."""
    function, arguments = source.pick(CALLS)
    values = dict(arguments)
    values[source.pick(list(values))] = source.pick(ODD)
    # What cannot be an index is refused by NumPy.
    refused = (IndexError, ValueError) if "index" in values else FileNotFoundError
    try:
        result = function(*values.values()) if len(values) == 1 else function(**values)
    except refused:
        return
    for value in vars(result).values() if hasattr(result, "__dict__") else (result,):
        if isinstance(value, (float, np.ndarray)) and np.asarray(value).dtype.kind == "f":
            finite(value, infinite=True)
