"""LICENSES.txt of a static explorer: name, version, licence and its text of all that is in the folder."""

import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from email import message_from_string
from email.message import Message
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

_TEXTS = Path(__file__).parent / "licenses"
_CALLED = re.compile(r"(LICEN[CS]E|COPYING|NOTICE)", re.IGNORECASE)
_HEAD = """What is in this folder, with the licence of each part. The scripts of Bokeh and Panel
have parts of others in them, which their sources list.
"""


@dataclass(frozen=True)
class Licensed:
    """A part of the folder: its name, version, the name of its licence, and the text."""

    name: str
    version: str
    licence: str
    text: str

    def __str__(self) -> str:
        return f"{self.name} {self.version}: {self.licence}\n\n{self.text.strip()}\n"


def _text(name: str, holder: str = "") -> str:
    """A licence whose text is not in the package itself."""
    text = (_TEXTS / f"{name}.txt").read_text(encoding="utf-8")
    return f"{holder}\n\n{text}" if holder else text


def _of(metadata: Message, texts: Iterable[str], where: str) -> Licensed:
    """A package by its metadata. Raises ValueError if it has no text of its licence."""
    name, found = metadata["Name"], "\n\n".join(texts)
    short = metadata["License-Expression"] or (metadata["License"] or "").strip().split("\n")[0]
    named = [each.split(" :: ")[-1] for each in metadata.get_all("Classifier", ()) if "License ::" in each]
    # Some packages have the text itself in the field for the name.
    short = "" if short.startswith("Copyright") else short
    if not found:
        raise ValueError(f"{where} has no text of the licence of {name}, which must be in the folder")
    return Licensed(name, metadata["Version"], short or ", ".join(named) or "as below", found)


def of_package(name: str) -> Licensed:
    """A package of this environment."""
    package = distribution(name)
    kept = [file for file in package.files or () if _CALLED.match(file.name) and ".dist-info" in str(file)]
    texts = [Path(str(file.locate())).read_text(encoding="utf-8") for file in kept]
    return _of(message_from_string(package.read_text("METADATA") or ""), texts, "its installation")


def of_wheel(path: Path) -> Licensed:
    """A package in a file."""
    with zipfile.ZipFile(path) as wheel:
        names = [name for name in wheel.namelist() if ".dist-info/" in name]
        kept = [name for name in names if _CALLED.match(name.rsplit("/", 1)[1])]
        metadata = next(name for name in names if name.endswith("/METADATA"))
        texts = [wheel.read(name).decode() for name in kept]
        return _of(message_from_string(wheel.read(metadata).decode()), texts, path.name)


def of_runtime(lock: Mapping[str, Any]) -> Iterator[Licensed]:
    """The runtime: Pyodide, and what is compiled into it."""
    info = lock["info"]
    source = "Source: https://github.com/pyodide/pyodide"
    yield Licensed("Pyodide", info["version"], "MPL-2.0", _text("MPL-2.0", source))
    yield Licensed("Python", info["python"], "PSF-2.0", _text("PSF-2.0"))
    emscripten = info["platform"].removeprefix("emscripten_").replace("_", ".")
    holders = "Copyright (c) 2010-2014 Emscripten authors\nCopyright © 2005-2020 Rich Felker, et al. (musl)"
    yield Licensed("Emscripten", emscripten, "MIT", _text("MIT", holders))


#: Libraries of the lock that are no packages of Python, with their licences and holders.
LIBRARIES = {"openblas": ("BSD-3-Clause", "Copyright (c) 2011-2014, The OpenBLAS Project")}


def of_library(name: str, version: str) -> Licensed:
    """A compiled library. Raises ValueError if its licence is not known here."""
    if name not in LIBRARIES:
        raise ValueError(f"the licence of the library {name} is not known, and it must be in the folder")
    licence, holder = LIBRARIES[name]
    return Licensed(name, version, licence, _text(licence, holder))


#: Scripts of others that come with Panel, by the folders in which it has them.
SCRIPTS = {
    "es-module-shims": ("MIT", "Copyright (C) 2018-2021 Guy Bedford"),
    "notyf": ("MIT", "Copyright (c) 2016 Carlos Roso"),
    "katex": ("MIT", "Copyright (c) 2013-2020 Khan Academy and other contributors"),
}


def of_script(name: str, version: str) -> Licensed:
    """A script for the browser that comes with Panel."""
    licence, holder = SCRIPTS[name]
    return Licensed(name, version, licence, _text(licence, holder))


def written(parts: Iterable[Licensed]) -> str:
    """All of them as one text."""
    line = "\n" + 80 * "-" + "\n"
    return line.join([_HEAD, *map(str, sorted(parts, key=lambda part: part.name.lower()))])
