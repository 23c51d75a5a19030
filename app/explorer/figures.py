"""Figures of the plots: frames with rows of data, filled for each view."""

from itertools import chain
from math import floor, log10
from typing import Any

import bokeh.models as bk
import numpy as np
from bokeh.core.properties import field
from bokeh.plotting import figure
from markupsafe import Markup

from mdr_core.show.figures import ROLES, Axis, Row

from ..common.figures import add_zoom, set_look
from ..common.quantities import unicode_subscripts
from ..common.ui import call, html_subscripts
from .plot import OF_AXIS, Plot, View, overlays, rows_of

#: Groups of rows with a common glyph, from the back to the front, and the glyph of each kind.
_GROUPS = ("areas", "lines", "lines right", "marks", "marks right", "labels")
_GLYPHS = {"areas": bk.Patches, "lines": bk.MultiLine, "marks": bk.Scatter, "labels": bk.Text}
#: Columns of a source with the places of its rows; all other columns are their look.
PLACES = ("xs", "ys", "x", "y", "text")
#: Tooltip: the nearest point of the curve.
_TIP = "<b>@row</b><br>@symbol = $snap_y{{%.4g}} {y.unit}<br>{symbol} = $snap_x{{%.4g}} {x.unit}"

_IS_CURVE = 'export default (args, tool, { value }) => value !== ""'


class Layer:
    """Rows of a plot that share a glyph and its source."""

    def __init__(self, plot: Plot, group: str, figure: Any):
        self.rows = [row for row in rows_of(plot) if row.group == group]
        self.name, self.kind, self.axis = group, self.rows[0].kind, self.rows[0].axis
        glyph = _GLYPHS[self.kind]
        names = [*(name for name in PLACES if name in glyph.properties()), *self.rows[0].look]
        self.source = bk.ColumnDataSource({name: [] for name in names}, name=f"{plot.name} {group}")
        # Only the server, or its frames, set the columns; the browser sends none back.
        self.source.syncable = False
        drawn = glyph(**{name: field(name) for name in names})
        side = "right" if self.axis == 2 else "default"
        renderer = figure.add_glyph(self.source, drawn, name=group, y_range_name=side)
        self.hover = None
        if any(row.symbol for row in self.rows):
            look = {"formatters": {"$snap_x": "printf", "$snap_y": "printf"}, "attachment": "right"}
            # Lines without a symbol, such as edges and outlines, are no curves with values.
            curves = {"@symbol": bk.CustomJS(code=_IS_CURVE)}
            look |= {"line_policy": "nearest", "visible": False, "filters": curves}
            self.hover = bk.HoverTool(renderers=[renderer], **look)
            figure.add_tools(self.hover)

    def columns(self, places: dict, axes: list[Axis], dark: bool) -> dict[str, list]:
        """Return the columns of the source: look, and places in the units of the axes."""
        parts = [places[row.name] for row in self.rows]
        xs = _short([x for x, *_ in parts], axes[0])
        ys = _short([y for _, y, *_ in parts], axes[self.axis])
        if self.kind in ("areas", "lines"):
            rows = self.rows
            symbol = {OF_AXIS: axes[self.axis].title.split(",")[0]}
            found = {"xs": xs, "ys": ys, "symbol": [symbol.get(row.symbol, row.symbol) for row in rows]}
            found["row"] = [unicode_subscripts(row.called(places[row.name])) for row in rows]
        else:
            rows = [row for row, x in zip(self.rows, xs, strict=True) for _ in x]
            found = {"x": [*chain(*xs)], "y": [*chain(*ys)], "row": [row.name for row in rows]}
        if self.kind == "labels":
            found["text"] = [text if np.isfinite(x) else "" for x, _, text in parts]
        looks = [row.look_in(dark) for row in rows]
        return found | {name: [look[name] for look in looks] for name in self.rows[0].look}


def _short(parts: list[Any], axis: Axis) -> list[list[float]]:
    """Convert the values of each row to the unit of an axis, rounded to a fraction of a pixel."""
    size = axis.start if axis.log else axis.end - axis.start
    decimals = 4 - floor(log10(size / axis.factor))
    scaled = (np.atleast_1d(np.asarray(values, float)) / axis.factor for values in parts)
    return [values.round(decimals).tolist() for values in scaled]


class Picture:
    """Plot as a figure."""

    #: Visible shares of the axes x and y below zero, which show marks at zero completely.
    margins = (0.02, 0.05)

    def __init__(self, plot: Plot):
        self.plot, self.axes = plot, None
        # Drawn preset and drive; a change of either resets the zoom.
        self._scene: tuple[str, str] | None = None
        f = self.figure = figure(name=plot.name, tools="", x_range=(0, 1), y_range=(0, 1))
        f.update(title=None, toolbar_location=None, sizing_mode="stretch_both", min_height=100)
        f.update(min_border_left=60, min_border_right=14, min_border_top=8, min_border_bottom=44)
        add_zoom(f)
        groups = {row.group for row in rows_of(plot)}
        if any(group.endswith("right") for group in groups):
            f.extra_y_ranges = {"right": bk.Range1d()}
            f.add_layout(bk.LinearAxis(y_range_name="right"), "right")
        for axis in f.axis:
            # A plot is low, and its curve matters more than its ticks.
            axis.ticker.desired_num_ticks = 4
        set_look(f)
        self.layers = [Layer(plot, group, f) for group in _GROUPS if group in groups]

    def axes_of(self, view: View) -> list[Axis]:
        """Return the axes of the drawn plot."""
        return self.plot.axes_of(view)

    def columns(self, view: View, i: int) -> dict[Any, dict[str, list]]:
        """Return the columns of each source in state i."""
        axes, places = self.axes_of(view), view.places(self.plot, i)
        if not axes:
            return {}
        return {layer.source: layer.columns(places, axes, view.state.dark) for layer in self.layers}

    def show(self, columns: dict, view: View) -> None:
        """Draw the columns of a view."""
        axes, scene = self.axes_of(view), (view.state.preset, view.state.drive)
        if scene != self._scene:
            self._whole()
        self._scene = scene
        if axes and axes != self.axes:
            self.set_axes(axes)
            self.axes = axes
        for source, data in columns.items():
            source.data = data

    def set_axes(self, axes: list[Axis]) -> None:
        f = self.figure
        about = f"{self.plot.title}: {axes[1].title}, over {axes[0].title}"
        f.html_attributes = {"role": "figure", "aria-label": about}
        sides, zoomed = (f.below[0], f.left[0], *f.right), self.zoomed
        known = zip(self.ranges, sides, axes, self.axes or axes, strict=False)
        for k, (bounds, side, axis, before) in enumerate(known):
            whole = ends = self._ends(axis, k)
            if zoomed:
                # A zoom stays, also in another unit, until the user resets it.
                ends = [each * before.factor / axis.factor for each in (bounds.start, bounds.end)]
            bounds.update(start=ends[0], end=ends[1], reset_start=whole[0], reset_end=whole[1])
            side.axis_label = axis.label
        symbol = axes[0].title.split(",")[0]
        for layer in self.layers:
            if layer.hover:
                layer.hover.tooltips = _TIP.format(symbol=symbol, x=axes[0], y=axes[layer.axis])

    def _ends(self, axis: Axis, k: int) -> tuple[float, float]:
        """Return start and end of axis number k, in its unit."""
        start, end = axis.ends
        at_zero = start == 0 and not axis.log and any(layer.kind == "marks" for layer in self.layers)
        return (-self.margins[min(k, 1)] * end, end) if at_zero else (start, end)

    @property
    def zoomed(self) -> bool:
        """Whether the plot is zoomed."""
        known = (each for each in self.ranges if each.reset_start is not None)
        return any((each.start, each.end) != (each.reset_start, each.reset_end) for each in known)

    @property
    def ranges(self) -> tuple[Any, ...]:
        """Ranges of the axes x and y, and of an axis on the right."""
        return self.figure.x_range, self.figure.y_range, *self.figure.extra_y_ranges.values()

    def _whole(self) -> None:
        """Show the whole plot."""
        for each in self.ranges if self.zoomed else ():
            each.update(start=each.reset_start, end=each.reset_end)


class Map(Picture):
    """Plot with an image and a colour bar."""

    margins = (0.0, 0.0)

    def __init__(self, plot: Any):
        super().__init__(plot)
        empty = {name: [] for name in ("image", "x", "y", "dw", "dh")}
        self.source = bk.ColumnDataSource(empty, name=f"{plot.name} image")
        self.source.syncable = False
        mapper = bk.LinearColorMapper(palette="Cividis256", low=0, high=1)
        glyph = self.figure.image("image", "x", "y", "dw", "dh", source=self.source, color_mapper=mapper)
        glyph.name, glyph.level, self.bar = "image", "image", glyph.construct_color_bar(padding=2, width=12)
        self.bar.update(background_fill_color=None, bar_line_color=None)
        self.figure.add_layout(self.bar, "right")
        # Grid lines of full strength would hide the map.
        self.figure.grid.grid_line_alpha = 0.25

    def columns(self, view: View, i: int) -> dict[Any, dict[str, list]]:
        found = super().columns(view, i)
        if found:
            axes, (across, up, values) = self.axes_of(view), view.places(self.plot, i)["image"]
            (left, right), (low, high) = across / axes[0].factor, up / axes[1].factor
            corner = {"x": [left], "y": [low], "dw": [right - left], "dh": [high - low]}
            found[self.source] = corner | {"image": [np.float32(values / axes[2].factor)]}
        return found

    def show(self, columns: dict, view: View) -> None:
        super().show(columns, view)
        # The style sheet does not reach the colours of the bar.
        colour = ROLES["ink"][view.state.dark]
        self.bar.update(title_text_color=colour, major_label_text_color=colour)

    def set_axes(self, axes: list[Any]) -> None:
        super().set_axes(axes[:2])
        low, high = axes[2].ends
        self.bar.color_mapper.update(low=low, high=high)
        self.bar.title = f"{axes[2].title.split(',')[0]} ({axes[2].unit})"


class Logarithmic(Picture):
    """Plot with optional logarithmic axes."""

    def set_axes(self, axes: list[Axis]) -> None:
        super().set_axes(axes)
        f = self.figure
        for name, side, axis in zip(("x_scale", "y_scale"), (f.below[0], f.left[0]), axes, strict=False):
            if isinstance(getattr(f, name), bk.LogScale) != axis.log:
                setattr(f, name, bk.LogScale() if axis.log else bk.LinearScale())
            elif not axis.log:
                continue
            linear = bk.BasicTicker(), bk.BasicTickFormatter()
            ticker, formatter = ticks(*axis.ends) if axis.log else linear
            side.update(ticker=ticker, formatter=formatter)
            for grid in (each for each in f.center if getattr(each, "axis", None) is side):
                grid.ticker = ticker


def ticks(low: float, high: float) -> tuple[Any, Any]:
    """Return ticker and formatter of a logarithmic axis; Bokeh's ticks are too many up to two decades."""
    formatter = bk.CustomJSTickFormatter(code=call("power", "tick"))
    if high > 101 * low:
        return bk.LogTicker(num_minor_ticks=0), formatter
    powers = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    fixed = bk.FixedTicker(ticks=[float(f"{n}e{power:.0f}") for power in powers for n in (1, 2, 5)])
    return fixed if high > 5 * low else bk.BasicTicker(), formatter


def picture_of(plot: Plot) -> Picture:
    """Return the picture of a plot with its overlays."""
    return next((each.picture for each in (*overlays(plot), plot) if each.picture), Picture)(plot)


def drawn(view: View, plot: Plot) -> dict[str, str]:
    """Return the displayed names of visible rows of a plot, in the present state or at the largest depth.

    They include labels of rows, even if a label has no room.
    """
    states = [view.places(plot, i) for i in (view.course.now, view.course.peak)]

    def seen(row: Row, places: dict) -> bool:
        place = places[row.name]
        return bool(place[2]) if row.names else bool(np.isfinite(place[1]).any())

    rows = [row for row in rows_of(plot) if any(seen(row, places) for places in states)]
    return {row.name: row.called(states[0][row.name]) for row in rows}


def in_legend(plot: Plot, shown: dict[str, str]) -> list[Row]:
    """Return the visible rows of a plot for its legend: rows without a label in the plot."""
    rows = rows_of(plot)
    labelled = {name for row in rows if row.name in shown for name in row.names}
    return [row for row in rows if row.legend and row.name in shown and row.name not in labelled]


def legend(plot: Plot, shown: dict[str, str]) -> Markup:
    """Return the legend of the visible rows without a label, as HTML."""
    rows = []
    for row in in_legend(plot, shown):
        hatch = "hatch" * (row.look.get("hatch_pattern", " ") != " ")
        look = " ".join((row.kind, hatch, row.look.get("line_dash", ""), row.look.get("marker", "")))
        one = Markup('<span class="{}"><i class="{}"></i>{}</span>')
        rows.append(one.format(row.role, look, html_subscripts(shown[row.name])))
    return Markup("").join(rows)
