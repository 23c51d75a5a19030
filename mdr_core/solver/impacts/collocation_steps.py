"""Steps of an equation of motion by collocation, in the depth or in the velocity, many impacts at once.

The unknown of a step is the velocity as a function of the depth, or near the turning point the depth as a
function of the velocity. Every step ends at a known depth or velocity. The unknown is a polynomial through
24 Gauss nodes, found by Newton's method. Time and viscous work are integrals over the step.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...base.results import Entries
from ..numerics.gauss import gauss_integrals, gauss_legendre
from ..numerics.roots import largest_value
from ..numerics.stable import cube_rise, cube_way
from .equation_of_motion import Equation, MotionState

_NODES, _WEIGHTS = gauss_legendre(24)
#: Matrices from values at the nodes to the integrals up to them, and to the last three Legendre
#: coefficients of the polynomial.
_INTEGRATE, _ONE = gauss_integrals(24, _NODES), np.eye(24)
_LAST = np.polynomial.legendre.legvander(2 * _NODES - 1, 23)[:, -3:] * _WEIGHTS[:, None]
_LAST = _LAST * (2 * np.arange(21, 24) + 1)


@dataclass(frozen=True)
class DepthCoordinate(Entries):
    """Coordinate δ of depths q = base + (root + δ)³ − root³ (m), one impact per row of (N, 1).

    After a kink or vertex a(s) is a fractional power of the distance (root³ at `base`), but smooth in δ.
    """

    base: np.ndarray
    root: np.ndarray

    def depth(self, delta):
        """Return the depths (m) at coordinates."""
        return self.base + cube_rise(self.root, delta)

    def delta(self, depth):
        """Return the coordinates of depths (m)."""
        # Both are infinite below the known depth.
        with np.errstate(invalid="ignore"):
            return cube_way(self.root, depth - self.base)


@dataclass(frozen=True)
class Steps(Entries):
    """Steps of impacts, one per row, from states `start`: base class of steps in depth and in velocity.

    The variable of a step goes from `origin` by `length` (N, 1). `slopes` (N, 3, 24) are the rates of the
    unknown, of time and of work at the nodes.
    """

    equation: Equation
    coordinate: DepthCoordinate
    start: MotionState
    origin: np.ndarray
    length: np.ndarray
    slopes: np.ndarray | None = None

    def at(self, share):
        """Return the `MotionState` at shares of the steps, of shape (N, K)."""
        matrix = gauss_integrals(_NODES.size, share.ravel()).reshape(*share.shape, -1)
        return self.state(share, np.einsum("nkj,nsj->snk", matrix, self.slopes))

    def end(self):
        """Return the `MotionState` at the ends (N, 1), which is more accurate than between the nodes."""
        return self.state(1.0, (self.slopes @ _WEIGHTS).T[..., None])

    def state(self, share, integrals):
        """Return the `MotionState` at shares of the steps, from the integrals of `slopes` up to there."""
        change, time, work = self.length * integrals
        depth, velocity = self._depth_and_velocity(self.origin + self.length * share, change)
        return MotionState(depth, velocity, self.start.time + time, self.start.work + work)

    def solved(self):
        """Return the steps with their slopes, and their estimated relative errors, infinite if unsolved."""
        slopes = self._slopes(self.origin + self.length * _NODES)

        def slope_and_jacobian(unknown):
            (slope, _, _), jacobian = slopes(unknown)
            return slope, jacobian

        unknown, settled = _collocate(slope_and_jacobian, self._first_unknown(), self.length)
        step = replace(self, slopes=np.stack(slopes(unknown)[0], axis=1))
        end, bodies = step.end(), self.equation.bodies
        # A work near zero is compared with a part of the kinetic energy.
        work = np.abs(end.work) + 1e-3 * bodies.inertia * bodies.speed**2
        size = np.hstack([self._size(end), np.abs(end.time), work])
        with np.errstate(all="ignore"):
            error = np.max(_last_coefficient(step.slopes) * np.abs(self.length) / size, axis=1)
        return step, np.where(settled & (error < np.inf), error, np.inf)

    def largest_deceleration(self):
        """Return the largest deceleration (m/s²) within each step, next to the node where it is largest."""

        def deceleration(share):
            state = self.at(share)
            _, acceleration, _ = self.equation.rates(*self.equation.load(state.depth), state.velocity)
            return -acceleration

        best, edges = self.decelerations().argmax(axis=1), np.array([0.0, *_NODES, 1.0])
        return largest_value(deceleration, edges[best, None], edges[best + 2, None])


class DepthSteps(Steps):
    """Steps in the coordinate δ of the depth, with the velocity as their unknown."""

    def _first_unknown(self):
        return self.start.velocity

    def _size(self, end):
        # A velocity that falls to zero is compared with a part of the first velocity.
        return np.abs(end.velocity) + np.abs(self.start.velocity) / 10

    def _depth_and_velocity(self, delta, change):
        return self.coordinate.depth(delta), self.start.velocity + change

    def _slopes(self, delta):
        """Return a function from the unknown to slopes of unknown, time, work and ∂(first)/∂(unknown)."""
        load, radius = self.equation.load(self.coordinate.depth(delta))
        damping, depth_rate = self.equation.damping(radius), 3 * (self.coordinate.root + delta) ** 2
        depth_share = self.equation.depth_share(radius)

        def slopes(velocity):
            rate, acceleration, power = self.equation.rates(load, radius, velocity)
            # A step that is too long passes the turning point, and is rejected.
            with np.errstate(all="ignore"):
                time = depth_rate / rate
                change = damping + acceleration * depth_share / rate
                return (acceleration * time, time, power * time), -change * time

        return slopes

    def decelerations(self):
        """Return the decelerations (m/s²) at the nodes."""
        # At an end at a kink both slopes may be 0.
        with np.errstate(divide="ignore", invalid="ignore"):
            return -self.slopes[:, 0] / self.slopes[:, 1]


class VelocitySteps(Steps):
    """Steps in the velocity, with the depth as their unknown."""

    def _first_unknown(self):
        return self.start.depth

    def _size(self, end):
        return np.abs(end.depth)

    def _depth_and_velocity(self, velocity, change):
        return self.start.depth + change, velocity

    def _slopes(self, velocity):
        def slopes(depth):
            load, radius = self.equation.load(depth)
            rate, acceleration, power = self.equation.rates(load, radius, velocity)
            stiffness = self.equation.stiffness(depth, load, radius, velocity)
            stiffness = stiffness * self.equation.depth_share(radius)
            # Without contact there is no acceleration; such a step is rejected.
            with np.errstate(all="ignore"):
                jacobian = stiffness * velocity / self.equation.bodies.inertia / acceleration**2
                return (rate / acceleration, 1 / acceleration, power / acceleration), jacobian

        return slopes

    def decelerations(self):
        """Return the decelerations (m/s²) at the nodes."""
        return -1 / self.slopes[:, 1]


def _collocate(derivative, first, length):
    """Solve u′ = f(u) over intervals by polynomials through 24 Gauss nodes, one interval per row.

    `derivative` returns f and ∂f/∂u for values of u at the nodes. `first` and `length`, of shape (N, 1),
    are u at the start and the length of each interval. Return u at the nodes, of shape (N, 24) and of one
    sign in each interval, and whether Newton's method has converged.
    """
    u, settled = np.repeat(first, len(_INTEGRATE), axis=1), np.zeros(len(first), bool)
    for _ in range(8):
        value, rate = derivative(u)
        # In an interval that is too long, values may overflow; it is not settled.
        with np.errstate(all="ignore"):
            change = _newton_step(u - first - length * (value @ _INTEGRATE.T), length * rate)
            u = np.where(change / u < 0.75, u - change, u / 4)
            settled = np.all(np.abs(change) <= 1e-9 * np.abs(u), axis=1)
        if settled.all():
            break
    return u, settled


def _newton_step(residual, rate):
    """Return δ with δ − ∫ f′δ = r for the residual r and the rate f′, times the length, at the nodes.

    It is δ = r + E ∫ f′r/E with E = exp ∫ f′. Up to E = e^10 its polynomial is so accurate that Newton's
    method converges as fast. Up to e^20 it would leave 10⁻¹² of u. Times f′ this is an error of the slope,
    which shorter steps do not reduce.
    """
    exponent = rate @ _INTEGRATE.T
    factor = np.exp(exponent)
    change = residual + factor * ((rate * residual / factor) @ _INTEGRATE.T)
    steep = np.flatnonzero(~(np.abs(exponent).max(axis=1) < 10.0))
    if steep.size:
        matrix = _ONE - rate[steep, None, :] * _INTEGRATE
        matrix[~np.isfinite(matrix).all(axis=(1, 2))] = _ONE
        change[steep] = np.linalg.solve(matrix, residual[steep, :, None])[..., 0]
    return change


def _last_coefficient(values):
    """Return the largest of the last three Legendre coefficients of polynomials through 24 Gauss nodes."""
    return np.abs(values @ _LAST).max(axis=-1)
