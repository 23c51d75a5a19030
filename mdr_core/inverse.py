"""Inverting a reduced profile: Newton's method on arrays, and a function it needs."""

import numpy as np


def newton(step, start, *, most=60):
    """Roots by Newton's method, elementwise.

    Parameters
    ----------
    step : callable
        f/f′ as a function of the positive unknown, for an increasing f that it evaluates to
        relative accuracy.
    start : ndarray
        First guesses, not negative; a guess of 0 is taken as the root.

    Raises
    ------
    ArithmeticError
        If the iteration does not settle.
    """
    x = np.asarray(start, dtype=float)
    zero = x == 0
    x = np.where(zero, 1.0, x)
    for _ in range(most):
        change = step(x)
        # Never below a tenth: keeps x positive where f is flat.
        new = np.maximum(x - change, x / 10)
        settled = np.abs(change) <= 1e-8 * x
        x = new
        # The error of the new x is the square of the change.
        if np.all(settled | zero):
            return np.where(zero, 0.0, x)
    raise ArithmeticError("the contact radius did not converge; check that the depth is in metres")


# 1/3, −1/5, 1/7, …: enough for τ ≤ 1/2.
_GAP = (1 / np.arange(3, 55, 2) * (-1.0) ** np.arange(26))[::-1]


def arctan_gap(tau):
    """τ − arctan τ without cancellation, for τ ≥ 0."""
    small = np.minimum(tau, 0.5)
    square = small * small
    series = np.zeros_like(square)
    for coefficient in _GAP:
        series = series * square + coefficient
    return np.where(tau < 0.5, series * square * small, tau - np.arctan(tau))
