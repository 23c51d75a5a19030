"""The deformed surface with the tip in it, and the imprint that is left, as a section in r and z."""

from dataclasses import replace

import numpy as np

from mdr_core.results.figures import NOTHING, at_radii, both

#: Where points lie between edges, at which the surface is steep.
_DENSE = (1 - np.cos(np.linspace(0, np.pi, 20))) / 2


def axes(view):
    """Radius and height of the section, as is chosen: the heights exaggerated, or to scale."""
    r, z = view.axes["section r"], view.axes["section z"]
    if view.chosen["heights"] == "exaggerated":
        return [r, z]
    reach = max(0.9 * r.end, -z.start)
    return [r, replace(r, title="z, height to scale", start=-reach, end=reach)]


def moving(view, i):
    """Rows of the section in state i."""
    state, profile = view.way.states[i], view.way.scene.profile
    across, z = axes(view)
    half, far = 1.1 * across.end, 3 * z.end
    a, c = float(state.contact_radius), float(state.plastic_radius)
    edges = {0.0, c, a, profile.face_radius, profile.wall, np.nextafter(profile.wall, np.inf), half}
    edges = np.array(sorted(edge for edge in edges if edge <= half))
    r = np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * _DENSE, edges))
    known = r[r <= profile.known_radius]
    # As far up as the axis reaches, also at the wall of a punch.
    tip = np.minimum(profile.height(known) - state.depth, far)
    imprint = 0.0 - state.imprint(r)
    beside, height = r > a, imprint.copy()
    height[beside] -= state.surface(r[beside])
    if a > 0:
        # Under the contact the surface is the tip.
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
