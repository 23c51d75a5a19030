"""Drawing of the springs of the 1D foundation: rows, and their columns in SI units."""

import numpy as np

from .figures import RADII, area, at_radii, both, line

#: Number of springs. Heights of the vertices of one spring from base (0) to top (1), and their offsets,
#: each with a gap at the end.
SPRINGS = 60
_ALONG = np.array([0, 0.14, 0.23, 0.41, 0.59, 0.77, 0.86, 1, np.nan])
_BEND = np.array([0, 0, -0.72, 0.72, -0.72, 0.72, 0, 0, np.nan])
#: Depth of the base of the springs over the height of the plot above the surface.
REST = 1.5
SPRING_ROWS = (
    area("profile g(x)", "body", 0.55),
    line("edge", "ink", 1.8, legend=False),
    line("free", "free", 0.9),
    line("elastic", "elastic", 1.3),
    line("yielded", "yielded", 1.5),
    line("stretched", "stick", 1.8),
    line("residual imprint", "yielded", 1.4, "dashed"),
    *RADII,
)


def reduced(profile, x):
    """Return the reduced profile (m), NaN beyond the known radius."""
    return np.where(x <= profile.known_radius, profile.reduced(np.minimum(x, profile.known_radius)), np.nan)


def _outline(profile, half):
    """Return coordinates of the profile g(x) on both sides, with its wall and its edges."""
    edges = [profile.face_radius, profile.wall, profile.wall * (1 + 1e-9)]
    x = np.unique(np.append(np.linspace(0, half, 60), [edge for edge in edges if edge < half]))
    g = reduced(profile, x)
    x, g = x[np.isfinite(g)], g[np.isfinite(g)]
    return both(x, -1), both(g)


def _places(half, state):
    """Return the coordinates of the springs; two springs are moved into a very narrow elastic ring."""
    x = half * (2 * (np.arange(SPRINGS) + 0.5) / SPRINGS - 1)
    a, c = float(state.contact_radius), float(state.plastic_radius)
    if 0 < c < a and not ((np.abs(x) > c) & (np.abs(x) < a)).any():
        nearest = int(np.argmin(np.abs(x - (a + c) / 2)))
        x[[nearest, -1 - nearest]] = (a + c) / 2, -(a + c) / 2
    return x


def _tops(state, x, relaxing=lambda g: 0.0):
    """Return for springs at x: heights g of the indenter, plastic depths, contact, heights of the tops."""
    g, interval = reduced(state.profile, np.abs(x)), state.live_interval
    left = np.fmax(interval.lower - g, 0.0)
    contact = (state.contact_radius > 0) & (g < interval.upper)
    return g, left, contact, np.where(contact, g - state.depth, -left - np.where(contact, 0.0, relaxing(g)))


def spring_line(state, half, relaxing=lambda g: 0.0):
    """Return the line through the tops of all springs for |x| < `half` (m)."""
    a, c = float(state.contact_radius), float(state.plastic_radius)
    edges = [side * radius * (1 + near) for radius in (a, c) for side in (-1, 1) for near in (-1e-6, 1e-6)]
    x = np.unique(np.clip([*np.linspace(-half, half, 161), *edges], -half, half))
    return x, _tops(state, x, relaxing)[3]


def springs(state, half, base, height, relaxing=lambda g: 0.0, along=None):
    """Return rows of the springs for |x| < `half` (m) and of the indenter.

    The plot extends from `base` to `height` (m). `relaxing` maps reduced heights to the elastic compression
    (m) of released elements. With friction, `along` maps radii to the tangential displacement (m) of
    elements, and whether they stick. The scale of this displacement is half the scale of depths.
    """
    profile, interval, far = state.profile, state.live_interval, 3 * height
    x = _places(half, state)
    g, left, contact, top = _tops(state, x, relaxing)
    lean, stick = (0.0 * x, None) if along is None else along(np.abs(x))
    lean = np.where(contact, lean, 0.0)[:, None] * (half / 2 / height) * _ALONG
    path = x[:, None] + _BEND * half / SPRINGS + lean, base + (top[:, None] - base) * _ALONG
    # Springs carry tension only with adhesion.
    adhesive = state.medium.work_of_adhesion > 0
    stretched = contact & adhesive & (np.maximum(g, interval.lower) > state.depth)
    states = {
        "free": ~contact & (left == 0),
        "elastic": contact & (left == 0) & ~stretched,
        "yielded": (left > 0) & ~stretched,
        "stretched": stretched,
    }
    if along is not None:
        states = {name: some & ~contact for name, some in states.items()}
        states |= {"sticks": contact & stick, "slips": contact & ~stick}
    rows = {name: tuple(part[some].ravel() for part in path) for name, some in states.items()}
    edge, (shape_x, shape_g) = np.array([far]), _outline(profile, 1.1 * half)
    body = np.minimum(shape_g - state.depth, far)
    rows["profile g(x)"] = (
        np.concatenate([shape_x[:1], shape_x, shape_x[-1:]]),
        np.concatenate([edge, body, edge]),
    )
    # The same outline as a line; the plot cuts it at the upper edge.
    rows["edge"] = rows["profile g(x)"]
    if interval.lower > 0:
        # Inside c, where its surface is below the virgin one.
        inside = shape_g <= interval.lower
        rows["residual imprint"] = shape_x[inside], shape_g[inside] - interval.lower
    a, c = float(state.contact_radius), float(state.plastic_radius)
    # The lines end below the text on the state, which is above.
    return rows | at_radii(a, c, half, base, 0.45 * height)
