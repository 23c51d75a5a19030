"""Start of the fit of a curve: its turning points, and the best parameters of a grid."""

import numpy as np

from ..integrals import integrals
from ..live_interval import LiveInterval
from ..medium import critical_depth, yield_constant
from ..yielding import interval_at
from .adhesive_curve import in_contact
from .curve import BACKGROUND, PARAMETERS, REACH

#: Trial depths of contact at the largest depth, in units of the range of depth.
_DEPTHS = np.geomspace(3e-3, 1 + REACH, 48)
#: Trial critical depths, as shares of the largest depth.
_SHARES = np.concatenate([np.geomspace(2e-3, 0.5, 13), [0.65, 0.8, 0.92, 3.0]])
#: Trial relaxation times, as shares of the largest depth over the largest rate.
_LAGS = np.append(0.0, np.geomspace(0.01, 4.0, 10))
#: Trial stretches at the rim at the largest depth, as shares of it.
_STRETCHES = np.geomspace(0.03, 4.0, 14)
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

    They are the minima over a grid of contact points, with the best critical depth and relaxation time or
    work of adhesion of grids. The force is E* times a function of these, and a background: E* and the
    parameters of the background follow by linear regression.
    """
    largest = min((1 + REACH) * float(problem.length.max()), problem.profile.known_depth)
    depths = largest * np.append(0.0, np.geomspace(1e-7, 1, 600))
    radius = problem.profile._radius(depths)
    table = depths, integrals(problem.profile).radius_integral(LiveInterval.elastic(depths)), radius
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
    trials = list(_grid(curve, fixed, turning_depth, table))
    squares = np.array([np.inf, *(trial["squares"] for trial in trials), np.inf])
    minima = (squares[1:-1] <= squares[:-2]) & (squares[1:-1] < squares[2:])
    minima &= squares[1:-1] <= _CLOSE * squares.min()
    return sorted((trials[i] for i in np.flatnonzero(minima)), key=lambda trial: trial["squares"])[:_STARTS]


def _grid(curve, fixed, turning_depth, table):
    """Parameters by name and sum of squares of the best medium for each contact point."""
    depth = curve.depth[0]
    count = min(depth.size, 512 if curve.memoryless else 64)
    subset = np.union1d(np.linspace(0, depth.size - 1, count).astype(int), np.argmax(depth))
    largest, _ = curve.largest_so_far(depth[None], turning_depth)
    top, length = float(depth.max()), float(curve.length[0, 0])
    points = top - np.minimum(length * _DEPTHS, curve.profile.known_depth)
    points = np.array([fixed["contact_point"]]) if "contact_point" in fixed else points
    d_c, tau, kappa = _media(curve, fixed, np.maximum(top - points, 1e-3 * length)[:, None])
    if curve.adhesive:
        unit_force = _adhesive_force(depth[subset], points, kappa, table)
    else:
        samples = largest[:, subset], depth[subset], curve.rate[0, subset]
        unit_force = _unit_force(*samples, points[:, None, None], d_c[..., None], tau[..., None], table)
    best, moduli, squares, background = _regression(curve, fixed, subset, unit_force, d_c, kappa)
    for i, (j, E) in enumerate(zip(best.tolist(), moduli.tolist(), strict=True)):
        yield {
            "E_star": E, "q_c": yield_constant(E, float(d_c[i, j])), "eta": E * float(tau[i, j]) / 4,
            "work_of_adhesion": E * float(kappa[i, j]), "contact_point": float(points[i]),
            "squares": squares[i],
            **{name: float(values[i]) for name, values in background.items()}, **fixed,
        }  # fmt: skip


def _media(curve, fixed, depth):
    """Trial d_c (m), relaxation times (s) and w/E* (m) at trial largest depths (m), arrays (Z, M)."""
    if curve.memoryless or {"E_star", "q_c"} <= set(fixed):
        d_c = np.full_like(depth, critical_depth(fixed.get("E_star", 1.0), fixed["q_c"]))
    else:
        d_c = depth * _SHARES
    tau = depth * _LAGS / max(float(curve.speed[0, 0]), 1e-300)
    if fixed.get("eta") == 0:
        tau = np.zeros_like(depth)
    elif {"E_star", "eta"} <= set(fixed):
        tau = np.full_like(depth, 4 * fixed["eta"] / fixed["E_star"])
    if curve.adhesive:
        radius = curve.profile._radius(np.minimum(depth, curve.profile.known_depth))
        kappa = (depth * _STRETCHES) ** 2 / (2 * np.pi * radius)
        if {"E_star", "work_of_adhesion"} <= set(fixed):
            kappa = np.full_like(depth, fixed["work_of_adhesion"] / fixed["E_star"])
        tau = np.zeros_like(kappa)
    else:
        kappa = np.zeros_like(tau)
    count = d_c.shape[1], tau.shape[1]
    return np.repeat(d_c, count[1], axis=1), *(np.tile(each, (1, count[0])) for each in (tau, kappa))


def _unit_force(largest, depth, rate, point, d_c, tau, table):
    """Force over E* (m²) of media with critical depths (m) and relaxation times (s), from a table."""
    depths, area, radius = table
    lag = tau * rate
    interval = interval_at(largest - point, depth - point + np.minimum(lag, 0.0), d_c)
    force = 2 * (np.interp(interval.upper, depths, area) - np.interp(interval.lower, depths, area))
    if tau.any():
        contact_radius = np.interp(interval.upper, depths, radius)
        force += 2 * np.where(interval.length > 0, np.maximum(lag, 0.0) * contact_radius, 0.0)
    return force


def _adhesive_force(depth, points, kappa, table):
    """Force over E* (m²) of elastic media with w/E* (m) of adhesion, from a table."""
    depths, area, radius = table
    force = np.empty((*kappa.shape, depth.size))
    for i, j in np.ndindex(kappa.shape):
        stretched = np.sqrt(2 * np.pi * radius * kappa[i, j])
        reached = depths - stretched
        end = int(np.argmin(reached))
        tension = np.interp(depth - points[i], reached[end:], (area - radius * stretched)[end:])
        force[i, j] = np.where(in_contact(depth - points[i], reached[end]), 2 * tension, 0.0)
    return force


def _regression(curve, fixed, subset, unit_force, d_c, kappa):
    """The line E* × unit force + background that is nearest to the force, of the best medium of each row.

    The free parameters of the background are projected out. Returns the index of that medium, E*, the sum
    of squares, and these parameters by name.
    """
    force, weight = curve.force[0, subset], curve.sigma[0].min() / curve.sigma[0, subset]
    columns = {name: column[0, subset] for name, column in curve.background_columns.items()}
    force = force - sum(fixed[name] * columns[name] for name in BACKGROUND if name in fixed)
    free = [name for name in BACKGROUND if name in curve.free]
    used = np.reshape([weight * columns[name] for name in free], (len(free), subset.size))
    basis, triangle = np.linalg.qr(used.T)
    weighted = weight * unit_force
    deviation, projected = weight * force - basis @ (basis.T @ (weight * force)), weighted
    if free:
        projected = weighted - (weighted @ basis) @ basis.T
    if "E_star" in fixed:
        E_star = np.full_like(d_c, fixed["E_star"])
    elif fixed.get("work_of_adhesion"):
        E_star = fixed["work_of_adhesion"] / kappa
    elif fixed.get("q_c", np.inf) < np.inf:
        E_star = fixed["q_c"] / yield_constant(1.0, d_c)
    else:
        power = np.einsum("zmn,zmn->zm", projected, projected)
        smallest = 1e-6 * np.ptp(force) / np.maximum(np.ptp(unit_force), 1e-300)
        E_star = np.maximum(projected @ deviation / np.maximum(power, 1e-300), smallest)
    squares = np.sum((deviation - E_star[..., None] * projected) ** 2, axis=-1)
    squares = np.where(np.isfinite(squares), squares, np.finfo(float).max)
    row, best = np.arange(len(squares)), squares.argmin(axis=1)
    E_star, squares = E_star[row, best], squares[row, best]
    remainder = weight * force - E_star[:, None] * weighted[row, best]
    values = np.linalg.lstsq(triangle, (remainder @ basis).T, rcond=None)[0] if free else ()
    return best, E_star, squares, dict(zip(free, values, strict=True))
