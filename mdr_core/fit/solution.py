"""Curves with as many turning points are solved together, and compared with an elastic medium."""

import numpy as np

from .._numeric import chunks
from .curve import Curves, critical_depth
from .least_squares import least_squares, roughness
from .start import first_guess, turning_points

#: Curves that share their steps.
_TOGETHER = 64
#: How often turning points are found anew.
_ROUNDS = 5
#: Stands for the logarithm of an infinite q_c.
_LOG_OF_INFINITE = 300.0


def grouped(depth, force, noise):
    """Curves that are solved together: rows, turning points, places to set out from.

    Depth and force turn at once: they are added in units in which the quieter of them weighs more.
    """
    path, variance, least = 0.0, 0.0, 0.0
    for values, sigma in ((depth, noise), (force, _rough(force))):
        size = np.ptp(values, axis=1, keepdims=True)
        weight = 1 / (0.005 + sigma / size)
        path, least = path + weight * values / size, least + 0.02 * weight
        variance = variance + (weight * sigma / size) ** 2
    least = np.maximum(least, 6 * np.sqrt(variance))[:, 0]
    found = [turning_points(row.tolist(), limit) for row, limit in zip(path, least.tolist(), strict=True)]
    kinds = [(len(turns), len(lows)) for turns, lows in found]
    for kind in sorted(set(kinds)):
        rows = np.array([i for i, each in enumerate(kinds) if each == kind])
        for part in chunks(rows.size, _TOGETHER):
            some = rows[part]
            places = (np.array([found[i][j] for i in some], int) for j in (0, 1))
            yield some, *(each.reshape(len(some), count) for each, count in zip(places, kind, strict=True))


def _rough(values):
    """Roughness of rows (R, 1), 0 of too few samples to tell."""
    return roughness(values) if values.shape[1] > 7 else np.zeros((len(values), 1))


def solved(tip, depth, force, fixed, noise, force_noise, rows, turns, lows):
    """Curves with as many turning points: rows, `Curves`, solution, `_elastic`, whether noise is known."""
    depth, force = depth[rows], force[rows]
    fixed = {name: value[rows] for name, value in fixed.items()}
    sigma = _first_sigma(force, noise, force_noise)
    curves = Curves(tip, depth, force, fixed, noise, sigma, turns, lows)
    x, *_ = solution = _minimum(curves)
    for _ in range(_ROUNDS if noise and turns.size else 0):
        before, curves = curves, curves.relabelled(x)
        if np.array_equal(before.turns, curves.turns):
            break
        x, *_ = solution = _minimum(curves, x)
    known = force_noise is not None or noise > 0
    solution, elastic = _elastic(curves, solution, known)
    return rows, curves, solution, elastic, known


def _first_sigma(force, noise, force_noise):
    """Standard deviation of the force (R, N): the one given, or the estimate; of unknown ones a unit."""
    size = np.ptp(force, axis=1, keepdims=True)
    if force_noise is not None:
        size = np.full_like(size, force_noise)
    elif noise:
        size = np.maximum(_rough(force), 1e-6 * size)
    return np.repeat(size, force.shape[1], axis=1)


def _minimum(curves, start=None):
    start = first_guess(curves) if start is None else start
    low, high = np.full_like(start, -np.inf), np.full_like(start, np.inf)
    for i, name in enumerate(curves.free):
        if name in ("E_star", "q_c"):
            low[:, i], high[:, i] = start[:, i] - 16, start[:, i] + 16
        elif name == "frame_compliance":
            low[:, i] = 0.0
        elif name == "contact_point":
            # As far as the tip is known.
            least = curves.depth.max(axis=1) - curves.tip.known_depth
            low[:, i] = np.maximum((least - curves.offset[:, i]) / curves.scale[:, i], -1.0)
            high[:, i] = 1.0
    return least_squares(curves.residuals, start, low, high)


def _elastic(curves, solution, known):
    """The solution, and whether an elastic medium is further away (0), about as near (1), or nearer (2).

    Where it is nearer the solution becomes the elastic one. Within an elastic medium q_c has no derivative:
    from there the search begins once more, below the largest depth.
    """
    elastic = np.zeros(len(curves.depth), int)
    if "q_c" in curves.fixed:
        return solution, elastic + 2 * np.isinf(curves.fixed["q_c"])
    place, freedom = curves.free.index("q_c"), max(solution[1].shape[1] - solution[0].shape[1], 1)
    share = _yield_share(curves, solution[0])
    rows = np.flatnonzero(share > 0.5)
    if not rows.size:
        return solution, elastic
    some, start = curves.rows(rows), solution[0][rows]
    start[:, place] += np.minimum(np.log(0.85 / share[rows]), 0.0)
    trials = [_minimum(some, start)]
    held = some.holding(q_c=np.full(rows.size, np.inf))
    x, residual, jacobian = _minimum(held, np.delete(solution[0][rows], place, axis=1))
    trials.append(
        (np.insert(x, place, _LOG_OF_INFINITE, axis=1), residual, np.insert(jacobian, place, 0.0, axis=2))
    )
    costs = np.array([np.sum(part[1] ** 2, axis=1) for part in ((None, solution[1][rows]), *trials)])
    noise = np.ones(rows.size) if known else costs.min(axis=0) / freedom
    gain = (costs[2] - costs[:2].min(axis=0)) / np.maximum(noise, 1e-300)
    small = costs[2] <= 1e-24 * solution[1].shape[1]
    nearer = (gain <= 2) | small
    chosen = np.where(nearer, 2, np.argmin(costs[:2], axis=0))
    for k, trial in enumerate(trials, start=1):
        for whole, part in zip(solution, trial, strict=True):
            whole[rows[chosen == k]] = part[chosen == k]
    elastic[rows] = np.where(nearer, 2, gain <= 9)
    return solution, elastic


def _yield_share(curves, x):
    """Critical depth over the largest depth of each curve."""
    values, _, state = curves.states(x)
    return critical_depth(values)[:, 0] / state.depth.max(axis=1)
