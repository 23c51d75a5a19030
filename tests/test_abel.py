"""Transforms between 3D and 1D: closed-form pairs, exactness for the polygon, inverses, growth."""

import itertools
import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import mdr_core as mdr
from mdr_core import abel

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
        actual = abel.stress_from_line_load(x, q, r, axis="straight")
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
        assert abel.stress_from_line_load(x, np.ones(5), 0.0) == pytest.approx(-1 / math.pi, rel=1e-15)
        # q constant to 0.5, then straight to 0: ∫ q′/x dx = −2 ln 2.
        assert abel.stress_from_line_load([0, 0.5, 1], [1, 1, 0], 0.0) == pytest.approx(
            -2 * math.log(2) / math.pi
        )
        assert abel.stress_from_line_load([0, 1], [1, 0], 0.0, axis="even") == pytest.approx(-2 / math.pi)

    def test_a_state_of_the_solver(self):
        medium = mdr.Medium(1e9, 1.0)
        state = mdr.indent(mdr.Cone(0.3), medium, 6 * medium.critical_depth)
        a, c = state.contact_radius, state.plastic_radius
        # q is a polygon with its vertices at c and a.
        r = np.array([0.0, 0.1, 0.5, 0.9, 0.99]) * a
        stress = abel.stress_from_line_load([0, c, a], state.line_load([0, c, a]), r)
        np.testing.assert_allclose(-stress, state.pressure(r), rtol=1e-12)

    def test_many_nodes(self):
        """The sum in blocks agrees with the direct one."""
        x = np.linspace(0, 1, 4001)
        r = x[[52, 2000, 3600]]
        q = np.cos(40 * x) * (1 - x)
        expected = [polygon_stress(x, q, radius) for radius in r]
        np.testing.assert_allclose(
            abel.stress_from_line_load(x, q, x)[[52, 2000, 3600]], expected, rtol=1e-9
        )

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            (([0, 1], [1, 0, 0], 0.5), "needs as many coordinates"),
            (([], [], 0.5), "needs as many coordinates"),
            (([0, 2, 1], [1, 1, 0], 0.5), r"coordinate\[2\] = 1 m comes after a larger one"),
            (([-1, 1], [1, 0], 0.5), r"coordinate\[0\] = -1 m is negative"),
            (([0, 1], [math.nan, 0], 0.5), r"line load q\[0\] = nan N/m"),
            (([0, 1], [1, 0], math.inf), "radius r = inf m must be finite"),
            (([0, 1], [1, 0], 0.5, "round"), "axis = 'round' must be"),
        ],
    )
    def test_bad_samples_are_refused(self, arguments, says):
        with pytest.raises(ValueError, match=says):
            abel.stress_from_line_load(*arguments)


class TestCubicLoad:
    def test_cubic_loads_are_exact_across_kinks_that_are_given_twice(self):
        """q = 1 − x² (Hertz) up to 0.37, on with another slope, and a jump at 0.6, then 1 − x³."""
        x = np.concatenate([np.linspace(0, 0.37, 9), np.linspace(0.37, 0.6, 5), np.linspace(0.6, 1, 12)])
        r = np.append(np.geomspace(1e-9, 1, 80, endpoint=False), [0.36999, 0.37001, 0.59999, 0.60001])
        pieces = np.repeat([0, 1, 2], [9, 5, 12])
        q = np.choose(pieces, [1 - x * x, 1 - 0.37**2 - 2 * (x - 0.37), 1 - x**3])

        def sqrt(b):
            return np.sqrt(np.maximum(b - r, 0) * (b + r))

        def arcosh(b):
            return np.arccosh(np.maximum(b / r, 1))

        def square(b):
            return (b * sqrt(b) + r * r * arcosh(b)) / 2

        with np.errstate(divide="ignore"):
            punch = np.where(r < 0.6, (1 - 0.6**3 - q[13]) / sqrt(0.6), 0.0)
        expected = (
            -2 * sqrt(0.37) - 2 * (arcosh(0.6) - arcosh(0.37)) - 3 * (square(1) - square(0.6)) + punch
        )
        actual = abel.stress_from_line_load(x, q, r, interpolation="cubic")
        # Slopes come from differences of loads over a fortieth, arcosh cancels at each kink.
        np.testing.assert_allclose(actual, expected / math.pi, rtol=1e-11)

    @pytest.mark.parametrize(("interpolation", "order"), [("linear", 1.5), ("cubic", 3.5)])
    def test_order_of_convergence(self, interpolation, order):
        """q = 1 − x⁴: p = (4/π)(s³/3 + r² s) with s = √(1 − r²).

        A spline's slope is wrong by h³, with a mean of zero over a panel; the part of it next to r,
        √h of the integral, has no mean. Linear panels likewise: h √h.
        """

        def error(count):
            x, r = np.linspace(0, 1, count + 1), np.linspace(0.05, 0.95, 977)
            s = np.sqrt(1 - r * r)
            exact = -4 / math.pi * (s**3 / 3 + r * r * s)
            actual = abel.stress_from_line_load(x, 1 - x**4, r, axis="even", interpolation=interpolation)
            return np.linalg.norm(actual - exact) / np.linalg.norm(exact)

        coarse, fine = error(40), error(320)
        assert math.log(coarse / fine, 8) == pytest.approx(order, abs=0.15)

    def test_axis(self):
        x = np.linspace(0, 1, 21)
        # −(1/π) ∫ 4x² dx
        quartic = abel.stress_from_line_load(x, 1 - x**4, 0.0, axis="even", interpolation="cubic")
        assert quartic == pytest.approx(-4 / (3 * math.pi), rel=1e-4)
        assert abel.stress_from_line_load(x, 1 - x, 0.0, interpolation="cubic") == -math.inf
        hertz = abel.stress_from_line_load(x, 1 - x * x, [0.0, 1e-12], interpolation="cubic")
        np.testing.assert_allclose(hertz, -2 / math.pi, rtol=1e-13)

    def test_few_nodes(self):
        """Two nodes make a straight line, three a parabola."""
        line = abel.stress_from_line_load([0.0, 1.0], [1.0, 0.0], 0.3, "straight", "cubic")
        assert line == pytest.approx(-math.acosh(1 / 0.3) / math.pi, rel=1e-14)
        hertz = abel.stress_from_line_load([0.0, 0.2, 1.0], [1.0, 0.96, 0.0], 0.3, interpolation="cubic")
        assert hertz == pytest.approx(-2 / math.pi * math.sqrt(0.91), rel=1e-14)
        assert abel.stress_from_line_load([0.5], [1.0], 0.3, interpolation="cubic") == pytest.approx(
            -1 / (0.4 * math.pi), rel=1e-14
        )

    def test_rough_loads_on_uneven_nodes(self):
        """Against Gauss quadrature of the spline itself, in √(x − r) from each panel's end."""
        x = np.concatenate([[0.0], np.sort(RNG.uniform(0, 1, 40)), [1.0, 1.5, 9.0]])
        q = RNG.normal(size=x.size)
        spline = CubicSpline(x, q).derivative()
        node, weight = np.polynomial.legendre.leggauss(60)
        for r in (1e-3, 0.2, 0.77, 1.2, 5.0):
            total, roots = -q[-1] / math.sqrt((9 - r) * (9 + r)), np.sqrt(np.maximum(x - r, 0))
            for low, high in itertools.pairwise(roots):
                t = (low + high) / 2 + (high - low) / 2 * node
                total += (high - low) * weight @ (spline(r + t * t) / np.sqrt(2 * r + t * t))
            actual = abel.stress_from_line_load(x, q, r, axis="straight", interpolation="cubic")
            # Slopes of up to 10⁴ of both signs.
            assert actual == pytest.approx(total / math.pi, rel=1e-10)

    @pytest.mark.parametrize("unit", [1e-9, 1e6])
    def test_units_do_not_matter(self, unit):
        for x in ([0.0, 1e-12, 1.0], [0.0, 0.2, 0.5, 1.0]):
            q = 1 - np.array(x) ** 2
            one = abel.stress_from_line_load(x, q, 0.3, interpolation="cubic")
            other = abel.stress_from_line_load(np.array(x) * unit, q, 0.3 * unit, interpolation="cubic")
            assert other * unit == pytest.approx(one, rel=1e-12)

    @pytest.mark.parametrize(
        ("x", "q", "says"),
        [
            ([0.0, 5e-324], [1.0, 0.0], r"coordinate\[1\] = .* must be 0 or lie between 1e-60 and 1e\+60"),
            ([0.0, 1e-59, 1.0], [1e60, -1e60, 0.0], None),
            ([1.0, 1.0 + 2**-52], [0, 1e70], r"line load q\[1\] = 1e\+70 N/m is beyond 1e\+60"),
        ],
    )
    def test_what_leaves_double_precision_is_refused(self, x, q, says):
        for between in ("linear", "cubic"):
            if says:
                with pytest.raises(ValueError, match=says):
                    abel.stress_from_line_load(x, q, 0.5, interpolation=between)
            else:
                assert np.isfinite(abel.stress_from_line_load(x, q, 0.5, interpolation=between))

    def test_jumps_at_one_place_are_one(self):
        """A step down to −1 and the end of the load there are the end of the load before."""
        for r in (0.0, 0.4, 1.0):
            both = abel.stress_from_line_load([0, 0.5, 1, 1], [2, 2, 2, -1], r)
            assert both == abel.stress_from_line_load([0, 0.5, 1], [2, 2, 2], r)

    def test_another_interpolation_is_refused(self):
        with pytest.raises(ValueError, match="interpolation = 'round' must be one of 'linear', 'cubic'"):
            abel.stress_from_line_load([0, 1], [1, 0], 0.5, interpolation="round")


class TestLineLoadFromStress:
    def test_uniform_and_linear_pressure(self):
        """p = 1: q = 2√(1−x²); p = 1 − r: q = √(1−x²) − x² arccosh(1/x)."""
        r, x = np.linspace(0, 1, 41), np.array([0.0, 1e-6, 0.3, 0.99])
        uniform = abel.line_load_from_stress(r, -np.ones_like(r), x)
        np.testing.assert_allclose(uniform, 2 * np.sqrt(1 - x * x), rtol=1e-13)
        linear = abel.line_load_from_stress(r, r - 1, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            expected = np.sqrt(1 - x * x) - np.where(x > 0, x * x * np.arccosh(1 / x), 0)
        np.testing.assert_allclose(linear, expected, rtol=1e-11)

    def test_gives_back_the_line_load_of_a_state(self):
        medium = mdr.Medium(1e9, 1.0)
        state = mdr.indent(mdr.Paraboloid(1e-5), medium, 0.8 * medium.critical_depth)
        r = state.contact_radius * np.sin(np.linspace(0, np.pi / 2, 2001))
        x = np.linspace(0, 0.95, 20) * state.contact_radius
        back = abel.line_load_from_stress(r, -state.pressure(r), x)
        # Chords of 1/2000 under a smooth pressure: second order
        # in the mean, of which q is small near the edge.
        np.testing.assert_allclose(back, state.line_load(x), rtol=1e-5)


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
            assert g == pytest.approx(reduced(x), rel=1e-13)

    def test_inverse_gives_back_the_height(self):
        height = abel.height_from_reduced(lambda x: x * np.arctan(x), np.array([0.1, 2.0]))
        np.testing.assert_allclose(height, np.sqrt(1 + np.array([0.1, 2.0]) ** 2) - 1, rtol=1e-13)

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
