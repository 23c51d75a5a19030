"""Integral transforms between 3D and 1D: Popov (2015), Eqs. (3) and (10), and their inverses.

Pure mathematics, for callables (`reduce_slope`, `height_from_reduced`) and for samples
(`stress_from_line_load`, `line_load_from_stress`).
"""

from collections.abc import Callable

import numpy as np
import scipy

from . import _check
from ._check import Array, ArrayLike
from ._numeric import chunks, gauss_legendre, root, tanh_sinh

# Steps of the rule tried in turn, and how closely two of them must agree: the error of the finer one is
# the square of that of the coarser.
_STEPS = (1 / 14, 1 / 28, 1 / 56, 1 / 112)
_AGREE = 1e-9


def reduce_slope(slope: Callable[[Array], Array], x: ArrayLike) -> Array:
    """Reduced height g(x) of the shape with slope dz/dr, Popov (2015), Eq. (3).

    g(x) = x ∫ z′(x sin t) dt over 0 < t < π/2, by a rule whose nodes crowd at both ends, with as many
    as it takes: spectral accuracy for a smooth slope, and for any power of r next to the tip.

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
        If the slope is not finite somewhere on [0, |x|], or too rough for 760 nodes.

    Examples
    --------
    >>> print(round(reduce_slope(lambda r: 2 * r, 3.0), 12))  # z = r² has g = 2x²
    18.0
    """
    x = np.abs(_check.finite_array("coordinate x", x, unit="m"))
    return (x * _mean_over_quarter(slope, x, "slope dz/dr"))[()]


def height_from_slope(slope, r):
    """Height z(r) = r ∫ z′(r sin t) cos t dt (m) of the shape with slope dz/dr, as in `reduce_slope`."""
    return (r * _mean_over_quarter(slope, r, "slope dz/dr", np.cos))[()]


def kappa(n: ArrayLike) -> Array:
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
    ratio = np.sqrt(np.pi) * scipy.special.gamma(few / 2 + 1) / scipy.special.gamma((few + 1) / 2)
    # Γ(m + 1/2)/Γ(m) for large m, where the gamma functions overflow.
    m = (np.maximum(n, 300.0) + 1) / 2
    series = np.polyval([869 / 4194304, -399 / 262144, -21 / 32768, 5 / 1024, 1 / 128, -1 / 8, 1], 1 / m)
    return np.where(n < 300, ratio, np.sqrt(np.pi * m) * series)[()]


def height_from_reduced(reduced: Callable[[Array], Array], r: ArrayLike) -> Array:
    """Height z(r) (m) of the shape whose reduced height is g(x), the inverse of Popov (2015), Eq. (3).

    z(r) = (2/π) ∫ g(r sin t) dt over 0 < t < π/2, for radii r (m) of any shape, and g (m) as a vectorised
    function of x ≥ 0 (m), smooth; by the rule of `reduce_slope`, and with its refusals.

    Examples
    --------
    >>> print(round(height_from_reduced(lambda x: 2 * x**2, 3.0), 12))
    9.0
    """
    r = np.abs(_check.finite_array("radius r", r, unit="m"))
    return (2 / np.pi * _mean_over_quarter(reduced, r, "reduced height g"))[()]


def _mean_over_quarter(function, x, quantity, times=None):
    """∫ function(x sin t) times(t) dt over 0 < t < π/2, for an array of x."""
    last = None
    for step in _STEPS:
        node, weight = tanh_sinh(step)
        angle = np.pi / 2 * node
        points = x[..., None] * np.sin(angle)
        with np.errstate(all="ignore"):
            values = np.broadcast_to(np.asarray(function(points), dtype=float), points.shape)
        bad = ~np.isfinite(values)
        if bad.any():
            raise ValueError(
                f"{quantity} is {values[bad][0]:g} at {points[bad][0]:g} m and must be finite up to "
                f"{x.max():g} m; stay below, or give a function that is finite there"
            )
        weight = np.pi / 2 * weight * (1.0 if times is None else times(angle))
        new, size = values @ weight, np.abs(values) @ weight
        if last is not None and np.all(np.abs(new - last) <= _AGREE * size):
            return new
        last = new
    raise ValueError(
        f"{quantity} is too rough: {node.size} nodes do not settle up to {x.max():g} m; "
        "give its kinks as samples (Sampled), or smooth it"
    )


def stress_from_line_load(
    x: ArrayLike, q: ArrayLike, r: ArrayLike, axis: str = "auto", interpolation: str = "linear"
) -> Array:
    """Normal stress σ_zz(r) from samples of the line load q(x), Popov (2015), Eq. (10).

    σ_zz = (1/π) ∫ q′(x)/√(x² − r²) dx over x > r, exactly for the q that is linear between the
    samples, or the cubic spline through them, constant before the first and 0 beyond the last one.
    A node given twice is a jump; so is a last q that is not 0.

    Parameters
    ----------
    x, q : array_like, shape (N,)
        Coordinates (m), not negative, in ascending order, and line load (N/m), positive in compression.
    r : array_like
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
    The cost grows as N M for M radii, the memory not at all.

    Examples
    --------
    Hertz, q = 1 − x² and p = (2/π) √(1 − r²), which a cubic gives without error:

    >>> x = np.linspace(0, 1, 5)
    >>> print(round(stress_from_line_load(x, 1 - x**2, 0.6, interpolation="cubic"), 12))
    -0.509295817894
    """
    x, q = _samples(x, q, "line load q", "N/m")
    r = _places("radius r", np.abs(_check.finite_array("radius r", r, unit="m")))
    _check.one_of("axis", axis, ("auto", "straight", "even"))
    _check.one_of("interpolation", interpolation, ("linear", "cubic"))
    if x[-1] == 0:
        # All of the load stands on the axis, where it has no width.
        return np.zeros_like(r)[()]
    slope, jump = _slopes(x, q)
    even = _is_even(x, slope, jump, axis)
    cubic = interpolation == "cubic"
    stress = _spline_stress(x, q, even, r) if cubic else _polygon_stress(x, slope, even, r)
    behind = x > 0
    jumps = _superpose(lambda x, r: 1 / root(x, r), x, jump, r)
    jumps = np.where(r == 0, np.sum(jump[behind] / x[behind]), jumps)
    return ((stress + jumps) / np.pi)[()]


def _polygon_stress(x, slope, even, r):
    """∫ q′/√(x² − r²) dx for constant slopes; where even, for a parabola on the first panel."""
    curvature = 0.0
    if even:
        curvature, slope[0] = 2 * slope[0] / x[1], 0.0
    # The kernel integrated once, arcosh(x/r), stands at each node times the change of slope.
    change = -np.diff(slope, prepend=0.0, append=0.0)
    stress = _superpose(_arcosh, x, change, r)
    # On the axis the logarithms of r cancel, unless q has a tip there.
    tip = slope[0] if x[0] == 0 and len(slope) else 0.0
    behind = x > 0
    at_axis = np.sum((change * np.log(x / x[-1], where=behind, out=np.zeros_like(x)))[behind])
    stress = np.where(r == 0, at_axis + (np.copysign(np.inf, tip) if tip else 0.0), stress)
    return stress + curvature * root(x[1], r) if even else stress


def _spline_stress(x, q, even, r):
    """∫ q′/√(x² − r²) dx for a cubic spline on each stretch between nodes that are given twice."""
    breaks, unit = np.flatnonzero(np.diff(x) == 0), x[-1]
    x, r, total = x / unit, r / unit, np.zeros_like(r)
    for first, last in zip(np.append(0, breaks + 1), np.append(breaks, len(x) - 1), strict=True):
        if last > first:
            ends = (1, 0.0) if even and first == 0 else "not-a-knot", "not-a-knot"
            stretch = slice(first, last + 1)
            slope = scipy.interpolate.CubicSpline(x[stretch], q[stretch], bc_type=ends).derivative()
            total = total + _parabolas_stress(slope.x, slope.c[::-1], r)
    return total / unit


def _parabolas_stress(x, c, r):
    """∫ (c₀ + c₁ t + c₂ t²)/√(x² − r²) dx over panels between `x`, t from the beginning of each, x > r."""
    low, high = x[:-1], x[1:]
    # Next to the axis by moments, which cancel farther out; there by nodes in w = √(x² − r²), in which
    # nothing is singular.
    inner = low < 4 * (high - low)
    flat, total = r.ravel(), np.zeros(r.size)
    node, weight = gauss_legendre(8)
    for rows in chunks(flat.size, max(1, 2**17 // low.size)):
        at = flat[rows, None]
        total[rows] += _moments(low[inner], high[inner], c[:, inner], at).sum(axis=1)
        begin, end = root(low[~inner], at)[..., None], root(high[~inner], at)[..., None]
        w = begin + (end - begin) * node
        place = np.hypot(at[..., None], w)
        t = np.maximum(place - low[~inner, None], 0.0)
        c0, c1, c2 = c[:, ~inner, None]
        value = np.divide(c0 + t * (c1 + t * c2), place, out=np.zeros_like(place), where=place > 0)
        total[rows] += np.einsum("ijk,ijk->i", value, weight * (end - begin))
    return total.reshape(r.shape)


def _moments(low, high, c, r):
    """∫ of each parabola over the part of its panel beyond r, from ∫ xⁿ dx/√(x² − r²)."""
    c0, c1, c2 = c
    # From powers of x − low to powers of x.
    p0, p1 = c0 - low * (c1 - low * c2), c1 - 2 * low * c2
    first, second = root(low, r), root(high, r)
    with np.errstate(divide="ignore", invalid="ignore"):
        width = np.where(high > r, np.log((high + second) / (np.maximum(low, r) + first)), 0.0)
        logarithm = np.where(p0 == 0, 0.0, p0 * width)
        square = np.where(r > 0, r * r * width, 0.0)
    return logarithm + p1 * (second - first) + c2 / 2 * (high * second - low * first + square)


def line_load_from_stress(r: ArrayLike, stress: ArrayLike, x: ArrayLike) -> Array:
    """Line load q(x) from samples of the normal stress σ_zz(r), the inverse of Popov (2015), Eq. (10).

    q = −2 ∫ r σ_zz/√(r² − x²) dr over r > x, exactly for the stress that is linear between the
    samples, constant before the first and 0 beyond the last one; a node given twice is a jump.

    Parameters
    ----------
    r, stress : array_like, shape (N,)
        Radii (m), not negative, in ascending order, and σ_zz (Pa), negative in compression.
    x : array_like
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
    moment = _superpose(_segment, r, change, x) + _superpose(root, r, jump, x)
    return (2 * np.where(x == 0, at_tip, moment))[()]


def _superpose(kernel, x, weight, r):
    """Σ weight_j kernel(x_j, r) over all x_j > r, and x_j = r where it is infinite; 0 for r = 0."""
    used = weight != 0
    x, weight, flat = x[used], weight[used], r.ravel()
    total = np.zeros(r.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        for rows in chunks(flat.size, max(1, 2**20 // max(x.size, 1))):
            at = flat[rows, None]
            terms = np.where((x >= at) & (at > 0), kernel(np.maximum(x, at), at) * weight, 0.0)
            total[rows] = terms.sum(axis=1)
    return total.reshape(r.shape)


def _arcosh(x, r):
    """∫ dx/√(x² − r²) from r."""
    return np.log1p((x - r + root(x, r)) / r)


def _segment(r, x):
    """∫ √(r² − x²) dr from x."""
    return (r * root(r, x) - x * x * _arcosh(r, x)) / 2


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
