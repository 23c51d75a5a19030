"""Normal motions without viscosity at levels of depth, for many impacts at a time: a grid for friction.

Arrays have a row for each level or step, and a column for each impact.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..contact.yielding import YieldRule, yield_rule


class DryLevels(NamedTuple):
    """Instants at which loading passes levels of depth, and unloading those that lie above the imprint.

    The turning point is that of number `turn`. At each instant: depth, plastic depth (m), velocity (m/s).
    For the steps between them: time (s), and depth and plastic depth (m) when half of it has passed.
    """

    turn: int
    depth: np.ndarray
    plastic_depth: np.ndarray
    velocity: np.ndarray
    step: np.ndarray
    middle: np.ndarray
    middle_plastic_depth: np.ndarray

    @classmethod
    def of(cls, turn, depth, plastic_depth, velocity, acceleration):
        """Levels with steps of fourth order, Δd = h (v₀ + v₁)/2 + h² (a₀ − a₁)/12."""
        rise, mean = np.diff(depth, axis=0), (velocity[1:] + velocity[:-1]) / 2
        bend = -np.diff(acceleration, axis=0) / 12
        root = np.copysign(np.sqrt(np.maximum(mean**2 + 4 * bend * rise, 0.0)), mean)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(rise == 0, 0.0, 2 * rise / (mean + root))
        middle = (depth[1:] + depth[:-1]) / 2 - step * np.diff(velocity, axis=0) / 8
        # The onset of yield is a level: over a step either nothing yields, or both depths rise alike.
        before, after = plastic_depth[:-1], plastic_depth[1:]
        middle_plastic_depth = np.clip(after - (depth[1:] - middle), before, after)
        return cls(turn, depth, plastic_depth, velocity, step, middle, middle_plastic_depth)

    @property
    def time(self):
        """Times (s) since first contact, of instants and of the middles between them."""
        half = np.repeat(self.step / 2, 2, axis=0)
        return np.vstack([0 * half[:1], np.cumsum(half, axis=0)])


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

    def levels(self, below, above, depths=()):
        """The `DryLevels` with so many steps of loading below the imprint, and so many above it.

        Some `depths` (m) of all impacts are levels as well; so are the onset of yield and the kinks.
        """
        end, size = self.plastic_depth, self.live_depth
        known = self.rule.onset(), *self.profile.kinks, *depths
        extra = np.array([np.broadcast_to(depth, end.shape) for depth in known])
        below, above = (np.linspace(0.0, 1.0, count + 1)[:, None] for count in (below, above))
        # In equal parts of √(d_max − d) below, about equal times; above closer towards both ends.
        root = np.sqrt(end + size)
        below = below[:-1] * (root - np.sqrt(size))
        below = np.vstack([below * (2 * root - below), np.minimum(extra, end), end])
        extra = np.where(extra < end + size, np.maximum(extra - end, 0.0), 0.0)
        above = np.vstack([size * np.sin(np.pi / 2 * above[1:]) ** 2, extra])
        below, above = np.sort(below, axis=0), np.sort(above, axis=0)
        depth = np.vstack([below, end + above])
        loaded, _ = self.rule.loading(depth)
        lower = np.vstack([loaded.lower, np.broadcast_to(end, above.shape)])
        length = np.vstack([loaded.length, above[-2::-1], 0 * size])
        return self._moving(len(depth) - 1, np.vstack([depth, end + length[len(depth) :]]), lower, length)

    def _moving(self, turn, depth, lower, length):
        """`DryLevels` from depths and live intervals (m) at all instants."""
        area = self.at_levels(self._area, lower, length)
        # Kinetic energy over 2E* (m³): what the springs hold more at the turning point, and what yields
        # until then.
        stored = self._energy(self.plastic_depth, self.live_depth)
        work = stored - self.at_levels(self._energy, lower, length)
        ahead = np.maximum(self.plastic_depth - lower, 0.0)
        if np.any(ahead > 0):
            work += self.at_levels(self.rule.plastic_integral, lower, ahead)
        # Beside the turning point the work is rounding, and steps would have any length. It is at least
        # that of the force at the level.
        speed = np.sqrt(2 * self.rate * np.maximum(work, (depth[turn] - depth) * area))
        speed[0], speed[turn] = self.speed, 0.0
        velocity = np.vstack([speed[:turn], -speed[turn:]])
        return DryLevels.of(turn, depth, lower, velocity, -self.rate * area)

    def _energy(self, lower, length):
        return integrals(self.profile).energy_integral(LiveInterval.above(lower, length))

    def _area(self, lower, length):
        return integrals(self.profile).radius_integral(LiveInterval.above(lower, length))
