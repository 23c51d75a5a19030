"""Scenes solved along their paths: the table of drives, and what takes longer than a move, in threads."""

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
from .state import PRESETS, State, medium, profile, settled, used
from .state.quantities import CHOICES, SHAPES

_LOG = logging.getLogger(__name__)

#: Every drive of the page, by its option of the choice "drive".
DRIVES: dict[str, Drive] = {}
for _found in iter_modules(drives.__path__):
    _module = import_module(f".drives.{_found.name}", __package__)
    _kinds = [kind for kind in vars(_module).values() if isinstance(kind, type) and issubclass(kind, Drive)]
    # One of which a method is missing cannot be made.
    DRIVES |= {kind.key: kind() for kind in _kinds if kind.key}


def scene_of(state: State) -> mdr.Scene:
    """What is to be modelled."""
    return mdr.Scene(profile(state), medium(state), DRIVES[state.drive].make(state))


def follow(state: State, known: dict[mdr.Scene, Course] | None = None) -> Course:
    """The states of a scene along its path, at the progress where the page stands.

    `known` has courses that have been solved in full.
    """
    scene = scene_of(state)
    course = (known or {}).get(scene) or DRIVES[state.drive].follow(scene, state.progress)
    return replace(course, now=nearest(course.progress, state.progress))


def described(state: State) -> Any:
    """The scene of a state as JSON; if it cannot be made, what it would be made of."""
    try:
        return scene_of(state).to_json()
    except Exception:
        return dict(state)


def deepest(state: State) -> mdr.Indentation:
    """The deepest state of the present scene, without its path there."""
    return DRIVES[state.drive].deepest(scene_of(settled(state)))


def options(state: State, name: str) -> list[str]:
    """The options of a choice that apply to the scene, the one to begin with first."""
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
    """Names of the numbers that the scene is made of, and of those that its drive asks for."""
    return used(state, DRIVES[state.drive].form)


def option(state: State, name: str) -> str:
    """The option of a choice; the first, where what was chosen does not apply."""
    chosen, known = state[name], options(state, name)
    return chosen if chosen in known else known[0]


@dataclass(frozen=True)
class Found:
    """Rows of a plot (SI), the axes that hold them, and what is said below it, as HTML."""

    rows: dict[str, Any]
    axes: list[Any]
    note: str = ""


#: What is shown before anything is found, and where nothing can be.
COMPUTING = Found({}, [], "computing …")
FAULT = Found({}, [], "This could not be found, because of a fault of the explorer.")


class Resting:
    """The searches of one session: the latest of each name only, in threads that all sessions share.

    `show` is given the name and what was found.
    """

    def __init__(self, show: Callable[[str, Any], None]):
        self._show, self._asked, self._found, self._document = show, {}, {}, pn.state.curdoc

    def follow(self, name: str, about: Any, search: Callable[..., Iterator[Any]], *arguments: Any) -> None:
        """Let a generator search, unless that is under way or done for what it is `about`.

        None: it is no longer looked at.
        """
        last, stop = self._asked.get(name, (None, None))
        if last == about:
            return
        if stop is not None:
            stop.set()
        stop = threading.Event()
        self._asked[name] = about, stop
        if about is not None:
            thread = pn.state.as_cached("resting", ThreadPoolExecutor, max_workers=2)
            thread.submit(self._run, name, stop, search, *arguments)

    def known(self, name: str, about: Any) -> Found:
        """What was found of a plot for what it is about."""
        asked, last = self._found.get(name, (None, COMPUTING))
        return last if asked == about else replace(COMPUTING, axes=last.axes)

    def found(self, plots: dict[str, Any], state: State, course: Course) -> dict[str, Found]:
        """What is known of the plots that are asked for; what is quick is found."""
        known = {}
        for plot in (plots[name] for name in state.tiles if name in plots and plots[name].find):
            asked = plot.asked(state)
            about = self._about(plot, course, asked)
            if plot.quick(asked):
                self._found[plot.name] = about, [*plot.find(course, asked)][-1]
            known[plot.name] = self.known(plot.name, about)
        return known

    def look(self, plots: dict[str, Any], seen: set[str], state: State, course: Course) -> None:
        """Let what is seen be found, where that takes longer than a move."""
        for plot in (plot for plot in plots.values() if plot.find):
            asked = plot.asked(state) if plot.name in seen else None
            slow = plot.name in seen and not plot.quick(asked)
            about = self._about(plot, course, asked) if slow else None
            self.follow(plot.name, about, plot.find, course, asked)

    @staticmethod
    def _about(plot, course, asked):
        """What a search for a plot is about: the scene, what is asked for, and the state."""
        return course.scene, asked, course.progress[course.now] if plot.of_state else None

    def give_up(self, name: str) -> None:
        """Of what was found last nothing is known."""
        self._found[name] = self._asked[name][0], FAULT

    def end(self) -> None:
        """The session is over."""
        for _, stop in self._asked.values():
            stop.set()
        self._asked, self._found = {}, {}

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
            self._found[name] = self._asked[name][0], found
        self._show(name, found)

    def _inside(self, act):
        """Call a function with the lock of the session; without a server, directly."""
        if self._document is None or self._document.session_context is None:
            act()
        else:
            self._document.add_next_tick_callback(act)


def in_time(course: Course) -> Iterator[Any]:
    """A course that is pending, in time, or why it cannot be so."""
    drive = next(each for each in DRIVES.values() if each.owns(course.scene.drive))
    try:
        yield drive.in_time(course.scene)
    except ValueError as error:
        yield str(error)


def drive_of(scene: mdr.Scene) -> Drive:
    """The drive that shows a scene."""
    return next(drive for drive in DRIVES.values() if drive.owns(scene.drive))
