"""Sets of files: a folder, a list of paths, a pattern, or the texts in a zip."""

import re
import zipfile
import zlib
from functools import partial
from glob import glob, has_magic
from pathlib import Path

from ...base.errors import MDRError
from .afm import is_afm_text
from .packed import is_binary, refuse_large
from .question import UnknownColumns
from .table import decoded

#: Largest number of files of a set, and their largest total size (bytes), unpacked.
_FILES, _BYTES = 1_000, 500_000_000
#: Number of bytes of a text to search for words of an AFM.
_HEAD = 4096


def set_of(path, of_path, of_text):
    """Return the name of a set of files, and functions that read each file with options, by file name.

    Return None if `path` is a single file. `of_path` reads a path, `of_text` the name and bytes of a text.
    """
    if isinstance(path, list | tuple):
        name, files = f"a list of {len(path)} files", [Path(each) for each in path]
    elif Path(path).is_dir():
        name, files = Path(path).name, [each for each in Path(path).iterdir() if each.is_file()]
    elif has_magic(str(path)) and not Path(path).exists():
        name, files = str(path), [Path(each) for each in glob(str(path), recursive=True)]
        files = [each for each in files if each.is_file()]
    elif texts := _texts_in(Path(path)):
        return Path(path).name, {name: partial(of_text, name, data) for name, data in texts.items()}
    else:
        return None
    files = sorted((each for each in files if not _of_a_system(each)), key=_natural)
    _check_size(name, [each.stat().st_size for each in files])
    short = len({each.name for each in files}) == len(files)
    return name, {each.name if short else str(each): partial(of_path, each) for each in files}


def _texts_in(path):
    """Return the bytes of the texts in a zip by name; empty for another file, and for a zip of an AFM."""
    if path.suffix.lower() != ".zip" or not zipfile.is_zipfile(path):
        return {}
    refuse_large(path)
    try:
        with zipfile.ZipFile(path) as file:
            inside = {each.filename: each for each in file.infolist() if not each.is_dir()}
            names = [each for each in inside if not _of_a_system(Path(each))]
            with file.open(names[0]) as first:
                head = first.read(_HEAD)
            if is_binary(head) or is_afm_text(decoded(head)):
                return {}
            _check_size(path.name, [inside[name].file_size for name in names])
            return {name: file.read(name) for name in sorted(names, key=_natural)}
    except (zipfile.BadZipFile, zlib.error, RuntimeError, IndexError) as error:
        raise MDRError(f"{path.name} cannot be unpacked, {error}: unpack it, and give its folder") from None


def _of_a_system(path):
    """Whether a file is hidden, of the system, or the lock of an open Excel file."""
    hidden = any(part.startswith((".", "~$", "__MACOSX")) and part != ".." for part in path.parts[-2:])
    return hidden or path.name.lower() in ("thumbs.db", "desktop.ini")


def _natural(path):
    """Return a key that sorts names in natural order, 2 before 10."""
    path = Path(path)
    parts = re.split(r"(\d+)", path.name.lower())
    return [int(part) if k % 2 else part for k, part in enumerate(parts)], str(path)


def _check_size(name, sizes):
    if not sizes:
        text = (
            "give a folder with files, or a pattern such as 'lab/*.txt', or 'lab/**/*.txt' for subfolders"
        )
        raise MDRError(f"{name} has no files: {text}")
    if len(sizes) > _FILES:
        raise MDRError(f"{name} has {len(sizes)} files, and at most {_FILES} are read: give a part of them")
    if sum(sizes) > _BYTES:
        size = f"{sum(sizes) / 1e9:.3g} GB"
        raise MDRError(f"{name} has {size}, and at most {_BYTES / 1e9:g} GB are read: give a part of it")


def curves_of_set(files, options, done):
    """Return the curves of the files of a set by name, and the errors of unread files.

    `files` are functions that read a file with options; `done` is called after each file. The first
    `UnknownColumns` is raised once for all files with the same headers and units, and given columns apply
    to these files. If no file raises `UnknownColumns`, they apply to all files.
    """
    plain = options | {"columns": None, "by": None}
    found = {}
    for name, read in files.items():
        found[name] = _tried(read, plain)
        done(1)
    questions = {name: each for name, each in found.items() if _asks(each)}
    key = next((each.table.key for each in questions.values()), None)
    same = [name for name, each in questions.items() if each.table.key == key]
    if options != plain:
        found |= {name: _tried(files[name], options) for name in same or files}
    elif same:
        raise questions[same[0]].of_files(len(same))
    unread = {name: each for name, each in found.items() if isinstance(each, Exception)}
    if len(unread) == len(files):
        raise next(iter(unread.values()))
    return {name: each for name, each in found.items() if name not in unread}, unread


def _tried(read, options):
    """Return the curves of a file, or its error."""
    try:
        return read(options)
    except (MDRError, OSError, ImportError) as error:
        return error


def _asks(outcome):
    """Whether a file has ambiguous columns and does not contain results."""
    return isinstance(outcome, UnknownColumns) and not outcome.results
