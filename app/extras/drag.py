"""The indenter is dragged to another depth, or it and the mark on the curve to another state."""

import json
from typing import Any

import numpy as np
from bokeh.core.properties import Any as AnyValue
from bokeh.core.properties import String
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

import mdr_core as mdr
from mdr_core.show.figures import mark

from ..changes import shown
from ..drives import DRIVES, scene_of
from ..extra import Extra, Service
from ..plot import Overlay, View
from ..plots import Z
from ..quantities import QUANTITIES
from ..shared.dragging import DRAGGED, TOUCH, let_drag, path
from ..state import State, checked, medium


class Hand(DataModel):
    """Depth and force of each state, and the depth that the indenter is dragged to (unit of the plot)."""

    #: As text: Bokeh would look at each number.
    path = String(default="{}")
    depth = AnyValue(default=None)


class Dragging(Service):
    """Lets a person drag in the plots of a page."""

    def __init__(self, page: Any):
        super().__init__(page)
        self.hand = Hand(name="dragging")
        self.hand.on_change("depth", self._dragged)
        figures = [page.layout.cards[name].picture.figure for name in DRAGGED]
        for figure in figures:
            let_drag(figure)
        page.document.add_root(self.hand)
        args = {"figures": figures, "dragging": self.hand}
        page.document.js_on_event(DocumentReady, CustomJS(args=args, code=TOUCH))

    def _dragged(self, attr, old, new):
        if isinstance(new, int | float):
            depth = new * self.page.shown.axis(Z).factor
            self.page.apply(lambda state: press_to(state, depth), mark="hand")
            self.hand.depth = None

    def show(self, view: View) -> None:
        self.hand.path = json.dumps(path(view))


def press_to(state: State, depth: float) -> State:
    """Press to a depth (m)."""
    depth = QUANTITIES["max_depth"].bounded(depth)
    pressed = mdr.indent(scene_of(state).profile, medium(state), depth)
    numbers = DRIVES[state.drive].equivalent(state, pressed)
    numbers = {name: checked(name, shown(value)) for name, value in numbers.items()}
    return state.replace(at=1.0, **numbers)


def handle(view: View, i: int) -> dict:
    """A handle at the rim of the contact, or without contact at the tip."""
    state = view.course.states[i]
    a = float(state.contact_radius)
    height = float(state.live_interval.upper) if a > 0 else 0.0
    return {"handle": (np.array([a]), np.array([height - float(state.depth)]))}


EXTRA = Extra(
    "drag",
    overlays=(Overlay("springs", (mark("handle", legend=False),), handle),),
    notes=lambda view: {"first": "Or drag the indenter by ●."},
    service=Dragging,
)
