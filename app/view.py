"""One trajectory in the units of its axes: what every plot draws from."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .units import digits, fitting, round_up, written

#: Depth of the springs' base below the surface, in units of the height axis.
REST = 1.5


@dataclass(frozen=True)
class Axis:
    """An axis: its title with the unit, the unit's name and size (SI), and where it starts and ends."""

    title: str
    unit: str
    factor: float
    start: float
    end: float


def _axis(title, kind, largest, below=0.0):
    """An axis that ends at the next round number above `largest` (SI), in a unit that fits."""
    unit = fitting(largest, kind)
    end = round_up(largest / unit.factor)
    if end >= 1000:
        unit = fitting(end * unit.factor, kind)
        end = round_up(largest / unit.factor)
    return Axis(unit.label(title), unit.name, unit.factor, 0.0 - below * end, end)


class View:
    """Arrays of a trajectory by the symbols of its axes, and the axes; with room for what is held."""

    def __init__(self, way, held=None):
        self.way, self.held = way, held
        self.axes = self._axes()
        self.unit = {name: axis.factor for name, axis in self.axes.items()}
        self.end = {name: axis.end for name, axis in self.axes.items()}
        states = way.states
        self.d, self.F = self.scaled("d", states.depth), self.scaled("F", way.force)
        self.a, self.c = self.scaled("a", states.contact_radius), self.scaled("a", states.plastic_radius)
        self.c = np.where(self.c > 0, self.c, np.nan)
        yielded = np.flatnonzero(states.live.lower > states.live.lower[0])
        #: The first state that has yielded; one past the deepest if none has.
        self.first = int(yielded[0]) if len(yielded) else way.peak + 1

    def scaled(self, axis, values):
        """Values (SI) in the unit of an axis."""
        return np.asarray(values) / self.unit[axis]

    def _axes(self):
        own = _largest(self.way)
        other = _largest(self.held) if self.held is not None else {}
        size = {name: max(value, other.get(name, 0.0)) for name, value in own.items()}
        axes = {
            "x": _axis("x, coordinate of the springs", "length", size["length"], 1.0),
            "r": _axis("r, radius", "length", size["length"], 1.0),
            "plane x": _axis("x, in the plane", "length", size["length"], 1.0),
            "plane y": _axis("y, in the plane", "length", size["length"], 1.0),
            "z": _axis("z, height", "length", size["depth"], REST),
            "d": _axis("d, indentation depth", "length", 1.02 * max(size["depth"], size["onset"])),
            "F": _axis("F, normal force", "force", size["force"]),
            "a": _axis("a, c, radius", "length", size["length"] / 1.1),
            "p": _axis("−σzz, contact pressure", "pressure", size["pressure"]),
        }
        if self.way.motion is not None:
            axes["t"] = _axis("t, time", "time", size["time"])
            axes["E"] = _axis("energy", "energy", size["energy"])
        return axes

    @cached_property
    def pressures(self):
        """Radii and pressures (SI) of the states that were asked for, by their numbers."""
        return {}

    def pressure(self, i):
        """Radii and pressures (SI) of state i."""
        if i not in self.pressures:
            r = self.way.radii(i, self.end["x"] * self.unit["x"])
            self.pressures[i] = r, self.way.pressure(i, r)
        return self.pressures[i]

    def still(self, plot):
        """Rows of a plot that stay while the scene is played."""
        if plot not in self.drawn:
            self.drawn[plot] = plot.still(self)
        return self.drawn[plot]

    def columns(self, plot, i):
        """All rows of a plot in state i; those of the states that the page stands at are kept."""
        if (plot, i) in self.drawn:
            return self.drawn[plot, i]
        rows = self.still(plot) | plot.moving(self, i)
        if i in (self.way.now, self.way.peak):
            self.drawn[plot, i] = rows
        return rows

    @cached_property
    def drawn(self):
        """Rows that were asked for, by their plot, or by plot and state."""
        return {}

    def beyond(self, i):
        """What is said of a pressure that the axis does not reach; nothing if it does."""
        r, p = self.pressure(i)
        top = self.end["p"] * self.unit["p"]
        infinite, k = np.isinf(p), int(np.argmax(np.where(np.isinf(p), -1.0, p)))
        if infinite.any():
            # A sharp tip that has not yielded is infinite on the axis, a flat face at its rim.
            return "↑ −σzz → ∞ at the " + ("axis" if r[np.argmax(infinite)] == 0 else "rim")
        if p[k] <= top:
            return ""
        where = "on the axis" if r[k] == 0 else f"at r = {written(r[k], 'length', 3)}"
        return f"↑ −σzz = {written(p[k], 'pressure', 3)} {where}"


def _largest(way):
    """Largest values (SI) that the axes are to hold."""
    states, a = way.states, float(np.max(way.states.contact_radius))
    size = {
        "length": 1.25 * a,
        "depth": float(np.max(states.depth)),
        "force": 1.05 * float(np.max(way.force)),
        "onset": 0.0,
    }
    onset = way.onset
    # An onset that lies little deeper than the path is kept in the picture.
    if onset is not None and size["depth"] < onset.depth <= 2.5 * size["depth"]:
        size["onset"] = 1.02 * float(onset.depth)
        size["force"] = max(size["force"], 1.05 * float(onset.force))
    size["pressure"] = 1.05 * _ceiling(way, size["length"])
    if way.motion is not None:
        size["time"], size["energy"] = float(way.motion.time[-1]), float(way.motion.kinetic_energy[0])
    return size


def _ceiling(way, half):
    """The largest pressure to draw: that of the deepest state, where it is infinite some times the mean."""
    pressure = way.pressure(way.peak, way.radii(way.peak, half))
    finite = np.isfinite(pressure)
    largest = float(np.max(pressure[finite], initial=0.0))
    return largest if finite.all() else min(largest, 4 * float(way.deepest.mean_pressure))


def phase(way, i):
    """Where a state stands on its way, in words."""
    share = way.progress[i]
    if i == way.peak:
        words = "deepest"
    else:
        words = "loading" if share < 1 else "unloading" if share < 2 else "load gone"
    if way.motion is None:
        return words
    unit = fitting(float(way.motion.time[-1]), "time")
    return f"{words}, t = {digits(float(way.motion.time[i]) / unit.factor, 3)} {unit.name}"
