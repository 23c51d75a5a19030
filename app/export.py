"""What is taken away as text: curves as CSV, and the state as a Python snippet."""

from inspect import signature

import numpy as np

import mdr_core as mdr
from mdr_core.results.quantities import QUANTITIES as RESULTS

from . import friction
from .drives import drive_of
from .drives.drive import arguments, named
from .sweep import asked

#: How far the pressure of a measured tip can be trusted.
_MEASURED = (
    "sigma_zz: Eq. (10) of Popov (2015), to rounding for the tip with straight lines between its samples",
    "every sample is a kink: next to a sharp one the pressure is that of the kink, not of the real tip",
)


def csv(trajectory, explorer):
    """Every state along the way as CSV in SI, with inputs, units and version in its header."""
    states, motion = trajectory.states, trajectory.motion
    columns = {
        "depth d (m)": states.depth,
        "force F (N)": trajectory.force,
        "contact radius a (m)": states.contact_radius,
        "plastic radius c (m)": states.plastic_radius,
        "plastic depth d_p (m)": states.live_interval.lower,
        "stored energy U (J)": trajectory.stored_energy,
        "plastic work W_p (J)": trajectory.plastic_work,
    }
    if motion is not None:
        columns = {"time t (s)": motion.time} | columns
        columns["velocity v (m/s)"] = motion.velocity
        columns["kinetic energy (J)"] = trajectory.ledger.kinetic_energy
        columns["viscous work (J)"] = trajectory.ledger.viscous_work
    if trajectory.oblique is not None:
        columns |= friction.table(trajectory.oblique)
    return _table(trajectory, explorer, "states along the way", columns)


def pressure_csv(trajectory, explorer, points=401):
    """Pressure, line load and reduced profile of the present state as CSV in SI."""
    state, profile = trajectory.state, trajectory.scene.profile
    largest = 1.25 * float(trajectory.deepest.contact_radius)
    r = np.linspace(0, min(largest, profile.known_radius), points)
    columns = {
        "radius r (m)": r,
        "sigma_zz (Pa)": 0.0 - state.pressure(r),
        "line load q (N/m)": state.line_load(r),
        "reduced profile g (m)": profile.reduced(r),
    }
    title = f"state at depth d = {float(state.depth)!r} m, force F = {float(state.force)!r} N"
    notes = _MEASURED if isinstance(profile, mdr.Sampled) else ()
    return _table(trajectory, explorer, title, columns, notes)


def fit_csv(trajectory, explorer):
    """The measured curve as it was fitted, in SI, with all values, errors and remarks in the header."""
    found, (depth, force) = explorer.measured.fit, explorer.measured.data
    columns = {
        "measured depth z (m)": depth,
        "measured force (N)": force,
        "depth d (m)": found.path.depth,
        "modelled force F (N)": found.path.force,
        "residual (N)": found.residuals,
    }
    asked = {name: value for name, value in explorer.measured.asked.items() if value is not None}
    given = ", ".join(f"{name} = {value!r}" for name, value in asked.items())
    values = [f"{name} = {value!r}" for name, value in found.to_dict().items()]
    told = ["fit, SI units:", f"  held or given: {given or 'nothing'}", *values, *repr(found).splitlines()]
    title = f"fit to {explorer.measured.name}; inputs are those of the page as it stands"
    return _table(trajectory, explorer, title, columns, told)


def _table(trajectory, explorer, title, columns, notes=()):
    lines = [f"mdr_core {mdr.__version__}: {title}", "inputs, SI units:"]
    lines += [f"  {name}: {value}" for name, value in _inputs(trajectory.scene, explorer)]
    rows = zip(*(np.asarray(values, float).tolist() for values in columns.values()), strict=True)
    table = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    return "\n".join([*(f"# {line}" for line in (*lines, *notes)), *table]) + "\n"


def _inputs(scene, explorer):
    medium, profile = scene.medium, scene.profile
    if explorer.preset:
        yield "preset", f"{explorer.preset}{', altered' if explorer.altered else ''}"
    yield "profile", repr(profile)
    text = f"E_star = {medium.E_star!r} Pa, q_c = {medium.q_c!r} N/m, eta = {medium.eta!r} Pa·s"
    yield "medium", f"{text}, poisson = {float(medium.poisson)!r}"
    # What the medium was made of.
    given = [name for name in explorer.used() if name not in ("E_star", "q_c", "eta")]
    yield "set on the page", ", ".join(f"{name} = {getattr(explorer, name)!r}" for name in given)
    yield "drive", repr(scene.drive)


def fit_python(curve):
    """Lines that come to the fit with `mdr_core`, from what `fit_csv` writes."""
    usual = signature(mdr.fit_indentation).parameters
    asked = {name: value for name, value in curve.asked.items() if value != usual[name].default}
    given = ", ".join(["tip", "z", "F", *[named(asked)] * bool(asked)])
    return f"""
# The fit to {curve.name}; fit.csv is what the page saves of it.
import numpy as np

z, F = np.genfromtxt("fit.csv", delimiter=",", usecols=(0, 1))[1:].T  # m, N
tip = {_made(curve.fit.profile)}
fit = mdr.fit_indentation({given})
print(fit)
"""


def python(trajectory, held=()):
    """A snippet that comes to the present state with `mdr_core`, and to those that are `held` beside it."""
    lines = ["import mdr_core as mdr", "", *_solved(trajectory)]
    for k, each in enumerate(held, 1):
        lines += ["", f"# Held to compare with, {k}: {' '.join(each.name.split())}"]
        lines += _solved(each.way, f"held_{k}_")
    return "\n".join(lines) + "\n"


def sweep_csv(trajectory, explorer):
    """All results of a sweep as CSV in SI, with inputs, units and version in its header."""
    sweep = asked(explorer)
    names, numbers = sweep.drive.results, sweep.numbers
    if not sweep.drive.solver:
        return _table(trajectory, explorer, "this drive is not swept", {})
    heads = [f"{name} {RESULTS[name].symbol} ({RESULTS[name].unit})" for name in names]
    columns = {sweep.swept: numbers} | dict(zip(heads, sweep.columns(numbers, names), strict=True))
    limit = {f"{name} (SI)".replace(",", ":"): row for name, row in sweep.limits(numbers)[0].items()}
    title = f"sweep of {sweep.swept} (SI) from {sweep.low!r} to {sweep.high!r}"
    return _table(trajectory, explorer, title, columns | limit)


def sweep_python(explorer):
    """Lines that come to the curve of a sweep with `mdr_core`."""
    sweep = asked(explorer)
    if not sweep.drive.solver:
        return ""
    numbers = sweep.numbers[:, None]
    profile, medium, given = sweep.parts(numbers)

    def shown(value):
        if np.array_equal(value, numbers):
            return "swept"
        if sweep.swept == "energy" and np.ndim(value):
            return f"(2 * swept / {given['mass']!r}) ** 0.5"
        return f"np.array({np.ravel(value).tolist()})[:, None]" if np.ndim(value) == 2 else repr(value)

    solver, space = f"mdr.{sweep.drive.solver[0]}", "geomspace" if sweep.logarithmic else "linspace"
    solved, found = f"{solver}(profile, medium, {named(given, shown)})", f"result.{sweep.against}[:, 0]"
    if not sweep.together:
        each = "profile.entries(i, swept.shape), medium.entries(i, swept.shape)"
        solved = f"[{solver}({each}, {named(given, shown)}) for i in np.ndindex(swept.shape)]"
        found = f"[each.{sweep.against} for each in result]"
    return f"""
# {sweep.against} over {sweep.swept}, in SI units:
import numpy as np

swept = np.{space}({sweep.low!r}, {sweep.high!r}, {len(numbers)})[:, None]
profile = {_made(profile, shown)}
medium = {_made(medium, shown)}
result = {solved}
print({found})
"""


def _made(value, shown=repr):
    """A profile or a medium in Python."""
    return f"mdr.{type(value).__name__}({arguments(value, shown)})"


def _solved(trajectory, prefix=""):
    """Lines for one state, its names with a prefix."""
    scene, names = trajectory.scene, (f"{prefix}profile", f"{prefix}medium")
    lines = [f"{names[0]} = {_made(scene.profile)}", f"{names[1]} = {_made(scene.medium)}  # Pa, N/m, Pa·s"]
    return lines + drive_of(scene).snippet(trajectory, ", ".join(names), prefix)
