"""Suggestions for an ambiguous table. They may be wrong, because the user confirms them."""

from itertools import pairwise

import numpy as np

from .names import DISPLACEMENT, TAKEN, normal
from .split import at_gaps, continues_beside, is_path, key_columns, place_of, restarts
from .units import cleaned, size_of, unit_alone

#: Parts of names in several languages.
_PARTS = {
    "depth": [
        "depth", "indent", "penetr", "displ", "disp", "tief", "eindr", "weg", "profond", "enfonc", "déplac",
        "deplac", "despl", "spost", "desloc", "prof", "glub", "глуб", "hloub", "głęb", "diept", "derin",
        "separ", "sep", "tss", "tip", "abstand", "height", "höhe", "hauteur", "altura", "altezza", "piezo",
        "piézo", "stage", "ramp", "sensor", "zsens", "extens", "stroke", "travel", "distance", "deform",
        "compress", "stauch", "verform", "hub", "position", "pos", "depress", "gap", "pd",
        "深", "压入", "压痕", "位移", "変位", "깊이",
    ],
    "force": [
        "force", "load", "kraft", "last", "forza", "fuerza", "charge", "carga", "carico", "effort", "сил",
        "нагруз", "kracht", "síla", "siła", "kuvvet", "力", "荷", "载", "하중", "fn", "lf", "defl", "fz",
    ],
    "time": ["time", "zeit", "temps", "tiempo", "tempo", "时间", "時間", "시간", "врем", "čas"],
}  # fmt: skip
_LETTERS = {
    "depth": {"h", "d", "z", "δ", "u", "w", "δh", "∆h", "δd"},
    "force": {"f", "p", "l", "δf"},
    "time": {"t"},
}
#: Parts of names of other columns.
_OTHER = [
    "max", "peak", "min", "std", "dev", "mean", "avg", "average", "raw", "error", "noise", "set", "target",
    "rate", "contact", "plastic", "residual", "resid", "lateral", "fric", "drift", "offset", "volt",
    "status", "temp", "area", "radius", "x-pos", "y-pos", "pos_x", "pos_y", "squared", "mittel", "médi",
    "moyen", "最大", "平均",
]  # fmt: skip
#: Parts of names of positions that include the deflection of a cantilever.
_POSITION = [
    "piezo", "piézo", "height", "höhe", "hauteur", "altura", "stage", "ramp", "sens", "scan", "z", "zpos",
    "ext", "stroke", "travel", "pos", "hub", "weg", "drive", "motor", "raw", "actuator", "lvdt", "verfahr",
    "stell", "déplac", "样品台", "ピエゾ", "压电",
]  # fmt: skip
#: Parts of names of the depth of the tip, in instruments with a cantilever.
_OF_TIP = "tip", "separ", "indent", "penetr", "sep "
#: Names of columns that label parts of one record.
_OF_ONE = "cycle", "loop", "segment", "step", "zyklus", "zyklen", "schritt", "phase"
#: Largest force (N) of an instrument with a cantilever.
_SMALL = 1e-5
#: Largest number of pairs to match by common words in their names.
_MOST = 100
#: Beginnings of words that scale or change the unit next to them.
_SCALING = (
    "pico", "piko", "nano", "micro", "mikro", "milli", "kilo", "mega", "deca", "deci", "tenth", "hundred",
    "thousand", "million", "log", "sqrt", "squared", "normali", "scaled", "half", "div", "double", "twice",
)  # fmt: skip


def columns(table, stiffness=None):
    """Return `columns=` with depth (or piezo), force and time; a list for several such pairs; or {}."""
    found, used = {}, set()
    for each in ("force", "depth", "time"):
        scores = {k: _score(each, table, k) for k in table.heads if k not in used}
        found[each] = _best(scores, 6 if each == "time" else 2, each == "time")
        used |= {*found[each]}
    if not found["depth"] or not found["force"]:
        return {}
    layouts, pairs = [], _paired(table, found["depth"], found["force"])
    for d, f in pairs:
        layout = {_called(table, d, f, stiffness): (d, _unit(table, d, "depth"))}
        layout["force"] = f, _unit(table, f, "force")
        time = max((t for t in found["time"] if t < d), default=next(iter(found["time"]), None))
        if len(found["time"]) == len(pairs):
            time = sorted(found["time"])[sorted(pairs).index((d, f))]
        if time is not None and _unit(table, time, "time") != "?":
            layout["time"] = time, _unit(table, time, "time")
        layouts.append(layout)
    return layouts if len(layouts) > 1 else layouts[0]


def whole(table, given):
    """Return a suggestion with the columns found by `columns`, and `by` for parts or for several curves."""
    if not given or scatters(table, given):
        return {}
    if isinstance(given, list):
        return {"columns": given} | ({"by": "segments"} if continues_beside(table, given) else {})
    rows = restarts(table.values[place_of(given)])
    return {"columns": given} | ({"by": by(table, given, rows)} if rows else {})


def scatters(table, given):
    """Whether depth and force of likely columns are scattered, like results of tests."""
    if not given or isinstance(given, list):
        return False
    return not is_path(table.values[place_of(given)], table.values[given["force"][0]])


def by(table, given, rows):
    """Return the value of `by=` that separates curves with the given first rows."""
    known = key_columns(table, given, rows)
    heads = {int(key.split()[0]) - 1: key.partition(" ")[2] for key in table.words} | table.heads
    of_curves = [
        each for each in known
        if isinstance(each, list) or not any(word in heads[each].lower() for word in _OF_ONE)
    ]  # fmt: skip
    if of_curves:
        return of_curves[0]
    if known:
        return "whole"
    return "gaps" if at_gaps(table, rows) else "restart"


def scaled(head):
    """Whether a number or a prefix in a header may scale its unit, unlike a number in a name, "Test 2"."""
    words = _words(head)
    if any(_scales(word) or (word.lower().startswith(_SCALING) and not unit_alone(word)) for word in words):
        return True
    if any(a in "nµukp" and unit_alone(b) for a, b in pairwise(words[1:])):
        # "Depth (n m)"
        return True
    # "Force (m N)", "Depth (nm) [µm]": two units.
    return len({unit for word in words[1:] if word != "h" and (unit := unit_alone(word))}) > 1


def _scales(word):
    name = word.rstrip("0123456789")
    number = word[len(name) :]
    if not any(map(str.isdigit, word)):
        # "kForce (N)"
        return len(word) > 3 and word[0] in "pnµumkM" and word[1].isupper() and word[2].islower()
    of_a_name = (not name or name.isalpha()) and len(number) < 3
    return not of_a_name or word == "10" or name.lower() in ("x", "e", "div")


def _words(head):
    for each in "_,:;()[]{}<>":
        head = head.replace(each, " ")
    return cleaned(head[:200]).split()


def _unit_in(table, column):
    """Return kind and name of a plain unit anywhere in a header, or empty texts."""
    _, kind, unit = table.parted(column)
    if kind:
        return kind, unit
    words = _words(table.heads[column])
    if len(words) == 2 and len(words[0]) == len(words[1]) == 1:
        # "F_N" may be a symbol.
        return "", ""
    found = [unit_alone(word) for word in words[1:] if word != "h"]
    return next(filter(None, reversed(found)), ("", ""))


def _unit(table, column, each):
    """Return the plain unit of a column if its kind fits the quantity and it is not scaled, else "?"."""
    kind, unit = _unit_in(table, column)
    kinds = {TAKEN[each][0]} | ({"length", "voltage"} if each == "force" else set())
    return unit if kind in kinds and not scaled(table.heads[column]) else "?"


def _score(each, table, column):
    """Return a score of how well a column fits a quantity, 0 if it cannot be this quantity."""
    name, wanted = table.parted(column)[0], TAKEN[each][0]
    kind, low = _unit_in(table, column)[0], cleaned(table.heads[column][:200]).lower()
    deflection = each == "force" and kind in ("length", "voltage") and "defl" in low
    if kind and kind != wanted and not deflection:
        return 0
    first = [word.rstrip("0123456789") for word in normal(low).split()[:1]]
    exact = name.rstrip("0123456789 ") in TAKEN[each][1]
    likely = 3 * (not _LETTERS[each].isdisjoint(first)) + 2 * any(part in low for part in _PARTS[each])
    score = 4 * (kind == wanted) + (6 if exact else likely)
    if each == "depth" and ("defl" in low or "cantilever" in low):
        score -= 3
    other = any(part in low for part in _PARTS["force" if each == "depth" else "depth"])
    score -= 2 * any(part in low.replace("temps", "") for part in _OTHER) + (other and not kind)
    # Next to "Indentation", a displacement belongs to a piezo or to the machine.
    score -= 2 * (name in DISPLACEMENT)
    return max(score, 0)


def _best(scores, least, time):
    """Return the columns with the best scores: all equal ones, or two with nearly equal scores."""
    best = max(scores.values(), default=0)
    near = [k for k, score in scores.items() if score >= max(best - 1, least)]
    near.sort(key=lambda k: (-scores[k], k))
    alike = [k for k in near if scores[k] == best]
    if time or len(alike) == len(near):
        return near
    return alike if len(alike) > 1 or len(near) == 2 else near


def _called(table, depth, force, stiffness):
    """Return "depth" for a likely depth of the tip, or "piezo" for a likely position of a piezo."""
    name, head = table.parted(depth)[0], normal(cleaned(table.heads[depth][:200]))
    if name in TAKEN["depth"][1]:
        return "depth"
    if stiffness is not None:
        # A given stiffness implies a piezo.
        return "piezo"
    if any(part in head for part in _OF_TIP):
        return "depth"
    kind, unit = table.parted(force)[1:]
    if "defl" in table.heads[force].lower() or kind in ("length", "voltage"):
        # Only a cantilever has a deflection.
        return "piezo"
    loads = np.abs(table.values[force])
    largest = np.nanmax(loads) if np.isfinite(loads).any() else 0.0
    words = head.split()
    place = any(part in words or (len(part) > 2 and part in head) for part in _POSITION)
    return "piezo" if place and largest * (size_of(unit) if unit else 1.0) < _SMALL else "depth"


def _paired(table, depths, forces):
    """Return pairs of a depth and a force, matched by common words in their names, or else by order."""
    if len(depths) == len(forces) > _MOST:
        return list(zip(depths, forces, strict=True))
    if len(depths) == len(forces):
        names = {k: set(normal(table.heads[k]).replace("h ", " ").split()) for k in (*depths, *forces)}
        pairs, left = [], list(forces)
        for d, f in zip(depths, forces, strict=True):
            best = max(left, key=lambda k, d=d, f=f: (len(names[d] & names[k]), k == f))
            pairs.append((d, best))
            left.remove(best)
        return pairs
    if len(depths) == 1:
        stems = {normal(table.heads[f]).translate(str.maketrans("", "", "0123456789")) for f in forces}
        return [(depths[0], f) for f in (forces if len(stems) == 1 else forces[:1])]
    return [(depths[0], forces[0])]
