"""Impacts to solve, and where each of them is on its course."""

from dataclasses import dataclass, fields

import numpy as np

from . import collocation as gauss
from . import superpose
from .contact_time import power
from .inverse import increasing_root
from .profiles import Profile
from .turning import plastic_integral, pressed
from .yielding import LiveInterval

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
        """Some of the impacts."""
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
        #: Largest deceleration so far (m/s²).
        self.peak = np.zeros(count)
        #: Length (s) and kind of the next step.
        self.step = 0.5 * _depth_scale(bodies) / bodies.speed
        self.kind = opening(bodies)
        self.breaks = _breaks(bodies)


def _depth_scale(bodies):
    """Depth (m) at which pressing at the full speed has spent the kinetic energy."""

    def work(y):
        live, growth = pressed(y, bodies.critical_depth, bodies.remainder, bodies.before)
        way = LiveInterval(bodies.before, bodies.before + y, y)
        drag = bodies.relaxation_time * bodies.speed
        stored = superpose.energy_integral(bodies.profile, live)
        spent = plastic_integral(bodies.profile, live, bodies.critical_depth, growth)
        slid = drag * superpose.radius_integral(bodies.profile, way)
        force = superpose.radius_integral(bodies.profile, live) + drag * bodies.profile._radius(way.upper)
        return stored + spent + slid, force

    start = np.where(np.isinf(bodies.critical_depth), 1.0, bodies.critical_depth)
    highest = bodies.profile.deepest - bodies.before
    return np.minimum(increasing_root(work, bodies.inertia * bodies.speed**2 / 2, start, highest), highest)


def opening(bodies):
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
        passed = both <= course.y[rows, None] * (1 + 1e-12)
        nearest = np.minimum(nearest, np.where(passed, np.inf, both).min(axis=1))
    return nearest


def below(course, rows):
    """Live depth (m) at which unloading stops being smooth: 0, where contact is lost, if not before."""
    if course.breaks is None:
        return np.zeros(rows.size)
    kinks = course.breaks[rows] - course.lower[rows, None]
    passed = kinks >= course.live[rows, None] * (1 - 1e-12)
    return np.maximum(np.where(passed, 0.0, kinks).max(axis=1), 0.0)
