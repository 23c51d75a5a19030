"""A page in a server: searches in threads, changes of the page in its session."""

from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import panel as pn
from bokeh.document import Document

from .host import Host, Sliced, Steps

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

    def later(self, act: Callable[[], None], milliseconds: int) -> Callable[[], None]:
        waiting = self._document.add_timeout_callback(act, milliseconds)
        return partial(self._document.remove_timeout_callback, waiting)

    def at_end(self, act: Callable[[], None]) -> None:
        self._document.on_session_destroyed(lambda context: act())

    def soon(self, act: Callable[[], None]) -> None:
        self._document.add_next_tick_callback(act)

    def run(self, act: Callable[[], Coroutine[Any, Any, None]]) -> None:
        pn.state.execute(act)

    def search(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        _THREADS.submit(Host.search, self, steps, wanted, done)


def host_of(document: Document) -> Host:
    """The server of a document, or nobody if it has no session."""
    return Server(document) if document.session_context is not None else Host()
