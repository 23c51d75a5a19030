"""Indenter shapes: Popov (2015), Eqs. (3)-(8), and the inverse of the reduced profile."""

import math

import numpy as np
import pytest

pytest.importorskip("mpmath")

from mpmath import mp, mpf

import mdr_core as mdr
from mdr_core.abel import kappa

from ...approx import approx
from ...hard_cases import EXTREMES
from ...reference import Reference
from ...shapes import POWER_LAWS, SHAPES, integrate, name

# Radii around the size of the shapes, on both sides of every kink.
RADII = np.array([1e-9, 1e-7, 0.299e-6, 0.301e-6, 0.999e-6, 1.001e-6, 3e-6, 9.9e-6])


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_eq_3_reduced_profile_is_the_transform_of_the_height(shape):
    """z is the inverse transform of g: z(r) = (2/π) ∫ g(r sin t) dt."""
    for r in RADII[shape.wall > RADII]:
        breaks = [0.0, *(math.asin(k / r) for k in (0.3e-6, 1e-6) if k < r), math.pi / 2]
        height = integrate(lambda t, r=r: shape.reduced(r * math.sin(t)), breaks)
        # The quadrature's own error; just behind a kink r itself is known to 3 digits less.
        assert 2 / math.pi * height == approx(shape.height(r), rel=1e-9, abs=1e-22)


@pytest.mark.parametrize("shape", POWER_LAWS, ids=name)
def test_eq_5_power_law_keeps_its_exponent(shape):
    n = math.log(shape.height(2e-6) / shape.height(1e-6)) / math.log(2)
    assert shape.reduced(2e-6) / shape.reduced(1e-6) == approx(2**n, rel=1e-14)


def test_eq_7_known_coefficients():
    assert kappa(1.0) == approx(math.pi / 2, rel=2e-16)
    assert kappa(2.0) == approx(2.0, rel=2e-16)


@pytest.mark.parametrize("n", [1e-6, 0.1, 1.0, 7.5, 50.0, 99.0])
def test_eq_7_recurrence(n):
    """κₙ κₙ₊₁ = (π/2)(n + 1), from the duplication of the gamma function."""
    # Each κ carries the few roundings of two gamma functions.
    assert kappa(n) * kappa(n + 1) == approx(math.pi / 2 * (n + 1), rel=5e-15)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_contact_radius_inverts_the_reduced_profile(shape):
    depth = np.geomspace(1e-12, 1e-6, 61)
    a = shape.contact_radius(depth)
    # g amplifies the rounding of a without bound at the edge of a flat face: bracket it instead.
    below, above = shape.reduced(a * (1 - 1e-15)), shape.reduced(a * (1 + 1e-15))
    assert np.all(below <= depth * (1 + 1e-15))
    assert np.all(above >= depth * (1 - 1e-15))
    assert np.all(np.diff(a) >= 0)


class TestRadiusAtHeight:
    """z(r) = h, for arrays of any shape: the largest such radius."""

    @pytest.mark.parametrize("shape", EXTREMES, ids=name)
    def test_inverts_the_height(self, shape):
        deepest = shape.radius if isinstance(shape, mdr.Sphere) else np.inf
        h = np.append(0.0, np.geomspace(1e-14, 1e-6, 59)).reshape(3, 20)
        r = shape.radius_at_height(np.minimum(h, deepest))
        assert r.shape == h.shape
        assert np.all(np.diff(r.ravel()) >= 0)
        # At the edge of a flat face, and at a wall, z amplifies the rounding of r: it is bracketed.
        outer = np.minimum(r * (1 + 4e-15), shape.known_radius)
        assert np.all(shape.height_at(r * (1 - 4e-15)) <= h * (1 + 1e-15))
        assert np.all(shape.height_at(outer) >= h * (1 - 1e-15))
        assert shape.radius_at_height(h[1, 3]) == r[1, 3]

    @pytest.mark.parametrize("shape", EXTREMES, ids=name)
    def test_closed_forms_are_what_a_search_finds(self, shape):
        h = np.geomspace(1e-12, 1e-6, 40)
        expected = mdr.Profile.radius_at_height(shape, h)
        np.testing.assert_allclose(shape.radius_at_height(h), expected, rtol=1e-14)

    def test_of_many_indenters(self):
        h = np.array([[1e-7], [1e-6]])
        for many in (mdr.Cone([0.1, 0.3]), mdr.Sphere([1e-5, 2e-5]), mdr.RoundedCone([1e-7, 1e-6], 0.3)):
            expected = np.hstack([many.entries(i).radius_at_height(h) for i in range(2)])
            np.testing.assert_allclose(many.radius_at_height(h), expected, rtol=1e-15)

    def test_a_shape_with_another_height_does_not_inherit_the_inverse(self):
        class Steeper(mdr.Cone):
            def height_at(self, r):
                return 2 * self.slope * r

        assert Steeper(0.3).radius_at_height(3e-6) == approx(0.5e-5, rel=1e-14)


@pytest.mark.parametrize("shape", EXTREMES, ids=name)
def test_reduced_slope_is_the_derivative(shape):
    """Against a difference of 45 digits of the textbook's g."""
    exact = Reference(shape, mdr.Medium(1e9, q_c=1.0), 1e-9)
    # On neither side of a kink by chance.
    x = 1.0001 * RADII
    x = x[(x < shape.wall) & (x < shape.known_radius)]
    expected = np.array([float(mp.diff(exact.g, mpf(each), h=mpf(each) * mpf(10) ** -20)) for each in x])
    # Behind an edge at b the slope goes as √(b/(x − b)): x/b is known to three digits less.
    # The slope of r⁵⁰ leaves double precision on the way to the axis.
    np.testing.assert_allclose(shape.reduced_slope(x), expected, rtol=1e-12, atol=1e-60)
    np.testing.assert_array_equal(shape.reduced_slope(-x), -shape.reduced_slope(x))
    assert isinstance(shape.reduced_slope(2e-7), float)


def test_reduced_slope_on_a_kink_is_that_of_its_outer_side():
    """Behind a corner of z the profile g begins as a root, behind a step of its curvature as a cube."""
    assert mdr.TruncatedCone(1e-6, 0.3).reduced_slope(1e-6) == math.inf
    assert mdr.TruncatedParaboloid(1e-6, 1e-5).reduced_slope(1e-6) == math.inf
    assert mdr.RoundedPunch(1e-6, 1e-5).reduced_slope(1e-6) == 0.0
    # b = sR: 2b/R on either side.
    assert mdr.RoundedCone(1e-6, 0.3).reduced_slope(0.3e-6) == approx(0.6, rel=1e-15)
    tip = mdr.Sampled([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 3.0, 6.0])
    np.testing.assert_array_equal(tip.reduced_slope([1.0, 2.0, -2.0]), [math.inf, math.inf, -math.inf])
    assert tip.reduced_slope(np.nextafter(1.0, 0)) == approx(math.pi / 2, rel=1e-15)
    for flat in (mdr.TruncatedCone(1e-6, 0.3), mdr.FlatPunch(1e-6)):
        assert flat.reduced_slope(0.999e-6) == 0.0
    for walled in (mdr.FlatPunch(1e-6), mdr.ParabolicPunch(1e-5, 1e-6)):
        assert walled.reduced_slope(1.001e-6) == math.inf


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_profiles_are_even_and_keep_shape(shape):
    x = np.array([[-2e-7, 2e-7], [0.0, 5e-7]])
    for function in (shape.height, shape.reduced):
        assert function(x).shape == x.shape
        assert function(x)[0, 0] == function(x)[0, 1]
        assert isinstance(function(2e-7), float)
    assert shape.height(0.0) == shape.reduced(0.0) == 0.0
    assert isinstance(shape.contact_radius(1e-9), float)


def test_limits_of_families():
    """Each family tends to a simpler shape, with the next term of the series right."""
    depth = 1e-9
    cone = mdr.Cone(slope=0.3).contact_radius(depth)
    # b/a → 0: g = s x (π/2 − b/x), so a grows by (2/π) b.
    b = 1e-6 * cone
    assert mdr.TruncatedCone(b, 0.3).contact_radius(depth) - cone == approx(2 / math.pi * b, rel=1e-5)
    # a/R → 0: g = x²/R (1 + x²/(3R²)), so a shrinks by a³/(6R²).
    paraboloid = mdr.Paraboloid(1e-3).contact_radius(depth)
    change = mdr.Sphere(1e-3).contact_radius(depth) - paraboloid
    assert change == approx(-(paraboloid**3) / 6e-6, rel=1e-5)
    # a ≫ sR: g = s (π/2 x − sR).
    blunt = 1e-6 * cone
    hyperboloid = mdr.Hyperboloid(0.3, blunt / 0.3).contact_radius(depth)
    assert hyperboloid - cone == approx(2 / math.pi * blunt, rel=1e-5)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: mdr.Cone(slope=0.0), "Cone slope = 0 must be finite and positive"),
        (lambda: mdr.Paraboloid(radius=-1.0), "Paraboloid radius = -1 m"),
        (lambda: mdr.PowerLaw(coefficient=1.0, exponent=0.0), "exponent = 0"),
        (lambda: mdr.Hyperboloid(slope=1e-200, tip_radius=1.0), r"between 1e-25 and 1e\+25"),
        (
            lambda: mdr.PowerLaw(coefficient=1.0, exponent=1e15),
            "must lie between 0.01 and 100; .*FlatPunch",
        ),
        (lambda: mdr.PowerLaw(coefficient=1e308, exponent=50.0), r"1e\+308 m\^\(1-n\) must lie between"),
        (lambda: kappa([2.0, 300.0]), r"exponent n\[1\] = 300 must be 0 or lie between 0 and 100"),
        (lambda: mdr.FlatPunch(radius=math.inf), "radius = inf m"),
        (lambda: mdr.Cone(slope=1.0).contact_radius(-1.0), "depth = -1 m is negative"),
        (lambda: mdr.Cone(slope=1.0).height("far"), "radius r must be real numbers"),
        (lambda: mdr.Sphere(radius=1.0).contact_radius(1e3), "deeper than the equator"),
    ],
)
def test_bad_shapes_and_arguments_are_refused(make, says):
    with pytest.raises(ValueError, match=says):
        make()


@pytest.mark.parametrize(("degrees", "slope"), [(45.0, 1.0), (60.0, 3**-0.5), (30.0, 3**0.5)])
def test_cone_from_its_half_angle(degrees, slope):
    assert mdr.Cone.from_half_angle(degrees).slope == approx(slope, rel=1e-15)


def test_the_cone_of_a_pyramid_has_its_force():
    """F = 0.7453 E* d² tan α of Bilodeau (1992): a cone of the same angle makes 17 % more of E*."""
    depth, tangent = np.linspace(0, 1e-6, 50), np.tan(np.radians(35.0))
    force = 0.7453 * 20e3 * depth**2 * tangent
    assert mdr.indent(mdr.Cone.pyramid(35.0), mdr.Medium(20e3), depth).force == approx(force)
    moduli = [
        mdr.fit_indentation(tip, depth, force, q_c=np.inf).medium.E_star
        for tip in (mdr.Cone.pyramid(35.0), mdr.Cone.from_half_angle(35.0))
    ]
    assert moduli == approx([20e3, 23.41e3], rel=1e-3)
    with pytest.raises(ValueError, match="half-angle"):
        mdr.Cone.pyramid(95.0)


def test_the_cone_of_a_berkovich_tip():
    """Oliver and Pharr: half-angle 70.3°, A = 24.5 h² (three figures as they are quoted)."""
    cone = mdr.Cone.berkovich()
    assert cone.slope == approx(mdr.Cone.from_half_angle(70.3).slope, rel=3e-4)
    assert np.pi / cone.slope**2 == approx(24.5, abs=0.05)


@pytest.mark.parametrize("degrees", [0.0, 90.0, -70.3, np.nan, [45.0, 91.0]])
def test_bad_half_angles_are_refused(degrees):
    with pytest.raises(ValueError, match="half-angle"):
        mdr.Cone.from_half_angle(degrees)
