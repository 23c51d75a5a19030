"""Profiles with a rounded tip: sphere, hyperboloid, rounded cone, parabolic punch."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base.check import ArrayLike, Parameter
from .radius_table import OneLength


@dataclass(frozen=True, eq=False)
class Sphere(OneLength):
    """Sphere z = R − √(R² − r²), with g = x artanh(x/R).

    From Popov (2015), Eq. (3).

    Parameters
    ----------
    radius : float
        Radius R (m), positive. Outside the equator, r > R, the height is infinite.

    Examples
    --------
    >>> from mdr_core import Sphere
    >>> print(round(Sphere(radius=1.0).reduced(0.5), 12))  # artanh(1/2)/2
    0.274653072167
    """

    radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, radius: ArrayLike) -> None: ...

    _length = _depth = body_radius = property(lambda self: self.radius)
    # At this depth a equals R to rounding.
    known_depth = property(lambda self: 100 * self.radius)
    _last = "the equator, which the contact reaches at d = 100 R"
    _end = np.nextafter(1.0, 0.0)

    @staticmethod
    def _Z(u):
        inside = np.minimum(u, 1.0)
        return np.where(u > 1, np.inf, inside * (inside / (1 + np.sqrt((1 - inside) * (1 + inside)))))

    @staticmethod
    def _G(u):
        with np.errstate(divide="ignore"):
            return np.where(u < 1, u * np.arctanh(np.minimum(u, 1.0)), np.inf)

    @staticmethod
    def _G_slope(u):
        with np.errstate(divide="ignore"):
            return np.where(u < 1, np.arctanh(np.minimum(u, 1.0)) + u / ((1 - u) * (1 + u)), np.inf)

    def radius_at_height(self, height):
        inside = np.minimum(height, self.radius)
        return np.sqrt(inside * (2 * self.radius - inside))


@dataclass(frozen=True, eq=False)
class Hyperboloid(OneLength):
    """Hyperboloid z = √(s²r² + s⁴R²) − s²R, a cone smoothly rounded at the tip.

    Its reduced height is g = s x arctan(x/(sR)), from Popov (2015), Eq. (3).

    Parameters
    ----------
    slope : float
        Slope s of the asymptotic cone, positive.
    tip_radius : float
        Radius of curvature R at the tip (m), positive.

    Examples
    --------
    >>> from mdr_core import Hyperboloid
    >>> print(round(Hyperboloid(slope=1.0, tip_radius=1.0).reduced(1.0), 12))  # π/4
    0.785398163397
    """

    slope: Parameter
    tip_radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, slope: ArrayLike, tip_radius: ArrayLike) -> None: ...

    _length = property(lambda self: self.slope * self.tip_radius)
    _depth = property(lambda self: self.slope * self._length)
    _Z = staticmethod(lambda u: u * (u / (np.hypot(u, 1.0) + 1)))
    _G = staticmethod(lambda u: u * np.arctan(u))
    _G_slope = staticmethod(lambda u: np.arctan(u) + u / (1 + u * u))

    def radius_at_height(self, height):
        return np.sqrt(height * (height + 2 * self._depth)) / self.slope


@dataclass(frozen=True, eq=False)
class RoundedCone(OneLength):
    """Cone with a parabolic cap: z = r²/(2R) up to b = sR, then s r − s²R/2.

    Reduced: x²/R, then (x/R)(x − √(x² − b²) + b arccos(b/x)), from Popov (2015), Eq. (3).

    Parameters
    ----------
    tip_radius : float
        Radius of curvature R of the cap (m), positive.
    slope : float
        Slope s of the cone, positive.

    Examples
    --------
    >>> from mdr_core import RoundedCone
    >>> print(round(RoundedCone(tip_radius=1.0, slope=1.0).reduced(1.0), 12))
    1.0
    """

    tip_radius: Parameter
    slope: Parameter

    if TYPE_CHECKING:

        def __init__(self, tip_radius: ArrayLike, slope: ArrayLike) -> None: ...

    _length = property(lambda self: self.slope * self.tip_radius)
    _depth = property(lambda self: self.slope * self._length)
    kinks = property(lambda self: (self._depth,))

    _Z = staticmethod(lambda u: np.where(u <= 1, u * (u / 2), u - 0.5))

    @staticmethod
    def _G(u):
        v = np.maximum(u, 1.0)
        tau = np.sqrt((v - 1) * (v + 1))
        # v − τ = 1/(v + τ), and arccos(1/v) = arctan τ.
        return np.where(u <= 1, u * u, v / (v + tau) + v * np.arctan(tau))

    @staticmethod
    def _G_slope(u):
        v = np.maximum(u, 1.0)
        tau = np.sqrt((v - 1) * (v + 1))
        return np.where(u <= 1, 2 * u, 2 / (v + tau) + np.arctan(tau))

    def radius_at_height(self, height):
        cone, cap = height / self.slope + self._length / 2, np.sqrt(2 * self.tip_radius * height)
        return np.where(cone > self._length, cone, cap)[()]


@dataclass(frozen=True, eq=False)
class ParabolicPunch(OneLength):
    """Cylinder with a parabolic cap: z = r²/(2R) for r ≤ b, and a wall at b; g = x²/R.

    Parameters
    ----------
    radius : float
        Radius of curvature R of the cap (m), positive.
    cylinder_radius : float
        Radius b of the cylinder (m), positive.

    Examples
    --------
    >>> from mdr_core import ParabolicPunch
    >>> ParabolicPunch(radius=1.0, cylinder_radius=0.5).contact_radius([0.04, 9.0]).tolist()
    [0.2, 0.5]
    """

    radius: Parameter
    cylinder_radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, radius: ArrayLike, cylinder_radius: ArrayLike) -> None: ...

    _length = wall = property(lambda self: self.cylinder_radius)
    _depth = property(lambda self: self.cylinder_radius * (self.cylinder_radius / self.radius))
    kinks = property(lambda self: (self._depth,))
    body_radius = property(lambda self: self.radius)
    _end = 1.0

    _Z = staticmethod(lambda u: np.where(u <= 1, u * (u / 2), np.inf))
    _G = staticmethod(lambda u: np.where(u <= 1, u * u, np.inf))
    _G_slope = staticmethod(lambda u: np.where(u <= 1, 2 * u, np.inf))

    def radius_at(self, depth):
        # At the wall the radius is exactly the cylinder radius.
        return np.minimum(np.sqrt(self.radius * depth), self.cylinder_radius)

    def radius_at_height(self, height):
        return np.minimum(np.sqrt(2 * self.radius * height), self.cylinder_radius)
