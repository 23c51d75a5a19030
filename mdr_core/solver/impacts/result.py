"""Impacts of a free rigid body, as results."""

from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np

from ...base import check, lazy
from ...base.check import Array
from ...base.motions import ImpactResult, Motion
from ...base.results import CLOSED_FORM, Entries, Limit, Model
from ..contact.indentation import Indentation
from ..contact.integrals import tabulated_for
from ..contact.yielding import yield_rule
from ..medium.medium import Medium
from ..medium.structure import RIGID, Structure
from ..profiles.profile import Profile
from .motion import motion
from .scaling import FastLimit, fast_limit


@dataclass(frozen=True, eq=False, repr=False)
class Impact(Entries, ImpactResult):
    """Results of one or many impacts, returned by `impact`; `result[i]` selects one.

    `turning_point` is the state of largest depth. `plastic_depth_increase` (m) is due to this impact alone.
    Each solver has a subclass, which defines `restitution`, the coefficient e, and `contact_time` (s) from
    first contact to its loss. For a captured body they are 0 and infinite.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium, impact
    >>> hit = impact(FlatPunch(radius=0.5), Medium(E_star=1.0), mass=1.0, speed=[0.1, 0.2])
    >>> print(hit[1].max_depth.round(9), hit[1].restitution)  # v₀ √(m/k) with k = 1 N/m
    0.2 1.0
    """

    mass: Array
    speed: Array
    turning_point: Indentation
    plastic_depth_increase: Array
    #: The structure that carries the medium; rigid by default.
    structure: Structure = field(default=RIGID, kw_only=True)

    _name = "Impact"
    #: Method of solution: the energy balance in closed form, or the equation of motion.
    model: ClassVar[Model] = CLOSED_FORM

    def __getitem__(self, index: Any) -> Self:
        values = {each.name: getattr(self, each.name) for each in fields(self)}
        structure = values.pop("structure").entries(index, self.shape)
        entries = {name: value[index] for name, value in values.items()}
        return type(self)(**entries, structure=structure)

    @property
    def profile(self) -> Profile:
        """The indenter."""
        return self.turning_point.profile

    @property
    def medium(self) -> Medium:
        """The medium."""
        return self.turning_point.medium

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model's assumptions for these impacts, and the fast limit (23), (24), as data."""
        return lazy.limits.impact_limits(self)

    @property
    def max_depth(self) -> Array:
        """Largest depth d_max (m), from the virgin surface."""
        return self.turning_point.depth

    @property
    def contact_radius(self) -> Array:
        """Largest contact radius a (m)."""
        return self.turning_point.contact_radius

    @property
    def plastic_radius(self) -> Array:
        """Radius c (m) of the final plastic zone."""
        return self.turning_point.plastic_radius

    @property
    def plastic_depth(self) -> Array:
        """Plastic depth d_p (m) that remains."""
        return self.turning_point.plastic_depth

    @property
    def stored_energy(self) -> Array:
        """Elastic energy (J) of the medium at the turning point.

        All of it is returned, unless the medium is viscous or on a plate.
        """
        return self.turning_point.stored_energy

    @check.frozen_property
    def max_force(self):
        """Largest force (N); with adhesion, the force at the turning point.

        In a viscous impact it is before the turning point.
        """
        return self.turning_point.force

    @property
    def max_pressure(self) -> Array:
        """Largest contact pressure (Pa) at the turning point: `Indentation.max_pressure`, one by one."""
        return self.turning_point.max_pressure

    @check.frozen_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        increase = self.plastic_depth_increase
        integral = self._rule.plastic_integral(self.plastic_depth - increase, increase)
        return 2 * self.medium.E_star * integral

    @check.frozen_property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity, during the contact and by relaxation after it."""
        return np.zeros(np.shape(self.mass))

    @check.frozen_property
    def structure_work(self):
        """Energy (J) that the waves of a plate or a rod carry away; 0 without a plate or a rod."""
        return np.zeros(np.shape(self.mass))

    @property
    def _rule(self):
        """The rule of yield."""
        count = np.size(self.plastic_depth_increase)
        profile = tabulated_for(self.profile, count, lambda: np.max(self.turning_point.depth))
        return yield_rule(profile, self.medium)

    @property
    def fast_limit(self) -> FastLimit:
        """The impact in the limit of Popov (2015), Eqs. (23), (24), with its error, as a `FastLimit`."""
        return fast_limit(self)

    def motion(self, n: int = 200) -> Motion:
        """Return the motion of one impact at n instants, from first contact to the loss of contact.

        Instants are equally spaced before the turning point, and again after it.

        Parameters
        ----------
        n : int
            Number of instants, at least 2.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, impact
        >>> hit = impact(Paraboloid(radius=1.0), Medium(E_star=1.0), 1.0, 0.01)
        >>> print(round(hit.motion(101).time[-1] / (hit.max_depth / 0.01), 6))  # Hertz
        2.943275
        """
        return motion(self, n)
