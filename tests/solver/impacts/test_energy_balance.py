"""Dry impact by its energy: how deep it comes, what it gives back, and what a second one finds."""

import math

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0)
D_C = MEDIUM.critical_depth


def hit_to_depth(shape, medium, depth):
    """The impact of 1 kg that reaches the given depth."""
    state = mdr.indent(shape, medium, depth)
    return mdr.impact(shape, medium, 1.0, np.sqrt(2 * (state.stored_energy + state.plastic_work)))


@pytest.mark.parametrize("times", [0.7, 1 - 1e-9, 1 + 1e-9, 1 + 1e-5, 3.0, 1e3, 4e5])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_largest_depth_from_energy_balance(shape, times):
    depth = min(times * D_C, 100e-5 if isinstance(shape, mdr.Sphere) else math.inf)
    hit = hit_to_depth(shape, MEDIUM, depth)
    # Work grows at least in proportion to depth: the roundings of the energy, no more.
    assert hit.max_depth == approx(depth, rel=1e-14)
    assert hit.stored_energy + hit.plastic_work == approx(hit.speed**2 / 2, rel=1e-13)
    assert hit.rebound_speed**2 / 2 == approx(hit.stored_energy, rel=1e-13)


@pytest.mark.parametrize("t", [2, 5, 10])
def test_restitution_at_given_depth(t):
    """Stored and plastic work of the springs in units of E*, d_c and the shape's length, t = d_max/d_c."""
    c, a = np.sqrt([t - 1, t])
    ring = t**2 * (a - c) - 2 / 3 * t * (a**3 - c**3) + (a**5 - c**5) / 5
    for shape, stored, plastic in (
        (mdr.Cone(0.3), t - 2 / 3, (t - 1) ** 2),
        (mdr.Paraboloid(1e-3), c + ring, 4 / 3 * c**3),
    ):
        e = np.sqrt(stored / (stored + plastic))
        assert hit_to_depth(shape, MEDIUM, t * D_C).restitution == approx(e, rel=1e-12)


def test_slow_impact_damages_nothing():
    hit = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-6, 1e-9)
    assert hit.restitution == 1.0
    assert hit.plastic_work == hit.damaged_area == hit.plastic_depth == hit.viscous_work == 0.0


class TestRepeatedImpacts:
    """The plastic depth carries over from one impact to the next on the same spot."""

    @pytest.mark.parametrize("shape", SHAPES, ids=name)
    def test_tend_to_elastic(self, shape):
        """Every impact widens the contact that the next one finds, until all of it is elastic."""
        medium, depth, restitution = mdr.Medium(1e9, q_c=10.0), 0.0, []
        state = mdr.indent(shape, medium, 2 * medium.critical_depth)
        speed = np.sqrt(2 * (state.stored_energy + state.plastic_work) / 1e-9)
        for _ in range(60):
            hit = mdr.impact(shape, medium, 1e-9, speed, plastic_depth=depth)
            restitution.append(hit.restitution)
            assert hit.plastic_depth >= depth
            depth = hit.plastic_depth
        assert np.all(np.diff(restitution) >= -1e-15)
        # The face of a punch does not grow, and one that is flat in the middle grows slowly.
        share = 1.0 if shape.contact_radius(0.0) > 0 else 0.25
        assert 1 - restitution[-1] <= share * (1 - restitution[0])

    @pytest.mark.parametrize("shape", SHAPES, ids=name)
    def test_energy_and_state(self, shape):
        """The second impact ends where pressing the first's imprint to its depth ends."""
        medium = mdr.Medium(1e9, q_c=10.0)
        first = mdr.impact(shape, medium, 1e-9, 0.05)
        second = mdr.impact(shape, medium, 1e-9, 0.1, plastic_depth=first.plastic_depth)
        path = mdr.indent(shape, medium, [first.max_depth, 0.0, second.max_depth])
        assert second.max_force == approx(path.force[-1], rel=1e-11)
        assert second.plastic_depth == approx(path.plastic_depth[-1], rel=1e-12)
        assert second.plastic_work == approx(path.plastic_work[-1] - path.plastic_work[0], rel=1e-9)
        work = second.stored_energy + second.plastic_work
        assert work == approx(1e-9 * 0.1**2 / 2, rel=1e-12)
        # The same from the equation of motion.
        assert second.motion(2).time[-1] == approx(second.contact_time, rel=1e-9)

    def test_a_softer_impact_is_elastic(self):
        medium, cone = mdr.Medium(1e9, q_c=10.0), mdr.Cone(0.3)
        first = mdr.impact(cone, medium, 1e-9, 0.1)
        second = mdr.impact(
            cone, medium, 1e-9, first.rebound_speed * 0.999, plastic_depth=first.plastic_depth
        )
        assert second.restitution == 1.0
        assert second.plastic_work == 0.0
        assert second.plastic_depth == first.plastic_depth
