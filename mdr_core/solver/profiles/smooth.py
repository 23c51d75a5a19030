"""A smooth profile given by its slope."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.polynomial import Chebyshev, Polynomial

from ...base import check
from ..numerics import abel
from ..numerics.roots import increasing_root
from .profile import Profile

#: Values of ln x between which the mean slope g/x is interpolated, in steps of half an octave from 10⁻¹⁸ to
#: 10⁶ m. In such a panel a function without structure smaller than x is a polynomial of this degree to
#: rounding. Its last coefficients must be smaller than this share of the largest coefficient.
_EDGES = np.log(2.0) * np.arange(-60, 20.5, 0.5)
_DEGREE, _RESOLVED = 11, 1e-12
#: Least excess of the power of x in g over 1, next to the axis, for a tip that is not sharp.
_ROUNDED = 1e-6


@dataclass(frozen=True)
class Smooth(Profile):
    """A smooth profile given by its slope dz/dr.

    The reduced height is Popov (2015), Eq. (3), by quadrature. The contact radius and the slope g′ come
    from piecewise polynomials through it, up to 10⁶ m or to the end of the slope.

    Parameters
    ----------
    slope_function : callable
        dz/dr (dimensionless) as a vectorised function of the radius r ≥ 0 (m): smooth, with a growing g.
        Use `PowerLaw` for fractional powers of r, and `Sampled` for kinks.
    radius : float, optional
        Largest radius (m) at which the slope is known; infinite by default.

    Examples
    --------
    >>> from mdr_core import Smooth
    >>> print(round(Smooth(lambda r: 2 * r).reduced(3.0), 12))  # z = r² has g = 2x²
    18.0
    """

    slope_function: Callable
    radius: float = np.inf

    def __post_init__(self):
        if not callable(self.slope_function):
            given = check.shown(self.slope_function)
            raise check.MDRError(f"Smooth slope_function must be a function of the radius, got {given}")
        if not isinstance(self.slope_function, Hashable):
            # For example NumPy's polynomials; their methods are hashable.
            check.store(self, slope_function=self.slope_function.__call__)
        radius = check.positive_number("Smooth radius", self.radius, unit="m", infinite=True)
        check.store(self, radius=radius)

    shape = ()

    @property
    def known_radius(self):
        """Largest radius (m) at which the profile is known: the end of a valid slope, at most `radius`."""
        end = self._mean_slope.x[-1]
        return float(np.exp(end)) if end < np.log(self.radius) else self.radius

    @property
    def known_depth(self):
        """Largest depth (m) at which the profile is known, to 10⁻³ of its value."""
        end = self._mean_slope.x[-1]
        return float(np.exp(end) * self._mean_slope(end))

    def too_deep(self):
        end = np.exp(self._mean_slope.x[-1])
        return (
            f"deeper than the Smooth shape is known: beyond r = {end:g} m, at g = {self.known_depth:g} m, "
            "the slope ends, is not finite or smooth, or g falls, so that the contact would not be compact"
        )

    # The cache makes single states 1700 times as fast.
    @cached_property
    def _mean_slope(self):
        """g/x as a piecewise polynomial of ln x, from the tip outward to the end of a valid slope."""
        last = min(np.log(self.radius), _EDGES[-1])
        edges, panels = [_EDGES[0]], []
        for end in np.append(_EDGES[1:][_EDGES[1:] < last], last):
            # Panels are halved towards the end of the profile.
            while edges[-1] < end:
                low, high, panel = edges[-1], end, None
                while panel is None and high - low > 1e-3:
                    panel = self._panel(low, high)
                    high = high if panel is not None else (low + high) / 2
                if panel is None:
                    break
                edges.append(high)
                panels.append(panel)
            if edges[-1] < end:
                break
        if not panels:
            advice = "take PowerLaw for a fractional power of r, Sampled for kinks"
            bad = "is not finite, not smooth or not positive next to the axis"
            raise check.MDRError(f"Smooth slope_function {bad}; {advice}")
        return scipy.interpolate.PPoly(np.transpose(panels), np.array(edges))

    def _panel(self, low, high):
        """Return coefficients of g/x between two values of ln x; None if g is not smooth and growing."""

        def mean_slope(logarithm):
            x = np.exp(logarithm)
            return self.reduced_at(x) / x

        try:
            series = Chebyshev.interpolate(mean_slope, _DEGREE, [low, high])
        except check.InvalidArgument:
            raise
        except ValueError:
            return None
        rough = np.abs(series.coef[-2:]).max() > _RESOLVED * np.abs(series.coef).max()
        grid = np.linspace(low, high, 2 * _DEGREE)
        if rough or np.any(series(grid) + series.deriv()(grid) <= 0):
            return None
        power = series.convert(kind=Polynomial, domain=[low, high], window=[0, high - low]).coef
        return np.pad(power, (0, _DEGREE + 1 - power.size))[::-1]

    def height_at(self, r):
        return abel.height_from_slope(self.slope_function, r)

    def reduced_at(self, x):
        return abel.reduce_slope(self.slope_function, x)

    def reduced_slope_at(self, x):
        return self._height_and_slope(x)[1]

    def _height_and_slope(self, x):
        """Return g (m) and g′ from the piecewise polynomial."""
        mean = self._mean_slope
        logarithm = np.log(np.maximum(x, 1e-300))
        inside = np.maximum(logarithm, mean.x[0])
        value, rate = mean(inside), mean(inside, 1)
        # Between the tip and the first panel g is a power of x.
        power = 1 + rate / value
        # On the axis the slope is 0, or the slope of a cone if the power is 1 to rounding.
        on_axis = np.where(power > 1 + _ROUNDED, 0.0, value * power)
        value = value * np.exp((logarithm - inside) * (power - 1))
        return x * value, np.where(x == 0, on_axis, value * power)

    def radius_at(self, depth):
        return increasing_root(self._height_and_slope, depth, 1e-6, np.exp(self._mean_slope.x[-1]))
