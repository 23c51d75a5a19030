"""Plots for a lecture, with large letters: *Large*, one over all others, and *Present*, over the page."""

from functools import partial
from pathlib import Path
from typing import Any

from ..extra import EXTRAS, Extra, Service
from ..parts import Part, button
from ..plot import Plot, View
from ..state import State
from ..ui import LAYOUT, show

_SHEET = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")
#: With a part above the form, such as a guided scene: that part alone stays in the side.
_WITH_SIDE = ":host { --side: flex; --form: none; --digits: 9.5px; }"
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

    def show(self, view: View) -> None:
        on, name_of_large = bool(view.state["present.on"]), view.state["present.large"]
        frame = self.page.frame
        with_side = any(EXTRAS[name].place == "above" for name in frame.opened & EXTRAS.keys())
        sheets = [_SHEET, *[_WITH_SIDE] * with_side] if on else []
        show(frame.view, stylesheets=[*LAYOUT, *sheets])
        for name, card in self.page.board.cards.items():
            is_large = name == name_of_large
            show(card.view, css_classes=["card", name, *["large"] * is_large])
            # On a small plot large titles of axes have no room.
            card.picture.letters(_SCALE if on or is_large else 1.0, short=on and not is_large)


EXTRA = Extra(
    "present",
    order=35,
    values={"present.on": None, "present.large": None},
    of_view=("present.on", "present.large"),
    header=present,
    on_plots=large,
    service=Letters,
)
