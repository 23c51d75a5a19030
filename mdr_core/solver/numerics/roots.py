"""Roots and largest values of functions, elementwise."""

import numpy as np

from ...base import check


def largest_value(function, low, high, grids=2):
    """Return the largest value of a function with one maximum between `low` and `high` (N, 1), by rows.

    `function` takes arguments of shape (N, K). The search uses grids, and then the vertex of the parabola
    through the best three points. The result is the value of the function at the vertex, because the
    parabola is too large on a plateau and next to a kink.
    """
    rows = np.arange(len(low))
    for _ in range(grids):
        places = low + (high - low) * np.linspace(0, 1, 17)
        values = function(places)
        best = np.clip(values.argmax(axis=1), 1, 15)
        low, high = places[rows, best - 1, None], places[rows, best + 1, None]
    before, there, after = (values[rows, best + side] for side in (-1, 0, 1))
    bend = 2 * there - before - after
    inside = np.abs(after - before) < 2 * bend
    # From the middle, over half of the interval.
    offset = np.where(inside, (after - before) / (2 * np.where(inside, bend, 1.0)), 0.0)[:, None]
    vertex = function(low + (high - low) * (1 + offset) / 2)
    return np.fmax(vertex[:, 0], values.max(axis=1))


def increasing_root(function, target, start, highest=np.inf, *, largest=check.LARGEST, quantity="depth"):
    """Find the positive x with function(x) = target, elementwise, if the function grows about as a power.

    Newton's method solves for ln f over ln x inside a bracket. If a step leaves the bracket, it is replaced
    by bisection. After a dozen steps every other step is a bisection, because Newton's method alone may
    alternate between both sides of a kink.

    Parameters
    ----------
    function : callable
        Values and derivatives at an array x > 0, up to `highest`.
    target, start : array_like
        Target values, and first guesses of x.
    highest : float or ndarray
        Largest x at which the function is known; the result is infinite if the target is not reached.
    largest : float
        The result is infinite if it would be larger.
    quantity : str
        Name of x, for the error if the iteration does not converge.
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
        # NaN counts as too large: a function ends there.
        high, low = np.where(value < target, high, x), np.where(value <= target, x, low)
        # Far from the root, values may overflow; targets of 0 need no search.
        with np.errstate(all="ignore"):
            miss = np.log(target / value)
            # The slope is infinite at the edge of a flat face and at some kinks, and a step there is 0.
            step = np.where(slope < np.inf, miss * value / (slope * x), np.nan)
            # Short steps first, which are safer after a bad start; 200 of them would reach 10⁻²⁶¹ of it.
            longest = 3.0 if iteration < 24 else 50.0
            step = np.clip(step, -longest, longest)
            new, middle = x * np.exp(step), np.where(low > 0, np.sqrt(low) * np.sqrt(high), high / 16)
            # By rounding, the root of a product may be above both factors.
            middle = np.where(high < np.inf, np.minimum(middle, high), 16 * x)
            inside = (new > low) & (new < high) & (iteration < 12 or iteration % 2 == 0)
            new = np.where(inside, new, middle)
            # The step or the bracket is only rounding.
            settled = (np.abs(new - x) <= 4 * eps * x) | (high - low <= 4 * eps * low)
        stalled = np.where(np.abs(miss) < least, 0, stalled + 1)
        best, least = np.where(stalled == 0, x, best), np.fmin(np.abs(miss), least)
        # The iteration ends when, by rounding of f, no step comes closer.
        settled |= least <= 8 * eps
        settled |= (stalled > 0) & (least <= 1e-14) | (stalled > 1) & (least <= 1e-13)
        reachable &= low < largest
        if np.all(settled | ~sought | ~reachable):
            return np.where(reachable, np.where(target > 0, best, 0.0), np.inf)
        # An entry beyond the largest length waits for the others.
        x = np.where(sought & reachable, new, x)
    raise check.MDRError(f"no {quantity} was found in 200 steps; check that all quantities are in SI units")


def change_between(answer, low, high, at_low):
    """Return neighbouring numbers between which an answer changes from its value at `low`, by bisection.

    `answer` returns a bool for each of an array of numbers, and changes once between `low` and `high`, of
    shape (M,). All changes are found at once: samples have a change at every vertex, and a call costs as
    much for one number as for many.
    """
    while np.any(high - low > 4e-16 * high):
        middle = (low + high) / 2
        if np.all((middle == low) | (middle == high)):
            break
        same = answer(middle) == at_low
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low, high


def crossing(function, x, low, high):
    """Find the root x of a function that is negative at `low`, by Newton's method inside a bracket.

    It works elementwise. `function` returns values and slopes. The result is NaN if there is no root up to
    the largest length.
    """
    for _ in range(200):
        value, slope = function(x)
        low, high = np.where(value < 0, x, low), np.where(value >= 0, x, high)
        with np.errstate(all="ignore"):
            step = value / slope
            new = x - step
            inside = (slope > 0) & (new >= low) & (new <= high)
            # After a step of 10⁻⁹ the next step is rounding.
            settled = inside & (np.abs(step) <= 1e-9 * np.abs(x)) | (high - low <= 4e-16 * np.abs(x))
            middle = np.where(high < np.inf, (low + high) / 2, 2 * np.maximum(x, low))
        x = np.where(inside, new, middle)
        if settled.all() or not np.any(np.abs(x) < check.FARTHEST):
            break
    return np.where(np.abs(x) < check.FARTHEST, x, np.nan)


def root_in_bracket(function, x, low, high, close):
    """Return the result at the root of an increasing function, by Newton's method from x in a bracket.

    `function` returns its value, its slope and a result at x; the root is found to within `close`.
    """
    for count in range(80):
        value, slope, result = function(x)
        miss = value / slope
        if abs(miss) <= close or high - low <= close:
            break
        low, high = (x, high) if miss < 0 else (low, x)
        x -= miss
        # Bisection at every other step, in case of a kink or a jump of the function.
        if not low < x < high or (count > 5 and count % 2 and high - low < np.inf):
            x = (low + high) / 2
    return result


def sign_change(function, low, high):
    """Return the place between `low` and `high` at which a function becomes positive.

    The search uses secants and bisection.
    """
    at_low, at_high = function(low), function(high)
    if at_low * at_high >= 0:
        # Rounding hides the change.
        return float(high)
    for count in range(200):
        # Illinois rule: the value at an unchanged end is halved, so that both ends move.
        place = high - at_high * (high - low) / (at_high - at_low)
        place = place if low < place < high and count % 8 < 6 else (low + high) / 2
        value = function(place)
        if value == 0 or not low < place < high:
            break
        if value > 0:
            high, at_high, at_low = place, value, at_low / 2
        else:
            low, at_low, at_high = place, value, at_high / 2
        if high - low <= 4e-16 * abs(high):
            break
    return float(place)
