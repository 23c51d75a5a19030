"""Depth, force and energies over time, and friction of an oblique impact."""

import numpy as np

from mdr_core.results.figures import NOTHING, area, line, mark

from ..drives import Course
from .plot import Plot, View, held_rows


def motion_still(view: View) -> dict:
    on = view.course.on_axes
    return {"depth d": (on["t"], on["d"]), "force F": (on["t"], on["F"])} | view.held_on_axes("t", "F")


def _marks(y: str):
    """Marks of the present state on the axis `y` and of its force."""
    return lambda view, i: {
        "now": view.mark(i, "t", y),
        "F now": view.mark(i, "t", "F"),
        "time": view.time(i, y),
    }


MOTION = Plot(
    "motion", "Depth and force over time",
    lambda course: "m d²d/dt² = −F,  § 9" if course.hit else "as prescribed  § 8, § 14", ("t", "d", "F"),
    (
        *held_rows("F", axis=2),
        line("depth d", "speed", 2.2, symbol="d"),
        line("force F", "elastic", 2.2, "dashed", "F", axis=2),
        line("time", "ink", 1.0, "dashed", legend=False),
        mark("now"),
        mark("F now", marker="diamond", size=11, axis=2, legend=False),
    ),
    motion_still, _marks("d"), tab=("In time", "v"),
)  # fmt: skip


def energy_still(view: View) -> dict:
    time, rows = view.course.motion.time, {}
    lower = np.zeros_like(time)
    for name, energy in view.course.energies.items():
        upper = lower + energy
        between = np.append(time, time[::-1]), np.append(upper, lower[::-1])
        # Rounding errors are not in the legend.
        rows[name] = between if energy.max() > 1e-9 * view.size["E"] else NOTHING
        lower = upper
    return rows


def _ledger(course: Course) -> str:
    lost = "U + W_p" + " + W_v" * course.dashpots + " + W_f" * (course.oblique is not None)
    if course.hit is None:
        return f"{lost} = ∫ F dd  § 14"
    along = " + m_t W²/2" * (course.oblique is not None)
    return f"{lost} + m v²/2{along} = const.  § 9" + ", § 13" * bool(along)


ENERGY = Plot(
    "energy", "Where the energy is", _ledger, ("t", "E"),
    (
        area("friction", "slip", 0.6, "x"),
        area("plastic", "yielded", 0.45, "/"),
        area("viscous", "loss", 0.5, "\\"),
        area("stored", "elastic", 0.45),
        area("kinetic", "speed", 0.3),
        line("time", "ink", 1.0, "dashed", legend=False),
    ),
    energy_still, lambda view, i: {"time": view.time(i, "E")}, tab=("Energy", "n"),
)  # fmt: skip


def forces_still(view: View) -> dict:
    on, most = view.course.on_axes, view.course.scene.drive.friction * view.course.states.force
    both = np.append(on["t"], [np.nan, *on["t"]]), np.append(most, [np.nan, *-most])
    rows = {"normal force F": (on["t"], on["F"]), "tangential force Fₓ": (on["t"], on["force"])}
    return rows | {"largest friction ±μF": both} | view.held_on_axes("t", "force")


FORCES = Plot(
    "forces", "Forces of an oblique impact", "|F_x| ≤ μ F,  § 13", ("t", "force"),
    (
        *held_rows("F"),
        line("largest friction ±μF", "slip", 1.2, "dashed", "μF"),
        line("normal force F", "elastic", 2.2, symbol="F"),
        line("tangential force Fₓ", "stick", 2.2, symbol="Fₓ"),
        line("time", "ink", 1.0, "dashed", legend=False),
        mark("now"),
        mark("F now", marker="diamond", legend=False),
    ),
    forces_still, _marks("force"), tab=("Friction", "c"),
)  # fmt: skip
