"""Plots for a lecture, with large letters: *Large*, one over all others, and *Present*, over the page."""

import re
from functools import partial
from pathlib import Path
from typing import Any

from bokeh.models import Text

from ..draw import Picture
from ..extra import Extra, Service
from ..parts import Part, button
from ..plot import Plot, View
from ..state import State
from ..ui import LAYOUT, show

_SHEET = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")
#: With a part above the form, such as a guided scene: that part alone stays in the side.
_WITH_SIDE = ":host { --side: flex; --form: 0px; --seen: hidden; --digits: 9.5px; }"
#: Letters of plots that are presented or large, over those of the page.
_SCALE = 1.5


def turned(state: State, name: str, value: str) -> State:
    """With a value, or without it if it is there."""
    return state.replace(**{name: None if state[name] == value else value})


def present(page: Any, view: View) -> Part:
    """The button *Present*."""
    act = partial(page.apply, lambda state: turned(state, "present.on", "1"))
    return button("Present", act, pressed=bool(view.state["present.on"]), key="escape")


def large(page: Any, plot: Plot, view: View) -> Part:
    """The button *Large* of a plot."""
    is_large = view.state["present.large"] == plot.name
    act = partial(page.apply, lambda state: turned(state, "present.large", plot.name))
    return button("Small" if is_large else "Large", act, pressed=is_large, key="escape")


class Letters(Service):
    """Shows the plots as large as they are asked for, with letters of that size."""

    def __init__(self, page: Any):
        super().__init__(page)
        # Of each plot what was set: the scale, and whether titles of axes are symbols alone.
        self._set: dict[str, tuple[float, bool]] = {}

    def show(self, view: View) -> None:
        on, name_of_large = bool(view.state["present.on"]), view.state["present.large"]
        frame = self.page.frame
        with_side = "above" in frame.opened
        sheets = [_SHEET, *[_WITH_SIDE] * with_side] if on else []
        show(frame.view, stylesheets=[*LAYOUT, *sheets])
        drawn = {name: card for name, card in self.page.board.cards.items() if card.picture.axes}
        for name, card in drawn.items():
            is_large = name == name_of_large
            show(card.view, css_classes=["card", name, *["large"] * is_large])
            # On a small plot large titles of axes have no room.
            look = (_SCALE if on or is_large else 1.0, on and not is_large)
            if look != self._set.get(name, (1.0, False)):
                self._set[name] = look
                set_letters(card.picture, look[0])
                card.picture.set_axes(card.picture.axes)
            if on and not is_large:
                for axis in card.picture.figure.axis:
                    axis.axis_label = re.sub(",.* ", " ", axis.axis_label)


def set_letters(picture: Picture, scale: float) -> None:
    """Make the letters of a plot so many times as large as on the page."""
    title, tick = f"{12 * scale:g}px", f"{11 * scale:g}px"
    picture.figure.min_border_left = round(48 * scale) + 16
    for axis in picture.figure.axis:
        axis.update(axis_label_text_font_size=title, major_label_text_font_size=tick)
    for text in picture.figure.select(Text):
        text.text_font_size = title


EXTRA = Extra(
    "present",
    order=35,
    values={"present.on": None, "present.large": None},
    of_view=("present.on", "present.large"),
    header=present,
    on_plots=large,
    service=Letters,
)
