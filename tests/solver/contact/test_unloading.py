"""Unloading to the loss of contact or the pull-off, and loops of adhesion: paths, energies, and JKR."""

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from mdr_core.solver.contact.unloading import adhesive_loop, unloading, unloading_curve

from ...approx import approx
from ...shapes import SHAPES, name

E_STAR, W, R = 1e9, 0.05, 1e-6
YIELDING = mdr.Medium(E_STAR, q_c=10.0)


def turning_point(shape, medium):
    depth = 0.5e-6 if shape.known_depth > 0.5e-6 else 0.5 * shape.known_depth
    return mdr.indent(shape, medium, depth)


@pytest.mark.parametrize("q_c", [10.0, math.inf])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_unloading_is_the_path_back_and_gives_back_what_is_stored(shape, q_c):
    state = turning_point(shape, mdr.Medium(E_STAR, q_c=q_c))
    states = unloading(state, np.linspace(1, 0, 4001))
    path = mdr.indent(shape, state.medium, np.append(state.depth, states.depth))
    # The live depth of the path is a difference of depths.
    np.testing.assert_allclose(states.force, path.force[1:], rtol=1e-9, atol=1e-9 * state.force)
    assert (states.depth[0], states.depth[-1]) == (state.depth, state.plastic_depth)
    assert states.force[-1] == 0
    # Chords of 4000 steps; an exponent of 1/2 has the largest error.
    assert -trapezoid(states.force, states.depth) == approx(state.stored_energy, rel=1e-5)


@pytest.mark.parametrize("q_c", [2.0, math.inf])
def test_unloading_with_adhesion_ends_where_the_path_loses_contact(q_c):
    state = mdr.indent(mdr.Paraboloid(R), mdr.Medium(E_STAR, q_c=q_c, work_of_adhesion=W), 1e-7)
    back = unloading(state, np.linspace(1, 0, 30))
    path = mdr.indent(state.profile, state.medium, np.append(state.depth, back.depth))
    # At the last depth contact is lost within rounding.
    np.testing.assert_allclose(back.force[:-1], path.force[1:-1], rtol=1e-6, atol=1e-9 * state.force)
    gone = mdr.indent(state.profile, state.medium, [state.depth, back.depth[-1] - 1e-13])
    assert gone.force[-1] == 0
    assert back.force[-1] < 0


@pytest.mark.parametrize(("q_c", "w"), [(2.0, 0.0), (2.0, W), (math.inf, W)])
def test_a_lifted_indenter_has_no_contact_and_leaves_the_imprint(q_c, w):
    state = mdr.indent(mdr.Paraboloid(R), mdr.Medium(E_STAR, q_c=q_c, work_of_adhesion=w), 1e-7)
    lost, lifted, up = unloading(state, np.array([0.0, -0.5, -1.0]))
    # Without an imprint the pull-off is above the undeformed surface.
    assert (lost.depth < 0) == (q_c == math.inf)
    assert up.depth == (2 * lost.depth if lost.depth < 0 else 0.0)
    assert lifted.depth == approx((lost.depth + up.depth) / 2, rel=1e-12)
    for each in (lifted, up):
        assert (each.force, each.contact_radius, each.pressure(0.0)) == (0, 0, 0)
        assert each.plastic_depth == state.plastic_depth


def test_under_a_force_the_end_is_the_pull_off_force():
    state = mdr.indent(mdr.Paraboloid(R), mdr.Medium(E_STAR, work_of_adhesion=W), 1e-7)
    _, force = unloading_curve(state, under_force=True)
    assert force[-1] == approx(-1.5 * np.pi * W * R, rel=1e-9)
    # At a given depth the contact is held further, under less tension.
    assert unloading_curve(state)[1][-1] == approx(-5 / 6 * np.pi * W * R, rel=1e-9)


def test_elements_held_back_by_dashpots_are_unloaded_from_the_depth_of_the_state():
    """The area below, over the stored energy of the elements in contact: each is ahead by d − D."""
    hit = mdr.impact(mdr.Paraboloid(R), mdr.Medium(E_STAR, eta=10.0), 1e-12, 0.1)
    state = hit.motion(101).states[80]
    depth, force = unloading_curve(state)
    assert depth[0] == state.depth > state.live_interval.upper
    # Chords of 24 steps.
    assert -trapezoid(force, depth) == approx(state.stored_energy, rel=3e-3)


@pytest.mark.parametrize("depth", [1e-9, 1e-8, 1e-7])
def test_an_elastic_loop_loses_what_jump_and_pull_off_take(depth):
    """JKR: springs at x are compressed by d − x²/R, d = a²/R − √(2πaw/E*); d = 0, and dd/da = 0."""
    stretch = np.sqrt(2 * np.pi * W / E_STAR)
    a = (stretch * R * np.array([1, 1 / 4])) ** (2 / 3)
    d = a**2 / R - stretch * np.sqrt(a)
    stored = E_STAR * (d**2 * a - 2 * d * a**3 / (3 * R) + a**5 / (5 * R**2))
    first, last = stored - np.pi * W * a**2
    medium = mdr.Medium(E_STAR, work_of_adhesion=W)
    loop = adhesive_loop(mdr.indent(mdr.Paraboloid(R), medium, np.linspace(0, depth, 50)))
    # Chords of some 10⁻⁴.
    assert loop.lost == approx(last - first, rel=1e-3)
    assert loop.gained == 0


def test_a_yielding_loop_has_the_area_of_its_path():
    """The work of the path itself, pressed and pulled off in many steps, from first contact on."""
    medium, cone = mdr.Medium(E_STAR, q_c=2.0, work_of_adhesion=0.005), mdr.Cone(0.3)
    down = np.linspace(0, 1e-7, 2000)
    loop = adhesive_loop(mdr.indent(cone, medium, down))
    path = mdr.indent(cone, medium, np.append(down, np.linspace(1e-7, -1e-7, 20_000)))
    # Before first contact there is no force, so that the jump is no work.
    assert loop.lost - loop.gained == approx(trapezoid(path.force, path.depth), rel=2e-3)
