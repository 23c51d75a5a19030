"""The player: it moves through the states of a scene in the browser."""

import json
from typing import Any

import panel as pn
from bokeh.models import CustomJS, ImportedStyleSheet, Row, Slider, Toggle

from . import readouts
from .draw import PLACES, Picture
from .plot import View
from .ui import JS, LAYOUT, SHEETS, WIDE, Messages


def frames(view: View, pictures: list[Picture]) -> list[Any]:
    """Sources that move, the places of their rows in each state as texts, readouts, and times."""
    numbers, states = readouts.line(view.course), range(len(view.course))
    found: dict[Any, list[str]] = {}
    for i in states:
        for picture in pictures:
            for source, columns in picture.columns(view, i).items():
                places = json.dumps({name: columns[name] for name in PLACES if name in columns})
                found.setdefault(source, []).append(places.replace("NaN", "null"))
    moving = {source: texts for source, texts in found.items() if len(set(texts)) > 1}
    words = [readouts.values(numbers, i) for i in states]
    return [[*moving], [*moving.values()], words, view.course.times.tolist()]


class Player:
    """Moves through the states of a scene in the browser, from frames that are sent once."""

    def __init__(self, messages: Messages):
        sheets = [ImportedStyleSheet(url=url) for url in SHEETS]
        look = {"css_classes": ["button", "key-space"], "stylesheets": sheets, "margin": 0}
        self.play = Toggle(label="▶ Play", name="play", width=84, **look)
        look = WIDE | {
            "stylesheets": sheets,
            "show_value": False,
            "title": None,
            "tooltips": False,
            "css_classes": ["slider"],
        }
        self.state = Slider(start=0, end=1, value=1, step=1, name="state", **look)
        #: Heads of the readouts (HTML).
        self.heads = ""
        self._messages = messages
        code = CustomJS(code=JS["named"] + JS["player"])
        self.state.js_on_change("value", code)
        messages.js_on_change("frames", code)
        self.play.js_on_change("active", code)
        row = Row(self.play, self.state, css_classes=["player"], stylesheets=LAYOUT, **WIDE)
        self.view = pn.pane.Bokeh(row, **WIDE)

    def show(self, view: View, moved: bool) -> None:
        """Show the present state of a course and its readouts; drop frames unless it has only moved."""
        course, i = view.course, view.course.now
        numbers = readouts.line(course)
        if not moved:
            self._messages.frames = []
        self.state.update(end=len(course) - 1, value=i)
        self.heads = readouts.heads(numbers)
        self._messages.words = readouts.values(numbers, i)

    def send(self, view: View, pictures: list[Picture]) -> None:
        """Send all states, once."""
        if not self._messages.frames:
            self._messages.frames = frames(view, pictures)
