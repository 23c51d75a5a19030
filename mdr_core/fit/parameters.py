"""The parameters of a fit: their units, the values that they may have, and how they are searched.

A search is in scaled parameters x of about 1: logarithms, or numbers in a unit that the data give. One more
parameter is an argument of `fit_indentation`, a row of `PARAMETERS`, and a derivative of the force in
`model.py`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _check
from ..medium import yield_constant
from ..results.quantities import QUANTITIES, Quantity

#: The contact point is searched down to so many ranges of depth below the record.
REACH = 30.0
_ADHESION = QUANTITIES["work_of_adhesion"]
_TILT, _DRAG = Quantity("F₁", "N/m", "tilt of the baseline"), Quantity("ζ", "N·s/m", "drag")
#: Largest change of a logarithm in a search.
_FARTHEST = 16.0


@dataclass(frozen=True)
class Parameter:
    """A parameter, searched in units (R, 1) that `unit` gives of `Curves`.

    It is held at positive numbers or, if `zero` or `infinite`, at these. `start` is its first value for a
    trial medium t of `start.py`; `in_time` says whether it needs times.
    """

    quantity: Quantity
    start: Callable[[dict], np.ndarray] | None = None
    unit: Callable[[Any], np.ndarray] | None = None
    zero: bool = False
    infinite: bool = False
    in_time: bool = False

    def checked(self, name, value):
        """A value at which it may be held, a number or an array."""
        allowed = {"zero": self.zero, "infinite": self.infinite}
        return _check.positive(name, value, unit=self.quantity.unit, **allowed)

    def value(self, x, curves):
        """Value (R, 1) of a scaled parameter."""
        return self.unit(curves) * x

    def scaled(self, value, curves):
        """Scaled parameter (R, 1) of a value."""
        return value / self.unit(curves)

    def rate(self, value, curves):
        """Derivative (R, 1) of the value by the scaled parameter."""
        return self.unit(curves)

    def bounds(self, start, curves):
        """Least and largest scaled parameter (R, 1) in a search from a start."""
        return -np.inf, np.inf


class Logarithm(Parameter):
    """A positive parameter that is searched as its logarithm."""

    def value(self, x, curves):
        return np.exp(x)

    def scaled(self, value, curves):
        return np.log(value)

    def rate(self, value, curves):
        return np.where(np.isfinite(value), value, 1.0)

    def bounds(self, start, curves):
        return start - _FARTHEST, start + _FARTHEST


class Background(Parameter):
    """A parameter of the force without contact, of any sign."""

    def checked(self, name, value):
        return _check.finite_array(name, value, unit=self.quantity.unit)


class ContactPoint(Background):
    """The measured depth at first contact, searched as the logarithm of the largest depth of contact."""

    def value(self, x, curves):
        return curves.top - np.exp(x)

    def scaled(self, value, curves):
        return np.log(curves.top - value)

    def rate(self, value, curves):
        return value - curves.top

    def bounds(self, start, curves):
        longest = np.minimum((1 + REACH) * curves.length, curves.profile.known_depth)
        return np.log(1e-4 * curves.length), np.log(longest)


class NotNegative(Parameter):
    """A parameter that is 0 or positive."""

    def bounds(self, start, curves):
        return 0.0, np.inf


def _viscosity(curves):
    """Viscosity (Pa·s) with which the dashpots carry the range of force at the largest speed."""
    radius = curves.profile._radius(np.minimum(curves.length, curves.profile.known_depth))
    return curves.load / (8 * radius * curves.speed)


#: Parameters of the medium, with their starts for a trial medium, and of the background with their units.
MEDIUM = {
    "E_star": Logarithm(QUANTITIES["E_star"], lambda t: t["E_star"]),
    "q_c": Logarithm(QUANTITIES["q_c"], lambda t: yield_constant(t["E_star"], t["d_c"]), infinite=True),
    "eta": NotNegative(
        QUANTITIES["eta"], lambda t: t["E_star"] * t["tau"] / 4, _viscosity, zero=True, in_time=True
    ),
    "work_of_adhesion": Logarithm(_ADHESION, lambda t: t["E_star"] * t["kappa"], zero=True),
}
BACKGROUND = {
    "baseline": Background(Quantity("F₀", "N", "baseline"), unit=lambda curves: curves.load),
    "tilt": Background(_TILT, unit=lambda curves: curves.load / curves.length),
    "drag": Background(_DRAG, unit=lambda curves: curves.load / curves.speed, in_time=True),
}
#: All parameters, in the order of a fit.
PARAMETERS = MEDIUM | {"contact_point": ContactPoint(Quantity("z₀", "m", "contact point"))} | BACKGROUND


def held_values(count, **values):
    """Values (R,) of the parameters of `count` curves that are held, by name: those that are not None."""
    held = {}
    for name in (name for name, value in values.items() if value is not None):
        if isinstance(values[name], str):
            text = "must be a number, which holds it, or None, which makes it free"
            raise ValueError(f"{name} = {values[name]!r} {text}")
        value = PARAMETERS[name].checked(name, values[name])
        _check.common_shape("fit_indentation", **{name: value, "curves": np.empty(count)})
        held[name] = np.broadcast_to(value, (count,)).astype(float)
    return held
