"""What takes longer than a move: found in a thread once the input is at rest, where it is looked at."""

import logging
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import panel as pn

from mdr_core.results.figures import Axis

from .drives import drive_of

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class Found:
    """Rows of a plot (SI), the axes that hold them, and what is said below it, as HTML."""

    rows: dict
    axes: list[Axis]
    note: str = ""


#: What is shown before anything is found, and where nothing can be.
COMPUTING = Found({}, [], "computing …")
FAULT = Found({}, [], "This could not be found, because of a fault of the explorer.")


def about(plot, way, values):
    """What a search for a plot is about: the scene, the values that are asked for, and the state."""
    return way.scene, *values, *[way.progress[way.now]] * plot.of_state


class Resting:
    """The searches of one session: the latest of each title only, in threads that all sessions share.

    `show` is given the title and what was found.
    """

    def __init__(self, show):
        self._show, self._asked, self._found, self._document = show, {}, {}, pn.state.curdoc

    def follow(self, title, about, search, *arguments):
        """Let a generator search, unless that is under way or done for what it is `about`.

        None: it is no longer looked at.
        """
        last, stop = self._asked.get(title, (None, None))
        if last == about:
            return
        if stop is not None:
            stop.set()
        stop = threading.Event()
        self._asked[title] = about, stop
        if about is not None:
            thread = pn.state.as_cached("resting", ThreadPoolExecutor, max_workers=2)
            thread.submit(self._run, title, stop, search, *arguments)

    def known(self, plot, way, values):
        """What is known of a plot: found at once where that is quick, else what was found of the same."""
        of = about(plot, way, values)
        if plot.quick(*values):
            self._found[plot.title] = of, *plot.resting(way, *values)
        asked, last = self._found.get(plot.title, (None, COMPUTING))
        return last if asked == of else replace(COMPUTING, axes=last.axes)

    def give_up(self, title):
        """Of what was found last nothing is known."""
        self._found[title] = self._asked[title][0], FAULT

    def _run(self, title, stop, search, *arguments):
        def show(found):
            self._inside(lambda: stop.is_set() or self._keep(title, found))

        if stop.is_set():
            return
        try:
            for found in search(*arguments):
                if stop.is_set():
                    return
                show(found)
        except Exception:
            _LOG.exception("%s could not be found, scene %s", title, arguments[0].scene.to_json())
            show(FAULT)

    def _keep(self, title, found):
        self._found[title] = self._asked[title][0], found
        self._show(title, found)

    def _inside(self, act):
        """Call a function with the lock of the session; without a server, directly."""
        if self._document is None or self._document.session_context is None:
            act()
        else:
            self._document.add_next_tick_callback(act)


def in_time(way):
    """A trajectory that is pending, in time, or why it cannot be so."""
    try:
        yield drive_of(way.scene).in_time(way.scene)
    except ValueError as error:
        yield str(error)
