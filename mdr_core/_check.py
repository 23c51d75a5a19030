"""Checks of what a caller hands in: quantity, value, bound, and what to do about it."""

from functools import cached_property, wraps

import numpy as np

# Beyond it the squares and products of quantities would overflow.
_LARGEST = 1e140


def number(quantity, value):
    """`value` as a float, if it is one real number (no bool, no text, no array)."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" or array.ndim:
            raise TypeError
    except (TypeError, ValueError):
        raise ValueError(f"{quantity} must be one real number, got {value!r}") from None
    return float(array)


def positive(quantity, value, *, unit="", infinite=False, zero=False):
    """`value` as a float or a read-only array, if positive (or zero, or infinite, where allowed)."""
    if np.ndim(value) == 0:
        values = np.asarray(number(quantity, value))
    else:
        values = _real_array(quantity, value).copy()
        values.setflags(write=False)
    with np.errstate(invalid="ignore"):
        bad = ~(values >= 0) if zero else ~(values > 0)
    if not infinite:
        bad = bad | (values == np.inf)
    bound = f"must be {'' if infinite else 'finite and '}{'not negative' if zero else 'positive'}"
    remedy = f"give it in SI units{f' ({unit})' if unit else ''}"
    refuse(quantity, values, bad, bound, unit=unit, remedy=remedy)
    return values if values.ndim else float(values)


def _real_array(quantity, value):
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf":
            raise TypeError
        return array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise ValueError(f"{quantity} must be real numbers, got {value!r:.80}") from None


def finite_array(quantity, value, *, unit=""):
    """`value` as a float array without NaN or infinity."""
    array = _real_array(quantity, value)
    return refuse(quantity, array, ~(np.abs(array) < _LARGEST), "must be finite", unit=unit)


def refuse(quantity, array, bad, bound, *, unit="", remedy=""):
    """`array`, if no entry is `bad`; otherwise an error that names the first and counts the others."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), array.shape)
        where = f"[{', '.join(map(str, index))}]" if array.ndim else ""
        unit = f" {unit}" if unit else ""
        others = np.count_nonzero(bad) - 1
        more = f" (and {others} more of {array.size} entries)" if others else ""
        remedy = f"; {remedy}" if remedy else ""
        raise ValueError(f"{quantity}{where} = {array[index]:g}{unit} {bound}{more}{remedy}")
    return array


def common_shape(what, **values):
    """Shape to which the values broadcast, or an error that names their shapes."""
    try:
        return np.broadcast_shapes(*map(np.shape, values.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in values.items() if np.ndim(value))
        raise ValueError(f"{what}: arrays of shapes {shapes} do not broadcast") from None


def frozen(values):
    """`values` as a scalar, or as an array that cannot be written to."""
    values = np.asarray(values)
    values.setflags(write=False)
    return values[()]


def frozen_property(function):
    """A property that is computed once and handed out as `frozen`."""
    return cached_property(wraps(function)(lambda self: frozen(function(self))))
