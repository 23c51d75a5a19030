"""A measured curve over the model, and its residual, as drawn."""

import numpy as np

from mdr_core.results.figures import label, line, mark

from ...plot import Along, Plot, View
from ...plots import D, F
from ...shared.once import once
from .measured import Curve

#: Most samples of a measured curve that are drawn.
_DRAWN = 150


def placed(view: View) -> Curve | None:
    """The measured curve where it lies over the model."""
    return view.computed.get("fit")


def sampled(x, y):
    step = max(1, -(-len(x) // _DRAWN))
    return x[::step], y[::step]


MEASURED = (
    mark("measured, not fitted", "free", size=3),
    mark("measured", "measured", "measured", size=4),
)


@once
def measured(view: View) -> dict:
    curve = placed(view)
    if curve is None:
        return {}
    parts = {"measured": curve.used, "measured, not fitted": ~curve.used}
    return {name: sampled(curve.depth[part], curve.force[part]) for name, part in parts.items()}


def reach(view: View, along: Along) -> tuple[float, float]:
    """The curve is within the axes of depth and force, and its residual within that of its force."""
    curve = placed(view)
    if curve is None:
        return 0.0, 0.0
    if along is RESIDUAL_FORCE:
        largest = float(np.nan_to_num(np.abs(curve.residual(view.course.scene))).max())
        return -largest, largest
    if along is D:
        return float(np.min(curve.depth)), 1.02 * float(curve.depth.max())
    if along is F:
        return float(np.min(curve.force)), 1.05 * float(curve.force.max())
    return 0.0, 0.0


RESIDUAL_FORCE = Along("ΔF, residual force", "force", lambda course: (0.0, 0.0))


@once
def residual(view: View) -> dict:
    """Residual and its standard deviation."""
    curve, ends = placed(view), np.array([view.axis(D).start, view.end(D)])
    depth = curve.depth[curve.used]
    missing = "no model at these depths" * bool(np.isnan(placed(view).residual(view.course.scene)).all())
    rows = {
        "zero": (ends, np.zeros(2)),
        "measured − model": sampled(depth, placed(view).residual(view.course.scene)),
        "missing": (0.05 * ends[1], 0.9 * view.end(RESIDUAL_FORCE), missing),
    }
    if curve.fit is not None:
        size = curve.fit.residual_noise
        d = np.append(depth, [np.nan, *depth])
        rows["± noise"] = d, np.concatenate([size, [np.nan], -size])
    return rows


RESIDUAL = Plot(
    "residual", "Residual", "ΔF = F_measured − F(d),  σ² = σ_F² + (S σ_d)²  § 17", (D, RESIDUAL_FORCE),
    (
        line("zero", "ink", 1.0, "dashed", legend=False),
        line("± noise", "free", 1.2, "dotted"),
        mark("measured − model", "measured", "measured", size=4),
        label("missing"),
    ),
    residual, applies=lambda view: placed(view) is not None, tab="Residual", order=60,
)  # fmt: skip
