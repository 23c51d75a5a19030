"""Where a curve turns back, in the presence of noise."""

import numpy as np
import pytest

from mdr_core.measurements.fit.depth_noise import turning_points


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_turning_points_are_those_of_new_largest_values_and_begin_where_the_path_rose(noise):
    """Rises to 1 and to 2, a third one to 1.5 that is no new largest value, and one to 3 at the end."""
    corners, ends = np.array([0, 1, 0.5, 2, 1, 1.5, 1, 3.0]), 20 * np.arange(8)
    path = np.interp(np.arange(141), ends, corners)
    path += noise * np.random.default_rng(1).uniform(-1, 1, path.size)
    # A step is 0.025 to 0.1, so that noise moves a corner by one or two samples.
    for stop, turns, starts in (
        (141, [20, 60], [0, 40, 120]), (121, [20, 60], [0, 40]), (81, [20, 60], [0, 40]),
        (61, [20], [0, 40]),
    ):  # fmt: skip
        found = turning_points(path[:stop].tolist(), 0.1)
        for where, expected in zip(found, (turns, starts), strict=True):
            assert len(where) == len(expected)
            assert np.all(np.abs(np.subtract(where, expected)) <= 2)
