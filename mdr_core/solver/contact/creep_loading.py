"""The scalar law of creep for an indenter that goes deeper.

With the contact radius a(s), f = F/(2E*), and A = ∫ a ds over the live interval [d_p, d], on a virgin
medium,

    A + τ a ḋ = f     until f has fallen to A.

With y = ∫ a ds from the tip to d, this is τ ẏ = f − A, which is linear as long as nothing yields. Times are
in units of τ, and f is linear between the given times.
"""

import warnings
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import scipy

from ...base.errors import MDRError
from ..numerics.gauss import gauss_legendre
from ..numerics.roots import increasing_root
from .integrals import integrals
from .live_interval import LiveInterval
from .yielding import YieldRule

#: Share of the largest depth up to which the law of a sharp tip that yields from first touch is linear.
#: There the tip is a cone, and for a cone with a constant hardness A/y is the same at every depth.
_TIP = 1e-6
#: Nodes of ∫ d df between two times while nothing yields. The work of the dashpots then has errors of at
#: most 4·10⁻¹², with 8 nodes 4·10⁻⁹.
_NODES = 12


@dataclass(frozen=True, eq=False)
class Loading:
    """The law of a growing depth under f (m²), linear over intervals `ds` (τ) of time.

    `bound` is an upper bound of the depth (m), `onset` (m) the onset of yield, and `precision` the relative
    precision of the integrator.
    """

    rule: YieldRule
    area: np.ndarray
    ds: np.ndarray
    bound: float
    onset: float
    precision: float

    def pressed(self, depth):
        """Return A (m²) and a (m) on a first loading to depths (m)."""
        interval, _ = self.rule.loading(depth)
        return integrals(self.rule.profile).radius_integral(interval), self.rule.profile.radius_at(depth)

    def elastic(self, depth):
        """Return ∫ a ds (m²) from the tip to depths (m), and a (m)."""
        interval = LiveInterval.elastic(np.asarray(depth, dtype=float))
        return integrals(self.rule.profile).radius_integral(interval), self.rule.profile.radius_at(depth)

    def depth_of(self, y):
        """Return the depths (m) at which ∫ a ds from the tip is y (m²); infinite below the known depth."""
        return increasing_root(self.elastic, y, self.bound, self.rule.profile.known_depth)

    @property
    def linear_part(self):
        """Depth (m) up to which the law is linear in y, the value of y (m²) there, and A/y."""
        depth = self.onset
        if depth >= self.rule.profile.known_depth:
            return np.inf, np.inf, 1.0
        if depth > 0:
            return depth, float(self.elastic(depth)[0]), 1.0
        depth = _TIP * self.bound
        y = float(self.elastic(depth)[0])
        return depth, y, float(self.pressed(depth)[0]) / y

    def solve(self, first):
        """Return the `Pressed` depths after a first depth (m)."""
        depth = np.full(len(self.area), np.inf)
        moment = np.zeros(len(self.area))
        depth[0] = first
        for start, stop in _stretches(self.area, self.ds):
            places = np.cumsum(self.ds[start:stop])
            reached = _Stretch(self, self.area[start], places, self.area[stop]).solve(depth[start])
            last = start + reached.depth.size
            depth[start + 1 : last + 1] = reached.depth
            moment[start + 1 : last + 1] = moment[start] + reached.moment
            if reached.turn is not None:
                turn = reached.turn
                return Pressed(
                    depth[: last + 1],
                    moment[: last + 1],
                    turning_depth=turn.depth,
                    turning_moment=moment[start] + turn.moment,
                    age=turn.time - np.append(0.0, places)[last - start],
                )
            if depth[stop] == np.inf:
                break
        # Integrated depths may decrease by rounding.
        return Pressed(np.maximum.accumulate(depth), moment)


@dataclass(frozen=True, eq=False)
class Pressed:
    """Depths (m) at the times up to the turning point, and ∫ d df (m³) since the first time.

    The turning point is at the depth `turning_depth` and the time `age` (τ) after the last of these times.
    Both are infinite if the indenter goes deeper until the end. Depths are infinite below the known depth.
    """

    depth: np.ndarray
    moment: np.ndarray
    turning_depth: float = np.inf
    turning_moment: float = 0.0
    age: float = np.inf

    @property
    def turned(self):
        """Whether there is a turning point."""
        return self.age < np.inf


def _stretches(area, ds):
    """Return the first and last indices of the times between which f is one straight line."""
    slope = np.diff(area) / ds
    bend = np.abs(np.diff(slope)) * np.minimum(ds[1:], ds[:-1])
    bends = (1 + np.flatnonzero(bend > 1e-13 * np.max(area))).tolist()
    # A single time has no stretch.
    return list(pairwise([0, *bends, len(ds)])) if len(ds) else []


class _Point(NamedTuple):
    """A point of a stretch: time (τ) and ∫ d df (m³), both from the start of the stretch, and depth (m)."""

    time: float
    depth: float
    moment: float


class _Reached(NamedTuple):
    """Depths (m) and ∫ d df (m³) from the start of a stretch, at its first M places.

    If there is a turning point, the places end at it.
    """

    depth: np.ndarray
    moment: np.ndarray
    turn: _Point | None = None


@dataclass(frozen=True, eq=False)
class _Stretch:
    """The law of a growing depth while f (m²) goes linearly from `first` at 0 to `last` at the last place.

    `places` are the times (τ) of the depths, from the start of the stretch.
    """

    law: Loading
    first: float
    places: np.ndarray
    last: float

    @property
    def slope(self):
        """df/ds (m²)."""
        return (self.last - self.first) / self.places[-1]

    def solve(self, depth):
        """Return the `_Reached` depths after a first depth (m)."""
        limit, *_ = self.law.linear_part
        if depth >= limit:
            return self._integrated(_Point(0.0, depth, 0.0), self.places)
        linear, end = self._linear(depth)
        left = self.places[linear.depth.size :]
        if linear.turn is not None or not left.size or np.isinf(linear.depth).any():
            return linear
        later = self._integrated(end._replace(depth=limit), left)
        depths, moments = np.append(linear.depth, later.depth), np.append(linear.moment, later.moment)
        return _Reached(depths, moments, later.turn)

    def _linear(self, depth):
        """Return the `_Reached` depths while the law is linear, from a first depth (m), and its end point.

        The end point is the onset of yield, the turning point, or the last place.
        """
        _, limit, rate = self.law.linear_part
        start = float(self.law.elastic(depth)[0])
        end, turns, yields = self.places[-1], False, False
        if self.slope < 0:
            # dy/ds = f − rate y vanishes.
            turning_time = np.log1p(max((self.first - rate * start) * rate / -self.slope, 0.0)) / rate
            turns = turning_time < end
            end = min(end, turning_time)
        if self._y(end, start, rate) > limit:
            yields = True
            end = scipy.optimize.brentq(
                lambda s: self._y(s, start, rate) - limit, 0.0, end, xtol=1e-300, rtol=1e-15
            )
        places = self.places[self.places < end] if end < self.places[-1] else self.places
        asked = np.append(places, end)
        depths = self.law.depth_of(self._y(asked, start, rate))
        moments = self._moments(asked, start, rate)
        point = _Point(end, depths[-1], moments[-1])
        return _Reached(depths[:-1], moments[:-1], point if turns and not yields else None), point

    def _y(self, s, start, rate):
        """Return y (m²) at times s (τ) from its value at the start, with dy/ds = f − rate y."""
        x = rate * s
        return start * np.exp(-x) + s * (self.first * _relaxed(x) + self.slope * s * _ramped(x))

    def _moments(self, places, start, rate):
        """Return ∫ d df (m³) from the start of the stretch to places (τ), with y at the start and rate."""
        if self.slope == 0:
            return np.zeros(len(places))
        # d begins as a fractional power of the time.
        node, weight = gauss_legendre(_NODES)
        before = np.append(0.0, places[:-1])[:, None]
        s = before + (places[:, None] - before) * node**4
        weight = 4 * node**3 * weight * (places[:, None] - before)
        depth = self.law.depth_of(self._y(s, start, rate))
        # Below the known depth, an infinite depth may have the weight 0.
        with np.errstate(invalid="ignore"):
            return self.slope * np.cumsum(np.sum(weight * depth, axis=1))

    def _integrated(self, begin, places):
        """Return the `_Reached` depths at places (τ) after a `_Point`, by an integrator of SciPy.

        The integrated state is the depth in units of `bound`, and ∫ d df in units of bound · slope.
        """
        law, unit = self.law, self.law.bound
        known = law.rule.profile.known_depth

        def excess(s, state):
            """Return f − A (m²), zero at a turning point."""
            return self.first + self.slope * s - law.pressed(min(state[0] * unit, known))[0]

        def rates(s, state):
            area, radius = law.pressed(np.asarray(min(state[0] * unit, known)))
            return (self.first + self.slope * s - area) / radius / unit, state[0]

        start = np.array([begin.depth / unit, 0.0])
        if self.slope < 0 and excess(begin.time, start) <= 0:
            return _Reached(np.empty(0), np.empty(0), begin)
        excess.terminal, excess.direction = True, -1
        event = excess if self.slope < 0 else None
        span = begin.time, self.places[-1]
        solution = _integrate(rates, span, start, places, event, law.precision)
        moment_unit = max(unit, 1e-300) * self.slope
        depths, moments = np.reshape(solution.y, (2, -1)) * [[unit], [moment_unit]]
        depths = np.where(depths > known * (1 + 1e-9), np.inf, depths)
        moments += begin.moment
        if solution.status == 0:
            return _Reached(depths, moments)
        time, (share, integral) = solution.t_events[0][0], solution.y_events[0][0]
        before = np.asarray(solution.t) < time
        turn = _Point(time, share * unit, integral * moment_unit + begin.moment)
        return _Reached(depths[before], moments[before], turn)


def _integrate(rates, span, start, places, event, precision):
    """Integrate rates by SciPy over a span of times, at places in it, up to the zero of an event."""
    for method in ("LSODA", "Radau"):
        with warnings.catch_warnings():
            # LSODA stops with a warning when f and A agree to rounding; then Radau continues.
            warnings.simplefilter("ignore", UserWarning)
            solution = scipy.integrate.solve_ivp(
                rates, span, start, method, t_eval=places, events=event, rtol=precision,
                atol=[1e-2 * precision, 1e-2 * precision * max(span[1] - span[0], 1e-300)],
            )  # fmt: skip
        if solution.status >= 0:
            return solution
    raise MDRError(
        f"creep is not solved: {solution.message} (SciPy); check that times are in s and forces in N"
    )


def _relaxed(x):
    """Return (1 − e⁻ˣ)/x."""
    return np.where(x > 0, -np.expm1(-x) / np.where(x > 0, x, 1.0), 1.0)


def _ramped(x):
    """Return (x − 1 + e⁻ˣ)/x², by its series if the difference would cancel."""
    small, series = np.minimum(x, 1.0), np.zeros_like(x)
    for k in range(20, 1, -1):
        series = (1 - small * series) / k
    large = np.maximum(x, 1.0)
    return np.where(x < 1, series, (large + np.expm1(-large)) / large / large)
