"""The page in a browser by Pyodide. It needs a whole one, the folder `MDR_PYODIDE`; .ci/static gets one."""

import base64
import hashlib
import os
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit

import pytest

from app.explorer.state import PRESETS, preset_state
from mdr_explorer import static

from ..conftest import DROP, ELASTIC, PUNCH, Explorer
from ..states import assert_draws
from .conftest import host_of


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
    with host_of(folder) as address:
        yield address


#: Once the page has taken the place of the first picture, for a busy machine.
STARTED, PATIENCE = "!document.getElementById('start') && window.explorer?.idle()", 300_000
#: Presets that are compared with the library, of drives and shapes that differ, with their labels.
SCENES = {name: PRESETS[name].label for name in (ELASTIC, PUNCH, DROP, "microsphere-pdms", "ball-steel")}


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
