"""The button *Save* of each plot: its picture, saved in the browser, with title, legend and scene."""

from typing import Any

from ..courses import Course
from ..extra import Extra
from ..parts import Part
from ..plot import Plot, View, rows_of
from ..shared.summary import summary
from ..state import State


class Save(Part):
    """The button that saves the picture of a plot, in the browser, with the scene below it."""

    KIND = "save"
    LOOK = ("label", "scene")

    def __init__(self, plot: Plot):
        rows = [row.name for row in rows_of(plot) if row.legend]
        super().__init__(figure=plot.name, title=plot.title, rows=rows)
        self.label, self.scene = "Save", ""


class Saving:
    """Keeps the scene below the pictures that are saved."""

    def __init__(self, page: Any):
        self._page = page

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {}

    def rest(self, view: View) -> None:
        for card in self._page.board.cards.values():
            for part in card.above:
                if isinstance(part, Save):
                    part.show(scene=summary(view.state))


EXTRA = Extra("save", on_plots=Save, service=Saving)
