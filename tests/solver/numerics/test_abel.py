"""Transforms between 3D and 1D: closed-form pairs, and exactness for the polygon."""

import math

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core import abel

from ...approx import approx

RNG = np.random.default_rng(20150401)


def polygon_stress(x, q, r):
    """σ_zz of a piecewise-linear q, panel by panel."""
    total = 0.0
    for x0, x1, q0, q1 in zip(x[:-1], x[1:], q[:-1], q[1:], strict=True):
        if x1 > r and x1 > x0:
            total += (q1 - q0) / (x1 - x0) * (math.acosh(x1 / r) - math.acosh(max(x0 / r, 1.0)))
        elif x1 == x0 > r:
            total += (q1 - q0) / math.sqrt((x0 - r) * (x0 + r))
    if x[-1] > r:
        total -= q[-1] / math.sqrt((x[-1] - r) * (x[-1] + r))
    return total / math.pi


class TestStressFromLineLoad:
    def test_any_polygon_with_jumps_is_exact(self):
        x = np.sort(RNG.uniform(0, 2e-6, 300))
        x[0], x[100], x[200] = 0.0, x[99], x[199]
        q = RNG.normal(size=300)
        r = RNG.uniform(1e-9, 2.1e-6, 200)
        expected = np.array([polygon_stress(x, q, radius) for radius in r])
        # 300 panels of either sign: their sizes add up, and so do their roundings.
        scale = np.abs(expected).max()
        actual = abel.stress_from_line_load(x, q, r)
        np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-11 * scale)

    @pytest.mark.parametrize("count", [10, 1000])
    def test_cone_and_punch(self, count):
        """Straight q = d − x: −arccosh(a/r)/π; constant q with its jump at the rim: −1/√(a²−r²)/π."""
        x, r = np.linspace(0, 1, count + 1), np.array([1e-9, 1e-3, 0.3, 0.77, 0.999])
        cone = abel.stress_from_line_load(x, 1 - x, r)
        np.testing.assert_allclose(cone, -np.arccosh(1 / r) / math.pi, rtol=1e-12)
        punch = abel.stress_from_line_load(x, np.ones_like(x), r)
        np.testing.assert_allclose(punch, -1 / np.sqrt((1 - r) * (1 + r)) / math.pi, rtol=1e-13)

    def test_smooth_load_converges_also_on_the_axis(self):
        """Hertz: q = 1 − x², σ = −(2/π)√(1 − r²); second order in the mean, no tip on the axis."""

        def worst(count):
            x = np.linspace(0, 1, count + 1)
            r = np.array([0.0, 1e-6, 0.5 / count, 1 / count, 0.2, 0.6])
            return np.abs(
                abel.stress_from_line_load(x, 1 - x * x, r) + 2 / math.pi * np.sqrt(1 - r * r)
            ).max()

        # Next to the axis the error of the panels is of first order, with a factor below 1/5.
        assert worst(100) < 0.002
        assert worst(1000) < 0.0002

    def test_axis(self):
        x = np.linspace(0, 1, 5)
        assert abel.stress_from_line_load(x, 1 - x, 0.0) == -math.inf
        assert abel.stress_from_line_load(x, np.ones(5), 0.0) == approx(-1 / math.pi, rel=1e-15)
        # q constant to 0.5, then straight to 0: ∫ q′/x dx = −2 ln 2.
        assert abel.stress_from_line_load([0, 0.5, 1], [1, 1, 0], 0.0) == approx(-2 * math.log(2) / math.pi)

    def test_a_state_of_the_solver(self):
        medium = mdr.Medium(1e9, q_c=1.0)
        state = mdr.indent(mdr.Cone(0.3), medium, 6 * medium.critical_depth)
        a, c = state.contact_radius, state.plastic_radius
        # q is a polygon with its vertices at c and a.
        r = np.array([0.0, 0.1, 0.5, 0.9, 0.99]) * a
        stress = abel.stress_from_line_load([0, c, a], state.line_load([0, c, a]), r)
        np.testing.assert_allclose(-stress, state.pressure(r), rtol=1e-12)

    def test_first_sample_given_twice(self):
        """A step of length zero at the axis changes the first panel from a parabola to a straight line."""
        x = np.linspace(0, 1, 21)
        x = np.append(0.0, x)
        r = np.array([0.01, 0.31, 0.72])
        q = 1 - x * x
        expected = [polygon_stress(x, q, radius) for radius in r]
        np.testing.assert_allclose(abel.stress_from_line_load(x, q, r), expected, rtol=1e-12)

    def test_unit_of_length_does_not_matter(self):
        """σ(λr) of q(λx) is σ(r)/λ, also where a coordinate is 1."""
        x, r = np.linspace(0, 1, 6), np.array([0.0, 0.05, 0.5])
        stress = abel.stress_from_line_load(x, 1 - x * x, r)
        for unit in (4.0, 5.0, 1e-9):
            scaled = abel.stress_from_line_load(unit * x, 1 - x * x, unit * r)
            np.testing.assert_allclose(scaled * unit, stress, rtol=1e-13)

    def test_many_nodes(self):
        """The sum in blocks agrees with the direct one."""
        x = np.linspace(0, 1, 4001)
        r = x[[52, 2000, 3600]]
        q = np.cos(40 * x) * (1 - x)
        expected = [polygon_stress(x, q, radius) for radius in r]
        np.testing.assert_allclose(
            abel.stress_from_line_load(x, q, x)[[52, 2000, 3600]], expected, rtol=1e-9
        )

    def test_order_of_convergence(self):
        """q = 1 − x⁴: p = (4/π)(s³/3 + r² s) with s = √(1 − r²).

        The slope of a chord has an error of the order h, with a mean of zero over an interval; the interval
        around r, √h of the integral, has no mean: h √h.
        """

        def error(count):
            x, r = np.linspace(0, 1, count + 1), np.linspace(0.05, 0.95, 977)
            s = np.sqrt(1 - r * r)
            exact = -4 / math.pi * (s**3 / 3 + r * r * s)
            return np.linalg.norm(abel.stress_from_line_load(x, 1 - x**4, r) - exact) / np.linalg.norm(
                exact
            )

        assert math.log(error(40) / error(320), 8) == approx(1.5, abs=0.15)

    def test_large_loads_are_finite(self):
        assert np.isfinite(abel.stress_from_line_load([0.0, 1e-59, 1.0], [1e60, -1e60, 0.0], 0.5))

    def test_jumps_at_the_same_coordinate_are_added(self):
        """A step down to −1 and the end of the load there equal the end of the load before."""
        for r in (0.0, 0.4, 1.0):
            both = abel.stress_from_line_load([0, 0.5, 1, 1], [2, 2, 2, -1], r)
            assert both == abel.stress_from_line_load([0, 0.5, 1], [2, 2, 2], r)

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            (([0, 1], [1, 0, 0], 0.5), "needs as many coordinates"),
            (([], [], 0.5), "needs as many coordinates"),
            (([0, 2, 1], [1, 1, 0], 0.5), r"coordinate\[2\] = 1 m comes after .*; sort the samples"),
            (([-1, 1], [1, 0], 0.5), r"coordinate\[0\] = -1 m is negative"),
            (([0, 1], [1, 0], math.inf), "radius r = inf m must be finite"),
            (([0.0, 5e-324], [1.0, 0.0], 0.5), r"coordinate\[1\] = .* must be 0 or .* 1e-60 and 1e\+25"),
            (([1.0, 1.0 + 2**-52], [0, 1e70], 0.5), r"line load q\[1\] = 1e\+70 N/m is beyond 1e\+60"),
        ],
    )
    def test_bad_samples_are_refused(self, arguments, says):
        with pytest.raises(ValueError, match=says):
            abel.stress_from_line_load(*arguments)


def test_the_surface_beside_a_cone_is_that_of_its_springs():
    """The compression under a cone is linear, so the displacement is exact to rounding."""
    state = mdr.indent(mdr.Cone(slope=0.2), mdr.Medium(E_star=1e9), 1e-6)
    x = np.array([0.0, 0.3, 1.0]) * state.contact_radius
    r = np.array([0.0, 0.1, 0.5, 1.0, 1.2, 40.0]) * state.contact_radius
    moved = abel.surface_displacement(x, state.line_load(x) / 1e9, r)
    np.testing.assert_allclose(moved, state.surface(r), rtol=1e-12)


class TestCallables:
    @pytest.mark.parametrize(
        ("slope", "reduced"),
        [
            (lambda r: 0.3 + 0 * r, lambda x: 0.3 * math.pi / 2 * x),
            (lambda r: r, lambda x: x**2),
            (lambda r: r / np.sqrt(4 - r * r), lambda x: x * math.atanh(x / 2)),
            (lambda r: r / np.sqrt(1 + r * r), lambda x: x * math.atan(x)),
        ],
        ids=["cone", "paraboloid", "sphere", "hyperboloid"],
    )
    def test_closed_pairs(self, slope, reduced):
        for x in (0.0, 1e-8, 0.5, 1.9):
            g = abel.reduce_slope(slope, x)
            assert g == approx(reduced(x), rel=1e-13)

    @pytest.mark.parametrize(
        ("slope", "says"),
        [
            (lambda r: 1 / (r - r), "slope dz/dr is inf at .* m and must be finite up to 1 m"),
            (lambda r: np.abs(r - 0.3), "too rough"),
        ],
    )
    def test_bad_slopes_are_refused(self, slope, says):
        with pytest.raises(ValueError, match=says):
            abel.reduce_slope(slope, 1.0)
