"""Slow searches of a session, made in threads while the input rests."""

import logging
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from typing import Any

import panel as pn

from .courses import Course
from .drives import in_time
from .plot import Found
from .state import State

_LOG = logging.getLogger(__name__)
#: Results before a search ends, and after one failed.
COMPUTING = Found({}, [], "computing …")
FAULT = Found({}, [], "This could not be found, because of a fault of the explorer.")
#: Threads for the searches of all sessions.
_THREADS = ThreadPoolExecutor()


class Resting:
    """Searches of a session in threads while the input rests: the last one of each name."""

    def __init__(self, show: Callable[[str, Any], None]):
        self._show, self._keys, self._results, self._document = show, {}, {}, pn.state.curdoc

    def begin(self, courses: list[Course], plots: Iterable[Any], state: State) -> None:
        """Begin the slow searches of a state: exact courses, and those of plots of the first course."""
        for k, course in enumerate(courses):
            if course.pending:
                self._search(f"course {k}", course.scene, in_time, course)
        for plot in (plot for plot in plots if plot.find):
            asked = plot.asked(state)
            if not plot.quick(asked):
                self._search(plot.name, _key(plot, courses[0], asked), plot.find, courses[0], asked)

    def _search(self, name, key, search, *arguments):
        """Search unless the last search of this name has the same key."""
        if self._keys.get(name) == key:
            return
        self._keys[name] = key

        def run():
            try:
                result = search(*arguments)
            except Exception:
                _LOG.exception("%s could not be found, scene %s", name, arguments[0].scene.to_json())
                result = FAULT
            done = partial(self._done, name, key, result)
            self._document.add_next_tick_callback(done) if served else done()

        served = is_served(self._document)
        _THREADS.submit(run) if served else run()

    def _done(self, name, key, result):
        if self._keys[name] == key:
            self._results[name] = key, result
            self._show(name, result)

    def found(self, plots: Iterable[Any], state: State, course: Course) -> dict[str, Found]:
        """Results for some plots; quick ones are computed."""
        results = {}
        for plot in (plot for plot in plots if plot.find):
            asked = plot.asked(state)
            key, result = self._results.get(plot.name, (None, COMPUTING))
            if plot.quick(asked):
                result = plot.find(course, asked)
            elif key != _key(plot, course, asked):
                result = replace(COMPUTING, axes=result.axes)
            results[plot.name] = result
        return results

    def give_up(self, name: str) -> None:
        self._results[name] = self._keys[name], FAULT


def is_served(document: Any) -> bool:
    """Whether a document is that of a session of the server."""
    return document is not None and document.session_context is not None


def _key(plot: Any, course: Course, asked: Any) -> Any:
    """Key of the search of a plot."""
    return course.scene, asked, course.progress[course.now] if plot.of_state else None
