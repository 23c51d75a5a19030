"""Tables of numbers in text: cells, the rows, and the names above them."""

import csv
import re
from array import array
from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ...base.check import Array
from ...base.errors import MDRError
from .names import normal, parted, symbols_in
from .numbers import number_reader, numeric, with_comma
from .units import cleaned, unit_alone

#: Most characters of a line, and of one that is searched for names and constants; most columns.
_LONGEST_LINE, LONGEST_HEADER, _MOST_COLUMNS = 10_000, 2_000, 1_000
#: Most samples of a table: each needs some 0.2 kB while the table is read.
_MOST_ROWS = 2_000_000
#: Ends of lines, as those of `str.splitlines`.
_ENDS = re.compile("\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]|$")
#: Most lines above the rows in which names are looked for.
_ABOVE = 8
_BRACKETS = " ()[]{}<>/"
#: Words before the names or units of the columns.
_LABELS = {"units", "columns", "names", "fields", "channels"}
#: Units of other quantities, in small letters.
_OTHER_UNITS = {
    "pa", "kpa", "mpa", "gpa", "nm/s", "µm/s", "um/s", "mn/s", "µn/s", "un/s", "1/s", "hz", "khz", "%", "c",
    "°c", "k", "deg", "°", "rad", "j", "nj", "µj", "nm^2", "µm^2", "um^2", "-", "a.u.",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers of a text file, by the number of the column from 0 on.

    `heads` are their names and `values` their numbers, NaN for cells that are none. `lines` are the line
    numbers of the rows, `odd` the text of lines with another number of cells or a cell that is no number,
    by their number. `words` are the cells of the columns that have no numbers in most rows. `units` are the
    cells of a line of units of its own, `header` the lines before the rows, and `gaps` the line numbers of
    empty lines and of words between rows. `name` is that of the sheet, or of one table of several.
    """

    heads: dict[int, str]
    values: dict[int, Array]
    lines: Array
    odd: dict[int, str]
    words: dict[str, list[str]]
    units: dict[int, str] = field(default_factory=dict)
    header: tuple[str, ...] = ()
    gaps: tuple[int, ...] = ()
    name: str = ""

    def parted(self, column):
        """Name of a column, and kind and name of its unit."""
        return self._parted[column]

    @cached_property
    def _parted(self):
        symbols = symbols_in(self.heads.values())
        found = {}
        for column, head in self.heads.items():
            cell = self.units.get(column, "")
            symbol = not cell and head in symbols
            name = head.removesuffix(cell).strip() if cell else head
            found[column] = (normal(head), "", "") if symbol else parted(name, cell)
        return found

    def unit(self, column):
        """Plain unit of a column, as in `COLUMN_UNITS`; else the empty text."""
        return self.parted(column)[2]

    @property
    def key(self):
        """What tables have in common for which the same columns may be told: heads and units."""
        return tuple(self.heads.items()), tuple(self.units.items()), tuple(self.words)

    def rows(self, chosen):
        """The table with some of its rows, a slice or numbers, and the odd lines between them."""
        lines = self.lines[chosen]
        first, last = (lines.min(), lines.max()) if lines.size else (0, -1)
        cells = {key: np.asarray(each)[chosen].tolist() for key, each in self.words.items()}
        return replace(
            self,
            values={k: each[chosen] for k, each in self.values.items()},
            lines=lines,
            odd={number: line for number, line in self.odd.items() if first <= number <= last},
            words=cells,
            gaps=tuple(number for number in self.gaps if first < number < last),
        )

    def few(self, count=3):
        """The heads and the first rows, which are enough to ask what the columns are."""
        return replace(self.rows(slice(0, count)), odd={}, header=self.header[-_ABOVE:])


class _Lines:
    """The lines of a text that are not empty.

    `each` has a column for a line: its number, where it begins and ends in the text, how many cells it has,
    how many of them are empty and how many are numbers, and where they begin in `values`, NaN for words.
    Cells are split anew when they are asked for: kept, they need half a kilobyte a line.
    """

    def __init__(self, text, split, each, values):
        self.text, self.split, self.each, self.values = text, split, each, values
        self.number, self.begin, self.end = each[:3]
        self.cells, empty, self.finite, self.first = each[3:]
        #: How many cells are neither numbers nor empty.
        self.spare = self.cells - empty - self.finite
        #: How many cells a row has; 0 for other lines.
        self.width = np.where((self.finite > 0) & (self.finite >= self.spare), self.cells, 0)

    def __len__(self):
        return self.number.size

    def __getitem__(self, chosen):
        """Some of the lines: a slice, numbers or a mask."""
        return _Lines(self.text, self.split, self.each[:, chosen], self.values)

    def texts(self):
        """Texts of the lines, one after the other."""
        return _parts(self.text, self.begin, self.end)

    def rows(self):
        """Cells of the lines, one line after the other."""
        return map(self.split, self.texts())

    def by_number(self):
        """Texts of the lines by their numbers."""
        return dict(zip(self.number.tolist(), self.texts(), strict=True))


def _parts(text, begin, end):
    """Parts of a text between places, one after the other."""
    # A memory view gives one integer at a time; the list of an array has all at once.
    return map(text.__getitem__, map(slice, memoryview(begin), memoryview(end)))


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


def read_table(text, name, limit=_MOST_ROWS):
    """The table of a text: a header, and rows of numbers separated by commas, semicolons, tabs or blanks.

    Lines that start with # belong to the header, or are comments. More samples than `limit` are refused.
    """
    return _table(_lines(text, name, limit), name, limit)


def read_tables(text, name, limit=_MOST_ROWS):
    """All tables of a text: each begins with a line that has a word for each column."""
    lines = _lines(text, name, limit)
    places, others = np.flatnonzero(lines.width), np.flatnonzero(lines.width == 0)
    whole = np.cumsum((lines.width > 0) & (lines.width == lines.finite))
    starts, before = [0], 0
    for i, line in zip(others.tolist(), lines[others].texts(), strict=True):
        if whole[i] > before + 1:
            k = np.searchsorted(places, i)
            if _is_header(line, *lines.width[places[k - 1 : k + 1]].tolist()):
                # What stands above a header, as a title, is the table's.
                starts, before = [*starts, places[k - 1] + 1], whole[i]
    parts = [lines[a:b] for a, b in zip(starts, [*starts[1:], len(lines)], strict=True)]
    parts = [part for part in parts if part.width.any()] or parts
    tables = [_table(part, name, limit) for part in parts]
    if len(tables) == 1:
        return tables
    return [replace(table, name=f"table {k}") for k, table in enumerate(tables, 1)]


def _is_header(line, *widths):
    """Whether a line between rows has a word for each column, and no numbers."""
    for width in widths:
        cells = [cell for cell in _head_cells(line, width) or () if cell]
        if len(cells) > 1 and not any(map(numeric, cells)):
            return all(any(map(str.isalpha, cell)) for cell in cells)
    return False


def _lines(text, name, limit):
    """`_Lines` of a text."""
    number, begin, end = _places(text, name, limit)
    if not number.size:
        raise MDRError(f"{name} is empty")
    if np.max(end - begin) > _LONGEST_LINE:
        raise MDRError(f"{name}: a line is longer than {_LONGEST_LINE} characters; use one line per sample")

    def texts(step=1):
        return _parts(text, begin[::step], end[::step])

    def split(line):
        if line.lstrip().startswith("#"):
            return []
        return _cells(line) if separator in line else [line.strip()]

    separator = next((s for s in "\t;|" if 2 * sum(s in line for line in texts()) > number.size), "")
    reader = number_reader(lambda step=1: map(split, texts(step)), number.size, name)
    values, counts = array("d"), array("q")
    for row in map(split, texts()):
        values.extend(map(reader, row))
        counts.extend((len(row), row.count("")))
    cells, empty = np.reshape(counts, (-1, 2)).T
    values, after = np.array(values), np.cumsum(cells)
    finite = np.append(0, np.cumsum(np.isfinite(values)))
    first = after - cells
    each = [number, begin, end, cells, empty, finite[after] - finite[first], first]
    each = np.array(each, "i4" if len(text) < 2**31 else "i8")
    return _Lines(text, split, each, values)


def _places(text, name, limit):
    """Number, begin and end of each line that is not empty."""
    found, begin, most = array("q"), 0, 2 * limit
    # The usual ends are counted at once.
    if max(text.count("\n"), text.count("\r")) > most:
        raise _too_many(name, limit)
    for number, match in enumerate(_ENDS.finditer(text), 1):
        if number > most:
            raise _too_many(name, limit)
        end = match.start()
        if text[begin:end].strip():
            found.extend((number, begin, end))
        begin = match.end()
    return np.reshape(found, (-1, 3)).T


def _too_many(name, limit):
    return ValueError(f"{name}: more than {limit} samples; give fewer samples")


def _cells(line):
    """Cells of a line, separated by tabs, semicolons or bars, else by blanks or commas."""
    for sign in ("\t", ";", "|"):
        if sign in line:
            return [cell.strip() for cell in line.replace('"', "").strip(" ").split(sign)]
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line.strip()], skipinitialspace=True))]
    cells = line.replace('"', "").split()
    # A comma is a decimal sign where the cells are separated otherwise.
    if "," not in line or (len(cells) > 1 and any(map(with_comma, cells))):
        return cells
    return [cell.strip() for cell in line.replace('"', "").split(",")]


def _head_cells(line, width, open_end=True):
    """Cells of a line of a header, `width` of them, or None; `open_end`: rows end in a separator."""
    line = line.lstrip("#%/ ").rstrip(" ")
    label, found, after = line.partition(":")
    if found and label.strip().lower() in _LABELS:
        line = after
    splits = [_cells(line)]
    if "," in line:
        splits.append([cell.strip() for cell in line.split(",")])
    # Where the rows end in a separator, the header need not; else a name lacks, perhaps the first one.
    splits += [[*cells, ""] for cells in splits[:1] if open_end and ("\t" in line or ";" in line)]
    splits += [cells[:-1] for cells in splits if cells and not cells[-1]]
    if not any(sign in line for sign in "\t;,|"):
        splits.append([cell.strip(' "') for cell in line.replace("  ", "\t").split("\t") if cell.strip()])
        ended = line.replace(")", ")\t").replace("]", "]\t").split("\t")
        splits.append([cell.strip() for cell in ended if cell.strip()])
    return next((cells for cells in splits if len(cells) == width), None)


def _table(lines, name, limit):
    """`Table` of lines."""
    width, first = _begin(lines, name)
    above, below = lines[:first], lines[first:]
    header = list(above.texts())
    rows = _rows(below, width)
    open_end = not any(cells[-1] for cells in rows.rows())
    names, units = _heads(list(above[above.width == 0].texts()), width, open_end)
    if not any(names):
        _refuse_decimal_commas(header, width, f"{name}, line {lines.number[first]}")
    heads = [f"{name} {unit}".strip() for name, unit in zip(names, units, strict=True)]
    if len(rows) > limit:
        raise _too_many(name, limit)
    values = rows.values[rows.first[:, None] + np.arange(width)]
    known = np.isfinite(values)
    numbers = [k for k in range(width) if _has_numbers(known[:, k], k, rows)]
    odd = below[(below.cells > 0) & ~np.isin(below.number, rows.number[known[:, numbers].all(axis=1)])]
    # A row of numbers before the rows, after which the header goes on.
    early = above[(above.width == width) & (above.finite == width)]
    begin, end = rows.number[[0, -1]]
    return Table(
        {k: heads[k] for k in numbers}, {k: values[:, k] for k in numbers}, rows.number,
        early.by_number() | odd.by_number(),
        {
            f"{k + 1} {heads[k]}": [cells[k] for cells in rows.rows()]
            for k in range(width) if k not in numbers
        },
        {k: units[k] for k in numbers if units[k]}, tuple(header),
        tuple(np.setdiff1d(np.arange(begin, end), rows.number).tolist()),
    )  # fmt: skip


def _begin(lines, name):
    """Number of columns of the rows, and the place of the first row."""
    if not lines.width.any():
        raise MDRError(f"{name}: no samples; expected rows of numbers")
    width = _most_common(lines.width[lines.width > 0])
    if width > _MOST_COLUMNS:
        raise MDRError(f"{name} has {width} columns: at most {_MOST_COLUMNS} are read")
    # Lines of a header, as "Depth limit, 200", have fewer numbers than rows.
    some = lines.width == width
    whole = some & (lines.finite >= _most_common(lines.finite[some]))
    # Two rows that follow each other, but for comments.
    kept = np.flatnonzero(lines.cells)
    for good in (whole, some):
        pairs = kept[:-1][good[kept[:-1]] & good[kept[1:]]]
        if pairs.size:
            return width, pairs[0]
    return width, np.argmax(some)


def _rows(lines, width):
    """Lines that are rows: of the usual number of cells, and not words with a number, as "Test 2"."""
    rows = lines[(lines.cells == width) & (lines.finite > 0)]
    usual = _most_common(rows.finite)
    words = _most_common(rows.spare[rows.finite == usual])
    return rows[(2 * rows.finite > usual) | (rows.spare <= words)]


def _most_common(numbers):
    """The most frequent number, of several the first."""
    return Counter(numbers.tolist()).most_common(1)[0][0]


def _has_numbers(known, column, lines):
    """Whether half of the cells of a column are numbers, or all that are not empty."""
    count = np.count_nonzero(known)
    return 2 * count >= known.size or (
        count > 1 and count == sum(bool(cells[column]) for cells in lines.rows())
    )


def _heads(header, width, open_end):
    """Names of the columns, and their units in a line of its own: the lines nearest to the rows."""
    near = []
    for line in [line for line in header if any(map(str.isalpha, line))][: -_ABOVE - 1 : -1]:
        cells = _head_cells(line, width, open_end)
        if cells is not None and 2 * sum(map(numeric, cells)) <= sum(map(bool, cells)):
            near.append(cells)
    nothing = [""] * width
    units = next((i for i, cells in enumerate(near) if _are_units(cells)), None)
    if units is None:
        return (near[0] if near else nothing), nothing
    # Names stand above their units; below them where there is nothing above.
    names = near[units + 1] if units + 1 < len(near) else near[units - 1] if units else nothing
    return names, near[units]


def _are_units(cells):
    """Whether most cells of a line are units, one of them of more than a letter; or all are."""
    cells = [cleaned(cell[:80]).strip(_BRACKETS) for cell in cells]
    cells = [cell for cell in cells if cell]
    units = [cell for cell in cells if unit_alone(cell) or cell.lower() in _OTHER_UNITS]
    longer = any(len(cell) > 1 for cell in units) and 2 * len(units) >= len(cells)
    return longer or 1 < len(units) == len(cells)


def _refuse_decimal_commas(header, width, place):
    """Refuse rows that have more cells than the header has names with units, as "1,5,2,3" has."""
    line = header[-1] if header else ""
    count = sum(bool(parted(cell.strip())[2]) for cell in line[:LONGEST_HEADER].split(","))
    if count > 1 and width == 2 * count and count == line.count(",") + 1:
        names = "two" if count == 2 else count
        raise MDRError(
            f"{place}: expected {names} numbers, as the header names {names} units, found {width}; "
            "where commas are decimal ones, separate columns by semicolons"
        )
