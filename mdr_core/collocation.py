"""Steps of Gauss collocation: integrals from the beginning of a step to each of its points.

A step runs over θ from 0 to 1; its points are 0 and 24 Gauss nodes, and 0 has no weight. Elapsed
time is θ, or θ³ where fractional powers of the time begin, or 1 − (1 − θ)³ where they end: these
three kinds of step are the rows of the tables here. Values of many steps are one row each; what is
done to them is done row by row, so that no step feels its neighbours.
"""

import numpy as np

from .panels import integration_rule

_NODES, _WEIGHTS, _TAIL = integration_rule(24)

PLAIN, OPENING, CLOSING = range(3)

POINTS = np.append(0.0, _NODES)
COUNT = POINTS.size

_RATE = np.stack([np.ones(COUNT), 3 * POINTS**2, 3 * (1 - POINTS) ** 2])


def _bordered(table):
    """A table for the nodes with zeros for the point 0."""
    return np.pad(table, [(0, 0)] * (table.ndim - 2) + [(1, 0), (1, 0)])


#: Share of the step's time at each point, (kind, point).
ELAPSED = np.stack([POINTS, POINTS**3, POINTS * (3 - POINTS * (3 - POINTS))])
#: Weights of the integral over the time of a whole step, (kind, point).
WHOLE = _RATE * np.append(0.0, _WEIGHTS)
#: Matrix of the integrals over time from the beginning to each point, (kind, point, point).
INTEGRATE = _bordered(_WEIGHTS - _TAIL) * _RATE[:, None, :]
#: The same applied twice, for the path from the acceleration.
TWICE = INTEGRATE @ INTEGRATE
IDENTITY = np.eye(COUNT)


def _interpolation(points):
    """Barycentric weights of interpolation points, and the matrix that differentiates at them."""
    difference = points[:, None] - points
    np.fill_diagonal(difference, 1.0)
    weight = 1 / difference.prod(axis=1)
    derivative = weight / weight[:, None] / difference
    np.fill_diagonal(derivative, 0.0)
    np.fill_diagonal(derivative, -derivative.sum(axis=1))
    return weight, derivative


_WEIGHT, _DERIVATIVE = _interpolation(POINTS)

#: Matrix that differentiates by the share of time elapsed, from and at the nodes, (kind, point, point).
DIFFERENTIATE = _bordered(_interpolation(_NODES)[1]) / np.where(_RATE > 0, _RATE, 1.0)[:, :, None]


def _last_coefficients():
    values = np.polynomial.legendre.legvander(2 * _NODES - 1, _NODES.size - 1)
    projection = (values * _WEIGHTS[:, None]).T * (2 * np.arange(_NODES.size)[:, None] + 1)
    return np.pad(projection[-3:], [(0, 0), (1, 0)])


_LAST = _last_coefficients() * _RATE[:, None, :]


def apply(matrices, values):
    """Matrices, one or one for each row, applied to rows of values."""
    return np.matmul(matrices, values[..., None])[..., 0]


def unresolved(values, kind):
    """Size of the last Legendre coefficients of values times dt/dθ, one step a row."""
    return np.maximum.reduce(np.abs(apply(_LAST[kind], values)), axis=1)


def share(kind, theta):
    """Share of a step's time elapsed at θ."""
    return np.choose(kind, [theta, theta**3, theta * (3 - theta * (3 - theta))])


def theta_at(kind, elapsed):
    """θ at a share of a step's time: inverse of `share`."""
    elapsed = np.clip(elapsed, 0.0, 1.0)
    return np.choose(kind, [elapsed, np.cbrt(elapsed), 1 - np.cbrt(1 - elapsed)])


def basis(theta):
    """Weights that interpolate values at the points to θ, one row each."""
    gap = theta[:, None] - POINTS
    # On a point its own weight outgrows the others.
    gap[gap == 0] = 1e-200
    row = _WEIGHT / gap
    return row / np.add.reduce(row, axis=1, keepdims=True)


def weights(kind, theta):
    """Weights of the integral over the share of time up to θ, one step a row."""
    # At the end the quadrature is better than the interpolant.
    result = WHOLE[kind]
    cut = np.flatnonzero(theta < 1)
    if cut.size:
        result[cut] = np.matmul(basis(theta[cut])[:, None, :], INTEGRATE[kind[cut]])[:, 0]
    return result


def dot(weights, values):
    """Sums of weighted values, one row each: an interpolation or an integral."""
    return np.matmul(weights[:, None, :], values[:, :, None])[:, 0, 0]


_EDGES = np.append(POINTS, 1.0)


def crossing(values, target, end=None):
    """First θ at which the interpolant of values at the points crosses a target, one step a row.

    The first value is on one side of the target, and some other one up to θ = `end` (1 if not
    given), or the interpolant there, on the other.
    """
    gap = values - target[:, None]
    end = np.ones(len(gap)) if end is None else end
    edges = np.minimum(_EDGES, end[:, None])
    known = np.empty(edges.shape)
    known[:, :-1] = gap
    there = dot(basis(end), gap)[:, None]
    known = np.where(end[:, None] > _EDGES, known, there)
    side = np.sign(known[:, :1])
    crossed = side * known <= 0
    # None has, by rounding: the end itself.
    crossed[:, -1] = True
    index, rows = crossed.argmax(axis=1), np.arange(len(gap))
    before = np.maximum(index - 1, 0)
    low, high = edges[rows, before], edges[rows, index]
    first, last = known[rows, before], known[rows, index]
    chord = np.divide(first, first - last, out=np.full_like(first, 0.5), where=first != last)
    theta = low + (high - low) * np.minimum(np.maximum(chord, 0.0), 1.0)
    slope, side = apply(_DERIVATIVE, gap), side[:, 0]
    for _ in range(60):
        row = basis(theta)
        value, rate = dot(row, gap), dot(row, slope)
        short = side * value > 0
        low, high = np.where(short, theta, low), np.where(short, high, theta)
        new = theta - np.divide(value, rate, out=np.full_like(value, np.inf), where=rate != 0)
        new = np.where((new >= low) & (new <= high), new, (low + high) / 2)
        moved, theta = np.abs(new - theta).max(initial=0.0), new
        # The error is the square of the last correction.
        if moved <= 1e-8:
            break
    return theta


def slope(values, theta):
    """Derivative by θ of the interpolant of values at the points, one step a row."""
    return dot(basis(theta), apply(_DERIVATIVE, values))


def around(index, last):
    """θ of the neighbours of points by number, up to `last`."""
    return POINTS[np.maximum(index - 1, 0)], np.minimum(_EDGES[index + 1], last)
