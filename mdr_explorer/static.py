"""The explorer as a folder for any static host: it runs in the browser, by Pyodide."""

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

#: The tested version of Pyodide, and its public address.
PYODIDE = "0.27.7"
PUBLISHED = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE}/full/"
#: Digests of its scripts in the npm package `pyodide`; a browser rejects scripts with other digests.
INTEGRITY = {
    "pyodide.mjs": "sha384-z8L8kZDaddEtk+VNtmPcXLY83XSVlBjlabpCtT6GghMW3jSyzOEzNsL9BiKsfjcL",
    "pyodide.asm.js": "sha384-J3SxzZJh4tkb2bgoUc72zArF45FJ+ngsbiqNsmxqkkecNVpZ/bUHAM0JMp+YPVpx",
}
#: Files of its runtime.
RUNTIME = ("pyodide.mjs", "pyodide.asm.js", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")
#: Folders of an earlier explorer that the command replaces.
WRITTEN = ("app", "static", "pyodide", "drawings")
#: Packages of this environment that the page imports in a browser.
PACKAGES = (
    "panel", "bokeh", "param", "pyviz-comms", "Jinja2", "MarkupSafe", "PyYAML", "packaging", "tqdm",
    "typing-extensions",
)  # fmt: skip
#: Replacements of packages that the page hardly needs. Panel reads remote tables by the first, or else by
#: pandas, 6 MB and 3 s of imports. The second is not compiled for a browser. Panel uses it to remove unsafe
#: HTML from a few of its texts, such as the position of notices; here HTML is escaped.
_IN_PLACE = {
    "pyodide_http.py": "def patch_all():\n    pass\n",
    "nh3.py": "from html import escape\n\n\ndef clean(html, **options):\n    return escape(html)\n",
}
#: Types of files that an import reads, without tests, browser scripts and compiled parts.
_KINDS = {".py", ".html", ".json", ".css", ".js", ".jinja"}
_LEFT_OUT = {"tests", "dist", "static", "sampledata", "node_modules", "..", "command"}


def sources(name: str) -> Iterator[tuple[str, Path]]:
    """Yield the needed files of an installed package, with their names in the archive."""
    for file in distribution(name).files or ():
        parts = PurePosixPath(file).parts
        wanted = file.suffix in _KINDS and not _LEFT_OUT & {*parts}
        # An import reads its version.
        if file.name == "METADATA" or (wanted and not parts[0].endswith(".dist-info")):
            yield str(file), Path(str(file.locate()))


def own_sources() -> Iterator[tuple[str, Path]]:
    """Yield the files of the core and of the page, and the assets that the page reads."""
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
    """Write the Python packages to one archive, which the browser unpacks."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, file in [*own_sources(), *(pair for each in PACKAGES for pair in sources(each))]:
            # Without file times, so that the same sources give the same archive.
            archive.writestr(zipfile.ZipInfo(name), file.read_bytes(), zipfile.ZIP_DEFLATED, 9)
        for name, text in _IN_PLACE.items():
            archive.writestr(zipfile.ZipInfo(name), text)


def used(lock: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the loaded entries of the lock, with their dependencies."""
    entries, names = lock["packages"], list(pages.COMPILED)
    for name in names:
        names += [each for each in entries[name]["depends"] if each not in names]
    return {name: entries[name] for name in names}


def whole(folder: Path) -> tuple[dict[str, bytes], list[licenses.Licensed]]:
    """Return the loaded files of a Pyodide and their licences. Raise ValueError if a file is missing."""
    path = folder / "pyodide-lock.json"
    if not path.is_file():
        raise ValueError(f"{folder} is not a folder of Pyodide: it has no pyodide-lock.json")
    lock: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    if (found := lock["info"]["version"]) != PYODIDE:
        raise ValueError(f"{folder} has Pyodide {found}, but must have the tested {PYODIDE}: download it")
    entries = used(lock)
    digests = dict.fromkeys(RUNTIME, "") | {each["file_name"]: each["sha256"] for each in entries.values()}
    if missing := [name for name in digests if not (folder / name).is_file()]:
        raise ValueError(f"{folder} has no {', '.join(missing)}: give a whole Pyodide {PYODIDE}")
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
        Folder of the explorer; it must be new, empty, or of an earlier explorer.
    pyodide : str, optional
        Folder of a whole Pyodide, whose needed files are copied, or the address from which browsers
        load it; by default the public address of the tested version.

    Raises
    ------
    ValueError
        If the folder has other files, or the Pyodide is not whole or not of the tested version.
    """
    if folder.exists() and any(folder.iterdir()) and not (folder / "explorer.zip").is_file():
        raise ValueError(f"{folder} has other files in it: name a new folder, or an earlier explorer's")
    parts = [licenses.of_package(name) for name in ("mdr-core", *PACKAGES)]
    address, files = pyodide or PUBLISHED, {}
    if urlsplit(address).scheme not in ("http", "https"):
        files, more = whole(Path(address))
        parts, address = parts + more, "pyodide/"
    # Write nothing before all files are found.
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
    (folder / "LICENSES.txt").write_text(licenses.as_text(parts), encoding="utf-8")
