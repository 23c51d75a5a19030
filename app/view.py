"""One trajectory and the axes that hold it: what every plot draws from, in SI."""

from dataclasses import replace
from functools import cached_property, partial

import numpy as np

import mdr_core as mdr
from mdr_core.results.figures import NOTHING, REST, Axis, ceiling, radii

from . import friction
from .dimensionless import over, scales
from .quantities import CHOICES
from .units import digits, fitting, round_up, written


def axis(name, title, kind, largest, below=0.0, start=None, size=None):
    """An axis that ends at the next round number above `largest` (SI), in a unit that fits.

    With a `size` (SI) of the scene, and its symbol, over that.
    """
    unit = fitting(largest, kind)
    if round_up(largest / unit.factor) >= 1000:
        unit = fitting(round_up(largest / unit.factor) * unit.factor, kind)
    made = over(Axis(name, title, unit.name, unit.factor), size)
    end = round_up(largest / made.factor) * made.factor
    return replace(made, start=0.0 - below * end if start is None else start, end=end)


class View:
    """A trajectory and its axes, with those held beside it, what plots have found at rest, and choices.

    `curve` is what was measured, if anything was.
    """

    def __init__(self, way, held=(), found=None, chosen=None, curve=None):
        # The first option of what is not chosen.
        self.chosen = {name: next(iter(options)) for name, options in CHOICES.items()} | (chosen or {})
        self.way, self.held, self.found, self.curve, self._drawn = way, held, found or {}, curve, {}
        # Sizes of the scene that are units, and those of what is held, each in its own.
        ratio = self.chosen["axes"] == "ratio"
        self._scales, *self._theirs = (scales(each) if ratio else {} for each in (way, *held))
        self.axes = self._axes()
        self.end = {name: each.end for name, each in self.axes.items()}

    @cached_property
    def first(self):
        """Number of the first state that has yielded; one past the deepest if none has."""
        depth = self.way.states.plastic_depth
        yielded = np.flatnonzero(depth > depth[0])
        return int(yielded[0]) if len(yielded) else self.way.peak + 1

    def _axes(self):
        size, way, curve = _largest(self.way), self.way, self.curve
        for k, held in enumerate(self.held):
            theirs = _largest(held)
            # Heights are those of this scene: nothing that is held is drawn over them.
            for name in size.keys() & theirs.keys() - {"z"}:
                size[name] = max(size[name], self.beside(k, name, theirs[name]))
        if curve is not None:
            size["d"] = max(size["d"], 1.02 * float(curve.depth.max()))
            size["F"] = max(size["F"], 1.05 * float(curve.force.max()))
        described = [
            ("x", "x, coordinate of the springs", "length", size["r"], 1.0),
            ("r", "r, radius", "length", size["r"], 1.0),
            ("plane x", "x, in the plane", "length", size["r"], 1.0),
            ("plane y", "y, in the plane", "length", size["r"], 1.0),
            ("z", "z, height", "length", size["z"], REST),
            ("d", "d, indentation depth", "length", size["d"]),
            ("F", "F, normal force", "force", size["F"]),
            ("a", "a, c, radius", "length", size["a"]),
            ("p", "−σzz, contact pressure", "pressure", size["p"]),
            ("section r", "r, radius", "length", 1.75 * size["r"], 1.0),
            ("section z", "z, height", "length", size["z"], 1.2),
        ]
        if way.motion is not None:
            begin = min(float(way.motion.time[0]), 0.0)
            described.append(("t", "t, time", "time", size["t"], 0.0, begin))
            described.append(("E", "E, energy", "energy", size["E"]))
        if curve is not None:
            largest = float(np.nan_to_num(np.abs(self.residual)).max())
            described.append(("ΔF", "ΔF, residual force", "force", largest, 1.0))
        if way.oblique is not None:
            described += friction.axes(way, size["F"])
        made = {each[0]: axis(*each, size=self._scales.get(each[0])) for each in described}
        least = _least(way).items()
        return made | {f"log {name}": self._logarithmic(made[name], value) for name, value in least}

    @staticmethod
    def _logarithmic(axis, least):
        """The axis from a power of ten below the least value (SI), over eight decades at most."""
        power = np.floor(np.log10(max(least, 1e-8 * axis.end) / axis.factor))
        return replace(axis, start=float(10.0**power) * axis.factor)

    def beside(self, k, name, values):
        """Values of one that is held on an axis of this scene, a dimensionless one in units of its own."""
        both = self._scales, self._theirs[k]
        (ours, same), (theirs, symbol) = (scale.get(name, (1.0, "")) for scale in both)
        return values * (ours / theirs) if symbol == same else values

    def of_held(self, what, columns):
        """Rows of all that is held, `what` after their names: `columns` has a trajectory and `beside`."""
        return {
            f"held {k + 1}{what}": columns(held, partial(self.beside, k))
            for k, held in enumerate(self.held)
        }

    def held_on(self, x, y):
        """Curves of all that is held on two axes, where it has what is on them."""

        def columns(way, over):
            known = way.on.keys() >= {x, y}
            return (over(x, way.on[x]), over(y, way.on[y])) if known else NOTHING

        return self.of_held("", columns)

    def mark(self, i, x, y):
        """Where state i is on two axes."""
        return self.way.on[x][[i]], self.way.on[y][[i]]

    def time(self, i, y):
        """A line at the time of state i, along an axis."""
        return self.way.on["t"][[i, i]], np.array([self.axes[y].start, self.axes[y].end])

    @cached_property
    def residual(self):
        """Measured less modelled force (N)."""
        return self.curve.residual(self.way.scene)

    def axes_of(self, plot):
        """The axes of a plot: those of the view, or what was found with its rows."""
        found = self.found.get(plot.title)
        if found and found.axes:
            return [over(each, self._scales.get(each.name)) for each in found.axes]
        if plot.fitted:
            return plot.fitted(self)
        return [self.axes[key] for key in plot.axes]

    def still(self, plot):
        """Rows of a plot that stay while the scene is played."""
        if plot not in self._drawn:
            found = self.found.get(plot.title)
            self._drawn[plot] = plot.still(self) | (found.rows if found else {})
        return self._drawn[plot]

    def moving(self, plot, i):
        """Rows of a plot that change, in state i; where the page stands they are kept."""
        if (plot, i) in self._drawn:
            return self._drawn[plot, i]
        rows = plot.moving(self, i)
        if i in (self.way.now, self.way.peak):
            self._drawn[plot, i] = rows
        return rows

    def columns(self, plot, i):
        """All rows of a plot in state i, empty where there is none."""
        rows = {row.name: (*NOTHING, "") for row in plot.rows}
        if plot.image:
            rows["image"] = *[np.array([0.0, 1.0])] * 2, np.full(plot.image, np.nan)
        return rows | self.still(plot) | self.moving(plot, i)

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
    """Largest values (SI) that the axes are to hold, by the names of those."""
    states, onset = way.states, way.onset
    radius, depth = float(np.max(states.contact_radius)), float(np.max(states.depth))
    size = {"r": 1.25 * radius, "a": 1.14 * radius, "z": depth, "d": 1.02 * depth}
    size |= {"F": 1.05 * float(np.max(way.force)), "p": 1.05 * ceiling(way.deepest, 1.25 * radius)}
    # An onset that lies little deeper than the path is kept in the picture.
    if onset is not None and depth < onset.depth <= 2.5 * depth:
        size["d"] = 1.02 * max(depth, 1.02 * float(onset.depth))
        size["F"] = max(size["F"], 1.05 * float(onset.force))
    if way.motion is not None:
        size |= {"t": float(way.motion.time[-1]), "E": float(np.max(way.energy))}
    return size


def _least(way):
    """Depth and force (SI) where logarithmic axes begin: well before the onset of yield."""
    profile, medium = way.scene.profile, way.scene.medium
    depth = min(float(np.max(way.states.depth)), medium.critical_depth) / 50
    return {"d": depth, "F": float(mdr.indent(profile, mdr.Medium(medium.E_star), depth).force)}


def phase(way, i):
    """Where a state stands on its way, in words."""
    share, rise = way.progress[i], way.states.depth[i] - way.states.depth[max(i - 1, 0)]
    if i == way.peak:
        words = "deepest"
    elif i and (way.states.contact_radius[i] == 0 or (share >= 2 and not way.turns)):
        words = "load gone"
    else:
        words = "unloading" if rise < 0 else "holding" if i and rise == 0 else "loading"
    words += f", {way.pending}" if way.pending else ""
    if way.motion is None:
        return words
    unit = fitting(float(way.motion.time[-1]), "time")
    return f"{words}, t = {digits(float(way.motion.time[i]) / unit.factor, 3)} {unit.name}"
