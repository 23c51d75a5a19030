"""Guided scenes: steps, each a link with two sentences, in a panel that opens below the buttons."""

import json
from urllib.parse import urlencode

import numpy as np
import panel as pn

from .controls import WIDE, html, linked
from .quantities import ASSETS
from .readouts import cells
from .units import written

#: By their titles: what the steps set, as a link does, and what they say of the numbers then read.
TOURS = json.loads((ASSETS / "tours.json").read_text(encoding="utf-8"))
_INTRO = "Three scenes, each of a few steps. Next begins; Undo takes a step back out of the page."


def said(step, way):
    """What a step says, with the numbers of the state that is shown."""
    numbers = {
        name: written(float(values if np.ndim(values) == 0 else values[way.now]), kind, 3)
        for name, _, kind, values in cells(way)
    }
    return step["says"].format_map(numbers)


class Tour:
    """The panel *Guide* of a page."""

    def __init__(self, page):
        self.page, self.at = page, -1
        self.title = pn.widgets.Select(
            options=list(TOURS), css_classes=["choice", "tour"], width=270, margin=0
        )
        plain = {"css_classes": ["button"], "margin": 0, "width": 70}
        self.back, self.next = (pn.widgets.Button(name=name, **plain) for name in ("Back", "Next"))
        self.words = html(_INTRO)
        self.title.param.watch(lambda event: self._go(0), "value")
        self.back.on_click(lambda event: self._go(self.at - 1))
        self.next.on_click(lambda event: self._go(self.at + 1))
        row = pn.Row(self.title, self.back, self.next, css_classes=["tools"], **WIDE)
        self.panel = pn.Column(row, self.words, css_classes=["away"], visible=False, stylesheets=[], **WIDE)
        self._bound()
        page.guide.param.watch(lambda event: self.panel.param.update(visible=event.new), "value")

    def _go(self, at):
        self.at, steps = at, TOURS[self.title.value]
        self.page.open(urlencode(steps[at]["set"]))
        text = linked(said(steps[at], self.page.way))
        self.words.object = f'<p role="status">{at + 1} of {len(steps)}. {text}</p>'
        self._bound()

    def _bound(self):
        self.back.disabled = self.at <= 0
        self.next.disabled = self.at == len(TOURS[self.title.value]) - 1
