"""The permanent plots of the page: springs, pressure, and force over depth."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from bokeh.events import Pan, PanEnd, PanStart
from bokeh.models import CustomJS

from mdr_core.show import figures
from mdr_core.show import springs as drawn
from mdr_core.show.figures import label, line, mark, split
from mdr_core.show.quantities import QUANTITIES
from mdr_core.show.units import format_quantity

from ..common.ui import call
from .courses import Course, onset_depth
from .plot import WIDTH, AxisSpec, Plot, View, width
from .state import LISTS, Entries

# Axes; other plots may share them.


def largest_radius(course: Course) -> float:
    return float(np.max(course.states.contact_radius))


def deepest(course: Course) -> float:
    """Return the largest depth (m), or the height of the indenter at the pull-off if it is larger."""
    return float(np.max(np.abs(course.states.depth)))


def across(course: Course) -> tuple[float, float]:
    """Return the range of coordinates around the contact."""
    half = 1.25 * largest_radius(course)
    return -half, half


def _of_states(name: str) -> Callable[[Course], tuple[float, float]]:
    """Return the span of a quantity, including an onset of yield slightly beyond the largest depth."""

    def span(course):
        onset, depth = course.onset, np.max(course.states.depth)
        values = getattr(course.states, name)
        # Adhesion gives values below zero, possibly only tension.
        largest, lowest = np.max(values), np.min(values)
        largest = max(largest, -0.25 * lowest)
        # With dashpots there is no mark: the onset is for slow loading.
        is_marked = onset is not None and not course.dashpots
        if is_marked and depth < onset.depth <= 2.5 * depth:
            largest = max(largest, getattr(onset, name))
        return float(lowest) if course.adhesive else 0.0, 1.02 * float(largest)

    return span


def _pressures(course: Course) -> tuple[float, float]:
    """Return the span of pressures, and of tensions with adhesion."""
    most = 1.05 * figures.ceiling(course.turning_point, across(course)[1])
    return -most if course.adhesive else 0.0, most


X = AxisSpec("x, coordinate of the springs", "length", across)
R = AxisSpec("r, radius", "length", across)
Z = AxisSpec("z, upward", "length", lambda course: (-drawn.REST * deepest(course), deepest(course)))
D = AxisSpec(QUANTITIES["depth"].title, "length", _of_states("depth"))
F = AxisSpec(QUANTITIES["force"].title, "force", _of_states("force"))
P = AxisSpec("p, pressure", "pressure", _pressures)


# Values outside kept axes.

OUT_OF_RANGE = label("cut off")


def _cut_off(
    view: View, states: Any, axes: dict[AxisSpec, tuple[str, str]], up: AxisSpec, share: float
) -> dict:
    """Return a label with values outside kept axes, at a share of the vertical axis.

    `axes` has quantities of the states and their symbols, by their axes.
    """
    if not view.kept:
        return {}
    values = ", ".join(dict.fromkeys(_out_of_range(view, states, axes)))
    across = view.axis(next(iter(axes)))
    left = across.start + 0.015 * (across.end - across.start)
    return {"cut off": (left, share * view.end(up), f"cut off: {values}" if values else "")}


def _out_of_range(view: View, states: Any, axes: dict[AxisSpec, tuple[str, str]]) -> Iterator[str]:
    for along, (name, symbol) in axes.items():
        axis, values = view.axis(along), getattr(states, name)
        high = -axis.start if along is Z else axis.end
        low = axis.start if along in (D, F) else -np.inf
        for value in (float(np.min(values)), float(np.max(values))):
            if not low - 1e-9 * high <= value <= (1 + 1e-9) * high:
                yield f"{symbol} = {format_quantity(value, along.kind, 3)}"


# Springs.


def springs(view: View, i: int) -> dict:
    """Return the springs by their state."""
    course, z, state = view.course, view.axis(Z), view.course.states[i]
    rows = drawn.springs(state, view.end(X), z.start, z.end, lambda g: course.relaxing(i, g))
    return rows | _cut_off(view, state, {X: ("contact_radius", "a"), Z: ("depth", "d")}, Z, 0.6)


def _spring_formula(course: Course) -> str:
    if course.adhesive:
        return "q = E* (u − Δl),  Δl = √(2π a w/E*)  § 19"
    law = "(1) (17) (18)  q = E* u + 4η du/dt" if course.dashpots else "(17) (18)  q = E* u"
    return f"{law},  u ≤ {_cap(course)}{course.more_law}"


def _cap(course: Course) -> str:
    """Return the largest elastic compression of a spring; at the largest depth if it depends on a."""
    medium = course.scene.medium
    if medium.q_c == np.inf:
        return "∞"
    if medium.inverse_to_radius:
        return f"d_c = π q_c/(2E*) = {format_quantity(float(medium.critical_depth), 'length')}"
    a = float(course.turning_point.contact_radius)
    if a == 0:
        return "u_c = π a σ_c/(2E*)  § 20"
    return f"u_c = π a σ_c/(2E*) = {format_quantity(_cap_at(medium, a), 'length')}  § 20"


def _cap_at(medium: Any, a: float) -> float:
    """Return the largest elastic compression (m) of a spring at a contact radius (m)."""
    return np.pi * a * float(medium.hardness_at(a)) / (2 * medium.E_star)


def _yields_at(view: View) -> str:
    """Return the elastic compression at which a spring yields, at the present a if it depends on that."""
    course, medium = view.course, view.course.scene.medium
    a = float(course.state.contact_radius)
    if course.adhesive or medium.q_c == np.inf or onset_depth(course.scene) == np.inf:
        return ""
    if medium.inverse_to_radius:
        return f"a spring yields at u = d_c = {format_quantity(float(medium.critical_depth), 'length')}"
    if a == 0:
        return ""
    cap = format_quantity(_cap_at(medium, a), "length")
    return f"a spring yields at u = u_c = {cap} for a = {format_quantity(a, 'length')}"


SPRINGS = Plot(
    "springs", "1D foundation", _spring_formula, (X, Z), (*drawn.SPRING_ROWS, OUT_OF_RANGE), springs,
    aside=_yields_at,
)  # fmt: skip


# Pressure.


def pressure(view: View, i: int) -> dict:
    state = view.course.states[i]
    rows = figures.pressure(state, view.end(R), view.end(P))
    return rows | _cut_off(view, state, {R: ("contact_radius", "a")}, P, 0.86)


PRESSURE = Plot(
    "pressure", "Pressure under the tip", "(10)  p(r) = −σ_zz(r) = −(1/π) ∫ q′(x) dx/√(x² − r²)", (R, P),
    (*figures.PRESSURE_ROWS, OUT_OF_RANGE), pressure, aside=lambda view: "p = −σ_zz(r)",
)  # fmt: skip


# Force over depth.


def force(view: View, i: int) -> dict:
    """Return the curve (of several loadings only up to state i), state i, and its energies as areas."""
    course, states, onset = view.course, view.course.states, view.course.onset
    past, right = slice(i + 1 if course.turns else None), 0.02 * view.end(D)
    depth = states.depth[past]
    rows = split(depth, states.force[past], depth, states.live_interval.lower[past])
    rows["now"] = states.depth[[i]], states.force[[i]]
    rows |= _cut_off(view, states, {D: ("depth", "d"), F: ("force", "F")}, F, 0.97)
    if course.turns:
        rows["path ahead"] = states.depth, states.force
    if onset is not None and not course.dashpots:
        rows["onset of yield"] = np.array([onset.depth]), np.array([onset.force])
    if (lower := float(states.plastic_depth[i])) > 0:
        text = f"dₚ = {format_quantity(lower, 'length', 3)}"
        # The text ends at its point, and begins inside the plot.
        room = width(text) / WIDTH * view.end(D)
        rows["dₚ"] = max(lower - 0.4 * right, room), 0.17 * view.end(F), text
    if course.chained or course.adhesive:
        # No areas: a live interval does not describe the stored energy of elements with separate memories.
        # With adhesion the area below the curve is not the stored energy.
        return rows
    return rows | figures.work(states, i)


def _force_formula(course: Course) -> str:
    if course.adhesive:
        return "F = 2E* [∫ a(s) ds − a Δl],  d_p < s < d + Δl  § 19"
    dashpots = " + 8η a dd/dt" * course.dashpots
    return f"(20) (22)  F = 2E* ∫ a(s) ds{dashpots},  d_p < s < d"


@dataclass(frozen=True, eq=False)
class ForcePlot(Plot):
    """Force over depth, with a free strip below the lowest force for the plastic zone."""

    def axes_of(self, view):
        depth, force = super().axes_of(view)
        return [depth, replace(force, start=force.start - STRIP * (force.end - force.start))]


#: Height of the strip below the lowest force, relative to the range of the axis.
STRIP = 0.13

FORCE = ForcePlot(
    "force", "Force and depth", _force_formula, (D, F),
    (
        line("path ahead", "free", 1.0),
        *figures.FORCE_ROWS,
        mark("onset of yield", "paper", "yielded", "diamond", 11),
        mark("now", size=13),
        label("dₚ", 0.8, "right"),
        OUT_OF_RANGE,
    ),
    force,
)  # fmt: skip


#: All plots by name; extras add plots with a tab.
PLOTS: dict[str, Plot] = {plot.name: plot for plot in (SPRINGS, PRESSURE, FORCE)}
LISTS["tiles"] = Entries(PLOTS.__contains__, 100)
#: Names of the permanent plots.
NAMED = tuple(PLOTS)


def visible(view: View) -> list[Plot]:
    """Return the plots of a view: the three permanent plots, and the first applicable optional plot."""
    optional = [PLOTS[name] for name in view.state.tiles if name not in NAMED]
    return [*map(PLOTS.get, NAMED), *[plot for plot in optional if plot.applies(view)][:1]]


#: Plots that the user can drag.
DRAGGED = ("springs", "force")


def drag_path(view: View) -> dict[str, Any]:
    """Return depth and force of all states in the units of the plots."""
    course, d, force = view.course, view.axis(D).factor, view.axis(F).factor
    found = {"d": course.states.depth / d, "F": course.states.force / force}
    found = {name: [float(f"{value:.6g}") for value in values] for name, values in found.items()}
    # The user cannot set the depth of an impact, or of a path with several turns.
    pressing = not course.turns and course.hit is None
    return found | {"unit": d / view.axis(Z).factor, "pressing": pressing}


def enable_drag(figure: Any) -> None:
    """Make a figure draggable."""
    for event in (PanStart, Pan, PanEnd):
        figure.js_on_event(event, CustomJS(code=call("drag", "cb_obj")))
