"""The folder of the explorer: its files, its sources, the copied Pyodide, and licences."""

import hashlib
import json
import os
import re
import subprocess
import sys
import zipfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import urlopen

import numpy
import pytest
import scipy

import mdr_explorer
from app.explorer import theory
from mdr_explorer import static

from ..conftest import ROOT
from .conftest import DRAWN


def settings(folder):
    """What the start of the page is told."""
    (text,) = re.findall(r"const settings = (.*)", (folder / "index.html").read_text(encoding="utf-8"))
    return json.loads(text)


def integrity(folder):
    """Digests of scripts from elsewhere, by which a browser refuses others."""
    index = (folder / "index.html").read_text(encoding="utf-8")
    (text,) = re.findall(r'<script type="importmap">(.*)</script>', index)
    return json.loads(text)["integrity"]


class Links(HTMLParser):
    """Files that a page asks for."""

    def __init__(self, page):
        super().__init__()
        self.found = set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        # Where a person may go is no part of the page.
        if not (tag == "a" and dict(attributes).get("href", "").startswith("http")):
            self.found |= {value for name, value in attributes if name in ("src", "href")}


def test_the_folder_has_all_that_its_pages_ask_for_and_names_one_other_address(written):
    folder, said = written
    told = settings(folder)
    assert {path.relative_to(folder).as_posix() for path in folder.rglob("*.html")} == {
        "index.html", "theory.html", "measurement.html", "app/theory.html",
        *(f"drawings/{name}.html" for name in told["presets"]),
    }  # fmt: skip
    assert {*DRAWN} <= {*told["presets"]}
    for page in folder.rglob("*.html"):
        if page.parent.name == "drawings" and page.stem not in DRAWN:
            continue
        local = {link for link in Links(page).found if not link.startswith(("data:", "#", "?"))}
        assert local or page.name == "measurement.html"
        missing = [link for link in local if not (page.parent / link.split("?")[0]).is_file()]
        assert missing == [], page.name
    assert [name for name in told["scripts"] if not (folder / name).is_file()] == []
    assert told["pyodide"] == static.PUBLISHED
    assert static.PUBLISHED in said
    assert static.PYODIDE in static.PUBLISHED
    assert integrity(folder) == {static.PUBLISHED + name: each for name, each in static.INTEGRITY.items()}
    assert not (folder / "pyodide").exists()
    # Some MB besides the runtime, of the hundred that Panel has. Of the drawings one is loaded.
    sizes = {path: path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    drawings = [size for path, size in sizes.items() if path.parent.name == "drawings"]
    assert sum(sizes.values()) - sum(drawings) < 10e6
    assert max(drawings) < 1e6


def test_scripts_and_sheets_are_those_of_the_served_page_in_its_order(written, server):
    """By their names; icons of warnings are not shown by a notice of the page."""

    def names(pattern, text):
        return [Path(each).name for each in re.findall(pattern, text)]

    sheet, served = r'<link rel="stylesheet" href="([^"?]*)', urlopen(server.url).read().decode()
    scripts = names(r'<script[^>]* src="([^"?]*)', served)
    assert [Path(each).name for each in settings(written[0])["scripts"]] == scripts
    own = names(sheet, (written[0] / "index.html").read_text(encoding="utf-8"))
    assert own == [name for name in names(sheet, served) if name != "all.min.css"]


def test_the_theory_is_the_served_one_with_a_place_for_each_equation(written):
    text = (written[0] / "app/theory.html").read_text(encoding="utf-8")
    assert theory.html() in text
    assert 'id="eq-11"' in text
    assert 'id="section-4"' in text


def test_the_sources_suffice_for_the_page_beside_what_is_compiled(written, tmp_path):
    """The page of a link starts with NumPy and SciPy alone, and every root of it has a place."""
    sources, compiled = tmp_path / "sources", tmp_path / "compiled"
    with zipfile.ZipFile(written[0] / "explorer.zip") as archive:
        archive.extractall(sources)
        names = archive.namelist()
    assert len({*names}) == len(names)
    assert not [name for name in names if name.endswith((".so", ".pyd")) or "/tests/" in name]
    compiled.mkdir()
    for package in (numpy, scipy):
        path = Path(package.__file__).parent
        for each in path.parent.glob(f"{path.name}*"):
            if each.name in (path.name, f"{path.name}.libs"):
                (compiled / each.name).symlink_to(each)
    # Where Panel finds its style sheets and scripts.
    script = (ROOT / "mdr_explorer/static.js").read_text(encoding="utf-8")
    places = dict(re.findall(r'(PANEL_\w+): here\("([^"]+)"\)', script))
    assert len(places) == 2
    environment = os.environ | {name: f"http://here/{path}" for name, path in places.items()}
    environment["PYTHONPATH"] = os.pathsep.join(map(str, (sources, compiled)))
    run = [sys.executable, "-S", Path(__file__).with_name("simulated.py"), "max_depth=5e-9"]
    done = subprocess.run(run, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    # The page, what it tells the browser beside it, and the address.
    assert {"app.common.ui.Messages", "panel.models.location.Location"} <= {*found["roots"]}
    assert found["places"] == len(found["roots"])
    assert "5.000 nm" in found["text"]
    # Each style sheet is a file of the folder, and no other host is asked.
    asked = set(re.findall(r"https?://[^\s\"'`\\)]+", found["text"]))
    here = {urlsplit(url).path[1:] for url in asked if urlsplit(url).hostname == "here"}
    assert here
    assert [path for path in here if not (written[0] / path).is_file()] == []
    assert [url for url in asked if urlsplit(url).hostname != "here"] == []


def wheel(path, name, version, licence="Do what you like."):
    with zipfile.ZipFile(path, "w") as file:
        info = f"{name}-{version}.dist-info"
        text = f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nLicense: MIT\n"
        file.writestr(f"{info}/METADATA", text)
        if licence:
            file.writestr(f"{info}/LICENSE.txt", licence)


@pytest.fixture
def pyodide(tmp_path):
    """A folder that looks like Pyodide, of the tested version, with more than is needed."""
    folder = tmp_path / "pyodide"
    folder.mkdir()
    for name in static.RUNTIME:
        (folder / name).write_text(name)
    wheel(folder / "numpy.whl", "numpy", "2.0.2")
    wheel(folder / "scipy.whl", "scipy", "1.14.1", "Only on Sundays.")
    wheel(folder / "pandas.whl", "pandas", "2.2.3")
    (folder / "openblas.zip").write_bytes(b"compiled")
    files = {"numpy": "numpy.whl", "scipy": "scipy.whl", "openblas": "openblas.zip", "pandas": "pandas.whl"}
    packages = {
        name: {
            "file_name": file,
            "version": {"numpy": "2.0.2", "scipy": "1.14.1", "openblas": "0.3.26"}.get(name, "2.2.3"),
            "depends": ["numpy", "openblas"] if name == "scipy" else [],
            "sha256": hashlib.sha256((folder / file).read_bytes()).hexdigest(),
        }
        for name, file in files.items()
    }
    info = {"version": static.PYODIDE, "python": "3.12.7", "platform": "emscripten_3_1_58"}
    (folder / "pyodide-lock.json").write_text(json.dumps({"info": info, "packages": packages}))
    return folder


def test_what_is_loaded_of_pyodide_is_copied_with_its_licences_as_its_lock_names_it(
    pyodide, tmp_path, monkeypatch
):
    """And no more. Each module belongs to a package, but for what stands in the place of others."""
    # Drawings of presets take most of the time, and are not looked at.
    monkeypatch.setattr("app.explorer.extras.scene_file.scene_file", lambda view, bokeh: "")
    folder = tmp_path / "site"
    static.write(folder, str(pyodide))
    copied = {path.name for path in (folder / "pyodide").iterdir()}
    assert copied == {*static.RUNTIME, "numpy.whl", "scipy.whl", "openblas.zip"}
    lock = json.loads((folder / "pyodide/pyodide-lock.json").read_text())
    for entry in lock["packages"].values():
        path = folder / "pyodide" / entry["file_name"]
        assert not path.exists() or hashlib.sha256(path.read_bytes()).hexdigest() == entry["sha256"]
    assert settings(folder)["pyodide"] == "pyodide/"
    text = (folder / "LICENSES.txt").read_text(encoding="utf-8")
    heads = set(re.findall(r"^-{80}\n(\S.*?) (\S+): (.+)$", text, re.MULTILINE))
    told = {(name.lower().replace("_", "-"), version) for name, version, _ in heads}
    with zipfile.ZipFile(folder / "explorer.zip") as archive:
        inside = [name for name in archive.namelist() if name.endswith(".dist-info/METADATA")]
        packages = {tuple(name.split("/")[0].removesuffix(".dist-info").rsplit("-", 1)) for name in inside}
        tops = {name.split("/")[0].removesuffix(".py") for name in archive.namelist()}
    found = {(name.lower().replace("_", "-"), version) for name, version in packages}
    found |= {("numpy", "2.0.2"), ("scipy", "1.14.1"), ("openblas", "0.3.26"), ("pyodide", static.PYODIDE)}
    assert found <= told
    assert len(packages) == len(static.PACKAGES) + 1
    assert {"panel", "bokeh", "yaml", "app"} <= tops
    # Scripts that come with Panel.
    others = {name for name, _ in told - found}
    assert others == {"python", "emscripten", "es-module-shims", "notyf", "katex", "font awesome free"}
    assert "Only on Sundays." in text
    assert "Mozilla Public License" in text
    assert ("Pyodide", static.PYODIDE, "MPL-2.0") in heads


def test_a_pyodide_that_is_not_whole_or_was_changed_is_refused_in_words(pyodide, tmp_path):
    """Also one of another version, and a package without its licence."""

    def refused(why):
        with pytest.raises(ValueError, match=why):
            static.write(tmp_path / "other", str(pyodide))

    wheel(pyodide / "numpy.whl", "numpy", "2.0.2", licence="")
    lock = json.loads((pyodide / "pyodide-lock.json").read_text())
    digest = hashlib.sha256((pyodide / "numpy.whl").read_bytes()).hexdigest()
    lock["packages"]["numpy"]["sha256"] = digest
    (pyodide / "pyodide-lock.json").write_text(json.dumps(lock))
    refused("licence of numpy")
    with (pyodide / "scipy.whl").open("ab") as file:
        file.write(b".")
    refused("scipy.whl .* SHA-256")
    (pyodide / "pyodide.asm.wasm").unlink()
    refused(r"pyodide\.asm\.wasm")
    path = pyodide / "pyodide-lock.json"
    path.write_text(path.read_text().replace(static.PYODIDE, "0.28.0"))
    refused(f"0.28.0.*{static.PYODIDE}")
    path.unlink()
    refused("pyodide-lock.json")


def test_a_folder_with_something_else_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("all of it")
    with pytest.raises(SystemExit, match="other files"):
        mdr_explorer.main(["--static", str(tmp_path)])
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]
