"""Conversion between the text of a number field and values in SI."""

import re
from math import isclose, isfinite, radians, tan

from mdr_core.show.units import UNITS, Unit, digits, fitting, with_unit

#: Accepted units that the page shows only after the user has typed them.
_READ = {"length": (Unit("Å", 1e-10), Unit("um", 1e-6))}
#: Letters of units and their substitutes on keyboards.
_KEYBOARD = str.maketrans("µ·³²", "u*32")
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d{1,3})?)\s*(.*)", re.IGNORECASE | re.ASCII)
#: A comma before exactly three digits is a decimal comma, or separates thousands.
_TWO_READINGS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}(?!\d)", re.ASCII)


def entry(value: float, unit: Unit) -> str:
    """Format a value (SI) for a field: up to nine digits if exact, else five; `read` accepts the text."""
    if not isfinite(value):
        return digits(value)
    number = value / unit.factor
    exact = isclose(float(f"{number:.9g}"), number, rel_tol=1e-13)
    return with_unit(f"{number:{'.9g' if exact else '.5g'}}", unit.name)


def in_full(value: float, kind: str) -> str:
    """Format a value (SI) in the unit that fits it, with the digits of `entry`."""
    return entry(value, fitting(value, kind)) if isfinite(value) else digits(value)


def read(text: str, kind: str, shown: Unit) -> tuple[float, Unit]:
    """Return the value (SI) and the unit of typed text.

    Decimal commas, spaces between thousands, and half-angles for slopes are accepted.

    Parameters
    ----------
    text : str
        A number, with a unit or without.
    kind : str
        Kind of quantity, a key of `UNITS`.
    shown : Unit
        Unit of numbers without a unit.

    Raises
    ------
    ValueError
        If the text is not a number, or has two readings.

    Examples
    --------
    >>> from app.common.units import read
    >>> from mdr_core.show.units import Unit
    >>> read("12,5 um", "length", Unit("nm", 1e-9))
    (1.25e-05, Unit(name='µm', factor=1e-06))
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
    if match and kind == "slope" and match[2] == "°" and 0 < float(match[1]) < 90:
        return 1 / tan(radians(float(match[1]))), shown
    if match and kind == "slope" and match[2] == "°":
        raise ValueError("the half-angle must be above 0° and below 90°")
    if match is None or (match[2] and match[2] not in units):
        names = ", ".join(unit.name for unit in UNITS[kind] if unit.name) or "°" * (kind == "slope")
        raise ValueError(f"“{text:.40}” is not a number" + f" with one of the units {names}" * bool(names))
    factor = units[match[2]].factor if match[2] else shown.factor
    # 15 nm is 1.5e-08, not 1.5000000000000002e-08.
    value = float(f"{float(match[1]) * factor:.15g}")
    if not isfinite(value):
        raise ValueError(f"“{text}” is too large")
    typed = (unit for unit in known if match[2] and unit.factor == factor)
    return value, next(typed, shown)
