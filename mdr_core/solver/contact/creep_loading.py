"""The scalar law of creep of an indenter that goes deeper.

With the contact radius a(s), f = F/(2E*), and A = ∫ a ds over the live interval [d_p, d], on a virgin
medium,

    A + τ a ḋ = f     until f has fallen to A.

In y = ∫ a ds from the tip to d this is τ ẏ = f − A, which is linear as long as nothing yields. Times are in
units of τ, and f is linear between the given times.
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

#: Share of the largest depth up to which the law of a sharp tip that yields from first touch is linear: the
#: tip is a cone there, for which, under a constant hardness, A/y is the same at every depth.
_TIP = 1e-6
#: Nodes of ∫ d df between two times while nothing yields. The work of the dashpots then has errors of
#: 4·10⁻¹² at most, with 8 nodes 4·10⁻⁹: measured by `python -m tests.benchmarks.constants`.
_NODES = 12


@dataclass(frozen=True, eq=False)
class Loading:
    """The law of a growing depth under f (m²), linear over intervals `ds` (τ) of time.

    `bound` is a depth (m) that is not exceeded, `onset` (m) that of yield, `precision` the relative one of
    the integrator.
    """

    rule: YieldRule
    area: np.ndarray
    ds: np.ndarray
    bound: float
    onset: float
    precision: float

    def pressed(self, depth):
        """A (m²) and a (m) on a first loading to depths (m)."""
        interval, _ = self.rule.loading(depth)
        return integrals(self.rule.profile).radius_integral(interval), self.rule.profile.radius_at(depth)

    def elastic(self, depth):
        """∫ a ds (m²) from the tip to depths (m), and a (m)."""
        interval = LiveInterval.elastic(np.asarray(depth, dtype=float))
        return integrals(self.rule.profile).radius_integral(interval), self.rule.profile.radius_at(depth)

    def depth_of(self, y):
        """Depths (m) at which ∫ a ds from the tip has values y (m²); infinite below the known depth."""
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
        """The `Pressed` depths that follow on a first depth (m)."""
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
        # An integrator's depths may fall by rounding.
        return Pressed(np.maximum.accumulate(depth), moment)


@dataclass(frozen=True, eq=False)
class Pressed:
    """Depths (m) at the times up to the turning point, and ∫ d df (m³) from the first time on.

    The turning point has the depth `turning_depth`, infinite if the indenter goes deeper to the end, and
    the time `age` (τ) after the last of these times. Depths are infinite below the known depth.
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
    """First and last numbers of the times between which f is one straight line."""
    slope = np.diff(area) / ds
    bend = np.abs(np.diff(slope)) * np.minimum(ds[1:], ds[:-1])
    ends = [0, *(1 + np.flatnonzero(bend > 1e-13 * np.max(area))).tolist(), len(ds)]
    return list(pairwise(ends))


class _Point(NamedTuple):
    """A point of a stretch: time (τ) and ∫ d df (m³), both from the start of the stretch, and depth (m)."""

    time: float
    depth: float
    moment: float


class _Reached(NamedTuple):
    """Depths (m) and ∫ d df (m³) from the start of a stretch, at the first M of its places.

    If there is a turning point, the places end at it.
    """

    depth: np.ndarray
    moment: np.ndarray
    turn: _Point | None = None


@dataclass(frozen=True, eq=False)
class _Stretch:
    """The law of a growing depth while f (m²) goes linearly from `first` at 0 to `last` at the last place.

    `places` are the times (τ), from the start of the stretch, at which depths are asked for.
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
        """What is `_Reached` from a first depth (m)."""
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
        """What is `_Reached` while the law is linear, from a first depth (m), and the point where it ends.

        That is where yield begins, the turning point, or the last place.
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
        """y (m²) at times s (τ) from its value at the start, with dy/ds = f − rate y."""
        x = rate * s
        return start * np.exp(-x) + s * (self.first * _relaxed(x) + self.slope * s * _ramped(x))

    def _moments(self, places, start, rate):
        """∫ d df (m³) from the start of the stretch to places (τ), from y at the start and its rate."""
        if self.slope == 0:
            return np.zeros(len(places))
        # From the start on d goes as a fractional power.
        node, weight = gauss_legendre(_NODES)
        before = np.append(0.0, places[:-1])[:, None]
        s = before + (places[:, None] - before) * node**4
        weight = 4 * node**3 * weight * (places[:, None] - before)
        depth = self.law.depth_of(self._y(s, start, rate))
        # Below the known depth an infinite depth may have no weight.
        with np.errstate(invalid="ignore"):
            return self.slope * np.cumsum(np.sum(weight * depth, axis=1))

    def _integrated(self, begin, places):
        """What is `_Reached` at places (τ) behind a `_Point`, by an integrator of SciPy.

        Its state is the depth in units of the `bound`, and ∫ d df in units of bound · slope.
        """
        law, unit = self.law, self.law.bound
        known = law.rule.profile.known_depth

        def excess(s, state):
            """f − A (m²), zero at a turning point."""
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
    """SciPy's solution of the rates over a span of times, at places in it, up to the zero of an event."""
    for method in ("LSODA", "Radau"):
        with warnings.catch_warnings():
            # LSODA gives up in a warning where f and A agree to rounding, and Radau goes on.
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
    """(1 − e⁻ˣ)/x."""
    return np.where(x > 0, -np.expm1(-x) / np.where(x > 0, x, 1.0), 1.0)


def _ramped(x):
    """(x − 1 + e⁻ˣ)/x², by its series where the difference would cancel."""
    small, series = np.minimum(x, 1.0), np.zeros_like(x)
    for k in range(20, 1, -1):
        series = (1 - small * series) / k
    large = np.maximum(x, 1.0)
    return np.where(x < 1, series, (large + np.expm1(-large)) / large / large)
