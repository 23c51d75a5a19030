"""Normal motions without viscosity at levels of depth, for many impacts at a time: a grid for friction.

Arrays have one row per level or step, and one column per impact.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..contact.yielding import YieldRule, yield_rule
from ..numerics.gauss import gauss_legendre

#: Gauss nodes of the work in each step.
_NODES = 3


class DryLevels(NamedTuple):
    """Instants at which loading passes levels of depth, and unloading passes levels above the imprint.

    The turning point is instant number `turn`. `depth`, `plastic_depth` (m) and `velocity` (m/s) are at
    each instant. `step` (s) is the time of the steps between them. `middle` and `middle_plastic_depth` (m)
    are the depths after half of this time.
    """

    turn: int
    depth: np.ndarray
    plastic_depth: np.ndarray
    velocity: np.ndarray
    step: np.ndarray
    middle: np.ndarray
    middle_plastic_depth: np.ndarray

    @classmethod
    def of(cls, turn, depth, plastic_depth, velocity, acceleration, plastic_depth_at):
        """Make levels with steps of fourth order, Δd = h (v₀ + v₁)/2 + h² (a₀ − a₁)/12.

        `plastic_depth_at` returns the plastic depths after loading to depths in the middle of steps.
        """
        rise, mean = np.diff(depth, axis=0), (velocity[1:] + velocity[:-1]) / 2
        bend = -np.diff(acceleration, axis=0) / 12
        root = np.copysign(np.sqrt(np.maximum(mean**2 + 4 * bend * rise, 0.0)), mean)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(rise == 0, 0.0, 2 * rise / (mean + root))
        middle = (depth[1:] + depth[:-1]) / 2 - step * np.diff(velocity, axis=0) / 8
        before, after = plastic_depth[:-1], plastic_depth[1:]
        loaded = np.vstack([plastic_depth_at(middle[:turn]), after[turn:]])
        return cls(turn, depth, plastic_depth, velocity, step, middle, np.clip(loaded, before, after))

    @property
    def time(self):
        """Times (s) since first contact, of instants and of the middles between them."""
        half = np.repeat(self.step / 2, 2, axis=0)
        return np.vstack([0 * half[:1], np.cumsum(half, axis=0)])


@dataclass(frozen=True)
class NormalMotions:
    """Impacts without viscosity on a virgin medium: the quantities that are constant during each impact.

    They are the rule of yield, the plastic depth at the end (m), the live depth at the turning point (m)
    and the speed (m/s). `rate` is 2E*/m (1/(m s²)), the ratio of acceleration and ∫a ds.
    """

    rule: YieldRule
    plastic_depth: np.ndarray
    live_depth: np.ndarray
    speed: np.ndarray
    rate: np.ndarray

    @classmethod
    def of(cls, hit, rows):
        """Make the motions of an `Impact` at rows of its flattened shape."""
        turning, medium = hit.turning_point.live_interval, hit.medium
        given = turning.lower, turning.length, hit.speed, 2 * medium.E_star / hit.mass
        given = (np.broadcast_to(value, hit.shape).ravel()[rows] for value in given)
        return cls(yield_rule(hit.profile, medium).flat_entries(rows, hit.shape), *given)

    @property
    def profile(self):
        """One indenter, or one per impact."""
        return self.rule.profile

    def __getitem__(self, rows):
        values = (value[rows] for name, value in vars(self).items() if name != "rule")
        return NormalMotions(self.rule.flat_entries(rows, self.speed.shape), *values)

    def levels(self, below, above, depths=()):
        """Return the `DryLevels`, with numbers of loading steps `below` and `above` the imprint.

        Loading has levels from 0 to d_max = d_p + ℓ, and unloading has the same levels from d_max to d_p.
        Other levels are `depths` (m) of all impacts, the onset of yield, and the depths at which either end
        of the live interval passes a kink.
        """
        imprint, live_depth = self.plastic_depth, self.live_depth
        column = self.rule.entries((slice(None), None), imprint.shape)
        breaks = column.breaks(0 * imprint[:, None], (imprint + live_depth)[:, None])
        known = [*breaks.onset.T, *breaks.upper.T, *breaks.lower.T, *depths]
        known = np.array([np.broadcast_to(depth, imprint.shape) for depth in known])
        deep = np.sort(np.vstack([self._even_below(below), np.minimum(known, imprint)]), axis=0)
        # From here in live depths; depths that are not between 0 and ℓ are moved to 0.
        reached = np.where(known < imprint + live_depth, np.maximum(known - imprint, 0.0), 0.0)
        live = np.sort(np.vstack([self._even_above(above), reached]), axis=0)

        loading_depth = np.vstack([deep, imprint + live])
        loading = self._loaded(loading_depth)
        released = np.vstack([live[-2::-1], 0 * live_depth])
        return self._moving(
            turn=len(loading_depth) - 1,
            depth=np.vstack([loading_depth, imprint + released]),
            lower=np.vstack([loading.lower, np.broadcast_to(imprint, released.shape)]),
            length=np.vstack([loading.length, released]),
        )

    def _even_below(self, count):
        """Return levels (m) from 0 to d_p, in equal parts of √(d_max − d), with about equal times."""
        root, last_root = np.sqrt(self.plastic_depth + self.live_depth), np.sqrt(self.live_depth)
        # d = d_max − (√d_max − passed)².
        passed = np.linspace(0.0, 1.0, count + 1)[:-1, None] * (root - last_root)
        return np.vstack([passed * (2 * root - passed), self.plastic_depth])

    def _even_above(self, count):
        """Return live depths (m) from above 0 to ℓ, closer towards both ends."""
        share = np.linspace(0.0, 1.0, count + 1)[1:, None]
        return self.live_depth * np.sin(np.pi / 2 * share) ** 2

    def _moving(self, turn, depth, lower, length):
        """Return `DryLevels` from depths and live intervals (m) at all instants."""
        # Kinetic energy over 2E* (m³) is the work of the force up to the turning point, or since then. The
        # sum over steps keeps its digits next to the turning point.
        loading = self._works(depth[:turn], np.diff(depth[: turn + 1], axis=0), self._loaded)
        unloading = self._works(length[turn + 1 :], -np.diff(length[turn:], axis=0), self._unloaded)
        work = np.vstack(
            [np.cumsum(loading[::-1], axis=0)[::-1], 0 * unloading[:1], np.cumsum(unloading, axis=0)]
        )
        speed = np.sqrt(2 * self.rate * work)
        speed[0] = self.speed
        velocity = np.vstack([speed[:turn], -speed[turn:]])
        acceleration = -self.rate * self._areas(LiveInterval.above(lower, length))
        return DryLevels.of(turn, depth, lower, velocity, acceleration, self.rule.plastic_depth)

    def _works(self, start, rise, interval_at):
        """Return the work over 2E* (m³) of the force in each step, by Gauss's rule."""
        parts = zip(*gauss_legendre(_NODES), strict=True)
        return rise * sum(weight * self._areas(interval_at(start + node * rise)) for node, weight in parts)

    def _loaded(self, depth):
        return self.rule.loading(depth)[0]

    def _unloaded(self, length):
        return LiveInterval.above(self.plastic_depth, length)

    def _areas(self, interval):
        return integrals(self.profile).radius_integral(interval)
