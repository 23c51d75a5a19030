"""The curve over the model, and the residuals, as two Bokeh figures."""

from math import inf
from typing import Any

import bokeh.models as bk
import numpy as np
import panel as pn
from bokeh.plotting import figure
from markupsafe import Markup

from mdr_core.show.figures import ROLES
from mdr_core.show.units import fitting

from ..common.figures import add_zoom, set_look
from ..common.ui import BOTH, WIDE, html, show
from .analysis import contact_depth

_NAMES = "others", "measured", "model", "noise", "residuals"
#: Rows of the legend by their sources, with role and kind of the swatch, and label.
_LEGEND = {
    "others": ("free", "marks", "not fitted"), "measured": ("measured", "marks", "measured"),
    "model": ("elastic", "lines", "model"),
}  # fmt: skip
_KEY = Markup('<span class="{}"><i class="{}"></i>{}</span>')
_HEAD = Markup('<h3>Force and depth</h3><span class="key">{}</span>')
#: Visible air before first contact, relative to the depth range of the contact.
_AIR = 1 / 3
_FIGURES = {
    "force": "Measured force and force of the model over measured depth",
    "residual": "Residuals of the force over measured depth, between bounds of the noise",
}


class Plots:
    """Both figures, with one axis of depth."""

    def __init__(self) -> None:
        look = {"sizing_mode": "stretch_both", "output_backend": "canvas", "tools": "", "y_range": (0, 1)}
        self.force = figure(name="force plot", css_classes=["of-force"], x_range=(0, 1), **look)
        look |= {"name": "residual plot", "css_classes": ["of-residual"]}
        self.residual = figure(x_range=self.force.x_range, **look)
        # The plot is low: more labels would touch each other.
        self.residual.yaxis.ticker.desired_num_ticks = 3
        for each, name in ((self.force, "force"), (self.residual, "residual")):
            add_zoom(each)
            # The same width inside the axes aligns the depths.
            each.update(min_border_left=76, min_border_right=14)
            _style(each, _FIGURES[name])
        self.sources = {name: bk.ColumnDataSource({"x": [], "y": []}, name=name) for name in _NAMES}
        #: Models, each with a property and its colours, light and dark; the browser chooses the theme.
        self.looks = [(model, name, ROLES[role]) for model, name, role in self._draw()]
        for model, name, colours in self.looks:
            setattr(model, name, colours[0])
        # Last set ends of the axis of depth; other ends are a zoom.
        self._ends = (0.0, 1.0)
        self.head = html("", "head-of-plots")
        force, self._residual_pane = (pn.pane.Bokeh(each, **BOTH) for each in (self.force, self.residual))
        both = pn.Column(force, self._residual_pane, css_classes=["both-plots"], **BOTH)
        self.view = pn.Column(self.head, both, css_classes=["plots-of-fit"], visible=False, **BOTH)

    def _draw(self) -> list[tuple[Any, str, str]]:
        """Draw both plots; return models with a property and the role of its colour."""
        force, residual, source = self.force, self.residual, self.sources
        dots = {"size": 4, "line_color": None}
        others = force.scatter("x", "y", source=source["others"], name="not fitted", **dots)
        measured = force.scatter("x", "y", source=source["measured"], name="measured", **dots)
        model = force.line("x", "y", source=source["model"], width=2, name="model")
        zero = bk.Span(location=0, dimension="width", line_dash="dashed")
        residual.add_layout(zero)
        noise = residual.line("x", "y", source=source["noise"], width=1.2)
        misses = residual.scatter("x", "y", source=source["residuals"], size=3, line_color=None)
        return [
            (others.glyph, "fill_color", "free"), (measured.glyph, "fill_color", "measured"),
            (misses.glyph, "fill_color", "measured"), (model.glyph, "line_color", "elastic"),
            (noise.glyph, "line_color", "free"), (zero, "line_color", "ink"),
        ]  # fmt: skip

    def show(self, taken: Any, used: np.ndarray, fit: Any = None) -> None:
        """Show samples from a little before first contact, and the fit of the used samples."""
        length = fitting(float(np.max(np.abs(taken.depth))), "length")
        force = fitting(float(np.max(np.abs(taken.force))), "force")
        self.force.yaxis.axis_label = f"F, force ({force.name})"
        # One label, below the lower plot.
        self.residual.xaxis.axis_label = f"z, measured depth ({length.name})"
        self.force.xaxis.axis_label = "" if fit is not None else self.residual.xaxis.axis_label
        data = dict.fromkeys(_NAMES, (np.array([]), np.array([])))
        data["measured"] = taken.depth[used], taken.force[used] / force.factor
        data["others"] = taken.depth[~used], taken.force[~used] / force.factor
        if fit is not None:
            small = fitting(float(np.nanmax(np.abs(fit.residuals))) or force.factor, "force")
            self.residual.yaxis.axis_label = f"residual ({small.name})"
            data["model"] = fit.depth, (fit.force - fit.residuals) / force.factor
            data["residuals"] = fit.depth, fit.residuals / small.factor
            # Before first contact an infinite rate of the hardness is multiplied by a width of 0.
            with np.errstate(invalid="ignore"):
                noise = np.broadcast_to(fit.residual_noise, fit.depth.shape) / small.factor
            order = np.argsort(fit.depth)
            depth, noise = fit.depth[order], noise[order]
            data["noise"] = np.r_[depth, np.nan, depth], np.r_[noise, np.nan, -noise]
        for name, (x, y) in data.items():
            self.sources[name].data = {"x": x / length.factor, "y": y}
        rows = (_KEY.format(*row) for name, row in _LEGEND.items() if data[name][0].size)
        show(self.head, object=_HEAD.format(Markup("").join(rows)))
        show(self._residual_pane, visible=fit is not None)
        depth, ends = self.force.x_range, _reach(taken.depth / length.factor, 0.03)
        is_zoomed = (depth.start, depth.end) != self._ends
        forces = self.force.y_range, *_reach(taken.force / force.factor, 0.08)
        if _set((depth, *ends), forces) or not is_zoomed:
            seen = taken.depth[taken.depth >= _begin(taken.depth, contact_depth(taken, fit))]
            self._ends = _reach(seen / length.factor, 0.03)
            depth.update(start=self._ends[0], end=self._ends[1])
        _set((self.residual.y_range, *_reach(np.append(data["residuals"][1], data["noise"][1]), 0.12)))


class AllCurves:
    """Figure of all curves of a file or a set; for a map, moduli at their positions."""

    def __init__(self) -> None:
        look = {"sizing_mode": "stretch_width", "height": 280, "output_backend": "canvas", "tools": "save"}
        self.figure = figure(name="all curves", x_range=(0, 1), y_range=(0, 1), **look)
        self.figure.toolbar.logo = None
        _style(self.figure, "All curves, or a map of the moduli")
        self.curves = bk.ColumnDataSource({"x": [], "y": []}, name="curves")
        self.map = bk.ColumnDataSource({"x": [], "y": [], "E": []}, name="map")
        self._lines = self.figure.multi_line("x", "y", source=self.curves)
        colours = bk.LinearColorMapper(palette="Viridis256")
        look = {"marker": "square", "size": 14, "line_color": None}
        field = {"field": "E", "transform": colours}
        self._places = self.figure.scatter("x", "y", source=self.map, fill_color=field, **look)
        self._bar = bk.ColorBar(color_mapper=colours, background_fill_color=None)
        self.figure.add_layout(self._bar, "right")
        ink, bar = ROLES["ink"], self._bar
        self.looks = [(self._lines.glyph, "line_color", ROLES["measured"])]
        self.looks += [(bar, f"{name}_text_color", ink) for name in ("title", "major_label")]
        for model, name, colour in self.looks:
            setattr(model, name, colour[0])
        self.view = pn.Column(
            pn.pane.Bokeh(self.figure, **WIDE), visible=False, css_classes=["all"], **WIDE
        )

    def show(self, rows: list[Any]) -> None:
        """Show the curves of rows, or E* at their positions if all rows have a position."""
        known = [row for row in rows if row.samples is not None]
        found = [row for row in rows if row.E is not None]
        placed = bool(found) and all(row.position is not None for row in rows)
        self._lines.visible, self._places.visible, self._bar.visible = not placed, placed, placed
        self.curves.data, self.map.data = {"x": [], "y": []}, {"x": [], "y": [], "E": []}
        if placed:
            (x, y), E = np.array([row.position for row in found]).T, np.array([row.E for row in found])
            length, pressure = fitting(float(np.ptp(x)), "length"), fitting(float(E.max()), "pressure")
            self.map.data = {"x": x / length.factor, "y": y / length.factor, "E": E / pressure.factor}
            self._bar.title = f"E* ({pressure.name})"
            labels, drawn = (f"x ({length.name})", f"y ({length.name})"), self.map.data
        elif known:
            depths, forces = zip(*(row.samples for row in known), strict=True)
            length = fitting(max(max(map(abs, each)) for each in depths), "length")
            force = fitting(max(max(map(abs, each)) for each in forces), "force")
            self.curves.data = {
                "x": [np.array(each) / length.factor for each in depths],
                "y": [np.array(each) / force.factor for each in forces],
            }
            labels = f"measured depth z ({length.name})", f"force F ({force.name})"
            drawn = self.curves.data
        else:
            return
        self.figure.xaxis.axis_label, self.figure.yaxis.axis_label = labels
        x, y = (np.concatenate([np.ravel(each) for each in (*drawn[name],)]) for name in "xy")
        _set((self.figure.x_range, *_reach(x, 0.05)), (self.figure.y_range, *_reach(y, 0.08)))


def _style(plot: Any, name: str) -> None:
    """Give a figure its name and the look of all plots."""
    plot.html_attributes = {"role": "figure", "aria-label": name}
    set_look(plot)


def _begin(depth: np.ndarray, contact: float | None) -> float:
    """Return the first shown depth (m) before a contact, −∞ for a curve without air."""
    within = 0.0 if contact is None else float(np.max(depth)) - contact
    return contact - _AIR * within if contact is not None and within > 0 else -inf


def _reach(values: np.ndarray, margin: float) -> tuple[float, float]:
    """Return the ends of an axis for all values with a margin."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    wide = margin * ((high - low) or 1.0)
    return low - wide, high + wide


def _set(*axes: tuple[Any, float, float]) -> bool:
    """Set the ends of axes, and the ends of a reset, if an end has changed; otherwise keep a zoom.

    Return whether an end has changed.
    """
    changed = any((axis.reset_start, axis.reset_end) != (start, end) for axis, start, end in axes)
    for axis, start, end in axes if changed else ():
        axis.update(start=start, end=end, reset_start=start, reset_end=end)
    return changed
