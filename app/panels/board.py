"""The board on the right: plots in frames with title, formula and legend; their tabs, and the player."""

import json
from collections.abc import Callable
from html import escape
from typing import Any

import numpy as np
import panel as pn
from bokeh.events import Pan, PanEnd, PanStart
from bokeh.models import ColumnDataSource, CustomJS, Slider, Toggle
from panel.models.markup import HTML

from ..plots import NAMED, PLOTS, TILES, visible
from ..plots.draw import Picture, drawn
from ..plots.plot import Plot, View
from ..ui import FULL, JS, STYLE, WIDE, button, html, legend, linked, show, toggle
from . import readouts
from .controls import Choices

#: Plots that share the axis x of another one.
_SAME_X = {"pressure": "springs"}


class Card:
    """A plot in its frame: title, formula, legend, controls above and a note below."""

    def __init__(self, plot: Plot, choices: Choices, scene: ColumnDataSource):
        self.plot, self.picture, self._rows = plot, Picture(plot), None
        self.head, self.key, self.note = html("", "formula"), html("", "key"), html("", "note", "found")
        save, self.large = button("Save", "none"), toggle("Large", "none")
        rows = [row.name for row in plot.rows if row.legend]
        told = {"figure": self.picture.figure, "scene": scene, "rows": rows, "title": plot.title}
        save.js_on_click(args=told, code=f"(async () => {{{JS['save']}}})()")
        self.large.param.watch(self._enlarge, "value")
        head = pn.Row(self.head, save, self.large, css_classes=["head"], stylesheets=STYLE, **WIDE)
        parts = [head, self.key, pn.pane.Bokeh(self.picture.figure, **FULL)]
        if plot.find:
            above = pn.Row(*map(choices.row, plot.controls), css_classes=["above"], **WIDE)
            parts = [head, above, *parts[1:], self.note]
        self.view = pn.Column(*parts, css_classes=["card", plot.name], **FULL)

    def _enlarge(self, event):
        self.view.css_classes = ["card", self.plot.name, *["large"] * event.new]
        self.large.label = "Small" if event.new else "Large"

    def show(self, columns: dict, view: View) -> None:
        """Draw columns made for a view, with the texts around them."""
        plot, course = self.plot, view.course
        self.picture.show(columns, view, view.state.dark)
        show(self.head, object=f"<h3>{plot.title}</h3>{linked(plot.formula_of(course))}")
        rows = drawn(view, plot, {course.now, course.peak})
        if rows != self._rows:
            self._rows = rows
            show(self.key, object=legend(plot, rows))
        if plot.name in view.found:
            show(self.note, object=view.found[plot.name].note)


class Player:
    """Moves through the states of a scene in the browser, from frames that are sent once."""

    def __init__(self, figures: list[Any]):
        look = {"css_classes": ["button", "key-space"], "stylesheets": STYLE, "margin": 0}
        self.play = Toggle(label="▶ Play", width=84, **look)
        wide = WIDE | {"stylesheets": STYLE}
        look = wide | {"show_value": False, "title": None, "tooltips": False, "css_classes": ["slider"]}
        self.state = Slider(start=0, end=1, value=1, step=1, name="state", **look)
        self.frames, self.hand = ColumnDataSource(name="frames"), ColumnDataSource(name="hand")
        self.heads = HTML(css_classes=["readouts", "heads"], height=29, **wide)
        self.readout = HTML(css_classes=["readouts"], height=24, **wide)
        self.parts = {"frames": self.frames, "state": self.state, "play": self.play}
        told = self.parts | {"readout": self.readout, "figures": figures}
        code = CustomJS(args=told, code=JS["player"])
        self.state.js_on_change("value", code)
        self.frames.js_on_change("tags", code)
        self.play.js_on_change("active", code)
        self.view = pn.Row(*map(pn.pane.Bokeh, (self.play, self.state)), css_classes=["player"], **WIDE)

    def show(self, view: View, moved: bool) -> None:
        """Show the present state of a course and its readouts; drop frames unless it has only moved."""
        course, i = view.course, view.course.now
        self._numbers = numbers = readouts.readings(course)
        if self.frames.tags and not moved:
            self.frames.tags = []
        self.state.update(end=len(course) - 1, value=i)
        d, F, z = (view.axis(name) for name in ("d", "F", "z"))
        pressing = course.hit is None and course.motion is None and not course.turns
        path = {"d": course.states.depth / d.factor, "F": course.states.force / F.factor}
        path = {name: [float(f"{value:.6g}") for value in values] for name, values in path.items()}
        self.state.tags = [path | {"unit": d.factor / z.factor, "pressing": pressing}]
        self.heads.text = escape(readouts.heads(course, numbers))
        self.readout.text = escape(readouts.values(course, numbers, i))

    def send(self, view: View, pictures: list[Picture]) -> None:
        """Send all states, once."""
        if self.frames.tags:
            return
        course = view.course
        states = range(len(course))
        frames = [[picture.frame(view, i) for picture in pictures] for i in states]
        sources = [source for frame in frames[0] for source in frame]
        times = np.linspace(0, 1, len(course))
        if course.motion is not None:
            times = (course.motion.time - course.motion.time[0]) / np.ptp(course.motion.time)
        sent = {
            "pictures": [[columns for frame in each for columns in frame.values()] for each in frames],
            "words": [escape(readouts.values(course, self._numbers, i)) for i in states],
            "times": times.tolist(),
        }
        # As one text: Bokeh would look at every number of it.
        self.frames.tags = [sources, json.dumps(sent).replace("NaN", "null")]


class Board:
    """All plots of a session: a card is made when it is seen for the first time, and stays."""

    def __init__(self, choices: Choices, asked: Callable[[str, bool], None]):
        self._choices, self.cards = choices, {}
        self.names: list[str] = []
        # Its tags are the scene, which stands below a picture that is saved.
        self.scene = ColumnDataSource(name="scene")
        self.tabs = {name: toggle(*PLOTS[name].tab) for name in TILES}
        for name, tab in self.tabs.items():
            tab.param.watch(lambda event, name=name: asked(name, event.new), "value")
        self.tab_row = pn.Row(*self.tabs.values(), css_classes=["tools", "tabs"], **WIDE)
        self.grid = pn.Column(css_classes=["plots"], **FULL)
        figures = {name: self._make(name) for name in NAMED}
        self.player = Player(list(figures.values()))
        drag = {"hand": self.player.hand, **self.player.parts}
        #: Figures that are dragged.
        self.dragged = [figures["springs"], figures["force"]]
        for figure in self.dragged:
            code = CustomJS(args=drag | {"figure": figure}, code=JS["drag"])
            for event in (PanStart, Pan, PanEnd):
                figure.js_on_event(event, code)

    def _make(self, name):
        card = self.cards[name] = Card(PLOTS[name], self._choices, self.scene)
        figure = card.picture.figure
        if name in _SAME_X:
            figure.x_range = self.cards[_SAME_X[name]].picture.figure.x_range
        self.grid.append(card.view)
        return figure

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
            show(tab, visible=applies, value=applies and name in view.state.tiles)

    def pictures(self) -> list[Picture]:
        """The pictures that are seen."""
        return [self.cards[name].picture for name in self.names]
