"""The board on the right: plots in frames with title, formula and legend, and their tabs."""

from functools import partial
from typing import Any

import panel as pn

from .draw import Picture, drawn, legend, picture_of
from .extra import EXTRAS
from .parts import Parts, button, text
from .plot import Plot, View
from .plots import NAMED, PLOTS, visible
from .ui import FULL, html, linked, reveal, show

#: Plots that share the axis x of another one.
_SAME_X = {"pressure": "springs"}


class Card:
    """A plot in its frame: title, formula, legend, what extras have above it, and a note below."""

    def __init__(self, plot: Plot, page: Any):
        self.plot, self.picture, self._page, self._legend = plot, picture_of(plot), page, {}
        self.head, self.controls = Parts("heading"), Parts("above")
        self.note = html("", "note", "found")
        parts = [self.head, *[self.controls] * bool(plot.controls)]
        parts.append(pn.pane.Bokeh(self.picture.figure, **FULL))
        self.view = pn.Column(*parts, css_classes=["card", plot.name], **FULL)

    def show(self, columns: dict, view: View) -> None:
        """Draw columns made for a view."""
        plot, course = self.plot, view.course
        self.picture.show(columns, view, view.state.dark)
        rows = drawn(view, plot, {course.now, course.peak})
        # What is cut off by axes that stay leaves no gap: the plot would move while it is dragged.
        self._legend = (self._legend if "axes" in view.computed else {}) | rows

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plot."""
        plot, page = self.plot, self._page
        formula = f"<h3>{plot.title}</h3>{linked(plot.formula_of(view.course))}"
        above = [each.on_plots(page, plot, view) for each in EXTRAS.values()]
        key = text("key", legend(plot, self._legend), "key")
        self.head.show([text("formula", formula, "formula"), *filter(None, above), key])
        self.controls.show([page.choice(name) for name in plot.controls])
        note = plot.note_of(view)
        show(self.note, object=note)
        reveal(self.view, self.note, bool(note))


class Board:
    """All plots of a session: a card is made when it is seen for the first time, and stays."""

    def __init__(self, page: Any):
        self._page, self.cards = page, {}
        self.tabs = Parts("bar", "tabs")
        self.grid = pn.Column(css_classes=["plots"], **FULL)
        for name in NAMED:
            self._make(name)

    def _make(self, name):
        card = self.cards[name] = Card(PLOTS[name], self._page)
        figure = card.picture.figure
        if name in _SAME_X:
            figure.x_range = self.cards[_SAME_X[name]].picture.figure.x_range
        self.grid.append(card.view)

    def columns(self, view: View) -> dict[str, dict]:
        """Columns of all plots that are seen, by their names; nothing on the page is changed."""
        names = [plot.name for plot in visible(view)]
        for name in names:
            if name not in self.cards:
                self._make(name)
        now, dark = view.course.now, view.state.dark
        return {name: self.cards[name].picture.columns(view, now, dark) for name in names}

    def show(self, columns: dict[str, dict], view: View) -> None:
        """Draw columns made for a view, on the plots that they are of."""
        for name, data in columns.items():
            self.cards[name].show(data, view)
        for name, card in self.cards.items():
            show(card.view, visible=name in columns)
        count = len(columns) - len(NAMED)
        show(self.grid, css_classes=["plots", f"with-{min(count, 2)}"])

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plots that are seen, and the tabs that apply."""
        for card in self.seen():
            card.show_parts(view)
        tabs = (plot for plot in PLOTS.values() if plot.tab and plot.applies(view))
        self.tabs.show(
            [
                button(plot.tab, partial(self._asked, plot.name), pressed=plot.name in view.state.tiles)
                for plot in tabs
            ]
        )

    def _asked(self, name: str) -> None:
        """Show an optional plot alone, or no longer."""

        def change(state):
            others = tuple(tile for tile in state.tiles if tile != name)
            return state.replace(tiles=others if name in state.tiles else (name,))

        self._page.apply(change)

    def seen(self) -> list[Card]:
        """The cards that are seen."""
        return [card for card in self.cards.values() if card.view.visible]

    def pictures(self) -> list[Picture]:
        """The pictures that are seen."""
        return [card.picture for card in self.seen()]
