"""The explorer as a folder that any static host serves: it runs in the browser, by Pyodide."""

import hashlib
import json
import shutil
import zipfile
from collections.abc import Iterator
from importlib.metadata import distribution
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import urlsplit

from . import APP, licenses, pages

#: The version of Pyodide that was tested, and where it is published.
PYODIDE = "0.27.7"
PUBLISHED = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE}/full/"
#: Digests of its scripts, by which a browser refuses others: those of the package `pyodide` of npm.
INTEGRITY = {
    "pyodide.mjs": "sha384-z8L8kZDaddEtk+VNtmPcXLY83XSVlBjlabpCtT6GghMW3jSyzOEzNsL9BiKsfjcL",
    "pyodide.asm.js": "sha384-J3SxzZJh4tkb2bgoUc72zArF45FJ+ngsbiqNsmxqkkecNVpZ/bUHAM0JMp+YPVpx",
}
#: Files of its runtime.
RUNTIME = ("pyodide.mjs", "pyodide.asm.js", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")
#: Folders of which an earlier explorer is replaced.
WRITTEN = ("app", "static", "pyodide", "drawings")
#: Packages of this environment of which the page imports something in a browser.
PACKAGES = (
    "panel", "bokeh", "param", "pyviz-comms", "Jinja2", "MarkupSafe", "PyYAML", "packaging", "tqdm",
    "typing-extensions",
)  # fmt: skip
#: In the place of packages of which the page needs little. Panel reads remote tables by the first one, and
#: where it is missing by pandas, 6 MB and 3 s of imports. The second is not compiled for a browser: Panel
#: removes by it unsafe HTML from a few texts of its own, as the place of notices; here HTML is escaped.
_IN_PLACE = {
    "pyodide_http.py": "def patch_all():\n    pass\n",
    "nh3.py": "from html import escape\n\n\ndef clean(html, **options):\n    return escape(html)\n",
}
#: Of their files what is read when they are imported: no tests, scripts for a browser, or compiled parts.
_KINDS = {".py", ".html", ".json", ".css", ".js", ".jinja"}
_LEFT_OUT = {"tests", "dist", "static", "sampledata", "node_modules", "..", "command"}


def sources(name: str) -> Iterator[tuple[str, Path]]:
    """Files of an installed package that are needed, by their names in the archive."""
    for file in distribution(name).files or ():
        parts = PurePosixPath(file).parts
        wanted = file.suffix in _KINDS and not _LEFT_OUT & {*parts}
        # Its version is asked for where it is imported.
        if file.name == "METADATA" or (wanted and not parts[0].endswith(".dist-info")):
            yield str(file), Path(str(file.locate()))


def own_sources() -> Iterator[tuple[str, Path]]:
    """Files of the core, of the page, and of what it reads."""
    import mdr_core

    for root, name in ((Path(mdr_core.__file__).parent, "mdr_core"), (APP, "app")):
        for path in sorted(root.rglob("*")):
            inside = path.relative_to(root)
            if path.is_file() and "__pycache__" not in inside.parts:
                yield f"{name}/{inside.as_posix()}", path
    for name in ("presets.json", "quantities.json"):
        yield f"assets/{name}", APP.parent / "assets" / name
    metadata = next(each for each in distribution("mdr-core").files or () if each.name == "METADATA")
    yield str(metadata), Path(str(metadata.locate()))


def write_archive(path: Path) -> None:
    """The packages of Python in one file, as they are unpacked in the browser."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, file in [*own_sources(), *(pair for each in PACKAGES for pair in sources(each))]:
            # Without the time of the file, so that the same sources are the same archive.
            archive.writestr(zipfile.ZipInfo(name), file.read_bytes(), zipfile.ZIP_DEFLATED, 9)
        for name, text in _IN_PLACE.items():
            archive.writestr(zipfile.ZipInfo(name), text)


def used(lock: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Entries of the lock that are loaded, with what they depend on."""
    entries, names = lock["packages"], list(pages.COMPILED)
    for name in names:
        names += [each for each in entries[name]["depends"] if each not in names]
    return {name: entries[name] for name in names}


def whole(folder: Path) -> tuple[dict[str, bytes], list[licenses.Licensed]]:
    """Files of a Pyodide that are loaded, and their licences. Raises ValueError if it is not whole."""
    path = folder / "pyodide-lock.json"
    if not path.is_file():
        raise ValueError(f"{folder} is no folder of Pyodide: it has no pyodide-lock.json")
    lock: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    if (found := lock["info"]["version"]) != PYODIDE:
        raise ValueError(f"{folder} has Pyodide {found}; tested is {PYODIDE}: give that one")
    entries = used(lock)
    digests = dict.fromkeys(RUNTIME, "") | {each["file_name"]: each["sha256"] for each in entries.values()}
    if missing := [name for name in digests if not (folder / name).is_file()]:
        raise ValueError(f"{folder} lacks {', '.join(missing)}: give a whole Pyodide {PYODIDE}")
    files = {name: (folder / name).read_bytes() for name in digests}
    for name, expected in digests.items():
        if expected and hashlib.sha256(files[name]).hexdigest() != expected:
            raise ValueError(f"{name} in {folder} is not the file that its lock names: its SHA-256 differs")
    parts = list(licenses.of_runtime(lock))
    for name, entry in entries.items():
        file, version = folder / entry["file_name"], entry["version"]
        wheel = file.suffix == ".whl"
        parts.append(licenses.of_wheel(file) if wheel else licenses.of_library(name, version))
    return files, parts


def write(folder: Path, pyodide: str = "") -> None:
    """Write the explorer into a folder.

    Parameters
    ----------
    folder : Path
        Where it is written; a folder that has something else in it is refused.
    pyodide : str, optional
        Folder of a whole Pyodide, of which what is needed is copied, or the address from which browsers
        load it; by default that at which the tested version is published.

    Raises
    ------
    ValueError
        If the folder has other files, or the Pyodide is not whole or not of the tested version.
    """
    if folder.exists() and any(folder.iterdir()) and not (folder / "explorer.zip").is_file():
        raise ValueError(f"{folder} has other files in it: name a new one, or that of an earlier explorer")
    parts = [licenses.of_package(name) for name in ("mdr-core", *PACKAGES)]
    address, files = pyodide or PUBLISHED, {}
    if urlsplit(address).scheme not in ("http", "https"):
        files, more = whole(Path(address))
        parts, address = parts + more, "pyodide/"
    # Nothing is written before all is known to be there.
    for name in WRITTEN:
        shutil.rmtree(folder / name, ignore_errors=True)
    for name, data in files.items():
        path = folder / "pyodide" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    folder.mkdir(parents=True, exist_ok=True)
    write_archive(folder / "explorer.zip")
    address = address.rstrip("/") + "/"
    digests = INTEGRITY if address == PUBLISHED else {}
    parts += pages.write(folder, address, {address + name: digest for name, digest in digests.items()})
    (folder / "LICENSES.txt").write_text(licenses.written(parts), encoding="utf-8")
