"""An indenter of any smooth shape, given by its slope."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.polynomial import Chebyshev, Polynomial

from .. import _check, abel
from .._numeric import increasing_root
from .profile import Profile

#: The mean slope g/x is interpolated in ln x, in stretches of half an octave between 10⁻¹⁸ and 10⁶ m. Over
#: one of them a function that has no structure smaller than x is a polynomial of this degree, to rounding.
_PLACES = np.log(2.0) * np.arange(-60, 20.5, 0.5)
_DEGREE, _RESOLVED = 11, 1e-12


@dataclass(frozen=True)
class Smooth(Profile):
    """Any smooth shape, given by its slope dz/dr.

    The reduced height comes from Popov (2015), Eq. (3), with spectral accuracy; the contact radius and
    the slope g′ from piecewise polynomials through it, which reach to 10⁶ m, or to where the slope ends.

    Parameters
    ----------
    slope_function : callable
        dz/dr (dimensionless) as a vectorised function of the radius r ≥ 0 (m): smooth on the whole
        contact, with g growing along it. Fractional powers of r belong to `PowerLaw`, kinks to
        `Sampled`.
    radius : float, optional
        Largest radius (m) at which the slope is known; infinite by default.

    Examples
    --------
    >>> print(round(Smooth(lambda r: 2 * r).reduced(3.0), 12))  # z = r² has g = 2x²
    18.0
    """

    slope_function: Callable
    radius: float = np.inf

    def __post_init__(self):
        if not callable(self.slope_function):
            raise ValueError(
                "Smooth slope_function must be a function of the radius, "
                f"got {_check.shown(self.slope_function)}"
            )
        radius = _check.positive_number("Smooth radius", self.radius, unit="m", infinite=True)
        object.__setattr__(self, "radius", radius)

    shape = ()
    known_radius = property(lambda self: self.radius)

    @cached_property
    def known_depth(self):
        """Depth (m) up to which the shape is known, within 10⁻³ of it."""
        end = self._mean_slope.x[-1]
        return float(np.exp(end) * self._mean_slope(end))

    def _too_deep(self):
        end = np.exp(self._mean_slope.x[-1])
        return (
            f"deeper than the Smooth shape is known: beyond r = {end:g} m, at g = {self.known_depth:g} m, "
            "the slope ends, is not finite or smooth, or g falls, so that the contact would not be compact"
        )

    @cached_property
    def _mean_slope(self):
        """g/x as a piecewise polynomial of ln x, from the tip outward as far as it can be had."""
        last = min(np.log(self.radius), _PLACES[-1])
        edges, pieces = [_PLACES[0]], []
        for end in np.append(_PLACES[1:][_PLACES[1:] < last], last):
            # Where the shape ends within a stretch, ever closer to there.
            while edges[-1] < end:
                low, high, piece = edges[-1], end, None
                while piece is None and high - low > 1e-3:
                    piece = self._piece(low, high)
                    high = high if piece is not None else (low + high) / 2
                if piece is None:
                    break
                edges.append(high)
                pieces.append(piece)
            if edges[-1] < end:
                break
        if not pieces:
            raise ValueError(
                "Smooth slope_function is not finite, not smooth or not positive next to the axis; a "
                "fractional power of r belongs to PowerLaw, kinks to Sampled"
            )
        return scipy.interpolate.PPoly(np.transpose(pieces), np.array(edges))

    def _piece(self, low, high):
        """Coefficients of g/x between two values of ln x; None where g is not known or does not grow."""

        def mean_slope(place):
            x = np.exp(place)
            return self._reduced(x) / x

        try:
            series = Chebyshev.interpolate(mean_slope, _DEGREE, [low, high])
        except ValueError:
            return None
        rough = np.abs(series.coef[-2:]).max() > _RESOLVED * np.abs(series.coef).max()
        along = np.linspace(low, high, 2 * _DEGREE)
        if rough or np.any(series(along) + series.deriv()(along) <= 0):
            return None
        power = series.convert(kind=Polynomial, domain=[low, high], window=[0, high - low]).coef
        return np.pad(power, (0, _DEGREE + 1 - power.size))[::-1]

    def _height(self, r):
        return abel.height_from_slope(self.slope_function, r)

    def _reduced(self, x):
        return abel.reduce_slope(self.slope_function, x)

    def _reduced_slope(self, x):
        return self._height_and_slope(x)[1]

    def _height_and_slope(self, x):
        """g and g′, from the piecewise polynomial."""
        mean = self._mean_slope
        place = np.log(np.maximum(x, 1e-300))
        inside = np.maximum(place, mean.x[0])
        value, rate = mean(inside), mean(inside, 1)
        # Closer to the tip g goes on as a power.
        power = 1 + rate / value
        value = value * np.exp((place - inside) * (power - 1))
        return x * value, value * power

    def _radius(self, depth):
        return increasing_root(self._height_and_slope, depth, 1e-6, np.exp(self._mean_slope.x[-1]))
