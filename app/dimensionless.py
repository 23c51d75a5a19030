"""Dimensionless axes: each quantity over one of the scene itself, so that all media are on one curve."""

from dataclasses import replace

import numpy as np

from .trajectory import onset


def over(axis, size):
    """An axis with a size (SI) of the scene, and what that is, for its unit, if there is such a size."""
    return replace(axis, unit=f"× {size[1]}", factor=size[0]) if size else axis


def scales(way):
    """Sizes (SI) of a scene with what they are, by the names of the axes that they are the units of.

    Depth, force and radius where yield starts, on the surface as it was at first; where that is never, or
    the shape is not known so deep, those of the deepest state. Radii in fields, and pressures, have the
    contact radius and the mean pressure of the deepest state.
    """
    begun, deepest = onset(way.scene), way.deepest
    at, words = (deepest, "largest {}") if begun is None else (begun, "{} at onset")
    names = {"depth": "d", "force": "F", "contact_radius": "a"}
    depth, force, radius = ((float(getattr(at, n)), words.format(s)) for n, s in names.items())
    found = {"d": depth, "z": depth, "section z": depth, "F": force, "a": radius}
    along = float(deepest.contact_radius), "largest a"
    found |= dict.fromkeys(("x", "r", "plane x", "plane y", "section r", "depth"), along)
    found |= dict.fromkeys(("p", "stress"), (float(deepest.mean_pressure), "mean pressure"))
    if way.motion is not None:
        found["t"] = float(np.ptp(way.motion.time)), "duration"
        # That of a body, or what is put in along a path, which begins without any.
        found["E"] = float(np.max(way.energy)), "energy put in"
    if way.oblique is not None:
        found["force"] = found["F"]
        found |= dict.fromkeys(("W", "v"), (way.scene.drive.speed, "v₀"))
    return found
