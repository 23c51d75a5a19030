"""A free body on a chain: Newton's equation in steps that are exact for the elements.

In a step of constant ḋ = V the impulse J(V) of the chain's force is exact, and the body's velocity
changes from v to v₁ with

    m (v₁ − v) = −J(V),   V = (v + v₁)/2,

so that its kinetic energy changes by the work −V J of that very force: the ledger closes whatever
the step. The order is two. One step ends where the body turns round, for the largest depth is what
the elements remember.
"""

from dataclasses import dataclass
from itertools import chain, repeat

import numpy as np
from scipy.optimize import brentq

from . import _check, elements
from .bounds import least_depth, resistance
from .foundation import Foundation, check_pair
from .medium import Medium
from .profiles import Profile

#: Change of velocity, and path, of the first run's steps in units of the whole.
_SHARE = 1 / 12
_MOST_STEPS = 100_000


@dataclass(frozen=True)
class Body:
    """What flies, against what, and from where."""

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    history: tuple[tuple[float, float], ...] = ()

    def __post_init__(self):
        check_pair(self.profile, self.medium)
        object.__setattr__(self, "mass", _check.positive_number("mass", self.mass, unit="kg"))
        object.__setattr__(self, "speed", _check.positive_number("speed", self.speed, unit="m/s"))

    @property
    def met_before(self):
        """Largest depth (m) of the history, at least 0."""
        return max([0.0, *(depth for depth, _ in self.history)])

    def row(self, n, deepest):
        """The chain on which the body starts, wide enough for a depth (m), edges at the plastic zones."""
        past = self.met_before
        level = np.array([past, deepest]) - self.medium.critical_depth
        nodes = self.profile.contact_radius(level[level > 0])
        widest = min(1.02 * max(past, deepest), self.profile.deepest)
        half_width = self.profile.contact_radius(widest)
        row = Foundation(self.profile, self.medium, n, half_width, nodes=tuple(nodes))
        for depth, dt in self.history:
            row = row.advance(depth, dt)
        return row


@dataclass(frozen=True, eq=False)
class Motion:
    """The motion step by step, from the start to the end of contact; arrays of one length.

    Time (s), depth (m), velocity (m/s), force (N) and the ledger (J): kinetic, stored, plastic and
    viscous. `legs` are the time steps (s) up to the turning point and after it, `foundation` is the
    chain at the end, `met` the time of first contact.
    """

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    kinetic_energy: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray
    legs: tuple[np.ndarray, np.ndarray]
    foundation: Foundation
    met: float


def reach(body):
    """A depth (m) that the body does not exceed, beyond what was met before."""
    profile, medium = body.profile, body.medium
    momentum, energy = body.mass * body.speed, body.mass * body.speed**2 / 2
    past = resistance(profile, medium, body.met_before)

    def stops(now):
        spent = now.work - past.work >= energy
        return spent or (medium.eta > 0 and now.momentum - past.momentum >= momentum)

    return least_depth(profile, medium, stops, body.met_before)


class _Flight:
    """One run: the chain, the velocity, and what has been recorded so far."""

    def __init__(self, body, row, precision):
        self.body, self.row, self.velocity = body, row, body.speed
        self.precision = precision * body.speed
        self.acceleration = self.jerk = self.time = 0.0
        self.met, self.end, self.turned = np.inf, 0.0, None
        self.steps, self.records = [], []
        self._record()

    def _record(self):
        row, v, m = self.row, self.velocity, self.body.mass
        state, medium = row._elements, row.medium
        # With the dashpots at the present velocity, not at the mean one of the step.
        load = np.maximum(state.elastic + medium.relaxation_time * v, 0.0)
        force = row._total(np.where(state.contact, load, 0.0))
        ledger = (m * v**2 / 2, row.stored_energy, row.plastic_work, row.viscous_work)
        self.records.append((self.time, row.depth, v, force, *ledger))

    @property
    def over(self):
        """Whether the body leaves for good: it goes back and touches nothing."""
        return self.velocity < 0 and not self.row._elements.contact.any()

    def trial(self, rate, dt):
        """Ramp, new elements, exchange, impulse (N·s) and its slope dJ/dV (kg) for a step."""
        ramp = self.row._ramp(self.row.depth + rate * dt, dt)
        state, exchange = elements.advance(self.row._elements, ramp)
        row = self.row
        return ramp, state, exchange, row._total(exchange.impulse), row._total(exchange.response)

    def step(self, dt):
        """One step of the given time, by Newton's method in V; with the new velocity."""
        m, v = self.body.mass, self.velocity
        last = self.steps[-1] if self.steps else 0.0
        rate = v + (self.acceleration + self.jerk * (last + dt) / 2) * dt / 2
        low, high = -np.inf, np.inf
        for count in range(80):
            ramp, state, exchange, impulse, slope = self.trial(rate, dt)
            miss = (2 * m * (rate - v) + impulse) / (2 * m + slope)
            if abs(miss) <= self.precision or high - low <= self.precision:
                break
            low, high = (rate, high) if miss < 0 else (low, rate)
            rate -= miss
            # Elements that let go within the step bend J sharply: then halve the bracket by turns.
            if not low < rate < high or (count > 5 and count % 2 and high - low < np.inf):
                rate = (low + high) / 2
        return ramp, state, exchange, v - impulse / m

    def turn(self, longest):
        """The step that ends where the velocity is zero, J(v/2) = m v."""
        m, v = self.body.mass, self.velocity

        def excess(dt):
            return (self.trial(v / 2, dt)[3] if dt else 0.0) - m * v

        dt = max(brentq(excess, 0.0, longest, xtol=1e-12 * longest), 1e-12 * longest)
        return *self.trial(v / 2, dt)[:3], 0.0

    def accept(self, ramp, state, exchange, velocity):
        """Take a step into the records."""
        touched = exchange.duration.max()
        if touched > 0:
            # On a virgin surface contact begins between the elements, at depth 0.
            first = self.time + ramp.time - touched if self.body.history else 0.0
            self.met = min(self.met, first)
            self.end = self.time + (ramp.time if state.contact.any() else touched)
        acceleration = (velocity - self.velocity) / ramp.time
        if self.steps:
            # From the middle of the last step to the middle of this one.
            self.jerk = 2 * (acceleration - self.acceleration) / (ramp.time + self.steps[-1])
        self.acceleration, self.velocity = acceleration, velocity
        self.row = self.row._after(ramp, state, exchange)
        self.time += ramp.time
        self.steps.append(ramp.time)
        self._record()

    def go(self, dt, taken=None):
        """A step of the given time, or up to where the body turns round."""
        if len(self.steps) > _MOST_STEPS:
            raise ValueError(
                f"the impact takes more than {_MOST_STEPS} steps: the relaxation time tau = "
                f"{self.row.medium.relaxation_time:g} s is out of proportion to the time of contact; "
                "check the units, or leave out eta"
            )
        taken = taken or self.step(dt)
        # With next to no velocity, before or after, the step ends there already.
        still = 10 * self.precision
        if self.velocity > still and taken[-1] < -still:
            taken = self.turn(dt)
        self.accept(*taken)
        if self.turned is None and self.velocity <= still:
            self.turned = len(self.steps)

    def approach(self, room):
        """Fly freely to a distance `room` (m) of the first element."""
        for _ in range(1000):
            state = self.row._elements
            gap = float(np.min(state.reduced + state.plastic + state.elastic)) - self.row.depth
            if gap <= room or state.contact.any():
                return
            dt = (gap - room / 2) / self.velocity
            self.accept(*self.trial(self.velocity, dt)[:3], self.velocity)

    def motion(self):
        """What was recorded, with the end where the last element lets go."""
        columns = [np.array(column) for column in zip(*self.records, strict=True)]
        columns[0][-1] = self.end
        legs = np.array(self.steps[: self.turned]), np.array(self.steps[self.turned :])
        return Motion(*columns, legs, self.row, self.met)


def pace(body, row, deepest):
    """A first run with steps as long as velocity and depth allow."""
    flight = _Flight(body, row, 1e-6)
    flight.approach(deepest)
    flight.steps.clear()
    path = _SHARE * max(deepest - row.depth, _SHARE * deepest)
    longest = _SHARE * body.speed
    dt = path / body.speed / 10
    while not flight.over:
        taken = flight.step(dt)
        change, rise = abs(taken[-1] - flight.velocity), abs(taken[0].rise)
        excess = max(change / longest, rise / path)
        if excess > 1.5:
            dt *= max(1 / excess, 0.1)
            continue
        down = flight.turned is None
        flight.go(dt, taken)
        dt *= min(1.5, 1 / max(excess, 1e-300))
        if down and flight.turned:
            # What springs back is no more than the critical depth.
            path = min(path, _SHARE * body.medium.critical_depth)
            dt = min(dt, np.sqrt(path / max(abs(flight.acceleration), 1e-300)))
        elif not down:
            # A body that creeps out of the imprint does so on the scale of the time it has taken.
            dt = min(dt, 1.5 * _SHARE * flight.time)
    return flight.motion()


def fly(body, row, legs, room, precision):
    """A run with given time steps (s) on either leg, the last one repeated as long as the leg lasts."""
    flight = _Flight(body, row, min(1e-9, 1e-4 * precision))
    flight.approach(room)
    flight.steps.clear()
    down, up = legs
    for dt in chain(down, repeat(np.max(down[-3:]))):
        flight.go(dt)
        if flight.turned:
            break
    for dt in chain(up, repeat(up[-1])):
        if flight.over:
            return flight.motion()
        flight.go(dt)


def halved(legs):
    """Every time step of both legs in two."""
    return tuple(np.repeat(steps / 2, 2) for steps in legs)
