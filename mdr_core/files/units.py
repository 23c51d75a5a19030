"""Units in the headers of tables: symbols and words, prefixes, and powers of ten beside them."""

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
#: Units that are known and not read: their sizes are no powers of ten of SI units, or are several.
_FOREIGN = re.compile(
    r"[kmµ]?gf|[kmµ]?g|kgs|tf|lbf?s?|pounds?|ozf?|kp|p(on)?d|dyne?s?|kips?|grams?|gramm|gram+force|in|inch(es)?"
    r"|mils?|thou|ft|[µu]in|a\.?u\.?|arb\.?( units?)?|%|counts?|lsb|bits?|px|pixels?|digits?", re.I
)  # fmt: skip
#: A power of ten: 10^-3, 10-3, 10**-3, 1e-6.
_POWER = r"(?:10\s*(?:\^\s*\(?\s*([-+]?\d+)\s*\)?|([-+]\s?\d+))|1(?:[.,]0*)?[eE]([-+]?\d+))"
_TIMES = r"\s*(?:[*·]|[xX](?=\s*1)|times)\s*"
_BEFORE = re.compile(rf"(?:{_TIMES})?{_POWER}(?:{_TIMES}|\s*)(?=\S)")
_AFTER = re.compile(rf"({_TIMES}|\s*/\s*|\s*){_POWER}")
#: Words that scale a unit or a quantity, or stand for a function of it.
_SCALES = (
    "tens?|tenths?|hundreds?|hundredths?|thousands?|thousandths?|millions?|millionths?|billions?|trillions?|dozens?"
    "|half|halves|double|zehner|zehntel|hunderte?|hundertstel|tausende?|tausendstel|million(?:en)?|dizaines?"
    "|dixièmes?|centaines?|centièmes?|milliers?|millièmes?|decenas|décimas|cientos|centésimas|miles|milésimas"
    "|decine|decimi|centinaia|centesimi|migliaia|millesimi"
    "|atto|femto|pico|piko|nano|micro|mikro|milli|centi|zenti|deci|dezi|deca|deka|hecto|hekto|kilo|mega|giga|tera"
    "|log(?:10|2|_?e)?|ln|sqrt|squared?|inverse|reciprocal|normali[sz]ed|norm|normiert|normalis[eé]e?s?"
    "|dimensionless|relative|scaled?|skaliert|factor|faktor|facteur|multiplied|divided|x ?1[0 ]+"
)
#: What may not stand beside a unit: numbers that scale, prefixes on their own, functions.
_SCALING = re.compile(
    r"(?:[*·/÷]|(?<![^\W_])x)\s*\d[\d.,]*|\d+\s*[*·]|\d\s*x(?![^\W_])|^\s*10+\s|^\s*\d+[^\W\d_](?![^\W\d_])"
    r"|\d+e[-+]?\d+|\d*\s*\^\S*|(?<![\d.])10\s?[-+]\s?\d+|e[-+]\d+"
    rf"|(?<![^\W_])(?:{_SCALES})(?![^\W\d_])",
    re.I,
)
_BRACKETS = re.compile(r"[(\[{<]([^()\[\]{}<>]*)[)\]}>]")
#: What may stand behind the unit in a name, as in "Defl_pN_Rt".
_LAST = re.compile(
    r"[\s_-]+(ex|rt|ext|ret|extend|retract|approach|withdraw|trace|retrace|raw)$|[\s_]+\d+$", re.I
)
#: What stands before the slash of a compound unit, as of a rate.
_A_UNIT = re.compile(r"[pnµumkMGcd]?[NmVgsJA]|[kMG]?Pa|1")
#: A prefix that stands alone before a unit without one, or before a name: "Force m(N)", "kForce (N)".
_LONE_PREFIX = re.compile(r"[^\W\d_][\s_]+[pnµumkM]\s*$|(?<![^\W\d_])[pnµumkM](?=[A-Z][a-z]{3})")
#: Smallest and largest sizes of units (SI) of a depth, force or time that anybody would write.
_USUAL = {"length": (1e-12, 1.0), "force": (1e-12, 1e3), "time": (1e-6, 60.0), "voltage": (1e-6, 1.0)}
#: Longest header of a column that is read.
_LONGEST = 300


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
    parsed = _parsed(cleaned(str(text)).strip(" ()[]"))
    return parsed.name if parsed and not parsed.doubt and parsed.kind in COLUMN_UNITS else None


@lru_cache(maxsize=4096)
def unit_of(head, cell=""):
    """`Unit` of a column with a name, and a cell in a line of units of its own where there is one."""
    text, cell = cleaned(head)[:_LONGEST], cleaned(cell).strip()
    if cell:
        own = _parsed(cell.strip(" ()[]"))
        if own is None:
            return Unit(doubt=_doubt_of(cell.strip(" ()[]")))
        return _with(own, text)
    for find in (_in_brackets, _after_slash, _at_the_end):
        parsed = find(text)
        if parsed:
            unit, remainder = parsed
            return _with(unit, remainder)
    return Unit(doubt=_foreign_in(text))


def _with(unit, remainder):
    """A unit with the doubt that is in the rest of the header."""
    if unit.doubt or unit.kind not in COLUMN_UNITS:
        return unit
    beside = _SCALING.search(remainder) or (unit.size in (1.0, 60.0) and _LONE_PREFIX.search(remainder))
    if beside:
        return Unit(unit.kind, unit.name, unit.size, beside[0].strip())
    for piece in _BRACKETS.findall(remainder):
        other = _parsed(piece.strip())
        if (other and (other.kind, other.size) != (unit.kind, unit.size)) or _FOREIGN.fullmatch(
            piece.strip()
        ):
            return Unit(unit.kind, unit.name, unit.size, piece.strip())
    return unit


def _doubt_of(text):
    """The text where it is a unit that is not read, or a number that scales; else nothing."""
    return text if _FOREIGN.fullmatch(text) or _SCALING.search(text) or re.search(r"\d", text) else ""


def _foreign_in(text):
    """Text that looks like a unit and is none of this package, in a header that has no other."""
    pieces = [
        *_BRACKETS.findall(text),
        *re.split(r"\s*/\s*|,\s*", text)[1:],
        re.split(r"[\s_-]+", text.strip())[-1],
    ]
    for piece in map(str.strip, pieces):
        if _FOREIGN.fullmatch(piece) or (
            piece != text.strip() and re.fullmatch(r"[kmµunpM�?]\s?[Nm]", piece)
        ):
            return piece
    beside = _SCALING.search(text)
    return beside[0].strip() if beside else ""


def _in_brackets(text):
    """Unit of the last bracket that has one, and the header without it."""
    for match in reversed(list(_BRACKETS.finditer(text))):
        before, after = text[: match.start()], text[match.end() :]
        pieces = [match[1], *(re.split("[,;:]", match[1]) if re.search("[,;:]", match[1]) else [])]
        for piece in pieces:
            unit = _parsed(
                re.sub(r"^(in|en|units?|einheit)\b[:\s]*", "", piece.strip(), flags=re.I), _upper(text)
            )
            if unit is None:
                continue
            remainder = (
                f"{before} {after}"
                if piece is match[1]
                else f"{before} {match[1].replace(piece, ' ')} {after}"
            )
            scale = _AFTER.match(after)
            if scale:
                remainder = f"{before} {after[scale.end() :]}"
                unit = _scaled(unit, scale, inside=False)
            else:
                # "Depth x1e-6 (m)"
                scale = re.search(rf"({_TIMES}){_POWER}\s*$", before)
                if scale:
                    remainder = f"{before[: scale.start()]} {after}"
                    unit = _scaled(unit, scale, inside=False)
            return unit, remainder
        inner = _at_the_end(match[1])
        if inner and (re.search(r"\d", match[1]) or re.search(r"(?<!\w)\w{1,2}(?!\w)", inner[1])):
            # As in (0.1 mN), (10e-3 N), (m N).
            return Unit(inner[0].kind, inner[0].name, inner[0].size, match[1].strip()), ""
        if match[1].strip() == "h":
            return Unit("time", "h", 3600.0), before
        if re.search(r"[A-Za-zµ%].*[/^]|[/^-]\d", match[1]):
            # A quantity of another kind, as (mN/s) or (nm^2).
            return Unit(), before
    return None


def _after_slash(text):
    """Unit after the slash of "h / nm", and what stands before it."""
    before, slash, after = text.rpartition("/")
    if not slash:
        return None
    before, after = before.strip(), after.strip()
    tail = re.split(r"[\s,_(\[]+", before)[-1]
    if _parsed(tail) or _parsed(f"{tail}/{after}") or _doubt_of(tail) or _A_UNIT.fullmatch(tail):
        # "Load µN/s" is a rate, "Stiffness N/m" no length.
        compound = _parsed(f"{tail}/{after}")
        return (compound or Unit(), "")
    unit = _parsed(after.strip("()[] "), _upper(text))
    return None if unit is None else (unit, before)


def _at_the_end(text):
    """Unit at the end of a name, "Depth nm", "load_micro_N", "Defl_pN_Rt", and what stands before it."""
    text = text.strip(" .:;,_-()[]")
    for end in dict.fromkeys((text, _LAST.sub("", text))):
        starts = [0, *(m.end() for m in re.finditer(r"[\s_,:;]+|(?<=[^\W\d_])-(?=[^\W\d_])", end))]
        for start in starts:
            unit = _parsed(end[start:].replace("_", " "), _upper(end))
            if unit is not None:
                before = end[:start]
                number = re.search(r"(?:^|[\s_])(\d+(?:[.,]\d+)?)[\s_]*$", before)
                if number and not re.fullmatch(r"[1-9]", number[1]):
                    return Unit(unit.kind, unit.name, unit.size, f"{number[1]} {end[start:]}"), ""
                scale = re.search(rf"({_TIMES}){_POWER}[\s_]*$", before)
                if scale:
                    return _scaled(unit, scale, inside=False), before[: scale.start()]
                return unit, before
    return None


def _upper(text):
    """Whether a header is all in capitals, in which a prefix is not told: MN, NM."""
    return text.upper() == text and len(re.findall("[A-Z]", text)) > 3


@lru_cache(maxsize=4096)
def _parsed(text, capitals=False):
    """`Unit` of a text that is a unit and nothing else, with powers of ten beside it, or None."""
    text = text.strip()
    if not text or len(text) > 60:
        return None
    before = _BEFORE.match(text)
    if before and not (remainder := text[before.end() :].strip()).startswith(("/", "^")):
        unit = _parsed(remainder, capitals)
        if unit is None or unit.kind not in COLUMN_UNITS:
            return unit and Unit(unit.kind, unit.name, unit.size, before[0].strip())
        return _scaled(unit, before, inside=True)
    after = re.search(rf"({_TIMES}|\s*/\s*){_POWER}$", text)
    if after and after.start():
        unit = _parsed(text[: after.start()], capitals)
        if unit is None or unit.kind not in COLUMN_UNITS:
            return unit and Unit(unit.kind, unit.name, unit.size, after[0].strip())
        return _scaled(unit, after, inside=True)
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


def _scaled(unit, match, inside):
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
