"""The curve over the model, and the residuals, as two Bokeh figures."""

from typing import Any

import bokeh.models as bk
import numpy as np
from bokeh.plotting import figure

from mdr_core.fit.indentation import IndentationFit
from mdr_core.show.figures import ROLES
from mdr_core.show.units import fitting

from ..tools import add_zoom
from ..ui import JS
from .asked import Samples

#: Colours by their roles, light and dark: measured, model, not in use.
_MEASURED, _MODEL, _OTHER, _INK, _PAPER = (
    ROLES[role] for role in ("measured", "elastic", "free", "ink", "paper")
)
#: Most samples that are drawn of each kind.
_DRAWN = 1000


class Plots:
    """Both figures, with one axis of depth."""

    def __init__(self) -> None:
        look = {"sizing_mode": "stretch_both", "output_backend": "canvas", "y_range": (0, 1), "tools": ""}
        self.force = figure(name="force plot", css_classes=["of-force"], x_range=(0, 1), **look)
        self.residual = figure(
            name="residual plot", css_classes=["of-residual"], x_range=self.force.x_range, **look
        )
        #: Models with a property of theirs and its colours, light and dark: a browser knows which it shows.
        self.looks: list[tuple[Any, str, tuple[str, str]]] = []
        # The plot is low: labels of more values would touch each other.
        self.residual.yaxis.ticker.desired_num_ticks = 3
        # The same width inside the axes, so that depths stand below each other.
        for each in (self.force, self.residual):
            add_zoom(each)
            each.min_border_left = 76
            each.min_border_right = 20
            each.update(background_fill_color=None, border_fill_color=None)
            for axis in each.axis:
                axis.axis_label_text_font_style = "normal"
                axis.minor_tick_line_color = None
                axis.axis_label_text_font_size = axis.major_label_text_font_size = "12px"
            each.xgrid.visible = False
            each.outline_line_color = None
            each.js_on_change("inner_width", bk.CustomJS(code=JS["canvas"]))
        about = {"aria-label": "Force over measured depth, as measured and of the model"}
        self.force.html_attributes = {"role": "figure"} | about
        about = {"aria-label": "Residuals of the force over measured depth, between bounds of the noise"}
        self.residual.html_attributes = {"role": "figure"} | about
        self.force.xaxis.axis_label = ""
        self.sources = {name: bk.ColumnDataSource({"x": [], "y": []}, name=name) for name in _NAMES}
        self._draw()

    def _draw(self) -> None:
        force, residual, sources = self.force, self.residual, self.sources
        look = {"size": 4, "line_color": None}
        others = force.scatter("x", "y", source=sources["others"], legend_label="not fitted", **look)
        measured = force.scatter("x", "y", source=sources["measured"], legend_label="measured", **look)
        model = force.line("x", "y", source=sources["model"], width=2, legend_label="model")
        force.legend.location = "top_left"
        force.legend.background_fill_alpha = 0.8
        force.legend.border_line_color = None
        force.legend.label_text_font_size = "12px"
        force.legend.glyph_height = force.legend.label_height = 15
        zero = bk.Span(location=0, dimension="width", line_dash="dashed")
        residual.add_layout(zero)
        noise = residual.line("x", "y", source=sources["noise"], width=1.2)
        misses = residual.scatter("x", "y", source=sources["residuals"], **look | {"size": 3})
        (key,) = force.legend
        self.looks += [
            (others.glyph, "fill_color", _OTHER), (measured.glyph, "fill_color", _MEASURED),
            (misses.glyph, "fill_color", _MEASURED), (model.glyph, "line_color", _MODEL),
            (noise.glyph, "line_color", _OTHER), (zero, "line_color", _INK),
            (key, "label_text_color", _INK), (key, "background_fill_color", _PAPER),
        ]  # fmt: skip
        for made, name, colours in self.looks:
            setattr(made, name, colours[0])

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
