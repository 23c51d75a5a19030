"""Notes in the form: formulas of the shape, the law of the hardness, the energy, sources of a preset."""

from functools import cache
from math import atan, degrees

import numpy as np
from markupsafe import Markup

from mdr_core.show.units import digits, written

from ..courses import Course, onset_depth
from ..extra import Extra
from ..plot import View
from ..shared.summary import with_symbol
from ..state import PRESETS, altered
from ..ui import linked, marked

#: Standard acceleration of free fall (m/s²).
_GRAVITY = 9.80665


def notes(view: View) -> dict[str, str]:
    """Notes (HTML) by the places of the form."""
    state, course = view.state, view.course
    shape, made = state.chosen("shape"), course.scene.medium
    head = "Altered. " * bool(altered(state)) + "Where the preset's numbers come from, "
    head += "and which of them are illustrative:"
    energy = written(state.mass * state.speed**2 / 2, "energy")
    height = written(state.speed**2 / (2 * _GRAVITY), "length")
    slope = getattr(course.scene.profile, "slope", None)
    angle = f"Half-angle {digits(degrees(atan(1 / slope)))}°" if slope else ""
    of_tip = state.tip_note if state.shape == "sampled" else angle
    eta, tau = written(made.eta, "viscosity"), written(made.relaxation_time, "time")
    idle = "" if course.dashpots else "; no effect here, where pressing is quasi-static"
    return {
        "drive": f"Energy {energy}; equivalent drop height {height}" * (state.drive == "impact"),
        "shape": Markup("<figcaption>{}<br>{}</figcaption>{}").format(
            marked(shape.height), marked(shape.reduced), marked(of_tip)
        ),
        "medium": marked(law_of_hardness(course)),
        "more": linked(f"η = {eta}, τ = 4η/E* = {tau} (1){idle}") if made.eta > 0 else "",
        "sources": Markup("<p>{}</p><dl>{}</dl>").format(head, _sources(state.preset)),
    }


@cache
def _sources(preset: str) -> Markup:
    """Numbers of a preset, and where each comes from."""
    known = PRESETS[preset]
    row = Markup("<dt>{}</dt><dd>{}</dd>")
    symbols = (marked(with_symbol(name, known.values[name])) for name in known.sources)
    return Markup("").join(map(row.format, symbols, known.sources.values()))


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
    if imprint := course.initial_plastic_depth:
        starts = (
            f"Over the imprint yield goes on at d = {written(onset_depth(course.scene, imprint), 'length')}"
        )
    elif onset == np.inf:
        starts = "Nothing yields under this shape: H is too large"
    elif onset == 0:
        starts = "Yield starts at first contact, d_y = 0"
    return f"σ_c = {law} = {hardness}{place}. {starts} " + ("(19)" if made.inverse_to_radius else "§ 20")


EXTRA = Extra("form_notes", notes=notes)
