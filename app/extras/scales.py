"""The button *Keep scales*: the axes of the three plots stay, as they do while something is dragged."""

from pathlib import Path
from typing import Any

import numpy as np
from bokeh.core.properties import Bool
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

from mdr_core.show.figures import label
from mdr_core.show.units import written

from ..courses import Course
from ..extra import Extra, Service
from ..parts import Part, button
from ..plot import Overlay, View
from ..plots import NAMED, PLOTS, D, F, R, X, Z
from ..state import State

_SCRIPT = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
#: What may leave each plot, of its axes, and where that is said: a share of the upright axis.
_PLOTS = {
    "springs": ((X, "contact_radius", "a"), (Z, "depth", "d"), 0.97),
    "pressure": ((R, "contact_radius", "a"), 0.86),
    "force": ((D, "depth", "d"), (F, "force", "F"), 0.97),
}


class Dragged(DataModel):
    """Whether something is being dragged in the browser."""

    on = Bool(False)


class Scales(Service):
    """Keeps the axes of the three plots until the drive or the preset changes."""

    def __init__(self, page: Any):
        super().__init__(page)
        self._kept, self.dragged = False, Dragged()
        page.document.add_root(self.dragged)
        script = CustomJS(args={"dragged": self.dragged}, code=_SCRIPT)
        page.document.js_on_event(DocumentReady, script)
        self.dragged.on_change("on", self._released)

    def _released(self, attr, old, new):
        if not new and self._kept:
            self.page.draw(self.page.state)

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        shown = self.page.shown
        self._kept = shown is not None and bool(state["scales.keep"] or self.dragged.on)
        if not self._kept or any(state[name] != shown.state[name] for name in ("preset", "drive")):
            return {}
        return {"axes": {along: shown.axis(along) for name in NAMED for along in PLOTS[name].axes}}


def keep(page: Any, view: View) -> Part:
    """The button *Keep scales*."""
    return button("Keep scales", lambda: page.apply(toggle), pressed=bool(view.state["scales.keep"]))


def toggle(state: State) -> State:
    return state.replace(**{"scales.keep": None if state["scales.keep"] else "1"})


def beyond(view: View, plot: str, i: int) -> str:
    """What leaves kept axes: in state i, of the plot of the force on the whole path."""
    found, states = [], view.course.states if plot == "force" else view.course.states[i]
    for along, name, symbol in _PLOTS[plot][:-1]:
        axis, values = view.axis(along), getattr(states, name)
        high = -axis.start if along is Z else axis.end
        low = axis.start if along in (D, F) else -np.inf
        for value in (float(np.min(values)), float(np.max(values))):
            if not low - 1e-9 * high <= value <= (1 + 1e-9) * high:
                found.append(f"{symbol} = {written(value, along.kind, 3)}")
    return f"cut off: {', '.join(dict.fromkeys(found))}" if found else ""


def _overlay(plot: str) -> Overlay:
    def places(view: View, i: int) -> dict:
        if "axes" not in view.computed:
            return {}
        x, y = (view.axis(along) for along in PLOTS[plot].axes)
        left = x.start + 0.015 * (x.end - x.start)
        return {"cut off": (left, _PLOTS[plot][-1] * y.end, beyond(view, plot, i))}

    return Overlay(plot, (label("cut off"),), places)


EXTRA = Extra(
    "scales",
    order=5,
    values={"scales.keep": None},
    of_view=("scales.keep",),
    overlays=tuple(map(_overlay, _PLOTS)),
    header=keep,
    service=Scales,
)
