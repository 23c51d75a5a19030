"""The sweep: single scenes, limits of the paper, other classes, axes and notes."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app.common.host import Sliced, last
from app.common.units import in_full
from app.explorer import changes
from app.explorer.drives import follow, scene_of
from app.explorer.extras import sweep
from app.explorer.extras.guide import TOURS, step_state
from app.explorer.page import Page
from app.explorer.search import FAULT
from app.explorer.state import OPENING, PRESETS, medium, preset_state, profile

from ...approx import approx
from ..conftest import DROP, PUNCH
from ..states import STEEL, full_name, linked_state, press, rested, state_with, unit, view_of


def swept(state, **choices):
    state = state.replace(**{full_name(name): value for name, value in choices.items()})
    asked = sweep.asked(state)
    return state, asked, last(sweep.found(follow(state), asked))


def one(state, name, value, quantity):
    """A quantity of the scene with another value of one number, as the page itself would show it."""
    if name == "energy":
        name, value = "speed", (2 * value / state.mass) ** 0.5
    course = follow(linked_state(state.replace(**{name: float(value)})))
    return float(getattr(course.hit or course.turning_point, quantity))


@pytest.mark.parametrize("drive", ["impact", "depth", "force"])
def test_every_number_is_swept_as_one_scene_at_a_time(drive):
    state = state_with(OPENING, drive)
    for name in changes.options(state, "sweep.swept"):
        state, asked, found = swept(state, swept=name, against="plastic_work")
        numbers, values = found.rows["this scene"]
        # What is 0 has no place on a logarithmic axis.
        values = np.nan_to_num(values)
        assert (numbers[0], numbers[-1]) == approx((asked.low, asked.high), rel=1e-12)
        for k in (0, 50, 80):
            expected = one(state, name, numbers[k], "plastic_work")
            # Inverse functions are found to some units of rounding, times a condition of some tens.
            assert values[k] == approx(expected, rel=1e-11, abs=1e-11 * values.max()), name
        x, y = (float(part[0]) for part in found.rows["present value"])
        assert x == asked.present
        assert np.interp(x, numbers, values) == approx(y, rel=2e-2)


def test_a_viscous_impact_is_swept_over_its_relaxation_time_at_rest():
    state = state_with(DROP, damping="eta").replace(eta=3e4)
    state, asked, found = swept(state, swept="eta", against="restitution")
    numbers, values = found.rows["this scene"]
    assert not sweep.quick(asked)
    assert values[20] == approx(one(state, "eta", numbers[20], "restitution"), rel=1e-9)
    # The limit of fast impacts is without viscosity.
    assert sweep.FAST not in found.rows
    state = changes.choose(state, "damping", "none")
    assert "eta" not in changes.options(state, "sweep.swept")
    assert changes.option(state, "sweep.swept") == "energy"


@pytest.mark.parametrize(("shape", "power"), [("cone", 1.0), ("paraboloid", 2 / 3)])
def test_the_damaged_area_comes_to_the_fast_limit_and_its_power_of_the_energy(shape, power):
    """Popov (2015), Eq. (24): A = 4W/(π q_c s) of a cone; class (b) in general 2/(n + 1)."""
    state = state_with(DROP, shape=shape)
    # Energies from 1e4 J on.
    speed = (2 * 3e6 / state.mass) ** 0.5
    state, asked, found = swept(state, swept="energy", speed=speed, against="damaged_area")
    # Of a closed form it follows a drag.
    assert sweep.quick(asked)
    (W, area), (_, fast) = found.rows["this scene"], found.rows[sweep.FAST]
    if shape == "cone":
        np.testing.assert_allclose(fast, 4 * W / (np.pi * state.q_c * state.cone_slope), rtol=1e-12)
    slopes = np.diff(np.log(area)) / np.diff(np.log(W))
    # What is missing of the limit falls as d_c/d.
    assert slopes[-1] == approx(power, rel=2e-2)
    assert abs(area[-1] / fast[-1] - 1) < abs(area[0] / fast[0] - 1) < 0.2


def test_other_classes_of_hardness_are_solved_through_the_present_point():
    """Under a ball all of the contact yields in the end: A ∝ W^(2/(2 + i)), e² ∝ W^(−i'/(2 + i)), § 20.

    The constant is rounded by up to 5·10⁻⁵, and the result goes at most as its square.
    """
    for key in (DROP, STEEL):
        state = changes.choose(state_with(key, shape="paraboloid"), "drive", "impact").replace(speed=30.0)
        for against, powers in (
            ("damaged_area", (1 / 2, 2 / 3, 1)),
            ("restitution", (-1 / 8, -1 / 3, -3 / 4)),
        ):
            asked = sweep.asked(state.replace(**{"sweep.against": against}))
            curves = dict(asked.classes())
            own = "(a)" if key == STEEL else "(b)"
            assert [row[:3] for row in curves] == [each for each in ("(a)", "(b)", "(c)") if each != own]
            (result,) = asked.column(np.array([asked.present]), against)
            for row, other in curves.items():
                constant = sweep.CLASSES[row][1]
                given = state.replace(
                    plasticity=other.state.plasticity, **{constant: other.state[constant]}
                )
                assert one(given, "speed", 30.0, against) == approx(result, rel=1e-4)
                energy = 1e6 * asked.present * np.array([1.0, 1.1])
                far = np.diff(np.log(other.column(energy, against))) / np.log(1.1)
                assert far[0] == approx(powers["abc".index(row[1])], abs=5e-3), (row, against)


def test_the_note_has_the_constants_and_powers_of_all_classes():
    """Popov's cone: e falls as W^(−1/4), of constant hardness it is the same at every speed."""
    _, asked, found = swept(state_with(DROP, shape="cone").replace(speed=20.0), against="restitution")
    note = re.sub("<su[bp]>|</su[bp]>", "", found.note)
    own, a, c = map(float, re.findall(r" W(\S+?)[.;,]? ", note.replace("−", "-") + " "))
    assert own == approx(-1 / 4, abs=2e-3)
    assert a == 0
    assert c < -3 / 4
    by_row = dict(asked.classes())
    H, f_c = (by_row[row].state[name] for row, (_, name) in sweep.CLASSES.items() if name != "q_c")
    assert in_full(H, "pressure") in note
    assert in_full(f_c, "force") in note


def test_nothing_is_drawn_of_other_classes_where_nothing_yields():
    _, asked, found = swept(state_with(DROP).replace(speed=0.01), against="restitution")
    assert dict(asked.classes()) == {}
    assert "Nothing yields at the present value" in found.note
    adhesive = swept(state_with("microsphere-pdms", "impact", adhesion="work"))[1]
    constant = swept(state_with(DROP), swept="q_c")[1]
    assert dict(adhesive.classes()) == dict(constant.classes()) == {}


def test_axes_are_logarithmic_where_the_result_allows():
    """Ratios too, unless the ball is held somewhere, e = 0."""
    for state, logs in (
        (state_with(DROP), (True, True)),
        (state_with(DROP).replace(**{"sweep.scale": "linear"}), (False, False)),
        (step_state(TOURS["It bounces only between two speeds"][0], state_with()), (True, False)),
    ):
        _, _, found = swept(state, against="restitution")
        assert tuple(axis.log for axis in found.axes) == logs
        assert found.axes[1].start <= np.nanmin(found.rows["this scene"][1])


def test_what_cannot_be_solved_ends_the_curve_and_is_said():
    state, _, found = swept(state_with(PUNCH, "force"), swept="max_force", against="depth")
    numbers, values = found.rows["this scene"]
    most = np.pi * medium(state).q_c * profile(state).radius
    np.testing.assert_array_equal(np.isfinite(values), numbers < most)
    assert "the whole flat face yields" in found.note


def test_a_drive_that_is_not_swept_says_so():
    _, _, found = swept(state_with(OPENING, "path"))
    assert found.rows == {}
    assert "press to a depth" in found.note


def test_a_sweep_is_in_the_unit_of_its_present_value():
    """A drop of 2.75 J over five decades: in J, although the range ends at 825 J and begins at 9 mJ."""
    state = preset_state(DROP).replace(**{"sweep.swept": "energy", "sweep.against": "restitution"})
    found = last(sweep.found(view_of(state).course, sweep.asked(state)))
    assert found.axes[0].label == "W, impact energy at fixed mass (J)"
    assert found.axes[0].start / found.axes[0].factor == approx(2.75 / 300, rel=1e-3)
    # A thousand times as hard, a thousand times the energy.
    state = state.replace(speed=state.speed * 1000**0.5)
    assert last(sweep.found(view_of(state).course, sweep.asked(state))).axes[0].unit == "kJ"


def test_a_sweep_of_a_drive_that_has_none_offers_numbers_with_a_value(page):
    page.choose("drive", "path")
    press(page, "Sweep")
    for name in page.choice("sweep.swept").look["options"]:
        page.choose("sweep.swept", name[0])
    assert page.notices == []


def test_numbers_of_two_bodies_are_swept_on_the_page(page):
    page.choose("preset", DROP)
    page.choose("elasticity", "bodies")
    press(page, "Sweep")
    for name in ("E_1", "nu_1", "E_2", "nu_2"):
        page.choose("sweep.swept", name)
        rested(page)
        assert (page.notices, page.view.computed["sweep"] is FAULT) == ([], False), name


def test_an_impact_is_swept_shown_in_time_and_repeated_on_the_same_spot(explorer):
    """The sweep moves with a slider, each axis in time has its own unit, and restitution is one click."""
    explorer.choose("Preset", PRESETS[DROP].label)
    hit = scene_of(preset_state(DROP)).solve()
    explorer.open("Sweep", "sweep", "this scene")

    def present():
        points = explorer.row("sweep", "present value")
        return [x * unit(each) for (x,), each in zip(points, explorer.axis("sweep")["labels"], strict=True)]

    assert present() == approx([2.75, float(hit.damaged_area)], rel=1e-4)
    explorer.slider("v_0").focus()
    explorer.change(explorer.page.keyboard.press, "PageUp")
    assert present()[0] > 2.75
    explorer.change(explorer.press, "Undo")
    explorer.open("In time", "motion", "depth d")
    assert re.fullmatch(r"d = [\d.]+ [µm]m", explorer.hover("motion", "depth d", 20)[1])
    assert re.fullmatch(r"F = [\d.]+ kN", explorer.hover("motion", "force F", 40)[1])
    explorer.press("e over v")
    explorer.wait("explorer.model('sweep') && explorer.axis('sweep').labels[1].startsWith('e')")
    explorer.wait("explorer.row('sweep', 'this scene')?.[0].length > 1")
    assert explorer.axis("sweep")["labels"][0].startswith("v₀")
    points, _ = explorer.row("sweep", "this scene")
    _, result, swept = explorer.hover("sweep", "this scene", len(points) // 2)
    assert re.fullmatch(r"e = 0\.\d+", result)
    assert swept.startswith("v₀ = ")
    explorer.change(explorer.press, "Hit again")
    again = mdr.impact(hit.profile, hit.medium, hit.mass, hit.speed, plastic_depth=hit.plastic_depth)
    assert explorer.readout("restitution") == f"{float(again.restitution):.4f}"


class Slow(Sliced):
    """A browser whose turns are taken by hand."""

    def __init__(self):
        self.turns = []

    def shows(self):
        return False

    def next_tick(self, act):
        self.turns.append(act)

    def search(self, steps, wanted, done):
        self.next_tick(lambda: self.make(steps, wanted, done))

    def turn(self):
        self.turns.pop(0)()


def test_a_sweep_is_found_in_slices_and_a_press_makes_the_one_before_void(monkeypatch):
    """The page is pressed while a sweep is being found: that one is never shown, the next one is."""
    # Each step is a slice.
    monkeypatch.setattr("app.common.host._SLICE", 0.0)
    host = Slow()
    # A ball: its sweep is not found at every move, and has lines of other classes of hardness.
    page = Page("preset=ball-glass_epoxy&tiles=sweep", host=host)

    def note():
        return page.view.computed["sweep"].note

    page._input_rests()
    assert note() == "computing …"
    host.turn()
    host.turn()
    assert note() == "computing …"
    assert host.turns
    page.apply(lambda state: state.replace(max_depth=0.9 * state.max_depth))
    page._input_rests()
    # What goes on of the first one ends with the next turn, and nothing is shown of it.
    turns = 0
    while host.turns:
        host.turn()
        turns += 1
    assert turns > 4
    at_once = Page("preset=ball-glass_epoxy&tiles=sweep")
    at_once.apply(lambda state: state.replace(max_depth=0.9 * state.max_depth))
    at_once._input_rests()
    expected = at_once.view.computed["sweep"]
    assert page.view.computed["sweep"].note == expected.note
    for name, columns in expected.rows.items():
        # Places, without the text of a label.
        for mine, theirs in zip(page.view.computed["sweep"].rows[name][:2], columns[:2], strict=True):
            np.testing.assert_allclose(mine, theirs, rtol=1e-12)
