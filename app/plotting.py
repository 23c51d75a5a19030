"""How a plot is declared once in HoloViews and then streamed to: layers, axes, one look."""

from html import escape

import holoviews as hv
import holoviews.plotting.bokeh
import numpy as np
from bokeh.core.serialization import Deserializer, Serializer
from bokeh.models import ColumnDataSource, HoverTool, Legend, Line, Scatter

from .units import fitting, round_up

hv.Store.set_current_backend("bokeh")

# Okabe–Ito; the three states mean the same thing in every plot.
FREE, ELASTIC, YIELDED = "#8a8f98", "#0072b2", "#d55e00"
INK, PAPER, RULE = "#22272e", "#ffffff", "#e6e8eb"
_FONT = "Helvetica Neue, Helvetica, Arial, sans-serif"

#: Drawn as nothing, but with its entry in the legend.
NOWHERE = (np.nan, np.nan)
_SHORT = 16


class Layer:
    """Data of one glyph, or of several over the same abscissae, of a rendered plot."""

    def __init__(self, source, columns):
        self.source, self.columns = source, columns

    def show(self, **columns):
        """Replace the data. Long columns travel as float32, each as a message; short ones as text."""
        self.source.data = {self.columns[name]: _sent(values) for name, values in columns.items()}

    def hide(self):
        """Draw nothing."""
        self.show(**{name: NOWHERE for name, column in self.columns.items() if column in self.source.data})


def _sent(values):
    return np.asarray(values, np.float32) if len(values) > _SHORT else np.asarray(values).tolist()


class Axis:
    """An axis that shows one quantity: its unit and its end follow the data in round steps."""

    def __init__(self, label, kind, axes, range_):
        self.label, self.kind, self.axes, self.range = label, kind, axes, range_
        self.unit, self.limits = None, None

    def fit(self, largest, below=0.0):
        """Let the axis end at the next round number above `largest` (SI).

        `below` is how far it goes below zero, as a multiple of that. Returns the end in SI.
        """
        self.unit = fitting(largest, self.kind)
        end = round_up(largest / self.unit.factor)
        if end >= 1000:
            self.unit = fitting(end * self.unit.factor, self.kind)
            end = round_up(largest / self.unit.factor)
        limits = (-below * end, end, self.unit)
        if limits != self.limits:
            self.limits = limits
            # The reset tool goes back to where the server put the axis.
            self.range.update(start=limits[0], end=end, reset_start=limits[0], reset_end=end)
            for each in self.axes:
                each.axis_label = self.unit.label(self.label)
        return end * self.unit.factor

    def follow(self, other):
        """Take unit and end of an axis whose range this one shares."""
        if self.limits != other.limits:
            self.unit, self.limits = other.unit, other.limits
            for each in self.axes:
                each.axis_label = self.unit.label(self.label)

    def __call__(self, values):
        """Values in SI in the unit of the axis."""
        return np.asarray(values) / self.unit.factor


class Declared:
    """A plot declared in HoloViews and rendered once; each session draws on a copy of its own.

    A copy is a quarter of the work of rendering, and nothing of a session stays with HoloViews.
    """

    def __init__(self, name, overlay, title, together=None, hatched=()):
        """Render an overlay whose elements are labelled.

        `together` names groups of elements over the same abscissae, each with the column of every
        element: they are drawn from one source, and updated as one layer. Those in `hatched` are hatched.
        """
        overlay = overlay.opts(
            hv.opts.Overlay(
                title="",
                responsive=True,
                min_height=240,
                toolbar="above",
                default_tools=["box_zoom", "reset", "save"],
                show_grid=True,
            )
        )
        plot = hv.renderer("bokeh").get_plot(overlay)
        for element, key in zip(overlay, plot.subplots, strict=True):
            renderer = plot.subplots[key].handles["glyph_renderer"]
            # Nothing is selected or muted here: fewer glyphs to send.
            renderer.update(name=element.label, selection_glyph=None, nonselection_glyph=None)
            renderer.update(muted_glyph=None, hover_glyph=None)
        plot.state.name = name
        renderers = {renderer.name: renderer for renderer in plot.state.renderers}
        for label in hatched:
            # Not an option of HoloViews' areas.
            glyph = renderers[label].glyph
            glyph.update(hatch_pattern="right_diagonal_line", hatch_color=glyph.fill_color)
            glyph.update(hatch_alpha=0.35, hatch_scale=10)
        for group, columns in (together or {}).items():
            empty = dict.fromkeys(["x", *columns.values()], NOWHERE)
            source = ColumnDataSource(empty, name=group)
            for label, column in columns.items():
                renderers[label].data_source = source
                renderers[label].glyph.update(x="x", y=column)
        _look(plot.state)
        #: Title and legend, as HTML.
        self.heading = _heading(title, plot.state)
        plot.state.center = [part for part in plot.state.center if not isinstance(part, Legend)]
        self._encoded = Serializer(deferred=False).encode(plot.state)

    def copy(self):
        """Bokeh figure of one session, and its layers by label."""
        figure = Deserializer().deserialize(self._encoded)
        layers = {}
        for renderer in figure.renderers:
            source, glyph = renderer.data_source, renderer.glyph
            if source.name:
                layers[source.name] = Layer(source, {column: column for column in source.data})
            else:
                fields = {name: getattr(glyph, name, None) for name in ("x", "y", "x0", "x1", "text")}
                columns = {name: getattr(field, "field", field) for name, field in fields.items()}
                layers[renderer.name] = Layer(source, columns)
        return figure, layers


def _look(figure):
    figure.update(
        background_fill_color=PAPER,
        border_fill_color=PAPER,
        outline_line_color=None,
        toolbar_inner=True,
        output_backend="canvas",
        sizing_mode="stretch_both",
        # Frames of plots that share an axis start and end at the same place.
        min_border_left=66,
        min_border_right=18,
        min_border_top=4,
    )
    figure.toolbar.update(autohide=True, logo=None)
    for grid in figure.grid:
        grid.grid_line_color = RULE
    for axis in figure.axis:
        axis.update(
            axis_line_color="#9aa0a8",
            major_tick_line_color="#9aa0a8",
            minor_tick_line_color=None,
            major_label_text_font=_FONT,
            major_label_text_font_size="11px",
            major_label_text_color="#4a515b",
            axis_label_text_font=_FONT,
            axis_label_text_font_size="12px",
            axis_label_text_font_style="normal",
            axis_label_text_color=INK,
        )


def _heading(title, figure):
    """Title and legend of a plot as HTML: a legend inside the canvas is drawn anew with every change."""
    entries = "".join(
        f"<li>{_swatch(item.renderers[0].glyph)}{escape(item.label.value)}</li>"
        for legend in figure.legend
        for item in legend.items
    )
    return f'<h3>{escape(title)}</h3><ul class="legend">{entries}</ul>'


def _swatch(glyph):
    if isinstance(glyph, Line):
        dash = " ".join(map(str, glyph.line_dash))
        mark = (
            f'<line x1="0" x2="20" y1="6" y2="6" stroke="{glyph.line_color}" '
            f'stroke-width="{glyph.line_width}" stroke-dasharray="{dash}"/>'
        )
    elif isinstance(glyph, Scatter):
        mark = f'<circle cx="10" cy="6" r="4.5" fill="{glyph.fill_color}"/>'
    else:
        hatch = f'stroke="{glyph.fill_color}"' if glyph.hatch_pattern else ""
        mark = (
            f'<rect width="20" height="12" fill="{glyph.fill_color}" '
            f'fill-opacity="{glyph.fill_alpha}"/><path d="M1 12 7 0M7 12 13 0M13 12 19 0" {hatch}/>'
        )
    return f'<svg width="20" height="12" aria-hidden="true">{mark}</svg>'


def tooltips(figure, rows):
    """Say what the pointer is over: pairs of a label and a column with its unit."""
    for tool in figure.toolbar.tools:
        if isinstance(tool, HoverTool) and tool.tooltips != rows:
            tool.tooltips = rows
