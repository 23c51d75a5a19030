"""Definition of a plot, and a view: a course with axes, from which rows are drawn, in SI."""

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

#: Symbol of a row that shows whatever is along its axis, which says its symbol first.
OF_AXIS = "of its axis"
_ROUND = np.array([1, 1.5, 2, 3, 4, 5, 6, 8, 10])


def round_up(value: float) -> float:
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 × 10ⁿ, so that axes rest while a slider moves."""
    if not value > 0 or not isfinite(value):
        return 1.0
    power = 10.0 ** floor(log10(value))
    return float(_ROUND[np.searchsorted(_ROUND, value / power * (1 - 1e-9))] * power)


@dataclass(frozen=True)
class AxisSpec:
    """An axis of a plot: title, kind of its unit, and the lowest and largest value (SI) of a course."""

    title: str
    kind: str
    span: Callable[[Course], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Plot:
    """A plot: title, formula, its axes (x, y, and one on the right), and rows.

    The formula stands with the numbers and assumptions; `aside` is what one must know beside the title.

    `places` tells where rows are in a state: x and y (SI), and the text of a label. A plot with a `tab` is
    optional; `order` is its place among these. `applies` says whether a view has it. `controls` are names
    of choices and numbers above it. `picture` draws it, if that is not a `Picture`, as
    `Logarithmic` where `axes_of` returns axes with `log`.
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
        """A note above the plot (a text, or HTML as `ui.marked` makes it of indices as in d_c)."""
        return ""

    def options_of(self, state: State, control: str) -> list[str]:
        """Options of one of its `controls` that apply to a state, the default first."""
        return list(CHOICES[control].options)


@dataclass(frozen=True, eq=False)
class Overlay:
    """What an extra draws into a plot of the page: rows behind those of the plot, and their places.

    `places` may also give other ones for rows of the plot. `reach` says of an axis how far the rows go,
    lowest and largest value (SI). `picture` draws the plot, if that is not its own.
    """

    on: str
    rows: tuple[Row, ...]
    places: Callable[["View", int], dict] = lambda view, i: {}
    reach: Callable[["View", AxisSpec], tuple[float, float]] = lambda view, along: (0.0, 0.0)
    picture: Callable[..., Any] | None = None


#: Overlays of all plots, from the back to the front; extras add theirs.
OVERLAYS: dict[tuple[str, str, int], Overlay] = {}


def overlays(plot: Plot) -> list[Overlay]:
    """Those of a plot."""
    return [each for each in OVERLAYS.values() if each.on == plot.name]


def rows_of(plot: Plot) -> tuple[Row, ...]:
    """Rows of a plot, behind them those of its overlays."""
    return (*(row for each in overlays(plot) for row in each.rows), *plot.rows)


def axis(title: str, kind: str, largest: float, lowest: float = 0.0) -> Axis:
    """Axis from zero, or a round number below it, to one above `largest` (SI), in a fitting unit."""
    end = round_up(largest)
    unit = fitting(end, kind)
    return Axis(title, title, unit.name, unit.factor, -round_up(-lowest) if lowest < 0 else 0.0, end)


class View:
    """A state with its course and axes, and what extras have computed, by name.

    `kept` are axes of a view before, by what is along them, on which this one is drawn, too.
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
        """Where all rows of a plot are in state i; kept for the present one and that of most depth."""
        if (plot.name, i) in self._places:
            return self._places[plot.name, i]
        found = {row.name: (*NOTHING, "") for row in rows_of(plot)} | plot.places_of(self, i)
        for each in overlays(plot):
            found |= each.places(self, i)
        if any(row.names for row in rows_of(plot)):
            found |= arranged(rows_of(plot), found, plot.axes_of(self))
        unknown = found.keys() - {row.name for row in rows_of(plot)}
        # A picture of its own may draw more than rows.
        if unknown and not plot.picture:
            raise KeyError(f"plot {plot.name!r} has places of rows that it has not: {sorted(unknown)}")
        if i in (self.course.now, self.course.peak):
            self._places[plot.name, i] = found
        return found


def cached(places: Callable[[View], dict]) -> Callable[[View, int], dict]:
    """Places in every state, kept with the view, of rows that stay while a scene is played."""

    def kept(view: View, i: int) -> dict:
        if places not in view.computed:
            view.computed[places] = places(view)
        return view.computed[places]

    return kept


#: The axis of time of the plots over time.
T = AxisSpec(QUANTITIES["time"].title, "time", lambda course: (0.0, float(course.motion.time[-1])))


def line_at_time(view: View, i: int, up: AxisSpec) -> tuple:
    """Vertical line at the time of state i, over the whole axis `up`."""
    return view.course.motion.time[[i, i]], np.array([view.axis(up).start, view.end(up)])


# Labels on curves and areas: their boxes, and which of them have a place in a plot. They are placed in the
# smallest plot, that of a phone. Their letters have one size in every plot, so that boxes which do not
# cover each other there do so in no larger plot either.

#: Pixels within the axes of the smallest plot, of a line of 12 px letters, and kept free beside a label.
WIDTH, HEIGHT, LINE, GAP = 290, 130, 14, 2
#: Widths of letters of Helvetica and Arial over their size.
_WIDTHS = {"fijlrt .,;:()'|": 0.28, "cksvxyz": 0.5, "mwMWCGOQ→−=∞%": 0.8}


def width(text: str) -> float:
    """Width (px) of a text of 12 px letters, some percent too large.

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
        """Whether all of it is within the axes."""
        return self.left >= 0 and self.right <= WIDTH and self.bottom >= 0 and self.top <= HEIGHT

    def covers(self, other: "Box") -> bool:
        """Whether it and another one cover each other."""
        across = self.left < other.right + GAP and other.left < self.right + GAP
        return across and self.bottom < other.top and other.bottom < self.top


_ACROSS = {"left": 0.0, "center": 0.5, "right": 1.0}
_UP = {"bottom": 0.0, "middle": 0.5, "top": 1.0}


def box(row: Row, x: float, y: float, text: str, axes: list[Axis]) -> Box:
    """Box of a label at a point (SI), with the size of a letter of its axes' smallest plot."""
    right, up = (_share(value, axis) for value, axis in zip((x, y), axes, strict=False))
    wide = width(text)
    left = right * WIDTH - _ACROSS[row.look["text_align"]] * wide
    bottom = up * HEIGHT - _UP[row.look["text_baseline"]] * LINE
    return Box(left, left + wide, bottom, bottom + LINE)


def _share(value: float, axis: Axis) -> float:
    """Place (0 to 1) of a value (SI) along an axis."""
    if axis.log:
        return log10(value / axis.start) / log10(axis.end / axis.start)
    return (value - axis.start) / (axis.end - axis.start)


def words_along(rows: dict[str, Any], axes: list[Axis], words: dict[str, str]) -> dict[str, tuple]:
    """Places of words on curves, by the names of their labels' rows: points of each within its axes."""
    found, y_axis = {}, axes[1]
    for name, text in words.items():
        x, y = rows.get(name, NOTHING)
        seen = np.flatnonzero((y >= y_axis.start) & (y <= y_axis.end))
        places = seen[(np.array([0.88, 0.7, 0.5, 0.3, 0.12]) * len(seen)).astype(int)] if len(seen) else []
        found[f"label {name}"] = x[places], y[places], text
    return found


def arranged(rows: list[Row], places: dict[str, Any], axes: list[Axis]) -> dict[str, tuple]:
    """Places of labels that name rows: the first of their points at which there is room, or none.

    Every other label has its place; `places` has points (SI) and a text for each row. A label of rows that
    are not seen is empty; one without room keeps its text, because its rows need no legend.
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
