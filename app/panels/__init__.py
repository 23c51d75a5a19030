"""The frame of the page: header, left column with tabs, right column with plots."""

from collections.abc import Callable
from typing import Any

import panel as pn

from ..ui import FULL, HERE, STYLE, WIDE, button, html, show, toggle, tools


class Frame:
    """Six buttons, tabs on the left, panels over them; `share` is called when that panel opens."""

    def __init__(self, preset: Any, panels: dict, tabs: dict, share: Callable[[], None]):
        self.undo, self.redo, self.hold = button("Undo", "z"), button("Redo", "y"), toggle("Hold", "h")
        self.reset, self.dark, self.all = (
            button("Reset", "r"),
            toggle("Dark", "d"),
            toggle("All numbers", "b"),
        )
        self.open = {
            "share": toggle("Share", "t"),
            "guide": toggle("Guide", "g"),
            "menu": toggle("Menu", "m"),
        }
        texts = {"explore": ("Explore", "x"), "fit": ("Fit a measurement", "f"), "held": ("Held", "j")}
        self.tabs = {name: toggle(*text) for name, text in texts.items()}
        self.numbers, self.warnings = html("", "all-numbers", visible=False), html("", "lights")
        about = html((HERE / "static" / "about.html").read_text(encoding="utf-8"))
        menu = pn.Column(tools(self.reset, self.dark), about, visible=False, **WIDE)
        self._panels, self._tabs = panels | {"menu": menu, "numbers": self.numbers}, tabs
        self._share, self.tab = share, "explore"
        self._preset = preset
        self.open["numbers"] = self.all
        for name, tab in self.tabs.items():
            tab.param.watch(lambda event, name=name: self._tabbed(name, event.new), "value")
        for name, each in self.open.items():
            each.param.watch(lambda event, name=name: self._opened(name, event.new), "value")
        self.show("explore")

    def framed(self, board: Any) -> pn.Column:
        title = html("<h1>Indentation explorer</h1>", "name", width=190, sizing_mode=None)
        six = (self.undo, self.redo, self.hold, *(self.open[name] for name in ("share", "guide", "menu")))
        buttons = pn.Row(*six, css_classes=["tools", "buttons"], margin=0, width=380)
        header = pn.Row(title, self._preset, buttons, css_classes=["header"], stylesheets=STYLE, **WIDE)
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        tabs = pn.Row(*self.tabs.values(), css_classes=["tools", "tabs"], **WIDE)
        side = pn.Column(tabs, *self._panels.values(), *self._tabs.values(), **look)
        texts = map(pn.pane.Bokeh, (board.player.heads, board.player.readout))
        line = pn.Column(*texts, css_classes=["line"], **WIDE)
        top = pn.Row(line, self.all, css_classes=["head", "top"], stylesheets=STYLE, **WIDE)
        parts = (top, board.player.view, self.warnings, board.grid, board.tab_row)
        columns = pn.Row(
            side, pn.Column(*parts, css_classes=["results"], **FULL), css_classes=["columns"], **FULL
        )
        return pn.Column(header, columns, css_classes=["page"], **FULL)

    def show(self, tab: str, panel: str | None = None) -> None:
        """Show a tab or a panel over it; the guide stands above the tab."""
        self.tab, free = tab, panel in (None, "guide")
        for name, each in self.tabs.items():
            show(each, value=free and name == tab)
            show(self._tabs[name], visible=free and name == tab)
        for name, each in self.open.items():
            show(each, value=name == panel)
            show(self._panels[name], visible=name == panel)
        if panel == "share":
            self._share()

    def _tabbed(self, name, on):
        if on:
            self.show(name, "guide" if self.open["guide"].value else None)
        elif self.tab == name and not any(each.value for each in self.open.values()):
            show(self.tabs[name], value=True)

    def _opened(self, name, on):
        if on or not any(each.value for each in self.open.values()):
            self.show(self.tab, name if on else None)
