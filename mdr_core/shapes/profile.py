"""What a shape is: its height z(r), its reduced height g(x), the slope g′(x), and where g has kinks."""

from abc import ABC, abstractmethod

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from .._numeric import increasing_root


class Profile(_check.Parameters, ABC):
    """A rigid axisymmetric indenter with its tip at the origin, growing outward.

    Lengths are in m, slopes dimensionless. A shape of your own is a frozen dataclass that gives `_height`,
    `_reduced` and `_reduced_slope` for arrays of radii that are not negative, and what it has of
    `face_radius`, `wall` and `kinks`; everything else follows. Parameters may be arrays that broadcast with
    each other, with radii and depths: many indenters at once, for `impact`.

    Examples
    --------
    A cone on top of a paraboloid, z = s r + r²/(2R), which is not in the library. The transform to g
    (Popov 2015, Eq. (3)) is linear, so that their reduced heights add up:

    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> from mdr_core import Medium, Profile, indent
    >>> @dataclass(frozen=True)
    ... class Pencil(Profile):
    ...     slope: float
    ...     radius: float
    ...
    ...     def _height(self, r):
    ...         return self.slope * r + r**2 / (2 * self.radius)
    ...
    ...     def _reduced(self, x):
    ...         return np.pi / 2 * self.slope * x + x**2 / self.radius
    ...
    ...     def _reduced_slope(self, x):
    ...         return np.pi / 2 * self.slope + 2 * x / self.radius
    >>> state = indent(Pencil(0.1, 1e-6), Medium(E_star=1e9, q_c=1.0), 20e-9)
    >>> print(f"a = {state.contact_radius * 1e9:.3f} nm, F = {state.force * 1e6:.4f} µN")
    a = 83.227 nm, F = 0.2538 µN
    """

    #: Radius (m) of a vertical wall, where depth grows at constant contact radius.
    wall = np.inf

    #: Radius (m) of a flat face at the tip: the contact radius at depth 0.
    face_radius = 0.0

    #: Depth and radius (m) beyond which the shape is not known.
    known_depth = np.inf
    _end_of_depth = "the shape is known"
    known_radius = np.inf

    #: Radius (m) of the body that the tip belongs to, which a contact is small against.
    body_radius = np.inf

    #: Depths (m), ascending, at which the edge of the contact passes a kink of g, or reaches the wall.
    kinks = ()

    #: Depth (m) at which the tip goes over from one power of the radius to another, if that is known.
    transition_depth = None

    #: For shapes with one length of their own: the shape with parameters of 1, and its units of length
    #: and depth (m), so that g(x) is the unit of depth times the unit shape's g(x/length).
    unit = None

    @abstractmethod
    def _height(self, r): ...

    @abstractmethod
    def _reduced(self, x): ...

    @abstractmethod
    def _reduced_slope(self, x): ...

    def height(self, r: ArrayLike) -> Array:
        """Height z(r) (m) above the tip at radius r (m), of the shape of `r`; even in r."""
        return self._of_radius("radius r", r, self._height)

    def reduced(self, x: ArrayLike) -> Array:
        """Height g(x) (m) of the equivalent 1D profile, Popov (2015), Eq. (3); even in x."""
        return self._of_radius("coordinate x", x, self._reduced)

    def reduced_slope(self, x: ArrayLike) -> Array:
        """Slope g′(x) (dimensionless) of the equivalent 1D profile, on the outer side where x is on a kink.

        Odd in x; infinite at the edge of a flat face with a sharp edge, and from a wall on.

        Examples
        --------
        >>> from mdr_core import Paraboloid
        >>> Paraboloid(radius=2.0).reduced_slope([-1.0, 3.0]).tolist()  # 2x/R
        [-1.0, 3.0]
        """
        sign = np.where(_check.finite_array("coordinate x", x, unit="m") < 0, -1.0, 1.0)
        slope = self._of_radius("coordinate x", x, self._reduced_slope)
        return (sign * np.where(np.abs(x) >= self.wall, np.inf, slope))[()]

    def contact_radius(self, depth: ArrayLike) -> Array:
        """Contact radius a (m) at indentation depth d (m): the largest x with g(x) ≤ d."""
        depth = self._places("depth", depth, most=_check.LARGEST)
        _check.refuse("depth", depth, depth < 0, "is negative", unit="m", remedy="it counts downward")
        depth = self._known(depth)
        with np.errstate(all="ignore"):
            radius = self._radius(depth)
        _check.refuse("depth", depth, np.isinf(radius), "has a contact beyond double precision", unit="m")
        return radius[()]

    def _radius(self, depth):
        """Contact radius (m) at depths that are not negative and not beyond what is known."""

        def height(x):
            return self._reduced(x), self._reduced_slope(x)

        return np.maximum(increasing_root(height, depth, 1.0, self.known_radius), self.face_radius)

    def _kink_above(self, depth):
        """The last kink (m) above each depth, or the tip."""
        above = np.zeros_like(depth)
        for kink in self.kinks:
            above = np.where(kink <= depth, kink, above)
        return above

    def flat_entries(self, rows, shape):
        """The indenters in some rows of an ensemble of a `shape`, counted flat."""
        if not self.shape:
            return self
        if isinstance(rows, slice):
            rows = np.arange(*rows.indices(np.prod(shape, dtype=int)))
        return self.entries(np.unravel_index(rows, shape), shape)

    def _of_radius(self, quantity, r, function):
        r, known = np.abs(self._places(quantity, r)), np.min(self.known_radius, initial=np.inf)
        bound = f"m is beyond the radius up to which the shape is known, {known:g} m"
        _check.refuse("radius", r, r > self.known_radius, bound)
        with np.errstate(all="ignore"):
            return function(r)[()]

    def _places(self, quantity, values, most=_check.FARTHEST):
        """Radii or depths (m), checked and broadcast to the indenters."""
        values = _check.finite_array(quantity, values, unit="m", most=most)
        shape = _check.common_shape(
            type(self).__name__, **{quantity: values}, indenters=np.empty(self.shape)
        )
        return np.broadcast_to(values, shape)

    def _known(self, depth):
        """`depth`, if the shape is known so far."""
        if np.all(self.known_depth == np.inf):
            return depth
        bound = f"is {self._too_deep()}"
        return _check.refuse(
            "depth", depth, depth > self.known_depth, bound, unit="m", remedy="press less deep"
        )

    def _too_deep(self):
        """What is wrong with a depth beyond `known_depth`, for a refusal."""
        return f"deeper than {self._end_of_depth}, {np.min(self.known_depth, initial=_check.LARGEST):g} m"
