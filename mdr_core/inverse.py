"""Roots on arrays: of reduced profiles, forces and energies; and a function they need."""

import numpy as np

from . import _check


def newton(step, start, *, largest=np.inf, most=60):
    """Roots by Newton's method, elementwise.

    Parameters
    ----------
    step : callable
        f/f′ as a function of the positive unknown, for an increasing f that it evaluates to
        relative accuracy.
    start : ndarray
        First guesses, not negative; a guess of 0 is taken as the root.
    largest : float
        Bound that no root exceeds.

    Raises
    ------
    ValueError
        If the iteration does not settle.
    """
    x = np.asarray(start, dtype=float)
    zero = x == 0
    x = np.where(zero, np.minimum(1.0, largest), x)
    settled, last = zero, np.inf
    for _ in range(most):
        change = step(x)
        # Never below a tenth: keeps x positive where f is flat.
        new = np.minimum(np.maximum(x - change, x / 10), largest)
        # The error of the new x is the square of the change. What has settled stays, so that no root
        # depends on its neighbours.
        size = np.abs(change)
        # Where f has few digits the changes end in rounding, and go round in circles.
        circling = (size <= 1e-6 * x) & (size >= last / 2)
        x, settled, last = np.where(settled, x, new), settled | (size <= 1e-8 * x) | circling, size
        if np.all(settled):
            return np.where(zero, 0.0, x)
    raise ValueError("the contact radius did not converge; check that the depth is in metres")


def increasing_root(function, target, start, highest=np.inf):
    """Positive x with function(x) = target, elementwise, for a function that grows about as a power.

    Newton's method on ln f against ln x, inside a bracket that every step narrows.

    Parameters
    ----------
    function : callable
        Values and derivatives at an array x > 0, as a pair.
    target : ndarray
        Values to reach; 0 is reached at 0.
    start : float or ndarray
        First guesses.
    highest : float or ndarray
        Largest x at which the function is known; where it falls short of the target there, or at
        what a depth may be, the result is infinite.
    """
    target = np.asarray(target, dtype=float)
    x = np.zeros(target.shape) + np.minimum(start, highest)
    low, high = np.zeros_like(x), np.zeros_like(x) + highest
    bounded = high < np.inf
    if bounded.any():
        reachable = ~bounded | (target <= function(np.where(bounded, high, x))[0])
    else:
        reachable = np.ones(target.shape, bool)
    sought = (target > 0) & reachable
    eps = np.finfo(float).eps
    best, least, stalled = x.copy(), np.full(x.shape, np.inf), np.zeros(x.shape, int)
    for iteration in range(300):
        value, slope = function(x)
        with np.errstate(all="ignore"):
            high = np.where(value >= target, x, high)
            low = np.where(value <= target, x, low)
            miss = np.log(target / value)
            step = miss * value / (slope * x)
            new = x * np.exp(np.clip(step, -3, 3))
            middle = np.where(low > 0, np.sqrt(low) * np.sqrt(high), high / 16)
            middle = np.where(high < np.inf, middle, 16 * x)
        better = np.abs(miss) < least
        stalled = np.where(better, 0, stalled + 1)
        best, least = np.where(better, x, best), np.where(better, np.abs(miss), least)
        # Long steps in a bracket take turns with halving it, so that none can go round in circles.
        halve = (iteration % 3 == 2) & (np.abs(step) > 0.1) & (low > 0) & (high < np.inf)
        new = np.where((new >= low) & (new <= high) & ~halve, new, middle)
        # In the end the rounding of f decides: it no longer comes closer.
        settled = (np.abs(new - x) <= 4 * eps * x) | (least <= 8 * eps) | ((stalled > 5) & (least <= 1e-12))
        # Of all but flat shapes no depth may be enough.
        reachable &= low < _check.LARGEST
        if np.all(settled | ~sought | ~reachable):
            return np.where(reachable, np.where(target > 0, best, 0.0), np.inf)
        x = np.where(sought, new, x)
    raise ValueError(
        "the depth of this force or energy was not found; check that all quantities are in SI units"
    )


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
