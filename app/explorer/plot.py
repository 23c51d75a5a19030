"""Definition of a plot and of a view: a course with axes, which gives the places of rows in SI."""

from collections.abc import Callable
from dataclasses import dataclass
from math import floor, isfinite, log10
from typing import Any

import numpy as np

from mdr_core.show.figures import NOTHING, Axis, Row
from mdr_core.show.quantities import QUANTITIES
from mdr_core.show.units import fitting

from ..common.quantities import CHOICES
from .courses import Course
from .state import State

#: Symbol of a row for the quantity of its axis, whose title begins with the symbol.
OF_AXIS = "of its axis"
_ROUND = np.array([1, 1.5, 2, 3, 4, 5, 6, 8, 10])


def round_up(value: float) -> float:
    """Round up to 1, 1.5, 2, 3, 4, 5, 6, 8 × 10ⁿ, so that axes change rarely while a slider moves."""
    if not value > 0 or not isfinite(value):
        return 1.0
    power = 10.0 ** floor(log10(value))
    return float(_ROUND[np.searchsorted(_ROUND, value / power * (1 - 1e-9))] * power)


@dataclass(frozen=True)
class AxisSpec:
    """Axis of a plot: title, kind of its unit, and the lowest and largest value (SI) of a course."""

    title: str
    kind: str
    span: Callable[[Course], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Plot:
    """Plot: title, formula, axes (x, y, and an optional axis on the right), and rows.

    The formula is shown with the numbers and assumptions, `aside` next to the title.

    `places` returns the places of rows in a state: x and y (SI), and the text of a label. A plot with a
    `tab` is optional; `order` is its position among these. `applies` is whether a view has the plot.
    `controls` are names of choices and numbers above it. `picture` draws the plot, by default `Picture`;
    `axes_of` with `log` axes needs `Logarithmic`.
    """

    name: str
    title: str
    formula: str | Callable[[Course], str]
    axes: tuple[AxisSpec, ...]
    rows: tuple[Row, ...]
    places: Callable[["View", int], dict] = lambda view, i: {}
    applies: Callable[["View"], bool] = lambda view: True
    tab: str = ""
    order: int = 0
    controls: tuple[str, ...] = ()
    picture: Callable[..., Any] | None = None
    aside: Callable[["View"], str] = lambda view: ""

    def formula_of(self, course: Course) -> str:
        return self.formula if isinstance(self.formula, str) else self.formula(course)

    def axes_of(self, view: "View") -> list[Axis]:
        return [view.axis(along) for along in self.axes]

    def places_of(self, view: "View", i: int) -> dict[str, Any]:
        return self.places(view, i)

    def note_of(self, view: "View") -> str:
        """Return a note above the plot: text, or HTML such as from `ui.html_subscripts` for d_c."""
        return ""

    def options_of(self, state: State, control: str) -> list[str]:
        """Return the options of one of its `controls` that apply to a state, the default first."""
        return list(CHOICES[control].options)


@dataclass(frozen=True, eq=False)
class Overlay:
    """Rows that an extra draws behind the rows of a plot, and their places.

    `places` may also replace places of the plot's rows. `reach` returns the lowest and largest value (SI)
    of the rows along an axis. `picture` draws the plot instead of the plot's `picture`.
    """

    on: str
    rows: tuple[Row, ...]
    places: Callable[["View", int], dict] = lambda view, i: {}
    reach: Callable[["View", AxisSpec], tuple[float, float]] = lambda view, along: (0.0, 0.0)
    picture: Callable[..., Any] | None = None


#: Overlays of all plots, from the back to the front; extras add to them.
OVERLAYS: dict[tuple[str, str, int], Overlay] = {}


def overlays(plot: Plot) -> list[Overlay]:
    """Return the overlays of a plot."""
    return [each for each in OVERLAYS.values() if each.on == plot.name]


def rows_of(plot: Plot) -> tuple[Row, ...]:
    """Return the rows of the overlays of a plot, then the rows of the plot."""
    return (*(row for each in overlays(plot) for row in each.rows), *plot.rows)


def axis(title: str, kind: str, largest: float, lowest: float = 0.0) -> Axis:
    """Return an axis from zero (or a round number below) to a round number above `largest` (SI)."""
    end = round_up(largest)
    unit = fitting(end, kind)
    return Axis(title, title, unit.name, unit.factor, -round_up(-lowest) if lowest < 0 else 0.0, end)


class View:
    """State with its course and axes, and computed data of extras by name.

    `kept` are the axes of an earlier view that this view also uses, by their specifications.
    """

    def __init__(
        self,
        state: State,
        course: Course,
        computed: dict[Any, Any] | None = None,
        kept: dict[AxisSpec, Axis] | None = None,
    ):
        self.state, self.course, self.computed, self.kept = state, course, computed or {}, kept or {}
        self._axes = dict(self.kept)
        self._places: dict[Any, dict[str, Any]] = {}

    def axis(self, along: AxisSpec) -> Axis:
        if along not in self._axes:
            spans = [along.span(self.course), *(each.reach(self, along) for each in OVERLAYS.values())]
            lowest, largest = zip(*spans, strict=True)
            self._axes[along] = axis(along.title, along.kind, max(largest), min(lowest))
        return self._axes[along]

    def end(self, along: AxisSpec) -> float:
        return self.axis(along).end

    def places(self, plot: Plot, i: int) -> dict[str, Any]:
        """Return the places of all rows of a plot in state i, cached for the present and deepest state."""
        if (plot.name, i) in self._places:
            return self._places[plot.name, i]
        found = {row.name: (*NOTHING, "") for row in rows_of(plot)} | plot.places_of(self, i)
        for each in overlays(plot):
            found |= each.places(self, i)
        if any(row.names for row in rows_of(plot)):
            found |= arranged(rows_of(plot), found, plot.axes_of(self))
        unknown = found.keys() - {row.name for row in rows_of(plot)}
        # A special picture may draw more than rows.
        if unknown and not plot.picture:
            raise KeyError(f"plot {plot.name!r} has places of unknown rows: {sorted(unknown)}")
        if i in (self.course.now, self.course.peak):
            self._places[plot.name, i] = found
        return found


def cached(places: Callable[[View], dict]) -> Callable[[View, int], dict]:
    """Cache in the view the places of rows that are equal in all states."""

    def kept(view: View, i: int) -> dict:
        if places not in view.computed:
            view.computed[places] = places(view)
        return view.computed[places]

    return kept


#: The axis of time of the plots over time.
T = AxisSpec(QUANTITIES["time"].title, "time", lambda course: (0.0, float(course.motion.time[-1])))


def line_at_time(view: View, i: int, up: AxisSpec) -> tuple:
    """Return a vertical line at the time of state i, over the whole axis `up`."""
    return view.course.motion.time[[i, i]], np.array([view.axis(up).start, view.end(up)])


# Labels on curves and areas: their boxes, and their places in a plot. The places are for the smallest plot,
# on a phone. Letters have the same size in every plot, so boxes that do not overlap there do not overlap
# in a larger plot either.

#: Pixels inside the axes of the smallest plot, of a line of 12 px letters, and of the gap next to a label.
WIDTH, HEIGHT, LINE, GAP = 290, 130, 14, 2
#: Widths of letters of Helvetica and Arial over their size.
_WIDTHS = {"fijlrt .,;:()'|": 0.28, "cksvxyz": 0.5, "mwMWCGOQ→−=∞%": 0.8}


def width(text: str) -> float:
    """Return the width (px) of a text of 12 px letters, overestimated by a few percent.

    Examples
    --------
    >>> round(width("plastic zone"))
    65
    """
    sizes = (next((size for some, size in _WIDTHS.items() if each in some), 0.56) for each in text)
    return 12 * sum(sizes)


@dataclass(frozen=True)
class Box:
    """Edges of a label in pixels from the lower left corner of the smallest plot."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def inside(self) -> bool:
        """Whether the box is inside the axes."""
        return self.left >= 0 and self.right <= WIDTH and self.bottom >= 0 and self.top <= HEIGHT

    def covers(self, other: "Box") -> bool:
        """Whether two boxes overlap."""
        across = self.left < other.right + GAP and other.left < self.right + GAP
        return across and self.bottom < other.top and other.bottom < self.top


_ACROSS = {"left": 0.0, "center": 0.5, "right": 1.0}
_UP = {"bottom": 0.0, "middle": 0.5, "top": 1.0}


def box(row: Row, x: float, y: float, text: str, axes: list[Axis]) -> Box:
    """Return the box of a label at a point (SI), in the smallest plot with these axes."""
    right, up = (_share(value, axis) for value, axis in zip((x, y), axes, strict=False))
    wide = width(text)
    left = right * WIDTH - _ACROSS[row.look["text_align"]] * wide
    bottom = up * HEIGHT - _UP[row.look["text_baseline"]] * LINE
    return Box(left, left + wide, bottom, bottom + LINE)


def _share(value: float, axis: Axis) -> float:
    """Return the place (0 to 1) of a value (SI) along an axis."""
    if axis.log:
        return log10(value / axis.start) / log10(axis.end / axis.start)
    return (value - axis.start) / (axis.end - axis.start)


def words_along(rows: dict[str, Any], axes: list[Axis], words: dict[str, str]) -> dict[str, tuple]:
    """Return possible points of words on curves, inside the axes, by the names of the labels' rows."""
    found, y_axis = {}, axes[1]
    for name, text in words.items():
        x, y = rows.get(name, NOTHING)
        seen = np.flatnonzero((y >= y_axis.start) & (y <= y_axis.end))
        places = seen[(np.array([0.88, 0.7, 0.5, 0.3, 0.12]) * len(seen)).astype(int)] if len(seen) else []
        found[f"label {name}"] = x[places], y[places], text
    return found


def arranged(rows: list[Row], places: dict[str, Any], axes: list[Axis]) -> dict[str, tuple]:
    """Return the places of labels that name rows: their first point with enough room, or none.

    Other labels have fixed places. `places` has points (SI) and a text for each row. A label of invisible
    rows is empty. A label without room keeps its text, because its rows need no legend.
    """
    labels = [row for row in rows if row.kind == "labels"]
    taken, found = [], {}
    for row in (row for row in labels if not row.names):
        x, y, text = places[row.name]
        if text and np.isfinite(x) and np.isfinite(y):
            taken.append(box(row, x, y, text, axes))
    for row in (row for row in labels if row.names):
        xs, ys, text = places[row.name]
        found[row.name] = (
            *NOTHING,
            text if any(_seen(places.get(name, NOTHING)) for name in row.names) else "",
        )
        points = zip(np.atleast_1d(xs), np.atleast_1d(ys), strict=True) if found[row.name][2] else ()
        for x, y in points:
            place = box(row, x, y, text, axes)
            if place.inside and not any(map(place.covers, taken)):
                taken.append(place)
                found[row.name] = float(x), float(y), text
                break
    return found


def _seen(place: tuple) -> bool:
    return bool(np.isfinite(place[1]).any())
