"""Numbers, choices and readouts with their texts: assets/quantities.json, and those of extras."""

import json
import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mdr_core.show.quantities import QUANTITIES as RESULTS

ASSETS = Path(__file__).parents[2] / "assets"


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
class Option:
    """An option of a choice, and the numbers of the form that it needs.

    Shapes have formulas of their `height` and `reduced` profile. Drives have choices of their own (`form`),
    readouts above the plots (`line`), and words for where dashpots act (`in_time`). Options of a choice in
    a form may have choices, too, and numbers that fold (`fold`).
    """

    label: str
    uses: list[str] = field(default_factory=list)
    order: float = 0.0
    height: str = ""
    reduced: str = ""
    form: list[str] = field(default_factory=list)
    fold: list[str] = field(default_factory=list)
    line: list[str] = field(default_factory=list)
    in_time: str = ""


@dataclass(frozen=True)
class Choice:
    """A choice, and its options by their keys."""

    label: str = ""
    help: str = ""
    options: dict[str, Option] = field(default_factory=dict)


@dataclass(frozen=True)
class Readout:
    """A readout: an attribute `of` a course, with its symbol, unit and long name.

    `short` is its name above the plots, in one line, where that is not the long one.
    """

    name: str
    of: str
    symbol: str
    unit: str
    long_name: str
    help: str
    equation: str = ""
    short: str = ""

    def values(self, course: Any) -> Any:
        for name in self.of.split("."):
            course = getattr(course, name, None)
        return course


#: By their names; numbers of a shape begin with its own, as "cone_slope".
QUANTITIES: dict[str, Quantity] = {}
CHOICES: dict[str, Choice] = {}
#: Every number that can be read, in the order in which all of them are listed.
READOUTS: list[Readout] = []


def read_data(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8"), parse_int=float)


_DATA = read_data(ASSETS / "quantities.json")


def quantity(like: str = "", **own: Any) -> Quantity:
    """A number with its own words, and those of the numbers that are like it."""
    words = _DATA["like"].get(like, {}) | own
    return Quantity(**words | {"bounds": tuple(words["bounds"])})


def include(data: dict[str, Any]) -> None:
    """Add the numbers, readouts and choices of the page, or those of an extra.

    Choices that are there get further options and a longer help, options that are there further numbers,
    choices and readouts. Readouts that the core has, too, have its symbol, unit and long name.
    """
    QUANTITIES.update({each["name"]: quantity(**each) for each in data.get("numbers", ())})
    for words in data.get("readouts", ()):
        result = RESULTS.get(words["name"])
        READOUTS.append(Readout(**(vars(result) if result else {}) | words))
    for name, words in data.get("choices", {}).items():
        known = CHOICES.get(name, Choice())
        given = words.get("options", {}).items()
        added = {key: _option(known.options.get(key), each) for key, each in given}
        options = sorted((known.options | added).items(), key=lambda each: each[1].order)
        help_ = f"{known.help} {words.get('help', '')}".strip()
        CHOICES[name] = Choice(known.label or words["label"], help_, dict(options))


def _option(known: Option | None, words: dict[str, Any]) -> Option:
    """A new option, or one that is there with longer lists."""
    if known is None:
        return Option(**words)
    return replace(known, **{name: [*getattr(known, name), *more] for name, more in words.items()})


include(_DATA)

_LOWERED = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")


def unicode_subscripts(text):
    """Text with indices, as in v_0, as Unicode subscripts where they exist."""
    return re.sub("_([a-z0-9]+)", lambda index: index[1].translate(_LOWERED), text)
