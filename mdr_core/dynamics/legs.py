"""Solution of the equation of motion, leg by leg, many impacts at once.

1. Loading and unloading are cut into legs at the depths where the motion is not smooth: where yield begins,
   and where either end of the live interval passes a kink of g.
2. A leg is a sequence of steps: in the depth while the depth changes faster, relative to itself, than the
   velocity, and in the velocity near the turning point. Each impact has step lengths of its own.
3. The last Legendre coefficients of a step are the estimate of its error: they accept or refuse the step,
   and set the length of the next one.
4. The force is largest on loading: it is searched for next to the node where it is largest.
"""

from dataclasses import dataclass

import numpy as np

from .._numeric import cube_way
from .energy_balance import loading_interval
from .equation_of_motion import Loading, MotionState, Unloading
from .steps import DepthCoordinate, DepthSteps, VelocitySteps

#: Relative error of a step from its last coefficients; at the ends of steps the error is far smaller.
TOLERANCE = 1e-5
_MOST_STEPS = 3000


@dataclass(frozen=True)
class Solution:
    """The end of each impact, one entry each, and the steps of loading and unloading with their impacts.

    Penetration y at the turning point (m), infinite where it exceeds the known depth; velocity (m/s) and
    time (s) at the loss of contact, viscous work over 2E* (m³), largest deceleration (m/s²).
    """

    penetration: np.ndarray
    velocity: np.ndarray
    time: np.ndarray
    work: np.ndarray
    max_deceleration: np.ndarray
    loading: list
    unloading: list


def solve(bodies, tolerance=TOLERANCE):
    """The `Solution` of impacts, from first contact to the loss of contact."""
    # A step that is too long may leave double precision; it is then repeated, shorter.
    with np.errstate(all="ignore"):
        turning_state, loading = _load(bodies, tolerance)
        end, unloading = _unload(bodies, turning_state, tolerance)
        return Solution(
            penetration=turning_state.depth[:, 0],
            velocity=end.velocity[:, 0],
            time=end.time[:, 0],
            work=end.work[:, 0],
            max_deceleration=_largest_deceleration(bodies.speed.size, loading),
            loading=loading,
            unloading=unloading,
        )


def _load(bodies, tolerance):
    """State at the turning point (its depth infinite beyond the known one), and the steps of loading."""
    profile, imprint, d_c = bodies.profile, bodies.imprint_depth, bodies.critical_depth
    equation, steps, zero = Loading(bodies), [], np.zeros_like(bodies.speed)
    state = MotionState(zero.copy(), bodies.speed.copy(), zero.copy(), zero.copy())
    kinks = [kink - imprint for kink in profile.kinks]
    end = np.broadcast_to(profile.known_depth - imprint, zero.shape)
    edges = np.array([d_c, *kinks, *(kink + d_c for kink in kinks)])
    edges = np.sort(np.where((edges > 0) & (edges < end), edges, end), axis=0)
    below = imprint - profile._kink_above(imprint)
    base, rows = zero, np.arange(zero.size)
    for edge in [*edges, end]:
        # Behind a kink the radius is a power of the distance from it, else of that from the kink above.
        root = np.cbrt(np.where((base == 0) | (base == d_c), below, 0.0))
        leg = _LoadingLeg(
            equation.rows(rows), DepthCoordinate(base, root).rows(rows), edge[rows], state.rows(rows)
        )
        leg.length = np.minimum(cube_way(root, 0.65 * bodies.dry_penetration)[rows], leg.edge_delta)
        leg.run(tolerance, rows, steps)
        state.store(rows, leg.state)
        rows, base = rows[~leg.turned], edge
    state.depth[rows] = np.inf
    return state, steps


def _unload(bodies, turning_state, tolerance):
    """State at the loss of contact, and the steps of unloading."""
    profile, steps, zero = bodies.profile, [], np.zeros_like(bodies.speed)
    interval, _ = loading_interval(turning_state.depth, bodies.critical_depth, bodies.imprint_depth)
    equation = Unloading(bodies, interval.lower)
    state = MotionState(interval.length, zero.copy(), turning_state.time.copy(), turning_state.work.copy())
    below = interval.lower - profile._kink_above(interval.lower)
    for edge in [*(kink - interval.lower for kink in profile.kinks[::-1]), zero]:
        rows = np.flatnonzero(((edge >= 0) & (edge < state.depth) & (interval.upper < np.inf))[:, 0])
        root = np.cbrt(np.where(edge == 0, below, 0.0))
        coordinate = DepthCoordinate(edge, root).rows(rows)
        leg = _UnloadingLeg(equation.rows(rows), coordinate, edge[rows], state.rows(rows))
        leg.run(tolerance, rows, steps)
        state.store(rows, leg.state)
    return state, steps


def _largest_deceleration(count, steps):
    """The largest deceleration (m/s²) of each impact, from steps of any length."""
    largest = np.zeros(count)
    for rows, step in steps:
        np.fmax.at(largest, rows, step.decelerations().max(axis=1))
    # Steps next to the largest value at a node may have a larger one in between.
    for rows, step in steps:
        near = np.flatnonzero(step.decelerations().max(axis=1) >= 0.98 * largest[rows])
        if near.size:
            np.maximum.at(largest, rows[near], step.rows(near).largest_deceleration())
    return largest


class _Leg:
    """One leg of impacts, from a `state` to a depth `edge` (m) or to the turning point, one impact a row.

    A subclass is of loading or of unloading: the sign of its steps in depth, the kind of steps that run
    towards zero, and `_plan`.
    """

    depth_sign: int
    vanishing: type

    def __init__(self, equation, coordinate, edge, state):
        self.equation, self.coordinate, self.edge, self.state = equation, coordinate, edge, state
        self.edge_delta, self.delta = coordinate.delta(edge), coordinate.delta(state.depth)
        self.length = np.full_like(edge, np.inf)
        self.in_depth = np.ones(len(edge), bool)
        #: Impacts that have to move in depth up to the edge, and those that have turned round.
        self.to_edge, self.turned = np.zeros((2, len(edge)), bool)

    def run(self, tolerance, numbers, steps):
        """Moves all impacts to the end of the leg; notes their `numbers` and steps in `steps`."""
        rows = np.arange(len(self.edge))
        for _ in range(_MOST_STEPS):
            if not rows.size:
                return
            in_depth, room, longest = self._plan(rows)
            # The length of the last step tells nothing about a step in the other variable.
            same = (in_depth == self.in_depth[rows])[:, None]
            self.length[rows] = np.where(same, np.minimum(self.length[rows], longest), longest)
            self.in_depth[rows] = in_depth
            arrived = np.zeros(rows.size, bool)
            for kind, chosen in ((DepthSteps, in_depth), (VelocitySteps, ~in_depth)):
                chosen = np.flatnonzero(chosen)
                if chosen.size:
                    step, good, arrived[chosen] = self._advance(kind, rows[chosen], room[chosen], tolerance)
                    if good.any():
                        steps.append((numbers[rows[chosen][good]], step.rows(np.flatnonzero(good))))
            self.turned[rows[arrived & ~in_depth]] = True
            rows = rows[~arrived]
        raise ValueError(f"no convergence in {_MOST_STEPS} steps of a motion; check mass, speed, viscosity")

    def _rates(self, rows):
        """Present depths and velocities of some impacts (m, m/s), and their `Rates`."""
        state, equation = self.state.rows(rows), self.equation.rows(rows)
        return state.depth, state.velocity, equation.rates(*equation.load(state.depth), state.velocity)

    def _advance(self, kind, rows, room, tolerance):
        """Tries one step of each of some impacts: the steps, which are good, which end the leg."""
        last = (room <= 1.001 * self.length[rows])[:, 0]
        length = np.where(last[:, None], room, self.length[rows])
        step, error = self._solved(kind, rows, length)
        end = step.end()
        # A body that turns round within a step in depth leaves no state at its end.
        error = np.where((step.start.velocity * end.velocity >= 0)[:, 0], error, np.inf)
        passed = self._passes_edge(kind, rows, end.depth)
        good = (error <= tolerance) & ~passed
        # Past the edge only the depth leads to it; but from rest the depth is no variable.
        self.to_edge[rows[passed & (error < 1e-3) & (step.start.velocity != 0)[:, 0]]] = True
        factor = np.clip(0.9 * (tolerance / error) ** (1 / 30), 0.3, 3.0)
        factor[passed] = 0.3
        if kind is self.vanishing:
            # What remains shrinks, and the steps in proportion to it.
            factor = np.where(good, factor * (1 - length / room)[:, 0], np.where(last, 0.85, factor))
        self.length[rows] = length * factor[:, None]
        taken, ended = rows[good], rows[good & last]
        self.state.store(taken, end.rows(good))
        if kind is DepthSteps:
            self.delta[taken] = (step.origin + step.length)[good]
            self.state.depth[ended] = self.edge[ended]
        else:
            self.delta[taken] = self.coordinate.rows(taken).delta(end.depth[good])
        return step, good, good & last

    def _solved(self, kind, rows, length):
        """Steps of a length in their variable, and their errors."""
        state = self.state.rows(rows)
        if kind is DepthSteps:
            origin, length = self.delta[rows], self.depth_sign * length
        else:
            origin, length = state.velocity, -length
        return kind(self.equation.rows(rows), self.coordinate.rows(rows), state, origin, length).solved()

    def _passes_edge(self, kind, rows, depth):
        """Whether steps end behind the edge, up to rounding; steps in depth end on it."""
        if kind is DepthSteps:
            return np.zeros(rows.size, bool)
        edge = self.edge[rows]
        return (self.depth_sign * (depth - edge) > (1e-12 * edge if self.depth_sign > 0 else 0.0))[:, 0]


class _LoadingLeg(_Leg):
    """A leg of loading: the depth grows, the velocity runs towards zero."""

    depth_sign, vanishing = 1, VelocitySteps

    def _plan(self, rows):
        """Which impacts move in depth; distance to the end in their variable, and the longest step."""
        depth, velocity, rates = self._rates(rows)
        to_edge, delta, coordinate = self.to_edge[rows, None], self.delta[rows], self.coordinate.rows(rows)
        # In the depth while it changes faster, relative to itself, than the velocity.
        in_depth = np.abs(rates.depth * velocity) > np.abs(rates.velocity * depth)
        in_depth |= to_edge | (delta == 0)
        room = np.where(in_depth, self.edge_delta[rows] - delta, velocity)
        # A part of the depth in which the present force would stop the body.
        stop = coordinate.delta(depth + velocity**2 / (3 * np.abs(rates.velocity))) - delta
        return in_depth[:, 0], room, np.where(in_depth & ~to_edge, stop, room)


class _UnloadingLeg(_Leg):
    """A leg of unloading: the live depth shrinks towards `edge`, where the coordinate is 0."""

    depth_sign, vanishing = -1, DepthSteps

    def _plan(self, rows):
        """Which impacts move in depth; distance to the end in their variable, and the longest step."""
        depth, velocity, rates = self._rates(rows)
        in_depth = np.abs(rates.depth * velocity) > np.abs(rates.velocity * depth)
        in_depth |= self.to_edge[rows, None]
        # A part of the velocity that springs alone, or dashpots alone, would return.
        relaxation_time = self.equation.bodies.rows(rows).relaxation_time
        gain = 0.4 / (1 / np.sqrt(np.abs(depth * rates.velocity)) + relaxation_time / depth)
        room = np.where(in_depth, self.delta[rows], np.inf)
        return in_depth[:, 0], room, np.where(in_depth, room, gain)
