"""The motion of one impact: its ledger at every instant, Newton's law, its turning point and its end."""

import math

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.impacts.motion import released_compression

from ...approx import approx
from ...shapes import SHAPES, name
from .test_equation_of_motion import E_STAR, MASS, SPEED, medium

ENERGY = MASS * SPEED**2 / 2


@pytest.mark.parametrize(("share", "q_c"), [(1e-4, 10.0), (1.0, math.inf), (1e4, 10.0)])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_energy_ledger_is_closed_at_every_instant(shape, share, q_c):
    motion = mdr.impact(shape, medium(share, shape, q_c), MASS, SPEED).motion(101)
    parts = (motion.kinetic_energy, motion.stored_energy, motion.plastic_work, motion.viscous_work)
    # What is promised: between the nodes of a step its polynomial is as exact as that.
    np.testing.assert_allclose(sum(parts), ENERGY, rtol=1e-9)
    assert np.all(np.array(parts) >= -1e-9 * ENERGY)
    assert np.all(np.diff(motion.plastic_work) >= 0)
    assert np.all(np.diff(motion.viscous_work) >= -1e-9 * ENERGY)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_motion_ends_in_the_impact(shape, q_c):
    hit = mdr.impact(shape, medium(0.3, shape, q_c), MASS, SPEED)
    motion = hit.motion(4001)
    assert motion.time[-1] == approx(hit.contact_time, rel=1e-12)
    assert -motion.velocity[-1] == approx(hit.rebound_speed, rel=1e-9)
    # Between two instants near a maximum, the square of half an interval.
    assert motion.depth.max() == approx(hit.max_depth, rel=1e-6)
    assert motion.force.max() <= hit.max_force * (1 + 1e-9)
    assert motion.plastic_depth[-1] == approx(hit.plastic_depth, rel=1e-12)
    lost = hit.plastic_work + hit.viscous_work
    assert hit.restitution**2 == approx(1 - lost / ENERGY, rel=1e-8)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_motion_obeys_newton(shape):
    """m v̇ = −F and ḋ = v, by central differences."""
    motion = mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED).motion(20001)
    inner = slice(20, -20)
    acceleration = np.gradient(motion.velocity, motion.time)[inner]
    scale = motion.force.max()
    # The difference is of second order, but of first where the force has a kink.
    wrong = np.abs(MASS * acceleration + motion.force[inner]) / scale
    assert np.quantile(wrong, 0.99) < 1e-5
    assert wrong.max() < 1e-2
    np.testing.assert_allclose(
        np.gradient(motion.depth, motion.time)[inner], motion.velocity[inner], atol=1e-6 * SPEED
    )


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_without_viscosity_the_motion_is_that_of_the_energy_balance(shape):
    """Two ways to the same numbers: quadrature of dd/v, and the equation of motion."""
    hit = mdr.impact(shape, mdr.Medium(E_STAR, q_c=10.0), MASS, SPEED)
    motion = hit.motion(2)
    assert motion.time[-1] == approx(hit.contact_time, rel=1e-9)
    assert -motion.velocity[-1] == approx(hit.rebound_speed, rel=1e-9)


def test_a_second_viscous_impact_loses_less_to_yield():
    material = mdr.Medium(E_STAR, q_c=10.0, eta=10.0)
    first = mdr.impact(mdr.Cone(0.3), material, MASS, SPEED)
    second = mdr.impact(mdr.Cone(0.3), material, MASS, SPEED, plastic_depth=first.plastic_depth)
    assert second.plastic_work < first.plastic_work
    assert second.plastic_depth > first.plastic_depth
    motion = second.motion(51)
    assert motion.depth[0] == approx(first.plastic_depth, rel=1e-15)
    # The bottom of the imprint is met at once: 8 η c v₀.
    c = first.plastic_radius
    assert motion.force[0] == approx(8 * 10.0 * c * SPEED, rel=1e-12)
    total = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    np.testing.assert_allclose(total, ENERGY, rtol=1e-9)


def test_motion_is_that_of_one_impact():
    hits = mdr.impact(mdr.Cone(0.3), mdr.Medium(E_STAR, q_c=10.0, eta=1.0), MASS, [0.1, 0.2])
    with pytest.raises(
        ValueError, match="motion needs a single impact, but this result has shape \\(2,\\)"
    ):
        hits.motion()
    assert hits[1].motion(3).velocity[0] == 0.2


@pytest.mark.parametrize("n", [1, 0, 2.5, True, "3", 10**9])
def test_bad_number_of_instants_is_refused(n):
    hit = mdr.impact(mdr.Cone(0.3), mdr.Medium(E_STAR), MASS, SPEED)
    with pytest.raises(ValueError, match="number of instants n"):
        hit.motion(n)


@pytest.mark.parametrize(("n", "eta"), [(3, 20.0), (12, 0.0), (101, 0.1)])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_the_turning_point_is_among_the_instants(shape, eta, n):
    hit = mdr.impact(shape, mdr.Medium(E_STAR, q_c=10.0, eta=eta), MASS, SPEED)
    motion = hit.motion(n)
    turn = motion.turning_index
    assert motion.velocity[turn] == 0.0
    # The same number, read off.
    assert motion.depth[turn] == approx(hit.max_depth, rel=1e-15)
    assert motion.kinetic_energy[turn] == 0.0
    assert motion.stored_energy[turn] == approx(hit.stored_energy, rel=1e-12)
    assert np.all(motion.velocity[:turn] > 0)
    assert np.all(motion.velocity[turn + 1 :] < 0)
    assert (motion.time.size, motion.velocity[0]) == (n, SPEED)


@pytest.mark.slow
def test_a_flat_punch_is_a_damped_oscillator():
    """m v̇ = −k (d + τ v) with the stiffness k = 2E*a, until d + τ v = 0, where ωt = π − 2 arcsin ζ.

    There are many damping ratios ζ, because a wrong last velocity depends on how its instant is rounded.
    """
    punch = mdr.FlatPunch(radius=1e-6)
    natural = math.sqrt(2 * E_STAR * punch.radius / MASS)
    for damping in np.linspace(0.02, 0.9, 20):
        material = mdr.Medium(E_STAR, eta=damping * E_STAR / (2 * natural))
        motion = mdr.impact(punch, material, MASS, SPEED).motion(9)
        damped = math.sqrt(1 - damping**2)
        phase = natural * damped * motion.time
        swing = np.cos(phase) - damping / damped * np.sin(phase)
        velocity = SPEED * np.exp(-damping * natural * motion.time) * swing
        # About ten steps, of each of which the polynomial may miss the velocity by 1e-10.
        np.testing.assert_allclose(motion.velocity, velocity, rtol=0, atol=1e-9 * SPEED)
        assert phase[-1] == approx(math.pi - 2 * math.asin(damping), rel=1e-9)


@pytest.mark.parametrize("q_c", [math.inf, 10.0])
def test_released_elements_relax_as_those_of_a_chain_on_the_same_path(q_c):
    shape = mdr.Paraboloid(radius=1e-5)
    motion = mdr.impact(shape, medium(1.0, shape, q_c), MASS, SPEED).motion(401)
    chain = mdr.indent_in_time(shape, motion.states.medium, motion.depth, motion.time, tolerance=1e-4)
    i = 300
    assert i > motion.turning_index
    x = np.linspace(1.02 * motion.contact_radius[i], 0.98 * motion.contact_radius.max(), 40)
    left = released_compression(motion.states, motion.time, i, shape.reduced(x))
    _, compression = chain.elements(x)
    assert left.max() > 1e-3 * motion.depth.max()
    # The compression at release is that of the next of 400 instants.
    np.testing.assert_allclose(left, compression[i], atol=0.02 * left.max())
    # Elements in contact are not released, and on loading none is.
    inside = shape.reduced(0.9 * motion.contact_radius[[i]])
    assert released_compression(motion.states, motion.time, i, inside) == 0
    assert not released_compression(motion.states, motion.time, 5, shape.reduced(x)).any()
