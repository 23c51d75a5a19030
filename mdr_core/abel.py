"""Integral transforms between 3D and 1D: Popov (2015), Eqs. (3) and (10), and their inverses.

Pure mathematics, for callables (`reduce_slope`, `height_from_reduced`) and for samples
(`stress_from_line_load`, `line_load_from_stress`).
"""

import numpy as np
from scipy.special import gamma

from . import _check, cubic
from .kernels import arcosh, chord, punch, segment
from .legendre import gauss_legendre
from .treecode import superpose_kernel

# Nodes tried in turn, and how closely two of them must agree.
_COUNTS = (16, 32, 64, 128, 256, 512, 1024)
_AGREE = 4e-15


def reduce_slope(slope, x):
    """Reduced height g(x) of the shape with slope dz/dr, Popov (2015), Eq. (3).

    g(x) = x ∫ z′(x sin t) dt over 0 < t < π/2, by Gauss–Legendre quadrature with as many nodes
    as it takes: spectral accuracy for a smooth slope.

    Parameters
    ----------
    slope : callable
        dz/dr (dimensionless) as a vectorised function of the radius r ≥ 0 (m), smooth.
    x : float or array_like
        Coordinate (m).

    Returns
    -------
    float or ndarray
        g (m), of the shape of `x`.

    Raises
    ------
    ValueError
        If the slope is not finite somewhere on [0, |x|], or too rough for 1024 nodes.

    Examples
    --------
    >>> print(round(reduce_slope(lambda r: 2 * r, 3.0), 12))  # z = r² has g = 2x²
    18.0
    """
    x = np.abs(_check.finite_array("coordinate x", x, unit="m"))
    return (x * _mean_over_quarter(slope, x, "slope dz/dr"))[()]


def kappa(n):
    """Coefficient κₙ = √π n Γ(n/2)/(2 Γ((n+1)/2)) of a reduced power law.

    Popov (2015), Eq. (7).

    Examples
    --------
    >>> print(kappa(2.0))
    2.0
    """
    n = np.asarray(_check.positive("exponent n", n, zero=True))
    # n Γ(n/2)/2 = Γ(n/2 + 1), which stays finite as n → 0.
    few = np.minimum(n, 300.0)
    ratio = np.sqrt(np.pi) * gamma(few / 2 + 1) / gamma((few + 1) / 2)
    # Γ(m + 1/2)/Γ(m) for large m, where the gamma functions overflow.
    m = (np.maximum(n, 300.0) + 1) / 2
    series = np.polyval([869 / 4194304, -399 / 262144, -21 / 32768, 5 / 1024, 1 / 128, -1 / 8, 1], 1 / m)
    return np.where(n < 300, ratio, np.sqrt(np.pi * m) * series)[()]


def height_from_reduced(reduced, r):
    """Height z(r) of the shape whose reduced height is g(x), the inverse of Popov (2015), Eq. (3).

    z(r) = (2/π) ∫ g(r sin t) dt over 0 < t < π/2.

    Parameters
    ----------
    reduced : callable
        g (m) as a vectorised function of x ≥ 0 (m), smooth.
    r : float or array_like
        Radius (m).

    Returns
    -------
    float or ndarray
        z (m), of the shape of `r`.

    Raises
    ------
    ValueError
        If g is not finite somewhere on [0, |r|], or too rough for 1024 nodes.

    Examples
    --------
    >>> print(round(height_from_reduced(lambda x: 2 * x**2, 3.0), 12))
    9.0
    """
    r = np.abs(_check.finite_array("radius r", r, unit="m"))
    return (2 / np.pi * _mean_over_quarter(reduced, r, "reduced height g"))[()]


def _mean_over_quarter(function, x, quantity):
    """∫ function(x sin t) dt over 0 < t < π/2, for an array of x."""
    result, open_, last = np.zeros(x.shape), np.ones(x.shape, bool), np.full(x.shape, np.nan)
    for count in _COUNTS:
        node, weight = gauss_legendre(count)
        points = x[open_][:, None] * np.sin(np.pi / 4 * (1 + node))
        with np.errstate(all="ignore"):
            values = np.asarray(function(points), dtype=float)
        values = np.broadcast_to(values, points.shape)
        bad = ~np.isfinite(values)
        if bad.any():
            raise ValueError(
                f"{quantity} is {values[bad][0]:g} at {points[bad][0]:g} m and must be finite up to "
                f"{x.max():g} m; stay below, or give a function that is finite there"
            )
        new = np.pi / 4 * values @ weight
        size = np.pi / 4 * np.abs(values) @ weight
        settled = np.abs(new - last[open_]) <= _AGREE * size
        result[open_] = last[open_] = new
        open_[open_] = ~settled
        if not open_.any():
            return result
    raise ValueError(
        f"{quantity} is too rough: {_COUNTS[-1]} nodes do not settle up to {x[open_].flat[0]:g} m; "
        "give its kinks as samples (Sampled), or smooth it"
    )


def stress_from_line_load(x, q, r, axis="auto", interpolation="linear"):
    """Normal stress σ_zz(r) from samples of the line load q(x), Popov (2015), Eq. (10).

    σ_zz = (1/π) ∫ q′(x)/√(x² − r²) dx over x > r, exactly for the q that is linear between the
    samples, or the cubic spline through them, constant before the first and 0 beyond the last one.
    A node given twice is a jump; so is a last q that is not 0.

    Parameters
    ----------
    x : array_like, shape (N,)
        Coordinates (m), not negative, in ascending order.
    q : array_like, shape (N,)
        Line load (N/m) at `x`, positive in compression.
    r : float or array_like
        Radii (m).
    axis : {"auto", "straight", "even"}, optional
        How q runs between x = 0 and the next node: straight (as the spline comes, if cubic), or as
        the even parabola (with no slope on the axis, if cubic) of a load that is smooth across the
        axis; otherwise it has a tip there, and an infinite stress. "auto" takes it as even where
        the first two slopes extrapolate to zero on the axis within 5 % of the second.
    interpolation : {"linear", "cubic"}, optional
        "linear" is right for any q, and exact for that of a cone. "cubic" is for a smooth q, whose
        error it makes fall as the power 3.5 of the spacing instead of 1.5. It does not cross nodes
        that are given twice: give those at which q has a kink so, with the same q.

    Returns
    -------
    float or ndarray
        σ_zz (Pa), negative in compression, of the shape of `r`; the contact pressure is minus
        this. Infinite at jumps, and on the axis below a tip of q.

    Notes
    -----
    The cost grows as (N + M) log N for M radii, the memory linearly.

    Examples
    --------
    A cone of slope 2/π under E* = 1 pressed to d = 1 has q = 1 − x, p = (1/π) arccosh(1/r):

    >>> print(round(stress_from_line_load([0, 1], [1, 0], 0.5), 12))
    -0.419200718279

    Hertz, q = 1 − x² and p = (2/π) √(1 − r²), which a cubic gives without error:

    >>> x = np.linspace(0, 1, 5)
    >>> print(round(stress_from_line_load(x, 1 - x**2, 0.6, interpolation="cubic"), 12))
    -0.509295817894
    """
    x, q = _samples(x, q, "line load q", "N/m")
    r = _places("radius r", np.abs(_check.finite_array("radius r", r, unit="m")))
    for name, value, known in (
        ("axis", axis, ("auto", "straight", "even")),
        ("interpolation", interpolation, ("linear", "cubic")),
    ):
        _check.one_of(name, value, known)
    if x[-1] == 0:
        # All of the load stands on the axis, where it has no width.
        return np.zeros_like(r)[()]
    slope, jump = _slopes(x, q)
    even = _is_even(x, slope, jump, axis)
    if interpolation == "cubic":
        smooth = cubic.stress(x, cubic.slopes(x, q, even), r)
    else:
        smooth = _polygon_stress(x, slope, even, r)
    return ((smooth + _jump_stress(x, jump, r)) / np.pi)[()]


def _polygon_stress(x, slope, even, r):
    """∫ q′/√(x² − r²) dx for constant slopes; where even, for a parabola on the first panel."""
    curvature = 0.0
    if even:
        curvature, slope[0] = 2 * slope[0] / x[1], 0.0
    # The kernel integrated once, arcosh(x/r), stands at each node times the change of slope.
    change = -np.diff(slope, prepend=0.0, append=0.0)
    stress = superpose_kernel(arcosh, x, change, r)
    # On the axis the logarithms of r cancel, unless q has a tip there.
    tip = slope[0] if x[0] == 0 and len(slope) else 0.0
    behind = x > 0
    at_axis = np.sum((change * np.log(x / x[-1], where=behind, out=np.zeros_like(x)))[behind])
    stress = np.where(r == 0, at_axis + (np.copysign(np.inf, tip) if tip else 0.0), stress)
    if even:
        stress = stress + curvature * np.sqrt(np.maximum(x[1] - r, 0.0) * (x[1] + r))
    return stress


def _jump_stress(x, jump, r):
    """Σ jump/√(x² − r²)."""
    behind = x > 0
    return np.where(r == 0, np.sum(jump[behind] / x[behind]), superpose_kernel(punch, x, jump, r))


def line_load_from_stress(r, stress, x):
    """Line load q(x) from samples of the normal stress σ_zz(r), the inverse of Popov (2015), Eq. (10).

    q = −2 ∫ r σ_zz/√(r² − x²) dr over r > x, exactly for the stress that is linear between the
    samples, constant before the first and 0 beyond the last one; a node given twice is a jump.

    Parameters
    ----------
    r : array_like, shape (N,)
        Radii (m), not negative, in ascending order.
    stress : array_like, shape (N,)
        σ_zz (Pa) at `r`, negative in compression.
    x : float or array_like
        Coordinates (m).

    Returns
    -------
    float or ndarray
        q (N/m), positive in compression, of the shape of `x`.

    Examples
    --------
    A uniform pressure 1 inside r = 1 has q = 2√(1 − x²):

    >>> print(round(line_load_from_stress([0, 1], [-1, -1], 0.6), 12))
    1.6
    """
    r, stress = _samples(r, stress, "stress", "Pa")
    x = _places("coordinate x", np.abs(_check.finite_array("coordinate x", x, unit="m")))
    slope, jump = _slopes(r, stress)
    change = -np.diff(slope, prepend=0.0, append=0.0)
    at_tip = np.sum(change * r**2) / 2 + np.sum(jump * r)
    moment = superpose_kernel(segment, r, change, x) + superpose_kernel(chord, r, jump, x)
    return (2 * np.where(x == 0, at_tip, moment))[()]


def _samples(x, values, quantity, unit):
    x = _check.finite_array("coordinate", x, unit="m")
    values = _check.finite_array(quantity, values, unit=unit, most=_check.LARGEST)
    if x.ndim != 1 or x.shape != values.shape or not x.size:
        raise ValueError(
            f"{quantity} of shape {values.shape} needs as many coordinates, got shape {x.shape}"
        )
    _check.refuse("coordinate", x, x < 0, "is negative", unit="m", remedy="give x ≥ 0; the load is even")
    back = np.append(False, np.diff(_places("coordinate", x)) < 0)
    _check.refuse("coordinate", x, back, "comes after a larger one", unit="m", remedy="sort the samples")
    return x, values


def _places(quantity, x):
    """Coordinates or radii (m) of which squares and quotients are double."""
    outside = (x > 0) & (x < _check.SMALLEST) | (x > _check.LARGEST)
    bound = f"must be 0 or lie between {_check.SMALLEST:g} and {_check.LARGEST:g}"
    return _check.refuse(quantity, x, outside, bound, unit="m", remedy="give it in SI units")


def _slopes(x, values):
    """Slope of each panel, and jump at each place: between equal nodes, and to 0 at the last."""
    step, rise = np.diff(x), np.diff(values)
    slope = np.divide(rise, step, out=np.zeros_like(step), where=step > 0)
    jump = np.append(np.where(step == 0, rise, 0.0), -values[-1])
    # Jumps of both signs at one place are one: apart they would be infinite there, and their sum NaN.
    first = np.flatnonzero(np.append(True, step > 0))
    merged = np.zeros_like(jump)
    merged[np.append(first[1:] - 1, len(x) - 1)] = np.add.reduceat(jump, first)
    return slope, merged


def _is_even(x, slope, jump, axis):
    """Whether the first panel, from the axis, is taken as an even parabola."""
    if axis == "straight" or len(x) < 2 or x[0] > 0 or x[1] == 0:
        return False
    if axis == "even":
        return True
    if len(x) < 3 or jump[1] or x[2] == x[1]:
        return False
    # Slopes of an even parabola grow as x1 to x1 + x2.
    return abs(slope[0] * (x[1] + x[2]) - slope[1] * x[1]) <= 0.05 * abs(slope[1]) * x[1]
