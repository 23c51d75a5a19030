"""The parameters of a fit: their units, the values that they may have, and how they are searched.

A search is in scaled parameters x of about 1: logarithms, or numbers in a unit that the data give. One more
parameter is an argument of `fit_indentation`, a row of `PARAMETERS`, and a derivative of the force in
`model.py`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import check
from ...show.quantities import QUANTITIES, Quantity
from ...solver.medium.medium import Medium

#: First contact is searched down to so many ranges of depth below the record.
REACH = 30.0
_ADHESION = QUANTITIES["work_of_adhesion"]
_TILT, _DRAG = Quantity("F₁", "N/m", "tilt of the baseline"), Quantity("ζ", "N·s/m", "drag")
#: Largest change of a logarithm in a search.
_FARTHEST = 16.0


@dataclass(frozen=True)
class Parameter:
    """A parameter, searched in units (R, 1) that `unit` gives of `Curves`.

    It is held at positive numbers or, if `zero` or `infinite`, at these. `start` is its first value for a
    trial medium t of `start.py`, whose constants of the hardness are over E*; `in_time` says whether it
    needs times.
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
        return check.positive(name, value, unit=self.quantity.unit, **allowed)

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
        # Of elastic media a constant of the hardness is infinite, or 0 beside one that is.
        return np.where((value > 0) & np.isfinite(value), value, 1.0)

    def bounds(self, start, curves):
        return start - _FARTHEST, start + _FARTHEST


class Background(Parameter):
    """A parameter of the force without contact, of any sign."""

    def checked(self, name, value):
        return check.finite_array(name, value, unit=self.quantity.unit)


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


class HardnessTerm(Parameter):
    """A constant of the hardness beside others: practically 0 or positive, since their sum is positive."""

    def bounds(self, start, curves):
        return 1e-9, np.inf


def _viscosity(curves):
    """Viscosity (Pa·s) with which the dashpots carry the range of force at the largest speed."""
    radius = curves.profile.radius_at(np.minimum(curves.length, curves.profile.known_depth))
    return curves.load / (8 * radius * curves.speed)


def _pressed_radius(curves):
    """Radius (m) of the contact under the largest force, about, from the depths with half of it."""
    pressed = curves.force > curves.force.max(axis=1, keepdims=True) - curves.load / 2
    depth = 3 * np.ptp(np.where(pressed, curves.depth, curves.top), axis=1, keepdims=True)
    return curves.profile.radius_at(np.clip(depth, 1e-3 * curves.length, curves.profile.known_depth))


#: The constants of the hardness σ_c = H + q_c/a + f_c/a², by the letters of their classes.
CLASSES = {"a": "hardness", "b": "q_c", "c": "f_c"}
_HARDNESS, _Q_C, _F_C = (QUANTITIES[name] for name in CLASSES.values())
#: Parameters of the medium, with their starts for a trial medium, and of the background with their units.
MEDIUM = {
    "E_star": Logarithm(QUANTITIES["E_star"], lambda t: t["E_star"]),
    "hardness": Logarithm(_HARDNESS, lambda t: t["E_star"] * t["hardness"], zero=True),
    "q_c": Logarithm(_Q_C, lambda t: t["E_star"] * t["q_c"], zero=True, infinite=True),
    "f_c": Logarithm(_F_C, lambda t: t["E_star"] * t["f_c"], zero=True),
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
#: Constants of the hardness where there are several.
TOGETHER = {
    "hardness": HardnessTerm(_HARDNESS, unit=lambda curves: curves.load / _pressed_radius(curves) ** 2),
    "q_c": HardnessTerm(_Q_C, unit=lambda curves: curves.load / _pressed_radius(curves)),
    "f_c": HardnessTerm(_F_C, unit=lambda curves: curves.load),
}
#: All parameters, in the order of a fit.
PARAMETERS = MEDIUM | {"contact_point": ContactPoint(Quantity("z₀", "m", "first contact"))} | BACKGROUND


def symbols(names):
    """Symbols of parameters as a text, as "E* and q_c"."""
    return " and ".join(PARAMETERS[name].quantity.symbol for name in names)


def held_values(count, **values):
    """Values (R,) of the parameters of `count` curves that are held, by name: those that are not None."""
    held = {}
    for name in (name for name, value in values.items() if value is not None):
        if isinstance(values[name], str):
            text = "must be a number, which holds it, or None, which makes it free"
            raise check.MDRError(f"{name} = {values[name]!r} {text}")
        value = PARAMETERS[name].checked(name, values[name])
        if np.shape(value) not in ((), (1,), (count,)):
            shape = np.shape(value)
            raise check.MDRError(
                f"{name} {shape} of {count} curves: give one number, or one for each curve"
            )
        held[name] = np.broadcast_to(value, (count,)).astype(float)
    for name in CLASSES.values():
        if np.any(held.get(name, 0.0)) and not np.all(held[name]):
            raise check.MDRError(f"{name} is 0 for some of the curves only: fit these apart")
    # Refuses a hardness of 0, and an infinite q_c beside another constant.
    Medium(1.0, **{name: held.get(name, 1.0) for name in CLASSES.values()})
    return held


def hardness_by_default(**given):
    """Constants of the hardness as they are given or `...`, which is 0, or a free q_c if none is given."""
    if all(value is ... for value in given.values()):
        return given | {"q_c": None, "hardness": 0.0, "f_c": 0.0}
    return {name: 0.0 if value is ... else value for name, value in given.items()}
