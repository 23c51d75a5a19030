"""Indenter shapes: height z(r), reduced height g(x) and contact radius a(d). Geometry only.

A shape is given by its height z(r), its reduced 1D profile g(x) (Popov 2015, Eq. (3)) and its
`zones`: the stretches of g between kinks, each in a coordinate in which g is smooth, with the
inverse of g in it. Everything else follows from these.
Here are the shapes that are a single power of r.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from . import _check
from .abel import kappa
from .panels import chunks
from .zones import Zone


class Profile(ABC):
    """A rigid axisymmetric indenter with its tip at the origin, growing outward.

    Lengths are in m, slopes dimensionless. Parameters may be arrays that broadcast with each other,
    with radii and depths: many indenters at once, for `impact`.
    """

    #: Radius (m) of a vertical wall, where depth grows at constant contact radius.
    wall = np.inf

    #: Depth and radius (m) beyond which the shape is not known.
    deepest = np.inf
    known_radius = np.inf

    #: Depths (m) at which the edge of the contact passes a kink of g, or reaches the wall.
    kinks = ()

    def __getstate__(self):
        # What is computed from the parameters is not worth keeping, and may hold functions.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def height(self, r):
        """Height z(r) (m) above the tip at radius r (m), of the shape of `r`; even in r."""
        r = self._within(self._places("radius r", r))
        with np.errstate(over="ignore", under="ignore"):
            return self._height(r)[()]

    def reduced(self, x):
        """Height g(x) (m) of the equivalent 1D profile, Popov (2015), Eq. (3); even in x."""
        x = self._within(self._places("coordinate x", x))
        with np.errstate(over="ignore", under="ignore"):
            return self._reduced(x)[()]

    def contact_radius(self, depth):
        """Contact radius a (m) at indentation depth d (m): the largest x with g(x) ≤ d."""
        depth = self._places("depth", depth, most=_check.LARGEST)
        _check.refuse("depth", depth, depth < 0, "is negative", unit="m", remedy="it counts downward")
        depth = self._known(depth)
        with np.errstate(over="ignore", under="ignore"):
            radius = self._radius(depth)
        _check.refuse("depth", depth, np.isinf(radius), "has a contact beyond double precision", unit="m")
        return radius[()]

    def zones_between(self, lower, upper):
        """The zones that hold depths from `lower` to `upper` (m), from the tip outward."""
        return self.zones

    def batches(self, depth):
        """Rows of an array of depths (m) that are solved together, in the zones of the deepest."""
        return chunks(depth.size)

    @cached_property
    def shape(self):
        """Shape to which array-valued parameters broadcast, () for one indenter."""
        return np.broadcast_shapes(*map(np.shape, self.__getstate__().values()))

    def entries(self, index, shape=None):
        """The indenters at an index of the parameters, broadcast to `shape` before."""
        if not self.shape:
            return self
        shape = self.shape if shape is None else shape
        values = self.__getstate__().values()
        return type(self)(*(np.broadcast_to(v, shape)[index] if np.ndim(v) else v for v in values))

    def flat_entries(self, rows, shape):
        """The indenters in some rows of an ensemble of a `shape`, counted flat."""
        if not self.shape:
            return self
        return self.entries(np.unravel_index(np.arange(np.prod(shape, dtype=int))[rows], shape), shape)

    #: For shapes with lengths of their own: the same shape with parameters of 1, and its units of
    #: length and depth (m), so that g(x) is the unit of depth times the unit shape's g(x/length).
    unit = None

    @property
    @abstractmethod
    def zones(self):
        """The smooth stretches of g, from the tip outward: a tuple of `Zone`."""

    @abstractmethod
    def _height(self, r): ...

    @abstractmethod
    def _reduced(self, x): ...

    def _radius(self, depth):
        (zone,) = self.zones
        return zone.radius(zone.coordinate(depth))

    def _places(self, quantity, values, most=_check.FARTHEST):
        """Radii or depths (m), checked and broadcast to the indenters."""
        values = _check.finite_array(quantity, values, unit="m", most=most)
        shape = _check.common_shape(
            type(self).__name__, **{quantity: values}, indenters=np.empty(self.shape)
        )
        return np.broadcast_to(values, shape)

    def _within(self, r):
        """The distance |r|, if the shape is known so far out."""
        r, known = np.abs(r), np.min(self.known_radius, initial=np.inf)
        bound = f"m is beyond the radius up to which the shape is known, {known:g} m"
        return _check.refuse("radius", r, r > self.known_radius, bound)

    def _known(self, depth):
        """`depth`, if the shape is known so far."""
        if np.all(self.deepest == np.inf):
            return depth
        bound = f"is deeper than the shape is known, {np.min(self.deepest, initial=np.inf):g} m"
        return _check.refuse(
            "depth", depth, depth > self.deepest, bound, unit="m", remedy="press less deep"
        )


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
        _check.set_positive(self, radius="m")

    wall = property(lambda self: self.radius)
    zones = ()

    def _height(self, r):
        return np.where(r <= self.radius, 0.0, np.inf)

    _reduced = _height

    def _radius(self, depth):
        return np.zeros_like(depth) + self.radius


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
        _check.set_positive(self, slope="")

    @property
    def zones(self):
        return (Zone(lambda t: np.full_like(t, np.pi / 2 * self.slope), self._radius, order=0),)

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
        _check.set_positive(self, radius="m")

    @property
    def zones(self):
        return (Zone(lambda t: 2 * t / self.radius, self._radius, order=1),)

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
    coefficient : float or array_like
        Coefficient c (m^(1−n)), positive.
    exponent : float or array_like
        Exponent n, from 0.01 to 1000.

    Examples
    --------
    >>> print(round(PowerLaw(coefficient=1.0, exponent=2.0).reduced(3.0), 12))  # κ₂ = 2
    18.0
    """

    coefficient: float
    exponent: float

    def __post_init__(self):
        _check.set_positive(self, coefficient="m^(1-n)", exponent="")
        exponent, reduced = np.asarray(self.exponent), np.asarray(self._reduced_coefficient)
        outside = ~((exponent >= 0.01) & (exponent <= 1000))
        bound = "must lie in 0.01 ≤ n ≤ 1000"
        _check.refuse("PowerLaw exponent", exponent, outside, bound, remedy="FlatPunch is n → ∞")
        bound = "m^(1-n), the coefficient of the reduced profile, leaves double precision"
        outside = ~((reduced > 0) & (reduced < np.inf))
        _check.refuse("κₙ c", reduced, outside, bound, remedy="use another unit of length")

    @cached_property
    def _reduced_coefficient(self):
        with np.errstate(over="ignore"):
            return _check.frozen(kappa(self.exponent) * self.coefficient)

    @property
    def zones(self):
        c, n = self._reduced_coefficient, self.exponent
        return (Zone(lambda t: n * c * t ** (n - 1), self._radius, order=n - 1),)

    def _height(self, r):
        return self.coefficient * r**self.exponent

    def _reduced(self, x):
        return self._reduced_coefficient * x**self.exponent

    def _radius(self, depth):
        c, p = self._reduced_coefficient, 1 / self.exponent
        # Where the shape is nearly flat d/c may underflow, and the radius is still a radius.
        if np.all(p < 0.25):
            return depth**p / c**p
        joint = (depth / c) ** p
        return np.where(p < 0.25, depth**p / c**p, joint) if np.any(p < 0.25) else joint

    def _known(self, depth):
        with np.errstate(over="ignore"):
            far = self._radius(np.maximum(depth, 0.0)) > _check.FARTHEST
        return _check.refuse("depth", depth, far, "has a contact beyond double precision", unit="m")
