"""Fields of one state: pressure where it is singular, and that of the dashpots."""

import math
from itertools import pairwise

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx
from ..shapes import SHAPES, name
from .test_indentation import D_C, HISTORIES, MEDIUM, state

WET = (
    mdr.Cone(0.3),
    mdr.Paraboloid(1e-5),
    mdr.Sphere(1e-5),
    mdr.RoundedCone(1e-6, 0.3),
    mdr.RoundedPunch(1e-6, 1e-5),
)


def test_pressure_is_infinite_only_where_it_is():
    """Rim of a flat face, elastic sharp tip; nowhere NaN."""
    for shape in SHAPES:
        for history in HISTORIES:
            s = state(shape, history)
            a, c = s.contact_radius, s.plastic_radius
            r = np.array([0, 1e-300, 0.3e-6, 1e-6, c, a, np.nextafter(a, 0), np.nextafter(a, 1), 2 * a])
            assert not np.isnan(s.pressure(r)).any(), (shape, history)
            assert not np.isnan(s.surface(r)).any(), (shape, history)
            assert not np.isnan(s.imprint(r)).any(), (shape, history)
            assert s.pressure(2 * a) == 0.0, (shape, history)
    assert state(SHAPES[0], (0.4 * D_C,)).pressure(0.0) == np.inf
    assert np.isfinite(state(SHAPES[0], (3 * D_C,)).pressure(0.0))
    assert mdr.indent(mdr.FlatPunch(1e-6), MEDIUM, D_C).pressure(1e-6) == np.inf


@pytest.mark.parametrize("n", [0.5, 1.5, 3.0])
@pytest.mark.parametrize("excess", [1e-12, 1e-6, 1e-3])
def test_axis_pressure_and_stiffness_of_a_power_law_next_to_the_threshold(n, excess):
    """p(0) = (E*/π) n κ c (a^(n−1) − c^(n−1))/(n−1), dF/dd = 2E*(a − c), c/a from d_p/d itself."""
    shape = mdr.PowerLaw(1e-3, n)
    s = mdr.indent(shape, MEDIUM, D_C * (1 + excess))
    ratio = (s.plastic_depth / s.depth) ** (1 / n)
    a = s.contact_radius
    expected = MEDIUM.E_star / math.pi * n * s.depth / a * (1 - ratio ** (n - 1)) / (n - 1)
    # Powers of a ratio down to 1e-12.
    assert s.pressure(0.0) == approx(expected, rel=1e-12)
    assert s.stiffness == approx(2 * MEDIUM.E_star * a * (1 - ratio), rel=1e-13)


@pytest.mark.parametrize("r", [1e-20, 1e-60])
@pytest.mark.parametrize("tip", [mdr.Cone(1.0), mdr.PowerLaw(1.0, 1.0)], ids=name)
def test_pressure_next_to_a_sharp_tip(tip, r):
    """p = (E*/2) arcosh(a/r): a logarithm, however small r is."""
    state = mdr.indent(tip, mdr.Medium(E_star=1e9), 1e-7)
    expected = 1e9 / 2 * (math.log(2 * state.contact_radius) - math.log(r))
    assert state.pressure(r) == approx(expected, rel=1e-13)


@pytest.mark.parametrize("shape", WET, ids=name)
def test_pressure_of_a_body_in_motion_is_the_transform_of_its_element_loads(shape):
    """q = E* min(d − g, d − d_p) + 4ηḋ while that is positive, at every instant, in and out; Eq. (10)."""
    medium = mdr.Medium(1e9, 10.0, eta=2.0)
    motion = mdr.impact(shape, medium, 1e-9, 0.1).motion(12)
    for i in (1, 4, 8, 10):
        state, depth = motion.states[i], motion.depth[i]
        a, c = float(state.contact_radius), float(state.plastic_radius)
        places = [0.0, c, *(k for k in (0.3e-6, 1e-6) if k < a), a]
        # Crowded at both ends of every stretch, where the load goes with a root.
        rise = (1 - np.cos(np.linspace(0, np.pi, 801))) / 2
        x = np.concatenate([low + (high - low) * rise for low, high in pairwise(sorted(places))])
        # Just inside: a load with a jump at the rim ends there.
        inside = np.minimum(x, a * (1 - 1e-15))
        spring = np.minimum(depth - shape.reduced(inside), depth - motion.plastic_depth[i])
        load = np.maximum(medium.E_star * spring + 4 * medium.eta * motion.velocity[i], 0.0)
        r = np.array([0.2, 0.55, 0.9, 0.97]) * a
        expected = -mdr.abel.stress_from_line_load(x, load, r)
        # Straight lines between 800 places: their spacing to the power 1.5 next to r.
        np.testing.assert_allclose(state.pressure(r), expected, rtol=2e-4)
        np.testing.assert_allclose(state.line_load(r), np.interp(r, x, load), rtol=1e-4)


@pytest.mark.parametrize("shape", WET, ids=name)
def test_dashpots_press_as_a_flat_punch(shape):
    """4ηḋ at every element in contact is that of a flat punch of radius a: 4ηḋ/(π√(a² − r²))."""
    medium = mdr.Medium(1e9, 10.0, eta=2.0)
    motion = mdr.impact(shape, medium, 1e-9, 0.1).motion(12)
    state = motion.states[3]
    slow = mdr.indent(shape, medium, motion.depth[3])
    a, load = state.contact_radius, 4 * medium.eta * motion.velocity[3]
    r = np.array([0.0, 0.5, 0.99]) * a
    with np.errstate(invalid="ignore"):
        added = state.pressure(r) - slow.pressure(r)
    finite = np.isfinite(slow.pressure(r))
    punch = load / math.pi / np.sqrt(a**2 - r**2)
    # A difference of pressures of one size.
    np.testing.assert_allclose(added[finite], punch[finite], rtol=1e-12)
    assert state.force - slow.force == approx(2 * a * load, rel=1e-12)
    assert state.pressure(a) == math.inf
    assert state.pressure(1.001 * a) == 0.0


@pytest.mark.parametrize("shape", [mdr.Smooth(lambda r: r / 1e-6), *SHAPES], ids=name)
def test_pressure_within_a_rounding_of_the_plastic_radius(shape):
    """Between its values at c (1 ± 10⁻⁸): a node may round to r, and the tangent at r = c is vertical."""
    for deep in np.random.default_rng(3).uniform(1.5, 40.0, 40):
        s = mdr.indent(shape, MEDIUM, deep * D_C)
        c = s.plastic_radius
        if c == s.contact_radius or c == shape.face_radius:
            continue
        near = [np.nextafter(c, 0), np.nextafter(np.nextafter(c, 0), 0), np.nextafter(c, 1)]
        # √(2·10⁻⁸) of the pressure, times a slope of some units.
        assert s.pressure(near) == approx(s.pressure(c * (1 + 1e-8)), rel=1e-3)
