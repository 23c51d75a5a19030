"""The motion of one impact: its states at any time, from one solution of the equation of motion."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.impacts.motion import dense_motion

from ...shapes import SHAPES, name
from .test_equation_of_motion import MASS, SPEED, medium


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_times_and_depths_are_inverse(shape):
    path = dense_motion(mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED))
    for branch in (path.loading, path.unloading):
        time = np.linspace(branch.start.time, branch.end.time, 201)[1:-1]
        state = branch.at(time)
        np.testing.assert_allclose(state.time, time, rtol=1e-11)
        # Near the turning point a depth fixes the time to the root of its rounding only.
        np.testing.assert_allclose(branch.when(state.depth), time, rtol=1e-7)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_instants_within_rounding_of_the_ends_of_steps(shape):
    """The slope of the time by the share of a step may be zero there."""
    path = dense_motion(mdr.impact(shape, medium(0.3, shape, 10.0), MASS, SPEED))
    for branch in (path.loading, path.unloading):
        ends = branch.nodes(2)
        for shift in (-4e-16, -2e-16, 0.0, 2e-16, 4e-16):
            state = branch.at(ends.time * (1 + shift))
            np.testing.assert_allclose(state.velocity, ends.velocity, rtol=0, atol=1e-13 * SPEED)
