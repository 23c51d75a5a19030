"""Definition of a plot, and a view: a course with axes, from which rows are drawn, in SI."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mdr_core.results.figures import NOTHING, Axis, Row, radii
from mdr_core.results.quantities import QUANTITIES

from .courses import Course
from .state import State
from .units import fitting, round_up, written


@dataclass(frozen=True)
class Along:
    """An axis of a plot: title, kind of its unit, and what it holds of a course.

    `size` is the largest value (SI), `below` how far it reaches below zero in shares of its end, `least`
    the lowest value that it reaches to in any case.
    """

    title: str
    kind: str
    size: Callable[[Course], float]
    below: Callable[[Course], float] = lambda course: 0.0
    least: Callable[[Course], float] = lambda course: 0.0


def titled(name: str) -> str:
    """Title of an axis of a quantity of the core."""
    known = QUANTITIES[name]
    return f"{known.symbol}, {known.long_name}"


@dataclass(frozen=True)
class Found:
    """What a search has found for a plot: rows (SI) with their axes, and a note as HTML."""

    rows: dict[str, Any]
    axes: list[Axis]
    note: str = ""


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, its axes (x, y, and one on the right or of colours), and rows.

    `still` returns rows that stay during playback, `moving` those of one state: x and y (SI), the text of a
    label or the values of an image. A plot with a `tab` is optional; `order` is its place among these.
    `applies` says whether a view has it. `find` is a slow search: it gets the course and the result of
    `asks` (default: the `controls`), and returns what is found, of a scene or a state (`of_state`); `quick`
    ones run at every move. `image`: rows and columns of pixels. `logs`: its axes can be logarithmic.
    """

    name: str
    title: str
    formula: str | Callable[[Course], str]
    axes: tuple[Along, ...]
    rows: tuple[Row, ...]
    still: Callable[["View"], dict] = lambda view: {}
    moving: Callable[["View", int], dict] = lambda view, i: {}
    applies: Callable[["View"], bool] = lambda view: True
    find: Callable[..., Found] | None = None
    asks: Callable[[State], Any] | None = None
    quick: Callable[[Any], bool] = lambda asked: False
    of_state: bool = False
    tab: str = ""
    order: int = 0
    controls: tuple[str, ...] = ()
    image: tuple[int, int] | None = None
    logs: bool = False

    def asked(self, state: State) -> Any:
        """Arguments of `find` beside the course."""
        return self.asks(state) if self.asks else tuple(state[name] for name in self.controls)

    def formula_of(self, course: Course) -> str:
        return self.formula if isinstance(self.formula, str) else self.formula(course)


@dataclass(frozen=True, eq=False)
class Overlay:
    """What an extra draws into a plot of the page: rows behind those of the plot, `still` and `moving`.

    `moving` may also give other columns for rows of the plot. `reach` says of an axis how far the rows go,
    lowest and largest value (SI).
    """

    on: str
    rows: tuple[Row, ...]
    still: Callable[["View"], dict] = lambda view: {}
    moving: Callable[["View", int], dict] = lambda view, i: {}
    reach: Callable[["View", Along], tuple[float, float]] = lambda view, along: (0.0, 0.0)


#: All overlays, from the back to the front.
OVERLAYS: list[Overlay] = []


def overlays(plot: Plot) -> list[Overlay]:
    return [each for each in OVERLAYS if each.on == plot.name]


def rows_of(plot: Plot) -> tuple[Row, ...]:
    """Rows of a plot, behind them those of its overlays."""
    return (*(row for each in overlays(plot) for row in each.rows), *plot.rows)


def axis(name: str, title: str, kind: str, largest: float, below: float = 0.0) -> Axis:
    """Axis up to the next round number above `largest` (SI), in a fitting unit."""
    unit = fitting(largest, kind)
    if round_up(largest / unit.factor) >= 1000:
        unit = fitting(round_up(largest / unit.factor) * unit.factor, kind)
    end = round_up(largest / unit.factor) * unit.factor
    return Axis(name, title, unit.name, unit.factor, 0.0 - below * end, end)


class View:
    """A state with its course and axes, results of searches, and what extras have computed, by name."""

    def __init__(self, state: State, course: Course, found=None, computed=None):
        self.state, self.course, self.found = state, course, found or {}
        self.computed: dict[str, Any] = computed or {}
        self._axes: dict[Along, Axis] = {}
        self._drawn: dict[str, dict] = {}
        self._pressures: dict[int, tuple[Any, Any]] = {}

    def axis(self, along: Along) -> Axis:
        if along not in self._axes:
            reached = [each.reach(self, along) for each in OVERLAYS]
            size = max([along.size(self.course), *(largest for _, largest in reached)])
            least = min([along.least(self.course), *(lowest for lowest, _ in reached)])
            made = axis(along.title, along.title, along.kind, size, along.below(self.course))
            if least < made.start:
                made = replace(made, start=-round_up(-least / made.factor) * made.factor)
            self._axes[along] = made
        return self._axes[along]

    def end(self, along: Along) -> float:
        return self.axis(along).end

    def axes_of(self, plot: Plot) -> list[Axis]:
        """Axes of a plot: those that it brings, or those found with its rows."""
        found = self.found.get(plot.name)
        if found and found.axes:
            return found.axes
        axes = [self.axis(along) for along in plot.axes]
        if plot.logs and plot.name in self.state.log:
            columns = [row for name, row in self._still(plot).items() if len(row) == 2]
            return [_logarithmic(each, [row[k] for row in columns]) for k, each in enumerate(axes)]
        return axes

    def _still(self, plot: Plot) -> dict:
        """Rows that stay during playback."""
        if plot.name not in self._drawn:
            empty = {row.name: (*NOTHING, "") for row in rows_of(plot)}
            if plot.image:
                empty["image"] = *[np.array([0.0, 1.0])] * 2, np.full(plot.image, np.nan)
            found = self.found.get(plot.name)
            rows = empty | plot.still(self) | (found.rows if found else {})
            for each in overlays(plot):
                rows |= each.still(self)
            self._drawn[plot.name] = rows
        return self._drawn[plot.name]

    def moving(self, plot: Plot, i: int) -> dict:
        """Rows of one state."""
        rows = plot.moving(self, i)
        for each in overlays(plot):
            rows |= each.moving(self, i)
        return rows

    def rows(self, plot: Plot, i: int) -> dict:
        """All rows of a plot in state i; those that stay during playback are cached."""
        return self._still(plot) | self.moving(plot, i)

    def pressure(self, i: int, half: float) -> tuple[Any, Any]:
        """Radii (m) up to `half` and pressures (Pa) of state i."""
        if i not in self._pressures:
            state = self.course.states[i]
            r = radii(state, half)
            self._pressures[i] = r, state.pressure(r)
        return self._pressures[i]


def _logarithmic(axis: Axis, columns: list[Any]) -> Axis:
    """The axis, logarithmic from a power of ten below its least positive value, six decades at most."""
    positive = [float(part[part > 0].min()) for part in map(np.asarray, columns) if (part > 0).any()]
    least = max(min(positive, default=axis.end), 1e-6 * axis.end)
    power = np.floor(np.log10(least / axis.factor))
    return replace(axis, start=float(10.0**power) * axis.factor, log=True)


def exceeds(r: Any, p: Any, top: float) -> str:
    """Note on a pressure (Pa) at radii r (m) beyond its axis."""
    infinite, k = np.isinf(p), int(np.argmax(np.where(np.isinf(p), -1.0, p)))
    if infinite.any():
        # A sharp tip that has not yielded is infinite on the axis, a flat face at its rim.
        at = np.argmax(infinite)
        sign = "↑ −σzz → ∞" if p[at] > 0 else "↓ −σzz → −∞"
        return f"{sign} at the " + ("axis" if r[at] == 0 else "rim")
    if p[k] <= top:
        return ""
    where = "on the axis" if r[k] == 0 else f"at r = {written(r[k], 'length', 3)}"
    return f"↑ −σzz = {written(p[k], 'pressure', 3)} {where}"
