"""Sums of a kernel over nodes beyond each target, in N log N operations."""

import numpy as np

# Chebyshev points per block. A block is used whole from one width away on, where the kernels
# converge as 5.8^(−points).
_POINTS = 20
_LEAF = 64
_NODE = np.cos(np.pi * (np.arange(_POINTS) + 0.5) / _POINTS)
_PROJECT = np.polynomial.chebyshev.chebvander(_NODE, _POINTS - 1) * (2 / _POINTS)
_PROJECT[:, 0] /= 2


def superpose_kernel(kernel, x, weight, target):
    """Σ weight_j kernel(x_j, target) over all x_j > target, and x_j = target where it is singular.

    Parameters
    ----------
    kernel : callable
        Vectorised function of x and target, for x ≥ target > 0; analytic beyond the target.
    x : ndarray, shape (N,)
        Nodes in ascending order.
    weight : ndarray, shape (N,)
        Weight of each node.
    target : ndarray
        Targets, not negative; at 0 the result is 0.

    Returns
    -------
    ndarray
        The sums, of the shape of `target`.
    """
    used = np.flatnonzero(weight)
    x, weight = x[used], weight[used]
    flat = target.ravel()
    order = np.argsort(flat, kind="stable")
    ascending = flat[order]
    first = np.searchsorted(ascending, 0.0, side="right")
    total = np.zeros_like(flat)
    if len(x):
        with np.errstate(divide="ignore"):
            _add_block(kernel, x, weight, ascending, total, first)
    result = np.empty_like(total)
    result[order] = total
    return result.reshape(target.shape)


def _add_block(kernel, x, weight, target, total, done):
    """Adds what a block of nodes gives to the sorted targets from index `done` on."""
    if len(x) <= _LEAF:
        _add_nodes(kernel, x, weight, target, total, done)
        return
    far = np.searchsorted(target, 2 * x[0] - x[-1], side="right")
    if far > done:
        middle, half = (x[-1] + x[0]) / 2, (x[-1] - x[0]) / 2
        moments = weight @ np.polynomial.chebyshev.chebvander((x - middle) / half, _POINTS - 1)
        points = middle + half * _NODE
        total[done:far] += kernel(points, target[done:far, None]) @ (_PROJECT @ moments)
        done = far
    if done < np.searchsorted(target, x[-1], side="right"):
        split = len(x) // 2
        _add_block(kernel, x[:split], weight[:split], target, total, done)
        _add_block(kernel, x[split:], weight[split:], target, total, done)


def _add_nodes(kernel, x, weight, target, total, done):
    before = np.searchsorted(target, x[0], side="right")
    if before > done:
        total[done:before] += kernel(x, target[done:before, None]) @ weight
        done = before
    end = np.searchsorted(target, x[-1], side="right")
    if end > done:
        r = target[done:end, None]
        reached = x >= r
        values = kernel(np.maximum(x, r), r)
        total[done:end] += np.where(reached, values * weight, 0.0).sum(axis=1)
