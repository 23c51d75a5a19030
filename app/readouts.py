"""Readouts: numbers of a course, with their units and explanations."""

from functools import cache
from typing import Any

import numpy as np

from mdr_core.results.units import KINDS, written

from .courses import Course
from .quantities import OF_DRIVE, READOUTS, Readout
from .ui import explained, linked, symbol


def readings(course: Course) -> dict[Readout, Any]:
    """Values of all readouts that a course has."""
    numbers = ((readout, readout.values(course)) for readout in READOUTS)
    return {readout: values for readout, values in numbers if values is not None}


def text(readout: Readout, values: Any, i: int, count: int = 4) -> str:
    """Value in state i with its unit."""
    value = values if np.ndim(values) == 0 else values[i]
    return written(float(value), KINDS[readout.known.unit], count)


def line(course: Course, numbers: dict[Readout, Any]) -> list[Readout]:
    """Readouts of the line above the plots."""
    return [readout for readout in numbers if readout.name in OF_DRIVE[course.drive]["line"]]


def values(course: Course, numbers: dict[Readout, Any], i: int) -> str:
    """Cells of the line in state i, as HTML."""
    cells = (
        f'<output data-name="{each.name}">{text(each, numbers[each], i)}</output>'
        for each in line(course, numbers)
    )
    return f'<div class="strip">{"".join(cells)}</div>'


def heads(course: Course, numbers: dict[Readout, Any]) -> str:
    """Heads of the line, with explanations, as HTML."""
    return f'<div class="strip">{"".join(map(head, line(course, numbers)))}</div>'


@cache
def head(readout: Readout) -> str:
    """Head of a readout with its explanation, as HTML."""
    known = readout.known
    about = f"<p>{linked(readout.help)}</p><em>{linked(readout.equation)}</em>"
    return explained(f"about-{readout.name}", f"{symbol(known.symbol)} {known.long_name}", about)
