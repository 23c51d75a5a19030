"""Viscous indentation under a prescribed force in time: creep, by the chain."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
import scipy

from .. import _check
from .._check import ArrayLike
from ..medium import Medium, check_pair, refuse_adhesion, refuse_other_classes, refuse_own_law
from ..numerics.roots import root_in_bracket
from ..profiles.profile import Profile
from .cap import flat_face_load, plastic_depth
from .depth_path import TimedIndentation, check_times, follow
from .foundation import Foundation
from .fronts import force_and_radius
from .grid import depth_bound
from .refinement import extrapolate, refine

#: Steps per piece of the path and elements of the coarsest run; number of runs; orders of their errors.
_STEPS, _ELEMENTS, _RUNS, _ORDERS = 8, 200, 6, (1, 2)
#: Fraction of the last step of a piece that has the rate at its end instead of the mean rate of the step.
_END_FRACTION = 1 / 16


@_check.keywords_explained
def creep(
    profile: Profile, medium: Medium, force: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-4
) -> TimedIndentation:
    """Press an indenter into a viscous medium along a path of force in time, under which it creeps.

    Solved by the chain in steps of constant ḋ, each of which ends at the prescribed force; errors of first
    and second order are extrapolated away.

    Parameters
    ----------
    profile, medium
        The indenter and the medium.
    force : array_like, shape (N,)
        Forces (N), not negative, linear in between; the first one is applied infinitely slowly.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Largest error of the depth, relative to the largest depth.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimated `error`. Contact radius and fields are those
        of a foundation that follows the extrapolated depths and carries the force.

    Raises
    ------
    ValueError
        If a force is negative or not finite, or needs more than the known depth of the profile; if the
        first one, or without viscosity any, is as large as the π q_c b at which a whole flat face yields
        (Popov 2015, Eq. (11)); or if times do not increase.

    Examples
    --------
    A flat punch under a force that increases for a time τ and is then constant for as long,
    d = F/(2E*b) (1 − (e − 1)/e²):

    >>> from mdr_core import FlatPunch, Medium
    >>> medium = Medium(E_star=1.0, eta=0.25)
    >>> state = creep(FlatPunch(1.0), medium, [0.0, 2.0, 2.0], [0.0, 1.0, 2.0], tolerance=1e-5)
    >>> print(round(float(state.depth[-1]), 4))
    0.7675
    """
    check_pair(profile, medium, "a path in time")
    refuse_adhesion(medium, "a path in time")
    refuse_own_law(medium, "a path of force in time", "take indent_in_time, a path of depth in time")
    instead = "take indent_in_time, or set hardness = 0 and f_c = 0"
    refuse_other_classes(medium, "a path of force in time", instead)
    force = _check.force("force", force)
    time = check_times(time, force, "force")
    tolerance = _check.positive_number("tolerance", tolerance)
    capacity = flat_face_load(medium, profile.wall)
    static = (np.arange(force.size) == 0) | (medium.eta == 0)
    bound = f"must be less than the {capacity:g} N at which the whole flat face yields"
    _check.refuse("force", force, (force >= capacity) & static, bound, unit="N", remedy="begin with less")
    # Bounds by the springs alone, and by the dashpots alone after the first force.
    first = depth_bound(profile, medium, "force", force[0])
    impulse = scipy.integrate.trapezoid(force, time)
    bound = min(
        depth_bound(profile, medium, "force", np.max(force)),
        depth_bound(profile, medium, "momentum", impulse, first),
    )
    runs = []

    def run(level):
        steps, depth = _STEPS * 2**level, 1.1 * runs[-1].depth.max() if runs else bound
        precision = 1e-2 * tolerance / (steps * len(time))
        runs.append(_creep_run(profile, medium, depth, _ELEMENTS * 2**level, force, time, steps, precision))
        return runs[-1].record

    record, errors = refine(run, tolerance, _RUNS, 1, orders=_ORDERS)
    depth, energies = record[:, 0], np.maximum(record[:, 1:], 0.0).T
    path_time, path_depth, index, radius = _consistent_path(runs, force)
    return TimedIndentation(
        profile, medium, time, depth, force, radius,
        **dict(zip(("stored_energy", "plastic_work", "viscous_work"), energies, strict=True)),
        plastic_depth=plastic_depth(profile, medium, np.maximum.accumulate(depth)),
        error=float(errors[0]), _index=index, _path_time=path_time, _path_depth=path_depth,
    )  # fmt: skip


class CreepRun(NamedTuple):
    """One run: its last foundation, times (s) and depths (m) of its path, index of the given times on it.

    `record` holds depth (m), stored energy, plastic and viscous work (J) at the given times.
    """

    foundation: Foundation
    time: np.ndarray
    depth: np.ndarray
    index: np.ndarray
    record: np.ndarray


def _creep_run(profile, medium, bound, n, force, time, steps, precision):
    """`CreepRun` up to a depth bound (m), with `steps` per piece, to a relative precision of the depth."""
    bound = min(bound, profile.known_depth)
    # A path without contact has no width of its own.
    half_width = float(profile.contact_radius(bound)) or min(1.0, profile.known_radius)
    foundation = Foundation(profile, medium, n, half_width)
    # A small force maintains contact where none is prescribed.
    close, smallest, rate = precision * bound, 1e-10 * np.max(force), 0.0
    # Times after the start of a piece increase as the cube of the step.
    fraction = (np.arange(steps + 1) / steps) ** 3
    if force[0] > 0:
        foundation = _step(foundation, np.inf, force[0], 0.0, bound, close)
    path_time, path_depth, record = [time[0]], [foundation.depth], [_recorded(foundation)]
    for (start, first), (stop, last) in pairwise(zip(time, force, strict=True)):
        for lower, upper in pairwise(fraction):
            dt, target = (stop - start) * (upper - lower), first + (last - first) * upper
            foundation = _step(foundation, dt, max(target, smallest), rate * dt, bound, close)
            rate = (foundation.depth - path_depth[-1]) / dt
            path_time.append(path_time[-1] + dt)
            path_depth.append(foundation.depth)
        record.append(_recorded(foundation))
    index = steps * np.arange(len(time))
    return CreepRun(foundation, np.array(path_time), np.array(path_depth), index, np.array(record))


def _recorded(foundation):
    return foundation.depth, foundation.energy_of_elements, foundation.plastic_work, foundation.viscous_work


def _step(foundation, dt, force, guess, bound, close):
    """Foundation after a time dt (s) under a force (N) at its end, from a guess of the travel (m)."""
    medium, room = foundation.medium, bound - foundation.depth

    def excess(travel):
        moved = foundation.advance(foundation.depth + travel, dt)
        elements, lag = moved._elements, moved._current.lag
        spring = (elements.elastic < moved._limit) + medium.relaxation_time / dt
        total, radius = force_and_radius(moved)
        stiffness = max(moved._total(elements.contact * spring), 1e-300)
        slope = foundation.profile.reduced_slope(radius)
        if lag > 0 and slope > 0:
            # Dashpots that come into contact as the radius increases.
            stiffness += 2 * medium.E_star * lag / slope
        return total - force, stiffness, moved

    return root_in_bracket(excess, min(guess, room), -foundation.depth, room, close)


def _consistent_path(runs, force):
    """Times (s) and depths (m) of a path that carries the force; index of the given times, radii (m) there.

    It is the extrapolated path, or that of the finest run where unloading is so steep that the extrapolated
    one does not carry the force. The rate at the end of each piece is adjusted to carry it exactly.
    """
    finest, time, index = runs[-1].foundation, runs[-1].time, runs[-1].index
    profile, medium = finest.profile, finest.medium
    for depth in (_extrapolated_depth(runs), runs[-1].depth):
        half_width = max(finest.half_width, float(profile.contact_radius(max(np.max(depth), 0.0))))
        record = follow(Foundation(profile, medium, finest.n, half_width), depth, time)[index]
        carried, radius = record[:, 0], record[:, -1]
        if np.all(np.abs(carried - force) <= np.max(force) / 16):
            break
    dashpots, end = 8 * medium.eta * radius, index[1:]
    rate = np.divide(force - carried, dashpots, out=np.zeros(force.shape), where=dashpots > 0)[1:]
    step = time[end] - time[end - 1]
    rate += (depth[end] - depth[end - 1]) / step
    time = np.insert(time, end, time[end] - _END_FRACTION * step)
    depth = np.insert(depth, end, depth[end] - _END_FRACTION * step * rate)
    return time, depth, index + np.arange(len(index)), radius


def _extrapolated_depth(runs):
    """Depths (m) of the finest path, corrected at the times that it has in common with coarser ones."""
    runs = runs[-len(_ORDERS) - 1 :]
    time, depth = runs[-1].time, runs[-1].depth
    common = [run.depth[:: 2**level] for level, run in enumerate(runs)]
    correction = extrapolate(common, _ORDERS) - common[-1]
    return depth + np.interp(time, time[:: 2 ** (len(runs) - 1)], correction)
