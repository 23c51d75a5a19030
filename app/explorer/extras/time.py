"""The plots over time: *In time* with depth and force, and *Energy* with the balance of energy."""

import numpy as np

from mdr_core.show.figures import NOTHING, area, line, mark

from ..courses import Course
from ..extra import Extra
from ..plot import AxisSpec, Plot, T, View, line_at_time
from ..plots import D, F


def motion_places(view: View, i: int) -> dict:
    time, states = view.course.motion.time, view.course.states
    return {
        "depth d": (time, states.depth),
        "force F": (time, states.force),
        "now": (time[[i]], states.depth[[i]]),
        "F now": (time[[i]], states.force[[i]]),
        "time": line_at_time(view, i, D),
    }


def _law(course: Course) -> str:
    if course.hit is None:
        return "prescribed  § 8, § 14"
    return f"m d²{'(d + w)' if course.structure else 'd'}/dt² = −F,  § 9"


MOTION = Plot(
    "motion", "Depth and force over time",
    _law,
    (T, D, F),
    (
        line("depth d", "speed", 2.2, symbol="d"),
        line("force F", "elastic", 2.2, "dashed", "F", axis=2),
        line("time", "ink", 1.0, "dashed", legend=False),
        mark("now"),
        mark("F now", marker="diamond", size=11, axis=2, legend=False),
    ),
    motion_places, applies=lambda view: view.course.motion is not None, tab="In time", order=30,
    aside=lambda view: view.course.asides.get("restitution", ""),
)  # fmt: skip


def energies(course: Course) -> dict:
    """Return losses so far, stored and kinetic energy (J), by the names of their areas."""
    m = course.ledger
    more = {"friction": m.friction_work} if hasattr(m, "friction_work") else {}
    if course.structure:
        more = {"waves": m.structure_work, "structure": m.support_energy}
    return more | {
        "plastic": m.plastic_work,
        "viscous": m.viscous_work,
        "stored": m.stored_energy,
        "kinetic": m.kinetic_energy,
    }


def _total(course: Course) -> tuple[float, float]:
    return 0.0, float(np.max(sum(energies(course).values())))


E = AxisSpec("E, energy", "energy", _total)


def energy_places(view: View, i: int) -> dict:
    """Return stored, kinetic and lost energies on top of each other, and the present time."""
    time, rows = view.course.motion.time, {"time": line_at_time(view, i, E)}
    lower = np.zeros_like(time)
    for name, energy in energies(view.course).items():
        upper = lower + energy
        between = np.append(time, time[::-1]), np.append(upper, lower[::-1])
        # Rounding errors are not in the legend.
        rows[name] = between if energy.max() > 1e-9 * view.end(E) else NOTHING
        lower = upper
    return rows


def _ledger(course: Course) -> str:
    friction = "friction" in energies(course)
    lost = "U + W_p" + " + W_v" * course.dashpots + " + W_f" * friction
    if course.structure:
        lost += " + W_s" if course.structure.is_plate else " + U_s"
    if course.hit is None:
        return f"{lost} = ∫ F dd  § 14"
    along = " + m_t v_t²/2" * friction
    speed = "V" if course.structure else "v"
    return f"{lost} + m {speed}²/2{along} = const.  § 9" + ", § 13" * friction


ENERGY = Plot(
    "energy", "Energy balance", _ledger, (T, E),
    (
        area("friction", "slip", 0.6, "x"),
        area("waves", "stick", 0.45, "-"),
        area("structure", "stick", 0.3, "|"),
        area("plastic", "yielded", 0.45, "/"),
        area("viscous", "loss", 0.5, "\\"),
        area("stored", "elastic", 0.45),
        area("kinetic", "speed", 0.3),
        line("time", "ink", 1.0, "dashed", legend=False),
    ),
    energy_places,
    applies=lambda view: view.course.motion is not None, tab="Energy", order=40,
)  # fmt: skip


EXTRA = Extra("time", plots=(MOTION, ENERGY))
