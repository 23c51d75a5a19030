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
from .._numeric import chunks
from ..indentation import Indentation
from ..medium import Medium, check_pair, refuse_adhesion, shape_with
from ..results.base import CLOSED_FORM, SCALAR_ODE, ImpactResult, Model, Motion
from ..results.limits import Limit, contact_limits
from ..scaling import FastLimit, fast_limit, how_fast
from ..shapes.profile import Profile
from ..yielding import yield_rule
from .adhesive_impact import (
    adhesive_contact_time,
    adhesive_turning_interval,
    pull_off,
    rebound_energy,
    touching,
)
from .contact_time import contact_time
from .course import Course
from .energy_balance import (
    dry_restitution,
    tabulated_for,
    turning_interval,
)
from .equation_of_motion import Bodies
from .legs import solve
from .motion import motion


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
    adhesive = np.any(np.asarray(medium.work_of_adhesion) > 0)
    if adhesive and in_time:
        refuse_adhesion(medium, "an equation of motion")
    rule = yield_rule(profile, medium)
    load = 0.0
    with np.errstate(all="ignore"):
        energy = np.broadcast_to(mass * speed**2 / (4 * medium.E_star), shape)
        if adhesive:
            interval, stretched = adhesive_turning_interval(profile, medium, energy, imprint_depth)
            increase = interval.lower - imprint_depth
            load = -medium.E_star * stretched
        else:
            interval, increase = turning_interval(rule, energy, imprint_depth)
        integrated = None
        if in_time or np.any(np.asarray(medium.eta) > 0):
            penetration = np.where(interval.upper < np.inf, interval.length + increase, np.inf)
            bodies = Bodies.of(profile, medium, mass, speed, imprint_depth, penetration)
            penetration, integrated = _integrated(bodies, penetration, mass, medium.E_star, in_time)
            interval, increase = rule.loading(penetration, imprint_depth)
    known = np.minimum(profile.known_depth, _check.LONGEST)
    unknown = ~(interval.upper <= known)
    bound = f"presses {too_deep}"
    _check.refuse("speed", speed, unknown, bound, unit="m/s", remedy="hit less hard")
    depth = interval.upper if not adhesive else _depth(rule, interval, stretched, increase)
    turning_point = Indentation(profile, medium, depth, interval, load, in_time=True)
    return Impact(profile, medium, mass[()], speed[()], turning_point, increase, integrated)


def _integrated(bodies, penetration, mass, E_star, in_time):
    """Penetrations (m) from those without viscosity, and quantities, by the equation of motion.

    It is solved where the medium is viscous, or everywhere if `in_time`.
    """
    shape = np.shape(penetration)
    penetration = penetration.ravel()
    velocity, time, work, deceleration = np.zeros((4, penetration.size))
    solved = (bodies.relaxation_time[:, 0] > 0) | in_time
    numbers = np.flatnonzero(solved)
    for block in chunks(numbers.size, 256):
        rows = numbers[block]
        solution = solve(bodies[rows])
        end = solution.end[:, 0]
        penetration[rows] = solution.turning_point.depth[:, 0]
        velocity[rows] = end.velocity
        time[rows] = end.time
        work[rows] = end.work
        deceleration[rows] = solution.max_deceleration
    quantities = {
        "solved": solved.reshape(shape),
        "restitution": np.minimum(-velocity / bodies.speed[:, 0], 1.0).reshape(shape),
        "contact_time": time.reshape(shape),
        "viscous_work": 2 * E_star * work.reshape(shape),
        "max_force": deceleration.reshape(shape) * mass,
    }
    return penetration.reshape(shape), {name: _check.frozen(values) for name, values in quantities.items()}


def _depth(rule, interval, stretched, increase):
    """Depth (m) at a turning point with adhesion."""
    return np.where(increase > 0, rule.onset(interval.lower), interval.upper - stretched)


def quantity_of(path: str, doc: str) -> "cached_property[Array]":
    """A property that is one of a state or result in this result, as in "turning_point.depth"."""
    quantity = cached_property(attrgetter(path))
    quantity.__doc__ = doc
    return quantity


@dataclass(frozen=True, eq=False, repr=False)
class Impact(ImpactResult):
    """One impact or many; made by `impact`. `result[i]` picks one.

    `turning_point` is the state of largest depth; `plastic_depth_increase` (m) is due to this impact alone.
    """

    profile: Profile
    medium: Medium
    mass: Array
    speed: Array
    turning_point: Indentation
    plastic_depth_increase: np.ndarray
    #: Quantities by the equation of motion, and where it was "solved"; None if nowhere.
    _integrated: dict[str, Array] | None = None

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Where the model's assumptions end for these impacts, and the fast limit (23), (24), as data."""
        limits = contact_limits(self.profile, self.medium, self.contact_radius)
        return (*limits, *how_fast(self))

    _course = cached_property(lambda self: Course(self))

    def __getitem__(self, index: Any) -> "Impact":
        state, increase = self.turning_point[index], self.plastic_depth_increase[index]
        integrated = self._integrated and {name: array[index] for name, array in self._integrated.items()}
        mass, speed = self.mass[index], self.speed[index]
        return Impact(state.profile, state.medium, mass, speed, state, increase, integrated)

    @property
    def model(self) -> Model:
        """How it was solved: by the energy balance in closed form, or by the equation of motion."""
        return CLOSED_FORM if self._integrated is None else SCALAR_ODE

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
        """Elastic energy (J) at the turning point; without viscosity all of it is returned."""
        return self.turning_point.stored_energy

    def _merged(self, name, dry):
        """A quantity from the equation of motion where that was solved, else from a function without it."""
        if self._integrated is None:
            return dry()
        solved, values = self._integrated["solved"], self._integrated[name]
        return values if np.all(solved) else np.where(solved, values, dry())

    @_check.frozen_property
    def max_force(self):
        """Largest force (N), with adhesion that at the turning point; a viscous one is before it."""
        return self._merged("max_force", lambda: self.turning_point.force)

    @_check.frozen_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        increase = self.plastic_depth_increase
        rule = yield_rule(tabulated_for(self.profile, increase.size), self.medium)
        return 2 * self.medium.E_star * rule.plastic_integral(self.plastic_depth - increase, increase)

    @property
    def viscous_work(self) -> Array:
        """Energy (J) dissipated by viscosity, during the contact and by relaxation after it."""
        return self._merged("viscous_work", lambda: np.zeros(self.mass.shape)[()])

    @cached_property
    def _adhesive(self):
        return np.any(np.asarray(self.medium.work_of_adhesion) > 0)

    @_check.frozen_property
    def _rebound_energy(self):
        """Energy over 2E* (m³) after the pull-off, negative for a captured body."""
        return rebound_energy(self.profile, self.medium, self.turning_point.live_interval)

    @_check.frozen_property
    def captured(self):
        """Whether adhesion holds the body, so that it does not rebound."""
        return self._rebound_energy <= 0 if self._adhesive else np.zeros(self.mass.shape, bool)

    @_check.frozen_property
    def adhesive_work(self):
        """Energy (J) that adhesion takes: the work between touching and pull-off.

        Of a captured body all that yielding leaves of its kinetic energy.
        """
        if not self._adhesive:
            return np.zeros(self.mass.shape)
        lower = self.turning_point.live_interval.lower
        first = touching(self.profile, self.medium, lower - self.plastic_depth_increase)[1]
        work = 2 * self.medium.E_star * (pull_off(self.profile, self.medium, lower)[1] - first)
        return np.where(self.captured, self.mass * self.speed**2 / 2 - self.plastic_work, work)

    @_check.frozen_property
    def restitution(self):
        """Coefficient of restitution e, speed after over speed before; 0 for a captured body."""
        if self._adhesive:
            kinetic = self.mass * self.speed**2 / (4 * self.medium.E_star)
            return np.sqrt(np.maximum(self._rebound_energy, 0.0) / kinetic)
        interval = self.turning_point.live_interval
        rule = yield_rule(self.profile, self.medium)
        increase = self.plastic_depth_increase
        return self._merged("restitution", lambda: dry_restitution(rule, interval, increase))

    @_check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact; infinite for a captured body."""
        inertia = self.mass / (2 * self.medium.E_star)
        arguments = inertia, self.speed, self.turning_point.live_interval, self.plastic_depth_increase
        if self._adhesive:
            return adhesive_contact_time(self.profile, self.medium, *arguments)
        return self._merged("contact_time", lambda: contact_time(self.profile, *arguments))

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
