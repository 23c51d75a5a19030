"""LICENSES.txt of a static explorer: name, version, licence and licence text of each part of the folder."""

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
_HEAD = """The parts of this folder, each with its licence. The scripts of Bokeh and Panel contain parts
of other projects, which their sources list.
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
    """Return the text of a licence that the package does not contain."""
    text = (_TEXTS / f"{name}.txt").read_text(encoding="utf-8")
    return f"{holder}\n\n{text}" if holder else text


def _of(metadata: Message, texts: Iterable[str], where: str) -> Licensed:
    """Return a package from its metadata. Raise ValueError if its licence text is missing."""
    name, found = metadata["Name"], "\n\n".join(texts)
    short = metadata["License-Expression"] or (metadata["License"] or "").strip().split("\n")[0]
    named = [each.split(" :: ")[-1] for each in metadata.get_all("Classifier", ()) if "License ::" in each]
    # Some packages have the licence text in the field for its name.
    short = "" if short.startswith("Copyright") else short
    if not found:
        raise ValueError(f"{where} has no text of the licence of {name}, which must be in the folder")
    return Licensed(name, metadata["Version"], short or ", ".join(named) or "as below", found)


def of_package(name: str) -> Licensed:
    """Return a package of this environment."""
    package = distribution(name)
    kept = [file for file in package.files or () if _CALLED.match(file.name) and ".dist-info" in str(file)]
    texts = [Path(str(file.locate())).read_text(encoding="utf-8") for file in kept]
    return _of(message_from_string(package.read_text("METADATA") or ""), texts, "its installation")


def of_wheel(path: Path) -> Licensed:
    """Return a package in a wheel."""
    with zipfile.ZipFile(path) as wheel:
        names = [name for name in wheel.namelist() if ".dist-info/" in name]
        kept = [name for name in names if _CALLED.match(name.rsplit("/", 1)[1])]
        metadata = next(name for name in names if name.endswith("/METADATA"))
        texts = [wheel.read(name).decode() for name in kept]
        return _of(message_from_string(wheel.read(metadata).decode()), texts, path.name)


def of_runtime(lock: Mapping[str, Any]) -> Iterator[Licensed]:
    """Yield the runtime: Pyodide and the programs compiled into it."""
    info = lock["info"]
    source = "Source: https://github.com/pyodide/pyodide"
    yield Licensed("Pyodide", info["version"], "MPL-2.0", _text("MPL-2.0", source))
    yield Licensed("Python", info["python"], "PSF-2.0", _text("PSF-2.0"))
    emscripten = info["platform"].removeprefix("emscripten_").replace("_", ".")
    holders = "Copyright (c) 2010-2014 Emscripten authors\nCopyright © 2005-2020 Rich Felker, et al. (musl)"
    yield Licensed("Emscripten", emscripten, "MIT", _text("MIT", holders))


#: Libraries of the lock that are not Python packages, with their licences and holders.
LIBRARIES = {"openblas": ("BSD-3-Clause", "Copyright (c) 2011-2014, The OpenBLAS Project")}


def of_library(name: str, version: str) -> Licensed:
    """Return a compiled library. Raise ValueError if its licence is unknown."""
    if name not in LIBRARIES:
        raise ValueError(f"the licence of the library {name} is not known, and it must be in the folder")
    licence, holder = LIBRARIES[name]
    return Licensed(name, version, licence, _text(licence, holder))


#: Scripts of other projects in Panel, by their folders.
SCRIPTS = {
    "es-module-shims": ("MIT", "Copyright (C) 2018-2021 Guy Bedford"),
    "notyf": ("MIT", "Copyright (c) 2016 Carlos Roso"),
    "katex": ("MIT", "Copyright (c) 2013-2020 Khan Academy and other contributors"),
}


def of_script(name: str, version: str) -> Licensed:
    """Return a browser script that comes with Panel."""
    licence, holder = SCRIPTS[name]
    return Licensed(name, version, licence, _text(licence, holder))


def as_text(parts: Iterable[Licensed]) -> str:
    """Return all parts as one text."""
    line = "\n" + 80 * "-" + "\n"
    return line.join([_HEAD, *map(str, sorted(parts, key=lambda part: part.name.lower()))])
