"""Texts, buttons and the like in one component, each of which costs some 4 ms of an opening."""

import json
from collections.abc import Callable
from typing import Any

import panel as pn
import param

from .ui import JS, WIDE, show


class Part:
    """A part: `told` is what it is, said once; `LOOK` are the names of what is shown of it."""

    KIND = ""
    LOOK: tuple[str, ...] = ()

    def __init__(self, **told: Any):
        self.told, self.visible = {"kind": self.KIND} | told, True
        self.place: Parts | None = None

    @property
    def parts(self) -> list["Part"]:
        return [self]

    def show(self, **values: Any) -> None:
        """Change what is shown of it: `visible`, and what is in `LOOK`."""
        changed = any(getattr(self, name) != value for name, value in values.items())
        vars(self).update(values)
        if changed and self.place is not None:
            self.place.refresh()

    def take(self, message: Any) -> None:
        """Do what a person wants of it."""


class Group:
    """Parts that come and go; they stay where they were made."""

    def __init__(self):
        self.parts: list[Any] = []
        self.place: Parts | None = None

    def show(self, parts: list[Part]) -> None:
        """Show some parts, and hide all others."""
        self.parts += [part for part in parts if part not in self.parts]
        for part in self.parts:
            part.show(visible=part in parts)
        if self.place is not None:
            self.place.refresh()


class Text(Part):
    """A text (HTML)."""

    KIND = "text"
    LOOK = ("object",)

    def __init__(self, *classes: str, object: str = ""):
        super().__init__(classes=" ".join(classes or ["note"]))
        self.object = object


class Button(Part):
    """A button: `act` is called when it is pressed; `pressed` is None if it does not stay down."""

    KIND = "button"
    LOOK = ("label", "pressed", "disabled")

    def __init__(self, label: str, act: Callable[[], None], key: str = "", pressed: bool | None = None):
        super().__init__(key=key)
        self.label, self.act, self.pressed, self.disabled = label, act, pressed, False

    def take(self, message: Any) -> None:
        if not self.disabled:
            self.act()


class Parts(pn.custom.JSComponent):
    """Parts of the page below each other, or in a row (class "bar")."""

    # As text: Panel and Bokeh would look at every value.
    told, shown = param.String("[]"), param.String("[]")

    # A link, so that the script is sent once.
    _esm = JS["parts"]

    def __init__(self, *places: Any, classes: tuple[str, ...] = (), **options: Any):
        self.places, self._known = places, []
        super().__init__(css_classes=list(classes), **WIDE | options)
        self.refresh()
        self.on_msg(self._on_message)

    def refresh(self) -> None:
        """Show all as they are."""
        for each in self.places:
            each.place = self
        parts = [part for each in self.places for part in each.parts]
        for part in parts:
            part.place = self
        self._known += [part for part in parts if part not in self._known]
        looks = [
            {"id": self._known.index(part), "visible": part.visible}
            | {name: getattr(part, name) for name in part.LOOK}
            for part in parts
        ]
        told = json.dumps([part.told for part in self._known], ensure_ascii=False)
        show(self, told=told, shown=json.dumps(looks, ensure_ascii=False))

    def _on_message(self, event):
        part, message = event.data
        if part in range(len(self._known)):
            self._known[part].take(message)
