"""Names of columns that are taken without asking, and the unit in a header. Nothing here is a guess.

A name is added with the file in which it was seen. A header that is anything more than a name and a plain
unit has no exact name: "Max Load (mN)", "Depth*10 (nm)" and "Load (mN) [x0.1]" are asked about.
"""

from functools import lru_cache

from .units import IN_BRACKETS, cleaned, unit_alone

#: Longest header that is looked at.
_LONGEST = 80
#: Names of the depth of the tip in the sample, of any instrument. KLA: "displacement into surface";
#: Optics11: "indentation"; Anton Paar: "pd", "penetration depth"; Hysitron: "depth".
DEPTH = {
    "depth", "indentation depth", "penetration depth", "indentation", "penetration", "pd",
    "displacement into surface", "depth of indentation", "depth of penetration", "contact displacement",
}  # fmt: skip
#: Names that mean the depth where an instrument has no cantilever, and may be a position of a piezo else.
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
#: Names of which a test, or a depth of a curve, has one: where they stand, the rows may be tests.
_RESULTS = {"e", "er", "eit", "e it", "h it", "hit", "hv", "hm", "cit", "young's modulus"}
_OF_RESULTS = {"modulus", "hardness"}
_PRESSURES = {"gpa", "mpa", "kpa", "pa"}


def normal(name):
    """Name in small letters with single blanks between its words."""
    for each in "_-./:,;{}[]()":
        name = name.replace(each, " ")
    return " ".join(name.lower().split())


@lru_cache(maxsize=4096)
def parted(head, cell=""):
    """Name of a column, and kind and name of its unit; both are empty where there is no plain unit.

    `cell` is the unit in a line of its own. Forms: "Depth (nm)", "Depth [nm]", "Depth / nm", "Depth, nm",
    "depth_nm", "Depth nm", "Depth in nm".
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
    """Name, sign and unit of a text that ends in a sign and a plain unit; without one the text alone."""
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
    """Headers that end in what may be an index, no unit, as "F_N", as no other header has its form."""
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
    """Whether a name has one of the exact names of a quantity among other words, as "depth corrected"."""
    words, squeezed = set(name.split()), name.replace(" ", "")
    names = TAKEN[each][1]
    return name not in names and any(
        other in words or (len(other) > 3 and other.replace(" ", "") in squeezed) for other in names
    )
