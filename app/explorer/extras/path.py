"""The drive *path*: several loadings, ramp and hold, and creep."""

from dataclasses import dataclass, fields, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core import abel
from mdr_core.solver.applicability import refuse_adhesion
from mdr_core.solver.contact.live_interval import LiveInterval
from mdr_core.solver.contact.yielding import yield_rule

from ..changes import equivalent
from ..courses import Course, onset_depth, path_progress
from ..drives import Drive, limited_force
from ..extra import Extra
from ..state import medium, profile

#: Steps of a piece of a path.
_STEPS = 24
#: Tolerance of the chain and of creep, below the resolution of plots.
_TOLERANCE = 3e-3


#: Note on a path in time in a medium without dashpots.
_IDLE = "Without viscosity nothing changes while the depth or force is held."


def _vertices(drive):
    """Return the prescribed values of a drive since first contact, and times or accumulated changes."""
    if drive.time is not None:
        return np.array(drive.force if _by_force(drive) else drive.depth), np.array(drive.time)
    depth = np.append(0.0, drive.depth)
    return depth, np.append(0.0, np.cumsum(np.abs(np.diff(depth))))


def _in_time(state):
    return state.drive == "path" and state["path.pattern"] in ("hold", "creep")


def _by_force(drive):
    return isinstance(drive, mdr.scene.ForcePath)


def _refined(scene, chain):
    """Return prescribed values and their places along the path, at the vertices and between them."""
    values, along = _vertices(scene.drive)
    by_force, largest = _by_force(scene.drive), onset_depth(scene)
    places = [along]
    for (begin, first), (end, last) in pairwise(zip(along, values, strict=True)):
        share = _shares(_STEPS, chain, first == last)
        if last > largest and not by_force:
            # Just before yield.
            share = np.append(share, (largest * (1 - 1e-12) - first) / (last - first))
            largest = last
        places.append(begin + (end - begin) * share)
    places = np.unique(np.concatenate(places))
    return np.interp(places, along, values), places


def _shares(steps, chain, held):
    """Return places along a piece, dense at both ends: radii start as a root of the depth."""
    share = np.linspace(0, 1, steps + 1)
    if chain:
        # Dashpot forces change fastest at the start of a piece.
        return (1e3**share - 1) / 999 if held else share**2
    return np.append((1 - np.cos(np.pi * share)) / 2, 1 - 1e-9)


@lru_cache(maxsize=8)
def _solved(scene, chain):
    values, along = _refined(scene, chain)
    by_force, bodies = _by_force(scene.drive), (scene.profile, scene.medium)
    if chain:
        solve = mdr.creep if by_force else mdr.indent_in_time
        states = PathStates.of(solve(*bodies, values, along, tolerance=_TOLERANCE))
    else:
        states = _slowly(scene, values)
    in_time = scene.drive.time is not None
    return Course(
        scene=scene,
        progress=path_progress(along, states.depth),
        states=states,
        motion=_motion(states, along) if in_time else None,
        turns=True,
        chained=chain,
        notes=(_IDLE,) * (in_time and scene.medium.eta == 0),
    )


def _slowly(scene, values):
    solve = mdr.indent_to_force if _by_force(scene.drive) else mdr.indent
    return solve(scene.profile, scene.medium, values)


def _motion(states, time):
    """Return the motion along a path in time, with its energies."""
    none, live = np.zeros_like(time), states.live_interval
    rate = np.append(0.0, np.diff(states.depth) / np.diff(time))
    viscous = none if isinstance(states, mdr.Indentation) else states.viscous_work
    return mdr.Motion(
        time, states.depth, rate, states.force, states.contact_radius, states.plastic_radius,
        live.lower, live.length, none, states.stored_energy, states.plastic_work, viscous,
        deflection=none, body_velocity=rate, structure_work=none, support_energy=none,
    )  # fmt: skip


#: Number of elements, in addition to the elements at the radii a and c of all states.
_PLACES = 300


@dataclass(frozen=True, eq=False, repr=False)
class PathStates(mdr.TimedIndentation):
    """States along a path in time, with elements evaluated once for all states.

    `x`: places (m) of the elements; `load`, `compression`: their line loads (N/m) and elastic
    compressions (m) in every state.
    """

    x: Any
    load: Any
    compression: Any

    @classmethod
    def of(cls, path):
        a, c = path.contact_radius, path.plastic_radius
        half = float(np.max(a)) or 1.0
        # The load may jump at the rim.
        x = [np.linspace(0, half, _PLACES), a, a * (1 - 1e-9), np.minimum(c, half)]
        x = np.unique(np.concatenate(x))
        known = {each.name: getattr(path, each.name) for each in fields(path)}
        return cls(**known, x=x, **dict(zip(("load", "compression"), path.elements(x), strict=True)))

    def __getitem__(self, index):
        return replace(
            super().__getitem__(index), load=self.load[index], compression=self.compression[index]
        )

    @property
    def mean_pressure(self):
        a = np.asarray(self.contact_radius)
        return (self.force / np.where(a > 0, np.pi * a * a, np.inf))[()]

    @property
    def live_interval(self):
        """Equivalent live interval of the elements in contact."""
        a, lower = np.asarray(self.contact_radius), np.asarray(self.plastic_depth)
        upper = np.where(a > 0, np.maximum(self.profile.reduced(a), lower), lower)
        length = np.where(a > 0, np.maximum(upper - lower, np.finfo(float).tiny), 0.0)
        return LiveInterval(lower, upper, length)

    def surface(self, r):
        """Return the elastic displacement (m), including released elements."""
        return abel.surface_displacement(self.x, self.compression, r)

    def imprint(self, r):
        return mdr.Indentation(self.profile, self.medium, self.depth, self.live_interval).imprint(r)

    def pressure(self, r):
        """Return the contact pressure (Pa) at radii r (m); infinite at the rim while dashpots act there."""
        inside = self.x < self.contact_radius
        if not inside.any():
            return np.zeros(np.shape(r))[()]
        x, load = np.append(self.x[inside][:-1], self.contact_radius), self.load[inside]
        load[-1] = load[-1] if load[-1] > 1e-6 * load.max() else 0.0
        return 0.0 - abel.stress_from_line_load(x, load, r)


class Path(Drive):
    """Pressing along a path."""

    def make(self, state):
        made = medium(state)
        if _in_time(state):
            refuse_adhesion(made, "a path in time")
            times = (0.0, state["path.ramp_time"], 5 * state["path.ramp_time"])
            if state["path.pattern"] == "creep":
                if made.eta > 0 and made.f_c > 0:
                    raise ValueError(
                        "creep with viscosity is not available for a hardness ∝ 1/a², as the force may "
                        "decrease with depth: first choose another hardness, or ramp and hold"
                    )
                return mdr.scene.ForcePath((0.0, state.max_force, state.max_force), times)
            return mdr.scene.DepthPath((0.0, state.max_depth, state.max_depth), times)
        tenths = (2, 4, 6, 8, 10) if state["path.pattern"] == "cycles" else (7, 10)
        peaks = [state.max_depth * tenth / 10 for tenth in tenths]
        # Unloading ends at loss of contact.
        unloaded = map(float, yield_rule(profile(state), made).plastic_depth(np.array(peaks)))
        return mdr.scene.DepthPath([depth for pair in zip(peaks, unloaded, strict=True) for depth in pair])

    def follow(self, scene, progress):
        """Return the states along the path."""
        return _solved(scene, scene.drive.time is not None and scene.medium.eta > 0)

    def equivalent(self, state, turning_point):
        """Return the present depth and force, and a ramp of one relaxation time if none is set."""
        numbers = {"max_depth": float(turning_point.depth), "max_force": limited_force(turning_point)}
        time = float(f"{turning_point.medium.relaxation_time or 1.0:.2g}")
        return numbers if _in_time(state) else numbers | {"path.ramp_time": time}

    def converted(self, state, choice, wanted):
        return equivalent(state, "path") if choice == "path.pattern" else {}


EXTRA = Extra("path", drives={"path": Path()})
