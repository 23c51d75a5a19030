"""The board on the right: plots in cards with title and legend, and the list of other plots."""

from dataclasses import replace
from functools import partial
from typing import Any

import panel as pn
from markupsafe import Markup, escape

from .draw import drawn, legend, picture_of
from .extra import EXTRAS
from .parts import Part, Parts, button, text
from .plot import Plot, View
from .plots import NAMED, PLOTS, visible
from .quantities import QUANTITIES
from .state import State
from .ui import FULL, marked, show


def opened(state: State, name: str) -> State:
    """With an optional plot, or none, in the place of the one that is shown."""
    return state.replace(tiles=(name,) if name else ())


class Card:
    """A plot in its card: title, buttons of extras, legend, choices, and a note."""

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
        # Its formula stands with the numbers.
        title = Markup("<h3>{}</h3><span>{}</span>").format(plot.title, marked(plot.aside(view)))
        buttons = (each.on_plots(page, plot, view) for each in EXTRAS.values())
        key = text("key", legend(plot, self._legend), "key")
        controls = [self._control(name) for name in plot.controls]
        close = [button("Close", partial(page.apply, partial(opened, name="")))] * bool(plot.tab)
        found = escape(plot.note_of(view))
        # In two lines, which show the rest when they are pointed at, or large.
        shown = Markup('<span title="{}">{}</span>').format(found.striptags(), found)
        note = text("note", shown, "note found")
        first = text("formula", title, "formula")
        self.head.show([first, *controls, *filter(None, buttons), *close, key, note])

    def _control(self, name: str) -> Part:
        """A choice above the plot, as a list, which needs less room than its options; or a number."""
        if name in QUANTITIES:
            return self._page.number(name)
        choice = self._page.choice(name)
        return replace(choice, look=choice.look | {"radio": False})


class Board:
    """All plots of a session: a card is made when it is seen for the first time, and stays."""

    def __init__(self, page: Any):
        self._page, self.cards = page, {}
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
        show(self.grid, css_classes=["plots", f"with-{len(columns) - len(NAMED)}"])

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plots that are seen."""
        for card in self.seen():
            card.show_parts(view)

    def others(self, view: View) -> Part:
        """The list of plots of which one is shown beside the three; the next one takes its place."""
        known = {plot.name: plot.tab for plot in PLOTS.values() if plot.tab and plot.applies(view)}
        shown = next((plot.name for plot in visible(view) if plot.tab), "")
        look = {"label": "Fourth plot", "about": "", "radio": False, "classes": "of-plots", "value": shown}
        look["options"] = [["", "none"], *map(list, known.items())]

        def choose(name):
            if name in known or name == "":
                self._page.apply(partial(opened, name=name))

        return Part("choice", "fourth plot", look, choose)

    def seen(self) -> list[Card]:
        """The cards that are seen."""
        return [card for card in self.cards.values() if card.view.visible]
