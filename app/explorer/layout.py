"""Layout of the page: header, side with one open part, player, and plots in cards."""

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import panel as pn
from markupsafe import Markup, escape

from ..common.host import last
from ..common.quantities import CHOICES, QUANTITIES
from ..common.ui import FULL, LAYOUT, WIDE, as_html, html, html_subscripts, show
from . import readouts
from .changes import with_tile
from .courses import Caution, Course
from .extra import EXTRAS, Side
from .figures import PLACES, Picture, drawn, legend, picture_of
from .plot import Plot, View
from .plots import NAMED, PLOTS, visible
from .state import State
from .widgets import Form, Part, Parts, button, text

#: Roles and names of the parts of the page, by their classes.
LANDMARKS = {
    "above": ("banner", "Preset and tools"),
    "side": ("complementary", "Drive, indenter and medium"),
    "results": ("main", "Numbers and plots"),
    "share": ("region", "Share"),
}
_TITLE = text("name", Markup("<h1>Indentation explorer</h1>"), "name")
#: The link to the page for measurements.
_FIT = text("fit", Markup('<a href="?fit">Fit a measurement</a>'), "way")


def _toggle_dark(state: State) -> State:
    """Dark instead of light, or back."""
    return state.replace(dark=not state.dark)


class Card:
    """Card of a plot: title, buttons of extras, legend, choices, and a note."""

    def __init__(self, plot: Plot, page: Any):
        self.plot, self.picture, self._page, self._legend = plot, picture_of(plot), page, {}
        self.head, figure = Parts("heading"), pn.pane.Bokeh(self.picture.figure, **FULL)
        # Invisible before the first drawing, which may fail.
        self.view = pn.Column(self.head, figure, css_classes=["card", plot.name], visible=False, **FULL)

    def show_parts(self, view: View) -> None:
        """Show the texts and buttons around the plot."""
        plot, page = self.plot, self._page
        # During a drag, names of rows off the axes stay in the legend: a gap would move the plot.
        kept = self._legend if view.kept else {}
        self._legend = kept | drawn(view, plot)
        # The formula is with the numbers.
        title = Markup("<h3>{}</h3><span>{}</span>").format(plot.title, html_subscripts(plot.aside(view)))
        buttons = [part for each in EXTRAS.values() for part in each.on_plots(page, plot, view)]
        key = text("key", legend(plot, self._legend), "key")
        # Choices have a separate row with room for their options.
        controls = [text("controls", "", "break"), *map(self._control, plot.controls)] * bool(plot.controls)
        close = [button("Close", partial(page.apply, partial(with_tile, name="")))] * bool(plot.tab)
        found = escape(plot.note_of(view))
        # Two lines; the tooltip, or the large plot, shows the rest.
        shown = Markup('<span title="{}">{}</span>').format(found.striptags(), found)
        note = text("note", shown, "note found")
        first = text("formula", title, "formula")
        self.head.show([first, *buttons, *close, *controls, key, note])

    def _control(self, name: str) -> Part:
        """Return a choice above the plot, as a list, because this needs less room; or a number."""
        if name in QUANTITIES:
            return self._page.number(name)
        choice = self._page.choice(name)
        return replace(choice, look=choice.look | {"radio": False})


class Layout:
    """Header, side and plots; parts of extras and cards are made at their first use, and kept."""

    def __init__(self, page: Any):
        self._page, self.form, self.cards = page, Form(page), {}
        self.grid = pn.Column(css_classes=["plots"], **FULL)
        for name in NAMED:
            self._make(PLOTS[name])
        #: Existing parts, and the name of the open part in each place.
        self.parts: dict[str, Side] = {}
        self.opened: dict[str, str] = {}
        # On a phone, less frequent actions are below the plots.
        self.header = Parts("header", stylesheets=LAYOUT)
        self.more = Parts("more", stylesheets=LAYOUT)
        self.line = Parts("top", stylesheets=LAYOUT)
        self.player = Parts("player", stylesheets=LAYOUT)
        # Cautions with their buttons, from the last rest.
        self.cautions: list[Part] = []
        self.below = html("", "lights")
        look = FULL | {"css_classes": ["side"], "sizing_mode": "stretch_height", "width": 312}
        self._side = pn.Column(self.form.view, **look)
        plots = (self.line, self.player, self.below, self.grid)
        results = pn.Column(*plots, css_classes=["results"], **FULL)
        columns = pn.Row(self._side, results, css_classes=["columns"], **FULL)
        head = pn.Row(self.header, self.more, css_classes=["above"], **WIDE | {"stylesheets": LAYOUT})
        self.view = pn.Column(head, columns, css_classes=["page"], **FULL)

    def toggle(self, name: str) -> None:
        """Open a part instead of another part, or close it."""
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
        """Show a view around the plots and in all open parts."""
        for card in self.seen():
            card.show_parts(view)
        offered = {name for name, each in EXTRAS.items() if each.side and each.offered(view)}
        self.opened = {place: name for place, name in self.opened.items() if name in offered}
        for name in offered:
            if EXTRAS[name].place == "top":
                self._open(name)
        page = self._page
        # A first visit has nothing to undo, and no button for it.
        undo = [button("Undo", page.undo, key="z")] * (page.history.at > 0)
        redo = [button("Redo", page.redo)] * (page.history.at + 1 < len(page.history.states))
        opening = [self._button(name) for name, each in EXTRAS.items() if name in offered and each.tab]
        self.form.show(view)
        preset = page.choice("preset")
        # The form explains the preset and its sources.
        preset.look["about"] = ""
        self.header.show([_TITLE, preset, *undo, *redo, *opening])
        dark = button("Dark", partial(page.apply, _toggle_dark), pressed=view.state.dark)
        more = (each.header(page, view) for each in EXTRAS.values())
        self.more.show([_FIT, *filter(None, more), dark])
        numbers = readouts.line(view.course)
        heads = text("heads", readouts.heads(numbers), "heads")
        page.messages.words = as_html(readouts.values(view.course, numbers, view.course.now))
        self.line.show([heads, Part("words", "words", {}), *self.cautions])
        self.player.show([player(view, page.move), self.others(view)])
        for name, part in self.parts.items():
            show(part.view, visible=name in self.opened.values())
            if part.view.visible:
                part.show(view)

    def _button(self, name: str) -> Part:
        """Return the button that opens a part."""
        pressed = name in self.opened.values()
        return button(EXTRAS[name].tab, partial(self.toggle, name), pressed, key="escape", opens=name)

    def rest(self, view: View) -> None:
        """Show texts that wait while a slider moves, because changed texts need a new layout."""
        found = (extra.notes(view).get("below") for extra in EXTRAS.values())
        show(self.below, object=Markup("").join(made() for made in found if made))
        self.cautions = [part for each in view.course.cautions for part in self._caution(each)]

    def _caution(self, caution: Caution) -> Iterator[Part]:
        """Yield the advice of a caution, and a button that follows it."""
        yield text(caution.limits[0], html_subscripts(caution.sentence), "severe")
        if caution.option:
            label = f"Take a {CHOICES[caution.choice].options[caution.option].label}"
            yield button(label, partial(self._page.choose, caution.choice, caution.option))

    # The plots.

    def _make(self, plot: Plot) -> None:
        self.cards[plot.name] = Card(plot, self._page)
        self.grid.append(self.cards[plot.name].view)

    def columns(self, view: View) -> dict[str, dict]:
        """Return the columns of all visible plots by name, without changing the page."""
        found = {}
        for plot in visible(view):
            if plot.name not in self.cards:
                self._make(plot)
            found[plot.name] = self.cards[plot.name].picture.columns(view, view.course.now)
        return found

    def draw(self, columns: dict[str, dict], view: View) -> None:
        """Draw the columns of a view on their plots."""
        for name, card in self.cards.items():
            show(card.view, visible=name in columns)
            if name in columns:
                card.picture.show(columns[name], view)
        show(self.grid, css_classes=["plots", f"with-{len(columns) - len(NAMED)}"])

    def others(self, view: View) -> Part:
        """Return the list of optional plots; the chosen plot is next to the three permanent plots."""
        known = {plot.name: plot.tab for plot in PLOTS.values() if plot.tab and plot.applies(view)}
        shown = next((plot.name for plot in visible(view) if plot.tab), "")
        look = {"label": "Fourth plot", "about": "", "radio": False, "classes": "of-plots", "value": shown}
        look["options"] = [["", "none"], *map(list, known.items())]

        def choose(name):
            if name in known or name == "":
                self._page.apply(partial(with_tile, name=name))

        return Part("choice", "fourth plot", look, choose)

    def seen(self) -> list[Card]:
        """Return the visible cards."""
        return [card for card in self.cards.values() if card.view.visible]


def frames(view: View, pictures: list[Picture]) -> list[Any]:
    """Return the moving sources, the places of their rows in each state as texts, readouts, and times."""
    return last(frames_in_steps(view, pictures))


def frames_in_steps(view: View, pictures: list[Picture]) -> Iterator[list[Any]]:
    """Yield an empty list for each computed state, then `frames`; all states take 0.2 s."""
    numbers, states = readouts.line(view.course), range(len(view.course))
    found: dict[Any, list[str]] = {}
    for i in states:
        yield []
        for picture in pictures:
            for source, columns in picture.columns(view, i).items():
                places = json.dumps({name: columns[name] for name in PLACES if name in columns})
                found.setdefault(source, []).append(places.replace("NaN", "null"))
    moving = {source: texts for source, texts in found.items() if len(set(texts)) > 1}
    words = [readouts.values(view.course, numbers, i) for i in states]
    yield [[*moving], [*moving.values()], words, view.course.times.tolist()]


def look(course: Course) -> dict[str, Any]:
    """Return the data of the player: indices of the last, the present, and the marked states."""
    return {"last": len(course) - 1, "now": course.now, "marks": marked_states(course)}


def marked_states(course: Course) -> dict[str, int]:
    """Return the marked states on the slider by name: the largest depth, and the loss of contact."""
    found = {"largest depth": course.peak}
    # A path with several turns may lose contact several times.
    lost = np.flatnonzero(course.states.contact_radius[course.peak :] == 0)
    if lost.size and not course.turns:
        found["loss of contact"] = course.peak + int(lost[0])
    return found


def player(view: View, move: Callable[[Any], None]) -> Part:
    """Return a button and a slider that play the states of a view in the browser.

    They call `move` with None when a movement begins, and with the index of the state in which it ends.
    """
    return Part("player", "player", look(view.course), move)
