"""Refinement: orders are extrapolated away, errors are relative, and the tolerance ends it."""

import numpy as np
import pytest

from mdr_core.solver.foundation.refinement import extrapolate, refine


@pytest.mark.parametrize("orders", [(), (2,), (1, 2)])
def test_orders_are_extrapolated_away(orders):
    exact = np.array([3.0, -1e-9])
    runs = [exact * (1 + sum(0.5 ** (order * k) for order in orders)) for k in range(4)]
    # Differences of numbers up to three times as large.
    np.testing.assert_allclose(extrapolate(runs, orders), exact, rtol=1e-15 * 8)
    # As far as there are runs for it.
    np.testing.assert_array_equal(extrapolate(runs[:1], orders), runs[0])


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e12])
def test_errors_are_relative_and_cover_the_error(size):
    levels = []

    def run(level):
        levels.append(level)
        h = 0.5**level
        return size * np.array([[1.0, 0.0, 5.0], [2.0 + h**2 + h**3, 0.0, 5.0 + h]])

    limit, errors = refine(run, 1e-6, 30, controlled=2, orders=(2,), runs=3)
    assert errors[0] <= 1e-6
    assert abs(limit[1, 0] / size - 2.0) <= 2.0 * errors[0]
    # Of a quantity that is zero, and of an exact agreement, half the tolerance.
    assert errors[1] == 0.5e-6
    assert errors[2] > 1e-6
    assert levels == list(range(len(levels)))
