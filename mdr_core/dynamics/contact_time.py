"""Contact time of a dry impact: quadrature of dd/v, without time stepping."""

from functools import lru_cache

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from .._numeric import chunks, cube_rise, cube_way, gauss_integrals, gauss_legendre
from ..closed_forms import closed_forms
from ..superposition import energy_integral, radius_integral, tabulated
from ..yielding import LiveInterval, elastic_interval

#: Nodes for pieces that come near the turning point, and for others.
_NEAR, _FAR = 28, 12
#: Where a shape goes over from one power of the depth to another, in units of its scale; and at which
#: multiples of its length the lower end of a live interval no longer feels the tip as the upper one does.
_OVER, _LENGTHS = np.array([1.0, 6.0]), 5 * 25.0 ** np.arange(6)
#: Live intervals shorter than such a share of the depth have no digits as differences.
_SHORT = 1e-4


def contact_time(profile, inertia, speed, interval, increase):
    """Time (s) from first contact to its loss, elementwise.

    From inertia m/(2E*) (m s²), speed v₀ (m/s), live interval at the turning point, and `increase` (m)
    of the plastic depth by the impact. Everything broadcasts to the shape of these two.
    """
    shape = np.shape(interval.upper)
    factor = np.broadcast_to(np.sqrt(inertia / 2), shape).ravel()
    increase = np.ravel(increase)
    lower, upper, length = (np.ravel(part) for part in (interval.lower, interval.upper, interval.length))
    passage = np.broadcast_to(upper.reshape(shape) / speed, shape).ravel()
    virgin, forms = increase == lower, closed_forms(profile)
    exponent, similar = (forms.elastic_exponent, forms.similar) if forms else (None, None)
    elastic = virgin & (lower == 0) & (exponent is not None)
    by_ratio = virgin & (lower > 0) & (similar is not None)
    time = np.empty(upper.shape)
    if elastic.any():
        ratio = np.broadcast_to(elastic_time(exponent), shape).ravel()
        time[elastic] = ratio[elastic] * passage[elastic]
    if by_ratio.any():
        time[by_ratio] = _similar_time(similar, lower[by_ratio] / length[by_ratio]) * passage[by_ratio]
    rest = np.flatnonzero(~(elastic | by_ratio))
    if rest.size:
        profile = tabulated(profile, upper[rest].max())
    unit, radius, depth = profile.unit or (profile, 1.0, 1.0)
    root, depth = (np.broadcast_to(part, shape).ravel() for part in (np.sqrt(radius), depth))
    for part in chunks(rest.size, max(32, 2048 // (1 + len(unit.kinks)))):
        rows = rest[part]
        # The kinetic energy is 2E* times the integral of a ds that is still to be spent.
        state = LiveInterval(lower[rows], upper[rows], length[rows]).in_units_of(depth[rows])
        ratio = time_over_root(unit.flat_entries(rows, shape), state, increase[rows] / depth[rows])
        time[rows] = ratio / root[rows] * factor[rows]
    return time.reshape(shape)[()]


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


def _similar_time(profile, ratio):
    """Contact time over d_max/v₀ of profiles similar to this one, as a function of d_p/d_c > 0."""
    result = np.empty_like(ratio)
    for rows in chunks(ratio.size):
        # Powers of √(d_p/d_c) at the onset of yield, of its inverse far beyond.
        root = np.sqrt(ratio[rows])
        result[rows] = chebyshev.chebval(2 * (root / (1 + root)) - 1, _table(profile))
    return result


@lru_cache
def _table(profile):
    """Chebyshev coefficients of `_similar_time` in 2v − 1, with v = √X/(1 + √X) and X = d_p/d_c."""

    def time(place):
        X = ((1 + place) / (1 - place)) ** 2
        one = np.ones_like(X)
        interval = LiveInterval(X, X + one, one)
        energy = energy_integral(profile, interval) + radius_integral(profile, elastic_interval(X))
        return time_over_root(profile, interval, X) * np.sqrt(energy) / interval.upper

    return chebyshev.chebtrim(chebyshev.chebinterpolate(time, 71), 1e-15)


def time_over_root(profile, interval, increase):
    """∫ ds/√(∫∫ a ds ds) over unloading and loading (m^(−1/2)), one impact a row.

    1. Unloading is one stretch of depth, loading two: beyond the critical depth both ends of the live
       interval move.
    2. Stretches are cut into pieces at kinks, and at depths beside which a piece would be long.
    3. In each piece what is still to be spent is integrated at Gauss nodes, from the turning point back, so
       that it never cancels.
    """
    lower, length, increase = interval.lower[:, None], interval.length[:, None], increase[:, None]
    start, nothing = lower - increase, np.zeros(interval.length.shape)
    kinks = np.column_stack(profile.kinks) if profile.kinks else np.empty((1, 0))
    over = np.empty((1, 0)) if profile.scale is None else np.multiply.outer(profile.scale, _OVER)
    over = np.atleast_2d(over)
    # Unloading, above the plastic depth.
    time, _ = _stretch(
        profile, lambda s, rows: (lower[rows], s), lower, length, 0.0, kinks - lower, over - lower, nothing
    )
    # Loading beyond the critical depth.
    cuts = np.hstack([kinks - start, kinks - start - length])
    breaks = np.hstack([over - start, _LENGTHS * length])
    beyond, spent = _stretch(
        profile,
        lambda s, rows: (start[rows] + s, length[rows]),
        start,
        increase,
        0.0,
        cuts,
        breaks,
        nothing,
    )
    # Loading up to it, about where it would turn if the interval went on to grow.
    force, a = _flow(profile, start[:, 0], interval.length), profile._radius(start[:, 0] + interval.length)
    more = (2 * spent / (force + np.sqrt(force**2 + 2 * a * spent)))[:, None]
    below, _ = _stretch(
        profile, lambda s, rows: (start[rows], s), start, length, more, kinks - start, over - start, spent
    )
    return time + beyond + below


def _stretch(profile, limits_at, lower, end, more, kinks, breaks, spent):
    """∫ ds/√spent over a stretch of depth, and what is spent from its beginning on, one impact a row.

    The stretch begins at a depth `lower` and is `end` long, after which `spent` is still to be spent on
    what is `more` up to the turning point (m). `limits_at` gives lower end and length of the live interval
    at depths from the beginning; at depths `kinks`, of shape (N, K), the force has a kink.
    """
    edges, origin = _edges(profile, lower, end, kinks, breaks)
    rows, k = np.nonzero(np.diff(edges) > 0)
    begin, origin = edges[rows, k], origin[rows, k]
    size, rest = edges[rows, k + 1] - begin, (end - edges[:, 1:] + more)[rows, k]
    spending, pieces = np.zeros((len(end), edges.shape[1])), []
    for some, count in ((size > rest, _NEAR), (size <= rest, _FAR)):
        if some.any():
            node, weight, tail = _rule(count)
            row, at = rows[some, None], begin[some, None]
            beyond, rate = _places(at - origin[some, None], size[some, None], rest[some, None], node)
            flow = _flow(profile.entries((row,), (len(end),)), *limits_at(at + beyond, row[:, 0])) * rate
            # Not by @: for sums as short as these the threads of BLAS take a second core, and no less time.
            spending[row[:, 0], k[some]] = np.einsum("ij,j", flow, weight)
            pieces.append((row[:, 0], k[some], rate, np.einsum("ij,kj", flow, tail), weight))
    # What is left after each piece.
    left = spent[:, None] + np.cumsum(spending[:, ::-1], axis=1)[:, ::-1]
    time = np.zeros(len(end))
    for row, k, rate, within, weight in pieces:
        passed = np.einsum("ij,j", rate / np.sqrt(left[row, k + 1, None] + within), weight)
        time += np.bincount(row, passed, minlength=len(end))
    return time, left[:, 0]


def _edges(profile, lower, end, kinks, breaks):
    """Depths between pieces of stretches, ascending; of each piece, where a(s) begins as a root."""
    cuts = np.clip(np.hstack([kinks, np.broadcast_to(breaks, (len(end), breaks.shape[1]))]), 0.0, end)
    order = np.argsort(cuts, axis=1)
    cuts = np.take_along_axis(cuts, order, axis=1)
    roots = np.where((order < kinks.shape[1]) & (cuts > 0), cuts, -np.inf)
    foot = profile._kink_above(lower[:, 0])[:, None] - lower
    return np.hstack([0 * end, cuts, end]), np.maximum.accumulate(np.hstack([foot, roots]), axis=1)


def _places(root, size, rest, node):
    """Nodes of pieces as depths beyond their beginning (m), and their rates by the node.

    A piece begins `root` (m) beyond where a(s) begins as a root, is `size` long, and ends by `rest` before
    the turning point. With W the way to it in σ = ∛depth, σ = ∛root + W u(2 − u): smooth enough in u from
    the root on, and with a velocity that is straight in u at the turning point, u = 1.
    """
    first = np.cbrt(root)
    rise = cube_way(first, size + rest)
    # The end as what it lacks, which may be less than rounding of it.
    lack = cube_way(np.cbrt(root + size), rest) / rise
    last = cube_way(first, size) / rise / (1 + np.sqrt(lack))
    u = last * node
    sigma = rise * (u * (2 - u))
    return cube_rise(first, sigma), last * 6 * rise * (1 - u) * (first + sigma) ** 2


@lru_cache
def _rule(count):
    """Nodes, weights, and what takes values at the nodes to integrals from each of them to the end."""
    node, weight = gauss_legendre(count)
    return node, weight, weight - gauss_integrals(count, node)


def _flow(profile, lower, length):
    """∫ a ds over live intervals (m²) to the digits that times need, from a table where there is one."""
    upper = lower + length
    if not profile.unit or not np.all(profile.table.covers([lower.min(), upper.min(), upper.max()])):
        return radius_integral(profile, LiveInterval(*np.broadcast_arrays(lower, upper, length)))
    flow = profile.table.area(upper) - profile.table.area(lower)
    short = length < _SHORT * upper
    if short.any():
        # At a kink the difference has to do.
        short &= profile._kink_above(lower) == profile._kink_above(upper)
        lower, length = (np.broadcast_to(part, short.shape)[short] for part in (lower, length))
        node, weight = gauss_legendre(2)
        flow[short] = length * np.einsum(
            "i,ij", weight, profile.table.covered_radius(lower + length * node[:, None])
        )
    return flow
