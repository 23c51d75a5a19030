"""Guided scenes: steps with a state and a text."""

import json
import re
from collections.abc import Callable
from typing import Any
from urllib.parse import urlencode

import panel as pn

from ..drives import Course
from ..state import State, link
from ..state.quantities import ASSETS
from ..ui import WIDE, button, field, html, linked, show, tools
from .readouts import readings, text

#: By their titles: what the steps set, as a link does, and what they say of the numbers then read.
TOURS = json.loads((ASSETS / "tours.json").read_text(encoding="utf-8"))
_INTRO = "Guided scenes, each of a few steps. Next begins; Undo takes back what a step has set."
_LEFT = "The page shows something else by now. Back and Next go on with the steps."


def step_state(step: dict[str, Any], now: State) -> State:
    """State of a step; theme, held scenes and other tiles stay."""
    state = link.read(urlencode(step["set"]))
    kept = {name: now[name] for name in ("hold", "dark", "curve")}
    return state.replace(tiles=state.tiles or now.tiles, **kept)


def step_text(step: dict[str, Any], course: Course) -> str:
    """Text of a step, with the numbers of a course."""
    numbers = {
        each.known.symbol: text(each, values, course.now, 3) for each, values in readings(course).items()
    }
    return step["says"].format_map(numbers)


def _marked(text: str) -> str:
    """HTML of a text with links, and *words* in italics; the asterisk of E* is followed by no letter."""
    return re.sub(r"\*(\w+)\*", r"<i>\1</i>", linked(text))


class Guide:
    """The panel *Guide*; `go` applies a change, `course` returns the present course."""

    def __init__(self, go: Callable[..., None], course: Callable[[], Course]):
        self._apply, self._course, self.at, self._scene, self._text = go, course, -1, None, ""
        self.title = field(pn.widgets.Select, label="Guided scene", options=list(TOURS))
        self.back, self.next = (button(name, width=70) for name in ("Back", "Next"))
        self.words = html(_INTRO)
        self.title.param.watch(lambda event: self.go(0), "value")
        self.back.on_click(lambda event: self.go(self.at - 1))
        self.next.on_click(lambda event: self.go(self.at + 1))
        parts = self.title, tools(self.back, self.next), self.words
        self.view = pn.Column(*parts, css_classes=["guide"], visible=False, **WIDE)

    def go(self, at: int) -> None:
        self.at, steps = at, TOURS[self.title.value]
        self._apply(lambda state: step_state(steps[at], state))
        course = self._course()
        self._scene, self._text = course.scene, _marked(step_text(steps[at], course))
        self.show(course)

    def show(self, course: Course) -> None:
        """Show the text of the step while the page shows its scene."""
        count = len(TOURS[self.title.value])
        show(self.back, disabled=self.at <= 0)
        show(self.next, disabled=self.at == count - 1)
        if self.at >= 0:
            words = self._text if course.scene == self._scene else _LEFT
            show(self.words, object=f'<p role="status">{self.at + 1} of {count}. {words}</p>')
