"""Solution of the equation of motion, leg by leg, many impacts at once.

1. Loading and unloading are cut into legs at the depths where the motion is not smooth: where yield begins,
   and where either end of the live interval passes a kink of g.
2. A leg is a sequence of steps: in the depth while the depth changes faster, relative to itself, than the
   velocity, and in the velocity near the turning point. Each impact has step lengths of its own.
3. The last Legendre coefficients of a step are the estimate of its error, which sets the next length.
"""

from dataclasses import dataclass

import numpy as np

from ..contact.quadrature import kink_above
from ..numerics.stable import cube_way
from .collocation_steps import DepthCoordinate, DepthSteps, VelocitySteps
from .equation_of_motion import Loading, MotionState, Unloading

_MOST_STEPS = 3000


@dataclass(frozen=True)
class Solution:
    """States (N, 1) at turning point (infinite below the known depth) and end; steps with their impacts."""

    turning_point: MotionState
    end: MotionState
    loading: list
    unloading: list

    @property
    def max_deceleration(self):
        """The largest deceleration (m/s²) of each impact."""
        largest = np.zeros(len(self.end.time))
        for rows, step in self.loading:
            np.fmax.at(largest, rows, step.decelerations().max(axis=1))
        # Steps next to the largest value at a node may have a larger one in between.
        for rows, step in self.loading:
            near = np.flatnonzero(step.decelerations().max(axis=1) >= 0.98 * largest[rows])
            if near.size:
                np.maximum.at(largest, rows[near], step[near].largest_deceleration())
        return largest


def solve(bodies, tolerance=1e-5):
    """The `Solution` of impacts; the tolerance is that between nodes: at ends errors are far smaller."""
    turning_point, loading = _load(bodies, tolerance)
    end, unloading = _unload(bodies, turning_point, tolerance)
    return Solution(turning_point, end, loading, unloading)


def _load(bodies, tolerance):
    """State at the turning point (of infinite depth below the known depth), and the steps of loading."""
    profile, rule, imprint = bodies.profile, bodies.rule, bodies.imprint_depth
    onset = rule.penetration(imprint, imprint)
    equation, steps, zero = Loading(bodies), [], np.zeros_like(bodies.speed)
    state = MotionState(zero.copy(), bodies.speed.copy(), zero.copy(), zero.copy())
    kinks = [kink - imprint for kink in profile.kinks]
    end = np.broadcast_to(profile.known_depth - imprint, zero.shape)
    edges = np.array([onset, *kinks, *(rule.penetration(kink, imprint) for kink in profile.kinks)])
    edges = np.sort(np.where((edges > 0) & (edges < end), edges, end), axis=0)
    below = imprint - kink_above(profile, imprint)
    base, rows = zero, np.arange(zero.size)
    for edge in [*edges, end]:
        # Behind a kink the radius is a power of the distance from it, else of that from the kink above.
        root = np.cbrt(np.where((base == 0) | (base == onset), below, 0.0))
        coordinate, first = DepthCoordinate(base, root), cube_way(root, 0.65 * bodies.dry_penetration)
        first = np.minimum(first, coordinate.delta(edge))
        leg = _LoadingLeg(equation[rows], coordinate[rows], edge[rows], state[rows], first[rows])
        leg.run(tolerance, rows, steps)
        state.store(rows, leg.state)
        rows, base = rows[~leg.turned], edge
    state.depth[rows] = np.inf
    return state, steps


def _unload(bodies, turning_state, tolerance):
    """State at the loss of contact, and the steps of unloading."""
    profile, steps, zero = bodies.profile, [], np.zeros_like(bodies.speed)
    interval, _ = bodies.rule.loading(turning_state.depth, bodies.imprint_depth)
    equation = Unloading(bodies, interval.lower)
    state = MotionState(interval.length, zero.copy(), turning_state.time.copy(), turning_state.work.copy())
    below = interval.lower - kink_above(profile, interval.lower)
    for edge in [*(kink - interval.lower for kink in profile.kinks[::-1]), zero]:
        rows = np.flatnonzero(((edge >= 0) & (edge < state.depth) & (interval.upper < np.inf))[:, 0])
        root = np.cbrt(np.where(edge == 0, below, 0.0))
        leg = _UnloadingLeg(equation[rows], DepthCoordinate(edge, root)[rows], edge[rows], state[rows])
        leg.run(tolerance, rows, steps)
        state.store(rows, leg.state)
    return state, steps


class _Leg:
    """One leg of impacts, from a `state` to a depth `edge` (m) or to the turning point, one impact a row.

    Depths q are penetrations below the bottom of the imprint before on loading, and live depths on
    unloading. Steps in depth go by the coordinate δ of q, counted from the `base` of the
    `DepthCoordinate`; steps in velocity by v (m/s). The leg is where this state is kept, so that each
    step changes the rows of the impacts that take it:

    `state`
        Depth q (m), velocity (m/s), time (s) and work (m³) that are reached, of shape (N, 1).
    `delta`, `edge_delta`
        δ there, and δ of the edge (m^(1/3)): the end of a step in depth is known in it without rounding.
    `in_depth`
        Whether the last step that was tried was one in depth.
    `length`
        Largest length of the next step, in the variable of that last one: δ or v. Given up when the
        variable changes.
    `to_edge`
        Impacts that may take only steps in depth, up to the edge: one in velocity would pass it.
    `turned`
        Impacts that have reached the turning point.

    A subclass gives the sign of steps in depth, the kind of steps that run towards zero, the rounding by
    which a depth may pass the edge, and `_room`: the distance to the end, and the longest step.
    """

    def __init__(self, equation, coordinate, edge, state, first=np.inf):
        self.equation, self.coordinate, self.edge, self.state = equation, coordinate, edge, state
        self.edge_delta, self.delta = coordinate.delta(edge), coordinate.delta(state.depth)
        self.length = np.array(np.broadcast_to(first, edge.shape))
        self.in_depth = np.ones(len(edge), bool)
        self.to_edge, self.turned = np.zeros((2, len(edge)), bool)

    def run(self, tolerance, numbers, steps):
        """Moves all impacts to the end of the leg; notes their `numbers` and steps in `steps`."""
        rows = np.arange(len(self.edge))
        for _ in range(_MOST_STEPS):
            if not rows.size:
                return
            in_depth, room, longest = self._plan(rows)
            # A length is one of the variable of the last step.
            same = (in_depth == self.in_depth[rows])[:, None]
            self.length[rows] = np.where(same, np.minimum(self.length[rows], longest), longest)
            self.in_depth[rows] = in_depth
            arrived = np.zeros(rows.size, bool)
            for kind, chosen in ((DepthSteps, in_depth), (VelocitySteps, ~in_depth)):
                chosen = np.flatnonzero(chosen)
                if chosen.size:
                    step, good, arrived[chosen] = self._advance(kind, rows[chosen], room[chosen], tolerance)
                    if good.any():
                        steps.append((numbers[rows[chosen][good]], step[np.flatnonzero(good)]))
            self.turned[rows[arrived & ~in_depth]] = True
            rows = rows[~arrived]
        raise ValueError(f"no convergence in {_MOST_STEPS} steps of a motion; check mass, speed, viscosity")

    def _plan(self, rows):
        """Which impacts move in depth; distance to the end in their variable, and the longest step."""
        state, equation = self.state[rows], self.equation[rows]
        rate, acceleration, _ = equation.rates(*equation.load(state.depth), state.velocity)
        # In the depth while it changes faster, relative to itself, than the velocity.
        in_depth = np.abs(rate * state.velocity) > np.abs(acceleration * state.depth)
        in_depth |= self.to_edge[rows, None] | (self.delta[rows] == 0)
        room, longest = self._room(rows, in_depth, state.depth, state.velocity, np.abs(acceleration))
        return in_depth[:, 0], room, longest

    def _advance(self, kind, rows, room, tolerance):
        """Tries one step of each of some impacts: the steps, which are good, which end the leg."""
        last = (room <= 1.001 * self.length[rows])[:, 0]
        length = np.where(last[:, None], room, self.length[rows])
        state, in_depth = self.state[rows], kind is DepthSteps
        origin, sign = (self.delta[rows], self.depth_sign) if in_depth else (state.velocity, -1)
        step = kind(self.equation[rows], self.coordinate[rows], state, origin, sign * length)
        step, error = step.solved()
        end, edge = step.end(), self.edge[rows]
        # A body that turns round within a step in depth leaves no state at its end.
        error = np.where((state.velocity * end.velocity >= 0)[:, 0], error, np.inf)
        passed = (self.depth_sign * (end.depth - edge) > self.margin * edge)[:, 0] & (not in_depth)
        good = (error <= tolerance) & ~passed
        # Past the edge only the depth leads to it; but from rest the depth is no variable.
        self.to_edge[rows[passed & (error < 1e-3) & (state.velocity != 0)[:, 0]]] = True
        with np.errstate(divide="ignore"):
            factor = np.clip(0.9 * (tolerance / error) ** (1 / 30), 0.3, 3.0)
        factor[passed] = 0.3
        if kind is self.vanishing:
            # Steps shrink in proportion to the remainder.
            with np.errstate(invalid="ignore"):
                shrink = factor * (1 - length / room)[:, 0]
            factor = np.where(good, shrink, np.where(last, 0.85, factor))
        self.length[rows] = length * factor[:, None]
        taken, ended = rows[good], rows[good & last]
        self.state.store(taken, end[good])
        if in_depth:
            self.delta[taken] = (step.origin + step.length)[good]
            self.state.depth[ended] = self.edge[ended]
        else:
            self.delta[taken] = self.coordinate[taken].delta(end.depth[good])
        return step, good, good & last


class _LoadingLeg(_Leg):
    """A leg of loading: the depth grows, the velocity runs towards zero."""

    depth_sign, vanishing, margin = 1, VelocitySteps, 1e-12

    def _room(self, rows, in_depth, depth, velocity, deceleration):
        room = np.where(in_depth, self.edge_delta[rows] - self.delta[rows], velocity)
        # A part of the depth in which the present force would stop the body.
        with np.errstate(divide="ignore"):
            way = velocity**2 / (3 * deceleration)
        stop = self.coordinate[rows].delta(depth + way) - self.delta[rows]
        return room, np.where(in_depth & ~self.to_edge[rows, None], stop, room)


class _UnloadingLeg(_Leg):
    """A leg of unloading: the live depth shrinks towards `edge`, where the coordinate is 0."""

    depth_sign, vanishing, margin = -1, DepthSteps, 0.0

    def _room(self, rows, in_depth, depth, velocity, deceleration):
        room = np.where(in_depth, self.delta[rows], np.inf)
        # A part of the velocity that springs alone, or dashpots alone, would return.
        relaxation_time = self.equation.bodies.relaxation_time[rows]
        gain = 0.4 / (1 / np.sqrt(depth * deceleration) + relaxation_time / depth)
        return room, np.where(in_depth, room, gain)
