"""The live interval: the elastic depths of an indentation."""

from dataclasses import dataclass
from typing import Self

import numpy as np


@dataclass(frozen=True)
class LiveInterval:
    """Interval [d_p, d] of elastic depths (m): floats, or arrays of one shape.

    `length` is stored because the difference `upper − lower` cancels if d is much larger than the elastic
    compression. Without contact the length is 0 and both ends are d_p.
    """

    lower: np.ndarray
    upper: np.ndarray
    length: np.ndarray

    @classmethod
    def above(cls, lower: np.ndarray, length: np.ndarray) -> Self:
        """Return the interval of a length (m) that begins at a plastic depth (m); both broadcast."""
        return cls(*np.broadcast_arrays(lower, lower + length, length))

    @classmethod
    def elastic(cls, depth: np.ndarray) -> Self:
        """Return the interval of an elastic indentation to a depth (m)."""
        return cls(np.zeros_like(depth), depth, depth)

    def __getitem__(self, index):
        return LiveInterval(self.lower[index], self.upper[index], self.length[index])

    def in_units_of(self, unit):
        """Return the interval in units of a depth (m)."""
        return LiveInterval(*np.broadcast_arrays(self.lower / unit, self.upper / unit, self.length / unit))
