"""The motion of one impact: its states at any time, from one solution of the equation of motion."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.impacts import dense_motion

from ..approx import approx
from ..shapes import SHAPES, name
from .test_equation_of_motion import E_STAR, MASS, SPEED, medium


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_times_and_depths_are_inverse(shape):
    path = dense_motion.dense_motion(mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED))
    for branch in (path.loading, path.unloading):
        time = np.linspace(branch.start.time, branch.end.time, 201)[1:-1]
        state = branch.at(time)
        np.testing.assert_allclose(state.time, time, rtol=1e-11)
        # Near the turning point a depth fixes the time to the root of its rounding only.
        np.testing.assert_allclose(branch.when(state.depth), time, rtol=1e-7)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_rates_are_those_of_the_equation_of_motion(shape):
    """The derivative of the depth is the velocity, to the square of the difference's step."""
    hit = mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED)
    path = dense_motion.dense_motion(hit)
    time = np.linspace(0.0, path.end_time, 50)[1:-1]
    step = 1e-5 * path.end_time
    early, late = path.at(time - step), path.at(time + step)
    rate = (late.depth - early.depth) / (2 * step)
    np.testing.assert_allclose(rate, path.at(time).velocity, atol=1e-4 * SPEED)


def test_ends_are_exact():
    hit = mdr.impact(mdr.RoundedCone(1e-6, 0.3), mdr.Medium(E_STAR, 10.0, 20.0), MASS, SPEED)
    path = dense_motion.dense_motion(hit)
    start, turn, end = (path.at(np.array([t])) for t in (0.0, path.turning_time, path.end_time))
    assert (start.depth[0], start.velocity[0]) == (0.0, SPEED)
    assert turn.velocity[0] == 0.0
    assert turn.depth[0] == approx(hit.max_depth, rel=1e-15)
    assert end.interval.length[0] == 0.0
    assert path.end_time == approx(hit.contact_time, rel=1e-9)


def test_an_oblique_impact_and_its_motion_solve_the_normal_motion_once(monkeypatch):
    calls = []
    solve = dense_motion.solve
    monkeypatch.setattr(dense_motion, "solve", lambda *arguments: calls.append(1) or solve(*arguments))
    hit = mdr.oblique_impact(
        mdr.Cone(0.3), mdr.Medium(E_STAR, 10.0, 20.0), MASS, SPEED, 0.06, 0.3, tolerance=1e-2
    )
    hit.motion(20)
    hit.normal.motion(20)
    assert len(calls) == 1


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_instants_within_rounding_of_the_ends_of_steps(shape):
    """The slope of the time by the share of a step may be zero there."""
    path = dense_motion.dense_motion(mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED))
    for branch in (path.loading, path.unloading):
        ends = branch.nodes(2)
        for shift in (-4e-16, -2e-16, 0.0, 2e-16, 4e-16):
            state = branch.at(ends.time * (1 + shift))
            np.testing.assert_allclose(state.velocity, ends.velocity, rtol=0, atol=1e-13 * SPEED)
