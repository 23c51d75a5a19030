"""Buttons *Large* and *Save* of each plot, and *Save plots*; pictures have title, legend and caption."""

from functools import partial
from typing import Any

from bokeh.models import Text

from ...common.quantities import unicode_subscripts
from ...common.ui import show
from ..courses import Course
from ..extra import Extra, Service
from ..figures import Picture, drawn, in_legend
from ..link import file_name, summary
from ..plot import Plot, View, rows_of
from ..plots import visible
from ..state import State
from ..widgets import Part, button

#: Size of letters in a large plot, and in all plots of a wide window, relative to the page.
_SCALE, _WIDE = 1.5, 1.2


def turned(state: State, name: str) -> State:
    """Make a plot large, or small if it is large."""
    return state.replace(large="" if state.large == name else name)


def large_button(page: Any, plot: Plot, view: View) -> Part:
    """Return the button *Large* of a plot."""
    is_large = view.state.large == plot.name
    act = partial(page.apply, lambda state: turned(state, plot.name))
    return button("Small" if is_large else "Large", act, pressed=is_large, key="escape")


def set_letters(picture: Picture, scale: float) -> None:
    """Scale the letters of a plot relative to the page."""
    title, tick = f"{12 * scale:g}px", f"{11 * scale:g}px"
    picture.figure.min_border_left = round(48 * scale) + 12
    for axis in picture.figure.axis:
        axis.update(axis_label_text_font_size=title, major_label_text_font_size=tick)
    for text in picture.figure.select(Text):
        text.text_font_size = title


#: Width and height of a picture in points, and left, top, width and height of its plots.
_SIZE, _WHOLE = (840, 624), (0, 0, 840, 600)
_SCREEN = (1280, 720)
_PLACES = {"springs": (0, 0, 640, 348), "pressure": (0, 348, 640, 348), "force": (640, 0, 640, 696)}
#: The same with a fourth plot below the force.
_WITH_FOURTH = _PLACES | {"force": (640, 0, 640, 348)}
_FOURTH = (640, 348, 640, 348)


class Cards(Service):
    """Shows one plot large, with larger letters; stores legends and scene for saved pictures."""

    def __init__(self, page: Any):
        super().__init__(page)
        # The scale of the letters of each plot, once it is set; and the legends of the last rest.
        self._set: dict[str, float] = {}
        self._legends: dict[str, Any] = {}

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {"save": self._legends}

    def show(self, view: View) -> None:
        cards = {name: card for name, card in self.page.layout.cards.items() if card.picture.axes}
        for name, card in cards.items():
            is_large = name == view.state.large
            show(card.view, css_classes=["card", name, *["large"] * is_large])
            scale = (_WIDE if self.page.messages.wide else 1.0) * (_SCALE if is_large else 1.0)
            if scale != self._set.get(name, 1.0):
                self._set[name] = scale
                set_letters(card.picture, scale)
                card.picture.set_axes(card.picture.axes)

    def rest(self, view: View) -> None:
        self._legends["scene"] = summary(view.state)
        self._legends["file"] = file_name(view.state, "")
        for plot in visible(view):
            # All rows while a search runs, else the drawn rows: the legend names the visible rows.
            called = drawn(view, plot) or {row.name: row.name for row in rows_of(plot)}
            rows = [unicode_subscripts(called[row.name]) for row in in_legend(plot, called)]
            self._legends[plot.name] = {"rows": rows, "title": plot.title}


def save(label: str, name: str, places: dict[str, Any], size: tuple[int, int], view: View) -> Part:
    """Return a button that saves plots as a picture in the browser, with the scene as caption."""
    legends = view.computed["save"]
    looks = [legends.get(each, {"rows": [], "title": ""}) for each in places]
    plots = [{"figure": figure, "place": place} for figure, place in places.items()]
    look = {"label": label, "looks": looks, "scene": legends.get("scene", "")}
    look["file"] = legends.get("file", "") + name
    return Part("save", label, look | {"plots": plots, "size": size})


def of_plot(plot: Plot, view: View) -> Part:
    return save("Save", plot.name, {plot.name: _WHOLE}, _SIZE, view)


def of_all(page: Any, view: View) -> Part:
    """Return the button that saves all visible plots as one picture."""
    names = [plot.name for plot in visible(view)]
    known = _PLACES if len(names) == len(_PLACES) else _WITH_FOURTH
    return save("Save plots", "plots", {name: known.get(name, _FOURTH) for name in names}, _SCREEN, view)


def on_plot(page: Any, plot: Plot, view: View) -> list[Part]:
    return [of_plot(plot, view), large_button(page, plot, view)]


EXTRA = Extra("cards", order=32, on_plots=on_plot, header=of_all, service=Cards)
