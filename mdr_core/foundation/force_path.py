"""Viscous indentation under a prescribed force in time: creep, on the chain."""

from itertools import pairwise

import numpy as np
import scipy

from .. import _check
from .._check import ArrayLike
from .._numeric import root_in_bracket
from ..medium import Medium, check_pair
from ..shapes.profile import Profile
from .depth_path import TimedIndentation, check_times
from .fronts import force_and_radius
from .reach import reach
from .row import Foundation

#: Steps in each piece of the path, and elements, of the first run; both are doubled up to so often.
_STEPS, _ELEMENTS, _REFINEMENTS = 8, 200, 6
#: Share of the largest force that still presses where none is prescribed, so that contact is kept.
_TOUCH = 1e-10
#: Share of the last step of a piece in which the rate is the one at its end, not the mean one of the step.
_ARRIVAL = 1 / 16
#: Share of the largest force by which that of the mean rates may differ from it where a path is followed.
_OFF = 1 / 16


@_check.keywords_explained
def creep(
    profile: Profile, medium: Medium, force: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-4
) -> TimedIndentation:
    """Press an indenter into a viscous medium along a path of force in time, under which it creeps.

    By the chain, in steps of constant ḋ that end under the prescribed force, finer at the beginning of each
    piece, where the dashpots give way; what is of first and second order in them is extrapolated away.

    Parameters
    ----------
    profile, medium
        The indenter and the medium.
    force : array_like, shape (N,)
        Forces (N), not negative, straight in between; the first one is reached infinitely slowly.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Error allowed in the depth, relative to the largest one.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimate reached as `error`. Contact radius and fields
        are those of a row of elements that follows the extrapolated depths and carries the force.

    Raises
    ------
    ValueError
        If a force is negative or not finite, the first one is more than a flat face carries at rest,
        π q_c b (Popov 2015, Eq. (11)), any is where there is no viscosity, or one presses deeper than the
        shape is known, or times do not increase.

    Examples
    --------
    A flat punch under a force that grows for a time τ and is held as long again, d = F/(2E*b) times
    1 − (e − 1)/e²:

    >>> from mdr_core import FlatPunch, Medium
    >>> medium = Medium(E_star=1.0, eta=0.25)
    >>> state = creep(FlatPunch(1.0), medium, [0.0, 2.0, 2.0], [0.0, 1.0, 2.0], tolerance=1e-5)
    >>> print(round(float(state.depth[-1]), 4))
    0.7675
    """
    check_pair(profile, medium, "a path in time")
    force = _check.force("force", force)
    time = check_times(time, force, "force")
    tolerance = _check.positive_number("tolerance", tolerance)
    most = 2 * medium.yield_line_load * profile.wall
    at_rest = (np.arange(force.size) == 0) | (medium.eta == 0)
    bound = f"must be less than the {most:g} N at which the whole flat face yields"
    _check.refuse("force", force, (force >= most) & at_rest, bound, unit="N", remedy="begin with less")
    # What springs, or dashpots from the first force on, alone allow.
    first = reach(profile, medium, "force", force[0])
    most = reach(profile, medium, "force", np.max(force))
    bound = min(most, reach(profile, medium, "momentum", scipy.integrate.trapezoid(force, time), first))
    rows, paths, limit, error = [], [], None, np.inf
    for level in range(_REFINEMENTS):
        steps = _STEPS * 2**level
        run = _Run(profile, medium, bound, _ELEMENTS * 2**level, 1e-2 * tolerance / (steps * len(time)))
        run.follow(force, time, steps)
        bound = 1.1 * max(depth for _, depth in run.path)
        rows.append(np.array(run.record))
        paths.append(np.array(run.path))
        last, limit = limit, _extrapolated(rows[-3:])
        if last is not None:
            error = float(np.max(np.abs(limit - last)[:, 0]) / (np.max(np.abs(limit[:, 0])) or 1.0))
        if error <= tolerance:
            break
    depth, *energies = limit.T
    # Contact comes and goes: its radius, and the rate that a force needs, are those of a row on the limit,
    # or on the last path where unloading is so steep that the force is not that of the limit.
    places = np.array(run.places)
    for path in (_limit_of_paths(paths[-3:]), paths[-1].T):
        half_width = max(run.row.half_width, float(profile.contact_radius(max(np.max(path[1]), 0.0))))
        found, radius = _replay(Foundation(profile, medium, run.row.n, half_width), *path, places)
        if np.all(np.abs(found - force) <= _OFF * np.max(force)):
            break
    dashpots = 8 * medium.eta * radius
    missing = np.divide(force - found, dashpots, out=np.zeros(force.shape), where=dashpots > 0)
    path, places = _arriving(*path, places, missing)
    plastic_depth = np.maximum(np.maximum.accumulate(depth) - medium.critical_depth, 0.0)
    states = force, radius, *np.maximum(energies, 0.0), plastic_depth
    return TimedIndentation(profile, medium, time, depth, *states, error, places, path)


def _extrapolated(rows):
    """The limit of results with errors of first and second order, each run with half the step."""
    for power in range(1, len(rows)):
        rows = [fine + (fine - coarse) / (2**power - 1) for coarse, fine in pairwise(rows)]
    return rows[-1]


def _limit_of_paths(paths):
    """Times (s) and depths (m) of the last path, corrected by those with half the steps each."""
    (time, depth), levels = paths[-1].T, range(len(paths))
    common = [path[:: 2**level, 1] for level, path in zip(levels, paths, strict=True)]
    return time, depth + np.interp(time, time[:: 2 ** levels[-1]], _extrapolated(common) - common[-1])


def _replay(row, time, depth, places):
    """Force (N) and contact radius (m) at some places of a path that a row follows."""
    found, steps = [], np.append(np.inf, np.diff(time))
    for to, dt in zip(depth, steps, strict=True):
        row = row.advance(to, dt)
        found.append(force_and_radius(row))
    return np.array(found)[places].T


def _arriving(time, depth, places, surplus):
    """The path with rates (m/s) added to those at which it comes to its places, and the places there."""
    ends = np.array(places[1:])
    step = time[ends] - time[ends - 1]
    rate = (depth[ends] - depth[ends - 1]) / step + surplus[1:]
    path = [
        np.insert(values, ends, values[ends] - _ARRIVAL * step * change)
        for values, change in ((time, 1.0), (depth, rate))
    ]
    return tuple(path), places + np.arange(len(places))


class _Run:
    """One run: the chain, its path, and what has been recorded at the given times."""

    def __init__(self, profile, medium, bound, n, precision):
        self.bound = min(bound, profile.known_depth)
        self.close = precision * self.bound
        # A path that never presses has no width of its own.
        half_width = float(profile.contact_radius(self.bound)) or min(1.0, profile.known_radius)
        self.row = Foundation(profile, medium, n, half_width)
        self.rate = 0.0
        self.path, self.places, self.record = [], [], []

    def follow(self, force, time, steps):
        """Follow a force path in so many steps for each of its pieces."""
        least = _TOUCH * np.max(force)
        # The pieces' beginnings resolved as the cube of the step.
        share = (np.arange(steps + 1) / steps) ** 3
        if force[0] > 0:
            self.go(np.inf, force[0], 0.0)
        self.path.append((time[0], self.row.depth))
        self.note()
        for (start, first), (stop, last) in pairwise(zip(time, force, strict=True)):
            for begin, end in pairwise(share):
                dt, before = (stop - start) * (end - begin), self.row.depth
                self.go(dt, max(first + (last - first) * end, least), self.rate * dt)
                self.rate = (self.row.depth - before) / dt
                self.path.append((self.path[-1][0] + dt, self.row.depth))
            self.note()

    def note(self):
        """Record the present state as one of those at the given times."""
        row = self.row
        self.places.append(len(self.path) - 1)
        energies = row.stored_energy, row.plastic_work, row.viscous_work
        self.record.append((row.depth, *energies))

    def go(self, dt, force, guess):
        """The move in a time dt (s) that ends under a force (N), by its rise (m) from a first guess."""
        row, medium, room = self.row, self.row.medium, self.bound - self.row.depth

        def excess(rise):
            moved = row.advance(row.depth + rise, dt)
            state = moved._elements
            spring = (state.elastic < medium.critical_depth) + medium.relaxation_time / dt
            total, radius = force_and_radius(moved)
            stiffness = max(moved._total(state.contact * spring), 1e-300)
            slope = row.profile.reduced_slope(radius)
            if moved._lag > 0 and slope > 0:
                # The dashpots that the growing contact meets.
                stiffness += 2 * medium.E_star * moved._lag / slope
            return total - force, stiffness, moved

        self.row = root_in_bracket(excess, min(guess, room), -row.depth, room, self.close)
