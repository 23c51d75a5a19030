"""The plot *Radii*: radii of the contact and of the plastic zone over depth."""

import numpy as np

from mdr_core.show.figures import area, line, mark, split

from ..courses import Course
from ..extra import Extra
from ..plot import Along, Plot, View
from ..plots import D, largest_radius

A = Along("a, c, radius", "length", lambda course: (0.0, 1.14 * largest_radius(course)))


def _loading(course: Course):
    """Depths and contact radii of loading, dense at the start, where a(d) is vertical."""
    depth, a = course.states.depth[: course.peak + 1], course.states.contact_radius[: course.peak + 1]
    if course.motion is None:
        return depth, a
    start = course.initial_plastic_depth
    fine = start + (depth[-1] - start) * np.linspace(0, 1, 81) ** 2
    return np.append(fine[:1], fine), np.append(a[:1], course.scene.profile.contact_radius(fine))


def zone(course: Course):
    """Loading, unloading and plastic radius over depth; a falls by a step when contact is lost."""
    depth, a, c = course.states.depth, course.states.contact_radius, course.states.plastic_radius
    deeper = depth >= np.maximum.accumulate(depth)
    if course.turns:
        rows = split(depth, a, depth, course.states.live_interval.lower)
        loading = np.concatenate([rows["elastic"], [[np.nan]] * 2, rows["yielding"]], axis=1)
        return tuple(loading), rows["unloading"], (depth[deeper], c[deeper])
    peak, released = course.peak, int(np.flatnonzero(course.states.live_interval.length > 0)[-1]) + 1
    last = c[-1:] if course.states.live_interval.lower[-1] > 0 else a[released : released + 1]
    back = np.append(depth[peak : released + 1], depth[released:])
    past = slice(peak + 1)
    falling = np.concatenate([a[peak:released], last, 0 * depth[released:]])
    return _loading(course), (back, falling), (depth[past], c[past])


def places(view: View, i: int) -> dict:
    states = view.course.states
    depth, a, now_c = states.depth[[i]], states.contact_radius[[i]], states.plastic_radius[[i]]
    rows = {"now": (depth, a), "c now": (depth, np.where(now_c > 0, now_c, np.nan))}
    loading, back, (d, c) = zone(view.course)
    # From the last state on that has not yielded.
    yielded_states = np.flatnonzero(c > c[0])
    subset = slice(max(int(yielded_states[0]) - 1, 0), None) if yielded_states.size else slice(0, 0)
    d, c = d[subset], c[subset]
    rows |= {"contact radius a": loading, "unloading": back, "plastic zone c": (d, c)}
    rows["zone"] = np.append(d, [*d[-1:], *d[:1]]), np.append(c, [0, 0][: 2 * len(d)])
    return rows


def _formula(course: Course) -> str:
    if course.adhesive:
        return "(21)  g(a) = d + Δl,  g(c) = d_p  § 19"
    return "(16) (21)  g(a) = d,  g(c) = d_p"


RADII = Plot(
    "radii", "Contact and plastic zone", _formula, (D, A),
    (
        area("zone", "yielded", 0.13, legend=False),
        line("unloading", "elastic", 1.8, "dashed", "a"),
        line("contact radius a", "elastic", 2.2, symbol="a"),
        line("plastic zone c", "yielded", 3.0, symbol="c"),
        mark("now"),
        mark("c now", legend=False),
    ),
    places, tab="Radii", order=10,
)  # fmt: skip


EXTRA = Extra("radii", plots=(RADII,))
