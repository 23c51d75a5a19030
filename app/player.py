"""The player: it moves through the states of a scene in the browser."""

import json

import panel as pn
from bokeh.models import CustomJS, ImportedStyleSheet, Row, Slider, Toggle

from . import readouts
from .draw import Picture
from .parts import Part, Text
from .plot import View
from .plots import D, F, Z
from .ui import JS, LAYOUT, SHEETS, WIDE, Messages


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
        self.heads, self.words = Text("heads"), Part(kind="words")
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
        self._numbers = numbers = readouts.readings(course)
        if not moved:
            self._messages.frames = []
        self.state.update(end=len(course) - 1, value=i)
        d, force = view.axis(D).factor, view.axis(F).factor
        path = {"d": course.states.depth / d, "F": course.states.force / force}
        path = {name: [float(f"{value:.6g}") for value in values] for name, values in path.items()}
        self._messages.path = path | {"unit": d / view.axis(Z).factor, "pressing": course.pressed}
        self.heads.show(object=readouts.heads(course, numbers))
        self._messages.words = readouts.values(course, numbers, i)

    def send(self, view: View, pictures: list[Picture]) -> None:
        """Send all states, once."""
        if self._messages.frames:
            return
        course = view.course
        states = range(len(course))
        frames = [[picture.frame(view, i) for picture in pictures] for i in states]
        sources = [source for frame in frames[0] for source in frame]
        sent = {
            "pictures": [[columns for frame in each for columns in frame.values()] for each in frames],
            "words": [readouts.values(course, self._numbers, i) for i in states],
            "times": course.times.tolist(),
        }
        # As one text: Bokeh would look at every number of it.
        self._messages.frames = [sources, json.dumps(sent).replace("NaN", "null")]
