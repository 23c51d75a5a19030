"""Profiles that are a single power of r: flat punch, cone, paraboloid, power law."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...base import check
from ...base.check import ArrayLike, Parameter
from ..numerics.abel import kappa
from .profile import Profile


@dataclass(frozen=True, eq=False)
class FlatPunch(Profile):
    """Flat punch, a cylinder: z = 0 for r ≤ b, and a wall at b.

    Parameters
    ----------
    radius : float
        Radius b of the flat end (m), positive.

    Examples
    --------
    >>> from mdr_core import FlatPunch
    >>> FlatPunch(radius=2.0).contact_radius([0.0, 1.0]).tolist()
    [2.0, 2.0]
    """

    radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, radius: ArrayLike) -> None: ...

    def __post_init__(self):
        check.set_positive(self, radius="m")

    wall = face_radius = property(lambda self: self.radius)

    def height_at(self, r):
        return np.where(r <= self.radius, 0.0, np.inf)

    reduced_at = reduced_slope_at = height_at

    def radius_at(self, depth):
        return np.zeros_like(depth) + self.radius

    radius_at_height = radius_at


@dataclass(frozen=True, eq=False)
class Cone(Profile):
    """Cone z = s r, with g = (π/2) s x.

    Popov (2015), Eqs. (13), (14), (16).

    Parameters
    ----------
    slope : float
        Slope s of the generator, positive: the tangent of its angle to the surface.

    Examples
    --------
    >>> from mdr_core import Cone
    >>> print(Cone(slope=1.0).reduced(1.0))  # π/2
    1.5707963267948966
    """

    slope: Parameter

    if TYPE_CHECKING:

        def __init__(self, slope: ArrayLike) -> None: ...

    def __post_init__(self):
        check.set_positive(self, slope="")

    @classmethod
    @check.keywords_explained
    def from_half_angle(cls, degrees: ArrayLike) -> "Cone":
        """Make a cone with a half-angle between axis and generator, in degrees between 0 and 90.

        Examples
        --------
        >>> from mdr_core import Cone
        >>> print(round(Cone.from_half_angle(45.0).slope, 12))  # its cotangent
        1.0
        """
        angle = check.finite_array("half-angle", degrees, unit="deg")
        bound, advice = "must lie between 0 and 90", "it is the angle between axis and generator"
        check.raise_if("half-angle", angle, ~((angle > 0) & (angle < 90)), bound, unit="deg", advice=advice)
        return cls((np.sin(np.radians(90 - angle)) / np.sin(np.radians(angle)))[()])

    @classmethod
    def berkovich(cls) -> "Cone":
        """Make a cone of half-angle 70.3° with the cross-section of a Berkovich pyramid at each height.

        Examples
        --------
        >>> import numpy as np
        >>> from mdr_core import Cone
        >>> print(round(np.pi / Cone.berkovich().slope ** 2, 1))  # A = 3√3 tan²(65.27°) h²
        24.5
        """
        return cls(math.sqrt(math.pi / (3 * math.sqrt(3.0))) / math.tan(math.radians(65.27)))

    @classmethod
    @check.keywords_explained
    def pyramid(cls, degrees: ArrayLike) -> "Cone":
        """Make a cone with the force of a four-sided pyramid, such as an AFM tip, at each depth.

        The half-angle α is between the axis and a face, in degrees between 0 and 90. F = 0.7453 E* d² tan α
        (Bilodeau, J. Appl. Mech. 59, 1992, 519), as for a cone of slope 2/(0.7453 π tan α).

        Examples
        --------
        >>> import numpy as np
        >>> from mdr_core import Cone, Medium, indent
        >>> from mdr_core import Medium, indent
        >>> state = indent(Cone.pyramid(35.0), Medium(E_star=1.0), 1.0)
        >>> print(round(state.force / np.tan(np.radians(35.0)), 4))
        0.7453
        """
        return cls(2 / (0.7453 * np.pi) * cls.from_half_angle(degrees).slope)

    def height_at(self, r):
        return self.slope * r

    def reduced_at(self, x):
        return np.pi / 2 * self.slope * x

    def reduced_slope_at(self, x):
        return np.pi / 2 * self.slope + 0 * x

    def radius_at(self, depth):
        return depth / (np.pi / 2 * self.slope)

    def radius_at_height(self, height):
        return height / self.slope


@dataclass(frozen=True, eq=False)
class Paraboloid(Profile):
    """Paraboloid z = r²/(2R), with g = x²/R (the Hertzian contact).

    Parameters
    ----------
    radius : float
        Radius of curvature R at the tip (m), positive.

    Examples
    --------
    >>> from mdr_core import Paraboloid
    >>> print(Paraboloid(radius=8.0).contact_radius(2.0))  # √(R d)
    4.0
    """

    radius: Parameter

    if TYPE_CHECKING:

        def __init__(self, radius: ArrayLike) -> None: ...

    def __post_init__(self):
        check.set_positive(self, radius="m")

    body_radius = property(lambda self: self.radius)

    def height_at(self, r):
        return r * (r / (2 * self.radius))

    def reduced_at(self, x):
        return x * (x / self.radius)

    def reduced_slope_at(self, x):
        return 2 * x / self.radius

    def radius_at(self, depth):
        return np.sqrt(self.radius * depth)

    def radius_at_height(self, height):
        return np.sqrt(2 * self.radius * height)


@dataclass(frozen=True, eq=False)
class PowerLaw(Profile):
    """Power law z = c rⁿ, with g = κₙ c xⁿ.

    Popov (2015), Eqs. (4)–(7).

    Parameters
    ----------
    coefficient, exponent : float or array_like
        Coefficient c (m^(1−n)), positive; exponent n, from 0.01 to 100.

    Examples
    --------
    >>> from mdr_core import PowerLaw
    >>> print(round(PowerLaw(coefficient=1.0, exponent=2.0).reduced(3.0), 12))  # κ₂ = 2
    18.0
    """

    coefficient: Parameter
    exponent: Parameter

    if TYPE_CHECKING:

        def __init__(self, coefficient: ArrayLike, exponent: ArrayLike) -> None: ...

    def __post_init__(self):
        check.set_positive(self, coefficient="m^(1-n)", exponent="")
        exponent = np.asarray(self.exponent)
        outside = (exponent < 0.01) | (exponent > 100)
        bound, advice = "must lie between 0.01 and 100", "for a flat end, n → ∞, take FlatPunch"
        check.raise_if("PowerLaw exponent", exponent, outside, bound, advice=advice)

    # The cache makes single states 1.5 times as fast, impacts 1.3 times.
    @cached_property
    def _reduced_coefficient(self):
        return check.frozen(kappa(self.exponent) * self.coefficient)

    def height_at(self, r):
        return self.coefficient * r**self.exponent

    def reduced_at(self, x):
        return self._reduced_coefficient * x**self.exponent

    def reduced_slope_at(self, x):
        # Infinite at the tip for n < 1.
        with np.errstate(divide="ignore"):
            return self.exponent * self._reduced_coefficient * x ** (self.exponent - 1)

    def radius_at(self, depth):
        return self._root(depth, self._reduced_coefficient)

    def radius_at_height(self, height):
        return self._root(height, self.coefficient)

    def _root(self, height, c):
        """Return the length x (m) at which c xⁿ is a height (m)."""
        p = 1 / self.exponent
        # For large exponents z/c may underflow while its power does not.
        if np.all(p < 0.25):
            return height**p / c**p
        joint = (height / c) ** p
        return np.where(p < 0.25, height**p / c**p, joint) if np.any(p < 0.25) else joint

    def _known(self, depth):
        with np.errstate(over="ignore"):
            far = self.radius_at(np.maximum(depth, 0.0)) > check.FARTHEST
        return check.raise_if(
            "depth", depth, far, "has a contact beyond double precision", unit="m", advice="press less deep"
        )
