"""Texts that are a unit and nothing else: symbols and words, prefixes, and powers of ten beside them.

Where in the header of a column its unit stands is in `headers.py`.
"""

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from ..profiles.samples import LENGTHS
from ..show.units import UNITS


def _sizes(kind, *names):
    """Sizes (SI) of units of a kind by their names."""
    known = {unit.name: unit.factor for unit in UNITS[kind]}
    return {name: known[name] for name in names}


#: Sizes (SI) of the units that a column of a file may have, by their kind.
COLUMN_UNITS = {
    "length": LENGTHS,
    "force": _sizes("force", "kN", "N", "mN", "µN", "nN", "pN", "MN"),
    "time": {"min": 60.0} | _sizes("time", "s", "ms", "µs") | {"h": 3600.0},
    "voltage": {"V": 1.0, "mV": 1e-3},
}
#: Names of units of a stiffness by their sizes (N/m).
STIFFNESS = {1e-3: "mN/m", 1.0: "N/m", 1e3: "µN/nm", 1e6: "mN/nm", 1e9: "N/nm"}
_PREFIXES = {"": 1.0, "p": 1e-12, "n": 1e-9, "µ": 1e-6, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}
#: Prefixes as words of several languages; "mil" and "kil" are cut where a vowel follows.
_PREFIX_WORDS = {
    "pico": 1e-12, "piko": 1e-12, "nano": 1e-9, "micro": 1e-6, "mikro": 1e-6, "mu": 1e-6, "milli": 1e-3,
    "mili": 1e-3, "kilo": 1e3, "quilo": 1e3, "mega": 1e6, "centi": 1e-2,
    "皮": 1e-12, "纳": 1e-9, "奈": 1e-9, "微": 1e-6, "毫": 1e-3, "千": 1e3, "兆": 1e6, "厘": 1e-2,
}  # fmt: skip
#: Words of the units without a prefix.
_WORDS = {
    "length": "met(?:er|re|ro|ri)s?|mètres?|米",
    "force": "newtons?|newtonios?|牛顿|牛",
    "time": "seconds?|secs?|sekunden?|sek|secondes?|segundos?|second[oi]|秒",
    "voltage": "volts?|voltios?|伏",
}
_SYMBOLS = {"length": "m", "force": "N", "time": "s", "voltage": "V"}
#: Units with words of their own.
_OTHERS = {
    "micron": ("length", 1e-6), "microns": ("length", 1e-6), "angstrom": ("length", 1e-10),
    "angstroms": ("length", 1e-10), "ångström": ("length", 1e-10), "ångstrom": ("length", 1e-10),
    "ångströms": ("length", 1e-10), "埃": ("length", 1e-10), "minute": ("time", 60.0),
    "minutes": ("time", 60.0), "minuten": ("time", 60.0), "minutos": ("time", 60.0),
    "minuti": ("time", 60.0), "mins": ("time", 60.0),
    "hr": ("time", 3600.0), "hours": ("time", 3600.0), "msec": ("time", 1e-3), "µsec": ("time", 1e-6),
}  # fmt: skip
#: A power of ten: 10^-3, 10-3, 10**-3, 1e-6.
POWER = r"(?:10\s*(?:\^\s*\(?\s*([-+]?\d+)\s*\)?|([-+]\s?\d+))|1(?:[.,]0*)?[eE]([-+]?\d+))"
#: A sign or word of multiplication.
TIMES = r"\s*(?:[*·]|[xX](?=\s*1)|times)\s*"
_BEFORE = re.compile(rf"(?:{TIMES})?{POWER}(?:{TIMES}|\s*)(?=\S)")
#: Smallest and largest sizes of units (SI) of a depth, force or time that anybody would write.
_USUAL = {"length": (1e-12, 1.0), "force": (1e-12, 1e3), "time": (1e-6, 60.0), "voltage": (1e-6, 1.0)}


@dataclass(frozen=True)
class Unit:
    """Unit of a column by its header.

    `kind` is a key of `COLUMN_UNITS`, "stiffness", "sensitivity" or empty for other quantities; `name` one
    of `COLUMN_UNITS[kind]`; `size` in SI. `doubt` is what stands beside and is not understood.
    """

    kind: str = ""
    name: str = ""
    size: float = float("nan")
    doubt: str = ""


#: Signs as they are after a wrong decoding, or in LaTeX and HTML.
_MOJIBAKE = {
    "Âµ": "µ", "Î¼": "µ", "Ã…": "Å", "Ã\x85": "Å", "Ã—": "*", "\\mu": "µ", "&micro;": "µ", "&#181;": "µ",
}  # fmt: skip


def cleaned(text):
    """Header with one character for each sign: µ, -, * and ^, no accents of a wrong encoding."""
    for wrong, right in _MOJIBAKE.items():
        text = text.replace(wrong, right)
    # Superscripts become digits: they are exponents.
    text = re.sub("([⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)", r"^\1", text)
    text = unicodedata.normalize("NFKC", text)
    text = text.translate(str.maketrans("−–—‐‑⁻×✕∙⋅µμ", "------****µµ")).replace("**", "^").replace("$", "")
    return re.sub(r"\^\{([^{}]*)\}", r"^\1", text).replace("^^", "^")


def unit_named(text):
    """Name of a known unit as in `COLUMN_UNITS`, or None."""
    unit = unit_alone(cleaned(str(text)).strip(" ()[]"))
    return unit.name if unit and not unit.doubt and unit.kind in COLUMN_UNITS else None


@lru_cache(maxsize=4096)
def unit_alone(text, capitals=False):
    """`Unit` of a text that is a unit and nothing else, with powers of ten beside it, or None."""
    text = text.strip()
    if not text or len(text) > 60:
        return None
    before = _BEFORE.match(text)
    if before and not (remainder := text[before.end() :].strip()).startswith(("/", "^")):
        unit = unit_alone(remainder, capitals)
        if unit is None or unit.kind not in COLUMN_UNITS:
            return unit and Unit(unit.kind, unit.name, unit.size, before[0].strip())
        return scaled(unit, before, inside=True)
    after = re.search(rf"({TIMES}|\s*/\s*){POWER}$", text)
    if after and after.start():
        unit = unit_alone(text[: after.start()], capitals)
        if unit is None or unit.kind not in COLUMN_UNITS:
            return unit and Unit(unit.kind, unit.name, unit.size, after[0].strip())
        return scaled(unit, after, inside=True)
    return _plain(text, capitals)


def _plain(text, capitals):
    """`Unit` of a symbol or word without a power of ten, or None."""
    compound = re.fullmatch(
        r"([^/]+?)\s*(?:/\s*|[\s·*.]+(?=[a-zµ]+\s*\^?\s*-\s*1$))([^/]+?)(?:\s*\^?\s*-\s*1)?", text
    )
    if compound and ("/" in text or re.search(r"-\s*1$", text)):
        pair = [_plain(each.strip(), False) for each in compound.groups()]
        if all(pair) and [each.kind for each in pair] == ["force", "length"]:
            size = pair[0].size / pair[1].size
            return Unit("stiffness", STIFFNESS.get(float(f"{size:.6g}"), f"{size:g} N/m"), size)
        if all(pair) and [each.kind for each in pair] == ["length", "voltage"]:
            return Unit("sensitivity", "", pair[0].size / pair[1].size)
        return Unit() if all(pair) else None
    size = _symbol(text) or _word(text)
    if size is None and capitals:
        size = _capital(text)
    elif size and capitals and text in ("MN", "PN", "NN") and size[1] == 1e6:
        return Unit(*_named(*size)[:3], doubt=f"{text}, which is MN or mN")
    return None if size is None else Unit(*_named(*size))


def _named(kind, size):
    """Kind, name, size and doubt of a unit of a size."""
    for name, known in COLUMN_UNITS[kind].items():
        if abs(known - size) < 1e-9 * size:
            return kind, name, known, ""
    return kind, "", size, f"{size:g} {_SYMBOLS[kind]}"


def _symbol(text):
    """Kind and size of "nm", "u N" or "Å", or None."""
    if text in ("Å", "Å"):
        return "length", 1e-10
    if text == "min":
        return "time", 60.0
    if text == "cm":
        return "length", 1e-2
    match = re.fullmatch(r"([pnµumkM]?)([mNsV])", text) or re.fullmatch(r"([µu])\s([mNsV])", text)
    if not match:
        return None
    kind = next(kind for kind, symbol in _SYMBOLS.items() if symbol == match[2])
    size = _PREFIXES[match[1]]
    # ks, Ms, Mm, kV and others are no units of these quantities.
    allowed = {"time": (1e-12, 1.0), "length": (1e-12, 1.0), "voltage": (1e-9, 1e3), "force": (1e-12, 1e6)}[
        kind
    ]
    return (kind, size) if allowed[0] <= size <= allowed[1] else None


_WORD = re.compile(
    rf"(?P<prefix>{'|'.join(_PREFIX_WORDS)}|)[\s-]*(?:(?P<symbol>(?-i:[mNsV]))|"
    + "|".join(f"(?P<{kind}>{words})" for kind, words in _WORDS.items()) + ")", re.I
)  # fmt: skip


def _word(text):
    """Kind and size of "micro N", "nanometers", "µNewton" or 微米, or None."""
    low = text.lower()
    if low in _OTHERS:
        return _OTHERS[low]
    symbol = re.fullmatch(r"([pnµumkM])[\s-]?(newtons?|met(?:er|re)s?|sec|seconds?|volts?)", text, re.I)
    if symbol and symbol[1] in _PREFIXES:
        base = _word(symbol[2])
        return base and (base[0], base[1] * _PREFIXES[symbol[1]])
    match = _WORD.fullmatch(text)
    if not match:
        return None
    prefix = match["prefix"].lower()
    kind = next(
        kind
        for kind in COLUMN_UNITS
        if match[kind] or (match["symbol"] and match["symbol"] == _SYMBOLS[kind])
    )
    if match["symbol"] and not prefix:
        return None
    return kind, _PREFIX_WORDS.get(prefix, 1.0)


def _capital(text):
    """Kind and size of a unit in a header that is all in capitals, where one reading is possible."""
    lengths = {"NM": 1e-9, "UM": 1e-6, "µM": 1e-6, "MM": 1e-3}
    forces = {"UN": 1e-6, "NN": 1e-9, "KN": 1e3}
    if text in lengths:
        return "length", lengths[text]
    if text in forces:
        return "force", forces[text]
    return {"S": ("time", 1.0), "SEC": ("time", 1.0), "MS": ("time", 1e-3), "MV": ("voltage", 1e-3)}.get(
        text
    )


def scaled(unit, match, inside):
    """A unit with a power of ten: it multiplies the unit, or the numbers, by what is usual of the two."""
    exponent = int(next(filter(None, match.groups()[-3:])).replace(" ", ""))
    divided = match.group(0).lstrip().startswith("/")
    factor = 10.0**exponent
    of_unit, of_numbers = unit.size * factor, unit.size / factor
    if divided:
        # Numbers that were divided by 10⁻³ are in thousandths.
        return Unit(*_named(unit.kind, of_unit)) if _usual(unit.kind, of_unit) else _unclear(unit, match)
    if inside and (exponent < 0 or match.re is _BEFORE):
        return Unit(*_named(unit.kind, of_unit)) if _usual(unit.kind, of_unit) else _unclear(unit, match)
    sizes = [size for size in (of_unit, of_numbers) if _usual(unit.kind, size)]
    return Unit(*_named(unit.kind, sizes[0])) if len(sizes) == 1 else _unclear(unit, match)


def _usual(kind, size):
    low, high = _USUAL[kind]
    return 0.999 * low <= size <= 1.001 * high


def _unclear(unit, match):
    return Unit(unit.kind, unit.name, unit.size, match.group(0).strip())
