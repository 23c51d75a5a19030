"""Sums of a kernel over nodes beyond each target, in N log N operations."""

import numpy as np

# Chebyshev points per block. A block is used whole from one width away on, where the kernels
# converge as 5.8^(−points).
_POINTS = 20
_LEAF = 64
_NODE = np.cos(np.pi * (np.arange(_POINTS) + 0.5) / _POINTS)
_PROJECT = np.polynomial.chebyshev.chebvander(_NODE, _POINTS - 1).T * (2 / _POINTS)
_PROJECT[0] /= 2


def superpose_kernel(kernel, x, weight, target, until=None, leaf=_LEAF):
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
    until : ndarray, shape (N,), optional
        Largest target for which each node counts, at most the node itself.
    leaf : int, optional
        Most nodes of a block that is not divided: the more, the cheaper the kernel is.

    Returns
    -------
    ndarray
        The sums, of the shape of `target`.
    """
    used = np.flatnonzero(weight)
    until = x[used] if until is None else until[used]
    x, weight = x[used], weight[used]
    flat = target.ravel()
    order = np.argsort(flat, kind="stable")
    ascending = flat[order]
    total = np.zeros_like(flat)
    if len(x):
        with np.errstate(divide="ignore"):
            _add_blocks(kernel, x, weight, until, ascending, total, leaf)
    result = np.empty_like(total)
    result[order] = total
    return result.reshape(target.shape)


def _add_blocks(kernel, x, weight, until, target, total, leaf):
    """Adds what the nodes give to the sorted targets, in blocks that are halved level by level."""
    # Index of the first target that each block of a level has not been added to.
    done = np.searchsorted(target, [0.0], side="right")
    edges = np.array([0, len(x)])
    while np.max(np.diff(edges)) > leaf:
        low, high = x[edges[:-1]], x[edges[1:] - 1]
        reach = np.minimum(2 * low - high, np.minimum.reduceat(until, edges[:-1]))
        far = np.maximum(np.searchsorted(target, reach, side="right"), done)
        blocks = np.flatnonzero(far > done)
        if blocks.size:
            points = (high + low)[:, None] / 2 + (high - low)[:, None] / 2 * _NODE
            moments = _moments(x, weight, edges) @ _PROJECT
            for block in blocks:
                rows = slice(done[block], far[block])
                total[rows] += kernel(points[block], target[rows, None]) @ moments[block]
        count = 2 * len(done)
        edges = len(x) * np.arange(count + 1) // count
        done = np.repeat(far, 2)
    for first, last, start in zip(edges, edges[1:], done, strict=False):
        _add_nodes(kernel, *(part[first:last] for part in (x, weight, until)), target, total, start)


def _moments(x, weight, edges):
    """Sums of the weights times each Chebyshev polynomial over each block."""
    start, count = edges[:-1], np.diff(edges)
    middle, half = (x[edges[1:] - 1] + x[start]) / 2, (x[edges[1:] - 1] - x[start]) / 2
    # Nodes that all stand in one place have no far field but their own.
    twice = 2 * (x - np.repeat(middle, count)) / np.repeat(np.maximum(half, np.finfo(float).tiny), count)
    last, this = weight, weight * twice / 2
    result = np.empty((_POINTS, len(start)))
    for moment in result:
        moment[:] = np.add.reduceat(last, start)
        last, this = this, twice * this - last
    return result.T


def _add_nodes(kernel, x, weight, until, target, total, done):
    before = np.searchsorted(target, until.min(), side="right")
    if before > done:
        total[done:before] += kernel(x, target[done:before, None]) @ weight
        done = before
    end = np.searchsorted(target, until.max(), side="right")
    if end > done:
        r = target[done:end, None]
        reached = until >= r
        values = kernel(np.maximum(x, r), r)
        total[done:end] += np.where(reached, values * weight, 0.0).sum(axis=1)
