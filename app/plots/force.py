"""Force over depth, linear and logarithmic, with a measured curve and its residual."""

import numpy as np
from scipy.integrate import trapezoid

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
    if course.adhesive:
        rows |= _adhesive_marks(view)
    if view.curve is not None:
        rows["measured"] = sampled(view.curve.depth, view.curve.force)
    return rows | view.held_on_axes("d", "F")


def _adhesive_marks(view: View) -> dict:
    """Where contact begins, and the largest tension of unloading, with its value."""
    depth, F = view.course.states.depth, view.course.states.force
    last = view.course.peak + int(np.argmin(F[view.course.peak :]))
    text = f"Fₐ = {written(view.course.pull_off_force[last], 'force', 3)}"
    beside = 0.02 * (view.end("d") - view.axis("d").start)
    above = 0.05 * (view.end("F") - view.axis("F").start)
    return {
        "jump into contact": (depth[:1], F[:1]),
        "jump": (depth[[0, 0]], np.array([0.0, F[0]])),
        "pull-off": (depth[[last]], F[[last]]),
        "Fₐ": (depth[last] + beside, F[last] + above, text),
    }


def force(view: View, i: int) -> dict:
    """The present state, the path so far, and the areas of dissipated and stored energy."""
    course, right = view.course, 0.02 * view.end("d")
    lower = float(course.states.plastic_depth[i])
    rows = {"now": view.mark(i, "d", "F"), "dₚ": (np.nan, np.nan, "")}
    if lower > 0:
        rows["dₚ"] = max(lower - 3 * right, right), 0.09 * view.end("F"), "dₚ"
    rows |= _curve(course, i + 1) if course.turns else {}
    if course.chained or (course.adhesive and course.turns):
        # No live interval tells what is stored in elements that have each a memory of their own; loops of
        # several loadings with adhesion overlap.
        return rows
    back_d, back_F = course.unloading_curve(i)
    if course.adhesive:
        return rows | _hysteresis(view, i, back_d, back_F)
    d, F = (np.asarray(part[: i + 1]) for part in (course.states.depth, course.states.force))
    elastic = lower == course.initial_plastic_depth and not course.dashpots
    # The path so far, and back along what is stored: dissipated is the loop that it encloses.
    lost = np.concatenate([d[:1], d, back_d, back_d[-1:]]), np.concatenate([[0.0], F, back_F, [0.0]])
    return rows | {
        "dissipated": NOTHING if elastic else lost,
        "stored": (np.append(back_d[:1], back_d), np.append(0.0, back_F)),
    }


def _hysteresis(view: View, i: int, back_d, back_F) -> dict:
    """Areas of a loading and unloading with adhesion, with their energies as text.

    Work is lost where the force of loading is above that of unloading, and gained where it is below, in
    reach of adhesion that an imprint no longer has. The stored energy is no area below the curve, because
    surfaces are separated, too: drawn is what comes back before the force is tension. Under a given force
    the pull-off may be above first contact, before anything has yielded: no loop is closed then.
    """
    d, F_in, F_out = view.course.adhesive_loop(i)
    around = np.append(d, d[::-1])
    lost = around, np.append(np.maximum(F_in, F_out), F_out[::-1])
    gained = around, np.append(F_out, np.minimum(F_in, F_out)[::-1])
    returned = _before_tension(back_d, back_F)
    works = [abs(float(trapezoid(*row[::-1]))) for row in (lost, gained, returned)]
    texts = [written(work, "energy", 3) for work in (*works, works[0] - works[1])]
    closed, gains = works[0] > works[1], works[0] > works[1] > 1e-3 * works[0]
    net = f" − {texts[1]} gained = {texts[3]}" * gains
    left, top = view.axis("d").start, view.end("F")
    height, width = top - view.axis("F").start, view.end("d") - left
    # An early loop may reach below the axis, which is that of the whole course.
    seen = closed and d[0] > left - 1e-6 * width
    left += 0.02 * width
    return {
        "dissipated": lost if closed else NOTHING,
        "gained": gained if gains else NOTHING,
        "given back": returned,
        "W_a": (left, top - 0.02 * height, f"dissipated {texts[0]}{net}" if seen else ""),
        "W_U": (left, top - 0.08 * height, f"given back {texts[2]}" if works[2] > 0 else ""),
    }


def _before_tension(d, F) -> tuple:
    """Area below the part of an unloading that begins with forces above zero, up to zero force."""
    # At its end, the pull-off, there is always tension.
    count = int(np.argmax(F <= 0))
    if count == 0:
        return NOTHING
    zero = np.interp(0.0, F[[count, count - 1]], d[[count, count - 1]])
    return np.concatenate([d[:1], d[:count], [zero]]), np.concatenate([[0.0], F[:count], [0.0]])


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
    line("jump", "elastic", 1.2, "dotted", legend=False),
    mark("jump into contact", "elastic", marker="square", size=9),
    mark("pull-off", "stick", marker="square", size=9),
)

FORCE = Plot(
    "force", "Force and depth", _formula, ("d", "F"),
    (
        area("dissipated", "yielded", 0.13, "/"),
        area("gained", "stick", 0.25),
        area("stored", "elastic", 0.25),
        area("given back", "elastic", 0.25),
        *_CURVES,
        mark("now", size=13),
        label("dₚ"),
        label("Fₐ"),
        label("W_a"),
        label("W_U"),
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
    lambda view: {name: _inside(view, *row) for name, row in force_still(view).items() if name != "Fₐ"},
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
