"""Exact names of columns, and the unit in a header. Nothing here is a guess.

Add a name with the file that contains it. A header with more than a name and a plain unit has no exact name
and raises `UnknownColumns`: "Max Load (mN)", "Depth*10 (nm)" and "Load (mN) [x0.1]".
"""

from functools import lru_cache

from .units import IN_BRACKETS, cleaned, unit_alone

#: Number of characters of a header that count.
_LONGEST = 80
#: Names of the depth of the tip in the sample, for any instrument. KLA: "displacement into surface";
#: Optics11: "indentation"; Anton Paar: "pd", "penetration depth"; Hysitron: "depth".
DEPTH = {
    "depth", "indentation depth", "penetration depth", "indentation", "penetration", "pd",
    "displacement into surface", "depth of indentation", "depth of penetration", "contact displacement",
}  # fmt: skip
#: Names of the depth for an instrument without a cantilever; otherwise they may be the position of a piezo.
DISPLACEMENT = {"displacement", "disp", "displ", "h"}
FORCE = {
    "force", "load", "normal force", "normal load", "load on sample", "applied force", "applied load",
    "indentation force", "indentation load", "force on sample", "force on surface", "p", "f", "fn",
}  # fmt: skip
TIME = {"time", "t", "time on sample", "time in contact", "test time", "elapsed time"}
STIFFNESS = {"harmonic contact stiffness", "contact stiffness", "stiffness", "s", "dp dh", "s=dp dh"}
#: Quantities, the kinds of their units, and their names.
TAKEN = {
    "depth": ("length", DEPTH | DISPLACEMENT),
    "force": ("force", FORCE),
    "time": ("time", TIME),
    "stiffness": ("stiffness", STIFFNESS),
}
#: Names of results of a test, or of a depth of a curve. A table with such a name may have tests as rows.
_RESULTS = {"e", "er", "eit", "e it", "h it", "hit", "hv", "hm", "cit", "young's modulus"}
_OF_RESULTS = {"modulus", "hardness"}
_PRESSURES = {"gpa", "mpa", "kpa", "pa"}


def normal(name):
    """Return a name in lower case with single blanks between its words."""
    for each in "_-./:,;{}[]()":
        name = name.replace(each, " ")
    return " ".join(name.lower().split())


@lru_cache(maxsize=4096)
def parted(head, cell=""):
    """Return the name of a column, and kind and name of its unit; both are empty without a plain unit.

    `cell` is the unit from a separate line of units. Forms: "Depth (nm)", "Depth [nm]", "Depth / nm",
    "Depth, nm", "depth_nm", "Depth nm", "Depth in nm".
    """
    text = cleaned(head[:_LONGEST]).strip(" \"'#")
    if cell.strip(" ()[]{}<>/"):
        return normal(text), *(unit_alone(cell[:_LONGEST].strip(" ()[]{}<>/")) or ("", ""))
    for opening, closing in ("()", "[]", "{}", "<>"):
        if text.endswith(closing) and opening in text:
            name, _, inner = text[:-1].rpartition(opening)
            unit = unit_alone(inner.strip().removeprefix("in "))
            return (normal(name), *unit) if unit else (normal(text), "", "")
    name, sign, unit = _ended(text)
    return (normal(name).removesuffix(" in"), *unit) if sign else (normal(text), "", "")


def _ended(text):
    """Return name, sign and unit of a text that ends in a sign and a plain unit, or else the text alone."""
    for sign in ("/", ",", ":", "_", " "):
        name, found, last = text.rpartition(sign)
        unit = unit_alone(last)
        compound = sign == "/" and _is_compound(name.split())
        if found and unit and unit[1] not in IN_BRACKETS and not compound:
            return name, sign, unit
    return text, "", ("", "")


def _is_compound(words):
    """Whether words before a slash end in a unit, as in "Load mN/s"; "h/nm" is a name and its unit."""
    return not words or (words != ["h"] and unit_alone(words[-1]) is not None)


def symbols_in(heads):
    """Return headers whose unit may be an index, such as "F_N", because no other header has this form."""
    ends = {head: _ended(cleaned(head[:_LONGEST]).strip(" \"'#")) for head in heads}
    signs = [sign for _, sign, _ in ends.values()]
    return {
        head
        for head, (name, sign, (kind, unit)) in ends.items()
        if len(name.strip()) == len(unit) == 1 and kind in ("length", "force") and signs.count(sign) == 1
    }


def is_result(head):
    """Whether a header names a modulus or a hardness."""
    words = normal(cleaned(head[:_LONGEST])).split()
    name = " ".join(word for word in words if word not in _PRESSURES)
    return name in _RESULTS or not (_OF_RESULTS | _PRESSURES).isdisjoint(words)


def is_variant(name, each):
    """Whether a name has an exact name of a quantity among other words, such as "depth corrected"."""
    words, squeezed = set(name.split()), name.replace(" ", "")
    names = TAKEN[each][1]
    return name not in names and any(
        other in words or (len(other) > 3 and other.replace(" ", "") in squeezed) for other in names
    )
