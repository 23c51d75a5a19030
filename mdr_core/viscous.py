"""Viscous impacts: what goes into the equation of motion, and what comes out of it."""

from dataclasses import dataclass, fields

import numpy as np

from . import superpose
from .contact_time import contact_time
from .course import Bodies
from .rebound import solve
from .similarity import WORTHWHILE, by_similarity
from .turning import dry_restitution, plastic_integral, turning_point
from .yielding import LiveInterval


@dataclass(frozen=True)
class Rebound:
    """What viscous impacts end with: arrays of their shape.

    Coefficient of restitution, contact time (s), viscous work (J), largest force (N).
    """

    restitution: np.ndarray
    contact_time: np.ndarray
    viscous_work: np.ndarray
    max_force: np.ndarray

    def __getitem__(self, index):
        return Rebound(*(getattr(self, field.name)[index] for field in fields(self)))


def bodies_of(profile, medium, mass, speed, before):
    """The equation of motion's parameters, flat."""
    shape = np.shape(speed)
    d_c, remainder = medium._critical_depth_parts
    arrays = (medium.relaxation_time, mass / (2 * medium.E_star), speed, d_c, remainder, before)
    flat = (np.broadcast_to(part, shape).ravel() for part in arrays)
    return Bodies(profile.flat_entries(slice(None), shape), *flat)


def viscous_impacts(profile, medium, mass, speed, before):
    """Live interval at the turning point, growth of the plastic depth, and `Rebound`, elementwise.

    Where eta is 0 they are those of the dry impact.
    """
    shape = np.shape(speed)
    bodies = bodies_of(profile, medium, mass, speed, before)
    results = np.empty((8, bodies.speed.size))
    wet = bodies.relaxation_time > 0
    for rows, solution in ((np.flatnonzero(wet), _wet), (np.flatnonzero(~wet), _dry)):
        if rows.size:
            results[:, rows] = solution(bodies.rows(rows))
    lower, upper, length, growth, restitution, time, work, force = (
        part.reshape(shape)[()] for part in results
    )
    modulus = 2 * medium.E_star
    return (
        LiveInterval(lower, upper, length),
        growth,
        Rebound(restitution, time, modulus * work, modulus * force),
    )


def _wet(bodies):
    if bodies.speed.size < WORTHWHILE:
        return _moved(bodies)
    holds, depth, time, restitution, loss, force = by_similarity(bodies)
    work = loss * (bodies.inertia * bodies.speed**2 / 2)
    results = np.array(
        [0 * depth, depth, depth, 0 * depth, _speed_ratio(loss, restitution), time, work, force]
    )
    rest = np.flatnonzero(~holds)
    if rest.size:
        results[:, rest] = _moved(bodies.rows(rest))
    return results


def _moved(bodies):
    course = solve(bodies)
    length = np.minimum(course.deepest, bodies.critical_depth)
    live = LiveInterval(course.lower, np.maximum(bodies.before + course.deepest, course.lower), length)
    work = bodies.relaxation_time * (course.slid + course.released)
    plastic = plastic_integral(bodies.profile, live, bodies.critical_depth, course.growth)
    loss = (work + plastic) / (bodies.inertia * bodies.speed**2 / 2)
    ends = (
        _speed_ratio(loss, -course.velocity / bodies.speed),
        course.time,
        work,
        course.peak * bodies.inertia,
    )
    return live.lower, live.upper, live.length, course.growth, *ends


def _speed_ratio(loss, ratio):
    """Restitution from the loss of energy where that is small, and known better than the ratio itself."""
    return np.where(loss < 0.25, np.sqrt(1 - np.minimum(loss, 0.25)), ratio)


def _dry(bodies):
    target = bodies.inertia * bodies.speed**2 / 2
    d_c = bodies.critical_depth
    live, growth = turning_point(bodies.profile, target, d_c, bodies.remainder, bodies.before)
    restitution = dry_restitution(bodies.profile, live, d_c, growth)
    time = contact_time(bodies.profile, bodies.inertia, bodies.speed, live, growth)
    ends = restitution, time, 0.0 * time, superpose.radius_integral(bodies.profile, live)
    return live.lower, live.upper, live.length, growth, *ends
