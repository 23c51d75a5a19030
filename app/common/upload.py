"""Files that a browser sends, within bounds that the server keeps too."""

from dataclasses import dataclass, field
from time import monotonic
from typing import Any

#: Most samples of a tip that are pressed without keeping everybody waiting.
MAX_SAMPLES = 60
#: Most bytes of a tip, of a measured curve, of all files of a session on their way, and of a part. As text
#: a part has a third more, and a message at most 8 MB.
TIP_BYTES, CURVE_BYTES, SESSION_BYTES, PART_BYTES = 5_000_000, 50_000_000, 100_000_000, 2_000_000
#: Most files that are read as one set.
SET_FILES = 1_000
#: Bytes of a part beside its own.
_LISTED = 64


def in_line(name: str) -> str:
    """Name of a file in a line of text."""
    return " ".join(name.split())[:80]


def _too_large(name: str, most: int) -> ValueError:
    return ValueError(f"{in_line(name)} has more than {most / 1e6:g} MB: thin out its samples")


@dataclass(frozen=True)
class Uploaded:
    """A file from the browser: name, size (bytes), and data unless it is too large to be sent."""

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
    """A file on its way: when it began (s), and its parts."""

    began: float = field(default_factory=monotonic)
    parts: list[bytes] = field(default_factory=list)


class Uploads:
    """The files of a session that come in parts, several at once, by their names, which may be paths.

    Parts are bytes and come in order. A file has at most as many bytes as its field takes, and all files on
    their way `SESSION_BYTES`. A file that breaks a bound is left out, with the rest of its parts.
    """

    def __init__(self) -> None:
        # By their field, which takes so many bytes, and their name.
        self._files: dict[tuple[int, str], _Coming] = {}

    @property
    def size(self) -> int:
        """Bytes of all files on their way, with those of their names and of lists of their parts."""
        files = self._files.items()
        return sum(len(name) + sum(len(part) + _LISTED for part in each.parts) for (_, name), each in files)

    def add(self, part: Any, most: int) -> tuple[str, bytes, float] | None:
        """Add a part of a file of at most `most` bytes.

        Returns name, data and beginning (s, by `time.monotonic`) of a whole file. Raises ValueError.
        """
        match part:
            case {"name": str(name), "chunk": int(number), "total_chunks": int(count), "data": bytes(data)}:
                pass
            case _:
                raise ValueError("the browser has sent something that is no part of a file: drop it again")
        key = most, name
        if number == 1:
            self._files[key] = _Coming()
        coming = self._files.pop(key, None)
        if coming is None:
            # The rest of a file that was left out.
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
                f"the files on their way have more than {SESSION_BYTES / 1e6:g} MB together; "
                f"{in_line(name)} is left out: drop it again when the others are there"
            )
        return None
