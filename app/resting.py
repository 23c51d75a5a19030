"""What takes longer than a move: found in a thread once the input is at rest, where it is looked at."""

import logging
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import panel as pn

from mdr_core.figures import Axis

from .drives import drive_of

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class Found:
    """Rows of a plot (SI), the axes that hold them, and what is said below it, as HTML."""

    rows: dict
    axes: list[Axis]
    note: str = ""


class Resting:
    """The searches of one session: the latest of each title only, in threads that all sessions share.

    `show` is given the title and what was found.
    """

    def __init__(self, show):
        self._show, self._asked, self._document = show, {}, pn.state.curdoc

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

    def _run(self, title, stop, search, *arguments):
        def show(found):
            self._inside(lambda: stop.is_set() or self._show(title, found))

        if stop.is_set():
            return
        try:
            for found in search(*arguments):
                if stop.is_set():
                    return
                show(found)
        except Exception:
            _LOG.exception("%s could not be found, scene %s", title, arguments[0].scene.to_json())
            show(Found({}, [], "This could not be found, because of a fault of the explorer."))

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
