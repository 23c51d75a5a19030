"""Gauss–Legendre rules of hundreds of nodes."""

from functools import lru_cache

import numpy as np
from scipy.special import roots_legendre


@lru_cache
def gauss_legendre(count):
    """Nodes and weights on [−1, 1], to a few units of rounding however many there are.

    NumPy's rule takes its nodes from a full matrix, which is seconds for a thousand of them, and divides
    by Pₙ₋₁ at nodes that are rounded, which costs two digits at both ends. w = 2/((1 − x²) P′ₙ²), with
    (1 − x²) P′ₙ = n (Pₙ₋₁ − x Pₙ), does not feel the rounding of x.
    """
    x = roots_legendre(count)[0]
    last, value = np.ones_like(x), x
    for n in range(2, count + 1):
        last, value = value, ((2 * n - 1) * x * value - (n - 1) * last) / n
    weight = (1 - x) * (1 + x) / (last - x * value) ** 2
    return x, 2 * weight / weight.sum()
