"""Numbers, choices and shapes; their texts and bounds are in assets/quantities.json."""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from math import log
from pathlib import Path

import mdr_core as mdr

ASSETS = Path(__file__).parents[2] / "assets"


@dataclass(frozen=True)
class Quantity:
    """A number that can be set.

    `kind` is a key of `units.UNITS`. `bounds` and `default` are in SI, but a length of a shape has its
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


def _power_law(height, width, exponent):
    return mdr.PowerLaw(coefficient=height / width**exponent, exponent=exponent)


#: Units, and the words and bounds of quantities, choices and shapes.
DATA = json.loads((ASSETS / "quantities.json").read_text(encoding="utf-8"), parse_int=float)


def _quantity(like="", **own):
    values = DATA["like"].get(like, {}) | own
    return Quantity(**values | {"bounds": tuple(values["bounds"])})


def _shape(key, label, height, reduced, quantities):
    build = _power_law if key == "power_law" else getattr(mdr, key.title().replace("_", ""))
    return Shape(label, height, reduced, tuple(_quantity(**each) for each in quantities), build)


_LOWERED = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")


def lowered(text):
    """Text with indices, as in v_0, as Unicode subscripts where they exist."""
    return re.sub("_([a-z0-9]+)", lambda index: index[1].translate(_LOWERED), text)


SHAPES = {key: _shape(key, **words) for key, words in DATA["shapes"].items()}
#: What each choice is called, its options as they are shown, the numbers that each of them uses, and
#: what it is.
LABELS, CHOICES, USED, ABOUT = {}, {}, {}, {}
for _name, _choice in DATA["choices"].items():
    LABELS[_name], ABOUT[_name] = _choice["label"], _choice["help"]
    CHOICES[_name] = {option: each["label"] for option, each in _choice["options"].items()}
    USED[_name] = {option: each["uses"] for option, each in _choice["options"].items()}
#: Choices of a drive (`form`), readouts above the plots (`line`) and results of sweeps, by the options of
#: the choice "drive".
OF_DRIVE = DATA["choices"]["drive"]["options"]


def shape_quantities(shape):
    """Names and quantities of the parameters of a shape."""
    return [(f"{shape}_{q.name}", q) for q in SHAPES[shape].quantities]


#: Every quantity by its name; those of the shapes are named as in "cone_slope".
QUANTITIES = {each["name"]: _quantity(**each) for each in DATA["numbers"]} | {
    name: quantity for shape in SHAPES for name, quantity in shape_quantities(shape)
}
#: What can be swept: every number, and the energy of an impact.
SWEPT = {"energy": _quantity(**DATA["energy"])} | QUANTITIES
CHOICES["shape"] = {key: shape.label for key, shape in SHAPES.items()}
CHOICES["swept"] = {name: lowered(f"{q.symbol}, {q.label}") for name, q in SWEPT.items()}


class Scale:
    """Steps of a slider and their values, logarithmic about a middle value where possible."""

    STEPS = 400

    def __init__(self, quantity: Quantity, middle: float):
        low, high = quantity.bounds
        self.logarithmic = quantity.span > 0 and middle > 0
        self.middle = middle
        if self.logarithmic:
            low, high = max(low, middle / quantity.span), min(high, middle * quantity.span)
        self.low, self.high = low, high

    @classmethod
    def about(cls, quantity: Quantity, middle: float, value: float) -> "Scale":
        """Scale about a middle value, or about another value that it does not reach."""
        scale = cls(quantity, middle)
        return scale if scale.reaches(value) else cls(quantity, value)

    def reaches(self, value: float) -> bool:
        return self.low <= value <= self.high

    def position(self, value: float) -> int:
        scaled = log if self.logarithmic else float
        low, high, at = map(scaled, (self.low, self.high, min(max(value, self.low), self.high)))
        return round(self.STEPS * (at - low) / (high - low))

    def value(self, position: float) -> float:
        share = min(max(position, 0), self.STEPS) / self.STEPS
        low, high = self.low, self.high
        value = low * (high / low) ** share if self.logarithmic else low + (high - low) * share
        return min(max(float(f"{value:.3g}"), low), high)
