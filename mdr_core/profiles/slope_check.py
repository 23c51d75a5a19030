"""Check whether g′ of a shape that a user wrote is the derivative of its g.

Between two radii that are near each other, the slope of g lies between the values of g′ at both, unless g′
turns in between. At a kink, at a jump of g and in the first cells of a table it may lie outside. So g′ is
wrong only if it is too large, or too small, by more than 30 % at three quarters of the radii of a contact.
A g′ that lacks a factor of 2 or π/2, or is z′, is wrong at all radii.
"""

from typing import NamedTuple

import numpy as np

#: Factor by which g′ may differ from the slope of g, and share of the radii at which it may differ by more.
#: Tables of powers of x up to the fourth, whose g is interpolated in another way than g′, differ by more at
#: half of the radii of a contact that is three cells wide, at a quarter of those of ten cells.
_FACTOR, _SHARE = 1.3, 0.75
#: Fewest pairs that are judged, and the heights g (m), and shares of g, below which they are rounding.
_FEWEST, _LOWEST, _ROUNDING = 4, 1e-12, 1e-6
#: Over a contact that is less than a cell of a table wide, g′ may differ everywhere. It is wrong only if it
#: is so up to this multiple of the contact radius, too, as far as the shape is known.
_WIDER = 5.0


class Misfit(NamedTuple):
    """Pairs of radii, one an entry: which can be judged, and at which g′ is too large or too small."""

    judged: np.ndarray
    large: np.ndarray
    small: np.ndarray

    @property
    def off(self):
        """At which pairs g′ is wrong."""
        return self.large | self.small

    @property
    def enough(self):
        """Whether enough pairs can be judged up to each of them."""
        return np.cumsum(self.judged, axis=0) >= _FEWEST

    def wrong(self, width):
        """Whether g′ is wrong for contacts up to each pair along the first axis.

        A pair stands for a width (m) of the contact.
        """
        judged, large, small = (np.cumsum(width * pairs, axis=0) for pairs in self)
        return self.enough & (np.maximum(large, small) > _SHARE * judged)


def misfit(below, above):
    """The `Misfit` of pairs of radii, from x (m), g (m) and g′ at the smaller and at the larger ones."""
    step, rise = above[0] - below[0], above[1] - below[1]
    # At the tip g′ may be infinite.
    with np.errstate(invalid="ignore"):
        low, high = (step * extreme(below[2], above[2]) for extreme in (np.minimum, np.maximum))
    judged = (above[1] > _LOWEST) & (np.maximum(rise, low) > _ROUNDING * above[1])
    return Misfit(judged, judged & (low > _FACTOR * rise), judged & (rise > _FACTOR * high))


def wrong_contacts(x, pairs):
    """Whether g′ of one profile is wrong for contacts with each of the radii x (m), from the tip outward.

    `pairs` is the `Misfit` of each of these radii with the one before it, and of the first with itself.
    """
    wrong = pairs.wrong(np.diff(x, prepend=0.0))
    wider = np.minimum(np.searchsorted(x, _WIDER * x), x.size - 1)
    return wrong & wrong[wider]


def words(x, g, slope):
    """Words for a wrong g′ at the larger one of two radii x (m), from g (m) and g′ at both."""
    own = (g[1] - g[0]) / (x[1] - x[0])
    return f"g′(x) is {slope[1]:g} at x = {x[1]:g} m, but g(x) rises with the slope {own:g} there"
