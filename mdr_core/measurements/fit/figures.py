"""Plot of a fit in a notebook: measured and fitted force over depth, and the residuals."""

import numpy as np

from ...show.figures import Axis, area, line, mark
from ...show.plots import overlay
from ...show.report import imported

_CURVE_ROWS = mark("measured", "measured", "measured", size=4), line("fit", "elastic")
_RESIDUAL_ROWS = (
    area("± noise", "free", 0.3),
    mark("measured − fit", "measured", "measured", size=4, legend=False),
    line("zero", "ink", 1.0, "dashed", legend=False),
)


def plot_fit(fit):
    """Return two overlays of one fit, one below the other: `IndentationFit.plot`."""
    given = np.isfinite(fit.residuals)
    depth, force, residual = (values[given] for values in (fit.depth, fit.force, fit.residuals))
    size = fit.residual_noise[given]
    order, ends = np.argsort(depth, kind="stable"), np.array([depth.min(), depth.max()])
    band = np.append(depth[order], depth[order][::-1]), np.append(size[order], -size[order][::-1])
    x = Axis.fitting("depth", "z, measured depth", "m", np.abs(depth).max())
    y = Axis.fitting("force", "F, measured force", "N", np.abs(force).max())
    largest = max(np.abs(residual).max(), size.max())
    below = Axis.fitting("residual", "ΔF, measured − fit", "N", largest)
    columns = {"measured": (depth, force), "fit": (depth, force - residual)}
    residuals = {"measured − fit": (depth, residual), "± noise": band, "zero": (ends, np.zeros(2))}
    plots = (
        overlay(f"{type(fit.profile).__name__}: fit", _CURVE_ROWS, columns, (x, y)),
        overlay("Residuals, ± √(σ_F² + (S σ_d)²)", _RESIDUAL_ROWS, residuals, (x, below)),
    )
    return imported("holoviews", "a plot", "holoviews bokeh").Layout(plots).cols(1)
