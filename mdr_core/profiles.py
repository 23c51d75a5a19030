"""Indenter shapes: height z(r), reduced height g(x) and contact radius a(d). Geometry only.

A shape is given by three facts, z(r), its reduced 1D profile g(x) (Popov 2015, Eq. (3)) and the
inverse a(d) of g, and by its `zones`: the stretches of x between kinks, each with the rate at
which depth grows in a coordinate in which it is smooth. Everything else follows from these.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import gamma

from . import _check


@dataclass(frozen=True)
class Zone:
    """A stretch of the reduced profile that starts at a kink and is smooth behind it.

    Behind a kink at x = k the profile is smooth in t = √(x² − k²), not in x: there
    dg = rate(t) dt.

    Parameters
    ----------
    kink : float
        Radius k (m) where the zone begins; 0 for the zone at the tip.
    end : float
        Radius (m) where it ends; infinite for the last zone.
    rate : callable
        dg/dt as a function of t (m), vectorised.
    order : float
        Exponent of the leading power of `rate` at t → 0.
    """

    kink: float
    end: float
    rate: Callable
    order: float


class Profile(ABC):
    """A rigid axisymmetric indenter with its tip at the origin, growing outward.

    Lengths are in m, slopes dimensionless.
    """

    #: Radius (m) of a vertical wall, where depth may grow at constant contact radius.
    wall = np.inf

    def height(self, r):
        """Height z(r) (m) above the tip at radius r (m), of the shape of `r`; even in r."""
        return self._height(np.abs(_check.finite_array("radius r", r, unit="m")))[()]

    def reduced(self, x):
        """Height g(x) (m) of the equivalent 1D profile, Popov (2015), Eq. (3); even in x."""
        return self._reduced(np.abs(_check.finite_array("coordinate x", x, unit="m")))[()]

    def contact_radius(self, depth):
        """Contact radius a (m) at indentation depth d (m): the largest x with g(x) ≤ d."""
        depth = _check.finite_array("depth", depth, unit="m")
        _check.refuse(
            "depth", depth, depth < 0, "is negative", unit="m", remedy="depth is positive downward"
        )
        return self._radius(depth)[()]

    @property
    @abstractmethod
    def zones(self) -> tuple[Zone, ...]:
        """The smooth stretches of g, from the tip outward."""

    @abstractmethod
    def _height(self, r): ...

    @abstractmethod
    def _reduced(self, x): ...

    @abstractmethod
    def _radius(self, depth): ...


def _set_positive(profile, **units):
    """Replace each named field by its checked float value."""
    for name, unit in units.items():
        quantity = f"{type(profile).__name__} {name}"
        value = _check.positive(quantity, getattr(profile, name), unit=unit)
        object.__setattr__(profile, name, value)


@dataclass(frozen=True)
class FlatPunch(Profile):
    """Flat-ended cylinder: z = 0 for r ≤ b, a wall beyond.

    Parameters
    ----------
    radius : float
        Radius b of the flat end (m), positive.

    Examples
    --------
    >>> FlatPunch(radius=2.0).contact_radius([0.0, 1.0]).tolist()
    [2.0, 2.0]
    """

    radius: float

    def __post_init__(self):
        _set_positive(self, radius="m")

    wall = property(lambda self: self.radius)
    zones = ()

    def _height(self, r):
        return np.where(r <= self.radius, 0.0, np.inf)

    _reduced = _height

    def _radius(self, depth):
        return np.full_like(depth, self.radius)


@dataclass(frozen=True)
class Cone(Profile):
    """Cone z = s r, with g = (π/2) s x: Popov (2015), Eqs. (13), (14), (16).

    Parameters
    ----------
    slope : float
        Slope s of the generator (dimensionless), positive: the tangent of its angle to the
        surface.

    Examples
    --------
    >>> print(Cone(slope=1.0).reduced(1.0))  # π/2
    1.5707963267948966
    """

    slope: float

    def __post_init__(self):
        _set_positive(self, slope="")

    @property
    def zones(self):
        return (Zone(0.0, np.inf, lambda t: np.full_like(t, np.pi / 2 * self.slope), 0.0),)

    def _height(self, r):
        return self.slope * r

    def _reduced(self, x):
        return np.pi / 2 * self.slope * x

    def _radius(self, depth):
        return depth / (np.pi / 2 * self.slope)


@dataclass(frozen=True)
class Paraboloid(Profile):
    """Paraboloid z = r²/(2R), with g = x²/R (the Hertzian contact).

    Parameters
    ----------
    radius : float
        Radius of curvature R at the tip (m), positive.

    Examples
    --------
    >>> print(Paraboloid(radius=8.0).contact_radius(2.0))  # √(R d)
    4.0
    """

    radius: float

    def __post_init__(self):
        _set_positive(self, radius="m")

    @property
    def zones(self):
        return (Zone(0.0, np.inf, lambda t: 2 * t / self.radius, 1.0),)

    def _height(self, r):
        return r * (r / (2 * self.radius))

    def _reduced(self, x):
        return x * (x / self.radius)

    def _radius(self, depth):
        return np.sqrt(self.radius * depth)


@dataclass(frozen=True)
class PowerLaw(Profile):
    """Power law z = c rⁿ, with g = κₙ c xⁿ: Popov (2015), Eqs. (4)–(7).

    Parameters
    ----------
    coefficient : float
        Coefficient c (m^(1−n)), positive.
    exponent : float
        Exponent n, positive.

    Examples
    --------
    >>> print(round(PowerLaw(coefficient=1.0, exponent=2.0).reduced(3.0), 12))  # κ₂ = 2
    18.0
    """

    coefficient: float
    exponent: float

    def __post_init__(self):
        _set_positive(self, coefficient="m^(1-n)", exponent="")

    @cached_property
    def _reduced_coefficient(self):
        return kappa(self.exponent) * self.coefficient

    @property
    def zones(self):
        c, n = self._reduced_coefficient, self.exponent
        return (Zone(0.0, np.inf, lambda t: n * c * t ** (n - 1), n - 1),)

    def _height(self, r):
        return self.coefficient * r**self.exponent

    def _reduced(self, x):
        return self._reduced_coefficient * x**self.exponent

    def _radius(self, depth):
        return (depth / self._reduced_coefficient) ** (1 / self.exponent)


def kappa(n):
    """Coefficient κₙ = √π n Γ(n/2)/(2 Γ((n+1)/2)) of a reduced power law.

    Popov (2015), Eq. (7).

    Examples
    --------
    >>> float(kappa(2.0))
    2.0
    """
    if n < 300:
        # n Γ(n/2)/2 = Γ(n/2 + 1), which stays finite as n → 0.
        return np.sqrt(np.pi) * gamma(n / 2 + 1) / gamma((n + 1) / 2)
    # Γ(m + 1/2)/Γ(m) for large m, where the gamma functions overflow.
    m = (n + 1) / 2
    series = np.polyval([869 / 4194304, -399 / 262144, -21 / 32768, 5 / 1024, 1 / 128, -1 / 8, 1], 1 / m)
    return np.sqrt(np.pi * m) * series
