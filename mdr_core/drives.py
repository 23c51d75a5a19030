"""Drives of the indenter of a scene: paths of depth and force, and impacts of free bodies."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import ClassVar

import numpy as np

from . import _check
from ._check import ArrayLike, Parameter
from .dynamics.impact import solve_impact
from .dynamics.oblique import FRICTION, oblique_impact
from .foundation.depth_path import TimedIndentation, check_times, indent_in_time
from .foundation.force_path import creep
from .foundation.impact import chain_impact
from .indentation import Indentation
from .medium import Medium
from .paths import indent, indent_to_force
from .results.base import CHAIN, CLOSED_FORM, SCALAR_ODE, Model


class _Path:
    """Base class of a path of a quantity, the first field of a subclass, with or without `time`."""

    _unit: ClassVar[str]
    _slowly: ClassVar[Callable[..., Indentation]]
    _in_time: ClassVar[Callable[..., TimedIndentation]]
    time: ArrayLike | None

    def __post_init__(self):
        quantity = f"{type(self).__name__} {self._name}"
        path = _check.finite_array(quantity, self._path, unit=self._unit, most=_check.LONGEST)
        if path.ndim > 1 or not path.size:
            raise ValueError(f"{quantity} must be a number or a path, got shape {path.shape}")
        object.__setattr__(self, self._name, tuple(path.tolist()) if path.ndim else path.item())
        if self.time is not None:
            object.__setattr__(self, "time", tuple(check_times(self.time, path, self._name).tolist()))

    _name = property(lambda self: fields(self)[0].name)
    _path = property(lambda self: getattr(self, self._name))

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Names of the models for this drive, the cheapest exact one first."""
        if medium.work_of_adhesion > 0:
            return (CLOSED_FORM,)
        return (CHAIN,) if self.time and medium.eta > 0 else (CLOSED_FORM, CHAIN)

    def solve(self, profile, medium, model):
        """The `Indentation` along this path, or on the chain the `TimedIndentation`."""
        if model == CLOSED_FORM:
            return type(self)._slowly(profile, medium, self._path)
        path, time = np.atleast_1d(self._path), self.time
        if time is None:
            # An infinitely slow path is a path without viscosity at any times.
            time, medium = np.arange(float(path.size)), replace(medium, eta=0.0)
        result = type(self)._in_time(profile, medium, path, np.asarray(time))
        return result if np.ndim(self._path) else result[0]


@dataclass(frozen=True)
class DepthPath(_Path):
    """Press along prescribed depths.

    Parameters
    ----------
    depth : float or sequence of float
        Indentation depth (m), a number or a path.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is infinitely slow.
    """

    depth: Parameter
    time: ArrayLike | None = None

    _unit, _slowly, _in_time = "m", staticmethod(indent), staticmethod(indent_in_time)


@dataclass(frozen=True)
class ForcePath(_Path):
    """Press with prescribed forces.

    Parameters
    ----------
    force : float or sequence of float
        Normal force (N), a number or a path; not negative.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is infinitely slow.
    """

    force: Parameter
    time: ArrayLike | None = None

    _unit, _slowly, _in_time = "N", staticmethod(indent_to_force), staticmethod(creep)


@dataclass(frozen=True)
class FreeImpact:
    """Impact of a free body.

    Parameters
    ----------
    mass, speed : float
        Mass m (kg), and speed v₀ (m/s) at first contact, positive.
    plastic_depth : float
        Plastic depth (m) after earlier impacts on the same spot; 0, the default, for a virgin surface.
    """

    mass: float
    speed: float
    plastic_depth: float = 0.0

    def __post_init__(self):
        for name, unit in (("mass", "kg"), ("speed", "m/s"), ("plastic_depth", "m")):
            quantity, value = f"FreeImpact {name}", getattr(self, name)
            value = _check.positive_number(quantity, value, unit=unit, zero=name == "plastic_depth")
            object.__setattr__(self, name, value)

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Names of the models for this drive, the cheapest exact one first."""
        if medium.work_of_adhesion > 0:
            return (CLOSED_FORM,)
        # The state of a chain with an imprint is more than the plastic depth: `chain_impact(start=…)`.
        models = (SCALAR_ODE, CHAIN) if medium.eta > 0 else (CLOSED_FORM, SCALAR_ODE, CHAIN)
        return models[:-1] if self.plastic_depth > 0 else models

    def solve(self, profile, medium, model):
        """The `Impact` of this body, or on the chain the `ChainImpact`."""
        if model == CHAIN:
            return chain_impact(profile, medium, self.mass, self.speed)
        in_time = model == SCALAR_ODE
        return solve_impact(profile, medium, self.mass, self.speed, self.plastic_depth, in_time=in_time)


@dataclass(frozen=True)
class FreeObliqueImpact:
    """Oblique impact of a free body with friction.

    Parameters
    ----------
    mass, speed : float
        Mass m (kg), and normal speed v₀ (m/s) at first contact, positive.
    tangential_speed : float
        Speed W₀ (m/s) of the contact point along the surface, of any sign.
    friction : float
        Coefficient of friction μ, not negative.
    tangential_mass : float, optional
        Mass m_t (kg) at the contact point along the surface; by default m. See `Ball.tangential_mass`.
    """

    mass: float
    speed: float
    tangential_speed: float
    friction: float
    tangential_mass: float | None = None

    def __post_init__(self):
        if self.tangential_mass is None:
            object.__setattr__(self, "tangential_mass", self.mass)
        units = zip(fields(self), ("kg", "m/s", "m/s", "", "kg"), strict=True)
        for name, unit in ((field.name, unit) for field, unit in units):
            quantity = f"FreeObliqueImpact {name}"
            value = _check.number(quantity, getattr(self, name), unit)
            if name != "tangential_speed":
                value = _check.positive(quantity, value, unit=unit, zero=name == "friction")
            object.__setattr__(self, name, value)

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Names of the models for this drive."""
        return (FRICTION,)

    def solve(self, profile, medium, model):
        """The `ObliqueImpact` of this body."""
        return oblique_impact(
            profile, medium, self.mass, self.speed, self.tangential_speed, self.friction,
            tangential_mass=self.tangential_mass,
        )  # fmt: skip
