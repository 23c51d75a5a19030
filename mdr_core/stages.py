"""The two stages of an impact, loading and unloading, and a collocation step of either."""

from dataclasses import dataclass, fields

import numpy as np

from . import collocation as gauss
from . import superpose
from .course import ELASTIC
from .turning import pressed
from .yielding import LiveInterval


class Loading:
    """Loading: the coordinate is the penetration y, and elements yield beyond the critical depth."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.y[rows], np.zeros(rows.size)
        self.tau, self.inertia = body.relaxation_time[:, None], body.inertia[:, None]
        self.met = body.before[:, None], body.remainder[:, None]
        # A step that begins before the critical depth runs on as if nothing ever yielded: smoothly.
        elastic = course.phase[rows] == ELASTIC
        self.elastic = elastic.all()
        self.d_c = np.where(elastic, np.inf, body.critical_depth)[:, None]
        self.velocity, self.step = course.velocity[rows, None], course.step[rows, None]
        self.differentiate = gauss.DIFFERENTIATE[course.kind[rows]]

    def live(self, way):
        """Live interval after a way gone."""
        before, remainder = self.met
        return pressed(np.maximum(self.start[:, None] + way, 0.0), self.d_c, remainder, before)[0]

    def radius(self, way, lost):
        """Contact radius (m) after a way gone and a velocity lost."""
        return self.profile._radius(self.live(way).upper)

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        live = self.live(way)
        a = self.profile._radius(live.upper)
        load = superpose.radius_integral(self.profile, live) + self.tau * a * (self.velocity - lost)
        return load / self.inertia, live, a

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the points."""
        ring = a
        if not self.elastic:
            # Newton's method settles on it, however many digits of it cancel.
            ring = np.where(np.isinf(self.d_c), a, a - self.profile._radius(live.lower))
        # a′(d) v is da/dt, and that is at hand without a formula for a′.
        drag = self.tau / self.step * gauss.apply(self.differentiate, a)
        return (ring + drag) / self.inertia, self.tau * a / self.inertia


class Unloading:
    """Unloading: the coordinate is the live depth ℓ = d + τ v − p, and the plastic depth stays."""

    def __init__(self, bodies, course, rows):
        body = bodies.rows(rows)
        self.profile = body.profile.entries((slice(None), None), rows.shape)
        self.start, self.lag = course.live[rows], body.relaxation_time
        self.inertia, self.lower = body.inertia[:, None], course.lower[rows, None]

    def length(self, way, lost):
        """Live depth (m) after a way gone and a velocity lost."""
        return self.start[:, None] + way - self.lag[:, None] * lost

    def radius(self, way, lost):
        """Contact radius (m) after a way gone and a velocity lost."""
        return self.profile._radius(np.abs(self.lower + self.length(way, lost)))

    def deceleration(self, way, lost):
        """Deceleration (m/s²), live interval and contact radius after a way gone and a velocity lost."""
        length = self.length(way, lost)
        edge = self.lower + length
        if np.minimum.reduce(length, axis=None) >= 0:
            live = LiveInterval(np.broadcast_to(self.lower, edge.shape), edge, length)
            a = self.profile._radius(edge)
            return superpose.radius_integral(self.profile, live) / self.inertia, live, a
        # Beyond the loss of contact φ goes on below φ(p), so that a step across it is smooth.
        low = np.where(length >= 0, self.lower, np.maximum(edge, 0.0))
        high = np.where(length >= 0, edge, np.where(edge > 0, self.lower, -length))
        live = LiveInterval(low, high, np.abs(length))
        load = np.copysign(superpose.radius_integral(self.profile, live), length)
        return load / self.inertia, live, self.profile._radius(np.abs(edge))

    def slopes(self, live, a):
        """Derivatives of the deceleration by depth (1/s²) and velocity (1/s) at the points."""
        rate = a / self.inertia
        return rate, self.lag[:, None] * rate


@dataclass(frozen=True)
class Step:
    """Steps of some impacts, one a row; values at the points of a step where there are many.

    Length (s), velocity at the beginning (m/s), deceleration (m/s²), way gone (m), velocity lost
    (m/s), coordinate of the stage (m), the time by which it runs ahead of the way (s), and the
    contact radius (m).
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
        if some.all():
            return self
        return Step(*(getattr(self, field.name)[some] for field in fields(self)))

    def at(self, theta, values):
        """Values at the points of each step, interpolated to a row of θ for each."""
        rows = gauss.basis(theta.ravel()).reshape(*theta.shape, gauss.COUNT)
        return gauss.apply(rows, values)

    def until(self, theta):
        """What happens up to θ: a `Part`."""
        weights = self.length[:, None] * gauss.weights(self.kind, theta)
        lost = gauss.dot(weights, self.deceleration)
        way = gauss.dot(weights, self.velocity[:, None] - self.lost)
        return Part(self, theta, weights, way, lost, way - self.lag * lost)


@dataclass(frozen=True)
class Part:
    """Steps up to θ: weights of the integral over time (s), and the way gone (m), velocity lost (m/s) and
    change of the coordinate (m) there.
    """

    step: Step
    theta: np.ndarray
    weights: np.ndarray
    way: np.ndarray
    lost: np.ndarray
    change: np.ndarray

    @property
    def duration(self):
        """Time (s) that passes."""
        return self.step.length * gauss.share(self.step.kind, self.theta)


def collocate(stage, course, rows):
    """Steps of their planned length, and whether Newton's method settled."""
    kind, h, speed = course.kind[rows], course.step[rows, None], course.velocity[rows]
    once, twice = h[..., None] * gauss.INTEGRATE[kind], (h * h)[..., None] * gauss.TWICE[kind]
    run = h * gauss.ELAPSED[kind] * speed[:, None]
    alpha = course.guess[rows]
    settled, before = np.zeros(rows.size, bool), np.zeros(rows.size)
    for _ in range(12):
        value, live, a = stage.deceleration(run - gauss.apply(twice, alpha), gauss.apply(once, alpha))
        by_depth, by_velocity = stage.slopes(live, a)
        jacobian = by_depth[..., None] * twice + by_velocity[..., None] * once + gauss.IDENTITY
        change = np.linalg.solve(jacobian, (alpha - value)[..., None])[..., 0]
        change[settled] = 0.0
        alpha = alpha - change
        largest = np.maximum.reduce(np.abs(change), axis=1)
        # Corrections shrink quadratically: the next one would be about this one cubed over the square of
        # the one before.
        small = 1e-6 * np.maximum.reduce(np.abs(alpha), axis=1)
        settled = (largest <= small) | (largest**3 <= 1e-5 * small * before**2)
        before = largest
        if (settled | (largest != largest)).all():
            break
    way, lost = run - gauss.apply(twice, alpha), gauss.apply(once, alpha)
    coordinate = stage.start[:, None] + way - stage.lag[:, None] * lost
    a = stage.radius(way, lost)
    return Step(rows, kind, h[:, 0], speed, alpha, way, lost, coordinate, stage.lag, a), settled


def gathered(step, tau, unloading):
    """a v² and, on unloading, τ a v v̇ at the points of steps."""
    velocity = step.velocity[:, None] - step.lost
    pushed = step.radius * velocity
    released = -tau[:, None] * pushed * step.deceleration if unloading else np.zeros_like(pushed)
    return pushed * velocity, released
