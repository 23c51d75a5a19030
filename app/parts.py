"""Parts of the page: texts, buttons, choices, numbers and files, many of them in one component.

A component of its own for each would cost some 4 ms of an opening.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import panel as pn
import param

from .changes import option, options
from .common.upload import TIP_BYTES, Uploaded
from .quantities import CHOICES
from .state import PRESETS, State, altered
from .ui import JS, WIDE, as_html, linked, show

#: Letters of all options of a choice below which it is shown as radio buttons, else as a list.
_SHORT = 48
#: Option of the list of presets for a scene that is none of them, so that its preset can be chosen again.
_ALTERED = "altered"


@dataclass(frozen=True)
class Part:
    """A part: its kind, its name in the component, and what the browser is told of it.

    `act` is called with what a person does with it.
    """

    kind: str
    name: str
    look: dict[str, Any]
    act: Callable[[Any], None] = lambda message: None


def text(name: str, html: str, classes: str = "note") -> Part:
    """A text, or HTML."""
    return Part("text", name, {"object": as_html(html), "classes": classes})


def button(
    label: str, act: Callable[[], None], pressed: bool | None = None, disabled: bool = False, key: str = ""
) -> Part:
    """A button: `pressed` is None if it does not stay down, `key` is a key of the keyboard."""
    look = {"label": label, "pressed": pressed, "disabled": disabled, "key": key}
    return Part("button", label, look, lambda message: None if disabled else act())


def upload(
    label: str, accept: str, take: Callable[[Uploaded], None], refused: str = "", busy: str = ""
) -> Part:
    """A field for a file, with why the last one was refused, or what is done with it."""
    look = {"label": as_html(label), "accept": accept, "most": TIP_BYTES, "refused": refused, "busy": busy}
    return Part("file", label, look, lambda message: take(Uploaded(**message)))


def choice(name: str, state: State, choose: Callable[[str], None]) -> Part:
    """A choice with its explanation, as radio buttons or a list.

    No preset is chosen if the scene differs from all of them.
    """
    chosen = option(state, name)
    pairs = [[each, CHOICES[name].options[each].label] for each in options(state, name)]
    if name == "preset" and altered(state):
        chosen = _ALTERED
        pairs.append([_ALTERED, f"{PRESETS[state.preset].label}, altered"])
    look = _about(name) | {"options": pairs, "value": chosen}
    return Part("choice", name, look, choose)


@cache
def _about(name: str) -> dict[str, Any]:
    known = CHOICES[name]
    radio = sum(len(each.label) for each in known.options.values()) < _SHORT
    classes = f"of-{name.replace('.', '-')}"
    return {"label": as_html(known.label), "about": linked(known.help), "radio": radio, "classes": classes}


class Parts(pn.custom.JSComponent):
    """Parts of the page below each other, or in a row (class "bar")."""

    #: The number of messages that are answered, and looks, as text: Bokeh would look at each value.
    shown = param.String("[0, []]")

    # A link, so that the script is sent once.
    _esm = JS["parts"]

    def __init__(self, *classes: str, **options: Any):
        self.parts: dict[str, Part] = {}
        self._answered = 0
        super().__init__(css_classes=list(classes), **WIDE | options)
        self.on_msg(self._on_message)

    def show(self, parts: list[Part]) -> None:
        """Show some parts, and no others."""
        self.parts = {part.name: part for part in parts}
        self._send()

    def _send(self):
        looks = [{"kind": part.kind, "name": part.name} | part.look for part in self.parts.values()]
        show(self, shown=json.dumps([self._answered, looks], ensure_ascii=False))

    @pn.io.hold()
    def _on_message(self, event):
        """Do what a person wants; what is refused is answered, too."""
        name, message = event.data
        self._answered += 1
        # Whatever comes from outside, a list too, names a part or none.
        if part := self.parts.get(str(name)):
            part.act(message)
        self._send()
