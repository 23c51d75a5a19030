"""The buttons *Save* of each plot and *Save plots*: pictures with titles, legends and the scene."""

from typing import Any

from ...common.quantities import unicode_subscripts
from ..courses import Course
from ..extra import Extra, Service
from ..figures import drawn, in_legend
from ..link import file_name, summary
from ..plot import Plot, View, rows_of
from ..plots import visible
from ..state import State
from ..widgets import Part

#: Width and height of a picture in points, and where its plots are: left, top, width and height.
_SIZE, _WHOLE = (840, 624), (0, 0, 840, 600)
_SCREEN = (1280, 720)
_PLACES = {"springs": (0, 0, 640, 348), "pressure": (0, 348, 640, 348), "force": (640, 0, 640, 696)}
#: With a fourth plot, which is below the force.
_WITH_FOURTH = _PLACES | {"force": (640, 0, 640, 348)}
_FOURTH = (640, 348, 640, 348)


class Legends(Service):
    """Legends and the scene of pictures that are saved, as of the last rest of a session."""

    def __init__(self, page: Any):
        super().__init__(page)
        self._legends: dict[str, Any] = {}

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {"save": self._legends}

    def rest(self, view: View) -> None:
        self._legends["scene"] = summary(view.state)
        self._legends["file"] = file_name(view.state, "")
        for plot in visible(view):
            # While a plot is searched, all that it will draw: a picture names what is seen in it.
            called = drawn(view, plot) or {row.name: row.name for row in rows_of(plot)}
            rows = [unicode_subscripts(called[row.name]) for row in in_legend(plot, called)]
            self._legends[plot.name] = {"rows": rows, "title": plot.title}


def save(label: str, name: str, places: dict[str, Any], size: tuple[int, int], view: View) -> Part:
    """A button that saves the picture of plots, in the browser, with the scene below it."""
    legends = view.computed["save"]
    looks = [legends.get(each, {"rows": [], "title": ""}) for each in places]
    plots = [{"figure": figure, "place": place} for figure, place in places.items()]
    look = {"label": label, "looks": looks, "scene": legends.get("scene", "")}
    look["file"] = legends.get("file", "") + name
    return Part("save", label, look | {"plots": plots, "size": size})


def of_plot(page: Any, plot: Plot, view: View) -> Part:
    return save("Save", plot.name, {plot.name: _WHOLE}, _SIZE, view)


def of_all(page: Any, view: View) -> Part:
    """The button that saves the plots that are seen as one picture."""
    names = [plot.name for plot in visible(view)]
    known = _PLACES if len(names) == len(_PLACES) else _WITH_FOURTH
    return save("Save plots", "plots", {name: known.get(name, _FOURTH) for name in names}, _SCREEN, view)


EXTRA = Extra("save", order=32, on_plots=of_plot, header=of_all, service=Legends)
