"""The stress tensor below the surface: each increment of depth is a flat punch, in closed form.

With w = z − i x and S = √(r² + w²), on the branch S → w for r → 0, an increment ds of a flat punch of
radius x has, at the depth z below the surface and in units of E* ds/π,

    J = Im 1/S      K = z Im(w/S³)      L = Im 1/(S + w)      M = Im 1/(S (S + w))
    σ_zz = −(J + K)                               σ_rz = −r z Im(1/S³)
    σ_θθ = −(2ν J + (1 − 2ν) L − z M)             σ_rr = −((1 + 2ν) J − K) − σ_θθ

The stress of a state is the integral over the live interval. The branch points x = ±r − i z are close to
the radii x ≥ 0 only for small z, at x = r, where the integral is split.
"""

from dataclasses import dataclass

import numpy as np

from ...base import check
from ...base.check import Array
from ..medium.medium import refuse_transversely_isotropic
from ..numerics.blocks import chunks
from ..numerics.gauss import crowded, gauss_legendre
from ..numerics.roots import largest_value
from .integrals import integrals
from .quadrature import nodes, pieces

#: Quantities for `stress_peak` and `largest_stress`.
SIZES = "max_shear", "von_mises"
#: A piece of radii is split for points closer to it than this share of its width.
_NEAR = 0.5
#: Nodes of a piece that is not split.
_WHOLE = gauss_legendre(24)
#: Number of points times nodes for arrays that fit into the cache.
_MOST = 2**12
#: Depth taken as 0, and distance beyond which the load is a point force, in units of the contact radius.
_SURFACE, _FAR = 1e-100, 1e30
#: Least depth, as a share of the width of a piece, that nodes resolve.
_LEAST = 1e-13


@dataclass(frozen=True, eq=False)
class Stress:
    """Stress tensor (Pa) below the surface, positive in tension; returned by `Indentation.stress`.

    `rr`, `tt` and `zz` are the radial, circumferential and axial normal stresses, `rz` is the shear stress
    in the r–z plane, all of one shape. The other components vanish by symmetry. Normal stresses are
    infinite at points of infinite pressure.

    Examples
    --------
    >>> from mdr_core.solver.contact.stress import Stress
    >>> state = Stress(rr=1.0, tt=1.0, zz=-2.0, rz=0.0)
    >>> print(round(state.von_mises, 12), state.max_shear, state.principal.tolist())
    3.0 1.5 [1.0, 1.0, -2.0]
    """

    rr: Array
    tt: Array
    zz: Array
    rz: Array

    @property
    def principal(self) -> Array:
        """Principal stresses (Pa), the largest first, along a first axis of length 3."""
        finite = np.isfinite(self.zz)
        rr, zz = np.where(finite, self.rr, 0.0), np.where(finite, self.zz, 0.0)
        mean, radius = (rr + zz) / 2, np.hypot((rr - zz) / 2, self.rz)
        both = np.where(finite, [mean + radius, mean - radius], -np.inf)
        return np.sort([*both, self.tt], axis=0)[::-1]

    @property
    def max_shear(self) -> Array:
        """Largest shear stress τ_max (Pa), half the difference of the outer principal stresses."""
        first, _, last = self.principal
        gap = np.subtract(first, last, out=np.full(np.shape(last), np.inf), where=np.isfinite(last))
        return gap[()] / 2

    @property
    def von_mises(self) -> Array:
        """Equivalent stress (Pa) of von Mises."""
        one, two, three = self.principal
        finite = np.isfinite(three)
        one, two, three = (np.where(finite, part, 0.0) for part in (one, two, three))
        size = np.hypot(np.hypot(one - two, two - three), three - one) / np.sqrt(2)
        return np.where(finite, size, np.inf)[()]


@dataclass(frozen=True)
class StressPeak:
    """Largest value (Pa) of a stress in a state, and its radius and depth below the surface (m)."""

    value: float
    r: float
    z: float


def depths(z):
    """Return depths below the surface (m) as an array; raise an error if one is negative."""
    z = check.finite_array("depth z", z, unit="m")
    bound = "is above the surface"
    return check.raise_if("depth z", z, z < 0, bound, unit="m", advice="z counts downward from it")


def stress(state, r, z):
    """Return `Indentation.stress` of one state, at r ≥ 0 and z ≥ 0 of one shape."""
    refuse_transversely_isotropic(state.medium, "the stress below the surface")
    nu, unit = state.medium.poisson, state.contact_radius or 1.0
    at_r, at_z = r.ravel() / unit, z.ravel() / unit
    # The stress of a point force falls as 1/distance², so that large distances need not be resolved.
    nearer = np.minimum(_FAR / np.maximum(np.maximum(at_r, at_z), 1.0), 1.0)
    at_r, at_z = at_r * nearer, np.where(at_z > _SURFACE, at_z * nearer, 0.0)
    J, K, T, L, M = _integrals(state, unit, at_r, at_z) * (state.medium.E_star / np.pi * nearer**2)
    surface = at_z == 0
    J[surface] = state.pressure(r.ravel()[surface])
    K[surface] = T[surface] = M[surface] = 0.0
    sharp = np.isinf(J)
    size, J[sharp] = J[sharp], 0.0
    tt = M - 2 * nu * J - (1 - 2 * nu) * L
    parts = K - (1 + 2 * nu) * J - tt, tt, -J - K, -T
    # At points of infinite pressure, the limits of the other stresses depend on the direction.
    for part in parts[:3]:
        part[sharp] = -size
    return Stress(*(part.reshape(r.shape)[()] for part in parts))


def stress_peak(state, quantity):
    """Return `Indentation.stress_peak` of one state: the maximum on a grid, then on finer grids."""
    a = state.contact_radius
    if not a:
        return StressPeak(0.0, 0.0, 0.0)
    r, z, sharp = _grid(state)
    # For ν = 1/2 a logarithmic singularity of the pressure is hydrostatic, without shear.
    close = _finite(state, quantity, sharp, a * np.array([[1e-9], [1e-6]]))
    infinite = sharp[(state.medium.poisson < 0.5) | (close[0] > 1.01 * close[1])]
    if infinite.size:
        return StressPeak(np.inf, float(infinite[-1]), 0.0)
    values = _finite(state, quantity, r, z[:, None])
    i, j = np.unravel_index(np.argmax(values), values.shape)
    spacing = np.array([np.diff(z)[max(i - 1, 0) : i + 1].max(), np.diff(r)[max(j - 1, 0) : j + 1].max()])
    best, offsets = np.array([z[i], r[j]]), np.linspace(-1, 1, 5)
    for _ in range(30):
        z, r = np.abs(best[:, None] + spacing[:, None] * offsets)
        values = _finite(state, quantity, r, z[:, None])
        i, j = np.unravel_index(np.argmax(values), values.shape)
        best, spacing = np.array([z[i], r[j]]), 0.6 * spacing
    return StressPeak(float(values[i, j]), float(best[1]), float(best[0]))


def largest_stress(states, z, quantity):
    """Return `Indentation.largest_stress`, state by state: the refined maximum over a grid of radii."""
    result, flat = np.zeros(z.size), z.ravel()[:, None]
    for index in np.ndindex(np.shape(states.depth)):
        state = states[index] if index else states
        if not state.contact_radius or not z.size:
            continue

        def values_at(r, state=state):
            return _finite(state, quantity, np.abs(r), flat)

        r, _, sharp = _grid(state)
        values = values_at(r)
        best = np.minimum(values.argmax(axis=1), r.size - 2)
        # A maximum on the axis lies between −r₁ and r₁.
        low, high = np.where(best > 0, r[best - 1], -r[1])[:, None], r[best + 1][:, None]
        result = np.max([result, values.max(axis=1), largest_value(values_at, low, high)], axis=0)
        if sharp.size:
            result[flat[:, 0] == 0] = np.inf
    return result.reshape(z.shape)[()]


def _finite(state, quantity, r, z):
    """Return a quantity of the stress at points; infinite values are replaced by 0."""
    values = getattr(stress(state, *np.broadcast_arrays(r, z)), quantity)
    return np.where(np.isfinite(values), values, 0.0)


def _grid(state):
    """Return radii and depths (m) for the search of the largest stress, and radii of infinite pressure."""
    profile, a, c = state.profile, state.contact_radius, state.plastic_radius
    inner = max(c, profile.face_radius)
    # The load varies between the inner radius and a.
    width = (
        float(integrals(profile).radius_difference(state.live_interval)) if c == inner else a - inner
    ) or a
    ring = width * np.linspace(-2, 1, 37)
    r = np.unique(np.abs(np.concatenate([a * np.linspace(0, 1.5, 31), a + ring])))
    z = np.concatenate([[0.0], width * np.geomspace(1e-3, 3, 36), np.geomspace(3 * width, 3 * a, 20)[1:]])
    kinks = np.array(profile.kinks)
    edges = profile.radius_at(kinks) if kinks.size else kinks
    # The radius of a kink has a rounding error, so that both sides are tried.
    edges = np.concatenate(
        [[0.0, profile.face_radius, a], np.nextafter(edges, 0), edges, np.nextafter(edges, a)]
    )
    edges = np.unique(edges[edges <= a])
    return r, z, edges[np.isinf(state.pressure(edges))]


def _integrals(state, unit, r, z):
    """Integrate J, K, r z Im(1/S³), L and z M over the load, at points in units of a length (m)."""
    profile, interval = state.profile, state.live_interval
    total, order = np.zeros((5, r.size)), np.argsort(r, kind="stable")
    if state.uniform_load != 0:
        width = np.array([state.uniform_load / state.medium.E_star])
        _add(total, order, np.array([state.contact_radius]), width, unit, r, z)
    if interval.length == 0:
        return total
    for piece in _pieces(profile, interval):
        begin, end, _ = piece
        low, high = profile.radius_at(interval.lower + piece[:2])
        if low == high:
            _add(total, order, np.array([low]), np.array([end - begin]), unit, r, z)
            continue
        width = (high - low) / unit
        away = np.hypot(np.maximum(np.maximum(low / unit - r, r - high / unit), 0.0), z)[order]
        close = away < _NEAR * width
        above, weight = (part[0] for part in nodes(*piece[:, None], _WHOLE))
        _add(total, order[~close], profile.radius_at(interval.lower + above), weight, unit, r, z)
        close = order[close]
        for rows in chunks(close.size, 64):
            rows = close[rows]
            # Points of a grid with the same radius share their nodes.
            cut, which = np.unique(np.clip(unit * r[rows], low, high), return_inverse=True)
            x, weight = _cut(profile, interval.lower, piece, low, high, cut)
            _add(total, rows, x[which], weight[which], unit, r, np.maximum(z, _LEAST * width))
    return total


def _pieces(profile, interval):
    """Return start and end (m) of each piece of the load above d_p, and the `offset` of its start."""
    if integrals(profile).polynomial:
        # One piece, since a(s) is a power from the tip.
        return np.array([[0.0, interval.length, interval.lower]])
    ends = map(np.atleast_1d, (interval.lower, interval.upper, interval.length))
    return np.transpose(pieces(profile, *ends)[2:])


def _cut(profile, lower, piece, low, high, cut):
    """Return radii and increments (m) of the punches of one piece, split at radii `cut`, one row per cut.

    The outer part is integrated over the radius, so that the nodes are equally close to the cut, also
    after a kink. The inner part is integrated over the depth, which is accurate at the kink itself.
    """
    begin, end, start = piece
    node, gap, share = crowded()
    middle = np.clip(profile.reduced_at(cut) - lower, begin, end)
    # An empty piece at the tip has weight 0.
    start = np.full_like(middle, max(start, np.finfo(float).tiny))
    above, inner = nodes(np.full_like(middle, begin), middle, start, (gap, share))
    cut = cut[:, None]
    x = np.clip(cut + (high - cut) * node, np.nextafter(cut, high), np.nextafter(high, low))
    outer = share * profile.reduced_slope_at(x)
    # The width of a short live interval is more accurate from depths than from radii.
    outer *= np.where(end > middle, (end - middle) / outer.sum(axis=1), 0.0)[:, None]
    return np.append(profile.radius_at(lower + above), x, axis=1), np.append(inner, outer, axis=1)


def _add(total, rows, x, weight, unit, r, z):
    """Add flat punches of radii x (m) and increments `weight` (m), the same or one row per point."""
    # A radius 0 on the axis of the surface would divide by 0.
    x, weight = np.maximum(x / unit, _SURFACE), weight / unit
    for part in chunks(rows.size, max(1, _MOST // x.shape[-1])):
        subset = part if x.ndim > 1 else ...
        total[:, rows[part]] += _punches(x[subset], weight[subset], r[rows[part]], z[rows[part]])


def _punches(x, weight, r, z):
    """Return `_integrals` over flat punches of radii x, one row per point or one row for all."""
    square = np.empty(np.broadcast_shapes(x.shape, (len(r), 1)), complex)
    # The sign of the imaginary part, also that of −0, selects the branch of S.
    square.real = (r[:, None] - x) * (r[:, None] + x) + (z * z)[:, None]
    square.imag = x * (-2 * z)[:, None]
    S = np.sqrt(square)
    with np.errstate(divide="ignore", invalid="ignore"):
        # At the rim of a punch.
        first = 1 / S
    S.real += z[:, None]
    S.imag -= x
    last, third = 1 / S, first * first * first
    J, L, M, T, X = (
        np.einsum("...j,...j->...", *factors)
        for factors in (
            (first.imag, weight),
            (last.imag, weight),
            ((first * last).imag, weight),
            (third.imag, weight),
            (third.real, x * weight),
        )
    )
    return J, z * (z * T - X), r * z * T, L, z * M
