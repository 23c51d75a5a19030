"""The paper's row of springs and sliders, written out: the brute-force witness, without viscosity."""

import numpy as np


class Chain:
    """A row of elements under an indenter, Popov (2015), Eqs. (1), (11), (17), (18).

    Parameters
    ----------
    profile, medium
        As for `mdr_core.indent`.
    n : int
        Elements on one side of the axis.
    half_width : float
        Length of that side (m).
    """

    def __init__(self, profile, medium, n, half_width):
        self.step = half_width / n
        self.x = (np.arange(n) + 0.5) * self.step
        self._medium, self._gap = medium, profile.reduced(self.x)
        self._plastic = np.zeros(n)
        self.line_load = np.zeros(n)

    def advance(self, depth):
        """Moves the indenter to a depth; gives the force (N)."""
        compression = depth - self._gap
        np.maximum(self._plastic, compression - self._medium.critical_depth, out=self._plastic)
        self.line_load = self._medium.E_star * np.maximum(compression - self._plastic, 0.0)
        return 2 * self.step * self.line_load.sum()
