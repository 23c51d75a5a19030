"""The solver against references of many digits, where it is hard (see `hard_cases`)."""

import numpy as np
import pytest

pytest.importorskip("mpmath")

from mpmath import mp, mpf

import mdr_core as mdr
from mdr_core import superpose
from mdr_core.yielding import LiveInterval

from .hard_cases import BOUNDS, EXTREMES, MEDIA, REGIMES, errors
from .shapes import name


@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("shape", EXTREMES, ids=name)
def test_against_many_digits(shape, regime):
    # One medium per pair keeps the run short; over all pairs each regime meets every medium.
    medium = MEDIA[(EXTREMES.index(shape) + list(REGIMES).index(regime)) % len(MEDIA)]
    for quantity, error in errors(shape, medium, regime).items():
        assert error <= BOUNDS[quantity], quantity


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
            error = abs(mpf(superpose.energy_integral(mdr.Sphere(1.0), live)[0]) / exact - 1)
        # Twenty roundings.
        assert error <= 5e-15, depth


def _latitude(depth):
    start = mp.sqrt(depth) if depth < 1 else depth
    return mp.findroot(lambda y: y * mp.tanh(y) / depth - 1, start) if depth else depth
