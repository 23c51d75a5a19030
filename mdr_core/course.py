"""Impacts to solve, and where each of them is on its course."""

from dataclasses import dataclass, fields

import numpy as np

from . import collocation as gauss
from .contact_time import power
from .profiles import Profile

#: Share of its depth to which a kink is met; between that and the kink the force is smooth enough.
NEAR = 1e-6

ELASTIC, YIELDING, UNLOADING, DONE = range(4)


@dataclass(frozen=True)
class Bodies:
    """Impacts to solve, one a row of each array; `profile` is one indenter, or one for each row.

    Relaxation time τ (s), inertia m/(2E*) (m s²), speed v₀ (m/s), critical depth d_c (m) and its
    remainder, plastic depth p₀ (m) of the imprint that is met.
    """

    profile: Profile
    relaxation_time: np.ndarray
    inertia: np.ndarray
    speed: np.ndarray
    critical_depth: np.ndarray
    remainder: np.ndarray
    before: np.ndarray

    def rows(self, index):
        """Some of the impacts, by their numbers."""
        if index.size == self.speed.size:
            return self
        profile, *arrays = (getattr(self, field.name) for field in fields(self))
        return Bodies(profile.entries(index, self.speed.shape), *(part[index] for part in arrays))


class Course:
    """Where each impact is, and what it has gathered on its way: arrays of one entry for each."""

    def __init__(self, bodies):
        count = bodies.speed.size
        self.phase = np.full(count, ELASTIC)
        #: Time (s), penetration y = d − p₀ and live depth ℓ (m), velocity (m/s).
        self.time, self.y, self.live = np.zeros((3, count))
        self.velocity = bodies.speed.copy()
        #: Plastic depth (m), what of it this impact has added, and the largest penetration.
        self.lower, self.growth, self.deepest = bodies.before.copy(), np.zeros(count), np.zeros(count)
        #: ∫ a v² dt in contact, and τ ∫ a v v̇ dt on unloading (m³/s): viscous work over 2E* τ.
        self.slid, self.released = np.zeros((2, count))
        #: Deceleration (m/s²) now, and the largest so far: a face that is met at speed pushes at once.
        face = bodies.profile._radius(bodies.before)
        self.load = bodies.relaxation_time * face * bodies.speed / bodies.inertia
        self.peak = self.load.copy()
        #: What the deceleration in the next step may be, at the points.
        self.guess = np.repeat(self.load[:, None], gauss.COUNT, axis=1)
        #: Kind of the steps in which contact or yield begins.
        self.opening = _opening(bodies)
        #: Length (s) and kind of the next step, and what the length was before an edge cut it short.
        self.step = 0.65 * _depth_scale(bodies) / bodies.speed
        self.kind, self.uncut = self.opening.copy(), np.zeros(count)
        self.breaks = _breaks(bodies)
        #: Whether any of them is viscous.
        self.viscous = bool(np.any(bodies.relaxation_time > 0))


def _depth_scale(bodies):
    """Depth (m) at which pressing at the full speed has about spent the kinetic energy."""
    target = bodies.inertia * bodies.speed**2 / 2
    drag, d_c = bodies.relaxation_time * bodies.speed, bodies.critical_depth
    highest = bodies.profile.deepest - bodies.before

    def work(y):
        # As if the face had been flat from the beginning: about right, and cheap for every shape.
        face, length = bodies.profile._radius(bodies.before + y), np.minimum(y, d_c)
        return face * (length * (length / 2 + np.maximum(y - d_c, 0.0)) + drag * y)

    y = np.minimum(np.where(np.isinf(d_c), 1.0, d_c), highest)
    # Newton's method on logarithms: a few steps from anywhere, for sums of powers.
    for _ in range(4):
        value = work(y)
        exponent = np.log2(value / work(y / 2))
        y = np.minimum(y * (target / value) ** (1 / exponent), highest)
    return y


def _opening(bodies):
    """Kind of the steps in which contact or yield begins, where radii grow as powers of the depth."""
    exponent = power(bodies.profile)
    # Whole powers are smooth in time itself, high ones nearly so.
    smooth = exponent is not None and (np.mod(exponent, 1) == 0) | (np.asarray(exponent) > 3)
    return np.where(smooth, gauss.PLAIN, gauss.OPENING) + np.zeros(bodies.speed.shape, int)


def _breaks(bodies):
    """Depths (m) at which either end of the live interval passes a kink of the profile."""
    kinks = bodies.profile.kinks
    return np.column_stack([np.broadcast_to(k, bodies.speed.shape) for k in kinks]) if kinks else None


def ahead(bodies, course, rows):
    """Penetration (m) at which loading stops being smooth."""
    d_c = bodies.critical_depth[rows]
    nearest = np.where(course.phase[rows] == ELASTIC, d_c, np.inf)
    if course.breaks is not None:
        kinks = course.breaks[rows] - bodies.before[rows, None]
        both = np.hstack([kinks, kinks + d_c[:, None]])
        passed = both <= course.y[rows, None] * (1 + 2 * NEAR)
        nearest = np.minimum(nearest, np.where(passed, np.inf, both).min(axis=1))
    return nearest


def below(course, rows):
    """Live depth (m) at which unloading stops being smooth: 0, where contact is lost, if not before."""
    if course.breaks is None:
        return np.zeros(rows.size)
    kinks = course.breaks[rows] - course.lower[rows, None]
    passed = kinks >= course.live[rows, None] * (1 - 2 * NEAR)
    return np.maximum(np.where(passed, 0.0, kinks).max(axis=1), 0.0)
