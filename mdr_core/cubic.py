"""Normal stress under a line load that is a cubic spline between its samples.

The integral of q′(x)/√(x² − r²) over a panel, q′ being a parabola there, is taken in closed form
near the radius r, by Gauss nodes and the sums of `treecode` farther away.
"""

import numpy as np
from scipy.interpolate import CubicSpline

from .kernels import punch, root
from .treecode import superpose_kernel

# Five Gauss nodes integrate 1/√(x² − r²) over a panel that is four of its widths away from r with an
# error of (9 + √(9² − 1))^(−10) = 3e-13 of the panel's own share.
_REACH = 4.0
_NODE, _WEIGHT = np.polynomial.legendre.leggauss(5)
# The kernel of the sums is so cheap that larger blocks need not be divided.
_LEAF = 160
_PAIRS = 1 << 16
# Odd powers of 2δ ≤ 1 in sinh δ − δ cosh δ, δ − sinh(2δ)/2 and δ + δ cosh 2δ − sinh 2δ, which cancel.
_POWERS = np.arange(9, 0, -1)
_ODD = 1 / np.cumprod(np.arange(1.0, 20.0))[2 * _POWERS]
_FIRST, _SECOND, _THIRD = (
    -2 * _POWERS * _ODD / 2.0 ** (2 * _POWERS + 1),
    -_ODD / 2,
    (2 * _POWERS - 1) * _ODD / 2,
)


def slopes(x, q, even):
    """Slope of the load on each panel as p₀ + p₁ t + p₂ t², t from the panel's beginning.

    A not-a-knot cubic spline on each stretch between nodes that are given twice; with fewer than
    four nodes the parabola or the straight line through them.

    Parameters
    ----------
    x, q : ndarray, shape (N,)
        Nodes in ascending order, and the load there.
    even : bool
        Whether the slope vanishes at the first node.

    Returns
    -------
    ndarray, shape (3, N − 1)
        p₀, p₁, p₂; zero on panels of no width.
    """
    result = np.zeros((3, len(x) - 1))
    breaks = np.flatnonzero(np.diff(x) == 0)
    for first, last in zip(np.append(0, breaks + 1), np.append(breaks, len(x) - 1), strict=True):
        if last > first:
            begin = (1, 0.0) if even and first == 0 else "not-a-knot"
            stretch = slice(first, last + 1)
            result[:, first:last] = _slopes_of_stretch(x[stretch], q[stretch], begin)
    return result


def _slopes_of_stretch(x, q, begin):
    """p₀, p₁, p₂ on the panels of one spline."""
    if len(x) == 3 and begin == "not-a-knot":
        # One parabola, whatever the spacing: SciPy solves for it by a matrix of both spacings.
        step = np.diff(x)
        mean = np.diff(q) / step
        bend = (mean[1] - mean[0]) / (x[2] - x[0])
        return np.array([mean - bend * step, [2 * bend, 2 * bend], [0.0, 0.0]])
    spline = CubicSpline(x, q, bc_type=(begin, "not-a-knot"))
    return spline.c[2::-1] * np.array([[1.0], [2.0], [3.0]])


def stress(x, slope, r):
    """∫ q′(x)/√(x² − r²) dx over x > r for the slopes that `slopes` gives.

    Parameters
    ----------
    x : ndarray, shape (N,)
        Nodes in ascending order.
    slope : ndarray, shape (3, N − 1)
        Coefficients of q′.
    r : ndarray
        Radii, not negative.

    Returns
    -------
    ndarray
        Of the shape of `r`; on the axis infinite where q′ does not vanish there.
    """
    wide = np.flatnonzero(np.diff(x) > 0)
    begin, end, slope = x[wide], x[wide + 1], slope[:, wide]
    flat = r.ravel()
    order = np.argsort(flat, kind="stable")
    ascending = flat[order]
    total = np.zeros_like(flat)
    # The sums leave out the axis, which is near all panels.
    until = begin - _REACH * (end - begin)
    total[order] = _near(begin, end, slope, until, ascending) + _far(begin, end, slope, until, ascending)
    return total.reshape(r.shape)


def _far(begin, end, slope, until, r):
    """What panels give to the radii up to `until`, except for the axis."""
    t = (end - begin)[:, None] * (1 + _NODE) / 2
    weight = (end - begin)[:, None] * _WEIGHT / 2 * _parabola(slope[:, :, None], t)
    nodes = begin[:, None] + t
    until = np.repeat(until, _NODE.size)
    return superpose_kernel(punch, nodes.ravel(), weight.ravel(), r, until, _LEAF)


def _near(begin, end, slope, until, r):
    """What panels give to the ascending radii between `until` and their end, and to the axis."""
    total = np.zeros_like(r)
    axis = np.searchsorted(r, 0.0, side="right")
    if axis:
        total[:axis] = np.sum(_panel(begin, end, slope, 0.0))
    first = np.maximum(np.searchsorted(r, until, side="right"), axis)
    count = np.maximum(np.searchsorted(r, end, side="left") - first, 0)
    ends = np.cumsum(count)
    low = 0
    while low < len(count):
        # As many panels at a time as make few enough pairs, at least one.
        high = max(low + 1, int(np.searchsorted(ends, ends[low] - count[low] + _PAIRS, side="right")))
        panel = np.repeat(np.arange(low, high), count[low:high])
        start = first[low:high] - (ends - count)[low:high]
        target = np.arange(panel.size) + ends[low] - count[low] + np.repeat(start, count[low:high])
        share = _panel(begin[panel], end[panel], slope[:, panel], r[target])
        total += np.bincount(target, share, minlength=r.size)
        low = high
    return total


def _panel(begin, end, slope, r):
    """∫ q′(x)/√(x² − r²) dx over the part of a panel beyond r, elementwise.

    With x = r cosh w, w = w̄ ± δ at the ends, X = r cosh w̄ and the middle m = X cosh δ,

        ∫ dx/√ = 2δ,  ∫ (x − m) dx/√ = 2X (sinh δ − δ cosh δ),
        ∫ (x − m)² dx/√ = r² (δ − sinh(2δ)/2) + X² (δ + δ cosh 2δ − sinh 2δ),

    the brackets as series of positive terms for δ ≤ 1/2. For larger δ the panel is no shorter than
    a third of x, and moments of x itself do.
    """
    low = np.maximum(begin, r)
    root_low, root_end = root(low, r), root(end, r)
    both = root_low + root_end
    with np.errstate(divide="ignore", invalid="ignore"):
        rise = (end - low) * (1 + (end + low) / both)
        width = np.log1p(rise / (low + root_low))
    result = _by_series(begin, low, end, slope, r, width / 2)
    wide = np.flatnonzero(width > 1)
    if wide.size:
        parts = (np.broadcast_to(part, width.shape)[wide] for part in (begin, low, end, r, width))
        result[wide] = _by_moments(*parts, slope[:, wide])
    return result


def _by_series(begin, low, end, slope, r, delta):
    delta = np.minimum(delta, 0.5)
    middle = (low + end) / 2
    t = middle - begin
    X = middle / np.cosh(delta)
    square = 4 * delta * delta
    first, second, third = np.zeros((3, *np.shape(delta)))
    for a, b, c in zip(_FIRST, _SECOND, _THIRD, strict=True):
        first, second, third = first * square + a, second * square + b, third * square + c
    cube = 2 * delta * square
    mean = 2 * delta * _parabola(slope, t) + cube * 2 * X * first * (slope[1] + 2 * slope[2] * t)
    return mean + slope[2] * cube * (r * r * second + X * X * third)


def _by_moments(begin, low, end, r, width, slope):
    # From powers of x − begin to powers of x.
    p0, p1, p2 = slope
    at_axis = p0 - begin * (p1 - begin * p2)
    root_low, root_end = root(low, r), root(end, r)
    with np.errstate(invalid="ignore"):
        logarithm = np.where(at_axis == 0, 0.0, at_axis * width)
        square = np.where(r > 0, r * r * width, 0.0)
    first = root_end - root_low
    return logarithm + (p1 - 2 * begin * p2) * first + p2 / 2 * (end * root_end - low * root_low + square)


def _parabola(slope, t):
    return slope[0] + t * (slope[1] + t * slope[2])
