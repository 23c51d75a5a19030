"""Curves of force and depth to compare with: the same tip without yield, and the other classes of hardness.

Popov (2015), section 1: under a fully yielded contact the force goes as aⁱ, i = 2 where the hardness is
constant (a), 1 where it is as 1/a (b), this model, and 0 where it is as 1/a² (c), with the contact
radius a = g⁻¹(d) of (16). All of them have the hardness F/(πa²) of the deepest state of the scene.
"""

import numpy as np

import mdr_core as mdr
from mdr_core.results.figures import line

_ELASTIC = "elastic throughout"
_CLASSES = {"a": "class (a), F ∝ a²", "c": "class (c), F constant"}
ROWS = (
    line(_ELASTIC, "free", 1.6, "dashed", "F"),
    line(_CLASSES["a"], "ink", 1.4, "dotted", "F"),
    line(_CLASSES["c"], "ink", 1.4, "dotdash", "F"),
)
#: Depths, over the largest: close where a logarithmic axis begins, too.
_SHARE = np.unique(np.append(np.linspace(0, 1, 80), np.geomspace(1e-5, 1, 60)))


def curves(view):
    """Those that are chosen, as deep as the axis reaches and the shape is known."""
    chosen, way, rows = view.chosen["references"], view.way, {}
    profile, deepest = way.scene.profile, way.deepest
    depth = _SHARE * min(view.end["d"], profile.known_depth)
    if chosen in ("elastic", "all"):
        rows[_ELASTIC] = depth, mdr.indent(profile, mdr.Medium(way.scene.medium.E_star), depth).force
    if chosen in ("classes", "all") and deepest.live_interval.lower > 0:
        share = profile.contact_radius(depth) / deepest.contact_radius
        for name, row in _CLASSES.items():
            rows[row] = depth, deepest.force * share ** mdr.ScalingLaw(name, 1.0).force
    return rows


def note(view):
    """What they are, and why some of them are not there."""
    chosen = view.chosen["references"]
    if chosen == "none":
        return ""
    if chosen == "elastic":
        return (
            "The same tip on the same medium if it never yielded: F = 2E* ∫ a dd, of a paraboloid Hertz's."
        )
    if view.way.deepest.live_interval.lower == 0:
        return "Nothing has yielded: this scene has no hardness that the classes could share."
    return (
        "Fully yielded, hardness constant (a) or ∝ 1/a² (c), as hard as this scene (b) where it is deepest."
    )
