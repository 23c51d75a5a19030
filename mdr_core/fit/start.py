"""Start of the fit of a curve: its turning points, and the best parameters of a grid."""

import numpy as np

from ..medium import critical_depth, yield_constant
from ..superposition import radius_integral
from ..yielding import elastic_interval, interval_at
from .curve import PARAMETERS, REACH

#: Trial frame compliances, in units of the range of depth over the range of force.
_COMPLIANCES = np.array([0.0, 0.05, 0.15, 0.3, 0.5])
#: Trial depths of contact at the largest depth, in units of the range of depth.
_DEPTHS = np.geomspace(3e-3, 1 + REACH, 48)
#: Trial critical depths, as shares of the largest depth.
_SHARES = np.concatenate([np.geomspace(2e-3, 0.5, 13), [0.65, 0.8, 0.92, 3.0]])
#: Largest number of starts, and largest sum of squares of a start in units of the smallest one.
_STARTS, _CLOSE = 4, 20.0


def turning_points(depth, threshold):
    """Indices where a path turns back from a new largest depth, and where each of these loadings starts.

    Moves of less than `threshold` (m) are noise. A path that ends at a new largest depth has one more start
    than turning points.
    """
    turns, starts, extreme, largest = [], [], 0, -np.inf
    rising, start = True, 0
    for i, d in enumerate(depth):
        if (rising and d >= depth[extreme]) or (not rising and d <= depth[extreme]):
            extreme = i
        elif abs(d - depth[extreme]) > threshold:
            if not rising:
                start = extreme
            elif depth[extreme] > largest + threshold / 2:
                turns, starts, largest = [*turns, extreme], [*starts, start], depth[extreme]
            rising, extreme = not rising, i
    if rising and depth[extreme] > largest + threshold / 2:
        starts.append(start)
    return turns, starts


def first_guesses(problem):
    """Starts of a search, the best first, each with its rows and their scaled parameters.

    They are the minima over a grid of contact points, with the best critical depth and frame compliance of
    grids. The force is E* times a function of these: E* and baseline follow by linear regression.
    """
    largest = min((1 + REACH) * float(problem.length.max()), problem.profile.known_depth)
    depths = largest * np.append(0.0, np.geomspace(1e-7, 1, 600))
    table = depths, radius_integral(problem.profile, elastic_interval(depths))
    turning_depth = _turning_depth(problem)
    count = len(problem.depth)
    guesses = [_guesses(problem.rows([row]), turning_depth[[row]], table) for row in range(count)]
    for k in range(max(map(len, guesses))):
        rows = np.array([i for i, minima in enumerate(guesses) if len(minima) > k])
        values = {name: np.array([[guesses[i][k][name]] for i in rows]) for name in PARAMETERS}
        yield rows, problem.rows(rows).scaled(values, turning_depth[rows])


def _turning_depth(problem):
    """Measured depths (m) at the turning points (R, K), means of five samples."""
    last = problem.depth.shape[1] - 1
    neighbours = np.clip(problem.turning_points[..., None] + np.arange(-2, 3), 0, last)
    return np.take_along_axis(problem.depth[:, None], neighbours, axis=2).mean(axis=2)


def _guesses(curve, turning_depth, table):
    """Parameters of one curve by name at the minima over its contact points, the best first."""
    fixed = {name: float(value[0]) for name, value in curve.fixed.items()}
    compliances = _COMPLIANCES * float((curve.length / curve.load)[0, 0])
    compliances = [fixed["frame_compliance"]] if "frame_compliance" in fixed else compliances
    grids = [_grid(curve, fixed, turning_depth, table, C) for C in compliances]
    trials = [min(column, key=lambda trial: trial["squares"]) for column in zip(*grids, strict=True)]
    squares = np.array([np.inf, *(trial["squares"] for trial in trials), np.inf])
    minima = (squares[1:-1] <= squares[:-2]) & (squares[1:-1] < squares[2:])
    minima &= squares[1:-1] <= _CLOSE * squares.min()
    return sorted((trials[i] for i in np.flatnonzero(minima)), key=lambda trial: trial["squares"])[:_STARTS]


def _grid(curve, fixed, turning_depth, table, compliance):
    """Parameters by name and sum of squares of the best critical depth for each contact point."""
    force, depth = curve.force[0], curve.depth[0]
    count = min(depth.size, 512 if curve.memoryless else 64)
    subset = np.union1d(np.linspace(0, depth.size - 1, count).astype(int), np.argmax(depth))
    depth = depth - compliance * (force - fixed.get("baseline", float(np.quantile(force, 0.05))))
    largest, _ = curve.largest_so_far(depth[None], turning_depth)
    top, length = float(depth.max()), float(curve.length[0, 0])
    points = top - np.minimum(length * _DEPTHS, curve.profile.known_depth)
    points = np.array([fixed["contact_point"]]) if "contact_point" in fixed else points
    known = curve.memoryless or {"E_star", "q_c"} <= set(fixed)
    points, shares = points[:, None, None], np.ones(1) if known else _SHARES
    d_c = shares[:, None] * np.maximum(top - points, 1e-3 * length)
    if known:
        d_c[:] = critical_depth(fixed.get("E_star", 1.0), fixed["q_c"])
    interval = interval_at(largest[:, subset] - points, depth[subset] - points, d_c)
    unit_force = 2 * (np.interp(interval.upper, *table) - np.interp(interval.lower, *table))
    modulus, baseline = _regression(unit_force, force[subset], fixed, d_c)
    squares = np.sum((force[subset] - baseline - modulus * unit_force) ** 2, axis=-1)
    squares = np.where(np.isfinite(squares), squares, np.finfo(float).max)
    for i, j in enumerate(squares.argmin(axis=1)):
        E, depth = float(modulus[i, j, 0]), float(d_c[i, j, 0])
        yield {
            "E_star": E, "q_c": yield_constant(E, depth), "contact_point": float(points[i, 0, 0]),
            "baseline": float(baseline[i, j, 0]), "frame_compliance": compliance,
            "squares": squares[i, j], **fixed,
        }  # fmt: skip


def _regression(unit_force, force, fixed, d_c):
    """E* and baseline of the line E* × unit force + baseline that is nearest to the force."""
    mean, centre = unit_force.mean(axis=-1, keepdims=True), force.mean()
    if "baseline" in fixed:
        mean, centre = 0.0, fixed["baseline"]
    if "E_star" in fixed:
        modulus = np.full_like(d_c, fixed["E_star"])
    elif fixed.get("q_c", np.inf) < np.inf:
        modulus = fixed["q_c"] / yield_constant(1.0, d_c)
    else:
        deviation = unit_force - mean
        power = np.sum(deviation**2, axis=-1, keepdims=True)
        product = np.sum(deviation * (force - centre), axis=-1, keepdims=True)
        smallest = 1e-6 * np.ptp(force) / np.maximum(np.ptp(unit_force), 1e-300)
        modulus = np.maximum(product / np.maximum(power, 1e-300), smallest)
    return modulus, centre - modulus * mean
