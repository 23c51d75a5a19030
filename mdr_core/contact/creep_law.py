"""Two scalar laws of creep: of an indenter that goes deeper, and of one that recedes.

With the contact radius a(s), f = F/(2E*), A = ∫ a ds over the live interval [d_p, D], and τ = 4η/E*:

    d grows      A + τ a ḋ = f, with D = d, on a virgin medium. In y = ∫ a ds from the tip to d this is
                 τ ẏ = f − A, which is linear as long as nothing yields.
    d falls      A = f, with D = d + τḋ, the height g at which elements are released, from the rim inward.
                 The edge of the contact follows the force at once, and the lead e = d − D of the indenter
                 over it obeys τ ė = −e − τ Ḋ. Released elements relax from the e of their release on, and
                 are not met again while the force does not rise.

The first law holds until f has fallen to A, the second one from there until the force rises. Times are in
units of τ, and f is linear between the given times.
"""

import warnings
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy

from ..numerics.gauss import gauss_legendre
from ..numerics.roots import increasing_root
from .integrals import integrals
from .live_interval import LiveInterval
from .loading import live_length
from .quadrature import nodes
from .yielding import YieldRule

#: Ages (τ) between which the memory of a retreating edge is integrated; what is older counts e⁻⁶⁴.
_AGES = np.array([0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0])
#: Share of the largest depth up to which the law of a sharp tip that yields from first touch is linear.
_TIP = 1e-6
#: Nodes of ∫ d df between two times while nothing yields.
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

    @cached_property
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
        depth, moment = np.full(len(self.area), np.inf), np.zeros(len(self.area))
        depth[0] = first
        for start, stop in _stretches(self.area, self.ds):
            stretch = _Stretch(self, self.area[start], np.cumsum(self.ds[start:stop]), self.area[stop])
            values, turn = stretch.solve(depth[start])
            last = start + values.shape[1]
            depth[start + 1 : last + 1] = values[0]
            moment[start + 1 : last + 1] = moment[start] + values[1]
            if turn is not None:
                place, turning_depth, turning_moment = turn
                age = place - np.append(0.0, stretch.places)[last - start]
                return Pressed(
                    depth[: last + 1],
                    moment[: last + 1],
                    turning_depth,
                    moment[start] + turning_moment,
                    age,
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


@dataclass(frozen=True, eq=False)
class _Stretch:
    """The law of a growing depth while f (m²) goes linearly from `first` at 0 to `last` at the last place.

    `places` are the times (τ) at which depths are asked for.
    """

    law: Loading
    first: float
    places: np.ndarray
    last: float

    @cached_property
    def slope(self):
        return (self.last - self.first) / self.places[-1]

    def solve(self, depth):
        """Depths (m) and ∫ d df (m³) at the places, shape (2, N), and at the turning point, or None.

        Of a turning point, at which the places end, also its place (τ).
        """
        limit, *_ = self.law.linear_part
        values, begin, turn = np.empty((2, 0)), 0.0, None
        moment = 0.0
        if depth < limit:
            values, turn, begin, moment = self._linear(depth)
            depth = limit
        if turn is None and values.shape[1] < len(self.places) and not np.isinf(values).any():
            later, turn = self._integrated(begin, depth, self.places[values.shape[1] :])
            later[1] += moment
            values = np.hstack([values, later])
            turn = turn and (*turn[:2], turn[2] + moment)
        return values, turn

    def _linear(self, depth):
        """Depths and moments while the law is linear; the turning point; where the law ends, and there."""
        _, limit, rate = self.law.linear_part
        start, end = float(self.law.elastic(depth)[0]), self.places[-1]
        turn = yielding = np.inf
        if self.slope < 0:
            turn = np.log1p(max((self.first - rate * start) * rate / -self.slope, 0.0)) / rate
        end = min(end, turn)
        if self._y(end, start, rate) > limit:
            yielding = scipy.optimize.brentq(
                lambda s: self._y(s, start, rate) - limit, 0.0, end, xtol=1e-300, rtol=1e-15
            )
            end = yielding
        places = self.places[self.places < end] if end < self.places[-1] else self.places
        asked = np.append(places, end)
        depths = self.law.depth_of(self._y(asked, start, rate))
        moments = self._moments(asked, start, rate)
        values = np.array([depths[:-1], moments[:-1]])
        if yielding <= end:
            return values, None, yielding, moments[-1]
        turned = turn < self.places[-1]
        return values, (turn, depths[-1], moments[-1]) if turned else None, end, moments[-1]

    def _y(self, s, start, rate):
        """y (m²) at times s (τ) from its value at the start, with dy/ds = f − rate y."""
        x = rate * s
        return start * np.exp(-x) + s * (self.first * _relaxed(x) + self.slope * s * _ramped(x))

    def _moments(self, places, start, rate):
        """∫ d df (m³) from the start of the stretch to places (τ)."""
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

    def _integrated(self, begin, depth, places):
        """Depths and moments at places (τ) by an integrator of SciPy, from one on; the turning point."""
        law, unit = self.law, self.law.bound
        known = law.rule.profile.known_depth

        def excess(s, state):
            """f − A (m²)."""
            return self.first + self.slope * s - law.pressed(min(state[0] * unit, known))[0]

        def rates(s, state):
            area, radius = law.pressed(np.asarray(min(state[0] * unit, known)))
            return (self.first + self.slope * s - area) / radius / unit, state[0]

        start = np.array([depth / unit, 0.0])
        if self.slope < 0 and excess(begin, start) <= 0:
            return np.empty((2, 0)), (begin, depth, 0.0)
        excess.terminal, excess.direction = True, -1
        events = excess if self.slope < 0 else None
        span, precision = (begin, self.places[-1]), law.precision
        moment = max(unit, 1e-300) * self.slope
        for method in ("LSODA", "Radau"):
            with warnings.catch_warnings():
                # LSODA gives up in a warning where f and A agree to rounding, and Radau goes on.
                warnings.simplefilter("ignore", UserWarning)
                solution = scipy.integrate.solve_ivp(
                    rates, span, start, method, t_eval=places, events=events, rtol=precision,
                    atol=[1e-2 * precision, 1e-2 * precision * max(span[1] - begin, 1e-300)],
                )  # fmt: skip
            if solution.status >= 0:
                break
        else:
            raise ValueError(f"creep was not integrated: {solution.message}; check the units of the times")
        values = np.reshape(solution.y, (2, -1)) * [[unit], [moment]]
        values[0] = np.where(values[0] > known * (1 + 1e-9), np.inf, values[0])
        if solution.status == 0:
            return values, None
        place, (share, integral) = solution.t_events[0][0], solution.y_events[0][0]
        return values[:, np.asarray(solution.t) < place], (place, share * unit, integral * moment)


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


@dataclass(frozen=True, eq=False)
class Retreat:
    """The law of a falling depth from a turning point on, with states at times of `area` f (m²).

    The first state is the turning point. `interval` is its live interval, `ds` (τ) the times between the
    states; `count` is the number of Gauss nodes in each piece.
    """

    rule: YieldRule
    interval: LiveInterval
    area: np.ndarray
    ds: np.ndarray
    count: int

    @cached_property
    def length(self):
        """D − d_p (m) of the states."""
        return self._lengths(self.area)

    @property
    def depth(self):
        """Depths d (m) of the states."""
        return self.interval.lower + (self.length + self.states[0])

    def _lengths(self, area):
        return live_length(self.rule.profile, self.interval, area)

    @cached_property
    def fall(self):
        """−df/ds (m²) between the states."""
        return -np.diff(self.area) / self.ds

    @cached_property
    def _edges(self):
        """D − d_p (m) at the `_AGES` before each state but the first."""
        ages = np.minimum(_AGES, self.ds[:, None])
        edges = self._lengths(
            np.minimum(self.area[1:, None] + self.fall[:, None] * ages, self.area[:-1, None])
        )
        edges = np.where(ages < self.ds[:, None], edges, self.length[:-1, None])
        edges[:, 0] = self.length[1:]
        return np.maximum.accumulate(edges, axis=1)

    def _memory(self, k, low):
        """∫ e⁻ᵛ dD, ∫ e⁻ᵛ (1 − e⁻ᵛ) dD and ∫ (1 − e⁻ᵛ) dD (m), shape (3, M), up to state k + 1.

        From D − d_p = `low` (m), shape (M,), upward; D was there v = (A(D) − f)/(−df/ds) before.
        """
        start = np.maximum(self._edges[k, :-1], low[:, None])
        stop = np.broadcast_to(self._edges[k, 1:], start.shape)
        row, piece = np.nonzero(stop > start)
        result = np.zeros((3, low.size))
        # Older than the last of the ages.
        result[2] = self.length[k] - np.maximum(self._edges[k, -1], low)
        if not row.size:
            return result
        start, stop, lower = start[row, piece], stop[row, piece], self.interval.lower
        length, weight = nodes(start, stop, lower + start, gauss_legendre(self.count))
        area = integrals(self.rule.profile).radius_integral(LiveInterval.above(lower, length))
        age = np.maximum(area - self.area[k + 1], 0.0) / self.fall[k]
        share, faded = weight * np.exp(-age), -np.expm1(-age)
        for sums, values in zip(result, (share, share * faded, weight * faded), strict=True):
            sums += np.bincount(row, values.sum(axis=1), minlength=low.size)
        return result

    @cached_property
    def states(self):
        """e (m), R (m³) and work of the dashpots over 2E* (m³) of the states, shape (3, N).

        E* R is the energy e² a E* of the contact that e adds beside 2E* (∫ (D − s) a ds + e A), and that of
        the elements that were released: dR/ds = −2R + 2e(−df/ds), and the dashpots take 2 · E* R ds.
        """
        states = np.zeros((3, len(self.area)))
        for k, (ds, fall) in enumerate(zip(self.ds, self.fall, strict=True)):
            lead, remainder, work = states[:, k]
            decay, passed = np.exp(-ds), -np.expm1(-ds)
            memory, released, followed = self._memory(k, self.length[k + 1 : k + 2])[:, 0]
            later = remainder * decay**2 + 2 * fall * (lead * decay * passed + released)
            # ∫ e ds, by which the indenter goes back.
            travel = lead * passed + followed
            taken = np.maximum((remainder - later) / 2 + fall * travel, 0.0)
            states[:, k + 1] = lead * decay + memory, later, work + taken
        return states

    def released(self, height):
        """Compressions (m) of released elements of reduced heights g (m) in all states, shape (N, M)."""
        place, result = height - self.interval.lower, np.zeros((len(self.area), height.size))
        for k, ds in enumerate(self.ds):
            decay, lead = np.exp(-ds), self.states[0, k]
            free = place >= self.length[k]
            result[k + 1, free] = result[k, free] * decay
            # Less those that had never been in contact.
            now = np.flatnonzero(~free & (place >= self.length[k + 1]))
            if now.size:
                result[k + 1, now] = lead * decay + self._memory(k, place[now])[0]
        return result
