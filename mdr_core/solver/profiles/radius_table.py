"""The contact radius of a profile and its integrals over the depth, as piecewise polynomials.

Ensembles of impacts need a(s), ∫ a ds and ∫∫ a ds ds. For profiles with one characteristic length and depth
(`OneLength`) these are functions of one variable, tabulated once for the class. `Tabulated` has the table
of one profile.
"""

from dataclasses import dataclass, fields
from functools import cached_property, lru_cache

import numpy as np
import scipy

from ...base import check
from ..numerics.roots import increasing_root
from .profile import Profile

#: Chebyshev points on [0, 1] for the interpolation of a(s), and the matrix from values there to the last
#: two Chebyshev coefficients.
_COUNT = 10
_NODE = (1 + np.cos(np.pi * (np.arange(_COUNT) + 0.5) / _COUNT)) / 2
_TO_LAST = np.linalg.inv(np.polynomial.chebyshev.chebvander(2 * _NODE - 1, _COUNT - 1))[-2:]


class RadiusTable:
    """Contact radius a(s) (m) of one profile, ∫ a ds (m²) and ∫∫ a ds ds (m³) from depth 0.

    Panels between the edges are halved until a polynomial of degree 9 equals a(s) to rounding. From depth 0
    to the first edge a(s) is the radius of the face plus a power of s. The panel has a parabola with the
    same integrals.

    `radius` is a(s) (m) at arrays of depths (m). `edges` are ascending depths (m): both ends of the table,
    and all kinks between them. Powers of depths over `unit` (m) must stay within double precision.
    """

    def __init__(self, radius, edges, unit=1.0):
        edges = np.asarray(edges) / unit
        self.unit, (self.start, self.end), self._function = unit, edges[[0, -1]], radius
        low, powers = _panels(lambda depth: radius(depth * unit), edges)
        first = _tip_panel(lambda share: radius(edges[0] * unit * share), edges[0])
        self._radius = _Polynomials(
            np.column_stack([first, powers]), np.concatenate([[0.0], low, edges[-1:]])
        )
        # Both are continuous from panel to panel, and 0 at depth 0.
        self._area = self._radius.antiderivative()
        self._volume = self._area.antiderivative()

    def covers(self, depth):
        """Whether depths (m) are in the table: 0, or between its first and its last edge."""
        depth = np.asarray(depth) / self.unit
        return ((depth >= self.start) | (depth == 0)) & (depth <= self.end)

    def radius(self, depth):
        """Return a(s) (m) at any depths (m)."""
        covered = self.covers(depth)
        if covered.all():
            return self.covered_radius(depth)
        result, depth = np.empty(covered.shape), np.asarray(depth)
        result[covered] = self.covered_radius(depth[covered])
        result[~covered] = self._function(depth[~covered])
        return result

    def covered_radius(self, depth):
        """Return a(s) (m) at depths (m) in the table."""
        return self._radius(depth / self.unit)

    def area(self, depth):
        """Return ∫ a ds (m²) from the tip to depths (m)."""
        return self._area(depth / self.unit) * self.unit

    def volume(self, depth):
        """Return ∫∫ a ds ds (m³) from the tip to depths (m)."""
        return self._volume(depth / self.unit) * self.unit**2

    def depth_of_area(self, area):
        """Return the depth (m) at which ∫ a ds has a value (m²), to about 10⁻⁴ of the depth."""
        with np.errstate(divide="ignore"):
            return np.exp(np.interp(np.log(area), *self._inverses[0]))

    def depth_of_volume(self, volume):
        """Return the depth (m) at which ∫∫ a ds ds has a value (m³), to about 10⁻⁴ of the depth."""
        with np.errstate(divide="ignore"):
            return np.exp(np.interp(np.log(volume), *self._inverses[1]))

    # Cached, depths of 300 impacts of samples are 2.6 times as fast, single depths of a rounded cone 1.8.
    @cached_property
    def _inverses(self):
        """Logarithms of ∫ a ds (m²) and of depths (m), and of ∫∫ a ds ds (m³) and of depths."""
        edges = self._radius.x[1:]
        depth = np.append(np.linspace(edges[:-1], edges[1:], 4, endpoint=False).T, edges[-1])
        area, volume = (each.by_numpy(depth) for each in (self._area, self._volume))
        # Far below the unit of depth, rounding may make an integral negative; it then gives no guess.
        with np.errstate(invalid="ignore", divide="ignore"):
            inverse = np.log(depth * self.unit)
            return [(np.log(area * self.unit), inverse), (np.log(volume * self.unit**2), inverse)]


#: Least number of depths for an evaluation of polynomials by SciPy.
_MANY = 1000


class _Polynomials:
    """Piecewise polynomials with coefficients by power, highest first, and panel.

    They replace `scipy.interpolate.PPoly`, which is up to 1.6 times as fast for many depths, but takes half
    a second to import.
    """

    def __init__(self, powers, x):
        self.powers, self.x = powers, x

    @cached_property
    def _of_scipy(self):
        return scipy.interpolate.PPoly(self.powers, self.x)

    def __call__(self, depth):
        depth = np.asarray(depth, dtype=float)
        return self._of_scipy(depth) if depth.size >= _MANY else self.by_numpy(depth)

    def by_numpy(self, depth):
        """Return their values without SciPy, even for many depths."""
        panel = self.x[1:-1].searchsorted(depth, side="right")
        above = depth - self.x[panel]
        value, *powers = self.powers[:, panel]
        for power in powers:
            value = value * above + power
        return value

    def antiderivative(self):
        """Return their integral from the first edge."""
        count, width = len(self.powers), np.diff(self.x)
        powers = np.vstack([self.powers / np.arange(count, 0, -1)[:, None], np.zeros(len(width))])
        whole = np.zeros(len(width))
        for row in powers:
            whole = whole * width + row
        powers[-1] = np.append(0.0, np.cumsum(whole)[:-1])
        return _Polynomials(powers, self.x)


def _tip_panel(radius, edge):
    """Return coefficients of the panel from the tip to the first edge (m), highest power first.

    `radius` is a (m) at shares t of the edge. There a = face + (whole − face) tᵖ, with p from the middle.
    Only the integrals at the end of this panel are used. It is therefore the parabola face + b t + c t²
    with the same ∫ a dt and ∫ (1 − t) a dt.
    """
    face, half, whole = radius(np.array([0.0, 0.5, 1.0]))
    p = np.log2((whole - face) / (half - face)) if half > face else 1.0
    area = (whole - face) / (1 + p)
    c, b = np.linalg.solve([[1 / 3, 1 / 2], [1 / 12, 1 / 6]], [area, area / (2 + p)])
    return np.append(np.zeros(_COUNT - 3), [c / edge**2, b / edge, face])


def _panels(radius, edges):
    """Return ascending lower edges of panels, and polynomial coefficients, highest power first."""
    low, high, panels = edges[:-1], edges[1:], []
    while low.size:
        width = high - low
        values = radius(low[:, None] + width[:, None] * _NODE)
        rough = np.abs(values @ _TO_LAST.T).max(axis=1) > 1e-15 * values.min(axis=1)
        # Panels limited by the rounding of a(s) or of the depth are not halved.
        below = low - edges[np.searchsorted(edges, low, side="right") - 1]
        rough &= width > np.maximum(below / 8, 2.0**-44 * high)
        powers = np.linalg.solve(np.vander(_NODE), values.T) / width ** np.arange(_COUNT)[::-1, None]
        panels.append((low[~rough], powers.T[~rough]))
        low, high = low[rough], high[rough]
        low, high = np.append(low, (low + high) / 2), np.append((low + high) / 2, high)
    low, powers = (np.concatenate(arrays) for arrays in zip(*panels, strict=True))
    order = np.argsort(low)
    return low[order], powers[order].T


class OneLength(Profile):
    """Base class of profiles with one length L and one depth H: z = H Z(r/L), g = H G(x/L).

    A subclass defines `_length` and `_depth` (L and H, m), and Z, G and G′ as functions of arrays u = r/L.
    Both scales must be 1 if all parameters are 1. A parameter named `slope` has no unit, others are in m.
    The inverse of G comes from a table, made once for the class at its first use.
    """

    _length: float
    _depth: float
    #: u at which G starts to grow (0, or 1 at the edge of a flat face), and the largest u.
    _edge, _end = 0.0, np.inf

    def __post_init__(self):
        # A parameter is a slope, or a length.
        units = {field.name: "" if field.name == "slope" else "m" for field in fields(self)}
        check.set_positive(self, **units)

    face_radius = property(lambda self: self._edge * self._length)
    transition_depth = property(lambda self: self._depth)
    unit = property(lambda self: (_unit(type(self)), self._length, self._depth))
    #: The `RadiusTable` of the unit profile.
    table = property(lambda self: _unit_table(type(self)))

    def height_at(self, r):
        return self._depth * self._Z(r / self._length)

    def reduced_at(self, x):
        return self._depth * self._G(x / self._length)

    def reduced_slope_at(self, x):
        u = x / self._length
        # Radii outside an edge must stay outside after rounding.
        u = np.where(x > self._length, np.maximum(u, np.nextafter(1.0, 2.0)), u)
        return self._depth / self._length * self._G_slope(u)

    def radius_at(self, depth):
        # Rounding must not lead out of the range of u.
        u = np.minimum(np.maximum(self.table.radius(depth / self._depth), self._edge), self._end)
        return self._length * u

    @classmethod
    def _unit_radius(cls, depth):
        """Return u with G(u) = `depth`, elementwise."""
        # The largest depth over the smallest unit of depth, s²R.
        limit = check.LONGEST**4
        u = increasing_root(lambda u: (cls._G(u), cls._G_slope(u)), depth, 1.0, cls._end, largest=limit)
        return np.maximum(np.where(u < np.inf, u, cls._end), cls._edge)


# The cache makes single states of a rounded cone 1.5 times as fast, the cache of its table 230 times.
@lru_cache
def _unit(kind):
    """Return the profile of a class with parameters of 1, which has the length and the depth 1."""
    unit = kind(*(1.0 for _ in fields(kind)))
    length, depth = unit._length, unit._depth  # noqa: SLF001
    if (length, depth) != (1.0, 1.0):
        raise TypeError(
            f"{kind.__name__} with parameters of 1 has the length {length:g} and the depth {depth:g}; "
            "a OneLength must have 1 and 1: take other parameters, or derive from Profile"
        )
    return unit


@lru_cache
def _unit_table(kind):
    """Return the `RadiusTable` of the unit profile of a class; its kinks are at the unit of depth."""
    edges = np.ldexp(1.0, np.arange(-100, 101))
    end = min(_unit(kind).known_depth, edges[-1])
    return RadiusTable(kind._unit_radius, np.append(edges[edges < end], end))  # noqa: SLF001


@dataclass(frozen=True, eq=False)
class Tabulated(Profile):
    """A profile with the contact radius of another profile from a table, down to a depth (m)."""

    profile: Profile
    known_depth: float

    unit = property(lambda self: (self, 1.0, 1.0))
    kinks = property(lambda self: self.profile.kinks)
    transition_depth = property(lambda self: self.profile.transition_depth)
    wall = property(lambda self: self.profile.wall)
    face_radius = property(lambda self: self.profile.face_radius)
    known_radius = property(lambda self: self.profile.known_radius)
    height_at = property(lambda self: self.profile.height_at)
    radius_at_height = property(lambda self: self.profile.radius_at_height)
    reduced_at = property(lambda self: self.profile.reduced_at)
    reduced_slope_at = property(lambda self: self.profile.reduced_slope_at)

    # The cache makes three contact times of samples 12 times as fast.
    @cached_property
    def table(self):
        kinks = [kink for kink in self.kinks if kink < self.known_depth] + [self.known_depth]
        edges = np.append(np.ldexp(kinks[0], np.arange(-64, 0)), kinks)
        return RadiusTable(
            lambda s: self.profile.radius_at(np.minimum(s, self.known_depth)), edges, self.known_depth
        )

    def radius_at(self, depth):
        return self.table.radius(depth)
