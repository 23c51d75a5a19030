"""Fields of one state: pressure where it is singular, and that of the dashpots."""

import math
from itertools import pairwise

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name
from .test_indentation import D_C, HISTORIES, MEDIUM, state

WET = (
    mdr.Cone(0.3),
    mdr.Paraboloid(1e-5),
    mdr.Sphere(1e-5),
    mdr.RoundedCone(1e-6, 0.3),
    mdr.RoundedPunch(1e-6, 1e-5),
)


def test_pressure_is_infinite_only_where_it_is():
    """Rim of a flat face, elastic sharp tip; nowhere NaN."""
    for shape in SHAPES:
        for history in HISTORIES:
            s = state(shape, history)
            a, c = s.contact_radius, s.plastic_radius
            r = np.array([0, 1e-300, 0.3e-6, 1e-6, c, a, np.nextafter(a, 0), np.nextafter(a, 1), 2 * a])
            assert not np.isnan(s.pressure(r)).any(), (shape, history)
            assert not np.isnan(s.surface(r)).any(), (shape, history)
            assert not np.isnan(s.imprint(r)).any(), (shape, history)
            assert s.pressure(2 * a) == 0.0, (shape, history)
    assert state(SHAPES[0], (0.4 * D_C,)).pressure(0.0) == np.inf
    assert np.isfinite(state(SHAPES[0], (3 * D_C,)).pressure(0.0))
    assert mdr.indent(mdr.FlatPunch(1e-6), MEDIUM, D_C).pressure(1e-6) == np.inf


@pytest.mark.parametrize("n", [0.5, 1.5, 3.0])
@pytest.mark.parametrize("excess", [1e-12, 1e-6, 1e-3])
def test_axis_pressure_and_stiffness_of_a_power_law_next_to_the_threshold(n, excess):
    """p(0) = (E*/π) n κ c (a^(n−1) − c^(n−1))/(n−1), dF/dd = 2E*(a − c), c/a from d_p/d itself."""
    shape = mdr.PowerLaw(1e-3, n)
    s = mdr.indent(shape, MEDIUM, D_C * (1 + excess))
    ratio = (s.plastic_depth / s.depth) ** (1 / n)
    a = s.contact_radius
    expected = MEDIUM.E_star / math.pi * n * s.depth / a * (1 - ratio ** (n - 1)) / (n - 1)
    # Powers of a ratio down to 1e-12.
    assert s.pressure(0.0) == approx(expected, rel=1e-12)
    assert s.stiffness == approx(2 * MEDIUM.E_star * a * (1 - ratio), rel=1e-13)


@pytest.mark.parametrize("r", [1e-20, 1e-60])
@pytest.mark.parametrize("tip", [mdr.Cone(1.0), mdr.PowerLaw(1.0, 1.0)], ids=name)
def test_pressure_next_to_a_sharp_tip(tip, r):
    """p = (E*/2) arcosh(a/r): a logarithm, however small r is."""
    state = mdr.indent(tip, mdr.Medium(E_star=1e9), 1e-7)
    expected = 1e9 / 2 * (math.log(2 * state.contact_radius) - math.log(r))
    assert state.pressure(r) == approx(expected, rel=1e-13)


@pytest.mark.parametrize("shape", WET, ids=name)
def test_pressure_of_a_body_in_motion_is_the_transform_of_its_element_loads(shape):
    """q = E* min(d − g, d − d_p) + 4ηḋ while that is positive, at every instant, in and out; Eq. (10)."""
    medium = mdr.Medium(1e9, q_c=10.0, eta=2.0)
    motion = mdr.impact(shape, medium, 1e-9, 0.1).motion(12)
    for i in (1, 4, 8, 10):
        state, depth = motion.states[i], motion.depth[i]
        a, c = float(state.contact_radius), float(state.plastic_radius)
        places = [0.0, c, *(k for k in (0.3e-6, 1e-6) if k < a), a]
        # Crowded at both ends of every stretch, where the load goes with a root.
        rise = (1 - np.cos(np.linspace(0, np.pi, 801))) / 2
        x = np.concatenate([low + (high - low) * rise for low, high in pairwise(sorted(places))])
        # Just inside: a load with a jump at the rim ends there.
        inside = np.minimum(x, a * (1 - 1e-15))
        spring = np.minimum(depth - shape.reduced(inside), depth - motion.plastic_depth[i])
        load = np.maximum(medium.E_star * spring + 4 * medium.eta * motion.velocity[i], 0.0)
        r = np.array([0.2, 0.55, 0.9, 0.97]) * a
        expected = -mdr.abel.stress_from_line_load(x, load, r)
        # Straight lines between 800 places: their spacing to the power 1.5 next to r.
        np.testing.assert_allclose(state.pressure(r), expected, rtol=2e-4)
        np.testing.assert_allclose(state.line_load(r), np.interp(r, x, load), rtol=1e-4)


@pytest.mark.parametrize("shape", WET, ids=name)
def test_dashpots_press_as_a_flat_punch(shape):
    """4ηḋ at every element in contact is that of a flat punch of radius a: 4ηḋ/(π√(a² − r²))."""
    medium = mdr.Medium(1e9, q_c=10.0, eta=2.0)
    motion = mdr.impact(shape, medium, 1e-9, 0.1).motion(12)
    state = motion.states[3]
    slow = mdr.indent(shape, medium, motion.depth[3])
    a, load = state.contact_radius, 4 * medium.eta * motion.velocity[3]
    r = np.array([0.0, 0.5, 0.99]) * a
    with np.errstate(invalid="ignore"):
        added = state.pressure(r) - slow.pressure(r)
    finite = np.isfinite(slow.pressure(r))
    punch = load / math.pi / np.sqrt(a**2 - r**2)
    # A difference of pressures of one size.
    np.testing.assert_allclose(added[finite], punch[finite], rtol=1e-12)
    assert state.force - slow.force == approx(2 * a * load, rel=1e-12)
    assert state.pressure(a) == math.inf
    assert state.pressure(1.001 * a) == 0.0


@pytest.mark.parametrize("shape", [mdr.Smooth(lambda r: r / 1e-6), *SHAPES], ids=name)
def test_pressure_within_a_rounding_of_the_plastic_radius(shape):
    """Between its values at c (1 ± 10⁻⁸): a node may round to r, and the tangent at r = c is vertical."""
    for deep in np.random.default_rng(3).uniform(1.5, 40.0, 40):
        s = mdr.indent(shape, MEDIUM, deep * D_C)
        c = s.plastic_radius
        if c == s.contact_radius or c == shape.face_radius:
            continue
        near = [np.nextafter(c, 0), np.nextafter(np.nextafter(c, 0), 0), np.nextafter(c, 1)]
        # √(2·10⁻⁸) of the pressure, times a slope of some units.
        assert s.pressure(near) == approx(s.pressure(c * (1 + 1e-8)), rel=1e-3)


class TestLargestPressure:
    """`max_pressure` against closed forms and against the pressure at many radii."""

    @pytest.mark.parametrize("ratio", [1 + 1e-6, 2.0, 1e3, 1e8])
    def test_of_cones_and_paraboloids_that_yield(self, ratio):
        """At r = c: (E* s/2) arcosh(a/c), and (2E*/(π R)) √(a² − c²) with a² − c² = R d_c, to rounding.

        At r = c itself `pressure` has the rounding of c, 10⁻⁹ of it at 10⁸ critical depths.
        """
        medium = mdr.Medium.from_critical_depth(1e10, D_C)
        cone, ball = (mdr.indent(tip, medium, ratio * D_C) for tip in (mdr.Cone(0.3), mdr.Paraboloid(1e-5)))
        live = cone.live_interval.length / cone.live_interval.lower
        arcosh = math.log1p(live + math.sqrt(live * (2 + live)))
        assert cone.max_pressure == approx(1.5e9 * arcosh, rel=2e-14)
        length = float(ball.live_interval.length)
        assert ball.max_pressure == approx(2e10 / np.pi * math.sqrt(length / 1e-5), rel=2e-14)

    def test_of_a_body_of_fourth_order_within_the_contact(self):
        """p ∝ √(a² − r²) (a² + 2r²) of z ∝ r⁴ has √2 times the pressure of the axis at a/√2."""
        state = mdr.indent(mdr.PowerLaw(1e16, 4.0), mdr.Medium(1e10), 1e-8)
        assert state.max_pressure == approx(math.sqrt(2) * state.pressure(0.0), rel=1e-13)
        assert state.max_pressure == approx(state.pressure(state.contact_radius / math.sqrt(2)), rel=1e-13)

    @pytest.mark.parametrize("history", HISTORIES, ids=str)
    @pytest.mark.parametrize("shape", SHAPES, ids=name)
    def test_is_the_largest_of_many_radii(self, shape, history):
        """Of 4,000 radii the largest pressure is up to 10⁻⁵ less; at c it has a vertical tangent inside."""
        s = state(shape, history)
        places = [0.0, s.contact_radius, s.plastic_radius * (1 + 1e-12), shape.face_radius]
        values = s.pressure(np.append(s.contact_radius * np.linspace(0, 1, 4001), places))
        assert s.max_pressure >= np.max(values) * (1 - 1e-11)
        assert s.max_pressure == approx(np.max(values), rel=1e-5)

    def test_is_infinite_where_the_pressure_is(self):
        elastic, yields = mdr.Medium(1e10), mdr.Medium(1e10, q_c=10.0)
        for tip in (
            mdr.Cone(0.3),
            mdr.FlatPunch(1e-6),
            mdr.TruncatedCone(1e-6, 0.3),
            mdr.PowerLaw(1e-3, 0.5),
        ):
            assert mdr.indent(tip, elastic, 1e-8).max_pressure == np.inf
        assert mdr.indent(mdr.FlatPunch(1e-6), yields, 1e-6).max_pressure == np.inf
        assert mdr.indent(mdr.TruncatedCone(1e-6, 0.3), yields, 1e-6).max_pressure < np.inf
        # While the dashpots carry a load, at the rim; first touch has no contact.
        motion = mdr.impact(mdr.Paraboloid(1e-5), mdr.Medium(1e10, q_c=10.0, eta=1.0), 1e-9, 1.0).motion(9)
        top = motion.turning_index
        assert np.isinf(motion.states.max_pressure).tolist() == [
            False,
            *[True] * (top - 1),
            *[False] * (9 - top),
        ]

    def test_with_adhesion_and_without_contact(self):
        """Of a ball by JKR that on the axis; after deep yield that at c, and 0 out of contact."""
        ball = mdr.Paraboloid(1e-5)
        sticks = mdr.indent(ball, mdr.Medium(1e9, work_of_adhesion=0.1), [3e-8, -1e-6])
        assert sticks[0].max_pressure == sticks[0].pressure(0.0)
        assert sticks[1].max_pressure == 0.0
        yields = mdr.indent(ball, mdr.Medium(1e9, q_c=10.0, work_of_adhesion=0.1), 1e-6)
        assert yields.max_pressure == approx(yields.pressure(yields.plastic_radius * (1 + 1e-12)), rel=1e-9)
        assert yields.max_pressure > yields.pressure(0.0)

    def test_of_a_polygon_is_that_of_the_body_through_its_samples(self):
        """Vertices do not count. To the pressure of the facets next to the axis, a few per cent."""
        ball, medium = mdr.Paraboloid(1e-5), mdr.Medium(1e10)
        r = np.linspace(0, 1e-6, 400)
        samples = mdr.Sampled(r, ball.height(r))
        for depth in (2e-9, 2e-8):
            state = mdr.indent(samples, medium, depth)
            assert state.pressure(r[20]) == np.inf
            assert state.max_pressure == approx(mdr.indent(ball, medium, depth).max_pressure, rel=0.08)
        flat = mdr.Sampled([0.0, 1e-7, 1e-6, 1.1e-6], [0.0, 0.0, 1e-8, 5e-8])
        faced = mdr.indent(flat, medium, 1e-8)
        assert faced.max_pressure == faced.pressure(0.0)
        yields = mdr.Medium(1e10, q_c=10.0)
        expected = mdr.indent(ball, yields, 2e-8).max_pressure
        assert mdr.indent(samples, yields, 2e-8).max_pressure == approx(expected, rel=0.08)

    def test_of_ensembles_and_of_hits_at_the_turning_point(self):
        medium = mdr.Medium([[1e10], [2e10]], q_c=10.0)
        states = mdr.indent(mdr.Sphere(1e-5), medium, [1e-9, 1e-7, 0.0])
        for index in np.ndindex(2, 3):
            assert states.max_pressure[index] == states[index].max_pressure
        hits = mdr.impact(mdr.Cone([0.2, 0.3]), mdr.Medium(1e10, q_c=10.0), 1e-12, 1.0)
        assert hits.max_pressure.tolist() == [hit.turning_point.max_pressure for hit in hits]
        assert "max_pressure" not in hits.to_dict() | states.to_dict()
