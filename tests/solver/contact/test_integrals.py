"""The solver against references of many digits, where it is hard (see `hard_cases`)."""

import numpy as np
import pytest

pytest.importorskip("mpmath")

from mpmath import mp, mpf

import mdr_core as mdr
from mdr_core.solver.contact.integrals import QuadratureIntegrals, integrals, tabulated
from mdr_core.solver.contact.live_interval import LiveInterval
from mdr_core.solver.profiles.radius_table import OneLength

from ...approx import approx
from ...hard_cases import EXTREMES, MEDIA, REGIMES, bounds, errors
from ...shapes import SHAPES, name

# Each shape in three regimes and one medium; the report on accuracy has all of them with every medium.
CASES = [
    (shape, MEDIA[i % len(MEDIA)], regime)
    for i, shape in enumerate(EXTREMES)
    for j, regime in enumerate(REGIMES)
    if (i + j) % 3 == 0
]


@pytest.mark.parametrize(("shape", "medium", "regime"), CASES, ids=str)
def test_against_many_digits(shape, medium, regime):
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
            error = abs(mpf(integrals(mdr.Sphere(1.0)).energy_integral(live)[0]) / exact - 1)
        # Twenty roundings.
        assert error <= 5e-15, depth


TABLES = (
    *(shape for shape in SHAPES if isinstance(shape, OneLength)),
    tabulated(mdr.Sampled(1e-6 * np.arange(61), 1e-7 * np.arange(61) + 2e-9 * np.arange(61.0) ** 2), 1e-5),
)


@pytest.mark.parametrize("shape", TABLES, ids=name)
def test_integrals_from_tables_are_those_of_quadrature(shape):
    """Of live intervals of all lengths: in one zone, across kinks, and next to them on both sides."""
    random, scale = np.random.default_rng(4), shape.transition_depth
    depth = scale * 10.0 ** random.uniform(-6, 1.5, 3000)
    depth[:500] = scale * (1 + random.choice([-1, 1], 500) * 10.0 ** random.uniform(-9, 0, 500))
    length = depth * 10.0 ** random.uniform(-8, 0, 3000)
    length[::7] = depth[::7]
    live = LiveInterval(np.where(length == depth, 0.0, depth - length), depth, length)
    table, quadrature = integrals(shape), QuadratureIntegrals(shape)
    np.testing.assert_allclose(table.radius_integral(live), quadrature.radius_integral(live), rtol=1e-13)
    # Differences lose up to two digits of the energy, a tenth of what is promised.
    np.testing.assert_allclose(table.energy_integral(live), quadrature.energy_integral(live), rtol=1e-13)


def test_depths_beyond_the_tables():
    """Where a sphere is a paraboloid to any precision, a hyperboloid its cone, and a sphere all in."""
    for depth in (1e-40, 1e-32, 1e-28):
        assert mdr.Sphere(1.0).contact_radius(depth) == approx(depth**0.5, rel=1e-15)
        energy = integrals(mdr.Sphere(1.0)).energy_integral(LiveInterval.elastic(np.array([depth])))[0]
        assert energy == approx(4 / 15 * depth**2.5, rel=1e-14)
    # The tables end at 2¹⁰⁰ times the length of the tip.
    wide = mdr.Hyperboloid(1.0, 1e-10).contact_radius(1e24)
    assert wide == approx(1e24 / (np.pi / 2), rel=1e-15)
    assert mdr.Sphere(1.0).contact_radius(99.0) == approx(1.0, rel=1e-15)


def _latitude(depth):
    start = mp.sqrt(depth) if depth < 1 else depth
    return mp.findroot(lambda y: y * mp.tanh(y) / depth - 1, start) if depth else depth
