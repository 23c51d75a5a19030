"""Dimensionless axes: each quantity over one of the scene itself, so that all media are on one curve."""

from dataclasses import dataclass

import numpy as np

from mdr_core.figures import Axis

from .trajectory import onset


@dataclass(frozen=True)
class Ratio(Axis):
    """An axis whose unit is a size of the scene: d in d_c, written as d/d_c."""

    @property
    def label(self):
        """The title, each of its symbols over the unit."""
        *symbols, name = self.title.split(", ")
        return ", ".join([*(f"{symbol}/{self.unit}" for symbol in symbols), name])


def over(axis, size):
    """An axis with a size (SI) of the scene, and its symbol, for its unit, if there is such a size."""
    return Ratio(axis.name, axis.title, size[1], size[0], axis.start, axis.end) if size else axis


def scales(way):
    """Sizes (SI) of a scene with their symbols, by the names of the axes that they are the units of.

    Depth, force and radius where yield starts, on the surface as it was at first; where that is never, or
    the shape is not known so deep, those of the deepest state. Radii in fields, and pressures, have the
    contact radius and the mean pressure of the deepest state.
    """
    begun, deepest = onset(way.scene), way.deepest
    at, index = (deepest, "max") if begun is None else (begun, "c")
    names = {"depth": "d", "force": "F", "contact_radius": "a"}
    depth, force, radius = ((float(getattr(at, name)), f"{s}_{index}") for name, s in names.items())
    found = {"d": depth, "z": depth, "section z": depth, "F": force, "a": radius}
    along = float(deepest.contact_radius), "a_max"
    found |= dict.fromkeys(("x", "r", "plane x", "plane y", "section r", "depth"), along)
    found |= dict.fromkeys(("p", "stress"), (float(deepest.mean_pressure), "p_m"))
    if way.motion is not None:
        found["t"] = float(np.ptp(way.motion.time)), "T"
        # A path begins without energy: the most that is put in stands in.
        found["E"] = float(np.max(way.energy)), "E_max" if way.hit is None else "E_0"
    if way.oblique is not None:
        found["force"] = found["F"]
        found |= dict.fromkeys(("W", "v"), (way.scene.drive.speed, "v_0"))
    return found
