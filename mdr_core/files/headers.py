"""The unit in the header of a column: in brackets, after a slash, or at the end of the name."""

import re
from functools import lru_cache

from .units import COLUMN_UNITS, POWER, TIMES, Unit, cleaned, scaled, unit_alone

#: A power of ten behind a unit.
_AFTER = re.compile(rf"({TIMES}|\s*/\s*|\s*){POWER}")
#: Units that are known and not read: their sizes are no powers of ten of SI units, or are several.
_FOREIGN = re.compile(
    r"[kmµ]?gf|[kmµ]?g|kgs|tf|lbf?s?|pounds?|ozf?|kp|p(on)?d|dyne?s?|kips?|grams?|gramm|gram+force|in|inch(es)?"
    r"|mils?|thou|ft|[µu]in|a\.?u\.?|arb\.?( units?)?|%|counts?|lsb|bits?|px|pixels?|digits?", re.I
)  # fmt: skip
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
#: Longest header of a column that is read.
_LONGEST = 300


@lru_cache(maxsize=4096)
def unit_of(head, cell=""):
    """`Unit` of a column with a name, and a cell in a line of units of its own where there is one."""
    text, cell = cleaned(head)[:_LONGEST], cleaned(cell).strip()
    if cell:
        own = unit_alone(cell.strip(" ()[]"))
        if own is None:
            return Unit(doubt=_doubt_of(cell.strip(" ()[]")))
        return _with(own, text)
    for find in (_in_brackets, _after_slash, _at_the_end):
        found = find(text)
        if found:
            unit, remainder = found
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
        other = unit_alone(piece.strip())
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
            unit = unit_alone(
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
                unit = scaled(unit, scale, inside=False)
            else:
                # "Depth x1e-6 (m)"
                scale = re.search(rf"({TIMES}){POWER}\s*$", before)
                if scale:
                    remainder = f"{before[: scale.start()]} {after}"
                    unit = scaled(unit, scale, inside=False)
            return unit, remainder
        inner = _at_the_end(match[1])
        if inner and (re.search(r"\d", match[1]) or re.search(r"(?<!\w)\w{1,2}(?!\w)", inner[1])):
            # As in (0.1 mN), (10e-3 N), (m N).
            return Unit(inner[0].kind, inner[0].name, inner[0].size, match[1].strip()), ""
        if match[1].strip() == "h":
            return Unit("time", "h", 3600.0), before
        if re.search(r"[A-Za-zµ]\s*/\s*\d[\d.,]*\s*$", match[1]):
            # A scale, as (mN/10).
            return Unit(doubt=match[1].strip()), before
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
    if unit_alone(tail) or unit_alone(f"{tail}/{after}") or _doubt_of(tail) or _A_UNIT.fullmatch(tail):
        if re.fullmatch(r"[\d.,]+", after):
            return Unit(doubt=f"{tail}/{after}"), ""
        # "Load µN/s" is a rate, "Stiffness N/m" no length.
        compound = unit_alone(f"{tail}/{after}")
        return (compound or Unit(), "")
    unit = unit_alone(after.strip("()[] "), _upper(text))
    return None if unit is None else (unit, before)


def _at_the_end(text):
    """Unit at the end of a name, "Depth nm", "load_micro_N", "Defl_pN_Rt", and what stands before it."""
    text = text.strip(" .:;,_-()[]")
    for end in dict.fromkeys((text, _LAST.sub("", text))):
        starts = [0, *(m.end() for m in re.finditer(r"[\s_,:;]+|(?<=[^\W\d_])-(?=[^\W\d_])", end))]
        for start in starts:
            unit = unit_alone(end[start:].replace("_", " "), _upper(end))
            if unit is not None:
                before = end[:start]
                number = re.search(r"(?:^|[\s_])(\d+(?:[.,]\d+)?)[\s_]*$", before)
                if number and not re.fullmatch(r"[1-9]", number[1]):
                    return Unit(unit.kind, unit.name, unit.size, f"{number[1]} {end[start:]}"), ""
                scale = re.search(rf"({TIMES}){POWER}[\s_]*$", before)
                if scale:
                    return scaled(unit, scale, inside=False), before[: scale.start()]
                return unit, before
    return None


def _upper(text):
    """Whether a header is all in capitals, in which a prefix is not told: MN, NM."""
    return text.upper() == text and len(re.findall("[A-Z]", text)) > 3
