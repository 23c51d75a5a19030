"""Dry impact: energy balance, known contact times and restitutions, the paper's fast limit."""

import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, trapezoid

import mdr_core as mdr

from .shapes import SHAPES, name

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0)
ELASTIC = mdr.Medium(E_star=1e9)
D_C = MEDIUM.critical_depth


def hit_to_depth(shape, medium, depth):
    """The impact of 1 kg that reaches the given depth."""
    state = mdr.indent(shape, medium, depth)
    return mdr.impact(shape, medium, 1.0, np.sqrt(2 * (state.stored_energy + state.plastic_work)))


@pytest.mark.parametrize("times", [0.7, 1 - 1e-9, 1 + 1e-9, 1.0001, 3.0, 1e3, 4e5])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_largest_depth_from_energy_balance(shape, times):
    depth = min(times * D_C, 100e-5 if isinstance(shape, mdr.Sphere) else math.inf)
    hit = hit_to_depth(shape, MEDIUM, depth)
    # Work grows at least in proportion to depth: the roundings of the energy, no more.
    assert hit.max_depth == pytest.approx(depth, rel=1e-14)
    assert hit.stored_energy + hit.plastic_work == pytest.approx(hit.speed**2 / 2, rel=1e-13)
    assert hit.rebound_speed**2 / 2 == pytest.approx(hit.stored_energy, rel=1e-13)


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (mdr.FlatPunch(1e-6), math.pi),
        (mdr.Cone(0.3), 2.80436421065),
        (mdr.Paraboloid(1e-3), 2.94327518432),
        (mdr.PowerLaw(1e-4, 0.5), 2.62205755429),
    ],
    ids=["flat", "cone", "Hertz", "root"],
)
def test_elastic_contact_time(shape, expected):
    """T v/d_max = 2√π Γ(1 + 1/(p+1))/Γ(1/2 + 1/(p+1)) for F ∝ dᵖ; Hertz: 2.943."""
    hit = mdr.impact(shape, ELASTIC, 1e-3, [1e-6, 1e-3, 1.0])
    np.testing.assert_allclose(hit.contact_time * hit.speed / hit.max_depth, expected, rtol=1e-11)
    np.testing.assert_array_equal(hit.restitution, 1.0)


@pytest.mark.parametrize("n", [0.2, 1.5, 3.0, 10.0, 50.0])
def test_elastic_contact_time_of_power_laws(n):
    q = 1 / (2 + 1 / n)
    expected = 2 * math.sqrt(math.pi) * math.gamma(1 + q) / math.gamma(0.5 + q)
    hit = mdr.impact(mdr.PowerLaw(1e-4, n), ELASTIC, 1.0, 1.0)
    # Few roundings times 40 nodes; for small n the largest depth to a high power.
    assert hit.contact_time * hit.speed / hit.max_depth == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (mdr.Cone(0.3), (0.755928946, 0.461643536, 0.321435893)),
        (mdr.Paraboloid(1e-3), (0.680556328, 0.404028978, 0.279675705)),
    ],
    ids=name,
)
def test_restitution_at_given_depth(shape, expected):
    for times, e in zip((2, 5, 10), expected, strict=True):
        assert hit_to_depth(shape, MEDIUM, times * D_C).restitution == pytest.approx(e, abs=5e-10)


@pytest.mark.parametrize("times", [0.7, 1.0001, 1.5, 30.0, 150.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_contact_time_by_direct_quadrature(shape, times):
    """T = ∫ dd/v in and out, from the force alone, with v from the work done so far."""
    hit = hit_to_depth(shape, MEDIUM, times * D_C)
    d_max, live = float(hit.max_depth), float(hit.deepest.live.length)

    s = np.linspace(0, 1, 4001)

    def time(height, path):
        """Over `height` below the turning point, where d_max − d = height·s²."""
        force = mdr.indent(shape, MEDIUM, path(height * s**2)).force.ravel()
        work = cumulative_trapezoid(force * 2 * height * s, s, initial=0)
        with np.errstate(invalid="ignore"):
            slowness = np.where(s > 0, 2 * height * s / np.sqrt(2 * work), np.sqrt(2 * height / force[0]))
        return trapezoid(slowness, s)

    loading = time(d_max, lambda y: (d_max - y)[:, None])
    unloading = time(live, lambda y: d_max - y)
    # Trapezoids of 1/4000, and a kink of the force at d_c.
    assert hit.contact_time == pytest.approx(loading + unloading, rel=1e-6)


@pytest.mark.parametrize(("shape", "n"), [(mdr.Cone(0.3), 1.0), (mdr.Paraboloid(1e-3), 2.0)])
class TestFastLimit:
    def test_restitution(self, shape, n):
        """e² → (1 + 1/n) d_c/(2 d_max), with a relative error of order d_c/d_max."""
        hit = hit_to_depth(shape, MEDIUM, 1e6 * D_C)
        assert hit.restitution**2 == pytest.approx((1 + 1 / n) / 2e6, rel=2e-6)

    def test_slope_of_restitution_against_speed(self, shape, n):
        """e ∝ v^(−1/2) for the cone, v^(−2/3) for the paraboloid; −1/4 at constant hardness."""
        hit = mdr.impact(shape, MEDIUM, 1.0, [1e4, 1e5])
        slope = np.diff(np.log(hit.restitution)) / np.diff(np.log(hit.speed))
        # d_max ∝ v^(2/(1 + 1/n)) and e² ∝ 1/d_max.
        assert slope[0] == pytest.approx(-n / (n + 1), rel=1e-4)


def test_eq_23_24_work_and_damaged_area_of_a_fast_cone():
    slope, speed = 0.3, np.array([10.0, 20.0, 40.0])
    hit = mdr.impact(mdr.Cone(slope), MEDIUM, 1e-3, speed)
    energy = 1e-3 * speed**2 / 2
    # The corrections are of relative order d_c/d_max.
    tolerance = 3 * D_C / hit.max_depth
    assert np.all(np.abs(MEDIUM.q_c * hit.max_depth**2 / slope / energy - 1) < tolerance)
    assert np.all(np.abs(hit.damaged_area / (4 * energy / (math.pi * MEDIUM.q_c * slope)) - 1) < tolerance)


def test_slow_impact_damages_nothing():
    hit = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-6, 1e-9)
    assert hit.restitution == 1.0
    assert hit.plastic_work == hit.damaged_area == hit.plastic_depth == hit.viscous_work == 0.0


def test_arguments_broadcast_and_order_does_not_matter():
    mass, speed = np.array([[1e-6], [1e-3]]), np.array([1e-4, 1e-2, 1.0])
    grid = mdr.impact(mdr.Paraboloid(1e-3), MEDIUM, mass, speed)
    flipped = mdr.impact(mdr.Paraboloid(1e-3), MEDIUM, mass[::-1], speed[::-1])
    assert grid.restitution.shape == grid.contact_time.shape == grid.mass.shape == (2, 3)
    np.testing.assert_allclose(flipped.contact_time[::-1, ::-1], grid.contact_time, rtol=1e-14)
    one = mdr.impact(mdr.Paraboloid(1e-3), MEDIUM, 1e-3, 1e-2)
    assert isinstance(one.contact_time, float)
    assert one.contact_time == pytest.approx(grid.contact_time[1, 1], rel=1e-14)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((0.0, 1.0), "mass = 0 kg must be finite and positive"),
        ((1.0, [1.0, -2.0]), r"speed\[1\] = -2 m/s must be finite and positive"),
        ((1.0, math.nan), "speed = nan m/s must be finite and positive"),
        ((1e-300, 1e-100), "mass = 1e-300 kg must lie between 1e-60 and 1e.60"),
    ],
)
def test_bad_arguments_are_refused(arguments, says):
    with pytest.raises(ValueError, match=says):
        mdr.impact(mdr.Cone(0.3), MEDIUM, *arguments)


def test_one_of_many():
    grid = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-3, [[0.01, 0.1], [1.0, 10.0]])
    assert grid[1, 0].restitution == grid.restitution[1, 0]
    assert grid[1].contact_time.shape == (2,)
