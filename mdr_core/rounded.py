"""Indenter shapes with a rounded tip: sphere, hyperboloid, rounded cone, parabolic punch."""

from dataclasses import dataclass

import numpy as np

from . import _check
from .inverse import arctan_gap, newton
from .profiles import Profile
from .zones import Zone


@dataclass(frozen=True)
class Sphere(Profile):
    """Sphere z = R − √(R² − r²), with g = x artanh(x/R).

    From Popov (2015), Eq. (3). With x = R tanh y the reduced height is R y tanh y.

    Parameters
    ----------
    radius : float
        Radius R (m), positive. Above the equator r > R the height counts as infinite.

    Examples
    --------
    >>> print(round(Sphere(radius=1.0).reduced(0.5), 12))  # artanh(1/2)/2
    0.274653072167
    """

    radius: float

    def __post_init__(self):
        _check.set_positive(self, radius="m")

    # There a is R to any precision, and the squares of hyperbolic functions are still finite.
    deepest = property(lambda self: 100 * self.radius)
    unit = property(lambda self: (Sphere(1.0), self.radius, self.radius))

    @property
    def zones(self):
        R = self.radius

        def rate(t):
            tau = t / R
            cosh = np.hypot(1.0, tau)
            return (tau + np.arcsinh(tau) / cosh) / cosh / cosh

        return (Zone(rate, lambda depth: R * np.sinh(self.latitude(depth)), order=1, scale=R, equator=R),)

    def latitude(self, depth):
        """y = artanh(a/R) at a depth (m): the root of y tanh y = d/R, inverse of g."""
        D = np.asarray(depth / self.radius)

        def step(y):
            tanh = np.tanh(y)
            return (y * tanh - D) / (tanh + y * (1 - tanh) * (1 + tanh))

        # y² for small y, y for large; the factor between them keeps the start within 4 %.
        return newton(step, np.sqrt(D * (1 + D * (0.33 + D) / (1 + D))))

    def _height(self, r):
        R = self.radius
        inside = np.minimum(r, R)
        return np.where(r > R, np.inf, inside * (inside / (R + np.sqrt((R - inside) * (R + inside)))))

    def _reduced(self, x):
        R = self.radius
        with np.errstate(divide="ignore"):
            return np.where(x < R, x * np.arctanh(np.minimum(x / R, 1.0)), np.inf)

    def _radius(self, depth):
        return self.radius * np.tanh(self.latitude(depth))


@dataclass(frozen=True)
class Hyperboloid(Profile):
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
    >>> print(round(Hyperboloid(slope=1.0, tip_radius=1.0).reduced(1.0), 12))  # π/4
    0.785398163397
    """

    slope: float
    tip_radius: float

    def __post_init__(self):
        _check.set_positive(self, slope="", tip_radius="m")

    @property
    def _length(self):
        return self.slope * self.tip_radius

    unit = property(lambda self: (Hyperboloid(1.0, 1.0), self._length, self.slope * self._length))

    @property
    def zones(self):
        s, length = self.slope, self._length

        def rate(t):
            tau = t / length
            return s * (np.arctan(tau) + tau / (1 + tau * tau))

        return (Zone(rate, self._radius, order=1, scale=length),)

    def _height(self, r):
        s, tip = self.slope, self.slope * self._length
        return s * r * (s * r / (np.hypot(s * r, tip) + tip))

    def _reduced(self, x):
        return self.slope * x * np.arctan(x / self._length)

    def _radius(self, depth):
        D = depth / (self.slope * self._length)

        def step(tau):
            arctan = np.arctan(tau)
            return (tau * arctan - D) / (arctan + tau / (1 + tau * tau))

        return self._length * newton(step, np.sqrt(D) + 2 / np.pi * D)


@dataclass(frozen=True)
class RoundedCone(Profile):
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
    >>> print(round(RoundedCone(tip_radius=1.0, slope=1.0).reduced(1.0), 12))
    1.0
    """

    tip_radius: float
    slope: float

    def __post_init__(self):
        _check.set_positive(self, tip_radius="m", slope="")

    @property
    def _cap(self):
        return self.slope * self.tip_radius

    kinks = property(lambda self: (self.slope * self._cap,))
    unit = property(lambda self: (RoundedCone(1.0, 1.0), self._cap, self.slope * self._cap))

    @property
    def zones(self):
        R, s, b = self.tip_radius, self.slope, self._cap

        def rate(t):
            tau = t / b
            x = np.hypot(1.0, tau)
            # sinh u gd u + 1 − e^(−2u) in the coordinate τ = sinh u.
            return s * (tau * np.arctan(tau) + 2 * tau / (tau + x)) / x

        return (
            Zone(
                lambda t: 2 * t / R,
                lambda depth: np.minimum(np.sqrt(R * depth), b),
                order=1,
                scale=b,
                end=b,
            ),
            Zone(rate, self._beyond_cap, order=1, kink=b, scale=b),
        )

    def _beyond_cap(self, depth):
        """√(a² − b²) (m), 0 as long as only the cap is in contact."""
        foot = self.slope * self._cap
        D = np.maximum(depth - foot, 0.0) / foot

        def step(tau):
            x = np.hypot(1.0, tau)
            arctan = np.arctan(tau)
            # g − foot: at first as τ² − …, which keeps its digits at the kink.
            near = tau * tau - x * arctan_gap(tau)
            height = np.where(tau < 1, near, x * (1 / (tau + x) + arctan) - 1)
            return (height - D) / ((tau * arctan + 2 * tau / (tau + x)) / x)

        return self._cap * newton(step, np.sqrt(D) + 2 / np.pi * D)

    def _height(self, r):
        R, s, b = self.tip_radius, self.slope, self._cap
        return np.where(r <= b, r * (r / (2 * R)), s * (r - b / 2))

    def _reduced(self, x):
        b = self._cap
        tau = np.sqrt(np.maximum(x - b, 0.0) * (x + b)) / b
        cone = self.slope * x * (1 / (tau + np.hypot(1.0, tau)) + np.arctan(tau))
        return np.where(x <= b, x * (x / self.tip_radius), cone)

    def _radius(self, depth):
        cap, cone = self.zones
        return np.where(
            depth > self.slope * self._cap, cone.radius(cone.coordinate(depth)), cap.coordinate(depth)
        )


@dataclass(frozen=True)
class ParabolicPunch(Profile):
    """Cylinder with a parabolic cap: z = r²/(2R) for r ≤ b, a wall beyond; g = x²/R.

    Parameters
    ----------
    radius : float
        Radius of curvature R of the cap (m), positive.
    cylinder_radius : float
        Radius b of the cylinder (m), positive.

    Examples
    --------
    >>> ParabolicPunch(radius=1.0, cylinder_radius=0.5).contact_radius([0.04, 9.0]).tolist()
    [0.2, 0.5]
    """

    radius: float
    cylinder_radius: float

    def __post_init__(self):
        _check.set_positive(self, radius="m", cylinder_radius="m")

    wall = property(lambda self: self.cylinder_radius)
    kinks = property(lambda self: (self.cylinder_radius * (self.cylinder_radius / self.radius),))
    unit = property(lambda self: (ParabolicPunch(1.0, 1.0), self.cylinder_radius, self.kinks[0]))

    @property
    def zones(self):
        return (Zone(lambda t: 2 * t / self.radius, self._radius, order=1, scale=self.cylinder_radius),)

    def _height(self, r):
        return np.where(r <= self.cylinder_radius, r * (r / (2 * self.radius)), np.inf)

    def _reduced(self, x):
        return np.where(x <= self.cylinder_radius, x * (x / self.radius), np.inf)

    def _radius(self, depth):
        return np.minimum(np.sqrt(self.radius * depth), self.cylinder_radius)
