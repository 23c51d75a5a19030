"""Refinement of a computation until its result is known to a tolerance.

A run of level k has 2^k times the elements and steps of the run of level 0. The limit for vanishing steps
is extrapolated from the last runs (Richardson); its error is estimated by its change from level to level.
"""

from itertools import pairwise

import numpy as np


def extrapolate(runs, orders):
    """Limit of the last runs, each with half the step of the one before, for errors of these orders."""
    values = runs[-len(orders) - 1 :]
    for order in orders[: len(values) - 1]:
        values = [fine + (fine - coarse) / (2**order - 1) for coarse, fine in pairwise(values)]
    return values[-1]


def refine(run, tolerance, levels, controlled, *, orders=(), runs=2, trust=0.0, floor=0.0):
    """Limit of ever finer runs, and the estimated relative error of each quantity.

    `run(level)` returns an array with one quantity per entry of its last axis. Refinement ends when the
    errors of the first `controlled` quantities are at most the tolerance, after `runs` to `levels` runs: a
    single change may be small by chance. Errors of these `orders` are extrapolated away. `trust` is the
    smallest error as a share of this correction, `floor` the smallest value to which an error is relative.
    Errors are at least half the tolerance, and infinite after a single run.
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
