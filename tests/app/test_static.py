"""The explorer as a folder of files: its contents, its sources, the first picture, and Pyodide."""

import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import threading
import zipfile
from contextlib import contextmanager
from functools import partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit
from urllib.request import urlopen

import numpy
import pytest
import scipy

import mdr_explorer
from app.common.host import Sliced
from app.explorer import readouts
from app.explorer.page import Page
from app.explorer.state import PRESETS, preset_state
from mdr_explorer import static

from .conftest import DROP, ELASTIC, GOLD, PUNCH, ROOT, Explorer
from .states import assert_draws


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The folder with a runtime from elsewhere, and what the command says."""
    folder = tmp_path_factory.mktemp("static") / "explorer"
    code = "import mdr_explorer; mdr_explorer.main()"
    run = [sys.executable, "-c", code, "--static", folder]
    done = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=True)
    return folder, done.stdout


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
    for page in folder.rglob("*.html"):
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
    # Some MB besides the runtime, of the hundred that Panel has. Half are drawings; one is loaded.
    sizes = {path: path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    assert sum(sizes.values()) < 15e6
    assert max(size for path, size in sizes.items() if path.parent.name == "drawings") < 1e6


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
    from app.explorer import theory

    assert theory.html() in text
    assert 'id="eq-11"' in text
    assert 'id="section-4"' in text


HERE = Path(__file__).parent


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
    run = [sys.executable, "-S", HERE / "simulated.py", "max_depth=5e-9"]
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


@pytest.fixture
def without_drawings(monkeypatch):
    """Drawings of presets take most of the time in which a folder is written, and are not looked at."""
    monkeypatch.setattr("app.explorer.extras.scene_file.scene_file", lambda view, bokeh: "")


def test_what_is_loaded_of_pyodide_is_copied_as_its_lock_names_it(pyodide, tmp_path, without_drawings):
    """And no more; what is not whole, was changed, or is of another version is refused in words."""
    folder = tmp_path / "site"
    static.write(folder, str(pyodide))
    copied = {path.name for path in (folder / "pyodide").iterdir()}
    assert copied == {*static.RUNTIME, "numpy.whl", "scipy.whl", "openblas.zip"}
    lock = json.loads((folder / "pyodide/pyodide-lock.json").read_text())
    for entry in lock["packages"].values():
        path = folder / "pyodide" / entry["file_name"]
        assert not path.exists() or hashlib.sha256(path.read_bytes()).hexdigest() == entry["sha256"]
    assert settings(folder)["pyodide"] == "pyodide/"
    # Another time in the same place.
    static.write(folder)
    assert not (folder / "pyodide").exists()

    def refused(why):
        with pytest.raises(ValueError, match=why):
            static.write(tmp_path / "other", str(pyodide))

    with (pyodide / "scipy.whl").open("ab") as file:
        file.write(b".")
    refused("scipy.whl .* SHA-256 differs")
    (pyodide / "pyodide.asm.wasm").unlink()
    refused(r"pyodide\.asm\.wasm.* give a whole Pyodide")
    path = pyodide / "pyodide-lock.json"
    path.write_text(path.read_text().replace(static.PYODIDE, "0.28.0"))
    refused(f"has Pyodide 0.28.0.*{static.PYODIDE}")
    path.unlink()
    refused("it has no pyodide-lock.json")


def test_a_folder_with_something_else_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("all of it")
    with pytest.raises(SystemExit, match="has other files in it"):
        mdr_explorer.main(["--static", str(tmp_path)])
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_licences_of_all_that_is_in_the_folder_are_in_it(pyodide, tmp_path, without_drawings):
    folder = tmp_path / "site"
    static.write(folder, str(pyodide))
    text = (folder / "LICENSES.txt").read_text(encoding="utf-8")
    heads = set(re.findall(r"^-{80}\n(\S.*?) (\S+): (.+)$", text, re.MULTILINE))
    told = {(name.lower().replace("_", "-"), version) for name, version, _ in heads}
    with zipfile.ZipFile(folder / "explorer.zip") as archive:
        inside = [name for name in archive.namelist() if name.endswith(".dist-info/METADATA")]
        packages = {tuple(name.split("/")[0].removesuffix(".dist-info").rsplit("-", 1)) for name in inside}
        # Each module belongs to one of them, but for what stands in the place of others.
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
    wheel(pyodide / "numpy.whl", "numpy", "2.0.2", licence="")
    lock = json.loads((pyodide / "pyodide-lock.json").read_text())
    digest = hashlib.sha256((pyodide / "numpy.whl").read_bytes()).hexdigest()
    lock["packages"]["numpy"]["sha256"] = digest
    (pyodide / "pyodide-lock.json").write_text(json.dumps(lock))
    with pytest.raises(ValueError, match="no text of the licence of numpy"):
        static.write(folder, str(pyodide))


@contextmanager
def host(folder):
    """The address of a folder from a host of files."""

    class Files(SimpleHTTPRequestHandler):
        def log_message(self, *arguments):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Files, directory=folder))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()
    thread.join()


class Slow(Sliced):
    """A browser whose turns are taken by hand."""

    def __init__(self):
        self.turns = []

    def shows(self):
        return False

    def next_tick(self, act):
        self.turns.append(act)

    def search(self, steps, wanted, done):
        self.next_tick(lambda: self.make(steps, wanted, done))

    def turn(self):
        self.turns.pop(0)()


def test_a_sweep_is_found_in_slices_and_a_press_makes_the_one_before_void(monkeypatch):
    """The page is pressed while a sweep is being found: that one is never shown, the next one is."""
    # Each step is a slice.
    monkeypatch.setattr("app.common.host._SLICE", 0.0)
    host = Slow()
    # A ball: its sweep is not found at every move, and has lines of other classes of hardness.
    page = Page("preset=ball-glass_epoxy&tiles=sweep", host=host)

    def note():
        return page.view.computed["sweep"].note

    page._input_rests()
    assert note() == "computing …"
    host.turn()
    host.turn()
    assert note() == "computing …"
    assert host.turns
    page.apply(lambda state: state.replace(max_depth=0.9 * state.max_depth))
    page._input_rests()
    # What goes on of the first one ends with the next turn, and nothing is shown of it.
    turns = 0
    while host.turns:
        host.turn()
        turns += 1
    assert turns > 4
    at_once = Page("preset=ball-glass_epoxy&tiles=sweep")
    at_once.apply(lambda state: state.replace(max_depth=0.9 * state.max_depth))
    at_once._input_rests()
    expected = at_once.view.computed["sweep"]
    assert page.view.computed["sweep"].note == expected.note
    for name, columns in expected.rows.items():
        # Places, without the text of a label.
        for mine, theirs in zip(page.view.computed["sweep"].rows[name][:2], columns[:2], strict=True):
            numpy.testing.assert_allclose(mine, theirs, rtol=1e-12)


@pytest.fixture(scope="module")
def started(browser, written):
    """Opens a link to the page, without Python: the drawings that it asks for, and the page itself."""
    with (
        host(written[0]) as address,
        browser.new_context(viewport={"width": 1280, "height": 720}) as context,
    ):
        # Not answered: the page waits.
        context.route(f"{static.PUBLISHED}**", lambda route: None)

        def start(query):
            page, asked = context.new_page(), []
            page.on("request", lambda request: asked.append(request.url))
            page.goto(address + query)
            page.frame_locator("#start iframe").locator("#player input").wait_for()
            return [Path(url).stem for url in asked if "/drawings/" in url], page

        yield start
        context.unroute_all(behavior="ignoreErrors")


#: Links to a preset as it is, and what follows on its name: nothing, a theme, what other sites append.
AS_IT_IS = {
    "": GOLD, f"?preset={PUNCH}": PUNCH, f"?preset={DROP}&dark=1": DROP,
    f"?utm_source=course&preset={ELASTIC}&fbclid=I": ELASTIC,
}  # fmt: skip


@pytest.mark.parametrize("query", AS_IT_IS)
def test_a_preset_is_drawn_at_once_and_plays(query, started):
    """And no drawing of another one is loaded."""
    preset = AS_IT_IS[query]
    asked, page = started(query)
    assert asked == [preset]
    drawing = page.frame_locator("#start iframe")
    assert drawing.locator("h1").inner_text() == PRESETS[preset].label
    view = Page(f"preset={preset}").view
    numbers = readouts.line(view.course)
    each = next(iter(numbers))
    expected = readouts.text(each, numbers[each], view.course.now)
    readout = drawing.locator(f'output[data-name="{each.name}"]')
    assert readout.inner_text() == expected
    drawing.locator("#player input").press("Home")
    assert readout.inner_text() != expected
    assert page.locator("#start .follows").count() == 0
    dark = "document.documentElement.classList.contains('dark')"
    assert page.evaluate(dark) == page.frames[1].evaluate(dark) == ("dark=1" in query)
    page.close()


#: Links to other scenes, and some that the page will refuse.
OTHERS = (
    f"?preset={PUNCH}&max_depth=5e-5", "?tiles=hardness", "?preset=none", "?preset=../theory",
    f"?preset={PUNCH}&preset={DROP}", "?preset=",
)  # fmt: skip


@pytest.mark.parametrize("query", OTHERS)
def test_another_scene_is_announced_over_the_opening_one(query, started):
    """That one is dimmed, and neither played nor read aloud: its numbers are not those of the link."""
    asked, page = started(query)
    assert asked == [GOLD]
    assert page.get_by_text("Your scene follows").is_visible()
    drawing = page.locator("#start iframe")
    assert float(drawing.evaluate("(each) => getComputedStyle(each).opacity")) < 0.5
    box = drawing.bounding_box()
    page.mouse.click(box["x"] + 60, box["y"] + 100)
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.localName") != "iframe"
    page.close()


def test_what_does_not_start_announces_no_scene(started):
    _, page = started(OTHERS[0])
    page.route(f"{static.PUBLISHED}**", lambda route: route.abort())
    page.reload()
    page.get_by_role("alert").filter(has_text="could not be started").wait_for()
    assert page.get_by_text("Your scene follows").count() == 0
    page.close()


@pytest.fixture(scope="module")
def real():
    """The folder of a whole Pyodide."""
    if not (pyodide := os.environ.get("MDR_PYODIDE")):
        pytest.skip("the page in a browser needs a whole Pyodide: its folder as MDR_PYODIDE")
    return Path(pyodide)


def test_digests_are_those_of_the_published_scripts(real):
    """From another package than the one whose digests are written down."""
    for name, told in static.INTEGRITY.items():
        digest = hashlib.sha384((real / name).read_bytes()).digest()
        assert told == f"sha384-{base64.b64encode(digest).decode()}", name


@pytest.fixture(scope="module")
def hosted(browser, real, tmp_path_factory):
    """The address of a folder with a whole Pyodide, from a host of files."""
    folder = tmp_path_factory.mktemp("hosted") / "explorer"
    static.write(folder, str(real))
    with host(folder) as address:
        yield address


#: Once the page has taken the place of the first picture, for a busy machine.
STARTED, PATIENCE = "!document.getElementById('start') && window.explorer?.idle()", 300_000


class Static(Explorer):
    """The page without a server, which takes longer to start."""

    def __init__(self, page, url):
        super().__init__(page, url, "true")
        page.set_default_timeout(PATIENCE)
        self.missing = []
        page.on("response", self._answered)

    def _answered(self, answer):
        if answer.status >= 400:
            self.missing.append(answer.url)

    def wait(self, condition, arg=None):
        self.page.wait_for_function(condition, arg=arg)


#: Presets that are compared with the library, of drives and shapes that differ, with their labels.
SCENES = {name: PRESETS[name].label for name in (ELASTIC, PUNCH, DROP, "microsphere-pdms", "ball-steel")}


def test_the_page_in_a_browser_by_pyodide(hosted, browser, tmp_path):
    """A first picture that moves, then scenes against the library, and what a person does, on one page."""
    with browser.new_context(viewport={"width": 1280, "height": 720}) as context:
        explorer = Static(context.new_page(), hosted)
        page = explorer.page
        first = page.frame_locator("#start iframe")
        slider = first.locator("#player input")
        before = first.locator("#readout").inner_text()
        slider.press("Home")
        assert first.locator("#readout").inner_text() != before
        assert page.get_by_role("status").inner_text().endswith("…")
        page.wait_for_function(STARTED)
        assert_draws(explorer, preset_state())
        assert explorer.readout("force") == "4.514 µN"

        # Keys and the address.
        explorer.slider("d_max").press("ArrowRight")
        explorer.wait("location.search.includes('max_depth=')")
        (depth,) = parse_qsl(urlsplit(page.url).query)
        assert_draws(explorer, preset_state().replace(max_depth=float(depth[1])))
        explorer.change(explorer.press, "Undo")
        assert page.url == hosted

        # Five scenes.
        for name, label in SCENES.items():
            explorer.choose("Preset", label)
            assert_draws(explorer, preset_state(name))
        # One with a search: a sweep, and the exact course of an impact in time.
        explorer.choose("Preset", SCENES[DROP])
        explorer.press("e over v")
        explorer.wait("explorer.row('sweep', 'this scene')?.[0].length > 10")
        speed, e = explorer.row("sweep", "this scene")
        state = preset_state(DROP)
        (_, hit), (at, now) = (speed, e), explorer.row("sweep", "present value")
        assert hit.min() <= now[0] <= hit.max()
        assert at[0] == pytest.approx(state.speed, rel=1e-6)

        # Saving, a file, the dark, compare.
        with page.expect_download() as download:
            explorer.press("Save plots")
        assert download.value.path().read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
        explorer.press("Share")
        with page.expect_download() as download:
            explorer.press("Curves (CSV)")
        assert download.value.suggested_filename == f"{DROP}_curves.csv"
        assert "Paraboloid" in download.value.path().read_text(encoding="utf-8")
        link = page.get_by_label("Link to this page").input_value()
        assert link.startswith(hosted + "?")
        explorer.press("Share")
        explorer.change(explorer.press, "Compare")
        explorer.press("Dark")
        page.wait_for_function("document.documentElement.classList.contains('dark')")

        # A tip of one's own.
        explorer.choose("Preset", SCENES[PUNCH])
        page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
        tip = {"name": "tip.csv", "mimeType": "", "buffer": b"r (nm), z (nm)\n0, 0\n100, 5\n200, 20\n"}
        page.get_by_label("CSV file of a measured tip: r, z").set_input_files(tip)
        explorer.wait("location.search.includes('samples=')")

        # The link that was shared, in another page; what is served beside the explorer is a file.
        page.goto(link + "&foo=1")
        page.wait_for_function(STARTED)
        page.locator(".notyf__message", has_text="Unknown names in this link are ignored: foo").wait_for()
        assert explorer.chosen("Fourth plot") == "Sweep"
        assert page.locator("#start").count() == 0
        for earlier in ("?theory=eq-11", "theory.html?theory=eq-11"):
            page.goto(hosted + earlier)
            page.wait_for_function("document.querySelector('math')")
            page.wait_for_function("document.documentElement.scrollTop > 0")
            assert page.url == f"{hosted}app/theory.html#eq-11"
        page.goto(hosted + "?fit")
        page.get_by_text("pip install").wait_for()
        assert explorer.problems == []
        assert explorer.missing == []
