"""The seam: what an extra brings to the page. The page knows no extra by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

from .courses import Course
from .drives import Drive
from .plot import Overlay, Plot, View
from .state import Entries, State
from .widgets import Part


class Side(Protocol):
    """A part of the side: what is served, and what it does when another view is shown."""

    view: Any

    def show(self, view: View) -> None: ...


class Service:
    """What an extra has and does in a session of a page, beside its part of the side."""

    def __init__(self, page: Any):
        self.page = page

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        """What it adds to `view.computed`, before anything is changed."""
        return {}

    def show(self, view: View) -> None:
        """Show another view."""

    def rest(self, view: View) -> None:
        """Do what waits until the input rests."""


@dataclass(frozen=True, eq=False)
class Extra:
    """Something that plugs into the page: `EXTRA` of a file in `extras/`, and what it brings.

    Its numbers, choices, drives and readouts are in a JSON file of its name beside it, with the fields of
    `Quantity`, `Choice`, `Option` and `Readout` in `app/common/quantities.py`; names of numbers and choices
    begin with its own and a point. Presets, which it names as `assets/presets.json` does, may be there,
    too. A drive of the name of one of the page takes its place, and further lists of its options are
    added. A number is seen where a drive names it (`Option.uses`) or above a plot (`Plot.controls`), a
    choice in the form of a drive (`Option.form`) or above a plot. These are values of the state, in links
    and undone.

    What it alone needs is in a class of its own: of `Service`, what it keeps or does in a session; of
    `Drive`, numbers that keep their meaning when a choice of it changes (`converted`); of `Plot`, axes,
    notes and options that apply to a state (`axes_of`, `note_of`, `options_of`).
    """

    name: str
    #: Its place among the extras.
    order: int = 0
    #: Values of the view beside those of its JSON file, which undo leaves alone, with their defaults: a
    #: text, None for one that is in no link, or `Entries` for a list.
    values: dict[str, str | Entries | None] = field(default_factory=dict)
    drives: dict[str, Drive] = field(default_factory=dict)
    plots: tuple[Plot, ...] = ()
    overlays: tuple[Overlay, ...] = ()
    #: Label of the button in the header that opens its part of the page; where the part is: "above" the
    #: form or "over" the plots, or without a button at the "top" of the form while it is offered; whether
    #: it is offered; and the part, made of a page when it is first opened.
    tab: str = ""
    place: str = "above"
    offered: Callable[[View], bool] = lambda view: True
    side: Callable[[Any], Side] | None = None
    #: A part, as a button, in the header of a page for a view, or None; and parts above a plot.
    header: Callable[[Any, View], Part | None] = lambda page, view: None
    on_plots: Callable[[Any, Plot, View], list[Part]] = lambda page, plot, view: []
    #: What it and others need once in a session of a page, which it is made of.
    service: Callable[[Any], Service] | None = None
    #: Files to download, each with its label, its name, and its text of a view.
    files: tuple[tuple[str, str, Callable[[View], str]], ...] = ()
    #: Notes, texts or HTML, by their places: in the form the "first" line, "drive", the "form" of it,
    #: "shape", "medium", the "more" of it and "sources"; "below" the player a function that returns it,
    #: called at the next rest.
    notes: Callable[[View], dict[str, str | Callable[[], str]]] = lambda view: {}
    #: Titles and texts, or HTML, that a saved scene has of it.
    scene_file_texts: Callable[[View], list[tuple[str, str]]] = lambda view: []


#: All extras by name, in their order.
EXTRAS: dict[str, Extra] = {}
