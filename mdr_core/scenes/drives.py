"""Drives of the indenter of a scene: paths of depth and force, and impacts of free bodies."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base import check
from ..base.check import ArrayLike
from ..base.results import CHAIN, CLOSED_FORM, CREEP_LAW, MODES, SCALAR_ODE, Model
from ..solver.contact.creep import creep
from ..solver.contact.loading import indent, indent_to_force
from ..solver.foundation.chain_impact import chain_impact
from ..solver.foundation.depth_path import check_times, indent_in_time
from ..solver.foundation.force_path import chain_creep
from ..solver.impacts.impact import solve_impact
from ..solver.medium.medium import Medium
from ..solver.medium.structure import Structure, structure_of
from ..solver.oblique.oblique_impact import FRICTION, oblique_impact


class _Path:
    """Base class of paths: in time, or infinitely slow if `time` is None."""

    time: ArrayLike | None
    #: Models in time on a viscous medium, the cheapest exact model first.
    _viscous: tuple[Model, ...] = (CHAIN,)

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Return the names of the models for this drive, the cheapest exact model first."""
        if medium.work_of_adhesion > 0:
            return (CLOSED_FORM,)
        return self._viscous if self.time and medium.eta > 0 else (CLOSED_FORM, CHAIN)


@dataclass(frozen=True)
class DepthPath(_Path):
    """Drive of a `Scene`: a path of prescribed depths.

    Parameters
    ----------
    depth : float or sequence of float
        Indentation depth (m), a number or a path.
    time : sequence of float, optional
        Increasing times (s) of a path; without times the path is quasi-static.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> from mdr_core.scene import DepthPath, Scene
    >>> state = Scene(Cone(slope=1.0), Medium(E_star=1.0), DepthPath(1.0)).solve()
    >>> print(round(state.force, 6))  # 2/π
    0.63662
    """

    depth: Any
    time: Any = None

    if TYPE_CHECKING:

        def __init__(self, depth: ArrayLike, time: ArrayLike | None = None) -> None: ...

    def __post_init__(self):
        depth = _path("DepthPath depth", self.depth, "m")
        time = _times(self.time, depth, "depth")
        check.store(self, depth=_plain(depth), time=time)

    def solve(self, profile, medium, model):
        """Return the `Indentation` along this path, or the `TimedIndentation` of the chain."""
        if model == CLOSED_FORM:
            return indent(profile, medium, self.depth)
        return _on_chain(indent_in_time, profile, medium, self.depth, self.time)


@dataclass(frozen=True)
class ForcePath(_Path):
    """Drive of a `Scene`: a path of prescribed forces.

    Parameters
    ----------
    force : float or sequence of float
        Normal force (N), a number or a path; not negative.
    time : sequence of float, optional
        Increasing times (s) of a path; without times the path is quasi-static.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> from mdr_core.scene import ForcePath, Scene
    >>> state = Scene(Cone(slope=1.0), Medium(E_star=1.0), ForcePath(1.0)).solve()
    >>> print(round(state.depth, 6))  # √(π/2)
    1.253314
    """

    force: Any
    time: Any = None

    if TYPE_CHECKING:

        def __init__(self, force: ArrayLike, time: ArrayLike | None = None) -> None: ...

    #: The scalar law of creep switches to the chain where the law ends.
    _viscous = (CREEP_LAW, CHAIN)

    def __post_init__(self):
        force = _path("ForcePath force", self.force, "N")
        time = _times(self.time, force, "force")
        check.store(self, force=_plain(force), time=time)

    def solve(self, profile, medium, model):
        """Return the `Indentation` along this path, or the `TimedIndentation` of creep or of the chain."""
        if model == CLOSED_FORM:
            return indent_to_force(profile, medium, self.force)
        if model == CREEP_LAW:
            return creep(profile, medium, self.force, self.time)
        return _on_chain(chain_creep, profile, medium, self.force, self.time)


def _path(quantity, values, unit):
    """Return depths (m) or forces (N) as an array. Raise MDRError unless they are a number or a path."""
    path = check.finite_array(quantity, values, unit=unit, most=check.LONGEST)
    if path.ndim > 1 or not path.size:
        raise check.MDRError(f"{quantity} must be a number or a path, got shape {path.shape}")
    return path


def _times(time, path, quantity):
    """Return the times (s) of a path of a quantity as a tuple, or None for an infinitely slow path."""
    return None if time is None else _plain(check_times(time, path, quantity))


def _plain(array):
    """Return a path as a tuple and a scalar array as a number, for comparing scenes and for JSON."""
    return tuple(array.tolist()) if array.ndim else array.item()


def _on_chain(solve, profile, medium, path, time):
    """Return the `TimedIndentation` of a path by `indent_in_time` or `chain_creep`."""
    values = np.atleast_1d(path)
    if time is None:
        # Without viscosity the times do not matter.
        time = np.arange(float(values.size))
        medium = replace(medium, eta=0.0)
    result = solve(profile, medium, values, np.asarray(time))
    return result if np.ndim(path) else result[0]


@dataclass(frozen=True)
class FreeImpact:
    """Drive of a `Scene`: the impact of a free body.

    Parameters
    ----------
    mass, speed : float
        Mass m (kg), and speed v₀ (m/s) at first contact, positive.
    plastic_depth : float
        Plastic depth (m) after earlier impacts on the same spot. By default 0, a virgin surface.
    structure : Structure, optional
        A single plate, rod or support that carries the medium; by default the body behind it is at rest.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium
    >>> from mdr_core.scene import FreeImpact, Scene
    >>> hit = Scene(FlatPunch(radius=0.5), Medium(E_star=1.0), FreeImpact(1.0, 0.1)).solve()
    >>> print(round(hit.contact_time, 6))  # half a period of a spring of 1 N/m: π
    3.141593
    """

    mass: float
    speed: float
    plastic_depth: float = 0.0
    structure: Structure | None = None

    def __post_init__(self):
        check.store(
            self,
            mass=check.positive_number("FreeImpact mass", self.mass, unit="kg"),
            speed=check.positive_number("FreeImpact speed", self.speed, unit="m/s"),
            plastic_depth=check.positive_number(
                "FreeImpact plastic_depth", self.plastic_depth, unit="m", zero=True
            ),
        )
        if structure_of(self.structure).shape:
            raise check.MDRError(
                "FreeImpact needs a single structure, but its parameters are arrays of shape "
                f"{self.structure.shape}; take one at a time, as in structure.entries(i)"
            )

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Return the names of the models for this drive, the cheapest exact model first."""
        if medium.work_of_adhesion > 0:
            return (CLOSED_FORM,)
        structure = structure_of(self.structure)
        if structure.modes is not None:
            return (MODES,)
        if medium.eta > 0 and not structure.rigid and self.plastic_depth == 0:
            return (CHAIN,)
        # The plastic depth does not determine a chain with an imprint: see `chain_impact(start=…)`.
        in_time = medium.eta > 0 or structure.is_plate
        models = (SCALAR_ODE, CHAIN) if in_time else (CLOSED_FORM, SCALAR_ODE, CHAIN)
        return models[:-1] if self.plastic_depth > 0 else models

    def solve(self, profile, medium, model):
        """Return the `Impact` of this body, or the `ChainImpact` of the chain."""
        if model == CHAIN:
            return chain_impact(profile, medium, self.mass, self.speed, structure=self.structure)
        given = self.mass, self.speed, self.plastic_depth, self.structure
        return solve_impact(profile, medium, *given, in_time=model == SCALAR_ODE)


@dataclass(frozen=True)
class FreeObliqueImpact:
    """Drive of a `Scene`: the oblique impact of a free body with friction.

    Parameters
    ----------
    mass, speed : float
        Mass m (kg), and normal speed v₀ (m/s) at first contact, positive.
    tangential_speed : float
        Speed v_t0 (m/s) of the point of contact along the surface, of any sign.
    friction : float
        Coefficient of friction μ, not negative.
    tangential_mass : float, optional
        Mass m_t (kg) at the point of contact along the surface; by default m. See `Ball.tangential_mass`.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium
    >>> from mdr_core.scene import FreeObliqueImpact, Scene
    >>> drive = FreeObliqueImpact(1.0, 0.1, tangential_speed=1.0, friction=0.1)
    >>> hit = Scene(FlatPunch(radius=0.5), Medium(E_star=1.0), drive).solve()
    >>> print(round(hit.tangential_velocity, 6))  # it slips throughout: 1 − 2 μ v₀
    0.98
    """

    mass: float
    speed: float
    tangential_speed: float
    friction: float
    tangential_mass: float | None = None

    def __post_init__(self):
        tangential_mass = self.mass if self.tangential_mass is None else self.tangential_mass
        check.store(
            self,
            mass=check.positive_number("FreeObliqueImpact mass", self.mass, unit="kg"),
            speed=check.positive_number("FreeObliqueImpact speed", self.speed, unit="m/s"),
            tangential_speed=check.number(
                "FreeObliqueImpact tangential_speed", self.tangential_speed, "m/s"
            ),
            friction=check.positive_number("FreeObliqueImpact friction", self.friction, zero=True),
            tangential_mass=check.positive_number(
                "FreeObliqueImpact tangential_mass", tangential_mass, unit="kg"
            ),
        )

    def models(self, medium: Medium) -> tuple[Model, ...]:
        """Return the names of the models for this drive."""
        return (FRICTION,)

    def solve(self, profile, medium, model):
        """Return the `ObliqueImpact` of this body."""
        return oblique_impact(
            profile, medium, self.mass, self.speed, self.tangential_speed, self.friction,
            tangential_mass=self.tangential_mass,
        )  # fmt: skip
