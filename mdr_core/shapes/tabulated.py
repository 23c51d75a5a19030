"""The contact radius of a shape and its integrals over the depth, as piecewise polynomials.

What a million impacts ask for is a(s), ∫ a ds and ∫∫ a ds ds: functions of one variable for all shapes that
have one length of their own, made once for the class (`OneLength`), or for one tip (`tabulated`).
"""

from abc import abstractmethod
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache

import numpy as np

from .. import _check
from .._numeric import increasing_root
from .power import Cone, FlatPunch, Paraboloid, PowerLaw
from .profile import Profile

#: Panels in an octave and coefficients of a panel: of tables made once for a class, and of single tips,
#: whose making counts.
_FINE, _CHEAP = (16, 8), (1, 18)
#: A panel resolves a(s) whose last coefficients are so much smaller than a(s).
_RESOLVED = 1e-14
#: Tables for a class reach so many octaves to both sides of the unit of depth.
_OCTAVES = 100


class RadiusTable:
    """Contact radius a(s) (m) of one indenter, ∫ a ds (m²) and ∫∫ a ds ds (m³) from the tip on.

    1. Kinks cut the depths into zones. The way into a zone is counted as a share of its width, and each
       octave of this share is cut into equal panels: so a fractional power of it is resolved everywhere.
    2. There are as many octaves as it takes for a(s) to be smooth down to the beginning of the zone; one
       panel is left there.
    3. In each panel a(s) is the polynomial through Chebyshev points; its integrals are polynomials too,
       that begin with what has been gathered before.
    """

    def __init__(self, radius, feet, end, rule=_CHEAP, octaves=None):
        """From a function a(s) of arrays, the depths of tip and kinks, and the last depth (m)."""
        self._per, count = rule
        self._feet = np.array(feet, dtype=float)
        self._width = np.append(self._feet[1:], end) - self._feet
        places = np.cos(np.pi * (np.arange(count) + 0.5) / count)

        def values(zone, low, high):
            share = low + (high - low) * (1 + places) / 2
            return radius(self._feet[zone, None] + self._width[zone, None] * share)

        self._octaves, rough = (
            (np.array(octaves), [0]) if octaves else _octaves(values, self._feet.size, count)
        )
        # Panels below the first octave, of all that doubles have.
        self._below = (1023 - self._octaves) * self._per - 1
        self._shift, self._end = 53 - self._per.bit_length(), end
        self._least = self._width[0] * 0.5 ** self._octaves[0] if 0 in rough else 0.0
        edges = [_edges(each, self._per) for each in self._octaves]
        low, high = (np.concatenate([each[part] for each in edges]) for part in (np.s_[:-1], np.s_[1:]))
        zone = np.repeat(np.arange(len(edges)), [each.size - 1 for each in edges])
        self._begin = np.searchsorted(zone, np.arange(len(edges)))
        self._count = np.bincount(zone)
        # Powers of what lies between −1/2 and 1/2, so that large coefficients do not cancel.
        powers = np.linalg.solve(np.vander(places / 2), values(zone, low[:, None], high[:, None]).T)
        self._middle, self._per_share = (low + high) / 2, 1 / (high - low)
        area = _integral(powers, (high - low) * self._width[zone])
        self._polynomials = powers, area, _integral(area, (high - low) * self._width[zone])

    def radius(self, depth):
        """a(s) (m) at depths (m)."""
        return self._values(depth, 0)[0]

    def integrals(self, depth, count=2):
        """∫ a ds (m²), and ∫∫ a ds ds (m³) if two are asked for, from the tip to depths (m)."""
        return self._values(depth, *range(1, count + 1))

    def depth_about(self, integral, value):
        """Depth (m) at which ∫ a ds (`integral` 1) or ∫∫ a ds ds (2) has a value, to some 10⁻⁴.

        With the power of the depth that the integral goes as there.
        """
        start, step, places = self._inverses[integral - 1]
        place = np.clip((np.log(value) - start) / step, 0, len(places) - 1.001)
        cell = place.astype(np.intp)
        low = places.take(cell)
        rise = places.take(cell + 1) - low
        return np.exp(low + (place - cell) * rise), step / rise

    @cached_property
    def _inverses(self):
        """ln s at even steps of the logarithm of each integral: where they begin, the step, values."""
        share = self._middle + np.linspace(-0.375, 0.375, 4)[:, None] / self._per_share
        zone = np.repeat(np.arange(self._feet.size), self._count)
        depth = np.sort((self._feet[zone] + self._width[zone] * share).ravel())
        depth = depth[depth >= self._least]
        inverses = []
        for values in self.integrals(depth):
            even = np.linspace(*np.log(values[[0, -1]]), 2**14)
            inverses.append((even[0], even[1] - even[0], np.interp(even, np.log(values), np.log(depth))))
        return inverses

    def covers(self, depth):
        """Whether the table goes to depths (m): above a tip that is a fractional power octaves end."""
        depth = np.asarray(depth)
        return ((depth >= self._least) | (depth == 0)) & (depth <= self._end)

    def foot(self, depth):
        """The last kink (m) above each depth, or the tip."""
        return self._feet.take(self._zone(depth))

    def _zone(self, depth):
        # One or two zones are what nearly all shapes have.
        if self._feet.size < 3:
            return np.asarray(depth >= self._feet[-1], dtype=int) * (self._feet.size - 1)
        return np.searchsorted(self._feet, depth, side="right") - 1

    def _values(self, depth, *which):
        zone = self._zone(depth) if self._feet.size > 1 else 0
        share = (depth - self._feet[zone]) / self._width[zone]
        # The exponent of a double and the first bits of its mantissa are the number of the panel.
        panel = (share.view(np.int64) >> self._shift) - self._below[zone]
        panel = np.minimum(np.maximum(panel, 0), self._count[zone] - 1) + self._begin[zone]
        x = (share - self._middle.take(panel)) * self._per_share.take(panel)
        return [_horner(self._polynomials[each], panel, x) for each in which]


def _octaves(values, zones, count):
    """Octaves of each zone, by halving the first panel until it is resolved."""
    to_series = np.linalg.inv(
        np.polynomial.chebyshev.chebvander(np.cos(np.pi * (np.arange(count) + 0.5) / count), count - 1)
    )
    octaves, rough = np.zeros(zones, int), np.arange(zones)
    for tried in (0, 4, 8, 10, 12, 14, 16, 20, 24, 32, 64):
        octaves[rough] = tried
        first = values(rough, 0.0, 0.5**tried)
        last = np.abs(first @ to_series[-2:].T).max(axis=1)
        # At a sharp tip a(s) is as small as it is, elsewhere rounding is that of the largest.
        size = first.min(axis=1) + np.where(rough > 0, first.max(axis=1) / 10, 0.0)
        rough = rough[last > _RESOLVED * size]
        if not rough.size:
            break
    return octaves, rough


def _edges(octaves, per):
    """Edges of the panels of a zone, as shares of its width."""
    inner = np.ldexp(1 + np.arange(per) / per, np.arange(-octaves, 0)[:, None]).ravel()
    return np.array([0.0, *inner, 1.0])


def _integral(powers, width):
    """Polynomials that are integrals of others from the first panel on: coefficients by panel."""
    count = len(powers)
    rise = np.vstack([powers * (width / np.arange(count, 0, -1.0)[:, None]), np.zeros_like(width)])
    low, high = (np.polyval(rise, x) for x in (-0.5, 0.5))
    rise[-1] = np.append(0.0, np.cumsum(high - low)[:-1]) - low
    return rise


def _horner(coefficients, panel, x):
    value = coefficients[0].take(panel)
    for row in coefficients[1:]:
        value *= x
        value += row.take(panel)
    return value


class OneLength(Profile):
    """A shape with one length L of its own: z = H Z(r/L), g = H G(x/L), one function for all of them.

    A subclass gives `_length` and `_depth` (L and H, m), and Z, G and G′ as functions of u = r/L, for
    arrays. The inverse of G comes from a table, made once for the class.
    """

    _length: float
    _depth: float

    #: Where G begins to grow, 0, or 1 behind a flat face; and where it ends.
    _edge, _end = 0.0, np.inf

    def __post_init__(self):
        # A parameter is a slope, or a length.
        units = {field.name: "" if field.name == "slope" else "m" for field in fields(self)}
        _check.set_positive(self, **units)

    @staticmethod
    @abstractmethod
    def _Z(u): ...

    @staticmethod
    @abstractmethod
    def _G(u): ...

    @staticmethod
    @abstractmethod
    def _G_slope(u): ...

    face_radius = property(lambda self: self._edge * self._length)
    scale = property(lambda self: self._depth)

    @cached_property
    def unit(self):
        return _unit(type(self)), self._length, self._depth

    @property
    def table(self):
        """The `RadiusTable` of the unit shape."""
        return _unit_table(type(self))

    def _height(self, r):
        return self._depth * self._Z(r / self._length)

    def _reduced(self, x):
        return self._depth * self._G(x / self._length)

    def _reduced_slope(self, x):
        u = x / self._length
        # What is beyond an edge is so after rounding, too.
        u = np.where(x > self._length, np.maximum(u, np.nextafter(1.0, 2.0)), u)
        return self._depth / self._length * self._G_slope(u)

    def _radius(self, depth):
        depth = depth / self._depth
        u, covered = self.table.radius(depth), self.table.covers(depth)
        with np.errstate(all="ignore"):
            # To rounding, by a step of Newton's method.
            step = (self._G(u) - depth) / self._G_slope(u)
            u = np.where((depth > 0) & np.isfinite(step), u - step, np.where(depth > 0, u, 0.0))
            u = np.clip(u, self._edge, self._end)
            # Just above a flat face the radius is that of the face, to rounding.
            far = ~covered & (depth > self._edge)
            if np.any(far):
                u = np.array(u)
                u[far] = _unit_radius(type(self), np.asarray(depth)[far], 1.0)
        return self._length * np.where(covered | far, u, self._edge)


def _unit_radius(kind, depth, start):
    """u with G(u) = depth of a class of shapes, elementwise, from places u to begin with."""
    # The largest of depths over the smallest of lengths.
    most = _check.LARGEST**3
    u = increasing_root(lambda u: (kind._G(u), kind._G_slope(u)), depth, start, kind._end, largest=most)
    return np.maximum(np.where(u < np.inf, u, kind._end), kind._edge)


@lru_cache
def _unit(kind):
    """The shape of a class with parameters of 1."""
    return kind(*(1.0 for _ in fields(kind)))


@lru_cache
def _unit_table(kind):
    unit = _unit(kind)
    end = min(unit.known_depth, 2.0**_OCTAVES)
    octaves = [_OCTAVES + int(np.log2(end)) for end in (*unit.kinks[:1], end)]
    coarse = np.ldexp(1.0, np.arange(-_OCTAVES, _OCTAVES))

    def radius(depth):
        start = np.exp(np.interp(np.log(depth), np.log(coarse), np.log(about)))
        return _unit_radius(kind, depth, start)

    with np.errstate(all="ignore"):
        about = _unit_radius(kind, coarse, 1.0)
        return RadiusTable(radius, (0.0, *unit.kinks), end, _FINE, octaves[: 1 + len(unit.kinks)])


@dataclass(frozen=True, eq=False)
class Tabulated(Profile):
    """A shape with the contact radius of another one as a table, down to a depth (m)."""

    profile: Profile
    known_depth: float

    unit = property(lambda self: (self, 1.0, 1.0))
    kinks = property(lambda self: self.profile.kinks)
    scale = property(lambda self: self.profile.scale)
    wall = property(lambda self: self.profile.wall)
    face_radius = property(lambda self: self.profile.face_radius)
    known_radius = property(lambda self: self.profile.known_radius)
    _height = property(lambda self: self.profile._height)
    _reduced = property(lambda self: self.profile._reduced)
    _reduced_slope = property(lambda self: self.profile._reduced_slope)

    @cached_property
    def table(self):
        feet = (0.0, *(kink for kink in self.kinks if kink < self.known_depth))
        with np.errstate(all="ignore"):
            return RadiusTable(
                lambda s: self.profile._radius(np.minimum(s, self.known_depth)), feet, self.known_depth
            )

    def _radius(self, depth):
        radius, covered = self.table.radius(depth), self.table.covers(depth)
        return radius if np.all(covered) else np.where(covered, radius, self.profile._radius(depth))


def tabulated(profile, known_depth):
    """A shape that gives the contact radius of `profile` quickly, down to a depth (m) or its own end.

    Pure powers and shapes of one length, which are quick, come back as they are, and so do many shapes.
    """
    powers = FlatPunch | Cone | Paraboloid | PowerLaw
    if profile.shape or isinstance(profile, powers | OneLength | Tabulated):
        return profile
    known_depth = min(2.0 ** np.ceil(np.log2(np.max(known_depth))), np.min(profile.known_depth))
    return _tabulated(profile, float(known_depth))


_tabulated = lru_cache(maxsize=16)(Tabulated)
