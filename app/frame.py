"""The frame of the page: header, side with one part at a time, and the plots."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import panel as pn

from . import readouts
from .extra import EXTRAS, Extra, Side
from .fields import Form
from .parts import Part, Parts, button, text
from .player import player
from .plot import View
from .state import State
from .ui import FULL, LAYOUT, html, show

_TITLE = text("name", "<h1>Indentation explorer</h1>", "name")


def _turned(state: State) -> State:
    """Dark instead of light, or back."""
    return state.replace(dark=not state.dark)


class Frame:
    """Header, parts of the side by name, each made when it is first opened, and the board."""

    def __init__(self, page: Any):
        self._page, self.form = page, Form(page)
        explore = Extra("explore", tab="Explore", side=lambda page: self.form)
        self._offers = {each.name: each for each in (explore, *EXTRAS.values())}
        #: Parts that have been made, and names of those that are open, one in each place.
        self.parts: dict[str, Side] = {"explore": self.form}
        self.opened = {"side": "explore"}
        self.header = Parts("header", "bar", stylesheets=LAYOUT)
        self.tabs = Parts("bar", "sides", stylesheets=LAYOUT)
        self.line = Parts("top", stylesheets=LAYOUT)
        self.player = Parts("player", stylesheets=LAYOUT)
        self.below = html("", "lights")
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        self._side = pn.Column(self.tabs, self.form.view, **look)
        board = page.board
        plots = (self.line, self.player, self.below, board.grid, board.tabs)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        self.view = pn.Column(self.header, columns, css_classes=["page"], **FULL)

    def toggle(self, name: str) -> None:
        """Open a part in the place of another one, or close it; one in the side uncovers the plots."""
        place = self._offers[name].place
        if name not in self.parts:
            part = self.parts[name] = self._offers[name].side(self._page)
            column = self.view if place == "over" else self._side
            column.insert(1 if place == "above" else len(column), part.view)
        if self.opened.pop(place, None) != name:
            self.opened[place] = name
        if place == "side":
            self.opened.pop("over", None)
        self._page.refresh()

    def show(self, view: View) -> None:
        """Show a view in all parts that are open."""
        opened = self.opened.items()
        self.opened = {place: name for place, name in opened if self._offers[name].offered(view)}
        self.opened.setdefault("side", "explore")
        page = self._page
        undo = button("Undo", page.undo, disabled=page.history.at == 0, key="z")
        redo = button("Redo", page.redo, disabled=page.history.at + 1 == len(page.history.states))
        dark = button("Dark", partial(page.apply, _turned), pressed=view.state.dark)
        buttons = self._buttons(view, "above", "over")
        self.header.show([_TITLE, page.choice("preset"), undo, redo, *buttons, dark])
        self.tabs.show([*self._buttons(view, "side")])
        numbers = readouts.line(view.course)
        heads = text("heads", readouts.heads(numbers), "heads")
        page.messages.words = readouts.values(numbers, view.course.now)
        self.line.show([heads, Part("words", "words", {})])
        self.player.show([player(view, page.move)])
        for name, part in self.parts.items():
            show(part.view, visible=name in self.opened.values())
            if part.view.visible:
                part.show(view)

    def _buttons(self, view: View, *places: str) -> Iterator[Part]:
        """Buttons that open parts, and what else extras have in the header."""
        for name, each in self._offers.items():
            if "over" in places and (part := each.header(self._page, view)):
                yield part
            if each.side and each.place in places and each.offered(view):
                key, pressed = "" if each.place == "side" else "escape", name in self.opened.values()
                yield button(each.tab, partial(self.toggle, name), pressed, key=key)

    def rest(self, view: View) -> None:
        """Show texts that wait while a slider moves, because a changed one causes a new layout."""
        show(self.below, object="".join(extra.notes(view).get("below", "") for extra in EXTRAS.values()))
