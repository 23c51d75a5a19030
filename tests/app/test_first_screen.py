"""The first screen: how much there is to click, and how large plots are; zoom, springs, compared scenes."""

import re
from pathlib import Path

import numpy as np
import pytest

from ..approx import approx
from .conftest import DROP, Explorer

CLICKABLE = Path(__file__).with_name("clickable.js").read_text(encoding="utf-8")
#: Pixels within the axes, below which a plot is not read from the back of a room.
LEAST = 150


@pytest.fixture
def projector(server, context):
    """The page on a projector."""
    explorer = Explorer(context.new_page(), server.url, window=(1280, 720))
    yield explorer
    assert explorer.problems == []
    explorer.page.close()


def heights(explorer, *names):
    return [explorer.page.evaluate(f"explorer.model('{name}').inner_height") for name in names]


def test_there_are_some_forty_things_to_click(projector):
    found = projector.page.evaluate(CLICKABLE)
    # The plots, which are dragged, are among them; the link to them is seen only while it has the focus.
    assert sum("bk-events" in name for name in found) == 3
    assert len(found) <= 40, "\n".join(found)
    # What the three views need is among them.
    for part in ("depth", "force", "impact", "Shape", "Hardness", "q_c, yield constant, slider", "▶ Play"):
        assert any(part in name for name in found), part


def test_plots_of_a_projector_are_at_least_150_pixels_high(projector):
    """With optional plots of an impact, too; a further one takes the place of the last."""
    assert min(heights(projector, "springs", "pressure", "force")) >= LEAST
    projector.goto(f"{projector.page.url.split('?')[0]}?preset={DROP}&tiles=sweep+energy+motion")
    cards = projector.page.locator(".card:visible")
    assert cards.count() == 4
    for tab in ("Sweep", "Energy", "Hardness", "Section"):
        name = tab.lower()
        projector.page.get_by_label("Fourth plot").select_option(label=tab)
        # Before it is laid out it has no height, and Bokeh raises.
        laid_out = (
            "(name) => { try { return explorer.model(name)?.inner_height > 0 } catch { return false } }"
        )
        projector.wait(laid_out, name)
        projector.wait("(name) => location.search.includes(`tiles=${name}`) && explorer.idle()", name)
        assert cards.count() == 4
        assert min(heights(projector, "springs", "pressure", "force", name)) >= LEAST, tab


def boxes(page, *selectors):
    return [page.locator(each).first.bounding_box() for each in selectors]


def test_the_springs_are_larger_than_the_other_plots(projector):
    """1.18 times as wide as the force, 1.12 times as high as the pressure, which has the same x axis."""
    springs, pressure, force = boxes(
        projector.page, *(f".card.{name}" for name in ("springs", "pressure", "force"))
    )
    assert springs["width"] / force["width"] == approx(1.18, rel=0.01)
    assert springs["height"] / pressure["height"] == approx(1.12, rel=0.01)
    assert springs["width"] == pressure["width"]
    across = [projector.axis(name)["x"] for name in ("springs", "pressure")]
    assert across[0] == across[1]


def test_numbers_have_the_colours_of_the_plots(projector):
    """What has yielded is orange, what is elastic is blue; a force is neither."""
    colour = "(name) => getComputedStyle(explorer.all().find((on) => on.dataset?.name === name)).color"
    found = {name: projector.page.evaluate(colour, name) for name in (
        "plastic_radius", "plastic_work", "contact_radius", "stored_energy", "force",
    )}  # fmt: skip
    assert found["plastic_radius"] == found["plastic_work"]
    assert found["contact_radius"] == found["stored_energy"]
    assert len(set(found.values())) == 3


def test_the_drawer_lies_over_the_plots(projector):
    """What the numbers are moves no plot, and is in the window."""
    page = projector.page
    before = boxes(page, ".card.springs", ".card.force")
    page.get_by_text("Numbers, equations, assumptions").click()
    page.locator(".drawer").wait_for()
    assert boxes(page, ".card.springs", ".card.force") == before
    (drawer,) = boxes(page, ".drawer")
    assert drawer["y"] + drawer["height"] <= 720


@pytest.mark.parametrize(("window", "rows", "beside"), [
    ((1024, 768), 2, True), ((820, 1180), 2, True), ((760, 1000), 2, True), ((1280, 720), 1, True),
    ((740, 1000), 2, False),
])  # fmt: skip
def test_nothing_is_cut_off_in_smaller_windows(server, context, window, rows, beside):
    """Readouts in one row or two, the form beside the plots or below them, and all within the window."""
    explorer = Explorer(context.new_page(), server.url, window=window)
    page = explorer.page
    places = [each.bounding_box() for each in page.locator("output").all()]
    assert len({place["y"] for place in places}) == rows
    form, springs = boxes(page, ".of-shape", ".card.springs")
    assert (form["x"] + form["width"] <= springs["x"]) == beside
    cards = [each.bounding_box() for each in page.locator(".card:visible").all()]
    for place in (*places, *cards):
        assert place["x"] >= 0
        assert place["x"] + place["width"] <= window[0]
    assert explorer.problems == []
    page.close()


def test_from_1600_pixels_on_all_is_larger(server, context):
    """Words of the form and letters of the plots by a fifth."""
    letters = "parseFloat(explorer.model('force').below[0].axis_label_text_font_size)"
    small, large = (
        Explorer(context.new_page(), server.url, window=each) for each in ((1280, 720), (1920, 1080))
    )
    small_letters = small.page.evaluate(letters)
    # The browser says how wide it is, and the server sends larger letters.
    large.wait(f"(small) => Math.abs({letters} / small - 1.2) < 1e-3", small_letters)
    heights = [each.page.locator("output").first.bounding_box()["height"] for each in (small, large)]
    assert heights[1] / heights[0] == approx(1.2, rel=0.02)
    assert small.page.evaluate(letters) == small_letters
    small.page.close()
    large.page.close()


def test_restitution_over_speed_is_one_click(projector):
    projector.goto(f"{projector.page.url.split('?')[0]}?preset={DROP}")
    projector.press("e over v")
    projector.wait("explorer.model('sweep') && explorer.row('sweep', 'this scene')?.[0].length > 1")
    labels = projector.axis("sweep")["labels"]
    assert [label.split(",")[0] for label in labels] == ["v₀", "e"]
    points, _ = projector.row("sweep", "this scene")
    _, result, swept = projector.hover("sweep", "this scene", len(points) // 2)
    assert re.fullmatch(r"e = 0\.\d+", result.strip())
    assert swept.startswith("v₀ = ")


def tools(explorer, name):
    """The buttons of the tools of a plot, which is pointed at or touched: a box, and the whole plot."""
    card = explorer.page.locator(f".card.{name}")
    return card.locator(".bk-OnOffButton"), card.locator(".bk-ClickButton")


def test_a_box_is_zoomed_to_until_a_double_click_or_another_drive(projector):
    """Its tool is seen while the plot is pointed at, and off after one box: the plot is dragged again."""
    page, before = projector.page, projector.axis("force")
    box, whole = tools(projector, "force")
    assert not box.is_visible()
    middle = page.locator(".card.force canvas").first.bounding_box()
    centre = middle["x"] + middle["width"] / 2, middle["y"] + middle["height"] / 2

    def zoom():
        page.mouse.move(*centre)
        box.click()
        projector.drag("force", (0.2, 0.15))
        narrow = "([a, b]) => { const { x } = explorer.axis('force'); return x[1] - x[0] < (b - a) / 2 }"
        projector.wait(narrow, before["x"])

    zoom()
    within = projector.axis("force")
    assert before["x"][0] < within["x"][0] < within["x"][1] < before["x"][1]
    assert before["y"][0] < within["y"][0] < within["y"][1] < before["y"][1]
    # It stays when a number is changed, and nothing was dragged.
    assert projector.readout("depth") == "8.978 nm"
    projector.change(projector.type, "q_c", "110 N/m")
    assert projector.axis("force")["x"] == within["x"]
    # In another unit it is the same part of the plot.
    projector.change(projector.type, "d_max", "900 pm")
    projector.change(projector.type, "d_max", "8.978 nm")
    np.testing.assert_allclose(projector.axis("force")["x"], within["x"], rtol=1e-9)
    # The tool is off: the mark on the curve is dragged.
    projector.drag("force", (-0.2, 0.2))
    projector.wait("player.value < 80")
    assert projector.axis("force")["x"] == within["x"]
    page.mouse.dblclick(*centre)
    projector.wait("(x) => explorer.axis('force').x.join() === x.join()", before["x"])
    zoom()
    page.mouse.move(*centre)
    whole.click()
    projector.wait("(x) => explorer.axis('force').x.join() === x.join()", before["x"])
    zoom()
    projector.pick("force")
    projector.wait("(wide) => Math.abs(explorer.axis('force').x[1] / wide - 1) < 1e-9", before["x"][1])


def test_a_finger_zooms(server, handheld):
    """A touched plot shows its tools, of 44 pixels; a finger draws the box."""
    explorer = Explorer(handheld.new_page(), server.url)
    page, before = explorer.page, explorer.axis("force")
    box, _ = tools(explorer, "force")
    place = page.locator(".card.force canvas").first.bounding_box()
    x, y = place["x"] + 0.3 * place["width"], place["y"] + 0.5 * place["height"]
    page.touchscreen.tap(x, y)
    box.wait_for()
    size = box.bounding_box()
    assert min(size["width"], size["height"]) >= 44
    box.tap()
    client = handheld.new_cdp_session(page)
    moves = ("touchStart", 0.0), ("touchMove", 0.1), ("touchMove", 0.25), ("touchEnd", None)
    for kind, share in moves:
        end = share is None
        at = [] if end else [{"x": x + share * place["width"], "y": y + share * place["height"]}]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
    narrow = "([a, b]) => { const { x } = explorer.axis('force'); return x[1] - x[0] < (b - a) / 2 }"
    explorer.wait(narrow, before["x"])
    assert page.evaluate("scrollY") == 0
    assert explorer.problems == []
    explorer.page.close()


def test_a_spring_says_its_compression_and_its_load_against_their_limits(projector):
    """Near the axis it has yielded: u = d_c = π q_c/(2E*) = 1.796 nm, q = π q_c/2 = 157 N/m.

    d = 8.978 nm, so that the spring at x has the plastic part d − (π/2) s x − d_c; nothing else is told.
    """
    page = projector.page
    box = page.locator(".card.springs canvas").first.bounding_box()
    page.mouse.move(box["x"] + 0.52 * box["width"], box["y"] + 0.7 * box["height"])
    page.locator(".told").wait_for()
    said = page.locator(".told").inner_text().split("\n")
    assert said[0].startswith("yielded spring at x = ")
    assert said[1] == "elastic part u = 1.8 of at most 1.8 nm = dc"
    x, plastic = (
        float(re.search(r"(−?[\d.]+) nm", line)[1].replace("−", "-")) for line in (said[0], said[2])
    )
    assert said[2].startswith("plastic part ")
    # Three digits are written, of which x has half a percent.
    assert plastic == approx(8.978 - np.pi / 2 * 0.358 * abs(x) - 1.796, abs=0.02)
    assert said[3] == "q = 157 of at most 157 N/m"
    assert page.locator(".bk-Tooltip:visible").count() == 0
    assert "1.796 nm" in page.locator(".card.springs .formula").inner_text()


def test_a_slider_prints_both_ends_and_its_scale(projector):
    ends = projector.number("d_max").locator(".ends span").all_inner_texts()
    assert ends == ["299 pm", "logarithmic", "269 nm"]


def test_numbers_that_differ_are_seen_while_a_slider_moves(projector):
    projector.change(projector.press, "Compare")
    projector.choose("Shape", "Paraboloid")
    table = projector.page.locator(".held table")
    assert "4.51 µN" in table.inner_text()
    assert "8.98 nm" not in table.inner_text()
    # Also beside the last slider of the form, to which one has to scroll.
    projector.press("More about the medium")
    projector.slider("ρ").scroll_into_view_if_needed()
    box = table.bounding_box()
    assert 0 <= box["y"] <= box["y"] + box["height"] <= 720
    # The cone is drawn in the plot of the springs, too.
    depth = projector.row("springs", "Cone")[1].min()
    assert depth == approx(-8.978, rel=1e-3)


def test_one_screen_of_a_phone_has_springs_force_and_slider(server, handheld):
    explorer = Explorer(handheld.new_page(), server.url)
    boxes = [explorer.page.locator(f".card.{name}").bounding_box() for name in ("springs", "force")]
    boxes.append(explorer.slider("d_max").bounding_box())
    assert all(box["y"] >= 0 and box["y"] + box["height"] <= 844 for box in boxes)
    assert min(heights(explorer, "springs", "force")) > 100
    tops = explorer.page.locator(".header button:visible, .header select:visible")
    boxes = [each.bounding_box() for each in tops.all()]
    assert len({round(box["y"] + box["height"] / 2) for box in boxes}) == 1
    assert explorer.problems == []
    explorer.page.close()
