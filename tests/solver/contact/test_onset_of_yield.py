"""Force and speed at which yield starts, against the states and impacts themselves."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name

MEDIUM = mdr.Medium(E_star=1e9, q_c=10.0)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_yield_force_is_that_at_the_critical_depth(shape):
    state = mdr.indent(shape, MEDIUM, MEDIUM.critical_depth)
    # Both are the same closed form or table, to rounding.
    assert mdr.yield_force(shape, MEDIUM) == approx(state.force, rel=1e-13)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_impacts_yield_above_the_yield_speed(shape):
    speed = mdr.yield_speed(shape, MEDIUM, 1e-9)
    slower, faster = (mdr.impact(shape, MEDIUM, 1e-9, share * speed) for share in (1 - 1e-9, 1 + 1e-9))
    assert slower.plastic_depth == 0.0
    assert faster.plastic_depth > 0.0
    assert slower.max_depth == approx(MEDIUM.critical_depth, rel=1e-8)


def test_johnsons_sphere():
    """m v_y²/2 = (8/15) E* √R d_c^(5/2), and F_c = (4/3) E* √R d_c^(3/2), of a paraboloid."""
    radius, mass, d_c = 1e-3, 1e-6, MEDIUM.critical_depth
    force = 4 / 3 * MEDIUM.E_star * radius**0.5 * d_c**1.5
    assert mdr.yield_force(mdr.Paraboloid(radius), MEDIUM) == approx(force, rel=1e-14)
    energy = 8 / 15 * MEDIUM.E_star * radius**0.5 * d_c**2.5
    speed = mdr.yield_speed(mdr.Paraboloid(radius), MEDIUM, mass)
    assert mass * speed**2 / 2 == approx(energy, rel=1e-14)


def test_a_flat_punch_yields_all_at_once():
    """π q_c b, the force of Eq. (11) of a contact that has yielded everywhere."""
    force = mdr.yield_force(mdr.FlatPunch(1e-6), MEDIUM)
    assert force == approx(np.pi * MEDIUM.q_c * 1e-6, rel=1e-14)


def test_arrays_broadcast_and_what_never_yields_is_infinite():
    medium = mdr.Medium(1e9, q_c=[10.0, np.inf])
    speed = mdr.yield_speed(mdr.Cone([[0.1], [0.2], [0.3]]), medium, 1e-9)
    assert speed.shape == (3, 2)
    assert speed[1, 0] == mdr.yield_speed(mdr.Cone(0.2), MEDIUM, 1e-9)
    assert np.all(np.isinf(speed[:, 1]))
    assert mdr.yield_force(mdr.Cone(0.2), mdr.Medium(1e9)) == np.inf


def test_a_profile_that_ends_before_the_critical_depth_is_refused():
    tip = mdr.Sampled([0.0, 1e-9], [0.0, 1e-10])
    with pytest.raises(ValueError, match="deeper than"):
        mdr.yield_force(tip, MEDIUM)


def test_medium_from_the_critical_depth():
    medium = mdr.Medium.from_critical_depth([1e9, 2e9], 3e-9, eta=1.0)
    np.testing.assert_allclose(medium.critical_depth, 3e-9, rtol=4e-16)
    assert medium.eta == 1.0
    with pytest.raises(ValueError, match=r"q_c.* and critical_depth .*; give one"):
        mdr.Medium.from_critical_depth(1e9, 3e-9, q_c=1.0)
    with pytest.raises(ValueError, match=r"critical depth = -1 m must be finite and positive"):
        mdr.Medium.from_critical_depth(1e9, -1.0)
