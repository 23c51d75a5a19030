"""Look and box zoom of the figures of both pages."""

from typing import Any

import bokeh.models as bk
from bokeh.events import DoubleTap, PanEnd

from .ui import HERE, call

#: Outline of a canvas; linked sheets do not reach it.
_FOCUS = [".bk-Canvas { --highlight-color: var(--elastic); --outline-width: 2px; }"]
_TOOLS = [(HERE / "static" / "tools.css").read_text(encoding="utf-8")]


def set_look(figure: Any) -> None:
    """Give a figure and its axes the look of all plots; the style sheet sets the colours."""
    figure.update(background_fill_color=None, border_fill_color=None, outline_line_color=None)
    figure.stylesheets = _FOCUS
    figure.xgrid.visible = False
    figure.js_on_change("inner_width", bk.CustomJS(code=call("tidy", "cb_obj")))
    for axis in figure.axis:
        axis.update(minor_tick_line_color=None, major_tick_in=0, major_tick_out=4)
        axis.update(axis_label_text_font_style="normal", axis_label_text_font_size="12px")


def add_zoom(figure: Any) -> None:
    """Add a zoom to one box at a time; a button and a double click show the whole plot again."""
    figure.add_tools(bk.BoxZoomTool(description="Zoom to a box"), bk.ResetTool(description="Whole plot"))
    figure.update(toolbar_location="above", toolbar_inner=True)
    figure.toolbar.update(autohide=True, logo=None, active_drag=None, stylesheets=_TOOLS)
    figure.js_on_event(PanEnd, bk.CustomJS(code=call("end_box", "cb_obj")))
    figure.js_on_event(DoubleTap, bk.CustomJS(code=call("whole", "cb_obj")))
