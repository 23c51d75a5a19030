"""Files of tips, for both pages: each is read in a process, which ends with the answer."""

from collections.abc import Callable
from functools import partial
from typing import Any

from bokeh.document import Document

from .folders import NOT_KEPT, Files
from .refusals import Message
from .worker import Here, Worker, in_session, waiting


class Tips:
    """Reads the tips of a session, the last one that was asked for."""

    def __init__(self, document: Document):
        served = document.session_context is not None
        self._document, self._worker, self._files = document, Worker() if served else Here(), Files()
        self._job = 0
        if served:
            document.on_session_destroyed(lambda context: self.close())

    def read(self, name: str, data: bytes, heard: Callable[[str, Any], None]) -> None:
        """Read a file, and call `heard` where the page may be changed.

        It hears "busy" with a text, then "done" with columns (m) and a note, or "refused" with the reason.
        """
        self._job += 1
        heard("busy", f"Reading {name} …")
        try:
            path = self._files.keep(data)
        except OSError:
            heard("refused", Message(NOT_KEPT))
            return
        tell = in_session(self._document, partial(self._told, self._job, name, heard))
        self._worker.ask("tip", path, name, tell=tell)

    def _told(self, job: int, name: str, heard: Callable[[str, Any], None], kind: str, answer: Any) -> None:
        if job != self._job:
            return
        if kind == "waiting":
            heard("busy", f"Reading {name} …" if answer is None else f"{waiting(answer)} …")
            return
        self.close()
        heard("done" if kind == "done" else "refused", answer)

    def close(self) -> None:
        """End the process, and remove the file."""
        self._worker.stop()
        self._files.clear()
