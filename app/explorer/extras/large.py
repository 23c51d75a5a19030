"""The button *Large* of a plot: it covers all others, with large letters."""

from functools import partial
from typing import Any

from bokeh.models import Text

from ...common.ui import show
from ..extra import Extra, Service
from ..figures import Picture
from ..plot import Plot, View
from ..state import State
from ..widgets import Part, button

#: Letters of a large plot, over those of the page.
_SCALE = 1.5


def turned(state: State, name: str) -> State:
    """With a plot large, or with none if it is large already."""
    return state.replace(**{"large.plot": None if state["large.plot"] == name else name})


def large(page: Any, plot: Plot, view: View) -> Part:
    """The button *Large* of a plot."""
    is_large = view.state["large.plot"] == plot.name
    act = partial(page.apply, lambda state: turned(state, plot.name))
    return button("Small" if is_large else "Large", act, pressed=is_large, key="escape")


class Letters(Service):
    """Shows one plot large, with letters of that size."""

    def __init__(self, page: Any):
        super().__init__(page)
        # The scale of the letters of each plot, where it was set.
        self._set: dict[str, float] = {}

    def show(self, view: View) -> None:
        drawn = {name: card for name, card in self.page.layout.cards.items() if card.picture.axes}
        for name, card in drawn.items():
            is_large = name == view.state["large.plot"]
            show(card.view, css_classes=["card", name, *["large"] * is_large])
            scale = _SCALE if is_large else 1.0
            if scale != self._set.get(name, 1.0):
                self._set[name] = scale
                set_letters(card.picture, scale)
                card.picture.set_axes(card.picture.axes)


def set_letters(picture: Picture, scale: float) -> None:
    """Make the letters of a plot so many times as large as on the page."""
    title, tick = f"{12 * scale:g}px", f"{11 * scale:g}px"
    picture.figure.min_border_left = round(48 * scale) + 12
    for axis in picture.figure.axis:
        axis.update(axis_label_text_font_size=title, major_label_text_font_size=tick)
    for text in picture.figure.select(Text):
        text.text_font_size = title


EXTRA = Extra(
    "large",
    order=35,
    values={"large.plot": None},
    on_plots=large,
    service=Letters,
)
