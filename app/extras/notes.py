"""Assumptions of the model, notes on the course, and what the numbers are, below the player."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any

from markupsafe import Markup

from mdr_core.show.units import written

from .. import readouts
from ..courses import Course
from ..extra import Extra
from ..plot import Plot, View
from ..plots import NAMED, PLOTS, visible
from ..quantities import CHOICES
from ..state import State
from ..ui import linked, marked

_HEAD = "Numbers, equations, assumptions"


def limits(course: Course, state: State) -> Iterator[tuple[str, str]]:
    """Levels ("good", "note", "beyond") and sentences of the assumptions."""
    for sentence in (*course.notes, course.pending):
        if sentence:
            yield "note", sentence
    speed = [] if course.hit is None else [course.hit.speed_limit(state.density)]
    for limit in sorted([*course.limits, *speed], key=lambda limit: limit.concerns != "result"):
        # The fast limit is one without adhesion; what is still computed may have dashpots.
        without = {"fast limit": course.adhesive, "viscosity": bool(course.pending)}
        if without.get(limit.what):
            continue
        own = _own_words(limit, state)
        yield ("note", own) if own else (limit.level, limit.sentence)


#: What is said where E* is given without ν.
_OF_INCOMPRESSIBLE = {
    "Poisson ratio": "Dashpots parallel to the springs are exact only for ν = ½; ν is not given with E*.",
    "coupling": "Friction is computed with ν = ½; ν is not given with E*.",
}


def _own_words(limit: Any, state: State) -> str:
    """What the page says of a limit in the place of the core, or nothing."""
    if limit.what == "viscosity":
        remedy = " and in ".join(each.in_time for each in CHOICES["drive"].options.values() if each.in_time)
        tau = written(limit.value, "time")
        return f"Pressing is quasi-static here. Dashpots (τ = {tau}) act in {remedy}."
    return _OF_INCOMPRESSIBLE.get(limit.what, "") if state.elasticity == "modulus" else ""


_SENTENCE = Markup('<span class="{}">{}</span>')


def below(view: View) -> Markup:
    """Exceeded assumptions as HTML; the others fold, with what the numbers and the plots are."""
    exceeded, others = Markup(""), Markup("")
    for level, sentence in limits(view.course, view.state):
        html = _SENTENCE.format(level, linked(sentence))
        exceeded += html * (level == "beyond")
        others += html * (level != "beyond")
    others += readouts.explained(readouts.line(view.course))
    others += _laws(view, visible(view), linked)
    return exceeded + Markup("<details><summary>{}</summary>{}</details>").format(_HEAD, others)


def _laws(view: View, plots: Iterable[Plot], link: Callable[[str], Markup]) -> Markup:
    """The formula of each plot, with the numbers of its equations (HTML); `link` makes HTML of a text."""
    laws = ((plot.title, link(plot.formula_of(view.course))) for plot in plots)
    rows = (Markup("<dt>{}</dt><dd><em>{}</em></dd>").format(*each) for each in laws)
    return Markup("<dl>{}</dl>").format(Markup("").join(rows))


def told(view: View) -> list[tuple[str, str]]:
    """All of them as HTML, without links to pages of the server."""
    sentences = limits(view.course, view.state)
    html = (_SENTENCE.format(level, marked(sentence)) for level, sentence in sentences)
    numbers = readouts.explained(readouts.line(view.course), marked)
    numbers += _laws(view, map(PLOTS.__getitem__, NAMED), marked)
    return [("Assumptions and notes", Markup("").join(html)), ("What the numbers are", numbers)]


EXTRA = Extra("notes", order=30, notes=lambda view: {"below": partial(below, view)}, told=told)
