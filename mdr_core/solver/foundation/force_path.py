"""Viscous indentation under a prescribed force in time, by the chain: steps that end at the force.

The chain checks the scalar laws of `creep`, and continues when they no longer hold.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...base import check
from ..applicability import check_pair, refuse_adhesion, refuse_own_law
from ..numerics.roots import root_in_bracket
from ..numerics.stable import trapezoid
from .cap import flat_face_load, plastic_depth
from .depth_path import Ramps, check_times, follow, states_along
from .fronts import force_and_radius
from .grid import depth_bound
from .refinement import extrapolate, refine
from .row import Row

#: Steps per piece of the path and elements of the coarsest run; number of runs; orders of their errors.
_STEPS, _ELEMENTS, _RUNS, _ORDERS = 8, 200, 6, (1, 2)
#: Fraction of the last step of a piece with the rate at its end instead of the mean rate of the step.
_END_FRACTION = 1 / 16


def check_creep(profile, medium, force, time, tolerance):
    """Return checked arrays of forces (N) and times (s) of a path of force in time, and its tolerance."""
    check_pair(profile, medium, "a path in time")
    refuse_adhesion(medium, "a path in time")
    refuse_own_law(medium, "creep()", "use indent_in_time(), which takes depths over time")
    if medium.f_c > 0:
        raise check.MDRError(
            "creep() does not support f_c above 0: if the force falls while the depth grows, the indenter "
            "jumps; use indent_in_time(), which takes depths over time, or set f_c = 0"
        )
    force = check.force("force", force)
    time = check_times(time, force, "force")
    tolerance = check.positive_number("tolerance", tolerance)
    capacity = flat_face_load(medium, profile.wall)
    static = (np.arange(force.size) == 0) | (medium.eta == 0)
    bound = f"must be less than the {capacity:g} N at which the whole flat face yields"
    check.raise_if("force", force, (force >= capacity) & static, bound, unit="N", advice="begin with less")
    return force, time, tolerance


@dataclass(frozen=True)
class Start:
    """A state from which the row of elements continues: contact inside the edge, which has retreated.

    `edge` is the reduced height at the edge of the contact, and `elastic` the compression of elements at
    coordinates x. Lengths are in m, and works so far in J.
    """

    depth: float
    largest: float
    plastic_depth: float
    edge: float
    elastic: Callable
    plastic_work: float
    viscous_work: float

    def elements(self, virgin):
        """Return `Elements` in this state, from undeformed elements at the same coordinates."""
        elastic, contact = self.elastic(virgin.x), virgin.reduced < self.edge
        plastic = np.maximum(self.plastic_depth - virgin.reduced, 0.0)
        # In contact the penetration is the elastic part, without a difference of depths.
        penetration = np.where(contact, elastic, self.depth - virgin.reduced - plastic)
        return replace(virgin, penetration=penetration, elastic=elastic, plastic=plastic, contact=contact)

    def put_on(self, row):
        """Return a new row in this state."""
        return replace(
            row,
            elements=self.elements(row.elements),
            depth=self.depth,
            largest=self.largest,
            # d + τḋ is the edge.
            lag=self.edge - self.depth,
            plastic_work=self.plastic_work,
            viscous_work=self.viscous_work,
        )


def chain_creep(profile, medium, force, time, *, tolerance=1e-4, start=None):
    """Solve `creep` by the chain alone, in steps of constant ḋ; each step ends at the prescribed force.

    Errors of first and second order are removed by extrapolation. A `Start` carries the first force.
    """
    force, time, tolerance = check_creep(profile, medium, force, time, tolerance)
    # Bounds by the springs alone, and by the dashpots alone after the first force.
    before = start.largest if start else 0.0
    first = max(before, depth_bound(profile, medium, "force", force[0]))
    impulse = trapezoid(force, time)
    bound = min(
        depth_bound(profile, medium, "force", np.max(force)),
        depth_bound(profile, medium, "momentum", impulse, first),
    )
    bound = max(bound, before)
    runs = []

    def run(level):
        steps, depth = _STEPS * 2**level, bound
        if runs:
            depth = max(1.1 * runs[-1].depth.max(), before)
        precision = 1e-2 * tolerance / (steps * len(time))
        n = _ELEMENTS * 2**level
        runs.append(_creep_run(profile, medium, depth, n, force, time, steps, precision, start))
        return runs[-1].record

    record, errors = refine(run, tolerance, _RUNS, 1, orders=_ORDERS, floor=(before, 0.0, 0.0, 0.0))
    depth, energies = record[:, 0], np.maximum(record[:, 1:], 0.0).T
    path_time, path_depth, index, radius = _consistent_path(runs, force, start)
    # The largest depth may lie between the times.
    largest = np.maximum(np.maximum.accumulate(path_depth)[index], depth)
    largest = np.maximum.accumulate(np.maximum(largest, before))
    elements = start and start.elements
    return states_along(
        Ramps(profile, medium, path_time, path_depth, elements, before), index,
        profile=profile, medium=medium, time=time, depth=depth, force=force, contact_radius=radius,
        **dict(zip(("stored_energy", "plastic_work", "viscous_work"), energies, strict=True)),
        plastic_depth=plastic_depth(profile, medium, largest),
        error=float(errors[0]),
    )  # fmt: skip


class CreepRun(NamedTuple):
    """One run: its last row, times (s) and depths (m) of its path, index of the given times on the path.

    `record` holds depth (m), stored energy, plastic and viscous work (J) at the given times.
    """

    row: Row
    time: np.ndarray
    depth: np.ndarray
    index: np.ndarray
    record: np.ndarray


def _creep_run(profile, medium, bound, n, force, time, steps, precision, start):
    """Return the `CreepRun` up to a depth bound (m), with `steps` per piece and a relative precision."""
    bound = min(bound, profile.known_depth)
    # A path without contact does not determine a width.
    half_width = float(profile.contact_radius(bound)) or min(1.0, profile.known_radius)
    row = Row.virgin(profile, medium, n, half_width)
    # A small force maintains contact if the prescribed force is 0.
    close, smallest, rate = precision * bound, 1e-10 * np.max(force), 0.0
    # Times after the start of a piece increase as the cube of the step.
    fraction = (np.arange(steps + 1) / steps) ** 3
    if start is not None:
        row = start.put_on(row)
        rate = row.lag / medium.relaxation_time
    elif force[0] > 0:
        row = _step(row, np.inf, force[0], 0.0, bound, close)
    path_time, path_depth, record = [time[0]], [row.depth], [_recorded(row)]
    for (start, first), (stop, last) in pairwise(zip(time, force, strict=True)):
        for lower, upper in pairwise(fraction):
            dt, target = (stop - start) * (upper - lower), first + (last - first) * upper
            row = _step(row, dt, max(target, smallest), rate * dt, bound, close)
            rate = (row.depth - path_depth[-1]) / dt
            path_time.append(path_time[-1] + dt)
            path_depth.append(row.depth)
        record.append(_recorded(row))
    index = steps * np.arange(len(time))
    return CreepRun(row, np.array(path_time), np.array(path_depth), index, np.array(record))


def _recorded(row):
    return row.depth, row.stored_energy, row.plastic_work, row.viscous_work


def _step(row, dt, force, guess, bound, close):
    """Return the `Row` after a time dt (s) under a force (N) at its end, from a guess of the travel (m)."""
    medium, room = row.medium, bound - row.depth

    def excess(travel):
        moved = row.ramp_to(row.depth + travel, dt)
        elements, lag = moved.elements, moved.lag
        spring = (elements.elastic < moved.elastic_limit) + medium.relaxation_time / dt
        total, radius = force_and_radius(moved)
        stiffness = max(moved.total(elements.contact * spring), 1e-300)
        slope = row.profile.reduced_slope(radius)
        if lag > 0 and slope > 0:
            # Dashpots that come into contact as the radius increases.
            stiffness += 2 * medium.E_star * lag / slope
        return total - force, stiffness, moved

    return root_in_bracket(excess, min(guess, room), -row.depth, room, close)


def _consistent_path(runs, force, start):
    """Return times (s) and depths (m) of a path that carries the force, with indices and radii (m).

    The indices and radii belong to the given times. It is the extrapolated path. If a steep unloading
    prevents this path from carrying the force, it is the path of the finest run. The rate at the end of
    each piece is adjusted to carry the force exactly.
    """
    finest, time, index = runs[-1].row, runs[-1].time, runs[-1].index
    profile, medium = finest.profile, finest.medium
    for depth in (_extrapolated_depth(runs), runs[-1].depth):
        half_width = max(finest.half_width, float(profile.contact_radius(max(np.max(depth), 0.0))))
        row = Row.virgin(profile, medium, finest.n, half_width)
        record = _followed(row, depth, time, start)[index]
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


def _followed(row, depth, time, start):
    """Return `follow` in one ramp per depth; a `Start` is at the first depth."""
    if start is None:
        return follow(row, depth, time, Row.ramp_to)
    first = start.put_on(row)
    later = follow(first, depth[1:], time[1:], Row.ramp_to, time[1] - time[0])
    force, radius = force_and_radius(first)
    return np.vstack([(force, 0.0, 0.0, 0.0, radius), later])


def _extrapolated_depth(runs):
    """Return the depths (m) of the finest path, corrected at its common times with coarser paths."""
    runs = runs[-len(_ORDERS) - 1 :]
    time, depth = runs[-1].time, runs[-1].depth
    common = [run.depth[:: 2**level] for level, run in enumerate(runs)]
    correction = extrapolate(common, _ORDERS) - common[-1]
    return depth + np.interp(time, time[:: 2 ** (len(runs) - 1)], correction)
