"""Refinement of a computation until its result reaches a tolerance.

A run of level k has 2^k times the elements and steps of the run of level 0. The limit for vanishing steps
is extrapolated from the last runs (Richardson). Its change from level to level estimates its error.
"""

from itertools import pairwise

import numpy as np


def extrapolate(runs, orders):
    """Return the limit of the last runs, each with half the previous step, for errors of these orders."""
    values = runs[-len(orders) - 1 :]
    for order in orders[: len(values) - 1]:
        values = [fine + (fine - coarse) / (2**order - 1) for coarse, fine in pairwise(values)]
    return values[-1]


def refine(run, tolerance, levels, controlled, *, orders=(), runs=2, trust=0.0, floor=0.0):
    """Return the limit of ever finer runs, and the estimated relative error of each quantity.

    `run(level)` returns an array with one quantity per entry of its last axis. Refinement ends when the
    errors of the first `controlled` quantities are at most the tolerance. It needs `runs` to `levels` runs,
    because a single change may be small by chance. Errors of these `orders` are removed by extrapolation.
    `trust` is the smallest error as a share of this correction, `floor` the smallest reference value of a
    relative error. Errors are at least half the tolerance, and infinite after a single run.
    """
    values, limit, errors = [], None, np.inf
    for level in range(levels):
        values.append(run(level))
        previous, limit = limit, extrapolate(values, orders)
        if level + 1 < runs:
            continue
        change = np.maximum(np.abs(limit - previous), trust * np.abs(limit - values[-1]))
        largest, change = (np.abs(x).reshape(-1, x.shape[-1]).max(axis=0) for x in (limit, change))
        scale = np.maximum(largest, floor)
        errors = np.maximum(change / np.where(scale > 0, scale, 1.0), tolerance / 2)
        if np.max(errors[:controlled]) <= tolerance:
            break
    return limit, np.broadcast_to(errors, limit.shape[-1:])
