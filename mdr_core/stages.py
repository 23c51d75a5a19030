"""The two stages of an impact, loading and unloading, and a collocation step of either."""

from dataclasses import dataclass, fields

import numpy as np

from . import collocation as gauss
from . import superpose
from .course import ELASTIC
from .turning import pressed
from .yielding import LiveInterval

_DIAGONAL = np.arange(gauss.NODES.size)


class Loading:
    """Loading: the coordinate is the penetration y, and elements yield beyond the critical depth."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.y[rows], np.zeros(rows.size)
        self.tau, self.inertia = body.relaxation_time[:, None], body.inertia[:, None]
        self.met = body.before[:, None], body.remainder[:, None]
        # A step that begins before the critical depth runs on as if nothing ever yielded: smoothly.
        self.elastic = course.phase[rows] == ELASTIC
        self.d_c = np.where(self.elastic, np.inf, body.critical_depth)[:, None]
        self.velocity, self.step = course.velocity[rows, None], course.step[rows, None]
        self.differentiate = gauss.DIFFERENTIATE[course.kind[rows]]

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        before, remainder = self.met
        live, _ = pressed(np.maximum(self.start[:, None] + way, 0.0), self.d_c, remainder, before)
        a = self.profile._radius(live.upper)
        load = superpose.radius_integral(self.profile, live) + self.tau * a * (self.velocity - lost)
        return load / self.inertia, live, a

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the nodes."""
        ring = a
        if not self.elastic.all():
            ring = np.where(np.isinf(self.d_c), a, superpose.radius_drop(self.profile, live))
        # a′(d) v is da/dt, and that is at hand without a formula for a′.
        growth = np.einsum("kij,kj->ki", self.differentiate, a) / self.step
        return (ring + self.tau * growth) / self.inertia, self.tau * a / self.inertia


class Unloading:
    """Unloading: the coordinate is the live depth ℓ = d + τ v − p, and the plastic depth stays."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.live[rows], body.relaxation_time
        self.inertia, self.lower = body.inertia[:, None], course.lower[rows, None]

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        length = self.start[:, None] + way - self.lag[:, None] * lost
        edge = self.lower + length
        # Beyond the loss of contact φ goes on below φ(p), so that a step across it is smooth.
        low = np.where(length >= 0, self.lower, np.maximum(edge, 0.0))
        high = np.where(length >= 0, edge, np.where(edge > 0, self.lower, -length))
        live = LiveInterval(low, high, np.abs(length))
        load = np.copysign(superpose.radius_integral(self.profile, live), length)
        return load / self.inertia, live, self.profile._radius(np.abs(edge))

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the nodes."""
        return a / self.inertia, self.lag[:, None] * a / self.inertia


@dataclass(frozen=True)
class Step:
    """Steps of some impacts, one a row; values at 0 and at the nodes where there are seventeen.

    Length (s), velocity at the beginning (m/s), deceleration (m/s²), way gone (m), velocity lost
    (m/s), coordinate of the stage (m), the time by which it runs ahead of the way (s), and the
    contact radius at the nodes (m).
    """

    rows: np.ndarray
    kind: np.ndarray
    length: np.ndarray
    velocity: np.ndarray
    deceleration: np.ndarray
    way: np.ndarray
    lost: np.ndarray
    coordinate: np.ndarray
    lag: np.ndarray
    radius: np.ndarray

    def keep(self, some):
        """The steps of some impacts."""
        return Step(*(getattr(self, field.name)[some] for field in fields(self)))

    def integral(self, values, theta):
        """∫ over time up to θ of values at the nodes."""
        # At the end the quadrature is better than the interpolant.
        result = np.einsum("kj,kj->k", gauss.WHOLE[self.kind], values)
        cut = np.flatnonzero(theta < 1)
        if cut.size:
            sums = np.einsum("kij,kj->ki", gauss.INTEGRATE[self.kind[cut]], values[cut])
            sums = gauss.with_start(np.zeros(cut.size), sums)
            result[cut] = gauss.interpolate(gauss.basis(theta[cut]), sums)
        return self.length * result

    def moved(self, theta):
        """Way, velocity lost, and change of the coordinate up to θ."""
        lost = self.integral(self.deceleration[:, 1:], theta)
        way = self.integral(self.velocity[:, None] - self.lost[:, 1:], theta)
        return way, lost, way - self.lag * lost


def collocate(stage, course, rows):
    """Steps of their planned length, and whether Newton's method settled."""
    kind, h = course.kind[rows], course.step[rows, None]
    once, twice = h[..., None] * gauss.INTEGRATE[kind], h[..., None] ** 2 * gauss.TWICE[kind]
    run = h * gauss.ELAPSED[kind] * course.velocity[rows, None]
    nothing = np.zeros((rows.size, 1))
    begun = stage.deceleration(nothing, nothing)[0]
    alpha = np.repeat(begun, gauss.NODES.size, axis=1)
    settled, failed = np.zeros((2, rows.size), bool)
    for _ in range(12):
        way = run - np.einsum("kij,kj->ki", twice, alpha)
        value, *state = stage.deceleration(way, np.einsum("kij,kj->ki", once, alpha))
        by_depth, by_velocity = stage.slopes(*state)
        jacobian = by_depth[..., None] * twice + by_velocity[..., None] * once
        jacobian[:, _DIAGONAL, _DIAGONAL] += 1
        change = np.linalg.solve(jacobian, (alpha - value)[..., None])[..., 0]
        largest = np.abs(change).max(axis=1)
        failed |= ~np.isfinite(largest)
        change[settled | failed] = 0.0
        alpha = alpha - change
        settled |= largest <= 1e-9 * np.abs(alpha).max(axis=1)
        if (settled | failed).all():
            break
    lost = np.einsum("kij,kj->ki", once, alpha)
    way = run - np.einsum("kij,kj->ki", twice, alpha)
    coordinate = stage.start[:, None] + way - stage.lag[:, None] * lost
    zero, speed = nothing[:, 0], course.velocity[rows]
    columns = ((begun, alpha), (zero, way), (zero, lost), (stage.start, coordinate))
    values = (gauss.with_start(*pair) for pair in columns)
    return Step(rows, kind, h[:, 0], speed, *values, stage.lag, state[1]), settled


def gathered(step, tau, unloading):
    """a v² and, on unloading, τ a v v̇ at the nodes of steps."""
    velocity = step.velocity[:, None] - step.lost[:, 1:]
    released = -tau[:, None] * step.radius * velocity * step.deceleration[:, 1:]
    return step.radius * velocity**2, released if unloading else np.zeros_like(released)
