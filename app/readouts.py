"""Readouts: numbers of a course, with their units and explanations."""

from functools import cache
from typing import Any

import numpy as np

from mdr_core.results.units import KINDS, written

from .courses import Course, onset_depth
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
    return f'<div class="strip">{"".join(map(_head, line(course, numbers)))}</div>'


def table(course: Course, numbers: dict[Readout, Any], i: int) -> str:
    """All numbers in state i, as HTML."""
    rows = (
        f'<tr data-name="{each.name}"><th>{_head(each)}</th><td>{text(each, value, i)}</td></tr>'
        for each, value in numbers.items()
    )
    return f"<table>{''.join(rows)}</table>"


@cache
def _head(readout: Readout) -> str:
    known = readout.known
    about = f"<p>{linked(readout.help)}</p><em>{linked(readout.equation)}</em>"
    return explained(f"about-{readout.name}", f"{symbol(known.symbol)} {known.long_name}", about)


def law_of_hardness(course: Course) -> str:
    """The hardness at the contact radius of the largest depth, and where yield begins."""
    made, onset = course.scene.medium, onset_depth(course.scene)
    a = float(course.turning_point.contact_radius)
    if made.q_c == np.inf:
        return "Nothing yields: q_c = ∞"
    law = "q_c/a" if made.q_c else "f_c/a²" if made.f_c else "H"
    hardness = written(float(made.hardness_at(a)), "pressure")
    place = " at every a" if law == "H" else f" at a = {written(a, 'length')}"
    starts = f"Yield starts at d_y = {written(onset, 'length')}"
    if onset == np.inf:
        starts = "Nothing yields under this shape: H is too large"
    elif onset == 0:
        starts = "Yield starts at first touch, d_y = 0"
    return f"σ_c = {law} = {hardness}{place}. {starts} " + ("(19)" if made.inverse_to_radius else "§ 20")
