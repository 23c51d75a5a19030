"""Zoom: a box with Shift on any plot; a double click, another drive or preset shows the whole plot."""

from functools import partial
from math import isfinite
from pathlib import Path
from typing import Any

from bokeh.core.properties import Any as AnyValue
from bokeh.events import DocumentReady
from bokeh.model import DataModel
from bokeh.models import CustomJS

from ..extra import Extra, Service
from ..parts import Part, button, text
from ..plot import Plot, View

_SCRIPT = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")


class Asked(DataModel):
    """The plot that is zoomed last, its box in the units of its axes or None, and a count."""

    asked = AnyValue(default=[])


class Zoom(Service):
    """The boxes to which the plots of a session are zoomed; they are in no link."""

    def __init__(self, page: Any):
        super().__init__(page)
        self._scene: tuple[str, str] | None = None
        self.zoom = Asked(name="zoom")
        self.zoom.on_change("asked", self._asked)
        page.document.add_root(self.zoom)
        page.document.js_on_event(DocumentReady, CustomJS(args={"zoom": self.zoom}, code=_SCRIPT))

    def _asked(self, attr, old, new):
        match new:
            case [str(name), box, _] if name in self.page.board.cards and (box is None or _is_box(box)):
                zoom_to(self.page, name, box)

    def show(self, view: View) -> None:
        scene = view.state.preset, view.state.drive
        if scene != self._scene:
            for card in self.page.board.cards.values():
                card.picture.zoom_to(None)
        self._scene = scene


def zoom_to(page: Any, name: str, box: Any) -> None:
    """Show what is within a box of a plot, or all of it, and the button that goes back."""
    page.board.cards[name].picture.zoom_to(box)
    page.refresh()


def whole(page: Any, plot: Plot, view: View) -> Part:
    """The button that shows all of a plot, while less is shown; else how to zoom, where it is large."""
    if page.board.cards[plot.name].picture.zoomed:
        return button("Whole plot", partial(zoom_to, page, plot.name, None))
    return text("how to zoom", "Shift and drag to zoom", "note when-large")


def _is_box(box: Any) -> bool:
    """Whether what a browser has sent is two or three ranges."""
    if not (isinstance(box, list) and len(box) in (2, 3)):
        return False
    numbers = (int, float)
    pairs = [pair for pair in box if isinstance(pair, list) and len(pair) == 2]
    finite = all(isinstance(end, numbers) and isfinite(end) for pair in pairs for end in pair)
    return len(pairs) == len(box) and finite and all(low < high for low, high in pairs)


EXTRA = Extra("zoom", order=34, on_plots=whole, service=Zoom)
