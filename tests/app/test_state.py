"""What is set and how it is written, without a browser."""

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.controls import Scale
from app.presets import OPENING, PRESETS
from app.run import solve
from app.shapes import SHAPES
from app.state import QUANTITIES, Explorer
from app.units import UNITS, digits, entry, fitting, read, round_up, written


def test_opens_on_a_cone_pressed_beyond_the_critical_depth():
    scene = Explorer().scene()
    assert isinstance(scene.profile, mdr.Cone)
    assert scene.drive.depth[-1] > scene.medium.critical_depth


@pytest.mark.parametrize("label", PRESETS)
def test_preset_solves_and_says_where_its_numbers_come_from(label):
    run = solve(Explorer(label).scene())
    assert run.state.force > 0
    assert run.yielded == (run.state.depth > run.onset.depth)
    assert run.largest_slope < 0.4
    assert all(source for _, _, source in PRESETS[label].sources)


def test_preset_combines_the_compliance_of_both_bodies():
    # Gold under diamond: 1/E* = (1 − 0.42²)/78 GPa + (1 − 0.07²)/1141 GPa, Eq. (2).
    expected = 1 / ((1 - 0.42**2) / 78e9 + (1 - 0.07**2) / 1141e9)
    assert Explorer(OPENING).medium().E_star == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("shape", SHAPES)
def test_shape_begins_at_the_size_of_what_is_on_the_page(shape, preset):
    state = Explorer(preset)
    before = solve(state.scene()).state.contact_radius
    state.choose(shape)
    run = solve(state.scene())
    assert 0.1 < run.state.contact_radius / before < 4
    assert np.all(np.isfinite(run.elastic.force))


@pytest.mark.parametrize("shape", SHAPES)
def test_every_bound_gives_a_profile(shape):
    state = Explorer()
    for name, quantity in state.shape_quantities(shape):
        for value in quantity.bounds:
            state.choose(shape)
            state.set(name, value)
            assert state.profile().contact_radius(0.0) >= 0


def test_out_of_bounds_is_refused_and_the_value_kept():
    state = Explorer()
    kept = state.values()
    for name, quantity in QUANTITIES.items():
        low, high = quantity.bounds
        for value in (low - 1, high * 2, math.nan, math.inf):
            with pytest.raises(ValueError, match="out of bounds"):
                state.set(name, value)
    assert state.values() == kept


def test_unloading_goes_from_the_largest_depth_over_zero_load_to_the_surface():
    state = Explorer()
    medium = state.medium()
    depths, forces = [], []
    for unloading in (0.0, 0.5, 1.0, 1.2):
        state.set("unloading", unloading)
        result = state.scene().solve()[-1]
        depths.append(result.depth)
        forces.append(result.force)
        assert result.plastic_depth == pytest.approx(state.max_depth - medium.critical_depth)
    deepest, d_c = state.max_depth, medium.critical_depth
    assert depths == pytest.approx([deepest, deepest - d_c / 2, deepest - d_c, 0.0], abs=1e-24)
    assert forces[0] > forces[1] > 0
    assert forces[2:] == pytest.approx([0, 0], abs=1e-12 * forces[0])


def test_curves_of_a_run_meet_in_its_states():
    state = Explorer()
    state.set("unloading", 0.4)
    run = solve(state.scene())
    assert run.elastic.force[-1] == pytest.approx(run.onset.force)
    assert run.yielding.force[-1] == pytest.approx(run.deepest.force)
    assert np.interp(
        run.state.depth, run.unloading.depth[::-1], run.unloading.force[::-1]
    ) == pytest.approx(run.state.force, rel=1e-3)
    # Plastic work is the area between loading and unloading.
    depth = np.concatenate([run.elastic.depth, run.yielding.depth, run.unloading.depth])
    force = np.concatenate([run.elastic.force, run.yielding.force, run.unloading.force])
    assert trapezoid(force, depth) == pytest.approx(run.state.plastic_work, rel=1e-3)


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("2.5", "length", 2.5e-6),
        (" 2.5e-1 ", "length", 2.5e-7),
        ("+3.E2 nm", "length", 3e-7),
        (".5mm", "length", 5e-4),
        ("40 um", "length", 4e-5),
        ("40 μm", "length", 4e-5),
        ("250 MPa", "pressure", 2.5e8),
        ("12", "fraction", 0.12),
        ("0.3", "number", 0.3),
    ],
)
def test_number_is_read(text, kind, value):
    shown = {"length": fitting(1e-6, "length")}.get(kind, UNITS[kind][0])
    assert read(text, kind, shown) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    "text", ["", " ", "x", "1 2", "1,5", "--1", "1e", "nan", "inf", "1e999", "1 kg", "0x10", "１", "9" * 50]
)
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", UNITS["length"][0])


@pytest.mark.parametrize("kind", UNITS)
@pytest.mark.parametrize("value", [1.2345e-9, 1e-3, 0.3, 1.0, 999.9996, 1234.5, 1e6, 2.5e11])
def test_entry_is_read_back(kind, value):
    text = entry(value, kind)
    assert read(text, kind, fitting(value, kind)) == pytest.approx(value, rel=1e-4)


def test_numbers_are_written_as_in_a_paper():
    assert written(4.5140622e-6, "force") == "4.514 µN"
    assert written(1e-3, "length") == "1.000 mm"
    assert written(0.0, "energy") == "0"
    assert written(8.71e-20, "energy") == "0.08710 aJ"
    assert digits(1.23456e7) == "1.235 × 10⁷"
    assert digits(-0.5, 2) == "−0.50"
    assert digits(math.inf) == "∞"


def test_axes_end_at_round_numbers():
    assert [round_up(x) for x in (1, 1.01, 1.6, 2.5, 3.1, 5.1, 7.6, 0.011)] == pytest.approx(
        [1, 1.5, 2, 3, 5, 7.5, 10, 0.015]
    )
    assert round_up(0.0) == round_up(math.nan) == 1


@pytest.mark.parametrize("name", QUANTITIES)
def test_slider_steps_through_its_range(name):
    quantity = QUANTITIES[name]
    middle = quantity.bounds[0] if quantity.span == 0 else quantity.default
    scale = Scale(quantity, middle, middle)
    values = [scale.value(step) for step in range(Scale.STEPS + 1)]
    assert np.all(np.diff(values) >= 0)
    assert quantity.bounds[0] <= values[0] < values[-1] <= quantity.bounds[1]
    assert abs(scale.position(middle) - (0 if quantity.span == 0 else Scale.STEPS / 2)) < Scale.STEPS / 2


def test_slider_recentres_on_a_value_typed_beyond_its_reach():
    quantity = QUANTITIES["max_depth"]
    scale = Scale(quantity, 1e-9, 1e-3)
    assert scale.position(1e-3) == Scale.STEPS // 2
