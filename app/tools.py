"""Bokeh's box zoom and reset on a plot, seen while it is pointed at or has been touched."""

from typing import Any

import bokeh.models as bk
from bokeh.events import DoubleTap, PanEnd

from .ui import HERE, JS

_LOOK = [(HERE / "static" / "tools.css").read_text(encoding="utf-8")]


def add_zoom(figure: Any) -> None:
    """Let a figure be zoomed to one box at a time; its button and a double click show the whole plot."""
    figure.add_tools(bk.BoxZoomTool(description="Zoom to a box"), bk.ResetTool(description="Whole plot"))
    figure.update(toolbar_location="above", toolbar_inner=True)
    figure.toolbar.update(autohide=True, logo=None, active_drag=None, stylesheets=_LOOK)
    figure.js_on_event(PanEnd, bk.CustomJS(code=JS["once"]))
    figure.js_on_event(DoubleTap, bk.CustomJS(code=JS["whole"]))
