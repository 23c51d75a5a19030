"""Folders for files of sessions, in one of this process: if it is killed, the next start clears it."""

import atexit
import os
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from .errors import Refused

try:
    import fcntl
except ImportError:
    # On Windows what a killed server has left is for the system to clear.
    fcntl = None  # type: ignore[assignment]

_PREFIX, _LOCK = "mdr-explorer-", "in use"
NOT_KEPT = "The server cannot keep this file for reading, as its disk is full. Try again later"


class Files:
    """Files of a session. The first file creates the folder."""

    def __init__(self) -> None:
        self._folder: Path | None = None
        self._count = 0

    def keep(self, data: bytes, suffix: str = "") -> str:
        """Keep a file instead of the last one, and return its path, a new one each time. Raises Refused."""
        self.clear()
        self._count += 1
        try:
            self._folder = Path(tempfile.mkdtemp(dir=own()))
            path = self._folder / f"file {self._count}{suffix}"
            path.write_bytes(data)
        except OSError:
            raise Refused(NOT_KEPT) from None
        return str(path)

    def clear(self) -> None:
        """Remove what is kept."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
        self._folder = None


@cache
def own() -> Path:
    """Return the folder of this process, which is locked as long as the process runs."""
    folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    # Never closed: the system does that at the end of the process, however it ends.
    _locked(folder / _LOCK, os.O_CREAT)
    return folder


def clear() -> None:
    """Remove the folders of this user whose processes have ended."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with suppress(OSError):
            own_folder = folder.lstat().st_uid == os.getuid() and not folder.is_symlink()
            if own_folder and (lock := _locked(folder / _LOCK, 0)) is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(lock)


def _locked(path: Path, flags: int) -> int | None:
    """Lock a file; return its descriptor, or None if another process has locked it."""
    if fcntl is None:
        return None
    descriptor = os.open(path, os.O_RDWR | flags, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor
