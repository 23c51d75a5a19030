"""Impacts in states that are numerically hard: next to the critical depth, on kinks, on fitted shapes."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mdr_core as mdr

from .shapes import SHAPES, name

E_STAR, MASS = 1e9, 1e-9


def hit_to_depth(shape, medium, depth, eta=0.0):
    """The impact that without viscosity reaches a depth."""
    state = mdr.indent(shape, medium, depth)
    speed = np.sqrt(2 * (state.stored_energy + state.plastic_work) / MASS)
    return mdr.impact(shape, mdr.Medium(medium.E_star, medium.q_c, eta), MASS, speed)


@pytest.mark.parametrize("times", [1.0001])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_turning_just_beyond_the_critical_depth(shape, times):
    """A step of the motion may go beyond the critical depth and come back: yield still begins there.

    With a relaxation time of 10⁻⁶ contact times, largest depth and restitution are the dry ones to
    some 10⁻⁶.
    """
    medium = mdr.Medium(E_STAR, 10.0)
    dry = hit_to_depth(shape, medium, times * medium.critical_depth)
    hit = mdr.impact(shape, mdr.Medium(E_STAR, 10.0, 1e-6 * dry.contact_time * E_STAR / 4), MASS, dry.speed)
    assert hit.max_depth == pytest.approx(dry.max_depth, rel=2e-5)
    assert hit.restitution == pytest.approx(dry.restitution, rel=2e-5)
    assert hit.contact_time == pytest.approx(dry.contact_time, rel=2e-5)


def test_punch_that_turns_between_two_nodes():
    """The same for a face so wide that the force is nearly straight and steps are long."""
    shape = mdr.RoundedPunch(flat_radius=2.67297751733623e-08, edge_radius=0.00012336733608624023)
    medium = mdr.Medium(34957.174742896605, 0.0008873308645671202)
    mass, speed = 6.347070116180173e-10, 0.00045921445279458405
    dry = mdr.impact(shape, medium, mass, speed)
    hit = mdr.impact(shape, mdr.Medium(medium.E_star, medium.q_c, 3.13e-06), mass, speed)
    # τ/T is 10⁻⁶.
    assert hit.max_depth == pytest.approx(dry.max_depth, rel=1e-5)
    assert hit.contact_time == pytest.approx(dry.contact_time, rel=1e-5)
    assert hit.motion(31).kinetic_energy[-1] == pytest.approx(hit.mass * hit.rebound_speed**2 / 2, rel=1e-8)


def test_depths_of_metres_at_the_threshold_of_yield():
    """Just below the critical depth nothing yields: the contact time is that of an elastic medium."""
    for shape in (mdr.Hyperboloid(0.2, 0.9), mdr.ParabolicPunch(2.8, 0.005), mdr.TruncatedCone(0.15, 5.5)):
        hit = mdr.impact(shape, mdr.Medium(1e9, 1e13), 200.0, 1e5)
        elastic = mdr.impact(shape, mdr.Medium(1e9), 200.0, 1e5)
        assert hit.plastic_work == 0.0
        assert hit.contact_time == pytest.approx(elastic.contact_time, rel=1e-13)


class TestSmooth:
    """A shape given by its slope alone is solved as its closed form, viscous or not."""

    EXACT = mdr.Hyperboloid(slope=0.3, tip_radius=1e-5 / 0.3)

    @staticmethod
    def smooth():
        return mdr.Smooth(lambda r: 0.3 * r / np.hypot(r, 1e-5))

    @pytest.mark.parametrize("q_c", [np.inf, 10.0])
    @pytest.mark.parametrize("share", [0.0, 0.3])
    def test_same_as_the_closed_form(self, share, q_c):
        dry = mdr.impact(self.EXACT, mdr.Medium(E_STAR, q_c), MASS, 0.1)
        medium = mdr.Medium(E_STAR, q_c, share * dry.contact_time * E_STAR / 4)
        hits = [mdr.impact(shape, medium, MASS, 0.1) for shape in (self.smooth(), self.EXACT)]
        for quantity in ("max_depth", "restitution", "contact_time"):
            # Steps are planned alike: roundings of the series, and of few steps.
            assert getattr(hits[0], quantity) == pytest.approx(getattr(hits[1], quantity), rel=1e-11), (
                quantity
            )

    def test_neighbours_do_not_matter(self):
        """Depths from nm to mm at once: every contact radius and force has the digits it has alone."""
        shape, depth = self.smooth(), np.geomspace(1e-9, 1e-3, 13)
        medium = mdr.Medium(E_STAR)
        together = mdr.impact(shape, medium, MASS, np.geomspace(1e-4, 1.0, 5))
        for i in range(5):
            alone = mdr.impact(self.smooth(), medium, MASS, together.speed[i])
            # A search that goes on for its neighbours may end one digit better.
            assert alone.max_depth == pytest.approx(together.max_depth[i], rel=4e-16)
            assert alone.contact_time == pytest.approx(together.contact_time[i], rel=2e-15)
        alone = [self.smooth().contact_radius(each) for each in depth]
        np.testing.assert_array_equal(shape.contact_radius(depth), alone)
        # A series on the largest contact would hold the smallest with six digits less.
        np.testing.assert_allclose(alone, self.EXACT.contact_radius(depth), rtol=2e-14)

    def test_up_to_where_the_slope_ends(self):
        """The depth g(R) at the last radius R is still solved, nothing beyond."""
        radius = 1e-6
        shape = mdr.Smooth(lambda r: r / 1e-5, radius=radius)
        deepest = radius**2 / 1e-5
        assert shape.contact_radius(deepest * (1 - 1e-9)) == pytest.approx(radius * (1 - 5e-10), rel=1e-14)
        assert shape.deepest == pytest.approx(deepest, rel=0.1)
        with pytest.raises(ValueError, match="presses deeper than the shape is known"):
            mdr.impact(shape, mdr.Medium(E_STAR), MASS, 10.0)


def test_polygon_of_a_paraboloid():
    """Chords of a paraboloid: energy is kept, and results come as close as the polygon does."""
    r = np.linspace(0.0, 3e-6, 40)
    polygon, exact = mdr.Sampled(r, r**2 / 2e-5), mdr.Paraboloid(1e-5)
    dry = mdr.impact(exact, mdr.Medium(E_STAR, 10.0), MASS, 0.03)
    medium = mdr.Medium(E_STAR, 10.0, 0.3 * dry.contact_time * E_STAR / 4)
    hits = [mdr.impact(shape, medium, MASS, 0.03) for shape in (polygon, exact)]
    for quantity in ("max_depth", "restitution", "contact_time"):
        # The chords lie above the curve by 1/8 of the squared spacing over R: 10⁻³ of the height.
        assert getattr(hits[0], quantity) == pytest.approx(getattr(hits[1], quantity), rel=5e-3), quantity
    lost = (hits[0].plastic_work + hits[0].viscous_work) / (MASS * 0.03**2 / 2)
    assert hits[0].restitution ** 2 + lost == pytest.approx(1, rel=1e-9)


@pytest.mark.parametrize("q_c", [np.inf, 100.0])
@pytest.mark.parametrize("share", [0.1, 10.0])
@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0, 50.0])
def test_largest_force(exponent, share, q_c):
    """Of blunt bodies the force is largest soon after first touch, where it is a fractional power of time.

    Beside it v(d) from d(v²)/dd = −2F/m, stepped in ln d, and the largest F on the way.
    """
    shape, medium = mdr.PowerLaw(0.1 * 1e-6 ** (1 - exponent), exponent), mdr.Medium(E_STAR, q_c)
    dry = hit_to_depth(shape, medium, 1e-6)
    tau = share * float(dry.contact_time)
    d_c, reduced = float(medium.critical_depth), float(shape._reduced_coefficient)

    def radius(d):
        return (d / reduced) ** (1 / exponent)

    def load(s, v):
        d = np.exp(s)
        yielded = np.maximum(d - d_c, 0.0)
        area = (radius(d) * d - radius(yielded) * yielded) / (1 + 1 / exponent)
        return 2 * E_STAR * (area + tau * radius(d) * v)

    def turned(s, v):
        return v[0] - 1e-6 * dry.speed

    turned.terminal = True
    ends = np.log(1e-25), np.log(2e-6)
    course = solve_ivp(
        lambda s, v: -load(s, v) * np.exp(s) / (MASS * v),
        ends, [float(dry.speed)], "DOP853", rtol=1e-11, atol=0.0, dense_output=True, events=turned,
    )  # fmt: skip
    s = np.linspace(ends[0], course.t[-1], 20_001)
    best = np.clip(np.argmax(load(s, course.sol(s)[0])), 1, s.size - 2)
    # Where yield begins the force may have its top as a cusp.
    cusp = np.clip(np.log(d_c), s[best - 1], s[best + 1])
    finer = np.append(np.linspace(s[best - 1], s[best + 1], 201), cusp)
    largest = load(finer, course.sol(finer)[0]).max()
    hit = mdr.impact(shape, mdr.Medium(E_STAR, q_c, tau * E_STAR / 4), MASS, dry.speed)
    # The fine grid misses the top by its spacing squared, the dense output adds about 10⁻⁹.
    assert hit.max_force == pytest.approx(largest, rel=1e-8)


@pytest.mark.parametrize("tip", [2e-10, 3e-9, 1e-8, 5e-7])
def test_blunt_tip_far_below_the_depth(tip):
    """The kink where a blunt tip passes into its cone may be hidden by rounding when the body turns."""
    medium = mdr.Medium(E_star=1e6, eta=1e-5)
    blunted, sharp = (
        mdr.impact(shape, medium, 1e-6, 20.0) for shape in (mdr.RoundedCone(tip, 1.5e-4), mdr.Cone(1.5e-4))
    )
    # The tip lies this much above the cone's, and the depth changes by less; both end to 1e-9.
    height = tip * 1.5e-4 / sharp.max_depth
    assert blunted.max_depth == pytest.approx(sharp.max_depth, rel=height + 1e-9)
    assert blunted.contact_time == pytest.approx(sharp.contact_time, rel=height + 1e-9)
    assert blunted.restitution == pytest.approx(sharp.restitution, abs=height + 1e-9)
