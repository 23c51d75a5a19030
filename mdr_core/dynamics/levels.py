"""Levels of depth, and when a normal impact passes them: what friction along the surface asks of it."""

from typing import NamedTuple

import numpy as np
import scipy

from .equation_of_motion import Bodies, solve

#: What polynomials of the normal motion leave, and places at which each of them is tabulated.
_TOLERANCE, _PLACES = 1e-10, np.linspace(0.0, 1.0, 25)[None]
#: Steps of the first run for each unit of what changes; the most levels that a run may have.
_STEPS, MOST_LEVELS = 4, 6000


class _Branch:
    """Loading or unloading over time: depth y or live depth ℓ (m), and velocity (m/s), both tabulated."""

    def __init__(self, steps):
        rows = []
        for _, step in steps:
            depth, velocity, time, _ = step.at(_PLACES)
            rate, acceleration, _ = step.bodies.rates(*step.bodies.loads(depth)[:2], velocity)
            rows.append(np.stack([time, depth, rate, velocity, acceleration])[:, 0])
        table = np.hstack(rows)
        # Where steps meet they have one instant in common.
        _, first = np.unique(table[0], return_index=True)
        self.time, self.at, rate, self.speed, acceleration = table[:, first]
        self.depth = scipy.interpolate.CubicHermiteSpline(self.time, self.at, rate)
        self.velocity = scipy.interpolate.CubicHermiteSpline(self.time, self.speed, acceleration)
        self._rate = self.depth.derivative()

    def when(self, depth):
        """Times (s) at some depths: Newton's method between two places of the table."""
        sign = np.sign(self.at[-1] - self.at[0])
        at = np.maximum.accumulate(sign * self.at)
        k = np.clip(np.searchsorted(at, sign * depth) - 1, 0, at.size - 2)
        low, high, time = self.time[k], self.time[k + 1], np.interp(sign * depth, at, self.time)
        for _ in range(6):
            with np.errstate(divide="ignore", invalid="ignore"):
                step = (self.depth(time) - depth) / self._rate(time)
            time = np.clip(time - np.where(np.isfinite(step), step, 0.0), low, high)
        return time

    def even(self, scales):
        """Times (s) at even shares of all that changes; `scales`: rates (1/s), what changes, and sizes."""
        rates, sizes = scales
        step = np.diff(self.time) * (rates[1:] + rates[:-1]) / 2
        step += sum(np.abs(np.diff(values)) / size for values, size in sizes)
        share = np.append(0.0, np.cumsum(step))
        count = int(np.ceil(min(_STEPS * share[-1], MOST_LEVELS / 16)))
        return np.interp(np.linspace(0, share[-1], count + 1)[1:-1], share, self.time)


class NormalMotion:
    """The normal motion of one `Impact`, as far as friction asks for it."""

    def __init__(self, hit):
        medium, self.profile = hit.medium, hit.profile
        self.tau, self.critical_depth = float(medium.relaxation_time), float(medium.critical_depth)
        self.deepest, self.lower = float(hit.max_depth), float(hit.plastic_depth)
        bodies = Bodies.of(hit.profile, medium, hit.mass, hit.speed, np.zeros(()), hit.max_depth)
        course = solve(bodies, _TOLERANCE)
        self.loading, self.unloading = _Branch(course.loading), _Branch(course.unloading)
        self.turn, self.end = self.unloading.time[0], self.unloading.time[-1]

    def levels(self, inertia, halvings, instants=()):
        """The `Levels` of a run with C = 2κE*/m_t (1/(m s²)), and with levels at some instants (s).

        They are as dense as loading and unloading need, and then halved in the time of loading.
        """
        down, up = self.loading, self.unloading
        early = np.append(down.even(self._scales(down, inertia)), [t for t in instants if t < self.turn])
        late = np.append(up.even(self._scales(up, inertia)), [t for t in instants if t > self.turn])
        met = np.append(self.lower + up.depth(late), [self.lower, min(self.critical_depth, self.deepest)])
        met = met[(met > 0) & (met < self.deepest)]
        time = np.concatenate([[0.0, self.turn], early, down.when(met)])
        depth = np.concatenate([[0.0, self.deepest], down.depth(early), met])
        depth, first = np.unique(np.clip(depth, 0.0, self.deepest), return_index=True)
        time = np.maximum.accumulate(np.minimum(time[first], self.turn))
        for _ in range(halvings):
            middle = (time[1:] + time[:-1]) / 2
            inner = np.clip(down.depth(middle), depth[:-1], depth[1:])
            between = np.arange(1, time.size)
            time, depth = np.insert(time, between, middle), np.insert(depth, between, inner)
        above = np.flatnonzero(depth > self.lower)[::-1]
        live = np.append(depth[above] - self.lower, 0.0)
        rise = np.maximum.accumulate(np.append(self.turn, up.when(live[1:])))
        rise[-1] = self.end
        return Levels(depth, time, np.maximum(down.velocity(time), 0.0), live, rise)

    def _scales(self, branch, inertia):
        """Rates (1/s) of stick under dashpots and springs, and what else a step is to be short against."""
        front = branch.at + (self.lower if branch is self.unloading else 0.0)
        a = self.profile._radius(np.clip(front, 0.0, self.deepest))
        span = branch.time[-1] - branch.time[0]
        rates = 1 / span + np.sqrt(inertia * a) + inertia * self.tau * a
        sizes = (branch.at, np.ptp(branch.at)), (a, a.max()), (branch.speed, np.ptp(branch.speed))
        return rates, sizes


class Levels(NamedTuple):
    """Levels of depth (m), times and velocities (m/s) on loading; live depths and times on unloading."""

    depth: np.ndarray
    down: np.ndarray
    velocity: np.ndarray
    live_depth: np.ndarray
    up: np.ndarray
