"""The button *Present*: the plots over the whole page, with large letters, for a lecture."""

from pathlib import Path
from typing import Any

from ..extra import Extra
from ..parts import Button
from ..plot import View
from ..ui import LAYOUT, show

_SHEET = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")
_SCALE = 1.5


class Present:
    """The button *Present*."""

    def __init__(self, page: Any):
        self._page = page
        self.view = Button("Present", self._turn, "escape", pressed=False)

    def _turn(self) -> None:
        on = not self.view.pressed
        self.view.show(pressed=on)
        show(self._page.frame.view, stylesheets=[*LAYOUT, *[_SHEET] * on])
        self.show(self._page.shown)

    def show(self, view: View) -> None:
        for card in self._page.board.cards.values():
            card.letters(_SCALE if self.view.pressed else 1.0)


EXTRA = Extra("present", order=35, header=Present)
