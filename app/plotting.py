"""How a plot is declared once in HoloViews and rendered once for everybody: layers, legend, one look."""

from dataclasses import dataclass, field

import holoviews as hv
import holoviews.plotting.bokeh
import numpy as np
from bokeh.document import Document
from bokeh.models import ColorBar, ColumnDataSource, HoverTool, Legend, Line, LinearAxis, Range1d, Scatter

hv.Store.set_current_backend("bokeh")

# Okabe–Ito; the three states mean the same thing in every plot.
FREE, ELASTIC, YIELDED = "#8a8f98", "#0072b2", "#d55e00"
HELD, SPEED, LOSS = "#aa4499", "#009e73", "#b8860b"
INK, PAPER, RULE, BODY = "#22272e", "#ffffff", "#e6e8eb", "#c9ced6"
FONT = "Helvetica Neue, Helvetica, Arial, sans-serif"

#: Drawn as nothing, but there.
_NOWHERE = {"text": ["", ""]}
_FIELDS = ("x", "y", "x0", "x1", "text", "image", "dw", "dh")

# Positive, as logarithmic axes need.
_TWO = np.ones(2)


def curve(label, **options):
    """A line; the page draws in it."""
    return hv.Curve((_TWO, _TWO), "x", "y", label=label).opts(**options)


def area(label, **options):
    """A filled polygon."""
    return hv.Area((_TWO, _TWO), "x", "y", label=label).opts(line_alpha=0, **options)


def points(label, **options):
    """Markers."""
    return hv.Scatter((_TWO, _TWO), "x", "y", label=label).opts(**options)


def verticals(label, **options):
    """Vertical lines through the whole plot."""
    return hv.VLines(_TWO, label=label).opts(**options)


def names(label, **options):
    """Short texts in the plot."""
    options = {"text_font_size": "12px", "text_color": INK, "text_font_style": "italic"} | options
    return hv.Labels((_TWO, _TWO, ["", ""]), label=label).opts(**options)


@dataclass
class Plot:
    """A plot declared in HoloViews and rendered once; every browser makes its own figure of it.

    No session has figures on the server: nothing to build, to keep or to walk through.

    Parameters
    ----------
    name, title, equation : str
        Its key, its heading, and the formula that it shows (a key of `equations.EQUATIONS`).
    overlay : hv.Overlay
        Elements with labels, under which the page draws in them.
    axes : tuple of str
        Keys of the axes that it shows: x, y, and one on the right if there is a third.
    right : tuple of str
        Layers that are drawn over the axis on the right.
    hatched : tuple of str
        Areas with a hatch, so that they do not differ by colour alone.
    """

    name: str
    title: str
    equation: str
    overlay: hv.Overlay
    axes: tuple[str, ...]
    right: tuple[str, ...] = ()
    hatched: tuple[str, ...] = ()
    legend: list = field(init=False)
    figure: object = field(init=False, repr=False)

    def __post_init__(self):
        overlay = self.overlay.opts(
            hv.opts.Overlay(
                title="",
                responsive=True,
                min_height=200,
                toolbar="above",
                default_tools=["box_zoom", "wheel_zoom", "reset"],
                active_tools=[],
                show_grid=True,
            )
        )
        plot = hv.renderer("bokeh").get_plot(overlay)
        figure = plot.state
        for element, key in zip(overlay, plot.subplots, strict=True):
            _strip(plot.subplots[key].handles["glyph_renderer"], element.label)
        renderers = {renderer.name: renderer for renderer in figure.renderers}
        for label in self.hatched:
            # Not an option of HoloViews' areas.
            glyph = renderers[label].glyph
            glyph.update(hatch_pattern="right_diagonal_line", hatch_color=glyph.fill_color)
            glyph.update(hatch_alpha=0.35, hatch_scale=10)
        if self.right:
            figure.extra_y_ranges = {"right": Range1d(0, 1)}
            figure.add_layout(LinearAxis(y_range_name="right"), "right")
            for label in self.right:
                renderers[label].y_range_name = "right"
        figure.name = self.name
        self.legend = [_entry(item) for legend in figure.legend for item in legend.items]
        figure.center = [part for part in figure.center if not isinstance(part, Legend)]
        _look(figure)
        if "t" in self.axes:
            # As wide as an axis on the right, so that times stand under each other.
            figure.min_border_right = 66
        self.figure = figure

    def described(self):
        """What the page writes around it."""
        return {
            "name": self.name,
            "title": self.title,
            "equation": self.equation,
            "legend": self.legend,
            "axes": self.axes,
        }


def _strip(renderer, label):
    """Take off what is never shown, and name the columns alike in every glyph."""
    glyph = renderer.glyph
    # Nothing is selected or muted here: fewer glyphs to send.
    renderer.update(name=label, selection_glyph=None, nonselection_glyph=None)
    renderer.update(muted_glyph=None, hover_glyph=None)
    fields = [name for name in _FIELDS if name in glyph.properties()]
    if "image" not in fields:
        data = {name: _NOWHERE.get(name, [np.nan, np.nan]) for name in fields if getattr(glyph, name, None)}
        renderer.data_source = ColumnDataSource(data)
        glyph.update(**{name: name for name in data})


def _look(figure):
    figure.update(
        background_fill_color=PAPER,
        border_fill_color=PAPER,
        outline_line_color=None,
        border_line_color=None,
        toolbar_inner=True,
        output_backend="canvas",
        sizing_mode="stretch_both",
        # Frames of plots that share an axis start and end at the same place.
        min_border_left=66,
        min_border_right=18,
        min_border_top=8,
        min_border_bottom=44,
    )
    figure.toolbar.update(autohide=True, logo=None)
    for grid in figure.grid:
        grid.grid_line_color = RULE
    for axis in figure.axis:
        axis.update(
            axis_line_color="#9aa0a8",
            major_tick_line_color="#9aa0a8",
            minor_tick_line_color=None,
            # The page draws these, in the margin.
            visible=not isinstance(axis, LinearAxis),
            major_label_text_font=FONT,
            major_label_text_font_size="11px",
            major_label_text_color="#4a515b",
            axis_label_text_font=FONT,
            axis_label_text_font_size="12px",
            axis_label_text_font_style="normal",
            axis_label_text_color=INK,
        )
    for bar in figure.right:
        if isinstance(bar, ColorBar):
            bar.update(background_fill_color=PAPER, bar_line_color=None, major_tick_line_color=INK)
            bar.update(major_label_text_color=INK, title_text_color=INK, title_text_font_style="normal")
            bar.update(major_label_text_font=FONT, title_text_font=FONT, title_text_font_size="12px")
    for tool in figure.toolbar.tools:
        if isinstance(tool, HoverTool):
            tool.tooltips = [("x", "$x"), ("y", "$y")]


def _entry(item):
    """One entry of a legend, which the page draws outside the canvas."""
    glyph, label = item.renderers[0].glyph, item.label.value
    if isinstance(glyph, Line):
        dash = list(glyph.line_dash)
        return {
            "label": label,
            "mark": "line",
            "colour": glyph.line_color,
            "width": glyph.line_width,
            "dash": dash,
        }
    if isinstance(glyph, Scatter):
        return {"label": label, "mark": "dot", "colour": glyph.fill_color, "edge": glyph.line_color}
    return {
        "label": label,
        "mark": "area",
        "colour": glyph.fill_color,
        "alpha": glyph.fill_alpha,
        "hatch": glyph.hatch_pattern is not None,
    }


def encoded(plots):
    """Figures as a Bokeh document that a browser can read, and their names in its order."""
    document = Document()
    for plot in plots:
        document.add_root(plot.figure)
    return {"names": [plot.name for plot in plots], "document": document.to_json(deferred=False)}
