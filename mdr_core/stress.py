"""The stress tensor below the surface: each increment of depth is a flat punch, in closed form.

With w = z − i x and S = √(r² + w²), the branch with S → w for r → 0, a flat punch of radius x that is
pressed by ds leaves at a depth z below the surface, over E* ds/π,

    J = Im 1/S      K = z Im(w/S³)      L = Im 1/(S + w)      M = Im 1/(S (S + w))
    σ_zz = −(J + K)                               σ_rz = −r z Im(1/S³)
    σ_θθ = −(2ν J + (1 − 2ν) L − z M)             σ_rr = −((1 + 2ν) J − K) − σ_θθ

and the stress of a state is their integral over the live interval. The branch points x = ±r − i z come
close to the radii x ≥ 0 only where z is small, at x = r: there the integral is cut.
"""

from dataclasses import dataclass

import numpy as np

from . import _check
from ._check import Array
from ._numeric import chunks, crowded, gauss_legendre, largest_value
from .closed_forms import closed_forms
from .superposition import nodes, pieces, radius_drop

#: What can be largest somewhere.
SIZES = "max_shear", "von_mises"
#: Places closer to a piece of the contact's radii than this share of its width have it cut.
_NEAR = 0.5
#: Nodes of a piece that is not.
_WHOLE = gauss_legendre(24)
#: So many places times nodes at once stay in the cache.
_MOST = 2**12
#: In units of the contact radius: what is less deep is on the surface, what is farther feels a point force.
_SURFACE, _FAR = 1e-100, 1e30
#: No closer to the surface do nodes crowd, as a share of the width of a piece.
_LEAST = 1e-13


@dataclass(frozen=True, eq=False)
class Stress:
    """Stress tensor (Pa) at places below the surface, positive in tension; made by `Indentation.stress`.

    Normal stresses along the radius, around the axis and downward, and the shear stress between the first
    and the last, as arrays of one shape; by symmetry there is no other. Infinite where the pressure is.

    Examples
    --------
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
    """Where in a state a stress is largest: its value (Pa), radius and depth below the surface (m)."""

    value: float
    r: float
    z: float


def depths(z):
    """Depths below the surface (m) as an array, if they are."""
    z = _check.finite_array("depth z", z, unit="m")
    bound = "is above the surface"
    return _check.refuse("depth z", z, z < 0, bound, unit="m", remedy="z counts downward from it")


def stress(state, r, z):
    """`Indentation.stress` of one state, at r ≥ 0 and z ≥ 0 of one shape."""
    nu, unit = state.medium.poisson, state.contact_radius or 1.0
    at_r, at_z = r.ravel() / unit, z.ravel() / unit
    # A point force's stress falls as the square, while powers of what is farther leave double precision.
    nearer = np.minimum(_FAR / np.maximum(np.maximum(at_r, at_z), 1.0), 1.0)
    at_r, at_z = at_r * nearer, np.where(at_z > _SURFACE, at_z * nearer, 0.0)
    with np.errstate(all="ignore"):
        J, K, T, L, M = _integrals(state, unit, at_r, at_z) * (state.medium.E_star / np.pi * nearer**2)
    surface = at_z == 0
    J[surface] = state.pressure(r.ravel()[surface])
    K[surface] = T[surface] = M[surface] = 0.0
    sharp = np.isinf(J)
    J[sharp] = 0.0
    tt = M - 2 * nu * J - (1 - 2 * nu) * L
    parts = K - (1 + 2 * nu) * J - tt, tt, -J - K, -T
    # Where the pressure is infinite the other stresses depend on the direction that one comes from.
    for part in parts[:3]:
        part[sharp] = -np.inf
    return Stress(*(part.reshape(r.shape)[()] for part in parts))


def stress_peak(state, quantity):
    """`Indentation.stress_peak` of one state: the best place of a grid, and of finer ones around it."""
    a = state.contact_radius
    if not a:
        return StressPeak(0.0, 0.0, 0.0)
    r, z, sharp = _grid(state)
    # In an incompressible medium a logarithm in the pressure is a hydrostatic one, which has no shear.
    beside = _size(state, quantity, sharp, a * np.array([[1e-9], [1e-6]]))
    endless = sharp[(state.medium.poisson < 0.5) | (beside[0] > 1.01 * beside[1])]
    if endless.size:
        return StressPeak(np.inf, float(endless[-1]), 0.0)
    values = _size(state, quantity, r, z[:, None])
    i, j = np.unravel_index(np.argmax(values), values.shape)
    way = np.array([np.diff(z)[max(i - 1, 0) : i + 1].max(), np.diff(r)[max(j - 1, 0) : j + 1].max()])
    best, around = np.array([z[i], r[j]]), np.linspace(-1, 1, 5)
    for _ in range(30):
        z, r = np.abs(best[:, None] + way[:, None] * around)
        values = _size(state, quantity, r, z[:, None])
        i, j = np.unravel_index(np.argmax(values), values.shape)
        best, way = np.array([z[i], r[j]]), 0.6 * way
    return StressPeak(float(values[i, j]), float(best[1]), float(best[0]))


def largest_stress(states, z, quantity):
    """`Indentation.largest_stress`, state by state: the best radius of a grid, and the top beside it."""
    result, flat = np.zeros(z.size), z.ravel()[:, None]
    for index in np.ndindex(np.shape(states.depth)):
        state = states[index] if index else states
        if not state.contact_radius or not z.size:
            continue

        def along(r, state=state):
            return _size(state, quantity, np.abs(r), flat)

        r, _, sharp = _grid(state)
        values = along(r)
        best = np.minimum(values.argmax(axis=1), r.size - 2)
        # On the axis a top has its other half beyond it.
        low, high = np.where(best > 0, r[best - 1], -r[1])[:, None], r[best + 1][:, None]
        result = np.max([result, values.max(axis=1), largest_value(along, low, high)], axis=0)
        if sharp.size:
            result[flat[:, 0] == 0] = np.inf
    return result.reshape(z.shape)[()]


def _size(state, quantity, r, z):
    """A quantity of the stress at places, 0 where it is infinite."""
    values = getattr(stress(state, *np.broadcast_arrays(r, z)), quantity)
    return np.where(np.isfinite(values), values, 0.0)


def _grid(state):
    """Radii and depths (m) at which to look for the largest stress, and radii with an infinite pressure."""
    profile, a, c = state.profile, state.contact_radius, state.plastic_radius
    inner = max(c, profile.face_radius)
    # The load stands between the inner radius and a, as closely as they are together.
    width = (float(radius_drop(profile, state.live_interval)) if c == inner else a - inner) or a
    ring = width * np.linspace(-2, 1, 37)
    r = np.unique(np.abs(np.concatenate([a * np.linspace(0, 1.5, 31), a + ring])))
    z = np.concatenate([[0.0], width * np.geomspace(1e-3, 3, 36), np.geomspace(3 * width, 3 * a, 20)[1:]])
    kinks = np.array(profile.kinks)
    edges = profile._radius(kinks) if kinks.size else kinks
    # Depths of kinks know the radii to rounding.
    edges = np.concatenate(
        [[0.0, profile.face_radius, a], np.nextafter(edges, 0), edges, np.nextafter(edges, a)]
    )
    edges = np.unique(edges[edges <= a])
    return r, z, edges[np.isinf(state.pressure(edges))]


def _integrals(state, unit, r, z):
    """∫ of J, K, r z Im(1/S³), L and z M over the load of a state; places in a unit of length (m)."""
    profile, interval = state.profile, state.live_interval
    total, order = np.zeros((5, r.size)), np.argsort(r, kind="stable")
    if state.dashpot_load > 0:
        width = np.array([state.dashpot_load / state.medium.E_star])
        _add(total, order, np.array([state.contact_radius]), width, unit, r, z)
    if interval.length == 0:
        return total
    for piece in _pieces(profile, interval):
        begin, end, _ = piece
        low, high = profile._radius(interval.lower + piece[:2])
        if low == high:
            _add(total, order, np.array([low]), np.array([end - begin]), unit, r, z)
            continue
        width = (high - low) / unit
        away = np.hypot(np.maximum(np.maximum(low / unit - r, r - high / unit), 0.0), z)[order]
        close = away < _NEAR * width
        beyond, weight = (part[0] for part in nodes(*piece[:, None], _WHOLE))
        _add(total, order[~close], profile._radius(interval.lower + beyond), weight, unit, r, z)
        close = order[close]
        for rows in chunks(close.size, 64):
            rows = close[rows]
            # Of a grid many places have one radius, and share their nodes.
            cut, which = np.unique(np.clip(unit * r[rows], low, high), return_inverse=True)
            x, weight = _cut(profile, interval.lower, piece, low, high, cut)
            _add(total, rows, x[which], weight[which], unit, r, np.maximum(z, _LEAST * width))
    return total


def _pieces(profile, interval):
    """Begin and end (m) beyond d_p of each piece of the load, and its begin behind a kink or the tip."""
    forms = closed_forms(profile)
    if forms and forms.polynomial:
        # Polynomials of what the nodes are even in.
        return np.array([[0.0, interval.length, interval.lower]])
    return np.transpose(
        pieces(profile, *map(np.atleast_1d, (interval.lower, interval.upper, interval.length)))[2:]
    )


def _cut(profile, lower, piece, low, high, cut):
    """Radii and increments (m) of the flat punches of one piece, cut at some radii, a row for each.

    From a cut outward they are counted in the radius: in the depth they would not crowd at it evenly
    behind a kink. Inward the depth knows better what lies at the kink itself.
    """
    begin, end, start = piece
    node, gap, share = crowded()
    middle = np.clip(profile._reduced(cut) - lower, begin, end)
    # An empty part has no weight, also at the tip.
    start = np.full_like(middle, max(start, np.finfo(float).tiny))
    beyond, inner = nodes(np.full_like(middle, begin), middle, start, (gap, share))
    cut = cut[:, None]
    x = np.clip(cut + (high - cut) * node, np.nextafter(cut, high), np.nextafter(high, low))
    outer = share * profile._reduced_slope(x)
    # Of a short live interval the depths have more digits than the radii.
    outer *= np.where(end > middle, (end - middle) / outer.sum(axis=1), 0.0)[:, None]
    return np.append(profile._radius(lower + beyond), x, axis=1), np.append(inner, outer, axis=1)


def _add(total, rows, x, weight, unit, r, z):
    """Adds flat punches of radii x (m) and increments `weight` (m), the same or a row for each place."""
    # On the axis of the surface a tip itself would divide by 0.
    x, weight = np.maximum(x / unit, _SURFACE), weight / unit
    for part in chunks(rows.size, max(1, _MOST // x.shape[-1])):
        each = part if x.ndim > 1 else ...
        total[:, rows[part]] += _punches(x[each], weight[each], r[rows[part]], z[rows[part]])


def _punches(x, weight, r, z):
    """`_integrals` over flat punches of some radii, a row for each place or one for all."""
    square = np.empty(np.broadcast_shapes(x.shape, (len(r), 1)), complex)
    # The sign of the imaginary part, also of −0, takes the right branch of S.
    square.real = (r[:, None] - x) * (r[:, None] + x) + (z * z)[:, None]
    square.imag = x * (-2 * z)[:, None]
    S = np.sqrt(square)
    first = 1 / S
    S.real += z[:, None]
    S.imag -= x
    last, third = 1 / S, first * first * first
    J, L, M, T, X = (
        np.einsum("...j,...j->...", *each)
        for each in (
            (first.imag, weight),
            (last.imag, weight),
            ((first * last).imag, weight),
            (third.imag, weight),
            (third.real, x * weight),
        )
    )
    return J, z * (z * T - X), r * z * T, L, z * M
