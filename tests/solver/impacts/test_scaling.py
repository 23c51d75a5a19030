"""The limit of very fast impacts, and what imprints tell of the class of hardness."""

import numpy as np
import pytest
from scipy.stats import linregress

import mdr_core as mdr

from ...approx import approx

MEDIUM = mdr.Medium(E_star=1e9, q_c=10.0)


@pytest.mark.parametrize(
    ("hardness", "exponent", "quantity", "power"),
    [
        # Expelled volume ∝ energy for constant hardness, whatever the shape.
        ("a", 1.0, "volume", 1.0),
        ("a", 2.0, "volume", 1.0),
        # Restitution of a ball on a metal falls as v^(−1/4).
        ("a", 2.0, "restitution", -1 / 4),
        # Popov (2015), Eq. (24): area ∝ energy for a cone.
        ("b", 1.0, "area", 1.0),
        ("b", 1.0, "restitution", -1 / 2),
        ("b", 2.0, "restitution", -2 / 3),
        ("c", 1.0, "depth", 1.0),
        ("c", 2.0, "depth", 1.0),
        # Popov (2015), section 1: hardness constant, ∝ 1/a, ∝ 1/a².
        ("a", 2.0, "force", 2),
        ("b", 2.0, "force", 1),
        ("c", 2.0, "force", 0),
    ],
)
def test_known_powers(hardness, exponent, quantity, power):
    assert getattr(mdr.ScalingLaw(hardness, exponent), quantity) == approx(power, rel=1e-15)


@pytest.mark.parametrize(
    ("shape", "n"), [(mdr.Cone(0.3), 1.0), (mdr.Paraboloid(1e-3), 2.0), (mdr.PowerLaw(1.0, 1.5), 1.5)]
)
def test_impacts_follow_the_law_of_class_b(shape, n):
    hit = mdr.impact(shape, MEDIUM, 1e-3, [1e2, 1e3])
    law, energy = mdr.ScalingLaw("b", n), np.log(hit.mass * hit.speed**2)

    def power(values, against):
        return np.diff(np.log(values))[0] / np.diff(against)[0]

    # Relative corrections of order d_c/d_max.
    assert power(hit.max_depth, energy) == approx(law.depth, rel=1e-4)
    assert power(hit.contact_radius, energy) == approx(law.radius, rel=1e-4)
    assert power(hit.damaged_area, energy) == approx(law.area, rel=1e-4)
    assert power(hit.restitution, energy / 2) == approx(law.restitution, rel=1e-4)


def test_eq_23_24_fast_limit_of_a_cone():
    hit = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-3, [0.1, 1.0, 10.0])
    limit, energy = hit.fast_limit, hit.mass * hit.speed**2 / 2
    np.testing.assert_allclose(MEDIUM.q_c * limit.max_depth**2 / 0.3, energy, rtol=1e-14)
    np.testing.assert_allclose(limit.contact_area, 4 * energy / (np.pi * MEDIUM.q_c * 0.3), rtol=1e-14)
    # d² − d d_c + d_c²/3 of the exact depth instead of its square.
    share = MEDIUM.critical_depth / hit.max_depth
    np.testing.assert_allclose(limit.max_depth_error, np.sqrt(1 - share + share**2 / 3) - 1, rtol=1e-6)


@pytest.mark.parametrize(
    "shape", [mdr.Sphere(1e-3), mdr.TruncatedCone(1e-6, 0.3), mdr.RoundedCone(1e-6, 0.3)], ids=lambda s: s
)
def test_fast_limit_is_approached_in_proportion_to_the_critical_depth(shape):
    """Ten times the plastic depth, about a tenth of the errors."""
    hit = mdr.impact(shape, MEDIUM, 1e-6, [0.3, 3.0])
    for error in (hit.fast_limit.max_depth_error, hit.fast_limit.restitution_error):
        ratio = error[1] / error[0] / (hit.max_depth[0] / hit.max_depth[1])
        assert 0.5 < ratio < 2
        assert abs(error[1]) < 0.05


def test_fast_limit_needs_a_medium_that_yields():
    with pytest.raises(ValueError, match="nothing yields; give the medium a q_c"):
        _ = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9), 1.0, 1.0).fast_limit


@pytest.mark.parametrize("hardness", ["a", "b", "c"])
@pytest.mark.parametrize("n", [1.0, 2.0])
def test_imprints_tell_the_class(hardness, n):
    energy = np.geomspace(1e-9, 1e-6, 12)
    scatter = 1 + 0.03 * np.random.default_rng(5).standard_normal(12)
    radius = 1e-6 * (energy / 1e-9) ** mdr.ScalingLaw(hardness, n).radius * scatter
    found = mdr.hardness_class(energy, radius, exponent=n)
    assert found.letter == hardness
    assert abs(found.slope - mdr.ScalingLaw(hardness, n).radius) < 4 * found.slope_error
    line = linregress(np.log(energy), np.log(radius))
    # The rounding of twelve terms.
    assert found.slope == approx(line.slope, rel=1e-12)
    assert found.slope_error == approx(line.stderr, rel=1e-10)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (([1.0, 1.0], [1.0, 2.0], 1.0), "at least two different energies"),
        (([1e60, np.nextafter(1e60, 0)], [1.0, 2.0], 1.0), "at least two different energies"),
        (([1.0, 2.0], [1.0], 1.0), "must be of the same shape"),
        (([1.0, -2.0], [1.0, 2.0], 1.0), r"energy\[1\] = -2 J"),
        (([1.0, 2.0], [1.0, 2.0], 0.0), "exponent = 0"),
    ],
)
def test_bad_imprints_are_refused(arguments, says):
    with pytest.raises(ValueError, match=says):
        mdr.hardness_class(*arguments)


def test_unknown_class_is_refused():
    with pytest.raises(ValueError, match="hardness_class = 'd' must be one of"):
        mdr.ScalingLaw("d", 1.0)
