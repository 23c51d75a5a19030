"""The field for a file, which comes in parts."""

from collections.abc import Callable
from typing import Any

import panel as pn

from ..ui import WIDE

#: Most bytes of a file, and of a part in which it comes: with a third more as text below 8 MB of a message.
MAX_BYTES, CHUNK = 50_000_000, 2_000_000


class Dropper(pn.widgets.FileDropper):
    """A field for a file, dropped or chosen, whose parts are kept until it is whole.

    The parts of one file are kept at a time, up to `most` bytes; one that is larger is left out.
    """

    def __init__(
        self, take: Callable[[str, bytes], None], coming: Callable[[], None], most: int, **options: Any
    ):
        self._take, self._coming, self._most = take, coming, most
        self._name: str | None = None
        self._parts: list[bytes] = []
        look = {"max_file_size": f"{most / 1e6:g}MB", "chunk_size": CHUNK, "multiple": False}
        super().__init__(layout="compact", css_classes=["drop"], **look, **WIDE | options)

    @property
    def kept(self) -> int:
        """Bytes that are kept."""
        return sum(map(len, self._parts))

    def _process_event(self, event: Any) -> None:
        if event.event_name != "upload_event":
            return
        told = event.data
        name, data = str(told["name"]), bytes(told["data"] or b"")
        if told["chunk"] == 1:
            self._name, self._parts = name, []
            # Before all of it is there, the process may start.
            self._coming()
        if name != self._name or self.kept + len(data) > self._most:
            self._name, self._parts = None, []
            return
        self._parts.append(data)
        if told["chunk"] == told["total_chunks"]:
            whole = b"".join(self._parts)
            self._name, self._parts = None, []
            self._take(name, whole)
