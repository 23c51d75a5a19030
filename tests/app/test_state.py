"""What is set and how it is written, without a browser."""

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.form import Scale
from app.presets import OPENING, PRESETS
from app.quantities import CHOICES, QUANTITIES, shape_quantities
from app.shapes import SHAPES
from app.state import Explorer
from app.trajectory import follow
from app.units import UNITS, digits, entry, fitting, read, round_up, written


def test_opens_on_a_cone_pressed_beyond_the_critical_depth():
    scene = Explorer().scene()
    assert isinstance(scene.profile, mdr.Cone)
    assert scene.drive.depth > scene.medium.critical_depth


@pytest.mark.parametrize("label", PRESETS)
def test_preset_solves_and_says_where_its_numbers_come_from(label):
    way = follow(Explorer(label).scene(), 1.0)
    assert way.state.force > 0
    assert way.now == way.peak
    assert way.largest_slope < 0.4
    assert all(source for _, _, source in PRESETS[label].sources)


@pytest.mark.parametrize("label", PRESETS)
def test_preset_says_whether_it_has_been_altered(label):
    state = Explorer(label)
    assert not state.altered
    before = state.snapshot()
    state.set("cone_slope", 0.0625)
    state.choose("shape", "cone")
    assert state.altered
    state.restore(before)
    assert not state.altered


def test_preset_combines_the_compliance_of_both_bodies():
    # Gold under diamond: 1/E* = (1 − 0.42²)/78 GPa + (1 − 0.07²)/1141 GPa, Eq. (2).
    expected = 1 / ((1 - 0.42**2) / 78e9 + (1 - 0.07**2) / 1141e9)
    state = Explorer(OPENING)
    assert state.choices["elasticity"] == "bodies"
    assert state.medium().E_star == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("shape", SHAPES)
def test_shape_begins_at_the_size_of_what_is_on_the_page(shape, preset):
    state = Explorer(preset)
    before = state.solved().contact_radius
    state.choose("shape", shape)
    assert 0.1 < state.solved().contact_radius / before < 10
    assert np.all(np.isfinite(follow(state.scene(), 1.0).force))


@pytest.mark.parametrize("shape", SHAPES)
def test_every_bound_gives_a_profile(shape):
    state = Explorer()
    for name, quantity in shape_quantities(shape):
        for value in quantity.bounds:
            state.choose("shape", "cone")
            state.choose("shape", shape)
            state.set(name, value)
            assert state.profile().contact_radius(0.0) >= 0


def test_out_of_bounds_is_refused_and_the_value_kept():
    state = Explorer()
    kept = dict(state.numbers)
    for name, quantity in QUANTITIES.items():
        low, high = quantity.bounds
        for value in (low - 1, high * 2, math.nan, math.inf):
            with pytest.raises(ValueError, match="out of bounds"):
                state.set(name, value)
    for progress in (-0.1, 2.3, math.nan):
        with pytest.raises(ValueError, match="out of bounds"):
            state.move(progress)
    assert state.numbers == kept


@pytest.mark.parametrize("name", ["elasticity", "plasticity", "damping", "drive"])
def test_another_option_means_the_same_scene(name):
    for option in CHOICES[name]:
        if option == "none":
            continue
        state = Explorer()
        if name == "damping":
            state.choose(name, "eta" if option == "tau" else "tau")
        medium, depth = state.medium(), float(state.solved().depth)
        state.choose(name, option)
        after = state.medium()
        assert [after.E_star, after.q_c, after.eta] == pytest.approx(
            [medium.E_star, medium.q_c, medium.eta], rel=1e-12
        )
        assert float(state.solved().depth) == pytest.approx(depth, rel=1e-6)


def test_yield_constant_is_hardness_times_radius_or_infinite():
    state = Explorer()
    state.choose("plasticity", "hardness")
    state.set("hardness", 2e9)
    state.set("hardness_radius", 50e-9)
    assert state.medium().q_c == pytest.approx(100.0)
    state.choose("plasticity", "none")
    assert state.medium().q_c == math.inf
    way = follow(state.scene(), 1.5)
    assert way.onset is None
    assert not np.any(way.states.plastic_radius)
    assert way.state.force > 0


def test_progress_goes_from_contact_over_the_deepest_state_to_the_surface():
    state = Explorer()
    critical, deepest = state.medium().critical_depth, state.numbers["max_depth"]
    states = [follow(state.scene(), progress).state for progress in (0.0, 0.5, 1.0, 1.5, 2.0, 2.2)]
    depths = [deepest * 0, deepest / 2, deepest, deepest - critical / 2, deepest - critical, 0.0]
    assert [float(each.depth) for each in states] == pytest.approx(depths, abs=1e-24)
    assert states[2].force > states[3].force > 0
    assert [float(each.force) for each in states[4:]] == pytest.approx([0, 0], abs=1e-12 * states[2].force)
    assert float(states[-1].plastic_depth) == pytest.approx(deepest - critical)


def test_plastic_work_is_the_area_between_loading_and_unloading():
    way = follow(Explorer().scene(), 2.0)
    assert trapezoid(way.force, way.states.depth) == pytest.approx(way.state.plastic_work, rel=2e-3)


def test_unloading_from_a_state_gives_its_stored_energy():
    way = follow(Explorer().scene(), 1.0)
    depth, force = way.released(np.arange(len(way.progress)))
    stored = trapezoid(force[:, ::-1], depth[:, ::-1], axis=1)
    assert stored == pytest.approx(way.states.stored_energy, rel=0.01, abs=1e-3 * way.deepest.stored_energy)


@pytest.mark.parametrize("damping", ["none", "tau"])
@pytest.mark.parametrize("shape", ["cone", "flat_punch", "sphere"])
def test_impact_goes_over_its_deepest_state_to_the_loss_of_contact(shape, damping):
    state = Explorer()
    state.choose("shape", shape)
    state.choose("drive", "impact")
    state.choose("damping", damping)
    way = follow(state.scene(), 1.0)
    hit, motion = way.hit, way.motion
    assert way.now == way.peak
    assert way.state.depth == pytest.approx(hit.max_depth)
    assert motion.time[-1] == pytest.approx(hit.contact_time, rel=1e-9)
    assert motion.velocity[[0, -1]] == pytest.approx([hit.speed, -hit.rebound_speed], rel=1e-6)
    ledger = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    assert ledger == pytest.approx(np.full(len(ledger), ledger[0]), rel=1e-6)


def test_onset_beyond_a_measured_tip_is_left_out():
    state = Explorer()
    state.upload(([0.0, 5e-9, 10e-9], [0.0, 0.2e-9, 0.6e-9]))
    way = follow(state.scene(), 1.0)
    assert way.scene.profile.deepest < way.scene.medium.critical_depth
    assert way.onset is None
    assert way.state.force > 0


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
        ("3 Pa*s", "viscosity", 3.0),
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
    assert [round_up(x) for x in (1, 1.01, 1.6, 2.5, 3.1, 5.1, 8.6, 0.011)] == pytest.approx(
        [1, 1.5, 2, 3, 4, 6, 10, 0.015]
    )
    assert round_up(0.0) == round_up(math.nan) == 1


@pytest.mark.parametrize("name", QUANTITIES)
def test_slider_steps_through_its_range(name):
    quantity = QUANTITIES[name]
    scale = Scale(quantity, quantity.start, quantity.start)
    values = [scale.value(step) for step in range(Scale.STEPS + 1)]
    assert np.all(np.diff(values) >= 0)
    assert quantity.bounds[0] <= values[0] < values[-1] <= quantity.bounds[1]
    assert scale.value(-5) == values[0]
    assert scale.value(1e9) == values[-1]


def test_slider_recentres_on_a_value_typed_beyond_its_reach():
    quantity = QUANTITIES["max_depth"]
    scale = Scale(quantity, 1e-9, 1e-3)
    assert scale.position(1e-3) == Scale.STEPS // 2
