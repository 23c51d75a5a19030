"""The menu: dark or light, and what the page is."""

from pathlib import Path
from typing import Any

import panel as pn

from ..extra import Extra
from ..parts import Parts, button
from ..plot import View
from ..state import State
from ..ui import WIDE, html

_ABOUT = Path(__file__).with_suffix(".html").read_text(encoding="utf-8")


def _turned(state: State) -> State:
    """Dark instead of light, or back."""
    return state.replace(dark=not state.dark)


class Menu:
    """What the page is, and what is seldom used."""

    def __init__(self, page: Any):
        self._page, self._buttons = page, Parts("bar")
        self.view = pn.Column(self._buttons, html(_ABOUT), **WIDE)

    def show(self, view: View) -> None:
        dark = button("Dark", lambda: self._page.apply(_turned), pressed=view.state.dark)
        self._buttons.show([dark])


EXTRA = Extra("menu", order=100, tab="Menu", place="over", side=Menu)
