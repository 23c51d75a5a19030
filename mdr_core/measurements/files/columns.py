"""Columns of a table, from exact names or from `columns=`; otherwise `UnknownColumns` asks for them."""

import numpy as np

from ...base import check
from ...base.remark import Remark, Remedy
from . import guess
from .names import DISPLACEMENT, TAKEN, is_result, is_variant
from .question import NoCurve, UnknownColumns
from .split import has_path, is_path, place_of, several
from .units import COLUMN_UNITS, size_of, unit_named

#: Sizes (SI) of the units of each quantity; a minus reverses the sign of a column.
SIZES = {
    each: COLUMN_UNITS[kind] | {f"−{unit}": -size for unit, size in COLUMN_UNITS[kind].items()}
    for each, kind in {"depth": "length", "force": "force", "time": "time"}.items()
}
#: Kinds of units that each quantity accepts; a force may be the deflection of a cantilever.
_KINDS = {
    "depth": ("length",), "piezo": ("length",), "force": ("force", "length", "voltage"), "time": ("time",),
    "stiffness": ("stiffness",),
}  # fmt: skip
_USUAL = {"depth": "nm", "piezo": "nm", "force": "mN", "time": "s", "stiffness": "N/m"}
#: Below this largest force (N) a displacement may be the position of a piezo.
_SMALL = 1e-5


def taken(table, file, given, stiffness=None):
    """Return the columns and units of an unambiguous table; otherwise raise `UnknownColumns`.

    `given` has the columns from the user, and `stiffness` is the given stiffness of a cantilever, if any.
    """
    if len(table.heads) < 2:
        raise NoCurve(f"{file} has one column of numbers: give one of depth and one of force")
    found = _exact(table, given)
    why = _lacking(found) or _second_set(table, found, given)
    if why:
        likely = guess.columns(table, stiffness)
        suggestion = guess.whole(table, likely)
        results = guess.scatters(table, likely) if likely else not _may_be_curve(table)
        if results and likely:
            why += " Depth and force are scattered: a table of results is not a curve"
        # A table that may contain results gets no suggestion.
        suggestion = {} if results else _merged(suggestion, given)
        raise UnknownColumns(why, table, file, suggestion, results=results)
    columns = given | {
        each: (k[0], table.unit(k[0])) for each, k in found.items() if len(k) == 1 and each not in given
    }
    if "piezo" in given:
        columns.pop("depth")
    columns = {each: column for each, column in columns.items() if column}
    why = _variant(table, found, given)
    if why:
        raise UnknownColumns(why, table, file, _with_by(table, columns))
    if not {"depth", "piezo"} & given.keys():
        _ask_for_piezo(table, file, columns, stiffness)
    return columns


def told(table, file, columns):
    """Return numbers and units of columns with given names or numbers, None for omitted columns."""
    if not isinstance(columns, dict):
        raise check.MDRError(
            f'columns = {columns!r:.80} must be like {{"depth": (0, "nm"), "force": (1, "mN")}}'
        )
    if {"depth", "piezo"} <= columns.keys():
        raise check.MDRError('columns: give "depth", or "piezo" for the position of a piezo, not both')
    found = {each: _one(table, each, column) for each, column in columns.items()}
    used = [column[0] for column in found.values() if column]
    twice = next((k for k in used if used.count(k) > 1), None)
    if twice is not None:
        raise check.MDRError(f"columns = {columns!r:.200} of {file}: column {twice} is given twice")
    return found


def exact_columns(table, columns):
    """Return the columns of time and stiffness with exact names that the given columns do not contain."""
    found = _exact(table, {})
    return {
        each: (found[each][0], table.unit(found[each][0]))
        for each in ("time", "stiffness")
        if each not in columns and len(found[each]) == 1
    }


def time_left_out(table, columns):
    """Return a remark on columns that may be the missing time of a curve, if there are any."""
    used = [column[0] for column in columns.values() if column]
    heads = [
        repr(head)
        for k, head in table.heads.items()
        if k not in used and (table.parted(k)[1] == "time" or table.parted(k)[0] in TAKEN["time"][1])
    ]
    if not heads:
        return ()
    text = f"the curve has no time: the header does not clearly identify {' or '.join(heads)} as the time"
    return (Remark(text, "left out", Remedy("give", "columns")),)


def ask_for_parts(table, file, columns):
    """Raise `UnknownColumns` if a table may contain several curves."""
    found = several(table, columns)
    if found:
        why, rows = found
        suggestion = {"columns": columns, "by": guess.by(table, columns, rows)}
        raise UnknownColumns(why, table, file, suggestion, hint=": several curves, or by='whole' for one")


def _exact(table, given):
    """Return the numbers of the columns with exact names and units, by quantity."""
    found = {each: [] for each in TAKEN}
    for column in table.heads:
        name, kind, _ = table.parted(column)
        for each, (wanted, names) in TAKEN.items():
            if name in names and kind == wanted:
                found[each].append(column)
    for each, column in given.items():
        found["depth" if each == "piezo" else each] = [column[0]] if column else []
    return found


def _lacking(found):
    """Return the question if depth and force do not have one exact column each, or an empty text."""
    lacking = [each for each in ("depth", "force") if len(found[each]) != 1]
    several = [each for each in lacking if len(found[each]) > 1]
    if several:
        return f"it has several columns of {' and of '.join(several)}: which belong together?"
    which = " and which the ".join(lacking)
    return f"which column is the {which}? The header is not clear." if lacking else ""


def _second_set(table, found, given):
    """Return the question if there are a second length and a second force, or an empty text."""
    others = [
        next((k for k in table.heads if k not in found[each] and table.parted(k)[1] == kind), None)
        for each, kind in (("depth", "length"), ("force", "force"))
    ]
    if None in others or given:
        return ""
    heads = " and ".join(repr(table.heads[k]) for k in others)
    return f"it has a second set of columns, {heads}: which is the curve?"


def _variant(table, found, given):
    """Return the question if another column of the same kind has an exact name among other words, or ""."""
    for each in ("depth", "force"):
        kind = TAKEN[each][0]
        for column in table.heads:
            name, own, _ = table.parted(column)
            told_or_taken = column in found[each] or each in given or (each == "depth" and "piezo" in given)
            if not told_or_taken and own == kind and is_variant(name, each):
                first = table.heads[found[each][0]]
                return f"{first!r}, or {table.heads[column]!r}? Which is the {each}?"
    return ""


def _ask_for_piezo(table, file, columns, stiffness):
    """Raise `UnknownColumns` for a displacement with a small force or a given stiffness: is it a piezo?"""
    place, force = columns["depth"][0], np.abs(table.values[columns["force"][0]])
    name, head = table.parted(place)[0], table.heads[place]
    largest = np.nanmax(force) if np.isfinite(force).any() else 0.0
    small = largest * size_of(columns["force"][1]) < _SMALL
    if name not in DISPLACEMENT or not (small or stiffness is not None):
        return
    given = columns
    if name != "h" or stiffness is not None:
        given = {"piezo" if each == "depth" else each: column for each, column in columns.items()}
    why = (
        f"is {head!r} the depth of the tip, or the position of a piezo, which includes the deflection F/k?"
    )
    hint = ' Give it as "depth", or as "piezo" with spring_constant= (N/m)'
    raise UnknownColumns(why, table, file, _with_by(table, given), hint=hint)


def ask_for_results(table, file, columns):
    """Raise `UnknownColumns` if the rows may be tests, not the samples of one test."""
    depth, force = (table.values[k] for k in (place_of(columns), columns["force"][0]))
    others = [head for head in table.heads.values() if is_result(head)]
    path = is_path(depth, force)
    timed = "stiffness" in columns and "time" in columns
    if path and (not others or _falls(force) or timed):
        return
    why = "are the rows samples of one test, or is this a table of results?"
    why += " Depth and force are scattered." * (not path)
    why += f" It has {others[0]!r}." if others else ""
    raise UnknownColumns(why, table, file, _with_by(table, columns) if path else {}, results=not path)


def _may_be_curve(table):
    """Whether a table without a likely depth and force may still be a curve."""
    return has_path(table) and not any(map(is_result, table.heads.values()))


def _falls(force):
    """Whether the force rises to a peak and falls again, with some samples in each part."""
    load = np.abs(force[np.isfinite(force)])
    return load.size > 6 and load[-1] < 0.8 * load.max() and 2 < np.argmax(load) < load.size - 3


def _with_by(table, columns):
    """Return a suggestion of columns, with `by` if the table may contain several curves."""
    found = several(table, columns)
    return {"columns": columns} | ({"by": guess.by(table, columns, found[1])} if found else {})


def _merged(suggestion, given):
    """Return a suggestion that includes the given columns."""
    if not given or not isinstance(suggestion.get("columns", {}), dict):
        return suggestion
    free = {each: column for each, column in suggestion.get("columns", {}).items() if each not in given}
    if {"depth", "piezo"} & given.keys():
        free = {each: column for each, column in free.items() if each not in ("depth", "piezo")}
    return suggestion | {"columns": given | free}


def _one(table, each, column):
    """Return the number and unit of a given column."""
    check.one_of("a key of columns", each, tuple(_KINDS))
    if column is None:
        return None
    which, unit = column if isinstance(column, tuple | list) and len(column) == 2 else (column, None)
    numbers = [
        k for k, head in table.heads.items()
        if not isinstance(which, bool)
        and which in (k, head, head.removesuffix(table.units.get(k, "")).strip())
    ]  # fmt: skip
    if isinstance(unit, str) and unit:
        unit = ("−" if unit[0] in "−-" else "") + (unit_named(unit.lstrip("−-")) or "?")
    elif unit is None and numbers and not guess.scaled(table.heads[numbers[0]]):
        # Take the unit of the header, unless it is scaled.
        unit = table.unit(numbers[0])
    allowed = [name for kind in _KINDS[each] for name in COLUMN_UNITS[kind]]
    if len(numbers) != 1 or not unit or unit.lstrip("−") not in allowed:
        first = next(iter(table.heads)) if isinstance(which, list | tuple) else which
        raise check.MDRError(
            f"columns: {each} = {column!r:.80} must be the number or the name of one column of "
            f"{table.heads}, and its unit, as in ({first!r}, {_USUAL[each]!r}), from {', '.join(allowed)}"
        )
    return numbers[0], unit
