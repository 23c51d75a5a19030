"""Dragging of the indenter, and of the mark on the curve, in a page and in saved scenes."""

from pathlib import Path
from typing import Any

from bokeh.events import Pan, PanEnd, PanStart
from bokeh.models import CustomJS

from ..plot import View
from ..plots import D, F, Z

_HERE = Path(__file__).parent
#: Script of the gestures, and that of fingers, which drag a plot by its mark alone: it is given `figures`,
#: and as `dragging` the `path` and the `depth` that is asked for.
_DRAG = (_HERE / "drag.js").read_text(encoding="utf-8")
TOUCH = (_HERE / "touch.js").read_text(encoding="utf-8")
#: Plots that are dragged.
DRAGGED = ("springs", "force")


def path(view: View) -> dict[str, Any]:
    """Depth and force of all states in the units of the plots."""
    course, d, force = view.course, view.axis(D).factor, view.axis(F).factor
    found = {"d": course.states.depth / d, "F": course.states.force / force}
    found = {name: [float(f"{value:.6g}") for value in values] for name, values in found.items()}
    # A depth on a path that turns, or of an impact, is not one that can be set.
    pressing = not course.turns and course.hit is None
    return found | {"unit": d / view.axis(Z).factor, "pressing": pressing}


def let_drag(figure: Any) -> None:
    """Let a figure be dragged."""
    for event in (PanStart, Pan, PanEnd):
        figure.js_on_event(event, CustomJS(code=_DRAG))
