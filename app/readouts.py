"""Readouts, assumptions, and summary of the scene."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from .courses import Course, onset_depth
from .quantities import (
    CHOICES,
    OF_DRIVE,
    QUANTITIES,
    READOUTS,
    SHAPES,
    USED,
    Readout,
    shape_quantities,
)
from .state import State, medium
from .ui import explained, linked, symbol
from .units import KINDS, digits, in_full, written


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


def limits(course: Course, state: State) -> Iterator[tuple[str, str]]:
    """Levels ("good", "note", "beyond") and sentences of the assumptions."""
    for sentence in (*course.notes, course.pending):
        if sentence:
            yield "note", sentence
    given = state.elasticity != "modulus"
    for limit in sorted(course.limits(state.density), key=lambda limit: limit.concerns != "result"):
        if limit.what == "Poisson ratio" and not given:
            yield "note", "Dashpots beside springs are exact for ν = ½ only; ν is not given with E*."
        elif limit.what == "coupling" and not given:
            yield "note", "Friction along the surface is that of ν = ½; ν is not given with E*."
        elif limit.what == "viscosity" and not course.pending:
            tau = written(limit.value, "time")
            remedy = ", or ".join(drive["in_time"] for drive in OF_DRIVE.values() if "in_time" in drive)
            yield "note", f"Pressing is quasi-static here; dashpots, τ = {tau}, act in {remedy}."
        elif limit.what not in ("fast limit", "viscosity"):
            yield limit.level, limit.sentence
        elif limit.what == "fast limit" and limit.holds and not course.adhesive:
            # The fast limit is one without adhesion.
            yield limit.level, _areas(course.hit)
        elif limit.what == "fast limit" and not course.adhesive:
            yield limit.level, limit.sentence + (f" {_areas(course.hit)}" if limit.value < np.inf else "")


def _areas(hit: Any) -> str:
    """Comparison of the fast limit with the areas of contact and damage."""
    limit = float(hit.fast_limit.contact_area)
    named = {"damaged area πc²": hit.damaged_area, "contact area πa²": np.pi * hit.contact_radius**2}
    texts = []
    for name, area in named.items():
        more = 100 * (limit / float(area) - 1)
        side = "above" if more > 0 else "below"
        texts.append(f"{digits(abs(more), 2)} % {side} the {name} = {written(float(area), 'area')}")
    return f"Fast-impact limit (23), (24): A = {written(limit, 'area')}, {' and '.join(texts)}."


def warnings(course: Course, state: State) -> str:
    """Exceeded assumptions as HTML; the others fold."""
    sentences = [
        (level, f'<span class="{level}">{linked(sentence)}</span>')
        for level, sentence in limits(course, state)
    ]
    exceeded = "".join(html for level, html in sentences if level == "beyond")
    others = "".join(html for level, html in sentences if level != "beyond")
    folded = f"<details><summary>Assumptions and notes</summary>{others}</details>"
    return exceeded + folded * bool(others)


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


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    made, choices = medium(state), OF_DRIVE[state.drive]["form"]
    names = [name for name, _ in shape_quantities(state.shape)]
    of_medium = {name: getattr(made, name) for name in ("E_star", "q_c", "f_c", "eta", "work_of_adhesion")}
    of_medium["volume_hardness"] = made.hardness
    names += [name for name, value in of_medium.items() if 0 < value < np.inf]
    names += [number for name in ("drive", *choices) for number in USED[name][state[name]]]
    words = [SHAPES[state.shape].label]
    for name in names:
        value = float(of_medium.get(name, state[name]))
        if value:
            words.append(f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}")
    return ", ".join([*words, *(CHOICES[name][state[name]] for name in choices)])
