"""Impact of a free rigid body.

On a medium without viscosity it is solved by the energy balance and quadrature, without time stepping, on a
viscous one by the equation of motion.
"""

from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter
from typing import Any

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..indentation import Indentation
from ..medium import Medium, check_pair, refuse_adhesion, shape_with
from ..results.base import ImpactResult, Model, Motion
from ..results.limits import Limit, contact_limits
from ..scaling import FastLimit, fast_limit, how_fast
from ..shapes.profile import Profile
from .adhesive_impact import AdhesiveEnergyBalance
from .course import Course
from .energy_balance import EnergyBalance
from .motion import motion
from .solution import Solution
from .viscous_impact import EquationOfMotion


@_check.keywords_explained
def impact(
    profile: Profile,
    medium: Medium,
    mass: ArrayLike,
    speed: ArrayLike,
    *,
    plastic_depth: ArrayLike = 0.0,
) -> "Impact":
    """Let a body of given mass hit the medium at given speed, with no other force acting.

    Contact starts at the bottom of the imprint (depth 0 on a virgin medium), and ends at zero force, with
    adhesion at the pull-off.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium; viscous if `eta` is positive.
    mass, speed : float or array_like
        Mass m (kg), and speed v₀ (m/s) at first contact, positive.
    plastic_depth : float or array_like, optional
        Plastic depth (m) of a relaxed imprint of the same indenter: for repeated impacts, the
        `plastic_depth` of the previous one. 0 (the default) is a virgin medium.

    Returns
    -------
    Impact
        Quantities of the shape to which all arguments broadcast: one impact or a million.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the indenter would go deeper than its profile is known.

    Examples
    --------
    Restitution of a cone whose largest depth is five times the critical depth:

    >>> from mdr_core import Cone, Medium, indent
    >>> medium = Medium(E_star=1.0, q_c=1.0)
    >>> state = indent(Cone(slope=1.0), medium, 5 * medium.critical_depth)
    >>> energy = state.stored_energy + state.plastic_work
    >>> hit = impact(Cone(slope=1.0), medium, 2.0, energy**0.5)
    >>> print(round(hit.restitution, 9))
    0.461643536
    """
    return solve_impact(profile, medium, mass, speed, plastic_depth)


def solve_impact(profile, medium, mass, speed, plastic_depth=0.0, *, in_time=False):
    """`impact`; `in_time` the equation of motion is solved also where there is no viscosity."""
    check_pair(profile, medium)
    mass = _check.positive("mass", mass, unit="kg")
    speed = _check.positive("speed", speed, unit="m/s")
    imprint_depth = _check.positive("plastic_depth", plastic_depth, unit="m", zero=True)
    shape = shape_with("impact", profile, medium, mass=mass, speed=speed, plastic_depth=imprint_depth)
    mass, speed, imprint_depth = (np.broadcast_to(values, shape) for values in (mass, speed, imprint_depth))
    too_deep = profile._too_deep()
    outside = imprint_depth > profile.known_depth
    _check.refuse("plastic_depth", imprint_depth, outside, f"is {too_deep}", unit="m")
    # The search may start far from the root, where powers leave double precision.
    with np.errstate(all="ignore"):
        solution = _solved(profile, medium, mass, speed, imprint_depth, in_time)
    known = np.minimum(profile.known_depth, _check.LONGEST)
    unknown = ~(solution.interval.upper <= known)
    bound = f"presses {too_deep}"
    _check.refuse("speed", speed, unknown, bound, unit="m/s", remedy="hit less hard")
    return Impact(solution)


def _solved(profile, medium, mass, speed, imprint_depth, in_time):
    """The `Solution` of checked impacts by the solver for their medium."""
    if np.any(np.asarray(medium.work_of_adhesion) > 0):
        if in_time:
            refuse_adhesion(medium, "an equation of motion")
        return AdhesiveEnergyBalance.of(profile, medium, mass, speed, imprint_depth)
    if in_time or np.any(np.asarray(medium.eta) > 0):
        return EquationOfMotion.of(profile, medium, mass, speed, imprint_depth, in_time)
    return EnergyBalance.of(profile, medium, mass, speed, imprint_depth)


def quantity_of(path: str, doc: str) -> "cached_property[Array]":
    """A property that is one of a state or result in this result, as in "turning_point.depth"."""
    quantity = cached_property(attrgetter(path))
    quantity.__doc__ = doc
    return quantity


@dataclass(frozen=True, eq=False, repr=False)
class Impact(ImpactResult):
    """One impact or many; made by `impact`. `result[i]` picks one."""

    _solution: Solution

    def __getitem__(self, index: Any) -> "Impact":
        return Impact(self._solution[index])

    @property
    def profile(self) -> Profile:
        """The indenter."""
        return self.turning_point.profile

    @property
    def medium(self) -> Medium:
        """The medium."""
        return self.turning_point.medium

    @property
    def model(self) -> Model:
        """How it was solved: by the energy balance in closed form, or by the equation of motion."""
        return self._solution.model

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Where the model's assumptions end for these impacts, and the fast limit (23), (24), as data."""
        limits = contact_limits(self.profile, self.medium, self.contact_radius)
        return (*limits, *how_fast(self))

    @cached_property
    def _course(self):
        return Course(self)

    @property
    def mass(self) -> Array:
        """Mass m (kg)."""
        return self._solution.mass[()]

    @property
    def speed(self) -> Array:
        """Speed v₀ (m/s) at first contact."""
        return self._solution.speed[()]

    @property
    def turning_point(self) -> Indentation:
        """The state of largest depth."""
        return self._solution.turning_point

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
    def plastic_depth_increase(self) -> Array:
        """Increase (m) of the plastic depth by this impact alone."""
        return self._solution.plastic_depth_increase

    @property
    def stored_energy(self) -> Array:
        """Elastic energy (J) at the turning point; without viscosity all of it is returned."""
        return self.turning_point.stored_energy

    @_check.frozen_property
    def max_force(self):
        """Largest force (N), with adhesion that at the turning point; a viscous one is before it."""
        return self._solution.max_force

    @_check.frozen_property
    def restitution(self):
        """Coefficient of restitution e, speed after over speed before; 0 for a captured body."""
        return self._solution.restitution

    @_check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact; infinite for a captured body."""
        return self._solution.contact_time

    @_check.frozen_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        return self._solution.plastic_work

    @_check.frozen_property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity, during the contact and by relaxation after it."""
        return self._solution.viscous_work

    @_check.frozen_property
    def adhesive_work(self):
        """Energy (J) that adhesion takes: the work between touching and pull-off.

        Of a captured body all that yielding leaves of its kinetic energy.
        """
        return self._solution.adhesive_work

    @_check.frozen_property
    def captured(self):
        """Whether adhesion holds the body, so that it does not rebound."""
        return self._solution.captured

    @property
    def fast_limit(self) -> FastLimit:
        """The impact in the limit of Popov (2015), Eqs. (23), (24), with its error: a `FastLimit`."""
        return fast_limit(self)

    def motion(self, n: int = 200) -> Motion:
        """The motion of one impact at n instants, from first contact to the loss of contact.

        Instants are equally spaced before the turning point, and again after it.

        Parameters
        ----------
        n : int
            Number of instants, at least 2.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> hit = impact(Paraboloid(radius=1.0), Medium(E_star=1.0), 1.0, 0.01)
        >>> print(round(hit.motion(101).time[-1] / (hit.max_depth / 0.01), 6))  # Hertz
        2.943275
        """
        return motion(self, n)
