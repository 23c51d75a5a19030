"""Viscous impact: the scalar equation of motion solved by others, its limits, the energy ledger."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mdr_core as mdr

from .shapes import SHAPES, name

E_STAR, MASS, SPEED = 1e9, 1e-9, 0.1
ENERGY = MASS * SPEED**2 / 2
D_C = mdr.Medium(E_STAR, 10.0).critical_depth


def medium(share, shape, q_c=math.inf):
    """A medium whose relaxation time is a share of the dry contact time."""
    dry = mdr.impact(shape, mdr.Medium(E_STAR, q_c), MASS, SPEED)
    return mdr.Medium(E_STAR, q_c, eta=share * dry.contact_time * E_STAR / 4)


def by_steps(phi, radius, tau, d_c):
    """Largest depth, restitution, contact time from scipy's DOP853, in SI units.

    `phi` is the elastic force curve, `radius` the contact radius.
    """
    options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-22}

    def event(function, direction=-1):
        function.terminal, function.direction = True, direction
        return function

    def loading(plastic):
        def rate(_, state):
            d = max(state[0], 0.0)
            p = max(d - d_c, 0.0) if plastic else 0.0
            return state[1], -(phi(d) - phi(p) + 2 * E_STAR * tau * radius(d) * state[1]) / MASS

        return rate

    turn = event(lambda t, state: state[1])
    yields = event(lambda t, state: state[0] - d_c, 1)
    first = solve_ivp(
        loading(False), (0, 1), (0, SPEED), events=(turn, yields), first_step=1e-12, **options
    )
    time, state = first.t[-1], first.y[:, -1]
    if first.t_events[1].size:
        second = solve_ivp(loading(True), (time, 1), state, events=turn, **options)
        time, state = second.t[-1], second.y[:, -1]
    deepest = state[0]
    p = max(deepest - d_c, 0.0)

    def unloading(_, state):
        return state[1], -(phi(max(state[0] + tau * state[1], p)) - phi(p)) / MASS

    free = event(lambda t, state: state[0] + tau * state[1] - p)
    last = solve_ivp(unloading, (time, 1), (deepest, 0.0), events=free, **options)
    return deepest, -last.y[1, -1] / SPEED, last.t[-1]


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


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("share", [1e-4, 0.1, 1.0, 30.0])
@pytest.mark.parametrize("curve", CURVES)
def test_against_steps_in_time(curve, share, q_c):
    shape, phi, radius = CURVES[curve]
    material = medium(share, shape, q_c)
    hit = mdr.impact(shape, material, MASS, SPEED)
    expected = by_steps(phi, radius, material.relaxation_time, min(material.critical_depth, 1.0))
    # The steps follow the square roots where contact begins and ends to some 1e-9.
    assert (hit.max_depth, hit.restitution, hit.contact_time) == pytest.approx(expected, rel=2e-8)


@pytest.mark.parametrize("zeta", [1e-12, 1e-3, 0.5, 1.999, 2.001, 10.0, 1e4, 1e8, 1e12])
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
    assert (hit.max_depth, hit.restitution, hit.contact_time) == pytest.approx(expected, rel=1e-11)
    assert hit.viscous_work == pytest.approx((1 - expected[1] ** 2) / 2, rel=1e-9)


def test_force_of_a_flat_face_jumps_at_first_touch():
    """8 η b v₀, and that is the largest force where viscosity governs."""
    hit = mdr.impact(mdr.FlatPunch(1e-6), mdr.Medium(E_STAR, eta=1e4), MASS, SPEED)
    assert hit.motion(11).force[0] == pytest.approx(8 * 1e4 * 1e-6 * SPEED, rel=1e-13)
    assert hit.max_force == pytest.approx(8 * 1e4 * 1e-6 * SPEED, rel=1e-13)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("share", [0.0, 1e-8, 1.0, 1e8])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_energy_ledger_is_closed_at_every_instant(shape, share, q_c):
    motion = mdr.impact(shape, medium(share, shape, q_c), MASS, SPEED).motion(101)
    parts = (motion.kinetic_energy, motion.stored_energy, motion.plastic_work, motion.viscous_work)
    # Between the nodes of a step, the interpolant's accuracy.
    np.testing.assert_allclose(sum(parts), ENERGY, rtol=3e-9)
    assert np.all(np.array(parts) >= -1e-9 * ENERGY)
    assert np.all(np.diff(motion.plastic_work) >= 0)
    assert np.all(np.diff(motion.viscous_work) >= -1e-9 * ENERGY)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_motion_ends_in_the_impact(shape, q_c):
    hit = mdr.impact(shape, medium(0.3, shape, q_c), MASS, SPEED)
    motion = hit.motion(4001)
    assert motion.time[-1] == pytest.approx(hit.contact_time, rel=1e-12)
    assert -motion.velocity[-1] == pytest.approx(hit.rebound_speed, rel=1e-9)
    # Between two instants near a maximum, the square of half an interval.
    assert motion.depth.max() == pytest.approx(hit.max_depth, rel=1e-6)
    assert motion.force.max() <= hit.max_force * (1 + 1e-9)
    assert motion.plastic_depth[-1] == pytest.approx(hit.plastic_depth, rel=1e-12)
    lost = hit.plastic_work + hit.viscous_work
    assert hit.restitution**2 == pytest.approx(1 - lost / ENERGY, rel=1e-8)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_motion_obeys_newton(shape):
    """m v̇ = −F and ḋ = v, by central differences."""
    motion = mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED).motion(20001)
    step = motion.time[1]
    inner = slice(20, -20)
    acceleration = np.gradient(motion.velocity, step)[inner]
    scale = motion.force.max()
    # The difference is of second order, but of first where the force has a kink.
    wrong = np.abs(MASS * acceleration + motion.force[inner]) / scale
    assert np.quantile(wrong, 0.99) < 1e-5
    assert wrong.max() < 1e-2
    np.testing.assert_allclose(
        np.gradient(motion.depth, step)[inner], motion.velocity[inner], atol=1e-6 * SPEED
    )


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_without_viscosity_the_motion_is_that_of_the_energy_balance(shape):
    """Two ways to the same numbers: quadrature of dd/v, and the equation of motion."""
    hit = mdr.impact(shape, mdr.Medium(E_STAR, 10.0), MASS, SPEED)
    motion = hit.motion(2)
    assert motion.time[-1] == pytest.approx(hit.contact_time, rel=1e-9)
    assert -motion.velocity[-1] == pytest.approx(hit.rebound_speed, rel=1e-9)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_elastic_limit(shape, q_c):
    """For τ → 0 the dry impact is approached in proportion to τ."""
    dry = mdr.impact(shape, mdr.Medium(E_STAR, q_c), MASS, SPEED)
    one, two = (mdr.impact(shape, medium(share, shape, q_c), MASS, SPEED) for share in (1e-6, 2e-6))
    assert one.contact_time == pytest.approx(dry.contact_time, rel=1e-4)
    first, second = (1 - hit.restitution / dry.restitution for hit in (one, two))
    # Relative corrections of order τ/T; flat faces jump in force, but not in energy.
    assert second / first == pytest.approx(2, rel=1e-4)


def test_overdamped_bodies_hardly_rebound():
    """For τ ≫ T the body stops at τ φ(d) = m v₀ and leaves with the speed d/τ."""
    tau = 1e3
    material = mdr.Medium(0.5, eta=tau * 0.5 / 4)
    hit = mdr.impact(mdr.FlatPunch(1.0), material, 1.0, 1.0)
    assert hit.max_depth == pytest.approx(1 / tau, rel=1e-4)
    assert hit.rebound_speed == pytest.approx(hit.max_depth / tau, rel=1e-4)


def test_a_second_viscous_impact_loses_less_to_yield():
    material = mdr.Medium(E_STAR, 10.0, eta=10.0)
    first = mdr.impact(mdr.Cone(0.3), material, MASS, SPEED)
    second = mdr.impact(mdr.Cone(0.3), material, MASS, SPEED, plastic_depth=first.plastic_depth)
    assert second.plastic_work < first.plastic_work
    assert second.plastic_depth > first.plastic_depth
    motion = second.motion(51)
    assert motion.depth[0] == pytest.approx(first.plastic_depth, rel=1e-15)
    # The bottom of the imprint is met at once: 8 η c v₀.
    c = first.plastic_radius
    assert motion.force[0] == pytest.approx(8 * 10.0 * c * SPEED, rel=1e-12)
    total = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    np.testing.assert_allclose(total, ENERGY, rtol=1e-9)


def test_motion_is_that_of_one_impact():
    hits = mdr.impact(mdr.Cone(0.3), mdr.Medium(E_STAR, 10.0, eta=1.0), MASS, [0.1, 0.2])
    with pytest.raises(ValueError, match="motion is that of one impact, but these are 2; pick one"):
        hits.motion()
    assert hits[1].motion(3).velocity[0] == 0.2


@pytest.mark.parametrize("n", [1, 0, 2.5, True, "3", 10**9])
def test_bad_number_of_instants_is_refused(n):
    hit = mdr.impact(mdr.Cone(0.3), mdr.Medium(E_STAR), MASS, SPEED)
    with pytest.raises(ValueError, match="number of instants n"):
        hit.motion(n)


def test_viscosity_may_keep_a_body_from_reaching_the_end_of_its_shape():
    """Dry, the sphere would go in deeper than it is known; the same speed on a viscous medium is fine."""
    sphere, speed = mdr.Sphere(1e-6), 1e4
    with pytest.raises(ValueError, match="deeper than the shape is known"):
        mdr.impact(sphere, mdr.Medium(1e6), 1e-9, speed)
    assert mdr.impact(sphere, mdr.Medium(1e6, eta=1e5), 1e-9, speed).max_depth < sphere.deepest
