"""Find the columns of depth, force, time and contact stiffness of a table, and their units."""

import re

from .. import _check
from . import words
from .units import COLUMN_UNITS, unit_named

#: Sizes of the units of each quantity (SI); a minus turns the sign of a column.
SIZES = {
    each: COLUMN_UNITS[kind] | {f"−{unit}": -size for unit, size in COLUMN_UNITS[kind].items()}
    for each, kind in {"depth": "length", "force": "force", "time": "time"}.items()
}
#: Units of a deflection, which times the stiffness of the cantilever is a force.
_DEFLECTION = COLUMN_UNITS["length"] | COLUMN_UNITS["voltage"]
_GIVE = 'give columns={"depth": (0, "nm"), "force": (1, "mN")}, numbers and units'
#: Words of the time that are no symbols.
_TIME = re.compile(r"\b(time|\w*zeit|temps|tiempo|tempo)\b|时间")
#: Names of columns of a stiffness that is not that of the contact.
_NO_CONTACT = re.compile(
    r"frame|spring|machine|support|squared|correct|system|cantilever|column|instrument|damping"
)


class NoCurve(ValueError):
    """A table that is none of a curve, but of results or settings."""


class UnknownColumns(ValueError):
    """A table whose header does not tell the columns of depth and force, or their units."""

    def __init__(self, message, table):
        super().__init__(message)
        self.table = table

    @property
    def named(self):
        """Whether the header has words of both: what lacks is a unit that is understood."""
        heads = self.table.heads.values()
        return all(
            any(words.named(each, head) and not words.is_none(each, head) for head in heads)
            for each in ("depth", "force")
        )


def size_of(each, unit):
    """Size (SI) of a unit of a quantity, negative for "−nm"; of a deflection of its length or voltage."""
    if unit in SIZES[each]:
        return SIZES[each][unit]
    return -_DEFLECTION[unit[1:]] if unit.startswith("−") else _DEFLECTION[unit]


def columns_of(table, name, given, cantilever=None):
    """Number and unit of the column of each quantity, None for no time, and remarks on the choice.

    `given` columns are kept; `cantilever` are the names of the arguments that turn a deflection into force.
    """
    free, columns, remarks = dict(table.heads), {}, []
    if len(free) < 2:
        raise NoCurve(f"{name} has one column of numbers: give one of depth and one of force")
    for each in given:
        _check.one_of("a key of columns", each, tuple(SIZES))
        columns[each] = _given(table, each, given[each], free, cantilever)
        free.pop(columns[each] and columns[each][0], None)
    for each in [each for each in ("time", "force", "depth") if each not in columns]:
        column, others = _found(table, each, free)
        if column is None and each == "force":
            column = _deflection(table, name, free, cantilever)
        if column is None and each != "time":
            raise UnknownColumns(_unknown(table, name, each, free), table)
        if each == "time" and column is None:
            remarks += _untimed(table, free)
        taken = column is not None and others
        listed = ", ".join(repr(free[other]) for other in others)
        remarks += [f"{each} is taken from {free[column]!r}, not from {listed}"] if taken else []
        columns[each] = None if column is None else (column, table.unit(column))
        free.pop(column, None)
    return {each: columns[each] for each in SIZES}, remarks


def _found(table, each, free):
    """Number of the column of a quantity, or None, and those of others in its kind of unit."""
    kind = {"depth": "length"}.get(each, each)
    units = {column: table.unit_of(column) for column in free}
    of_kind = [column for column, unit in units.items() if unit.kind == kind]
    if each == "depth":
        of_kind = [column for column in of_kind if words.quantity_of(free[column]) != "deflection"]
    fits = [
        column for column in of_kind if not units[column].doubt and not words.is_none(each, free[column])
    ]
    named = [column for column in fits if words.named(each, free[column])]
    # Other columns that have the name, and a unit that is not understood.
    unclear = [
        column for column, head in free.items()
        if words.named(each, head) and not words.is_none(each, head) and column not in fits
        and (units[column].doubt or not units[column].kind) and not _other_kind(units[column], head)
    ]  # fmt: skip
    if not fits or (unclear and not named):
        return None, []
    best = max(named or fits, key=lambda column: _rank(each, free[column]))
    better = (column for column in unclear if units[column].doubt)
    if any(_rank(each, free[column]) > _rank(each, free[best]) for column in better):
        return None, []
    unnamed = not named and len(fits) > 1
    others = [k for k in free if (k in of_kind or k in unclear) and k != best]
    return (None, []) if unnamed and each == "depth" else (best, others)


def _other_kind(unit, head):
    """Whether the unit of a column is of another kind, as nm/s; one without any unit is not."""
    return not unit.doubt and bool(re.search(r"[(\[].*[/^].*[)\]]|\w/\w|Pa\b", head))


def _rank(each, head):
    """Whether a name is no raw one, says the depth, and is a measured one or of the whole series."""
    name = words.normal(head)
    measured = "measured" in name or "sensor" in name or "strain gauge" in name or "series" in name
    depth = words.says_depth(head) if each == "depth" else 0
    # A displacement and a height may be those of a piezo.
    sure = depth == 2 and not re.search("displ|height|contact", name)
    return "raw" not in name, sure, depth, words.quantity_of(head) == each, measured


def _deflection(table, name, free, cantilever):
    """Number of a column of a deflection (m or V), for which the constants of the cantilever are known."""
    candidates = [k for k, head in free.items() if words.quantity_of(head) == "deflection"
             and not words.is_none("force", head) and table.unit(k) in _DEFLECTION]  # fmt: skip
    if not candidates:
        return None
    # In m no sensitivity is needed.
    best = min(candidates, key=lambda k: table.unit(k) in COLUMN_UNITS["voltage"])
    _need_cantilever(table, name, best, table.unit(best), cantilever)
    return best


def _need_cantilever(table, name, column, unit, cantilever):
    """Refuse a deflection without the constants that turn it into a force."""
    needed = {"spring_constant": "spring_constant= (N/m)"}
    if unit.lstrip("−") in COLUMN_UNITS["voltage"]:
        needed["sensitivity"] = "sensitivity= (m/V)"
    lacking = [text for each, text in needed.items() if each not in (cantilever or ())]
    if lacking:
        raise UnknownColumns(
            f"{name} has no column of force with a unit in its header, but a deflection in {unit}, "
            f"{table.heads[column]!r}: give {' and '.join(lacking)}",
            table,
        )


def _unknown(table, name, each, free):
    """Message on a header that is not understood, and on the columns to give."""
    for column, head in free.items():
        unit = table.unit_of(column)
        if words.named(each, head) and unit.doubt:
            unit_given = "nm" if each == "depth" else "mN"
            return (
                f"{name}: the unit of {each} in {head!r} is not understood: {unit.doubt!r} is not a "
                "unit of this package, or scales a unit. Convert the numbers if need be, and give the "
                f'number of the column and its unit, columns={{"{each}": ({column}, "{unit_given}"), …}}, '
                f"out of {_units(each)}"
            )
    kind = {"depth": "length"}.get(each, each)
    fits = [head for k, head in free.items() if table.unit_of(k).kind == kind]
    several = f"; {', '.join(map(repr, fits))} is not named as the {each}" if fits else ""
    return (
        f"{name} has no column of {each} with a unit in its header, {table.heads}{several}: {_GIVE}; a "
        "deflection is not a force. NT-MDT's files need spring_constant= (N/m) and sensitivity= (m/A)"
    )


def _units(each):
    return ", ".join(unit for unit in SIZES[each] if not unit.startswith("−"))


def _untimed(table, free):
    """A remark on a time whose unit is not understood."""
    for column, head in free.items():
        unit = table.unit_of(column)
        unknown = unit.doubt or not (unit.kind or _other_kind(unit, head))
        if unknown and _TIME.search(words.normal(head)) and not words.is_none("time", head):
            return [
                f'{head!r} has no unit of time and is left out: give columns={{"time": ({column}, "s")}}'
            ]
    return []


def _given(table, each, column, free, cantilever):
    """Number and unit of one of the `free` columns that is given by its name or number."""
    if column is None and each == "time":
        return None
    which, unit = column if isinstance(column, tuple | list) else (column, None)
    number = next((k for k, head in free.items() if which in (k, head)), None)
    if number is None and isinstance(which, str):
        # A name without the unit in a line of its own.
        named = [
            k
            for k, head in free.items()
            if head.removesuffix(table.units.get(k, "")).strip() == which.strip()
        ]
        number = named[0] if len(named) == 1 else None
    if number is not None:
        unit = unit_named(unit) or unit if unit else table.unit(number)
    if number is not None and each == "force" and unit and unit.lstrip("−") in _DEFLECTION:
        _need_cantilever(table, "the table", number, unit, cantilever)
        return number, unit
    if number is None or unit not in SIZES[each]:
        raise ValueError(
            f"columns: {each} = {column!r} must be a number or name of {free}; a column without a unit "
            f"needs one, as in ({which!r}, {list(SIZES[each])[1]!r}), out of {', '.join(SIZES[each])}"
        )
    return number, unit


def stiffness_of(table):
    """Number and size (N/m) of the column of a contact stiffness, or None; "Contact" comes first."""
    candidates = []
    for column, head in table.heads.items():
        unit, name = table.unit_of(column), words.normal(head)
        if unit.kind != "stiffness" or unit.doubt or _NO_CONTACT.search(name):
            continue
        if re.search(r"stiffness|steifigkeit|raideur|rigid|刚度|^s\b|d[fpl] d[hdz]\b", name):
            candidates.append(("contact" in name or "kontakt" in name, -column, unit.size))
    if not candidates:
        return None
    _, column, size = max(candidates)
    return -column, size
