"""Impacts by the equation of motion: on a viscous medium, and for a comparison on others."""

from dataclasses import dataclass

import numpy as np

from .._numeric import chunks
from ..indentation import Indentation
from ..results.base import SCALAR_ODE
from ..yielding import yield_rule
from .energy_balance import EnergyBalance
from .equation_of_motion import Bodies
from .legs import solve
from .solution import Solution


@dataclass(frozen=True)
class EquationOfMotion(Solution):
    """Impacts solved by the equation of motion.

    Rebound speed (m/s), contact time (s), viscous work (J) and largest force (N) are those at its end.
    """

    rebound_speed: np.ndarray
    end_time: np.ndarray
    dissipated: np.ndarray
    largest_force: np.ndarray

    model = SCALAR_ODE

    @classmethod
    def of(cls, profile, medium, mass, speed, imprint_depth, in_time=False):
        """The solution, from the energy balance where the medium has no viscosity, unless `in_time`."""
        dry = EnergyBalance.of(profile, medium, mass, speed, imprint_depth)
        interval, increase = dry.interval, dry.plastic_depth_increase
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
        rebound_speed, end_time, work, deceleration = motions
        rule = yield_rule(profile, medium)
        interval, increase = rule.loading(penetrations.reshape(mass.shape), imprint_depth)
        return cls(
            mass=mass,
            speed=speed,
            turning_point=Indentation(profile, medium, interval.upper, interval, in_time=True),
            plastic_depth_increase=increase,
            rebound_speed=np.minimum(rebound_speed, speed),
            end_time=end_time,
            dissipated=2 * medium.E_star * work,
            largest_force=mass * deceleration,
        )

    @property
    def restitution(self):
        return self.rebound_speed / self.speed

    @property
    def contact_time(self):
        return self.end_time

    @property
    def max_force(self):
        """Largest force (N), which is before the turning point."""
        return self.largest_force

    @property
    def viscous_work(self):
        return self.dissipated


def _solved(bodies):
    """Penetrations (m); rebound speed, contact time, viscous work over 2E*, largest deceleration."""
    solution = solve(bodies)
    end = solution.end
    values = -end.velocity, end.time, end.work, solution.max_deceleration[:, None]
    return solution.turning_point.depth[:, 0], np.hstack(values).T


def _of_dry(dry):
    """Rebound speed, contact time, viscous work over 2E*, largest deceleration without viscosity."""
    rebound_speed = dry.restitution * dry.speed
    return rebound_speed, dry.contact_time, np.zeros_like(rebound_speed), dry.max_force / dry.mass
