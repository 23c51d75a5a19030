"""Guided scenes: steps, each a link with two sentences, in a panel that opens below the buttons."""

import json
from urllib.parse import urlencode

import panel as pn

from .parts import button, field, html, linked, panel, tools
from .quantities import ASSETS
from .readouts import cells, here
from .units import written

#: By their titles: what the steps set, as a link does, and what they say of the numbers then read.
TOURS = json.loads((ASSETS / "tours.json").read_text(encoding="utf-8"))
_INTRO = "Three scenes, each of a few steps. Next begins; Undo takes back what a step has set."
_LEFT = "The page shows something else by now. Back and Next go on with the steps."


def said(step, way):
    """What a step says, with the numbers of the state that is shown."""
    numbers = {name: written(here(values, way.now), kind, 3) for name, _, kind, values in cells(way)}
    return step["says"].format_map(numbers)


class Tour:
    """The panel *Guide* of a page."""

    def __init__(self, page):
        self.page, self.at, self._scene, self._text = page, -1, None, ""
        self.title = field(pn.widgets.Select, "tour", options=list(TOURS), width=270, sizing_mode=None)
        self.back, self.next = (button(name, width=70) for name in ("Back", "Next"))
        self.words = html(_INTRO)
        self.title.param.watch(lambda event: self._go(0), "value")
        self.back.on_click(lambda event: self._go(self.at - 1))
        self.next.on_click(lambda event: self._go(self.at + 1))
        self.panel = panel(page.guide, tools(self.title, self.back, self.next), self.words)
        self._bound()

    def _go(self, at):
        self.at, steps = at, TOURS[self.title.value]
        self.page.open(urlencode(steps[at]["set"]))
        self._scene, self._text = self.page.way.scene, linked(said(steps[at], self.page.way))
        self.show()
        self._bound()

    def show(self):
        """What the step says, while the page shows its scene."""
        if self.at >= 0:
            text = self._text if self.page.way.scene == self._scene else _LEFT
            count = len(TOURS[self.title.value])
            self.words.object = f'<p role="status">{self.at + 1} of {count}. {text}</p>'

    def _bound(self):
        self.back.disabled = self.at <= 0
        self.next.disabled = self.at == len(TOURS[self.title.value]) - 1
