"""Friction along the surface of a viscous medium, for one impact at a time: section 13 of the theory.

Quantities along the surface are divided by the initial tangential speed. An element with the displacement s
has the load Q = s + τṡ, and |Q| ≤ B, where B is μ/κ times its normal load. It sticks with ṡ = W, the
velocity of the point of contact, or slips with |Q| = B. After its release it relaxes with Q = 0. With
C = 2κE*/m_t the velocity follows Ẇ = −C ∫Q dx.

1. Levels of depth are the edges of elements. A step is between two instants at which the edge of the
   contact passes a level: it covers or releases one element.
2. The depth of an element is the mean ∫g dx/Δx, so that the normal force is exact at every level.
3. Over a step, load and bound are linear in time until they meet, so that s is exact. The balance of
   momentum is solved for the velocity at the end.
4. Work is the mean load times the displacement, friction work the mean load times the slip. The sum of the
   energies is constant for any step.

Errors are of second order in the step.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..contact.yielding import yield_rule
from ..impacts.motion import dense_motion
from ..numerics.roots import largest_value

#: Value of κv_t0/μ over the normal speed below which everything sticks.
SLOWEST = 1e-7
#: Largest number of levels of a run.
MOST_LEVELS = 6000


@dataclass(frozen=True)
class Levels:
    """Levels: depths (m), times (s), velocities (m/s) on loading; live depths and times on unloading."""

    depth: np.ndarray
    loading_time: np.ndarray
    velocity: np.ndarray
    live_depth: np.ndarray
    unloading_time: np.ndarray


def levels(hit, inertia, halvings, instants=()):
    """Return the `Levels` of a run along the surface under one normal `Impact`.

    `inertia` is C = 2κE*/m_t (1/(m s²)). Steps of loading are halved in time. Depths at `instants` (s) are
    also levels.
    """
    dense, max_depth, lower = dense_motion(hit), hit.max_depth, hit.plastic_depth
    loading, unloading, turn = dense.loading, dense.unloading, dense.turning_time
    instants = np.asarray(instants, dtype=float)
    early = np.append(_even_times(hit, loading, 0.0, inertia), instants[instants < turn])
    late = np.append(_even_times(hit, unloading, lower, inertia), instants[instants > turn])
    onset = min(yield_rule(hit.profile, hit.medium).onset(), max_depth)
    inner = np.append(lower + unloading.at(late).depth, [lower, onset])
    inner = inner[(inner > 0) & (inner < max_depth)]
    depth = np.concatenate([[0.0, max_depth], loading.at(early).depth, inner])
    coarse, first = np.unique(np.clip(depth, 0.0, max_depth), return_index=True)
    time = np.concatenate([[0.0, turn], early, loading.when(inner)])[first]
    time = np.maximum.accumulate(np.minimum(time, turn))
    # Equal parts of each step of loading.
    count = 2**halvings
    time = np.append(time[:-1, None] + np.diff(time)[:, None] * (np.arange(count) / count), time[-1])
    state = loading.at(time)
    depth = np.clip(state.depth[:-1], np.repeat(coarse[:-1], count), np.repeat(coarse[1:], count))
    depth[::count] = coarse[:-1]
    depth = np.append(depth, coarse[-1])
    live_depth = np.append(depth[depth > lower][::-1] - lower, 0.0)
    unloading_time = np.maximum.accumulate(np.append(turn, unloading.when(live_depth[1:])))
    return Levels(depth, time, np.maximum(state.velocity, 0.0), live_depth, unloading_time)


def _even_times(hit, branch, lower, inertia):
    """Return times (s) at equal shares of all change on a branch; its depths count from `lower` (m)."""
    state = branch.nodes(25)
    radius = hit.profile.radius_at(np.clip(lower + state.depth, 0.0, hit.max_depth))
    # Stick relaxes on springs and dashpots at these rates (1/s).
    stick = np.sqrt(inertia * radius) + inertia * hit.medium.relaxation_time * radius
    rates = 1 / np.ptp(state.time) + stick
    share = np.diff(state.time) * (rates[1:] + rates[:-1]) / 2
    sizes = np.ptp(state.depth), radius.max(), np.ptp(state.velocity)
    for values, size in zip((state.depth, radius, state.velocity), sizes, strict=True):
        share += np.abs(np.diff(values)) / size
    share = np.append(0.0, np.cumsum(share))
    count = int(np.ceil(min(4 * share[-1], MOST_LEVELS / 16)))
    return np.interp(np.linspace(0, share[-1], count + 1)[1:-1], share, state.time)


def bound_ratio(hit, speed, friction):
    """Return (μ/κ)/v_t0 (s/m) at a tangential speed: the ratio of B to the normal load, for a speed of 1.

    For a tangential speed of 0 it is the largest ratio, at which everything sticks.
    """
    largest = 1 / (SLOWEST * float(hit.speed))
    return min(friction / float(hit.medium.tangential_ratio) / abs(speed), largest) if speed else largest


class SurfaceElements(NamedTuple):
    """Elements between levels: outer edges, widths, mean depths (m), delays (shares of the first step)."""

    edge: np.ndarray
    width: np.ndarray
    mean_depth: np.ndarray
    delay: np.ndarray

    @classmethod
    def of(cls, profile, depth):
        """Make elements with their edges at the contact radii of levels of depth (m)."""
        edge = np.maximum.accumulate(profile.radius_at(depth))
        width, rise = np.diff(edge), np.diff(depth)
        area = integrals(profile).radius_integral(LiveInterval(depth[:-1], depth[1:], rise))
        with np.errstate(divide="ignore", invalid="ignore"):
            delay = np.where(width > 0, (edge[1:] - area / rise) / width, 0.5).clip(0.0, 1.0)
        mean_depth = np.append(0.0, depth[:-1] + delay * rise)
        # There are no elements outside a wall.
        count = 1 + int(np.max(np.flatnonzero(width), initial=-1) + 1)
        width, delay = np.append(edge[0], width), np.append(0.0, delay)
        return cls(edge[:count], width[:count], mean_depth[:count], delay[:count])


def _partly_yielded(profile, elements, levels, plastic_depth):
    """Return the element in which the plastic zone ends, at each level: its number, its mean (g − p)₊."""
    number = np.searchsorted(levels.depth, plastic_depth, side="right")
    top = np.maximum(levels.depth[np.minimum(number, levels.depth.size - 1)], plastic_depth)
    area = integrals(profile).radius_integral(LiveInterval(plastic_depth, top, top - plastic_depth))
    number = np.minimum(number, elements.width.size - 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (profile.radius_at(top) * (top - plastic_depth) - area) / elements.width[number]
    return number, np.where(np.isfinite(mean), np.maximum(mean, 0.0), 0.0)


class RunQuantities(NamedTuple):
    """Results of a run in its units: change of the velocity, largest force, friction and viscous work."""

    change: float
    force: float
    friction: float
    viscous: float


def largest_force(time, force):
    """Return the largest |force| of each column with one row per instant, also at a kink (onset of slip).

    Between two instants the force is the smaller of two parabolas, each through three instants on one side.
    """
    force = np.abs(force)
    at, largest = np.argmax(force, axis=0), np.max(force, axis=0)
    for first in (at - 1, at):
        near = np.clip(first + np.arange(-2, 4)[:, None], 0, len(time) - 1)
        t, f = (np.take_along_axis(values, near, axis=0)[..., None] for values in (time, force))
        steps = np.diff(t[..., 0], axis=0)

        def between(place, t=t, f=f):
            return np.minimum(_parabola(t[:3], f[:3], place), _parabola(t[3:], f[3:], place))

        with np.errstate(divide="ignore", invalid="ignore"):
            # At a kink the last parabola exceeds the force by an eighth of the force's gain in its step.
            top = largest_value(between, t[2], t[3], grids=5)
        # Parabolas through uneven steps are not meaningful.
        even = steps.min(axis=0) > 0.1 * steps.max(axis=0)
        largest = np.where(even, np.maximum(largest, top), largest)
    return largest


def _parabola(t, f, place):
    """Return values at places of parabolas through three points each."""
    slope, last_slope = np.diff(f, axis=0) / np.diff(t, axis=0)
    bend = (last_slope - slope) / (t[2] - t[0])
    return f[0] + (place - t[0]) * (slope + (place - t[1]) * bend)


def slide(hit, levels, inertia, ratio, instants=()):
    """Return the `FrictionRun` of a body of speed 1.

    C is `inertia` (1/(m s²)), and B is `ratio` times the normal load.
    """
    tau = float(hit.medium.relaxation_time)
    interval, _ = yield_rule(hit.profile, hit.medium).loading(levels.depth)
    elements = SurfaceElements.of(hit.profile, levels.depth)
    plastic_depth = interval.lower
    load = interval.length + tau * levels.velocity
    number, partial = _partly_yielded(hit.profile, elements, levels, plastic_depth)
    time = np.append(levels.loading_time, levels.unloading_time[1:])
    run = FrictionRun(elements, inertia, tau, time, instants)
    total = elements.width.size
    for i in range(levels.depth.size):
        count, old = min(i + 1, total), min(i, total)
        rise = np.maximum(elements.mean_depth[:count] - plastic_depth[i], 0.0)
        if plastic_depth[i] > 0 and number[i] < count:
            rise[number[i]] = partial[i]
        # An element covered at a finite speed begins with the load of its dashpot.
        run.cover(old, count, ratio * tau * levels.velocity[max(i - 1, 0)])
        run.step(i, np.maximum(ratio * (load[i] - rise), 0.0), slice(old, count))
    rise = np.maximum(elements.mean_depth - hit.plastic_depth, 0.0)
    for k in range(1, levels.live_depth.size):
        count = min(levels.depth.size - k, total)
        bound = np.zeros(run.count)
        bound[:count] = np.maximum(ratio * (levels.live_depth[k] - rise[:count]), 0.0)
        run.step(levels.depth.size - 1 + k, bound, slice(count, run.count))
        run.release(count)
    return run


class FrictionRun:
    """One run in units of the initial tangential speed: the elements during it, and its records.

    Each element in contact has a load Q and a displacement s (s). Records at every time (s) are velocity,
    force over 2κE* (m s), and stored, viscous and friction energy over 2κE* (m s²). `element_states` are
    loads of elements, and whether they stick, by the numbers of the requested `instants`.
    """

    def __init__(self, elements, inertia, tau, time, instants):
        self.elements, self.inertia, self.tau, self.time = elements, inertia, tau, time
        self.load, self.s, self.bound = np.zeros((3, elements.width.size))
        self.count, self.velocity, self.rate, self.stored, self.released = 0, 1.0, 0.0, 0.0, 0.0
        self.velocities, self.forces, self.energies, self.viscous, self.friction = np.zeros((5, time.size))
        middle = (time[1:] + time[:-1]) / 2
        self.instants, self.element_states = np.searchsorted(middle, instants).tolist(), {}

    @property
    def quantities(self):
        """The `RunQuantities`, after all elements have relaxed."""
        (force,) = largest_force(self.time[:, None], self.forces[:, None])
        viscous = self.viscous[-1] + self.energies[-1]
        return RunQuantities(self.velocities[-1] - 1.0, force, self.friction[-1], viscous)

    def cover(self, old, count, bound):
        """Cover elements with loads limited to `bound`."""
        self.count = count
        self.load[old:count] = np.clip(self.tau * self.velocity, -bound, bound)
        self.bound[old:count] = bound

    def step(self, i, bound, changing):
        """Take a step to instant i, with bounds there; `changing` elements are covered or released."""
        h = self.time[i] - self.time[i - 1] if i else 0.0
        n, width = self.count, self.elements.width[: self.count]
        start_load, s = self.load[:n], self.s[:n]
        dt = np.full(n, h)
        dt[changing] *= 1 - self.elements.delay[changing]
        velocity, trial, slip_share, mean = self._balance(h, dt, width, start_load, s, bound)
        load = np.minimum(np.maximum(trial, -bound), bound)
        displacement = dt * ((self.velocity + velocity) / 2)
        self.rate = (velocity - self.velocity) / h if h else 0.0
        work, remaining = (width * mean) @ displacement, np.exp(-2 * h / self.tau)
        end_s, slip_work = self._relaxed(
            dt, s, displacement, slip_share, start_load, trial, load, velocity - self.velocity
        )
        gain, friction = width @ (end_s**2 - s**2) / 2, width @ slip_work
        viscous = work - friction - gain + (1 - remaining) * self.released
        self.released *= remaining
        self.velocity, self.load[:n], self.s[:n], self.bound[:n] = velocity, load, end_s, bound
        self.stored += gain
        self.velocities[i], self.forces[i] = velocity, width @ load
        self.energies[i] = self.stored + self.released
        if i:
            self.viscous[i] = self.viscous[i - 1] + viscous
            self.friction[i] = self.friction[i - 1] + friction
        if i in self.instants:
            self.element_states[i] = load, slip_share == 0

    def _balance(self, h, dt, width, start_load, s, bound):
        """Return velocity at the end of a step, loads if all stick, slipping shares, and mean loads.

        Load and bound are linear in time until they meet. A stuck element with some `room` to its bound,
        which stick would exceed by `excess`, then slips. The residual W₁ − W + C ∫∫Q dx dt grows with W₁.
        """
        weight, reach = self.inertia * width * dt / 2, dt / 2 + self.tau
        base, known = s + dt * (self.velocity / 2), weight @ start_load - self.velocity
        stiffness, w, low, high = weight * reach, self.velocity + h * self.rate, -np.inf, np.inf
        # Without any room, a slipping element slips for the whole step.
        allowed = self.bound[: bound.size] * (1 + 1e-15) + 1e-290
        for _ in range(100):
            trial = base + reach * w
            sign = np.copysign(1.0, trial)
            excess, room = np.maximum(np.abs(trial) - bound, 0.0), allowed - sign * start_load
            slip_share = excess / (room + excess)
            end_load = trial - sign * excess * slip_share
            residual = w + known + weight @ end_load
            low, high = (low, w) if residual > 0 else (w, high)
            new = w - residual / (1 + stiffness @ (1 - slip_share) ** 2)
            if abs(new - w) <= 1e-12:
                break
            w = new if low < new < high or high - low == np.inf else (low + high) / 2
        return w, trial, slip_share, (start_load + end_load) / 2

    def _relaxed(self, dt, s, displacement, slip_share, start_load, trial, load, gain):
        """Return s after a step, and friction work: first stick, then τṡ + s = Q with a linear load."""
        stuck = 1 - slip_share
        slip_s, slip_load = s + stuck * displacement, start_load + stuck * (trial - start_load)
        dt = np.maximum(slip_share * dt, 1e-300)
        z, rise, mean = dt / self.tau, load - slip_load, (load + slip_load) / 2
        fade = -np.expm1(-z)
        # 1 − (1 − e^(−z))/z, without cancellation.
        late = np.where(z > 1e-3, 1 - fade / z, z / 2 - z * z / 6)
        end_s = slip_s + fade * (slip_load - slip_s) + late * rise
        # ∫Qṡ dt by parts, with ∫s dt known; the velocity of the surface is also linear in time.
        elastic = load * end_s - slip_load * slip_s - rise * (mean - (end_s - slip_s) / z)
        slip_work = mean * slip_share * displacement + rise * slip_share * gain * dt / 12 - elastic
        return end_s, slip_work

    def release(self, count):
        """Release the elements from number `count`; their stored energy relaxes."""
        rows = slice(count, self.count)
        energy = self.elements.width[rows] @ self.s[rows] ** 2 / 2
        self.stored, self.released, self.count = self.stored - energy, self.released + energy, count
