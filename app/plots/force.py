"""Force over depth, linear and logarithmic, with a measured curve and its residual."""

import numpy as np

from mdr_core.results.figures import NOTHING, area, label, line, mark, parts, split

from ..drives import Course
from ..state.units import written
from .plot import Plot, View, held_rows

#: Most samples of a measured curve that are drawn.
_DRAWN = 150


def _curve(course: Course, until=None) -> dict:
    """Parts of the force–depth curve, optionally up to a state."""
    depth, past = course.states.depth, slice(until)
    return split(
        depth[past], course.states.force[past], depth[past], course.states.live_interval.lower[past]
    )


def sampled(x, y):
    step = -(-len(x) // _DRAWN)
    return x[::step], y[::step]


def force_still(view: View) -> dict:
    course, onset = view.course, view.course.onset
    rows = {"path ahead": (course.states.depth, course.states.force)} if course.turns else _curve(course)
    if onset is not None and not course.dashpots:
        rows["onset of yield"] = np.array([onset.depth]), np.array([onset.force])
    if view.curve is not None:
        rows["measured"] = sampled(view.curve.depth, view.curve.force)
    return rows | view.held_on_axes("d", "F")


def force(view: View, i: int) -> dict:
    """The present state, the path so far, and the areas of dissipated and stored energy."""
    course, right = view.course, 0.02 * view.end("d")
    lower = float(course.states.plastic_depth[i])
    rows = {"now": view.mark(i, "d", "F"), "dₚ": (np.nan, np.nan, "")}
    if lower > 0:
        rows["dₚ"] = max(lower - 3 * right, right), 0.09 * view.end("F"), "dₚ"
    if course.adhesive:
        last = int(np.argmin(course.states.force))
        text = f"Fₐ = {written(course.pull_off_force[last], 'force', 3)}"
        rows["Fₐ"] = course.states.depth[last] + 3 * right, 0.09 * view.end("F"), text
    rows |= _curve(course, i + 1) if course.turns else {}
    if course.chained:
        # No live interval tells what is stored in elements that have each a memory of their own.
        return rows
    d, F = (np.asarray(part[: i + 1]) for part in (course.states.depth, course.states.force))
    back_d, back_F = course.unloading_curve(i)
    elastic = lower == course.initial_plastic_depth and not (course.dashpots or course.adhesive)
    # The path so far, and back along what is stored: dissipated is the loop that it encloses.
    lost = np.concatenate([d[:1], d, back_d, back_d[-1:]]), np.concatenate([[0.0], F, back_F, [0.0]])
    return rows | {
        "dissipated": NOTHING if elastic else lost,
        # Tension takes work.
        "stored": (np.append(back_d[:1], back_d), np.append(0.0, np.maximum(back_F, 0.0))),
    }


def _formula(course: Course) -> str:
    if course.adhesive:
        return "F = 2E* [∫ a(s) ds − a Δl],  d_p < s < d + Δl  § 19"
    dashpots = " + 8η a dd/dt" * course.dashpots
    return f"(20) (22)  F = 2E* ∫ a(s) ds{dashpots},  d_p < s < d"


_CURVES = (
    *held_rows("F"),
    line("path ahead", "free", 1.0),
    *parts("F"),
    mark("measured", "measured", "measured", size=4),
    mark("onset of yield", "paper", "yielded", "diamond", 11),
)

FORCE = Plot(
    "force", "Force and depth", _formula, ("d", "F"),
    (
        area("dissipated", "yielded", 0.13, "/"),
        area("stored", "elastic", 0.25),
        *_CURVES,
        mark("now", size=13),
        label("dₚ"),
        label("Fₐ"),
    ),
    force_still, force,
)  # fmt: skip


def _inside(view: View, d, F, *_):
    """The part of a curve inside logarithmic axes."""
    inside = np.minimum(d / view.axis("log d").start, F / view.axis("log F").start) >= 1
    return np.where(inside, d, np.nan), np.where(inside, F, np.nan)


LOGLOG = Plot(
    "loglog", "Force and depth, logarithmic", "z ∝ rⁿ:  F ∝ d^(1 + 1/n), then d^(1/n)  § 6",
    ("log d", "log F"), (*_CURVES, mark("now")),
    lambda view: {name: _inside(view, *row) for name, row in force_still(view).items()},
    lambda view, i: {"now": _inside(view, *view.mark(i, "d", "F"))},
    tab=("Log–log", "l"),
)  # fmt: skip


def residual(view: View) -> dict:
    """Residual and its standard deviation."""
    curve, ends = view.curve, np.array([view.axis("d").start, view.end("d")])
    missing = "no model at these depths" * bool(np.isnan(view.residual).all())
    rows = {
        "zero": (ends, np.zeros(2)),
        "measured − model": sampled(curve.depth, view.residual),
        "missing": (0.05 * ends[1], 0.9 * view.end("ΔF"), missing),
    }
    if curve.fit is not None:
        size = curve.fit.residual_noise
        d = np.append(curve.depth, [np.nan, *curve.depth])
        rows["± noise"] = d, np.concatenate([size, [np.nan], -size])
    return rows


RESIDUAL = Plot(
    "residual", "Residual", "ΔF = F_measured − F(d),  σ² = σ_F² + (S σ_d)²  § 17", ("d", "ΔF"),
    (
        line("zero", "ink", 1.0, "dashed", legend=False),
        line("± noise", "free", 1.2, "dotted"),
        mark("measured − model", "measured", "measured", size=4),
        label("missing"),
    ),
    residual, tab=("Residual", "q"),
)  # fmt: skip
