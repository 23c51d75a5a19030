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
    """`value` as a float, if it is positive (or zero, or infinite, where allowed)."""
    result = number(quantity, value)
    bound = "not negative" if zero else "positive"
    low = result >= 0 if zero else result > 0
    if not low or (result == np.inf and not infinite):
        finite = "" if infinite else "finite and "
        unit = f" {unit}" if unit else ""
        raise ValueError(
            f"{quantity} = {result:g}{unit} must be {finite}{bound}; "
            f"give it in SI units{' (' + unit.strip() + ')' if unit else ''}"
        )
    return result


def finite_array(quantity, value, *, unit=""):
    """`value` as a float array without NaN or infinity."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf":
            raise TypeError
        array = array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise ValueError(f"{quantity} must be real numbers, got {value!r:.80}") from None
    return refuse(quantity, array, ~(np.abs(array) < _LARGEST), "must be finite", unit=unit)


def refuse(quantity, array, bad, bound, *, unit="", remedy=""):
    """`array`, if no entry is `bad`; otherwise an error that names the first that is."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), array.shape)
        where = f"[{', '.join(map(str, index))}]" if array.ndim else ""
        unit = f" {unit}" if unit else ""
        remedy = f"; {remedy}" if remedy else ""
        raise ValueError(f"{quantity}{where} = {array[index]:g}{unit} {bound}{remedy}")
    return array


def frozen(values):
    """`values` as a scalar, or as an array that cannot be written to."""
    values = np.asarray(values)
    values.setflags(write=False)
    return values[()]


def frozen_property(function):
    """A property that is computed once and handed out as `frozen`."""
    return cached_property(wraps(function)(lambda self: frozen(function(self))))
