"""Plots of results as HoloViews elements. HoloViews is imported when a result is plotted."""

import numpy as np

from ..base.errors import MDRError
from ..base.results import check_single, quantities_of
from ..solver.contact.indentation import Indentation
from . import figures
from .figures import FORCE_ROWS, NOTHING, PRESSURE_ROWS, Axis, line, parts
from .quantities import QUANTITIES, engineering
from .report import imported, title
from .springs import REST, SPRING_ROWS, springs


def overlay(heading, rows, columns, axes):
    """Return a plot as a HoloViews overlay, with one element for each row with data."""
    hv = imported("holoviews", "a plot", "holoviews bokeh")
    if not hv.Store.loaded_backends():
        hv.extension("bokeh", logo=False)
    bokeh, made = "bokeh" in hv.Store.loaded_backends(), []
    dims = [hv.Dimension((axis.name, axis.title), unit=axis.unit or None) for axis in axes]
    for row in rows:
        x, y, *text = columns.get(row.name, NOTHING)
        if not np.isfinite(y).any() or text == [""]:
            continue
        x, y = (np.asarray(v) / axis.factor for v, axis in zip((x, y), axes, strict=True))
        named = {"label": row.name} if row.legend else {}
        if row.kind == "lines":
            element = hv.Curve((x, y), dims[0], dims[1], **named)
        elif row.kind == "marks":
            element = hv.Scatter((x, y), dims[0], dims[1], **named)
        elif row.kind == "areas":
            element = hv.Polygons([{dims[0].name: x, dims[1].name: y}], dims, **named)
        else:
            element = hv.Labels(([x], [y], text), dims, "text")
        # HoloViews does not support hatches.
        look = {name: value for name, value in row.look_in(False).items() if "hatch" not in name}
        made.append(element.opts(backend="bokeh", **look) if bokeh else element)
    look = {"title": heading, "width": 600, "height": 400, "show_grid": True, "legend_position": "right"}
    look |= {"xlim": axes[0].ends, "ylim": axes[1].ends}
    return hv.Overlay(made).opts(backend="bokeh", **look) if bokeh else hv.Overlay(made)


def plot_curve(result, quantity, over):
    """Plot a quantity of a result over another quantity: `Result.plot`."""
    quantities = quantities_of(result)
    for name in {quantity, over} - set(quantities):
        known = ", ".join(quantities)
        remedy = "plot the motion() of one impact, or two" if hasattr(result, "motion") else "take two"
        raise MDRError(f"{type(result).__name__} has no {name!r} to plot: {remedy} of {known}")
    if len(result.shape) != 1:
        raise MDRError(f"plot() needs a single path, but this result has shape {result.shape}: select one")
    x, y = (np.asarray(getattr(result, name)) for name in (over, quantity))
    axes = [_axis_of(name, values) for name, values in ((over, x), (quantity, y))]
    if {"depth", "plastic_depth"} <= set(quantities):
        columns = figures.split(x, y, result.depth, result.plastic_depth)
        if (quantity, over) == ("force", "depth") and _stores(result):
            columns |= figures.work(result, len(x) - 1)
            return overlay(title(result), FORCE_ROWS, columns, axes)
        return overlay(title(result), parts(""), columns, axes)
    return overlay(title(result), [line("", "elastic", legend=False)], {"": (x, y)}, axes)


def _stores(path):
    """Whether the area below the unloading of a path is its stored energy, as it is without adhesion."""
    return isinstance(path, Indentation) and path.shape[0] > 0 and not np.any(path.medium.work_of_adhesion)


def _axis_of(name, values):
    known = QUANTITIES[name]
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    return Axis.fitting(name, known.title, known.unit, largest)


def plot_pressure(state):
    """Plot the contact pressure of one state: `Indentation.plot_pressure`."""
    half = _drawn_radius(state, "plot_pressure")
    top = 1.05 * figures.ceiling(state, half)
    bottom = -top if state.medium.work_of_adhesion > 0 else 0.0
    axes = [
        Axis.fitting("r", "r, radius", "m", half, start=-half, end=half),
        Axis.fitting("pressure", "p, contact pressure", "Pa", top, start=bottom, end=top),
    ]
    return overlay("Contact pressure", PRESSURE_ROWS, figures.pressure(state, half, top), axes)


def plot_springs(state):
    """Plot the springs of the 1D foundation in one state: `Indentation.plot_springs`."""
    half = _drawn_radius(state, "plot_springs")
    height = max(float(state.depth), float(state.live_interval.upper))
    base = -REST * height
    axes = [
        Axis.fitting("x", "x, coordinate of the springs", "m", half, start=-half, end=half),
        Axis.fitting("z", "z, upward", "m", height, start=base, end=height),
    ]
    return overlay("1D foundation", SPRING_ROWS, springs(state, half, base, height), axes)


def _drawn_radius(state, what):
    """Return the half-width (m) of a plot: 1.25 times the radius of the contact or of the imprint."""
    check_single(state, what)
    largest = max(float(state.contact_radius), float(state.plastic_radius))
    if not largest:
        depth = engineering(state.depth, "m")
        raise MDRError(f"{what} needs a contact or an imprint, and there is none at d = {depth}")
    return 1.25 * largest
