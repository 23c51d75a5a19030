"""Drives: small values that say what is done with an indenter, and solve it."""

from dataclasses import dataclass

import numpy as np

from . import _check
from .chain_impact import chain_impact
from .creep import indent_to_force_in_time
from .impact import solve_impact
from .indentation import indent, indent_to_force
from .medium import Medium
from .model import CHAIN, CLOSED_FORM, SCALAR_ODE
from .timed import check_times, indent_in_time


def _path(quantity, values, unit):
    values = _check.finite_array(quantity, values, unit=unit)
    if values.ndim > 1 or not values.size:
        raise ValueError(f"{quantity} must be a number or a path, got shape {values.shape}")
    return tuple(values.tolist()) if values.ndim else values.item()


def _times(quantity, values, path):
    if values is None:
        return None
    return tuple(check_times(values, np.asarray(path), quantity).tolist())


@dataclass(frozen=True)
class DepthPath:
    """Press along prescribed depths.

    Parameters
    ----------
    depth : float or sequence of float
        Indentation depth (m), one or a path.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is followed infinitely slowly.
    """

    depth: float | tuple[float, ...]
    time: tuple[float, ...] | None = None

    def __post_init__(self):
        object.__setattr__(self, "depth", _path("DepthPath depth", self.depth, "m"))
        object.__setattr__(self, "time", _times("depth", self.time, self.depth))

    def models(self, medium):
        """Names of the models that can solve it, the cheapest that is exact first."""
        return (CHAIN,) if self.time and medium.eta > 0 else (CLOSED_FORM, CHAIN)

    def solve(self, profile, medium, model):
        """The `Indentation` along this path, or on the chain the `TimedIndentation`."""
        if model == CLOSED_FORM:
            return indent(profile, medium, self.depth)
        path, time, medium = _on_the_chain(self.depth, self.time, medium)
        profile._known(path)
        result = indent_in_time(profile, medium, path, time, 1e-6)
        return result if np.ndim(self.depth) else result[0]


@dataclass(frozen=True)
class ForcePath:
    """Press with prescribed forces.

    Parameters
    ----------
    force : float or sequence of float
        Normal force (N), one or a path; not negative.
    time : sequence of float, optional
        Increasing times (s) of a path; without them it is followed infinitely slowly.
    """

    force: float | tuple[float, ...]
    time: tuple[float, ...] | None = None

    def __post_init__(self):
        object.__setattr__(self, "force", _path("ForcePath force", self.force, "N"))
        object.__setattr__(self, "time", _times("force", self.time, self.force))

    models = DepthPath.models

    def solve(self, profile, medium, model):
        """The `Indentation` along this path, or on the chain the `TimedIndentation`."""
        # The checks of a force are the same, whatever the model.
        slow = indent_to_force(profile, medium, self.force)
        if model == CLOSED_FORM:
            return slow
        path, time, medium = _on_the_chain(self.force, self.time, medium)
        result = indent_to_force_in_time(profile, medium, path, time, 1e-4)
        return result if np.ndim(self.force) else result[0]


def _on_the_chain(path, time, medium):
    """Path, times and medium as the chain takes them: infinitely slow is without viscosity."""
    path = np.atleast_1d(path)
    if time is None:
        return path, np.arange(float(path.size)), Medium(medium.E_star, medium.q_c)
    return path, np.asarray(time), medium


@dataclass(frozen=True)
class FreeImpact:
    """Let a free body hit the medium.

    Parameters
    ----------
    mass : float
        Mass m (kg), positive.
    speed : float
        Speed v₀ (m/s) at first contact, positive.
    plastic_depth : float
        Plastic depth (m) that earlier impacts on the same spot have left; 0, the default, is a virgin
        surface.
    """

    mass: float
    speed: float
    plastic_depth: float = 0.0

    def __post_init__(self):
        for name, unit in (("mass", "kg"), ("speed", "m/s"), ("plastic_depth", "m")):
            quantity = f"FreeImpact {name}"
            value = _check.number(quantity, getattr(self, name))
            value = _check.positive(quantity, value, unit=unit, zero=name == "plastic_depth")
            object.__setattr__(self, name, float(value))

    def models(self, medium):
        """Names of the models that can solve it, the cheapest that is exact first.

        The chain hits an imprint by `chain_impact(start=…)`: the depth alone does not set it up.
        """
        models = (SCALAR_ODE, CHAIN) if medium.eta > 0 else (CLOSED_FORM, SCALAR_ODE, CHAIN)
        return models[:-1] if self.plastic_depth > 0 else models

    def solve(self, profile, medium, model):
        """The `Impact` of this body, or on the chain the `ChainImpact`."""
        if model == CHAIN:
            return chain_impact(profile, medium, self.mass, self.speed)
        in_time = model == SCALAR_ODE
        return solve_impact(profile, medium, self.mass, self.speed, self.plastic_depth, in_time=in_time)
