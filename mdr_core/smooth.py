"""An indenter of any smooth shape, given by its slope."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev

from . import _check, abel
from .inverse import newton
from .panels import chunks
from .profiles import Profile
from .zones import Zone

# Degrees tried for the Chebyshev series of g/x, and how small its last coefficients must be.
_DEGREES = (16, 32, 64, 128, 256, 512)
_CONVERGED = 2e-15
# Steps of the depths to which zones reach (octaves), least and largest depth (m), zones remembered.
_OCTAVES, _SHALLOWEST, _DEEPEST, _MOST_ZONES = (2.0, 0.25, 0.01), 1e-60, 1e9, 512


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
                "Smooth slope_function must be a function of the radius, "
                f"got {_check.shown(self.slope_function)}"
            )
        radius = _check.positive_number("Smooth radius", self.radius, unit="m", infinite=True)
        object.__setattr__(self, "radius", radius)

    shape = ()
    known_radius = property(lambda self: self.radius)

    @property
    def zones(self):
        raise TypeError("the zone of a Smooth shape depends on the depth; ask zones_between")

    def zones_between(self, lower, upper):
        return tuple(zone for _, zone in self._shared(np.array([upper], dtype=float)))

    def batches(self, depth):
        return [rows[part] for rows, _ in self._shared(depth) for part in chunks(rows.size)] + [
            np.flatnonzero(~(depth > 0))
        ]

    @cached_property
    def deepest(self):
        """Depth (m) up to which zones can be fitted, within a tenth; infinite if unknown.

        What stops them is the end of the slope, or g that no longer grows or is too rough there.
        """
        depth = 2.0**-20
        while not self._fits(depth):
            depth /= 2.0**20
            if depth < _SHALLOWEST:
                # Nowhere: the zone that is asked for will say why.
                return np.inf
        for factor in (2.0**10, 4.0):
            while depth < _DEEPEST and self._fits(depth * factor):
                depth *= factor
        for factor in (2.0, 2**0.5, 2**0.25, 2**0.125):
            if depth < _DEEPEST and self._fits(depth * factor):
                depth *= factor
        return depth

    def _known(self, depth):
        # A zone that cannot be fitted says itself why it does not reach so deep.
        tiny, bound = (depth > 0) & (depth < _SHALLOWEST), f"must be 0 or at least {_SHALLOWEST:g}"
        return _check.refuse("depth", depth, tiny, bound, unit="m", remedy="give it in SI units")

    def _shared(self, depth):
        """Rows of an array of positive depths (m) and the zone that they share, whatever their neighbours.

        Zones reach to powers of two; where the shape ends before, to finer steps, at last to a depth
        itself.
        """
        rest = np.flatnonzero(depth > 0)
        for octaves in _OCTAVES:
            levels = np.ceil(np.log2(np.maximum(depth[rest], _SHALLOWEST)) / octaves)
            left = np.ones(rest.size, bool)
            for level in np.unique(levels):
                top = float(2.0 ** (octaves * level))
                if self._fits(top):
                    yield rest[levels == level], self._attempt(top, True)
                    left[levels == level] = False
            rest = rest[left]
        for row in rest:
            zone = self._attempt(float(depth[row]), False)
            if isinstance(zone, ValueError):
                raise ValueError(*zone.args)
            yield np.array([row]), zone

    def _fits(self, depth):
        return not isinstance(self._attempt(depth, True), ValueError)

    _zones = cached_property(lambda self: {})
    _failures = cached_property(lambda self: [(np.inf, None)])

    def _attempt(self, depth, generous):
        """The zone up to a depth, generously or exactly, or the error it ends in; remembered."""
        result = self._zones.get((depth, generous))
        if result is None:
            if generous and depth >= self._failures[-1][0]:
                return self._failures[-1][1]
            try:
                result = _fitted_zone(self, depth, 1e-2 if generous else 0.0)
            except ValueError as error:
                result = error
                if generous:
                    # What contains it fails as well.
                    self._failures.append((depth, error))
            if len(self._zones) > _MOST_ZONES:
                self._zones.clear()
            self._zones[depth, generous] = result
        return result

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
        depth = np.asarray(depth)
        result, flat = np.zeros(depth.size), depth.ravel()
        for rows, zone in self._shared(flat):
            result[rows] = zone.coordinate(flat[rows])
        return result.reshape(depth.shape)


def _fitted_zone(shape, depth, margin):
    """The one zone of a smooth shape up to its contact radius at `depth`, or a little beyond."""
    end = _contact_end(shape, depth, margin)
    series = _series(shape, end)
    derivative = chebyshev.chebder(series) * (2 / end)

    def mean_slope(x):
        return chebyshev.chebval(2 * x / end - 1, series)

    def rate(x):
        return mean_slope(x) + x * chebyshev.chebval(2 * x / end - 1, derivative)

    x = end * np.sin(np.linspace(0, np.pi / 2, 513)[1:]) ** 2
    if np.any(rate(x) <= 0):
        raise _not_compact(depth)
    table = end * np.geomspace(1e-10, 1, 400)
    # Closer to the tip, where the series has few digits left, the profile goes on as a power.
    table = table[np.argmax(mean_slope(table) > 1e-5 * mean_slope(end)) :]
    heights, table = np.log(table * mean_slope(table)), np.log(table)
    power = (table[5] - table[0]) / (heights[5] - heights[0])

    def coordinate(depths):
        depths = np.asarray(np.minimum(depths, depth))
        with np.errstate(divide="ignore"):
            height = np.log(depths)
        beside = np.minimum(height - heights[0], 0.0)
        target = np.where(beside < 0, np.exp(heights[0]), depths)
        start = np.exp(np.interp(height, heights, table))
        t = newton(lambda x: (x * mean_slope(x) - target) / rate(x), start, largest=end * (1 + 1e-12))
        return t * np.exp(power * beside)

    # A tip is sharp if the mean slope does not vanish towards it.
    order = 0 if mean_slope(0.0) > 1e-12 * np.abs(series).sum() else 1
    # The degree tells how close to the axis a singularity may lie.
    return Zone(rate, coordinate, order=order, scale=8 * end / len(series))


def _series(shape, end):
    """Chebyshev series on [0, end] of g/x, the mean slope."""
    for degree in _DEGREES:
        count = degree + 1
        order, node = np.arange(count)[:, None], 2 * np.arange(count) + 1
        x = end * np.cos(np.pi / 4 * node / count) ** 2
        # Cosines are orthogonal on these nodes; whole turns are taken out before they cost digits.
        cosine = np.cos(np.pi / 2 * (order * node % (4 * count)) / count)
        series = 2 / count * cosine @ (shape._reduced(x) / x)
        series[0] /= 2
        if np.abs(series[-3:]).max() <= _CONVERGED * np.abs(series).max():
            return series
    raise ValueError(
        f"Smooth slope_function is too rough up to r = {end:g} m: a Chebyshev series of degree "
        f"{_DEGREES[-1]} does not converge; give samples (Sampled), or PowerLaw for a fractional power"
    )


def _contact_end(shape, depth, margin):
    """Contact radius (m) at `depth`, by bisection of g itself; too large by up to a share `margin`."""

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
    low, g_low, g_high = high, height(high), np.inf
    while g_low < depth and low < min(shape.radius, 1e12):
        high = min(2 * low, shape.radius)
        g_high = height(high)
        if g_high <= g_low:
            raise _not_compact(depth)
        if g_high >= depth:
            break
        low, g_low = high, g_high
    if g_high < depth:
        raise _too_deep(depth, low, g_low)
    for _ in range(60):
        if g_high < np.inf and high <= low * (1 + margin):
            return high
        middle = (low + high) / 2
        g_middle = height(middle)
        if margin and g_middle == np.inf:
            break
        if g_middle >= depth:
            high, g_high = middle, g_middle
        else:
            low = middle
    if height(low) < depth * (1 - 1e-12):
        raise _too_deep(depth, low, height(low))
    return low


def _too_deep(depth, radius, height):
    return ValueError(
        f"depth = {depth:g} m is deeper than the Smooth shape is known: at r = {radius:g} m, where the "
        f"slope ends or is not finite or smooth, g = {height:g} m; press less deep"
    )


def _not_compact(depth):
    return ValueError(
        f"the reduced height of a Smooth shape does not grow all the way to a depth of {depth:g} m, so "
        "that the contact would not be compact; the shape must not be concave or wavy: press less deep"
    )
