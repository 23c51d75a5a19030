"""Contact time of a dry impact: quadrature of dd/v, without time stepping."""

from functools import lru_cache, partial

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from ..contact.integrals import integrals, tabulated
from ..contact.live_interval import LiveInterval
from ..contact.quadrature import kink_above
from ..numerics.blocks import chunks
from ..numerics.gauss import gauss_integrals, gauss_legendre
from ..numerics.stable import cube_rise, cube_way

#: Depths between pieces, where a(s) changes from one power of the depth to another, in units of the
#: transition depth.
TRANSITIONS = np.array([1.0, 6.0])


def contact_time(rule, inertia, speed, interval, increase):
    """Time (s) from first contact to its loss, elementwise.

    From the `YieldRule`, inertia m/(2E*) (m s²), speed v₀ (m/s), and, of full shape, the live interval at
    the turning point and the increase (m) of the plastic depth.
    """
    shape, profile = np.shape(interval.upper), rule.profile
    factor = np.broadcast_to(np.sqrt(inertia / 2), shape).ravel()
    lower, upper, length, increase = map(
        np.ravel, (interval.lower, interval.upper, interval.length, increase)
    )
    passage = np.broadcast_to(upper.reshape(shape) / speed, shape).ravel()
    virgin = increase == lower
    exponent, similar = integrals(profile).elastic_exponent, rule.similar
    elastic = virgin & (lower == 0) & (exponent is not None)
    by_ratio = virgin & (lower > 0) & (similar is not None)
    time = np.empty(upper.shape)
    if elastic.any():
        ratio = np.broadcast_to(elastic_time(exponent), shape).ravel()
        time[elastic] = ratio[elastic] * passage[elastic]
    if by_ratio.any():
        ratio = _similar_time(type(rule), similar, lower[by_ratio] / length[by_ratio])
        time[by_ratio] = ratio * passage[by_ratio]
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
        own = rule.flat_entries(rows, shape)
        own = own.in_units_of(unit.flat_entries(rows, shape), root[rows] ** 2, depth[rows])
        ratio = time_over_root(own, turning, increase[rows] / depth[rows])
        time[rows] = ratio / root[rows] * factor[rows]
        start = stop
    return time.reshape(shape)[()]


def elastic_time(p):
    """Contact time over d_max/v₀ of an elastic impact with F ∝ dᵖ: 2.9433 for p = 3/2 (Hertz)."""
    q, gamma = 1 / (p + 1), scipy.special.gamma
    return 2 * np.sqrt(np.pi) * gamma(1 + q) / gamma(0.5 + q)


def _similar_time(kind, profile, ratio):
    """Contact time over d_max/v₀ of profiles similar to this one, as a function of d_p/ℓ > 0.

    `kind` is the class of the rule of yield, and ℓ the live depth at the turning point, d_c for q_c/a.
    """
    result = np.empty_like(ratio)
    for rows in chunks(ratio.size):
        # A series in √(d_p/ℓ) at the onset of yield, in its inverse where d_p ≫ ℓ.
        root = np.sqrt(ratio[rows])
        result[rows] = chebyshev.chebval(2 * (root / (1 + root)) - 1, _table(kind, profile))
    return result


@lru_cache
def _table(kind, profile):
    """Chebyshev coefficients of `_similar_time` in 2v − 1, with v = √X/(1 + √X) and X = d_p/ℓ."""

    def time(place):
        return _ratio(*kind.at_ratio(profile, ((1 + place) / (1 - place)) ** 2))

    return chebyshev.chebtrim(chebyshev.chebinterpolate(time, 71), 1e-15)


def _ratio(rule, interval):
    """Contact time over d_max/v₀ of impacts on a virgin medium, from the live intervals at the end."""
    plastic = rule.plastic_integral(0 * interval.lower, interval.lower)
    energy = integrals(rule.profile).energy_integral(interval) + plastic
    return time_over_root(rule, interval, interval.lower) * np.sqrt(energy) / interval.upper


def time_over_root(rule, interval, increase):
    """∫ ds/√(∫∫ a ds ds) over unloading and loading (m^(−1/2)), one impact a row.

    The kinetic energy is 2E* times the inner integral, which is the work up to the turning point.
    Unloading is one stretch of depth, loading two: past the onset both ends of the live interval move. In
    each piece of a stretch the work is integrated from the turning point back, so that it never cancels.
    """
    profile, count = rule.profile, len(increase)
    lower, length, increase = interval.lower[:, None], interval.length[:, None], increase[:, None]
    before, stretch = lower - increase, partial(_stretch, profile)
    column = rule.entries((slice(None), None), (count,))
    onset = np.where(increase > 0, column.penetration(before, before), length)
    kinks = np.column_stack(profile.kinks) if profile.kinks else np.empty((1, 0))
    kinks = kinks[:, (kinks < interval.upper.max()).any(axis=0)]
    breaks = np.empty((1, 0))
    if profile.transition_depth is not None:
        breaks = np.atleast_2d(np.multiply.outer(profile.transition_depth, TRANSITIONS))
    first = kink_above(profile, lower[:, 0])[:, None] - lower
    time, _ = stretch(lambda s, rows: (lower[rows], s), first, length, kinks - lower, breaks - lower)

    def yielding(s, rows):
        own = rule.entries((rows[:, None],), (count,)).past_onset(before[rows], onset[rows], s)
        return own.lower, own.length

    # Loading past the onset: depths from there at which the lower end of the live interval is at a kink,
    # and at which the upper end is.
    passed = column.penetration(kinks, before) - onset if kinks.size else kinks - before
    both = np.hstack([passed, kinks - before - onset])
    all_breaks = np.hstack([breaks - before, rule.scales * onset])
    first = kink_above(profile, before[:, 0])[:, None]
    start = column.penetration(first, before) - onset
    span = increase + (length - onset)
    time_below, work = stretch(yielding, start, span, both, all_breaks)
    # Loading down to it, and about the further distance to rest if nothing yielded.
    force = _flow(profile, before[:, 0], onset[:, 0])
    a = profile._radius(before[:, 0] + onset[:, 0])
    total = force + np.sqrt(force**2 + 2 * a * work)
    # Under a sharp tip that yields from first touch on there is none of it.
    distance = (2 * work / np.where(total > 0, total, np.inf))[:, None]
    elastic = partial(stretch, lambda s, rows: (before[rows], s), first - before, onset)
    time_above, _ = elastic(kinks - before, breaks - before, distance, work)
    return time + time_below + time_above


def _stretch(profile, interval_at, first, length, kinks, breaks, distance=0.0, work=0.0):
    """∫ ds/√W over a stretch of depth, and the work W from its start on.

    `interval_at` gives the lower end and the length of the live interval at depths from the start; `first`
    is the depth from there, not positive, at which a(s) starts as a root; pieces end at depths `kinks` from
    there, (N, K), where the force has a kink, and at `breaks`. At the end of the stretch `work` remains,
    and the `distance` (m) to the turning point.
    """
    edges, origins = _edges(first, length, kinks, breaks)
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
            depth, rate = places(at - origin[subset, None], *sizes, node)
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


def _edges(first, length, kinks, breaks):
    """Depths between pieces of stretches, ascending, and for each piece where a(s) starts as a root."""
    cuts = np.hstack([kinks, np.broadcast_to(breaks, (len(length), breaks.shape[1]))])
    cuts = np.clip(cuts, 0.0, length)
    order = np.argsort(cuts, axis=1)
    cuts = np.take_along_axis(cuts, order, axis=1)
    roots = np.where((order < kinks.shape[1]) & (cuts > 0), cuts, -np.inf)
    return np.hstack([0 * length, cuts, length]), np.maximum.accumulate(np.hstack([first, roots]), axis=1)


def places(offset, size, remainder, node):
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
