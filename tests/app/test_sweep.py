"""The sweep: its columns are those of one scene at a time, its limits those of the paper."""

import numpy as np
import pytest

from app import changes, link
from app.drives import follow
from app.extras import sweep
from app.state import OPENING, medium, profile

from .conftest import DROP, PUNCH
from .states import linked_state, state_with


def swept(state, **choices):
    state = state.replace(**{link.FORMER.get(name, name): value for name, value in choices.items()})
    asked = sweep.asked(state)
    return state, asked, sweep.found(follow(state), asked)


def one(state, name, value, quantity):
    """A quantity of the scene with another value of one number, as the page itself would show it."""
    if name == "energy":
        name, value = "speed", (2 * value / state.mass) ** 0.5
    course = follow(linked_state(state.replace(**{name: float(value)})))
    return float(getattr(getattr(course, "hit", course.turning_point), quantity))


@pytest.mark.parametrize("drive", ["impact", "depth", "force"])
def test_every_number_is_swept_as_one_scene_at_a_time(drive):
    state = state_with(OPENING, drive)
    for name in changes.options(state, "sweep.swept"):
        state, asked, found = swept(state, swept=name, against="plastic_work")
        numbers, values = found.rows["this scene"]
        # What is 0 has no place on a logarithmic axis.
        values = np.nan_to_num(values)
        assert (numbers[0], numbers[-1]) == pytest.approx((asked.low, asked.high), rel=1e-12)
        for k in (0, 50, 80):
            expected = one(state, name, numbers[k], "plastic_work")
            # Inverse functions are found to some units of rounding, times a condition of some tens.
            assert values[k] == pytest.approx(expected, rel=1e-11, abs=1e-11 * values.max()), name
        x, y = (float(part[0]) for part in found.rows["present value"])
        assert x == asked.present
        assert np.interp(x, numbers, values) == pytest.approx(y, rel=2e-2)


def test_a_viscous_impact_is_swept_over_its_relaxation_time_at_rest():
    state = state_with(DROP, damping="eta").replace(eta=3e4)
    state, asked, found = swept(state, swept="eta", against="restitution")
    numbers, values = found.rows["this scene"]
    assert not sweep.quick(asked)
    assert values[20] == pytest.approx(one(state, "eta", numbers[20], "restitution"), rel=1e-9)
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
    state, _, found = swept(state, swept="energy", speed=speed, against="damaged_area")
    (W, area), (_, fast) = found.rows["this scene"], found.rows[sweep.FAST]
    if shape == "cone":
        np.testing.assert_allclose(fast, 4 * W / (np.pi * state.q_c * state.cone_slope), rtol=1e-12)
    slopes = np.diff(np.log(area)) / np.diff(np.log(W))
    # What is missing of the limit falls as d_c/d.
    assert slopes[-1] == pytest.approx(power, rel=2e-2)
    assert abs(area[-1] / fast[-1] - 1) < abs(area[0] / fast[0] - 1) < 0.2
    for name, i in (("a", 2), ("c", 0)):
        law = np.diff(np.log(found.rows[sweep.CLASSES[name]][1])) / np.diff(np.log(W))
        np.testing.assert_allclose(law, 2 / ({"cone": 1, "paraboloid": 2}[shape] + i), rtol=1e-9)


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
