"""Readouts, assumptions, and summary of the scene."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from mdr_core.results.limits import friction_limits
from mdr_core.results.quantities import QUANTITIES as RESULTS
from mdr_core.results.quantities import Quantity

from ..drives import Course
from ..state import State, medium
from ..state.quantities import CHOICES, DATA, OF_DRIVE, QUANTITIES, SHAPES, USED, shape_quantities
from ..state.units import KINDS, digits, in_full, written
from ..ui import explained, linked, plain, symbol


@dataclass(frozen=True)
class Readout:
    """A readout: its name in the table of quantities of the core, and its attribute `of` a course.

    `own` is its symbol, unit and name if the core has none.
    """

    name: str
    of: str
    help: str
    equation: str = ""
    own: tuple[str, str, str] | None = None

    @property
    def known(self) -> Quantity:
        return Quantity(*self.own) if self.own else RESULTS[self.name]

    def values(self, course: Course) -> Any:
        for name in self.of.split("."):
            course = getattr(course, name, None)
        return course


#: Every number that can be read, in the order in which all of them are listed.
READOUTS = tuple(
    Readout(**row | {"own": tuple(row["own"])} if "own" in row else row) for row in DATA["readouts"]
)


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
    assumptions = list((course.states if course.hit is None else course.hit).limits)
    if course.hit is not None:
        assumptions.append(course.hit.speed_limit(state.density))
    assumptions += friction_limits(course.scene.medium) if course.oblique is not None else ()
    if course.hit is not None and course.hit.captured:
        yield "note", "Adhesion holds the body: e = 0. Unloading is drawn as if it were pulled off."
    if course.pending:
        yield "note", course.pending
    rests = getattr(course.scene.drive, "time", None) is not None
    if rests and course.scene.medium.eta == 0:
        yield "note", "Without viscosity nothing changes while the depth or force is held."
    given = state.elasticity != "modulus"
    if course.adhesive:
        # The fast limit is one without adhesion.
        assumptions = [limit for limit in assumptions if limit.what != "fast limit"]
    for limit in sorted(assumptions, key=lambda limit: limit.concerns != "result"):
        if limit.what == "Poisson ratio" and not given:
            yield "note", "Dashpots beside springs are exact for ν = ½ only; ν is not given with E*."
        elif limit.what == "coupling" and not given:
            yield "note", "Friction along the surface is that of ν = ½; ν is not given with E*."
        elif limit.what == "viscosity":
            tau = written(limit.value, "time")
            remedy = "choose the drive path and one of its patterns in time, or an impact"
            yield "note", f"Pressing is quasi-static here, without dashpots; τ = {tau}. For these {remedy}."
        elif limit.what == "fast limit" and limit.holds:
            yield limit.level, _areas(course.hit)
        else:
            areas = " " + _areas(course.hit) if limit.what == "fast limit" and limit.value < np.inf else ""
            yield limit.level, plain(limit.sentence) + areas


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


def summary(state: State) -> str:
    """Shape, medium and drive of a scene in one line."""
    made, choices = medium(state), OF_DRIVE[state.drive]["form"]
    names = [name for name, _ in shape_quantities(state.shape)]
    of_medium = ("E_star", "q_c", "eta", "work_of_adhesion")
    names += [name for name in of_medium if 0 < getattr(made, name) < np.inf]
    names += [number for name in ("drive", *choices) for number in USED[name][state[name]]]
    words = [SHAPES[state.shape].label]
    for name in names:
        value = float(getattr(made, name)) if name in of_medium else state[name]
        if value:
            words.append(f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}")
    return ", ".join([*words, *(CHOICES[name][state[name]] for name in choices)])
