"""Figures from the entries of `PLOTS`: rendered once by HoloViews, and copied for every session."""

from functools import cache

import bokeh.models as bk
import holoviews as hv
import holoviews.plotting.bokeh
import numpy as np
from bokeh.document import Document

from mdr_core.results.figures import DASHES, ROLES

from .plots import PLOTS

hv.Store.set_current_backend("bokeh")

FONT = "Helvetica Neue, Helvetica, Arial, sans-serif"
LIGHT = {role: colours[0] for role, colours in ROLES.items()}
DARK = {role: colours[1] for role, colours in ROLES.items()}
#: What the pointer is told: the point of the curve next to it, from the columns drawn.
_TIP = "<b>@row</b><br>{own} = @y{{%.4g}} {y.unit}<br>{symbol} = @x{{%.4g}} {x.unit}"
_LABEL = {"text_font_size": "12px", "text_font_style": "italic", "text_align": "left"}
_LABEL |= {"text_baseline": "top", "text_color": LIGHT["ink"]}
_PATH = {"x": np.array([1.0, 2, 3]), "y": np.array([1.0, 2, 1])}
#: Of the pictures that are saved; on the page Bokeh would lay a legend out anew at every paint.
LEGEND = {
    "orientation": "horizontal", "ncols": 5, "location": "left", "margin": 0, "padding": 2, "spacing": 7,
    "label_standoff": 5, "glyph_width": 20, "glyph_height": 12, "label_height": 12, "label_text_font": FONT,
    "label_text_font_size": "11px", "border_line_color": None, "background_fill_color": None,
}  # fmt: skip


def _element(kind, count):
    """A HoloViews element with places for so many rows of a kind."""
    at = np.arange(1.0, count + 1)
    if kind == "labels":
        return hv.Labels((at, at, ["-"] * count)).opts(**_LABEL)
    if kind in ("marks", "tips"):
        return hv.Scatter((at, at), "x", "y").opts(size=9)
    return (hv.Polygons if kind == "areas" else hv.Contours)([_PATH] * count)


def _elements(plot):
    """The plot in HoloViews: few elements, each with all rows of a kind on one axis."""
    if plot.image:
        image = hv.Image(np.ones(plot.image), bounds=(0, 0, 1, 1), group="image")
        yield image.opts(cmap="cividis", colorbar=True, clim=(0, 1))
    for group in ("areas", "lines", "lines right", "marks", "marks right", "labels"):
        rows = [row for row in plot.rows if row.group == group]
        if rows:
            yield _element(rows[0].kind, len(rows)).relabel(group=group)
        if any(row.symbol for row in rows):
            yield _element("tips", 1).relabel(group=group.replace("lines", "tips"))


def _rendered(name):
    """One plot as a Bokeh figure: what HoloViews renders, and what it has no options for."""
    plot, renderers = PLOTS[name], {}

    def note(handles, element):
        renderers[element.group] = handles.handles["glyph_renderer"]

    elements = [element.opts(hooks=[note]) for element in _elements(plot)]
    look = {"responsive": True, "show_legend": False, "show_grid": True, "default_tools": []}
    look |= {"logx": True, "logy": True} if plot.log else {"xlim": (0, 1), "ylim": (0, 1)}
    figure = hv.renderer("bokeh").get_plot(hv.Overlay(elements).opts(**look)).state
    figure.name = name
    if any(row.axis == 2 for row in plot.rows):
        figure.extra_y_ranges = {"right": bk.Range1d(0, 1)}
        figure.add_layout(bk.LinearAxis(y_range_name="right"), "right")
    # From roles to colours; another palette is another theme.
    mapper = bk.CategoricalColorMapper(factors=list(LIGHT), palette=list(LIGHT.values()))
    only = dict.fromkeys(("selection_glyph", "nonselection_glyph", "muted_glyph", "hover_glyph"))
    for group, renderer in renderers.items():
        renderer.update(name=group, **only)
        _finished(renderer, mapper, [row for row in plot.rows if row.group == group])
        # On a canvas above the axes, which are not painted again with the data; it does not clip.
        renderer.level = "overlay"
    _look(figure)
    return figure


def _finished(renderer, mapper, rows):
    """What HoloViews has no options for: dashes, hatches and edges by row, the axis on the right."""
    glyph, source, kind = renderer.glyph, renderer.data_source, renderer.name.split()[0]
    role, edge = ({"field": field, "transform": mapper} for field in ("role", "edge"))
    looks = {key: [row.look[key] for row in rows] for key in (rows[0].look if rows else ())}
    if kind == "areas":
        glyph.update(fill_color=role, hatch_color=role, fill_alpha="alpha", line_color=None)
        if set(looks["hatch"]) != {" "}:
            glyph.update(hatch_pattern="hatch", hatch_alpha=0.35, hatch_scale=10)
    elif kind == "lines":
        looks["dash"] = [DASHES[dash] for dash in looks["dash"]]
        glyph.update(line_color=role, line_dash="dash", line_width="width")
    elif kind == "marks":
        glyph.update(fill_color=role, hatch_color=role, line_color=edge, line_width=1.6)
        glyph.update(marker={"field": "marker"}, size={"field": "size"})
    elif kind == "labels":
        # To be read where lines pass below.
        glyph.update(background_fill_color=LIGHT["paper"], background_fill_alpha=0.8)
    elif kind == "tips":
        # There to be found by the pointer only.
        glyph.update(fill_color=None, line_color=None, hatch_color=None)
    if kind in ("areas", "lines", "marks"):
        at = {key: value for key, value in source.data.items() if key in ("x", "y", "xs", "ys")}
        source.data = at | looks | {"row": [row.name for row in rows], "role": [row.role for row in rows]}
    if renderer.name.endswith("right"):
        renderer.y_range_name = "right"


def _look(figure):
    figure.update(background_fill_color=None, border_fill_color=None, outline_line_color=None)
    # The outermost pixels of a canvas keep a trace of the colour before the last one.
    figure.styles = {"clip-path": "inset(1px)"}
    figure.update(output_backend="canvas", sizing_mode="stretch_both", min_height=200)
    figure.update(min_border_left=66, min_border_right=18, min_border_top=8, min_border_bottom=46)
    # Bokeh looks at titles at every paint, also at hidden ones: it is in the picture that is saved.
    figure.update(toolbar_location="above", toolbar_inner=True, title=None)
    told = {"formatters": {"@x": "printf", "@y": "printf"}, "attachment": "right", "limit": 1}
    tips = [renderer for renderer in figure.renderers if renderer.name.startswith("tips")]
    hovers = [bk.HoverTool(renderers=[each], name=each.name, visible=False, **told) for each in tips]
    # Nothing is armed: a drag in the plot of the force goes along the curve.
    tools = [*hovers, bk.BoxZoomTool(), bk.ResetTool()]
    figure.toolbar.update(autohide=True, logo=None, tools=tools, active_drag=None, active_scroll=None)
    for axis in figure.axis:
        axis.update(minor_tick_line_color=None, major_tick_in=0, axis_label_text_font_style="normal")
        axis.update(axis_label_text_font=FONT, axis_label_text_font_size="12px")
        axis.update(major_label_text_font=FONT, major_label_text_font_size="11px")
    for bar in _bars(figure):
        bar.update(background_fill_color=None, bar_line_color=None, major_label_text_font=FONT, padding=2)
        bar.update(title_text_font=FONT, title_text_font_size="11px", title_text_font_style="normal")


def _bars(figure):
    return [side for side in figure.right if isinstance(side, bk.ColorBar)]


def set_axes(figure, axes):
    """Show axes on a figure: their ends, titles and units."""
    ranges = (figure.x_range, figure.y_range, figure.extra_y_ranges.get("right"))
    sides = (figure.below[0], figure.left[0], *figure.right[:1])
    for bounds, side, axis in zip(ranges, sides, axes, strict=False):
        if bounds is not None:
            start, end = axis.ends
            bounds.update(start=start, end=end, reset_start=start, reset_end=end)
            side.axis_label = axis.label
            _scale(figure, side, axis)
    symbols = {row.symbol for row in PLOTS[figure.name].rows if row.symbol}
    for hover in (tool for tool in figure.toolbar.tools if isinstance(tool, bk.HoverTool)):
        x, y = axes[0], axes[2 if hover.name.endswith("right") else 1]
        # Rows of whatever the axis has.
        own = y.title.split(",")[0] if symbols == {"y"} else "@symbol"
        hover.tooltips = _TIP.format(symbol=x.title.split(",")[0], own=own, x=x, y=y)
    for bar in _bars(figure):
        low, high = axes[2].ends
        bar.color_mapper.update(low=low, high=high)
        bar.title = f"{axes[2].title.split(',')[0]} ({axes[2].unit})"


def _scale(figure, side, axis):
    """Make the scale along one side of a figure logarithmic, or linear again."""
    name = "x_scale" if side is figure.below[0] else "y_scale"
    log = axis.log or PLOTS[figure.name].log
    if isinstance(getattr(figure, name), bk.LogScale) != log:
        setattr(figure, name, bk.LogScale() if log else bk.LinearScale())
    elif not log:
        return
    ticker, formatter = ticks(*axis.ends) if log else (bk.BasicTicker(), bk.BasicTickFormatter())
    side.update(ticker=ticker, formatter=formatter)
    for grid in (each for each in figure.center if getattr(each, "axis", None) is side):
        grid.ticker = side.ticker


def ticks(low, high):
    """Ticker and formatter of a logarithmic axis; over two decades or less Bokeh's has too many."""
    if high > 101 * low:
        return bk.LogTicker(), bk.LogTickFormatter()
    powers = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    fixed = bk.FixedTicker(ticks=[float(f"{n}e{power:.0f}") for power in powers for n in (1, 2, 5)])
    return fixed if high > 5 * low else bk.BasicTicker(), bk.BasicTickFormatter()


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
