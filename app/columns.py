"""Columns of the plots, by the names of their rows, from a `View` and the number of a state.

x and y of a line, an area or a mark in the units of the axes; x, y and text of a label; left edge and
values of an image.
"""

import numpy as np

from .view import REST

SPRINGS, PIXELS = 60, 64
# A spring from its base (0) to its top (1), and how far it bends sideways; then a gap.
_ALONG = np.array([0, 0.14, 0.23, 0.41, 0.59, 0.77, 0.86, 1, np.nan])
_BEND = np.array([0, 0, -0.72, 0.72, -0.72, 0.72, 0, 0, np.nan])
_NOTHING = np.array([np.nan]), np.array([np.nan])


def _both(values, sign=1):
    """Mirrored to both sides of the axis."""
    return np.concatenate([sign * values[::-1], values])


def _at_radii(view, i, bottom, top):
    """Lines at ±a and ±c, and their names beside them: c on the inside where they are close."""
    half, scale = view.end["x"], view.unit["a"] / view.unit["x"]
    a, c = view.a[i] * scale or np.nan, view.c[i] * scale
    y = np.array([bottom, top, np.nan, bottom, top])
    beside = -0.05 if a - c < 0.11 * half else 0.05
    return {
        "at a": (np.array([-a, -a, a, a, a]), y),
        "at c": (np.array([-c, -c, c, c, c]), y),
        "a": (a + 0.03 * half, 0.98 * top, "a"),
        "c": (c + (0.03 if beside > 0 else -0.08) * half, 0.98 * top, "c"),
    }


# 1D foundation.


def _reduced(profile, x):
    """Reduced profile, not a number where the shape is not known."""
    known = x <= profile.known_radius
    return np.where(known, profile.reduced(np.where(known, x, 0.0)), np.nan)


def _outline(view):
    """The profile g(x) to both sides, in the units of the axes, with its wall and its edges."""
    profile, half = view.way.scene.profile, 1.1 * view.end["x"] * view.unit["x"]
    edges = [profile.face_radius, profile.wall, profile.wall * (1 + 1e-9)]
    x = np.unique(np.append(np.linspace(0, half, 60), [edge for edge in edges if edge < half]))
    g = _reduced(profile, x)
    x, g = x[np.isfinite(g)] / view.unit["x"], g[np.isfinite(g)] / view.unit["z"]
    return _both(x, -1), _both(g)


def _relaxing(view, i, g):
    """What is left (m) of the elastic compression of elements that have let go of a viscous rebound."""
    way, tau = view.way, view.way.scene.medium.relaxation_time
    if way.motion is None or tau == 0 or i <= way.peak:
        return 0.0
    past = slice(way.peak, i + 1)
    upper, time = way.states.live.upper[past], way.motion.time[past]
    ahead = way.states.depth[past] - upper
    gone = np.minimum(np.searchsorted(-upper, -g), len(upper) - 1)
    return np.where(g >= upper[-1], ahead[gone] * np.exp((time[gone] - time[-1]) / tau), 0.0)


def springs(view, i):
    profile, live, half = view.way.scene.profile, view.way.states.live[i], view.end["x"]
    depth, far, rest = float(view.way.states.depth[i]), 3 * view.end["z"], -REST * view.end["z"]
    x = half * (2 * (np.arange(SPRINGS) + 0.5) / SPRINGS - 1)
    g = _reduced(profile, np.abs(x) * view.unit["x"])
    left = np.fmax(live.lower - g, 0.0)
    contact = (live.length > 0) & (g < live.upper)
    top = np.where(contact, g - depth, -left - np.where(contact, 0.0, _relaxing(view, i, g)))
    path = x[:, None] + _BEND * half / SPRINGS, rest + (view.scaled("z", top)[:, None] - rest) * _ALONG
    states = {"free": ~contact & (left == 0), "elastic": contact & (left == 0), "yielded": left > 0}
    rows = {name: tuple(part[some].ravel() for part in path) for name, some in states.items()}
    edge, (shape_x, shape_g) = np.array([far]), _outline(view)
    lower = live.lower / view.unit["z"]
    return rows | _at_radii(view, i, rest, view.end["z"]) | {
        "profile g(x)": (
            np.concatenate([shape_x[:1], shape_x, shape_x[-1:]]),
            np.concatenate([edge, np.minimum(shape_g - view.scaled("z", depth), far), edge]),
        ),
        "residual imprint": (shape_x, 0.0 - np.maximum(lower - shape_g, 0)) if lower > 0 else _NOTHING,
    }  # fmt: skip


# Force and depth.


def force_still(view):
    way, d, F = view.way, view.d, view.F
    first, peak, onset, held = min(view.first, way.peak), way.peak, way.onset, view.held
    rows = {
        "unloading": (d[peak:], F[peak:]),
        "elastic": (d[: first + 1], F[: first + 1]),
        "yielding": (d[first : peak + 1], F[first : peak + 1]) if view.first <= peak else _NOTHING,
        "onset of yield": _NOTHING,
        "held": _NOTHING,
    }
    if onset is not None and (way.motion is None or way.scene.medium.eta == 0):
        at = (np.array([float(value)]) for value in (onset.depth, onset.force))
        rows["onset of yield"] = tuple(view.scaled(axis, v) for axis, v in zip("dF", at, strict=True))
    if held is not None:
        rows["held"] = view.scaled("d", held.states.depth), view.scaled("F", held.force)
    return rows


def force(view, i):
    way, right = view.way, 0.02 * view.end["d"]
    deepest = min(i, way.peak)
    lost, back = (
        [view.scaled(axis, v) for axis, v in zip("dF", way.released(k), strict=True)] for k in (deepest, i)
    )
    d, F = view.d[: deepest + 1], view.F[: deepest + 1]
    lower = view.scaled("d", way.states.live.lower[i])
    imprint = (
        (max(lower - 3 * right, right), 0.09 * view.end["F"], "dₚ") if lower > 0 else (np.nan, np.nan, "")
    )
    return {
        "dissipated": (np.concatenate([d[:1], d, lost[0]]), np.concatenate([[0.0], F, lost[1]])),
        "recoverable": (np.append(back[0][:1], back[0]), np.append(0.0, back[1])),
        "now": (view.d[[i]], view.F[[i]]),
        "dₚ": imprint,
    }


# Contact pressure.


def pressure(view, i):
    r, p = view.pressure(i)
    top, half = view.end["p"], view.end["x"]
    r, p = view.scaled("x", r), np.minimum(view.scaled("p", p), 1e3 * top)
    curve, scale = (_both(r, -1), _both(p)), view.unit["a"] / view.unit["x"]
    a, c = view.a[i] * scale, view.c[i] * scale
    mean = (
        view.F[i] * view.unit["F"] / (np.pi * (a * view.unit["x"]) ** 2) / view.unit["p"]
        if a > 0
        else np.nan
    )
    return _at_radii(view, i, 0.0, top) | {
        "plastic zone r < c": (np.array([-c, c, c, -c]), np.array([0, 0, top, top])),
        "below": curve,
        "−σzz(r)": curve,
        "mean F/(πa²)": (np.array([-a, a]), np.array([mean, mean])),
        "beyond": (-0.97 * half, 0.98 * top, view.beyond(i)),
    }


def pressure_still(view):
    if view.held is None:
        return {"held": _NOTHING}
    held = view.held
    r = held.radii(held.now, view.end["x"] * view.unit["x"])
    p = np.minimum(view.scaled("p", held.pressure(held.now, r)), 1e3 * view.end["p"])
    return {"held": (_both(view.scaled("x", r), -1), _both(p))}


# Contact radius and plastic zone.


def _zone(way):
    """Depths and radii of a way: the contact radius falls by a step where the load is gone."""
    depth, a, c = way.states.depth, way.states.contact_radius, way.states.plastic_radius
    gone = int(np.flatnonzero(way.states.live.length > 0)[-1]) + 1
    lower = way.states.live.lower[-1:]
    back = (
        np.concatenate([depth[way.peak : gone], depth[gone : gone + 1], depth[gone:]]),
        np.concatenate(
            [a[way.peak : gone], c[-1:] if lower[0] > 0 else a[gone : gone + 1], 0 * depth[gone:]]
        ),
    )
    return (depth[: way.peak + 1], a[: way.peak + 1]), back, (depth[: way.peak + 1], c[: way.peak + 1])


def radii_still(view):
    def scaled(rows):
        return view.scaled("d", rows[0]), view.scaled("a", rows[1])

    loading, back, zone = map(scaled, _zone(view.way))
    some = slice(max(view.first - 1, 0), None) if view.first <= view.way.peak else slice(0, 0)
    d, c = zone[0][some], zone[1][some]
    closed = np.append(d, [d[-1], d[0]]) if len(d) else d, np.append(c, [0, 0]) if len(d) else c
    rows = {"zone": closed, "contact radius a": loading, "unloading": back, "plastic zone c": (d, c)}
    rows |= {"held a": _NOTHING, "held c": _NOTHING}
    if view.held is not None:
        loading, back, zone = map(scaled, _zone(view.held))
        rows["held a"] = tuple(np.append(*pair) for pair in zip(loading, back, strict=True))
        rows["held c"] = zone
    return rows


def radii_marks(view, i):
    return {"now": (view.d[[i]], view.a[[i]]), "c now": (view.d[[i]], view.c[[i]])}


# An impact in time.


def motion_still(view):
    t = view.scaled("t", view.way.motion.time)
    rows = {"depth d": (t, view.d), "force F": (t, view.F), "held": _NOTHING}
    if view.held is not None and view.held.motion is not None:
        rows["held"] = view.scaled("t", view.held.motion.time), view.scaled("F", view.held.force)
    return rows


def motion(view, i):
    t = view.scaled("t", view.way.motion.time[[i]])
    end = np.array([0.0, view.end["d"]])
    return {"time": (t.repeat(2), end), "now": (t, view.d[[i]]), "F now": (t, view.F[[i]])}


def energy_still(view):
    m = view.way.motion
    t, parts = view.scaled("t", m.time), (m.plastic_work, m.viscous_work, m.stored_energy, m.kinetic_energy)
    sums = view.scaled("E", np.cumsum([np.zeros_like(m.time), *parts], axis=0))
    names = ("plastic", "viscous", "stored", "kinetic")
    both = np.append(t, t[::-1])
    rows = {
        n: (both, np.append(upper, lower[::-1]))
        for n, lower, upper in zip(names, sums, sums[1:], strict=False)
    }
    if not m.viscous_work.any():
        rows["viscous"] = _NOTHING
    return rows


def energy(view, i):
    return {"time": (view.scaled("t", view.way.motion.time[[i, i]]), np.array([0.0, view.end["E"]]))}


def plane(view, i):
    half = view.end["x"]
    r, p = view.pressure(i)
    at = half * (2 * (np.arange(PIXELS) + 0.5) / PIXELS - 1)
    p = np.minimum(view.scaled("p", p), view.end["p"])
    image = np.interp(np.hypot(at, at[:, None]), view.scaled("x", r), p, right=0.0)
    turn, scale = np.linspace(0, 2 * np.pi, 73), view.unit["a"] / view.unit["x"]
    rings = {"contact radius a": view.a[i] * scale, "plastic zone c": view.c[i] * scale}
    return {"image": (np.array([-half]), image.ravel())} | {
        name: (radius * np.cos(turn), radius * np.sin(turn)) for name, radius in rings.items()
    }
