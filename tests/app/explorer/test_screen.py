"""Layout: the first screen, small and large windows, and parts that open."""

import re
from pathlib import Path

import pytest

from app.explorer.state import preset_state

from ...approx import approx
from ..conftest import DROP, Explorer, boxes, heights
from ..states import assert_draws

CLICKABLE = Path(__file__).with_name("clickable.js").read_text(encoding="utf-8")


def test_there_are_some_forty_things_to_click(projector):
    found = projector.page.evaluate(CLICKABLE)
    # The plots, which are dragged, are among them; the link to them is seen only while it has the focus.
    assert sum("bk-events" in name for name in found) == 3
    assert len(found) <= 40, "\n".join(found)
    # What the three views need is among them.
    for part in ("depth", "force", "impact", "Shape", "Hardness", "q_c, yield constant, slider", "▶ Play"):
        assert any(part in name for name in found), part


#: Pixels within the axes, below which a plot is not read from the back of a room.
LEAST = 150


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


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (1440, 900)])
def test_the_first_screen_has_what_a_person_comes_for(server, context, width, height):
    """The drive with its slider first, shape, E* and q_c; one line of readouts; three plots, all whole."""
    explorer = Explorer(context.new_page(), server.url, window=(width, height))
    page = explorer.page
    # A field and a slider each.
    inputs = [each.bounding_box() for each in page.locator(".number input:visible").all()]
    assert [box["y"] + box["height"] <= height for box in inputs] == 8 * [True]
    assert explorer.slider("d_max").bounding_box()["y"] < 0.3 * height
    for name in ("springs", "pressure", "force"):
        card = page.locator(f".card.{name}").bounding_box()
        assert card["y"] + card["height"] <= height
        assert card["x"] + card["width"] <= width
        assert card["width"] > 0.3 * width
        assert card["height"] > 0.3 * height
    assert page.locator("output").count() <= 8
    assert page.locator(".header .act:visible, .more .act:visible").count() == 5
    assert page.locator(".top").bounding_box()["height"] < 70
    assert page.evaluate("document.documentElement.scrollHeight") <= height
    assert explorer.problems == []
    explorer.page.close()


def test_the_page_opens_on_a_cone_that_has_yielded_and_says_what_everything_is(explorer):
    """Every control has a name and an explanation; tooltips are of the data and their own axis."""
    assert_draws(explorer, preset_state())
    assert explorer.page.title() == "Indentation explorer"
    assert explorer.readout("force") == "4.514 µN"
    assert explorer.readout("relative_depth") == "5.000"
    assert explorer.slider("d_max").input_value() == "200"
    assert explorer.axis("springs")["x"] == explorer.axis("pressure")["x"]
    page = explorer.page
    for each in page.locator("input:visible, select:visible, textarea:visible").all():
        named = each.evaluate("(on) => on.ariaLabel || on.labels?.[0]?.textContent.trim()")
        assert named, each.evaluate("(on) => on.outerHTML")
    assert page.get_by_role("slider", name="State along the path").count() == 1
    page.get_by_label("What is q_c, yield constant?").click()
    about = explorer.number("q_c").locator(".about")
    assert "Hardness times contact radius" in about.inner_text()
    assert "(11)" in about.inner_text()
    explorer.open("Hardness", "hardness", "yielding")
    a, _ = explorer.row("hardness", "yielding")
    tip = explorer.hover("hardness", "yielding", len(a) * 2 // 3)
    assert re.fullmatch(r"pₘ = [\d.]+ GPa", tip[1])
    assert re.fullmatch(r"a = [\d.]+ nm", tip[2])


#: Sizes of the letters of a plot: of titles, ticks and labels.
LETTERS = """(name) => {
  const { below, renderers } = explorer.model(name)
  const text = renderers.find(({ glyph }) => glyph.type === "Text")
  const sizes = [below[0].axis_label_text_font_size, below[0].major_label_text_font_size]
  const { value, field } = text.glyph.text_font_size
  return [...sizes, value ?? text.data_source.data[field][0]].map(parseFloat)
}"""


def test_what_is_opened_leaves_the_form_and_is_closed_by_escape(projector):
    page, field = projector.page, projector.field("d_max")
    opened = (
        ("Guide", page.get_by_label("Guided scene")),
        ("Share", page.get_by_label("This scene in Python")),
    )
    for name, part in opened:
        projector.press(name)
        part.wait_for()
        assert field.is_visible()
        page.keyboard.press("Escape")
        part.wait_for(state="hidden")
    projector.number("d_max").locator(".help").click()
    page.keyboard.press("Escape")
    assert projector.number("d_max").locator(".about").is_hidden()
    letters, card = page.evaluate(LETTERS, "force"), page.locator(".card.force")
    title = card.locator("h3").bounding_box()["height"]
    card.get_by_role("button", name="Large").click()
    card.get_by_role("button", name="Small").wait_for()
    projector.wait("explorer.model('force').inner_width > 700")
    assert page.evaluate(LETTERS, "force") == [1.5 * size for size in letters]
    assert card.locator("h3").bounding_box()["height"] == approx(1.5 * title, abs=1)
    page.keyboard.press("Escape")
    card.get_by_role("button", name="Large").wait_for()
    assert page.evaluate(LETTERS, "force") == letters


#: How far the titles of the axes reach beyond their plots, below.
BELOW = """() => Math.max(...["springs", "pressure", "force"].map((name) => {
  const { inner_height, above, min_border_top, min_border_bottom } = explorer.model(name)
  const { bbox } = Bokeh.index.find_one(explorer.model(name))
  return inner_height + min_border_top + min_border_bottom - bbox.height
}))"""


def test_nothing_is_cut_with_notes_open_at_720_pixels(projector):
    page = projector.page
    projector.open("Sweep", "sweep", "this scene")
    note = page.locator(".card.sweep .found")
    note.wait_for()
    page.get_by_text("Numbers, equations, assumptions").click()
    projector.wait(f"({BELOW})() < 1")
    card, said = page.locator(".card.sweep").bounding_box(), note.bounding_box()
    figure = page.locator(".card.sweep canvas").first.bounding_box()
    assert card["y"] <= said["y"]
    assert said["y"] + said["height"] <= figure["y"] + 1
    assert figure["y"] + figure["height"] <= card["y"] + card["height"] + 1
    sizes = page.evaluate("""() => explorer.all().filter((each) => each.matches(".strip .name, h1, h2, h3"))
        .map((each) => parseFloat(getComputedStyle(each).fontSize))""")
    assert min(sizes) >= 12


def test_what_is_opened_leaves_the_buttons_of_a_large_plot(explorer):
    page = explorer.page
    page.set_viewport_size({"width": 1280, "height": 720})
    card = page.locator(".card.force")
    card.get_by_role("button", name="Large").click()
    small = card.get_by_role("button", name="Small")
    small.wait_for()
    explorer.press("Share")
    share = page.get_by_label("This scene in Python")
    share.wait_for()
    shown = page.locator(".share").first.bounding_box()
    for name in ("Small", "Save"):
        box = card.get_by_role("button", name=name).bounding_box()
        assert box["y"] + box["height"] <= shown["y"], name
    small.click()
    card.get_by_role("button", name="Large").wait_for()


def test_a_zoomed_window_begins_with_a_plot(phone):
    """Of 1280 × 720 pixels at 200 % the whole plot of the springs is on the first screen."""
    page = phone.page
    page.set_viewport_size({"width": 640, "height": 360})
    phone.wait("explorer.model('springs').inner_width > 400")
    page.evaluate("scrollTo(0, 0)")
    box = page.locator(".card.springs").bounding_box()
    assert box["y"] > 0
    assert box["y"] + box["height"] <= 360
    page.set_viewport_size({"width": 390, "height": 844})
    phone.wait("explorer.model('springs').inner_width < 400")
