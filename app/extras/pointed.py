"""A spring that is pointed at says its place x, compression u and line load q, beside their limits."""

from pathlib import Path
from typing import Any

import numpy as np
from bokeh.core.properties import Any as AnyValue
from bokeh.core.properties import Dict, String
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

from mdr_core.show.units import fitting
from mdr_core.solver.contact.yielding import yield_rule

from ..courses import Course, onset_depth
from ..extra import Extra, Service
from ..plot import View
from ..plots import Z

_SCRIPT = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")


class Springs(DataModel):
    """What a browser needs beside what is drawn, in the units of the plot."""

    springs = Dict(String, AnyValue, default={})


def caps(course: Course) -> np.ndarray:
    """Largest elastic compression (m) of springs in each state, or one for all; none if nothing yields."""
    scene, imprint = course.scene, course.initial_plastic_depth
    if scene.medium.q_c == np.inf:
        return np.empty(0)
    if scene.medium.inverse_to_radius:
        return np.array([scene.medium.critical_depth], float)
    rule, onset = yield_rule(scene.profile, scene.medium), onset_depth(scene, imprint)
    largest = np.maximum(np.maximum.accumulate(np.asarray(course.states.depth, float)), 0.0)
    # In an imprint a spring yields again with the compression at which it was unloaded.
    return np.where((imprint > 0) & (largest <= onset), onset - imprint, rule.cap(largest))


def told(view: View) -> dict[str, Any]:
    """Units, limits and stiffness of the springs of a view."""
    course, axis, limits = view.course, view.axis(Z), caps(view.course)
    modulus = course.scene.medium.E_star
    unit = fitting(modulus * float(np.max(limits, initial=0.0) or axis.end), "yield constant")
    return {
        "unit": axis.unit,
        "caps": [float(f"{value:.6g}") for value in limits / axis.factor],
        "cap": "<i>d</i><sub>c</sub>" if course.scene.medium.inverse_to_radius else "<i>u</i><sub>c</sub>",
        # The load of the dashpots is not drawn.
        "named": "<i>E* u</i>" if course.dashpots else "<i>q</i>",
        "load": modulus * axis.factor / unit.factor,
        "load_unit": unit.name,
    }


class Pointing(Service):
    """Tells the browser of a session what springs are like."""

    def __init__(self, page: Any):
        super().__init__(page)
        self.pointed = Springs(name="pointed")
        page.document.add_root(self.pointed)
        args = {"figure": page.layout.cards["springs"].picture.figure, "pointed": self.pointed}
        page.document.js_on_event(DocumentReady, CustomJS(args=args, code=_SCRIPT))

    def show(self, view: View) -> None:
        if (now := told(view)) != self.pointed.springs:
            self.pointed.springs = now


EXTRA = Extra("pointed", service=Pointing)
