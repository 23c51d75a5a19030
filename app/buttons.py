"""Rows of buttons: each row is one component, so that a page of many buttons opens quickly."""

from collections.abc import Callable
from typing import Any

import panel as pn
import param

from .ui import JS, WIDE


class Button:
    """A button: `act` is called when it is pressed; `pressed` is None if it does not stay down."""

    def __init__(self, label: str, act: Callable[[], None], key: str = "", pressed: bool | None = None):
        self.label, self.act, self.key, self.pressed = label, act, key, pressed
        self.disabled, self.visible = False, True
        self.row: Bar | None = None

    def show(self, **values: Any) -> None:
        """Change what is shown of it: `label`, `pressed`, `disabled`, `visible`."""
        changed = any(getattr(self, name) != value for name, value in values.items())
        for name, value in values.items():
            setattr(self, name, value)
        if changed and self.row is not None:
            self.row.refresh()

    @property
    def look(self) -> list[Any]:
        return [self.label, self.pressed, self.disabled, self.visible, self.key]


class Bar(pn.custom.JSComponent):
    """A row of buttons."""

    shown = param.List()

    _esm = JS["buttons"]

    def __init__(self, *buttons: Button, classes: tuple[str, ...] = (), **options: Any):
        self.buttons = buttons
        for button in buttons:
            button.row = self
        super().__init__(css_classes=["bar", *classes], **WIDE | options)
        self.refresh()
        self.on_msg(self._on_message)

    def refresh(self) -> None:
        """Show the buttons as they are."""
        looks = [button.look for button in self.buttons]
        if looks != self.shown:
            self.shown = looks

    def _on_message(self, event):
        if event.data in range(len(self.buttons)) and not self.buttons[event.data].disabled:
            self.buttons[event.data].act()
