"""Where the stress below the surface is largest, and how large."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import mdr_core as mdr
from mdr_core.solver.contact.stress import StressPeak

from ...approx import approx
from ...shapes import SHAPES, name
from .test_indentation import D_C, HISTORIES
from .test_stress import DEEP, MEDIUM, WET, state


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_peak_of_hertz(nu):
    """0.310 p₀ at 0.481 a for ν = 0.3 (Johnson, Sec. 3.4); all digits from Huber's formula on the axis."""
    s = mdr.indent(mdr.Paraboloid(1e-5), mdr.Medium(1e9, poisson=nu), 1e-8)
    p0, a = s.pressure(0.0), s.contact_radius

    def shear(zeta):
        return 0.75 / (1 + zeta**2) - (1 + nu) / 2 * (1 - zeta * math.atan(1 / zeta))

    top = minimize_scalar(
        lambda zeta: -shear(zeta), bounds=(0.1, 1), method="bounded", options={"xatol": 1e-9}
    )
    peak, equivalent = s.stress_peak(), s.stress_peak("von_mises")
    if nu == 0.3:
        assert (round(peak.value / p0, 3), round(peak.z / a, 3)) == (0.310, 0.481)
    assert peak.value == approx(-top.fun * p0, rel=1e-8)
    # A top of curvature one is flat to the root of what the stress has.
    assert peak.z / a == approx(top.x, abs=1e-3)
    assert peak.r / a == approx(0, abs=1e-3)
    # On the axis two of three principal stresses are equal.
    assert equivalent.value == approx(2 * peak.value, rel=1e-8)


def test_peak_of_a_cone():
    """Incompressible: σ_zz − σ_rr → 3 E* s/4 on the way to the tip. Otherwise infinite, as the pressure."""
    tip = mdr.Cone(0.3)
    peak = mdr.indent(tip, mdr.Medium(1e9), 1e-8).stress_peak()
    assert peak.value == approx(3 / 8 * 1e9 * 0.3, rel=1e-6)
    assert max(peak.r, peak.z) < 1e-3 * mdr.indent(tip, mdr.Medium(1e9), 1e-8).contact_radius
    assert mdr.indent(tip, mdr.Medium(1e9, poisson=0.49), 1e-8).stress_peak() == StressPeak(
        math.inf, 0.0, 0.0
    )


@pytest.mark.parametrize("nu", [0.3, 0.5])
@pytest.mark.parametrize(
    ("shape", "history", "radius"),
    [
        (mdr.FlatPunch(1e-6), (0.4 * D_C,), 1e-6),
        (mdr.ParabolicPunch(1e-5, 1e-6), (40 * 0.1e-6,), 1e-6),
        (mdr.PowerLaw(2e-4, 0.5), (0.4 * D_C,), 0.0),
    ],
    ids=name,
)
def test_peak_where_the_shear_is_infinite(shape, history, radius, nu):
    medium = mdr.Medium(1e9, poisson=nu)
    assert mdr.indent(shape, medium, history[0]).stress_peak() == StressPeak(math.inf, radius, 0.0)


def test_peak_at_the_edges_of_a_polygon():
    """A logarithm of the pressure, and for ν < 1/2 of the shear, at its outermost vertex in contact."""
    tip = mdr.Sampled([0.0, 1e-7, 2e-7, 3e-7], [0.0, 1e-9, 5e-9, 20e-9])
    depth = float(tip.reduced(2.5e-7))
    peak = mdr.indent(tip, mdr.Medium(1e9, poisson=0.3), depth).stress_peak()
    assert peak.value == math.inf
    assert peak.r == approx(2e-7, rel=1e-12)
    assert np.isfinite(mdr.indent(tip, mdr.Medium(1e9), depth).stress_peak().value)


def shape_name(value):
    return name(value) if isinstance(value, mdr.Profile) else None


# A sphere is not pressed in by a hundred radii.
DEEPEST = [(shape, (1e6 * D_C,), "max_shear") for shape in SHAPES if not isinstance(shape, mdr.Sphere)]
STATES = [(s, h, q) for s in SHAPES for h, q in ((HISTORIES[0], "von_mises"), (HISTORIES[3], "max_shear"))]


@pytest.mark.parametrize(("shape", "history", "quantity"), STATES + DEEPEST, ids=shape_name)
def test_nothing_is_larger_than_the_peak(shape, history, quantity):
    s = state(shape, history)
    peak, a = s.stress_peak(quantity), s.contact_radius
    rng = np.random.default_rng(1)
    ring = a - s.plastic_radius
    r = np.append(rng.uniform(0, 1.5, 2000) * a, a + ring * rng.uniform(-2, 1, 2000))
    z = np.append(rng.uniform(0, 1.5, 2000) * a, ring * 10 ** rng.uniform(-3, 0.5, 2000))
    assert np.max(getattr(s.stress(r, z), quantity)) <= peak.value * (1 + DEEP)
    if np.isfinite(peak.value):
        assert getattr(s.stress(peak.r, peak.z), quantity) == approx(peak.value, rel=DEEP)


def test_largest_at_each_depth():
    """Over a path that of its states, and over radii what a fine row of them has."""
    path = mdr.indent(mdr.RoundedCone(1e-6, 0.3), MEDIUM, [0.5 * D_C, 3 * D_C, 2.6 * D_C, 2 * D_C])
    z = np.geomspace(1e-9, 1e-5, 15)
    largest = path.largest_stress(z, "von_mises")
    r = np.linspace(0, 1.6, 3001) * path.contact_radius.max()
    rows = [path[i].stress(r, z[:, None]).von_mises.max(axis=1) for i in range(4)]
    expected = np.max(rows, axis=0)
    assert np.all(largest >= expected * (1 - DEEP))
    # Rows with 3000 radii, each top of which is within (a/6000)² of the curvature there.
    np.testing.assert_allclose(largest, expected, rtol=1e-4)
    peak = path[1].stress_peak("von_mises")
    assert path[1].largest_stress(peak.z, "von_mises") == approx(peak.value, rel=1e-6)


def test_largest_over_an_impact():
    hit = mdr.impact(mdr.Sphere(1e-5), WET, 1e-9, 0.1)
    states = hit.motion(20).states
    z = np.array([0.0, 1e-8, 1e-7, 3e-7])
    largest = states.largest_stress(z)
    # The rim that the dashpots press down.
    assert largest[0] == math.inf
    expected = np.max([states[i].largest_stress(z[1:]) for i in range(20)], axis=0)
    np.testing.assert_allclose(largest[1:], expected, rtol=1e-12)
