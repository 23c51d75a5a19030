"""The equation of motion of an impact on a viscous medium, many impacts in step.

The element of Popov (2015), Eqs. (1), (17), (18) is a spring that never carries more than π q_c/2, and a
dashpot beside it. On loading all of them are pressed; on unloading an element lets go when its total load
reaches zero, which happens at g = d + τḋ, outside first. With y = d − p₀ the penetration into what is met,
p the plastic depth, ℓ = d + τḋ − p the live one, Φ = ∫ a ds over it, τ = 4η/E*, and μ = m/(2E*),

    loading     μ v̇ = −(Φ + τ a v)     ẏ = v              ẇ = τ a v²        until v = 0
    unloading   μ v̇ = −Φ               ℓ̇ = v + τ v̇       ẇ = τ a v ℓ̇     until ℓ = 0

where 2E* w is the viscous work, with what the elements that let go are going to lose (by parts).

1. Time is eliminated: a step runs in the depth, y or ℓ, with the velocity as its unknown, or in the
   velocity, with the depth as its unknown, where the body is about to turn round or has just done so. So
   every step ends at a depth or velocity known beforehand: no event is searched for.
2. Both stages are cut into legs at the depths where the motion is not smooth: where yield begins, and where
   either end of the live interval passes a kink of the shape.
3. Depth is measured by δ, with (b + δ)³ the distance from where a(s) begins as a fractional power: in δ it
   is smooth enough. It counts from the lower end of the leg, so that no distance is a difference.
4. The unknown is a polynomial through 24 Gauss nodes of a step (collocation), found by Newton's method;
   time and work are integrals over the step.
5. The last Legendre coefficients of the integrands set the length of the next step, or of this one anew.
6. The force is largest on loading: it is looked for next to the node where it is largest.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from .. import _numeric
from .._numeric import cube_rise, cube_way
from ..shapes.profile import Profile
from ..superposition import radius_integral, tabulated
from ..yielding import LiveInterval
from .energy_balance import loading_interval

#: What the last coefficients may leave of velocity, depth and time; the ends of steps are far better.
TOLERANCE = 1e-5
_MOST_STEPS = 3000
_NODES, _WEIGHTS = _numeric.gauss_legendre(24)


@dataclass(frozen=True)
class Bodies:
    """Impacts to solve, one a row of each array of shape (N, 1); `profile` is one indenter, or as many.

    Relaxation time τ (s), inertia μ (m s²), speed v₀ (m/s), critical depth d_c (m), plastic depth p₀ (m) of
    the imprint that is met, penetration y (m) that would be reached without viscosity; `lower` is the
    plastic depth p (m) on unloading, None on loading.
    """

    profile: Profile
    tau: np.ndarray
    inertia: np.ndarray
    speed: np.ndarray
    critical_depth: np.ndarray
    before: np.ndarray
    dry: np.ndarray
    lower: np.ndarray | None = None

    @classmethod
    def of(cls, profile, medium, mass, speed, before, dry):
        """One a row; `dry` are penetrations (m) without viscosity, infinite where the shape ends before."""
        shape, inertia = np.shape(speed), mass / (2 * medium.E_star)
        arrays = medium.relaxation_time, inertia, speed, medium.critical_depth, before, dry
        columns = [np.broadcast_to(part, shape).reshape(-1, 1) for part in arrays]
        profile = profile.flat_entries(slice(None), shape).entries((slice(None), None), (columns[0].size,))
        columns[-1] = np.minimum(columns[-1], profile.known_depth - columns[-2])
        # A little deeper than it comes, for the end of what is interpolated is not to be where it turns.
        return cls(tabulated(profile, columns[-2] + 1.1 * columns[-1]), *columns)

    def rows(self, index):
        """Some of the impacts, by their numbers."""
        if index.size == self.speed.size:
            return self
        profile, *arrays = (getattr(self, field.name) for field in fields(self))
        profile = profile.entries(index, self.speed.shape) if profile.shape else profile
        return Bodies(profile, *(part if part is None else part[index] for part in arrays))

    def loads(self, depth):
        """Φ, a and dΦ/dq at depths q: y, or ℓ on unloading."""
        depth = np.maximum(depth, 0.0)
        if self.lower is None:
            interval, increase = loading_interval(depth, self.critical_depth, self.before)
        else:
            interval, increase = LiveInterval(self.lower + 0 * depth, self.lower + depth, depth), 0.0
        a = self.profile._radius(interval.upper)
        ring = (
            np.where(increase > 0, a - self.profile._radius(interval.lower), a) if np.any(increase) else a
        )
        return radius_integral(self.profile, interval), a, ring

    def rates(self, load, a, velocity):
        """Rates of depth, velocity and viscous work at loads Φ, contact radii and velocities."""
        if self.lower is None:
            drag = self.tau * a * velocity
            return velocity, -(load + drag) / self.inertia, drag * velocity
        rate = velocity - self.tau * load / self.inertia
        return rate, -load / self.inertia, self.tau * a * velocity * rate


@dataclass(frozen=True)
class Steps:
    """Steps of some impacts, one a row: all in the depth (`deep`), or all in the velocity.

    `start` is depth (m), velocity (m/s), time (s) and viscous work over 2E* (m³) at the beginning, of shape
    (4, N, 1). Depth is measured by `place`, as `base` + (begin + place)³ − begin³, velocity by itself.
    `slopes` (3, N, nodes) are derivatives by that at the nodes: of the other of both, of time and work.
    """

    bodies: Bodies
    deep: bool
    start: np.ndarray
    base: np.ndarray
    begin: np.ndarray
    place: np.ndarray
    length: np.ndarray
    slopes: np.ndarray | None = None

    def rows(self, index):
        """Some of the steps, by their numbers."""
        parts = {name: getattr(self, name)[index] for name in ("base", "begin", "place", "length")}
        start, slopes = self.start[:, index], self.slopes[:, index]
        return replace(self, bodies=self.bodies.rows(index), start=start, slopes=slopes, **parts)

    def at(self, theta):
        """The states (4, N, K) at shares θ of the steps, of shape (N, K)."""
        matrix = _numeric.gauss_integrals(_NODES.size, theta.ravel()).reshape(*theta.shape, -1)
        return self._state(theta, np.einsum("nkj,snj->snk", matrix, self.slopes))

    def share(self, own):
        """Shares θ (N, K) of the steps at depths (m), for steps in the depth, or at velocities."""
        place = cube_way(self.begin, np.maximum(own - self.base, 0.0)) if self.deep else own
        return np.clip((place - self.place) / self.length, 0.0, 1.0)

    def end(self):
        """The states (4, N, 1) at the ends of the steps: more exact than those between the nodes."""
        return self._state(np.ones((1, 1)), (self.slopes @ _WEIGHTS)[..., None])

    def _state(self, theta, integrals):
        other, time, work = self.length * integrals
        own = self.place + self.length * theta
        if self.deep:
            depth, velocity = self.base + cube_rise(self.begin, own), self.start[1] + other
        else:
            depth, velocity = self.start[0] + other, own
        return np.stack([depth, velocity, self.start[2] + time, self.start[3] + work])

    def solved(self):
        """The steps with their slopes, and an estimate of the error of each; infinite if not found."""
        own, first = self.place + self.length * _NODES, self.start[int(self.deep)]
        derivatives = self._by_depth(own) if self.deep else self._by_velocity(own)
        unknown, settled = _numeric.collocate(lambda u: derivatives(u)[::3], first, self.length)
        done = replace(self, slopes=np.stack(derivatives(unknown)[:3]))
        # Of velocities, and of work, a part of what they were at first is next to nothing.
        size = np.abs(done.end()[..., 0])
        size[1] += np.abs(self.start[1, :, 0]) / 10
        size[3] += 1e-3 * (self.bodies.inertia * self.bodies.speed**2)[:, 0]
        rest = _numeric.last_coefficient(done.slopes) * np.abs(self.length[:, 0])
        error = np.max(rest / size[[int(self.deep), 2, 3]], axis=0)
        return done, np.where(settled & (error < np.inf), error, np.inf)

    def _by_depth(self, place):
        """Of the velocity: derivatives of velocity, time and work by δ, and that of the first by it."""
        load, a, _ = self.bodies.loads(self.base + cube_rise(self.begin, place))
        drag = self.bodies.tau * a / self.bodies.inertia if self.bodies.lower is None else 0.0

        def derivatives(velocity):
            rate, acceleration, work = self.bodies.rates(load, a, velocity)
            pace = 3 * (self.begin + place) ** 2 / rate
            return acceleration * pace, pace, work * pace, -(drag + acceleration / rate) * pace

        return derivatives

    def _by_velocity(self, velocity):
        """Of the depth: derivatives of depth, time, work by the velocity, and that of the first by it."""

        def derivatives(depth):
            load, a, stiffness = self.bodies.loads(depth)
            rate, acceleration, work = self.bodies.rates(load, a, velocity)
            increase = stiffness * velocity
            if self.bodies.lower is None:
                # The drag grows as the contact does, by 1/g′.
                increase += self.bodies.tau * velocity**2 / self.bodies.profile._reduced_slope(a)
            own = increase / self.bodies.inertia / acceleration**2
            return rate / acceleration, 1 / acceleration, work / acceleration, own

        return derivatives

    def decelerations(self):
        """Decelerations (m/s²) at the nodes."""
        return -self.slopes[0] / self.slopes[1] if self.deep else -1 / self.slopes[1]

    def largest_deceleration(self):
        """The largest deceleration (m/s²) within each step, next to the node where it is largest."""

        def deceleration(theta):
            depth, velocity, *_ = self.at(theta)
            return -self.bodies.rates(*self.bodies.loads(depth)[:2], velocity)[1]

        best, edges = self.decelerations().argmax(axis=1), np.array([0.0, *_NODES, 1.0])
        return _numeric.largest_value(deceleration, edges[best, None], edges[best + 2, None])


@dataclass(frozen=True)
class Course:
    """How impacts end: arrays of one entry for each, and the steps with the impacts that they belong to.

    Deepest penetration y (m), infinite beyond the known shape; velocity (m/s) and time (s) at the loss of
    contact, viscous work over 2E* (m³), largest deceleration (m/s²).
    """

    deepest: np.ndarray
    velocity: np.ndarray
    time: np.ndarray
    work: np.ndarray
    peak: np.ndarray
    loading: list
    unloading: list


def solve(bodies, tolerance=TOLERANCE):
    """The `Course` of some impacts, from first contact to its loss; refused if one does not converge."""
    # Trials of steps may leave double precision; they are then made again, shorter.
    with np.errstate(all="ignore"):
        turned, loading = _load(bodies, tolerance)
        peak = _largest_deceleration(bodies.speed.size, loading)
        state, unloading = _unload(bodies, turned, tolerance)
    return Course(turned[0, :, 0], *state[1:, :, 0], peak, loading, unloading)


def _load(bodies, tolerance):
    """State at the turning point, and the steps there."""
    count, steps = bodies.speed.size, []
    state = bodies.speed * np.array([0.0, 1.0, 0.0, 0.0])[:, None, None]
    below = bodies.before - bodies.profile._kink_above(bodies.before)
    kinks = [kink - bodies.before for kink in bodies.profile.kinks]
    edges = np.array([bodies.critical_depth, *kinks, *(kink + bodies.critical_depth for kink in kinks)])
    end = np.broadcast_to(bodies.profile.known_depth - bodies.before, (count, 1))
    edges = np.sort(np.where((edges > 0) & (edges < end), edges, end), axis=0)
    base, rows = np.zeros((count, 1)), np.arange(count)
    for edge in [*edges, end]:
        # Behind a kink the radius begins as a power of the distance from it; else as one from the tip.
        begin = np.cbrt(np.where((base == 0) | (base == bodies.critical_depth), below, 0.0))
        leg = _Leg(bodies.rows(rows), base[rows], begin[rows], edge[rows], tolerance)
        first = np.minimum(cube_way(begin[rows], 0.65 * bodies.dry[rows]), leg.end)
        state[:, rows], turned = leg.run(state[:, rows], first, rows, steps)
        rows, base = rows[~turned], edge
    state[0, rows] = np.inf
    return state, steps


def _unload(bodies, state, tolerance):
    """State at the loss of contact, and the steps there."""
    steps, count = [], bodies.speed.size
    interval, _ = loading_interval(state[0], bodies.critical_depth, bodies.before)
    bodies = replace(bodies, lower=interval.lower)
    state = np.stack([interval.length, np.zeros((count, 1)), state[2], state[3]])
    below = interval.lower - bodies.profile._kink_above(interval.lower)
    for edge in [*(kink - interval.lower for kink in bodies.profile.kinks[::-1]), np.zeros((count, 1))]:
        rows = np.flatnonzero(((edge >= 0) & (edge < state[0]) & (interval.upper < np.inf))[:, 0])
        begin = np.cbrt(np.where(edge == 0, below, 0.0))
        leg = _Leg(bodies.rows(rows), edge[rows], begin[rows], edge[rows], tolerance)
        state[:, rows], _ = leg.run(state[:, rows], np.full((rows.size, 1), np.inf), rows, steps)
    return state, steps


def _largest_deceleration(count, steps):
    """The largest deceleration (m/s²) of each of some impacts, from steps of any length."""
    largest = np.zeros(count)
    for rows, step in steps:
        np.fmax.at(largest, rows, step.decelerations().max(axis=1))
    # Steps next to the largest value at a node may have a larger one in between.
    for rows, step in steps:
        near = np.flatnonzero(step.decelerations().max(axis=1) >= 0.98 * largest[rows])
        if near.size:
            np.maximum.at(largest, rows[near], step.rows(near).largest_deceleration())
    return largest


class _Leg:
    """Legs of some impacts: from `base` (m) down to `edge` on loading, back to `base` on unloading."""

    def __init__(self, bodies, base, begin, edge, tolerance):
        self.bodies, self.base, self.begin, self.edge, self.tolerance = bodies, base, begin, edge, tolerance
        self.loading = bodies.lower is None
        self.end = cube_way(begin, edge - base) if self.loading else np.zeros_like(base)

    def run(self, state, length, numbers, steps):
        """State at the end, and which bodies have turned round; notes the steps, from a `length` on."""
        count, self.state, self.length = self.base.size, state.copy(), length.copy()
        self.place = cube_way(self.begin, state[0] - self.base)
        rows, (deep, self.forced, turned) = np.arange(count), np.zeros((3, count), bool)
        deep[:] = self.loading
        for _ in range(_MOST_STEPS):
            if not rows.size:
                return self.state, turned
            wanted, room, most = self._plan(rows)
            planned = np.minimum(self.length[rows], most)
            self.length[rows] = np.where((wanted == deep[rows])[:, None], planned, most)
            deep[rows], done = wanted, np.zeros(rows.size, bool)
            for kind in (True, False):
                some = np.flatnonzero(wanted == kind)
                if some.size:
                    good, step, done[some] = self._step(kind, rows[some], room[some])
                    if good.size:
                        steps.append((numbers[rows[some][good]], step.rows(good)))
            turned[rows[done & ~wanted]] = True
            rows = rows[~done]
        raise ValueError(f"no convergence in {_MOST_STEPS} steps of a motion; check mass, speed, viscosity")

    def _plan(self, rows):
        """Which bodies move on in the depth; in the coordinate, how far the end is, and how far to try."""
        bodies, forced = self.bodies.rows(rows), self.forced[rows, None]
        depth, velocity = self.state[:2, rows]
        rate, acceleration, _ = bodies.rates(*bodies.loads(depth)[:2], velocity)
        # In the depth while it changes more, relative to itself, than the velocity.
        deep, place = forced | (np.abs(rate * velocity) > np.abs(acceleration * depth)), self.place[rows]
        if self.loading:
            deep |= place == 0
            # A part of the way on which the present force would stop the body.
            beyond = depth - self.base[rows] + velocity**2 / (3 * np.abs(acceleration))
            room = np.where(deep, self.end[rows] - place, velocity)
            most = np.where(deep & ~forced, cube_way(self.begin[rows], beyond) - place, room)
        else:
            # A part of what springs, or dashpots alone, would give back.
            gain = 0.4 / (1 / np.sqrt(np.abs(depth * acceleration)) + bodies.tau / depth)
            room, most = np.where(deep, place, np.inf), np.where(deep, place, gain)
        return deep[:, 0], room, most

    def _step(self, deep, rows, room):
        """Steps of some bodies: which are good, and are taken; all of them; and which are the last."""
        last = (room <= 1.001 * self.length[rows])[:, 0]
        way = np.where(last[:, None], room, self.length[rows]) * (1 if deep and self.loading else -1)
        begin, base, state = self.begin[rows], self.base[rows], self.state[:, rows]
        place = self.place[rows] if deep else state[1]
        step, error = Steps(self.bodies.rows(rows), deep, state, base, begin, place, way).solved()
        after = step.end()
        beyond = (after[0] > self.edge[rows] * (1 + 1e-12)) if self.loading else (after[0] < base)
        beyond = beyond[:, 0] & (not deep)
        if deep and self.loading:
            error = np.where(after[1, :, 0] > 0, error, np.inf)
        good = (error <= self.tolerance) & ~beyond
        # Beyond the end of a leg only the depth leads there; but from rest the depth is no coordinate.
        self.forced[rows[beyond & (error < 1e-3) & (state[1, :, 0] != 0)]] = True
        factor = np.where(beyond, 0.3, np.clip(0.9 * (self.tolerance / error) ** (1 / 30), 0.3, 3.0))
        if deep != self.loading:
            # What runs towards zero goes on in proportion.
            factor = np.where(good, factor * (1 - np.abs(way) / room)[:, 0], np.where(last, 0.85, factor))
        self.length[rows] = np.abs(way) * factor[:, None]
        there, arrived = rows[good], good & last
        self.state[:, there] = after[:, good]
        self.place[there] = (place + way if deep else cube_way(begin, after[0] - base))[good]
        if deep:
            self.state[0, rows[arrived]] = (self.edge if self.loading else self.base)[rows[arrived]]
        return np.flatnonzero(good), step, arrived
