"""Readouts above the plots: values, balances, units and meanings."""

import re
from html import unescape
from math import pi, sqrt

import numpy as np
import pytest

import mdr_core as mdr
from app.common.quantities import CHOICES, QUANTITIES, unicode_subscripts
from app.explorer import changes, link, readouts
from app.explorer.drives import follow, scene_of
from app.explorer.page import Page
from app.explorer.plots import force
from app.explorer.readouts import READOUTS, explained, heads, line
from app.explorer.state import PRESETS, medium, preset_state

from ...approx import approx
from ..conftest import DROP, ELASTIC
from ..states import SILICA, note, numbers, oblique_state, part, solved, state_with, view_of, viscous

#: A power of ten in a readout: no preset has a result below a thousandth of the smallest unit.
TINY = re.compile(r"× 10⁻")


@pytest.mark.parametrize("key", PRESETS)
def test_no_readout_is_a_rounding_error_at_the_ends_of_a_path(key):
    for drive in ("depth", "force", "path", "impact"):
        state = state_with(key, drive)
        for at in (0.0, 1.0, 2.0, 2.2):
            course = follow(state.replace(at=at))
            readings = readouts.readings(course).items()
            shown = {each.name: readouts.text(each, values, course.now) for each, values in readings}
            assert [text for text in shown.values() if TINY.search(text)] == [], (drive, at)
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


def test_no_readout_is_infinite_without_yield():
    course = follow(state_with(plasticity="none"))
    shown = {readouts.text(each, values, course.now) for each, values in readouts.readings(course).items()}
    assert "∞ m" not in shown


@pytest.mark.parametrize("drive", CHOICES["drive"].options)
def test_a_line_has_at_most_as_many_numbers_as_there_is_room_for(drive):
    """Eight are beside each other at 1280 pixels."""
    assert len(CHOICES["drive"].options[drive].line) <= readouts.MOST == 8


def test_the_readout_of_friction_is_the_work_so_far():
    page = Page(f"preset={DROP}&drive=oblique")
    assert "friction so far" in part(page, "heads").look["object"]


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


def test_energies_of_a_viscous_impact_add_up_in_every_state():
    """Kinetic, stored, plastic and viscous energy: 5.5 kg at 1 m/s. A dry medium has no viscous work."""
    found = numbers(solved(viscous()))
    parts = ("stored_energy", "plastic_work", "viscous_work", "kinetic_energy")
    assert found["viscous_work"][-1] > 0
    # The viscous solver keeps the balance to 10⁻⁶.
    np.testing.assert_allclose(sum(found[name] for name in parts), 2.75, rtol=2e-6)
    assert "viscous_work" in {each.name for each in readouts.line(follow(viscous()))}
    assert "viscous_work" not in {each.name for each in readouts.line(follow(state_with(DROP)))}


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
    state = changes.repeat_impact(preset_state(DROP))
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
        again = follow(changes.set_value(state, "plastic_depth", imprint))
        assert numbers(again)["critical_depth"] == approx(root**2, rel=1e-9)
    pressed = follow(changes.choose(state, "drive", "depth"))
    shown = numbers(pressed)
    np.testing.assert_allclose(shown["relative_depth"], pressed.states.depth / (k**2 * R), rtol=1e-9)
    # H < E* s, and above.
    cone = preset_state(SILICA)
    for hardness, says in ((cone.volume_hardness, "at first contact"), (3e10, "Nothing yields")):
        page = Page(link.write(changes.set_value(cone, "volume_hardness", hardness)))
        assert says in note(page, "medium")
        assert "relative_depth" not in numbers(page.view.course)
