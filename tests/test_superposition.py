"""The solver against references of many digits, where it is hard (see `hard_cases`)."""

import numpy as np
import pytest

pytest.importorskip("mpmath")

from mpmath import mp, mpf

import mdr_core as mdr
from mdr_core import superposition
from mdr_core.yielding import LiveInterval

from .hard_cases import EXTREMES, MEDIA, REGIMES, bounds, errors

# A third of all pairs, which the report on accuracy has (with every medium): each shape in three regimes.
PAIRS = [
    (shape, regime)
    for i, shape in enumerate(EXTREMES)
    for j, regime in enumerate(REGIMES)
    if (i + j) % 3 == 0
]


@pytest.mark.parametrize(("shape", "regime"), PAIRS, ids=str)
def test_against_many_digits(shape, regime):
    medium = MEDIA[EXTREMES.index(shape) % len(MEDIA)]
    for quantity, error in errors(shape, medium, regime).items():
        assert error <= bounds(regime)[quantity], quantity


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 1 - 1e-9])
def test_energy_of_a_sphere_of_any_contact_radius(share):
    """∫ (d − s) a ds with s = R y tanh y, from a ≪ R to a → R, and live intervals of any length."""
    for depth in (1e-12, 2.2e-4, 2.3e-4, 0.087, 0.088, 1.35, 1.37, 3.0):
        lower = share * depth
        live = LiveInterval(*(np.array([each]) for each in (lower, depth, depth - lower)))
        # Many digits are needed where the interval is a billionth of the depth.
        with mp.workdps(60):
            ends = [_latitude(mpf(each)) for each in (lower, depth)]

            def moment(y, depth=depth):
                a = mp.tanh(y)
                return (depth - y * a) * a * (a + y * (1 - a * a))

            exact = mp.quad(moment, mp.linspace(*ends, 2 + int(ends[1] - ends[0])))
            error = abs(mpf(superposition.energy_integral(mdr.Sphere(1.0), live)[0]) / exact - 1)
        # Twenty roundings.
        assert error <= 5e-15, depth


def _latitude(depth):
    start = mp.sqrt(depth) if depth < 1 else depth
    return mp.findroot(lambda y: y * mp.tanh(y) / depth - 1, start) if depth else depth
