"""The curve over the model, and the residuals, as two Bokeh figures."""

from typing import Any

import bokeh.models as bk
import numpy as np
from bokeh.plotting import figure

from mdr_core.fit.indentation import IndentationFit
from mdr_core.show.units import fitting

from ..ui import JS
from .measurement import Samples

#: Colours as those of the explorer's light theme: measured, model, not in use.
_MEASURED, _MODEL, _OTHER, _INK = "#7a4a1e", "#0072b2", "#b9bec6", "#22272e"
#: Most samples that are drawn of each kind.
_DRAWN = 1000


class Plots:
    """Both figures, with one axis of depth."""

    def __init__(self) -> None:
        tools = {"tools": "pan,box_zoom,wheel_zoom,reset,save", "toolbar_location": "right"}
        look = {"sizing_mode": "stretch_both", "output_backend": "canvas", "y_range": (0, 1)}
        self.force = figure(name="force plot", css_classes=["of-force"], x_range=(0, 1), **look | tools)
        self.residual = figure(
            name="residual plot", css_classes=["of-residual"], x_range=self.force.x_range, tools="", **look
        )
        self.residual.toolbar_location = None
        # The plot is low: labels of more values would touch each other.
        self.residual.yaxis.ticker.desired_num_ticks = 3
        # The same width inside the axes, so that depths stand below each other.
        for each in (self.force, self.residual):
            each.min_border_left = 76
            each.toolbar.logo = None
            each.min_border_right = 34
            for axis in each.axis:
                axis.axis_label_text_font_style = "normal"
                axis.minor_tick_line_color = None
                axis.axis_label_text_font_size = axis.major_label_text_font_size = "12px"
            each.grid.grid_line_color = "#e8eaed"
            each.outline_line_color = None
            each.js_on_change("inner_width", bk.CustomJS(code=JS["canvas"]))
        about = {"aria-label": "Force over measured depth, as measured and of the model"}
        self.force.html_attributes = {"role": "figure"} | about
        about = {"aria-label": "Residuals of the force over measured depth, between bounds of the noise"}
        self.residual.html_attributes = {"role": "img"} | about
        self.force.xaxis.axis_label = ""
        self.sources = {name: bk.ColumnDataSource({"x": [], "y": []}, name=name) for name in _NAMES}
        self._draw()

    def _draw(self) -> None:
        force, residual, sources = self.force, self.residual, self.sources
        look = {"size": 4, "line_color": None}
        force.scatter("x", "y", source=sources["others"], color=_OTHER, legend_label="not fitted", **look)
        force.scatter(
            "x", "y", source=sources["measured"], color=_MEASURED, legend_label="measured", **look
        )
        force.line("x", "y", source=sources["model"], color=_MODEL, width=2, legend_label="model")
        force.legend.location = "top_left"
        force.legend.background_fill_alpha = 0.8
        force.legend.border_line_color = None
        force.legend.label_text_font_size = "12px"
        force.legend.glyph_height = force.legend.label_height = 15
        residual.add_layout(bk.Span(location=0, dimension="width", line_color=_INK, line_dash="dashed"))
        residual.line("x", "y", source=sources["noise"], color=_OTHER, width=1.2)
        residual.scatter("x", "y", source=sources["residuals"], color=_MEASURED, **look | {"size": 3})

    def show(self, taken: Samples, used: np.ndarray, fit: IndentationFit | None) -> None:
        """Show samples, and the fit of those in use."""
        length = fitting(float(np.max(np.abs(taken.depth))), "length")
        force = fitting(float(np.max(np.abs(taken.force))), "force")
        self.force.yaxis.axis_label = f"force F ({force.name})"
        self.residual.xaxis.axis_label = f"measured depth z ({length.name})"

        def columns(x: Any, y: Any, unit: float) -> dict[str, Any]:
            step = max(1, -(-len(x) // _DRAWN))
            return {"x": np.asarray(x)[::step] / length.factor, "y": np.asarray(y)[::step] / unit}

        places = {name: {"x": [], "y": []} for name in _NAMES}
        places["measured"] = columns(taken.depth[used], taken.force[used], force.factor)
        places["others"] = columns(taken.depth[~used], taken.force[~used], force.factor)
        if fit is not None:
            places["model"] = columns(fit.depth, fit.force - fit.residuals, force.factor)
            misses = float(np.nanmax(np.abs(fit.residuals)))
            small = fitting(misses or float(np.max(np.abs(taken.force))), "force")
            self.residual.yaxis.axis_label = f"residual ({small.name})"
            places["residuals"] = columns(fit.depth, fit.residuals, small.factor)
            # Before first contact a rate at which the hardness falls is infinite, times a width of 0.
            with np.errstate(invalid="ignore"):
                noise = np.broadcast_to(fit.residual_noise, fit.depth.shape)
            order = np.argsort(fit.depth)
            depth = fit.depth[order]
            places["noise"] = {
                "x": np.concatenate([depth, [np.nan], depth]) / length.factor,
                "y": np.concatenate([noise[order], [np.nan], -noise[order]]) / small.factor,
            }
        for name, data in places.items():
            self.sources[name].data = data
        others, _, model = self.force.legend.items
        others.visible = bool(np.any(~used))
        model.visible = fit is not None
        parts = ("measured", "others")
        self._reach(self.force.x_range, [places[name]["x"] for name in parts], 0.03)
        self._reach(self.force.y_range, [places[name]["y"] for name in parts], 0.08)
        self._reach(self.residual.y_range, [places[name]["y"] for name in ("residuals", "noise")], 0.12)

    @staticmethod
    def _reach(axis: Any, values: list[Any], margin: float) -> None:
        """Let a range of an axis, also where it is reset, have all values and a margin."""
        every = np.concatenate([np.asarray(each, float) for each in values])
        low, high = (np.nanmin(every), np.nanmax(every)) if np.isfinite(every).any() else (-1.0, 1.0)
        wide = margin * ((high - low) or 1.0)
        ends = float(low - wide), float(high + wide)
        if ends != (axis.reset_start, axis.reset_end):
            axis.update(start=ends[0], end=ends[1], reset_start=ends[0], reset_end=ends[1])


_NAMES = ("measured", "others", "model", "residuals", "noise")
