"""Layout: the first screen, small and large windows, and parts that open."""

from pathlib import Path

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
    page.get_by_text("Numbers, equations, assumptions").click()


#: Windows, with the rows of readouts, and whether the form is beside the plots.
WINDOWS = {
    (1024, 768): (2, True), (820, 1180): (2, True), (760, 1000): (2, True), (740, 1000): (2, False),
    (1920, 1080): (1, True), (1280, 720): (1, True),
}  # fmt: skip


def test_nothing_is_cut_off_in_any_window_and_all_is_larger_from_1600_pixels_on(projector):
    """Readouts in one row or two, the form beside the plots or below them, and all within the window.

    In a large window words of the form and letters of the plots are larger by a fifth.
    """
    page = projector.page
    letters = "parseFloat(explorer.model('force').below[0].axis_label_text_font_size)"
    small = page.evaluate(letters), page.locator("output").first.bounding_box()["height"]
    for (width, height), (rows, beside) in WINDOWS.items():
        page.set_viewport_size({"width": width, "height": height})
        # The browser says how wide it is, and the server sends larger letters.
        larger = 1.2 if width >= 1600 else 1.0
        projector.wait(f"(letters) => Math.abs({letters} / letters - {larger}) < 1e-3", small[0])
        projector.wait("explorer.idle() && document.documentElement.scrollWidth <= innerWidth")
        places = [each.bounding_box() for each in page.locator("output").all()]
        assert len({place["y"] for place in places}) == rows, width
        assert places[0]["height"] / small[1] == approx(larger, rel=0.02)
        form, springs = boxes(page, ".of-shape", ".card.springs")
        assert (form["x"] + form["width"] <= springs["x"]) == beside, width
        cards = [each.bounding_box() for each in page.locator(".card:visible").all()]
        for place in (*places, *cards):
            assert 0 <= place["x"] <= place["x"] + place["width"] <= width


def test_the_first_screen_has_what_a_person_comes_for(projector):
    """The drive with its slider first, shape, E* and q_c; one line of readouts; three plots, all whole."""
    page = projector.page
    assert_draws(projector, preset_state())
    assert projector.readout("force") == "4.514 µN"
    assert projector.readout("relative_depth") == "5.000"
    # A field and a slider each.
    inputs = [each.bounding_box() for each in page.locator(".number input:visible").all()]
    assert [box["y"] + box["height"] <= 720 for box in inputs] == 8 * [True]
    assert projector.slider("d_max").bounding_box()["y"] < 0.3 * 720
    assert projector.slider("d_max").input_value() == "200"
    for card in boxes(page, ".card.springs", ".card.pressure", ".card.force"):
        assert card["y"] + card["height"] <= 720
        assert card["x"] + card["width"] <= 1280
        assert card["width"] > 0.3 * 1280
        assert card["height"] > 0.3 * 720
    assert page.locator("output").count() <= 8
    assert page.locator(".top").bounding_box()["height"] < 70
    assert page.evaluate("document.documentElement.scrollHeight") <= 720


#: Sizes of the letters of a plot: of titles, ticks and labels.
LETTERS = """(name) => {
  const { below, renderers } = explorer.model(name)
  const text = renderers.find(({ glyph }) => glyph.type === "Text")
  const sizes = [below[0].axis_label_text_font_size, below[0].major_label_text_font_size]
  const { value, field } = text.glyph.text_font_size
  return [...sizes, value ?? text.data_source.data[field][0]].map(parseFloat)
}"""


def test_what_is_opened_leaves_the_form_and_is_closed_by_escape(projector):
    """In the order in which it was opened: the link before the large plot, whose buttons stay in sight."""
    page, field, card = projector.page, projector.field("d_max"), projector.page.locator(".card.force")
    projector.press("Guide")
    page.get_by_label("Guided scene").wait_for()
    assert field.is_visible()
    page.keyboard.press("Escape")
    page.get_by_label("Guided scene").wait_for(state="hidden")
    page.get_by_label("What is q_c, yield constant?").click()
    about = projector.number("q_c").locator(".about")
    assert "(11)" in about.inner_text()
    page.keyboard.press("Escape")
    assert about.is_hidden()
    letters, title = page.evaluate(LETTERS, "force"), card.locator("h3").bounding_box()["height"]
    card.get_by_role("button", name="Large").click()
    card.get_by_role("button", name="Small").wait_for()
    projector.wait("explorer.model('force').inner_width > 700")
    assert page.evaluate(LETTERS, "force") == [1.5 * size for size in letters]
    assert card.locator("h3").bounding_box()["height"] == approx(1.5 * title, abs=1)
    slider, (force,) = projector.slider("d_max").bounding_box(), boxes(page, ".card.force")
    assert slider["x"] + slider["width"] <= force["x"]
    projector.press("Share")
    link = page.get_by_label("Link to this page")
    link.click()
    (shown,) = boxes(page, ".share")
    for name in ("Small", "Save"):
        box = card.get_by_role("button", name=name).bounding_box()
        assert box["y"] + box["height"] <= shown["y"], name
    assert field.is_visible()
    page.keyboard.press("Escape")
    link.wait_for(state="hidden")
    assert card.get_by_role("button", name="Small").is_visible()
    page.keyboard.press("Escape")
    card.get_by_role("button", name="Large").wait_for()
    assert page.evaluate(LETTERS, "force") == letters


#: How far the titles of the axes reach beyond their plots, below.
BELOW = """() => Math.max(...["springs", "pressure", "force"].map((name) => {
  const { inner_height, above, min_border_top, min_border_bottom } = explorer.model(name)
  const { bbox } = Bokeh.index.find_one(explorer.model(name))
  return inner_height + min_border_top + min_border_bottom - bbox.height
}))"""


def test_four_plots_and_the_notes_of_one_fit_a_projector(server, context):
    """Plots are at least 150 pixels high; a further one takes the place of the last."""
    url = f"{server.url}?preset={DROP}&tiles=sweep+energy+motion"
    explorer = Explorer(context.new_page(), url, window=(1280, 720))
    page, cards = explorer.page, explorer.page.locator(".card:visible")
    assert cards.count() == 4
    for tab in ("Energy", "Hardness", "Section", "Sweep"):
        name = tab.lower()
        page.get_by_label("Fourth plot").select_option(label=tab)
        # Before it is laid out it has no height, and Bokeh raises.
        laid_out = "try { return explorer.model(name)?.inner_height > 0 } catch { return false }"
        explorer.wait(f"(name) => {{ {laid_out} }}", name)
        explorer.wait("(name) => location.search.includes(`tiles=${name}`) && explorer.idle()", name)
        assert cards.count() == 4
        assert min(heights(explorer, "springs", "pressure", "force", name)) >= 150, tab
    note = page.locator(".card.sweep .found")
    note.wait_for()
    page.get_by_text("Numbers, equations, assumptions").click()
    explorer.wait(f"({BELOW})() < 1")
    card, said, figure = boxes(page, ".card.sweep", ".card.sweep .found", ".card.sweep canvas")
    assert card["y"] <= said["y"]
    assert said["y"] + said["height"] <= figure["y"] + 1
    assert figure["y"] + figure["height"] <= card["y"] + card["height"] + 1
    sizes = page.evaluate("""() => explorer.all().filter((each) => each.matches(".strip .name, h1, h2, h3"))
        .map((each) => parseFloat(getComputedStyle(each).fontSize))""")
    assert min(sizes) >= 12
    assert explorer.problems == []
    page.close()
