"""Reading of numbers in text: decimal points and commas, and separated thousands."""

import re
from contextlib import suppress
from itertools import zip_longest
from math import nan

from ...base.errors import MDRError

_GROUPS = r"[-+]?\d{1,3}(?:%s\d{3})+"
_EXPONENT = r"(?:[eE][-+]?\d+)?"
_DECIMAL_COMMA = re.compile(rf"[-+]?\d*,\d+{_EXPONENT}")
_DECIMAL_POINT = re.compile(rf"[-+]?\d*\.\d*{_EXPONENT}")
_COMMAS = re.compile(_GROUPS % "," + rf"(\.\d+)?{_EXPONENT}")
_POINTS = re.compile(_GROUPS % r"\." + rf"(,\d+)?{_EXPONENT}")
#: Thousands separated by a blank or an apostrophe, with either decimal sign.
_PARTED = re.compile(_GROUPS % "[ \u00a0\u2009\u202f'’]" + rf"([.,]\d*)?{_EXPONENT}")
_NUMERIC = re.compile(r"[-+−]?[\d.,][\d.,' \u00a0\u2009\u202f’]*(?:[eE][-+−]?\d+)?")


#: Numbers of this size and larger are placeholders of missing values, for example 1.8e308.
_NONE = 1e30
#: Approximate number of rows that determine the notation of numbers.
_ENOUGH = 5000


class _Ambiguous(Exception):
    """Error for a comma that may be a decimal sign, or separate thousands."""


def numeric(cell):
    """Whether a cell may be a number in some notation."""
    return bool(_NUMERIC.fullmatch(cell.strip()))


def with_comma(cell):
    """Whether a cell is a number with a comma as decimal sign or between thousands."""
    return "," in cell and bool(
        _DECIMAL_COMMA.fullmatch(cell) or _COMMAS.fullmatch(cell) or _POINTS.fullmatch(cell)
    )


def number_reader(rows, count, name):
    """Return a function that converts a cell to its number, NaN for words, in the notation of a file.

    `rows(step)` returns the cells of every step-th of the `count` rows.

    A comma is a decimal sign or separates thousands: "1,5" and "0,500" imply the first, "1,234.5" and
    "1,234,567" the second. Raises MDRError if no number determines the notation.
    """
    few = count // _ENOUGH + 1
    if not any("," in cell for row in rows() for cell in row):
        _refuse_doubtful_points(rows(few), name)
        return _plain
    # Look at a part of a long file first, then at all of it.
    for step in dict.fromkeys((few, 1)):
        cells = {cell for row in rows(step) if _is_row(row) for cell in row}
        with suppress(_Ambiguous):
            return _reader(cells, name)
    raise MDRError(
        f"{name}: the comma of {min(filter(with_comma, cells))!r} may be a decimal sign, or separate "
        "thousands: write numbers without separators of thousands, and with decimal points"
    )


def _refuse_doubtful_points(rows, name):
    """Raise MDRError for a column of "1.234" and "17".

    Either the point separates thousands, or "17" has lost its decimals.
    """
    for column in zip_longest(*filter(_is_row, rows), fillvalue=""):
        cells = {cell.strip() for cell in column}
        points = {cell for cell in cells if "." in cell and numeric(cell)}
        whole = any(cell.strip("+-0").isdecimal() for cell in cells if cell not in points)
        if points and whole and all(_POINTS.fullmatch(c) and c.lstrip("+-")[0] != "0" for c in points):
            raise MDRError(
                f"{name}: the point of {min(points)!r} may be a decimal sign, or separate thousands, as "
                "all points of its column have three digits behind them: write numbers without separators "
                "of thousands"
            )


def _is_row(row):
    """Whether at least half of the cells with content may be numbers."""
    return 2 * sum(map(numeric, row)) >= sum(map(bool, row))


def _reader(cells, name):
    """Return the function of `number_reader` for the cells of rows."""
    commas = {cell for cell in cells if "," in cell and with_comma(cell)}
    if not commas:
        return _plain
    parted = {cell for cell in commas if _POINTS.fullmatch(cell) and "," in cell and "." in cell}
    decimal = {cell for cell in commas if _DECIMAL_COMMA.fullmatch(cell) and not _thousands(cell)} | parted
    thousands = {
        cell for cell in commas if _COMMAS.fullmatch(cell) and (cell.count(",") > 1 or "." in cell)
    }
    points = {cell for cell in cells if "." in cell and _DECIMAL_POINT.fullmatch(cell)}
    if decimal and thousands:
        raise MDRError(
            f"{name}: in {min(decimal)!r} a comma is the decimal sign, in {min(thousands)!r} it separates "
            "thousands: write all numbers in one notation"
        )
    if decimal:
        if parted:
            return lambda cell: _plain(cell.replace(".", "").replace(",", "."))
        doubtful = [cell for cell in points if _POINTS.fullmatch(cell)]
        if doubtful and len(doubtful) == len(points):
            raise MDRError(
                f"{name}: {min(decimal)!r} has a decimal comma, so {min(doubtful)!r} may be a thousand "
                "times larger: write numbers without separators of thousands"
            )
        return lambda cell: _plain(cell.replace(",", "."))
    if thousands or points:
        return lambda cell: _plain(cell.replace(",", "") if _COMMAS.fullmatch(cell) else cell)
    # All commas have three digits behind them: with fixed decimals, every number would have a comma.
    if any(re.fullmatch(r"[-+]?\d+", cell) and cell.strip("+-0") for cell in cells):
        raise _Ambiguous
    return lambda cell: _plain(cell.replace(",", "."))


def _thousands(cell):
    """Whether a comma may separate thousands, as in "1,234" but not in "0,234"."""
    return bool(_COMMAS.fullmatch(cell)) and not re.match(r"[-+]?0", cell)


def _plain(cell):
    value = _float(cell)
    return value if abs(value) < _NONE else nan


def _float(cell):
    try:
        return float(cell)
    except ValueError:
        pass
    if _PARTED.fullmatch(cell):
        cell = re.sub("[ \u00a0\u2009\u202f'’]", "", cell)
    try:
        return float(cell.replace("−", "-"))
    except ValueError:
        return nan
