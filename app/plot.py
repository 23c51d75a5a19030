"""Definition of a plot, and a view: a course with axes, from which rows are drawn, in SI."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import floor, isfinite, log10
from typing import Any

import numpy as np

from mdr_core.results.figures import NOTHING, Axis, Row
from mdr_core.results.units import fitting

from .courses import Course
from .extra import EXTRAS
from .state import State

_ROUND = np.array([1, 1.5, 2, 3, 4, 5, 6, 8, 10])


def round_up(value: float) -> float:
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 × 10ⁿ, so that axes rest while a slider moves."""
    if not value > 0 or not isfinite(value):
        return 1.0
    power = 10.0 ** floor(log10(value))
    return float(_ROUND[np.searchsorted(_ROUND, value / power * (1 - 1e-9))] * power)


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


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, its axes (x, y, and one on the right), and rows.

    `still` returns rows that stay during playback, `moving` those of one state: x and y (SI), and the text
    of a label. A plot with a `tab` is optional; `order` is its place among these. `applies` says whether a
    view has it. `controls` are choices above it. `picture` draws it, if that is not a `Picture`.
    """

    name: str
    title: str
    formula: str | Callable[[Course], str]
    axes: tuple[Along, ...]
    rows: tuple[Row, ...]
    still: Callable[["View"], dict] = lambda view: {}
    moving: Callable[["View", int], dict] = lambda view, i: {}
    applies: Callable[["View"], bool] = lambda view: True
    tab: str = ""
    order: int = 0
    controls: tuple[str, ...] = ()
    picture: Callable[..., Any] | None = None

    def formula_of(self, course: Course) -> str:
        return self.formula if isinstance(self.formula, str) else self.formula(course)

    def axes_of(self, view: "View") -> list[Axis]:
        return [view.axis(along) for along in self.axes]

    def still_of(self, view: "View") -> dict[str, Any]:
        """All rows, those that stay during playback with what they have."""
        return {row.name: (*NOTHING, "") for row in rows_of(self)} | self.still(view)

    def note_of(self, view: "View") -> str:
        """A note below the plot."""
        return ""


@dataclass(frozen=True, eq=False)
class Overlay:
    """What an extra draws into a plot of the page: rows behind those of the plot, `still` and `moving`.

    `moving` may also give other columns for rows of the plot. `reach` says of an axis how far the rows go,
    lowest and largest value (SI). `picture` draws the plot, if that is not its own.
    """

    on: str
    rows: tuple[Row, ...]
    still: Callable[["View"], dict] = lambda view: {}
    moving: Callable[["View", int], dict] = lambda view, i: {}
    reach: Callable[["View", Along], tuple[float, float]] = lambda view, along: (0.0, 0.0)
    picture: Callable[..., Any] | None = None


def all_overlays() -> list[Overlay]:
    """All overlays, from the back to the front."""
    return [overlay for extra in EXTRAS.values() for overlay in extra.overlays]


def overlays(plot: Plot) -> list[Overlay]:
    """Those of a plot."""
    return [each for each in all_overlays() if each.on == plot.name]


def rows_of(plot: Plot) -> tuple[Row, ...]:
    """Rows of a plot, behind them those of its overlays."""
    return (*(row for each in overlays(plot) for row in each.rows), *plot.rows)


def axis(name: str, title: str, kind: str, largest: float, below: float = 0.0) -> Axis:
    """Axis up to the next round number above `largest` (SI), in a fitting unit."""
    unit = fitting(round_up(largest), kind)
    end = round_up(largest / unit.factor) * unit.factor
    return Axis(name, title, unit.name, unit.factor, 0.0 - below * end, end)


class View:
    """A state with its course and axes, and what extras have computed, by name."""

    def __init__(self, state: State, course: Course, computed: dict[str, Any] | None = None):
        self.state, self.course, self.computed = state, course, computed or {}
        #: Axes by what is along them, at first those that are kept.
        self._axes: dict[Along, Axis] = dict(self.computed.get("axes", {}))
        self._drawn: dict[Any, dict[str, Any]] = {}

    def axis(self, along: Along) -> Axis:
        if along not in self._axes:
            reached = [each.reach(self, along) for each in all_overlays()]
            size = max([along.size(self.course), *(largest for _, largest in reached)])
            least = min([along.least(self.course), *(lowest for lowest, _ in reached)])
            made = axis(along.title, along.title, along.kind, size, along.below(self.course))
            if least < made.start:
                made = replace(made, start=-round_up(-least / made.factor) * made.factor)
            self._axes[along] = made
        return self._axes[along]

    def end(self, along: Along) -> float:
        return self.axis(along).end

    def still(self, plot: Plot) -> dict[str, Any]:
        """Rows that stay during playback."""
        if plot.name not in self._drawn:
            rows = plot.still_of(self)
            for each in overlays(plot):
                rows |= each.still(self)
            self._drawn[plot.name] = rows
        return self._drawn[plot.name]

    def moving(self, plot: Plot, i: int) -> dict[str, Any]:
        """Rows of one state; those of the present one and of the largest depth are kept."""
        if (plot.name, i) in self._drawn:
            return self._drawn[plot.name, i]
        rows = plot.moving(self, i)
        for each in overlays(plot):
            rows |= each.moving(self, i)
        if i in (self.course.now, self.course.peak):
            self._drawn[plot.name, i] = rows
        return rows

    def rows(self, plot: Plot, i: int) -> dict[str, Any]:
        """All rows of a plot in state i."""
        return self.still(plot) | self.moving(plot, i)
