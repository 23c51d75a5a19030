"""Base class of profiles: height z(r), reduced height g(x), its slope g′(x) and its kinks."""

from abc import ABC, abstractmethod
from functools import cached_property
from typing import Any

import numpy as np

from ...base import check, lazy, read_only
from ...base.check import Array, ArrayLike
from ...base.remark import Remark
from ..numerics.roots import increasing_root

#: Relative distance of two radii for the slope in a search. The slope need not be exact.
_APART = 1e-7

#: Former and present names of the functions of a shape.
_FORMER = {
    "_height": "height_at",
    "_reduced": "reduced_at",
    "_reduced_slope": "reduced_slope_at",
    "_radius": "radius_at",
}


def is_own(profile):
    """Whether a user wrote the class of a profile."""
    return not type(profile).__module__.startswith(f"{__package__}.")


class Profile(check.Parameters, ABC):
    """Base class of shapes: rigid axisymmetric indenters, from the tip at the origin outward.

    A custom profile is a frozen dataclass with the first three functions below. They take an array of
    lengths (m) ≥ 0, without checks, and return an array of its shape. They must not change their argument.
    In addition to its parameters, solvers use eleven names of a profile. A shape defines the names that
    differ from the base class::

        height_at(r)          height z (m) at radii r (m)
        reduced_at(x)         height g (m) of the equivalent 1D profile at x (m), which does not fall
        reduced_slope_at(x)   its slope g′, without unit; on a kink, the slope of the outer side
        radius_at(depth)      contact radius a (m) at depths (m), g(a) = depth; by default found from g
        radius_at_height(z)   radius r (m) at heights (m), z(r) = z; by default found from z
        face_radius           radius (m) of a flat face at the tip; 0 without a face
        wall                  radius (m) of a vertical wall; ∞ without a wall
        kinks                 depths (m) at which the edge of the contact passes a kink of g, a tuple
        known_depth           depth (m) to which the shape is known; by default found from g
        known_radius          radius (m) to which the shape is known; by default found from g
        too_deep()            words for depths beyond known_depth, in errors

    The checked functions for users are `height`, `reduced`, `reduced_slope` and `contact_radius`.
    `body_radius` and `transition_depth` are for limits in words, and scales. Parameters may be arrays that
    broadcast with each other, with radii and with depths: an ensemble of indenters for `impact`.

    Every calculation checks a custom shape at 200 radii, from 10⁻⁶ of its largest contact radius up to it:
    g is 0 at the tip, finite, and does not fall, z is finite, and g′ is a number. Without known_depth and
    known_radius, a single shape ends where a function has no value, or g does not rise any more. An error
    is raised if g′ differs from the slope of g by more than 30 % at three quarters of the radii, or if a
    contact radius differs by 0.1 % from the radius that follows from g. Kinks, jumps of g and coarse tables
    are allowed.

    Examples
    --------
    The sum of a cone and a paraboloid, z = s r + r²/(2R). The transform to g (Popov 2015, Eq. (3)) is
    linear, so that their reduced heights add up:

    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> from mdr_core import Medium, Profile, indent
    >>> @dataclass(frozen=True)
    ... class Pencil(Profile):
    ...     slope: float
    ...     radius: float
    ...
    ...     def height_at(self, r):
    ...         return self.slope * r + r**2 / (2 * self.radius)
    ...
    ...     def reduced_at(self, x):
    ...         return np.pi / 2 * self.slope * x + x**2 / self.radius
    ...
    ...     def reduced_slope_at(self, x):
    ...         return np.pi / 2 * self.slope + 2 * x / self.radius
    >>> state = indent(Pencil(0.1, 1e-6), Medium(E_star=1e9, q_c=1.0), 20e-9)
    >>> print(f"a = {state.contact_radius * 1e9:.3f} nm, F = {state.force * 1e6:.4f} µN")
    a = 83.227 nm, F = 0.2538 µN
    """

    #: Radius (m) of a vertical wall, at which depth grows at constant contact radius.
    wall = np.inf
    #: Radius (m) of a flat face at the tip: the contact radius at depth 0.
    face_radius = 0.0
    #: Radius (m) of the body behind the tip; the half-space needs a contact that is small compared with it.
    body_radius = np.inf
    #: Depths (m), ascending, at which the edge of the contact passes a kink of g, or reaches the wall.
    kinks = ()
    #: Whether it is a polygon through samples; its kinks are not edges of the body.
    polygonal = False
    #: Depth (m) at which g changes from one power of x to another, None if it is not known.
    transition_depth = None
    #: Remarks on changes to the input of the profile, such as a concave area function.
    remarks: tuple[Remark, ...] = ()
    #: Words for the end of the known depth.
    _last = "the shape is known"

    def __init_subclass__(cls, **keywords: Any):
        super().__init_subclass__(**keywords)
        for name in ("known_depth", "known_radius"):
            if name in cls.__annotations__ and name not in vars(cls):
                # A field without a default must not inherit the property from g.
                setattr(cls, name, np.inf)
        for old, new in _FORMER.items():
            if old in vars(cls):
                raise TypeError(
                    f"{cls.__name__} defines {old}, a former name of a function of a shape: call it {new}; "
                    f"a shape defines {', '.join(_FORMER.values())}, the last only in closed form"
                )
        if "height_at" in vars(cls) and "radius_at_height" not in vars(cls):
            # The parent class's function would be the inverse of another height.
            cls.radius_at_height = Profile.radius_at_height
        read_only.guard_methods(cls, (*_FORMER.values(), "radius_at_height"))

    @cached_property
    def known_depth(self):
        """Largest depth (m) for which the profile is known."""
        return np.inf if self.shape or not is_own(self) else self.sound.depth

    @cached_property
    def known_radius(self):
        """Largest radius (m) for which the profile is known."""
        return np.inf if self.shape or not is_own(self) else self.sound.radius

    @cached_property
    def sound(self):
        """The `ValidRange` of a user's profile."""
        given = type(self).known_radius is not Profile.known_radius
        return lazy.shape.sound_range(self, min(self.wall, self.known_radius if given else np.inf))

    @abstractmethod
    def height_at(self, r: np.ndarray) -> np.ndarray:
        """Return the height z (m) at radii r ≥ 0 (m), an array; unchecked."""

    @abstractmethod
    def reduced_at(self, x: np.ndarray) -> np.ndarray:
        """Return the height g (m) of the equivalent 1D profile at x ≥ 0 (m), an array; unchecked."""

    @abstractmethod
    def reduced_slope_at(self, x: np.ndarray) -> np.ndarray:
        """Return the slope g′ at x ≥ 0 (m), an array; unchecked."""

    def height(self, r: ArrayLike) -> Array:
        """Return the height z(r) (m) above the tip at radii r (m); even in r."""
        return self._of_radius("radius r", r, self.height_at)

    def reduced(self, x: ArrayLike) -> Array:
        """Return the height g(x) (m) of the equivalent 1D profile, Popov (2015), Eq. (3); even in x."""
        return self._of_radius("coordinate x", x, self.reduced_at)

    def reduced_slope(self, x: ArrayLike) -> Array:
        """Return the slope g′(x) (dimensionless) of the equivalent 1D profile, on a kink of its outer side.

        It is odd in x, and infinite at the sharp edge of a flat face, and at the radius of a wall and
        outside.
        """
        sign = np.where(check.finite_array("coordinate x", x, unit="m") < 0, -1.0, 1.0)
        slope = self._of_radius("coordinate x", x, self.reduced_slope_at)
        return (sign * np.where(np.abs(x) >= self.wall, np.inf, slope))[()]

    def contact_radius(self, depth: ArrayLike) -> Array:
        """Return the contact radius a (m) at indentation depth d (m): the largest x with g(x) ≤ d."""
        depth = self._places("depth", depth, most=check.LONGEST)
        check.raise_if("depth", depth, depth < 0, "is negative", unit="m", advice="it counts downward")
        depth = self._known(depth)
        # At the known depth, rounding in a search may lead beyond the known radius.
        radius = np.minimum(self.radius_at(depth), self.known_radius)
        bound, advice = "has a contact beyond double precision", "press less deep"
        check.raise_if("depth", depth, np.isinf(radius), bound, unit="m", advice=advice)
        advice = f"correct radius_at of {type(self).__name__}"
        check.raise_if("depth", depth, np.isnan(radius), "has no contact radius", unit="m", advice=advice)
        return radius[()]

    def radius_at(self, depth):
        """Return the contact radius (m) at depths (m) from 0 to the known depth, an array; unchecked."""
        root = increasing_root(
            lambda x: (self.reduced_at(x), self.reduced_slope_at(x)), depth, 1.0, self.known_radius
        )
        # A search passes a wall, where g jumps.
        return np.minimum(np.maximum(root, self.face_radius), self.wall)

    def radius_at_height(self, height):
        """Return the largest radius (m) with z(r) ≤ heights ≥ 0 (m), ∞ if z is not known; unchecked."""

        def height_and_slope(r):
            z, inside = self.height_at(r), r * (1 - _APART)
            # Outside a wall z is infinite: without a slope, the search halves its bracket.
            with np.errstate(invalid="ignore"):
                return z, (z - self.height_at(inside)) / (r - inside)

        known = np.minimum(self.wall, self.known_radius)
        radius = increasing_root(height_and_slope, height, height, known)
        return np.maximum(np.minimum(radius, self.wall), self.face_radius)

    def _of_radius(self, quantity, r, function):
        """Return `function` at checked radii |r| (m)."""
        r = np.abs(self._places(quantity, r))
        known = np.min(self.known_radius, initial=np.inf)
        bound = f"must not exceed the known radius of the shape, {known:g} m"
        advice = "give a smaller radius"
        check.raise_if(quantity, r, r > self.known_radius, bound, unit="m", advice=advice)
        values = function(r)[()]
        advice = f"correct {function.__name__} of {type(self).__name__}"
        check.raise_if(quantity, r, np.isnan(values), "has no height or slope", unit="m", advice=advice)
        return values

    def _places(self, quantity, values, most=check.FARTHEST):
        """Return radii or depths (m), checked and broadcast to the ensemble."""
        values = check.finite_array(quantity, values, unit="m", most=most)
        given = {quantity: values, "indenters": np.empty(self.shape)}
        return np.broadcast_to(values, check.common_shape(type(self).__name__, **given))

    def _known(self, depth):
        """Return `depth` (m) if it is within the known depth; a shape without an end may override it."""
        if np.all(self.known_depth == np.inf):
            return depth
        too_deep = depth > self.known_depth
        bound = f"is {self.too_deep()}"
        return check.raise_if("depth", depth, too_deep, bound, unit="m", advice="press less deep")

    def too_deep(self):
        """Return words for depths beyond `known_depth`, for error messages."""
        end = self.sound if is_own(self) and not self.shape else None
        if end and end.fault and self.known_depth == end.depth:
            return (
                f"deeper than {type(self).__name__} is valid, {end.depth:g} m, because {end.fault}: "
                "correct its functions, or give known_depth and known_radius, or wall, at its end"
            )
        deepest = np.min(self.known_depth)
        if deepest > check.LONGEST:
            return f"deeper than {check.LONGEST:g} m, the largest depth that is computed"
        return f"deeper than {self._last}, {deepest:g} m"


def check_known(profile: Profile, depth: np.ndarray) -> np.ndarray:
    """Return `depth` (m) if it does not exceed the known depth; otherwise raise the profile's error."""
    return profile._known(depth)  # noqa: SLF001
