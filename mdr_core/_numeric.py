"""Quadrature, collocation, roots of arrays, and functions that avoid cancellation."""

from functools import lru_cache

import numpy as np

from . import _check


@lru_cache
def gauss_legendre(count):
    """Nodes and weights on [0, 1]."""
    node, weight = np.polynomial.legendre.leggauss(count)
    return (1 + node) / 2, weight / 2


def gauss_integrals(count, places):
    """Matrix from values at Gauss–Legendre nodes on [0, 1] to integrals of their polynomial from 0.

    One row for each upper limit in `places`.
    """
    values = np.polynomial.legendre.legvander(2 * places - 1, count)
    # ∫ P_k from 0 is (P_{k+1} − P_{k−1})/(2(2k + 1)), for k = 0 the upper limit itself.
    rise = np.column_stack([places, (values[:, 2:] - values[:, :-2]) / (4 * np.arange(1, count) + 2)])
    return rise @ _to_legendre(count)


@lru_cache
def _to_legendre(count):
    """Matrix from values at Gauss–Legendre nodes to coefficients of Legendre polynomials."""
    node, weight = gauss_legendre(count)
    polynomials = np.polynomial.legendre.legvander(2 * node - 1, count - 1)
    return (2 * np.arange(count)[:, None] + 1) * (polynomials * weight[:, None]).T


def collocate(derivative, first, length):
    """Solutions of u′ = f(u) over intervals as polynomials through 24 Gauss nodes, one interval a row.

    `derivative` gives f and ∂f/∂u for values of u at the nodes; `first` and `length`, of shape (N, 1), are
    u at the start and the length of each interval. Returns u at the nodes, of shape (N, 24) and of one sign
    in each interval, and whether Newton's method has converged.
    """
    integrate, one, _ = _collocation()
    u, settled = np.repeat(first, len(one), axis=1), np.zeros(len(first), bool)
    for _ in range(8):
        value, rate = derivative(u)
        residual, rate = u - first - length * (value @ integrate.T), length * rate
        # The linear equation δ − ∫ f′δ = r has the solution δ = r + E ∫ f′r/E with E = exp ∫ f′. Up to
        # E = e^20 its polynomial is accurate to 10⁻¹⁰, so that Newton's method converges as fast.
        exponent = rate @ integrate.T
        factor = np.exp(exponent)
        change = residual + factor * ((rate * residual / factor) @ integrate.T)
        steep = np.flatnonzero(~(np.abs(exponent).max(axis=1) < 20.0))
        if steep.size:
            matrix = one - rate[steep, None, :] * integrate
            matrix[~np.isfinite(matrix).all(axis=(1, 2))] = one
            change[steep] = np.linalg.solve(matrix, residual[steep, :, None])[..., 0]
        u = np.where(change / u < 0.75, u - change, u / 4)
        settled = np.all(np.abs(change) <= 1e-9 * np.abs(u), axis=1)
        if settled.all():
            break
    return u, settled


@lru_cache
def _collocation():
    node, weight = gauss_legendre(24)
    last = np.polynomial.legendre.legvander(2 * node - 1, 23)[:, -3:] * weight[:, None]
    return gauss_integrals(24, node), np.eye(24), last * (2 * np.arange(21, 24) + 1)


def last_coefficient(values):
    """Largest of the last three Legendre coefficients of polynomials through 24 Gauss nodes."""
    return np.abs(values @ _collocation()[2]).max(axis=-1)


def largest_value(function, low, high):
    """Largest value of a function with one maximum between `low` and `high` (N, 1), one a row.

    `function` takes arguments of shape (N, K). Two grids, and the parabola through the best three points.
    """
    rows = np.arange(len(low))
    for _ in range(2):
        places = low + (high - low) * np.linspace(0, 1, 17)
        values = function(places)
        best = np.clip(values.argmax(axis=1), 1, 15)
        low, high = places[rows, best - 1, None], places[rows, best + 1, None]
    before, there, after = (values[rows, best + side] for side in (-1, 0, 1))
    bend = 2 * there - before - after
    top = there + (after - before) ** 2 / (8 * np.maximum(bend, 1e-300))
    return np.where(np.abs(after - before) < 2 * bend, top, values.max(axis=1))


def cube_rise(begin, step):
    """(b + δ)³ − b³ without cancellation."""
    return step * (3 * begin * begin + step * (3 * begin + step))


def cube_way(begin, rise):
    """δ at (b + δ)³ − b³ = `rise`, the inverse of `cube_rise`."""
    end = np.cbrt(begin**3 + rise)
    squares = begin * begin + begin * end + end * end
    step = np.divide(rise, squares, out=np.zeros_like(rise), where=rise > 0)
    return np.where(rise < np.inf, step, np.inf)


@lru_cache
def tanh_sinh(step=1 / 28):
    """Nodes and weights on [0, 1] for functions that behave as any power at both ends.

    u = 1/(1 + e^(−2s)), s = (π/2) sinh t. The first node is 10⁻³⁹, so that a singularity just outside the
    interval is resolved, too.
    """
    t = step * np.arange(-round(3.4 / step), round(3.4 / step) + 1)
    s = np.pi / 2 * np.sinh(t)
    node = 1 / (1 + np.exp(-2 * s))
    weight = np.pi / 2 * np.cosh(t) / (2 * np.cosh(s) ** 2) * step
    return node, weight / weight.sum()


@lru_cache
def crowded():
    """Nodes and weights on [0, 1] for a function that is singular at 0, or just outside.

    Nodes e^(−y) at even steps of t. As y grows as t, a singularity at a distance δ outside the interval
    stays π/2 away from all t for any δ down to 10⁻¹³: the error is e^(−π²/0.4). At both ends y grows
    exponentially, so that the sum may be truncated.

    Returns
    -------
    node, gap, weight : ndarray
        With `gap` = 1 − `node`, free of rounding.
    """
    last = 33.0
    t = np.arange(-3.2, last, 0.4)
    rise = 1 / (1 + np.exp(np.exp(-t) - t))
    y = np.logaddexp(0.0, t - np.exp(-t)) + np.exp(t - last + 6)
    weight = np.exp(-y) * (rise * (1 + np.exp(-t)) + np.exp(t - last + 6))
    return np.exp(-y), -np.expm1(-y), weight / weight.sum()


def root(x, r):
    """√(x² − r²) of two lengths without cancellation or underflow, 0 for x < r."""
    return np.sqrt(np.maximum(x - r, 0.0)) * np.sqrt(x + r)


def log1p_ratio(above, below):
    """ln(1 + above/below), also where the quotient leaves double precision; infinite over 0."""
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        ratio = above / below
        return np.where(ratio < np.inf, np.log1p(ratio), np.log(above) - np.log(below))


#: Rows of a block where each block takes about a thousand calls of NumPy.
LONG = 2**14


def chunks(size, most=8192):
    """Slices of at most `most` rows, so that the arrays of a block fit into the cache."""
    return (slice(start, start + most) for start in range(0, size, most))


def broadcast_flat(*arrays):
    """Shape to which arrays broadcast, and flat views of them that can be sliced."""
    arrays = np.broadcast_arrays(*arrays)
    return arrays[0].shape, [part.ravel() if part.flags.c_contiguous else part.flat for part in arrays]


@np.errstate(all="ignore")
def increasing_root(function, target, start, highest=np.inf, *, largest=_check.LARGEST, quantity="depth"):
    """Positive x with function(x) = target, elementwise, for a function that grows about as a power.

    Newton's method on ln f against ln x inside a bracket, with bisection where a step leaves it and, after
    a dozen steps, at every other one: Newton's method alone may alternate between both sides of a kink.

    Parameters
    ----------
    function : callable
        Values and derivatives at an array x > 0, up to `highest`.
    target, start : array_like
        Values to be reached, and first guesses of x.
    highest : float or ndarray
        Largest x at which the function is known; the result is infinite where the target is not reached.
    largest : float
        The result is infinite where it would be larger.
    quantity : str
        Name of x, for the error that is raised if the iteration does not converge.
    """
    target = np.asarray(target, dtype=float)
    x = np.zeros(target.shape) + np.minimum(start, highest)
    low, high = np.zeros_like(x), np.zeros_like(x) + highest
    reachable = high == np.inf
    if not reachable.all():
        reachable |= target <= function(np.where(reachable, x, high))[0]
    sought = (target > 0) & reachable
    eps = np.finfo(float).eps
    best, least, stalled = x.copy(), np.full(x.shape, np.inf), np.zeros(x.shape, int)
    for iteration in range(200):
        value, slope = function(x)
        high, low = np.where(value >= target, x, high), np.where(value <= target, x, low)
        miss = np.log(target / value)
        stalled = np.where(np.abs(miss) < least, 0, stalled + 1)
        best, least = np.where(stalled == 0, x, best), np.fmin(np.abs(miss), least)
        # The slope is infinite at the edge of a flat face and at some kinks, and a step there is 0.
        new = x * np.exp(np.clip(np.where(slope < np.inf, miss * value / (slope * x), np.nan), -3, 3))
        middle = np.where(low > 0, np.sqrt(low) * np.sqrt(high), high / 16)
        middle = np.where(high < np.inf, middle, 16 * x)
        inside = (new > low) & (new < high) & (iteration < 12 or iteration % 2 == 0)
        new = np.where(inside, new, middle)
        # Rounding of f ends the iteration where no step comes closer any more.
        settled = (np.abs(new - x) <= 4 * eps * x) | (high - low <= 4 * eps * low) | (least <= 8 * eps)
        settled |= (stalled > 0) & (least <= 1e-14) | (stalled > 1) & (least <= 1e-13)
        reachable &= low < largest
        if np.all(settled | ~sought | ~reachable):
            return np.where(reachable, np.where(target > 0, best, 0.0), np.inf)
        x = np.where(sought, new, x)
    raise ValueError(f"no {quantity} was found in 200 steps; check that all quantities are in SI units")


def root_in_bracket(function, x, low, high, close):
    """Result at the root of an increasing function, by Newton's method from x inside a bracket.

    `function` gives its value, its slope and a result at x; the root is found to within `close`.
    """
    for count in range(80):
        value, slope, result = function(x)
        miss = value / slope
        if abs(miss) <= close or high - low <= close:
            break
        low, high = (x, high) if miss < 0 else (low, x)
        x -= miss
        # Bisection at every other step, where the function has a kink or jumps.
        if not low < x < high or (count > 5 and count % 2 and high - low < np.inf):
            x = (low + high) / 2
    return result
