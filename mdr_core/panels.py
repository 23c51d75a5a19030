"""Gauss–Legendre quadrature: composite rules, and integration from each node to the end."""

import numpy as np


def integration_rule(count):
    """Gauss–Legendre nodes and weights on [0, 1], and the matrix that integrates from each node to 1."""
    legendre = np.polynomial.legendre
    node, weight = legendre.leggauss(count)
    values = legendre.legvander(node, count)
    # ∫ₓ¹ P_k = (P_{k−1} − P_{k+1})/(2k + 1), for k = 0: 1 − x.
    tail = np.empty((count, count))
    tail[:, 0] = 1 - node
    k = np.arange(1, count)
    tail[:, 1:] = (values[:, :-2] - values[:, 2:]) / (2 * k + 1)
    project = (values[:, :count] * weight[:, None]).T * (np.arange(count)[:, None] + 0.5)
    return (1 + node) / 2, weight / 2, tail @ project / 2


#: Sixteen nodes give full accuracy on a panel of this width for a function that is smooth to a
#: distance of π/2 from the real axis.
PANEL = 1.5
NODES, WEIGHTS, TAIL = integration_rule(16)


def gauss_panels(width, longest=PANEL):
    """Nodes and weights on the intervals [0, width], or [width, 0] where negative.

    Parameters
    ----------
    width : ndarray
        Signed widths, one for each interval.
    longest : float
        Longest panel.

    Returns
    -------
    nodes, weights : ndarray
        One row of sixteen for each panel; the weights are positive.
    start : ndarray
        Row of each interval's first panel, as `np.add.reduceat` takes it.
    """
    count = np.maximum(np.ceil(np.abs(width) / longest), 1).astype(int)
    start = np.cumsum(count) - count
    step = np.repeat(width / count, count)[:, None]
    index = np.arange(count.sum()) - np.repeat(start, count)
    nodes = step * (index[:, None] + NODES)
    return nodes, np.abs(step) * WEIGHTS, start


def chunks(size, most=4096):
    """Slices of at most so many rows: enough to amortise a call, few enough to stay in the cache."""
    return (slice(start, start + most) for start in range(0, size, most))
