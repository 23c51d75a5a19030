"""What a lecturer shows to a room: scales that stay, a large plot, one picture of all plots."""

import io

import numpy as np
import pytest

from app.explorer import changes
from app.explorer.page import Page
from app.explorer.plots import PLOTS, D, F, R, X, Z

from ..approx import approx
from .conftest import Explorer

#: Sizes of the letters of a plot: of titles, ticks and labels.
LETTERS = """(name) => {
  const { below, renderers } = explorer.model(name)
  const text = renderers.find(({ glyph }) => glyph.type === "Text")
  const sizes = [below[0].axis_label_text_font_size, below[0].major_label_text_font_size]
  const { value, field } = text.glyph.text_font_size
  return [...sizes, value ?? text.data_source.data[field][0]].map(parseFloat)
}"""
#: How far the titles of the axes reach beyond their plots, below.
BELOW = """() => Math.max(...["springs", "pressure", "force"].map((name) => {
  const { inner_height, above, min_border_top, min_border_bottom } = explorer.model(name)
  const { bbox } = Bokeh.index.find_one(explorer.model(name))
  return inner_height + min_border_top + min_border_bottom - bbox.height
}))"""


def test_twice_the_depth_is_twice_the_picture():
    """On axes kept while something is dragged; what leaves them is not drawn, and said.

    Another drive has its own, and when it is released they fit again.
    """
    page = Page()
    before = page.view
    page.messages.dragged = True
    page.apply(lambda state: changes.put(state, "max_depth", 2 * state.max_depth))
    view, i = page.view, page.view.course.now
    assert [view.axis(each) for each in (X, Z, R, D, F)] == [before.axis(each) for each in (X, Z, R, D, F)]
    state = view.course.state
    a, d, force = (float(each) for each in (state.contact_radius, state.depth, state.force))
    # A cone: a = 2 d/(π s).
    assert a == approx(2 * float(before.course.state.contact_radius), rel=1e-9)
    for plot, said in (("springs", (a * 1e9, d * 1e9)), ("force", (d * 1e9, force * 1e6))):
        text = view.places(PLOTS[plot], i)["cut off"][2]
        assert text.startswith("cut off: ")
        told = [float(each.split(" = ")[1].split()[0]) for each in text[9:].split(", ")]
        # Three digits.
        assert told == approx(said, rel=5e-3)
    for name in ("springs", "pressure", "force"):
        # What is drawn at this level Bokeh cuts off at the axes.
        renderers = page.layout.cards[name].picture.figure.renderers
        assert {renderer.level for renderer in renderers} == {"glyph"}
    page.undo()
    assert page.view.kept
    assert page.view.places(PLOTS["force"], i)["cut off"][2] == ""
    page.apply(lambda state: changes.choose(state, "drive", "impact"))
    assert page.view.kept == {}
    page.undo()
    page.apply(lambda state: changes.put(state, "max_depth", 2 * state.max_depth))
    assert page.view.kept
    page.messages.dragged = False
    assert page.view.kept == {}
    assert page.view.axis(D).end > before.axis(D).end


@pytest.fixture(scope="module")
def lecture(server, context):
    explorer = Explorer(context.new_page(), server.url, window=(1280, 720))
    yield explorer
    assert explorer.problems == []
    explorer.page.close()


def test_scales_stay_while_a_slider_is_dragged(lecture):
    mouse, box = lecture.page.mouse, lecture.slider("d_max").bounding_box()
    before, y = lecture.axis("force"), box["y"] + box["height"] / 2
    mouse.move(box["x"] + box["width"] / 2, y)
    mouse.down()
    mouse.move(box["x"] + 0.6 * box["width"], y, steps=5)
    lecture.wait("explorer.text('force', 'cut off')?.startsWith('cut off: d = 1')")
    assert lecture.axis("force") == before
    mouse.up()
    lecture.wait("(end) => explorer.model('force').x_range.end > end", before["x"][1])
    lecture.wait("explorer.text('force', 'cut off') === ''")
    lecture.link("max_depth=")
    lecture.change(lecture.press, "Undo")


def test_what_is_opened_leaves_the_form_and_is_closed_by_escape(lecture):
    page, field = lecture.page, lecture.field("d_max")
    opened = (
        ("Guide", page.get_by_label("Guided scene")),
        ("Share", page.get_by_label("This scene in Python")),
    )
    for name, part in opened:
        lecture.press(name)
        part.wait_for()
        assert field.is_visible()
        page.keyboard.press("Escape")
        part.wait_for(state="hidden")
    lecture.number("d_max").locator(".help").click()
    page.keyboard.press("Escape")
    assert lecture.number("d_max").locator(".about").is_hidden()
    letters, card = page.evaluate(LETTERS, "force"), page.locator(".card.force")
    title = card.locator("h3").bounding_box()["height"]
    card.get_by_role("button", name="Large").click()
    card.get_by_role("button", name="Small").wait_for()
    lecture.wait("explorer.model('force').inner_width > 700")
    assert page.evaluate(LETTERS, "force") == [1.5 * size for size in letters]
    assert card.locator("h3").bounding_box()["height"] == approx(1.5 * title, abs=1)
    page.keyboard.press("Escape")
    card.get_by_role("button", name="Large").wait_for()
    assert page.evaluate(LETTERS, "force") == letters


def test_nothing_is_cut_with_notes_open_at_720_pixels(lecture):
    page = lecture.page
    lecture.open("Sweep", "sweep", "this scene")
    note = page.locator(".card.sweep .found")
    note.wait_for()
    page.get_by_text("Numbers, equations, assumptions").click()
    lecture.wait(f"({BELOW})() < 1")
    card, said = page.locator(".card.sweep").bounding_box(), note.bounding_box()
    figure = page.locator(".card.sweep canvas").first.bounding_box()
    assert card["y"] <= said["y"]
    assert said["y"] + said["height"] <= figure["y"] + 1
    assert figure["y"] + figure["height"] <= card["y"] + card["height"] + 1
    sizes = page.evaluate("""() => explorer.all().filter((each) => each.matches(".strip .name, h1, h2, h3"))
        .map((each) => parseFloat(getComputedStyle(each).fontSize))""")
    assert min(sizes) >= 12


def test_all_plots_are_one_picture_of_twice_the_screen(lecture):
    page = lecture.page
    with page.expect_download() as download:
        lecture.press("Save plots")
    data = download.value.path().read_bytes()
    assert [int.from_bytes(data[k : k + 4], "big") for k in (16, 20)] == [2560, 1440]
    # Each plot has its colours: springs that have yielded, the pressure, the curve.
    image = np.asarray(pytest.importorskip("PIL.Image").open(io.BytesIO(data)).convert("RGB"), int)
    places = (
        (image[:696, :1280], "#d55e00"),
        (image[696:1392, :1280], "#0072b2"),
        (image[:, 1280:], "#d55e00"),
    )
    for part, colour in places:
        wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
        assert (np.abs(part - wanted).max(axis=2) < 8).sum() > 500
