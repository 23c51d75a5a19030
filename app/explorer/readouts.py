"""Readouts: numbers of a course, with their units and explanations."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from markupsafe import Markup

from mdr_core.show.units import KINDS, format_quantity

from ..common.quantities import CHOICES, READOUTS, Readout, unicode_subscripts
from ..common.ui import linked, symbol
from .courses import Course

#: Largest number of readouts in the line above the plots.
MOST = 8
#: Rounding error of a sum relative to its largest term: some units in the last place.
_RESIDUE = 16 * np.finfo(float).eps
#: Restitution below which the page shows no digits, because the model is not that accurate.
_LEAST = 1e-3


def readings(course: Course, asked: list[Readout] = READOUTS) -> dict[Readout, Any]:
    """Return the values of the readouts of a course; a sum that is only rounding error becomes 0.

    All numbers on the page, in texts and in exports come from here.
    """
    terms = course.largest_terms
    found = {each: values for each in asked if (values := each.values(course)) is not None}
    return {each: _without_residue(values, terms.get(each.name)) for each, values in found.items()}


def _without_residue(values: Any, term: Any) -> Any:
    return values if term is None else np.where(np.abs(values) <= _RESIDUE * term, 0.0, values)


def line(course: Course) -> dict[Readout, Any]:
    """Return the values of the readouts above the plots."""
    in_place, names = course.in_place, CHOICES["drive"].options[course.drive].line
    names = [in_place.get(name, name) for name in names]
    return readings(course, [each for each in READOUTS if each.name in names])


def text(readout: Readout, values: Any, i: int, count: int = 4) -> str:
    """Format the value in state i with its unit."""
    value = float(values if np.ndim(values) == 0 else values[i])
    if readout.name == "restitution" and 0 < value < _LEAST:
        return f"< {_LEAST:g}"
    return format_quantity(value, KINDS[readout.unit], count)


_STRIP = Markup('<div class="strip">{}</div>')
_CELL = Markup('<output data-name="{}"{}>{}{}</output>')
_DOUBTFUL = Markup(' class="doubtful" title="{}"')
_ASIDE = Markup(" <small>{}</small>")
_ABOUT = Markup('<span class="name" title="{}">{} {}</span>')
_NUMBER = Markup("<dt>{} {}</dt><dd>{}</dd>")
_EXPLAINED = Markup("<dt>{} {}</dt><dd>{} <em>{}</em></dd>")


def values(course: Course, numbers: dict[Readout, Any], i: int) -> Markup:
    """Return the cells of the line of a course in state i as HTML; mark numbers that are no results."""
    doubtful, asides = course.doubtful, course.asides
    cells = (
        _CELL.format(
            each.name,
            _DOUBTFUL.format(doubtful[each.name]) if each.name in doubtful else "",
            text(each, value, i),
            _ASIDE.format(asides[each.name]) if each.name in asides else "",
        )
        for each, value in numbers.items()
    )
    return _STRIP.format(Markup("").join(cells))


def heads(numbers: dict[Readout, Any]) -> Markup:
    """Return the heads of the line as HTML; their tooltips explain them, as the notes do."""
    return _STRIP.format(Markup("").join(map(head, numbers)))


@cache
def head(readout: Readout) -> Markup:
    about = f"{unicode_subscripts(readout.help)} {unicode_subscripts(readout.equation)}".strip()
    return _ABOUT.format(about, symbol(readout.symbol), readout.short or readout.long_name)


def table(course: Course) -> Markup:
    """Return the numbers of the present state outside the line, as HTML."""
    above = line(course)
    rows = (
        _NUMBER.format(symbol(each.symbol), each.long_name, text(each, value, course.now))
        for each, value in readings(course).items()
        if each not in above
    )
    return Markup("<dl>{}</dl>").format(Markup("").join(rows))


def explained(numbers: dict[Readout, Any], link: Callable[[str], Markup] = linked) -> Markup:
    """Return explanations of numbers, with their equations, as HTML; `link` converts text to HTML."""
    rows = (
        _EXPLAINED.format(symbol(each.symbol), each.long_name, link(each.help), link(each.equation))
        for each in numbers
    )
    return Markup("<dl>{}</dl>").format(Markup("").join(rows))
