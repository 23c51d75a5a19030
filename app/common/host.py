"""Hosts of a page, which decide when slow work runs.

A test does it at once, a server in threads, and a browser without threads and processes (browser.py).
"""

from collections.abc import Callable, Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial
from time import perf_counter
from typing import Any

import panel as pn
from bokeh.document import Document

#: Slow work in steps: the last step yields the result, all earlier steps yield None.
Steps = Iterator[Any]
#: Seconds of steps after which other sessions are served.
_SLICE = 0.02


def last(steps: Steps, wanted: Callable[[], bool] = lambda: True) -> Any:
    """Return the result of the last step, or None if it is not wanted any more."""
    found = None
    while wanted():
        try:
            found = next(steps)
        except StopIteration:
            return found
    return None


class Host:
    """Host without server and browser, for tests and files: it does all work at once."""

    #: Whether a separate process, which can be stopped, reads the files of users.
    processes = False

    def shows(self) -> bool:
        """Whether a browser shows the page; slow updates then wait until the input rests."""
        return False

    def on_load(self, act: Callable[[], None]) -> None:
        """Do something once a browser shows the page."""
        act()

    def call_later(self, act: Callable[[], None], milliseconds: int) -> Callable[[], None]:
        """Do something later, and return a function that cancels it."""
        act()
        return lambda: None

    def on_close(self, act: Callable[[], None]) -> None:
        """Do something when the page is closed, if the host notices this."""

    def next_tick(self, act: Callable[[], None]) -> None:
        """Do something in the thread that may change the page; call this from any thread."""
        act()

    def run(self, act: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Run a coroutine that may wait for a process; without processes it never waits."""
        with suppress(StopIteration):
            act().send(None)

    def search(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        """Run the steps of a search in the background, and pass the result to `done` if it is wanted."""
        found = last(steps, wanted)
        if wanted():
            self.next_tick(partial(done, found))

    def make(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        """Run steps that read the page, and pass the result to `done` if it is wanted."""
        self.search(steps, wanted, done)


class Sliced(Host):
    """Host that serves other sessions between slices of a slow task."""

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
    """Host for a session of a server."""

    processes = True

    def __init__(self, document: Document):
        self._document = document

    def shows(self) -> bool:
        return bool(pn.state.loaded)

    def on_load(self, act: Callable[[], None]) -> None:
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
    """Return the host of a document: its server, or a `Host` if it has no session."""
    return Server(document) if document.session_context is not None else Host()
