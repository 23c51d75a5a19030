"""The solver against references of many digits, where it is hard (see `hard_cases`)."""

import pytest

pytest.importorskip("mpmath")

from .hard_cases import BOUNDS, EXTREMES, MEDIA, REGIMES, errors
from .shapes import name


@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("shape", EXTREMES, ids=name)
def test_against_many_digits(shape, regime):
    # One medium per pair keeps the run short; over all pairs each regime meets every medium.
    medium = MEDIA[(EXTREMES.index(shape) + list(REGIMES).index(regime)) % len(MEDIA)]
    for quantity, error in errors(shape, medium, regime).items():
        assert error <= BOUNDS[quantity], quantity
