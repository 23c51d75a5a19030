"""Contact time of a dry impact: quadrature of dd/v, without time stepping."""

from functools import lru_cache

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from .._numeric import chunks, gauss_integrals, gauss_legendre
from ..shapes.power import Cone, FlatPunch, Paraboloid, PowerLaw
from ..shapes.tabulated import tabulated
from ..superposition import energy_integral, radius_integral
from ..yielding import LiveInterval, virgin

_NODE, _WEIGHT = gauss_legendre(40)
#: From values at the nodes to integrals from each of them to the end.
_TAIL = _WEIGHT - gauss_integrals(40, _NODE)


def contact_time(profile, inertia, speed, live, growth):
    """Time (s) from first contact to its loss, elementwise.

    From inertia m/(2E*) (m s²), speed v₀ (m/s), live interval at the turning point, and `growth` (m), what
    the impact added to the plastic depth. Everything broadcasts to the shape of these two.
    """
    shape = np.shape(live.upper)
    factor = np.broadcast_to(np.sqrt(inertia / 2), shape).ravel()
    growth = np.ravel(growth)
    lower, upper, length = (np.ravel(part) for part in (live.lower, live.upper, live.length))
    passage = np.broadcast_to(upper.reshape(shape) / speed, shape).ravel()
    # Of a power law, the contact time over d_max/v₀ depends on d_p/d_c alone.
    fresh = growth == lower
    known = fresh & (lower == 0) & (power(profile) is not None)
    by_ratio = fresh & (lower > 0) & isinstance(profile, Cone | Paraboloid)
    time = np.empty(upper.shape)
    if known.any():
        ratio = np.broadcast_to(elastic_time(power(profile)), shape).ravel()
        time[known] = ratio[known] * passage[known]
    if by_ratio.any():
        grown = lower[by_ratio] / length[by_ratio]
        time[by_ratio] = _tabulated(type(profile), grown) * passage[by_ratio]
    rest = np.flatnonzero(~(known | by_ratio))
    if rest.size:
        profile = tabulated(profile, upper[rest].max())
    for part in chunks(rest.size, 512):
        rows = rest[part]
        indenters = profile.flat_entries(rows, shape)
        # The kinetic energy is 2E* times the integral of a ds that is still to be spent.
        state = LiveInterval(lower[rows], upper[rows], length[rows])
        time[rows] = time_over_root(indenters, state, growth[rows]) * factor[rows]
    return time.reshape(shape)[()]


def power(profile):
    """Exponent p of the elastic force F ∝ dᵖ, None if it is not a power."""
    if isinstance(profile, PowerLaw):
        return 1 + 1 / profile.exponent
    return {FlatPunch: 1.0, Cone: 2.0, Paraboloid: 1.5}.get(type(profile))


def elastic_time(p):
    """Contact time over d_max/v₀ of an elastic impact with F ∝ dᵖ.

    Examples
    --------
    >>> print(round(elastic_time(1.5), 10))  # Hertz
    2.9432751843
    """
    q = 1 / (p + 1)
    gamma = scipy.special.gamma
    return 2 * np.sqrt(np.pi) * gamma(1 + q) / gamma(0.5 + q)


def _tabulated(kind, grown):
    """Contact time over d_max/v₀ of a cone or paraboloid, as a function of d_p/d_c > 0."""
    result = np.empty_like(grown)
    for rows in chunks(grown.size):
        # Powers of √(d_p/d_c) at the onset of yield, of its inverse far beyond.
        root = np.sqrt(grown[rows])
        result[rows] = chebyshev.chebval(2 * (root / (1 + root)) - 1, _table(kind))
    return result


@lru_cache
def _table(kind):
    """Chebyshev coefficients of `_tabulated` in 2v − 1, with v = √X/(1 + √X) and X = d_p/d_c."""

    def time(place):
        X = ((1 + place) / (1 - place)) ** 2
        one = np.ones_like(X)
        profile, live = kind(1.0), LiveInterval(X, X + one, one)
        energy = energy_integral(profile, live) + radius_integral(profile, virgin(X))
        return time_over_root(profile, live, X) * np.sqrt(energy) / live.upper

    return chebyshev.chebtrim(chebyshev.chebinterpolate(time, 71), 1e-15)


def time_over_root(profile, live, growth):
    """∫ ds/√(∫ a ds) over unloading and loading (√m), one impact a row.

    Depths run from where a stretch begins to its turning point as τ³(2 − τ³): the square in
    1 − τ³ takes out the square root at the turning point, the cube the fractional powers where
    contact or yield begins. What is still to be spent is integrated from the turning point back,
    so that it never cancels.
    """
    # Besides kinks, the depth at which a shape goes over from one power to another.
    places = (*profile.kinks, *(() if profile.scale is None else (profile.scale,)))
    kinks = np.column_stack(places) if places else np.empty((1, 0))
    base, whole = live.lower[:, None], live.length[:, None]
    start = base - growth[:, None]
    nothing, end = np.zeros_like(growth), np.ones_like(growth)
    # Unloading over the live length, above the plastic depth.
    time, _ = _stretch(profile, live.length, kinks - base, lambda s: (base + 0 * s, s), end, nothing)
    # Loading beyond the critical depth: the interval moves. Its lower end has a scale of its own, d_c.
    between = np.sqrt(whole * growth[:, None])
    breaks = np.hstack([kinks - start, kinks - start - whole, whole, between])
    beyond, spent = _stretch(profile, growth, breaks, lambda s: (start + s, whole + 0 * s), end, nothing)
    # Loading up to the critical depth: the same map about the turning point, cut at τ_c.
    way = growth + live.length
    cut = np.cbrt(live.length / way / (1 + np.sqrt(growth / way)))
    below, _ = _stretch(profile, way, kinks - start, lambda s: (start + 0 * s, s), cut, spent)
    return time + beyond + below


def _stretch(profile, extent, breaks, interval, last, spent):
    """∫ ds/√spent over a stretch of depth, and what is spent when it ends, one impact a row.

    The stretch begins `extent` (m) before its turning point, at τ = 1, and ends at τ = `last`, beyond which
    `spent` is still to be spent; `interval` gives lower end and length of the live interval at depths from
    its beginning, and at depths `breaks`, of shape (N, K), the force has a kink.
    """
    room = np.where(extent > 0, extent, 1.0)[:, None]
    with np.errstate(over="ignore"):
        share = np.clip(breaks / room, 0, 1)
    # Inverse of τ³(2 − τ³), without cancellation for small shares.
    inner = np.minimum(np.cbrt(share / (1 + np.sqrt(1 - share))), last[:, None])
    edges = np.sort(np.hstack([np.zeros_like(room), inner, last[:, None]]), axis=1)
    time, spent = np.zeros_like(extent), spent.copy()
    for k in range(edges.shape[1] - 2, -1, -1):
        low, high = edges[:, k], edges[:, k + 1]
        rows = np.flatnonzero((high > low) & (extent > 0))
        if not rows.size:
            continue
        # Behind a break the force may go on with the root of the depth: squared.
        square = (low > 0)[rows, None]
        node, slope = np.where(square, _NODE**2, _NODE), np.where(square, 2 * _NODE, 1.0)
        tau = low[rows, None] + (high - low)[rows, None] * node
        depth = np.zeros((len(extent), _NODE.size))
        depth[rows] = extent[rows, None] * (tau**3 * (2 - tau**3))
        lower, length = (part[rows] for part in interval(depth))
        rate = extent[rows, None] * (high - low)[rows, None] * (6 * slope * tau**2 * (1 - tau**3))
        indenters = profile.entries((rows, None), (len(extent),))
        flow = radius_integral(indenters, LiveInterval(lower, lower + length, length)) * rate
        left = spent[rows, None] + np.einsum("ij,kj->ik", flow, _TAIL)
        time[rows] += np.einsum("ij,j->i", rate / np.sqrt(left), _WEIGHT)
        spent[rows] += np.einsum("ij,j->i", flow, _WEIGHT)
    return time, spent
