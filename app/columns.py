"""Columns of the plots, by the names of their rows, from a `View` and the number of a state.

x and y of a line, an area or a mark in the units of the axes; x, y and text of a label; left edge and
values of an image.
"""

from itertools import pairwise

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


def _curve(view, axes, *values):
    """x and y (SI) in the units of two axes."""
    return tuple(view.scaled(axis, value) for axis, value in zip(axes, values, strict=True))


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


def _reduced(profile, x):
    """Reduced profile, not a number where the shape is not known."""
    return np.where(x <= profile.known_radius, profile.reduced(np.minimum(x, profile.known_radius)), np.nan)


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


def force_still(view):
    way, held, onset, peak = view.way, view.held, view.way.onset, view.way.peak
    first = min(view.first, peak)
    rows = dict.fromkeys(("onset of yield", "held", "yielding"), _NOTHING)
    rows["unloading"] = view.d[peak:], view.F[peak:]
    rows["elastic"] = view.d[: first + 1], view.F[: first + 1]
    if view.first <= peak:
        rows["yielding"] = view.d[first : peak + 1], view.F[first : peak + 1]
    if onset is not None and (way.motion is None or way.scene.medium.eta == 0):
        rows["onset of yield"] = _curve(view, "dF", [onset.depth], [onset.force])
    if held is not None:
        rows["held"] = _curve(view, "dF", held.states.depth, held.force)
    return rows


def force(view, i):
    way, right = view.way, 0.02 * view.end["d"]
    deepest = min(i, way.peak)
    (lost_d, lost_F), (back_d, back_F) = (_curve(view, "dF", *way.released(k)) for k in (deepest, i))
    d, F = view.d[: deepest + 1], view.F[: deepest + 1]
    lower = view.scaled("d", way.states.live.lower[i])
    place = (max(lower - 3 * right, right), 0.09 * view.end["F"], "dₚ")
    return {
        "dissipated": (np.concatenate([d[:1], d, lost_d]), np.concatenate([[0.0], F, lost_F])),
        "recoverable": (np.append(back_d[:1], back_d), np.append(0.0, back_F)),
        "now": (view.d[[i]], view.F[[i]]),
        "dₚ": place if lower > 0 else (np.nan, np.nan, ""),
    }


def pressure(view, i):
    r, p = view.pressure(i)
    top, half = view.end["p"], view.end["x"]
    r, p = view.scaled("x", r), np.minimum(view.scaled("p", p), 1e3 * top)
    curve, scale = (_both(r, -1), _both(p)), view.unit["a"] / view.unit["x"]
    a, c = view.a[i] * scale, view.c[i] * scale
    mean = view.scaled("p", view.way.states.mean_pressure[i] or np.nan)
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


def _zone(view, way):
    """Loading, unloading and plastic zone: the contact radius falls by a step where the load is gone."""
    depth, a, c = way.states.depth, way.states.contact_radius, way.states.plastic_radius
    peak, gone = way.peak, int(np.flatnonzero(way.states.live.length > 0)[-1]) + 1
    last = c[-1:] if way.states.live.lower[-1] > 0 else a[gone : gone + 1]
    back = (
        np.append(depth[peak : gone + 1], depth[gone:]),
        np.concatenate([a[peak:gone], last, 0 * depth[gone:]]),
    )
    loading, zone = ((depth[: peak + 1], radius[: peak + 1]) for radius in (a, c))
    return [_curve(view, "da", *rows) for rows in (loading, back, zone)]


def radii_still(view):
    loading, back, (d, c) = _zone(view, view.way)
    some = slice(max(view.first - 1, 0), None) if view.first <= view.way.peak else slice(0, 0)
    d, c = d[some], c[some]
    rows = {"contact radius a": loading, "unloading": back, "plastic zone c": (d, c)}
    rows["zone"] = np.append(d, [*d[-1:], *d[:1]]), np.append(c, [0, 0][: 2 * len(d)])
    rows |= {"held a": _NOTHING, "held c": _NOTHING}
    if view.held is not None:
        loading, back, rows["held c"] = _zone(view, view.held)
        rows["held a"] = tuple(map(np.append, loading, back))
    return rows


def radii_marks(view, i):
    return {"now": (view.d[[i]], view.a[[i]]), "c now": (view.d[[i]], view.c[[i]])}


def motion_still(view):
    t, held = view.scaled("t", view.way.motion.time), view.held
    rows = {"depth d": (t, view.d), "force F": (t, view.F), "held": _NOTHING}
    if held is not None and held.motion is not None:
        rows["held"] = _curve(view, "tF", held.motion.time, held.force)
    return rows


def motion(view, i):
    t = view.scaled("t", view.way.motion.time[[i]])
    end = np.array([0.0, view.end["d"]])
    return {"time": (t.repeat(2), end), "now": (t, view.d[[i]]), "F now": (t, view.F[[i]])}


def energy_still(view):
    m = view.way.motion
    t, parts = view.scaled("t", m.time), (m.plastic_work, m.viscous_work, m.stored_energy, m.kinetic_energy)
    sums = view.scaled("E", np.cumsum([np.zeros_like(m.time), *parts], axis=0))
    both = np.append(t, t[::-1])
    between = [(both, np.append(upper, lower[::-1])) for lower, upper in pairwise(sums)]
    rows = dict(zip(("plastic", "viscous", "stored", "kinetic"), between, strict=True))
    return rows if m.viscous_work.any() else rows | {"viscous": _NOTHING}


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
