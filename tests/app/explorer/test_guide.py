"""Guided scenes: their steps, what they say, and the powers of the classes."""

import re
from pathlib import Path

import numpy as np
import pytest

from app.common import units
from app.common.host import last
from app.explorer import changes
from app.explorer.drives import follow
from app.explorer.extras import guide, hardness, sweep
from app.explorer.extras.guide import TOURS, step_state, step_text
from app.explorer.extras.notes import limits
from app.explorer.page import Page
from app.explorer.state import medium, preset_state
from mdr_core.show.units import Unit

from ...approx import approx
from ..states import press, side, stepped


def test_the_help_reads_a_number_without_a_unit_as_the_fields_do():
    help_text = Path(guide.__file__).with_suffix(".html").read_text(encoding="utf-8")
    ((typed, meant),) = re.findall(r"(\S+) in a field of nanometres is (\d+) nm", help_text)
    nm = Unit("nm", 1e-9)
    assert units.read(typed, "length", nm) == (approx(float(meant) * 1e-9, rel=1e-12), nm)


def test_guided_scenes_say_what_is_so():
    """At d/d_c = 5 the mean pressure of a cone is 0.90 of q_c/a, q_c = 100 N/m."""
    elastic, begun, deep, lifted = stepped("First yield")
    assert elastic.state.plastic_radius == 0
    assert elastic.state.pressure(0.0) == float("inf")
    assert begun.state.plastic_radius > 0
    assert begun.state.pressure(0.0) < float("inf")
    assert float(deep.state.mean_pressure * deep.state.contact_radius) == approx(0.90 * 100, rel=0.01)
    # (21): the ring a − c stays as wide as it is.
    rings = [float(course.state.contact_radius - course.state.plastic_radius) for course in (begun, deep)]
    assert rings[0] == approx(rings[1], rel=1e-9)
    assert lifted.states.force[lifted.now] == 0
    left = float(deep.state.depth) - elastic.onset.depth
    assert float(lifted.state.depth) == approx(left, rel=1e-9)
    courses = stepped("Damage by a fast impact")
    slow, onset, fast, one, twice, _ = (course.hit for course in courses)
    assert slow.restitution == 1
    assert slow.damaged_area == 0
    assert onset.damaged_area > 0
    assert fast.plastic_work / (fast.mass * fast.speed**2 / 2) > 0.9
    assert twice.damaged_area / one.damaged_area == approx(4, rel=0.05)
    fast, slow, thick, thin = (course.hit for course in stepped("Why a slow drop bounces better"))
    assert slow.restitution > 4 * fast.restitution
    assert thin.contact_time > 2 * thick.contact_time
    assert thin.restitution > thick.restitution
    assert thick.plastic_work == thin.plastic_work == 0
    courses = stepped("It bounces only between two speeds")
    assert [bool(course.hit.captured) for course in courses] == [False, True, True]
    courses = stepped("Harder pressed, harder to pull off")
    forces = [float(course.states.pull_off_force[-1]) for course in courses]
    assert forces[0] < forces[1] == forces[2] < forces[3]


def test_a_guided_scene_is_stepped_through_and_undone():
    page = Page()
    press(page, "Surface")
    opening = page.state.scene_values
    for at, step in enumerate(TOURS["First yield"]):
        side(page, "guide").next.clicks += 1
        assert page.state.max_depth == step["set"]["max_depth"]
        assert page.state.at == step["set"].get("at", 1.0)
        assert f"{at + 1} of 4" in side(page, "guide").words.object
        assert "{" not in side(page, "guide").words.object
    assert side(page, "guide").next.disabled
    told = []
    side(page, "guide").words.param.watch(lambda event: told.append(event.new), "object")
    side(page, "guide").title.value = "Damage by a fast impact"
    # Its text is the only one: it is not taken for a scene that was changed by hand.
    assert len(told) == 1
    assert "e = 1.00" in re.sub("<[^>]+>", "", side(page, "guide").words.object)
    # A scene has its own plots.
    assert page.state.tiles == ()
    # What it says is gone while the page shows something else.
    page.apply(lambda state: changes.set_value(state, "speed", 2 * state.speed))
    assert "1 of 6" in side(page, "guide").words.object
    assert "e = 1.00" not in re.sub("<[^>]+>", "", side(page, "guide").words.object)
    page.undo()
    assert "e = 1.00" in re.sub("<[^>]+>", "", side(page, "guide").words.object)
    # Each step that sets something is one change.
    for _ in range(4):
        page.undo()
    while page.history.at:
        page.undo()
    assert page.state.scene_values == opening


KINDS = TOURS["Which kind of medium is it?"]


def powers(step):
    """Powers of the curves of a sweep at the present value, as its note has them: own, and by class."""
    state = step_state(step, preset_state())
    found = last(sweep.found(follow(state), sweep.asked(state)))
    note = re.sub("</?(sub|i)>", "", found.note).replace("−", "-")
    told = [float(text) for text in re.findall(r"<sup>(-?[\d.]+)</sup>", note)]
    return dict(zip(["own", *re.findall(r"\(([abc])\) \w", note)], told, strict=True))


def test_a_cone_tells_the_classes_by_volume_area_and_depth():
    """d_p ∝ W^(1/3), and so c; A ∝ W; d_p ∝ W. Class (a) exactly, the others to what is missing of deep."""
    a, b, c = KINDS[:3]
    assert powers(a)["own"] == approx(1 / 3, abs=5e-4)
    # The imprint is a cone of one shape: its volume is as c² d_p.
    states = [step_state(a, preset_state()).replace(speed=speed) for speed in (1.0, 2.0)]
    slow, fast = (follow(state).hit for state in states)
    volumes = [hit.plastic_radius**2 * hit.plastic_depth for hit in (slow, fast)]
    assert volumes[1] / volumes[0] == approx(4, rel=1e-9)
    assert slow.restitution == approx(fast.restitution, rel=1e-9)
    assert powers(b)["own"] == approx(1, abs=0.02)
    assert powers(b)["a"] == approx(2 / 3, abs=2e-3)
    assert powers(c)["own"] == approx(1, abs=0.02)
    course = follow(step_state(c, preset_state()))
    most = np.pi * 300
    assert 0.999 * most < float(course.hit.max_force) < most
    assert f"{most:.0f} N" in c["says"]


def test_scenes_on_the_classes_are_within_the_assumptions():
    for step in KINDS:
        state = step_state(step, preset_state())
        assert [text for level, text in limits(follow(state), state) if level == "beyond"] == []


def test_a_step_sets_what_is_the_default_too():
    """After another result has been swept, a step on the damaged area, the first option, shows that."""
    steps = [step for steps in TOURS.values() for step in steps]
    step = next(each for each in steps if each["set"].get("sweep.against") == "damaged_area")
    before = preset_state().replace(**{"sweep.against": "max_depth", "section.stress": "von_mises"})
    state = step_state(step, before)
    assert state["sweep.against"] == "damaged_area"
    # What it does not set stays.
    assert state["section.stress"] == "von_mises"


def test_a_round_nose_tells_them_by_restitution_and_area():
    a, b = KINDS[3:5]
    assert powers(a)["own"] == approx(-1 / 4, abs=2e-3)
    assert powers(a)["b"] == approx(-2 / 3, abs=5e-3)
    assert powers(b)["own"] == approx(2 / 3, abs=0.01)
    assert powers(b)["a"] == approx(1 / 2, abs=0.01)


def slope(x, y):
    """Log–log slope of a curve at its end."""
    return float(np.log(y[-1] / y[-2]) / np.log(x[-1] / x[-2]))


@pytest.mark.parametrize(("step", "power"), [*zip(KINDS[5:], (0, -1, -2), strict=True)])
def test_the_mean_pressure_over_the_radius_is_drawn_as_the_text_says(step, power):
    """It is the hardness less what the elastic ring lacks: within 2 % of σ_c, 0.02 of the slope."""
    state = step_state(step, preset_state())
    assert (state.tiles, state["hardness.axes"]) == (("hardness",), "log")
    course = follow(state)
    found = hardness.found(course, ("log",))
    assert all(axis.log for axis in found.axes)
    a, p = (column[np.isfinite(column)] for column in found.rows["yielding"])
    assert slope(a, p) == approx(power, abs=0.02)
    r, sigma = found.rows["hardness"]
    assert slope(r, sigma) == approx(power, abs=1e-9)
    assert p[-1] == approx(np.interp(a[-1], r, sigma), rel=0.02)
    if power == 0:
        a, p = (column[np.isfinite(column) & (column > 0)] for column in found.rows["elastic"])
        assert slope(a, p) == approx(1, rel=1e-6)
    said = step_text(step, course)
    share = float(re.search("is ([\\d.]+) of", found.note)[1])
    assert share == approx(
        course.state.mean_pressure / medium(state).hardness_at(course.state.contact_radius), rel=1e-3
    )
    assert f"p_m = {float(course.state.mean_pressure) / 1e6:#.3g} MPa" in said


def test_a_newcomer_takes_the_scene_home(explorer, opened, tmp_path):
    """Open, see first yield, change the tip, hit it, read what was destroyed, take it home as a file."""
    page = explorer.page
    explorer.press("Guide")
    for d in ("1.5", "2"):
        explorer.change(explorer.press, "Next")
        explorer.wait("(d) => explorer.row('force', 'now')[0][0].toFixed(1) === Number(d).toFixed(1)", d)
    page.get_by_role("status").get_by_text("2 of 4.").wait_for()
    explorer.choose("Shape", "Paraboloid")
    explorer.pick("impact")
    assert explorer.readout("damaged_area").endswith("m²")
    page.get_by_text("Numbers, equations, assumptions").click()
    page.get_by_text("Area π c² of the plastic zone").wait_for()
    page.get_by_text("Numbers, equations, assumptions").click()
    explorer.press("Share")
    with page.expect_download() as download:
        page.get_by_text("Scene as a file", exact=True).click()
    # The name of a download has no ending, by which the browser tells what it is.
    path = download.value.path().rename(tmp_path / "scene.html")
    taken = opened(path)
    assert "Paraboloid" in taken.page.locator("header").inner_text()
    link = taken.page.get_by_role("link", name="This scene in the explorer").get_attribute("href")
    assert link == page.url
    # Where it was left, and in a state that is elastic still: the same numbers, and the same is drawn.
    for number in (None, 20):
        if number is not None:
            page.get_by_label("State along the path").fill(str(number))
            explorer.wait("explorer.played() && explorer.idle()")
            taken.page.get_by_label("State along the path").fill(str(number))
        here, there = (each.page.locator("output").all_inner_texts() for each in (explorer, taken))
        assert here == there
        for figure, row in (("springs", "elastic"), ("pressure", "p(r)"), ("force", "now")):
            np.testing.assert_array_equal(explorer.row(figure, row), taken.row(figure, row))
    assert taken.readout("plastic_radius") == "0"
    taken.page.close()
