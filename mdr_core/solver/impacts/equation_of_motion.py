"""Equation of motion of impacts on a viscous medium.

The element of Popov (2015), Eqs. (1), (17), (18) is a spring that carries at most π q_c/2, in parallel with
a dashpot. On loading all elements under the indenter are pressed. On unloading an element is released when
its total load reaches zero, at g = d + τḋ, from the rim inward. With the penetration y = d − p₀ into an
imprint of plastic depth p₀, the plastic depth p, the live depth ℓ = d + τḋ − p, Φ = ∫ a ds over the live
interval, τ = 4η/E* and μ = m/(2E*),

    loading     μ v̇ = −(Φ + τ a v)     ẏ = v              ẇ = τ a v²        until v = 0
    unloading   μ v̇ = −Φ               ℓ̇ = v + τ v̇       ẇ = τ a v ℓ̇     until ℓ = 0

2E* w is the viscous work, including the energy that released elements will lose. `motion_solver` solves
these equations in the depth q = y or ℓ and the velocity v.

On a structure, without dashpots in the medium, the deflection w of the structure obeys w′ = F/Z + F′/K,
with F = 2E* Φ. One of Z and K is infinite. Let v be the velocity of the body minus F/Z. Let ω = dΦ/dq,
which is a, or a − c dp/ds while the plastic depth grows. Let τ_w = m/Z, κ = 2E*/K and S = 1 + κ ω. Then on
both branches

    q̇ = v/S        μ v̇ = −(Φ + τ_w ω q̇)        ẇ = τ_w Φ²/μ

and 2E* w is the energy that the waves carry away. On a plate S is 1. While nothing yields, its loading is
the viscous loading with τ_w instead of τ.

A body never leaves a plate if τ_w² c ≥ 4μ, with the radius c of the contact at ℓ → 0. Let p = −v on
unloading. Its barrier p_b = 2Φ/(τ_w a) falls with ℓ by 2/τ_w or less. At the barrier p falls by

    dp/dℓ = (τ_w a − Φ/p)/μ = τ_w a/(2μ)

which is more if τ_w² a ≥ 4μ. a falls to c: p stays below its barrier, and goes to 0 with Φ. If
τ_w² c < 4μ, the end is a focus, which the body leaves.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from ...base.results import Entries
from ..contact.integrals import integrals, tabulated
from ..contact.live_interval import LiveInterval
from ..contact.quadrature import growth_at, radius_rate
from ..contact.yielding import YieldRule, yield_rule
from ..medium.structure import RIGID
from ..profiles.profile import Profile


@dataclass(frozen=True)
class MotionState(Entries):
    """Depth q (m), velocity (m/s), time (s) and viscous work over 2E* (m³), as arrays of one shape."""

    depth: np.ndarray
    velocity: np.ndarray
    time: np.ndarray
    work: np.ndarray

    def replaced(self, index, states):
        """Return the states, with `states` at an index."""
        values = []
        for field in fields(self):
            value = np.array(getattr(self, field.name))
            value[index] = getattr(states, field.name)
            values.append(value)
        return MotionState(*values)


@dataclass(frozen=True)
class Bodies:
    """Impacts to solve, one per row of each array of shape (N, 1).

    The rule of yield is for one indenter or N. The relaxation time (s) is τ of the medium or τ_w of a
    plate. The inertia is μ (m s²), the speed v₀ (m/s), and the imprint has the plastic depth p₀ (m).
    `dry_penetration` is y (m) of the same impact without viscosity and plate, and `support_compliance` is
    κ (1/m).
    """

    rule: YieldRule
    relaxation_time: np.ndarray
    inertia: np.ndarray
    speed: np.ndarray
    imprint_depth: np.ndarray
    dry_penetration: np.ndarray
    support_compliance: np.ndarray

    @classmethod
    def of(cls, profile, medium, mass, speed, imprint_depth, dry_penetration, structure=RIGID):
        """Make impacts with one row each; `dry_penetration` is infinite if it exceeds the known depth."""
        shape, size = np.shape(speed), np.size(speed)

        def column(values):
            return np.broadcast_to(values, shape).reshape(-1, 1)

        rule = yield_rule(profile, medium).flat_entries(slice(None), shape)
        rule = rule.entries((slice(None), None), (size,))
        imprint_depth = column(imprint_depth)
        dry_penetration = np.minimum(column(dry_penetration), rule.profile.known_depth - imprint_depth)
        # A little deeper than the impact: the table must not end at the turning point.
        profile = tabulated(rule.profile, imprint_depth + 1.1 * dry_penetration)
        return cls(
            rule=replace(rule, profile=profile),
            # In each row, one of these terms is 0.
            relaxation_time=column(medium.relaxation_time + mass / structure.impedance),
            inertia=column(mass / (2 * medium.E_star)),
            speed=column(speed),
            imprint_depth=imprint_depth,
            dry_penetration=dry_penetration,
            support_compliance=column(2 * medium.E_star / structure.stiffness),
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
    """Base class of the equations of motion in a depth q: here on a medium with or without viscosity."""

    bodies: Bodies

    def load(self, depth):
        """Return Φ (m²) and contact radius a (m) at depths q (m); on a structure ω (m) instead of a."""
        interval, profile = self.interval(depth), self.bodies.profile
        return integrals(profile).radius_integral(interval), profile.radius_at(interval.upper)

    def depth_share(self, radius):
        """Return ∂q̇/∂v."""
        return 1.0

    def damping_share(self, radius):
        """Return the square of damping over critical damping for a contact radius (m) at the end; (N, 1).

        A body never leaves if it is 1 or more.
        """
        return np.zeros(radius.shape)


@dataclass(frozen=True)
class Loading(Equation):
    """Equation of motion from first contact to the turning point, in the penetration y."""

    def interval(self, depth):
        """Return the live interval at penetrations (m)."""
        return self.bodies.rule.loading(np.maximum(depth, 0.0), self.bodies.imprint_depth)[0]

    def rates(self, load, radius, velocity):
        """Return rates of y (m/s), velocity (m/s²) and viscous work over 2E* (m³/s) at given loads Φ."""
        drag = self.bodies.relaxation_time * radius * velocity
        return velocity, -(load + drag) / self.bodies.inertia, drag * velocity

    def damping(self, radius):
        """Return −∂v̇/∂v (1/s)."""
        return self.bodies.relaxation_time * radius / self.bodies.inertia

    def stiffness(self, depth, load, radius, velocity):
        """Return −μ ∂v̇/∂y (m): a (minus c dp/ds while yielding), plus the drag on a growing contact."""
        bodies = self.bodies
        state = bodies.rule.loading(np.maximum(depth, 0.0), bodies.imprint_depth)
        width = bodies.rule.loading_stiffness_radius(*state, radius)
        return width + bodies.relaxation_time * velocity * growth_at(bodies.profile, radius)


@dataclass(frozen=True)
class Unloading(Equation):
    """Equation of motion from the turning point to the loss of contact, in the live depth ℓ."""

    plastic_depth: np.ndarray

    def interval(self, depth):
        """Return the live interval at live depths (m)."""
        return LiveInterval.above(self.plastic_depth, np.maximum(depth, 0.0))

    def rates(self, load, radius, velocity):
        """Return rates of ℓ (m/s), velocity (m/s²) and viscous work over 2E* (m³/s) at given loads Φ."""
        acceleration = -load / self.bodies.inertia
        rate = velocity + self.bodies.relaxation_time * acceleration
        return rate, acceleration, self.bodies.relaxation_time * radius * velocity * rate

    def damping(self, radius):
        """Return −∂v̇/∂v (1/s): released elements do not brake."""
        return np.zeros_like(radius)

    def stiffness(self, depth, load, radius, velocity):
        """Return −μ ∂v̇/∂ℓ (m)."""
        return radius


class OnStructure:
    """Equation of motion on a structure; a subclass has the interval of loading or of unloading."""

    def rates(self, load, width, velocity):
        """Return rates of q (m/s), velocity (m/s²) and work of waves over 2E* (m³/s) at given loads Φ."""
        bodies = self.bodies
        rate = velocity * self.depth_share(width)
        acceleration = -(load + bodies.relaxation_time * width * rate) / bodies.inertia
        return rate, acceleration, bodies.relaxation_time * load**2 / bodies.inertia

    def depth_share(self, width):
        """Return ∂q̇/∂v = 1/S."""
        return 1 / (1 + self.bodies.support_compliance * width)

    def damping(self, width):
        """Return −∂v̇/∂v (1/s)."""
        return self.bodies.relaxation_time * width * self.depth_share(width) / self.bodies.inertia

    def stiffness(self, depth, load, width, velocity):
        """Return the derivative of the slope q̇/v̇ by q, times μ v̇²/q̇ (m): −μ ∂v̇/∂q on a plate."""
        share, growth = self.depth_share(width), self.growth(depth, width)
        drag = self.bodies.relaxation_time * velocity * share
        return width + growth * share * (drag + self.bodies.support_compliance * (load + drag * width))

    def damping_share(self, radius):
        # A support does not damp: its τ_w is 0.
        return self.bodies.relaxation_time**2 * radius / (4 * self.bodies.inertia)


class LoadingOnStructure(OnStructure, Loading):
    """Equation of motion on a structure up to the largest depth, in the penetration y."""

    def load(self, depth):
        rule = self.bodies.rule
        interval, increase = rule.loading(np.maximum(depth, 0.0), self.bodies.imprint_depth)
        return integrals(rule.profile).radius_integral(interval), rule.loading_stiffness_radius(
            interval, increase
        )

    def growth(self, depth, width):
        """Return ∂ω/∂y for Newton's method, without the change of dp/ds."""
        rule, interval = self.bodies.rule, self.interval(depth)
        yields = interval.lower > self.bodies.imprint_depth
        if not yields.any():
            return growth_at(rule.profile, width)
        lower = radius_rate(rule.profile, interval.lower) * rule.rate(interval.upper) ** 2
        growth = radius_rate(rule.profile, interval.upper)
        return np.where(yields, growth - lower, growth)


class UnloadingOnStructure(OnStructure, Unloading):
    """Equation of motion on a structure after the turning point, in the live depth ℓ."""

    def oscillated(self, state, radius):
        """Return states at the loss of contact for a constant contact radius (m) on a plate.

        ℓ̈ + 2δ ℓ̇ + ω₀² ℓ = 0 with δ = τ_w c/(2μ), ω₀² = c/μ, up to ℓ = 0.
        """
        bodies, depth = self.bodies, state.depth
        decay = bodies.relaxation_time * radius / (2 * bodies.inertia)
        frequency = np.sqrt(radius / bodies.inertia * (1 - self.damping_share(radius)))
        along, across = frequency * depth, state.velocity + decay * depth
        time = np.arctan2(along, -across) / frequency
        velocity = -np.hypot(along, across) * np.exp(-decay * time)
        body_velocity = state.velocity + bodies.relaxation_time * radius * depth / bodies.inertia
        lost = (bodies.inertia * (body_velocity**2 - velocity**2) + radius * depth**2) / 2
        return MotionState(np.zeros_like(depth), velocity, state.time + time, state.work + lost)

    def growth(self, depth, width):
        """Return ∂ω/∂ℓ."""
        return growth_at(self.bodies.profile, width)


#: Equations of loading and of unloading.
ON_MEDIUM = Loading, Unloading
ON_STRUCTURE = LoadingOnStructure, UnloadingOnStructure
