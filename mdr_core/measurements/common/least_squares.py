"""Least squares for many small problems at once."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Minimum:
    """Minimum of the sum of squares of R problems, one problem in each row.

    It has the scaled parameters x (R, P), residuals (R, N) and their derivatives (R, N, P). `at_bound`
    (R, P) marks parameters at a bound.
    """

    x: np.ndarray
    residual: np.ndarray
    jacobian: np.ndarray
    at_bound: np.ndarray

    @property
    def sum_of_squares(self):
        """Sums of squares (R,)."""
        return np.sum(self.residual**2, axis=1)

    @property
    def degrees_of_freedom(self):
        """Degrees of freedom, at least 1."""
        return max(self.residual.shape[1] - self.x.shape[1], 1)

    def replaced(self, rows, other, better):
        """Return a copy with the `better` minima of `other`, which has the problems `rows`."""
        arrays = {name: values.copy() for name, values in vars(self).items()}
        for name, values in arrays.items():
            values[rows[better]] = getattr(other, name)[better]
        return Minimum(**arrays)


def least_squares(function, start, lower, upper, *, steps=200, tolerance=1e-11):
    """Return the `Minimum` by the Levenberg–Marquardt method between bounds (R, P), one problem per row.

    `function(x, rows)` returns residuals (R, N) and derivatives (R, N, P) of the problems `rows`, at scaled
    parameters x (R, P) of about 1. SciPy solves one problem per call; here many curves share every step.
    """
    x = np.clip(start, lower, upper)
    rows, damping = np.arange(len(x)), np.full(len(x), 1e-4)
    residual, jacobian = function(x, rows)
    cost = np.sum(residual**2, axis=1)
    for _ in range(steps if x.shape[1] else 0):
        derivatives, low, high = jacobian[rows], lower[rows], upper[rows]
        # A parameter cannot cross its bound.
        gradient = np.einsum("rn,rnp->rp", residual[rows], derivatives)
        blocked = ((x[rows] <= low) & (gradient > 0)) | ((x[rows] >= high) & (gradient < 0))
        step = _step(residual[rows], np.where(blocked[:, None, :], 0.0, derivatives), damping[rows])
        trial = np.clip(x[rows] + np.clip(step, -1.5, 1.5), low, high)
        size = np.abs(trial - x[rows]).max(axis=1)
        trial_residual, trial_jacobian = function(trial, rows)
        trial_cost = np.sum(trial_residual**2, axis=1)
        better = trial_cost < cost[rows]
        improved = rows[better]
        x[improved], cost[improved] = trial[better], trial_cost[better]
        residual[improved], jacobian[improved] = trial_residual[better], trial_jacobian[better]
        damping[rows] *= np.where(better, 0.03, 10.0)
        # If not even a very short step improves the sum of squares, rounding exceeds the step.
        rows = rows[(size > tolerance) & (damping[rows] < 1e9)]
        if not rows.size:
            break
    # Steps across a bound may end next to it.
    return Minimum(x, residual, jacobian, (x <= lower + 1e-9) | (x >= upper - 1e-9))


def _step(residual, jacobian, damping):
    u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    inverse = s / (s**2 + damping[:, None] * s[:, :1] ** 2 + 1e-300)
    coordinates = np.einsum("rnk,rn->rk", u, residual) * np.where(s > 1e-14 * s[:, :1], inverse, 0.0)
    return -np.einsum("rk,rkp->rp", coordinates, vt)
