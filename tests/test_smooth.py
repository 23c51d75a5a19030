"""Shapes given by their slope alone agree with their closed forms to rounding."""

import numpy as np
import pytest

import mdr_core as mdr

MEDIUM = mdr.Medium(1e9, 1.0)
D_C = MEDIUM.critical_depth
R = 1e-5
PAIRS = {
    "cone": (lambda r: 0.3 + 0 * r, mdr.Cone(0.3)),
    "paraboloid": (lambda r: r / R, mdr.Paraboloid(R)),
    "cubic": (lambda r: 3e11 * r**2, mdr.PowerLaw(1e11, 3.0)),
    "sphere": (lambda r: r / np.sqrt((R - r) * (R + r)), mdr.Sphere(R)),
    "hyperboloid": (lambda r: 0.3 * r / np.sqrt(r**2 + 9e-14), mdr.Hyperboloid(0.3, 1e-6)),
}


@pytest.mark.parametrize("history", [(0.4,), (3.0,), (100.0,), (1000.0, 999.5)])
@pytest.mark.parametrize("pair", PAIRS)
def test_same_as_the_closed_form(pair, history):
    slope, exact = PAIRS[pair]
    path = np.array(history) * D_C
    smooth, closed = mdr.indent(mdr.Smooth(slope), MEDIUM, path)[-1], mdr.indent(exact, MEDIUM, path)[-1]
    x = np.array([1e-3, 0.5, 1.0]) * closed.contact_radius
    np.testing.assert_allclose(smooth.profile.reduced(x), exact.reduced(x), rtol=1e-13)
    np.testing.assert_allclose(smooth.profile.height(x), exact.height(x), rtol=1e-13)
    assert smooth.contact_radius == pytest.approx(closed.contact_radius, rel=1e-14)
    for field in ("force", "stored_energy", "plastic_work"):
        assert getattr(smooth, field) == pytest.approx(getattr(closed, field), rel=2e-13), field
    # The derivative of the Chebyshev series has lost two or three digits.
    np.testing.assert_allclose(smooth.pressure(x[:2]), closed.pressure(x[:2]), rtol=2e-11)
    r = np.array([0.9, 1.5, 100.0]) * closed.contact_radius
    np.testing.assert_allclose(smooth.surface(r), closed.surface(r), rtol=1e-11)


def test_force_path_and_impact():
    smooth, exact = mdr.Smooth(PAIRS["paraboloid"][0]), PAIRS["paraboloid"][1]
    force = mdr.indent(exact, MEDIUM, 5 * D_C).force
    assert mdr.indent_to_force(smooth, MEDIUM, force).depth == pytest.approx(5 * D_C, rel=1e-13)
    hits = [mdr.impact(shape, MEDIUM, 1e-9, 0.01) for shape in (smooth, exact)]
    assert hits[0].restitution == pytest.approx(hits[1].restitution, rel=1e-12)
    assert hits[0].contact_time == pytest.approx(hits[1].contact_time, rel=1e-11)


@pytest.mark.parametrize(
    ("slope", "says"),
    [
        (lambda r: np.sqrt(r), "fractional power of r belongs to PowerLaw"),
        (lambda r: 0.1 - 1e7 * r, "contact would not be compact"),
        (lambda r: 0.1 * np.sin(r * 1e7), "not be compact|too rough|deeper than the Smooth shape is known"),
        (lambda r: np.abs(r - 1e-7) / R, "deeper than the Smooth shape is known"),
        (lambda r: r / np.sqrt(1e-16 - r * r), "deeper than the Smooth shape is known|too rough"),
    ],
)
def test_shapes_that_cannot_be_solved_are_refused(slope, says):
    with pytest.raises(ValueError, match=says):
        _ = mdr.indent(mdr.Smooth(slope), MEDIUM, 200 * D_C).force


@pytest.mark.parametrize(("radius", "depth"), [(10.0, 1e9), (np.inf, 1e50)])
def test_depths_beyond_the_end_are_refused_far_out_too(radius, depth):
    """Where the search for the contact radius has passed from 1 m to the end of the shape."""
    with pytest.raises(ValueError, match="deeper than the Smooth shape is known"):
        mdr.Smooth(lambda r: r, radius).contact_radius(depth)


def test_depths_next_to_nothing_are_refused():
    with pytest.raises(ValueError, match=r"depth = 1e-300 m must be 0 or at least 1e-60; give it in SI"):
        mdr.Smooth(lambda r: r).contact_radius(1e-300)


def test_known_radius_is_respected():
    slope = PAIRS["paraboloid"][0]
    with pytest.raises(ValueError, match="deeper than the Smooth shape is known"):
        _ = mdr.indent(mdr.Smooth(slope, radius=1e-7), MEDIUM, 10 * D_C).force
    with pytest.raises(ValueError, match="beyond the radius up to which"):
        mdr.Smooth(slope, radius=1e-7).reduced(2e-7)
    with pytest.raises(ValueError, match="must be a function"):
        mdr.Smooth(0.3)
    with pytest.raises(ValueError, match="a Smooth cannot be written as JSON"):
        mdr.Scene(mdr.Smooth(slope), MEDIUM, mdr.DepthPath(1e-9)).to_json()


def test_depths_with_no_digits_left_beside_the_shape():
    """Overdamped bodies leave at depths that nobody would hand in; the shape goes on as a power there."""
    shape = mdr.Smooth(lambda r: r / 1e-5)
    depth = np.array([1e-300, 1e-100, 1e-70])
    # The exponent comes from g at 10⁻⁸ of the end of the series, and is used over 240 decades.
    assert shape._radius(depth) == pytest.approx(np.sqrt(depth * 1e-5), rel=1e-5)


def test_depths_far_apart_in_one_zone():
    """The plastic depth just beyond yield, 10⁻³⁰ of the depth, where the series of g/x is but rounding."""
    (zone,) = mdr.Smooth(lambda r: r).zones_between(0.0, 1.0)
    depth = np.geomspace(1e-34, 1e-2, 2000)
    np.testing.assert_allclose(
        zone.coordinate(depth[depth > 1e-15]), np.sqrt(depth[depth > 1e-15]), rtol=1e-7
    )
    assert np.all(zone.coordinate(depth) < 1.1 * np.sqrt(depth) + 1e-8)


@pytest.mark.parametrize(
    ("slope", "known"),
    [
        (lambda r: r / 1e-8, mdr.Paraboloid(1e-8)),
        (lambda r: 1e12 * r**3, mdr.PowerLaw(1e12 / 4, 4.0)),
        (lambda r: 0.3 * r / np.hypot(r, 1e-3), mdr.Hyperboloid(0.3, 1e-3 / 0.3)),
    ],
    ids=["paraboloid", "fourth power", "hyperboloid"],
)
def test_radius_of_a_depth_far_below_the_one_that_was_fitted(slope, known):
    """A plastic zone may be a trillionth of the contact: its radius keeps nine digits or so."""
    deepest = 1e-6
    (zone,) = mdr.Smooth(slope).zones_between(0.0, deepest)
    depth = deepest * np.logspace(-22, -4, 400)
    np.testing.assert_allclose(zone.coordinate(depth), known.contact_radius(depth), rtol=1e-9)
