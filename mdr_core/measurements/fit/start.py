"""Starts of the search for a curve: the best points of a grid of first contacts and media.

The force is a background plus E* times a function of first contact, of the hardness constants over E*, and
of the relaxation time or the work of adhesion. Linear regression gives E* and the parameters of the
background.
"""

import numpy as np

from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from ...solver.contact.yielding import interval_at
from ...solver.medium.medium import critical_depth, yield_constant
from .adhesion import in_contact
from .parameters import BACKGROUND, MEDIUM, REACH

#: Trial depths of contact at the largest depth, in units of the range of depth.
_DEPTHS = np.geomspace(3e-3, 1 + REACH, 48)
#: Trial caps as shares of the largest depth, and shares of one, two or three constants in the cap.
_SHARES = np.concatenate([np.geomspace(2e-3, 0.5, 13), [0.65, 0.8, 0.92, 3.0]])
_MIXTURES = {
    1: np.ones((1, 1)),
    2: np.array([[0.9, 0.1], [0.5, 0.5], [0.1, 0.9]]),
    3: np.array([[0.8, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.8], [0.4, 0.3, 0.3]]),
}
#: Trial relaxation times, as shares of the largest depth over the largest rate.
_LAGS = np.append(0.0, np.geomspace(0.01, 4.0, 10))
#: Trial stretches at the rim, at the largest depth and as shares of it.
_STRETCHES = np.geomspace(0.03, 4.0, 14)
#: Largest cap, as a share of the largest depth, for which springs carry much less than dashpots. A search
#: from such a start does not return to a medium whose springs matter.
_DASHPOTS = 0.05
#: Largest number of starts, and largest sum of squares of a start in units of the smallest sum.
_STARTS, _CLOSE = 4, 20.0


def first_guesses(curves):
    """Yield starts of a search, the best first, each with its rows and their scaled parameters.

    They are the minima over the trial first contacts.
    """
    largest = min((1 + REACH) * float(curves.length.max()), curves.profile.known_depth)
    depths = largest * np.append(0.0, np.geomspace(1e-7, 1, 600))
    radius = curves.profile.radius_at(depths)
    table = depths, integrals(curves.profile).radius_integral(LiveInterval.elastic(depths)), radius
    turning_depth = curves.first_turning_depth()
    count = len(curves.depth)
    guesses = [_guesses(curves.rows([row]), turning_depth[[row]], table) for row in range(count)]
    for k in range(max(map(len, guesses))):
        rows = np.array([i for i, minima in enumerate(guesses) if len(minima) > k])
        values = {name: np.array([[guesses[i][k][name]] for i in rows]) for name in curves.free}
        yield rows, curves.rows(rows).scaled(values | {"turning_depth": turning_depth[rows]})


def _guesses(curve, turning_depth, table):
    """Return the free parameters of one curve by name at the minima over first contact, the best first."""
    held = {name: float(value[0]) for name, value in curve.held.items()}
    depth = curve.depth[0]
    top, length = float(curve.top[0, 0]), float(curve.length[0, 0])
    points = top - np.minimum(length * _DEPTHS, curve.profile.known_depth)
    if "contact_point" in held:
        points = np.array([held["contact_point"]])
    count = min(depth.size, 512 if curve.held_elastic else 64)
    samples = np.union1d(np.linspace(0, depth.size - 1, count).astype(int), np.argmax(depth))
    largest_depth = np.maximum(top - points, 1e-3 * length)[:, None]
    if curve.adhesive:
        media = _adhesive_media(curve, held, largest_depth)
        unit_force = _adhesive_force(depth[samples], points, media["kappa"], table)
    else:
        media = _media(curve, held, largest_depth)
        largest = curve.largest_so_far(curve.depth, turning_depth)[0][:, samples]
        point, rate = points[:, None, None], curve.rate[0, samples]
        unit_force = _unit_force(largest - point, depth[samples] - point, rate, media, table)
    E_star, sum_of_squares, background = _regression(curve, held, samples, unit_force, media)
    chosen = []
    for kind in _kinds(curve, media, largest_depth):
        best = np.where(kind, sum_of_squares, np.inf).argmin(axis=1)
        place = np.arange(points.size), best
        trials = {name: values[place] for name, values in media.items()} | {"E_star": E_star[place]}
        values = {name: parameter.start(trials) for name, parameter in MEDIUM.items() if name in curve.free}
        values |= background(best) | {"contact_point": points}
        least = sum_of_squares[place]
        for i in _minima(least):
            chosen.append((least[i], {name: float(values[name][i]) for name in curve.free}))
    return [start for _, start in sorted(chosen, key=lambda pair: pair[0])]


def _minima(sum_of_squares):
    """Return indices of the smallest minima of the sum of squares over first contact, the best first."""
    around = np.concatenate([[np.inf], sum_of_squares, [np.inf]])
    minima = (
        (sum_of_squares <= around[:-2])
        & (sum_of_squares < around[2:])
        & (sum_of_squares <= _CLOSE * sum_of_squares.min())
    )
    return sorted(np.flatnonzero(minima), key=lambda i: sum_of_squares[i])[:_STARTS]


def _kinds(curve, media, depth):
    """Return masks of the trial media (M,) with separate starts: mainly dashpots, and others."""
    cap = media["cap"][0] / depth[0, 0] if "cap" in media and "eta" in curve.free else np.zeros(1)
    few = cap < _DASHPOTS
    return [few, ~few] if few.any() and not few.all() else [np.ones(few.shape, bool)]


def _media(curve, held, depth):
    """Return the trial media by name, arrays (Z, M), at largest depths (Z, 1).

    They have the constants of the hardness over E*, τ = 4η/E* (s) and κ = w/E* (m).
    """
    names = curve.constants
    known = curve.held_elastic or {"E_star", *names} <= set(held)
    mixtures = _MIXTURES[1 if known else len(names)]
    caps = (depth if known else depth * _SHARES)[:, :, None] * np.ones(len(mixtures))
    radius = curve.profile.radius_at(np.minimum(depth, curve.profile.known_depth))[:, :, None]
    of_one = {"hardness": 1 / radius, "q_c": 1.0, "f_c": radius}
    media = {}
    for name, shares in zip(names, mixtures.T, strict=True):
        if known or {"E_star", name} <= set(held):
            trial = np.full_like(caps, held[name] / held.get("E_star", 1.0))
        else:
            trial = of_one[name] * yield_constant(1.0, caps * shares)
        media[name] = trial.reshape(len(depth), -1)
    if held.get("eta") == 0:
        tau = np.zeros_like(depth)
    elif {"E_star", "eta"} <= set(held):
        tau = np.full_like(depth, 4 * held["eta"] / held["E_star"])
    else:
        tau = depth * _LAGS / max(float(curve.speed[0, 0]), 1e-300)
    count = caps[0].size
    if not known:
        media["cap"] = caps.reshape(len(depth), -1)
    media = {name: np.repeat(trial, tau.shape[1], axis=1) for name, trial in media.items()}
    tau = np.tile(tau, (1, count))
    return media | {"tau": tau, "kappa": np.zeros_like(tau)}


def _adhesive_media(curve, held, depth):
    """Return the values of `_media` for elastic media with adhesion."""
    if {"E_star", "work_of_adhesion"} <= set(held):
        kappa = np.full_like(depth, held["work_of_adhesion"] / held["E_star"])
    else:
        radius = curve.profile.radius_at(np.minimum(depth, curve.profile.known_depth))
        kappa = (depth * _STRETCHES) ** 2 / (2 * np.pi * radius)
    return {"q_c": np.full_like(kappa, np.inf), "tau": np.zeros_like(kappa), "kappa": kappa}


def _unit_force(largest, depth, rate, media, table):
    """Return the force over E* (m²) of trial media, from a table."""
    depths, area, radius = table
    tau = media["tau"][..., None]
    lag = tau * rate
    interval = interval_at(largest, depth + np.minimum(lag, 0.0), _cap(largest, media, table))
    force = 2 * (np.interp(interval.upper, depths, area) - np.interp(interval.lower, depths, area))
    if tau.any():
        contact_radius = np.interp(interval.upper, depths, radius)
        force += 2 * np.where(interval.length > 0, np.maximum(lag, 0.0) * contact_radius, 0.0)
    return force


def _cap(largest, media, table):
    """Return the cap (m) of trial media at largest depths (m) so far, from a table."""
    depths, _, radii = table
    # The first radius may be 0.
    a = np.maximum(np.interp(largest, depths, radii), radii[1])
    factors = {"hardness": a, "q_c": 1.0, "f_c": 1 / a}
    return critical_depth(
        1.0, sum(media[name][..., None] * factors[name] for name in factors if name in media)
    )


def _adhesive_force(depth, points, kappa, table):
    """Return the force over E* (m²) of elastic media with adhesion w/E* (m), from a table."""
    depths, area, radius = table
    force = np.empty((*kappa.shape, depth.size))
    for i, j in np.ndindex(kappa.shape):
        stretched = np.sqrt(2 * np.pi * radius * kappa[i, j])
        reached = depths - stretched
        end = int(np.argmin(reached))
        tension = np.interp(depth - points[i], reached[end:], (area - radius * stretched)[end:])
        force[i, j] = np.where(in_contact(depth - points[i], reached[end]), 2 * tension, 0.0)
    return force


def _held_modulus(curve, held, media):
    """Return E* (Pa) of trial media if it, or a constant that determines it, is held; otherwise None."""
    if "E_star" in held:
        return np.full_like(media["tau"], held["E_star"])
    if held.get("work_of_adhesion"):
        return held["work_of_adhesion"] / media["kappa"]
    for name in curve.constants:
        if held.get(name, np.inf) < np.inf:
            return held[name] / media[name]
    return None


def _regression(curve, held, samples, unit_force, media):
    """Fit E* × unit force + background to the force, for each trial (Z, M).

    The free parameters of the background are projected out. Return E*, the sums of squares, and a function
    that returns these parameters by name, for one medium in each row.
    """
    force, weight = curve.force[0, samples], curve.sigma[0].min() / curve.sigma[0, samples]
    columns = {name: column[0, samples] for name, column in curve.background_columns.items()}
    force = force - sum(held[name] * columns[name] for name in BACKGROUND if name in held)
    free = [name for name in BACKGROUND if name in curve.free]
    used = np.reshape([weight * columns[name] for name in free], (len(free), samples.size))
    basis, triangle = np.linalg.qr(used.T)
    weighted = weight * unit_force
    deviation = weight * force - basis @ (basis.T @ (weight * force))
    projected = weighted
    if free:
        projected = weighted - (weighted @ basis) @ basis.T
    E_star = _held_modulus(curve, held, media)
    if E_star is None:
        power = np.einsum("zmn,zmn->zm", projected, projected)
        smallest = 1e-6 * np.ptp(force) / np.maximum(np.ptp(unit_force), 1e-300)
        E_star = np.maximum(projected @ deviation / np.maximum(power, 1e-300), smallest)
    sum_of_squares = np.sum((deviation - E_star[..., None] * projected) ** 2, axis=-1)
    sum_of_squares = np.where(np.isfinite(sum_of_squares), sum_of_squares, np.finfo(float).max)

    def background(best):
        row = np.arange(len(sum_of_squares))
        remainder = weight * force - E_star[row, best, None] * weighted[row, best]
        values = np.linalg.lstsq(triangle, (remainder @ basis).T, rcond=None)[0] if free else ()
        return dict(zip(free, values, strict=True))

    return E_star, sum_of_squares, background
