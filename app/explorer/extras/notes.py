"""Notes in the form; and assumptions and explanations of the numbers below the player."""

from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from math import atan, degrees
from typing import Any

import numpy as np
from markupsafe import Markup

from mdr_core.show.units import digits, format_quantity

from ...common.quantities import CHOICES
from ...common.ui import html_subscripts, linked
from .. import readouts
from ..courses import Course, onset_depth
from ..extra import Extra
from ..link import with_symbol
from ..plot import Plot, View
from ..plots import NAMED, PLOTS, visible
from ..state import PRESETS, State, changed_from_preset

#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665


def form_notes(view: View) -> dict[str, str]:
    """Return notes (HTML) by the places of the form."""
    state, course = view.state, view.course
    shape, made = state.chosen("shape"), course.scene.medium
    head = "Altered. " * bool(changed_from_preset(state)) + "Sources of the preset's numbers, "
    head += "including illustrative numbers:"
    energy = format_quantity(state.mass * state.speed**2 / 2, "energy")
    height = format_quantity(state.speed**2 / (2 * _GRAVITY), "length")
    slope = getattr(course.scene.profile, "slope", None)
    angle = f"Half-angle {digits(degrees(atan(1 / slope)))}°" if slope else ""
    of_tip = state.tip_note if state.shape == "sampled" else angle
    eta, tau = format_quantity(made.eta, "viscosity"), format_quantity(made.relaxation_time, "time")
    idle = "" if course.dashpots else "; no effect here, because pressing is quasi-static"
    return {
        "drive": f"Energy {energy}; equivalent drop height {height}" * (state.drive == "impact"),
        "shape": Markup("<figcaption>{}<br>{}</figcaption>{}").format(
            html_subscripts(shape.height), html_subscripts(shape.reduced), html_subscripts(of_tip)
        ),
        "medium": html_subscripts(law_of_hardness(course)),
        "more": linked(f"η = {eta}, τ = 4η/E* = {tau} (1){idle}") if made.eta > 0 else "",
        "sources": Markup("<p>{}</p><dl>{}</dl>").format(head, _sources(state.preset)),
    }


@cache
def _sources(preset: str) -> Markup:
    """Return the numbers of a preset with their sources."""
    known = PRESETS[preset]
    row = Markup("<dt>{}</dt><dd>{}</dd>")
    symbols = (html_subscripts(with_symbol(name, known.values[name])) for name in known.sources)
    return Markup("").join(map(row.format, symbols, known.sources.values()))


def law_of_hardness(course: Course) -> str:
    """Return the hardness at the contact radius of the largest depth, and the depth of first yield."""
    made, onset = course.scene.medium, onset_depth(course.scene)
    a = float(course.turning_point.contact_radius)
    if made.q_c == np.inf:
        return "Nothing yields: q_c = ∞"
    law = "q_c/a" if made.q_c else "f_c/a²" if made.f_c else "H"
    hardness = format_quantity(float(made.hardness_at(a)), "pressure")
    place = " at every a" if law == "H" else f" at a = {format_quantity(a, 'length')}"
    starts = f"Yield starts at d_y = {format_quantity(onset, 'length')}"
    if imprint := course.initial_plastic_depth:
        depth = format_quantity(onset_depth(course.scene, imprint), "length")
        starts = f"Over the imprint yield goes on at d = {depth}"
    elif onset == np.inf:
        starts = "Nothing yields under this shape: H is too large"
    elif onset == 0:
        starts = "Yield starts at first contact, d_y = 0"
    return f"σ_c = {law} = {hardness}{place}. {starts} " + ("(19)" if made.inverse_to_radius else "§ 20")


_HEAD = "Numbers, equations, assumptions"


def limits(course: Course, state: State) -> Iterator[tuple[str, str]]:
    """Yield levels ("good", "note", "beyond", "severe") and sentences of the assumptions."""
    for sentence in (*course.notes, course.pending):
        if sentence:
            yield "note", sentence
    yield from (("severe", each.sentence) for each in course.cautions)
    told = {what for each in course.cautions for what in each.limits}
    speed = [] if course.hit is None else [course.hit.speed_limit(state.density)]
    for limit in sorted([*course.limits, *speed], key=lambda limit: limit.concerns != "result"):
        # The fast limit excludes adhesion; a pending course may have dashpots.
        without = {"fast limit": course.adhesive, "viscosity": bool(course.pending)}
        if without.get(limit.what) or limit.what in told:
            continue
        own = _own_words(limit, state)
        yield ("note", own) if own else (limit.level, limit.sentence)


#: Notes on limits if E* is given without ν.
_OF_INCOMPRESSIBLE = {
    "Poisson ratio": "Dashpots parallel to the springs are exact only for ν = ½; ν is not given with E*.",
    "coupling": "Friction is computed with ν = ½; ν is not given with E*.",
}


def _own_words(limit: Any, state: State) -> str:
    """Return the page's sentence on a limit if it replaces the core's sentence, else an empty text."""
    if limit.what == "viscosity":
        remedy = " and in ".join(each.in_time for each in CHOICES["drive"].options.values() if each.in_time)
        tau = format_quantity(limit.value, "time")
        return f"Pressing is quasi-static here. Dashpots (τ = {tau}) act in {remedy}."
    return _OF_INCOMPRESSIBLE.get(limit.what, "") if state.elasticity == "modulus" else ""


_DRAWER = Markup('<details><summary>{}</summary><div class="drawer">{}</div></details>')
_SENTENCE = Markup('<span class="{}">{}</span>')


def below(view: View) -> Markup:
    """Return exceeded assumptions as HTML; a fold has the others, and explains numbers and plots."""
    exceeded, others = Markup(""), Markup("")
    for level, sentence in limits(view.course, view.state):
        html = _SENTENCE.format(level, linked(sentence))
        exceeded += html * (level == "beyond")
        # Cautions and their buttons are above the player.
        others += html * (level in ("good", "note"))
    others += readouts.explained(readouts.line(view.course))
    others += readouts.table(view.course)
    others += _laws(view, visible(view), linked)
    return exceeded + _DRAWER.format(_HEAD, others)


def _laws(view: View, plots: Iterable[Plot], link: Callable[[str], Markup]) -> Markup:
    """Return the formulas of plots with their equation numbers (HTML); `link` converts text to HTML."""
    laws = ((plot.title, link(plot.formula_of(view.course))) for plot in plots)
    rows = (Markup("<dt>{}</dt><dd><em>{}</em></dd>").format(*each) for each in laws)
    return Markup("<dl>{}</dl>").format(Markup("").join(rows))


def scene_file_texts(view: View) -> list[tuple[str, str]]:
    """Return all notes as HTML, without links to pages of the server."""
    sentences = limits(view.course, view.state)
    html = (_SENTENCE.format(level, html_subscripts(sentence)) for level, sentence in sentences)
    numbers = readouts.explained(readouts.line(view.course), html_subscripts)
    numbers += _laws(view, map(PLOTS.__getitem__, NAMED), html_subscripts)
    return [("Assumptions and notes", Markup("").join(html)), ("What the numbers are", numbers)]


def notes(view: View) -> dict[str, Any]:
    """Return notes by their places."""
    return form_notes(view) | {"below": partial(below, view)}


EXTRA = Extra("notes", order=30, notes=notes, scene_file_texts=scene_file_texts)
