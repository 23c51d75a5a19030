"""Start of the fit of a curve: its turning points, and the best parameters of a grid."""

import numpy as np

from ..superposition import radius_integral
from ..yielding import elastic_interval, interval_at
from .curve import PARAMETERS

#: Trial frame compliances, in units of the range of depth over the range of force.
_COMPLIANCES = np.array([0.0, 0.05, 0.15, 0.3, 0.5])
#: Trial critical depths, as shares of the largest depth.
_SHARES = np.concatenate([np.geomspace(2e-3, 0.5, 13), [0.65, 0.8, 0.92, 3.0]])


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


def first_guess(problem):
    """Scaled parameters at the start: the best of a grid of contact points and critical depths.

    The force is 2E* times a function of these two; E* and the baseline follow by linear regression.
    """
    count = problem.depth.shape[1]
    subset = np.unique(np.linspace(0, count - 1, min(count, 64)).astype(int))
    limit = min(2 * float(problem.length.max()), problem.profile.known_depth)
    depths = limit * np.append(0.0, np.geomspace(1e-5, 1, 300))
    table = depths, radius_integral(problem.profile, elastic_interval(depths))
    turning_depth = _turning_depth(problem)
    guesses = []
    for row in range(len(problem.depth)):
        curve = problem.rows([row])
        fixed = {name: float(value[0]) for name, value in curve.fixed.items()}
        unit = float((curve.length / curve.load)[0, 0])
        compliances = [fixed["frame_compliance"]] if "frame_compliance" in fixed else _COMPLIANCES * unit
        trials = [_guess(curve, fixed, turning_depth[[row]], subset, table, C) for C in compliances]
        guesses.append(min(trials, key=lambda trial: trial["squares"]))
    values = {name: np.array([[guess[name]] for guess in guesses]) for name in PARAMETERS}
    return problem.scaled(values, turning_depth)


def _turning_depth(problem):
    """Measured depths (m) at the turning points (R, K), means of five samples."""
    if not problem.turning_points.size:
        return np.zeros(problem.turning_points.shape)
    last = problem.depth.shape[1] - 1
    neighbours = np.clip(problem.turning_points[..., None] + np.arange(-2, 3), 0, last)
    return np.take_along_axis(problem.depth[:, None], neighbours, axis=2).mean(axis=2)


def _guess(curve, fixed, turning_depth, subset, table, compliance):
    """Parameters of one curve by name, and the sum of squares of its residuals."""
    force, depth = curve.force[0], curve.depth[0]
    top, bottom = force.max(), fixed.get("baseline", float(np.quantile(force, 0.05)))
    depth = depth - compliance * (force - bottom)
    touch = float(depth[np.argmax(force - bottom > 0.05 * (top - bottom))])
    width = max(float(depth.max()) - touch, 1e-3 * float(curve.length[0, 0]))
    point = np.array([fixed["contact_point"]]) if "contact_point" in fixed else None
    point = touch - width * np.linspace(0, 1, 16) ** 1.5 if point is None else point
    memoryless = {"E_star", "q_c"} <= set(fixed) or fixed.get("q_c") == np.inf
    shares = np.ones(1) if memoryless else _SHARES
    point, shares = (values.ravel()[:, None] for values in np.meshgrid(point, shares))
    d_c = shares * np.maximum(depth.max() - point, 1e-3 * width)
    if memoryless:
        d_c[:] = np.pi / 2 * fixed["q_c"] / fixed.get("E_star", 1.0)
    largest, _ = curve.largest_so_far(depth[None], turning_depth)
    interval = interval_at(largest[:, subset] - point, depth[subset] - point, d_c)
    unit_force = 2 * (np.interp(interval.upper, *table) - np.interp(interval.lower, *table))
    modulus, baseline = _regression(unit_force, force[subset], fixed, d_c)
    squares = np.sum((force[subset] - baseline - modulus * unit_force) ** 2, axis=1)
    best = int(np.argmin(np.where(np.isfinite(squares), squares, np.inf)))
    E, d_c = float(modulus[best, 0]), float(d_c[best, 0])
    guess = {"E_star": E, "q_c": 2 / np.pi * E * d_c, "contact_point": float(point[best, 0])}
    guess |= {
        "baseline": float(baseline[best, 0]),
        "frame_compliance": compliance,
        "squares": squares[best],
    }
    return guess | fixed


def _regression(unit_force, force, fixed, d_c):
    """E* and baseline (G, 1) of the line E* × unit force + baseline that is nearest to the force."""
    if "baseline" in fixed:
        mean, centre = 0.0, fixed["baseline"]
    else:
        mean, centre = unit_force.mean(axis=1, keepdims=True), force.mean()
    if "E_star" in fixed:
        modulus = np.full_like(d_c, fixed["E_star"])
    elif fixed.get("q_c", np.inf) < np.inf:
        modulus = np.pi / 2 * fixed["q_c"] / d_c
    else:
        deviation = unit_force - mean
        power = np.sum(deviation**2, axis=1, keepdims=True)
        product = np.sum(deviation * (force - centre), axis=1, keepdims=True)
        smallest = 1e-6 * np.ptp(force) / np.maximum(np.ptp(unit_force), 1e-300)
        modulus = np.maximum(product / np.maximum(power, 1e-300), smallest)
    return modulus, centre - modulus * mean
