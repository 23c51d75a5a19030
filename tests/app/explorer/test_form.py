"""The form: choices, groups that open and close, and the order of requests."""

import re
from html import unescape

import pytest

from app.explorer import changes
from app.explorer.changes import choose, set_value
from app.explorer.drives import follow
from app.explorer.page import Page
from app.explorer.state import PRESETS, changed_from_preset, medium, preset_state

from ...approx import approx
from ..conftest import DROP, GOLD, PUNCH
from ..states import SHAPED, assert_draws, fields_of, note, part, press, state_with


def test_the_form_begins_with_the_drive_and_has_what_is_used():
    page = Page()
    form = page.layout.form.view
    assert fields_of(form) == ["max_depth", "cone_slope", "E_star", "q_c"]
    assert not part(page, "More about the medium").look["pressed"]
    press(page, "More about the medium")
    sources = unescape(part(page, "note sources").look["object"])
    assert all(source in sources for source in PRESETS[page.state.preset].sources.values())
    page.apply(lambda state: changes.choose(state, "damping", "eta"))
    assert part(page, "More about the medium").look["pressed"]
    assert "eta" in fields_of(form)
    idle = note(page, "more")
    page.apply(lambda state: changes.choose(state, "drive", "impact"))
    # A viscosity acts in an impact, and not while a depth is set slowly.
    assert idle != note(page, "more")
    assert fields_of(form)[:3] == ["mass", "speed", "plastic_depth"]
    page.apply(lambda state: changes.choose(state, "drive", "oblique"))
    page.apply(lambda state: changes.choose(state, "drive", "depth"))
    assert fields_of(form)[:2] == ["max_depth", "cone_slope"]


def test_typing_the_modulus_of_two_bodies_unfolds_nothing_and_what_is_unfolded_is_folded_again():
    page = Page()
    page.apply(lambda state: set_value(state, "E_star", 60e9))
    assert PRESETS[GOLD].values["E_1"] != page.state.E_1
    more = "More about the medium"
    assert part(page, more).look["pressed"] is False
    # A viscosity is seen when it comes, and may be folded.
    page.apply(lambda state: choose(state, "damping", "eta"))
    assert part(page, more).look["pressed"] is True
    assert not part(page, more).look["disabled"]
    press(page, more)
    assert part(page, more).look["pressed"] is False
    page.apply(lambda state: set_value(state, "q_c", 50.0))
    assert part(page, more).look["pressed"] is False


@pytest.mark.parametrize("shape", SHAPED)
def test_a_shape_that_was_looked_at_keeps_its_values(shape):
    state = changes.choose(state_with(shape=shape), "shape", "sphere" if shape == "cone" else "cone")
    assert state.cone_slope == 0.358
    assert not changed_from_preset(changes.choose(state, "shape", "cone"))


def test_a_sphere_has_the_radius_of_the_paraboloid_before_it():
    state = state_with(shape="paraboloid")
    assert changes.choose(state, "shape", "sphere").sphere_radius == state.paraboloid_radius


def test_E_star_of_two_bodies_and_q_c_of_a_hardness_can_be_set():
    state = changes.set_value(preset_state(), "E_star", 5e10)
    assert state.elasticity == "bodies"
    assert medium(state).E_star == approx(5e10, rel=1e-12)
    assert medium(state).poisson == 0.42
    state = changes.set_value(state_with(plasticity="hardness"), "q_c", 50.0)
    assert medium(state).q_c == approx(50.0, rel=1e-12)


def test_a_number_out_of_bounds_is_refused_with_its_symbol_and_bounds():
    with pytest.raises(ValueError, match=r"dₘₐₓ = 1000 m .* 10\.00 m"):
        changes.set_value(preset_state(), "max_depth", 1000.0)


def test_the_viscosity_stays_where_damping_is_turned_off_and_on():
    state = changes.set_value(changes.choose(preset_state(DROP), "damping", "eta"), "eta", 123.0)
    assert changes.choose(state, "damping", "none").eta == 123.0


def test_hit_again_pressed_while_the_drive_changes_is_refused(page):
    page.choose("preset", DROP)
    again = part(page, "Hit again")
    page.choose("drive", "depth")
    again.act(None)
    assert page.notices
    assert page.state.plastic_depth == 0


def test_an_impact_after_pressing_is_as_deep_and_on_a_virgin_surface():
    state = changes.repeat_impact(preset_state("ball-steel"))
    pressed = changes.choose(state, "drive", "depth")
    hit = changes.choose(pressed, "drive", "impact")
    assert hit.plastic_depth == 0
    assert float(follow(hit).turning_point.depth) == approx(pressed.max_depth, rel=1e-4)


def test_of_choices_in_quick_succession_the_last_one_counts_and_all_are_drawn(explorer):
    """The first is sent at once; what is chosen before it is answered waits, and replaces what waits."""
    explorer.page.evaluate("""() => {
      const drives = explorer.all().filter((on) => on.matches(".of-drive input"))
      for (const drive of drives.slice(1).concat(drives[1], drives[3])) drive.click()
    }""")
    explorer.wait("explorer.idle()")
    assert explorer.page.locator(".of-drive input:checked").get_attribute("value") == "impact"
    # One step of undo for the first one, one for the last.
    explorer.change(explorer.press, "Undo")
    explorer.change(explorer.press, "Undo")
    assert explorer.page.locator(".of-drive input:checked").get_attribute("value") == "depth"
    assert not explorer.page.get_by_role("button", name="Undo", exact=True).is_visible()
    for key in (PUNCH, "berkovich-pdms"):
        explorer.choose("Preset", PRESETS[key].label)
        assert_draws(explorer, preset_state(key))
    state = preset_state("berkovich-pdms")
    explorer.choose("Shape", "Sphere")
    state = changes.choose(state, "shape", "sphere")
    assert_draws(explorer, state)
    explorer.press("More about the medium")
    for text, *choice in (
        ("force", "drive", "force"),
        ("E*", "elasticity", "modulus"),
    ):  # fmt: skip
        explorer.pick(text)
        state = changes.choose(state, *choice)
        assert_draws(explorer, state)
    # The sources of the preset are told to be those of another scene.
    assert explorer.page.get_by_text(re.compile("^Altered")).first.is_visible()
    # Elements of the page after many changes of drive are as many as before.
    counts = []
    for _ in range(2):
        for drive in ("depth", "path", "impact", "oblique", "force"):
            explorer.pick(drive)
        counts.append(explorer.page.evaluate("explorer.all().length"))
    assert counts[1] == approx(counts[0], rel=0.05)
