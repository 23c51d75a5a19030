"""Drags of the indenter and of the mark on the curve; and tooltips of the springs."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from bokeh.core.properties import Any as AnyValue
from bokeh.core.properties import Dict, String
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

import mdr_core as mdr
from mdr_core.show.figures import mark
from mdr_core.show.units import fitting
from mdr_core.solver.contact.yielding import yield_rule

from ...common.quantities import QUANTITIES
from ...common.ui import call
from ..changes import shown
from ..courses import Course, onset_depth
from ..drives import DRIVES, scene_of
from ..extra import Extra, Service
from ..plot import Overlay, View
from ..plots import DRAGGED, Z, drag_path, enable_drag
from ..state import State, checked, medium

#: Script of the tooltip of a spring; its arguments are the `figure` and the `SpringModel` `pointed`.
_SPRING = Path(__file__).with_name("pointer_spring.js").read_text(encoding="utf-8")


class DragModel(DataModel):
    """Depth and force of each state, and the wanted depth of a drag, in the units of the plot."""

    #: Text is faster: Bokeh would check each number.
    path = String(default="{}")
    depth = AnyValue(default=None)


class SpringModel(DataModel):
    """Data for the tooltips of springs, in the units of the plot."""

    springs = Dict(String, AnyValue, default={})


class Pointer(Service):
    """Service for drags in the plots, and for the spring data in the browser."""

    def __init__(self, page: Any):
        super().__init__(page)
        figures = {name: page.layout.cards[name].picture.figure for name in DRAGGED}
        for figure in figures.values():
            enable_drag(figure)
        self.drag, self.springs = DragModel(name="dragging"), SpringModel(name="pointed")
        self.drag.on_change("depth", self._dragged)
        scripts = (
            (call("touch", "figures", "dragging"), {"figures": [*figures.values()], "dragging": self.drag}),
            (_SPRING, {"figure": figures["springs"], "pointed": self.springs}),
        )
        for model in (self.drag, self.springs):
            page.document.add_root(model)
        for code, args in scripts:
            page.document.js_on_event(DocumentReady, CustomJS(args=args, code=code))

    def _dragged(self, attr, old, new):
        if isinstance(new, int | float):
            depth = new * self.page.view.axis(Z).factor
            self.page.apply(lambda state: press_to(state, depth), mark="hand")
            self.drag.depth = None

    def show(self, view: View) -> None:
        self.drag.path = json.dumps(drag_path(view))
        if (now := spring_data(view)) != self.springs.springs:
            self.springs.springs = now


def press_to(state: State, depth: float) -> State:
    """Press to a depth (m)."""
    depth = QUANTITIES["max_depth"].bounded(depth)
    pressed = mdr.indent(scene_of(state).profile, medium(state), depth)
    numbers = DRIVES[state.drive].equivalent(state, pressed)
    numbers = {name: checked(name, shown(value)) for name, value in numbers.items()}
    return state.replace(at=1.0, **numbers)


def handle(view: View, i: int) -> dict:
    """Return a handle at the rim of the contact, or at the tip without contact."""
    state = view.course.states[i]
    a = float(state.contact_radius)
    height = float(state.live_interval.upper) if a > 0 else 0.0
    return {"handle": (np.array([a]), np.array([height - float(state.depth)]))}


def caps(course: Course) -> np.ndarray:
    """Return the largest elastic compression (m) of springs in each state, or one for all, or none."""
    scene, imprint = course.scene, course.initial_plastic_depth
    if scene.medium.q_c == np.inf:
        return np.empty(0)
    if scene.medium.inverse_to_radius:
        return np.array([scene.medium.critical_depth], float)
    rule, onset = yield_rule(scene.profile, scene.medium), onset_depth(scene, imprint)
    largest = np.maximum(np.maximum.accumulate(np.asarray(course.states.depth, float)), 0.0)
    # In an imprint a spring yields again at the compression before unloading.
    return np.where((imprint > 0) & (largest <= onset), onset - imprint, rule.cap(largest))


def spring_data(view: View) -> dict[str, Any]:
    """Return units, limits and stiffness of the springs of a view."""
    course, axis, limits = view.course, view.axis(Z), caps(view.course)
    modulus = course.scene.medium.E_star
    unit = fitting(modulus * float(np.max(limits, initial=0.0) or axis.end), "yield constant")
    return {
        "unit": axis.unit,
        "caps": [float(f"{value:.6g}") for value in limits / axis.factor],
        "cap": "<i>d</i><sub>c</sub>" if course.scene.medium.inverse_to_radius else "<i>u</i><sub>c</sub>",
        # The plot omits the load of the dashpots.
        "named": "<i>E* u</i>" if course.dashpots else "<i>q</i>",
        "load": modulus * axis.factor / unit.factor,
        "load_unit": unit.name,
    }


EXTRA = Extra(
    "pointer",
    overlays=(Overlay("springs", (mark("handle", legend=False),), handle),),
    notes=lambda view: {"first": "You can also drag the indenter by ●."},
    service=Pointer,
)
