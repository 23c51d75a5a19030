"""The board on the right: plots in frames with title, formula and legend, and their tabs."""

from functools import partial
from typing import Any

import panel as pn

from .draw import drawn, legend, picture_of
from .extra import EXTRAS
from .parts import Parts, button, text
from .plot import Plot, View
from .plots import NAMED, PLOTS, visible
from .ui import FULL, linked, show


class Card:
    """A plot in its frame: title, formula, buttons of extras, legend, choices, and a note."""

    def __init__(self, plot: Plot, page: Any):
        self.plot, self.picture, self._page, self._legend = plot, picture_of(plot), page, {}
        self.head, figure = Parts("heading"), pn.pane.Bokeh(self.picture.figure, **FULL)
        # Not seen before it is drawn: that may fail.
        self.view = pn.Column(self.head, figure, css_classes=["card", plot.name], visible=False, **FULL)

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plot."""
        plot, page = self.plot, self._page
        # What is cut off by axes that stay leaves no gap: the plot would move while it is dragged.
        kept = self._legend if view.kept else {}
        self._legend = kept | drawn(view, plot)
        formula = f"<h3>{plot.title}</h3>{linked(plot.formula_of(view.course))}"
        buttons = (each.on_plots(page, plot, view) for each in EXTRAS.values())
        key = text("key", legend(plot, self._legend), "key")
        choices, note = map(page.choice, plot.controls), text("note", plot.note_of(view), "note found")
        self.head.show([text("formula", formula, "formula"), *filter(None, buttons), key, *choices, note])


class Board:
    """All plots of a session: a card is made when it is seen for the first time, and stays."""

    def __init__(self, page: Any):
        self._page, self.cards = page, {}
        self.tabs = Parts("bar", "tabs")
        self.grid = pn.Column(css_classes=["plots"], **FULL)
        for name in NAMED:
            self._make(PLOTS[name])

    def _make(self, plot: Plot) -> None:
        self.cards[plot.name] = Card(plot, self._page)
        self.grid.append(self.cards[plot.name].view)

    def columns(self, view: View) -> dict[str, dict]:
        """Columns of all plots that are seen, by their names; nothing on the page is changed."""
        found = {}
        for plot in visible(view):
            if plot.name not in self.cards:
                self._make(plot)
            found[plot.name] = self.cards[plot.name].picture.columns(view, view.course.now)
        return found

    def show(self, columns: dict[str, dict], view: View) -> None:
        """Draw columns made for a view, on the plots that they are of."""
        for name, card in self.cards.items():
            show(card.view, visible=name in columns)
            if name in columns:
                card.picture.show(columns[name], view)
        count = len(columns) - len(NAMED)
        show(self.grid, css_classes=["plots", f"with-{min(count, 2)}"])

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plots that are seen, and the tabs that apply."""
        for card in self.seen():
            card.show_parts(view)
        tabs = [plot for plot in PLOTS.values() if plot.tab and plot.applies(view)]
        self.tabs.show([self._tab(plot, plot.name in view.state.tiles) for plot in tabs])

    def _tab(self, plot: Plot, shown: bool) -> Any:
        """The button that shows an optional plot alone, or no longer."""

        def change(state):
            others = tuple(tile for tile in state.tiles if tile != plot.name)
            return state.replace(tiles=others if plot.name in state.tiles else (plot.name,))

        return button(plot.tab, partial(self._page.apply, change), pressed=shown)

    def seen(self) -> list[Card]:
        """The cards that are seen."""
        return [card for card in self.cards.values() if card.view.visible]
