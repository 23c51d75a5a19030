"""A free body on the chain: Newton's equation in steps that are exact for the elements.

1. The chain is as wide as the contact that springs, or dashpots alone, allow at most.
2. A step of constant ḋ = V is exact for every element, and so is the impulse J(V) of their force.
   The velocity of the body changes from v to v₁ with m (v₁ − v) = −J(V), V = (v + v₁)/2, found by Newton's
   method. Its kinetic energy changes by the work of that very force: the ledger closes whatever the step.
3. The largest depth is what the elements remember: one step is split where the body turns round.
4. Steps are equal in ln(T₀ + t), with t the time since first contact, then since the turning point.
   Contact ends when the last element lets go.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .. import _check
from .._numeric import root_in_bracket
from ..medium import Medium
from ..results import Motion
from ..shapes.profile import Profile
from . import element
from .fronts import force_and_radius
from .reach import reach
from .row import Foundation

_MOST_STEPS = 20_000
#: The deepest that the chain can tell the critical depth from rounding, in critical depths.
_DEEPEST = 1e11


@dataclass(frozen=True)
class Body:
    """What flies, against what, and from where."""

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    history: tuple[tuple[float, float], ...] = ()

    def __post_init__(self):
        object.__setattr__(self, "mass", _check.positive_number("mass", self.mass, unit="kg"))
        object.__setattr__(self, "speed", _check.positive_number("speed", self.speed, unit="m/s"))

    @property
    def met_before(self):
        """Largest depth (m) of the history, at least 0."""
        return max([0.0, *(depth for depth, _ in self.history)])

    def room(self):
        """A depth (m) that the body does not exceed, beyond what was met before."""
        profile, medium, momentum, past = self.profile, self.medium, self.mass * self.speed, self.met_before
        bound = min(
            reach(profile, medium, "work", momentum * self.speed / 2, past),
            reach(profile, medium, "momentum", momentum, past),
        )
        if bound > _DEEPEST * medium.critical_depth:
            raise ValueError(
                f"speed = {self.speed:g} m/s presses to {bound:g} m, over {_DEEPEST:g} critical depths, "
                "so that what springs back is lost in rounding; hit less hard, or use impact"
            )
        return bound

    def row(self, n, deepest):
        """The chain on which the body starts, with edges at the radii of a depth (m) and of the past."""
        level = np.array([self.met_before, deepest])
        level = np.append(level, level - self.medium.critical_depth)
        nodes = self.profile.contact_radius(level[level > 0]) if n >= 16 else ()
        widest = min((1.02 + 2 / n) * level.max(), self.profile.known_depth)
        half_width = self.profile.contact_radius(widest)
        row = Foundation(self.profile, self.medium, n, half_width, nodes=tuple(nodes))
        for depth, dt in self.history:
            row = row.advance(depth, dt)
        return row


class Run(NamedTuple):
    """One run: its motion, the chain when contact ends, and its `quantities`.

    These are the coefficient of restitution, largest depth (m) and force (N), contact time (s), and the
    energies (J) stored at the turning point, and dissipated by yielding and by the dashpots.
    """

    motion: Motion
    foundation: Foundation
    quantities: np.ndarray


class Flight:
    """A body on its way: the chain, the velocity, and what has been recorded so far."""

    def __init__(self, body, row, steps, room):
        self.body, self.row, self.velocity, self.steps, self.room = body, row, body.speed, steps, room
        self.time, self.acceleration, self.records = 0.0, 0.0, []
        self.first_yield = max(body.met_before, body.medium.critical_depth)
        # Velocities are found to twelve digits of what damping leaves of them.
        tau = max(body.medium.relaxation_time, room * 1e-9 / body.speed)
        self.still = 1e-12 * min(body.speed, min(room, body.medium.critical_depth) / tau)
        self._record()

    def run(self):
        """The flight from the start to the loss of contact."""
        self._approach()
        first, unit = len(self.records), self.room / self.body.speed
        before = self.row
        self._leg(unit, lambda: self.velocity <= self.still)
        turn, (medium, mass) = self.time, (self.body.medium, self.body.mass)
        rate = 2 * medium.E_star * force_and_radius(self.row)[1] / mass
        peak = self._largest_force(before, first)
        self._leg(1 / (np.sqrt(rate) + medium.relaxation_time * rate), self._free)
        motion = self._motion(max(self._left(), turn))
        lasts = motion.time[-1] - motion.time[first - 1]
        stored, plastic, viscous = motion.stored_energy, motion.plastic_work, motion.viscous_work
        # What relaxing elements still store at the end is lost, too.
        lost = viscous[-1] - viscous[0] + stored[-1] - stored[0]
        energies = stored[motion.turning_index], plastic[-1] - plastic[0], lost
        restitution = -self.velocity / self.body.speed
        return Run(motion, self.row, np.array([restitution, motion.depth.max(), peak, lasts, *energies]))

    def _free(self):
        return self.velocity < 0 and not self.row._elements.contact.any()

    def _left(self):
        """Time (s) at which contact is lost, where d + τḋ is down at the axis; after that no force acts."""
        row, v = self.row, self.velocity
        return self.time - (row._elements.above[0] + row.medium.relaxation_time * v) / v

    def _approach(self):
        """Fly freely to where the axis is met, but for a billionth of the way to come."""
        for _ in range(1000):
            state = self.row._elements
            gap = float(state.reduced[0] + state.plastic[0] + state.elastic[0]) - self.row.depth
            if gap <= 1e-9 * self.room or state.contact.any():
                return
            dt = (gap - 1e-10 * self.room) / self.velocity
            self._accept(*self._trial(self.velocity, dt)[:3], self.velocity)

    def _leg(self, unit, over):
        """Steps until it is over, from a share of a time `unit` (s) on, in proportion to the time gone."""
        begin = self.time
        for _ in range(_MOST_STEPS):
            dt = (unit + self.time - begin) / self.steps
            taken = self._until_yield(self._step(dt))
            if self.velocity > self.still and taken[-1] < -self.still:
                taken = self._turn(dt, taken[-1])
            self._accept(*taken)
            if over():
                return
        raise ValueError(
            f"the impact takes more than {_MOST_STEPS} steps: the relaxation time tau = "
            f"{self.row.medium.relaxation_time:g} s is out of proportion to the time of contact; "
            "check the units, or leave out eta"
        )

    def _until_yield(self, taken):
        """A step, or one that ends where yield begins, if it would pass there: the force has a kink."""
        way = self.first_yield - self.row.depth
        for _ in range(4):
            if not 1e-9 * self.first_yield < way < taken[0].rise:
                break
            taken = self._step(taken[0].time * way / taken[0].rise)
        return taken

    def _largest_force(self, row, first):
        """The largest force (N) so far: at the end of a step, or between three that nothing happens at.

        Blunt bodies are met with most of the force of the dashpots: within the `first` step it is asked for
        at times of every order.
        """
        met, time, depth, force = (np.array([record[k] for record in self.records]) for k in (2, 0, 1, 3))
        v, dt = met[first - 1], time[first] - time[first - 1]
        within = dt * np.geomspace(1e-9, 1.0, 40)[:-1]
        early = []
        for t in within:
            slower = v + (met[first] - v) * t / dt
            ramp = row._ramp((v + slower) / 2 * t, t)
            moved = row._after(ramp, *element.advance(row._elements, ramp), slower)
            early.append((moved.depth, force_and_radius(moved)[0]))
        time = np.append(time[first - 1] + within, time[first:])
        depth, force = np.append(np.transpose(early), [depth[first:], force[first:]], axis=1)
        # Before first touch, and after the turning point, the force is another function of time.
        i = min(max(int(np.argmax(force)), 1), len(force) - 2)
        if depth[i - 1] < self.first_yield * (1 - 1e-3) and depth[i + 1] > self.first_yield * (1 + 1e-3):
            return float(force.max())
        x, y = (time[i - 1 : i + 2] - time[i]) / (time[i + 1] - time[i]), force[i - 1 : i + 2] - force[i]
        bend, slope, _ = np.polyfit(x, y, 2)
        top = -slope / (2 * bend) if bend < 0 else np.inf
        return float(force[i] + slope * top / 2 if x[0] < top < 1 else force.max())

    def _trial(self, rate, dt):
        """Ramp, new elements and exchange of a step, and its impulse (N·s)."""
        ramp = self.row._ramp(rate * dt, dt)
        state, exchange = element.advance(self.row._elements, ramp)
        return ramp, state, exchange, self.row._total(exchange.impulse)

    def _step(self, dt):
        """One step of the given time, with the new velocity."""
        m, v = self.body.mass, self.velocity

        def excess(rate):
            *taken, impulse = self._trial(rate, dt)
            slope = 2 * m + self.row._total(taken[2].response)
            return 2 * m * (rate - v) + impulse, slope, (*taken, v - impulse / m)

        close = max(self.still, 1e-12 * abs(v))
        return root_in_bracket(excess, v + self.acceleration * dt / 2, -np.inf, np.inf, close)

    def _turn(self, longest, after):
        """The step that ends where the velocity is zero, J(v/2) = m v; less than one that ends beyond."""
        m, v = self.body.mass, self.velocity

        def excess(dt):
            *taken, impulse = self._trial(v / 2, dt)
            ramp, state, _ = taken
            force = self.row._total(np.where(state.contact, state.elastic + ramp.lag, 0.0))
            return impulse - m * v, force or m * v / longest, (*taken, 0.0)

        guess = v / (v - after) * longest
        return root_in_bracket(excess, guess, 0.0, longest, max(self.still / v * guess, 1e-12 * longest))

    def _accept(self, ramp, state, exchange, velocity):
        self.acceleration = (velocity - self.velocity) / ramp.time
        # With the dashpots at the present velocity, not at the mean one of the step.
        self.row, self.velocity = self.row._after(ramp, state, exchange, velocity), velocity
        self.time += ramp.time
        self._record()

    def _record(self):
        row, v = self.row, self.velocity
        axis = row._elements.elastic[0] + min(row.medium.relaxation_time * v, 0.0)
        interval = max(axis, 0.0) if row._elements.contact[0] else 0.0
        ledger = (self.body.mass * v**2 / 2, row.stored_energy, row.plastic_work, row.viscous_work)
        self.records.append((self.time, row.depth, v, *force_and_radius(row), interval, *ledger))

    def _motion(self, end):
        """What was recorded, with the end where contact is lost."""
        columns = [np.array(column) for column in zip(*self.records, strict=True)]
        time, depth, velocity, force, radius, interval, *ledger = columns
        end = max(end, time[-2])
        time[-1], depth[-1] = end, depth[-1] + velocity[-1] * (end - time[-1])
        past = np.maximum(np.maximum.accumulate(depth), self.body.met_before)
        plastic = np.maximum(past - self.body.medium.critical_depth, 0.0)
        zone = np.where(plastic > 0, self.body.profile.contact_radius(plastic), 0.0)
        return Motion(time, depth, velocity, force, radius, zone, plastic, interval, *ledger)
