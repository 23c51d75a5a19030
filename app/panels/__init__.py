"""The frame of the page: header, side with the form and its panels, plots."""

from typing import Any

import panel as pn

from ..ui import FULL, HERE, STYLE, WIDE, button, html, reveal, show, toggle, tools

#: Parts of the side, of which one is shown: label and key of each.
_PARTS = {
    "explore": ("Explore", "x"),
    "fit": ("Fit a measurement", "f"),
    "held": ("Held", "j"),
    "share": ("Share", "t"),
    "menu": ("Menu", "m"),
    "numbers": ("All numbers", "b"),
}


class Frame:
    """The whole page: buttons, parts of the side by name, the guide above them, and the board."""

    def __init__(self, preset: Any, guide: Any, board: Any, parts: dict[str, Any]):
        self.undo, self.redo, self.reset = button("Undo", "z"), button("Redo", "y"), button("Reset", "r")
        self.hold, self.guide, self.dark = toggle("Hold", "h"), toggle("Guide", "g"), toggle("Dark", "d")
        self.numbers, self.warnings = html("", "all-numbers"), html("", "lights")
        about = html((HERE / "static" / "about.html").read_text(encoding="utf-8"))
        menu = pn.Column(tools(self.reset, self.dark), about, **WIDE)
        self._parts = parts | {"menu": menu, "numbers": self.numbers}
        self.tabs = tabs = {name: toggle(*text) for name, text in _PARTS.items()}
        title = html("<h1>Indentation explorer</h1>", "name", width=190, sizing_mode=None)
        six = (self.undo, self.redo, self.hold, tabs["share"], self.guide, tabs["menu"])
        buttons = pn.Row(*six, css_classes=["tools", "buttons"], margin=0, width=380)
        header = pn.Row(title, preset, buttons, css_classes=["header"], stylesheets=STYLE, **WIDE)
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        # The buttons of the menu have keys.
        self._side = pn.Column(tools(tabs["explore"], tabs["fit"], tabs["held"]), menu, **look)
        texts = map(pn.pane.Bokeh, (board.player.heads, board.player.readout))
        line = pn.Column(*texts, css_classes=["line"], **WIDE)
        top = pn.Row(line, tabs["numbers"], css_classes=["head", "top"], stylesheets=STYLE, **WIDE)
        plots = (top, board.player.view, self.warnings, board.grid, board.tab_row)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        self.view = pn.Column(header, columns, css_classes=["page"], **FULL)
        for name, tab in tabs.items():
            tab.param.watch(lambda event, name=name: self._switched(name, event.new), "value")
        self.guide.param.watch(lambda event: reveal(self._side, guide, event.new, 1), "value")
        self.show("explore")

    def show(self, name: str) -> None:
        """Show a part of the side."""
        self.shown = name
        for each, tab in self.tabs.items():
            show(tab, value=each == name)
            reveal(self._side, self._parts[each], each == name)

    def _switched(self, name, on):
        if on or name == self.shown:
            self.show(name if on else "explore")
