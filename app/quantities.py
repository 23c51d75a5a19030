"""Numbers, choices and shapes, with their texts and bounds: assets/quantities.json and those of extras."""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mdr_core as mdr
from mdr_core._errors import InvalidArgument
from mdr_core.results.quantities import QUANTITIES as RESULTS
from mdr_core.results.quantities import Quantity as Described
from mdr_core.results.units import KINDS, written

ASSETS = Path(__file__).parents[1] / "assets"


@dataclass(frozen=True)
class Quantity:
    """A number that can be set.

    `kind` is that of its units. `bounds` and `default` are in SI, but a length of a shape has its
    `default` in contact radii. The slider covers a factor `span` each way; 0: linear between bounds; below
    0: no slider.
    """

    name: str
    symbol: str
    label: str
    kind: str
    bounds: tuple[float, float]
    default: float
    span: float
    help: str
    equation: str
    typical: str = ""

    def bounded(self, value):
        return min(max(value, self.bounds[0]), self.bounds[1])


@dataclass(frozen=True)
class Shape:
    """A shape: its name, formulas, parameters and constructor."""

    label: str
    height: str
    reduced: str
    quantities: tuple[Quantity, ...]
    build: Callable[..., mdr.Profile]


@dataclass(frozen=True)
class Readout:
    """A readout: its name in the table of quantities of the core, and its attribute `of` a course.

    `own` is its symbol, unit and name if the core has none.
    """

    name: str
    of: str
    help: str
    equation: str = ""
    own: tuple[str, str, str] | None = None

    @property
    def known(self) -> Described:
        return Described(*self.own) if self.own else RESULTS[self.name]

    def values(self, course: Any) -> Any:
        for name in self.of.split("."):
            course = getattr(course, name, None)
        return course


def _power_law(height, width, exponent):
    return mdr.PowerLaw(coefficient=height / width**exponent, exponent=exponent)


def read_data(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8"), parse_int=float)


#: The words and bounds of quantities, choices and shapes.
DATA = read_data(ASSETS / "quantities.json")


def quantity(like="", **own):
    values = DATA["like"].get(like, {}) | own
    return Quantity(**values | {"bounds": tuple(values["bounds"])})


def _shape(key, label, height, reduced, quantities):
    build = _power_law if key == "power_law" else getattr(mdr, key.title().replace("_", ""))
    return Shape(label, height, reduced, tuple(quantity(**each) for each in quantities), build)


_LOWERED = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")


def lowered(text):
    """Text with indices, as in v_0, as Unicode subscripts where they exist."""
    return re.sub("_([a-z0-9]+)", lambda index: index[1].translate(_LOWERED), text)


SHAPES = {key: _shape(key, **words) for key, words in DATA["shapes"].items()}


def shape_quantities(shape):
    """Names and quantities of the parameters of a shape."""
    return [(f"{shape}_{q.name}", q) for q in SHAPES[shape].quantities]


#: Every quantity by its name; those of the shapes are named as in "cone_slope".
QUANTITIES: dict[str, Quantity] = {}
#: What each choice is called, its options as they are shown, the numbers that each of them uses, and
#: what it is.
LABELS: dict[str, str] = {}
CHOICES: dict[str, dict[str, str]] = {}
USED: dict[str, dict[str, list[str]]] = {}
ABOUT: dict[str, str] = {}
#: Choices of a drive (`form`) and readouts above the plots (`line`), by the options of the choice "drive".
OF_DRIVE: dict[str, dict[str, Any]] = {}
#: Every number that can be read, in the order in which all of them are listed.
READOUTS: list[Readout] = []


def include(data: dict[str, Any]) -> None:
    """Add the numbers, choices, drives and readouts of the page, or those of an extra."""
    QUANTITIES.update({each["name"]: quantity(**each) for each in data.get("numbers", ())})
    for row in data.get("readouts", ()):
        READOUTS.append(Readout(**row | {"own": tuple(row["own"])} if "own" in row else row))
    for name, choice in data.get("choices", {}).items():
        LABELS[name] = choice["label"]
        ABOUT[name] = choice["help"]
        CHOICES[name] = {}
        USED[name] = {}
        _add_options(name, choice["options"])
    drives = data.get("drives", {})
    _add_options("drive", drives)
    OF_DRIVE.update(drives)
    for name, text in data.get("help", {}).items():
        ABOUT[name] = f"{ABOUT[name]} {text}"


def _add_options(name: str, options: dict[str, Any]) -> None:
    for option, words in options.items():
        CHOICES[name][option] = words["label"]
        USED[name][option] = words.get("uses", [])


include(DATA)
OF_DRIVE.update(DATA["choices"]["drive"]["options"])
CHOICES["shape"] = {key: shape.label for key, shape in SHAPES.items()}
QUANTITIES.update(pair for shape in SHAPES for pair in shape_quantities(shape))


def in_words(error: ValueError) -> str:
    """Message of an error of the core: of a refused number its symbol, value with unit, bound and remedy.

    All other messages are as they stand.
    """
    if not isinstance(error, InvalidArgument) or not isinstance(error.value, int | float):
        return str(error)
    known = QUANTITIES.get(error.argument)
    name = f"{lowered(known.symbol)}, {known.label}," if known else error.quantity
    value = written(float(error.value), KINDS.get(error.unit, "number"))
    remedy = f"; {error.remedy}" if error.remedy and "SI units" not in error.remedy else ""
    return f"{name} = {value} {error.bound}{remedy}"
