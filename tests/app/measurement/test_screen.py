"""Layout of the page for measurements: one screen, one column, both themes."""

import itertools
import re

import pytest

from mdr_core.show.figures import ROLES

from ..conftest import READY, Explorer
from ..measuring import shown_number


def test_a_sample_is_one_click_and_all_of_it_is_in_sight(measurement):
    """At 1280 × 720 without scrolling: number, class, curve and residuals; the link has the sample."""
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    measurement.press("Sample: fused silica")
    assert re.fullmatch(r"69\.\d\d GPa", shown_number(measurement, "69"))
    page.get_by_text("The curve is of class (a), constant hardness.").wait_for()
    for place in (".big output", ".classes table", ".of-force canvas", ".of-residual canvas"):
        box = page.locator(place).first.bounding_box()
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= 720, place
    assert page.locator(".big").evaluate("(each) => parseFloat(getComputedStyle(each).fontSize)") >= 30
    measurement.wait("location.search.includes('medium=constant')")
    again = page.url
    page.goto(again)
    shown_number(measurement, "69")
    page.context.grant_permissions(["clipboard-read"])
    measurement.press("Copy")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert re.search(r"E\* = 69\.\d+ ± 0\.\d+ GPa", copied)
    assert re.search(r"constant hardness H\t14\.\d+ ± 0\.\d+ GPa", copied)
    for button, start in (("CSV", "# mdr_core "), ("JSON", '{\n "version": "mdr_core ')):
        with page.expect_download() as download:
            page.get_by_text(button, exact=True).click()
        assert download.value.path().read_text(encoding="utf-8").startswith(start)


def test_a_narrow_window_has_one_column_and_nothing_over_another(measurement):
    """No scrolling sideways; the number, the buttons, the classes and the plots stand below each other."""
    page = measurement.page
    page.set_viewport_size({"width": 390, "height": 800})
    measurement.press("Sample: fused silica")
    shown_number(measurement, "69")
    page.get_by_text("The curve is of class (a), constant hardness.").wait_for()
    for width in (390, 720, 1040, 1100):
        page.set_viewport_size({"width": width, "height": 800})
        measurement.wait("document.documentElement.scrollWidth <= innerWidth")
        places = (".big output", ".second >> nth=-1", ".tools button:visible >> nth=2", ".classes table")
        boxes = [page.locator(place).bounding_box() for place in (*places, ".of-force", ".of-residual")]
        for above, below in itertools.pairwise(boxes):
            assert above["y"] + above["height"] <= below["y"] + 1
        # Both plots are high enough to be read.
        assert boxes[-2]["height"] > 200
        assert boxes[-1]["height"] > 100


LIGHT, DARK = ([ROLES[role][k].lower() for role in ("measured", "elastic")] for k in (0, 1))


DRAWN = """(name) => Bokeh.documents[0].get_model_by_name('force plot').renderers
  .find((each) => each.name === name).glyph[name === 'model' ? 'line_color' : 'fill_color'].value"""


def colours(opened):
    """Colours in which measured samples and the model are drawn."""
    return [opened.page.evaluate(DRAWN, name).lower() for name in ("measured", "model")]


def test_the_figures_are_dark_on_a_first_visit_with_a_dark_system(server, browser):
    """No cookie tells the server."""
    with browser.new_context(color_scheme="dark") as context:
        opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
        opened.press("Sample: fused silica")
        shown_number(opened, "69")
        assert colours(opened) == DARK
        assert opened.page.get_by_role("button", name="Dark", pressed=True).is_visible()
        assert opened.problems == []


def test_dark_is_the_theme_of_both_pages(server, browser):
    """One button as in the explorer: the page, its figures, and what a browser keeps for the next page."""
    with browser.new_context() as context:
        opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
        opened.press("Sample: fused silica")
        shown_number(opened, "69")
        assert colours(opened) == LIGHT
        is_dark = "document.documentElement.classList.contains('dark')"
        for dark, drawn in ((True, DARK), (False, LIGHT), (True, DARK)):
            opened.press("Dark")
            opened.page.get_by_role("button", name="Dark", pressed=dark).wait_for()
            assert opened.page.evaluate(is_dark) is dark
            assert colours(opened) == drawn
            (cookie,) = (each["value"] for each in context.cookies() if each["name"] == "dark")
            assert cookie == str(int(dark))
        opened.goto(server.url)
        assert opened.page.evaluate(is_dark)
        assert opened.problems == []


def test_the_explorer_leads_there_and_back(explorer):
    page = explorer.page
    page.get_by_role("link", name="Fit a measurement").click()
    page.get_by_text("A curve in, E* out").wait_for()
    explorer.press("Sample: gel by AFM")
    shown_number(explorer, "kPa")
    page.get_by_role("link", name="Model of this curve in the explorer").click()
    page.wait_for_function("window.explorer?.idle()")
    assert explorer.field("E*").input_value() == "19.7 kPa"
    # As deep as the curve from first contact on.
    assert explorer.field("d_max").input_value().startswith("138")
    assert explorer.chosen("Shape") == "Paraboloid"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_page_for_measurements_shows_what_will_come_and_then_the_number_above_its_form(
    server, browser, theme
):
    """First no digits that nobody has measured; on a phone the number is above what is asked."""
    held = {"viewport": {"width": 390, "height": 844}, "color_scheme": theme}
    with browser.new_context(**held) as context:
        there = "explorer.all().some((each) => each.matches('.ghost'))"
        explorer = Explorer(context.new_page(), f"{server.url}?fit", there)
        page = explorer.page
        shown = page.locator(".ghost")
        shown.get_by_text("E* = … ± …").wait_for()
        assert not any(letter.isdigit() for letter in shown.locator(".number").inner_text())
        for step in ("Curve:", "Tip:", "Sample:"):
            assert shown.get_by_text(step).is_visible()
        page.get_by_role("button", name="Sample: fused silica").click()
        page.get_by_label("Tip", exact=True).select_option(label="Berkovich or Vickers (cone of 70.3°)")
        page.get_by_label("Sample", exact=True).select_option(index=1)
        number = page.locator(".big output")
        number.wait_for()
        form = page.get_by_label("Tip", exact=True).bounding_box()
        assert number.bounding_box()["y"] < form["y"]
        curve = page.locator(".plots-of-fit").bounding_box()
        assert curve["y"] > form["y"]
        # The samples are drawn in the theme of the browser.
        colour = """() => Bokeh.documents[0].get_model_by_name("force plot").renderers
          .find((each) => each.data_source.name === "measured").glyph.fill_color"""
        wanted = {"light": "#7a4a1e", "dark": "#d8b48a"}[theme]
        drawn = page.evaluate(colour)
        assert (drawn.get("value", drawn) if isinstance(drawn, dict) else drawn) == wanted
        assert explorer.problems == []
