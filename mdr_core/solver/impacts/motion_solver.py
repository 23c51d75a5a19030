"""Solution of the equation of motion, leg by leg, many impacts at once.

1. Loading and unloading are cut into legs at the depths where the motion is not smooth: at the onset of
   yield, and where either end of the live interval passes a kink of g.
2. A leg is a sequence of steps. Steps are in the depth while the depth changes faster, relative to itself,
   than the velocity, and in the velocity near the turning point. Each impact has its own step lengths.
3. The last Legendre coefficients of a step estimate its error, which determines the next length.
"""

from dataclasses import dataclass, fields, replace
from enum import IntEnum

import numpy as np

from ...base.errors import MDRError
from ...base.results import Entries
from ..contact.quadrature import kink_above
from ..numerics.stable import cube_way
from .collocation_steps import DepthCoordinate, DepthSteps, VelocitySteps
from .equation_of_motion import ON_MEDIUM, Loading, MotionState, Unloading

#: Largest number of steps tried for one leg. Legs of impacts with τ from 10⁻⁴ to 10⁴ contact times take at
#: most 17. Under profiles r^0.02 to r^20, with τ from 10⁻⁶ to 10⁸ and the tolerance of a motion, at most
#: 92.
_MOST_STEPS = 500

# Shares of lengths. They determine the number of steps, not their accuracy: a step with a large error is
# shortened. Within the given ranges, impacts with the τ above take at most 5 % more steps.

#: First step in depth, over the largest penetration of the same impact without viscosity: 0.5 to 0.7.
_FIRST = 0.65
#: Longest step in depth on loading, over the stopping distance v²/(2|v̇|) at the present deceleration: 0.3
#: to 1.0.
_STOPPING = 2 / 3
#: Longest step in velocity on unloading, over the velocity that springs or dashpots alone would return: 0.3
#: to 0.7.
_RETURNED = 0.4
#: Next length, over the length at which the error is the tolerance: the usual safety factor, 0.82 to 0.92.
_SAFETY = 0.9
#: Assumed power of the length in the error, 28 to 50. Coefficients of degree 21 and more, times the length,
#: grow as its power 22 if the motion is smooth. They grow as 22/√(1 − s) for a step over the share s of the
#: depths up to a singular depth: 30 is s = 0.46.
_POWER = 30
#: Smallest ratio of the lengths of successive steps, and the inverse of the largest: 0.1 to 0.5.
_SHORTER = 0.3
#: Share of the room of a step towards zero to try if the whole room was too long: 0.82 to 0.88. A function
#: with a singularity at zero has Legendre coefficients ∝ ρ⁻ⁿ over the share s, with s = 4ρ/(1 + ρ)². For
#: 0.85 they are 2·10⁻⁸ at degree 22; for 0.93 they reach the tolerance of 10⁻⁵.
_AGAIN = 0.85
#: Live depth, over the live depth at the turning point, at which an endless motion is cut off.
_AT_REST = 1e-3
#: Square of the share of the critical damping from which the damped oscillator gives the end of a motion:
#: bodies return with less than 10⁻⁴⁰ of their speed. Live depth at this change, over the live depth at the
#: turning point; the contact is wider by it than at the end.
_NEARLY_CRITICAL = 0.999
_OSCILLATES = 1e-12
#: The largest deceleration is searched in steps that have this share of it at a node. Nodes are at most
#: 0.064 of a step apart: a peak as wide as a step has 0.996 at one of the nodes.
_NEAR = 0.98


@dataclass(frozen=True)
class Solution:
    """States (N, 1) of N impacts at the turning point and at the end, and their steps.

    The depth of a turning point below the known depth is infinite. `loading` and `unloading` are lists of
    pairs: the numbers of impacts, and their steps. `endless`, (N, 1), marks bodies that never leave.
    """

    turning_point: MotionState
    end: MotionState
    endless: np.ndarray
    loading: list
    unloading: list

    @property
    def max_deceleration(self):
        """Largest deceleration (m/s²) of each impact."""
        largest = np.zeros(len(self.end.time))
        for rows, step in self.loading:
            np.fmax.at(largest, rows, step.decelerations().max(axis=1))
        # Steps close to the largest value at a node may have a larger value between nodes.
        for rows, step in self.loading:
            near = np.flatnonzero(step.decelerations().max(axis=1) >= _NEAR * largest[rows])
            if near.size:
                np.maximum.at(largest, rows[near], step[near].largest_deceleration())
        return largest


class ConvergenceError(MDRError):
    """Error of impacts, at `rows`, whose motion has not ended after the largest number of steps."""

    def __init__(self, rows):
        super().__init__(rows)
        self.rows = rows

    def __str__(self):
        return f"a motion is not solved: it has not ended after {_MOST_STEPS} steps"


def solve(bodies, tolerance=1e-5, equations=ON_MEDIUM, to_rest=False):
    """Return the `Solution` of impacts by their equations of loading and of unloading.

    `tolerance` is the relative error of a step between its nodes; at its end the error is far smaller.
    Endless motions continue beyond the turning point only if `to_rest` is true.
    """
    on_loading, on_unloading = equations
    turning_point, loading = _load(bodies, tolerance, on_loading)
    end, endless, unloading = _unload(bodies, turning_point, tolerance, on_unloading, to_rest)
    return Solution(turning_point, end, endless, loading, unloading)


def _load(bodies, tolerance, equation_of):
    """Return the turning point, with infinite depth below the known depth, and the steps of loading."""
    profile, rule, imprint = bodies.profile, bodies.rule, bodies.imprint_depth
    breaks = rule.breaks(imprint, imprint + bodies.dry_penetration)
    equation, steps, zero = equation_of(bodies), [], np.zeros_like(bodies.speed)
    state = MotionState(zero, bodies.speed, zero, zero)
    end = np.broadcast_to(profile.known_depth - imprint, zero.shape)
    edges = np.hstack([breaks.onset, breaks.upper, breaks.lower])
    edges = np.sort(np.where((edges > 0) & (edges < end), edges, end), axis=1)
    below = imprint - kink_above(profile, imprint)
    base, rows = zero, np.arange(zero.size)
    for edge in [*edges.T[:, :, None], end]:
        # After a kink the radius is a power of the distance from it, else from the kink above.
        root = np.cbrt(np.where((base == 0) | (base == breaks.onset), below, 0.0))
        coordinate = DepthCoordinate(base, root)
        leg = _LoadingLeg(equation, coordinate, edge, coordinate.delta(edge))
        first = np.minimum(cube_way(root, _FIRST * bodies.dry_penetration), leg.edge_delta)
        ended, turned = leg.run(leg.from_states(state, rows, first), tolerance, steps)
        state = state.replaced(ended.row, ended.state)
        rows, base = np.sort(ended.row[~turned]), edge
    too_deep = replace(state[rows], depth=np.full((rows.size, 1), np.inf))
    return state.replaced(rows, too_deep), steps


def _unload(bodies, turning_state, tolerance, equation_of, to_rest):
    """Return the state at the loss of contact, a mask of endless motions, and the steps of unloading."""
    profile, steps, zero = bodies.profile, [], np.zeros_like(bodies.speed)
    interval, _ = bodies.rule.turning(turning_state.depth, bodies.imprint_depth)
    equation = equation_of(bodies, interval.lower)
    state = replace(turning_state, depth=interval.length, velocity=zero)
    radius = profile.radius_at(interval.lower)
    damping = equation.damping_share(radius)
    endless = damping >= 1
    oscillates = (damping > _NEARLY_CRITICAL) & ~endless
    last = np.where(endless, _AT_REST if to_rest else 1.0, np.where(oscillates, _OSCILLATES, 0.0))
    last = last * state.depth
    below = interval.lower - kink_above(profile, interval.lower)
    for edge in [*(np.maximum(kink - interval.lower, last) for kink in profile.kinks[::-1]), last]:
        rows = np.flatnonzero(((edge >= 0) & (edge < state.depth) & (interval.upper < np.inf))[:, 0])
        root = np.cbrt(np.where(edge == 0, below, 0.0))
        coordinate = DepthCoordinate(edge, root)
        leg = _UnloadingLeg(equation, coordinate, edge, coordinate.delta(edge))
        ended, _ = leg.run(leg.from_states(state, rows), tolerance, steps)
        state = state.replaced(ended.row, ended.state)
    if oscillates.any():
        rows = np.flatnonzero(oscillates[:, 0])
        state = state.replaced(rows, equation[rows].oscillated(state[rows], radius[rows]))
    return state, endless, steps


class _Outcome(IntEnum):
    """Outcome of a step for an impact."""

    #: The step is rejected, and a shorter step is tried.
    AGAIN = 0
    #: The impact continues from the end of the step.
    ON = 1
    #: The impact is at the end of the leg.
    ARRIVED = 2
    #: The impact is at the turning point.
    TURNED = 3


@dataclass(frozen=True)
class _Underway(Entries):
    """Impacts along a leg, at the end of their last steps: one impact per row of arrays (N, 1)."""

    #: Numbers of the impacts, of shape (N,): their rows in the arrays of the leg.
    row: np.ndarray
    #: Depth q (m), velocity (m/s), time (s) and work (m³).
    state: MotionState
    #: Coordinate δ (m^(1/3)) of the depth. A step in depth ends at an exact δ; from the depth it would have
    #: a rounding error.
    delta: np.ndarray
    #: Longest next step in depth, in δ (m^(1/3)); infinite after a step in velocity, and at first.
    depth_step: np.ndarray
    #: Longest next step in velocity (m/s); infinite after a step in depth, and at first.
    velocity_step: np.ndarray
    #: Whether only steps in depth remain up to the edge, because a step in velocity would pass it.
    depth_only: np.ndarray


@dataclass(frozen=True)
class _Leg(Entries):
    """One leg, up to a depth or to the turning point, with one impact per row of arrays (N, 1).

    Depths q are penetrations below the bottom of the earlier imprint on loading, and live depths on
    unloading. A step is in the depth or in the velocity. A step in depth uses the coordinate δ of q,
    counted from the `base` of the `DepthCoordinate`. A subclass limits the length of each kind of step.
    """

    equation: Loading | Unloading
    coordinate: DepthCoordinate
    #: Depth (m) at which the leg ends, and δ (m^(1/3)) there.
    edge: np.ndarray
    edge_delta: np.ndarray

    def from_states(self, state, rows, first=None):
        """Return the `_Underway` of impacts at some rows, from states and longest first steps in δ."""
        none = np.full((rows.size, 1), np.inf)
        delta = self.coordinate[rows].delta(state.depth[rows])
        first = none if first is None else first[rows]
        return _Underway(rows, state[rows], delta, first, none, np.zeros(none.shape, bool))

    def run(self, impacts, tolerance, steps):
        """Return the impacts at the end of the leg, and whether each has reached the turning point.

        It appends pairs to `steps`: the numbers of impacts, and their steps.
        """
        ended, turned = [impacts[:0]], [np.zeros(0, bool)]
        for _ in range(_MOST_STEPS):
            if not impacts.row.size:
                return _joined(ended), np.concatenate(turned)
            in_depth, deceleration = self._variable(impacts)
            going = []
            for chosen, advance in (in_depth, self._by_depth), (~in_depth, self._by_velocity):
                if not chosen.any():
                    continue
                after, step, outcome = advance(impacts[chosen], deceleration[chosen], tolerance)
                good, at_end = outcome > _Outcome.AGAIN, outcome > _Outcome.ON
                if good.any():
                    steps.append((after.row[good], step[np.flatnonzero(good)]))
                going.append(after[~at_end])
                ended.append(after[at_end])
                turned.append(outcome[at_end] == _Outcome.TURNED)
            impacts = _joined(going)
        raise ConvergenceError(impacts.row)

    def _variable(self, impacts):
        """Return whether each impact takes its next step in depth, (N,), and its deceleration (m/s²)."""
        state, equation = impacts.state, self.equation[impacts.row]
        rate, acceleration, _ = equation.rates(*equation.load(state.depth), state.velocity)
        # In the depth while it changes faster, relative to itself, than the velocity.
        in_depth = np.abs(rate * state.velocity) > np.abs(acceleration * state.depth)
        in_depth |= impacts.depth_only | (impacts.delta == 0)
        # On a plate, a returning body may get slower, but steps in velocity go to a faster velocity.
        in_depth |= (rate < 0) & (acceleration >= 0)
        return in_depth[:, 0], np.abs(acceleration)

    def _by_depth(self, impacts, deceleration, tolerance):
        """Try one step in depth of each impact.

        Return the impacts after the step (before it if it was rejected), the steps and the `_Outcome`.
        """
        leg, state = self[impacts.row], impacts.state
        room = self.depth_sign * (leg.edge_delta - impacts.delta)
        longest = np.where(impacts.depth_only, room, leg.longest_in_depth(impacts, room, deceleration))
        length, last = _length(room, np.minimum(impacts.depth_step, longest))
        change = self.depth_sign * length
        step, error = DepthSteps(leg.equation, leg.coordinate, state, impacts.delta, change).solved()
        end = step.end()
        good, factor = _judged(step, end, error, tolerance)
        if self.depth_vanishes:
            factor = _shrinking(factor, good, last, length, room)
        end = replace(end, depth=np.where(last, leg.edge, end.depth))
        after = _Underway(
            impacts.row,
            state=state.replaced(good[:, 0], end[good[:, 0]]),
            delta=np.where(good, impacts.delta + change, impacts.delta),
            depth_step=length * factor,
            velocity_step=np.full_like(length, np.inf),
            depth_only=impacts.depth_only,
        )
        return after, step, _outcome(good, last, _Outcome.ARRIVED)

    def _by_velocity(self, impacts, deceleration, tolerance):
        """Try one step in velocity of each impact; return the same as `_by_depth`."""
        leg, state = self[impacts.row], impacts.state
        room, longest = leg.room_in_velocity(impacts, deceleration)
        length, last = _length(room, np.minimum(impacts.velocity_step, longest))
        step, error = VelocitySteps(leg.equation, leg.coordinate, state, state.velocity, -length).solved()
        end = step.end()
        good, factor = _judged(step, end, error, tolerance)
        passed = self.depth_sign * (end.depth - leg.edge) > self.margin * leg.edge
        # A step that would pass the edge must be in depth, but from rest the depth is no variable.
        depth_only = good & passed & (state.velocity != 0)
        good &= ~passed
        factor = np.where(passed, _SHORTER, factor)
        if not self.depth_vanishes:
            factor = _shrinking(factor, good, last, length, room)
        after = _Underway(
            impacts.row,
            state=state.replaced(good[:, 0], end[good[:, 0]]),
            delta=np.where(good, leg.coordinate.delta(end.depth), impacts.delta),
            depth_step=np.full_like(length, np.inf),
            velocity_step=length * factor,
            depth_only=impacts.depth_only | depth_only,
        )
        # A step in velocity ends a leg only at zero velocity.
        return after, step, _outcome(good, last, _Outcome.TURNED)


class _LoadingLeg(_Leg):
    """A leg of loading: the depth grows, the velocity falls to zero at the turning point."""

    #: Direction of the depth, and whether the depth (or else the velocity) goes to zero.
    depth_sign = 1
    depth_vanishes = False
    #: Rounding by which a step in velocity may pass the edge, over its depth.
    margin = 1e-12

    def longest_in_depth(self, impacts, room, deceleration):
        """Return the longest step in δ (m^(1/3)): a share of the stopping distance at this force."""
        depth, velocity = impacts.state.depth, impacts.state.velocity
        with np.errstate(divide="ignore"):
            way = _STOPPING * velocity**2 / (2 * deceleration)
        return self.coordinate.delta(depth + way) - impacts.delta

    def room_in_velocity(self, impacts, deceleration):
        """Return the remaining velocity (m/s), and the longest step."""
        return impacts.state.velocity, impacts.state.velocity


class _UnloadingLeg(_Leg):
    """A leg of unloading: the live depth falls to the edge with δ = 0; the velocity is negative."""

    depth_sign = -1
    depth_vanishes = True
    margin = 0.0

    def longest_in_depth(self, impacts, room, deceleration):
        """Return the longest step in δ (m^(1/3)), up to the edge."""
        return room

    def room_in_velocity(self, impacts, deceleration):
        """Return the room in velocity, infinite because the leg ends at a depth, and the longest step.

        The longest step is a share of the velocity that springs alone, or dashpots alone, would return.
        """
        depth, relaxation_time = impacts.state.depth, self.equation.bodies.relaxation_time
        gain = _RETURNED / (1 / np.sqrt(depth * deceleration) + relaxation_time / depth)
        return np.full_like(gain, np.inf), gain


def _outcome(good, last, end):
    """Return the `_Outcome`, (N,), of steps (N, 1): `end` for good steps that took all of the room."""
    return np.select([~good[:, 0], last[:, 0]], [_Outcome.AGAIN, end], _Outcome.ON)


def _length(room, longest):
    """Return lengths of steps, at most `longest` and the room, and whether they take all of the room."""
    last = room <= longest
    return np.where(last, room, longest), last


def _judged(step, end, error, tolerance):
    """Return whether steps are good, and the ratio of the next length to their length, both (N, 1)."""
    # A body that turns within a step in depth has no state at its end.
    error = np.where(step.start.velocity * end.velocity >= 0, error[:, None], np.inf)
    with np.errstate(divide="ignore"):
        factor = np.clip(_SAFETY * (tolerance / error) ** (1 / _POWER), _SHORTER, 1 / _SHORTER)
    return error <= tolerance, factor


def _shrinking(factor, good, last, length, room):
    """Return `factor` for steps towards zero: a good step leaves less room and shortens the next step."""
    with np.errstate(invalid="ignore"):
        shrunk = factor * (1 - length / room)
    return np.where(good, shrunk, np.where(last, _AGAIN, factor))


def _joined(parts):
    """Join several `_Underway`."""
    if len(parts) == 1:
        return parts[0]
    state = MotionState(*(
        np.concatenate([getattr(part.state, field.name) for part in parts]) for field in fields(MotionState)
    ))  # fmt: skip
    names = [field.name for field in fields(_Underway) if field.name != "state"]
    return _Underway(state=state, **{n: np.concatenate([getattr(p, n) for p in parts]) for n in names})
