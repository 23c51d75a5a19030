"""The columns of a plain table: taken by their exact names, told by `columns=`, or asked for."""

import numpy as np

from ...base import check
from ...base.remark import Remark, Remedy
from . import guess
from .names import DISPLACEMENT, TAKEN, is_result, is_variant
from .question import NoCurve, UnknownColumns
from .split import has_path, is_path, place_of, several
from .units import COLUMN_UNITS, size_of, unit_named

#: Sizes of the units of each quantity (SI); a minus turns the sign of a column.
SIZES = {
    each: COLUMN_UNITS[kind] | {f"−{unit}": -size for unit, size in COLUMN_UNITS[kind].items()}
    for each, kind in {"depth": "length", "force": "force", "time": "time"}.items()
}
#: Kinds of the units that each quantity may be told in; a force may be a deflection of a cantilever.
_KINDS = {
    "depth": ("length",), "piezo": ("length",), "force": ("force", "length", "voltage"), "time": ("time",),
    "stiffness": ("stiffness",),
}  # fmt: skip
_USUAL = {"depth": "nm", "piezo": "nm", "force": "mN", "time": "s", "stiffness": "N/m"}
#: Largest force (N) below which a displacement may be that of a piezo.
_SMALL = 1e-5


def taken(table, file, given, stiffness=None):
    """Columns and units of a table that says plainly what they are; else the question is raised.

    `given` are those that are told; `stiffness` is that of a cantilever, if one is given.
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
            why += " Depth and force go to and fro: a table of results is no curve"
        # Of a table that may be one of results nothing is suggested.
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
    """Numbers and units of columns that are told by their names or numbers, None for those left out."""
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
    """Time and stiffness that have exact names, beside columns that are told."""
    found = _exact(table, {})
    return {
        each: (found[each][0], table.unit(found[each][0]))
        for each in ("time", "stiffness")
        if each not in columns and len(found[each]) == 1
    }


def time_left_out(table, columns):
    """A remark on columns that may be the time of a curve without one, if there are any."""
    used = [column[0] for column in columns.values() if column]
    heads = [
        repr(head)
        for k, head in table.heads.items()
        if k not in used and (table.parted(k)[1] == "time" or table.parted(k)[0] in TAKEN["time"][1])
    ]
    if not heads:
        return ()
    text = f"the curve has no time: the header does not say plainly that {' or '.join(heads)} is it"
    return (Remark(text, "left out", Remedy("give", "columns")),)


def ask_for_parts(table, file, columns):
    """Ask where a table may hold several curves."""
    found = several(table, columns)
    if found:
        why, rows = found
        suggestion = {"columns": columns, "by": guess.by(table, columns, rows)}
        raise UnknownColumns(why, table, file, suggestion, hint=": several curves, or by='whole' for one")


def _exact(table, given):
    """Numbers of the columns whose names and units are taken without asking, by their quantity."""
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
    """What is asked where depth and force have not one exact name each; empty where they have."""
    lacking = [each for each in ("depth", "force") if len(found[each]) != 1]
    several = [each for each in lacking if len(found[each]) > 1]
    if several:
        return f"it has several columns of {' and of '.join(several)}: which belong together?"
    which = " and which the ".join(lacking)
    return f"which column is the {which}? The header does not say it plainly." if lacking else ""


def _second_set(table, found, given):
    """What is asked where there are both another length and another force."""
    others = [
        next((k for k in table.heads if k not in found[each] and table.parted(k)[1] == kind), None)
        for each, kind in (("depth", "length"), ("force", "force"))
    ]
    if None in others or given:
        return ""
    heads = " and ".join(repr(table.heads[k]) for k in others)
    return f"it has a second set of columns, {heads}: which is the curve?"


def _variant(table, found, given):
    """What is asked where another column has one of the names among other words, and its kind of unit."""
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
    """Ask whether a displacement of a small force, or beside a stiffness that is given, is a piezo's."""
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
        f"is {head!r} the depth of the tip, or the position of a piezo, from which the deflection F/k is "
        "subtracted?"
    )
    hint = ' Give it as "depth" or as "piezo", of which spring_constant= (N/m) is needed'
    raise UnknownColumns(why, table, file, _with_by(table, given), hint=hint)


def ask_for_results(table, file, columns):
    """Ask where the rows may be tests, not the samples of one."""
    depth, force = (table.values[k] for k in (place_of(columns), columns["force"][0]))
    others = [head for head in table.heads.values() if is_result(head)]
    path = is_path(depth, force)
    timed = "stiffness" in columns and "time" in columns
    if path and (not others or _falls(force) or timed):
        return
    why = "are the rows samples of one test, or is this a table of results?"
    why += " Depth and force go to and fro." * (not path)
    why += f" It has {others[0]!r}." if others else ""
    raise UnknownColumns(why, table, file, _with_by(table, columns) if path else {}, results=not path)


def _may_be_curve(table):
    """Whether a table without a likely depth and force may yet be a curve."""
    return has_path(table) and not any(map(is_result, table.heads.values()))


def _falls(force):
    """Whether the force rises to a peak and falls again, some samples each."""
    load = np.abs(force[np.isfinite(force)])
    return load.size > 6 and load[-1] < 0.8 * load.max() and 2 < np.argmax(load) < load.size - 3


def _with_by(table, columns):
    """A suggestion of columns, with `by` where the depth starts anew."""
    found = several(table, columns)
    return {"columns": columns} | ({"by": guess.by(table, columns, found[1])} if found else {})


def _merged(suggestion, given):
    """A suggestion with the columns that are told."""
    if not given or not isinstance(suggestion.get("columns", {}), dict):
        return suggestion
    free = {each: column for each, column in suggestion.get("columns", {}).items() if each not in given}
    if {"depth", "piezo"} & given.keys():
        free = {each: column for each, column in free.items() if each not in ("depth", "piezo")}
    return suggestion | {"columns": given | free}


def _one(table, each, column):
    """Number and unit of a column that is told."""
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
        # The header's own unit, where nothing scales it.
        unit = table.unit(numbers[0])
    allowed = [name for kind in _KINDS[each] for name in COLUMN_UNITS[kind]]
    if len(numbers) != 1 or not unit or unit.lstrip("−") not in allowed:
        first = next(iter(table.heads)) if isinstance(which, list | tuple) else which
        raise check.MDRError(
            f"columns: {each} = {column!r:.80} must be the number or the name of one column of "
            f"{table.heads}, and its unit, as in ({first!r}, {_USUAL[each]!r}), out of {', '.join(allowed)}"
        )
    return numbers[0], unit
