"""Solution of curves with the same number of turning points, and its comparison with an elastic medium."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .._numeric import chunks
from ..medium import critical_depth
from .adhesive_curve import contact_of_data, contact_of_model
from .curve import LOGARITHMIC, NO_WEIGHT, REACH, CurveProblem
from .least_squares import (
    autocorrelation,
    block_factors,
    block_length,
    covariances,
    least_squares,
    roughness,
)
from .start import first_guesses, turning_points

#: Largest number of searches with adhesion, between which the samples in contact are found anew.
_SEARCHES = 8


@dataclass(frozen=True)
class SolvedCurves:
    """Curves `rows` of a measurement, the solution of their problem, and whether they are elastic (R,).

    `at_bound` (R, P) marks parameters at a bound. `rival` is the second-best minimum in scaled parameters
    (R, P), `rival_squares` its sum of squares, infinite where there is none.
    """

    rows: np.ndarray
    problem: CurveProblem
    x: np.ndarray
    residual: np.ndarray
    jacobian: np.ndarray
    at_bound: np.ndarray
    rival: np.ndarray
    rival_squares: np.ndarray
    elastic: np.ndarray
    hardly_yields: np.ndarray
    noise_known: bool

    @cached_property
    def values_and_states(self):
        """Parameters by name (R, 1), with an infinite q_c where elastic, and the states at all samples."""
        problem = self.problem
        if problem.adhesive:
            problem = problem.in_contact(contact_of_model(problem, self.x))
        values, _, state = problem.states(self.x)
        return values | {"q_c": np.where(self.elastic[:, None], np.inf, values["q_c"])}, state

    @cached_property
    def noise(self):
        """Standard deviation (N) of the residuals at all samples (R, N)."""
        return self.problem.noise(self.values_and_states[1].slope)

    @cached_property
    def reduced_chi_square(self):
        freedom = max(self.residual.shape[1] - self.x.shape[1], 1)
        return np.sum(self.residual**2, axis=1) / freedom

    @cached_property
    def orders(self):
        """Indices in the order, of time or (elastic) of depth, in which residuals are more correlated."""
        orders = np.broadcast_to(np.arange(self.residual.shape[1]), self.residual.shape).copy()
        if self.problem.memoryless:
            by_depth = np.argsort(self.problem.depth, axis=1)
            sorted_residual = np.take_along_axis(self.residual, by_depth, axis=1)
            closer = autocorrelation(sorted_residual) > autocorrelation(self.residual)
            orders[closer] = by_depth[closer]
        return orders

    @cached_property
    def block_length(self):
        """Number of samples over which residuals are correlated (R,), 1 for noise."""
        residuals = zip(self.residual, self.orders, strict=True)
        return np.array([block_length(residual[order]) for residual, order in residuals])

    @cached_property
    def covariance(self):
        """Covariance of the scaled free parameters (R, P, P), by blocks if residuals are correlated."""
        free = len(self.problem.free)
        variance = 1.0 if self.noise_known else self.reduced_chi_square
        covariance = covariances(self.jacobian, variance)[:, :free, :free]
        for i in np.flatnonzero(self.block_length > 1) if free else ():
            order, length = self.orders[i], self.block_length[i]
            factors = block_factors(self.residual[i, order], self.jacobian[i, order], length)[:free]
            covariance[i] *= factors[:, None] * factors
        return covariance


def grouped(depth, force, fixed, noise):
    """Yields curves with the same number of turning points: rows, turning points, starts of loadings.

    A medium that is held elastic has no memory and neither of these. Depth and force turn at the same
    sample: both are added in units in which the quieter one weighs more.
    """
    path, variance, threshold = 0.0, 0.0, 0.0
    for values, sigma in ((depth, noise), (force, roughness(force))):
        size = np.ptp(values, axis=1, keepdims=True)
        weight = 1 / (0.005 + sigma / size)
        path, threshold = path + weight * values / size, threshold + 0.02 * weight
        variance = variance + (weight * sigma / size) ** 2
    thresholds = np.maximum(threshold, 6 * np.sqrt(variance))[:, 0].tolist()
    indices = [turning_points(row.tolist(), size) for row, size in zip(path, thresholds, strict=True)]
    elastic = np.isinf(fixed.get("q_c", np.zeros(len(depth))))
    indices = [((), ()) if known else pair for known, pair in zip(elastic, indices, strict=True)]
    counts = [(len(turns), len(starts)) for turns, starts in indices]
    for count in sorted(set(counts)):
        rows = np.array([i for i, other in enumerate(counts) if other == count])
        for chunk in chunks(rows.size, 64):
            subset = rows[chunk]
            turns, starts = zip(*(indices[i] for i in subset), strict=True)
            yield subset, np.array(turns, int), np.array(starts, int)


def solved(profile, samples, fixed, noise, rows, turns, starts):
    """Solves the curves at `rows` of `Samples`, which have the same number of turning points."""
    depth, force, rate = samples.depth[rows], samples.force[rows], samples.rate[rows]
    fixed = {name: value[rows] for name, value in fixed.items()}
    # Without memory and rates the order of time means nothing, and that of depth makes the force smooth.
    ordered = (
        force if starts.size or rate.any() else np.take_along_axis(force, np.argsort(depth, axis=1), axis=1)
    )
    given = samples.force_noise is not None
    sigma = samples.force_noise[rows] if given else _first_sigma(ordered, noise)
    sigma = np.where(samples.corner[rows], NO_WEIGHT * sigma, sigma)
    time = None if samples.time is None else samples.time[rows]
    problem = CurveProblem(profile, depth, force, rate, fixed, noise, sigma, turns, starts, time=time)
    solution, rival = _best_minimum(problem)
    for _ in range(5 if noise and turns.size else 0):
        before, problem = problem, problem.with_best_turning_points(solution[0])
        if np.array_equal(before.turning_points, problem.turning_points):
            break
        solution = _minimum(problem, solution[0])
    if problem.adhesive:
        problem = problem.in_contact(contact_of_data(problem, solution[0]))
        solution = _minimum(problem, solution[0])
    noise_known = given or noise > 0
    if "q_c" in fixed:
        elastic, hardly_yields = np.isinf(fixed["q_c"]), np.zeros(len(rows), bool)
    else:
        solution, elastic, hardly_yields = _compared_with_elastic(problem, solution, noise_known)
    return SolvedCurves(samples.rows[rows], problem, *solution, *rival, elastic, hardly_yields, noise_known)


def _first_sigma(force, noise):
    """Standard deviation of the force (R, N): estimated, or its range where it is not known."""
    size = np.ptp(force, axis=1, keepdims=True)
    if noise:
        size = np.maximum(roughness(force), 1e-6 * size)
    return np.repeat(size, force.shape[1], axis=1)


def _minimum(problem, start):
    """Scaled parameters, residuals, derivatives, and which parameters are at a bound, near `start`."""
    lower, upper = np.full_like(start, -np.inf), np.full_like(start, np.inf)
    longest = np.minimum((1 + REACH) * problem.length[:, 0], problem.profile.known_depth)
    for i, name in enumerate(problem.free):
        if name == "contact_point":
            lower[:, i], upper[:, i] = np.log(1e-4 * problem.length[:, 0]), np.log(longest)
        elif name in LOGARITHMIC:
            lower[:, i], upper[:, i] = start[:, i] - 16, start[:, i] + 16
        elif name == "eta":
            lower[:, i] = 0.0
    solution = least_squares(lambda x, rows: problem.rows(rows).residuals(x), start, lower, upper)
    # Steps across a bound may end next to it.
    return *solution, (solution[0] <= lower + 1e-9) | (solution[0] >= upper - 1e-9)


def _searched(problem, start):
    """`_minimum`, with adhesion for the samples in contact that fit best."""
    if not problem.adhesive:
        return _minimum(problem, start)
    contact = None
    for _ in range(_SEARCHES):
        before, contact = contact, contact_of_data(problem, start)
        if np.array_equal(before, contact):
            break
        solution = _minimum(problem.in_contact(contact), start)
        start = solution[0]
    return solution


def _best_minimum(problem):
    """The best minimum, and the second-best one that differs in E* or contact point, with its squares."""
    (_, start), *others = first_guesses(problem)
    solution = _searched(problem, start)
    rival, rival_squares = solution[0].copy(), np.full(len(start), np.inf)
    columns = [i for i, name in enumerate(problem.free) if name in ("E_star", "contact_point")]
    for rows, start in others:
        trial = _searched(problem.rows(rows), start)
        x, squares = solution[0][rows], np.sum(solution[1][rows] ** 2, axis=1)
        trial_squares = np.sum(trial[1] ** 2, axis=1)
        differs = np.any(np.abs(trial[0] - x)[:, columns] > 0.05, axis=1)
        better, worse = trial_squares < squares, np.maximum(squares, trial_squares)
        second = differs & (worse < rival_squares[rows])
        rival[rows[second]] = np.where(better[:, None], x, trial[0])[second]
        rival_squares[rows[second]] = worse[second]
        for values, improved in zip(solution, trial, strict=True):
            values[rows[better]] = improved[better]
    return solution, (rival, rival_squares)


def _compared_with_elastic(problem, solution, noise_known):
    """The solution or the elastic one where that is nearer, and whether it is, or about as near.

    In an elastic medium q_c has no derivative: a second search starts below the largest depth.
    """
    x, residual, *_ = solution
    elastic, hardly_yields = np.zeros((2, len(x)), bool)
    column, freedom = problem.free.index("q_c"), max(residual.shape[1] - x.shape[1], 1)
    values, _, state = problem.states(x)
    share = critical_depth(values["E_star"], values["q_c"])[:, 0] / state.depth.max(axis=1)
    rows = np.flatnonzero(share > 0.5)
    if not rows.size:
        return solution, elastic, hardly_yields
    subset, start = problem.rows(rows), x[rows]
    start[:, column] += np.minimum(np.log(0.85 / share[rows]), 0.0)
    yielding = _minimum(subset, start)
    held = replace(subset, fixed=subset.fixed | {"q_c": np.full(rows.size, np.inf)})
    start = np.delete(x[rows], column, axis=1)
    elastic_x, elastic_residual, jacobian, at_bound = _minimum(held, start)
    # 300 represents the logarithm of an infinite q_c.
    elastic_x = np.insert(elastic_x, column, 300.0, axis=1)
    jacobian = np.insert(jacobian, column, 0.0, axis=2)
    unyielding = elastic_x, elastic_residual, jacobian, np.insert(at_bound, column, False, axis=1)
    residuals = residual[rows], yielding[1], elastic_residual
    squares = np.array([np.sum(values**2, axis=1) for values in residuals])
    noise = np.ones(rows.size) if noise_known else squares.min(axis=0) / freedom
    gain = (squares[2] - squares[:2].min(axis=0)) / np.maximum(noise, 1e-300)
    nearer = (gain <= 2) | (squares[2] <= 1e-24 * residual.shape[1])
    better = (squares[1] < squares[0]) & ~nearer
    for values, second, third in zip(solution, yielding, unyielding, strict=True):
        values[rows[better]], values[rows[nearer]] = second[better], third[nearer]
    elastic[rows], hardly_yields[rows] = nearer, (gain <= 9) & ~nearer
    return solution, elastic, hardly_yields
