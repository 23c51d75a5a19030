"""Readouts above the plots: values, balances, units and meanings."""

import re
from html import unescape
from math import pi, sqrt

import numpy as np
import pytest

import mdr_core as mdr
from app.common import ui
from app.common.quantities import CHOICES, QUANTITIES, unicode_subscripts
from app.common.ui import CSS
from app.explorer import changes, link, readouts
from app.explorer.drives import follow, scene_of
from app.explorer.page import Page
from app.explorer.plots import force
from app.explorer.readouts import READOUTS, explained, heads, line
from app.explorer.state import PRESETS, medium, preset_state

from ...approx import approx
from ..conftest import DROP, ELASTIC
from ..states import SILICA, numbers, oblique_state, part, solved, state_with, view_of, viscous

#: A power of ten in a readout: no preset has a result below a thousandth of the smallest unit.
TINY = re.compile(r"× 10⁻")


@pytest.mark.parametrize("key", PRESETS)
@pytest.mark.parametrize("drive", ["depth", "force", "path", "impact"])
@pytest.mark.parametrize("at", [0.0, 1.0, 2.0, 2.2])
def test_no_readout_is_a_rounding_error_at_the_ends_of_a_path(key, drive, at):
    state = state_with(key, drive).replace(at=at)
    course = follow(state)
    shown = {each.name: readouts.text(each, v, course.now) for each, v in readouts.readings(course).items()}
    assert [text for text in shown.values() if TINY.search(text)] == []
    if at == 2.2 and drive in ("depth", "force") and not course.adhesive:
        assert shown["depth"] == shown["force"] == "0"


def test_every_number_says_what_it_is():
    for drive in ("depth", "impact", "oblique"):
        course = follow(state_with(DROP, drive, damping="eta"))
        numbers = line(course)
        # In the notes with their equations, and where they are pointed at.
        assert 6 <= explained(numbers).count("<dd>") == heads(numbers).count(' title="') <= 8
        assert all(
            unicode_subscripts(each.help.split(".")[0]) in unescape(heads(numbers)) for each in numbers
        )
    assert all(each.help.endswith(".") for each in (*READOUTS, *QUANTITIES.values()))
    assert all(". " in quantity.help and quantity.equation for quantity in QUANTITIES.values())
    options = [option for choice in CHOICES.values() for option in choice.options.values()]
    assert {name for option in options for name in option.uses} <= QUANTITIES.keys()
    assert {name for option in options for name in option.form} <= CHOICES.keys()
    assert len({each.name for each in READOUTS}) == len(READOUTS)
    assert all(choice.label and choice.help for choice in CHOICES.values())


@pytest.mark.parametrize("progress", [0.7, 1.0, 1.5])
def test_energies_of_a_viscous_impact_add_up_in_every_state(progress):
    course = follow(viscous().replace(at=progress))
    parts = ("stored_energy", "plastic_work", "viscous_work", "kinetic_energy")
    assert sum(numbers(course)[name][course.now] for name in parts) == approx(2.75, rel=1e-6)
    helps = {each.name: each.help for each in readouts.READOUTS}
    assert "Without dashpots" in helps["stored_energy"]
    assert "Without dashpots" in helps["mean_pressure"]


def test_no_readout_is_infinite_without_yield():
    assert "never cut" not in (ui.HERE / "explorer" / "extras" / "guide.html").read_text(encoding="utf-8")
    course = follow(state_with(plasticity="none"))
    said = {readouts.text(each, values, course.now) for each, values in readouts.readings(course).items()}
    assert "∞ m" not in said
    assert "line load" in QUANTITIES["q_c"].help
    equations = {each.name: each.equation for each in readouts.READOUTS}
    assert equations["yield_force"].startswith("(22)")


def test_a_line_has_at_most_as_many_numbers_as_there_is_room_for():
    """Eight, each of which stands beside the others at 1280 pixels."""
    assert "repeat(8," in CSS
    for drive, option in CHOICES["drive"].options.items():
        assert len(option.line) <= readouts.MOST, drive


def test_the_readout_of_friction_is_the_work_so_far():
    page = Page(f"preset={DROP}&drive=oblique")
    heads = part(page, "heads").look["object"]
    assert "friction so far" in heads


def test_speed_of_onset_is_a_readout():
    hit = changes.choose(preset_state(), "drive", "impact")
    assert 0 < numbers(follow(hit))["yield_speed"] < hit.speed


def test_the_speed_and_depth_of_onset_are_those_of_the_energy():
    """Paraboloid, class (b): U = (8/15) E* √R d_y^(5/2) is m v_y²/2; over an imprint d_y = d_0 + d_c."""
    state = preset_state(DROP)
    made = medium(state)
    d_c = float(made.critical_depth)
    energy = 8 / 15 * made.E_star * state.paraboloid_radius**0.5 * d_c**2.5
    speed = (2 * energy / state.mass) ** 0.5
    assert numbers(follow(state))["yield_speed"] == approx(speed, rel=1e-9)
    for factor, yields in ((0.999, False), (1.001, True)):
        course = follow(state.replace(speed=factor * speed))
        assert bool(numbers(course)["damaged_area"] > 0) is yields
    again = numbers(follow(state.replace(plastic_depth=2 * d_c)))
    np.testing.assert_allclose(again["relative_depth"], again["depth"] / (3 * d_c), rtol=1e-9)
    viscous = state_with(DROP, damping="eta")
    for other in (state.replace(plastic_depth=2 * d_c), viscous, state_with(DROP, plasticity="none")):
        assert "yield_speed" not in numbers(follow(other))


def test_a_drop_on_a_viscous_medium_has_the_work_of_the_dashpots():
    """With what is stored, plastic and kinetic it is the energy of the body, also at the end."""
    course = solved(state_with(DROP, damping="eta"))
    shown = {each.name: values for each, values in readouts.line(course).items()}
    assert float(shown["viscous_work"][-1]) > 0
    drive = course.scene.drive
    kinetic = drive.mass * course.motion.velocity**2 / 2
    balance = kinetic + course.motion.stored_energy + shown["plastic_work"] + shown["viscous_work"]
    # The viscous solver keeps the balance to 10⁻⁶.
    np.testing.assert_allclose(balance, drive.mass * drive.speed**2 / 2, rtol=2e-6)
    assert "viscous_work" not in {each.name for each in readouts.line(solved(state_with(DROP)))}


def test_numbers_of_the_rebound_are_those_of_the_ball():
    course = solved(oblique_state())
    found, drive = numbers(course), course.scene.drive
    body = mdr.Ball(drive.mass, float(course.scene.profile.body_radius))
    assert drive.tangential_mass == approx(float(body.tangential_mass))
    hit = course.motion.impact
    speed, spin = body.rebound(hit, drive.tangential_speed)
    assert found["body_speed"] == approx(float(speed), rel=1e-12)
    assert found["spin"] == approx(float(spin), rel=1e-12)
    assert found["body_angle"] == approx(np.arctan2(float(hit.normal.rebound_speed), float(speed)))
    assert found["tangential_restitution"] == approx(float(hit.tangential_restitution), rel=1e-12)
    # A tip that belongs to no ball has no radius to turn about; what cannot turn has no spin.
    assert "spin_speed" in numbers(follow(state_with(ELASTIC, "oblique", body="solid", shape="cone")))
    assert not {"spin", "spin_speed"} & numbers(follow(state_with(ELASTIC, "oblique", body="block"))).keys()


def test_after_another_hit_depth_and_force_of_yield_belong_together():
    hit = scene_of(preset_state(DROP)).solve()
    state = changes.hit_again(preset_state(DROP))
    course = follow(state)
    again = float(hit.plastic_depth) + medium(state).critical_depth
    assert numbers(course)["yield_force"] == approx(float(course.onset.force))
    np.testing.assert_allclose(force(view_of(state), 0)["onset of yield"][0], again)


def test_the_onset_of_yield_at_constant_hardness_is_that_of_the_shape():
    """Paraboloid: s − k √(R s) = d_0 with k = π H/(2E*); a cone yields from first touch, or never."""
    state = state_with("striker-glass_epoxy-drop-weight", plasticity="constant")
    R, k = state.paraboloid_radius, pi * state.volume_hardness / (2 * state.E_star)
    assert numbers(follow(state))["critical_depth"] == approx(k**2 * R, rel=1e-9)
    for imprint in (0.0, 2e-5):
        root = (k * sqrt(R) + sqrt(k**2 * R + 4 * imprint)) / 2
        again = follow(changes.put(state, "plastic_depth", imprint))
        assert numbers(again)["critical_depth"] == approx(root**2, rel=1e-9)
    pressed = follow(changes.choose(state, "drive", "depth"))
    shown = numbers(pressed)
    np.testing.assert_allclose(shown["relative_depth"], pressed.states.depth / (k**2 * R), rtol=1e-9)
    # H < E* s, and above.
    cone = preset_state(SILICA)
    for hardness, says in (
        (cone.volume_hardness, "at first contact"),
        (3e10, "Nothing yields under this shape"),
    ):
        query = link.write(changes.put(cone, "volume_hardness", hardness))
        page = Page(query)
        assert says in part(page, "note medium").look["object"]
        assert "relative_depth" not in numbers(page.view.course)
