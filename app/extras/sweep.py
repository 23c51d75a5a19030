"""The plot *Sweep*: results over a range of one number, with the limit of fast impacts."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup

from mdr_core.show.figures import NOTHING, line, mark
from mdr_core.show.quantities import QUANTITIES as RESULTS
from mdr_core.show.units import KINDS, digits

from ..changes import option
from ..common.errors import in_words
from ..common.units import in_full
from ..extra import Extra
from ..fields import slider_range
from ..figures import Logarithmic
from ..host import last
from ..parts import Part, button
from ..plot import OF_AXIS, Plot, View, axis
from ..quantities import CHOICES, QUANTITIES, Option, lowered, quantity, read_data
from ..shared.rest import Found, Resting, Searched
from ..state import PRESETS, State, used, used_by
from ..sweeps import CLASSES, FAST, SOLVERS, Sweep
from ..ui import marked

_DATA = read_data(Path(__file__).with_suffix(".json"))
_RESULTS = _DATA["results"]
#: The energy of an impact, which is swept by the speed.
_ENERGY = quantity(**_DATA["energy"])

#: Dashes of the lines beside that of the scene.
LINES = dict(zip((FAST, *CLASSES), ("dashed", "dotted", "dashed", "dotdash"), strict=True))
#: Of a ratio, as the restitution, what is nothing beside its largest value.
_NOTHING = 1e-3
#: Shapes with closed forms.
_SHAPES = ("cone", "paraboloid", "power_law")


def known(name: str):
    """A quantity that can be swept."""
    return _ENERGY if name == "energy" else QUANTITIES[name]


for _name in ("energy", *QUANTITIES):
    _label = lowered(f"{known(_name).symbol}, {known(_name).label}")
    CHOICES["sweep.swept"].options[_name] = Option(_label)


def swept(state: State) -> list[str]:
    """What can be swept, the first one if nothing is chosen."""
    if state.drive not in SOLVERS:
        names = CHOICES["sweep.swept"].options
        return [each for each in names if each == "energy" or state[each] is not None]
    own, impact = used_by(state, "drive"), state.drive == "impact"
    idle = ("density",) if impact else ("density", "eta")
    works = [each for each in used(state) if each not in idle and QUANTITIES[each].span >= 0]
    return ["energy"] * impact + sorted(works, key=lambda each: each not in own)


def against(state: State) -> list[str]:
    """Results that can be drawn."""
    return _RESULTS.get(state.drive) or list(CHOICES["sweep.against"].options)


def _value(state: State, name: str) -> float:
    return state.mass * state.speed**2 / 2 if name == "energy" else state[name]


def asked(state: State) -> Sweep:
    """The sweep of a state, over the range of a slider about the value of the preset."""
    name = option(state, "sweep.swept")
    value, middle = (_value(each, name) for each in (state, state.replace(**PRESETS[state.preset].values)))
    low, _, high = slider_range(known(name), middle, value)
    chosen = option(state, "sweep.against"), state["sweep.scale"] == "log", SOLVERS.get(state.drive, "")
    return Sweep(state.scene_values, name, value, low, high, *chosen)


def quick(sweep: Sweep) -> bool:
    """Whether the sweep is fast enough for every move: shapes with closed forms."""
    one_by_one = sweep.solver == "indent_to_force" and sweep.swept != "max_force"
    return not (one_by_one or sweep.in_time) and sweep.state.shape in _SHAPES


def found(course, sweep: Sweep) -> Found:
    """Curve of the sweep with the present value and limits."""
    return last(in_steps(course, sweep))


def in_steps(course, sweep: Sweep) -> Iterator[Found | None]:
    """`found`, after a step for each of its lines."""
    if not sweep.solver:
        yield Found({}, [], "This drive has no sweep: press to a depth or a force, or let a body hit.")
        return
    result = course.turning_point if course.hit is None else course.hit
    numbers, present = sweep.numbers, getattr(result, sweep.against)
    values = sweep.column(numbers, sweep.against)
    yield None
    inside = sweep.low <= sweep.present <= sweep.high
    columns, classes = {"this scene": values} | sweep.fast(numbers), {}
    for row, each in sweep.each_class() if inside else ():
        yield None
        classes[row], columns[row] = each, each.column(numbers, each.against)
        yield None
    rows = {name: (numbers, column) for name, column in columns.items()}
    x, y = _axes(sweep, values, float(present))
    if y.log:
        rows = {name: (numbers, np.where(row > 0, row, np.nan)) for name, (_, row) in rows.items()}
    visible = inside and (present > 0 or not y.log)
    rows["present value"] = (np.array([sweep.present]), np.array([present])) if visible else NOTHING
    yield Found(rows, [x, y], Markup(" ").join(_notes(sweep, numbers, values, classes, inside)))


def _axes(sweep, values, present):
    """Both logarithmic, to show powers, or linear; a ratio that is nearly 0 somewhere has a linear one."""
    quantity, result = known(sweep.swept), RESULTS[sweep.against]
    log = sweep.logarithmic and sweep.low > 0
    # Over decades in the unit of the present value: J for 2.75 J, not kJ for the end of the range.
    fits = min(sweep.present, sweep.high) if log else sweep.high
    x = axis(lowered(f"{quantity.symbol}, {quantity.label}"), quantity.kind, fits)
    x = replace(x, start=sweep.low if log else min(sweep.low, 0.0), end=sweep.high, log=log)
    sizes = np.append(values, present)
    sizes = sizes[np.isfinite(sizes)]
    title = CHOICES["sweep.against"].options[sweep.against].label
    y = axis(title, KINDS[result.unit], max(sizes, default=1.0))
    if not (log and (sizes > 0).any() and (result.unit or (sizes > _NOTHING * max(sizes)).all())):
        return x, y
    # At most six decades, between powers of ten.
    least, most = max(min(sizes[sizes > 0]), 1e-6 * max(sizes)), max(sizes)
    low, high = 10.0 ** np.floor(np.log10(least / y.factor)), 10.0 ** np.ceil(np.log10(most / y.factor))
    return x, replace(y, start=low * y.factor, end=max(high, 10 * low) * y.factor, log=True)


def _power(sweep):
    """The power law at the present value, by its log–log slope; empty where the result is 0."""
    pair = sweep.present * np.array([0.999, 1.001])
    ends = sweep.column(pair, sweep.against)
    if not (ends > 0).all():
        return ""
    slope = round(float(np.log(ends[1] / ends[0]) / np.log(pair[1] / pair[0])), 6)
    return Markup("{}<sup>{}</sup>").format(marked(known(sweep.swept).symbol), digits(slope, 3))


def _told(row, sweep):
    """Class, constant and law of a sweep of another class."""
    constant = QUANTITIES[CLASSES[row][1]]
    value = in_full(sweep.state[constant.name], constant.kind)
    told = [marked(f"{row.split()[0]} {constant.symbol} = {value}"), sweep.low > 0 and _power(sweep)]
    return Markup(", ").join(part for part in told if part)


def _notes(sweep, numbers, values, classes, inside):
    quantity = known(sweep.swept)
    if not inside:
        shown = in_full(sweep.present, quantity.kind)
        value = marked(f"{quantity.symbol} = {shown}")
        yield Markup("The present value, {}, is outside the range.").format(value)
    elif sweep.low > 0 and (power := _power(sweep)):
        result = marked(RESULTS[sweep.against].symbol)
        yield Markup("At the present value {} ∝ {}.").format(result, power)
    if classes:
        told = [_told(row, each) for row, each in classes.items()]
        yield Markup("Through the same point: {}.").format(Markup("; ").join(told))
    elif inside and not sweep.yields:
        yield "Nothing yields at the present value."
    refused = numbers[np.isnan(values)]
    if refused.size:
        try:
            sweep.solve(float(refused[0]))
        except ValueError as error:
            yield marked(f"Not all of the range can be solved: {in_words(error)}.")


@dataclass(frozen=True, eq=False)
class SweepPlot(Searched):
    """The plot, whose choices offer what applies to the drive."""

    def options_of(self, state, control):
        offered = {"sweep.swept": swept, "sweep.against": against}
        return offered[control](state) if control in offered else super().options_of(state, control)


SWEEP = SweepPlot(
    "sweep", "Sweep", "one parameter varied, all others fixed  § 10, § 20", (),
    (
        *(line(name, "ink", 1.4, dash, OF_AXIS) for name, dash in LINES.items()),
        line("this scene", "elastic", 2.4, symbol=OF_AXIS),
        mark("present value"),
    ),
    find=in_steps, asks=asked, quick=quick, tab="Sweep", order=90, picture=Logarithmic,
    controls=("sweep.swept", "sweep.against", "sweep.scale"),
)  # fmt: skip


def e_over_v(page: Any, plot: Plot, view: View) -> Part | None:
    """The button above the force of an impact that shows the restitution over the speed."""
    if plot.name != "force" or view.state.drive != "impact":
        return None
    shown = {"tiles": ("sweep",), "sweep.swept": "speed", "sweep.against": "restitution"}
    return button("e over v", lambda: page.apply(lambda state: state.replace(**shown)))


EXTRA = Extra(
    "sweep",
    plots=(SWEEP,),
    on_plots=e_over_v,
    service=Resting,
)
