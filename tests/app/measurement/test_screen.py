"""Layout of the page for measurements: one screen, one column, both themes."""

import itertools
import re

from mdr_core.show.figures import ROLES

from ..conftest import Explorer
from ..measuring import shown_number


def test_a_sample_is_one_click_and_all_of_it_is_in_sight_in_any_window(measurement):
    """At 1280 × 720 without scrolling: number, class, curve and residuals; the link has the sample.

    In a narrow window all is in one column, and nothing scrolls sideways.
    """
    page = measurement.page
    page.set_viewport_size({"width": 1280, "height": 720})
    measurement.press("Sample: fused silica")
    assert re.fullmatch(r"69\.\d\d GPa", shown_number(measurement, "69"))
    page.get_by_text("The curve is of class (a)").wait_for()
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
    page.get_by_text("The curve is of class (a)").wait_for()
    for width in (1100, 1040, 720, 390):
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


def test_on_a_phone_the_number_is_above_the_form_and_dark_is_the_theme_of_both_pages(server, browser):
    """First no digits that nobody has measured; no cookie tells the server the theme of the system.

    One button as in the explorer: the page, its figures, and what a browser keeps for the next page.
    """
    held = {"viewport": {"width": 390, "height": 844}, "color_scheme": "dark"}
    with browser.new_context(**held) as context:
        there = "explorer.all().some((each) => each.matches('.ghost'))"
        opened = Explorer(context.new_page(), f"{server.url}?fit", there)
        page = opened.page
        shown = page.locator(".ghost")
        shown.get_by_text("E* = … ± …").wait_for()
        assert not any(letter.isdigit() for letter in shown.locator(".number").inner_text())
        for step in ("Curve:", "Tip:", "Sample:"):
            assert shown.get_by_text(step).is_visible()
        opened.press("Sample: fused silica")
        shown_number(opened, "69")
        form, curve = page.get_by_label("Tip", exact=True), page.locator(".plots-of-fit")
        assert page.locator(".big output").bounding_box()["y"] < form.bounding_box()["y"]
        assert curve.bounding_box()["y"] > form.bounding_box()["y"]
        assert colours(opened) == DARK
        assert page.get_by_role("button", name="Dark", pressed=True).is_visible()
        is_dark = "document.documentElement.classList.contains('dark')"
        for dark, drawn in ((False, LIGHT), (True, DARK), (False, LIGHT)):
            opened.press("Dark")
            page.get_by_role("button", name="Dark", pressed=dark).wait_for()
            assert page.evaluate(is_dark) is dark
            assert colours(opened) == drawn
            (cookie,) = (each["value"] for each in context.cookies() if each["name"] == "dark")
            assert cookie == str(int(dark))
        opened.goto(server.url)
        assert not page.evaluate(is_dark)
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
