"""Guided scenes, whose steps have a state and a text; and help on keys and the model."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import panel as pn
from markupsafe import Markup

from ...common.ui import WIDE, button, field, html, linked, own_html, replaced, show, tools
from .. import link
from ..courses import Course
from ..extra import Extra
from ..plot import View
from ..readouts import readings, text
from ..state import State, kept_extras

#: Steps of the guided scenes by title: `set` has the values of a link, `says` the text with its numbers.
TOURS = json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8"))
#: Help on keys and the model.
_HELP = own_html(Path(__file__).with_suffix(".html"))

_INTRO = "Guided scenes, each of a few steps. Next starts the scene; Undo undoes a step."
_LEFT = "The scene has been changed since this step. Back and Next continue."


def tours() -> dict[str, list[dict[str, Any]]]:
    """Return the guided scenes whose values the page knows."""
    return {
        title: steps
        for title, steps in TOURS.items()
        if not any(link.unknown(urlencode(step["set"])) for step in steps)
    }


def step_state(step: dict[str, Any], now: State) -> State:
    """Return the state of a step; keep the theme, and values of extras that no step or preset sets."""
    state = link.read(urlencode(step["set"]))
    # These include values set to their defaults.
    named = {name for name, _ in link.pairs(urlencode(step["set"]))}
    kept = {name: value for name, value in kept_extras(now).items() if name not in named}
    return state.replace(dark=now.dark, **(kept | state.extras))


def step_text(step: dict[str, Any], course: Course) -> str:
    """Return the text of a step with the numbers of a course."""
    numbers = {each.symbol: text(each, values, course.now, 3) for each, values in readings(course).items()}
    return step["says"].format_map(numbers)


def _marked(text: str) -> Markup:
    """Return text as HTML with links, powers such as W^(2/3), and *words*; no letter follows E*."""
    return replaced(r"\*(\w+)\*", r"<i>\1</i>", replaced(r"\^\((.*?)\)", r"<sup>\1</sup>", linked(text)))


class Guide:
    """The panel *Guide*; `apply` applies a change, `shown` returns the present view."""

    def __init__(self, apply: Callable[..., None], shown: Callable[[], View]):
        self._apply, self._shown, self.at, self._scene, self._text = apply, shown, -1, None, ""
        self._tours, self._going = tours(), False
        self.title = field(pn.widgets.Select, label="Guided scene", options=list(self._tours))
        self.back = button("Back", lambda: self.go(self.at - 1), width=70)
        self.next = button("Next", lambda: self.go(self.at + 1), width=70)
        self.words = html(_INTRO, "step")
        self.title.param.watch(lambda event: self.go(0), "value")
        parts = self.title, tools(self.back, self.next), self.words, html(_HELP)
        self.view = pn.Column(*parts, css_classes=["guide"], **WIDE)

    def go(self, at: int) -> None:
        self.at, steps = at, self._tours[self.title.value]
        # The page shows the scene before it has the text of the step.
        self._going = True
        self._apply(lambda state: step_state(steps[at], state))
        self._going = False
        view = self._shown()
        self._scene, self._text = view.course.scene, _marked(step_text(steps[at], view.course))
        self.show(view)

    def show(self, view: View) -> None:
        """Show the text of the step while the page shows its scene."""
        course = view.course
        count = len(self._tours[self.title.value])
        show(self.back, disabled=self.at <= 0)
        show(self.next, disabled=self.at == count - 1)
        if self.at >= 0 and not self._going:
            words = self._text if course.scene == self._scene else _LEFT
            said = Markup('<p role="status">{} of {}. {}</p>').format(self.at + 1, count, words)
            show(self.words, object=said)


EXTRA = Extra(
    "guide", order=30, tab="Guide", place="above",
    side=lambda page: Guide(page.apply, lambda: page.view),
)  # fmt: skip
