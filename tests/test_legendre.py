"""Rules of many nodes are as exact as those of few."""

import numpy as np
import pytest

from mdr_core.legendre import gauss_legendre


@pytest.mark.parametrize("count", [1, 2, 16, 128, 1024])
def test_weights_of_powers(count):
    node, weight = gauss_legendre(count)
    for power in (0, 2, 20, 200):
        if power < 2 * count:
            assert weight @ node**power == pytest.approx(2 / (power + 1), rel=1e-14)


@pytest.mark.parametrize("count", [256, 512, 1024])
def test_a_pole_next_to_the_end(count):
    """NumPy's rule of 1024 nodes, whose weights lose digits at the ends, misses it by 8e-14."""
    node, weight = gauss_legendre(count)
    assert weight @ (1 / (1.1 + node)) == pytest.approx(np.log(21), rel=3e-15)
