"""What leaves the page and comes back, and how it is used: files, links, keys, narrow and dark."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from app.state import Explorer as State

from .conftest import CHROMIUM
from .test_page import DROP, FIGURES, assert_draws, now

# Where the browser is required its absence is a failure.
pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required",
    reason="the page's tests need Chromium; set CHROMIUM to its path",
)


def test_csv_and_scene_files_agree_with_the_library(explorer):
    explorer.choose("Shape", "Sphere")
    path = explorer.take("Curves as CSV")
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    scene = mdr.Scene.from_json(explorer.take("Scene as JSON").read_text(encoding="utf-8"))
    expected = mdr.indent(scene.profile, scene.medium, rows[:, 0])
    np.testing.assert_allclose(rows[:, 1], expected.force, rtol=1e-9, atol=1e-12 * rows[:, 1].max())
    path = explorer.take("Pressure as CSV")
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    np.testing.assert_allclose(-rows[1:, 1], scene.solve().pressure(rows[1:, 0]), rtol=1e-9)


def test_python_snippet_runs_and_gives_what_is_read(explorer):
    explorer.menu("Copy as Python")
    text = explorer.page.locator("dialog textarea").input_value()
    scope = {}
    exec(text, scope)
    assert f"{scope['state'].force * 1e6:.3f} µN" == explorer.readout("F")
    explorer.page.get_by_role("button", name="Close").click()
    assert explorer.page.locator("dialog").count() == 0


def test_plots_are_saved_with_title_and_legend(explorer):
    for figure in FIGURES:
        picture = explorer.save(figure, "PNG").read_bytes()
        assert picture[:8] == b"\x89PNG\r\n\x1a\n"
        width, height = (int.from_bytes(picture[at : at + 4], "big") for at in (16, 20))
        assert width > 400
        assert height > 250
        drawing = explorer.drawing(figure)
        tile = explorer.page.locator(f'[data-plot="{figure}"]')
        assert tile.locator("h3").inner_text() in drawing
        assert all(name in drawing for name in tile.locator(".legend li:visible").all_inner_texts())


def test_link_opens_the_same_page(explorer):
    explorer.choose("Preset", DROP)
    explorer.choose("Shape", "Hyperboloid")
    explorer.page.wait_for_function("location.search.includes('hyperboloid')")
    explorer.page.goto(explorer.page.url)
    explorer.page.wait_for_function("explorer.idle()")
    state = State(DROP)
    state.choose("shape", "hyperboloid")
    assert_draws(explorer, state)
    assert explorer.field("v_0").input_value() == "1 m/s"


def test_tampered_link_opens_the_page_with_a_message(explorer):
    explorer.page.wait_for_function("location.search.includes('cone_slope')")
    bad = explorer.page.url.replace("cone_slope=0.358", "cone_slope=<img src=x onerror=alert(1)>")
    explorer.page.goto(bad)
    explorer.page.wait_for_function("explorer.idle()")
    assert "link was not opened" in explorer.page.locator(".notice").first.inner_text()
    assert explorer.page.locator("main img:not([alt])").count() == 0
    assert_draws(explorer, State())


def test_files_are_brought_and_bad_ones_refused(explorer, tmp_path):
    tip = tmp_path / "tip.csv"
    tip.write_text("r (nm), z (nm)\n0, 0\n10, 1\n20, 3\n40, 12\n80, 40\n", encoding="utf-8")
    with explorer.change():
        explorer.bring("Load a tip", tip)
    tip_profile = mdr.Sampled.from_csv(tip)
    state = State()
    state.upload((tip_profile.r, tip_profile.z))
    assert_draws(explorer, state)
    scene = tmp_path / "scene.json"
    scene.write_text(
        mdr.Scene(mdr.Cone(0.5), mdr.Medium(2e9, 5.0), mdr.DepthPath(5e-9)).to_json(), encoding="utf-8"
    )
    with explorer.change():
        explorer.bring("Load a scene", scene)
    assert explorer.field("s").input_value() == "0.5"
    kept = now(explorer)
    bad = tmp_path / "bad.csv"
    for count, text in enumerate(
        ("<b>no</b>", "r (nm), z (nm)\n0 0\n1 9\n2 10\n", "x" * 2_100_000), start=1
    ):
        bad.write_text(text, encoding="utf-8")
        explorer.bring("Load a tip", bad)
        explorer.page.wait_for_function("(n) => explorer.notices() >= n", arg=count)
    assert now(explorer) == kept


def test_keys_hold_undo_reset_and_switch(explorer):
    page = explorer.page
    page.locator("h1").click()
    page.keyboard.press("h")
    page.wait_for_function("explorer.column('force', 'held', 'x').length > 10")
    assert "Cone, s = 0.358" in page.locator(".toolbar .note").inner_text()
    with explorer.change():
        explorer.type("d_max", "5 nm")
    page.locator("h1").click()
    with explorer.change():
        page.keyboard.press("z")
    assert_draws(explorer, State())
    with explorer.change():
        page.keyboard.press("y")
    assert now(explorer)[0] == pytest.approx(5e-9)
    with explorer.change():
        page.keyboard.press("r")
    assert_draws(explorer, State())
    page.keyboard.press("m")
    page.wait_for_function("explorer.figure('map') !== undefined && explorer.idle()")
    page.wait_for_function("explorer.column('map', 'image', 'image')[0].length > 1000")
    assert max(explorer.column("map", "image", "image")[0]) > 5
    page.keyboard.press("d")
    page.wait_for_function("explorer.figure('force').background_fill_color === '#181b20'")
    assert page.locator("main.dark").count() == 1


def test_narrow_page_needs_no_sideways_scrolling_and_people_do_not_disturb_each_other(
    explorer, server, context
):
    page = context.new_page()
    page.set_viewport_size({"width": 400, "height": 800})
    other = type(explorer)(page, server.url)
    with other.change():
        other.type("d_max", "30")
    assert now(other)[0] == pytest.approx(30e-9)
    assert_draws(explorer, State())
    assert page.evaluate("document.documentElement.scrollWidth <= 400")
    assert other.problems == []
    page.close()


def test_everything_can_be_reached_and_is_named(explorer):
    unnamed = explorer.page.evaluate(
        """() => [...explorer.main().querySelectorAll("input, select, button, textarea")]
           .filter((node) => !(node.getAttribute("aria-label") || node.textContent || node.labels?.length))
           .map((node) => node.outerHTML)"""
    )
    assert unnamed == []
    explorer.page.locator("h1").click()
    explorer.page.keyboard.press("Tab")
    tag = explorer.page.evaluate("explorer.main().getRootNode().activeElement.tagName")
    assert tag in ("SELECT", "INPUT", "BUTTON", "SUMMARY")


def test_scene_file_from_the_page_is_json(explorer):
    data = json.loads(explorer.take("Scene as JSON").read_text(encoding="utf-8"))
    assert data["profile"] == {"type": "Cone", "slope": 0.358}
