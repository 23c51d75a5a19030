"""The interface between the page and its extras. The page knows no extra by name."""

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
    """Part of the side: its served `view`, and `show` for another state of the page."""

    view: Any

    def show(self, view: View) -> None: ...


class Service:
    """Data and work of an extra in a session of a page, in addition to its part of the side."""

    def __init__(self, page: Any):
        self.page = page

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        """Return additions to `view.computed`, before the page changes."""
        return {}

    def show(self, view: View) -> None:
        """Show another view."""

    def rest(self, view: View) -> None:
        """Do slow work once the input rests."""


@dataclass(frozen=True, eq=False)
class Extra:
    """Extra of the page: `EXTRA` of a file in `extras/`.

    A JSON file of the same name has its numbers, choices, drives and readouts, with the fields of
    `Quantity`, `Choice`, `Option` and `Readout` in `app/common/quantities.py`. Names of numbers and choices
    begin with the name of the extra and a point. The file may also have presets, in the form of
    `assets/presets.json`. A drive replaces a drive of the page with the same name, and adds lists to its
    options. A number appears if a drive names it (`Option.uses`), or above a plot (`Plot.controls`). A
    choice appears in the form of a drive (`Option.form`) or above a plot. All are values of the state: in
    links, and undone.

    Subclasses have the rest. A `Service` has data and work in a session. A `Drive` converts numbers when
    its choice changes (`converted`). A `Plot` has axes, notes and options that depend on the state
    (`axes_of`, `note_of`, `options_of`).
    """

    name: str
    #: Its position among the extras.
    order: int = 0
    #: Further values of the view with their defaults; undo does not change them. A default is a text, None
    #: for a value outside links, or `Entries` for a list.
    values: dict[str, str | Entries | None] = field(default_factory=dict)
    drives: dict[str, Drive] = field(default_factory=dict)
    plots: tuple[Plot, ...] = ()
    overlays: tuple[Overlay, ...] = ()
    #: Label of the header button that opens its part of the page. The part is "above" the form, "over" the
    #: plots, or without a button at the "top" of the form while it is offered. `side` makes the part of a
    #: page when it first opens.
    tab: str = ""
    place: str = "above"
    offered: Callable[[View], bool] = lambda view: True
    side: Callable[[Any], Side] | None = None
    #: A part in the header of a page for a view, for example a button, or None; and parts above a plot.
    header: Callable[[Any, View], Part | None] = lambda page, view: None
    on_plots: Callable[[Any, Plot, View], list[Part]] = lambda page, plot, view: []
    #: Makes the service of a page, once in a session; other extras may use it.
    service: Callable[[Any], Service] | None = None
    #: Files to download: label, name, and function that returns the text for a view.
    files: tuple[tuple[str, str, Callable[[View], str]], ...] = ()
    #: Notes (text or HTML) by their places. Places in the form are the "first" line, "drive" and its
    #: "form", "shape", "medium" and its "more", and "sources". The note "below" the player is a function,
    #: called at the next rest.
    notes: Callable[[View], dict[str, str | Callable[[], str]]] = lambda view: {}
    #: Titles and texts (or HTML) of the extra in a saved scene.
    scene_file_texts: Callable[[View], list[tuple[str, str]]] = lambda view: []


#: All extras by name, in their order.
EXTRAS: dict[str, Extra] = {}
