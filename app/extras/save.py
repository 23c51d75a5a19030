"""The button *Save* of each plot: its picture, saved in the browser, with title, legend and scene."""

from typing import Any

from ..courses import Course
from ..draw import drawn
from ..extra import Extra
from ..parts import Part
from ..plot import Plot, View, rows_of
from ..shared.summary import summary
from ..state import State


class Save(Part):
    """The button that saves the picture of a plot, in the browser, with the scene below it."""

    KIND = "save"
    LOOK = ("label", "rows", "scene")

    def __init__(self, plot: Plot):
        super().__init__(figure=plot.name, title=plot.title)
        self.label, self.rows, self.scene = "Save", [], ""


class Saving:
    """Keeps the legend and the scene of the pictures that are saved."""

    def __init__(self, page: Any):
        self._page = page

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {}

    def rest(self, view: View) -> None:
        states, board = {view.course.now, view.course.peak}, self._page.board
        for card in map(board.cards.get, board.names):
            called = drawn(view, card.plot, states)
            rows = [called.get(row.name, row.name) for row in rows_of(card.plot) if row.legend]
            for part in (part for part in card.above if isinstance(part, Save)):
                part.show(rows=rows, scene=summary(view.state))


EXTRA = Extra("save", on_plots=Save, service=Saving)
