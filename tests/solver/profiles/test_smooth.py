"""Shapes given by their slope alone agree with their closed forms to rounding."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

MEDIUM = mdr.Medium(1e9, q_c=1.0)
D_C = MEDIUM.critical_depth
R = 1e-5
PAIRS = {
    "cone": (lambda r: 0.3 + 0 * r, mdr.Cone(0.3)),
    "paraboloid": (lambda r: r / R, mdr.Paraboloid(R)),
    "cubic": (lambda r: 3e11 * r**2, mdr.PowerLaw(1e11, 3.0)),
    "sphere": (lambda r: r / np.sqrt((R - r) * (R + r)), mdr.Sphere(R)),
    "hyperboloid": (lambda r: 0.3 * r / np.sqrt(r**2 + 9e-14), mdr.Hyperboloid(0.3, 1e-6)),
}


@pytest.mark.few(5)
@pytest.mark.parametrize("history", [(0.4,), (3.0,), (100.0,), (1000.0, 999.5)])
@pytest.mark.parametrize("pair", PAIRS)
def test_same_as_the_closed_form(pair, history):
    slope, exact = PAIRS[pair]
    path = np.array(history) * D_C
    smooth, closed = mdr.indent(mdr.Smooth(slope), MEDIUM, path)[-1], mdr.indent(exact, MEDIUM, path)[-1]
    x = np.array([1e-3, 0.5, 1.0]) * closed.contact_radius
    np.testing.assert_allclose(smooth.profile.reduced(x), exact.reduced(x), rtol=1e-13)
    np.testing.assert_allclose(smooth.profile.height(x), exact.height(x), rtol=1e-13)
    assert smooth.contact_radius == approx(closed.contact_radius, rel=1e-14)
    height = exact.height(x)
    np.testing.assert_allclose(smooth.profile.radius_at_height(height), x, rtol=1e-13)
    for field in ("force", "stored_energy", "plastic_work"):
        assert getattr(smooth, field) == approx(getattr(closed, field), rel=2e-13), field
    # The derivative of the Chebyshev series has lost two or three digits.
    np.testing.assert_allclose(smooth.pressure(x[:2]), closed.pressure(x[:2]), rtol=2e-11)
    r = np.array([0.9, 1.5, 100.0]) * closed.contact_radius
    np.testing.assert_allclose(smooth.surface(r), closed.surface(r), rtol=1e-11)


def test_force_path_and_impact():
    smooth, exact = mdr.Smooth(PAIRS["paraboloid"][0]), PAIRS["paraboloid"][1]
    force = mdr.indent(exact, MEDIUM, 5 * D_C).force
    assert mdr.indent_to_force(smooth, MEDIUM, force).depth == approx(5 * D_C, rel=1e-13)
    hits = [mdr.impact(shape, MEDIUM, 1e-9, 0.01) for shape in (smooth, exact)]
    assert hits[0].restitution == approx(hits[1].restitution, rel=1e-12)
    assert hits[0].contact_time == approx(hits[1].contact_time, rel=1e-11)


@pytest.mark.parametrize(
    ("slope", "says"),
    [
        (lambda r: 1 / r, "must be finite|not finite"),
        (lambda r: 0.1 - 1e7 * r, "contact would not be compact"),
        (lambda r: 0.1 * np.sin(r * 1e7), "not be compact|too rough|deeper than the Smooth shape is known"),
        (lambda r: np.abs(r - 1e-7) / R, "deeper than the Smooth shape is known"),
        (lambda r: r / np.sqrt(1e-16 - r * r), "deeper than the Smooth shape is known|too rough"),
    ],
)
def test_shapes_that_cannot_be_solved_are_refused(slope, says):
    with pytest.raises(ValueError, match=says):
        _ = mdr.indent(mdr.Smooth(slope), MEDIUM, 200 * D_C).force


def test_a_polynomial_is_a_slope():
    """NumPy's polynomials are not hashable, profiles are: the slope r/R is that of the paraboloid."""
    tip, medium = mdr.Smooth(np.polynomial.Polynomial([0.0, 1 / R])), mdr.Medium(1e9, work_of_adhesion=0.01)
    force = mdr.indent(tip, medium, 1e-9).force
    assert force == approx(mdr.indent(mdr.Paraboloid(R), medium, 1e-9).force, rel=1e-12)


@pytest.mark.parametrize(("radius", "depth"), [(10.0, 1e9), (np.inf, 1e24)])
def test_depths_beyond_the_end_are_refused_far_out_too(radius, depth):
    """Where the search for the contact radius has passed from 1 m to the end of the shape."""
    with pytest.raises(ValueError, match="deeper than the Smooth shape is known"):
        mdr.Smooth(lambda r: r, radius).contact_radius(depth)


def test_known_radius_is_respected():
    slope = PAIRS["paraboloid"][0]
    with pytest.raises(ValueError, match="deeper than the Smooth shape is known"):
        _ = mdr.indent(mdr.Smooth(slope, radius=1e-7), MEDIUM, 10 * D_C).force
    with pytest.raises(ValueError, match=r"coordinate x = 2e-07 m must not exceed .*, 1e-07 m"):
        mdr.Smooth(slope, radius=1e-7).reduced(2e-7)
    with pytest.raises(ValueError, match="must be a function"):
        mdr.Smooth(0.3)
    with pytest.raises(ValueError, match="a Smooth cannot be written as JSON"):
        mdr.Scene(mdr.Smooth(slope), MEDIUM, mdr.scene.DepthPath(1e-9)).to_json()


def test_a_fractional_power_of_the_radius():
    """z′ = √r next to the tip: a power law of exponent 3/2."""
    smooth, exact = mdr.Smooth(lambda r: 30 * np.sqrt(r)), mdr.PowerLaw(20.0, 1.5)
    states = [mdr.indent(shape, MEDIUM, [5 * D_C, 4.3 * D_C])[-1] for shape in (smooth, exact)]
    for field in ("contact_radius", "force", "stored_energy", "plastic_work"):
        assert getattr(states[0], field) == approx(getattr(states[1], field), rel=1e-12), field


class TestImpact:
    """A shape given by its slope alone is solved as its closed form, viscous or not."""

    EXACT = mdr.Hyperboloid(slope=0.3, tip_radius=1e-5 / 0.3)

    @staticmethod
    def smooth():
        return mdr.Smooth(lambda r: 0.3 * r / np.hypot(r, 1e-5))

    @pytest.mark.parametrize("q_c", [np.inf, 10.0])
    @pytest.mark.parametrize("share", [0.0, 0.3])
    def test_same_as_the_closed_form(self, share, q_c):
        dry = mdr.impact(self.EXACT, mdr.Medium(1e9, q_c=q_c), 1e-9, 0.1)
        medium = mdr.Medium(1e9, q_c=q_c, eta=share * dry.contact_time * 1e9 / 4)
        hits = [mdr.impact(shape, medium, 1e-9, 0.1) for shape in (self.smooth(), self.EXACT)]
        for quantity in ("max_depth", "restitution", "contact_time"):
            # Steps are planned alike: roundings of the series, and of few steps.
            assert getattr(hits[0], quantity) == approx(getattr(hits[1], quantity), rel=1e-11), quantity

    @pytest.mark.slow
    def test_neighbours_do_not_matter(self):
        """Depths from nm to mm at once: every contact radius and force has the digits it has alone."""
        shape, depth = self.smooth(), np.geomspace(1e-9, 1e-3, 13)
        medium = mdr.Medium(1e9)
        together = mdr.impact(shape, medium, 1e-9, np.geomspace(1e-4, 1.0, 5))
        for i in (0, 2, 4):
            alone = mdr.impact(self.smooth(), medium, 1e-9, together.speed[i])
            # A search that goes on for its neighbours may end one digit better.
            assert alone.max_depth == approx(together.max_depth[i], rel=4e-16)
            assert alone.contact_time == approx(together.contact_time[i], rel=2e-15)
        radius = shape.contact_radius(depth)
        alone = [self.smooth().contact_radius(each) for each in depth[::4]]
        np.testing.assert_allclose(radius[::4], alone, rtol=2e-15)
        # A series on the largest contact would hold the smallest with six digits less.
        np.testing.assert_allclose(radius, self.EXACT.contact_radius(depth), rtol=2e-14)

    def test_up_to_where_the_slope_ends(self):
        """The depth g(R) at the last radius R is still solved, nothing beyond."""
        radius = 1e-6
        shape = mdr.Smooth(lambda r: r / 1e-5, radius=radius)
        deepest = radius**2 / 1e-5
        assert shape.contact_radius(deepest * (1 - 1e-9)) == approx(radius * (1 - 5e-10), rel=1e-14)
        assert shape.known_depth == approx(deepest, rel=0.1)
        with pytest.raises(ValueError, match="presses deeper than the Smooth shape is known"):
            mdr.impact(shape, mdr.Medium(1e9), 1e-9, 10.0)


def test_tables_reach_down_to_shallow_impacts():
    """Many impacts are solved with a table that ends at 10⁶ m, single ones with the profile itself."""
    tip, medium = mdr.Smooth(lambda r: 0.3 * np.tanh(r / 1e-6)), mdr.Medium(1e9, q_c=1.0)
    depth = np.geomspace(3e-12, 1e-6, 20)
    states = mdr.indent(tip, medium, depth[:, None])
    energy = (states.stored_energy + states.plastic_work)[:, 0]
    hits = mdr.impact(tip, medium, 1e-9, np.sqrt(2 * energy / 1e-9))
    np.testing.assert_allclose(hits.max_depth, depth, rtol=1e-12)


@pytest.mark.few(1)
@pytest.mark.parametrize("radius", [1e-9, 1e-6, 1e-2])
def test_pressure_on_the_axis_of_a_rounded_tip(radius):
    """Hertz: p₀ = (2/π) E* √(d/R), with Huber's −p₀ and 0.31 p₀; g′ is from polynomials to 10⁻¹²."""
    state = mdr.indent(mdr.Smooth(lambda r: r / radius), mdr.Medium(1e9, poisson=0.3), 1e-3 * radius)
    hertz = 2 / np.pi * 1e9 * np.sqrt(1e-3)
    assert state.pressure(0.0) == approx(hertz, rel=1e-10)
    assert state.stress(0.0, 0.0).zz == approx(-hertz, rel=1e-10)
    assert state.stress_peak().value == approx(0.310 * hertz, rel=1e-3)
    assert state.profile.reduced_slope(0.0) == 0.0
    sharp = mdr.Smooth(lambda r: 0.3 + r / radius)
    assert mdr.indent(sharp, mdr.Medium(1e9), 1e-3 * radius).pressure(0.0) == np.inf
    assert sharp.reduced_slope(0.0) == approx(np.pi / 2 * 0.3, rel=1e-8)


@pytest.mark.slow
@pytest.mark.few(1)
@pytest.mark.parametrize("given", [{}, {"radius": 1e-6}, {"radius": 0.9e-6}, {"radius": 0.3e-6}], ids=str)
def test_a_slope_that_ends_has_every_class_of_hardness(given):
    """A sphere by its slope, which is infinite at its radius: the forces of the sphere, to rounding."""
    radius = 1e-6

    def slope(r):
        with np.errstate(all="ignore"):
            return r / np.sqrt((radius - r) * (radius + r))

    smooth, sphere = mdr.Smooth(slope, **given), mdr.Sphere(radius)
    for medium in (
        mdr.Medium(1e9, hardness=1e7),
        mdr.Medium(1e9, q_c=1.0, hardness=1e7, f_c=1e-7),
        mdr.Medium(1e9, q_c=10.0, work_of_adhesion=0.01),
    ):
        expected = mdr.indent(sphere, medium, 1e-9).force
        assert mdr.indent(smooth, medium, 1e-9).force == approx(expected, rel=1e-12)
    low, high = mdr.capture_speeds(smooth, medium, 1e-15)
    assert (low, high) == approx(mdr.capture_speeds(sphere, medium, 1e-15), rel=1e-10)
    assert smooth.known_radius <= radius
    # Printing looks at all classes of hardness.
    depth = np.append(np.linspace(0, 20e-9, 30), np.linspace(20e-9, 15e-9, 15))
    fit = mdr.fit_indentation(smooth, depth, mdr.indent(sphere, mdr.Medium(1e9, q_c=5.0), depth).force)
    assert "class of hardness" in repr(fit)
