"""Integrals over the live interval: each increment of depth is a flat punch of radius a(s).

    radius_integral   ∫ a(s) ds over the depths s in [d_p, d]    force
    energy_integral   ∫ (d − s) a(s) ds                          stored energy
    radius_drop       a(d) − a(d_p)                              stiffness while yielding

for arrays of states; `fields` has those that depend on the radius r. Moduli are the caller's business, here
is geometry only, and of a shape no more is used than its contact radius a(s), g′(x) and its kinks.

Far beyond the critical depth the interval is much shorter than the depths at its ends. Nodes are therefore
depths *beyond d_p*, and closed forms are the interval's length times a positive mean; nothing here is a
difference of two elastic curves.
"""

from functools import lru_cache

import numpy as np

from ._numeric import LONG, chunks, gauss_legendre, increasing_root
from .closed_forms import closed_forms
from .shapes.tabulated import Tabulated
from .yielding import LiveInterval, first_loading

#: Integrals over live intervals that are longer, as a share of the depth, are differences of integrals from
#: the tip, of which the energy loses up to two digits.
_FAR = 0.15
#: Of shorter ones: lengths over the distance from the last kink, and the Gauss nodes that they need.
_NEAR = ((0.03, 4), (0.15, 6), (0.5, 10))


def radius_integral(profile, interval):
    """∫ a(s) ds over the live interval (m²), elementwise."""
    if forms := closed_forms(profile):
        return forms.radius_integral(interval)
    if profile.unit:
        return _from_table(profile, interval, 1)[0]
    return _integrate(profile, interval, _radius, moment=0)


def energy_integral(profile, interval):
    """∫ (d − s) a(s) ds over the live interval (m³), elementwise."""
    if forms := closed_forms(profile):
        return forms.energy_integral(interval)
    if profile.unit:
        return _from_table(profile, interval, 2)[1]
    return _integrate(profile, interval, _radius, moment=1)


def radius_and_energy(profile, interval):
    """`radius_integral` and `energy_integral`, at the cost of one where a table has both."""
    if profile.unit and not closed_forms(profile):
        return _from_table(profile, interval, 2)
    return radius_integral(profile, interval), energy_integral(profile, interval)


def radius_drop(profile, interval):
    """a(d) − a(d_p) (m), elementwise: where the medium has yielded, the width of the elastic ring."""
    if forms := closed_forms(profile):
        return forms.radius_drop(interval)
    if profile.shape and profile.unit:
        unit, length, depth = profile.unit
        return length * radius_drop(unit, interval.in_units_of(depth))
    a, c = profile._radius(interval.upper), profile._radius(interval.lower)
    narrow = interval.length < 1e-2 * interval.upper
    if not np.any(narrow):
        return a - c
    # ∫ da: the difference of the radii has few digits in a short interval. At the very tip, where it has
    # all of them, the rate may be infinite.
    with np.errstate(invalid="ignore"):
        return np.where(narrow, _integrate(profile, interval, _radius_rate, moment=0), a - c)


def tabulated(profile, known_depth):
    """A profile that gives its contact radius and integrals quickly, down to a depth (m) or to its own end.

    Ensembles, and profiles that have closed forms or a table, are returned as they are.
    """
    if profile.shape or profile.unit or closed_forms(profile):
        return profile
    known_depth = min(2.0 ** np.ceil(np.log2(np.max(known_depth))), np.min(profile.known_depth))
    return _tabulated(profile, float(known_depth))


_tabulated = lru_cache(maxsize=16)(Tabulated)


def _radius(profile, depth):
    return profile._radius(depth)


def _radius_rate(profile, depth):
    """da/ds (dimensionless); 0 at a wall."""
    with np.errstate(divide="ignore"):
        return 1 / profile._reduced_slope(profile._radius(depth))


def _integrate(profile, interval, function, moment):
    """∫ (d − s)^moment function(s) ds over the live interval, elementwise."""
    if profile.shape and profile.unit:
        unit, length, depth = profile.unit
        return (
            length * depth ** (moment + 1) * _integrate(unit, interval.in_units_of(depth), function, moment)
        )
    shape = np.shape(interval.length)
    lower, upper, length = (np.ravel(part) for part in (interval.lower, interval.upper, interval.length))
    result = np.zeros_like(length)
    # Shapes that are cut at depths of their own, one by one.
    alone = profile.shape and _is_cut_by_shape(profile)
    for rows in chunks(length.size, 1 if alone else max(16, 2**16 // (1 + len(profile.kinks)))):
        some = profile.flat_entries(rows.start if alone else rows, shape)
        result[rows] = _sums(some, lower[rows], upper[rows], length[rows], function, moment)
    return result.reshape(shape)


def _sums(profile, lower, upper, length, function, moment):
    row, piece, begin, end, start = pieces(profile, lower, upper, length)
    above = length[row] - end
    # What lies between two cuts of one state is the same for all states.
    inner, total = np.zeros(row.size, bool), np.empty(row.size)
    inner[1:-1] = (row[2:] == row[:-2]) & _is_cut_by_shape(profile)
    if inner.any():
        zeroth, first = (zone[piece[inner]] for zone in _whole_zones(profile, function))
        total[inner] = first + above[inner] * zeroth if moment else zeroth
    cut = ~inner
    beyond, weight = nodes(begin[cut], end[cut], start[cut], gauss_legendre(24))
    values = weight * function(profile.entries((row[cut], None)), lower[row[cut], None] + beyond)
    if moment:
        values *= length[row[cut], None] - beyond
    total[cut] = values.sum(axis=1)
    return np.bincount(row, total, minlength=length.size)


@lru_cache(maxsize=64)
def _whole_zones(profile, function):
    """∫ function(s) ds and ∫ (top − s) function(s) ds over every stretch between two cuts, by number."""
    cuts, feet = _cuts(profile)
    zeroth, first = np.zeros((2, len(feet)))
    low, end = cuts[:-1], np.diff(cuts)
    beyond, weight = nodes(np.zeros_like(end), end, low - feet[1:-1], gauss_legendre(24))
    values = weight * function(profile, low[:, None] + beyond)
    zeroth[1:-1] = values.sum(axis=1)
    first[1:-1] = (values * (end[:, None] - beyond)).sum(axis=1)
    return zeroth, first


def pieces(profile, lower, upper, length):
    """Live intervals cut where a(s) is not smooth.

    Returns
    -------
    row, piece : ndarray, shape (P,)
        State that each piece belongs to, and the number of the stretch between cuts that it lies in.
    begin, end : ndarray, shape (P,)
        Its ends as depths beyond d_p (m), which do not feel the rounding of the depths.
    start : ndarray, shape (P,)
        Depth (m) of its beginning beyond the kink that it lies behind, or beyond the tip.
    """
    cuts, feet = _cuts(profile)
    unit = np.ones_like(upper) if _is_cut_by_shape(profile) else np.where(upper > 0, upper, 1.0)
    first = np.searchsorted(cuts, lower / unit, side="right")
    count = np.maximum(np.searchsorted(cuts, upper / unit) - first, 0) + 1
    row, behind = np.repeat(np.arange(len(count)), count), np.cumsum(count)
    piece = first[row] + np.arange(len(row)) - (behind - count)[row]
    ends = np.concatenate([[0.0], cuts])[piece] * unit[row] - lower[row]
    begin = np.clip(ends, 0.0, length[row])
    begin[behind - count] = 0.0
    end = np.append(begin[1:], 0.0)
    end[behind - 1] = length
    kept = end > begin
    row, piece, begin, end = row[kept], piece[kept], begin[kept], end[kept]
    return row, piece, begin, end, np.maximum(lower[row] + begin - feet[piece] * unit[row], 0.0)


def nodes(begin, end, start, rule):
    """Nodes in pieces as depths beyond d_p (m), and their weights (m).

    Behind a kink at the depth f the contact radius is smooth in σ = (s − f)^(1/4), whether it begins as a
    root, as a third of a power, or straight: there the nodes of a rule on [0, 1] stand.
    """
    low, high = (np.sqrt(np.sqrt(part)) for part in (start, start + (end - begin)))
    rise = (end - begin) / ((high * high + low * low) * (high + low))
    low, rise, (node, share) = low[:, None], rise[:, None], rule
    way = rise * node
    beyond = begin[:, None] + way * (4 * low**3 + way * (6 * low**2 + way * (4 * low + way)))
    return beyond, 4 * rise * share * (low + way) ** 3


def _is_cut_by_shape(profile):
    return profile.scale is not None or len(profile.kinks) > 0


def _cuts(profile):
    """Depths (m) at which live intervals are cut, and the kinks (or tip) behind which the pieces lie.

    Where it is not known at which depths the shape changes, shares of the largest depth.
    """
    if not _is_cut_by_shape(profile):
        return 1e-2 ** np.arange(4, 0, -1.0), np.zeros(5)
    kinks = np.array(profile.kinks, dtype=float)
    feet = np.append(0.0, kinks)
    # Beyond a kink by as much as the depth there, a(s) goes over to another power.
    over = feet + np.maximum(feet, profile.scale or 0.0)
    over = over[(over > 0) & (over < np.append(kinks, np.inf))]
    cuts = np.unique(np.concatenate([kinks, over]))
    return cuts, feet[np.searchsorted(kinks, np.append(0.0, cuts), side="right")]


def _from_table(profile, interval, moments):
    """∫ (d − s)^k a(s) ds for k below `moments` (1 or 2), from the table of the unit profile."""
    unit, *scales = profile.unit
    shape = np.shape(interval.length)
    ends = [np.ravel(end) for end in (interval.lower, interval.upper, interval.length)]
    if profile.shape:
        scales = [np.broadcast_to(scale, shape).ravel() for scale in scales]
    result = np.empty((moments, ends[0].size))
    for rows in chunks(result.shape[1], LONG):
        length, depth = (scale[rows] for scale in scales) if profile.shape else scales
        lower, upper, live_depth = (end[rows] / depth for end in ends)
        # In ascending order: a search in the table is several times as fast next to the last one.
        order, block = np.argsort(upper), result[:, rows]
        block[:, order] = _table_integrals(unit, lower[order], upper[order], live_depth[order], moments)
        block *= length * depth ** np.arange(1, moments + 1)[:, None]
    return result.reshape(moments, *shape)


def _table_integrals(profile, lower, upper, length, moments):
    """∫ (d − s)^k a(s) ds of one profile, k below `moments`: differences, where these have digits.

    In short intervals, where they have not, a few nodes in depth do, if no kink is near; otherwise
    `_integrate` resolves them.
    """
    covered = profile.table.covers(lower) & profile.table.covers(upper)
    far = covered & (length >= _FAR * upper)
    if far.all():
        return _differences(profile.table, lower, upper, length, moments)
    result = np.empty((moments, length.size))
    if far.any():
        result[:, far] = _differences(profile.table, lower[far], upper[far], length[far], moments)
    kink, near = profile._kink_above(lower), covered & ~far
    free = np.where(kink == profile._kink_above(upper), upper - kink, 0.0)
    for share, count in _NEAR:
        rows = np.flatnonzero(near & (length < share * free))
        if rows.size:
            node, weight = gauss_legendre(count)
            values = profile.table.covered_radius(lower[rows, None] + length[rows, None] * node)
            for k in range(moments):
                mean = np.einsum("ij,j", values, weight * (1 - node) ** k)
                result[k, rows] = mean * length[rows] ** (k + 1)
            near[rows] = False
    rows = np.flatnonzero(near | ~covered)
    if rows.size:
        state = LiveInterval(lower[rows], upper[rows], length[rows])
        for k in range(moments):
            result[k, rows] = _integrate(profile, state, _radius, moment=k)
    return result


def _differences(table, lower, upper, length, moments):
    """`_table_integrals` over live intervals that are long enough for differences of integrals."""
    low, high = table.area(lower), table.area(upper)
    if moments == 1:
        return (high - low)[None]
    return np.array([high - low, table.volume(upper) - table.volume(lower) - length * low])


def loading_depth(profile, critical_depth, area):
    """Depth (m) at which a first loading has ∫ a ds = `area` (m²), elementwise."""

    def loading(depth):
        interval = first_loading(depth, critical_depth)
        ring = np.where(interval.lower > 0, radius_drop(profile, interval), profile._radius(depth))
        return radius_integral(profile, interval), ring

    start = critical_depth if critical_depth < np.inf else 1.0
    return increasing_root(loading, area, start, profile.known_depth)


def live_length(profile, front, area):
    """Live depth (m) with ∫ a ds = `area` (m²) after unloading from the live interval `front`."""

    def unloading(length):
        length = np.minimum(length, front.length)
        interval = LiveInterval(front.lower, front.lower + length, length)
        return radius_integral(profile, interval), profile._radius(interval.upper)

    longest = np.where(front.length > 0, front.length, 1.0)
    return np.minimum(increasing_root(unloading, area, longest, longest), front.length)
