"""Impact on the chain: against scalar equations, energy balance, oscillators; repeated impacts."""

import math

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import POWER_LAWS, SHAPES, name
from .small_steps import SmallSteps, scalar_impact

DRY = mdr.Medium(E_star=1e9, q_c=1.0)
D_C = DRY.critical_depth
MASS = 1e-12


def speed_to_depth(shape, depth):
    """Speed (m/s) at which the body reaches a depth (m) of a dry medium."""
    state = mdr.indent(shape, DRY, depth)
    return math.sqrt(2 * (state.stored_energy + state.plastic_work) / MASS)


def viscous(speed, depth, times):
    """A medium with τ = times depth/speed."""
    return mdr.Medium(DRY.E_star, q_c=DRY.q_c, eta=times * depth / speed * DRY.E_star / 4)


@pytest.mark.few(2)
@pytest.mark.parametrize("times", [0.03, 1.0])
@pytest.mark.parametrize(
    "shape", [*POWER_LAWS, mdr.FlatPunch(1e-6), mdr.TruncatedCone(1e-6, 0.3)], ids=name
)
def test_against_the_scalar_equation(shape, times):
    """On a virgin medium contact does not return, and the body obeys a scalar equation."""
    speed = speed_to_depth(shape, 8 * D_C)
    medium = viscous(speed, 8 * D_C, times)
    restitution, max_depth, duration = scalar_impact(shape, medium, MASS, speed)
    hit = mdr.chain_impact(shape, medium, MASS, speed)
    # The default tolerance.
    assert hit.error <= 1e-6
    assert hit.restitution == approx(restitution, abs=1e-6)
    assert hit.max_depth == approx(max_depth, rel=1e-6)
    # Of second order in the last of some 200 steps, extrapolated.
    assert hit.contact_time == approx(duration, rel=2e-5)
    lost = hit.plastic_work + hit.viscous_work
    assert lost == approx(MASS * speed**2 / 2 * (1 - restitution**2), rel=1e-5)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_without_viscosity_it_is_the_dry_impact(shape):
    speed = speed_to_depth(shape, 6 * D_C)
    hit, dry = (impact(shape, DRY, MASS, speed) for impact in (mdr.chain_impact, mdr.impact))
    assert hit.restitution == approx(dry.restitution, abs=1e-6)
    for quantity in ("max_depth", "plastic_depth", "plastic_work", "contact_radius", "plastic_radius"):
        assert getattr(hit, quantity) == approx(getattr(dry, quantity), rel=2e-6), quantity
    # The largest force is a power of the depth, whose error is the tolerance.
    assert hit.max_force == approx(dry.max_force, rel=1e-5)
    assert hit.contact_time == approx(dry.contact_time, rel=3e-5)


@pytest.mark.parametrize("times", [0.01, 0.3, 10.0])
@pytest.mark.parametrize("depth", [0.9, 3.0, 100.0])
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.FlatPunch(1e-6)], ids=name)
def test_every_estimate_covers_its_error(shape, depth, times):
    """Elastic or mostly plastic, hardly damped or overdamped: no error exceeds its estimate."""
    speed = speed_to_depth(shape, depth * D_C)
    medium = viscous(speed, depth * D_C, times)
    exact = mdr.impact(shape, medium, MASS, speed)
    for tolerance in (1e-4, 1e-6):
        hit = mdr.chain_impact(shape, medium, MASS, speed, tolerance=tolerance)
        errors = hit.errors.restitution * hit.restitution, hit.errors.max_depth
        assert hit.error == approx(max(errors), rel=1e-15)
        assert hit.error <= tolerance
        assert hit.restitution == approx(exact.restitution, rel=hit.errors.restitution, abs=0)
        # The equation of motion itself is good to 1e-9.
        assert hit.max_depth == approx(exact.max_depth, rel=hit.errors.max_depth + 1e-9)
        assert hit.contact_time == approx(exact.contact_time, rel=hit.errors.contact_time)
        assert hit.max_force == approx(exact.max_force, rel=hit.errors.max_force)


@pytest.mark.few(2)
@pytest.mark.parametrize("times", [1e2, 1e3])
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.FlatPunch(1e-6)], ids=name)
def test_body_that_nearly_sticks(shape, times):
    """Relaxation times of up to a thousand contact times: both methods agree."""
    speed = speed_to_depth(shape, 0.5 * D_C)
    medium = viscous(speed, 0.5 * D_C, times)
    exact = mdr.impact(shape, medium, MASS, speed)
    hit = mdr.chain_impact(shape, medium, MASS, speed)
    # The tolerance is relative to the impact speed; nevertheless small e have four digits.
    assert hit.restitution == approx(exact.restitution, rel=1e-4)
    assert hit.max_depth == approx(exact.max_depth, rel=1e-6)
    assert hit.contact_time == approx(exact.contact_time, rel=hit.errors.contact_time)


def test_force_is_largest_where_a_flat_face_touches():
    """Far above critical damping the dashpots alone stop the body: F = 8ηb v₀ at once, then less."""
    punch, medium = mdr.FlatPunch(1e-6), mdr.Medium(1e9, eta=1.0)
    hit = mdr.chain_impact(punch, medium, 1e-15, 1.0, tolerance=1e-4)
    assert hit.max_force == approx(8 * 1.0 * 1e-6 * 1.0, rel=1e-8)


@pytest.mark.few(2)
@pytest.mark.parametrize("times", [0.0, 0.3])
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.FlatPunch(1e-6)], ids=name)
def test_motion_is_that_of_the_equation_of_motion(shape, times):
    """At every step radii, live depth and force of the virgin chain are those of the scalar equation."""
    speed = speed_to_depth(shape, 4 * D_C)
    medium = viscous(speed, 4 * D_C, times)
    chain = mdr.chain_impact(shape, medium, MASS, speed).motion()
    exact = mdr.impact(shape, medium, MASS, speed).motion(4001)
    assert type(chain) is type(exact) is mdr.Motion
    for quantity in ("depth", "velocity", "force", "live_depth", "plastic_depth", "plastic_radius"):
        if quantity == "plastic_radius" and isinstance(shape, mdr.FlatPunch):
            # All of the face yields at once: a jump, which no interpolation follows.
            continue
        values = getattr(exact, quantity)
        expected = np.interp(chain.time, exact.time, values)
        # At first contact the chain's force is zero, that of a flat face is not.
        actual = getattr(chain, quantity)[1:]
        # Some 100 steps of second order, not extrapolated, and 4000 straight pieces between.
        np.testing.assert_allclose(actual, expected[1:], rtol=0, atol=1e-3 * np.max(np.abs(values)))
    inside = (chain.time > 0) & (chain.live_depth > 0.02 * D_C)
    expected = np.interp(chain.time, exact.time, exact.contact_radius)[inside]
    # Within half an element, about 200 on either side.
    np.testing.assert_allclose(chain.contact_radius[inside], expected, rtol=0, atol=5e-3 * expected.max())


@pytest.mark.few(1)
@pytest.mark.parametrize("zeta", [0.05, 0.5, 0.95])
def test_flat_punch_without_yield_is_a_damped_oscillator(zeta):
    """e = exp(−ζθ/√(1 − ζ²)), cot θ = (ζ − 1/(2ζ))/√(1 − ζ²): until the force is zero."""
    hit = mdr.chain_impact(mdr.FlatPunch(0.5), mdr.Medium(1.0, eta=zeta / 2), 1.0, 3.0)
    root = math.sqrt(1 - zeta**2)
    angle = math.atan2(root, zeta - 1 / (2 * zeta))
    assert hit.restitution == approx(math.exp(-zeta * angle / root), abs=1e-6)
    assert hit.contact_time == approx(angle / root, rel=1e-4)


@pytest.mark.parametrize("times", [0.0, 1.0, 100.0])
@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.TruncatedCone(1e-6, 0.3)], ids=name)
def test_ledger_is_closed_at_every_instant(shape, times):
    speed = speed_to_depth(shape, 8 * D_C)
    motion = mdr.chain_impact(shape, viscous(speed, 8 * D_C, times), MASS, speed, tolerance=1e-4).motion()
    ledger = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    # Newton's method has an error of 1e-9 of the speed in every step.
    np.testing.assert_allclose(ledger, MASS * speed**2 / 2, rtol=1e-8)
    assert motion.depth[0] == motion.time[0] == 0.0
    assert motion.force[-1] == 0.0
    assert np.all(np.diff(motion.time) >= 0)
    assert np.all(np.diff(motion.velocity) <= 1e-9 * speed)


class TestSecondImpact:
    shape = mdr.Paraboloid(1e-5)
    speed = speed_to_depth(shape, 5 * D_C)

    def test_at_the_speed_of_rebound_a_dry_imprint_is_elastic(self):
        """The energy of the first rebound reaches exactly the same depth, and is recovered completely."""
        first = mdr.chain_impact(self.shape, DRY, MASS, self.speed)
        lifted = first.foundation.advance(-3 * D_C)
        second = mdr.chain_impact(self.shape, DRY, MASS, first.rebound_speed, start=lifted)
        # The tolerance of both impacts.
        assert second.restitution == approx(1.0, abs=2e-6)
        assert second.max_depth == approx(first.max_depth, rel=2e-6)
        assert second.plastic_work == approx(0.0, abs=2e-6 * first.plastic_work)
        # Contact begins at the bottom of the imprint.
        dry = mdr.impact(self.shape, DRY, MASS, first.rebound_speed, plastic_depth=first.plastic_depth)
        assert second.contact_time == approx(dry.contact_time, rel=second.errors.contact_time)
        assert second.max_force == approx(dry.max_force, rel=1e-5)

    @pytest.mark.slow
    @pytest.mark.few(1)
    @pytest.mark.parametrize("wait", [0.05, 1.0, 100.0])
    def test_against_small_steps(self, wait):
        """A second impact before the elements have relaxed, or long after."""
        medium = viscous(self.speed, 5 * D_C, 1.0)
        tau = medium.relaxation_time
        first = mdr.chain_impact(self.shape, medium, MASS, self.speed, tolerance=1e-5)
        lifted = first.foundation.advance(0.0, wait * tau)
        second = mdr.chain_impact(self.shape, medium, MASS, self.speed, start=lifted, tolerance=1e-5)
        assert second.error <= 1e-5

        edges = np.linspace(0, self.shape.contact_radius(1.2 * second.max_depth), 301)
        foundation = SmallSteps(medium, self.shape.reduced((edges[1:] + edges[:-1]) / 2))
        dt = first.contact_time / 6000
        depth, velocity, _ = foundation.fly(np.diff(edges), MASS, 0.0, self.speed, dt)
        assert -velocity / self.speed == approx(first.restitution, abs=1e-3)
        for k in range(1, 501):
            foundation.step(depth * (1 - k / 500), -depth / (wait * tau), wait * tau / 500)
        depth, velocity, _ = foundation.fly(np.diff(edges), MASS, 0.0, self.speed, dt)
        # First order in steps of 1/6000 of the contact.
        assert -velocity / self.speed == approx(second.restitution, abs=1e-3)

    def test_repeated_impacts_deepen_the_imprint(self):
        medium, start, depths = viscous(self.speed, 5 * D_C, 0.2), None, []
        for _ in range(3):
            hit = mdr.chain_impact(self.shape, medium, MASS, self.speed, start=start, n=200, tolerance=1e-4)
            assert hit.foundation.n == 200
            depths.append(hit.max_depth)
            start = hit.foundation.advance(-D_C, 1e3 * medium.relaxation_time)
        assert depths[0] < depths[1] < depths[2]


def test_units_do_not_matter():
    """Mass, modulus, yield constant and viscosity times a power of two, which is exact."""
    base = mdr.chain_impact(mdr.Cone(0.5), mdr.Medium(1.0, q_c=1.0, eta=1.0), 1.0, 1.0, tolerance=1e-4)
    scaled = mdr.chain_impact(
        mdr.Cone(0.5), mdr.Medium(2.0**40, q_c=2.0**40, eta=2.0**40), 2.0**40, 1.0, tolerance=1e-4
    )
    assert scaled.restitution == approx(base.restitution, rel=1e-9)
    assert scaled.max_depth == approx(base.max_depth, rel=1e-9)


def test_the_largest_force_behind_a_wall_is_that_of_the_plateau():
    """All of the face yields, F = π q_c b; a parabola over the beginning of the plateau had 8 % more."""
    tip, medium = mdr.ParabolicPunch(9e-6, cylinder_radius=1.4e-7), mdr.Medium(1e10, q_c=3.4)
    hit = mdr.chain_impact(tip, medium, 1.4e-11, 0.35, tolerance=1e-3)
    assert hit.max_force == approx(np.pi * 3.4 * 1.4e-7, rel=hit.errors.max_force)


@pytest.mark.full
@pytest.mark.slow
def test_a_coarse_run_on_a_soft_support_may_end_far_above_the_largest_depth():
    """Where the force of f_c jumps at the onset of yield, six steps of a support end 13 % above it."""
    tip, medium = mdr.Paraboloid(5e-7), mdr.Medium(6.7e9, f_c=1.7e-6)
    support = mdr.Structure(stiffness=3.1e4)
    hit = mdr.chain_impact(tip, medium, 1e-10, 0.32, structure=support, tolerance=1e-3)
    dry = mdr.impact(tip, medium, 1e-10, 0.32, structure=support)
    for quantity in hit.errors._fields:
        assert getattr(hit, quantity) == approx(getattr(dry, quantity), rel=getattr(hit.errors, quantity))


def test_bad_arguments_are_refused():
    cone = mdr.Cone(0.3)
    with pytest.raises(ValueError, match="mass = -1 kg must be"):
        mdr.chain_impact(cone, DRY, -1.0, 1.0)
    with pytest.raises(ValueError, match="speed = 0 m/s must be"):
        mdr.chain_impact(cone, DRY, 1.0, 0.0)
    with pytest.raises(ValueError, match="tolerance = 0 must be"):
        mdr.chain_impact(cone, DRY, 1.0, 1.0, tolerance=0.0)
    other = mdr.Foundation(mdr.Cone(0.4), DRY, 2, 1.0)
    with pytest.raises(TypeError, match="start must be a Foundation"):
        mdr.chain_impact(cone, DRY, 1.0, 1.0, start=0)
    for n in (0, 3, "20", True):
        with pytest.raises(ValueError, match=r"n (=|must be)"):
            mdr.chain_impact(cone, DRY, 1.0, 1.0, n=n)
    with pytest.raises(ValueError, match="start is a foundation under Cone"):
        mdr.chain_impact(cone, DRY, 1.0, 1.0, start=other)
