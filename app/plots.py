"""The plots of the page: springs, pressure, and force over depth."""

from collections.abc import Callable

import numpy as np

from mdr_core.results import figures
from mdr_core.results.figures import REST, label, line, mark, split
from mdr_core.results.quantities import QUANTITIES

from .courses import Course
from .plot import Along, Plot, View

# Axes, which other plots may share.


def largest_radius(course: Course) -> float:
    return float(np.max(course.states.contact_radius))


def deepest(course: Course) -> float:
    """Largest depth (m), or height to which adhesion lifts the indenter."""
    return float(np.max(np.abs(course.states.depth)))


def _most(name: str) -> Callable[[Course], float]:
    """Largest value of a quantity, also at an onset of yield slightly ahead, which stays visible."""

    def size(course):
        states, onset = course.states, course.onset
        values, depth = getattr(states, name), np.max(states.depth)
        # With adhesion there may be tension alone.
        most = max(np.max(values), -0.25 * np.min(values))
        if onset is not None and depth < onset.depth <= 2.5 * depth:
            most = max(most, getattr(onset, name))
        return 1.02 * float(most)

    return size


def _pressure_size(course: Course) -> float:
    return 1.05 * figures.ceiling(course.turning_point, radius_size(course))


def _least(name: str) -> Callable[[Course], float]:
    """Least value of a quantity: adhesion reaches below zero."""
    return lambda course: float(np.min(getattr(course.states, name))) if course.adhesive else 0.0


def radius_size(course: Course) -> float:
    return 1.25 * largest_radius(course)


X = Along("x, coordinate of the springs", "length", radius_size, lambda course: 1.0)
R = Along("r, radius", "length", radius_size, lambda course: 1.0)
Z = Along("z, height", "length", deepest, lambda course: REST)
D = Along(QUANTITIES["depth"].title, "length", _most("depth"), least=_least("depth"))
F = Along(QUANTITIES["force"].title, "force", _most("force"), least=_least("force"))
P = Along("−σzz, pressure", "pressure", _pressure_size, lambda course: float(course.adhesive))


# Springs.


def springs(view: View, i: int) -> dict:
    """Springs by their state."""
    course, state = view.course, view.course.states[i]
    return figures.springs(state, view.end(X), view.end(Z), lambda g: course.relaxing(i, g))


def _spring_formula(course: Course) -> str:
    if course.adhesive:
        return "q = E* (u − Δl),  Δl = √(2π a w/E*)  § 19"
    law = "(1) (17) (18)  q = E* u + 4η du/dt" if course.dashpots else "(17) (18)  q = E* u"
    of_class_b = course.scene.medium.inverse_to_radius
    cap = "d_c" if of_class_b else "u_c = π a σ_c/(2E*)  § 20"
    return f"{law},  u ≤ {cap}{course.more_law}"


SPRINGS = Plot(
    "springs", "1D foundation", _spring_formula, (X, Z),
    figures.SPRING_ROWS, moving=springs,
)  # fmt: skip


# Pressure.


def pressure(view: View, i: int) -> dict:
    half, top, state = view.end(R), view.end(P), view.course.states[i]
    r = figures.radii(state, half)
    return figures.pressure(state, r, state.pressure(r), half, top)


PRESSURE = Plot(
    "pressure", "Contact pressure", "(10)  σ_zz(r) = (1/π) ∫ q′(x) dx/√(x² − r²)", (R, P),
    figures.PRESSURE_ROWS, moving=pressure,
)  # fmt: skip


# Force over depth.


def _curve(course: Course, until=None) -> dict:
    """Parts of the force–depth curve, optionally up to a state."""
    depth, past = course.states.depth, slice(until)
    return split(
        depth[past], course.states.force[past], depth[past], course.states.live_interval.lower[past]
    )


def force_still(view: View) -> dict:
    course, onset = view.course, view.course.onset
    rows = {"path ahead": (course.states.depth, course.states.force)} if course.turns else _curve(course)
    if onset is not None and not course.dashpots:
        rows["onset of yield"] = np.array([onset.depth]), np.array([onset.force])
    return rows


def force(view: View, i: int) -> dict:
    """The present state, the path so far, and the areas of lost and stored energy."""
    course, right = view.course, 0.02 * view.end(D)
    states = course.states
    rows = {"now": (states.depth[[i]], states.force[[i]]), "dₚ": (np.nan, np.nan, "")}
    if (lower := float(states.plastic_depth[i])) > 0:
        rows["dₚ"] = max(lower - 3 * right, right), 0.09 * view.end(F), "dₚ"
    rows |= _curve(course, i + 1) if course.turns else {}
    if course.chained or course.adhesive:
        # No live interval tells what is stored in elements that have each a memory of their own, and with
        # adhesion the area below the curve is not what is stored.
        return rows
    return rows | figures.work(states, i)


def _force_formula(course: Course) -> str:
    if course.adhesive:
        return "F = 2E* [∫ a(s) ds − a Δl],  d_p < s < d + Δl  § 19"
    dashpots = " + 8η a dd/dt" * course.dashpots
    return f"(20) (22)  F = 2E* ∫ a(s) ds{dashpots},  d_p < s < d"


FORCE = Plot(
    "force", "Force and depth", _force_formula, (D, F),
    (
        line("path ahead", "free", 1.0),
        *figures.FORCE_ROWS,
        mark("onset of yield", "paper", "yielded", "diamond", 11),
        mark("now", size=13),
        label("dₚ"),
    ),
    force_still, force,
)  # fmt: skip


#: All plots by name; extras add theirs, each with a tab.
PLOTS: dict[str, Plot] = {plot.name: plot for plot in (SPRINGS, PRESSURE, FORCE)}
#: Names of the plots that are always shown.
NAMED = tuple(PLOTS)


def visible(view: View) -> list[Plot]:
    """Plots that a view shows, in their order."""
    shown = (*NAMED, *view.state.tiles)
    return [plot for name, plot in PLOTS.items() if name in shown and plot.applies(view)]
