"""Contact time of dry impacts: closed forms of elastic powers, and the quadrature as it stands."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, trapezoid

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name
from .test_energy_balance import D_C, MEDIUM, hit_to_depth

ELASTIC = mdr.Medium(E_star=1e9)


@pytest.mark.parametrize(
    ("tip", "n"),
    [(mdr.FlatPunch(1e-6), math.inf), (mdr.Cone(0.3), 1.0), (mdr.Paraboloid(1e-3), 2.0)]
    + [(mdr.PowerLaw(1e-4, n), n) for n in (0.2, 0.5, 1.5, 3.0, 10.0, 50.0)],
    ids=str,
)
def test_elastic_contact_time_of_power_laws(tip, n):
    """T v/d_max = 2√π Γ(1 + q)/Γ(1/2 + q) with q = 1/(p + 1) for F ∝ dᵖ, p = 1 + 1/n."""
    q = 1 / (2 + 1 / n)
    expected = 2 * math.sqrt(math.pi) * math.gamma(1 + q) / math.gamma(0.5 + q)
    hit = mdr.impact(tip, ELASTIC, 1.0, 1.0)
    assert hit.restitution == 1.0
    # Few roundings times 40 nodes; for small n the largest depth to a high power.
    assert hit.contact_time * hit.speed / hit.max_depth == approx(expected, rel=1e-12)


@pytest.mark.parametrize("times", [0.7, 1 + 1e-5, 1.5, 30.0, 150.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_contact_time_by_direct_quadrature(shape, times):
    """T = ∫ dd/v in and out, from the force alone, with v from the work done so far."""
    hit = hit_to_depth(shape, MEDIUM, times * D_C)
    d_max, live = float(hit.max_depth), float(hit.turning_point.live_interval.length)

    s = np.linspace(0, 1, 4001)

    def time(height, path):
        """Over `height` below the turning point, where d_max − d = height·s²."""
        force = mdr.indent(shape, MEDIUM, path(height * s**2)).force.ravel()
        work = cumulative_trapezoid(force * 2 * height * s, s, initial=0)
        with np.errstate(invalid="ignore"):
            slowness = np.where(s > 0, 2 * height * s / np.sqrt(2 * work), np.sqrt(2 * height / force[0]))
        return trapezoid(slowness, s)

    loading = time(d_max, lambda y: (d_max - y)[:, None])
    unloading = time(live, lambda y: d_max - y)
    # Trapezoids of 1/4000, and a kink of the force at d_c.
    assert hit.contact_time == approx(loading + unloading, rel=1e-6)


def test_depths_of_metres_at_the_threshold_of_yield():
    """Just below the critical depth nothing yields: the contact time is that of an elastic medium."""
    for shape in (mdr.Hyperboloid(0.2, 0.9), mdr.ParabolicPunch(2.8, 0.005), mdr.TruncatedCone(0.15, 5.5)):
        hit = mdr.impact(shape, mdr.Medium(1e9, q_c=1e13), 200.0, 1e5)
        elastic = mdr.impact(shape, mdr.Medium(1e9), 200.0, 1e5)
        assert hit.plastic_work == 0.0, shape
        assert hit.contact_time == approx(elastic.contact_time, rel=1e-13), shape


KINKED = (
    mdr.RoundedCone(tip_radius=1e-6, slope=0.3),
    mdr.ParabolicPunch(radius=1e-5, cylinder_radius=1e-6),
    mdr.Sampled([0.0, 1e-6, 2e-6, 9e-6], [0.0, 1e-7, 3e-7, 3e-6]),
)


@pytest.mark.parametrize("beyond", [0.0, D_C])
@pytest.mark.parametrize("shape", KINKED, ids=name)
def test_turning_exactly_on_a_kink(shape, beyond):
    """Restitution and time go through the kink without a jump: of the contact, or of the plastic zone."""
    at = shape.kinks[0] + beyond
    hit, before, after = (hit_to_depth(shape, MEDIUM, at * (1 + step)) for step in (0.0, -1e-7, 1e-7))
    assert hit.max_depth == approx(at, rel=1e-14)
    for quantity in ("restitution", "contact_time", "max_force"):
        values = [getattr(each, quantity) for each in (before, after)]
        # Straight over 10⁻⁷ but for a root of it, of which the kink's next power is the third.
        assert getattr(hit, quantity) == approx(sum(values) / 2, rel=1e-9), quantity


def behind_a_face(s, sqrt):
    """∫ a ds and ∫∫ a ds ds of z = (r² − 1)₊/2, with τ = √(a² − 1) and τa = s."""
    square = (sqrt(1 + 4 * s * s) - 1) / 2
    tau, a = sqrt(square), sqrt(1 + square)
    area = tau + 2 * tau**3 / 3
    return area, area * s - (6 * a**5 - 5 * a**3 - 1) / 15


def below_a_wall(s, sqrt):
    """The same of a cylinder of radius 1 with the cap z = r²/2: a = √s up to 1."""
    low, beyond = min(s, 1), max(s - 1, 0)
    area = 2 * low * sqrt(low) / 3
    return area + beyond, 4 * low**2 * sqrt(low) / 15 + area * beyond + beyond**2 / 2


def many_digits(integrals, d, d_c):
    """∫ ds/√(∫∫ a ds ds) in and out, of an impact on a virgin medium as deep as d."""
    mp = pytest.importorskip("mpmath").mp
    d, d_c, time = mp.mpf(d), mp.mpf(d_c), mp.mpf(0)
    p = max(d - d_c, mp.mpf(0))

    def loading(s):
        return integrals(s, mp.sqrt)[1] - integrals(max(s - d_c, mp.mpf(0)), mp.sqrt)[1]

    def unloading(s):
        return integrals(s, mp.sqrt)[1] - (s - p) * integrals(p, mp.sqrt)[0]

    for work, begin in ((loading, mp.mpf(0)), (unloading, p)):
        whole = work(d)
        cuts = sorted({begin, d, *(c for c in (d_c, 5 * d_c, mp.mpf(1), 1 + d_c) if begin < c < d)})
        for low, high in itertools.pairwise(cuts):

            def slowness(u, low=low, high=high, work=work, whole=whole):
                # The square takes out the root at the turning point.
                left = whole - work(high - (high - low) * u * u)
                return 2 * u * (high - low) / mp.sqrt(left) if left > 0 else mp.mpf(0)

            time += mp.quad(slowness, [0, 1], maxdegree=5)
    return time


@pytest.mark.few(2)
@pytest.mark.parametrize("depth", [1e-4, 0.97, 1.5])
@pytest.mark.parametrize(
    ("shape", "integrals"),
    [(mdr.TruncatedParaboloid(1.0, 1.0), behind_a_face), (mdr.ParabolicPunch(1.0, 1.0), below_a_wall)],
    ids=["face", "wall"],
)
def test_times_against_many_digits(shape, integrals, depth):
    """From elastic impacts to thousands of critical depths, far below the shape's own length and beyond."""
    mp = pytest.importorskip("mpmath").mp
    medium = mdr.Medium(1.0, q_c=depth / np.array([1.0, 4.9, 3e4]) * 2 / math.pi)
    states = [mdr.indent(shape, medium.entries(i), depth) for i in range(3)]
    speed = np.sqrt([2 * float(each.stored_energy + each.plastic_work) for each in states])
    found = mdr.impact(shape, medium, 1.0, speed).contact_time
    with mp.workdps(40):
        expected = [float(many_digits(integrals, depth, d_c) / 2) for d_c in medium.critical_depth]
    # 10⁻⁹ is promised; the nodes are chosen for a tenth of it.
    np.testing.assert_allclose(found, expected, rtol=1e-10)
