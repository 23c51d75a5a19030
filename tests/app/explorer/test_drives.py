"""Drives: states along the path, creep, oblique impacts, and changes from one to another."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.common.quantities import CHOICES
from app.explorer import changes, readouts
from app.explorer.drives import DRIVES, EXACT, follow, scene_of
from app.explorer.extras import oblique, share
from app.explorer.extras.share import csv
from app.explorer.link import summary
from app.explorer.plot import View
from app.explorer.state import PRESETS, medium, preset_state, profile

from ...approx import approx
from ..conftest import DROP, ELASTIC
from ..states import STEEL, amounts, linked_state, numbers, oblique_state, path, solved, state_with, view_of


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


@pytest.mark.parametrize("key", [ELASTIC, STEEL])
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


def test_creep_has_more_states_where_it_is_fast_and_its_ramp_takes_the_relaxation_time():
    """Half of the states of the hold are in its first tenth. A ramp as long as τ shows the creep."""
    state = path("creep", damping="eta")
    time, force = solved(state).motion.time, solved(state).states.force
    held_at = np.flatnonzero(force >= 0.999 * force.max())
    share = (time[held_at] - time[held_at[0]]) / np.ptp(time[held_at])
    assert np.mean(share < 0.1) > 0.5
    assert state["path.ramp_time"] == approx(float(medium(state).relaxation_time), rel=0.02)


@pytest.mark.parametrize(("angle", "body", "sticks"), [(30, "block", False), (60, "solid", True)])
def test_an_oblique_impact_says_whether_it_sticks(angle, body, sticks):
    """As the core says of the solved impact; at the times in which its elements stick."""
    chosen = {"oblique.attack": np.radians(angle), "oblique.body": body}
    state = state_with(DROP, "oblique").replace(**chosen)
    course = solved(state)
    assert bool(course.motion.impact.slips_throughout) is not sticks
    text = oblique.forces(view_of(state), 0)["regime"][2]
    assert text.startswith("slips")
    ends = course.motion.time[np.flatnonzero(course.motion.stick_radius > 0)][[0, -1]] if sticks else []
    assert amounts(text) == approx(ends, rel=0.02)


@pytest.mark.parametrize("key", PRESETS)
def test_a_path_ends_exactly_at_the_depth_that_is_asked_for_and_at_the_surface(key):
    """In the exported table, too: the last row is the indenter at the undeformed surface, without force."""
    state = preset_state(key)
    if state.drive != "depth":
        state = changes.choose(state, "drive", "depth")
    view = view_of(state)
    depth = view.course.states.depth
    assert float(depth.max()) == state.max_depth
    assert depth[-1] == 0.0
    *_, head, last = [line.split(",") for line in csv(view).splitlines() if line[0] != "#"][:: len(depth)]
    columns = dict(zip(head, last, strict=True))
    at = [text for name, text in columns.items() if " d (m)" in name or " F (N)" in name]
    assert at == ["0.0", "0.0"]


def test_an_exact_course_is_found_again_once_others_have_taken_its_place(page):
    page.choose("preset", "ball-glass_epoxy")
    page.choose("drive", "oblique")
    page._input_rests()
    assert not page.view.course.pending
    EXACT.clear()
    page.apply(lambda state: state.replace(dark=True))
    assert page.view.course.pending
    page._input_rests()
    assert not page.view.course.pending


def test_an_oblique_impact_a_path_and_a_section_are_found_at_rest(explorer):
    explorer.choose("Preset", PRESETS[ELASTIC].label)
    explorer.pick("oblique")
    explorer.page.get_by_label("Fourth plot").select_option(label="Friction")
    hit = scene_of(state_with(ELASTIC, "oblique")).solve()
    explorer.wait("explorer.model('forces')")
    explorer.page.locator(".lights span", has_text="so far").wait_for(state="hidden")
    explorer.link("tiles=forces")
    _, force = explorer.row("forces", "tangential force Fₓ")
    assert np.max(np.abs(force)) == approx(float(hit.max_tangential_force), rel=1e-3)
    explorer.pick("path")
    explorer.choose("Pattern", "five cycles, growing")
    explorer.change(explorer.type, "d_max", "8 µm")
    explorer.open("Section", "section", "contact radius a")
    state = state_with(ELASTIC, "path", pattern="cycles").replace(max_depth=8e-6)
    a = float(follow(state).turning_point.contact_radius)
    found = "(a) => Math.abs(explorer.row('section', 'contact radius a')[0][0] / a - 1) < 1e-3"
    explorer.wait(found, a * 1e6)
