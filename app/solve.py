"""Courses of scenes: the table of drives, and slow searches."""

import asyncio
import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import panel as pn
from bokeh.document import without_document_lock

import mdr_core as mdr

from . import drives
from .drives import Course, Drive, nearest
from .state import PRESETS, State, medium, profile, used, with_derived
from .state.quantities import CHOICES, SHAPES

_LOG = logging.getLogger(__name__)

#: Every drive of the page, by its option of the choice "drive".
DRIVES: dict[str, Drive] = {}
for _found in iter_modules(drives.__path__):
    _module = import_module(f".drives.{_found.name}", __package__)
    _kinds = [kind for kind in vars(_module).values() if isinstance(kind, type) and issubclass(kind, Drive)]
    # A drive with a missing method raises here.
    DRIVES |= {kind.key: kind() for kind in _kinds if kind.key}


def scene_of(state: State) -> mdr.Scene:
    return mdr.Scene(profile(state), medium(state), DRIVES[state.drive].make(state))


def follow(state: State, known: dict[mdr.Scene, Course] | None = None) -> Course:
    """Course of a state; `known` has exact courses."""
    scene = scene_of(state)
    course = (known or {}).get(scene) or DRIVES[state.drive].follow(scene, state.progress)
    return replace(course, now=nearest(course.progress, state.progress))


def described(state: State) -> Any:
    """Scene as JSON for the log; its values if it is invalid."""
    try:
        return scene_of(state).to_json()
    except Exception:
        return dict(state)


def turning_point(state: State) -> mdr.Indentation:
    """State of largest depth, without the path."""
    return DRIVES[state.drive].turning_point(scene_of(with_derived(state)))


def options(state: State, name: str) -> list[str]:
    """Applicable options of a choice, the default first."""
    drive = DRIVES[state.drive]
    if name == "preset":
        return list(PRESETS)
    if name == "shape":
        return list(SHAPES)
    if name == "against" and drive.solver:
        return list(drive.results)
    if name != "swept" or not drive.solver:
        return list(CHOICES[name])
    impact = "speed" in drive.solver
    idle = {"density"} if impact else {"density", "eta", "tau"}
    works = [each for each in numbers_of(state) if each not in idle]
    return ["energy"] * impact + sorted(works, key=lambda each: each not in drive.solver)


def numbers_of(state: State) -> list[str]:
    return used(state, DRIVES[state.drive].form)


def option(state: State, name: str) -> str:
    """Option of a choice; the first one if the chosen one does not apply."""
    chosen, known = state[name], options(state, name)
    return chosen if chosen in known else known[0]


@dataclass(frozen=True)
class Found:
    """Rows of a plot (SI) with their axes, and a note as HTML."""

    rows: dict[str, Any]
    axes: list[Any]
    note: str = ""


#: Results before a search ends, and after one failed.
COMPUTING = Found({}, [], "computing …")
FAULT = Found({}, [], "This could not be found, because of a fault of the explorer.")


class Resting:
    """Searches of a session while the input rests, in threads: the last one of each name."""

    def __init__(self, show: Callable[[str, Any], None]):
        self._show, self._asked, self._found, self._document = show, {}, {}, pn.state.curdoc
        self._served = is_served(self._document)

    def begin(self, courses: list[Course], plots: Iterable[Any], state: State) -> None:
        """Begin the slow searches of a state: exact courses, and those of plots of the first course."""
        searches = [
            self._find(f"course {k}", course.scene, in_time, course)
            for k, course in enumerate(courses)
            if course.pending
        ]
        for plot in (plot for plot in plots if plot.find):
            asked = plot.asked(state)
            if not plot.quick(asked):
                about = _about(plot, courses[0], asked)
                searches.append(self._find(plot.name, about, plot.find, courses[0], asked))

        @without_document_lock
        async def search():
            await asyncio.gather(*searches)

        if self._served:
            self._document.add_next_tick_callback(search)
        else:
            asyncio.run(search())

    async def _find(self, name, about, search, *arguments):
        """Search unless it was asked for with the same key `about`; show the result of the last key."""
        if self._asked.get(name) == about:
            return
        self._asked[name] = about
        try:
            found = await asyncio.to_thread(search, *arguments)
        except Exception:
            _LOG.exception("%s could not be found, scene %s", name, arguments[0].scene.to_json())
            found = FAULT
        if self._asked[name] == about:
            self._found[name] = about, found
            show = partial(self._show, name, found)
            self._document.add_next_tick_callback(show) if self._served else show()

    def found(self, plots: Iterable[Any], state: State, course: Course) -> dict[str, Found]:
        """Results for some plots; quick ones are computed."""
        results = {}
        for plot in (plot for plot in plots if plot.find):
            asked = plot.asked(state)
            known, found = self._found.get(plot.name, (None, COMPUTING))
            if plot.quick(asked):
                found = plot.find(course, asked)
            elif known != _about(plot, course, asked):
                found = replace(COMPUTING, axes=found.axes)
            results[plot.name] = found
        return results

    def give_up(self, name: str) -> None:
        self._found[name] = self._asked[name], FAULT


def is_served(document: Any) -> bool:
    """Whether a document is that of a session of the server."""
    return document is not None and document.session_context is not None


def _about(plot: Any, course: Course, asked: Any) -> Any:
    """Key of the search of a plot."""
    return course.scene, asked, course.progress[course.now] if plot.of_state else None


def in_time(course: Course) -> Course | str:
    """Exact course of a pending one, or the reason of failure."""
    try:
        return drive_of(course.scene).in_time(course.scene)
    except ValueError as error:
        return str(error)


def drive_of(scene: mdr.Scene) -> Drive:
    return next(drive for drive in DRIVES.values() if drive.owns(scene.drive))
