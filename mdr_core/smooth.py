"""An indenter of any smooth shape, given by its slope."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev

from . import _check, abel
from .inverse import newton
from .profiles import Profile
from .zones import Zone

# Degrees tried for the Chebyshev series of g/x, and how small its last coefficients must be.
_DEGREES = (16, 32, 64, 128, 256, 512)
_CONVERGED = 2e-15


@dataclass(frozen=True)
class Smooth(Profile):
    """Any smooth shape, given by its slope dz/dr.

    The reduced height comes from Popov (2015), Eq. (3), with spectral accuracy; over the contact
    it is a Chebyshev series, converged to rounding.

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
                f"Smooth slope_function must be a function of the radius, got {self.slope_function!r:.80}"
            )
        _check.number("Smooth radius", self.radius)
        radius = _check.positive("Smooth radius", self.radius, unit="m", infinite=True)
        object.__setattr__(self, "radius", radius)

    shape = ()
    known_radius = property(lambda self: self.radius)

    @property
    def zones(self):
        raise TypeError("the zone of a Smooth shape depends on the depth; ask zones_between")

    def zones_between(self, lower, upper):
        return (self._zone(float(upper)),) if upper > 0 else ()

    _zones = cached_property(lambda self: {})

    def _zone(self, depth):
        """The zone up to a depth, remembered."""
        if depth not in self._zones:
            if len(self._zones) > 64:
                self._zones.clear()
            self._zones[depth] = _fitted_zone(self, depth)
        return self._zones[depth]

    def _height(self, r):
        # ∫ z′ dr = r ∫ z′(r sin t) cos t dt, as the transform of z′(ρ) √(1 − (ρ/r)²).
        flat = r.ravel()
        height = [self._height_at(radius) for radius in flat]
        return np.array(height).reshape(r.shape)

    def _height_at(self, r):
        if r == 0:
            return 0.0

        def slope(rho):
            cosine = np.sqrt(np.maximum(1 - rho / r, 0.0) * (1 + rho / r))
            return self.slope_function(rho) * cosine

        return abel.reduce_slope(slope, r)

    def _reduced(self, x):
        return abel.reduce_slope(self.slope_function, x)

    def _radius(self, depth):
        deepest = float(np.max(depth, initial=0.0))
        return self._zone(deepest).coordinate(depth) if deepest > 0 else np.zeros_like(depth)


def _fitted_zone(shape, depth):
    """The one zone of a smooth shape up to its contact radius at `depth`."""
    end = _contact_end(shape, depth)
    series = _series(shape, end)
    derivative = chebyshev.chebder(series) * (2 / end)

    def mean_slope(x):
        return chebyshev.chebval(2 * x / end - 1, series)

    def rate(x):
        return mean_slope(x) + x * chebyshev.chebval(2 * x / end - 1, derivative)

    x = end * np.sin(np.linspace(0, np.pi / 2, 513)[1:]) ** 2
    if np.any(rate(x) <= 0):
        raise _not_compact(depth)
    table = end * np.geomspace(1e-18, 1, 600)
    heights = np.log(np.maximum(table * mean_slope(table), np.finfo(float).tiny))

    def coordinate(depths):
        depths = np.asarray(np.minimum(depths, depth))
        with np.errstate(divide="ignore"):
            start = np.exp(np.interp(np.log(depths), heights, np.log(table)))
        start = np.where(depths > 0, start, 0.0)
        return newton(lambda x: (x * mean_slope(x) - depths) / rate(x), start, largest=end * (1 + 1e-12))

    # A tip is sharp if the mean slope does not vanish towards it.
    order = 0 if mean_slope(0.0) > 1e-12 * np.abs(series).sum() else 1
    # The degree tells how close to the axis a singularity may lie.
    return Zone(rate, coordinate, order=order, scale=8 * end / len(series))


def _series(shape, end):
    """Chebyshev series on [0, end] of g/x, the mean slope."""
    for degree in _DEGREES:
        x = end * (1 + np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))) / 2
        series = chebyshev.chebfit(2 * x / end - 1, shape._reduced(x) / x, degree)
        if np.abs(series[-3:]).max() <= _CONVERGED * np.abs(series).max():
            return series
    raise ValueError(
        f"Smooth slope_function is too rough up to r = {end:g} m: a Chebyshev series of degree "
        f"{_DEGREES[-1]} does not converge; give samples (Sampled), or PowerLaw for a fractional power"
    )


def _contact_end(shape, depth):
    """Contact radius (m) at `depth`, by bisection of g itself."""

    def height(x):
        # Where the slope is not finite, or too rough, the shape is not known.
        try:
            return float(shape._reduced(np.asarray(x)))
        except ValueError:
            return np.inf

    high = min(shape.radius, 1.0)
    while high > 1e-200 and height(high) >= depth:
        high /= 4
    if high <= 1e-200:
        raise ValueError(
            "Smooth slope_function is not finite or not smooth next to the axis; a fractional power of "
            "r belongs to PowerLaw, kinks to Sampled"
        )
    low, g_low = high, height(high)
    while g_low < depth and low < min(shape.radius, 1e12):
        high = min(2 * low, shape.radius)
        g_high = height(high)
        if g_high <= g_low:
            raise _not_compact(depth)
        if g_high >= depth:
            break
        low, g_low = high, g_high
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if height(middle) >= depth else (middle, high)
    if height(low) < depth * (1 - 1e-12):
        raise ValueError(
            f"depth = {depth:g} m is deeper than the Smooth shape is known: at r = {low:g} m, where the "
            f"slope ends or is not finite or smooth, g = {height(low):g} m; press less deep"
        )
    return low


def _not_compact(depth):
    return ValueError(
        f"the reduced height of a Smooth shape does not grow all the way to a depth of {depth:g} m, so "
        "that the contact would not be compact; the shape must not be concave or wavy: press less deep"
    )
