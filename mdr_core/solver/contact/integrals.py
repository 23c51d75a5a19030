"""Integrals over the live interval: each increment of depth is a flat punch of radius a(s).

    radius_integral   ∫ a(s) ds over the depths s in [d_p, d]    force
    energy_integral   ∫ (d − s) a(s) ds                          stored energy
    radius_difference a(d) − a(d_p)                              stiffness while yielding

for arrays of states. They are geometry only: the caller multiplies by the modulus. `pressure` has the
integrals that depend on the radius r. `integrals` chooses closed forms, a table of a(s), or quadrature for
a profile.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache, singledispatch
from typing import Any

import numpy as np

from ..numerics.blocks import LONG, chunks
from ..numerics.gauss import gauss_legendre
from ..profiles.profile import Profile
from ..profiles.radius_table import OneLength, Tabulated
from .live_interval import LiveInterval
from .quadrature import integrate, kink_above, radius, radius_rate

#: Live intervals longer than this share of the depth are integrated as a difference of two integrals from
#: the tip. The energy loses up to two digits. 2000 elastic states of a rounded cone are 10 times as fast,
#: and the depths of 10⁵ impacts 17 times.
_LONG = 0.15
#: Largest number of depths without a table; additional depths for each kink above the end of the table; and
#: depths per kink of the profile from which the table goes to the known depth. Making a table takes as long
#: as 2 to 8 depths per kink: a single call should avoid it, many calls should make it at once. A table to
#: the known depth needs no search for the largest depth, which makes later impacts 1.6 times as fast.
_FEW, _FEW_A_KINK, _MANY_A_KINK = 16, 0.5, 2
#: Numbers of Gauss nodes for shorter intervals, by their length over the distance from the last kink.
#: Forces of 2000 states of a rounded cone are 7 times as fast as by `integrate`.
_SHORT = ((0.03, 4), (0.15, 6), (0.5, 10))


@dataclass(frozen=True)
class Integrals(ABC):
    """Integrals over the live interval under one profile or an ensemble, elementwise.

    A subclass defines the first three functions. The defaults of the others mean: no closed form, no table.
    """

    profile: Any

    #: Whether a(s) is a polynomial of √s from the tip, so that quadrature needs no cuts.
    polynomial = False

    #: A profile of the family, if the contact time over d_max/v₀ is the same function of d_p/d_c for all of
    #: them, under the hardness q_c/a.
    similar = None

    #: Exponent p of the elastic force F ∝ dᵖ.
    elastic_exponent = None

    #: `RadiusTable` of the unit profile.
    table = None

    @abstractmethod
    def radius_integral(self, interval):
        """Return ∫ a(s) ds (m²)."""

    @abstractmethod
    def energy_integral(self, interval):
        """Return ∫ (d − s) a(s) ds (m³)."""

    @abstractmethod
    def radius_difference(self, interval):
        """Return a(d) − a(d_p) (m), the width of the elastic ring if the medium has yielded."""

    def radius_and_energy(self, interval):
        """Return `radius_integral` and `energy_integral`; from a table both cost as much as one."""
        return self.radius_integral(interval), self.energy_integral(interval)

    def pressure_integral(self, interval, r):
        """Return ∫ ds/√(a(s)² − r²) over a(s) > r, for one state and radii r ≥ 0 (m)."""
        return None

    def turning_interval(self, target, d_c):
        """Return the live interval at the turning point of an impact, on a virgin medium with d_c (m).

        `target` is the kinetic energy over 2E* (m³).
        """
        return None

    @property
    def unit(self):
        """The unit profile, a length L and a depth H (m): g(x) is H times g(x/L) of the unit profile."""
        return self.profile, 1.0, 1.0

    @property
    def convex(self):
        """Whether g(x)/x never falls; this holds for every convex shape."""
        if self.elastic_exponent is not None:
            # g ∝ xⁿ, with F ∝ d^(1 + 1/n).
            return bool(np.all(self.elastic_exponent <= 2))
        unit = self.unit[0]
        # An ensemble of a user's dataclass is not hashable.
        return (_growing_mean_slope.__wrapped__ if unit.shape else _growing_mean_slope)(unit)


# The cache makes single states of a sampled tip on a medium with a hardness H 19 times as fast.
@lru_cache(maxsize=64)
def _growing_mean_slope(profile):
    """Whether g(x)/x never falls between 10⁻¹² and 10³ m, within the known radius of the profile."""
    last = profile.known_radius
    if np.all(np.isfinite(profile.known_depth)):
        # Beyond this radius g may have no value at all.
        last = np.minimum(last, profile.radius_at(np.asarray(profile.known_depth)))
    for place in np.geomspace(1e-12, 1e3, 256):
        x = np.minimum(np.full(profile.shape, place), last)
        # Radii may be far beyond any contact; there the comparison is false, or has a NaN.
        with np.errstate(all="ignore"):
            falls = np.any(x * profile.reduced_slope_at(x) < profile.reduced_at(x) * (1 - 1e-9))
        if falls:
            return False
    return True


@singledispatch
def integrals(profile: Profile) -> Integrals:
    """Return the `Integrals` of a profile: closed forms or a table if registered for its class."""
    return QuadratureIntegrals(profile)


@dataclass(frozen=True)
class QuadratureIntegrals(Integrals):
    """Integrals of any profile by quadrature."""

    def radius_integral(self, interval):
        return integrate(self.profile, interval, radius, moment=0)

    def energy_integral(self, interval):
        return integrate(self.profile, interval, radius, moment=1)

    def radius_difference(self, interval):
        a, c = self.profile.radius_at(interval.upper), self.profile.radius_at(interval.lower)
        narrow = interval.length < 1e-2 * interval.upper
        if not np.any(narrow):
            return a - c
        # ∫ da, because the difference of the radii has few digits in a short interval. At the very tip it
        # has all digits, and the rate may be infinite.
        with np.errstate(invalid="ignore"):
            return np.where(narrow, integrate(self.profile, interval, radius_rate, moment=0), a - c)


@integrals.register(OneLength)
@integrals.register(Tabulated)
@dataclass(frozen=True)
class TableIntegrals(Integrals):
    """Integrals of profiles with a table of their contact radius."""

    @property
    def unit(self):
        return self.profile.unit

    @property
    def table(self):
        return self.profile.table

    def radius_integral(self, interval):
        return self._from_table(interval, 1)[0]

    def energy_integral(self, interval):
        return self._from_table(interval, 2)[1]

    def radius_and_energy(self, interval):
        return self._from_table(interval, 2)

    def radius_difference(self, interval):
        unit, length, depth = self.unit
        return length * QuadratureIntegrals(unit).radius_difference(interval.in_units_of(depth))

    def _from_table(self, interval, moments):
        """Return ∫ (d − s)^k a(s) ds for k below `moments` (1 or 2), from the table of the unit profile."""
        unit, *scales = self.unit
        shape = np.shape(interval.length)
        ends = [np.ravel(end) for end in (interval.lower, interval.upper, interval.length)]
        if self.profile.shape:
            scales = [np.broadcast_to(scale, shape).ravel() for scale in scales]
        result = np.empty((moments, ends[0].size))
        for rows in chunks(result.shape[1], LONG):
            length, depth = (scale[rows] for scale in scales) if self.profile.shape else scales
            lower, upper, live_depth = (end[rows] / depth for end in ends)
            # Ascending order: a search in the table is several times as fast next to the previous one.
            order, block = np.argsort(upper), result[:, rows]
            block[:, order] = _table_integrals(unit, lower[order], upper[order], live_depth[order], moments)
            block *= length * depth ** np.arange(1, moments + 1)[:, None]
        return result.reshape(moments, *shape)


def _table_integrals(profile, lower, upper, length, moments):
    """Return ∫ (d − s)^k a(s) ds of one profile for k below `moments`, from its table and flat arrays.

    Long intervals are differences. Short intervals use a few nodes if no kink is near, else `integrate`.
    """
    covered = profile.table.covers(lower) & profile.table.covers(upper)
    far = covered & (length >= _LONG * upper)
    if far.all():
        return _differences(profile.table, lower, upper, length, moments)
    result = np.empty((moments, length.size))
    if far.any():
        result[:, far] = _differences(profile.table, lower[far], upper[far], length[far], moments)
    kink, near = kink_above(profile, lower), covered & ~far
    distance = np.where(kink == kink_above(profile, upper), upper - kink, 0.0)
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
            result[k, rows] = integrate(profile, interval, radius, moment=k)
    return result


def _differences(table, lower, upper, length, moments):
    """Return `_table_integrals` over long intervals."""
    result = np.array([integral(upper) for integral in (table.area, table.volume)[:moments]])
    # Both integrals are 0 at the tip, where elastic intervals start.
    if lower.any():
        area = table.area(lower)
        result[0] -= area
        if moments > 1:
            result[1] -= table.volume(lower)
            result[1] -= length * area
    return result


def tabulated_for(profile, count, largest_depth):
    """Return the profile for searches of `count` depths, with a table if there are many.

    The table ends at the known depth, or at `largest_depth()`, about the largest of the depths (m). Making
    it takes longer if more kinks are above its end.
    """
    slow = not profile.shape and isinstance(integrals(profile), QuadratureIntegrals)
    if count <= _FEW or not slow or profile.known_depth == np.inf:
        return profile
    kinks = len(profile.kinks)
    # Without kinks the known depth may be many powers of ten away, and a table to it would be long.
    if kinks and profile.known_radius < np.inf and count > _MANY_A_KINK * kinks:
        return tabulated(profile, profile.known_depth)
    end = _end_of_table(profile, largest_depth())
    if count <= _FEW + _FEW_A_KINK * np.searchsorted(profile.kinks, end):
        return profile
    return tabulated(profile, end)


def tabulated(profile, known_depth):
    """Return a profile with a fast contact radius and fast integrals, down to a depth (m) or to its end.

    Ensembles and profiles with closed forms or a table are returned unchanged. Without depths, any profile
    is returned unchanged.
    """
    if profile.shape or not np.size(known_depth) or not isinstance(integrals(profile), QuadratureIntegrals):
        return profile
    return _tabulated(profile, _end_of_table(profile, known_depth))


def _end_of_table(profile, depth):
    """Return the end (m) of a table for depths (m): a power of 2, so that few tables are made."""
    return float(min(2.0 ** np.ceil(np.log2(np.max(depth))), np.min(profile.known_depth)))


# A table makes the times of 300 impacts of a sampled tip some 300 times as fast, one time and 20 viscous
# impacts 5 times, and impacts of a `Smooth` tip 20 times. Without the cache every call would make it again.
_tabulated = lru_cache(maxsize=16)(Tabulated)
