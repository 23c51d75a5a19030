"""Plain units of columns: symbols and English words, without scaling factors."""

import unicodedata
from functools import lru_cache

from ...show.units import UNITS
from ...solver.profiles.samples import LENGTHS


def _sizes(kind, *names):
    """Return the sizes (SI) of units of a kind by name."""
    known = {unit.name: unit.factor for unit in UNITS[kind]}
    return {name: known[name] for name in names}


#: Sizes (SI) of the units that a column of a file may have, by kind.
COLUMN_UNITS = {
    "length": LENGTHS | {"in": 0.0254},
    "force": _sizes("force", "kN", "N", "mN", "µN", "nN", "pN", "MN")
    | {"g": 9.80665e-3, "gf": 9.80665e-3, "kgf": 9.80665, "lb": 4.4482216, "lbf": 4.4482216},
    "time": {"min": 60.0} | _sizes("time", "s", "ms", "µs") | {"h": 3600.0},
    "voltage": {"V": 1.0, "mV": 1e-3},
    "stiffness": {
        "mN/m": 1e-3, "N/m": 1.0, "µN/nm": 1e3, "mN/µm": 1e3, "N/mm": 1e3, "mN/nm": 1e6, "N/µm": 1e6,
        "N/nm": 1e9,
    },
    "sensitivity": {"nm/V": 1e-9, "µm/V": 1e-6, "nm/mV": 1e-6, "m/V": 1.0, "m/A": 1.0},
}  # fmt: skip
_PREFIXES = {"": "", "pico": "p", "nano": "n", "micro": "µ", "milli": "m", "kilo": "k"}
_NOUNS = {"meter": "m", "meters": "m", "metre": "m", "metres": "m", "newton": "N", "newtons": "N"}
#: Units that may also be words or letters of names: valid only in brackets and in a row of units.
IN_BRACKETS = {"in", "g", "lb"}
#: English words of units, in lower case without blanks and hyphens.
_WORDS = {
    "micron": "µm", "microns": "µm", "angstrom": "Å", "angstroms": "Å", "centimeter": "cm",
    "centimeters": "cm", "centimetre": "cm", "centimetres": "cm", "sec": "s", "secs": "s", "second": "s",
    "seconds": "s", "msec": "ms", "millisecond": "ms", "milliseconds": "ms", "µsec": "µs", "usec": "µs",
    "microsecond": "µs", "microseconds": "µs", "minute": "min", "minutes": "min", "hr": "h", "hrs": "h",
    "hour": "h", "hours": "h", "volt": "V", "volts": "V",
} | {
    prefix + noun: symbol + unit
    for prefix, symbol in _PREFIXES.items()
    for noun, unit in _NOUNS.items()
}  # fmt: skip
#: Kind and name of each unit by symbol; "um" and "uN" are µm and µN.
_SYMBOLS = {name: (kind, name) for kind, sizes in COLUMN_UNITS.items() for name in sizes}
_SYMBOLS |= {name.replace("µ", "u"): known for name, known in _SYMBOLS.items()}
_BY_WORD = {word: _SYMBOLS[name] for word, name in _WORDS.items() if name in _SYMBOLS}
#: µ of UTF-8, GBK, Shift-JIS and EUC-KR read as Windows-1252, and µ of TeX and HTML.
_MU = ("Âµ", "Î¼", "¦Ì", "ƒÊ", "¥ì", "μ", "$\\mu$", "\\mu", "&micro;")
_DASHES = str.maketrans("−–—‐‑", "-----")


@lru_cache(maxsize=4096)
def cleaned(text):
    """Return a text with a unique character for each of µ, Å and -."""
    for each in _MU:
        text = text.replace(each, "µ")
    return unicodedata.normalize("NFKC", text).replace("μ", "µ").translate(_DASHES)


def unit_alone(text):
    """Return kind and name of a text that is exactly a plain unit, or None.

    MN is excluded: next to a measured depth, a header in capitals means mN.
    """
    unit = _unit_told(text)
    return None if unit == ("force", "MN") else unit


def _unit_told(text):
    text = cleaned(str(text)).strip()
    return _SYMBOLS.get(text) or _BY_WORD.get(text.lower().replace(" ", "").replace("-", ""))


def unit_named(text):
    """Return the name in `COLUMN_UNITS` of a given unit, or None."""
    unit = _unit_told(str(text).strip(" ()[]"))
    return unit and unit[1]


def is_deflection(unit):
    """Whether a force in this unit is the deflection of a cantilever: a length, or a voltage."""
    return unit.lstrip("−") in COLUMN_UNITS["length"] or is_voltage(unit)


def is_voltage(unit):
    return unit.lstrip("−") in COLUMN_UNITS["voltage"]


def size_of(unit):
    """Return the size (SI) of a unit by name, negative for "−nm"."""
    if unit.startswith("−"):
        return -size_of(unit[1:])
    kind, name = _SYMBOLS[unit]
    return COLUMN_UNITS[kind][name]
