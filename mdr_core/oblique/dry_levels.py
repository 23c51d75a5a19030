"""Normal motions without viscosity at levels of depth, for many impacts at a time: a grid for friction.

Arrays have a row for each level, and a column for each impact.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..contact.yielding import YieldRule, yield_rule


class Branch(NamedTuple):
    """Loading or unloading. At levels: depth and plastic depth (m), velocity (m/s) and acceleration (m/s²).

    For the steps between them: time (s), and depth and plastic depth (m) when half of it has passed.
    """

    depth: np.ndarray
    plastic_depth: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    step: np.ndarray
    middle: np.ndarray
    middle_plastic_depth: np.ndarray

    @classmethod
    def of(cls, depth, plastic_depth, velocity, acceleration):
        """The branch with steps of fourth order, Δd = h (v₀ + v₁)/2 + h² (a₀ − a₁)/12."""
        rise, mean = np.diff(depth, axis=0), (velocity[1:] + velocity[:-1]) / 2
        bend = -np.diff(acceleration, axis=0) / 12
        root = np.copysign(np.sqrt(np.maximum(mean**2 + 4 * bend * rise, 0.0)), mean)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(rise == 0, 0.0, 2 * rise / (mean + root))
        middle = (depth[1:] + depth[:-1]) / 2 - step * np.diff(velocity, axis=0) / 8
        # The onset of yield is a level: over a step either nothing yields, or both depths rise alike.
        before, after = plastic_depth[:-1], plastic_depth[1:]
        middle_plastic_depth = np.clip(after - (depth[1:] - middle), before, after)
        return cls(depth, plastic_depth, velocity, acceleration, step, middle, middle_plastic_depth)


@dataclass(frozen=True)
class NormalMotions:
    """Impacts without viscosity on a virgin medium, as what stays the same during each of them.

    Rule of yield, plastic depth at the end, live depth at the turning point (m), speed (m/s), and 2E*/m
    (1/(m s²)), which makes an acceleration of ∫a ds.
    """

    rule: YieldRule
    plastic_depth: np.ndarray
    live_depth: np.ndarray
    speed: np.ndarray
    rate: np.ndarray

    @classmethod
    def of(cls, hit, rows):
        """Those of the `Impact` at rows of its flattened shape."""
        turning, medium = hit.turning_point.live_interval, hit.medium
        given = turning.lower, turning.length, hit.speed, 2 * medium.E_star / hit.mass
        given = (np.broadcast_to(value, hit.shape).ravel()[rows] for value in given)
        return cls(yield_rule(hit.profile, medium).flat_entries(rows, hit.shape), *given)

    @property
    def profile(self):
        """One indenter, or one for each impact."""
        return self.rule.profile

    def __getitem__(self, rows):
        values = (value[rows] for name, value in vars(self).items() if name != "rule")
        return NormalMotions(self.rule.flat_entries(rows, self.speed.shape), *values)

    def at_levels(self, function, *levels):
        """A function of arrays of levels, which is called level by level where profiles differ."""
        if not self.profile.shape:
            return function(*levels)
        return np.array([function(*row) for row in zip(*levels, strict=True)])

    def radii(self, depth):
        """Contact radii (m) at levels of depth (m)."""
        return self.at_levels(self.profile._radius, depth)

    def branches(self, counts, instants):
        """Loading and unloading: with levels in so many parts below and above the imprint.

        Depths at `instants`, (M, n), are levels as well; so are the onset of yield and the kinks.
        """
        end, size = self.plastic_depth, self.live_depth
        kinks = [np.broadcast_to(kink, end.shape) for kink in self.profile.kinks]
        onset = np.broadcast_to(self.rule.onset(), end.shape)
        extra = np.vstack([np.stack([onset, *kinks]), instants])
        below, above = (np.linspace(0.0, 1.0, count + 1)[:, None] for count in counts)
        # In equal parts of √(d_max − d) below, about equal times; above closer towards both ends.
        root = np.sqrt(end + size)
        below = below[:-1] * (root - np.sqrt(size))
        below = np.vstack([below * (2 * root - below), np.clip(extra, 0.0, end), end])
        above = np.vstack([size * np.sin(np.pi / 2 * above[1:]) ** 2, np.clip(extra - end, 0.0, size)])
        below, above = np.sort(below, axis=0), np.sort(above, axis=0)
        loading = self._loading(np.vstack([below, end + above]))
        return loading, self._unloading(np.vstack([above[::-1], 0 * size]))

    def _loading(self, depth):
        interval, _ = self.rule.loading(depth)
        lower = interval.lower
        work, area = self._work_and_area(lower, interval.length)
        ahead = np.maximum(self.plastic_depth - lower, 0.0)
        if np.any(ahead > 0):
            work += self.at_levels(self.rule.plastic_integral, lower, ahead)
        velocity = self._velocity(work, depth[-1] - depth, area)
        velocity[0], velocity[-1] = self.speed, 0.0
        return Branch.of(depth, lower, velocity, -self.rate * area)

    def _unloading(self, live_depth):
        lower = np.broadcast_to(self.plastic_depth, live_depth.shape)
        work, area = self._work_and_area(lower, live_depth)
        velocity = -self._velocity(work, live_depth[0] - live_depth, area)
        velocity[0] = 0.0
        return Branch.of(lower + live_depth, lower, velocity, -self.rate * area)

    def _velocity(self, work, gap, area):
        """Speeds (m/s) from works (m³), at least that of the force at a level over the gap (m) to the top.

        Beside the turning point the work is rounding, and steps would have any length.
        """
        return np.sqrt(2 * self.rate * np.maximum(work, gap * area))

    def _work_and_area(self, lower, length):
        """Energy stored at the turning point less that at levels, over 2E* (m³), and ∫a ds there (m²)."""
        stored = self._energy(self.plastic_depth, self.live_depth)
        work = stored - self.at_levels(self._energy, lower, length)
        return work, self.at_levels(self._area, lower, length)

    def _energy(self, lower, length):
        return integrals(self.profile).energy_integral(LiveInterval.above(lower, length))

    def _area(self, lower, length):
        return integrals(self.profile).radius_integral(LiveInterval.above(lower, length))
