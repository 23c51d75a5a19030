"""The parameters of a fit: their units, the values that they may have, and how they are searched.

A search is in scaled parameters x of about 1: logarithms, or numbers in a unit that the data give. One more
parameter is a row of `PARAMETERS`, an argument of `fit_indentation`, and a derivative of the force in
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
#: Largest change of a logarithm in a search.
_FARTHEST = 16.0


@dataclass(frozen=True)
class Parameter:
    """A parameter of the medium, of the background or of the position, searched in a unit of the data.

    `start` gives its first value from a `Trial` of `start.py`, `unit` its unit (R, 1) from `Curves`; it may
    be held at any number, or at positive ones if it is `positive`, with 0 and infinity where these mean
    something. It is searched from `least` on. `in_time` says whether it needs times.
    """

    quantity: Quantity
    of: str
    start: Callable[[Any], Any]
    unit: Callable[[Any], Any] | None = None
    positive: bool = True
    zero: bool = False
    infinite: bool = False
    in_time: bool = False
    least: float = -np.inf

    def checked(self, name, value):
        """A value at which it may be held, a number or an array."""
        if not self.positive:
            return _check.finite_array(name, value, unit=self.quantity.unit)
        return _check.positive(name, value, unit=self.quantity.unit, zero=self.zero, infinite=self.infinite)

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
        return np.full_like(start, self.least), np.full_like(start, np.inf)


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


class ContactPoint(Parameter):
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


#: All parameters, in the order of a fit.
PARAMETERS = {
    "E_star": Logarithm(QUANTITIES["E_star"], "medium", lambda trial: trial.E_star),
    "q_c": Logarithm(
        QUANTITIES["q_c"],
        "medium",
        lambda trial: yield_constant(trial.E_star, trial.critical_depth),
        infinite=True,
    ),
    "eta": Parameter(
        QUANTITIES["eta"],
        "medium",
        lambda trial: trial.E_star * trial.relaxation_time / 4,
        lambda curves: curves.load / (8 * curves.radius * curves.speed),
        zero=True,
        in_time=True,
        least=0.0,
    ),
    "work_of_adhesion": Logarithm(
        QUANTITIES["work_of_adhesion"],
        "medium",
        lambda trial: trial.E_star * trial.adhesion_length,
        zero=True,
    ),
    "contact_point": ContactPoint(
        Quantity("z₀", "m", "contact point"),
        "position",
        lambda trial: trial.contact_point,
        positive=False,
    ),
    "baseline": Parameter(
        Quantity("F₀", "N", "baseline"),
        "background",
        lambda trial: trial.background["baseline"],
        lambda curves: curves.load,
        positive=False,
    ),
    "tilt": Parameter(
        Quantity("F₁", "N/m", "tilt of the baseline"),
        "background",
        lambda trial: trial.background["tilt"],
        lambda curves: curves.load / curves.length,
        positive=False,
    ),
    "drag": Parameter(
        Quantity("ζ", "N·s/m", "drag"),
        "background",
        lambda trial: trial.background["drag"],
        lambda curves: curves.load / curves.speed,
        positive=False,
        in_time=True,
    ),
}


def _names(what):
    return tuple(name for name, parameter in PARAMETERS.items() if parameter.of == what)


#: Names of the parameters of the medium, and of the background.
MEDIUM, BACKGROUND = _names("medium"), _names("background")
#: Names of those that need times.
IN_TIME = tuple(name for name, parameter in PARAMETERS.items() if parameter.in_time)


def held_values(name, value, count):
    """Values (R,) at which a parameter of `count` curves is held."""
    if isinstance(value, str):
        raise ValueError(
            f"{name} = {value!r} must be a number, which holds it, or None, which makes it free"
        )
    value = PARAMETERS[name].checked(name, value)
    _check.common_shape("fit_indentation", **{name: value, "curves": np.empty(count)})
    return np.broadcast_to(value, (count,)).astype(float)
