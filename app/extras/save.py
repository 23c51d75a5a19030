"""The buttons *Save* of each plot and *Save plots*: pictures with titles, legends and the scene."""

from typing import Any

from ..courses import Course
from ..draw import drawn
from ..extra import Extra
from ..parts import Part
from ..plot import Plot, View, rows_of
from ..plots import NAMED
from ..shared.summary import summary
from ..state import State

#: Width and height of a picture in points, and where its plots are: left, top, width and height.
_SIZE, _WHOLE = (840, 624), (0, 0, 840, 600)
_SCREEN = (1280, 720)
_PLACES = {"springs": (0, 0, 640, 348), "pressure": (0, 348, 640, 348), "force": (640, 0, 640, 696)}


class Save(Part):
    """A button that saves the picture of plots, in the browser, with the scene below it."""

    KIND = "save"
    LOOK = ("label", "looks", "scene")

    def __init__(self, label: str, name: str, places: dict[str, Any], size: tuple[int, int]):
        plots = [{"figure": figure, "place": place} for figure, place in places.items()]
        super().__init__(name=name, plots=plots, size=size)
        self.label, self.names, self.looks, self.scene = label, list(places), [], ""


class Saves:
    """What has a button that saves."""

    def __init__(self, *told: Any):
        self.view = Save(*told)

    def show(self, view: View) -> None:
        pass


def of_plot(plot: Plot, apply: Any) -> Saves:
    return Saves("Save", plot.name, {plot.name: _WHOLE}, _SIZE)


def of_all(page: Any) -> Saves:
    """The button that saves the three plots as one picture."""
    return Saves("Save plots", "plots", {name: _PLACES[name] for name in NAMED}, _SCREEN)


class Saving:
    """Keeps the legends and the scene of the pictures that are saved."""

    def __init__(self, page: Any):
        self._page = page

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {}

    def rest(self, view: View) -> None:
        states, board = {view.course.now, view.course.peak}, self._page.board
        looks = {}
        for card in map(board.cards.get, board.names):
            called = drawn(view, card.plot, states)
            rows = [called.get(row.name, row.name) for row in rows_of(card.plot) if row.legend]
            looks[card.plot.name] = {"rows": rows, "title": card.plot.title}
        parts = [part.view for name in board.names for part in board.cards[name].above]
        for part in (*parts, self._page.frame.buttons["save"].view):
            if isinstance(part, Save):
                part.show(looks=[looks[name] for name in part.names], scene=summary(view.state))


EXTRA = Extra("save", order=32, on_plots=of_plot, header=of_all, service=Saving)
