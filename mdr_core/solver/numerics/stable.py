"""Functions that avoid cancellation."""

import numpy as np


def cube_rise(begin, step):
    """Return (b + δ)³ − b³ without cancellation."""
    # A step may be infinite.
    with np.errstate(over="ignore", invalid="ignore"):
        return step * (3 * begin * begin + step * (3 * begin + step))


def cube_way(begin, rise):
    """Return δ with (b + δ)³ − b³ = `rise`, the inverse of `cube_rise`."""
    end = np.cbrt(begin**3 + rise)
    # Either may be infinite.
    with np.errstate(over="ignore", invalid="ignore"):
        squares = begin * begin + begin * end + end * end
        step = np.divide(rise, squares, out=np.zeros_like(rise), where=rise > 0)
    return np.where(rise < np.inf, step, np.inf)


def root(x, r):
    """Return √(x² − r²) of two lengths without cancellation or underflow, 0 for x < r."""
    return np.sqrt(np.maximum(x - r, 0.0)) * np.sqrt(x + r)


def log1p_ratio(above, below):
    """Return ln(1 + above/below), even if the quotient overflows; infinite for below = 0."""
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        ratio = above / below
        return np.where(ratio < np.inf, np.log1p(ratio), np.log(above) - np.log(below))


def trapezoid(y, x):
    """Return ∫ y dx of straight lines between points; SciPy's function takes half a second to import."""
    return np.sum((y[1:] + y[:-1]) * np.diff(x)) / 2
