"""The frame of the page: header, side with one part at a time, and the plots."""

from collections.abc import Callable
from functools import partial
from typing import Any

import panel as pn

from . import changes
from .extra import EXTRAS, Part
from .parts import Button, Parts, Text
from .plot import View
from .readouts import readings, table
from .ui import FULL, HERE, LAYOUT, WIDE, html, reveal, show


class Menu:
    """What the page is, and buttons that are seldom used."""

    def __init__(self, reset: Button, dark: Button):
        about = html((HERE / "static" / "about.html").read_text(encoding="utf-8"))
        self.view = pn.Column(Parts(reset, dark, classes=("bar",)), about, **WIDE)

    def show(self, view: View) -> None:
        """It is the same for all views."""


class Readings:
    """All numbers of the present state."""

    def __init__(self):
        self.view = html("", "all-numbers")

    def show(self, view: View) -> None:
        course = view.course
        show(self.view, object=table(course, readings(course), course.now))


class Frame:
    """Bar, parts of the side by name, each made when it is first opened, and the board."""

    def __init__(self, page: Any, preset: Any, form: Part, board: Any):
        self._view: View | None = None
        self.undo = Button("Undo", page.undo, "z")
        self.redo = Button("Redo", page.redo)
        self.reset = Button("Reset", lambda: page.apply(changes.reset))
        self.dark = Button("Dark", lambda: page.apply(changes.turn_dark), pressed=False)
        self._make: dict[str, Callable[[], Part]] = {
            "explore": lambda: form,
            "menu": lambda: Menu(self.reset, self.dark),
            "numbers": Readings,
        }
        self.parts: dict[str, Part] = {}
        self.tabs = {
            name: Button(label, partial(self._switch, name), pressed=False)
            for name, label in (("explore", "Explore"), ("menu", "Menu"), ("numbers", "All numbers"))
        }
        #: What extras have in the header.
        self.buttons: dict[str, Part] = {}
        in_header, in_side = [], [self.tabs["explore"]]
        for extra in EXTRAS.values():
            if extra.header:
                self.buttons[extra.name] = extra.header(page)
                in_header.append(self.buttons[extra.name].view)
            if extra.side:
                self.tabs[extra.name] = Button(extra.tab, partial(self._switch, extra.name), pressed=False)
                self._make[extra.name] = partial(extra.side, page)
                (in_header if extra.in_header else in_side).append(self.tabs[extra.name])
        title = Text("name", object="<h1>Indentation explorer</h1>")
        parts = (title, preset, self.undo, self.redo, *in_header, self.tabs["menu"])
        header = Parts(*parts, classes=("header", "bar"), stylesheets=LAYOUT)
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        self._side = pn.Column(Parts(*in_side, classes=("bar",)), **look)
        numbers = Parts(self.tabs["numbers"], classes=("bar",), sizing_mode=None)
        top = pn.Row(board.player.line, numbers, css_classes=["head", "top"], stylesheets=LAYOUT, **WIDE)
        self.warnings = html("", "lights")
        plots = (top, board.player.view, self.warnings, board.grid, board.tab_row)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        self.view = pn.Column(header, columns, css_classes=["page"], **FULL)
        self.open("explore")

    def part(self, name: str) -> Part:
        if name not in self.parts:
            self.parts[name] = self._make[name]()
        return self.parts[name]

    @staticmethod
    def _is_above(name: str) -> bool:
        return name in EXTRAS and EXTRAS[name].above

    def open(self, name: str) -> None:
        """Show a part of the side in the place of the present one, or above it."""
        part = self.part(name)
        if self._view is not None:
            part.show(self._view)
        reveal(self._side, part.view, True, 1 if self._is_above(name) else None)
        self.tabs[name].show(pressed=True)
        if self._is_above(name):
            return
        self.opened = name
        for other, each in self.parts.items():
            if other != name and not self._is_above(other):
                reveal(self._side, each.view, False)
                self.tabs[other].show(pressed=False)

    def _switch(self, name: str) -> None:
        """Open a part of the side, or close it."""
        if not self.tabs[name].pressed:
            self.open(name)
        elif self._is_above(name):
            reveal(self._side, self.parts[name].view, False)
            self.tabs[name].show(pressed=False)
        else:
            self.open("explore")

    def show(self, view: View) -> None:
        """Show a view in all parts that are seen."""
        self._view = view
        for each in self.buttons.values():
            each.show(view)
        for name, extra in EXTRAS.items():
            if extra.side:
                self.tabs[name].show(visible=extra.offered(view))
        if self.opened in EXTRAS and not EXTRAS[self.opened].offered(view):
            self.open("explore")
        for part in self.parts.values():
            if part.view.visible:
                part.show(view)
        self.dark.show(pressed=view.state.dark)
