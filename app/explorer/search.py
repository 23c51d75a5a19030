"""Slow searches of a session while the input rests: rows of plots, and exact courses."""

import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mdr_core.show.figures import Axis

from ..common.host import Steps, last
from .courses import Course, nearest
from .drives import DRIVES, EXACT
from .extra import Service
from .plot import Plot, View
from .plots import PLOTS, visible
from .state import State

_LOG = logging.getLogger(__name__)
#: Number of exact courses that the server keeps for all sessions.
_KEPT = 64


@dataclass(frozen=True)
class SearchResult:
    """Result of a search for a plot: rows (SI) with their axes, and a note (text or HTML)."""

    rows: dict[str, Any]
    axes: list[Axis]
    note: str = ""


#: Results before a search ends, and after a failed search.
COMPUTING = SearchResult({}, [], "computing …")
FAULT = SearchResult({}, [], "A fault of the explorer prevents this result.")


@dataclass(frozen=True, eq=False)
class AsyncPlot(Plot):
    """Plot whose rows and axes come from a search.

    `find` gets the course and the result of `asks` (default: the `controls`). It returns the result for a
    scene or a state (`of_state`), or steps that end with the result. A `quick` search runs at every move.
    `image` has the numbers of rows and columns of pixels.
    """

    find: Callable[..., SearchResult | Iterator[SearchResult | None]] = lambda course, asked: COMPUTING
    asks: Callable[[State], Any] | None = None
    quick: Callable[[Any], bool] = lambda asked: False
    of_state: bool = False
    image: tuple[int, int] | None = None

    def asked(self, state: State) -> Any:
        """Return the arguments of `find` after the course."""
        return self.asks(state) if self.asks else tuple(state[name] for name in self.controls)

    def key(self, course: Course, asked: Any) -> Any:
        """Return the key that identifies a search."""
        return course.scene, asked, course.progress[course.now] if self.of_state else None

    def found(self, view: View) -> SearchResult:
        return view.computed.get(self.name) or COMPUTING

    def axes_of(self, view: View) -> list[Axis]:
        return self.found(view).axes

    def places_of(self, view: View, i: int) -> dict[str, Any]:
        found = super().places_of(view, i) | self.found(view).rows
        if self.image and "image" not in found:
            found["image"] = *[np.array([0.0, 1.0])] * 2, np.full(self.image, np.nan)
        return found

    def note_of(self, view: View) -> str:
        return self.found(view).note


def as_steps(found: Any) -> Steps:
    """Return the steps of a search, or one step for a result."""
    return found if isinstance(found, Iterator) else iter([found])


class Searching(Service):
    """Searches of a session: the last search of each name."""

    def __init__(self, page: Any):
        super().__init__(page)
        self._keys, self._results = {}, {}

    def find_exact(self, courses: list[Course]) -> None:
        """Start the searches for the exact courses of pending courses."""
        for k, course in enumerate(courses):
            if course.pending:
                self._search(f"course {k}", course.scene, _exact, course)

    def _search(self, name, key, search, *arguments):
        """Search unless the last search of this name has the same key."""
        if self._keys.get(name) == key:
            return
        self._keys[name] = key

        def steps():
            try:
                yield from as_steps(search(*arguments))
            except Exception:
                _LOG.exception("%s could not be found, scene %s", name, arguments[0].scene.to_json())
                yield FAULT

        def wanted():
            return self._keys.get(name) == key

        self.page.host.search(steps(), wanted, partial(self._done, name, key))

    def _done(self, name, key, result):
        """Draw a result of the last search; if this fails, continue without it."""
        if self._keys.get(name) != key:
            return
        page = self.page
        self._results[name] = key, result
        try:
            if isinstance(result, str):
                page.notify(result)
                return
            if isinstance(result, Course):
                _keep(result)
                # Search again after other courses have replaced it.
                del self._keys[name]
            page.draw(page.state)
        except Exception as error:
            if isinstance(result, Course):
                EXACT.pop(result.scene, None)
            # Do not search again: it would fail again.
            self._keys[name] = key
            self._results[name] = key, FAULT
            page.notify(page.refusal(error))
            page.draw(page.state)


class IdleSearch(Searching):
    """Searches for the plots of a view and for its exact course."""

    def compute(self, state: State, course: Course) -> dict[str, SearchResult]:
        """Return results for the plots of a state; compute quick results."""
        results = {}
        for plot in (PLOTS[name] for name in state.tiles if isinstance(PLOTS[name], AsyncPlot)):
            asked = plot.asked(state)
            key, result = self._results.get(plot.name, (None, COMPUTING))
            if plot.quick(asked):
                result = last(as_steps(plot.find(course, asked)))
            elif key != plot.key(course, asked):
                result = replace(COMPUTING, axes=result.axes)
            results[plot.name] = result
        return results

    def rest(self, view: View) -> None:
        """Start the slow searches of a view: for its exact course and its plots."""
        self.find_exact([view.course])
        for plot in (plot for plot in visible(view) if isinstance(plot, AsyncPlot)):
            asked = plot.asked(view.state)
            if not plot.quick(asked):
                self._search(plot.name, plot.key(view.course, asked), plot.find, view.course, asked)


def _keep(course: Course) -> None:
    """Keep an exact course, and drop the oldest course."""
    EXACT[course.scene] = course
    for scene in list(EXACT)[:-_KEPT]:
        del EXACT[scene]


def exact(course: Course) -> Course:
    """Return the exact course of a pending course, in the same state."""
    made = DRIVES[course.drive].exact(course.scene)
    return replace(made, now=nearest(made.progress, course.progress[course.now]), drive=course.drive)


def _exact(course):
    """Return the exact course, or the reason for the failure."""
    try:
        return exact(course)
    except ValueError as error:
        return str(error)
