"""Parameters of a fit: units, ranges and scaling.

The search uses scaled parameters x of about 1: logarithms, or numbers in a unit from the data. A new
parameter needs an argument of `fit_indentation`, a row of `PARAMETERS`, and a derivative of the force in
`model.py`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base import check
from ...show.quantities import QUANTITIES, Quantity
from ...solver.medium.medium import Medium

#: Largest distance of first contact below the record, in ranges of depth.
REACH = 30.0
_ADHESION = QUANTITIES["work_of_adhesion"]
_TILT, _DRAG = Quantity("F₁", "N/m", "tilt of the baseline"), Quantity("ζ", "N·s/m", "drag")
#: Largest change of a logarithm in a search.
_FARTHEST = 16.0


@dataclass(frozen=True)
class Parameter:
    """Parameter, searched in the units (R, 1) that `unit` returns for `Curves`.

    It may be held at positive numbers, with `zero` also at 0, and with `infinite` at ∞. `start` returns its
    first value for a trial medium t of `start.py`, whose hardness constants are over E*. `in_time` is true
    if the parameter needs times.
    """

    quantity: Quantity
    start: Callable[[dict], np.ndarray] | None = None
    unit: Callable[[Any], np.ndarray] | None = None
    zero: bool = False
    infinite: bool = False
    in_time: bool = False

    def checked(self, name, value):
        """Return a valid value to hold, a number or an array; raise MDRError for other values."""
        allowed = {"zero": self.zero, "infinite": self.infinite}
        return check.positive(name, value, unit=self.quantity.unit, **allowed)

    def value(self, x, curves):
        """Return the value (R, 1) of a scaled parameter."""
        return self.unit(curves) * x

    def scaled(self, value, curves):
        """Return the scaled parameter (R, 1) of a value."""
        return value / self.unit(curves)

    def rate(self, value, curves):
        """Return the derivative (R, 1) of the value with respect to the scaled parameter."""
        return self.unit(curves)

    def bounds(self, start, curves):
        """Return the bounds (R, 1) of the scaled parameter in a search from a start."""
        return -np.inf, np.inf


class Logarithm(Parameter):
    """Positive parameter, searched as its logarithm."""

    def value(self, x, curves):
        return np.exp(x)

    def scaled(self, value, curves):
        return np.log(value)

    def rate(self, value, curves):
        # The hardness constants of elastic media are infinite or 0; scale them by 1.
        return np.where((value > 0) & np.isfinite(value), value, 1.0)

    def bounds(self, start, curves):
        return start - _FARTHEST, start + _FARTHEST


class Background(Parameter):
    """Parameter of the force without contact, of any sign."""

    def checked(self, name, value):
        return check.finite_array(name, value, unit=self.quantity.unit)


class ContactPoint(Background):
    """Measured depth at first contact, searched as the logarithm of the largest depth of contact."""

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
    """Parameter that is 0 or positive."""

    def bounds(self, start, curves):
        return 0.0, np.inf


class HardnessTerm(Parameter):
    """One of several constants of the hardness: practically 0 or positive, as their sum is positive."""

    def bounds(self, start, curves):
        return 1e-9, np.inf


def _viscosity(curves):
    """Return the viscosity (Pa·s) with which dashpots carry the range of force at the largest speed."""
    radius = curves.profile.radius_at(np.minimum(curves.length, curves.profile.known_depth))
    return curves.load / (8 * radius * curves.speed)


def _pressed_radius(curves):
    """Estimate the contact radius (m) at the largest force, from the depths in the upper half of it."""
    pressed = curves.force > curves.force.max(axis=1, keepdims=True) - curves.load / 2
    depth = 3 * np.ptp(np.where(pressed, curves.depth, curves.top), axis=1, keepdims=True)
    return curves.profile.radius_at(np.clip(depth, 1e-3 * curves.length, curves.profile.known_depth))


#: Constants of the hardness σ_c = H + q_c/a + f_c/a², by the letters of their classes.
CLASSES = {"a": "hardness", "b": "q_c", "c": "f_c"}
_HARDNESS, _Q_C, _F_C = (QUANTITIES[name] for name in CLASSES.values())
#: Parameters of the medium with their starts for a trial medium, and of the background with their units.
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
#: Constants of the hardness if there are several.
TOGETHER = {
    "hardness": HardnessTerm(_HARDNESS, unit=lambda curves: curves.load / _pressed_radius(curves) ** 2),
    "q_c": HardnessTerm(_Q_C, unit=lambda curves: curves.load / _pressed_radius(curves)),
    "f_c": HardnessTerm(_F_C, unit=lambda curves: curves.load),
}
#: All parameters, in the order of a fit.
PARAMETERS = MEDIUM | {"contact_point": ContactPoint(Quantity("z₀", "m", "first contact"))} | BACKGROUND


def symbols(names):
    """Return the symbols of parameters as a text, such as "E* and q_c"."""
    return " and ".join(PARAMETERS[name].quantity.symbol for name in names)


def held_values(count, **values):
    """Return the values (R,) of the held parameters, which are not None, of `count` curves by name."""
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
            raise check.MDRError(f"{name} is 0 for some curves only: fit these curves separately")
    # Raises an error for a hardness of 0, and for an infinite q_c with another constant.
    Medium(1.0, **{name: held.get(name, 1.0) for name in CLASSES.values()})
    return held


def hardness_by_default(**given):
    """Return the hardness constants with `...` replaced by 0, or by a free q_c if no constant is given."""
    if all(value is ... for value in given.values()):
        return given | {"q_c": None, "hardness": 0.0, "f_c": 0.0}
    return {name: 0.0 if value is ... else value for name, value in given.items()}
