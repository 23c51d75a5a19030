"""Readouts: numbers of a course, with their units and explanations."""

from collections.abc import Callable
from html import escape
from typing import Any

import numpy as np

from mdr_core.show.units import KINDS, written

from .courses import Course
from .quantities import CHOICES, READOUTS, Readout, lowered
from .ui import linked, symbol

#: Most readouts above the plots, beside each other.
MOST = 8
#: Relative to the largest term of a sum: what is left of it by rounding, some units in the last place.
_RESIDUE = 16 * np.finfo(float).eps


def readings(course: Course, asked: list[Readout] = READOUTS) -> dict[Readout, Any]:
    """Values of the readouts that a course has; a sum of which rounding alone is left is 0.

    All numbers that are shown, told or exported are read here.
    """
    terms = course.largest_terms
    found = {each: values for each in asked if (values := each.values(course)) is not None}
    return {each: _without_residue(values, terms.get(each.name)) for each, values in found.items()}


def _without_residue(values: Any, term: Any) -> Any:
    return values if term is None else np.where(np.abs(values) <= _RESIDUE * term, 0.0, values)


def line(course: Course) -> dict[Readout, Any]:
    """Values of the readouts above the plots.

    With dashpots the work that they lose has the place of the damaged area, which c gives, too.
    """
    names = CHOICES["drive"].options[course.drive].line
    if course.dashpots:
        names = ["viscous_work" if name == "damaged_area" else name for name in names]
    return readings(course, [each for each in READOUTS if each.name in names])


def text(readout: Readout, values: Any, i: int, count: int = 4) -> str:
    """Value in state i with its unit."""
    value = values if np.ndim(values) == 0 else values[i]
    return written(float(value), KINDS[readout.unit], count)


def values(numbers: dict[Readout, Any], i: int) -> str:
    """Cells of the line in state i, as HTML."""
    cells = (
        f'<output data-name="{each.name}">{text(each, value, i)}</output>'
        for each, value in numbers.items()
    )
    return f'<div class="strip">{"".join(cells)}</div>'


def heads(numbers: dict[Readout, Any]) -> str:
    """Heads of the line, as HTML; pointed at they say what they are, as the notes do."""
    return f'<div class="strip">{"".join(map(head, numbers))}</div>'


def head(readout: Readout) -> str:
    about = escape(f"{lowered(readout.help)} {lowered(readout.equation)}".strip())
    name = readout.short or readout.long_name
    return f'<span class="name" title="{about}">{symbol(readout.symbol)} {name}</span>'


def explained(numbers: dict[Readout, Any], link: Callable[[str], str] = linked) -> str:
    """What each number is, with its equation, as HTML; `link` is what makes HTML of a text."""
    rows = (
        f"<dt>{symbol(each.symbol)} {each.long_name}</dt>"
        f"<dd>{link(each.help)} <em>{link(each.equation)}</em></dd>"
        for each in numbers
    )
    return f"<dl>{''.join(rows)}</dl>"
