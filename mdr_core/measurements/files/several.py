"""Curves of several tables in a text, or in the sheets of a workbook."""

from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np

from ...base.remark import MeasurementError, Remark, Remedy
from .columns import taken, told
from .curve import curve_factory, curves_of
from .formats import format_of
from .question import NoCurve, UnknownColumns
from .split import below, goes_on, known_depths
from .table import read_tables


def curves_of_text(text, file, options):
    """Return functions that make the curves of a text, in a known format or as tables."""
    columns, by, given = options["columns"], options["by"], options["given"]
    known = format_of(text)
    if known and columns is None and by is None:
        # If the text deviates from the format, read it as a table.
        with suppress(LookupError):
            return known.curves(text, file, given)
    tables = read_tables(known.body(text) if hasattr(known, "body") else text, file)
    if len(tables) == 1:
        return curves_of(tables[0], file, columns, by, given)
    if by == "segments" and not isinstance(columns, list | tuple):
        return _of_parts(tables, file, columns, given)
    if by is None and columns is None:
        _ask_for_segments(tables, file, given)
    return curves_of_tables(tables, file, options)


def curves_of_tables(tables, file, options):
    """Return functions that make the curves of tables; a function of an ambiguous table raises the error.

    `columns` and `by` hold for all tables with the headers and units of one table. This is the first table
    with the given column names, or else the table chosen by `_asked`. Tables of results and settings are
    left out, with a remark. Unambiguous tables come first. If there are none, the table chosen by `_asked`
    comes first. Thus an ambiguous table keeps its number after its columns are given.
    """
    columns, by, given = options["columns"], options["by"], options["given"]
    plain = [_tried(table, file, None, None, given) for table in tables]
    found = plain
    if columns is not None or by is not None:
        key = _key_of_told(tables, plain, columns)
        found = [
            _tried(table, file, columns, by, given) if table.key == key else old
            for table, old in zip(tables, plain, strict=True)
        ]
    left, makers, doubtful = [], [], []
    wanted = [not _no_curve(outcome) for outcome in found]
    first = _asked(tables, plain)
    none = not any(isinstance(each, list) for each in plain)
    for i in sorted(range(len(tables)), key=lambda i: none and i != first):
        table, outcome, before = tables[i], found[i], plain[i]
        if isinstance(outcome, list):
            (makers if isinstance(before, list) else doubtful).extend(outcome)
        elif any(wanted) and _no_curve(outcome):
            left.append(Remark(f"{table.name!r} is left out, as it has no curve", "left out"))
        else:
            doubtful.append(partial(_refuse, _for_pasting(outcome, table, tables, first)))
    makers += doubtful
    if all(make.func is _refuse for make in makers):
        makers[0]()
    return [partial(_said, make, tuple(left)) for make in makers] if left else makers


def _tried(table, file, columns, by, given):
    """Return functions that make the curves of a table, or the error of this table."""
    try:
        return curves_of(table, file, columns, by, given)
    except ValueError as error:
        return error


def _no_curve(outcome):
    return isinstance(outcome, NoCurve) or getattr(outcome, "results", False)


def _asked(tables, plain):
    """Return the number of the first ambiguous table, or of the first table with a curve.

    If no table is unambiguous, it is the ambiguous table with a length, a force and the most rows. The
    other tables may describe a motor, for example.
    """

    def rank(i):
        kinds = {tables[i].parted(k)[1] for k in tables[i].heads}
        return len(kinds & {"length", "force"}), len(tables[i].lines)

    asked = [i for i, each in enumerate(plain) if isinstance(each, UnknownColumns) and not each.results]
    if asked and not any(isinstance(each, list) for each in plain):
        return max(asked, key=rank)
    if asked:
        return asked[0]
    return next((i for i, each in enumerate(plain) if not _no_curve(each)), 0)


def _key_of_told(tables, plain, columns):
    """Return the headers and units of the tables to which `columns` and `by` apply."""
    parts = columns if isinstance(columns, list | tuple) else [columns or {}]
    cells = [c for part in parts if isinstance(part, dict) for c in part.values()]
    names = [c[0] if isinstance(c, list | tuple) else c for c in cells]
    for table in tables if any(isinstance(name, str) for name in names) else ():
        # An unknown name belongs to another table.
        with suppress(ValueError):
            for part in parts:
                told(table, "", part)
            return table.key
    return tables[_asked(tables, plain)].key


def _for_pasting(error, table, tables, first):
    """Return an `UnknownColumns` with names of columns, if the numbers would apply to another table."""
    if not isinstance(error, UnknownColumns) or table.key == tables[first].key or not error.suggestion:
        return error

    def named(layout):
        heads = list(table.heads.values())
        own = {
            each: (table.heads[c[0]], c[1]) if c and heads.count(table.heads[c[0]]) == 1 else c
            for each, c in layout.items()
        }
        return own

    columns = error.suggestion["columns"]
    columns = [*map(named, columns)] if isinstance(columns, list) else named(columns)
    return error.elsewhere(error.suggestion | {"columns": columns})


def _refuse(error):
    raise error


def _said(make, left):
    """Make a curve with remarks on the omitted tables."""
    curve = make()
    return replace(curve, remarks=(*curve.remarks, *left))


def _ask_for_segments(tables, file, given):
    """Raise `UnknownColumns` if the depth continues below a further header, as in parts of one curve."""
    same = [table for table in tables if table.key == tables[0].key]
    try:
        layout = taken(tables[0], file, {}, given.get("spring_constant"))
    except ValueError:
        return
    span = np.ptp(known_depths(same, layout))
    if any(goes_on([before], table, layout, span) for before, table in pairwise(same)):
        why = "the depth continues below a second header"
        hint = ": parts of one curve, or by='whole' for several"
        raise UnknownColumns(why, tables[0], file, {"columns": layout, "by": "segments"}, hint=hint)


def _of_parts(tables, file, columns, given):
    """Return functions that make curves from tables, each a part that continues the part before."""
    layout = told(tables[0], file, columns) if columns else taken(tables[0], file, {})
    groups = [[tables[0]]]
    span = np.ptp(known_depths([table for table in tables if table.key == tables[0].key], layout))
    for table in tables[1:]:
        same = table.key == tables[0].key
        if same and goes_on(groups[-1], table, layout, span):
            groups[-1].append(table)
        elif same:
            groups.append([table])
    if all(len(group) == 1 for group in groups):
        text = f"{file} has no parts of a curve: no table continues the table before"
        raise MeasurementError(text, Remedy("give", "by"))
    layout = {each: column for each, column in layout.items() if column}
    label = f"{file}, curve {{}}" if len(groups) > 1 else file
    options = {
        "source": "as told" if columns else "by its header",
        "asked": {"columns": layout, "by": "segments"},
    }
    return [
        curve_factory(replace(below(group), name=""), label.format(i), layout, given, **options)
        for i, group in enumerate(groups, 1)
    ]
