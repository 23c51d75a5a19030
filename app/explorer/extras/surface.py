"""The plot *Surface*: the deformed surface with its imprint, below the tip."""

import numpy as np

from mdr_core.show.figures import NOTHING, RADII, area, at_radii, both, line

from ..courses import Course
from ..extra import Extra
from ..plot import AxisSpec, Plot, View
from ..plots import deepest, largest_radius


def _around(course: Course) -> tuple[float, float]:
    half = 2.1875 * largest_radius(course)
    return -half, half


R = AxisSpec("r, radius", "length", _around)
Z = AxisSpec("z, upward", "length", lambda course: (-1.2 * deepest(course), deepest(course)))
#: Places of points between two edges, dense at the edges because the surface is steep there.
_DENSE = (1 - np.cos(np.linspace(0, np.pi, 20))) / 2


def surface(view: View, i: int) -> dict:
    state, profile = view.course.states[i], view.course.scene.profile
    across, z = view.axis(R), view.axis(Z)
    half, far = 1.1 * across.end, 3 * z.end
    a, c = float(state.contact_radius), float(state.plastic_radius)
    edges = {0.0, c, a, profile.face_radius, profile.wall, np.nextafter(profile.wall, np.inf), half}
    edges = np.array(sorted(edge for edge in edges if edge <= half))
    r = np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * _DENSE, edges))
    known = r[r <= profile.known_radius]
    # Up to the end of the axis, also at the wall of a punch.
    tip = np.minimum(profile.height(known) - state.depth, far)
    imprint = 0.0 - state.imprint(r)
    beside, height = r > a, imprint.copy()
    height[beside] -= state.surface(r[beside])
    if a > 0:
        # In the contact the surface is the tip.
        height[~beside] = tip[: np.count_nonzero(~beside)]
    ends, bottom = np.array([-half, half]), np.full(2, z.start)
    surface = both(r, -1), both(height)
    return at_radii(a, c, across.end, z.start, z.end) | {
        "tip z(r)": (np.pad(both(known, -1), 1, "edge"), np.pad(both(tip), 1, constant_values=far)),
        "medium": (np.append(surface[0], ends[::-1]), np.append(surface[1], bottom)),
        "undeformed": (ends, np.zeros(2)),
        "deformed surface": surface,
        "residual imprint": (both(r, -1), both(imprint)) if state.live_interval.lower > 0 else NOTHING,
    }


SURFACE = Plot(
    "surface", "Surface and imprint", "u(r) = ∫ (2/π) arcsin(a(s)/r) ds,  a(s) < r  § 7",
    (R, Z),
    (
        area("tip z(r)", "body", 0.55),
        area("medium", "free", 0.16, legend=False),
        line("undeformed", "free", 1.0, "dashed", legend=False),
        line("deformed surface", "elastic", 2.2, symbol="z"),
        line("residual imprint", "yielded", 2.0, "dotted", symbol="z"),
        *RADII,
    ),
    places=surface, tab="Surface", order=70,
)  # fmt: skip


EXTRA = Extra("surface", plots=(SURFACE,))
