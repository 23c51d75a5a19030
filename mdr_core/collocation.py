"""Steps of Gauss collocation: integrals from the beginning of a step to each of its nodes.

A step runs over θ from 0 to 1. Elapsed time is θ, or θ³ where fractional powers of the time begin,
or 1 − (1 − θ)³ where they end: these three kinds of step are the rows of the tables here.
"""

import numpy as np

from .panels import integration_rule

NODES, WEIGHTS, TAIL = integration_rule(24)

PLAIN, OPENING, CLOSING = range(3)

_RATE = np.stack([np.ones_like(NODES), 3 * NODES**2, 3 * (1 - NODES) ** 2])
#: Share of the step's time at each node, (kind, node).
ELAPSED = np.stack([NODES, NODES**3, NODES * (3 - NODES * (3 - NODES))])
#: Weights of the integral over the time of a whole step, (kind, node).
WHOLE = _RATE * WEIGHTS
#: Matrix of the integrals over time from the beginning to each node, (kind, node, node).
INTEGRATE = (WEIGHTS - TAIL) * _RATE[:, None, :]
#: The same applied twice, for the path from the acceleration.
TWICE = INTEGRATE @ INTEGRATE


def _interpolation(points):
    """Barycentric weights of interpolation points, and the matrix that differentiates at them."""
    difference = points[:, None] - points
    np.fill_diagonal(difference, 1.0)
    weight = 1 / difference.prod(axis=1)
    derivative = weight / weight[:, None] / difference
    np.fill_diagonal(derivative, 0.0)
    np.fill_diagonal(derivative, -derivative.sum(axis=1))
    return weight, derivative


#: The beginning and the nodes of a step.
POINTS = np.append(0.0, NODES)
_WEIGHT, _DERIVATIVE = _interpolation(POINTS)
_INNER_DERIVATIVE = _interpolation(NODES)[1]

#: Matrix that differentiates by the share of time elapsed, from values at the nodes, (kind, node, node).
DIFFERENTIATE = _INNER_DERIVATIVE / _RATE[:, :, None]


def _legendre_projection():
    values = np.polynomial.legendre.legvander(2 * NODES - 1, NODES.size - 1)
    return (values * WEIGHTS[:, None]).T * (2 * np.arange(NODES.size)[:, None] + 1)


_LAST = _legendre_projection()[-3:]


def unresolved(values, kind):
    """Size of the last Legendre coefficients of values at the nodes times dt/dθ, one step a row."""
    return np.abs(np.einsum("ij,kj->ik", values * _RATE[kind], _LAST)).max(axis=1)


def share(kind, theta):
    """Share of a step's time elapsed at θ."""
    return np.choose(kind, [theta, theta**3, theta * (3 - theta * (3 - theta))])


def theta_at(kind, elapsed):
    """θ at a share of a step's time: inverse of `share`."""
    elapsed = np.clip(elapsed, 0.0, 1.0)
    return np.choose(kind, [elapsed, np.cbrt(elapsed), 1 - np.cbrt(1 - elapsed)])


def basis(theta):
    """Weights that interpolate values at 0 and the nodes to θ, one row each."""
    gap = theta[:, None] - POINTS
    # On a point its own weight outgrows the others.
    gap[gap == 0] = 1e-200
    row = _WEIGHT / gap
    return row / row.sum(axis=1, keepdims=True)


def with_start(start, values):
    """Values at 0 and the nodes, as `basis` takes them."""
    return np.column_stack([start, values])


def interpolate(weights, values):
    """Values at 0 and the nodes, at the θ of `basis`."""
    return np.einsum("ij,ij->i", weights, values)


def crossing(values, target, end=1.0):
    """First θ at which the interpolant of values at 0 and the nodes crosses a target, one step a row.

    The first value is on one side of the target, and some other one up to θ = `end`, or the
    interpolant there, on the other.
    """
    gap = values - np.asarray(target)[:, None]
    end = np.broadcast_to(end, len(gap))
    inside = np.column_stack([end[:, None] > POINTS, np.zeros(len(gap), bool)])
    edges = np.where(inside, np.append(POINTS, 1.0), end[:, None])
    there = interpolate(basis(end), gap)[:, None]
    known = np.where(inside, np.hstack([gap, there]), there)
    side = np.sign(known[:, :1])
    index = np.argmax(side * known <= 0, axis=1)
    index = np.where((side * known <= 0).any(axis=1), index, edges.shape[1] - 1)
    rows = np.arange(len(gap))
    low, high = edges[rows, np.maximum(index - 1, 0)], edges[rows, index]
    slope = np.einsum("ij,kj->ik", gap, _DERIVATIVE)
    first, last = known[rows, np.maximum(index - 1, 0)], known[rows, index]
    chord = np.divide(first, first - last, out=np.full_like(first, 0.5), where=first != last)
    theta = low + (high - low) * np.clip(chord, 0.0, 1.0)
    for _ in range(60):
        weights = basis(theta)
        value, rate = interpolate(weights, gap), interpolate(weights, slope)
        before = side[:, 0] * value > 0
        low, high = np.where(before, theta, low), np.where(before, high, theta)
        new = theta - np.divide(value, rate, out=np.full_like(value, np.inf), where=rate != 0)
        new = np.where((new >= low) & (new <= high), new, (low + high) / 2)
        moved, theta = np.abs(new - theta).max(initial=0.0), new
        # The error is the square of the last correction.
        if moved <= 1e-9:
            break
    return theta


def slope(values, theta):
    """Derivative by θ of the interpolant of values at 0 and the nodes, one step a row."""
    return interpolate(basis(theta), np.einsum("ij,kj->ik", values, _DERIVATIVE))


def largest(values, last):
    """θ up to `last` at which the interpolant of values at 0 and the nodes is largest, one step a row."""
    slope = np.einsum("ij,kj->ik", values, _DERIVATIVE)
    bend = np.einsum("ij,kj->ik", slope, _DERIVATIVE)
    known = np.where(last[:, None] >= POINTS, values, -np.inf)
    index = np.argmax(known, axis=1)
    low, high = POINTS[np.maximum(index - 1, 0)], np.minimum(np.append(POINTS, 1.0)[index + 1], last)
    theta = np.minimum(POINTS[index], last)
    for _ in range(6):
        weights = basis(theta)
        rate, change = interpolate(weights, slope), interpolate(weights, bend)
        new = theta - np.divide(rate, change, out=np.zeros_like(rate), where=change < 0)
        new = np.clip(new, low, high)
        moved, theta = np.abs(new - theta).max(initial=0.0), new
        if moved <= 1e-6:
            break
    return theta
