"""The flight of a free body on a chain: Newton's equation in steps that are exact for the elements.

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

from . import elements
from .foundation import Foundation
from .fronts import force_and_radius
from .motion import Motion
from .peak import Step, largest_force

#: Change of velocity, and path, of the first run's steps in units of the whole, and by how much less of
#: the path on the way back; change in units of the velocity itself; growth of the steps.
_SHARE, _FINER, _CREEP, _GROWTH = 1 / 4, 1.5, 0.6, 2.0
#: What follows the planned steps, should contact last longer than planned: for a body that all but
#: floats on the dashpots it may be a thousand times as long.
_TAIL = 1.2 ** np.arange(1, 100)
#: What velocities are found to, relative to themselves and to what damping leaves of the speed.
_FINEST = 1e-12
#: Time steps of a run, and of the first one, which only plans them.
_MOST_STEPS, _MOST_PLANNED = 100_000, 5000


@dataclass(frozen=True, eq=False)
class Run:
    """One flight.

    Its `motion`, the chain at the end, the time of contact (s), and the largest force (N), also
    inside of a step.
    """

    motion: Motion
    foundation: Foundation
    contact_time: float
    max_force: float


class _Flight:
    """One run: the chain, the velocity, and what has been recorded so far."""

    def __init__(self, body, row, most=_MOST_STEPS):
        self.body, self.row, self.velocity, self.most = body, row, body.speed, most
        self.precision = None
        self.acceleration = self.jerk = self.time = self.met = 0.0
        self.turned, self.steps, self.records = None, [], []
        self.largest, self.around = 0.0, []
        self._record()

    def _record(self):
        row, v = self.row, self.velocity
        force, radius = force_and_radius(row)
        axis = row._elements.elastic[0] + min(row.medium.relaxation_time * v, 0.0)
        live = max(axis, 0.0) if row._elements.contact[0] else 0.0
        ledger = (self.body.mass * v**2 / 2, row.stored_energy, row.plastic_work, row.viscous_work)
        self.records.append((self.time, row.depth, v, force, radius, live, *ledger))
        return force

    @property
    def over(self):
        """Whether the body leaves for good: it goes back and touches nothing."""
        return self.velocity < 0 and not self.row._elements.contact.any()

    def trial(self, rate, dt):
        """Ramp, new elements and exchange of a step, and its impulse (N·s)."""
        ramp = self.row._ramp(rate * dt, dt)
        state, exchange = elements.advance(self.row._elements, ramp)
        return ramp, state, exchange, self.row._total(exchange.impulse)

    def step(self, dt):
        """One step of the given time, with the new velocity."""
        m, v = self.body.mass, self.velocity
        last = self.steps[-1] if self.steps else 0.0

        def excess(rate):
            *taken, impulse = self.trial(rate, dt)
            return 2 * m * (rate - v) + impulse, (*taken, v - impulse / m)

        def slope(taken):
            return 2 * m + self.row._total(taken[2].response)

        guess = v + (self.acceleration + self.jerk * (last + dt) / 2) * dt / 2
        return _settled(excess, slope, guess, (-np.inf, np.inf), max(self.precision, _FINEST * abs(v)))

    def turn(self, longest, after):
        """The step that ends where the velocity is zero, J(v/2) = m v; less than one that ends beyond."""
        m, v = self.body.mass, self.velocity

        def excess(dt):
            *taken, impulse = self.trial(v / 2, dt)
            return impulse - m * v, (*taken, 0.0)

        def force(taken):
            ramp, state, *_ = taken
            return (
                self.row._total(np.where(state.contact, state.elastic + ramp.lag, 0.0)) or m * v / longest
            )

        shortest, guess = 1e-12 * longest, v / (v - after) * longest
        close = max(self.precision / (v - after) * longest, shortest)
        return _settled(excess, force, guess, (shortest, longest), close)

    def accept(self, ramp, state, exchange, velocity):
        """Take a step into the records."""
        taken = Step(self.row, self.velocity, velocity, ramp.time)
        acceleration = taken.acceleration
        if self.steps:
            # From the middle of the last step to the middle of this one.
            self.jerk = 2 * (acceleration - self.acceleration) / (ramp.time + self.steps[-1])
        self.acceleration, self.velocity = acceleration, velocity
        # With the dashpots at the present velocity, not at the mean one of the step.
        self.row = self.row._after(ramp, state, exchange, velocity)
        self.time += ramp.time
        self.steps.append(ramp.time)
        force = self._record()
        if force > self.largest:
            self.largest, self.around = force, [taken]
        elif len(self.around) == 1:
            self.around.append(taken)

    def go(self, dt, taken=None):
        """A step of the given time, or up to where the body turns round."""
        if len(self.steps) > self.most:
            raise ValueError(
                f"the impact takes more than {self.most} steps: the relaxation time tau = "
                f"{self.row.medium.relaxation_time:g} s is out of proportion to the time of contact; "
                "check the units, or leave out eta"
            )
        taken = taken or self.step(dt)
        # With next to no velocity, before or after, the step ends there already.
        still = 10 * self.precision
        if self.velocity > still and taken[-1] < -still:
            taken = self.turn(dt, taken[-1])
        self.accept(*taken)
        if self.turned is None and self.velocity <= still:
            self.turned = len(self.steps)

    def approach(self, room):
        """Fly freely to where the axis is met, but for a billionth of `room` (m)."""
        medium, speed = self.row.medium, self.body.speed
        # Where damping rules the body goes back as slowly as what is compressed relaxes; else τ is none.
        tau = max(medium.relaxation_time, room * 1e-9 / speed)
        self.precision = _FINEST * min(speed, min(room, medium.critical_depth) / tau)
        for _ in range(1000):
            state = self.row._elements
            gap = float(state.reduced[0] + state.plastic[0] + state.elastic[0]) - self.row.depth
            if gap <= 1e-9 * room or state.contact.any():
                break
            dt = (gap - 1e-10 * room) / self.velocity
            self.accept(*self.trial(self.velocity, dt)[:3], self.velocity)
        self.met = self.time
        self.steps.clear()

    @property
    def left(self):
        """Time (s) at which contact is lost, where d + τḋ is down at the axis.

        After that no force acts, so that the straight line through the end is the motion itself.
        """
        row, v = self.row, self.velocity
        straight = self.time - (row._elements.above[0] + row.medium.relaxation_time * v) / v
        # Not before the turning point, where next to nothing of v is left.
        return max(straight, self.time - sum(self.steps[self.turned :]))

    @property
    def legs(self):
        """The time steps (s) up to the turning point, and after it."""
        return np.array(self.steps[: self.turned]), np.array(self.steps[self.turned :])

    def run(self):
        """What was recorded, with the end where contact is lost."""
        columns = [np.array(column) for column in zip(*self.records, strict=True)]
        time, depth, velocity, force, radius, live, *ledger = columns
        end = max(self.left, time[-2])
        time[-1], depth[-1] = end, depth[-1] + velocity[-1] * (end - time[-1])
        medium, profile = self.row.medium, self.row.profile
        past = np.maximum(np.maximum.accumulate(depth), self.body.met_before)
        plastic = np.maximum(past - medium.critical_depth, 0.0)
        zone = np.where(plastic > 0, profile.contact_radius(plastic), 0.0)
        motion = Motion(time, depth, velocity, force, radius, zone, plastic, live, *ledger)
        first_yield = max(self.body.met_before, medium.critical_depth)
        peak = largest_force(self.around, first_yield, self.largest)
        return Run(motion, self.row, self.left - self.met, peak)


def _settled(function, slope, x, bracket, close):
    """What is found at the root of a function with some slope: by Newton's method inside a bracket."""
    (low, high), steep = bracket, np.inf
    for count in range(80):
        value, found = function(x)
        # The last slope will do to tell that it is near enough.
        if count and abs(value) <= close * steep:
            break
        steep = slope(found)
        miss = value / steep
        if abs(miss) <= close or high - low <= close:
            break
        low, high = (x, high) if miss < 0 else (low, x)
        x -= miss
        # Elements that let go within the step bend J sharply: then halve the bracket by turns.
        if not low < x < high or (count > 5 and count % 2 and high - low < np.inf):
            x = (low + high) / 2
    return found


def pace(body, row, deepest):
    """Time steps (s) on either leg as long as velocity and depth allow, and the largest depth (m)."""
    flight = _Flight(body, row, _MOST_PLANNED)
    flight.approach(deepest)
    path = _SHARE * max(deepest - row.depth, _SHARE * deepest)
    longest = _SHARE * body.speed
    dt = path / body.speed / 10
    while not flight.over:
        taken = flight.step(dt)
        change, rise = abs(taken[-1] - flight.velocity), abs(taken[0].rise)
        excess = max(change / longest, rise / path)
        if 0 < taken[-1] < flight.velocity:
            # What creeps to a halt is to be seen to.
            excess = max(excess, change / (_CREEP * flight.velocity))
        if excess > 1.5:
            dt *= max(1 / excess, 0.1)
            continue
        down = flight.turned is None
        flight.go(dt, taken)
        dt *= min(_GROWTH, 1 / max(excess, 1e-300))
        if down and flight.turned:
            # What springs back is no more than the critical depth.
            path = min(path, _SHARE * body.medium.critical_depth) / _FINER
            dt = min(dt, np.sqrt(path / max(abs(flight.acceleration), 1e-300)))
        elif not down:
            # A body that creeps out of the imprint does so on the scale of the time it has taken.
            dt = min(dt, 1.5 * _SHARE * flight.time)
            # A flat face lets go exponentially, and contact ends by what little of the force is left.
            before, after = (flight.records[i][3] for i in (-2, -1))
            if after < before / 3:
                dt = min(dt, flight.steps[-1])
    down, up = flight.legs
    return (down, np.append(up, up[-1] * _TAIL)), max(record[1] for record in flight.records)


def fly(body, row, legs, room):
    """A run with given time steps (s) on either leg, the last one repeated as long as the leg lasts."""
    flight = _Flight(body, row)
    flight.approach(room)
    down, up = legs
    for dt in chain(down, repeat(np.max(down[-3:]))):
        flight.go(dt)
        if flight.turned:
            break
    for dt in chain(up, repeat(up[-1])):
        if flight.over:
            return flight.run()
        flight.go(dt)


def halved(legs):
    """Every time step of both legs in two."""
    return tuple(np.repeat(steps / 2, 2) for steps in legs)
