"""Folders for the files of sessions, in a folder of this process; the next start clears leftovers."""

import atexit
import os
import re
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from .errors import Refused
from .upload import SESSION_BYTES, SET_FILES

try:
    import fcntl
except ImportError:
    # On Windows the system clears the files of a killed server.
    fcntl = None  # type: ignore[assignment]

_PREFIX, _LOCK = "mdr-explorer-", "in use"
TOO_MANY = "At most {} files with {:g} MB together can be read: drop fewer files"
NOT_KEPT = "The server cannot store this file because its disk is full. Try again later"


class Files:
    """Files of a session. The first file creates the folder."""

    def __init__(self) -> None:
        self._folder: Path | None = None
        self.paths: list[str] = []
        self._bytes = 0

    def keep(self, data: bytes, name: str = "") -> str:
        """Replace all files by this file, and return its new path. Raises `Refused`."""
        self.clear()
        return self.add(data, name)

    def add(self, data: bytes, name: str) -> str:
        """Add a file, within bounds, and return its path. Raises `Refused`."""
        self._bytes += len(data)
        if self._bytes > SESSION_BYTES or len(self.paths) >= SET_FILES:
            raise Refused(TOO_MANY.format(SET_FILES, SESSION_BYTES / 1e6))
        try:
            self._folder = self._folder or Path(tempfile.mkdtemp(dir=own()))
            path = self._folder / safe_name(name)
            if path.exists():
                path = path.with_name(f"{len(self.paths) + 1} {path.name}")
            path.write_bytes(data)
        except OSError:
            raise Refused(NOT_KEPT) from None
        self.paths.append(str(path))
        return str(path)

    def clear(self) -> None:
        """Remove all files."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
        self._folder, self.paths, self._bytes = None, [], 0


def safe_name(name: str) -> str:
    """Return a file name of safe characters and safe length for every system."""
    path = Path(re.sub(r"[^\w. #+,;=@()&-]", "_", name.replace("/", " ")).strip(". "))
    return f"{path.stem[:40] or 'file'}{path.suffix[:20]}"


@cache
def own() -> Path:
    """Return the folder of this process, locked while the process runs."""
    folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    # Never closed here: the system closes it when the process ends, even after a crash.
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
