"""Every drive gives states along its path through one interface, and what it says is what the core says."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.common.quantities import CHOICES
from app.explorer import changes, readouts
from app.explorer.drives import DRIVES, follow, scene_of
from app.explorer.extras import notes, share
from app.explorer.link import summary
from app.explorer.plot import View
from app.explorer.plots import force
from app.explorer.state import PRESETS, medium, preset_state, profile

from ..approx import approx
from .conftest import DROP, ELASTIC
from .states import linked_state, numbers, solved, state_with, view_of


def path(pattern, **choices):
    state = changes.choose(state_with(**choices), "drive", "path")
    return changes.choose(state, "path.pattern", pattern)


@pytest.mark.parametrize("damping", ["none", "eta"])
@pytest.mark.parametrize("drive", DRIVES)
def test_every_drive_gives_the_same_interface(drive, damping):
    state = state_with(DROP, drive, damping=damping)
    if drive == "path" and damping == "eta":
        state = changes.choose(state, "path.pattern", "hold")
    course = solved(state)
    states, count = course.states, len(course)
    for name in (
        "depth", "force", "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure",
        "stored_energy", "plastic_work",
    ):  # fmt: skip
        assert np.shape(getattr(states, name)) == (count,), name
    assert states.live_interval.lower.shape == states.live_interval.length.shape == (count,)
    assert np.all(np.diff(course.progress) >= 0)
    assert course.progress[course.peak] == 1.0
    state = states[course.peak]
    r = float(state.contact_radius) * np.array([0.1, 0.5, 1.2])
    for field in (state.pressure, state.line_load, state.surface, state.imprint):
        assert np.shape(field(r)) == (3,)
    assert 6 <= len(readouts.line(course)) <= 8
    assert set(DRIVES) == set(CHOICES["drive"].options)


@pytest.mark.parametrize("drive", [each for each in DRIVES if each != "depth"])
def test_another_drive_is_shown_at_its_largest_depth(drive):
    """Also where the indenter had been lifted: else the page shows no contact and F = 0."""
    lifted = preset_state().replace(at=2.1)
    assert float(follow(lifted).state.force) == 0
    course = follow(changes.choose(lifted, "drive", drive))
    assert course.now == course.peak
    assert float(course.state.force) > 0


@pytest.mark.parametrize("pattern", CHOICES["path.pattern"].options)
def test_a_pattern_goes_as_deep_as_what_was_there_before_and_is_in_link_and_csv(pattern):
    state = path(pattern)
    course = solved(state)
    # A force that is found has the five digits that its field shows.
    assert float(course.turning_point.depth) == approx(preset_state().max_depth, rel=5e-5)
    assert scene_of(linked_state(state)) == course.scene
    assert CHOICES["path.pattern"].options[pattern].label in summary(state)
    lines = share.csv(View(state, course)).splitlines()
    assert sum(line[0] != "#" for line in lines) == 1 + len(course)


def test_hysteresis_yields_once_a_cycle_and_reloads_elastically():
    state = path("cycles")
    # The first cycle ends where yield begins.
    depth = 5 * medium(state).critical_depth
    view = view_of(state.replace(max_depth=depth))
    assert len(force(view, 0)["path ahead"][0]) == len(view.course)
    rows = force(view, len(view.course) - 1)
    yielding, elastic = rows["yielding"][0], rows["elastic"][0]
    peaks = depth * np.arange(1, 6) / 5
    stretches = np.split(yielding, np.flatnonzero(np.isnan(yielding)))
    ends = [[part[~np.isnan(part)][k] for part in stretches] for k in (0, -1)]
    np.testing.assert_allclose(ends, [peaks[:-1], peaks[1:]], rtol=1e-9)
    # One goes back elastically to where the cycle before began to unload.
    assert np.nanmax(elastic) == approx(peaks[-2], rel=1e-9)


@pytest.mark.parametrize("shape", ["cone", "sphere"])
def test_a_held_ramp_of_a_viscous_medium_is_that_of_the_core(shape):
    state = path("hold", shape=shape, damping="eta")
    course = solved(state)
    time, made = course.motion.time, medium(state)
    exact = mdr.indent_in_time(profile(state), made, course.states.depth, time)
    # What the page asks of the chain is 3·10⁻³.
    np.testing.assert_allclose(course.states.force, exact.force, atol=3e-3 * exact.force.max())
    assert numbers(course)["chain_error"] == course.states.error
    # At the end of the hold the dashpots carry nothing: F of the springs alone.
    still = mdr.indent(profile(state), made, course.states.depth)
    assert course.states.force[-1] == approx(float(still.force[-1]), rel=1e-3)
    # All that has been put in is in the ledger, by the trapezoidal rule over 24 steps a piece.
    motion = course.motion
    ledger = motion.stored_energy + motion.plastic_work + motion.viscous_work
    assert ledger[-1] == approx(trapezoid(motion.force, motion.depth), rel=0.02)
    # Away from the rim the pressure is the core's; elements between 300 places are straight.
    i = course.peak // 2
    one = course.states[i]
    r = float(one.contact_radius) * np.linspace(0.02, 0.98, 40)
    exact = mdr.indent_in_time(profile(state), made, course.states.depth[: i + 1], time[: i + 1])[-1]
    np.testing.assert_allclose(one.pressure(r), exact.pressure(r), atol=3e-3 * one.pressure(r).max())
    assert np.isinf(one.pressure(float(one.contact_radius)))
    # While nothing has been released dashpots do not move the surface.
    r = float(one.contact_radius) * np.array([0.5, 1.01, 1.5, 3.0])
    np.testing.assert_allclose(one.surface(r), still[i].surface(r), rtol=1e-3)
    np.testing.assert_allclose(one.imprint(r), still[i].imprint(r), rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("plasticity", ["q_c", "constant"])
def test_creep_is_that_of_the_core(plasticity):
    """At once, with as many states as are drawn; of a glass or a metal, too."""
    state = path("creep", damping="eta", plasticity=plasticity)
    course = follow(state)
    assert not course.pending
    assert np.all(np.diff(course.states.depth) > 0)
    exact = mdr.creep(
        profile(state), medium(state), course.states.force, course.motion.time, tolerance=1e-9
    )
    np.testing.assert_allclose(course.states.depth, exact.depth, rtol=0, atol=3e-3 * exact.depth[-1])
    # It creeps towards what the springs alone carry.
    slow = mdr.indent_to_force(profile(state), medium(state), state.max_force)
    assert 0.7 < course.states.depth[-1] / slow.depth < 1


def oblique_state(key=ELASTIC, **numbers):
    numbers = {"oblique.attack": 0.9, "oblique.friction": 0.5} | numbers
    return state_with(key, "oblique", body="solid").replace(**numbers)


@pytest.mark.parametrize("key", [ELASTIC, DROP, "berkovich-fused_silica", "ball-steel"])
def test_a_move_is_right_to_three_digits(key):
    state = oblique_state(key)
    rough, full = follow(state), solved(state)
    assert (bool(rough.pending), bool(full.pending)) == (True, False)
    hit, size = scene_of(state).solve(), state["oblique.incoming_speed"]
    for course, error in ((rough, 2e-3), (full, 1e-4)):
        found = numbers(course)
        assert found["friction_work"][-1] == approx(float(hit.friction_work), rel=error)
        assert found["max_tangential_force"] == approx(float(hit.max_tangential_force), rel=error)
        after = course.rebound.contact_velocity
        assert after == approx(float(hit.tangential_velocity), abs=error * size)


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


def test_looking_at_the_other_impact_keeps_body_and_normal_speed():
    before = scene_of(preset_state(DROP)).drive
    state = state_with(DROP, "oblique")
    drive = scene_of(state).drive
    assert (drive.mass, drive.speed) == approx((before.mass, before.speed), rel=1e-12)
    back = scene_of(changes.choose(state, "drive", "impact")).drive
    assert back.speed == approx(before.speed, rel=1e-12)


def test_another_drive_goes_as_deep_as_a_hit_on_an_imprint_and_as_a_viscous_path():
    d_c = float(medium(preset_state(DROP)).critical_depth)
    # At these speeds the imprint grows, and does not.
    hits = [state_with(DROP).replace(plastic_depth=20 * d_c, speed=speed) for speed in (1.0, 0.01)]
    for state in (*hits, path("hold", damping="eta")):
        depth = float(follow(state).turning_point.depth)
        for drive in ("depth", "force"):
            pressed = follow(changes.choose(state, "drive", drive))
            assert float(pressed.turning_point.depth) == approx(depth, rel=5e-4)


def test_presets_are_within_what_the_model_assumes():
    for key in PRESETS:
        levels = [level for level, _ in notes.limits(follow(preset_state(key)), preset_state(key))]
        assert "beyond" not in levels, key


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


def test_a_drop_on_a_viscous_medium_says_what_the_dashpots_lose():
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
