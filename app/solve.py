"""Courses of scenes: the table of drives, and slow searches in threads."""

import logging
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import panel as pn

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
    """Searches of a session: the latest of each name, in threads shared by all sessions."""

    def __init__(self, show: Callable[[str, Any], None]):
        self._show, self._searches, self._found, self._document = show, {}, {}, pn.state.curdoc

    def follow(self, name: str, about: Any, search: Callable[..., Iterator[Any]], *arguments: Any) -> None:
        """Start a search unless one with the same key `about` is running or done; None stops it."""
        last, stop = self._searches.get(name, (None, None))
        if last == about:
            return
        if stop is not None:
            stop.set()
        stop = threading.Event()
        self._searches[name] = about, stop
        if about is not None:
            thread = pn.state.as_cached("resting", ThreadPoolExecutor, max_workers=2)
            thread.submit(self._run, name, stop, search, *arguments)

    def known(self, name: str, about: Any) -> Found:
        asked, last = self._found.get(name, (None, COMPUTING))
        return last if asked == about else replace(COMPUTING, axes=last.axes)

    def found(self, plots: dict[str, Any], state: State, course: Course) -> dict[str, Found]:
        """Results for the visible plots; quick ones are computed."""
        known = {}
        for plot in (plots[name] for name in state.tiles if name in plots and plots[name].find):
            asked = plot.asked(state)
            about = self._about(plot, course, asked)
            if plot.quick(asked):
                self._found[plot.name] = about, [*plot.find(course, asked)][-1]
            known[plot.name] = self.known(plot.name, about)
        return known

    def look(self, plots: dict[str, Any], seen: set[str], state: State, course: Course) -> None:
        """Start the slow searches of visible plots."""
        for plot in (plot for plot in plots.values() if plot.find):
            asked = plot.asked(state) if plot.name in seen else None
            slow = plot.name in seen and not plot.quick(asked)
            about = self._about(plot, course, asked) if slow else None
            self.follow(plot.name, about, plot.find, course, asked)

    @staticmethod
    def _about(plot, course, asked):
        """Key of a search."""
        return course.scene, asked, course.progress[course.now] if plot.of_state else None

    def give_up(self, name: str) -> None:
        self._found[name] = self._searches[name][0], FAULT

    def end(self) -> None:
        for _, stop in self._searches.values():
            stop.set()
        self._searches, self._found = {}, {}

    def _run(self, name, stop, search, *arguments):
        def show(found):
            self._inside(lambda: stop.is_set() or self._take(name, found))

        if stop.is_set():
            return
        try:
            for found in search(*arguments):
                if stop.is_set():
                    return
                show(found)
        except Exception:
            _LOG.exception("%s could not be found, scene %s", name, arguments[0].scene.to_json())
            show(FAULT)

    def _take(self, name, found):
        if isinstance(found, Found):
            self._found[name] = self._searches[name][0], found
        self._show(name, found)

    def _inside(self, act):
        """Call a function under the lock of the session."""
        if self._document is None or self._document.session_context is None:
            act()
        else:
            self._document.add_next_tick_callback(act)


def in_time(course: Course) -> Iterator[Any]:
    """Exact course of a pending one, or the reason of failure."""
    drive = next(each for each in DRIVES.values() if each.owns(course.scene.drive))
    try:
        yield drive.in_time(course.scene)
    except ValueError as error:
        yield str(error)


def drive_of(scene: mdr.Scene) -> Drive:
    return next(drive for drive in DRIVES.values() if drive.owns(scene.drive))
