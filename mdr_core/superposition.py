"""Integrals over the live interval: each increment of depth is a flat punch of radius a(s).

    radius_integral   ∫ a(s) ds over the depths s in [d_p, d]    force
    energy_integral   ∫ (d − s) a(s) ds                          stored energy
    radius_drop       a(d) − a(d_p)                              stiffness while yielding

for arrays of states; `fields` has the integrals that depend on the radius r. They are geometry only: the
caller multiplies by the modulus. A profile enters by its closed forms, by a table of a(s), or by a(s),
g′(x) and its kinks.

At depths much larger than the critical depth the interval is much shorter than the depths at its ends.
Nodes are therefore counted from d_p, so that no integral over a short interval is a difference of two
elastic curves.
"""

from functools import lru_cache

import numpy as np

from ._numeric import LONG, chunks, gauss_legendre
from .closed_forms import closed_forms
from .live_interval import LiveInterval
from .shapes.tabulated import Tabulated

#: Live intervals longer than this share of the depth are integrated as a difference of two integrals from
#: the tip; the energy loses up to two digits by it.
_LONG = 0.15
#: Numbers of Gauss nodes for shorter ones, by their length over the distance from the last kink.
_SHORT = ((0.03, 4), (0.15, 6), (0.5, 10))


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
        return np.where(narrow, _integrate(profile, interval, radius_rate, moment=0), a - c)


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


def radius_rate(profile, depth):
    """da/ds (dimensionless); 0 at a wall."""
    with np.errstate(divide="ignore"):
        return 1 / profile._reduced_slope(profile._radius(depth))


def _integrate(profile, interval, function, moment):
    """∫ (d − s)^moment function(s) ds over the live interval by quadrature, elementwise."""
    if profile.shape and profile.unit:
        unit, length, depth = profile.unit
        return (
            length * depth ** (moment + 1) * _integrate(unit, interval.in_units_of(depth), function, moment)
        )
    shape = np.shape(interval.length)
    lower, upper, length = (np.ravel(end) for end in (interval.lower, interval.upper, interval.length))
    result = np.zeros_like(length)
    # In an ensemble of profiles with kinks every one has cuts of its own.
    single = profile.shape and _has_cuts(profile)
    for rows in chunks(length.size, 1 if single else max(16, 2**16 // (1 + len(profile.kinks)))):
        entries = profile.flat_entries(rows.start if single else rows, shape)
        result[rows] = _sums(entries, lower[rows], upper[rows], length[rows], function, moment)
    return result.reshape(shape)


def _sums(profile, lower, upper, length, function, moment):
    """`_integrate` over flat arrays, piece by piece."""
    row, zone, start, stop, offset = pieces(profile, lower, upper, length)
    remainder = length[row] - stop
    # A piece between two cuts of one state is the same for all states.
    inner, total = np.zeros(row.size, bool), np.empty(row.size)
    inner[1:-1] = (row[2:] == row[:-2]) & _has_cuts(profile)
    if inner.any():
        zeroth, first = (integral[zone[inner]] for integral in _zone_integrals(profile, function))
        total[inner] = first + remainder[inner] * zeroth if moment else zeroth
    outer = ~inner
    node, weight = nodes(start[outer], stop[outer], offset[outer], gauss_legendre(24))
    values = weight * function(profile.entries((row[outer], None)), lower[row[outer], None] + node)
    if moment:
        values *= length[row[outer], None] - node
    total[outer] = values.sum(axis=1)
    return np.bincount(row, total, minlength=length.size)


@lru_cache(maxsize=64)
def _zone_integrals(profile, function):
    """∫ function(s) ds and ∫ (s₁ − s) function(s) ds over each zone between two cuts, s₁ its upper cut."""
    cuts, origins = _cuts(profile)
    zeroth, first = np.zeros((2, len(origins)))
    lower, width = cuts[:-1], np.diff(cuts)
    node, weight = nodes(np.zeros_like(width), width, lower - origins[1:-1], gauss_legendre(24))
    values = weight * function(profile, lower[:, None] + node)
    zeroth[1:-1] = values.sum(axis=1)
    first[1:-1] = (values * (width[:, None] - node)).sum(axis=1)
    return zeroth, first


def pieces(profile, lower, upper, length):
    """Cut live intervals where a(s) is not smooth.

    Returns
    -------
    row, zone : ndarray, shape (P,)
        Number of the state that each piece belongs to, and number of the zone between cuts that it lies in.
    start, stop : ndarray, shape (P,)
        Ends of the piece as depths above d_p (m), which are free of the rounding of the depths.
    offset : ndarray, shape (P,)
        Depth (m) of its start, counted from the kink above it or from the tip.
    """
    cuts, origins = _cuts(profile)
    unit = np.ones_like(upper) if _has_cuts(profile) else np.where(upper > 0, upper, 1.0)
    first = np.searchsorted(cuts, lower / unit, side="right")
    count = np.maximum(np.searchsorted(cuts, upper / unit) - first, 0) + 1
    row, total = np.repeat(np.arange(len(count)), count), np.cumsum(count)
    zone = first[row] + np.arange(len(row)) - (total - count)[row]
    start = np.clip(np.concatenate([[0.0], cuts])[zone] * unit[row] - lower[row], 0.0, length[row])
    start[total - count] = 0.0
    stop = np.append(start[1:], 0.0)
    stop[total - 1] = length
    rows = stop > start
    row, zone, start, stop = row[rows], zone[rows], start[rows], stop[rows]
    return row, zone, start, stop, np.maximum(lower[row] + start - origins[zone] * unit[row], 0.0)


def nodes(start, stop, offset, rule):
    """Nodes of a rule on [0, 1] in pieces, as depths above d_p (m), and their weights (m).

    From a kink at the depth f on, the contact radius is smooth in σ = (s − f)^(1/4), whether it grows as a
    root, as a power with thirds, or linearly: the nodes are even in σ.
    """
    low, high = (np.sqrt(np.sqrt(depth)) for depth in (offset, offset + (stop - start)))
    # high − low without cancellation.
    width = (stop - start) / ((high * high + low * low) * (high + low))
    low, width, (node, weight) = low[:, None], width[:, None], rule
    step = width * node
    depth = start[:, None] + step * (4 * low**3 + step * (6 * low**2 + step * (4 * low + step)))
    return depth, 4 * width * weight * (low + step) ** 3


def _has_cuts(profile):
    """Whether the depths at which a(s) is not smooth are known."""
    return profile.transition_depth is not None or len(profile.kinks) > 0


def _cuts(profile):
    """Depths (m) at which live intervals are cut, and that of the kink or tip above each zone between them.

    Where the depths at which the profile changes are not known, both are shares of the largest depth.
    """
    if not _has_cuts(profile):
        return 1e-2 ** np.arange(4, 0, -1.0), np.zeros(5)
    kinks = np.array(profile.kinks, dtype=float)
    origins = np.append(0.0, kinks)
    # As far below a kink as the kink is deep, a(s) goes over to another power.
    transitions = origins + np.maximum(origins, profile.transition_depth or 0.0)
    transitions = transitions[(transitions > 0) & (transitions < np.append(kinks, np.inf))]
    cuts = np.unique(np.concatenate([kinks, transitions]))
    return cuts, origins[np.searchsorted(kinks, np.append(0.0, cuts), side="right")]


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
    """∫ (d − s)^k a(s) ds of one profile for k below `moments`, from its table and flat arrays.

    Long intervals as differences, short ones with a few nodes if no kink is near, others by `_integrate`.
    """
    covered = profile.table.covers(lower) & profile.table.covers(upper)
    far = covered & (length >= _LONG * upper)
    if far.all():
        return _differences(profile.table, lower, upper, length, moments)
    result = np.empty((moments, length.size))
    if far.any():
        result[:, far] = _differences(profile.table, lower[far], upper[far], length[far], moments)
    kink, near = profile._kink_above(lower), covered & ~far
    distance = np.where(kink == profile._kink_above(upper), upper - kink, 0.0)
    for share, count in _SHORT:
        rows = np.flatnonzero(near & (length < share * distance))
        if rows.size:
            node, weight = gauss_legendre(count)
            values = profile.table.covered_radius(lower[rows, None] + length[rows, None] * node)
            for k in range(moments):
                mean = np.einsum("ij,j", values, weight * (1 - node) ** k)
                result[k, rows] = mean * length[rows] ** (k + 1)
            near[rows] = False
    rows = np.flatnonzero(near | ~covered)
    if rows.size:
        interval = LiveInterval(lower[rows], upper[rows], length[rows])
        for k in range(moments):
            result[k, rows] = _integrate(profile, interval, _radius, moment=k)
    return result


def _differences(table, lower, upper, length, moments):
    """`_table_integrals` over long intervals."""
    result = np.array([integral(upper) for integral in (table.area, table.volume)[:moments]])
    # Both are 0 at the tip, where elastic intervals start.
    if lower.any():
        area = table.area(lower)
        result[0] -= area
        if moments > 1:
            result[1] -= table.volume(lower)
            result[1] -= length * area
    return result
