"""The frame of the page: header, side with one part at a time, and the plots."""

from functools import partial
from typing import Any

import panel as pn
from markupsafe import Markup

from . import readouts
from .extra import EXTRAS, Side
from .fields import Form
from .parts import Part, Parts, button, text
from .player import player
from .plot import View
from .state import State
from .ui import FULL, LAYOUT, WIDE, as_html, html, show

#: Roles and names of the parts of the page, by their classes.
LANDMARKS = {
    "above": ("banner", "Preset and tools"),
    "side": ("complementary", "Drive, indenter and medium"),
    "results": ("main", "Numbers and plots"),
    "share": ("region", "Share"),
}
_TITLE = text("name", Markup("<h1>Indentation explorer</h1>"), "name")


def _turned(state: State) -> State:
    """Dark instead of light, or back."""
    return state.replace(dark=not state.dark)


class Frame:
    """Header, side and plots; parts of extras by name, each made when it is first opened."""

    def __init__(self, page: Any):
        self._page, self.form = page, Form(page)
        #: Parts that have been made, and the name of the one that is open in each place.
        self.parts: dict[str, Side] = {}
        self.opened: dict[str, str] = {}
        # On a phone what is less often used is below the plots.
        self.header = Parts("header", stylesheets=LAYOUT)
        self.more = Parts("more", stylesheets=LAYOUT)
        self.line = Parts("top", stylesheets=LAYOUT)
        self.player = Parts("player", stylesheets=LAYOUT)
        self.below = html("", "lights")
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        self._side = pn.Column(self.form.view, **look)
        plots = (self.line, self.player, self.below, page.board.grid)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        head = pn.Row(self.header, self.more, css_classes=["above"], **WIDE | {"stylesheets": LAYOUT})
        self.view = pn.Column(head, columns, css_classes=["page"], **FULL)

    def toggle(self, name: str) -> None:
        """Open a part in the place of another one, or close it."""
        place = EXTRAS[name].place
        if self.opened.pop(place, None) != name:
            self._open(name)
        self._page.refresh()

    def _open(self, name: str) -> None:
        place = EXTRAS[name].place
        if name not in self.parts:
            part = self.parts[name] = EXTRAS[name].side(self._page)
            column = self.view if place == "over" else self._side
            column.insert(len(column) if place == "over" else 0, part.view)
        self.opened[place] = name

    def show(self, view: View) -> None:
        """Show a view in all parts that are open."""
        offered = {name for name, each in EXTRAS.items() if each.side and each.offered(view)}
        self.opened = {place: name for place, name in self.opened.items() if name in offered}
        for name in offered:
            if EXTRAS[name].place == "top":
                self._open(name)
        page = self._page
        # There is nothing to undo on a first visit, and no button for it.
        undo = [button("Undo", page.undo, key="z")] * (page.history.at > 0)
        redo = [button("Redo", page.redo)] * (page.history.at + 1 < len(page.history.states))
        opening = [self._button(name) for name, each in EXTRAS.items() if name in offered and each.tab]
        self.form.show(view)
        preset = page.choice("preset")
        # What it is, and its sources, are told in the form.
        preset.look["about"] = ""
        self.header.show([_TITLE, preset, *undo, *redo, *opening])
        dark = button("Dark", partial(page.apply, _turned), pressed=view.state.dark)
        more = (each.header(page, view) for each in EXTRAS.values())
        self.more.show([*filter(None, more), dark])
        numbers = readouts.line(view.course)
        heads = text("heads", readouts.heads(numbers), "heads")
        page.messages.words = as_html(readouts.values(numbers, view.course.now))
        self.line.show([heads, Part("words", "words", {})])
        self.player.show([player(view, page.move), page.board.others(view)])
        for name, part in self.parts.items():
            show(part.view, visible=name in self.opened.values())
            if part.view.visible:
                part.show(view)

    def _button(self, name: str) -> Part:
        """The button that opens a part."""
        pressed = name in self.opened.values()
        return button(EXTRAS[name].tab, partial(self.toggle, name), pressed, key="escape")

    def rest(self, view: View) -> None:
        """Show texts that wait while a slider moves, because a changed one causes a new layout."""
        found = (extra.notes(view).get("below") for extra in EXTRAS.values())
        show(self.below, object=Markup("").join(made() for made in found if made))
