"""Plots as Bokeh figures: one source for the rows of a kind, drawn by `source.data = …`; frames."""

from dataclasses import replace
from itertools import chain
from math import floor, log10
from typing import Any

import bokeh.models as bk
import numpy as np
from bokeh.plotting import figure

from mdr_core.results.figures import DASHES, ROLES, Axis, Row

from .plot import Plot, View, overlays, rows_of
from .quantities import lowered
from .ui import JS, marked

FONT = "Helvetica Neue, Helvetica, Arial, sans-serif"
#: The outline of a canvas, which no linked sheet reaches.
_FOCUS = [".bk-Canvas { --highlight-color: var(--elastic); --outline-width: 2px; }"]
#: Rows that are drawn together, from the back to the front.
_GROUPS = ("areas", "lines", "lines right", "marks", "marks right", "labels")
#: Glyphs of each kind of row, and the columns of their source.
_LINE = {"line_color": "color", "line_width": "width", "line_dash": "dash"}
_MARK = {"fill_color": "color", "line_color": "edge", "marker": "marker", "size": "size", "line_width": 1.6}
_TEXT = {"text_font_size": "12px", "text_font_style": "italic", "text_baseline": "top"}
_GROUND = {"text_color": "color", "background_fill_color": "ground", "background_fill_alpha": 0.8}
_GLYPHS: dict[str, tuple[Any, dict[str, Any]]] = {
    "areas": (bk.Patches, {"xs": "xs", "ys": "ys", "fill_color": "color", "fill_alpha": "alpha"}),
    "lines": (bk.MultiLine, {"xs": "xs", "ys": "ys"} | _LINE),
    "marks": (bk.Scatter, {"x": "x", "y": "y"} | _MARK),
    "labels": (bk.Text, {"x": "x", "y": "y", "text": "text"} | _TEXT | _GROUND),
}
_HATCH = {"hatch_pattern": "hatch", "hatch_color": "color", "hatch_alpha": 0.35}
_PLACES = ("xs", "ys", "x", "y", "text")
#: What the pointer is told: the point of the curve that is nearest.
_TIP = "<b>@row</b><br>@symbol = $snap_y{{%.4g}} {y.unit}<br>{symbol} = $snap_x{{%.4g}} {x.unit}"


class Layer:
    """Rows of a plot that share a source."""

    def __init__(self, plot: Plot, group: str, shared: dict[str, Any]):
        self.rows = [row for row in rows_of(plot) if row.group == group]
        self.name, self.kind, self.axis = group, self.rows[0].kind, self.rows[0].axis
        self.connected = self.kind in ("areas", "lines")
        places = [name for name in _GLYPHS[self.kind][1] if name in _PLACES]
        empty = {name: [] for name in (*self._look(self.rows, False), *places)}
        self.source = bk.ColumnDataSource(empty, name=f"{plot.name} {group}", **shared)
        # Columns come from the server, or from the frames it has sent: never the other way.
        self.source.syncable = False

    def _look(self, rows: list[Row], dark: bool) -> dict[str, list]:
        """Columns of the look of rows."""
        found = {"row": [row.name for row in rows], "color": [ROLES[row.role][dark] for row in rows]}
        if self.kind == "labels":
            return found | {"ground": [ROLES["paper"][dark]] * len(rows)}
        found |= {key: [row.look[key] for row in rows] for key in self.rows[0].look}
        if self.kind == "areas" and dark:
            found["alpha"] = [min(1.6 * alpha, 1.0) for alpha in found["alpha"]]
        if self.kind == "lines":
            found["dash"] = [DASHES[dash] for dash in found["dash"]]
            found["symbol"] = [row.symbol or row.name for row in rows]
        elif self.kind == "marks":
            found["edge"] = [ROLES[edge][dark] for edge in found["edge"]]
        return found

    def columns(self, rows: dict, axes: list[Axis], dark: bool) -> dict[str, list]:
        """Columns of the source: look, and places in the units of the axes."""
        x_axis, y_axis = axes[0], axes[self.axis]
        parts = [rows[row.name] for row in self.rows]
        clip = _inside if self.connected else _seen
        parts = [clip(row, x_axis, y_axis, *part) for row, part in zip(self.rows, parts, strict=True)]
        xs, ys = ([_short(part[k], axis) for part in parts] for k, axis in ((0, x_axis), (1, y_axis)))
        if self.connected:
            names = [lowered(row.called(rows[row.name])) for row in self.rows]
            return self._look(self.rows, dark) | {"row": names, "xs": xs, "ys": ys}
        points = [row for row, x in zip(self.rows, xs, strict=True) for _ in x]
        found = self._look(points, dark) | {"x": [*chain(*xs)], "y": [*chain(*ys)]}
        return found | {"text": [part[2] for part in parts]} if self.kind == "labels" else found

    def draw(self, figure: Any) -> Any:
        """Renderer of the rows on a figure."""
        kind, look = _GLYPHS[self.kind]
        if self.kind == "areas":
            # An edge in full colour: on its ground a pale area alone is hard to see.
            look = look | {"line_color": "color"}
            look |= _HATCH if any(row.look["hatch"] != " " for row in self.rows) else {}
        only = dict.fromkeys(("selection_glyph", "nonselection_glyph", "muted_glyph", "hover_glyph"))
        only["y_range_name"] = "right" if self.axis == 2 else "default"
        # Level: above the axes, on a canvas of its own, so that they are not painted again with the data.
        return figure.add_glyph(self.source, kind(**look), name=self.name, level="overlay", **only)


def _short(values: Any, axis: Axis) -> list[float]:
    """Values in the unit of an axis, as list, on a linear one to a fraction of a pixel."""
    values = np.atleast_1d(np.asarray(values, float)) / axis.factor
    if axis.log:
        return values.tolist()
    size = max(abs(axis.start), abs(axis.end)) / axis.factor or 1.0
    return np.round(values, 4 - floor(log10(size))).tolist()


def _inside(row: Row, x: Axis, y: Axis, *given: Any) -> tuple[Any, Any]:
    """A line or area as far as it is within its axes, for a canvas that does not clip."""
    parts = list(given[:2])
    for k, sign, bound in ((1, 1, y.end), (1, -1, -y.start), (0, 1, x.end), (0, -1, -x.start)):
        outside = sign * parts[k] > bound + 1e-9 * (x, y)[k].end
        if not outside.any():
            continue
        at = np.flatnonzero(outside[:-1] != outside[1:])
        share = (sign * bound - parts[k][at]) / (parts[k][at + 1] - parts[k][at])
        parts = [np.insert(part, at + 1, part[at] + share * (part[at + 1] - part[at])) for part in parts]
        cut = sign * bound if row.kind == "areas" else np.nan
        parts[k] = np.where(np.insert(outside, at + 1, False), cut, parts[k])
    return parts[0], parts[1]


def _seen(row: Row, x: Axis, y: Axis, *parts: Any) -> tuple[Any, ...]:
    """Marks and labels within their axes."""
    seen = True
    for axis, part in zip((x, y), parts[:2], strict=True):
        near = 1e-9 * axis.end
        seen = seen & (np.asarray(part) >= axis.start - near) & (np.asarray(part) <= axis.end + near)
    return *(np.where(seen, part, np.nan) for part in parts[:2]), *parts[2:]


class Picture:
    """One plot as a figure."""

    def __init__(self, plot: Plot):
        self.plot, self.axes = plot, None
        #: Whether titles of axes are symbols alone.
        self.short = False
        ranges = {"x_range": bk.Range1d(0.1, 1), "y_range": bk.Range1d(0.1, 1)}
        self.figure = figure(name=plot.name, tools="", toolbar_location=None, stylesheets=_FOCUS, **ranges)
        # Nothing is selected: the sources of a figure share what Bokeh has for it.
        shared = {"selected": bk.Selection(), "selection_policy": bk.UnionRenderers()}
        groups = [group for group in _GROUPS if any(row.group == group for row in rows_of(plot))]
        self.layers = [Layer(plot, group, shared) for group in groups]
        self.hovers: list[tuple[Any, int]] = []
        if any(layer.axis == 2 for layer in self.layers):
            self.figure.extra_y_ranges = {"right": bk.Range1d(0, 1)}
            self.figure.add_layout(bk.LinearAxis(y_range_name="right"), "right")
        for layer in self.layers:
            renderer = layer.draw(self.figure)
            if layer.kind == "lines" and any(row.symbol for row in layer.rows):
                told = {"formatters": {"$snap_x": "printf", "$snap_y": "printf"}, "attachment": "right"}
                hover = bk.HoverTool(renderers=[renderer], line_policy="nearest", visible=False, **told)
                self.figure.add_tools(hover)
                self.hovers.append((hover, layer.axis))
        self._dress()

    def _dress(self):
        f = self.figure
        f.update(background_fill_color=None, border_fill_color=None, outline_line_color=None, title=None)
        # The outermost pixels of a canvas keep a trace of the colour before the last one. What is enlarged
        # is drawn anew, not its pixels.
        f.styles = {"clip-path": "inset(1px)", "zoom": "calc(1 / var(--zoom, 1))"}
        f.update(min_border_left=64, min_border_right=16, min_border_top=8, min_border_bottom=44)
        f.update(sizing_mode="stretch_both", min_height=100)
        painted = bk.CustomJS(args={"figure": f}, code=JS["label"])
        for axis in f.axis:
            axis.js_on_change("axis_label", painted)
            axis.update(minor_tick_line_color=None, major_tick_in=0, axis_label_text_font_style="normal")
            axis.update(axis_label_text_font=FONT, major_label_text_font=FONT)
            axis.update(axis_label_text_font_size="12px", major_label_text_font_size="11px")

    def axes_of(self, view: View) -> list[Axis]:
        """Axes on which the plot is drawn."""
        return self.plot.axes_of(view)

    def columns(self, view: View, i: int, dark: bool) -> dict[Any, dict[str, list]]:
        """What each source has in state i."""
        axes, rows = self.axes_of(view), view.rows(self.plot, i)
        if not axes:
            return {}
        return {layer.source: layer.columns(rows, axes, dark) for layer in self.layers}

    def frame(self, view: View, i: int) -> dict[Any, dict[str, list]]:
        """Places of what moves in state i; the rest of its columns is as it is drawn."""
        axes, rows = self.axes_of(view), view.rows(self.plot, i)
        moving = view.moving(self.plot, view.course.now).keys()
        found = {}
        for layer in self.layers:
            if any(row.name in moving for row in layer.rows):
                columns = layer.columns(rows, axes, False)
                found[layer.source] = {name: columns[name] for name in _PLACES if name in columns}
        return found

    def show(self, columns: dict, view: View, dark: bool) -> None:
        """Draw columns that were made for a view."""
        axes = self.axes_of(view)
        if axes and (axes, dark) != self.axes:
            self.axes = axes, dark
            self.set_axes(axes, dark)
        for source, data in columns.items():
            source.data = data

    def set_axes(self, axes: list[Axis], dark: bool):
        f, ground = self.figure, ROLES["paper"][dark]
        # Another ground paints the axes anew, too, which take their colours from the sheet.
        f.update(background_fill_color=ground, border_fill_color=ground)
        about = f"{self.plot.title}: {axes[1].title}, over {axes[0].title}"
        f.html_attributes = {"role": "img", "aria-label": about}
        ranges = (f.x_range, f.y_range, *f.extra_y_ranges.values())
        sides = (f.below[0], f.left[0], *f.right)
        for bounds, side, axis in zip(ranges, sides, axes, strict=False):
            start, end = axis.ends
            bounds.update(start=start, end=end)
            title = axis.title.split(",")[0] if self.short else axis.title
            side.axis_label = replace(axis, title=title).label
        for hover, number in self.hovers:
            symbol = axes[0].title.split(",")[0]
            hover.tooltips = _TIP.format(symbol=symbol, x=axes[0], y=axes[number])


def picture_of(plot: Plot) -> Picture:
    """The picture of a plot, as it is drawn with its overlays."""
    return next((each.picture for each in (*overlays(plot), plot) if each.picture), Picture)(plot)


def drawn(view: View, plot: Plot, states: set[int]) -> dict[str, str]:
    """Rows of a plot that have something to show in one of some states, and what they are called."""
    found = [view.rows(plot, i) for i in states]
    rows = {name for rows in found for name, (_, y, *_) in rows.items() if np.isfinite(y).any()}
    return {row.name: row.called(found[0][row.name]) for row in rows_of(plot) if row.name in rows}


def legend(plot, shown):
    """Legend of the visible rows of a plot, as HTML."""
    text = ""
    for row in rows_of(plot):
        if row.legend and row.name in shown:
            hatch = "hatch" * (row.look.get("hatch", " ") != " ")
            look = " ".join((row.kind, hatch, row.look.get("dash", ""), row.look.get("marker", "")))
            text += f'<span class="{row.role}"><i class="{look}"></i>{marked(shown[row.name])}</span>'
    return text
