"""Kernels of the transforms between line load and stress, for x > r, elementwise."""

import numpy as np


def root(x, r):
    """√(x² − r²)."""
    return np.sqrt((x - r) * (x + r))


def arcosh(x, r):
    """∫ dx/√(x² − r²) from r."""
    # Only beyond the digits of r does its lower bound count.
    r = np.maximum(r, 1e-200)
    if np.min(x) > 1.5 * np.max(r):
        # As exact, and faster.
        return np.log((x + root(x, r)) / r)
    return np.log1p((x - r + root(x, r)) / r)


def punch(x, r):
    """1/√(x² − r²), the stress of a flat punch."""
    return 1 / root(x, r)


def chord(r, x):
    """∫ r dr/√(r² − x²) from x."""
    return root(r, x)


def segment(r, x):
    """∫ √(r² − x²) dr from x."""
    return (r * root(r, x) - x * x * arcosh(r, x)) / 2
