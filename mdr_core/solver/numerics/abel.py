"""Abel transforms between the 3D and the 1D problem, for functions and samples.

Popov (2015), Eqs. (3), (7) and (10).
"""

from collections.abc import Callable

import numpy as np
import scipy

from ...base import check, read_only
from ...base.check import Array, ArrayLike
from .blocks import chunks
from .gauss import tanh_sinh
from .stable import root

# Steps of the quadrature in the order of trial, and largest relative difference of two results. The error
# of the finer rule is about the square of the error of the coarser rule.
_STEPS = (1 / 14, 1 / 28, 1 / 56, 1 / 112)
_MAX_DIFFERENCE = 1e-9


def reduce_slope(slope: Callable[[Array], Array], x: ArrayLike) -> Array:
    """Compute the reduced profile g(x) (m) of the profile with slope dz/dr.

    Popov (2015), Eq. (3): g(x) = x ∫ z′(x sin t) dt over 0 < t < π/2, by a tanh-sinh rule, refined until it
    converges. The accuracy is spectral for smooth slopes, and for any power of r at r = 0.

    Parameters
    ----------
    slope : callable
        dz/dr (dimensionless) as a vectorised function of the radius r ≥ 0 (m), smooth.
    x : array_like
        Coordinate (m).

    Returns
    -------
    float or ndarray
        g (m), of the shape of `x`.

    Raises
    ------
    ValueError
        If the slope is not finite between 0 and x, or the rule does not converge with 760 nodes.

    Examples
    --------
    >>> from mdr_core.abel import reduce_slope
    >>> print(round(reduce_slope(lambda r: 2 * r, 3.0), 12))  # z = r² has g = 2x²
    18.0
    """
    x = np.abs(check.finite_array("coordinate x", x, unit="m"))
    return (x * _slope_integral(slope, x, np.ones_like))[()]


def height_from_slope(slope: Callable[[Array], Array], r: Array) -> Array:
    """Compute the height z(r) = r ∫ z′(r sin t) cos t dt (m) from the slope dz/dr, like `reduce_slope`."""
    return (r * _slope_integral(slope, r, np.cos))[()]


def kappa(n: ArrayLike) -> Array:
    """Return the coefficient κₙ = √π n Γ(n/2)/(2 Γ((n+1)/2)) of a reduced power law, for n up to 100.

    Popov (2015), Eq. (7).

    Examples
    --------
    >>> from mdr_core.abel import kappa
    >>> print(kappa(2.0))
    2.0
    """
    n = check.positive("exponent n", n, zero=True, within=(0.0, 100.0))
    # n Γ(n/2)/2 = Γ(n/2 + 1), which is finite for n → 0.
    return np.sqrt(np.pi) * scipy.special.gamma(n / 2 + 1) / scipy.special.gamma((n + 1) / 2)


def _refused(what, advice):
    """Return the error for a slope that gives no numbers."""
    return check.InvalidArgument(f"{what}; {advice}", "slope dz/dr", None, what, "", advice)


def _slope_integral(slope, x, factor):
    """Return ∫ slope(x sin t) factor(t) dt over 0 < t < π/2, for an array of x."""
    slope = read_only.read_only(slope, "slope dz/dr")
    previous = None
    for step in _STEPS:
        node, weight = tanh_sinh(step)
        angle = np.pi / 2 * node
        radius = x[..., None] * np.sin(angle)
        values = check.values_of("slope dz/dr", slope, radius, _refused)
        bad = ~np.isfinite(values)
        if bad.any():
            raise check.MDRError(
                f"slope dz/dr is {values[bad][0]:g} at {radius[bad][0]:g} m and must be finite up to "
                f"{x.max():g} m; stay below, or give a function that is finite there"
            )
        weight = np.pi / 2 * weight * factor(angle)
        integral, size = values @ weight, np.abs(values) @ weight
        if previous is not None and np.all(np.abs(integral - previous) <= _MAX_DIFFERENCE * size):
            return integral
        previous = integral
    raise check.MDRError(
        f"slope dz/dr is too rough: {node.size} nodes do not converge up to {x.max():g} m; give a profile "
        "with kinks as samples (Sampled), or smooth it"
    )


def stress_from_line_load(x: ArrayLike, q: ArrayLike, r: ArrayLike) -> Array:
    """Compute the normal stress σ_zz(r) (Pa) from samples of the line load q(x).

    Popov (2015), Eq. (10): σ_zz = (1/π) ∫ q′(x)/√(x² − r²) dx over x > r. It is exact for a q that is
    linear between the samples, constant before the first sample and 0 after the last sample. A coordinate
    given twice is a jump; a last q other than 0 is also a jump. If the first two slopes extrapolate to zero
    at the axis within 5 % of the second slope, q is an even parabola between x = 0 and the next sample. The
    stress on the axis is then finite.

    Parameters
    ----------
    x, q : array_like, shape (N,)
        Coordinates (m), not negative, in ascending order, and line load (N/m), positive in compression.
    r : array_like
        Radii (m).

    Returns
    -------
    float or ndarray
        σ_zz (Pa), negative in compression, of the shape of `r`; the contact pressure is −σ_zz. It is
        infinite at jumps, and on the axis if q has a kink there.

    Raises
    ------
    ValueError
        If the samples are not finite, not in ascending order, or of different lengths.

    Notes
    -----
    The error for a smooth load decreases as the power 1.5 of the spacing. The time is proportional to the
    number of samples times the number of radii.

    Examples
    --------
    A cone in elastic contact, q = 1 − x and p = arcosh(1/r)/π:

    >>> from mdr_core.abel import stress_from_line_load
    >>> print(round(stress_from_line_load([0.0, 1.0], [1.0, 0.0], 0.5), 12))
    -0.419200718279
    """
    x, q = _samples(x, q, "line load q", "N/m")
    r = _lengths("radius r", np.abs(check.finite_array("radius r", r, unit="m")))
    if x[-1] == 0:
        # A load only on the axis has no width.
        return np.zeros_like(r)[()]
    slope, jump = _slopes(x, q)
    positive = x > 0
    jumps = _superpose(lambda x, r: 1 / root(x, r), x, jump, r)
    jumps = np.where(r == 0, np.sum(jump[positive] / x[positive]), jumps)
    return ((_polygon_stress(x, slope, _is_even(x, slope, jump), r) + jumps) / np.pi)[()]


def surface_displacement(x: ArrayLike, u: ArrayLike, r: ArrayLike) -> Array:
    """Compute the elastic surface displacement (m) from samples of the foundation's compression u(x).

    It is (2/π) ∫ u(x)/√(r² − x²) dx over x < r, exact for a u that is linear between the samples and 0
    after the last sample.

    Parameters
    ----------
    x, u : array_like, shape (N,)
        Coordinates (m) in ascending order from 0, and compression (m).
    r : array_like
        Radii (m).

    Returns
    -------
    ndarray
        Displacement (m), positive downward, of the shape of `r`.

    Examples
    --------
    A flat punch of radius 1 m, pressed by 1 m, displaces the surface at r = 2 m by (2/π) arcsin(1/2) m:

    >>> from mdr_core.abel import surface_displacement
    >>> print(round(float(surface_displacement([0.0, 1.0], [1.0, 1.0], 2.0)), 12))
    0.333333333333
    """
    x, u = _samples(x, u, "displacement u", "m")
    r = np.abs(check.finite_array("radius r", r, unit="m"))[..., None]
    inside, slope = np.minimum(x, r), np.diff(u) / np.diff(x)
    # On the axis the displacement is the compression of the spring there.
    ratio = np.divide(inside, r, out=np.ones_like(inside), where=r > 0)
    angle = np.where(r > 0, np.diff(np.arcsin(ratio)), 0.0)
    root = np.diff(np.sqrt((r - inside) * (r + inside)))
    moved = 2 / np.pi * np.sum((u[:-1] - slope * x[:-1]) * angle - slope * root, axis=-1)
    return np.where(r[..., 0] > 0, moved, u[0])[()]


def _polygon_stress(x, slope, even, r):
    """Return ∫ q′/√(x² − r²) dx (N/m²) for constant slopes; if even, with a parabola in interval 0."""
    curvature = 0.0
    if even:
        curvature, slope[0] = 2 * slope[0] / x[1], 0.0
    # Integration by parts: arcosh(x/r), the integral of the kernel, times each change of slope.
    change = -np.diff(slope, prepend=0.0, append=0.0)
    stress = _superpose(_arcosh, x, change, r)
    # On the axis the logarithms of r cancel, unless q has a kink there.
    kink = slope[0] if x[0] == 0 and len(slope) else 0.0
    positive = x > 0
    at_axis = np.sum((change * np.log(x / x[-1], where=positive, out=np.zeros_like(x)))[positive])
    stress = np.where(r == 0, at_axis + (np.copysign(np.inf, kink) if kink else 0.0), stress)
    return stress + curvature * root(x[1], r) if even else stress


def _superpose(kernel, x, weight, r):
    """Return Σ weight_j kernel(x_j, r) over all x_j > r, and x_j = r if it is infinite; 0 for r = 0."""
    used = weight != 0
    x, weight, flat = x[used], weight[used], r.ravel()
    total = np.zeros(r.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        for rows in chunks(flat.size, max(1, 2**20 // max(x.size, 1))):
            radius = flat[rows, None]
            inside = (x >= radius) & (radius > 0)
            terms = np.where(inside, kernel(np.maximum(x, radius), radius) * weight, 0.0)
            total[rows] = terms.sum(axis=1)
    return total.reshape(r.shape)


def _arcosh(x, r):
    """Return arcosh(x/r) = ∫ dx/√(x² − r²) from r to x."""
    return np.log1p((x - r + root(x, r)) / r)


def _samples(x, values, quantity, unit):
    """Return coordinates (m) and values of a quantity as arrays if they are valid samples."""
    x = check.finite_array("coordinate", x, unit="m")
    values = check.finite_array(quantity, values, unit=unit, most=check.LARGEST)
    if x.ndim != 1 or x.shape != values.shape or not x.size:
        raise check.MDRError(
            f"{quantity} of shape {values.shape} needs as many coordinates, got shape {x.shape}"
        )
    check.raise_if(
        "coordinate", x, x < 0, "is negative", unit="m", advice="give x ≥ 0; the values at −x are the same"
    )
    back = np.append(False, np.diff(_lengths("coordinate", x)) < 0)
    bound = "comes after a larger coordinate"
    check.raise_if("coordinate", x, back, bound, unit="m", advice="sort the samples")
    return x, values


def _lengths(quantity, x):
    """Return coordinates or radii (m) if their squares and quotients are within double precision."""
    outside = (x > 0) & (x < check.SMALLEST) | (x > check.LONGEST)
    bound = f"must be 0 or lie between {check.SMALLEST:g} and {check.LONGEST:g}"
    return check.raise_if(quantity, x, outside, bound, unit="m", advice="give it in SI units")


def _slopes(x, q):
    """Return the slope of each interval and the jump at each coordinate; the last jump is to 0."""
    step, rise = np.diff(x), np.diff(q)
    slope = np.divide(rise, step, out=np.zeros_like(step), where=step > 0)
    jump = np.append(np.where(step == 0, rise, 0.0), -q[-1])
    # Jumps at the same coordinate are added before the kernel: ∞ − ∞ would be NaN.
    first = np.flatnonzero(np.append(True, step > 0))
    merged = np.zeros_like(jump)
    merged[np.append(first[1:] - 1, len(x) - 1)] = np.add.reduceat(jump, first)
    return slope, merged


def _is_even(x, slope, jump):
    """Whether the first interval, from the axis, is an even parabola."""
    if len(x) < 3 or x[0] > 0 or x[1] == 0 or jump[1] or x[2] == x[1]:
        return False
    # The mean slopes of an even parabola are in the ratio x₁ : (x₁ + x₂).
    return abs(slope[0] * (x[1] + x[2]) - slope[1] * x[1]) <= 0.05 * abs(slope[1]) * x[1]
