"""The stress below the surface: against the literature, balance laws, limits, and many digits."""

import math
from itertools import pairwise

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.numerics.gauss import tanh_sinh

from ...approx import approx
from ...shapes import SHAPES, name
from .test_indentation import D_C, HISTORIES

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0, poisson=0.3)
COMPONENTS = "rr", "tt", "zz", "rz"
# What is promised, of the largest stress; and closer to the surface than 10⁻³ a.
DEEP, SHALLOW = 1e-8, 1e-6


def state(shape, history, medium=MEDIUM):
    return mdr.indent(shape, medium, history)[-1]


def tensor(s, r, z):
    stress = s.stress(r, z)
    return np.array([getattr(stress, each) for each in COMPONENTS])


def mean_pressure(s):
    return s.force / (math.pi * s.contact_radius**2)


def point_force(force, r, z, nu):
    """Boussinesq: Johnson, Contact Mechanics (1985), Eq. (3.19)."""
    rho = np.hypot(r, z)
    # 1/r² − z/(ρ r²) without cancellation.
    flat = 1 / (rho * (rho + z))
    rr = (1 - 2 * nu) * flat - 3 * z * (r / rho) ** 2 / rho**3
    tt = -(1 - 2 * nu) * (flat - z / rho**3)
    return (
        force
        / (2 * math.pi)
        * np.array([rr, tt, -3 * (z / rho) ** 3 / rho**2, -3 * r * (z / rho**2) ** 2 / rho])
    )


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.3, 0.5])
def test_hertz_on_the_axis(nu):
    """Huber (1904); Johnson, Eqs. (3.45)."""
    s = mdr.indent(mdr.Paraboloid(1e-5), mdr.Medium(1e9, poisson=nu), 1e-8)
    p0, zeta = s.pressure(0.0), np.geomspace(1e-3, 1e3, 40)
    zz = -p0 / (1 + zeta**2)
    rr = -p0 * ((1 + nu) * (1 - zeta * np.arctan(1 / zeta)) - 1 / (2 * (1 + zeta**2)))
    expected = [rr, rr, zz, 0 * zeta]
    np.testing.assert_allclose(tensor(s, 0.0, zeta * s.contact_radius), expected, rtol=0, atol=DEEP * p0)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_cone_on_the_axis(nu):
    """Love (1939): σ_zz = −(E* s/2)(ln(1 + 1/ζ²)/2 + 1/(1 + ζ²)), and its σ_rr."""
    s = mdr.indent(mdr.Cone(0.3), mdr.Medium(1e9, poisson=nu), 1e-8)
    zeta, scale = np.geomspace(1e-3, 1e3, 40), 1e9 * 0.3 / 2
    J, K = np.log1p(zeta**-2.0) / 2, 1 / (1 + zeta**2)
    rr = -scale / 2 * ((1 + 2 * nu) * J - K)
    expected = [rr, rr, -scale * (J + K), 0 * zeta]
    np.testing.assert_allclose(tensor(s, 0.0, zeta * s.contact_radius), expected, rtol=0, atol=DEEP * scale)


@pytest.mark.parametrize("history", [HISTORIES[0], HISTORIES[3]])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_equilibrium_and_compatibility(shape, history):
    """div σ = 0, and a trace that is harmonic, by differences of fourth order."""
    s = state(shape, history)
    a = s.contact_radius
    r, z = np.meshgrid(np.linspace(0.15, 2, 14) * a, np.linspace(0.2, 2, 7) * a)
    h = 4e-3 * a
    steps = np.arange(-2, 3)
    first, second = np.array([1, -8, 0, 8, -1]) / (12 * h), np.array([-1, 16, -30, 16, -1]) / (12 * h * h)
    along = np.array([tensor(s, r + k * h, z) for k in steps])
    down = np.array([tensor(s, r, z + k * h) for k in steps])
    rr, tt, _, rz = along[2]
    dr, dz = np.tensordot(first, along, 1), np.tensordot(first, down, 1)
    scale = mean_pressure(s) / a
    # The fifth derivative at 0.2 a times h⁴ is 10⁻⁶ of it, noise of 10⁻⁹ over h as much.
    np.testing.assert_allclose(dr[0] + dz[3] + (rr - tt) / r, 0, atol=1e-5 * scale)
    np.testing.assert_allclose(dr[3] + dz[2] + rz / r, 0, atol=1e-5 * scale)
    trace = sum(np.tensordot(second, part[:, :3].sum(axis=1), 1) for part in (along, down))
    np.testing.assert_allclose(trace + dr[:3].sum(axis=0) / r, 0, atol=1e-3 * scale / a)


@pytest.mark.parametrize("history", [HISTORIES[0], HISTORIES[2], HISTORIES[3]])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_every_plane_carries_the_force(shape, history):
    s = state(shape, history)
    for depth in (1e-4, 0.02, 0.3, 3.0):
        assert carried(s, depth) == approx(s.force, rel=1e-6), depth


def carried(s, depth):
    """−2π ∫ σ_zz r dr over the plane at some contact radii below the surface."""
    a, c = s.contact_radius, s.plastic_radius
    node, weight = tanh_sinh()
    places = sorted({0.0, c, *(k for k in (0.3e-6, 1e-6) if k < a), a})
    total = 0.0
    for low, high in pairwise(places):
        r = low + (high - low) * node
        total -= 2 * math.pi * np.sum(weight * (high - low) * r * s.stress(r, depth * a).zz)
    # Outside, up to infinity.
    inner = node < 1 - 1e-9
    node, weight = node[inner], weight[inner]
    r = a * (1 + node / (1 - node))
    return total - 2 * math.pi * np.sum(weight * a / (1 - node) ** 2 * r * s.stress(r, depth * a).zz)


@pytest.mark.parametrize("history", [(1e4 * D_C,), (2e8 * D_C,)])
@pytest.mark.parametrize(
    "shape", [mdr.Cone(0.3), mdr.Hyperboloid(0.3, 1e-6), mdr.TruncatedCone(1e-6, 0.3)], ids=name
)
def test_far_beyond_the_critical_depth(shape, history):
    """A load on a narrow ring: what one ring width below the surface is carried, and far away."""
    s = state(shape, history)
    a = s.contact_radius
    # Radii have 10⁻¹⁶ a, and the ring is 10⁻⁸ a wide.
    assert carried(s, (a - s.plastic_radius) / a) == approx(s.force, rel=1e-6)
    assert carried(s, 1.0) == approx(s.force, rel=1e-8)


@pytest.mark.parametrize("history", HISTORIES)
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_surface_is_free_outside_and_joins_the_pressure_inside(shape, history):
    s = state(shape, history)
    a, scale = s.contact_radius, mean_pressure(s)
    outside = np.array([1.01, 1.3, 5.0]) * a
    for z in (0.0, 1e-10 * a):
        stress = s.stress(outside, z)
        assert np.abs([stress.zz, stress.rz]).max() <= SHALLOW * scale
    # Not at radii where the pressure has a kink or is infinite.
    inside = np.array([0.11, 0.37, 0.53, 0.97]) * a
    surface, below = tensor(s, inside, 0.0), tensor(s, inside, 1e-10 * a)
    np.testing.assert_array_equal(surface[2:], [-s.pressure(inside), 0 * inside])
    size = scale + np.abs(surface).max(axis=0)
    assert np.all(np.abs(below - surface) <= SHALLOW * size)
    # Under any pressure the surface is strained as much along as around: σ_rr + σ_θθ = −(1 + 2ν) p.
    np.testing.assert_allclose(surface[0] + surface[1], 1.6 * surface[2], rtol=1e-14)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_yielded_state_is_one_elastic_state_less_another(shape):
    s, elastic = state(shape, (3 * D_C, 2.6 * D_C)), mdr.Medium(MEDIUM.E_star, poisson=MEDIUM.poisson)
    deep, past = (mdr.indent(shape, elastic, depth) for depth in (2.6 * D_C, s.plastic_depth))
    a = s.contact_radius
    places = np.meshgrid(np.linspace(0, 2, 15) * a, np.geomspace(1e-3, 3, 15) * a)
    expected = tensor(deep, *places) - tensor(past, *places)
    # Of both together, which are up to five times as large; three errors add up.
    bound = 3 * DEEP * (np.abs(tensor(deep, *places)).max() + np.abs(tensor(past, *places)).max())
    np.testing.assert_allclose(tensor(s, *places), expected, rtol=0, atol=bound)


@pytest.mark.parametrize("distance", [1e4, 1e12, 1e60])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_far_away_it_is_that_of_a_point_force(shape, distance):
    s, angle = state(shape, HISTORIES[1]), np.linspace(0, 1.5, 9)
    r, z = (distance * s.contact_radius * part for part in (np.sin(angle), np.cos(angle)))
    expected = point_force(s.force, r, z, MEDIUM.poisson)
    # The next term falls as (a/R)², and 10⁻⁸ is what the quadrature has.
    np.testing.assert_allclose(tensor(s, r, z), expected, rtol=0, atol=1e-7 * np.abs(expected).max())


# Every third of the shapes: an acute tip, an equator, walls and edges.
@pytest.mark.slow
@pytest.mark.few(2)
@pytest.mark.parametrize("shape", SHAPES[2::3], ids=name)
def test_against_many_digits(shape):
    """At scattered places, next to the rim and to c, close to the surface, below the tip."""
    pytest.importorskip("mpmath")
    from mpmath import mp

    from ...reference import Reference

    history = HISTORIES[SHAPES.index(shape) % len(HISTORIES)]
    s = state(shape, history)
    a, c = s.contact_radius, s.plastic_radius
    places = (
        (0.31, 0.72), (1.6, 0.05), (0.99, 0.02), (c / a * 1.001, 2e-3), (1.0, 1e-3), (0.0, 1e-3),
        (0.7, 1e-5), (0.999999, 1e-7), (1e-7, 1e-6),
    )  # fmt: skip
    # Two of them for each shape; over all shapes each history and each place comes up.
    chosen = [(SHAPES.index(shape) + k) % len(places) for k in (0, 4)]
    exact = Reference(shape, MEDIUM, history[-1], history[0])
    with mp.workdps(32):
        for r, z in (places[i] for i in chosen):
            got = tensor(s, r * a, z * a)
            expected = np.array(exact.stress(r * a, z * a, MEDIUM.poisson), dtype=float)
            largest = max(np.abs(expected).max(), mean_pressure(s))
            bound = DEEP if z >= 1e-3 else SHALLOW
            assert np.abs(got - expected).max() <= bound * largest, (r, z)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_infinite_only_where_the_pressure_is(shape):
    for history in HISTORIES:
        s = state(shape, history)
        a, c = s.contact_radius, s.plastic_radius
        r = np.array([0, 1e-300, 0.3e-6, 1e-6, c, a, np.nextafter(a, 0), np.nextafter(a, 1), 2 * a, 1e60])
        stress = s.stress(r, np.array([0, 1e-320, 1e-100, 1e-14, 1e-9, 1e60])[:, None] * a)
        infinite = np.isinf(s.pressure(r))
        for part in (*COMPONENTS[:3], "max_shear", "von_mises"):
            values = getattr(stress, part)
            np.testing.assert_array_equal(np.isinf(values[0]), infinite, err_msg=f"{part} {history}")
            assert np.isfinite(values[1:][:, ~infinite]).all(), (part, history)
        assert np.isfinite(stress.rz).all(), history
        assert not np.isnan(stress.principal).any(), history


def test_no_stress_without_contact():
    s = state(mdr.Cone(0.3), (3 * D_C, D_C))
    assert s.contact_radius == 0
    assert not tensor(s, [0.0, 1e-6], [0.0, 1e-6]).any()
    assert s.stress_peak().value == 0
    assert s.largest_stress(1e-6) == 0


def test_invariants_of_the_tensor():
    """Against the eigenvalues of the matrix."""
    s = state(mdr.Sphere(1e-5), HISTORIES[3])
    for r, z in ((0.3e-6, 0.2e-6), (0.9e-6, 0.01e-6), (0.0, 0.4e-6)):
        stress = s.stress(r, z)
        matrix = np.array([[stress.rr, 0, stress.rz], [0, stress.tt, 0], [stress.rz, 0, stress.zz]])
        values = np.linalg.eigvalsh(matrix)[::-1]
        deviator = matrix - np.trace(matrix) / 3 * np.eye(3)
        # A few roundings.
        np.testing.assert_allclose(stress.principal, values, rtol=1e-12, atol=1e-12 * np.abs(values).max())
        assert stress.max_shear == approx((values[0] - values[2]) / 2, rel=1e-12)
        assert stress.von_mises == approx(math.sqrt(1.5 * np.sum(deviator**2)), rel=1e-12)


def test_shapes_of_arrays():
    s = state(mdr.Cone(0.3), HISTORIES[1])
    grid = s.stress(np.linspace(-1e-6, 1e-6, 5), np.linspace(0, 1e-6, 3)[:, None])
    assert grid.rr.shape == grid.von_mises.shape == (3, 5)
    assert grid.principal.shape == (3, 3, 5)
    # Sums in another order.
    np.testing.assert_allclose(grid.zz, grid.zz[:, ::-1], rtol=1e-12)
    one = s.stress(0.5e-6, 0.5e-6)
    assert isinstance(one.rr, float)
    assert isinstance(one.max_shear, float)
    assert one.rz == approx(grid.rz[1, 3], rel=1e-12)
    assert s.stress([], 1e-6).rr.shape == (0,)


WET = mdr.Medium(1e9, q_c=10.0, eta=2.0, poisson=0.2)


@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Sphere(1e-5), mdr.RoundedPunch(1e-6, 1e-5)], ids=name)
def test_states_of_an_impact(shape):
    """The dashpots add a flat punch as wide as the contact; on the way out it is ahead of the depth."""
    motion = mdr.impact(shape, WET, 1e-9, 0.1).motion(12)
    for i in (1, 4, 8, 10):
        s = motion.states[i]
        assert carried(s, 0.2) == approx(motion.force[i], rel=1e-6)
    s, slow = motion.states[3], mdr.indent(shape, WET, motion.depth[3])
    a = s.contact_radius
    elastic = mdr.Medium(WET.E_star, poisson=WET.poisson)
    punch = mdr.indent(mdr.FlatPunch(a), elastic, 4 * WET.eta * motion.velocity[3] / WET.E_star)
    places = np.array([0.0, 0.5, 1.0, 1.3]) * a, np.array([0.1, 0.01, 1e-4, 1.0]) * a
    expected = tensor(slow, *places) + tensor(punch, *places)
    # Two roundings of the largest of them.
    np.testing.assert_allclose(tensor(s, *places), expected, rtol=0, atol=1e-13 * np.abs(expected).max())
    assert s.stress(a, 0.0).zz == -math.inf


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda s: s.stress(0.0, -1e-9), "depth z = -1e-09 m is above the surface; z counts downward"),
        (lambda s: s.stress(0.0, [0.0, math.inf]), r"depth z\[1\] = inf m must be finite"),
        (lambda s: s.stress([0.0, 1.0], [0.0, 1.0, 2.0]), r"r \(2,\), z \(3,\) do not broadcast"),
        (
            lambda s: s.stress_peak("pressure"),
            "quantity = 'pressure' must be one of 'max_shear', 'von_mises'",
        ),
        (lambda s: s.largest_stress(-1.0), "depth z = -1 m is above"),
        (
            lambda s: mdr.indent(s.profile, s.medium, [1e-9, 2e-9]).stress(0, 0),
            "stress needs a single state",
        ),
        (
            lambda s: mdr.indent(s.profile, s.medium, [1e-9]).stress_peak(),
            "stress_peak needs a single state",
        ),
    ],
)
def test_bad_calls_are_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call(state(mdr.Cone(0.3), HISTORIES[0]))
