"""Refusals of the core in the words of the page."""

from mdr_core._errors import InvalidArgument

from .quantities import QUANTITIES, lowered
from .units import KINDS, written


def in_words(error: ValueError) -> str:
    """Message of an error: of a refused number its symbol, value with unit, bound and remedy.

    All other messages are as they stand.
    """
    if not isinstance(error, InvalidArgument) or not isinstance(error.value, int | float):
        return str(error)
    known = QUANTITIES.get(error.argument)
    name = f"{lowered(known.symbol)}, {known.label}," if known else error.quantity
    value = written(float(error.value), KINDS.get(error.unit, "number"))
    remedy = f"; {error.remedy}" if error.remedy and "SI units" not in error.remedy else ""
    return f"{name} = {value} {error.bound}{remedy}"
