"""A free body on the chain: Newton's equation in steps that are exact for the elements.

1. A step of constant ḋ = V is exact for every element. The impulse J(V) of their force is therefore also
   exact. The velocity of the body changes from v to v₁ with m (v₁ − v) = −J(V), V = (v + v₁)/2, solved by
   Newton's method. The kinetic energy changes by the work of this force: energy is conserved for every
   step size. On a structure, ḋ is V minus the mean rate of the deflection. The deflection changes by
   J/Z + (F₁ − F₀)/K along the step, with the forces F₀ and F₁ at its ends. The waves take J²/Z over the
   duration of the step.
2. One step ends at the turning point ḋ = 0, because the elements remember the largest depth. Another step
   ends at the onset of yield, because the force has a kink there.
3. Steps are equal in ln(T₀ + t), with the time t since first contact, then since the turning point.
"""

from typing import NamedTuple

import numpy as np

from ...base.errors import MDRError
from ...base.motions import Motion
from ..numerics.roots import root_in_bracket
from . import element
from .cap import elastic_limit, plastic_depth
from .element import Elements, Exchange, Ramp
from .fronts import force_and_radius
from .grid import depth_bound
from .row import Row

#: Largest number of steps, and largest depth over critical depth.
_MAX_STEPS, _MAX_DEPTH_RATIO = 20_000, 1e11
#: Share of the initial energy at which the motion of a body that never leaves ends.
_REST = 1e-9


def earlier_depth(history):
    """Return the largest depth (m) of the moves of a foundation, at least 0."""
    return max([0.0, *(depth for depth, _ in history)])


def impact_depth_bound(profile, medium, mass, speed, history):
    """Return an upper bound (m) of the depth for a mass (kg) and a speed (m/s) after earlier moves."""
    momentum, start = mass * speed, earlier_depth(history)
    bound = min(
        depth_bound(profile, medium, "work", momentum * speed / 2, start),
        depth_bound(profile, medium, "momentum", momentum, start),
    )
    if bound > _MAX_DEPTH_RATIO * elastic_limit(profile, medium, bound):
        raise MDRError(
            f"speed = {speed:g} m/s presses to {bound:g} m, over {_MAX_DEPTH_RATIO:g} critical depths, "
            "where the live depth is lost in rounding; reduce the speed, or use impact"
        )
    return bound


def row_before(profile, medium, history, n, depth):
    """Return the `Row` after earlier moves, with edges at the radii of these moves and of `depth` (m)."""
    level = np.array([earlier_depth(history), depth])
    level = np.append(level, plastic_depth(profile, medium, level))
    nodes = profile.contact_radius(level[level > 0]) if n >= 16 else ()
    outer = min((1.02 + 2 / n) * level.max(), profile.known_depth)
    row = Row.virgin(profile, medium, n, profile.contact_radius(outer), nodes)
    for move, dt in history:
        row = row.advance(move, dt)
    return row


class BodyStep(NamedTuple):
    """One step: its ramp, the elements at its end, and their exchange.

    `velocity` of the body, `depth_rate` (m/s) and, on a support, `force` (N) are values at its end.
    """

    ramp: Ramp
    elements: Elements
    exchange: Exchange
    velocity: float
    depth_rate: float
    force: float = 0.0


class ImpactSolver:
    """Time integration of one impact.

    After `solved()` it has the `motion`, the `row` at the end of contact, the `quantities`, and whether the
    impact is `endless`. `depth` (m) is the approximate largest depth.
    """

    def __init__(self, row, mass, speed, steps, bound, structure, depth):
        self.row, self.steps, self.bound = row, steps, bound
        self.mass, self.speed, self.velocity, self.acceleration = mass, speed, speed, 0.0
        self.time, self.records, medium = 0.0, [], row.medium
        self.structure, self.depth, self.endless = structure, bound if structure.rigid else depth, False
        self.depth_rate, self.deflection = speed, 0.0
        self.structure_work, self.support_energy, self.support_force = 0.0, 0.0, 0.0
        # Mean rate (m/s) of the depth along the last step, and its duration (s).
        self.last_rate, self.last_duration = speed, np.inf
        self.earlier_depth, self.tau = earlier_depth(row.history), medium.relaxation_time
        self.yield_depth = max(self.earlier_depth, row.onset)
        # Velocities are computed to twelve digits of the velocity that remains after damping.
        tau = max(self.tau, bound * 1e-9 / speed)
        limit = elastic_limit(row.profile, medium, bound)
        self.precision = 1e-12 * min(speed, min(bound, limit) / tau)
        self._record()

    def solved(self):
        """Integrate from the start to the loss of contact, and return the solver itself."""
        self._approach()
        first, untouched = len(self.records), self.row
        self._advance_until(lambda: self.depth_rate <= self.precision, self.depth / self.speed)
        turning_time, max_force = self.time, self._max_force(untouched, first)
        # Time scale of the rebound: the time of an oscillator of stiffness 2E*a, or of its creep.
        stiffness = 2 * self.row.medium.E_star * force_and_radius(self.row)[1]
        rate = stiffness / (1 + stiffness / self.structure.stiffness) / self.mass
        unit = 1 / (np.sqrt(rate) + (self.tau + self.mass / self.structure.impedance) * rate)
        self.endless = self._never_leaves()
        self._advance_until(self._ended, unit)
        self._release_support()
        # Contact ended in the last step, when d + τḋ was the surface at the axis; then no force acts.
        penetration, rate = self.row.elements.penetration[0], self.depth_rate
        release_time = self.time if self.endless else self.time - (penetration + self.tau * rate) / rate
        motion = self.motion = self._motion(max(release_time, turning_time))
        stored, viscous = motion.stored_energy, motion.viscous_work
        self.quantities = {
            "restitution": 0.0 if self.endless else -self.velocity / self.speed,
            "max_depth": motion.depth.max(),
            "max_force": max_force,
            "contact_time": motion.time[-1] - motion.time[first - 1],
            "stored_energy": stored[motion.turning_index],
            "plastic_work": motion.plastic_work[-1] - motion.plastic_work[0],
            # Relaxing elements dissipate their stored energy after the end.
            "viscous_work": viscous[-1] - viscous[0] + stored[-1] - stored[0],
            "structure_work": motion.structure_work[-1],
        }
        return self

    def _never_leaves(self):
        """Whether the velocity of the body goes to zero with the force, because a plate damps it.

        The body is on a spring 2E*c with a dashpot of the time τ, on a second dashpot 1/β. Both modes are
        overdamped and slower than τ if βm − τ ≥ 2√(m/(2E*c)).
        """
        if not self.structure.is_plate:
            return False
        row = self.row
        d_p = float(plastic_depth(row.profile, row.medium, max(row.largest, self.earlier_depth)))
        c = float(row.profile.contact_radius(max(d_p, 0.0)))
        excess = self.mass / self.structure.impedance - self.tau
        return excess > 0 and excess**2 * 2 * row.medium.E_star * c >= 4 * self.mass

    def _release_support(self):
        """Give the body the energy left in a support, which carries no load after the contact.

        This energy is of second order in the steps. Without it the restitution has the error of the last
        step.
        """
        if self.support_energy:
            energy = self.mass * self.velocity**2 / 2 + self.support_energy
            self.velocity, self.support_energy = -np.sqrt(max(2 * energy / self.mass, 0.0)), 0.0
            self.records.pop()
            self._record()

    def _ended(self):
        """Whether the contact has ended, or an endless contact has almost no energy left."""
        if self.endless:
            left = self.row.stored_energy + self.mass * self.velocity**2 / 2
            return left <= _REST * self.mass * self.speed**2 / 2
        return self.depth_rate < 0 and not self.row.elements.contact.any()

    def _approach(self):
        """Move freely up to the surface at the axis, within 1e-9 of the depth bound."""
        for _ in range(1000):
            elements = self.row.elements
            surface = float(elements.reduced[0] + elements.plastic[0] + elements.elastic[0])
            gap = surface - self.row.depth
            if gap <= 1e-9 * self.bound or elements.contact.any():
                return
            step, _ = self._trial(self.velocity, (gap - 1e-10 * self.bound) / self.velocity, self.velocity)
            self._accept(step)

    def _advance_until(self, done, unit):
        """Take steps until `done()`, each a constant fraction of the time so far plus a unit (s)."""
        start = self.time
        for _ in range(_MAX_STEPS):
            dt = (unit + self.time - start) / self.steps
            step = self._step_to_yield(self._step(dt))
            if self.depth_rate > self.precision and step.depth_rate < -self.precision:
                step = self._turning_step(dt, step)
            self._accept(step)
            if done():
                return
        why = f": the relaxation time tau = {self.tau:g} s is far from the contact time" * (self.tau > 0)
        instead = "set eta = 0" if self.tau > 0 else "take impact, or a larger tolerance"
        raise MDRError(f"the impact needs more than {_MAX_STEPS} steps{why}; check the units, or {instead}")

    def _trial(self, rate, dt, velocity):
        """Return a step at a constant rate (m/s) that ends with a velocity, and its impulse (N·s)."""
        ramp = self.row.ramp(rate * dt, dt)
        elements, exchange = element.advance(self.row.elements, ramp)
        step = BodyStep(ramp, elements, exchange, velocity, velocity)
        return step, self.row.total(exchange.impulse)

    def _step(self, dt):
        """Return the step of duration dt (s) that satisfies Newton's equation."""
        m, v, structure = self.mass, self.velocity, self.structure
        # 2m (V − v) + J (1 + 2m/(Z Δt)) + … = 0: twice the momentum missing in the mean rate.
        share = 1 + 2 * m / structure.impedance / dt
        # From the mean rates of two steps, as in the backward differentiation formula of second order.
        ahead = dt / (dt + self.last_duration)

        def excess(rate):
            step, impulse = self._trial(rate, dt, v)
            after = v - impulse / m
            miss = 2 * m * (rate - v) + share * impulse
            slope = 2 * m + share * self.row.total(step.exchange.impulse_slope)
            end_rate, force = after, 0.0
            if structure.is_plate:
                end_rate = self._rate_on_plate(step.elements, after)
            elif structure.is_support:
                end_rate = rate + (rate - self.last_rate) * ahead
                row = self.row.after(step.ramp, step.elements, step.exchange, end_rate)
                force, unit = force_and_radius(row)[0], 2 * m / structure.stiffness / dt
                springs, dashpots = self._stiffness_and_drag(step.elements)
                miss += unit * (force - self.support_force)
                slope += unit * (springs * dt + dashpots * (1 + ahead))
                # The depth turns with the body; its rate is a share of the velocity of the body.
                end_rate = after / (1 + springs / structure.stiffness) if self.tau == 0 else end_rate
            return miss, slope, step._replace(velocity=after, depth_rate=end_rate, force=force)

        start = v + self.acceleration * dt / 2 if structure.rigid else self.depth_rate
        close = max(self.precision, 1e-12 * abs(v))
        return root_in_bracket(excess, start, -np.inf, np.inf, close)

    def _stiffness_and_drag(self, elements):
        """Return 2E*a (N/m) of springs that have not yielded, and 8ηa (N·s/m), at the end of a step."""
        held = elements.contact & (elements.elastic < self.row.elastic_limit * (1 - 1e-12))
        return self.row.total(held.astype(float)), self.tau * self.row.total(elements.contact.astype(float))

    def _rate_on_plate(self, elements, velocity):
        """Return the rate of the depth (m/s) on a plate, ḋ = V − F/Z; the dashpots carry 8ηa ḋ of F."""
        springs = self.row.total(np.where(elements.contact, elements.elastic, 0.0))
        drag = self.tau * self.row.total(elements.contact.astype(float))
        impedance = self.structure.impedance
        return (velocity - springs / impedance) / (1 + drag / impedance)

    def _step_to_yield(self, step):
        """Return the step, shortened to end at the onset of yield if it crosses that depth."""
        travel = self.yield_depth - self.row.depth
        for _ in range(4):
            if not 1e-9 * self.yield_depth < travel < step.ramp.travel:
                break
            step = self._step(step.ramp.duration * travel / step.ramp.travel)
        return step

    def _turning_step(self, max_dt, too_far):
        """Return the step to velocity zero, J(v/2) = m v, inside the step `too_far` of duration max_dt."""
        if not self.structure.rigid:
            return self._turning_step_on_structure(max_dt, too_far)
        m, v, velocity = self.mass, self.velocity, too_far.velocity

        def excess(dt):
            step, impulse = self._trial(v / 2, dt, 0.0)
            load = np.where(step.elements.contact, step.elements.elastic + step.ramp.lag, 0.0)
            return impulse - m * v, self.row.total(load) or m * v / max_dt, step

        guess = v / (v - velocity) * max_dt
        close = max(self.precision / v * guess, 1e-12 * max_dt)
        return root_in_bracket(excess, guess, 0.0, max_dt, close)

    def _turning_step_on_structure(self, max_dt, too_far):
        """Return the step to depth rate zero inside `too_far`, a step of duration max_dt (s)."""

        def excess(dt):
            step = self._step(dt)
            return -step.depth_rate, (self.depth_rate - too_far.depth_rate) / max_dt, step

        guess = self.depth_rate / (self.depth_rate - too_far.depth_rate) * max_dt
        step = root_in_bracket(excess, guess, 0.0, max_dt, 1e-12 * max_dt)
        return step._replace(depth_rate=0.0)

    def _accept(self, step):
        duration = step.ramp.duration
        self.acceleration = (step.velocity - self.velocity) / duration
        if not self.structure.rigid:
            force = self.mass * (self.velocity - step.velocity) / duration
            self.deflection += force * duration / self.structure.impedance
            self.deflection += (step.force - self.support_force) / self.structure.stiffness
            self.structure_work += force**2 * duration / self.structure.impedance
            self.support_energy += force * (step.force - self.support_force) / self.structure.stiffness
            self.support_force = step.force
            self.last_rate, self.last_duration = step.ramp.travel / duration, duration
        # The load of the dashpots follows the rate at the end, not the mean rate of the step.
        self.row = self.row.after(step.ramp, step.elements, step.exchange, step.depth_rate)
        self.velocity, self.time = step.velocity, self.time + duration
        self.depth_rate = step.depth_rate
        self._record()

    def _record(self):
        row, v, rate = self.row, self.velocity, self.depth_rate
        force, radius = force_and_radius(row)
        live_depth = max(row.elements.elastic[0] + min(self.tau * rate, 0.0), 0.0)
        self.records.append({
            "time": self.time, "depth": row.depth, "velocity": rate,
            "force": force, "contact_radius": radius,
            "live_depth": live_depth if row.elements.contact[0] else 0.0,
            "kinetic_energy": self.mass * v**2 / 2, "stored_energy": row.stored_energy,
            "plastic_work": row.plastic_work, "viscous_work": row.viscous_work,
            "deflection": self.deflection, "body_velocity": v, "structure_work": self.structure_work,
            "support_energy": self.support_energy,
        })  # fmt: skip

    def _columns(self):
        return {name: np.array([record[name] for record in self.records]) for name in self.records[0]}

    def _max_force(self, row, first):
        """Return the largest force (N) up to the turning point, from steps and a parabola through three.

        Under blunt indenters most of the dashpots' force acts at once. The `first` step, from the `row`
        before it, is therefore sampled at times of every order of magnitude. This is not needed on a
        support, which the dashpots press first.
        """
        columns = self._columns()
        time, depth, force = columns["time"], columns["depth"], columns["force"]
        (v, slower), dt = columns["body_velocity"][first - 1 : first + 1], time[first] - time[first - 1]
        mean_rate = (depth[first] - depth[first - 1]) / dt
        early_time, early = dt * np.geomspace(1e-9, 1.0, 40)[:-1], np.empty((39, 2))
        if self.structure.is_support:
            early_time, early = early_time[:0], early[:0]
        for i, t in enumerate(early_time):
            velocity = v + (slower - v) * t / dt
            ramp = row.ramp((mean_rate if self.structure.is_plate else (v + velocity) / 2) * t, t)
            elements, exchange = element.advance(row.elements, ramp)
            rate = self._rate_on_plate(elements, velocity) if self.structure.is_plate else velocity
            moved = row.after(ramp, elements, exchange, rate)
            early[i] = moved.depth, force_and_radius(moved)[0]
        time = np.append(time[first - 1] + early_time, time[first:])
        depth, force = np.append(early.T, [depth[first:], force[first:]], axis=1)
        # The parabola stays between first contact and turning point, and does not cross the kink at yield.
        i = min(max(int(np.argmax(force)), 1), len(force) - 2)
        if depth[i - 1] < self.yield_depth * (1 - 1e-3) and depth[i + 1] > self.yield_depth * (1 + 1e-3):
            return float(force.max())
        # Next to a kink, such as the start of a plateau at a wall, the force bends less.
        bends = np.diff(np.diff(force) / np.diff(time)) / (time[2:] - time[:-2])
        if np.any(bends[max(i - 2, 0) : i + 1] > bends[i - 1] / 4):
            return float(force.max())
        x, y = (time[i - 1 : i + 2] - time[i]) / (time[i + 1] - time[i]), force[i - 1 : i + 2] - force[i]
        curvature, slope, _ = np.polyfit(x, y, 2)
        top = -slope / (2 * curvature) if curvature < 0 else np.inf
        return float(force[i] + slope * top / 2 if x[0] < top < 1 else force.max())

    def _motion(self, end):
        """Return the `Motion` of the recorded steps; its last time (s) is moved to the end of contact."""
        columns, row = self._columns(), self.row
        time, depth = columns["time"], columns["depth"]
        end = max(end, time[-2])
        time[-1], depth[-1] = end, depth[-1] + columns["velocity"][-1] * (end - time[-1])
        largest_depth = np.maximum(np.maximum.accumulate(depth), self.earlier_depth)
        d_p = plastic_depth(row.profile, row.medium, largest_depth)
        radius = np.where(d_p > 0, row.profile.contact_radius(d_p), 0.0)
        return Motion(**columns, plastic_depth=d_p, plastic_radius=radius)
