"""Viscous impact: its equation of motion solved by others, its limits, states that are hard for it."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mdr_core as mdr

from ...approx import approx
from ...events import until
from ...shapes import SHAPES, name
from ..foundation.small_steps import scalar_impact
from .test_contact_time import KINKED

E_STAR, MASS, SPEED = 1e9, 1e-9, 0.1
D_C = mdr.Medium(E_STAR, q_c=10.0).critical_depth


def medium(share, shape, q_c=math.inf):
    """A medium whose relaxation time is a share of the dry contact time."""
    dry = mdr.impact(shape, mdr.Medium(E_STAR, q_c=q_c), MASS, SPEED)
    return mdr.Medium(E_STAR, q_c=q_c, eta=share * dry.contact_time * E_STAR / 4)


def by_steps(phi, radius, tau, d_c):
    """Largest depth, restitution, contact time from scipy's DOP853, in SI units.

    `phi` is the elastic force curve, `radius` the contact radius.
    """

    def loading(plastic):
        def rate(_, state):
            d = max(state[0], 0.0)
            p = max(d - d_c, 0.0) if plastic else 0.0
            return state[1], -(phi(d) - phi(p) + 2 * E_STAR * tau * radius(d) * state[1]) / MASS

        return rate

    def turns(_, state):
        return state[1]

    def yields(_, state):
        return state[0] - d_c

    options = {"longest": 1.0, "rtol": 1e-12, "atol": 1e-22, "first_step": 1e-12}
    which, time, state = until(loading(False), (0.0, (0.0, SPEED)), (turns, yields), **options)
    if which:
        _, time, state = until(loading(True), (time, state), (turns,), **options)
    deepest = state[0]
    p = max(deepest - d_c, 0.0)

    def unloading(_, state):
        return state[1], -(phi(max(state[0] + tau * state[1], p)) - phi(p)) / MASS

    def leaves(_, state):
        return state[0] + tau * state[1] - p

    _, time, state = until(unloading, (time, (deepest, 0.0)), (leaves,), **options)
    return deepest, -state[1] / SPEED, time


CURVES = {
    "cone": (
        mdr.Cone(0.3),
        lambda d: 2 * E_STAR * d**2 / (math.pi * 0.3),
        lambda d: 2 * d / (math.pi * 0.3),
    ),
    "Hertz": (
        mdr.Paraboloid(1e-5),
        lambda d: 4 / 3 * E_STAR * math.sqrt(1e-5) * d**1.5,
        lambda d: math.sqrt(1e-5 * d),
    ),
    "flat": (mdr.FlatPunch(1e-6), lambda d: 2 * E_STAR * 1e-6 * d, lambda d: 1e-6),
}


@pytest.mark.few(8)
@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("share", [1e-4, 0.1, 1.0, 30.0])
@pytest.mark.parametrize("curve", CURVES)
def test_against_steps_in_time(curve, share, q_c):
    shape, phi, radius = CURVES[curve]
    material = medium(share, shape, q_c)
    hit = mdr.impact(shape, material, MASS, SPEED)
    expected = by_steps(phi, radius, material.relaxation_time, min(material.critical_depth, 1.0))
    # Steps with an error of 1e-12 each; of a time, after a long relaxation, 1e-10.
    assert (hit.max_depth, hit.restitution, hit.contact_time) == approx(expected, rel=3e-10)


@pytest.mark.parametrize("zeta", [1e-4, 0.5, 1.999, 2.001, 10.0, 1e4])
def test_flat_punch_is_a_damped_oscillator(zeta):
    """v̇ + d + ζ v = 0 until d + ζ v = 0: contact time, restitution and depth in closed form."""
    mp = pytest.importorskip("mpmath").mp
    with mp.workdps(60):
        z = mp.mpf(zeta)
        fast, slow = (-z - mp.sqrt(z * z - 4)) / 2, (-z + mp.sqrt(z * z - 4)) / 2

        def first(ratio):
            """First t > 0 at which exp((slow − fast) t) has the given value."""
            t = mp.log(ratio) / (slow - fast)
            return mp.re(t if mp.re(t) > 0 else t + 2j * mp.pi / (slow - fast))

        def way(t, order=0):
            grown = slow**order * mp.exp(slow * t) - fast**order * mp.exp(fast * t)
            return mp.re(grown / (slow - fast))

        turn, end = first(fast / slow), first((1 + z * fast) / (1 + z * slow))
        expected = [float(part) for part in (way(turn), -way(end, 1), end)]
    hit = mdr.impact(mdr.FlatPunch(1.0), mdr.Medium(0.5, eta=zeta / 8), 1.0, 1.0)
    # Exponentials over few steps; far overdamped, twenty times as many.
    assert (hit.max_depth, hit.restitution, hit.contact_time) == approx(expected, rel=1e-11)
    assert hit.viscous_work == approx((1 - expected[1] ** 2) / 2, rel=1e-9)


def test_force_of_a_flat_face_jumps_at_first_touch():
    """8 η b v₀, and that is the largest force where viscosity governs."""
    hit = mdr.impact(mdr.FlatPunch(1e-6), mdr.Medium(E_STAR, eta=1e4), MASS, SPEED)
    assert hit.motion(11).force[0] == approx(8 * 1e4 * 1e-6 * SPEED, rel=1e-13)
    # The largest value of a polynomial through the first step, which ends in this force.
    assert hit.max_force == approx(8 * 1e4 * 1e-6 * SPEED, rel=1e-12)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_elastic_limit(shape, q_c):
    """For τ → 0 the dry impact is approached in proportion to τ."""
    dry = mdr.impact(shape, mdr.Medium(E_STAR, q_c=q_c), MASS, SPEED)
    one, two = (mdr.impact(shape, medium(share, shape, q_c), MASS, SPEED) for share in (1e-6, 2e-6))
    assert one.contact_time == approx(dry.contact_time, rel=1e-4)
    first, second = (1 - hit.restitution / dry.restitution for hit in (one, two))
    # Relative corrections of order τ/T; flat faces jump in force, but not in energy.
    assert second / first == approx(2, rel=1e-4)


def test_overdamped_bodies_hardly_rebound():
    """For τ ≫ T the body stops at τ φ(d) = m v₀ and leaves with the speed d/τ."""
    tau = 1e3
    material = mdr.Medium(0.5, eta=tau * 0.5 / 4)
    hit = mdr.impact(mdr.FlatPunch(1.0), material, 1.0, 1.0)
    assert hit.max_depth == approx(1 / tau, rel=1e-4)
    assert hit.rebound_speed == approx(hit.max_depth / tau, rel=1e-4)


def test_viscosity_may_keep_a_body_from_reaching_the_end_of_its_shape():
    """Dry, the sphere would go in deeper than it is known; the same speed on a viscous medium is fine."""
    sphere, speed = mdr.Sphere(1e-6), 1e4
    with pytest.raises(ValueError, match="deeper than the equator"):
        mdr.impact(sphere, mdr.Medium(1e6), 1e-9, speed)
    assert mdr.impact(sphere, mdr.Medium(1e6, eta=1e5), 1e-9, speed).max_depth < sphere.known_depth


def hit_to_depth(shape, medium, depth, eta=0.0):
    """The impact that without viscosity reaches a depth."""
    state = mdr.indent(shape, medium, depth)
    speed = np.sqrt(2 * (state.stored_energy + state.plastic_work) / MASS)
    return mdr.impact(shape, mdr.Medium(medium.E_star, q_c=medium.q_c, eta=eta), MASS, speed)


@pytest.mark.parametrize("times", [1.0001])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_turning_just_beyond_the_critical_depth(shape, times):
    """A step of the motion may go beyond the critical depth and come back: yield still begins there.

    With a relaxation time of 10⁻⁶ contact times, largest depth and restitution are the dry ones to
    some 10⁻⁶.
    """
    medium = mdr.Medium(E_STAR, q_c=10.0)
    dry = hit_to_depth(shape, medium, times * medium.critical_depth)
    hit = mdr.impact(
        shape, mdr.Medium(E_STAR, q_c=10.0, eta=1e-6 * dry.contact_time * E_STAR / 4), MASS, dry.speed
    )
    assert hit.max_depth == approx(dry.max_depth, rel=2e-5)
    assert hit.restitution == approx(dry.restitution, rel=2e-5)
    assert hit.contact_time == approx(dry.contact_time, rel=2e-5)


def test_punch_that_turns_between_two_nodes():
    """The same for a face so wide that the force is nearly straight and steps are long."""
    shape = mdr.RoundedPunch(flat_radius=2.67297751733623e-08, edge_radius=0.00012336733608624023)
    medium = mdr.Medium(34957.174742896605, q_c=0.0008873308645671202)
    mass, speed = 6.347070116180173e-10, 0.00045921445279458405
    dry = mdr.impact(shape, medium, mass, speed)
    hit = mdr.impact(shape, mdr.Medium(medium.E_star, q_c=medium.q_c, eta=3.13e-06), mass, speed)
    # τ/T is 10⁻⁶.
    assert hit.max_depth == approx(dry.max_depth, rel=1e-5)
    assert hit.contact_time == approx(dry.contact_time, rel=1e-5)
    assert hit.motion(31).kinetic_energy[-1] == approx(hit.mass * hit.rebound_speed**2 / 2, rel=1e-8)


@pytest.mark.few(4)
@pytest.mark.parametrize("q_c", [np.inf, 100.0])
@pytest.mark.parametrize("share", [0.1, 10.0])
@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0, 50.0])
def test_largest_force(exponent, share, q_c):
    """Of blunt bodies the force is largest soon after first touch, where it is a fractional power of time.

    Beside it v(d) from d(v²)/dd = −2F/m, stepped in ln d, and the largest F on the way.
    """
    shape, medium = mdr.PowerLaw(0.1 * 1e-6 ** (1 - exponent), exponent), mdr.Medium(E_STAR, q_c=q_c)
    dry = hit_to_depth(shape, medium, 1e-6)
    tau = share * float(dry.contact_time)
    d_c, g = float(medium.critical_depth), float(shape.reduced(1e-6))

    def radius(d):
        return 1e-6 * (d / g) ** (1 / exponent)

    def load(s, v):
        d = np.exp(s)
        yielded = np.maximum(d - d_c, 0.0)
        area = (radius(d) * d - radius(yielded) * yielded) / (1 + 1 / exponent)
        return 2 * E_STAR * (area + tau * radius(d) * v)

    def turned(s, v):
        # The depth that is left is some 10⁻⁸ of the largest; steps that are not above rounding stop SciPy.
        return v[0] - 1e-4 * dry.speed

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
    hit = mdr.impact(shape, mdr.Medium(E_STAR, q_c=q_c, eta=tau * E_STAR / 4), MASS, dry.speed)
    # The fine grid misses the top by its spacing squared, the dense output adds about 10⁻⁹.
    assert hit.max_force == approx(largest, rel=1e-8)


@pytest.mark.parametrize("tip", [2e-10, 3e-9, 1e-8, 5e-7])
def test_blunt_tip_far_below_the_depth(tip):
    """The kink where a blunt tip passes into its cone may be hidden by rounding when the body turns."""
    medium = mdr.Medium(E_star=1e6, eta=1e-5)
    blunted, sharp = (
        mdr.impact(shape, medium, 1e-6, 20.0) for shape in (mdr.RoundedCone(tip, 1.5e-4), mdr.Cone(1.5e-4))
    )
    # The tip lies this much above the cone's, and the depth changes by less; both end to 1e-9.
    height = tip * 1.5e-4 / sharp.max_depth
    assert blunted.max_depth == approx(sharp.max_depth, rel=height + 1e-9)
    assert blunted.contact_time == approx(sharp.contact_time, rel=height + 1e-9)
    assert blunted.restitution == approx(sharp.restitution, abs=height + 1e-9)


def turning_at(shape, medium, depth):
    """The impact that turns round at a depth."""
    start = math.log(hit_to_depth(shape, medium, depth).speed)

    def miss(log):
        return math.log(mdr.impact(shape, medium, MASS, math.exp(log)).max_depth / depth)

    # Viscosity takes some of the energy, at most nearly all of it.
    log = brentq(miss, start, start + 1.0, xtol=1e-15)
    return mdr.impact(shape, medium, MASS, math.exp(log))


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_turning_a_hundred_thousandth_beyond_the_critical_depth(shape):
    material = mdr.Medium(E_STAR, q_c=10.0, eta=3.0)
    hit = turning_at(shape, material, D_C * (1 + 1e-5))
    assert 0 < hit.plastic_depth < 1.01e-5 * D_C
    found = hit.restitution, hit.max_depth, hit.contact_time
    # The reference has eleven digits in every step, and leaves few of them behind.
    assert found == approx(scalar_impact(shape, material, MASS, hit.speed), rel=2e-8)


@pytest.mark.few(2)
@pytest.mark.parametrize("q_c", [1e4, 10.0])
@pytest.mark.parametrize("shape", KINKED, ids=name)
def test_turning_exactly_on_a_kink(shape, q_c):
    """The depth at which steps end is the one at which the body turns round, yielding or not."""
    material = mdr.Medium(E_STAR, q_c=q_c, eta=3.0)
    hit = turning_at(shape, material, shape.kinks[0])
    assert hit.max_depth == approx(shape.kinks[0], rel=1e-13)
    found = hit.restitution, hit.max_depth, hit.contact_time
    assert found == approx(scalar_impact(shape, material, MASS, hit.speed), rel=2e-8)
    motion = hit.motion(51)
    ledger = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    # What is promised.
    np.testing.assert_allclose(ledger, MASS * hit.speed**2 / 2, rtol=1e-9)


def test_a_cylinder_that_has_yielded_up_to_its_wall():
    """The spring force no longer grows: μ v̇ = −(b d_c + τ b v), an exponential up to the turning point."""
    shape, b = mdr.ParabolicPunch(radius=3e-6, cylinder_radius=1.5e-8), 1.5e-8
    medium = mdr.Medium(1e9, q_c=10.0, eta=3.0)
    mass, speed, tau, d_c = 8e-12, 1.8, medium.relaxation_time, medium.critical_depth
    hit = mdr.impact(shape, medium, mass, speed)
    inertia = mass / (2 * medium.E_star)
    flat = d_c / tau
    depth = inertia / (tau * b) * (speed - flat * math.log1p(speed / flat))
    # Before full yield, over a depth of d_c, the force is smaller.
    assert hit.max_depth == approx(depth, rel=2 * d_c / depth)
    lost = hit.plastic_work + hit.viscous_work + mass * hit.rebound_speed**2 / 2
    assert lost == approx(mass * speed**2 / 2, rel=1e-9)


def test_an_imprint_that_ends_on_a_kink():
    """The force goes through the kink without a jump, even if both of its ends come there at once."""
    shape, medium = mdr.RoundedCone(1e-6, 0.1), mdr.Medium(1e9, q_c=10.0, eta=3.0)
    # The kink is at 1e-8 and some rounding.
    depth = 1e-8 * (1 + np.array([-1e-6, 0.0, 1e-6]))
    force = mdr.impact(shape, medium, 1e-9, 0.1, plastic_depth=depth).max_force
    # Straight over 10⁻⁶ but for the square of it.
    assert force[1] == approx((force[0] + force[2]) / 2, rel=1e-9)
