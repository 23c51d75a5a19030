"""A scene as a file has the numbers and plots of the page, and needs nothing else."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from app.explorer import changes, readouts
from app.explorer.extras.comparison import Held
from app.explorer.extras.scene_file import scene_file
from app.explorer.figures import Picture
from app.explorer.plots import NAMED, PLOTS
from app.explorer.state import PRESETS, preset_state

from ...approx import approx
from ..conftest import DROP
from ..states import HOSTILE, amounts, now, plain, state_with, unit, view_of


def test_it_says_what_the_page_says():
    state = changes.set_value(preset_state(DROP), "speed", 2.0)
    view = view_of(state, 1.5)
    course = view.course
    view.computed["held"] = [Held("<b>stiff</b>", course)]
    html = scene_file(view)
    said = plain(html)
    assert f"{PRESETS[DROP].label}, altered" in said
    assert "<b>stiff</b>." in said
    # Of equations the text alone: the links of the page lead to its server.
    assert "theory.html" not in html
    for each in readouts.line(course):
        assert each.long_name in said
    # What the preset says has its source; what was typed says so.
    assert PRESETS[DROP].sources["q_c"] in said
    assert "2.0000 m/s set on the page" in said
    for limit in course.hit.limits:
        assert limit.sentence.rstrip(".") in said
    assert all(PLOTS[name].title in said for name in NAMED)


def test_it_can_be_sent_by_mail():
    """The scene with most frames is below 3 MB."""
    assert len(scene_file(view_of(state_with(DROP, "oblique"))).encode()) < 3e6


@pytest.fixture(scope="module")
def saved(opened, tmp_path_factory):
    """The opening scene, opened from its file."""
    path = tmp_path_factory.mktemp("saved") / "scene.html"
    path.write_text(scene_file(view_of(preset_state())), encoding="utf-8")
    return opened(path)


#: Numbers of states of the opening scene: elastic, yielding, of the largest depth, and unloading.
STATES = 20, 60, 80, 100


def go(saved, number):
    saved.page.get_by_label("State along the path").fill(str(number))


def test_the_numbers_of_a_cone_are_read_and_drawn_in_every_state(saved):
    """F = 2E* (d² − d_p²)/(π s): Eq. (22) with a(u) = 2u/(π s), without the solver."""
    state, depths = preset_state(), view_of(preset_state()).course.states.depth
    critical = np.pi * state.q_c / (2 * state.E_star)
    for number in STATES:
        go(saved, number)
        depth, force = now(saved)
        plastic = max(0.0, depths[: number + 1].max() - critical)
        expected = 2 * state.E_star * (depth**2 - plastic**2) / (np.pi * state.cone_slope)
        # Depths are drawn to 10⁻⁵ of the axis, to which the force of unloading is 30 times as sensitive.
        assert force == approx(expected, rel=1e-3), number
        assert amounts(saved.readout("force")) == approx([expected], rel=1e-3)
        assert bool(np.isfinite(saved.row("springs", "yielded")[0]).any()) == (plastic > 0)
        if number < 80:
            # The peak of the pressure is beyond the axis, and not drawn.
            continue
        # The pressure that is drawn carries the force; trapezoids miss some of its cusp.
        r, p = saved.row("pressure", "p(r)")
        units = saved.axis("pressure")["labels"]
        carried = np.pi * trapezoid(p * np.abs(r), r)
        carried *= unit(units[0]) ** 2 * unit(units[1])
        assert carried == approx(expected, rel=0.01), number


def test_every_row_is_drawn_as_on_the_page(saved):
    view = view_of(preset_state())
    numbers = readouts.line(view.course)
    for number in STATES:
        go(saved, number)
        said = {each.name: readouts.text(each, values, number) for each, values in numbers.items()}
        assert {name: saved.readout(name) for name in said} == said
        for name in NAMED:
            for layer, columns in Picture(PLOTS[name]).columns(view, number).items():
                for k, row in enumerate(columns["row"] if "xs" in columns else ()):
                    places = np.array([columns["xs"][k], columns["ys"][k]], float)
                    np.testing.assert_array_equal(
                        saved.row(name, row), places, err_msg=f"{layer.name} {row}"
                    )


def test_it_plays_is_dragged_and_turns_dark(saved):
    """As the page does, with the mouse and with keys."""
    page = saved.page
    slider, play = page.get_by_label("State along the path"), page.locator(".player button")
    go(saved, 80)
    before = saved.row("force", "now")
    saved.drag("force", (-0.3, 0.3))
    assert saved.row("force", "now")[0] < before[0]
    assert slider.input_value() != "80"
    before = saved.row("force", "now")
    saved.drag("springs", (0, 0.2))
    assert saved.row("force", "now")[0] > before[0]
    go(saved, 0)
    page.keyboard.press("Space")
    saved.wait("explorer.row('force', 'now')[0][0] > 5")
    assert play.inner_text() == "❚❚ Pause"
    page.keyboard.press("Space")
    assert play.inner_text() == "▶ Play"
    stopped = slider.input_value()
    assert saved.row("force", "now")[0][0] == approx(float(saved.readout("depth").split()[0]), abs=1e-3)
    colour = """() => {
        const { renderers } = explorer.model("springs")
        const drawn = renderers.map(({ data_source: { data } }) => (data.line_color ?? data.text_color)[0])
        const grounds = [document.body, document.querySelector(".card")]
        return [...grounds.map((each) => getComputedStyle(each).backgroundColor), ...drawn]
    }"""
    light = page.evaluate(colour)
    saved.press("Dark")
    dark = page.evaluate(colour)
    assert all(one != other for one, other in zip(light, dark, strict=True))
    assert page.locator("#dark").get_attribute("aria-pressed") == "true"
    saved.press("Dark")
    assert page.evaluate(colour) == light
    assert slider.input_value() == stopped
    # A browser that turns dark turns it, too.
    page.emulate_media(color_scheme="dark")
    saved.wait("document.documentElement.classList.contains('dark')")
    assert page.evaluate(colour) == dark
    page.emulate_media(color_scheme="light")
    saved.wait("!document.documentElement.classList.contains('dark')")


def test_it_fits_a_slide_and_a_phone(saved):
    """All on one screen of 1280 × 720; on a phone one column, all readouts, and targets for a finger."""
    page = saved.page
    for box in (page.locator(f".card.{name}").bounding_box() for name in NAMED):
        assert box["width"] > 400
        assert box["height"] > 200
        assert box["y"] + box["height"] <= 720
    assert page.evaluate("document.documentElement.scrollHeight") <= 720
    assert page.title() == PRESETS[preset_state().preset].label
    page.set_viewport_size({"width": 390, "height": 844})
    saved.wait("explorer.model('force').inner_width < 330")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    assert page.locator("output:visible").count() == page.locator(".strip .name:visible").count() == 8
    for control in (".player input", ".player button", "#dark"):
        assert page.locator(control).bounding_box()["height"] >= 44
    assert page.locator(".card.springs").bounding_box()["y"] < 300
    # The slider stays in sight of every plot.
    page.locator(".card.force").scroll_into_view_if_needed()
    assert page.evaluate("scrollY") > 200
    assert 0 <= page.locator(".player input").bounding_box()["y"] < 44
    page.set_viewport_size({"width": 1280, "height": 720})


def test_a_saved_scene_ends_no_script_of_its_own(opened, tmp_path):
    """A tip with a hostile name, in the file of a scene."""
    r = np.linspace(0, 1e-6, 20)
    state = changes.take_tip(preset_state(), (r, r**2 / 1e-5), f"20 samples of {''.join(HOSTILE)}")
    path = tmp_path / "scene.html"
    path.write_text(scene_file(view_of(state)), encoding="utf-8")
    page = opened(path).page
    assert page.evaluate("window.run") is None
    assert page.locator("img[src=x], svg[onload]").count() == 0
    page.get_by_text("Inputs and their sources").click()
    page.get_by_text(HOSTILE[0]).first.wait_for()
