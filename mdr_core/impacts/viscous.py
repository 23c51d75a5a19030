"""Impacts by the equation of motion: on a viscous medium, and for a comparison on others."""

from dataclasses import dataclass

import numpy as np

from .. import _check
from ..contact.indentation import Indentation
from ..contact.yielding import yield_rule
from ..numerics.blocks import chunks
from ..results.base import SCALAR_ODE
from .energy_balance import dry_impact
from .equation_of_motion import Bodies
from .motion_solver import solve
from .result import Impact


@dataclass(frozen=True, eq=False, repr=False)
class ViscousImpact(Impact):
    """Impacts solved by the equation of motion.

    Speed after the impact (m/s), time of the loss of contact (s), viscous work (J) and largest force (N).
    """

    speed_after: np.ndarray
    end_time: np.ndarray
    dissipated: np.ndarray
    largest_force: np.ndarray

    model = SCALAR_ODE

    @_check.frozen_property
    def restitution(self):
        """Coefficient of restitution e."""
        return self.speed_after / self.speed

    @_check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact."""
        return self.end_time

    @_check.frozen_property
    def max_force(self):
        """Largest force (N), which is before the turning point."""
        return self.largest_force

    @_check.frozen_property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity, during the contact and by relaxation after it."""
        return self.dissipated


def viscous_impact(profile, medium, mass, speed, imprint_depth, in_time=False):
    """Impacts over imprints of given plastic depth (m).

    Where the medium has no viscosity they are solved by the energy balance, unless `in_time`.
    """
    dry = dry_impact(profile, medium, mass, speed, imprint_depth)
    interval, increase = dry.turning_point.live_interval, dry.plastic_depth_increase
    penetration = np.where(interval.upper < np.inf, interval.length + increase, np.inf)
    bodies = Bodies.of(profile, medium, mass, speed, imprint_depth, penetration)
    viscous = (bodies.relaxation_time.reshape(mass.shape) > 0) | in_time
    motions = np.zeros((4, *mass.shape))
    if not viscous.all():
        motions[:, ~viscous] = _of_dry(dry[~viscous])
    penetrations = penetration.ravel()
    # A view, with one column for each impact.
    columns = motions.reshape(4, -1)
    numbers = np.flatnonzero(viscous)
    for block in chunks(numbers.size, 256):
        rows = numbers[block]
        penetrations[rows], columns[:, rows] = _solved(bodies[rows])
    speed_after, end_time, work, deceleration = motions
    rule = yield_rule(profile, medium)
    interval, increase = rule.loading(penetrations.reshape(mass.shape), imprint_depth)
    return ViscousImpact(
        mass=mass[()],
        speed=speed[()],
        turning_point=Indentation(profile, medium, interval.upper, interval, in_time=True),
        plastic_depth_increase=increase,
        speed_after=np.minimum(speed_after, speed),
        end_time=end_time,
        dissipated=2 * medium.E_star * work,
        largest_force=mass * deceleration,
    )


def _solved(bodies):
    """Penetrations (m); speed after, contact time, viscous work over 2E*, largest deceleration."""
    solution = solve(bodies)
    end = solution.end
    values = -end.velocity, end.time, end.work, solution.max_deceleration[:, None]
    return solution.turning_point.depth[:, 0], np.hstack(values).T


def _of_dry(dry):
    """Speed after, contact time, viscous work over 2E*, largest deceleration without viscosity."""
    speed_after = dry.restitution * dry.speed
    return speed_after, dry.contact_time, np.zeros_like(speed_after), dry.max_force / dry.mass
