"""The frame of the page: header, side with one part at a time, and the plots."""

from functools import partial
from typing import Any

import panel as pn

from . import changes
from .extra import EXTRAS, Extra, Part
from .parts import Button, Parts, Text
from .plot import View
from .readouts import readings, table
from .ui import FULL, HERE, LAYOUT, WIDE, html, reveal, show


class Menu:
    """What the page is, and what is seldom used."""

    def __init__(self, page: Any):
        self._dark = Button("Dark", lambda: page.apply(changes.turn_dark), pressed=False)
        about = html((HERE / "static" / "about.html").read_text(encoding="utf-8"))
        self.view = pn.Column(Parts(self._dark, classes=("bar",)), about, **WIDE)

    def show(self, view: View) -> None:
        self._dark.show(pressed=view.state.dark)


class Readings:
    """All numbers of the present state."""

    def __init__(self, page: Any):
        self.view = html("", "all-numbers")

    def show(self, view: View) -> None:
        course = view.course
        show(self.view, object=table(course, readings(course), course.now))


#: What the page itself has in the side, before and after its extras.
_EXPLORE = Extra("explore", tab="Explore", side=lambda page: page.form)
_MENU = Extra("menu", tab="Menu", place="header", side=Menu)
_NUMBERS = Extra("numbers", tab="All numbers", place="line", side=Readings)


class Frame:
    """Header, parts of the side by name, each made when it is first opened, and the board."""

    def __init__(self, page: Any):
        self._page, self._view = page, None
        self._offers = {each.name: each for each in (_EXPLORE, *EXTRAS.values(), _MENU, _NUMBERS)}
        #: Parts that have been opened, buttons that open them, and what extras have in the header.
        self.parts: dict[str, Part] = {}
        self.tabs: dict[str, Button] = {}
        self.buttons: dict[str, Part] = {}
        self.undo, self.redo = Button("Undo", page.undo, "z"), Button("Redo", page.redo)
        rows = {"header": [self.undo, self.redo], "side": [], "line": []}
        for name, each in self._offers.items():
            if each.header:
                self.buttons[name] = each.header(page)
                rows["header"].append(self.buttons[name].view)
            if each.side:
                key = "escape" * (each.place != "side")
                self.tabs[name] = Button(each.tab, partial(self._switch, name), key, pressed=False)
                rows[each.place].append(self.tabs[name])
        title, board = Text("name", object="<h1>Indentation explorer</h1>"), page.board
        parts = (title, page.choices.part("preset"), *rows["header"])
        header = Parts(*parts, classes=("header", "bar"), stylesheets=LAYOUT)
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        self._side = pn.Column(Parts(*rows["side"], classes=("bar",)), **look)
        line = board.player.heads, board.player.words, *rows["line"]
        top = Parts(*line, classes=("top",), stylesheets=LAYOUT)
        self.below = html("", "lights")
        plots = (top, board.player.view, self.below, board.grid, board.tab_row)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        self.view = pn.Column(header, columns, css_classes=["page"], **FULL)
        self.open("explore")

    def open(self, name: str) -> None:
        """Show a part: in the side in the place of the present one, above it, or over the plots."""
        if name not in self.parts:
            self.parts[name] = self._offers[name].side(self._page)
        if self._view is not None:
            self.parts[name].show(self._view)
        if not self._offers[name].above:
            self.opened = name if self._in_side(name) else self.opened
            for other in self.parts:
                if other != self.opened and not self._offers[other].above:
                    self._reveal(other, False)
        self._reveal(name, True)

    def _in_side(self, name):
        return self._offers[name].above or self._offers[name].place == "side"

    def _reveal(self, name, visible):
        column = self._side if self._in_side(name) else self.view
        reveal(column, self.parts[name].view, visible, 1 if self._offers[name].above else None)
        self.tabs[name].show(pressed=visible)

    def _switch(self, name):
        """Open a part, or close it."""
        if not self.tabs[name].pressed:
            self.open(name)
        elif self._offers[name].above or not self._in_side(name):
            self._reveal(name, False)
        else:
            self.open("explore")

    def show(self, view: View) -> None:
        """Show a view in all parts that are seen."""
        self._view = view
        for each in self.buttons.values():
            each.show(view)
        for name, tab in self.tabs.items():
            tab.show(visible=self._offers[name].offered(view))
        if not self._offers[self.opened].offered(view):
            self.open("explore")
        for part in self.parts.values():
            if part.view.visible:
                part.show(view)
