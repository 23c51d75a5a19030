"""The plot *Sweep*: results over one number, with other classes of hardness and limiting cases."""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup

import mdr_core as mdr
from mdr_core.show.figures import NOTHING, line, mark, word
from mdr_core.show.quantities import QUANTITIES as RESULTS
from mdr_core.show.units import KINDS, digits

from ...common.errors import error_text
from ...common.quantities import CHOICES, QUANTITIES, Option, quantity, read_data, unicode_subscripts
from ...common.ui import html_subscripts
from ...common.units import in_full
from ..changes import CONSTANTS, crossing, option, shown, with_tile
from ..drives import DRIVES
from ..extra import Extra
from ..figures import Logarithmic
from ..plot import OF_AXIS, Plot, View, axis, words_along
from ..search import AsyncPlot, IdleSearch, SearchResult
from ..state import PRESETS, State, medium, numbers_of, profile, used, yield_constant
from ..widgets import Part, button, slider_range

#: Functions of the core by drives.
SOLVERS = {"depth": "indent", "force": "indent_to_force", "impact": "impact"}
#: Numbers of points along the range: in general; for impacts in time (1 ms each); for impacts by modes
#: (0.1 s each); and of further points by modes, where the result changes most.
POINTS, IN_TIME, BY_MODES, FINER = (81, 31, 13, 0) if sys.platform == "emscripten" else (81, 31, 25, 12)
#: Names of the fast limit of class (b), of limiting structures, and of the classes (option, constant).
FAST = "fast limit (23) (24), class (b)"
LIMITING = "plate without edges", "support without mass"
CLASSES = {
    "(a) hardness constant": ("constant", "volume_hardness"),
    "(b) hardness ∝ 1/a": ("q_c", "q_c"),
    "(c) hardness ∝ 1/a²": ("line", "f_c"),
}
#: Attributes of an impact with results of its fast limit.
_LIMITS = {
    "damaged_area": "fast_limit.contact_area",
    "max_depth": "fast_limit.max_depth",
    "restitution": "fast_limit.restitution",
}


@dataclass(frozen=True)
class Sweep:
    """Sweep: the scene, the swept number with its range, and the result."""

    state: State
    swept: str
    present: float
    low: float
    high: float
    against: str
    logarithmic: bool
    #: Function of the core, "" if the drive has none.
    solver: str

    @property
    def in_time(self):
        """Whether the sweep solves impacts with dashpots or on a structure."""
        return self.solver == "impact" and (self.state.damping != "none" or self.structure is not None)

    @cached_property
    def structure(self):
        """Structure of the present scene, or None."""
        return DRIVES[self.state.drive].given_quickly(self.state).get("structure")

    @property
    def by_modes(self):
        """Whether the sweep solves impacts on a structure with modes."""
        return self.structure is not None and self.structure.modes is not None

    @property
    def numbers(self):
        space = np.geomspace if self.low > 0 else np.linspace
        count = BY_MODES if self.by_modes else IN_TIME if self.in_time else POINTS
        return space(self.low, self.high, count)

    def at(self, numbers):
        """Return the state with values of the swept number."""
        if self.swept == "energy":
            return self.state.replace(speed=(2 * numbers / self.state.mass) ** 0.5)
        return self.state.replace(**{self.swept: numbers})

    def solve(self, numbers):
        """Solve the scene for values of the swept number."""
        state = self.at(numbers)
        given = DRIVES[state.drive].given_quickly(state)
        return getattr(mdr, self.solver)(profile(state), medium(state), **given)

    def column(self, numbers, quantity):
        """Return a result at values of the swept number; NaN if the core raises an error."""
        try:
            result = self.solve(numbers[:, None] if len(numbers) > 1 else float(numbers[0]))
            return np.broadcast_to(attrgetter(quantity)(result), (len(numbers), 1))[:, 0]
        except ValueError:
            if len(numbers) == 1:
                return np.full(1, np.nan)
            return np.hstack([self.column(half, quantity) for half in np.array_split(numbers, 2)])

    def one_by_one(self, numbers, quantity):
        """Return the numbers, with further numbers between them, and the results; one step for each."""
        values = []
        for number in numbers:
            values.append(self.column(number[None], quantity)[0])
            yield None
        for _ in range(FINER):
            middles = (numbers[:-1] + numbers[1:]) / 2
            change = np.abs(np.diff(values)) * (np.diff(numbers) > 0.01 * middles)
            k = int(np.argmax(np.nan_to_num(change)))
            numbers = np.insert(numbers, k + 1, middles[k])
            values.insert(k + 1, self.column(middles[k : k + 1], quantity)[0])
            yield None
        return numbers, np.array(values)

    def limiting(self, numbers):
        """Return results of the limiting cases of the drive, by their names."""
        state, found = self.at(numbers[:, None]), {}
        for name, given in DRIVES[state.drive].limiting_cases(state).items():
            result = getattr(mdr, self.solver)(profile(state), medium(state), **given)
            values = attrgetter(self.against)(result)
            found[name] = np.broadcast_to(values, (len(numbers), 1))[:, 0]
        return found

    @property
    def yields(self):
        """Whether the medium yields at the present value."""
        return self.column(np.array([self.present]), "plastic_work")[0] > 0

    @property
    def dry(self):
        return not self.in_time and self.state.adhesion == "none"

    def fast(self, numbers):
        """Return the fast limit of dry impacts on a virgin medium of class (b), otherwise nothing."""
        virgin = self.solver == "impact" and self.dry and not self.state.plastic_depth
        if virgin and self.against in _LIMITS and self.state.plasticity in ("q_c", "hardness"):
            return {FAST: self.column(numbers, _LIMITS[self.against])}
        return {}

    def classes(self):
        """Yield rows of the other classes of hardness, and their sweeps through the present value."""
        own = yield_constant(self.state)
        others = {row: pair for row, pair in CLASSES.items() if pair[1] not in own}
        constant = self.swept in numbers_of(self.state, "plasticity")
        # Under a given force each constant would need a separate search.
        if constant or not self.dry or not self.yields or self.solver == "indent_to_force":
            return
        for row, pair in others.items():
            if each := self._through(*pair):
                yield row, each

    def _through(self, option, constant):
        """Return the sweep of another class with the constant that gives the present result, or None.

        The search is around the constant of the same hardness at the largest contact radius. The constant
        has five digits, as in a field.
        """
        at = np.array([self.present])
        wanted, a = (float(self.column(at, quantity)[0]) for quantity in (self.against, "contact_radius"))
        same = float(medium(self.at(self.present)).hardness_at(a)) * a ** (CONSTANTS.index(constant))
        other = replace(self, state=self.state.replace(plasticity=option), swept=constant)
        found = crossing(lambda values: other.column(values, self.against) - wanted, same / 40, same * 30)
        if found is None:
            return None
        return replace(other, state=other.state.replace(**{constant: shown(found)}), swept=self.swept)


_DATA = read_data(Path(__file__).with_suffix(".json"))
_RESULTS = _DATA["results"]
#: The energy of an impact; the speed varies with it.
_ENERGY = quantity(**_DATA["energy"])

#: Dashes of the lines other than the line of the scene.
_DASHES = "dashed", "dotted", "dashed", "dotdash", "dashed", "dotted"
LINES = dict(zip((FAST, *CLASSES, *LIMITING), _DASHES, strict=True))
#: Words on the lines.
_WORDS = dict(
    zip(LINES, ("fast limit", "class (a)", "class (b)", "class (c)", "no edges", "support"), strict=True)
)
#: Share of the largest value below which a ratio, such as the restitution, is nearly 0.
_NOTHING = 1e-3
#: Shapes with closed forms.
_SHAPES = ("cone", "paraboloid", "power_law")


def known(name: str):
    """Return a quantity that can be swept."""
    return _ENERGY if name == "energy" else QUANTITIES[name]


for _name in ("energy", *QUANTITIES):
    _label = unicode_subscripts(f"{known(_name).symbol}, {known(_name).label}")
    CHOICES["sweep.swept"].options[_name] = Option(_label)


def swept(state: State) -> list[str]:
    """Return the names of the quantities that can be swept, with the default first."""
    if state.drive not in SOLVERS:
        names = CHOICES["sweep.swept"].options
        return [each for each in names if each == "energy" or state[each] is not None]
    own, impact = numbers_of(state, "drive"), state.drive == "impact"
    idle = ("density",) if impact else ("density", "eta")
    works = [each for each in used(state) if each not in idle and QUANTITIES[each].span >= 0]
    return ["energy"] * impact + sorted(works, key=lambda each: each not in own)


def against(state: State) -> list[str]:
    """Return the names of the results that can be plotted."""
    return _RESULTS.get(state.drive) or list(CHOICES["sweep.against"].options)


def _value(state: State, name: str) -> float:
    return state.mass * state.speed**2 / 2 if name == "energy" else state[name]


def asked(state: State) -> Sweep:
    """Return the sweep of a state over the range of a slider around the value of the preset."""
    name = option(state, "sweep.swept")
    value, middle = (_value(each, name) for each in (state, state.replace(**PRESETS[state.preset].values)))
    low, _, high = slider_range(known(name), middle, value)
    chosen = option(state, "sweep.against"), state["sweep.scale"] == "log", SOLVERS.get(state.drive, "")
    return Sweep(state.scene_values, name, value, low, high, *chosen)


def quick(sweep: Sweep) -> bool:
    """Whether the sweep is fast enough for every move: the shape has a closed form."""
    one_by_one = sweep.solver == "indent_to_force" and sweep.swept != "max_force"
    return not (one_by_one or sweep.in_time) and sweep.state.shape in _SHAPES


def found(course, sweep: Sweep) -> Iterator[SearchResult | None]:
    """Yield the curve of the sweep, the present value and limiting cases, after a step for each line."""
    if not sweep.solver:
        yield SearchResult({}, [], "This drive has no sweep: press to a depth or a force, or drop a body.")
        return
    result = course.turning_point if course.hit is None else course.hit
    numbers, present = sweep.numbers, getattr(result, sweep.against)
    if sweep.by_modes:
        numbers, values = yield from sweep.one_by_one(numbers, sweep.against)
    else:
        values = sweep.column(numbers, sweep.against)
    yield None
    inside = sweep.low <= sweep.present <= sweep.high
    columns, classes = {"this scene": values} | sweep.fast(numbers) | sweep.limiting(numbers), {}
    for row, each in sweep.classes() if inside else ():
        yield None
        classes[row], columns[row] = each, each.column(numbers, each.against)
        yield None
    rows = {name: (numbers, column) for name, column in columns.items()}
    x, y = _axes(sweep, values, float(present))
    if y.log:
        rows = {name: (numbers, np.where(row > 0, row, np.nan)) for name, (_, row) in rows.items()}
    visible = inside and (present > 0 or not y.log)
    rows["present value"] = (np.array([sweep.present]), np.array([present])) if visible else NOTHING
    rows |= words_along(rows, [x, y], {"this scene": "this scene"} | _WORDS)
    yield SearchResult(rows, [x, y], Markup(" ").join(_notes(sweep, numbers, values, classes, inside)))


def _axes(sweep, values, present):
    """Return both axes: logarithmic to show powers, or linear; also linear for a ratio that nears 0."""
    quantity, result = known(sweep.swept), RESULTS[sweep.against]
    log = sweep.logarithmic and sweep.low > 0
    # A logarithmic axis has the unit of the present value: J for 2.75 J, not kJ as at its end.
    fits = min(sweep.present, sweep.high) if log else sweep.high
    x = axis(unicode_subscripts(f"{quantity.symbol}, {quantity.label}"), quantity.kind, fits)
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
    """Return the power law at the present value from the log–log slope; empty if the result is 0."""
    pair = sweep.present * np.array([0.999, 1.001])
    ends = sweep.column(pair, sweep.against)
    if not (ends > 0).all():
        return ""
    slope = round(float(np.log(ends[1] / ends[0]) / np.log(pair[1] / pair[0])), 6)
    return Markup("{}<sup>{}</sup>").format(html_subscripts(known(sweep.swept).symbol), digits(slope, 3))


def _class_note(row, sweep):
    """Describe a sweep of another class by class, constant and power law."""
    constant = QUANTITIES[CLASSES[row][1]]
    value = in_full(sweep.state[constant.name], constant.kind)
    parts = [
        html_subscripts(f"{row.split()[0]} {constant.symbol} = {value}"),
        sweep.low > 0 and _power(sweep),
    ]
    return Markup(", ").join(part for part in parts if part)


def _notes(sweep, numbers, values, classes, inside):
    quantity = known(sweep.swept)
    if not inside:
        shown = in_full(sweep.present, quantity.kind)
        value = html_subscripts(f"{quantity.symbol} = {shown}")
        yield Markup("The present value, {}, is outside the range.").format(value)
    elif sweep.low > 0 and not sweep.by_modes and (power := _power(sweep)):
        result = html_subscripts(RESULTS[sweep.against].symbol)
        yield Markup("At the present value {} ∝ {}.").format(result, power)
    if classes:
        parts = [_class_note(row, each) for row, each in classes.items()]
        yield Markup("Through the same point: {}.").format(Markup("; ").join(parts))
    elif inside and not sweep.yields:
        yield "Nothing yields at the present value."
    refused = numbers[np.isnan(values)]
    if refused.size:
        try:
            sweep.solve(float(refused[0]))
        except ValueError as error:
            yield html_subscripts(f"Not all of the range can be solved: {error_text(error)}.")


@dataclass(frozen=True, eq=False)
class SweepPlot(AsyncPlot):
    """The plot *Sweep*; its options depend on the drive."""

    def options_of(self, state, control):
        offered = {"sweep.swept": swept, "sweep.against": against}
        return offered[control](state) if control in offered else super().options_of(state, control)


SWEEP = SweepPlot(
    "sweep", "Sweep", "one parameter varied, all others fixed  § 10, § 20", (),
    (
        *(line(name, "ink", 1.4, dash, OF_AXIS) for name, dash in LINES.items()),
        line("this scene", "elastic", 2.4, symbol=OF_AXIS),
        mark("present value", legend=False),
        word("this scene", "elastic-text", "center", "bottom", 0.7, ("this scene",)),
        *(word(name, "ink", "center", "bottom", 0.7, (name,)) for name in LINES),
    ),
    find=found, asks=asked, quick=quick, tab="Sweep", order=90, picture=Logarithmic,
    controls=("sweep.swept", "sweep.against", "sweep.scale"),
)  # fmt: skip


def e_over_v(page: Any, plot: Plot, view: View) -> list[Part]:
    """Return the button above the force of an impact that plots the restitution over the speed."""
    if plot.name != "force" or view.state.drive != "impact":
        return []
    chosen = {"sweep.swept": "speed", "sweep.against": "restitution"}
    return [
        button("e over v", lambda: page.apply(lambda state: with_tile(state, "sweep").replace(**chosen)))
    ]


EXTRA = Extra(
    "sweep",
    plots=(SWEEP,),
    on_plots=e_over_v,
    service=IdleSearch,
)
