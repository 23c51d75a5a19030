"""The plot *Sweep*: results over a range of one number, with the limit of fast impacts."""

from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import mdr_core as mdr
from mdr_core.results.figures import NOTHING, line, mark
from mdr_core.results.quantities import QUANTITIES as RESULTS

from ..changes import option
from ..extra import Extra
from ..plot import axis
from ..quantities import CHOICES, QUANTITIES, Scale, lowered, quantity, read_data
from ..refused import in_words
from ..shared.rest import Found, Resting, Searched
from ..state import PRESETS, State, medium, profile, used
from ..ui import marked
from ..units import KINDS, digits, in_full

_DATA = read_data(Path(__file__).with_suffix(".json"))
#: Functions of the core and their arguments, by drives, and the results of each.
SOLVERS = {
    "depth": ("indent", "max_depth"),
    "force": ("indent_to_force", "max_force"),
    "impact": ("impact", "mass", "speed"),
}
_RESULTS = _DATA["results"]
#: The energy of an impact, which is swept by the speed.
_ENERGY = quantity(**_DATA["energy"])

#: Points along the range, and of a viscous impact, which takes a millisecond each.
POINTS, VISCOUS = 81, 31
#: Rows of the fast limit, which is that of class (b), and of the other classes, with their dashes.
FAST = "fast limit (23) (24), class (b)"
CLASSES = {"a": "scaling of class (a), hardness constant", "c": "scaling of class (c), hardness ∝ 1/a²"}
LINES = {FAST: "dashed", CLASSES["a"]: "dotted", CLASSES["c"]: "dotdash"}
#: What the fast limit has: its quantity, and the power of the energy that a `ScalingLaw` has for it.
_LIMITS = {
    "damaged_area": ("fast_limit.contact_area", lambda law: law.area),
    "max_depth": ("fast_limit.max_depth", lambda law: law.depth),
    "restitution": ("fast_limit.restitution", lambda law: law.restitution / 2),
}
_SHAPES = {"cone": 1.0, "paraboloid": 2.0}


@dataclass(frozen=True)
class Sweep:
    """A sweep: fixed values, the swept number with its range, and the result."""

    values: dict
    swept: str
    present: float
    low: float
    high: float
    against: str
    #: Function of the core and its arguments.
    solver: tuple

    @property
    def viscous(self):
        return self.values["damping"] != "none" and "speed" in self.solver

    @property
    def numbers(self):
        space = np.geomspace if self.low > 0 else np.linspace
        return space(self.low, self.high, VISCOUS if self.viscous else POINTS)

    def solve(self, numbers):
        """Results of the core for values of the swept number."""
        values = self.values | {self.swept: numbers}
        if self.swept == "energy":
            values["speed"] = (2 * numbers / values["mass"]) ** 0.5
        solver, *names = self.solver
        given = {name.replace("max_", ""): values[name] for name in names}
        if solver == "impact":
            given["plastic_depth"] = values["plastic_depth"]
        state = SimpleNamespace(**values)
        return getattr(mdr, solver)(profile(state), medium(state), **given)

    def column(self, numbers, quantity):
        """A result at values of the swept number; NaN where the core refuses."""
        try:
            result = self.solve(numbers[:, None] if len(numbers) > 1 else float(numbers[0]))
            return np.broadcast_to(attrgetter(quantity)(result), (len(numbers), 1))[:, 0]
        except ValueError:
            if len(numbers) == 1:
                return np.full(1, np.nan)
            return np.hstack([self.column(half, quantity) for half in np.array_split(numbers, 2)])

    def limits(self, numbers):
        """Curves of the fast limit and of the classes of hardness, and their powers of the energy."""
        values, (limit, power) = self.values, _LIMITS.get(self.against, ("", None))
        dry = not self.viscous and not values["plastic_depth"] and values["adhesion"] == "none"
        if not (limit and dry and "speed" in self.solver and values["plasticity"] in ("q_c", "hardness")):
            return {}, {}
        rows = {FAST: self.column(numbers, limit)}
        exponent = (_SHAPES | {"power_law": values["power_law_exponent"]}).get(values["shape"])
        if exponent is None or self.swept not in ("energy", "mass", "speed"):
            return rows, {}
        powers = {name: power(mdr.ScalingLaw(name, exponent)) for name in "abc"}
        # All through the limit at the present energy.
        present = self.column(np.array([self.present]), limit)
        energy = (numbers / self.present) ** (2 if self.swept == "speed" else 1)
        return rows | {CLASSES[name]: present * energy ** powers[name] for name in CLASSES}, powers


def known(name: str):
    """A quantity that can be swept."""
    return _ENERGY if name == "energy" else QUANTITIES[name]


CHOICES["sweep.swept"].update(
    {name: lowered(f"{known(name).symbol}, {known(name).label}") for name in ("energy", *QUANTITIES)}
)


def swept(state: State) -> list[str]:
    """What can be swept, the first one if nothing is chosen."""
    if state.drive not in SOLVERS:
        return list(CHOICES["sweep.swept"])
    solver, impact = SOLVERS[state.drive], state.drive == "impact"
    idle = "density" if impact else "eta"
    works = [each for each in used(state) if each != idle and QUANTITIES[each].span >= 0]
    return ["energy"] * impact + sorted(works, key=lambda each: each not in solver)


def against(state: State) -> list[str]:
    """Results that can be drawn."""
    return _RESULTS.get(state.drive) or list(CHOICES["sweep.against"])


def asked(state: State) -> Sweep:
    """The sweep of a state, over the range of a slider about the value of the preset."""
    name = option(state, "sweep.swept")
    states = state, state.replace(**PRESETS[state.preset].values)
    values, preset = ({**each.scene_values, "energy": each.mass * each.speed**2 / 2} for each in states)
    scale = Scale.about(known(name), preset[name], values[name])
    chosen = option(state, "sweep.against"), SOLVERS.get(state.drive, ())
    return Sweep(state.scene_values, name, values[name], scale.low, scale.high, *chosen)


def quick(sweep: Sweep) -> bool:
    """Whether the sweep is fast enough for every move: shapes with closed forms."""
    one_by_one = sweep.solver[:1] == ("indent_to_force",) and sweep.swept != "max_force"
    return not (one_by_one or sweep.viscous) and sweep.values["shape"] in (*_SHAPES, "power_law")


def found(course, sweep: Sweep):
    """Curve of the sweep with the present value and limits."""
    if not sweep.solver:
        return Found({}, [], "Nothing is swept: press to a depth or a force, or let a body hit.")
    numbers, present = sweep.numbers, getattr(getattr(course, "hit", course.turning_point), sweep.against)
    values = sweep.column(numbers, sweep.against)
    limits, powers = sweep.limits(numbers)
    inside = sweep.low <= sweep.present <= sweep.high
    rows = {"this scene": (numbers, values)} | {name: (numbers, row) for name, row in limits.items()}
    x, y = _axes(sweep, values, float(present))
    if y.log:
        rows = {name: (numbers, np.where(row > 0, row, np.nan)) for name, (_, row) in rows.items()}
    visible = inside and (present > 0 or not y.log)
    rows["present value"] = (np.array([sweep.present]), np.array([present])) if visible else NOTHING
    return Found(rows, [x, y], " ".join(_notes(sweep, numbers, values, powers, inside)))


def _axes(sweep, values, present):
    """Both logarithmic, to show powers; a ratio, and numbers that may be negative, on a linear one."""
    quantity, result = known(sweep.swept), RESULTS[sweep.against]
    x = axis("swept", lowered(f"{quantity.symbol}, {quantity.label}"), quantity.kind, sweep.high)
    x = replace(x, start=sweep.low, end=sweep.high, log=sweep.low > 0)
    sizes = np.append(values, present)
    sizes = sizes[np.isfinite(sizes)]
    title = lowered(f"{result.symbol}, {result.long_name}")
    y = axis("against", title, KINDS[result.unit], max(sizes, default=1.0))
    if not (result.unit and x.log and (sizes > 0).any()):
        return x, y
    # At most six decades, between powers of ten.
    least, most = max(min(sizes[sizes > 0]), 1e-6 * max(sizes)), max(sizes)
    low, high = 10.0 ** np.floor(np.log10(least / y.factor)), 10.0 ** np.ceil(np.log10(most / y.factor))
    return x, replace(y, start=low * y.factor, end=max(high, 10 * low) * y.factor, log=True)


def _notes(sweep, numbers, values, powers, inside):
    quantity, symbol = known(sweep.swept), RESULTS[sweep.against].symbol
    if not inside:
        shown = in_full(sweep.present, quantity.kind)
        yield f"The present value, {marked(f'{quantity.symbol} = {shown}')}, is outside of the range."
    elif sweep.low > 0:
        pair = sweep.present * np.array([0.999, 1.001])
        ends = sweep.column(pair, sweep.against)
        if (ends > 0).all():
            slope = round(float(np.log(ends[1] / ends[0]) / np.log(pair[1] / pair[0])), 6)
            power = f"<sup>{digits(slope, 3)}</sup>."
            yield marked(f"At the present value {symbol} goes as {quantity.symbol}") + power
    if powers:
        texts = ", ".join(f"W<sup>{digits(power, 3)}</sup> ({name})" for name, power in powers.items())
        yield f"In the fast limit it goes with the energy as {texts}: hardness constant, ∝ 1/a, ∝ 1/a²."
        yield "Lines of (a) and (c) are these powers, drawn through the fast limit at the present value."
    refused = numbers[np.isnan(values)]
    if refused.size:
        try:
            sweep.solve(float(refused[0]))
        except ValueError as error:
            yield marked(f"Not all of the range can be solved: {in_words(error)}.")


SWEEP = Searched(
    "sweep", "Sweep", "one number over a range, all others as they are  § 10", (),
    (
        *(line(name, "ink", 1.4, dash, "y") for name, dash in LINES.items()),
        line("this scene", "elastic", 2.4, symbol="y"),
        mark("present value"),
    ),
    find=found, asks=asked, quick=quick, tab="Sweep", order=90, controls=("sweep.swept", "sweep.against"),
)  # fmt: skip


EXTRA = Extra(
    "sweep",
    former={"swept": "sweep.swept", "against": "sweep.against"},
    offers={"sweep.swept": swept, "sweep.against": against},
    plots=(SWEEP,),
    service=Resting,
)
