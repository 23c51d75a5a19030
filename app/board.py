"""The board on the right: plots in frames with title, formula and legend; their tabs, and the player."""

from collections.abc import Callable
from functools import partial

import panel as pn
from bokeh.events import Pan, PanEnd, PanStart
from bokeh.models import CustomJS

from .draw import Picture, drawn, legend, picture_of
from .extra import EXTRAS
from .fields import Choices
from .parts import Button, Parts, Text
from .player import Player
from .plot import Plot, View
from .plots import NAMED, PLOTS, visible
from .ui import FULL, JS, Messages, html, linked, reveal, show

#: Plots that share the axis x of another one.
_SAME_X = {"pressure": "springs"}


class Card:
    """A plot in its frame: title, formula, legend, controls above and a note below."""

    def __init__(self, plot: Plot, choices: Choices, apply: Callable[..., None]):
        self.plot, self.picture, self._rows = plot, picture_of(plot), {}
        self.scale = 1.0
        self.large = Button("Large", self._enlarge, "escape", pressed=False)
        self.formula, self.legend = Text("formula"), Text("key")
        #: What extras have above it.
        made = [each.on_plots(plot, apply) for each in EXTRAS.values() if each.on_plots]
        self.above = [each for each in made if each is not None]
        buttons = (*(each.view for each in self.above), self.large)
        head = Parts(self.formula, *buttons, self.legend, classes=("heading",))
        self.note = html("", "note", "found")
        parts = [head, pn.pane.Bokeh(self.picture.figure, **FULL)]
        if plot.controls:
            parts.insert(1, Parts(*map(choices.part, plot.controls), classes=("above",)))
        self.view = pn.Column(*parts, css_classes=["card", plot.name], **FULL)

    def _enlarge(self) -> None:
        large = not self.large.pressed
        self.view.css_classes = ["card", self.plot.name, *["large"] * large]
        self.large.show(pressed=large, label="Small" if large else "Large")
        self.letters(self.scale)

    def letters(self, scale: float) -> None:
        """Make the letters of the plot so many times as large, or as they are where it is large."""
        self.scale, large = scale, bool(self.large.pressed)
        self.picture.letters(max(scale, 1.5 * large), short=scale > 1 and not large)

    def show(self, columns: dict, view: View) -> None:
        """Draw columns made for a view, with the texts around them."""
        plot, course = self.plot, view.course
        self.picture.show(columns, view, view.state.dark)
        self.formula.show(object=f"<h3>{plot.title}</h3>{linked(plot.formula_of(course))}")
        rows = drawn(view, plot, {course.now, course.peak})
        if "axes" in view.computed:
            # What is cut off leaves no gap in the legend: the plot would move while it is dragged.
            rows = self._rows | rows
        if rows != self._rows:
            self._rows = rows
            self.legend.show(object=legend(plot, rows))
        for each in self.above:
            each.show(view)
        note = plot.note_of(view)
        show(self.note, object=note)
        reveal(self.view, self.note, bool(note))


class Board:
    """All plots of a session: a card is made when it is seen for the first time, and stays."""

    def __init__(self, choices: Choices, apply: Callable[..., None], messages: Messages):
        self._choices, self._apply, self.cards = choices, apply, {}
        self.names: list[str] = []
        self.tabs = {
            name: Button(plot.tab, partial(self._asked, name), pressed=False)
            for name, plot in PLOTS.items()
            if plot.tab
        }
        self.tab_row = Parts(*self.tabs.values(), classes=("bar", "tabs"))
        self.grid = pn.Column(css_classes=["plots"], **FULL)
        figures = {name: self._make(name) for name in NAMED}
        self.player = Player(messages)
        #: Figures that are dragged.
        self.dragged = [figures["springs"], figures["force"]]
        for figure in self.dragged:
            for event in (PanStart, Pan, PanEnd):
                figure.js_on_event(event, CustomJS(code=JS["named"] + JS["drag"]))

    def _make(self, name):
        card = self.cards[name] = Card(PLOTS[name], self._choices, self._apply)
        figure = card.picture.figure
        if name in _SAME_X:
            figure.x_range = self.cards[_SAME_X[name]].picture.figure.x_range
        self.grid.append(card.view)
        return figure

    def _asked(self, name: str) -> None:
        """Show an optional plot alone, or no longer."""

        def change(state):
            others = tuple(tile for tile in state.tiles if tile != name)
            return state.replace(tiles=others if name in state.tiles else (name,))

        self._apply(change)

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
        self.names = list(columns)
        for name, data in columns.items():
            self.cards[name].show(data, view)
        for name, card in self.cards.items():
            show(card.view, visible=name in columns)
        count = len(columns) - len(NAMED)
        show(self.grid, css_classes=["plots", f"with-{min(count, 2)}"])

    def show_tabs(self, view: View) -> None:
        """Show the tabs of plots that apply to a view."""
        for name, tab in self.tabs.items():
            applies = PLOTS[name].applies(view)
            tab.show(visible=applies, pressed=applies and name in view.state.tiles)

    def pictures(self) -> list[Picture]:
        """The pictures that are seen."""
        return [self.cards[name].picture for name in self.names]
