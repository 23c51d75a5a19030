"""Quadrature over the live interval, for any profile.

It uses the contact radius a(s), the slope g′(x) and the kinks of a profile. At depths much larger than the
critical depth, the interval is much shorter than the depths at its ends. Nodes are therefore depths above
d_p: no integral over a short interval is a difference of two elastic curves.
"""

from functools import lru_cache

import numpy as np

from ..numerics.blocks import chunks
from ..numerics.gauss import gauss_legendre


def radius(profile, depth):
    """Return the contact radius a(s) (m)."""
    return profile.radius_at(depth)


def radius_rate(profile, depth):
    """Return da/ds (dimensionless); 0 at a wall."""
    return growth_at(profile, profile.radius_at(depth))


def growth_at(profile, a):
    """Return da/ds (dimensionless) at contact radii (m); 0 at a wall."""
    with np.errstate(divide="ignore"):
        rate = 1 / profile.reduced_slope_at(a)
    # The slope at the wall itself may be the slope of the tip inside it.
    return np.where(a < profile.wall, rate, 0.0)


def integrate(profile, interval, function, moment):
    """Integrate (d − s)^moment function(s) over the live interval by quadrature, elementwise."""
    shape = np.shape(interval.length)
    lower, upper, length = (np.ravel(end) for end in (interval.lower, interval.upper, interval.length))
    result = np.zeros_like(length)
    # In an ensemble of profiles with kinks, each profile has other cuts.
    single = profile.shape and _has_cuts(profile)
    for rows in chunks(length.size, 1 if single else max(16, 2**16 // (1 + len(profile.kinks)))):
        entries = profile.flat_entries(rows.start if single else rows, shape)
        result[rows] = _sums(entries, lower[rows], upper[rows], length[rows], function, moment)
    return result.reshape(shape)


def _sums(profile, lower, upper, length, function, moment):
    """Integrate for flat arrays, piece by piece; the arguments are as in `integrate`."""
    row, zone, start, stop, offset = pieces(profile, lower, upper, length)
    remainder = length[row] - stop
    # A piece between two cuts is the same for all states.
    inner, total = np.zeros(row.size, bool), np.empty(row.size)
    inner[1:-1] = (row[2:] == row[:-2]) & _has_cuts(profile)
    if inner.any():
        zeroth, first = _Zones(profile, function)(zone[inner])
        total[inner] = first + remainder[inner] * zeroth if moment else zeroth
    outer = ~inner
    node, weight = nodes(start[outer], stop[outer], offset[outer], gauss_legendre(24))
    values = function(profile.entries((row[outer], None)), lower[row[outer], None] + node)
    # Below the known depth values are infinite.
    with np.errstate(invalid="ignore"):
        values = weight * values
        if moment:
            values *= length[row[outer], None] - node
    total[outer] = values.sum(axis=1)
    return np.bincount(row, total, minlength=length.size)


# The cache makes states of a sampled tip some 16 times as fast one by one, and 1.5 times for 2000 at once.
@lru_cache(maxsize=64)
class _Zones:
    """∫ function(s) ds and ∫ (s₁ − s) function(s) ds over zones between two cuts, s₁ the deeper cut.

    Each zone is integrated at its first use. Zones outside the deepest contact are never used; they would
    be slow, because a radius of a polygon takes longer the farther out it is.
    """

    def __init__(self, profile, function):
        self._profile, self._function = profile, function
        self._cuts, self._origins = _cuts(profile)
        self._integrals = np.full((2, len(self._origins)), np.nan)

    def __call__(self, zone):
        """Return both integrals over zones, shape (2, N); zone i ends at cut i."""
        new = np.unique(zone[np.isnan(self._integrals[0, zone])])
        if new.size:
            lower = self._cuts[new - 1]
            width = self._cuts[new] - lower
            node, weight = nodes(
                np.zeros_like(width), width, lower - self._origins[new], gauss_legendre(24)
            )
            values = weight * self._function(self._profile, lower[:, None] + node)
            self._integrals[0, new] = values.sum(axis=1)
            self._integrals[1, new] = (values * (width[:, None] - node)).sum(axis=1)
        return self._integrals[:, zone]


def kink_above(profile, depth):
    """Return the depth (m) of the last kink above each depth (m), 0 for the tip."""
    if profile.shape:
        above = np.zeros_like(depth)
        for kink in profile.kinks:
            above = np.where(kink <= depth, kink, above)
        return above
    kinks = np.array([0.0, *profile.kinks])
    return kinks[np.searchsorted(kinks, depth, side="right") - 1]


def pieces(profile, lower, upper, length):
    """Cut live intervals where a(s) is not smooth.

    Returns
    -------
    row, zone : ndarray, shape (P,)
        Number of the state of each piece, and number of its zone between cuts.
    start, stop : ndarray, shape (P,)
        Ends of the piece as depths above d_p (m), free of the rounding of the depths.
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
    """Return the nodes of a rule on [0, 1] in pieces, as depths above d_p (m), and their weights (m).

    Below a kink at the depth f, the contact radius may grow as a root, as a power with thirds, or linearly.
    In each case it is smooth in σ = (s − f)^(1/4), so that the nodes are even in σ.
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
    """Return the depths (m) of the cuts, and for each zone the depth (m) of the kink or tip above it.

    If the depths at which the profile changes are not known, both are shares of the largest depth.
    """
    if not _has_cuts(profile):
        return 1e-2 ** np.arange(4, 0, -1.0), np.zeros(5)
    kinks = np.array(profile.kinks, dtype=float)
    origins = np.append(0.0, kinks)
    # At twice the depth of a kink, a(s) changes to another power.
    transitions = origins + np.maximum(origins, profile.transition_depth or 0.0)
    transitions = transitions[(transitions > 0) & (transitions < np.append(kinks, np.inf))]
    cuts = np.unique(np.concatenate([kinks, transitions]))
    return cuts, origins[np.searchsorted(kinks, np.append(0.0, cuts), side="right")]
