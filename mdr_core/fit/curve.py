"""Curves of force over depth: their model with its derivatives, and its branches.

    ∂F/∂ln E* = F − 2E* c d_c,   ∂F/∂ln q_c = 2E* c d_c,   ∂F/∂d = 2E* a,   ∂F/∂d_max = −2E* c

with d_max the largest depth so far, which is d itself on a first loading: there the last two add up.

Noise of the depth must not be taken for memory, as the running maximum of the samples would. Where there is
some, a branch knows its d_max as a parameter, and every sample belongs to the place of its branch that is
nearest in units of both noises (orthogonal distances: Boggs, Byrd & Schnabel, SIAM J. Sci. Stat. Comput. 8,
1987, 1052). Its distance in units of √(σ_F² + (S σ_d)²), S the slope there, is what is made small.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..superposition import radius_integral
from ..yielding import LiveInterval, interval_at

#: All parameters, in the order of a fit.
NAMES = ("E_star", "q_c", "contact_point", "baseline", "frame_compliance")
#: What the force depends on beside the depth.
_MATTER = ("E_star", "q_c", "frame_compliance")
#: Steps of the search for the nearest place.
_PROJECTIONS = 6


@dataclass(frozen=True)
class Curves:
    """Curves of as many turning points, one a row: what was measured, what is held, how branches are told.

    `fixed` are the held parameters by name (R,), `free` the names of the others; `depth_noise` and `sigma`
    the standard deviations of depth (m) and force (N), the latter (R, N). Scaled parameters x are
    logarithms of E* and q_c, else shares of the measured ranges `length` and `load`.
    """

    tip: object
    depth: np.ndarray
    force: np.ndarray
    fixed: dict
    depth_noise: float
    sigma: np.ndarray
    turns: np.ndarray
    lows: np.ndarray

    def rows(self, rows):
        fixed = {name: value[rows] for name, value in self.fixed.items()}
        names = "depth", "force", "sigma", "turns", "lows"
        return replace(self, fixed=fixed, **{name: getattr(self, name)[rows] for name in names})

    def holding(self, **values):
        return replace(self, fixed=self.fixed | values)

    @cached_property
    def length(self):
        return np.ptp(self.depth, axis=1, keepdims=True)

    @cached_property
    def load(self):
        return np.ptp(self.force, axis=1, keepdims=True)

    @cached_property
    def free(self):
        return tuple(name for name in NAMES if name not in self.fixed)

    @property
    def peaks(self):
        """Number of turning depths that are parameters."""
        return self.turns.shape[1] if self.depth_noise else 0

    @cached_property
    def scale(self):
        """What one unit of each scaled parameter is, 1 of a logarithm (R, P)."""
        one = np.ones_like(self.length)
        units = dict(zip(NAMES, (one, one, self.length, self.load, self.length / self.load), strict=True))
        return np.hstack([one[:, :0], *(units[name] for name in self.free), *[self.length] * self.peaks])

    @cached_property
    def offset(self):
        """Where scaled lengths count from (R, P)."""
        low = self.depth.min(axis=1, keepdims=True)
        none = np.zeros_like(low)
        begin = [low if name == "contact_point" else none for name in self.free]
        return np.hstack([none[:, :0], *begin, *[low] * self.peaks])

    def values(self, x):
        """Parameters by name (R, 1), and the turning depths (R, K)."""
        plain = self.offset + self.scale * x
        values = {name: value[:, None] for name, value in self.fixed.items()}
        for i, name in enumerate(self.free):
            values[name] = np.exp(x[:, i, None]) if name in NAMES[:2] else plain[:, i, None]
        return values, plain[:, len(self.free) :]

    def scaled(self, values, turning):
        """The inverse of `values`."""
        plain = np.hstack([*(values[name] for name in self.free), turning[:, : self.peaks]])
        plain = plain.reshape(len(self.depth), -1)
        x = (plain - self.offset) / self.scale
        for i, name in enumerate(self.free):
            x[:, i] = np.log(values[name][:, 0]) if name in NAMES[:2] else x[:, i]
        return x

    @cached_property
    def branches(self):
        """Which turning depth each sample has behind it (−1: none), and whether it may go deeper (R, N)."""
        place = np.arange(self.depth.shape[1])
        behind = np.sum(place > self.turns[:, :, None], axis=1) - 1
        deeper = np.zeros(self.depth.shape, bool)
        for k in range(self.lows.shape[1]):
            end = self.turns[:, k, None] if k < self.turns.shape[1] else place.size
            deeper |= (place >= self.lows[:, k, None]) & (place <= end)
        return behind, deeper

    def memory(self, depth, turning):
        """The largest depth so far, and where it is the sample's own; without noise the running maximum."""
        if not self.depth_noise:
            deepest = np.maximum.accumulate(depth, axis=1)
            return deepest, depth >= deepest
        behind, deeper = self.branches
        padded = np.hstack([np.full_like(self.length, -np.inf), turning])
        before = np.take_along_axis(padded, behind + 1, axis=1)
        own = deeper & (depth >= before)
        return np.where(own, depth, before), own

    def states(self, x):
        """Parameters, the nearest `State` of each sample, and before it how far that is in depth (m)."""
        values, turning = self.values(x)
        seen, turning = self.depth - values["contact_point"], turning - values["contact_point"]
        with np.errstate(all="ignore"):
            here = State.at(self, values, seen, turning)
            if self.depth_noise:
                here = self._nearest(values, seen, turning, here)
        return values, seen - here.seen, here

    def _nearest(self, values, measured, turning, here):
        """The state of each branch that is nearest to its sample.

        Out of contact the slope tells no way; so the search begins within the contact, too.
        """
        load, noise = self.force - values["baseline"], self.depth_noise

        def distance(state):
            return ((measured - state.seen) / noise) ** 2 + ((load - state.force) / self.sigma) ** 2

        best, least, inside = here, distance(here), np.maximum(measured, here.live_interval.lower + noise)
        place = State.at(self, values, inside, turning)
        for _ in range(_PROJECTIONS):
            cost = distance(place)
            best, least = best.where(cost < least, place), np.minimum(cost, least)
            pull = load - place.force - place.slope * (measured - place.seen)
            step = place.slope * noise**2 * pull / (self.sigma**2 + (place.slope * noise) ** 2)
            place = State.at(self, values, measured + step, turning)
        return best.where(distance(place) < least, place)

    def residuals(self, x, rows=slice(None)):
        """Residuals in units of their noise (R, N), and derivatives by the scaled parameters (R, N, P)."""
        if not isinstance(rows, slice):
            return self.rows(rows).residuals(x)
        values, off, state = self.states(x)
        noise = self.noise(state.slope)
        load = self.force - values["baseline"]
        jacobian = state.derivatives(self) / noise[..., None] * self.scale[:, None, :]
        return (load - state.force - state.slope * off) / noise, jacobian

    def noise(self, slope):
        """Standard deviation (N) of what is missed, of both noises where the curve has some slope."""
        return np.sqrt(self.sigma**2 + (slope * self.depth_noise) ** 2)

    def relabelled(self, x):
        """With turning points where the two branches that meet there fit best."""
        turns, count = self.turns.copy(), self.depth.shape[1]
        for k in range(turns.shape[1]):
            first = self.lows[:, k]
            last = self.lows[:, k + 1] if k + 1 < self.lows.shape[1] else np.full(len(turns), count)
            costs = []
            for place in (np.minimum(last, count) - 1, first):
                trial = self.turns.copy()
                trial[:, k] = place
                costs.append(replace(self, turns=trial).residuals(x)[0] ** 2)
            gain = np.cumsum(costs[0] - costs[1], axis=1)
            place = np.arange(count)
            within = (place >= first[:, None]) & (place < last[:, None])
            turns[:, k] = np.argmin(np.where(within, gain, np.inf), axis=1)
        return replace(self, turns=turns)


@dataclass(frozen=True)
class State:
    """Samples on the model, arrays (R, N).

    `seen` is the depth with what the frame gives way, u = d + C F; `slope` is ∂F/∂u, `memory` that by the
    largest u so far, where it is not the sample's `own`; `gradient` by the parameters in `_MATTER`.
    """

    seen: np.ndarray
    depth: np.ndarray
    own: np.ndarray
    live_interval: LiveInterval
    force: np.ndarray
    slope: np.ndarray
    memory: np.ndarray
    gradient: np.ndarray

    @classmethod
    def at(cls, curves, values, seen, turning):
        deepest, own = curves.memory(seen, turning)
        C = values["frame_compliance"]
        if not C.any() and "frame_compliance" not in curves.free:
            return cls(seen, seen, own, *_springs(curves.tip, values, seen, deepest, own))
        # First how deep the turning point is, then the sample itself.
        D = _without_frame(curves.tip, values, deepest, deepest, True)
        d = np.where(own, D, _without_frame(curves.tip, values, seen, D, own))
        front = cls(D, D, own, *_springs(curves.tip, values, D, D, True))
        here = cls(d, d, own, *_springs(curves.tip, values, d, D, own))
        give, back = 1 + C * here.slope, here.memory / (1 + C * front.slope)
        gradient = (here.gradient - C * back * front.gradient) / give
        frame = -(here.slope * here.force + back * front.force) / give
        gradient = np.concatenate([gradient, frame[None]])
        return cls(seen, d, own, here.live_interval, here.force, here.slope / give, back / give, gradient)

    def where(self, chosen, other):
        """This state, and the `other` one where it is chosen."""

        def mixed(one, two, names):
            return (np.where(chosen, getattr(two, name), getattr(one, name)) for name in names)

        interval = LiveInterval(
            *mixed(self.live_interval, other.live_interval, ("lower", "upper", "length"))
        )
        rest = mixed(self, other, ("force", "slope", "memory", "gradient"))
        return State(*mixed(self, other, ("seen", "depth", "own")), interval, *rest)

    def derivatives(self, curves):
        """−∂F/∂p of all parameters that are free, and of the turning depths (R, N, P)."""
        columns = {"contact_point": self.slope + self.memory, "baseline": np.full_like(self.force, -1.0)}
        columns |= dict(zip(_MATTER, -self.gradient, strict=False))
        found = [columns[name] for name in curves.free]
        behind, _ = curves.branches
        found += [np.where(behind == k, -self.memory, 0.0) for k in range(curves.peaks)]
        return np.stack(found, axis=-1) if found else np.zeros((*self.force.shape, 0))


def critical_depth(values):
    """d_c (m) of parameters by name."""
    return np.pi / 2 * values["q_c"] / values["E_star"]


def _springs(tip, values, depth, deepest, own):
    """Live interval, force, slope and derivative by the largest depth, and those by ln E* and ln q_c."""
    d_c, modulus = critical_depth(values), 2 * values["E_star"]
    depth, deepest = np.minimum(depth, tip.known_depth), np.minimum(deepest, tip.known_depth)
    interval = interval_at(deepest, depth, d_c)
    touching = interval.length > 0
    a = np.where(touching, tip._radius(interval.upper), 0.0)
    c = np.where(touching & (interval.lower > 0), tip._radius(interval.lower), 0.0)
    force, back = modulus * radius_integral(tip, interval), modulus * c
    yielded = np.where(c > 0, back * d_c, 0.0)
    slope = modulus * a - np.where(own, back, 0.0)
    return interval, force, slope, np.where(own, 0.0, -back), np.stack([force - yielded, yielded])


def _without_frame(tip, values, seen, deepest, own):
    """Depth d (m) with d + C F(d) = `seen`, by Newton's method from above."""
    C, depth = values["frame_compliance"], seen
    for _ in range(40):
        most = depth if own is True else np.where(own, depth, deepest)
        _, force, slope, *_ = _springs(tip, values, depth, most, own)
        step = (depth + C * force - seen) / (1 + C * slope)
        depth = depth - step
        if np.all(np.abs(step) <= 1e-15 * np.abs(seen).max()):
            break
    return depth
