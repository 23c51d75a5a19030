"""Where the fit of a curve begins: its turning points, and the best of a grid."""

import numpy as np

from ..superposition import radius_integral
from ..yielding import elastic_interval, interval_at
from .curve import NAMES

#: Compliances of the frame to begin with, in units of the range of depth over that of force.
_SOFT = np.array([0.0, 0.05, 0.15, 0.3, 0.5])


def turning_points(depth, least):
    """Where a path turns back from a depth that it had not reached before, and where it set out for it.

    Moves of less than `least` (m) are noise. There is one place to set out from more than there are turning
    points where the path ends deeper than ever.
    """
    turns, lows, place, record = [], [], 0, -np.inf
    rising, low = True, 0
    for i, d in enumerate(depth):
        if (rising and d >= depth[place]) or (not rising and d <= depth[place]):
            place = i
        elif abs(d - depth[place]) > least:
            if not rising:
                low = place
            elif depth[place] > record + least / 2:
                turns, lows, record = [*turns, place], [*lows, low], depth[place]
            rising, place = not rising, i
    if rising and depth[place] > record + least / 2:
        lows.append(low)
    return turns, lows


def first_guess(curves):
    """Scaled parameters to begin with: the best of a grid of contact points and critical depths.

    The force is 2E* times a function of these two, so that E* (and a baseline) follow from each at once.
    """
    count = curves.depth.shape[1]
    some = np.unique(np.linspace(0, count - 1, min(count, 64)).astype(int))
    reach = min(2 * float(curves.length.max()), curves.tip.known_depth)
    steps = reach * np.append(0.0, np.geomspace(1e-5, 1, 300))
    table = steps, radius_integral(curves.tip, elastic_interval(steps))
    peak = _turning(curves)
    found = []
    for row in range(len(curves.depth)):
        curve = curves.rows([row])
        soft = curves.fixed["frame_compliance"][[row]] if "frame_compliance" in curves.fixed else None
        soft = _SOFT * (curve.length / curve.load)[0] if soft is None else soft
        guesses = [_guess(curve, peak[[row]], some, table, float(each)) for each in soft]
        found.append(min(guesses, key=lambda guess: guess["miss"]))
    values = {name: np.array([[each[name]] for each in found]) for name in NAMES}
    return curves.scaled(values, peak)


def _turning(curves):
    """Measured depths at the turning points (R, K), each from some neighbours."""
    near = np.clip(curves.turns[..., None] + np.arange(-2, 3), 0, curves.depth.shape[1] - 1)
    rows = np.arange(len(near))[:, None, None]
    return curves.depth[rows, near].mean(axis=2) if near.size else np.zeros(curves.turns.shape)


def _guess(curve, peak, some, table, compliance):
    """Parameters of one curve by name, and what is missed."""
    held = {name: float(value[0]) for name, value in curve.fixed.items()}
    force, depth = curve.force[0], curve.depth[0]
    top, bottom = force.max(), held.get("baseline", float(np.quantile(force, 0.05)))
    depth = depth - compliance * (force - bottom)
    touched = float(depth[np.argmax(force - bottom > 0.05 * (top - bottom))])
    width = max(float(depth.max()) - touched, 1e-3 * float(curve.length[0, 0]))
    points = touched - width * np.linspace(0, 1, 16) ** 1.5
    point = np.array([held["contact_point"]]) if "contact_point" in held else points
    shares = np.concatenate([np.geomspace(2e-3, 0.5, 13), [0.65, 0.8, 0.92, 3.0]])
    if {"E_star", "q_c"} <= set(held) or held.get("q_c") == np.inf:
        shares = np.array([np.nan])
    point, shares = (part.ravel()[:, None] for part in np.meshgrid(point, shares))
    d_c = shares * np.maximum(depth.max() - point, 1e-3 * width)
    if np.isnan(shares).any():
        d_c[:] = np.pi / 2 * held["q_c"] / held.get("E_star", 1.0)
    deepest, _ = curve.memory(depth[None], peak)
    deepest, d, load = deepest[:, some] - point, depth[some] - point, force[some]
    interval = interval_at(deepest, d, d_c)
    unit = 2 * (np.interp(interval.upper, *table) - np.interp(interval.lower, *table))
    modulus, base = _line(unit, load, held, d_c)
    miss = np.sum((load - base - modulus * unit) ** 2, axis=1)
    best = int(np.argmin(np.where(np.isfinite(miss), miss, np.inf)))
    E, d_c = float(modulus[best, 0]), float(d_c[best, 0])
    guess = {"E_star": E, "q_c": 2 / np.pi * E * d_c, "contact_point": float(point[best, 0])}
    guess["miss"] = miss[best]
    return guess | {"baseline": float(base[best, 0]), "frame_compliance": compliance} | held


def _line(unit, load, held, d_c):
    """E* and baseline for which E* times each row of `unit` is nearest to the load (G, 1)."""
    shift = load * 0 + held.get("baseline", 0.0)
    mean, centre = (0.0, 0.0) if "baseline" in held else (unit.mean(axis=1, keepdims=True), load.mean())
    if "E_star" in held:
        modulus = np.full_like(d_c, held["E_star"])
    elif held.get("q_c", np.inf) < np.inf:
        modulus = np.pi / 2 * held["q_c"] / d_c
    else:
        wide = unit - mean
        power = np.sum(wide**2, axis=1, keepdims=True)
        product = np.sum(wide * (load - centre - shift), axis=1, keepdims=True)
        ratio = product / np.maximum(power, 1e-300)
        modulus = np.maximum(ratio, 1e-6 * np.ptp(load) / np.maximum(np.ptp(unit), 1e-300))
    base = np.full_like(d_c, shift[0]) if "baseline" in held else centre - modulus * mean
    return modulus, base
