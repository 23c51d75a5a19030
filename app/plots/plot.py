"""Definition of a plot, and a view: a course with axes, from which rows are drawn, in SI."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.results.figures import NOTHING, REST, Axis, Row, ceiling, line, radii
from mdr_core.results.quantities import QUANTITIES

from ..drives import Course
from ..state import State
from ..state.units import fitting, round_up, written

#: Scenes that are held have each its own dashes.
DASHES = ("dotdash", "dashed", "dotted", "solid")


def _titled(name: str) -> str:
    known = QUANTITIES[name]
    return f"{known.symbol}, {known.long_name}"


#: Every axis: its title, the kind of its unit, the size (see `_sizes`) that it holds, and how far it
#: reaches below zero, in shares of that.
AXES: dict[str, tuple[str, str, str, float]] = {
    "x": ("x, coordinate of the springs", "length", "r", 1.0),
    "r": ("r, radius", "length", "r", 1.0),
    "z": ("z, height", "length", "z", REST),
    "d": (_titled("depth"), "length", "d", 0.0),
    "F": (_titled("force"), "force", "F", 0.0),
    "a": ("a, c, radius", "length", "a", 0.0),
    "p": ("−σzz, pressure", "pressure", "p", 0.0),
    "far r": ("r, radius", "length", "far", 1.0),
    "far z": ("z, height", "length", "z", 1.2),
    "t": (_titled("time"), "time", "t", 0.0),
    "E": ("E, energy", "energy", "E", 0.0),
    "ΔF": ("ΔF, residual force", "force", "ΔF", 1.0),
    "force": ("F, Fₓ, force", "force", "force", 0.0),
    "log d": (_titled("depth"), "length", "d", 0.0),
    "log F": (_titled("force"), "force", "F", 0.0),
    "across": ("x, across the surface", "length", "r", 1.0),
    "oblique": ("−σzz, pressure", "pressure", "relief", 0.0),
}


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, keys of its axes (x, y, and one on the right or of colours), and rows.

    `still` returns rows that stay during playback, `moving` those of one state: x and y (SI), the text of a
    label or the values of an image. A plot with a `tab` (text, key) is optional. `find` is a slow search:
    it gets the course and the result of `asks` (default: the `controls`), and returns what is found, of
    a scene or a state (`of_state`); `quick` ones run at every move. `image`: rows and columns of pixels.
    """

    name: str
    title: str
    formula: str | Callable[[Course], str]
    axes: tuple[str, ...]
    rows: tuple[Row, ...]
    still: Callable[["View"], dict] = lambda view: {}
    moving: Callable[["View", int], dict] = lambda view, i: {}
    find: Callable[..., Any] | None = None
    asks: Callable[[Any], Any] | None = None
    quick: Callable[[Any], bool] = lambda asked: False
    of_state: bool = False
    tab: tuple[str, str] | None = None
    controls: tuple[str, ...] = ()
    image: tuple[int, int] | None = None

    def __post_init__(self):
        if unknown := set(self.axes) - AXES.keys():
            raise ValueError(f"plot {self.name}: no axis {', '.join(unknown)}")

    def asked(self, state: Any) -> Any:
        """Arguments of `find` beside the course."""
        return self.asks(state) if self.asks else tuple(state[name] for name in self.controls)

    def formula_of(self, course: Course) -> str:
        return self.formula if isinstance(self.formula, str) else self.formula(course)

    def applies(self, view: "View") -> bool:
        """Whether a view has all axes."""
        return all(AXES[name][2] in view.size for name in self.axes)


def held_rows(
    symbol: str, axis: int = 1, what: str = "", width: float = 1.6, legend: bool = True
) -> list[Row]:
    rows = enumerate(DASHES, 1)
    return [line(f"held {k}{what}", "held", width, dash, symbol, axis, legend) for k, dash in rows]


def axis(name: str, title: str, kind: str, largest: float, below: float = 0.0) -> Axis:
    """Axis up to the next round number above `largest` (SI), in a fitting unit."""
    unit = fitting(largest, kind)
    if round_up(largest / unit.factor) >= 1000:
        unit = fitting(round_up(largest / unit.factor) * unit.factor, kind)
    end = round_up(largest / unit.factor) * unit.factor
    return Axis(name, title, unit.name, unit.factor, 0.0 - below * end, end)


class View:
    """A state with its course and axes, courses of held scenes, results of searches, and the curve."""

    def __init__(self, state: State, course: Course, held=(), found=None):
        self.state, self.course, self.held, self.found = state, course, held, found or {}
        self.curve = None if state.curve is None else state.curve.placed(state)
        self._axes: dict[str, Axis] = {}
        self._drawn: dict[Any, Any] = {}

    @cached_property
    def size(self) -> dict[str, float]:
        """Largest values (SI) on the axes, including held scenes."""
        size = _sizes(self.course)
        for held in map(_sizes, self.held):
            # Heights are those of this scene: nothing that is held is drawn over them.
            size |= {name: max(size[name], held[name]) for name in size.keys() & held.keys() - {"z"}}
        if self.curve is not None:
            size["d"] = max(size["d"], 1.02 * float(self.curve.depth.max()))
            size["F"] = max(size["F"], 1.05 * float(self.curve.force.max()))
            size["ΔF"] = float(np.nan_to_num(np.abs(self.residual)).max())
        return size

    def axis(self, name: str) -> Axis:
        if name not in self._axes:
            title, kind, size, below = AXES[name]
            key = name.removeprefix("log ")
            made = axis(key, title, kind, self.size[size], below)
            if name == "force":
                made = replace(made, start=-min(self.course.scene.drive.friction, 1.0) * made.end)
            elif name == "p" and any(each.adhesive for each in (self.course, *self.held)):
                made = replace(made, start=-made.end)
            elif name in ("d", "F"):
                # Adhesion reaches below zero, and a measurement before first contact.
                parts = [each.on_axes[name] for each in (self.course, *self.held) if each.adhesive]
                if self.curve is not None:
                    parts.append({"d": self.curve.depth, "F": self.curve.force}[name])
                least = min((np.min(values) for values in parts), default=0.0)
                if least < 0:
                    made = replace(made, start=-round_up(-least / made.factor) * made.factor)
            elif name != key:
                profile, medium = self.course.scene.profile, self.course.scene.medium
                depth = min(float(np.max(self.course.states.depth)), medium.critical_depth) / 50
                elastic = mdr.indent(profile, mdr.Medium(medium.E_star), depth)
                least = max(float({"d": depth, "F": elastic.force}[key]), 1e-8 * made.end)
                power = np.floor(np.log10(least / made.factor))
                made = replace(made, start=float(10.0**power) * made.factor, log=True)
            self._axes[name] = made
        return self._axes[name]

    def end(self, name: str) -> float:
        return self.axis(name).end

    def axes_of(self, plot: Plot) -> list[Axis]:
        """Axes of a plot: those of the view, or those found with its rows."""
        found = self.found.get(plot.name)
        if found and found.axes:
            return found.axes
        return [self.axis(key) for key in plot.axes]

    def held_curves(self, what: str, columns: Callable[[Course], Any]) -> dict:
        """Rows of all held scenes."""
        return {f"held {k}{what}": columns(held) for k, held in enumerate(self.held, 1)}

    def held_on_axes(self, x: str, y: str) -> dict:
        """Curves of all held scenes on two axes."""

        def columns(course):
            on = course.on_axes
            return (on[x], on[y]) if on.keys() >= {x, y} else NOTHING

        return self.held_curves("", columns)

    def mark(self, i: int, x: str, y: str) -> tuple[Any, Any]:
        return self.course.on_axes[x][[i]], self.course.on_axes[y][[i]]

    def time(self, i: int, y: str) -> tuple[Any, Any]:
        """Vertical line at the time of state i."""
        return self.course.on_axes["t"][[i, i]], np.array([self.axis(y).start, self.axis(y).end])

    @cached_property
    def residual(self) -> np.ndarray:
        return self.curve.residual(self.course.scene)

    def rows(self, plot: Plot, i: int) -> dict:
        """All rows of a plot in state i; those that stay during playback are cached."""
        if plot.name not in self._drawn:
            empty = {row.name: (*NOTHING, "") for row in plot.rows}
            if plot.image:
                empty["image"] = *[np.array([0.0, 1.0])] * 2, np.full(plot.image, np.nan)
            found = self.found.get(plot.name)
            self._drawn[plot.name] = empty | plot.still(self) | (found.rows if found else {})
        return self._drawn[plot.name] | plot.moving(self, i)

    def pressure(self, i: int) -> tuple[Any, Any]:
        """Radii (m) and pressures (Pa) of state i."""
        if i not in self._drawn:
            state = self.course.states[i]
            r = radii(state, self.end("x"))
            self._drawn[i] = r, state.pressure(r)
        return self._drawn[i]

    def exceeds(self, i: int) -> str:
        """Note on a pressure beyond its axis."""
        r, p = self.pressure(i)
        infinite, k = np.isinf(p), int(np.argmax(np.where(np.isinf(p), -1.0, p)))
        if infinite.any():
            # A sharp tip that has not yielded is infinite on the axis, a flat face at its rim.
            at = np.argmax(infinite)
            sign = "↑ −σzz → ∞" if p[at] > 0 else "↓ −σzz → −∞"
            return f"{sign} at the " + ("axis" if r[at] == 0 else "rim")
        if p[k] <= self.end("p"):
            return ""
        where = "on the axis" if r[k] == 0 else f"at r = {written(r[k], 'length', 3)}"
        return f"↑ −σzz = {written(p[k], 'pressure', 3)} {where}"


def _sizes(course: Course) -> dict[str, float]:
    """Largest values (SI) on the axes."""
    states, first_yield = course.states, course.onset
    radius, depth = float(np.max(states.contact_radius)), float(np.max(states.depth))
    # Twice the tension on the axis from adhesion alone.
    state = course.turning_point
    tension = -2 / np.pi * float(state.uniform_load / state.contact_radius) if course.adhesive else 0.0
    size = {"r": 1.25 * radius, "a": 1.14 * radius, "far": 2.1875 * radius, "z": depth, "d": 1.02 * depth}
    size["F"] = 1.05 * float(np.max(states.force))
    if course.adhesive:
        # There may be tension alone, and the indenter is lifted above the surface.
        size["F"] = max(size["F"], 0.25 * float(-np.min(states.force)))
        size["z"] = max(depth, float(-np.min(states.depth)))
    size["p"] = 1.05 * max(ceiling(state, 1.25 * radius), tension)
    size["relief"] = 1.35 * size["p"]
    # An onset slightly below the path stays visible.
    if first_yield is not None and depth < first_yield.depth <= 2.5 * depth:
        size["d"] = 1.02 * max(depth, 1.02 * float(first_yield.depth))
        size["F"] = max(size["F"], 1.05 * float(first_yield.force))
    if course.motion is not None:
        size |= {"t": float(course.motion.time[-1]), "E": float(np.max(sum(course.energies.values())))}
    if course.oblique is not None:
        size["force"] = max(size["F"], float(np.max(np.abs(course.on_axes["force"]))))
    return size
