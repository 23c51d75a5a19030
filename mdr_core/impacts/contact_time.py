"""Contact time of a dry impact: quadrature of dd/v, without time stepping."""

from functools import lru_cache
from typing import NamedTuple

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
#: transition depth. Contact times of five shapes over seven decades of speed then have errors of 5·10⁻¹¹
#: at most, without them 2·10⁻¹⁰: `python -m tests.benchmarks.constants`, which tries other ones, too.
TRANSITIONS = np.array([1.0, 6.0])


def contact_time(rule, inertia, speed, interval, increase):
    """Time (s) from first contact to its loss, elementwise.

    From the `YieldRule`, inertia m/(2E*) (m s²), speed v₀ (m/s), and, of full shape, the live interval at
    the turning point and the increase (m) of the plastic depth.
    """
    exponent, similar = integrals(rule.profile).elastic_exponent, rule.similar
    virgin = increase == interval.lower
    elastic = virgin & (interval.lower == 0) & (exponent is not None)
    yielded = virgin & (interval.lower > 0) & (similar is not None)
    time, passage = np.empty(np.shape(interval.upper)), interval.upper / speed
    if elastic.any():
        time[elastic] = (elastic_time(exponent) * passage)[elastic]
    if yielded.any():
        ratio = interval.lower[yielded] / interval.length[yielded]
        time[yielded] = _similar_time(type(rule), similar, ratio) * passage[yielded]
    others = ~(elastic | yielded)
    if others.any():
        root = np.broadcast_to(np.sqrt(inertia / 2), time.shape)
        time[others] = root[others] * _by_quadrature(rule, interval, increase, others)
    return time[()]


def _by_quadrature(rule, interval, increase, chosen):
    """`time_over_root` (m^(−1/2)) of impacts at a mask `chosen`, in blocks, in units of profiles."""
    shape, numbers = chosen.shape, np.flatnonzero(chosen)
    unit, *scales = integrals(tabulated(rule.profile, interval.upper[chosen].max())).unit
    length, depth = (np.broadcast_to(scale, shape)[chosen] for scale in scales)
    interval, increase = interval[chosen].in_units_of(depth), increase[chosen] / depth
    # In ascending order, impacts that reach few kinks are together.
    order = np.argsort(interval.upper)
    kinks = np.sort([np.min(kink) for kink in unit.kinks])
    passed = np.searchsorted(kinks, interval.upper[order])
    time, start = np.empty(numbers.size), 0
    while start < order.size:
        stop = start + max(32, 2048 // (1 + passed[start]))
        rows = order[start:stop]
        own_unit = unit.flat_entries(numbers[rows], shape)
        own = rule.flat_entries(numbers[rows], shape).in_units_of(own_unit, length[rows], depth[rows])
        time[rows] = time_over_root(own, interval[rows], increase[rows])
        start = stop
    return time / np.sqrt(length)


def elastic_time(p):
    """Contact time over d_max/v₀ of an elastic impact with F ∝ dᵖ: 2.9433 for p = 3/2 (Hertz)."""
    q, gamma = 1 / (p + 1), scipy.special.gamma
    return 2 * np.sqrt(np.pi) * gamma(1 + q) / gamma(0.5 + q)


def _similar_time(kind, profile, ratio):
    """Contact time over d_max/v₀ of profiles similar to this one, as a function of d_p/ℓ > 0.

    `kind` is the class of the rule of yield, and ℓ the live depth at the turning point, d_c for q_c/a.
    """
    # Against `time_over_root` for each impact: 4 times as fast for 300 impacts, 34 times for 10⁵.
    result, coefficients = np.empty_like(ratio), _table(kind, profile)
    for rows in chunks(ratio.size):
        # A series in √(d_p/ℓ) at the onset of yield, in its inverse where d_p ≫ ℓ.
        root = np.sqrt(ratio[rows])
        result[rows] = chebyshev.chebval(2 * (root / (1 + root)) - 1, coefficients)
    return result


# Kept, times of single cones are 4.6 times as fast.
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
    """∫ ds/√W over unloading and loading (m^(−1/2)), one impact a row.

    W = ∫∫ a ds ds (m³) is the work from a depth to the turning point: 2E* W is the kinetic energy there.
    The path has three stretches. With p₀ and p the depths (m) of the bottom of the imprint before and
    after, counted from the undeformed surface, y₀ the penetration into the old imprint at which yield
    starts, and ℓ the live depth at the turning point, the live interval is

        unloading            [p, p + s]            for s from ℓ to 0
        loading past yield   that of the `rule`    for s from 0 to p − p₀ + ℓ − y₀, penetration y₀ + s
        loading before it    [p₀, p₀ + s]          for s from 0 to y₀

    On the second one both ends of the interval move. Where nothing yields y₀ is ℓ, and it has no length.

    Parameters
    ----------
    rule : YieldRule
        The rule, of a profile or of N.
    interval : LiveInterval, shape (N,)
        Live interval at the turning point, [p, p + ℓ].
    increase : ndarray, shape (N,)
        p − p₀ (m).
    """
    profile, count = rule.profile, len(increase)
    column = rule.entries((slice(None), None), (count,))
    new, length, increase = interval.lower[:, None], interval.length[:, None], increase[:, None]
    old = new - increase
    onset = np.where(increase > 0, column.penetration(old, old), length)
    # Depths (m) from the undeformed surface, of shape (1, K) or (N, K).
    kinks = np.column_stack(profile.kinks) if profile.kinks else np.empty((1, 0))
    kinks = kinks[:, (kinks < interval.upper.max()).any(axis=0)]
    transitions = np.empty((1, 0))
    if profile.transition_depth is not None:
        transitions = np.atleast_2d(np.multiply.outer(profile.transition_depth, TRANSITIONS))

    def elastic(bottom, length, distance=0.0, work=0.0):
        """Time over a stretch of the live intervals [bottom, bottom + s], s from 0 to a length (m)."""
        above = kink_above(profile, bottom[:, 0])[:, None]
        cuts = _Cuts(above - bottom, kinks - bottom, transitions - bottom)
        return _stretch(profile, lambda s, rows: (bottom[rows], s), cuts, length, distance, work)[0]

    def past_yield():
        """Time over the second stretch, and the work over it (m³)."""

        def interval_at(s, rows):
            own = rule.entries((rows[:, None],), (count,)).past_onset(old[rows], onset[rows], s)
            return own.lower, own.length

        above = kink_above(profile, old[:, 0])[:, None]
        # The lower end of the interval passes some kinks, the upper end others.
        by_lower = column.penetration(kinks, old) - onset if kinks.size else kinks - old
        by_upper = kinks - old - onset
        cuts = _Cuts(
            root=column.penetration(above, old) - onset,
            kinks=np.hstack([by_lower, by_upper]),
            # At the first ones the lower end is about at a transition.
            smooth=np.hstack([transitions - old, column.breaks(old, increase, onset)]),
        )
        return _stretch(profile, interval_at, cuts, increase + (length - onset))

    time, work = past_yield()
    distance = _distance_to_rest(profile, old[:, 0], onset[:, 0], work)[:, None]
    return elastic(new, length) + time + elastic(old, onset, distance, work)


def _distance_to_rest(profile, bottom, length, work):
    """About the distance (m) over which a contact that does not yield would take up a work over 2E* (m³).

    From the live interval [bottom, bottom + length] on: x at F x + a x²/2 = W, with F = ∫ a ds.
    """
    force = _flow(profile, bottom, length)
    a = profile.radius_at(bottom + length)
    total = force + np.sqrt(force**2 + 2 * a * work)
    # Under a sharp tip that yields from first touch on there is none.
    return 2 * work / np.where(total > 0, total, np.inf)


class _Cuts(NamedTuple):
    """Where a stretch is cut into pieces: depths (m) from its start, of shape (N, K) or (1, K).

    Those outside the stretch cut nothing.
    """

    #: (N, 1), not positive: the last kink or tip above the start, from which a(s) rises as a root.
    root: np.ndarray
    #: Kinks of the force, from each of which a(s) rises as a root.
    kinks: np.ndarray
    #: Where the force is smooth, but turns from one power of the depth into another.
    smooth: np.ndarray


def _stretch(profile, interval_at, cuts, length, distance=0.0, work=0.0):
    """∫ ds/√W over a stretch of depth, shape (N,), and the work W (m³) from its start on.

    All depths s (m) are counted from the start of the stretch. In each piece between cuts the work is
    integrated from its end back, so that next to the turning point it does not cancel.

    Parameters
    ----------
    profile : Profile
        One or N.
    interval_at : callable
        Lower end and length (m) of the live interval at depths s, from an array (P, K) of these and the
        impacts (P,) to which its rows belong.
    cuts : _Cuts
        Ends of pieces.
    length : ndarray, shape (N, 1)
        Length (m) of the stretch.
    distance : ndarray, shape (N, 1)
        About the distance (m) from its end to the turning point.
    work : ndarray, shape (N,)
        W (m³) at its end.
    """
    edges, origins = _edges(cuts, length)
    # One piece an entry: its impact, its number, its start, where a(s) started as a root, its size, and
    # the distance from its end to the turning point.
    rows, k = np.nonzero(np.diff(edges) > 0)
    start, origin = edges[rows, k], origins[rows, k]
    size = edges[rows, k + 1] - start
    remainder = (length - edges[:, 1:] + distance)[rows, k]
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
    # The work over each piece becomes that from its start on.
    works = np.reshape(work, (-1, 1)) + np.cumsum(works[:, ::-1], axis=1)[:, ::-1]
    time = np.zeros(len(length))
    for row, k, rate, within, weight in pieces:
        passage = np.einsum("ij,j", rate / np.sqrt(works[row, k + 1, None] + within), weight)
        time += np.bincount(row, passage, minlength=len(length))
    return time, works[:, 0]


def _edges(cuts, length):
    """Ends (N, K + 1) of the K pieces of stretches, and where a(s) starts as a root before each piece.

    Both are depths (m) from the start of the stretch, the ends ascending from 0 to its length.
    """
    smooth = np.broadcast_to(cuts.smooth, (len(length), cuts.smooth.shape[1]))
    inner = np.clip(np.hstack([cuts.kinks, smooth]), 0.0, length)
    order = np.argsort(inner, axis=1)
    inner = np.take_along_axis(inner, order, axis=1)
    kinks = np.where((order < cuts.kinks.shape[1]) & (inner > 0), inner, -np.inf)
    last_root = np.maximum.accumulate(np.hstack([cuts.root, kinks]), axis=1)
    return np.hstack([0 * length, inner, length]), last_root


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
