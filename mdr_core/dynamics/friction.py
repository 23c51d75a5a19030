"""Friction along the surface under a given normal motion: stick and slip, element by element.

Beside every element of the foundation stands one along the surface, κ = 2(1 − ν)/(2 − ν) as stiff
(Mindlin). Per κE* its load is Q = s + τṡ, and the normal one allows B = (μ/κ)(ℓ − (g − p)₊), with ℓ the
live depth, p the plastic one:

    stick    ṡ = W      |Q| ≤ B             slip    Q = ±B, s follows         released    Q = 0, s relaxes
    the body            m_t Ẇ = −2κE* ∫Q dx

1. Levels of depth are the edges of the elements, and times are those at which the contact's edge passes
   them, on loading and on unloading: an element is covered, and let go, within one step.
2. An element stands for its mean depth ḡ = ∫g dx/Δx, so that the normal force is exact at every level, and
   is covered for a share of its first step.
3. Over a step Q goes straight; then s is exact, and of second order for any ratio of τ to the step. The
   momentum balance is linear between changes of stick and slip: Newton's method in a bracket ends there.
4. The mean load times the way is work, and the mean load times the slip is friction: the ledger closes
   whatever the step.
5. The next run has twice the levels; quantities go to their limits with the square of the step.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..superposition import radius_integral
from ..yielding import LiveInterval

#: Speed of the bound over that of the body at which all that is in contact holds.
_HOLDS = 1e10


def grip(hit, speed, friction):
    """(μ/κ)/W₀ (s/m) of a body that comes with a tangential speed: what B is of a load, for speed 1.

    More than `_HOLDS` allows changes nothing. Without speed it is the limit of a slow one, that much.
    """
    most = _HOLDS / float(hit.speed)
    return min(friction / float(hit.medium.tangential_ratio) / abs(speed), most) if speed else most


class Row(NamedTuple):
    """Elements between levels, the flat face first: outer edges, widths, mean depths (m).

    `late` is the share of the first step that has gone when an element is met.
    """

    edge: np.ndarray
    width: np.ndarray
    mean: np.ndarray
    late: np.ndarray

    @classmethod
    def of(cls, profile, depth):
        edge = np.maximum.accumulate(profile._radius(depth))
        width, rise = np.diff(edge), np.diff(depth)
        area = radius_integral(profile, LiveInterval(depth[:-1], depth[1:], rise))
        with np.errstate(divide="ignore", invalid="ignore"):
            late = np.where(width > 0, (edge[1:] - area / rise) / width, 0.5).clip(0.0, 1.0)
        mean = np.append(0.0, depth[:-1] + late * rise)
        # At a wall there are no more elements.
        count = 1 + int(np.max(np.flatnonzero(width), initial=-1) + 1)
        parts = edge, np.append(edge[0], width), mean, np.append(0.0, late)
        return cls(*(part[:count] for part in parts))


def _partly_yielded(profile, row, levels, lower):
    """Of the element in which the plastic zone ends, at each level: its number, its mean (g − p)₊ (m)."""
    number = np.searchsorted(levels.depth, lower, side="right")
    top = np.maximum(levels.depth[np.minimum(number, levels.depth.size - 1)], lower)
    area = radius_integral(profile, LiveInterval(lower, top, top - lower))
    number = np.minimum(number, row.mean.size - 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (profile._radius(top) * (top - lower) - area) / row.width[number]
    return number, np.where(np.isfinite(mean), np.maximum(mean, 0.0), 0.0)


@dataclass(frozen=True)
class Run:
    """One run, in units of the first tangential speed: records at every instant, elements at some.

    Time (s), tangential velocity; force over 2κE* (m s); stored, viscous and friction energy over 2κE*
    (m s²); numbers of the `instants` asked for, and what is `seen` then: loads Q (s) of elements, and
    whether they stick.
    """

    row: Row
    time: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    stored: np.ndarray
    viscous: np.ndarray
    friction: np.ndarray
    instants: list
    seen: dict

    @property
    def quantities(self):
        """Change of the velocity, largest force, friction and viscous work, with what still relaxes."""
        largest = _largest(self.time, np.abs(self.force))
        work = self.friction[-1], self.viscous[-1] + self.stored[-1]
        return np.array([self.velocity[-1] - 1.0, largest, *work])


def _largest(time, values):
    """Largest value, by the parabola through three instants."""
    i = int(np.argmax(values))
    if not 1 < i < values.size - 2 or np.any(np.diff(time[i - 2 : i + 3]) <= 0):
        return values[i]
    slope = np.diff(values[i - 2 : i + 3]) / np.diff(time[i - 2 : i + 3])
    bend = np.diff(slope) / (time[i : i + 3] - time[i - 2 : i + 1]) * [1, 1, 1]
    early, late = time[i] - time[i - 1], time[i + 1] - time[i]
    top = (slope[1] * late + slope[2] * early) / (early + late)
    # At a kink the largest value stands by itself.
    kink = abs(bend[1]) > 3 * max(abs(bend[0]), abs(bend[2]))
    return values[i] if kink or bend[1] >= 0 else values[i] - top**2 / (4 * bend[1])


def slide(hit, levels, inertia, hold, instants=()):
    """One `Run` of a body that comes with tangential speed 1, C = `inertia`, and B = `hold` × load."""
    tau, d_c, row = (
        float(hit.medium.relaxation_time),
        hit.medium.critical_depth,
        Row.of(hit.profile, levels.depth),
    )
    lower = np.maximum(levels.depth - d_c, 0.0)
    interval = np.minimum(levels.depth, d_c) + tau * levels.velocity
    number, part = _partly_yielded(hit.profile, row, levels, lower)
    state = _State(row, inertia, tau, np.append(levels.loading_time, levels.unloading_time[1:]), instants)
    total = row.mean.size
    for i in range(levels.depth.size):
        count, old = min(i + 1, total), min(i, total)
        rise = np.maximum(row.mean[:count] - lower[i], 0.0)
        if lower[i] > 0 and number[i] < count:
            rise[number[i]] = part[i]
        # What is met at a speed begins with the load of its dashpot.
        state.meet(old, count, hold * tau * levels.velocity[max(i - 1, 0)])
        state.step(i, np.maximum(hold * (interval[i] - rise), 0.0), slice(old, count))
    rise = np.maximum(row.mean - hit.plastic_depth, 0.0)
    for k in range(1, levels.live_depth.size):
        count = min(levels.depth.size - k, total)
        bound = np.zeros(state.count)
        bound[:count] = np.maximum(hold * (levels.live_depth[k] - rise[:count]), 0.0)
        state.step(levels.depth.size - 1 + k, bound, slice(count, state.count))
        state.let_go(count)
    return state.run()


def changes(hit, run, hold):
    """Instants (s) at which all elements that slip begin to stick, as they do together.

    Slip ends where the surface is no faster than the bound grows, W = ±(μ/κ) v, or W = 0 where it yields.
    """
    time, velocity = run.time, hit._course.at(run.time).velocity
    found = []
    for excess in (run.velocity - hold * velocity, run.velocity + hold * velocity, run.velocity):
        i = np.flatnonzero(excess[:-1] * excess[1:] < 0)
        found.append(time[i] + (time[i + 1] - time[i]) * excess[i] / (excess[i] - excess[i + 1]))
    return np.concatenate(found)


class _State:
    """The row on its way: load Q and displacement s of each element in contact, and what is recorded."""

    def __init__(self, row, inertia, tau, time, instants):
        self.row, self.inertia, self.tau, self.time = row, inertia, tau, time
        self.load, self.s, self.bound = np.zeros((3, row.mean.size))
        self.count, self.velocity, self.rate, self.stored, self.free = 0, 1.0, 0.0, 0.0, 0.0
        # Velocity, force, stored, viscous and friction work.
        self.record = np.zeros((5, time.size))
        middle = (time[1:] + time[:-1]) / 2
        self.wanted, self.seen = np.searchsorted(middle, instants).tolist(), {}

    def meet(self, old, count, bound):
        """Elements are met, at a speed at which they bear no more than some bound."""
        self.count = count
        self.load[old:count] = np.clip(self.tau * self.velocity, -bound, bound)
        self.bound[old:count] = bound

    def step(self, i, bound, part):
        """To the instant i, at which elements bear no more than `bound`.

        A `part` of them is met within the step, or let go.
        """
        h = self.time[i] - self.time[i - 1] if i else 0.0
        n, width = self.count, self.row.width[: self.count]
        before, s = self.load[:n], self.s[:n]
        dt = np.full(n, h)
        dt[part] *= 1 - self.row.late[part]
        velocity, trial, slips, mean = self._balance(h, dt, width, before, s, bound)
        load = np.minimum(np.maximum(trial, -bound), bound)
        way, self.rate = dt * ((self.velocity + velocity) / 2), (velocity - self.velocity) / h if h else 0.0
        work, after, kept = (width * mean) @ way, load, 1.0
        if self.tau:
            after, slipped = self._relaxed(dt, s, way, slips, before, trial, load, velocity - self.velocity)
            kept = np.exp(-2 * h / self.tau)
        gain = width @ (after**2 - s**2) / 2
        friction = width @ slipped if self.tau else work - gain
        lost = work - friction - gain + (1 - kept) * self.free
        self.free *= kept
        self.velocity, self.load[:n], self.s[:n], self.bound[:n] = velocity, load, after, bound
        self.stored += gain
        self.record[:3, i] = velocity, width @ load, self.stored + self.free
        self.record[3:, i] = self.record[3:, i - 1] + (lost, friction) if i else 0.0
        if i in self.wanted:
            self.seen[i] = load, slips == 0

    def _balance(self, h, dt, width, before, s, bound):
        """Velocity at the end of a step, loads if all stuck, shares of the step that slip, mean loads.

        Load and bound go straight until they meet: a stuck element with some `room` to its bound, which
        stick would leave `beyond` it, slips for the rest. W₁ − W + C ∫∫Q dx dt = 0 grows with W₁.
        """
        weight, reach = self.inertia * width * dt / 2, dt / 2 + self.tau
        base, given = s + dt * (self.velocity / 2), weight @ before - self.velocity
        stiff, w, low, high = weight * reach, self.velocity + h * self.rate, -np.inf, np.inf
        # Without room at all the whole step slips, if it does.
        allowed = self.bound[: bound.size] * (1 + 1e-15) + 1e-290
        for _ in range(100):
            trial = base + reach * w
            sign = np.copysign(1.0, trial)
            beyond, room = np.maximum(np.abs(trial) - bound, 0.0), allowed - sign * before
            slips = beyond / (room + beyond)
            later = trial - sign * beyond * slips
            excess = w + given + weight @ later
            low, high = (low, w) if excess > 0 else (w, high)
            new = w - excess / (1 + stiff @ (1 - slips) ** 2)
            if abs(new - w) <= 1e-12:
                break
            w = new if low < new < high or high - low == np.inf else (low + high) / 2
        return w, trial, slips, (before + later) / 2

    def _relaxed(self, dt, s, way, slips, before, trial, load, gained):
        """s after a step, and friction work: it sticks, then τṡ + s = Q with a load that goes straight."""
        stuck = 1 - slips
        met, begin, dt = s + stuck * way, before + stuck * (trial - before), np.maximum(slips * dt, 1e-300)
        z, rise, mean = dt / self.tau, load - begin, (load + begin) / 2
        fade = -np.expm1(-z)
        # 1 − (1 − e^(−z))/z, without cancellation.
        late = np.where(z > 1e-3, 1 - fade / z, z / 2 - z * z / 6)
        after = met + fade * (begin - met) + late * rise
        # ∫Qṡ dt by parts, for ∫s dt is known; the surface's speed goes straight, too.
        moved = load * after - begin * met - rise * (mean - (after - met) / z)
        slipped = mean * slips * way + rise * slips * gained * dt / 12 - moved
        return after, slipped

    def let_go(self, count):
        """Elements from a number on are let go; what they store relaxes."""
        left = slice(count, self.count)
        energy = self.row.width[left] @ self.s[left] ** 2 / 2
        self.stored, self.free, self.count = self.stored - energy, self.free + energy, count

    def run(self):
        return Run(self.row, self.time, *self.record, self.wanted, self.seen)
