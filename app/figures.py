"""Figures from the entries of `PLOTS`: rendered once by HoloViews, and copied for every session."""

from functools import cache

import holoviews as hv
import holoviews.plotting.bokeh
import numpy as np
from bokeh.document import Document
from bokeh.models import (
    BoxZoomTool,
    CategoricalColorMapper,
    ColorBar,
    HoverTool,
    Legend,
    LegendItem,
    LinearAxis,
    Range1d,
    ResetTool,
)

from .columns import PIXELS
from .plots import PLOTS, ROLES, line

hv.Store.set_current_backend("bokeh")

FONT = "Helvetica Neue, Helvetica, Arial, sans-serif"
LIGHT = {role: colours[0] for role, colours in ROLES.items()}
DARK = {role: colours[1] for role, colours in ROLES.items()}
#: What the pointer is told: the point of the curve next to it, from the columns drawn.
TIP = "<b>@row</b><br>@symbol = @y{{%.4g}} @unit<br>{symbol} = @x{{%.4g}} {unit}"
_DASHES = {"solid": "solid", "dashed": "6 4", "dotted": "2 3", "dotdash": "6 3 2 3"}
_PATH = {"x": np.array([1.0, 2, 3]), "y": np.array([1.0, 2, 1])}


def _paths(element, rows, look):
    """An element of one path for each row, its colour by role."""
    data = [_PATH | {"row": row.name, "role": row.role} | row.look for row in rows]
    return element(data, vdims=["row", "role", *look]).opts(color="role", cmap=LIGHT)


def _rows(plot):
    """All rows of a plot; the edge of a body is a line, which ends where the body leaves the plot."""
    edges = (line(row.name, "ink", 1.8, legend=False) for row in plot.rows if row.role == "body")
    return (*edges, *plot.rows)


def _elements(plot):
    """The plot in HoloViews: few elements, each with all rows of a kind on one axis."""
    rows = {(kind, axis): [] for axis in (1, 2) for kind in ("areas", "lines", "marks", "labels")}
    for row in _rows(plot):
        rows[row.kind, row.axis].append(row)
    if plot.image:
        image = hv.Image(np.ones((PIXELS, PIXELS)), bounds=(-1, -1, 1, 1), group="image")
        yield image.opts(cmap="cividis", colorbar=True, clim=(0, 1))
    for (kind, axis), some in rows.items():
        at = np.arange(1.0, len(some) + 1)
        if not some:
            continue
        if kind == "areas":
            made = _paths(hv.Polygons, some, ("alpha", "hatch")).opts(line_alpha=0)
        elif kind == "lines":
            made = _paths(hv.Contours, some, ("width", "dash")).opts(line_width="width")
        elif kind == "marks":
            look = [(row.name, row.role, *row.look.values()) for row in some]
            made = hv.Scatter(
                (at, at, *zip(*look, strict=True)), "x", ["y", "row", "role", "edge", "marker", "size"]
            )
            made.opts(color="role", cmap=LIGHT, marker="marker", size="size", line_width=1.6)
        else:
            made = hv.Labels((at, at, [row.name for row in some])).opts(
                text_color=LIGHT["ink"], text_font_size="12px", text_font_style="italic", text_align="left",
                text_baseline="top",
            )  # fmt: skip
        yield made.relabel(group=kind if axis == 1 else f"{kind} right")
    for axis in sorted({row.axis for row in plot.rows if row.symbol}):
        nothing = hv.Scatter(([1.0], [1.0]), "x", "y", group="tips" if axis == 1 else "tips right")
        yield nothing.opts(alpha=0, size=9)


def _rendered(name):
    """One plot as a Bokeh figure: what HoloViews renders, and what it has no options for."""
    plot, renderers = PLOTS[name], {}

    def note(handles, element):
        renderers[element.group] = handles.handles["glyph_renderer"]

    elements = [element.opts(hooks=[note]) for element in _elements(plot)]
    options = {"logx": True, "logy": True, "xlim": (1e-6, 10), "ylim": (1e-17, 1)} if plot.log else {}
    overlay = hv.Overlay(elements).opts(
        hv.opts.Overlay(
            title=plot.title,
            responsive=True,
            show_legend=False,
            show_grid=True,
            default_tools=[],
            **({"xlim": (0, 1), "ylim": (0, 1)} | options),
        )
    )
    figure = hv.renderer("bokeh").get_plot(overlay).state
    figure.name = name
    if len(plot.axes) == 3:
        figure.extra_y_ranges = {"right": Range1d(0, 1)}
        figure.add_layout(LinearAxis(y_range_name="right"), "right")
    for group, renderer in renderers.items():
        renderer.update(
            name=group, selection_glyph=None, nonselection_glyph=None, muted_glyph=None, hover_glyph=None
        )
        _finished(renderer, group, plot)
        if not plot.log:
            # On a canvas above the axes, which are not painted again with the data; it does not clip.
            renderer.level = "overlay"
    # Of roles, where rows are to be named.
    figure.center = [part for part in figure.center if not isinstance(part, Legend)]
    _look(figure)
    return figure


def legend(figure):
    """A legend for the pictures that are saved: on the page Bokeh would lay it out anew at every paint."""
    renderers = {renderer.name: renderer for renderer in figure.renderers}
    items = [
        LegendItem(label=row.name, name=row.name, renderers=[renderers[group]], index=index)
        for group, index, row in placed(PLOTS[figure.name])
        if row.legend
    ]
    return Legend(
        items=items, orientation="horizontal", ncols=5, location="left", margin=0, padding=2, spacing=7,
        label_standoff=5, glyph_width=20, glyph_height=12, label_height=12, label_text_font=FONT,
        label_text_font_size="11px", border_line_color=None, background_fill_color=None,
    )  # fmt: skip


def placed(plot):
    """Every row with the group it is drawn in, and its place there."""
    counts = {}
    for row in _rows(plot):
        group = row.kind if row.axis == 1 else f"{row.kind} right"
        yield group, counts.setdefault(group, 0), row
        counts[group] += 1


def _finished(renderer, group, plot):
    """What HoloViews has no options for: dashes, hatches and edges by row, the axis on the right."""
    glyph, source = renderer.glyph, renderer.data_source
    rows = [row for place, _, row in placed(plot) if place == group]
    kind, role = group.split()[0], {"field": "role", "transform": mapper()}
    at = {key: value for key, value in source.data.items() if key in ("x", "y", "xs", "ys")}
    looks = {key: [row.look[key] for row in rows] for key in (rows[0].look if rows else ())}
    if kind == "lines":
        looks["dash"] = [_DASHES[dash] for dash in looks["dash"]]
    names = {"row": [row.name for row in rows], "role": [row.role for row in rows]}
    if kind == "areas":
        glyph.update(fill_color=role, hatch_color=role, fill_alpha="alpha")
        if set(looks["hatch"]) != {" "}:
            glyph.update(hatch_pattern="hatch", hatch_alpha=0.35, hatch_scale=10)
    elif kind == "lines":
        names |= {"symbol": [row.symbol for row in rows], "unit": [""] * len(rows)}
        glyph.update(line_color=role, line_dash="dash", line_width="width")
    elif kind == "marks":
        edge = {"field": "edge", "transform": role["transform"]}
        glyph.update(
            fill_color=role,
            hatch_color=role,
            line_color=edge,
            marker={"field": "marker"},
            size={"field": "size"},
        )
    elif kind == "labels":
        at["Label"] = source.data["Label"]
    if kind in ("areas", "lines", "marks", "labels"):
        source.data = at | looks | names
    if kind == "tips":
        # There to be found by the pointer only.
        glyph.update(fill_color=None, line_color=None, hatch_color=None)
    if group.endswith("right"):
        renderer.y_range_name = "right"


def mapper():
    """From roles to colours; another palette is another theme."""
    return CategoricalColorMapper(factors=list(LIGHT), palette=list(LIGHT.values()))


def _look(figure):
    figure.update(background_fill_color=None, border_fill_color=None, outline_line_color=None)
    # The outermost pixels of a canvas keep a trace of the colour before the last one.
    figure.styles = {"clip-path": "inset(1px)"}
    figure.update(output_backend="canvas", sizing_mode="stretch_both", min_height=200)
    figure.update(min_border_left=66, min_border_right=18, min_border_top=8, min_border_bottom=46)
    figure.update(toolbar_location="above", toolbar_inner=True)
    # Bokeh looks at titles at every paint, also at hidden ones: it is in the picture that is saved.
    figure.title = None
    tips = [renderer for renderer in figure.renderers if renderer.name.startswith("tips")]
    told = {
        "tooltips": TIP,
        "formatters": {"@x": "printf", "@y": "printf"},
        "attachment": "right",
        "limit": 1,
    }
    hovers = [HoverTool(renderers=tips, visible=False, **told)] if tips else []
    # Nothing is armed: a drag in the plot of the force goes along the curve.
    tools = [*hovers, BoxZoomTool(), ResetTool()]
    figure.toolbar.update(autohide=True, logo=None, tools=tools, active_drag=None, active_scroll=None)
    for axis in figure.axis:
        axis.update(minor_tick_line_color=None, major_tick_in=0, axis_label_text_font_style="normal")
        axis.update(major_label_text_font=FONT, major_label_text_font_size="11px")
        axis.update(axis_label_text_font=FONT, axis_label_text_font_size="12px")
    for bar in figure.right:
        if isinstance(bar, ColorBar):
            bar.update(
                background_fill_color=None, bar_line_color=None, major_label_text_font=FONT, padding=2
            )
            bar.update(title_text_font=FONT, title_text_font_size="11px", title_text_font_style="normal")


@cache
def _made(name):
    document = Document()
    document.add_root(_rendered(name))
    return document.to_json(deferred=False)


def figure(name):
    """A figure of one session: a copy of what was rendered once."""
    document = Document.from_json(_made(name))
    made = document.roots[0]
    document.clear()
    for renderer in made.renderers:
        # Columns and colours come from the server, or from what it has sent: never the other way.
        renderer.data_source.syncable = False
    return made
