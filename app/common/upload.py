"""Uploads of a browser, within bounds that the server also checks."""

from dataclasses import dataclass, field
from time import monotonic
from typing import Any

#: Largest number of samples of a tip; more samples would delay all sessions.
MAX_SAMPLES = 60
#: Largest size (bytes) of a tip, of a measured curve, of all incoming files of a session, and of a part. As
#: text a part is larger by a third, and a message has at most 8 MB.
TIP_BYTES, CURVE_BYTES, SESSION_BYTES, PART_BYTES = 5_000_000, 50_000_000, 100_000_000, 2_000_000
#: Largest number of files in one set.
SET_FILES = 1_000
#: Bytes of a list entry for each part.
_LISTED = 64


def in_line(name: str) -> str:
    """Return the name of a file for a line of text."""
    return " ".join(name.split())[:80]


def _too_large(name: str, most: int) -> ValueError:
    return ValueError(f"{in_line(name)} has more than {most / 1e6:g} MB: thin out its samples")


@dataclass(frozen=True)
class Uploaded:
    """Uploaded file: name, size (bytes), and data, which is None if the file is too large to send."""

    name: str
    size: int
    data: bytes | None

    def read(self) -> bytes:
        """Return the data of a tip. Raises ValueError if it is too large."""
        if self.data is None or len(self.data) > TIP_BYTES:
            raise _too_large(self.name, TIP_BYTES)
        return self.data


@dataclass
class _Coming:
    """Incoming file: time of its first part (s), and its parts."""

    began: float = field(default_factory=monotonic)
    parts: list[bytes] = field(default_factory=list)


class Uploads:
    """Incoming files of a session by their names, which may be paths; several arrive at once, in parts.

    Parts are bytes and arrive in order. The field bounds the size of each file, and `SESSION_BYTES` the
    size of all incoming files. A file that exceeds a bound is discarded, with the rest of its parts.
    """

    def __init__(self) -> None:
        # Keys: the largest size that the field accepts, and the name.
        self._files: dict[tuple[int, str], _Coming] = {}

    @property
    def size(self) -> int:
        """Bytes of all incoming files, including their names and the lists of their parts."""
        files = self._files.items()
        return sum(len(name) + sum(len(part) + _LISTED for part in each.parts) for (_, name), each in files)

    def add(self, part: Any, most: int) -> tuple[str, bytes, float] | None:
        """Add a part of a file of at most `most` bytes.

        Returns name, data and start time (s, by `time.monotonic`) of a complete file. Raises ValueError.
        """
        match part:
            case {"name": str(name), "chunk": int(number), "total_chunks": int(count), "data": bytes(data)}:
                pass
            case _:
                raise ValueError("the browser has sent an invalid part of a file: drop the file again")
        key = most, name
        if number == 1:
            self._files[key] = _Coming()
        coming = self._files.pop(key, None)
        if coming is None:
            # The rest of a discarded file.
            return None
        if number != len(coming.parts) + 1 or number > count:
            raise ValueError(f"a part of {in_line(name)} is missing: drop the file again")
        coming.parts.append(data)
        if sum(map(len, coming.parts)) > most:
            raise _too_large(name, most)
        if number == count:
            return name, b"".join(coming.parts), coming.began
        self._files[key] = coming
        if self.size > SESSION_BYTES:
            del self._files[key]
            raise ValueError(
                f"all incoming files together have more than {SESSION_BYTES / 1e6:g} MB: "
                f"drop {in_line(name)} again when the others have arrived"
            )
        return None
