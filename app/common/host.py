"""Where a page runs, and when what takes time is done there.

At once, as in a test; in a server in threads; in a browser, without threads and processes, by browser.py.
"""

from collections.abc import Callable, Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial
from time import perf_counter
from typing import Any

import panel as pn
from bokeh.document import Document

#: Something that takes time, in steps: the last one gives what is found, those before it nothing.
Steps = Iterator[Any]
#: Seconds after which others are served while steps are taken.
_SLICE = 0.02


def last(steps: Steps, wanted: Callable[[], bool] = lambda: True) -> Any:
    """What the last step gives, None once it is not wanted any more."""
    found = None
    while wanted():
        try:
            found = next(steps)
        except StopIteration:
            return found
    return None


class Host:
    """No server and no browser, as in a test or for a file: what is asked for is done at once."""

    #: Whether a file of somebody is read in a process, which can be stopped.
    processes = False

    def shows(self) -> bool:
        """Whether a browser shows the page, so that slow updates wait until the input rests."""
        return False

    def once_shown(self, act: Callable[[], None]) -> None:
        """Do something once a browser shows the page."""
        act()

    def call_later(self, act: Callable[[], None], milliseconds: int) -> Callable[[], None]:
        """Do something later, and return what prevents it."""
        act()
        return lambda: None

    def on_close(self, act: Callable[[], None]) -> None:
        """Do something when the page is closed, if that is known."""

    def next_tick(self, act: Callable[[], None]) -> None:
        """Do something where the page may be changed, from whichever thread."""
        act()

    def run(self, act: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Do something that may wait for a process; without processes nothing waits."""
        with suppress(StopIteration):
            act().send(None)

    def search(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        """Take the steps of a search beside the page, and give what is found to `done` if it is wanted."""
        found = last(steps, wanted)
        if wanted():
            self.next_tick(partial(done, found))

    def make(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        """Take steps that read the page, and give what they make to `done` if it is wanted."""
        self.search(steps, wanted, done)


class Sliced(Host):
    """Others are served between slices of what is made."""

    def make(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        self._go_on(steps, wanted, done, None)

    def _go_on(self, steps, wanted, done, made):
        begun = perf_counter()
        while wanted():
            try:
                made = next(steps)
            except StopIteration:
                done(made)
                return
            if perf_counter() > begun + _SLICE:
                self.next_tick(partial(self._go_on, steps, wanted, done, made))
                return


#: Threads for the searches of all sessions.
_THREADS = ThreadPoolExecutor()


class Server(Sliced):
    """A session of a server."""

    processes = True

    def __init__(self, document: Document):
        self._document = document

    def shows(self) -> bool:
        return bool(pn.state.loaded)

    def once_shown(self, act: Callable[[], None]) -> None:
        pn.state.onload(act)

    def call_later(self, act: Callable[[], None], milliseconds: int) -> Callable[[], None]:
        waiting = self._document.add_timeout_callback(act, milliseconds)
        return partial(self._document.remove_timeout_callback, waiting)

    def on_close(self, act: Callable[[], None]) -> None:
        self._document.on_session_destroyed(lambda context: act())

    def next_tick(self, act: Callable[[], None]) -> None:
        self._document.add_next_tick_callback(act)

    def run(self, act: Callable[[], Coroutine[Any, Any, None]]) -> None:
        pn.state.execute(act)

    def search(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        _THREADS.submit(Host.search, self, steps, wanted, done)


def host_of(document: Document) -> Host:
    """The server of a document, or nobody if it has no session."""
    return Server(document) if document.session_context is not None else Host()
