"""Largest values and roots of functions with kinks and plateaus, elementwise."""

import numpy as np
import pytest

from mdr_core.solver.numerics.roots import increasing_root, largest_value

from ...approx import approx

LOW, HIGH = np.zeros((1, 1)), np.ones((1, 1))
#: Functions on [0, 1] and their largest values.
FUNCTIONS = {
    "smooth": (lambda x: np.sin(2 * x), 1.0),
    "plateau": (lambda x: np.minimum(x, 0.3137), 0.3137),
    "kink": (lambda x: np.minimum(2 * x, 1 - x), 2 / 3),
    "end": (lambda x: np.exp(x), np.e),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_largest_value_is_taken_on_and_never_exceeded(name):
    """With five grids places are 1.5·10⁻⁵ apart: at a kink the slope times that is missing."""
    function, expected = FUNCTIONS[name]
    (found,) = largest_value(function, LOW, HIGH, grids=5)
    assert found <= expected * (1 + 1e-15)
    assert found == approx(expected, rel=3e-5 if name == "kink" else 1e-15)


def test_a_root_is_never_sought_beyond_its_bounds():
    """Only where the function is known, up to the highest x, and not far beyond the largest one."""
    highest = np.array([0.7, 3.0, np.inf])

    def function(x):
        assert np.all(x <= highest)
        assert np.all(x < 1e90)
        # Saturates: the target is reached at the very end, and never.
        return x / (1 + x), 1 / (1 + x) ** 2

    target = np.array([0.7 / 1.7, 0.75 * (1 - 1e-16), 1.5])
    found = increasing_root(function, target, 1e-3, highest)
    assert found[:2] == approx(highest[:2], rel=1e-13)
    assert found[2] == np.inf
