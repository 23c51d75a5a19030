"""Units of the page, and numbers as texts. The core knows SI only."""

import re
from dataclasses import dataclass
from math import floor, isclose, isfinite, log10, radians, tan

import numpy as np

from mdr_core._errors import InvalidArgument

from .quantities import DATA, QUANTITIES, lowered


@dataclass(frozen=True)
class Unit:
    """A unit and its size in SI."""

    name: str
    factor: float

    def fits(self, value: float) -> bool:
        """Whether a value (SI) is written in this unit without a power of ten."""
        return value == 0 or 1e-3 <= abs(value) / self.factor < 1e5


#: The units of each kind of quantity, smallest first; the first of factor 1 is the SI unit.
UNITS = {
    kind: tuple(Unit(name, float(factor)) for name, factor in units.items())
    for kind, units in DATA["units"].items()
}
#: Kinds by the names of their SI units, as the core has them: "N" is a force.
KINDS = {unit.name: kind for kind, units in reversed(UNITS.items()) for unit in units if unit.factor == 1}
KINDS |= {"": "number", "rad": "angle"}
#: Units that are read, and shown where they were typed.
_READ = {"length": (Unit("Å", 1e-10), Unit("um", 1e-6))}


def fitting(value: float, kind: str, like: float = 0.0) -> Unit:
    """Unit in which a value (SI) has one to three digits before the point; areas up to four.

    Zero has the unit of the value `like`.
    """
    units = UNITS[kind]
    size = abs(value) if isfinite(value) and value else abs(like)
    if size == 0:
        return next((unit for unit in units if unit.factor == 1), units[0])
    # A value a rounding error below the next unit is written in that unit: 1 mm, not 1000 µm.
    pairs = zip(units[:0:-1], units[-2::-1], strict=True)
    fits = (unit for unit, below in pairs if min(unit.factor, 1e4 * below.factor) <= size * (1 + 1e-9))
    return next(fits, units[0])


def digits(value: float, count: int = 4) -> str:
    """A number with significant digits, very large and small ones as a × 10ⁿ."""
    if not isfinite(value):
        return "∞" if value > 0 else "–"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        value = float(f"{value:.{count - 1}e}")
        return f"{value:.{max(count - 1 - floor(log10(abs(value))), 0)}f}".replace("-", "−")
    mantissa, exponent = f"{value:.{count - 1}e}".split("e")
    power = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa} × 10{power}".replace("-", "−")


def written(value: float, kind: str, count: int = 4) -> str:
    """A value (SI) as text with its unit."""
    if value == 0 or not isfinite(value):
        return digits(value)
    unit = fitting(value, kind)
    return f"{digits(value / unit.factor, count)} {unit.name}".strip()


def entry(value: float, unit: Unit) -> str:
    """A value (SI) as text for a field, readable by `read`: all digits up to nine, else five."""
    if not isfinite(value):
        return digits(value)
    number = value / unit.factor
    exact = isclose(float(f"{number:.9g}"), number, rel_tol=1e-13)
    return f"{number:{'.9g' if exact else '.5g'}} {unit.name}".strip()


def in_full(value: float, kind: str) -> str:
    """A value (SI) in the unit that fits it, with all digits as in `entry`."""
    return entry(value, fitting(value, kind)) if isfinite(value) else digits(value)


def with_symbol(name: str, value: float) -> str:
    """A number of the page with its symbol, in full."""
    return f"{QUANTITIES[name].symbol} = {in_full(value, QUANTITIES[name].kind)}"


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


#: Letters of units, with those that keyboards have for them.
_KEYBOARD = str.maketrans("µ·³²", "u*32")
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(e[+-]?\d{1,3})?)\s*(.*)", re.IGNORECASE | re.ASCII)


#: A comma before exactly three digits is a decimal comma, or separates thousands.
_TWO_READINGS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}(?!\d)", re.ASCII)


def read(text: str, kind: str, shown: Unit) -> tuple[float, Unit]:
    """Value (SI) of typed text, and its unit; ValueError if it is no number.

    Bare numbers are in the displayed unit, with an exponent in SI; decimal commas, spaces between
    thousands, and half-angles for slopes are accepted.
    """
    plain = text.strip().replace("−", "-").replace("μ", "µ")
    plain = re.sub(r"(?<=\d)\s(?=\d{3}(?!\d))", "", plain)
    if plain.count(",") == 1 and "." not in plain:
        whole, part = plain.replace(",", ""), plain.replace(",", ".")
        if _TWO_READINGS.match(plain):
            raise ValueError(f"“{text:.40}” can be {whole:.40} or {part:.40}: type one of these")
        plain = part
    match = _NUMBER.fullmatch(plain) if len(plain) <= 40 else None
    known = (*UNITS[kind], *_READ.get(kind, ()))
    units = {name: unit for unit in known for name in (unit.name, unit.name.translate(_KEYBOARD))}
    if match and kind == "slope" and match[3] == "°" and 0 < float(match[1]) < 90:
        return 1 / tan(radians(float(match[1]))), shown
    if match and kind == "slope" and match[3] == "°":
        raise ValueError("the half-angle is above 0° and below 90°")
    if match is None or (match[3] and match[3] not in units):
        names = ", ".join(unit.name for unit in UNITS[kind] if unit.name) or "°" * (kind == "slope")
        raise ValueError(f"“{text:.40}” is not a number" + f" with one of the units {names}" * bool(names))
    factor = units[match[3]].factor if match[3] else 1.0 if match[2] else shown.factor
    # 15 nm as 1.5e-08, not as 1.5000000000000002e-08.
    value = float(f"{float(match[1]) * factor:.15g}")
    if not isfinite(value):
        raise ValueError(f"“{text}” is too large")
    typed = (unit for unit in known if match[3] and unit.factor == factor)
    return value, next(typed, shown)


_ROUND = np.array([1, 1.5, 2, 3, 4, 5, 6, 8, 10])


def round_up(value: float) -> float:
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 × 10ⁿ, so that axes rest while a slider moves."""
    if not value > 0 or not isfinite(value):
        return 1.0
    power = 10.0 ** floor(log10(value))
    return float(_ROUND[np.searchsorted(_ROUND, value / power * (1 - 1e-9))] * power)
