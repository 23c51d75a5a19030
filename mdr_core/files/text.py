"""Tables of numbers in text files: lines, cells, the header, and several tables in one text."""

import csv
import re
from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from math import isfinite

import numpy as np

from .._check import Array
from . import words
from .headers import unit_of
from .numbers import number_reader, numeric, with_comma
from .units import Unit, cleaned

#: Largest number of characters of a line.
_LONGEST_LINE = 10_000
# An opening bracket ends the one before it: a line of brackets would take quadratic time otherwise.
_BRACKETS = re.compile(r"[(\[]\s*([^(\[)\]\s]+)\s*[)\]]")
#: Lines of a header that have a name before the cells, as "# units: m N s".
_LABELLED = re.compile(r"#*\s*([A-Za-z][\w.-]*):\s+")
#: Cells of a line of units that are none of `COLUMN_UNITS`.
_OTHER_UNITS = re.compile(
    r"[kMG]?Pa|deg|°|°?C|K|k?Hz|%|-|a\.?u\.?|[nµmp]?A|rad|[nµm]?J|[nµm]?m\^[23]|[\wµ²³^-]{1,4}(/[\wµ²³^-]{1,4})+|\W*"
)
#: A title between rows, as "Test 2" or "# Messung Nr. 3".
_TITLE = re.compile(
    rf"[#*=\-\s]*(?:{words.SAMPLES})[\s_:.#=-]*(?:no|nr|number|n°|№)?[\s_:.#=-]*(\d+)\b[^\d;,\t]{{0,40}}",
    re.I,
)
#: Lines of a header that name a segment, and its number.
_SEGMENT = re.compile(
    r"#+\s*segment:\s*(\S+)|#*\s*((?:approach|extend|retract|withdraw|load|unload|hold|pause)(?:ing|al)?)\s*:?\s*$",
    re.I,
)
#: Segments with which a curve begins.
_FIRST = re.compile("approach|extend|load", re.I)
_INDEX = re.compile(r"#+\s*segmentIndex:\s*(\d+)", re.I)


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers of a text file, by the number of the column from 0 on.

    `heads` are their names and `values` their numbers, NaN for cells that are none. `lines` are the line
    numbers of the rows, `odd` the text of lines with another number of cells or a cell that is no number,
    by their number. `words` are the cells of the columns that have no numbers in most rows. `units` are the
    cells of a line of units of its own, and `header` the lines before the rows.
    """

    heads: dict[int, str]
    values: dict[int, Array]
    lines: Array
    odd: dict[int, str]
    words: dict[str, list[str]]
    units: dict[int, str] = field(default_factory=dict)
    header: tuple[str, ...] = ()

    def unit_of(self, column: int) -> Unit:
        """Unit of a column by the header."""
        cell = self.units.get(column, "")
        head = self.heads[column]
        return unit_of(head.removesuffix(cell).strip() if cell else head, cell)

    def unit(self, column: int) -> str:
        """Known unit of a column, as in `COLUMN_UNITS`; else the empty text."""
        unit = self.unit_of(column)
        return "" if unit.doubt else unit.name


class _Line:
    """A line of a text: its number, its cells and their numbers, and how many are finite.

    `width` is the number of cells of a row: half of those that are not empty are numbers; else 0.
    """

    __slots__ = "cells", "finite", "number", "text", "values", "width"

    def __init__(self, number, text, cells, values):
        self.number, self.text, self.cells, self.values = number, text, cells, values
        self.finite = sum(map(isfinite, values))
        row = self.finite and 2 * self.finite >= len(cells) - cells.count("")
        self.width = len(cells) if row and (text[0] in "0123456789-+." or not is_title(text)) else 0


def is_title(line):
    """Whether a line numbers a sample, as "Test 2"."""
    return bool(_TITLE.fullmatch(line.strip()))


def decoded(data):
    """Text of the bytes of a file in UTF-8, UTF-16 or Windows-1252."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    if b"\0" in data[:2]:
        return data.decode("utf-16-be" if data[0] == 0 else "utf-16-le", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def read_table(text, name, limit=10**7):
    """`Table` of a text: a header, and rows of numbers separated by commas, semicolons, tabs or blanks.

    Lines that start with # belong to the header, or are comments. More samples than `limit` are refused.
    """
    return _table(_lines(text, name, limit), name, limit)


def read_tables(text, name, limit=10**7):
    """All tables of a text, with their titles: each has a header or a title of its own, like "Test 2".

    Segments of one curve, which the text names, are one table.
    """
    parts = _parts(_lines(text, name, limit))
    tables = []
    for title, lines in parts:
        before = tables[-1][1] if tables else None
        # Lines after the last table, as of a summary, may be no rows.
        if before is not None and not any(line.width for line in lines):
            before.odd.update({line.number: line.text for line in lines if line.cells})
            continue
        table = _table(lines, name, limit, before)
        if before is not None and _continues(before, table):
            tables[-1] = tables[-1][0], _joined(before, table)
        else:
            tables.append((title, table))
    return [(title, _with_segments(table)) for title, table in tables]


def _lines(text, name, limit):
    """Lines of a text that are not empty."""
    lines = [pair for pair in enumerate(text.splitlines()[: 2 * limit], 1) if pair[1].strip()]
    if not lines:
        raise ValueError(f"{name} is empty")
    if any(len(line) > _LONGEST_LINE for _, line in lines):
        raise ValueError(
            f"{name}: a line is longer than {_LONGEST_LINE} characters; use one line per sample"
        )
    cells = [[] if line.startswith("#") else _cells(line) for _, line in lines]
    number = number_reader(cells, name)
    return [
        _Line(i, line, row, [number(cell) for cell in row])
        for (i, line), row in zip(lines, cells, strict=True)
    ]


def _cells(line):
    """Cells of a line, separated by semicolons or tabs, else by blanks or commas."""
    if ";" in line or "\t" in line:
        return re.split(r" *[;\t] *", line.replace('"', "").strip(" "))
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line.strip()], skipinitialspace=True))]
    cells = line.replace('"', "").split()
    # A comma is a decimal sign where the cells are separated otherwise.
    if "," not in line or (len(cells) > 1 and any(map(with_comma, cells))):
        return cells
    return [cell.strip() for cell in line.replace('"', "").split(",")]


def _table(lines, name, limit, before=None):
    """`Table` of lines; without names of its own it has those of the table `before`."""
    counts = [line.width for line in lines]
    if not any(counts):
        raise ValueError(f"{name}: no samples; expected rows of numbers")
    width = Counter(filter(None, counts)).most_common(1)[0][0]
    # Lines of a header, as "Depth limit, 200", have fewer numbers than rows.
    finite = [line.finite for line in lines]
    usual = Counter(finite[i] for i, count in enumerate(counts) if count == width).most_common(1)[0][0]
    pairs = list(pairwise([i for i, line in enumerate(lines) if line.cells]))
    whole = (i for i, j in pairs if counts[i] == counts[j] == width and min(finite[i], finite[j]) >= usual)
    first = next(whole, next((i for i, j in pairs if counts[i] == counts[j] == width), counts.index(width)))
    header = [line.text for line in lines[:first]]
    names, units = _heads(header, width, f"{name}, line {lines[first].number}")
    if not any(names) and before is not None and set(before.heads) <= set(range(width)):
        names = [
            before.heads.get(k, "").removesuffix(before.units.get(k, "")).strip() for k in range(width)
        ]
        units = units if any(units) else [before.units.get(k, "") for k in range(width)]
    heads = [f"{name} {unit}".strip() for name, unit in zip(names, units, strict=True)]
    whole = [line for line in lines[first:] if len(line.cells) == width]
    if len(whole) > limit:
        raise ValueError(f"{name}: more than {limit} samples; give fewer samples")
    values = np.array([line.values for line in whole])
    known = np.isfinite(values)
    numeric = [k for k in range(width) if _has_numbers(known[:, k], k, whole)]
    complete = known[:, numeric].all(axis=1)
    good = {line.number for line, row in zip(whole, complete.tolist(), strict=True) if row}
    # A row of numbers before the rows, after which the header goes on.
    early = {
        line.number: line.text for line in lines[:first] if line.width == width and line.finite == width
    }
    odd = {line.number: line.text for line in lines[first:] if line.cells and line.number not in good}
    return Table(
        {k: heads[k] for k in numeric}, {k: values[:, k] for k in numeric},
        np.array([line.number for line in whole]), early | odd,
        {f"{k + 1} {heads[k]}": [row.cells[k] for row in whole] for k in range(width) if k not in numeric},
        {k: units[k] for k in numeric if units[k]}, tuple(header),
    )  # fmt: skip


def _has_numbers(known, column, lines):
    """Whether half of the cells of a column are numbers, or all that are not empty."""
    count = np.count_nonzero(known)
    return 2 * count >= known.size or (
        count > 1 and count == sum(bool(line.cells[column]) for line in lines)
    )


def _header_cells(line, width):
    """Cells of a line of a header, `width` of them, or None."""
    line = line.strip(" ")
    separator = next((s for s in ";\t," if s in line), None)
    if separator == "," and '"' in line:
        cells = [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    elif separator is None and '"' in line:
        cells = [cell.strip('"') for cell in re.findall(r'"[^"]*"|[^\s"]+', line)]
    else:
        line = line.replace('"', "")
        cells = line.split(separator) if separator else re.split(r"\s{2,}", line)
    # Rows or header may end in a separator.
    splits = [cells, cells[:-1], *[[*cells, ""]] * (separator in (";", "\t"))]
    if separator is None:
        splits += [line.split(), re.findall(r"[^()\[\]]*[(\[][^()\[\]]*[)\]]", line)]
    return next(([cell.strip() for cell in cells] for cells in splits if len(cells) == width), None)


def _heads(header, width, place):
    """Names of the columns and their units in a line of its own: of all lines the one with most words."""
    names, units, named_units = None, None, False
    best = (-1,)
    for line in header:
        if is_title(line):
            continue
        labelled = _LABELLED.match(line)
        cells = _header_cells(re.sub(r"^#+\s*", "", line[labelled.end() :] if labelled else line), width)
        if cells is None and labelled:
            cells = _header_cells(re.sub(r"^#+\s*", "", line), width)
        if cells is None or 2 * sum(map(numeric, cells)) > sum(map(bool, cells)):
            continue
        label = labelled[1].lower() if labelled else ""
        if label == "units" or (not label and _are_units(cells)):
            units, named_units = cells, label == "units"
            continue
        known = sum(words.quantity_of(cell) is not None for cell in cells)
        known += sum(bool(unit_of(cell).kind) for cell in cells)
        rank = label == "columns", label in ("fancynames", "names", "channels"), known
        if rank >= best:
            best, names = rank, cells
            # Units stand below the names, unless they are called so.
            units = units if named_units else None
    if names is None and units is None:
        matches = _BRACKETS.findall(header[-1]) if header else []
        if len(matches) not in (0, 1, width):
            count = "two" if len(matches) == 2 else len(matches)
            raise ValueError(
                f"{place}: expected {count} numbers, as the header names {count} units, found {width}; "
                "where commas are decimal ones, separate columns by semicolons"
            )
        names = matches if len(matches) == width else None
    nothing = [""] * width
    return names or nothing, units or nothing


def _are_units(cells):
    """Whether the cells of a line are units, one of them a known one."""
    cells = [cleaned(cell).strip(" ()[]") for cell in cells]
    kinds = [unit_of("", cell).kind for cell in cells if cell]
    known = sum(kind in ("length", "force", "time", "voltage") for kind in kinds)
    others = sum(bool(_OTHER_UNITS.fullmatch(cell)) for cell in cells if cell)
    doubts = sum(
        bool(
            unit_of("", cell).doubt
            and re.fullmatch(r"[^%()]{1,12}[^\W\d]", cell)
            and not words.quantity_of(cell)
        )
        for cell in cells
    )
    # Of many columns some have units that only their instrument knows.
    return known + doubts > 0 and known + others + doubts >= 0.75 * len(kinds)


def _parts(lines):
    """Titles of the tables of a text and their lines: where a header or a title stands between rows."""
    parts, start, rows, last, title = [], 0, 0, 0, ""
    for i, line in enumerate(lines):
        named = not line.width and is_title(line.text)
        if line.width and (rows or line.finite > 1):
            rows, last = rows + 1, i
        elif rows >= 2 and (named or _is_header(line.text)):
            parts.append((title, lines[start : last + 1]))
            start, rows, title = last + 1, 0, ""
        if named:
            title = line.text.strip(" #*=-")
    return [*parts, (title, lines[start:])]


def _is_header(line):
    """Whether a line between rows names columns of two quantities, or says that it has their names."""
    labelled = _LABELLED.match(line)
    if labelled and labelled[1].lower() in ("columns", "fancynames", "segmentindex"):
        return True
    line = re.sub(r"^#+\s*", "", line)
    cells = _cells(line)
    if len(cells) < 2 or any(map(numeric, filter(None, cells))):
        return False
    pieces = cells if len(cells) > 1 else line.split()
    quantities = {words.quantity_of(cell) for cell in pieces} - {None}
    return len(quantities) >= 2


def _labels(table):
    """Number and name of the segment that the header of a table says."""
    matches = [next(filter(None, map(each.match, table.header)), None) for each in (_INDEX, _SEGMENT)]
    return tuple(next(filter(None, match.groups())) if match else None for match in matches)


def _continues(before, table):
    """Whether a table is the next segment of the one before: the same columns, and a higher number."""
    (index, segment), (last, previous) = _labels(table), _labels(before)
    if segment is None or previous is None or table.heads != before.heads:
        return False
    if index is None or last is None:
        return not _FIRST.match(segment)
    return int(index) > int(last)


def _joined(before, table):
    """Two segments as one table, whose header is that of the last one."""
    first, second = (_with_segments(each) for each in (before, table))
    values = {k: np.append(first.values[k], second.values[k]) for k in first.values}
    labels = {key: first.words[key] + second.words.get(key, []) for key in first.words}
    lines = np.append(first.lines, second.lines)
    return Table(first.heads, values, lines, first.odd | second.odd, labels, first.units, table.header)


def _with_segments(table):
    """A table with the segment that its header names at each row."""
    _, segment = _labels(table)
    key = f"{max(table.heads, default=0) + 2} segment"
    if segment is None or key in table.words:
        return table
    labels = table.words | {key: [segment] * len(table.lines)}
    return Table(table.heads, table.values, table.lines, table.odd, labels, table.units, table.header)
