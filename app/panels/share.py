"""Exports: link, report, curves as CSV in SI, and Python."""

from collections.abc import Callable
from inspect import signature
from io import StringIO
from typing import Any

import numpy as np
import panel as pn

import mdr_core as mdr
from mdr_core.results.quantities import QUANTITIES as RESULTS

from ..drives import Course, arguments, named
from ..plots.sweep import asked as asked_sweep
from ..solve import DRIVES, drive_of, numbers_of
from ..state import PRESETS, State, altered, link
from ..state.files import Measured
from ..ui import WIDE, field, html, show
from .report import report

#: Columns of the states along a path, by their names in the core's table; those of a motion.
_STATES = ("depth", "force", "contact_radius", "plastic_radius", "plastic_depth")
_TIMED = ("velocity", "kinetic_energy", "viscous_work")
_OBLIQUE = ("tangential_velocity", "tangential_force", "friction_work", "stick_radius", "slip_radius")
#: How far the pressure of a measured tip can be trusted.
_MEASURED = (
    "sigma_zz: Eq. (10) of Popov (2015), to rounding for the tip with straight lines between its samples",
    "every sample is a kink: next to a sharp one the pressure is that of the kink, not of the real tip",
)


def _head(name: str) -> str:
    known = RESULTS[name]
    return f"{known.long_name} {known.symbol} ({known.unit or '1'})".replace(",", "")


def csv(course: Course, state: State) -> str:
    """All states along the path."""
    columns = {"time": course.motion.time} if course.motion is not None else {}
    columns |= {name: getattr(course.states, name) for name in _STATES}
    columns |= {"stored_energy": course.stored_energy, "plastic_work": course.plastic_work}
    if course.motion is not None:
        columns |= {name: getattr(course.ledger, name) for name in _TIMED}
    if course.oblique is not None:
        columns |= {name: getattr(course.oblique, name) for name in _OBLIQUE}
    return _table(
        course, state, "states along the path", {_head(name): column for name, column in columns.items()}
    )


def pressure_csv(course: Course, state: State, points: int = 401) -> str:
    """Pressure, line load and reduced profile of the present state."""
    now, profile = course.state, course.scene.profile
    largest = 1.25 * float(course.turning_point.contact_radius)
    r = np.linspace(0, min(largest, profile.known_radius), points)
    columns = {
        "radius r (m)": r,
        "sigma_zz (Pa)": 0.0 - now.pressure(r),
        "line load q (N/m)": now.line_load(r),
        "reduced profile g (m)": profile.reduced(r),
    }
    title = f"state at depth d = {float(now.depth)!r} m, force F = {float(now.force)!r} N"
    notes = _MEASURED if isinstance(profile, mdr.Sampled) else ()
    return _table(course, state, title, columns, notes)


def fit_csv(course: Course, state: State) -> str:
    """The measured curve with its fit; values, errors and remarks are in the header."""
    found, (depth, force) = state.curve.fit, state.curve.data
    columns = {
        "measured depth z (m)": depth,
        "measured force (N)": force,
        "depth d (m)": found.path.depth,
        "modelled force F (N)": found.path.force,
        "residual (N)": found.residuals,
    }
    asked = {name: value for name, value in state.curve.asked.items() if value is not None}
    given = ", ".join(f"{name} = {value!r}" for name, value in asked.items())
    values = [f"{name} = {value!r}" for name, value in found.to_dict().items()]
    notes = ["fit, SI units:", f"  held or given: {given or 'nothing'}", *values, *repr(found).splitlines()]
    title = f"fit to {state.curve.name}; inputs are those of the page as it stands"
    return _table(course, state, title, columns, notes)


def _table(course: Course, state: State, title: str, columns: dict, notes=()) -> str:
    lines = [f"mdr_core {mdr.__version__}: {title}", "inputs, SI units:"]
    lines += [f"  {name}: {value}" for name, value in _inputs(course.scene, state)]
    rows = zip(*(np.asarray(values, float).tolist() for values in columns.values()), strict=True)
    table = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    return "\n".join([*(f"# {line}" for line in (*lines, *notes)), *table]) + "\n"


def _inputs(scene, state):
    medium, profile = scene.medium, scene.profile
    yield "preset", f"{PRESETS[state.preset].label}{', altered' if altered(state) else ''}"
    yield "profile", repr(profile)
    text = f"E_star = {medium.E_star!r} Pa, q_c = {medium.q_c!r} N/m, eta = {medium.eta!r} Pa·s"
    yield "medium", f"{text}, poisson = {float(medium.poisson)!r}"
    # What the medium was made of.
    given = [name for name in numbers_of(state) if name not in ("E_star", "q_c", "eta")]
    yield "set on the page", ", ".join(f"{name} = {state[name]!r}" for name in given)
    yield "drive", repr(scene.drive)


def fit_python(curve: Measured) -> str:
    """Python that repeats the fit from the file of `fit_csv`."""
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


def python(course: Course, held=()) -> str:
    """Python that reproduces the present state and those of held scenes."""
    lines = ["import mdr_core as mdr", "", *_solved(course)]
    for k, each in enumerate(held, 1):
        lines += ["", f"# Held to compare with, {k}: {' '.join(each.name.split())}"]
        lines += _solved(each.course, f"held_{k}_")
    return "\n".join(lines) + "\n"


def sweep_csv(course: Course, state: State) -> str:
    """All results of the sweep."""
    sweep = asked_sweep(state)
    names, numbers = sweep.drive.results, sweep.numbers
    if not sweep.drive.solver:
        return _table(course, state, "this drive is not swept", {})
    heads = [f"{name} {RESULTS[name].symbol} ({RESULTS[name].unit})" for name in names]
    columns = {sweep.swept: numbers} | dict(zip(heads, sweep.columns(numbers, names), strict=True))
    limit = {f"{name} (SI)".replace(",", ":"): row for name, row in sweep.limits(numbers)[0].items()}
    title = f"sweep of {sweep.swept} (SI) from {sweep.low!r} to {sweep.high!r}"
    return _table(course, state, title, columns | limit)


def sweep_python(state: State) -> str:
    """Python that reproduces the curve of the sweep."""
    sweep = asked_sweep(state)
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
    return f"mdr.{type(value).__name__}({arguments(value, shown)})"


def _solved(course: Course, prefix: str = "") -> list[str]:
    scene, names = course.scene, (f"{prefix}profile", f"{prefix}medium")
    lines = [f"{names[0]} = {_made(scene.profile)}", f"{names[1]} = {_made(scene.medium)}  # Pa, N/m, Pa·s"]
    return lines + drive_of(scene).snippet(course, ", ".join(names), prefix)


class Share:
    """The panel *Share*; `shown` returns what the page shows."""

    def __init__(self, shown: Callable[[], Any]):
        self._shown = shown

        def curves(write):
            return lambda: write(shown().view.course, shown().state)

        files = {
            "Report": ("report.html", self._report),
            "Curves (CSV)": ("curves.csv", curves(csv)),
            "Pressure (CSV)": ("pressure.csv", curves(pressure_csv)),
            "Sweep (CSV)": ("sweep.csv", curves(sweep_csv)),
            "Python": ("scene.py", self.snippet),
            "Fit (CSV)": ("fit.csv", curves(fit_csv)),
        }
        self.files = {label: self._file(label, *of) for label, of in files.items()}
        self.link = field(pn.widgets.TextInput, label="Link to this page")
        self.python = field(pn.widgets.TextAreaInput, label="This state with mdr_core", rows=12)
        self._note = html()
        buttons = pn.FlexBox(*self.files.values(), css_classes=["tools"], **WIDE)
        self.view = pn.Column(self.link, self._note, buttons, self.python, visible=False, **WIDE)

    @staticmethod
    def _file(label, name, write):
        options = {"callback": lambda: StringIO(write()), "filename": name, "label": label, "auto": True}
        return pn.widgets.FileDownload(css_classes=["button"], margin=0, **options)

    def address(self) -> str:
        """Link to the page; ValueError if it is too long."""
        shown = self._shown()
        base = pn.state.location.href.split("?")[0] if pn.state.location else ""
        query = link.write(shown.state, DRIVES[shown.state.drive].form)
        return f"{base}?{query}" if query else base

    def show(self) -> None:
        state = self._shown().state
        try:
            address, note = self.address(), ""
        except ValueError as error:
            address, note = "", f"No link: {error}."
        if state.curve is not None:
            note += " The measured curve is not in the link: it stays in its file. What was fitted is."
        show(self.link, value=address)
        show(self._note, object=note)
        show(self.python, value=self.snippet())
        show(self.files["Fit (CSV)"], visible=state.curve is not None and state.curve.fit is not None)

    def snippet(self) -> str:
        shown = self._shown()
        text, curve = python(shown.view.course, shown.held), shown.state.curve
        if "sweep" in shown.state.tiles:
            text += sweep_python(shown.state)
        return text + fit_python(curve) if curve is not None and curve.fit is not None else text

    def _report(self):
        shown, names = self._shown(), [each.name for each in self._shown().held]
        try:
            address = self.address()
        except ValueError:
            address = ""
        return report(shown.state, shown.view, shown.plots, self.snippet(), address, names)
