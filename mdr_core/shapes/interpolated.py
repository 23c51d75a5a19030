"""The contact radius of any shape as a piecewise polynomial, for solvers that often ask for it."""

import numpy as np
import scipy

from .power import Cone, FlatPunch, Paraboloid, PowerLaw
from .profile import Profile

#: Chebyshev points of a panel on [0, 1], and matrices from values there to coefficients of Chebyshev
#: polynomials, and from these to those of powers, the highest first.
_POINTS = (1 - np.cos(np.pi * (np.arange(14) + 0.5) / 14)) / 2
_TO_SERIES = np.linalg.inv(np.polynomial.chebyshev.chebvander(2 * _POINTS - 1, 13))
_TO_POWERS = np.zeros((14, 14))
for _k in range(14):
    _TO_POWERS[13 - _k :, _k] = (
        np.polynomial.Chebyshev.basis(_k, [0, 1]).convert(kind=np.polynomial.Polynomial).coef[::-1]
    )
#: Panels grow by this factor.
_RATIO = np.sqrt(2.0)


def interpolated(profile, deepest):
    """A shape whose contact radius is that of `profile` to 10⁻¹⁰, down to a depth (m) or its own end.

    A pure power comes back as it is.
    """
    powers = FlatPunch | Cone | Paraboloid | PowerLaw
    return profile if isinstance(profile, powers) else Interpolated(profile, deepest)


class Interpolated(Profile):
    """The contact radius of a shape, interpolated in σ = (s − f)^(1/4) behind each kink at a depth f."""

    # It is no dataclass: two tables are the same if they are one.
    __eq__, __hash__ = object.__eq__, object.__hash__

    def __init__(self, profile, deepest, unit=None):
        self.profile, self.shape = profile, profile.shape
        self.deepest = min(np.max(deepest), np.min(profile.deepest))
        self.kinks, self.scale, self.wall = profile.kinks, profile.scale, profile.wall
        if profile.shape:
            shape, length, depth = profile.unit
            self.unit = unit or Interpolated(shape, deepest / depth), length, depth
            return
        deepest = self.deepest
        feet = np.array([0.0, *(kink for kink in profile.kinks if kink < deepest)])
        panels = [_panels(feet, zone, deepest) for zone in range(len(feet))]
        # One coordinate for all zones, one after the other.
        self._feet, self._begin = feet, np.cumsum([0.0] + [edges[-1] for edges in panels])
        inner = [begin + part[1:] for begin, part in zip(self._begin[:-1], panels, strict=True)]
        edges = np.concatenate([[0.0], *inner])
        width = np.diff(edges)
        place = edges[:-1, None] + width[:, None] * _POINTS
        zone = np.searchsorted(self._begin, place[:, 0], side="right") - 1
        depth = feet[zone, None] + (place - self._begin[zone, None]) ** 4
        radius = profile._radius(np.minimum(depth, deepest))
        degree = np.arange(_POINTS.size)[::-1, None]
        powers = _TO_POWERS @ (_TO_SERIES @ radius.T) / width**degree
        self._polynomial = scipy.interpolate.PPoly(powers, edges)
        # ds = 4σ³ dσ, with σ from the beginning of the zone.
        begin, rate = edges[:-1] - self._begin[zone], np.zeros((_POINTS.size + 3, len(width)))
        for k, factor in enumerate((4, 12 * begin, 12 * begin**2, 4 * begin**3)):
            rate[k : k + _POINTS.size] += factor * powers
        self._area = scipy.interpolate.PPoly(rate, edges).antiderivative()

    def _radius(self, depth):
        if self.shape:
            unit, length, scale = self.unit
            return length * unit._radius(depth / scale)
        return self._polynomial(self._place(depth))

    def area(self, depth):
        """∫ a(s) ds (m²) from the tip to a depth (m)."""
        if self.shape:
            unit, length, scale = self.unit
            return length * scale * unit.area(depth / scale)
        return self._area(self._place(depth))

    def _place(self, depth):
        """The coordinate of depths: σ, counted through all zones."""
        zone = np.searchsorted(self._feet, depth, side="right") - 1
        return self._begin[zone] + np.sqrt(np.sqrt(depth - self._feet[zone]))

    def _height(self, r):
        return self.profile._height(r)

    def _reduced(self, x):
        return self.profile._reduced(x)

    def _reduced_slope(self, x):
        return self.profile._reduced_slope(x)

    def entries(self, index, shape=None):
        if not self.shape:
            return self
        return Interpolated(self.profile.entries(index, shape), self.deepest, self.unit[0])


def _panels(feet, zone, deepest):
    """Edges of panels in σ behind one foot, from 0 to the next one; finer the closer to the foot."""
    end = (feet[zone + 1] if zone + 1 < len(feet) else deepest) - feet[zone]
    # As deep as the foot stands behind the last one, the shape before it still shows.
    least = 0.05 * (feet[zone] - feet[zone - 1]) if zone else 1e-16 * end
    count = max(0, int(np.ceil(np.log(end / least) / np.log(_RATIO) / 4)))
    return np.append(0.0, end**0.25 * _RATIO ** -np.arange(count, -1, -1.0))
