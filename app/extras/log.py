"""The button *Log* of a plot: logarithmic axes, on which powers are straight lines."""

from dataclasses import replace
from typing import Any

import numpy as np

from mdr_core.show.figures import NOTHING, Axis

from ..extra import Extra
from ..parts import Part, button
from ..plot import Overlay, Plot, View, rows_of
from ..plots import PLOTS
from ..shared.logarithmic import Logarithmic
from ..state import State

#: Plots whose axes can be logarithmic. All but the force over depth find their own, as they do others.
_PLOTS = ("force", "hardness")


def switch(page: Any, plot: Plot, view: View) -> Part | None:
    """The button *Log* of a plot."""
    if plot.name not in _PLOTS:
        return None
    pressed = plot.name in view.state["log.plots"]
    return button("Log", lambda: page.apply(lambda state: switched(state, plot.name)), pressed=pressed)


def switched(state: State, name: str) -> State:
    """With logarithmic axes of a plot, or with linear ones again."""
    plots = state["log.plots"]
    others = tuple(plot for plot in plots if plot != name)
    return state.replace(**{"log.plots": others if len(others) < len(plots) else (*plots, name)})


class Switched(Logarithmic):
    """A plot on linear axes, or on logarithmic ones if they are asked for."""

    def axes_of(self, view: View) -> list[Axis]:
        axes = super().axes_of(view)
        if self.plot.name not in view.state["log.plots"]:
            return axes
        curves = [row for row in view.places(self.plot, view.course.peak).values() if len(row) == 2]
        return [logarithmic(axis, [row[k] for row in curves]) for k, axis in enumerate(axes)]


def logarithmic(axis: Axis, columns: list[Any]) -> Axis:
    """The axis, logarithmic from a power of ten below its least positive value, six decades at most."""
    positive = [float(part[part > 0].min()) for part in map(np.asarray, columns) if (part > 0).any()]
    least = max(min(positive, default=axis.end), 1e-6 * axis.end)
    power = np.floor(np.log10(least / axis.factor))
    return replace(axis, start=float(10.0**power) * axis.factor, log=True)


def hidden(view: View, i: int) -> dict:
    """Nothing for areas and labels, which have no place on logarithmic axes."""
    if "force" not in view.state["log.plots"]:
        return {}
    rows = rows_of(PLOTS["force"])
    return {row.name: (*NOTHING, "") for row in rows if row.kind in ("areas", "labels")}


EXTRA = Extra(
    "log",
    # After all others that draw over the force, before the button that saves a plot.
    order=31,
    values={"log.plots": ()},
    of_view=("log.plots",),
    overlays=(Overlay("force", (), hidden, picture=Switched),),
    on_plots=switch,
)
