"""One trajectory and the axes that hold it: what every plot draws from, in SI."""

from functools import cached_property

import numpy as np

from mdr_core.figures import NOTHING, REST, Axis, ceiling, radii

from .units import digits, fitting, round_up, written


def axis(name, title, kind, largest, below=0.0, start=None):
    """An axis that ends at the next round number above `largest` (SI), in a unit that fits."""
    unit = fitting(largest, kind)
    if round_up(largest / unit.factor) >= 1000:
        unit = fitting(round_up(largest / unit.factor) * unit.factor, kind)
    end = round_up(largest / unit.factor) * unit.factor
    return Axis(name, title, unit.name, unit.factor, 0.0 - below * end if start is None else start, end)


class View:
    """A trajectory and its axes, with what is held beside it, and what plots have found at rest."""

    def __init__(self, way, held=None, found=None):
        self.way, self.held, self.found, self._drawn = way, held, found or {}, {}
        self.axes = self._axes()
        self.end = {name: each.end for name, each in self.axes.items()}

    @cached_property
    def first(self):
        """Number of the first state that has yielded; one past the deepest if none has."""
        yielded = np.flatnonzero(self.way.states.live.lower > self.way.states.live.lower[0])
        return int(yielded[0]) if len(yielded) else self.way.peak + 1

    def _axes(self):
        size = _largest(self.way)
        if self.held is not None:
            size = {name: max(value, _largest(self.held).get(name, 0.0)) for name, value in size.items()}
        depth = 1.02 * max(size["depth"], size["onset"])
        described = [
            ("x", "x, coordinate of the springs", "length", size["length"], 1.0),
            ("r", "r, radius", "length", size["length"], 1.0),
            ("plane x", "x, in the plane", "length", size["length"], 1.0),
            ("plane y", "y, in the plane", "length", size["length"], 1.0),
            ("z", "z, height", "length", size["depth"], REST),
            ("d", "d, indentation depth", "length", depth),
            ("F", "F, normal force", "force", size["force"]),
            ("a", "a, c, radius", "length", size["length"] / 1.1),
            ("p", "−σzz, contact pressure", "pressure", size["pressure"]),
        ]
        if self.way.motion is not None:
            described.append(("t", "t, time", "time", size["time"]))
            described.append(("E", "energy", "energy", size["energy"]))
        return {name: axis(name, *rest) for name, *rest in described}

    def axes_of(self, plot):
        """The axes of a plot: those of the view, or what was found with its rows."""
        found = self.found.get(plot.title)
        return found.axes if found else [self.axes[key] for key in plot.axes]

    def still(self, plot):
        """Rows of a plot that stay while the scene is played."""
        if plot not in self._drawn:
            found = self.found.get(plot.title)
            self._drawn[plot] = plot.still(self) | (found.rows if found else {})
        return self._drawn[plot]

    def columns(self, plot, i):
        """All rows of a plot in state i, empty where there is none; where the page stands they are kept."""
        if (plot, i) in self._drawn:
            return self._drawn[plot, i]
        rows = {row.name: (*NOTHING, "") for row in plot.rows}
        if plot.image:
            rows["image"] = np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.full(plot.image, np.nan)
        rows |= self.still(plot) | plot.moving(self, i)
        if i in (self.way.now, self.way.peak):
            self._drawn[plot, i] = rows
        return rows

    def pressure(self, i):
        """Radii and pressures (SI) of state i."""
        if ("pressure", i) not in self._drawn:
            state = self.way.states[i]
            r = radii(state, self.end["x"])
            self._drawn["pressure", i] = r, state.pressure(r)
        return self._drawn["pressure", i]

    def beyond(self, i):
        """What is said of a pressure that the axis does not reach; nothing if it does."""
        r, p = self.pressure(i)
        infinite, k = np.isinf(p), int(np.argmax(np.where(np.isinf(p), -1.0, p)))
        if infinite.any():
            # A sharp tip that has not yielded is infinite on the axis, a flat face at its rim.
            return "↑ −σzz → ∞ at the " + ("axis" if r[np.argmax(infinite)] == 0 else "rim")
        if p[k] <= self.end["p"]:
            return ""
        where = "on the axis" if r[k] == 0 else f"at r = {written(r[k], 'length', 3)}"
        return f"↑ −σzz = {written(p[k], 'pressure', 3)} {where}"


def _largest(way):
    """Largest values (SI) that the axes are to hold."""
    states, onset = way.states, way.onset
    size = {
        "length": 1.25 * float(np.max(states.contact_radius)),
        "depth": float(np.max(states.depth)),
        "force": 1.05 * float(np.max(way.force)),
        "onset": 0.0,
    }
    # An onset that lies little deeper than the path is kept in the picture.
    if onset is not None and size["depth"] < onset.depth <= 2.5 * size["depth"]:
        size["onset"] = 1.02 * float(onset.depth)
        size["force"] = max(size["force"], 1.05 * float(onset.force))
    size["pressure"] = 1.05 * ceiling(way.deepest, size["length"])
    if way.motion is not None:
        size["time"], size["energy"] = float(way.motion.time[-1]), float(way.motion.kinetic_energy[0])
    return size


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
