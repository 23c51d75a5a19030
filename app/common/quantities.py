"""Numbers, choices and readouts with their texts, from assets/quantities.json and from extras."""

import json
import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mdr_core.show.quantities import QUANTITIES as RESULTS

ASSETS = Path(__file__).parents[2] / "assets"


@dataclass(frozen=True)
class Quantity:
    """Number that the user can set.

    `kind` is the kind of its units. `bounds` and `default` are in SI, but the `default` of a shape's length
    is in contact radii. The slider covers a factor `span` in each direction. It is linear between the
    bounds if `span` is 0, and absent if `span` is negative.
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
    """Option of a choice, and the numbers that it needs in the form.

    Shapes have formulas of their `height` and `reduced` profile. Drives have separate choices (`form`),
    readouts above the plots (`line`), and words for the place in which dashpots act (`in_time`). Options of
    a choice in a form may also have choices, and numbers in a fold (`fold`).
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
    """Choice, and its options by their keys."""

    label: str = ""
    help: str = ""
    options: dict[str, Option] = field(default_factory=dict)


@dataclass(frozen=True)
class Readout:
    """Readout: an attribute `of` a course, with its symbol, unit and long name.

    `short` is its name in the line above the plots, if this differs from the long name.
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


#: Numbers by their names; the name of a shape's number begins with the shape, for example "cone_slope".
QUANTITIES: dict[str, Quantity] = {}
CHOICES: dict[str, Choice] = {}
#: All readouts, in the order of their list on the page.
READOUTS: list[Readout] = []


def read_data(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8"), parse_int=float)


_DATA = read_data(ASSETS / "quantities.json")


def quantity(like: str = "", **own: Any) -> Quantity:
    """Return a number from its words and from the shared words `like`."""
    words = _DATA["like"].get(like, {}) | own
    return Quantity(**words | {"bounds": tuple(words["bounds"])})


def include(data: dict[str, Any]) -> None:
    """Add the numbers, readouts and choices of the page, or those of an extra.

    Existing choices get further options and a longer help. Existing options get further numbers, choices
    and readouts. A readout that is also a result of the core has the core's symbol, unit and long name.
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
    """Return a new option, or the known option with longer lists."""
    if known is None:
        return Option(**words)
    return replace(known, **{name: [*getattr(known, name), *more] for name, more in words.items()})


include(_DATA)

_LOWERED = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")


def unicode_subscripts(text):
    """Replace indices, such as in v_0, by Unicode subscripts if they exist."""
    return re.sub("_([a-z0-9]+)", lambda index: index[1].translate(_LOWERED), text)
