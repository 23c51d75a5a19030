"""Plastic memory of the medium: one number, the plastic depth, stands for the whole depth history.

Every 1D element yields at the same compression d_c (Popov 2015, Eqs. (11), (12), (19)), so an
element at x keeps the plastic part max(0, d_max − d_c − g(x)), and the state at depth d is the
*live interval* of depths [d_p, d] with d_p = max(0, d_max − d_c).
"""

from dataclasses import dataclass

import numpy as np

from .medium import plastic_depth


@dataclass(frozen=True)
class LiveInterval:
    """Interval [d_p, d] of depths (m) that are elastic: floats, or arrays of one shape.

    `length` is stored because the difference `upper − lower` cancels where d is much larger than the
    critical depth. Without contact the length is 0 and both ends are d_p.
    """

    lower: np.ndarray
    upper: np.ndarray
    length: np.ndarray

    def __getitem__(self, index):
        return LiveInterval(self.lower[index], self.upper[index], self.length[index])

    def in_units_of(self, unit):
        """The interval in units of a depth (m)."""
        return LiveInterval(*np.broadcast_arrays(self.lower / unit, self.upper / unit, self.length / unit))


def path_intervals(depth, critical_depth):
    """Live interval after each point of a path of depths (m) along the last axis, negative out of contact.

    The critical depth d_c (m) may be infinite.

    Examples
    --------
    >>> path_intervals(np.array([0.5, 3.0, 2.5, 1.0]), 1.0).length.tolist()
    [0.5, 1.0, 0.5, 0.0]
    """
    largest = np.maximum.accumulate(depth, axis=-1) if depth.ndim else depth
    return interval_at(largest, depth, critical_depth)


def interval_at(largest, depth, critical_depth):
    """Live interval at each depth (m) where the largest depth so far is `largest` (m)."""
    lower = plastic_depth(largest, critical_depth)
    # The length is the depth before the first yield, and afterwards d_c less the depth of unloading.
    length = np.maximum(np.minimum(depth, critical_depth - (largest - depth)), 0.0)
    return LiveInterval(lower, np.maximum(depth, lower), length)


def first_loading(depth, critical_depth):
    """Live intervals of a virgin medium that is pressed to each one of an array of depths (m)."""
    return path_intervals(depth[..., None], critical_depth)[..., 0]


def elastic_interval(depth):
    """Live interval of an elastic indentation to a depth (m)."""
    return LiveInterval(np.zeros_like(depth), depth, depth)
