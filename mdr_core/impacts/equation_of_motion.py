"""Equation of motion of impacts on a viscous medium.

The element of Popov (2015), Eqs. (1), (17), (18) is a spring that carries at most π q_c/2, in parallel with
a dashpot. On loading all elements under the indenter are pressed; on unloading an element is released when
its total load reaches zero, which happens at g = d + τḋ, from the rim inward. With the penetration
y = d − p₀ into an imprint of plastic depth p₀, the plastic depth p, the live depth ℓ = d + τḋ − p,
Φ = ∫ a ds over the live interval, τ = 4η/E* and μ = m/(2E*),

    loading     μ v̇ = −(Φ + τ a v)     ẏ = v              ẇ = τ a v²        until v = 0
    unloading   μ v̇ = −Φ               ℓ̇ = v + τ v̇       ẇ = τ a v ℓ̇     until ℓ = 0

2E* w is the viscous work, with the energy that released elements are still to lose. `motion_solver`
solves these equations, in the depth q = y or ℓ and the velocity v.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from ..contact.integrals import integrals, tabulated
from ..contact.live_interval import LiveInterval
from ..contact.rule_of_yield import YieldRule
from ..contact.yielding import yield_rule
from ..numerics.results import Entries
from ..profiles.profile import Profile


@dataclass(frozen=True)
class MotionState(Entries):
    """Depth q (m), velocity (m/s), time (s) and viscous work over 2E* (m³), as arrays of one shape."""

    depth: np.ndarray
    velocity: np.ndarray
    time: np.ndarray
    work: np.ndarray

    def replaced(self, index, states):
        """The states with others at an index."""
        values = []
        for field in fields(self):
            value = np.array(getattr(self, field.name))
            value[index] = getattr(states, field.name)
            values.append(value)
        return MotionState(*values)


@dataclass(frozen=True)
class Bodies:
    """Impacts to solve, one a row of each array of shape (N, 1).

    Rule of yield for one indenter or N, relaxation time τ (s), inertia μ (m s²), speed v₀ (m/s), plastic
    depth p₀ (m) of the imprint, and penetration y (m) of the same impact without viscosity.
    """

    rule: YieldRule
    relaxation_time: np.ndarray
    inertia: np.ndarray
    speed: np.ndarray
    imprint_depth: np.ndarray
    dry_penetration: np.ndarray

    @classmethod
    def of(cls, profile, medium, mass, speed, imprint_depth, dry_penetration):
        """Impacts with one row each; `dry_penetration` is infinite where it exceeds the known depth."""
        shape, size = np.shape(speed), np.size(speed)

        def column(values):
            return np.broadcast_to(values, shape).reshape(-1, 1)

        rule = yield_rule(profile, medium).flat_entries(slice(None), shape)
        rule = rule.entries((slice(None), None), (size,))
        imprint_depth = column(imprint_depth)
        dry_penetration = np.minimum(column(dry_penetration), rule.profile.known_depth - imprint_depth)
        # A little deeper than the impact reaches: the table must not end at the turning point.
        profile = tabulated(rule.profile, imprint_depth + 1.1 * dry_penetration)
        return cls(
            rule=replace(rule, profile=profile),
            relaxation_time=column(medium.relaxation_time),
            inertia=column(mass / (2 * medium.E_star)),
            speed=column(speed),
            imprint_depth=imprint_depth,
            dry_penetration=dry_penetration,
        )

    @property
    def profile(self) -> Profile:
        """One indenter or N, with a table of its contact radius."""
        return self.rule.profile

    def __getitem__(self, index):
        columns = {name: getattr(self, name)[index] for name in self.__dataclass_fields__ if name != "rule"}
        return Bodies(self.rule.entries(index, self.speed.shape), **columns)


@dataclass(frozen=True)
class Equation(Entries):
    """Base class of the equations of motion in a depth q."""

    bodies: Bodies

    def load(self, depth):
        """Φ (m²) and contact radius a (m) at depths q (m)."""
        interval, profile = self.interval(depth), self.bodies.profile
        return integrals(profile).radius_integral(interval), profile.radius_at(interval.upper)


@dataclass(frozen=True)
class Loading(Equation):
    """Equation of motion from first contact to the turning point, in the penetration y."""

    def interval(self, depth):
        """Live interval at penetrations (m)."""
        return self.bodies.rule.loading(np.maximum(depth, 0.0), self.bodies.imprint_depth)[0]

    def rates(self, load, radius, velocity):
        """Rates of y (m/s), velocity (m/s²), viscous work over 2E* (m³/s) at loads Φ, radii, velocities."""
        drag = self.bodies.relaxation_time * radius * velocity
        return velocity, -(load + drag) / self.bodies.inertia, drag * velocity

    def damping(self, radius):
        """−∂v̇/∂v (1/s)."""
        return self.bodies.relaxation_time * radius / self.bodies.inertia

    def stiffness(self, depth, radius, velocity):
        """−μ ∂v̇/∂y (m): a (less c dp/ds while yielding), and the drag on a contact that grows."""
        rule, profile, slope = self.bodies.rule, self.bodies.profile, radius
        interval = self.interval(depth)
        yields = interval.lower > self.bodies.imprint_depth
        if yields.any():
            c = profile.radius_at(interval.lower)
            slope = np.where(yields, radius - c * rule.rate(interval.upper), radius)
        # At a wall the contact no longer grows.
        with np.errstate(divide="ignore"):
            spread = 1 / profile.reduced_slope_at(radius)
        spread = np.where(radius < profile.wall, spread, 0.0)
        return slope + self.bodies.relaxation_time * velocity * spread


@dataclass(frozen=True)
class Unloading(Equation):
    """Equation of motion from the turning point to the loss of contact, in the live depth ℓ."""

    plastic_depth: np.ndarray

    def interval(self, depth):
        """Live interval at live depths (m)."""
        return LiveInterval.above(self.plastic_depth, np.maximum(depth, 0.0))

    def rates(self, load, radius, velocity):
        """Rates of ℓ (m/s), velocity (m/s²), viscous work over 2E* (m³/s) at loads Φ, radii, velocities."""
        acceleration = -load / self.bodies.inertia
        rate = velocity + self.bodies.relaxation_time * acceleration
        return rate, acceleration, self.bodies.relaxation_time * radius * velocity * rate

    def damping(self, radius):
        """−∂v̇/∂v (1/s): released elements do not brake."""
        return np.zeros_like(radius)

    def stiffness(self, depth, radius, velocity):
        """−μ ∂v̇/∂ℓ (m)."""
        return radius
