"""Slow searches of a session, made while the input rests: rows of plots, and exact courses."""

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
#: How many exact courses are kept, the last ones that were found in any session.
_KEPT = 64


@dataclass(frozen=True)
class Found:
    """What a search has found for a plot: rows (SI) with their axes, and a note, a text or HTML."""

    rows: dict[str, Any]
    axes: list[Axis]
    note: str = ""


#: Results before a search ends, and after one failed.
COMPUTING = Found({}, [], "computing …")
FAULT = Found({}, [], "This could not be found, because of a fault of the explorer.")


@dataclass(frozen=True, eq=False)
class AsyncPlot(Plot):
    """A plot whose rows and axes are found by a search.

    `find` gets the course and the result of `asks` (default: the `controls`), and returns what is found of
    a scene or a state (`of_state`), or steps of which the last gives it; `quick` ones run at every move.
    `image`: rows and columns of pixels.
    """

    find: Callable[..., Found | Iterator[Found | None]] = lambda course, asked: COMPUTING
    asks: Callable[[State], Any] | None = None
    quick: Callable[[Any], bool] = lambda asked: False
    of_state: bool = False
    image: tuple[int, int] | None = None

    def asked(self, state: State) -> Any:
        """Arguments of `find` beside the course."""
        return self.asks(state) if self.asks else tuple(state[name] for name in self.controls)

    def key(self, course: Course, asked: Any) -> Any:
        """What a search is known by."""
        return course.scene, asked, course.progress[course.now] if self.of_state else None

    def found(self, view: View) -> Found:
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
    """What a search returns as steps, one if it is a result."""
    return found if isinstance(found, Iterator) else iter([found])


class Searching(Service):
    """Searches of a session: the last one of each name."""

    def __init__(self, page: Any):
        super().__init__(page)
        self._keys, self._results = {}, {}

    def find_exact(self, courses: list[Course]) -> None:
        """Begin to find the exact courses of those that are pending."""
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
        """Draw a result if it is that of the last search; on failure go on without it."""
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
                # Searched anew once others have taken its place.
                del self._keys[name]
            page.draw(page.state)
        except Exception as error:
            if isinstance(result, Course):
                EXACT.pop(result.scene, None)
            # Not searched again: it would fail as often.
            self._keys[name] = key
            self._results[name] = key, FAULT
            page.notify(page.refusal(error))
            page.draw(page.state)


class IdleSearch(Searching):
    """Searches for the plots of a view, and for its exact course."""

    def compute(self, state: State, course: Course) -> dict[str, Found]:
        """Results for the plots of a state; quick ones are computed."""
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
        """Begin the slow searches of a view: its exact course, and those of its plots."""
        self.find_exact([view.course])
        for plot in (plot for plot in visible(view) if isinstance(plot, AsyncPlot)):
            asked = plot.asked(view.state)
            if not plot.quick(asked):
                self._search(plot.name, plot.key(view.course, asked), plot.find, view.course, asked)


def _keep(course: Course) -> None:
    """Keep an exact course in the place of the oldest one."""
    EXACT[course.scene] = course
    for scene in list(EXACT)[:-_KEPT]:
        del EXACT[scene]


def exact(course: Course) -> Course:
    """The exact course of a pending one, in the same state."""
    made = DRIVES[course.drive].exact(course.scene)
    return replace(made, now=nearest(made.progress, course.progress[course.now]), drive=course.drive)


def _exact(course):
    """The exact course, or the reason of failure."""
    try:
        return exact(course)
    except ValueError as error:
        return str(error)
