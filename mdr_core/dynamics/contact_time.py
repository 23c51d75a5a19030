"""Contact time of a dry impact: quadrature of dd/v, without time stepping."""

from functools import lru_cache, partial

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from .._numeric import chunks, cube_rise, cube_way, gauss_integrals, gauss_legendre
from ..integrals import integrals, tabulated
from ..live_interval import LiveInterval
from ..quadrature import kink_above

#: Depths between pieces, where a(s) changes from one power of the depth to another, in units of the
#: transition depth; and in units of the length of the live interval, whose lower end is close to the tip.
_TRANSITIONS, _LENGTHS = np.array([1.0, 6.0]), 5 * 25.0 ** np.arange(6)


def contact_time(profile, inertia, speed, interval, increase):
    """Time (s) from first contact to its loss, elementwise.

    From inertia m/(2E*) (m s²), speed v₀ (m/s), and, of full shape, the live interval at the turning point
    and the increase (m) of the plastic depth.
    """
    shape = np.shape(interval.upper)
    factor = np.broadcast_to(np.sqrt(inertia / 2), shape).ravel()
    lower, upper, length, increase = map(
        np.ravel, (interval.lower, interval.upper, interval.length, increase)
    )
    passage = np.broadcast_to(upper.reshape(shape) / speed, shape).ravel()
    virgin = increase == lower
    exponent, similar = integrals(profile).elastic_exponent, integrals(profile).similar
    elastic = virgin & (lower == 0) & (exponent is not None)
    by_ratio = virgin & (lower > 0) & (similar is not None)
    time = np.empty(upper.shape)
    if elastic.any():
        ratio = np.broadcast_to(elastic_time(exponent), shape).ravel()
        time[elastic] = ratio[elastic] * passage[elastic]
    if by_ratio.any():
        time[by_ratio] = _similar_time(similar, lower[by_ratio] / length[by_ratio]) * passage[by_ratio]
    remainder = np.flatnonzero(~(elastic | by_ratio))
    if remainder.size:
        profile = tabulated(profile, upper[remainder].max())
    unit, radius, depth = integrals(profile).unit
    root, depth = (np.broadcast_to(scale, shape).ravel() for scale in (np.sqrt(radius), depth))
    # In ascending order, impacts that reach few kinks are together.
    depths = upper[remainder] / depth[remainder]
    order = np.argsort(depths)
    kinks, start = np.sort([np.min(kink) for kink in unit.kinks]), 0
    inside = np.searchsorted(kinks, depths[order])
    while start < order.size:
        stop = start + max(32, 2048 // (1 + inside[start]))
        rows = remainder[order[start:stop]]
        turning = LiveInterval(lower[rows], upper[rows], length[rows]).in_units_of(depth[rows])
        ratio = time_over_root(unit.flat_entries(rows, shape), turning, increase[rows] / depth[rows])
        time[rows] = ratio / root[rows] * factor[rows]
        start = stop
    return time.reshape(shape)[()]


def elastic_time(p):
    """Contact time over d_max/v₀ of an elastic impact with F ∝ dᵖ: 2.9433 for p = 3/2 (Hertz)."""
    q, gamma = 1 / (p + 1), scipy.special.gamma
    return 2 * np.sqrt(np.pi) * gamma(1 + q) / gamma(0.5 + q)


def _similar_time(profile, ratio):
    """Contact time over d_max/v₀ of profiles similar to this one, as a function of d_p/d_c > 0."""
    result = np.empty_like(ratio)
    for rows in chunks(ratio.size):
        # A series in √(d_p/d_c) at the onset of yield, in its inverse where d_p ≫ d_c.
        root = np.sqrt(ratio[rows])
        result[rows] = chebyshev.chebval(2 * (root / (1 + root)) - 1, _table(profile))
    return result


@lru_cache
def _table(profile):
    """Chebyshev coefficients of `_similar_time` in 2v − 1, with v = √X/(1 + √X) and X = d_p/d_c."""

    def time(place):
        X = ((1 + place) / (1 - place)) ** 2
        return _ratio(profile, X + 1, X)

    return chebyshev.chebtrim(chebyshev.chebinterpolate(time, 71), 1e-15)


def _ratio(profile, depth, X):
    """Contact time over d_max/v₀ of impacts on a virgin medium, from d_max (m) and X = d_p/d_c."""
    interval = LiveInterval(depth * X / (1 + X), depth, depth / (1 + X))
    plastic = interval.length * integrals(profile).radius_integral(LiveInterval.elastic(interval.lower))
    energy = integrals(profile).energy_integral(interval) + plastic
    return time_over_root(profile, interval, interval.lower) * np.sqrt(energy) / depth


def time_over_root(profile, interval, increase):
    """∫ ds/√(∫∫ a ds ds) over unloading and loading (m^(−1/2)), one impact a row.

    The kinetic energy is 2E* times the inner integral, which is the work up to the turning point.
    Unloading is one stretch of depth, loading two: deeper than d_c both ends of the live interval move. In
    each piece of a stretch the work is integrated from the turning point back, so that it never cancels.
    """
    lower, length, increase = interval.lower[:, None], interval.length[:, None], increase[:, None]
    before, stretch = lower - increase, partial(_stretch, profile)
    kinks = np.column_stack(profile.kinks) if profile.kinks else np.empty((1, 0))
    kinks = kinks[:, (kinks < interval.upper.max()).any(axis=0)]
    breaks = np.empty((1, 0))
    if profile.transition_depth is not None:
        breaks = np.atleast_2d(np.multiply.outer(profile.transition_depth, _TRANSITIONS))
    time, _ = stretch(lambda s, rows: (lower[rows], s), lower, length, kinks - lower, breaks - lower)
    # Loading deeper than the critical depth.
    both = np.hstack([kinks - before, kinks - before - length])
    all_breaks = np.hstack([breaks - before, _LENGTHS * length])
    yielding = partial(stretch, lambda s, rows: (before[rows] + s, length[rows]))
    time_below, work = yielding(before, increase, both, all_breaks)
    # Loading down to it, and about the further distance to rest if nothing yielded.
    force = _flow(profile, before[:, 0], interval.length)
    a = profile._radius(before[:, 0] + interval.length)
    distance = (2 * work / (force + np.sqrt(force**2 + 2 * a * work)))[:, None]
    elastic = partial(stretch, lambda s, rows: (before[rows], s))
    time_above, _ = elastic(before, length, kinks - before, breaks - before, distance, work)
    return time + time_below + time_above


def _stretch(profile, interval_at, upper, length, kinks, breaks, distance=0.0, work=0.0):
    """∫ ds/√W over a stretch of depth that starts at `upper` (m), and the work W from there on.

    `interval_at` gives the lower end and the length of the live interval at depths from the start; pieces
    end at depths `kinks` from there, (N, K), where the force has a kink, and at `breaks`. At the end of the
    stretch `work` remains, and the `distance` (m) to the turning point.
    """
    edges, origins = _edges(profile, upper, length, kinks, breaks)
    rows, k = np.nonzero(np.diff(edges) > 0)
    start, origin = edges[rows, k], origins[rows, k]
    size, remainder = edges[rows, k + 1] - start, (length - edges[:, 1:] + distance)[rows, k]
    works, pieces = np.zeros((len(length), edges.shape[1])), []
    # Pieces that are longer than their distance from the turning point need more nodes.
    for subset, count in ((size > remainder, 28), (size <= remainder, 12)):
        if subset.any():
            node, weight, tail = _rule(count)
            row, at = rows[subset, None], start[subset, None]
            sizes = size[subset, None], remainder[subset, None]
            depth, rate = _places(at - origin[subset, None], *sizes, node)
            entries = profile.entries((row,), (len(length),))
            flow = _flow(entries, *interval_at(at + depth, row[:, 0])) * rate
            # Not by @: for sums as short as these the threads of BLAS take a second core, and no less time.
            works[row[:, 0], k[subset]] = np.einsum("ij,j", flow, weight)
            pieces.append((row[:, 0], k[subset], rate, np.einsum("ij,kj", flow, tail), weight))
    # The work from the start of each piece on.
    works = np.reshape(work, (-1, 1)) + np.cumsum(works[:, ::-1], axis=1)[:, ::-1]
    time = np.zeros(len(length))
    for row, k, rate, within, weight in pieces:
        passage = np.einsum("ij,j", rate / np.sqrt(works[row, k + 1, None] + within), weight)
        time += np.bincount(row, passage, minlength=len(length))
    return time, works[:, 0]


def _edges(profile, upper, length, kinks, breaks):
    """Depths between pieces of stretches, ascending, and for each piece where a(s) starts as a root."""
    cuts = np.hstack([kinks, np.broadcast_to(breaks, (len(length), breaks.shape[1]))])
    cuts = np.clip(cuts, 0.0, length)
    order = np.argsort(cuts, axis=1)
    cuts = np.take_along_axis(cuts, order, axis=1)
    roots = np.where((order < kinks.shape[1]) & (cuts > 0), cuts, -np.inf)
    first = kink_above(profile, upper[:, 0])[:, None] - upper
    return np.hstack([0 * length, cuts, length]), np.maximum.accumulate(np.hstack([first, roots]), axis=1)


def _places(offset, size, remainder, node):
    """Nodes of pieces as depths from their start (m), and their rates by the node.

    A piece starts `offset` (m) below the depth where a(s) starts as a root, has the length `size`, and ends
    `remainder` above the turning point. With W the distance to it in σ = ∛depth, σ = ∛offset + W u(2 − u):
    smooth in u from the root on, with a velocity that is linear in u at the turning point, u = 1.
    """
    first = np.cbrt(offset)
    rise = cube_way(first, size + remainder)
    # 1 − u(2 − u) at the end, which may be less than rounding of u(2 − u).
    gap = cube_way(np.cbrt(offset + size), remainder) / rise
    last = cube_way(first, size) / rise / (1 + np.sqrt(gap))
    u = last * node
    sigma = rise * (u * (2 - u))
    return cube_rise(first, sigma), last * 6 * rise * (1 - u) * (first + sigma) ** 2


@lru_cache
def _rule(count):
    """Nodes, weights, and the matrix from values at the nodes to integrals from each of them to the end."""
    node, weight = gauss_legendre(count)
    return node, weight, weight - gauss_integrals(count, node)


def _flow(profile, lower, length):
    """∫ a ds over live intervals (m²) with the digits that times need, from a table where there is one."""
    upper, table = lower + length, integrals(profile).table
    if table is None or not np.all(table.covers([lower.min(), upper.min(), upper.max()])):
        return integrals(profile).radius_integral(LiveInterval.above(lower, length))
    flow = table.area(upper) - table.area(lower)
    # Over these a difference of integrals has too few digits.
    short = length < 1e-4 * upper
    if short.any():
        # Across a kink the difference must do.
        short &= kink_above(profile, lower) == kink_above(profile, upper)
        lower, length = (np.broadcast_to(array, short.shape)[short] for array in (lower, length))
        node, weight = gauss_legendre(2)
        values = table.covered_radius(lower[:, None] + length[:, None] * node)
        flow[short] = length * (values @ weight)
    return flow
