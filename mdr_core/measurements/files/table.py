"""Tables of numbers in text: cells, rows, and the names above them."""

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

#: Largest number of characters of a line, of characters of a header line, and of columns.
_LONGEST_LINE, LONGEST_HEADER, _MOST_COLUMNS = 10_000, 2_000, 1_000
#: Largest number of samples of a table; reading needs about 0.2 kB for each sample.
_MOST_ROWS = 2_000_000
#: Ends of lines, as in `str.splitlines`.
_ENDS = re.compile("\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]|$")
#: Number of lines above the rows to search for names.
_ABOVE = 8
_BRACKETS = " ()[]{}<>/"
#: Words before the names or units of the columns.
_LABELS = {"units", "columns", "names", "fields", "channels"}
#: Units of other quantities, in lower case.
_OTHER_UNITS = {
    "pa", "kpa", "mpa", "gpa", "nm/s", "µm/s", "um/s", "mn/s", "µn/s", "un/s", "1/s", "hz", "khz", "%", "c",
    "°c", "k", "deg", "°", "rad", "j", "nj", "µj", "nm^2", "µm^2", "um^2", "-", "a.u.",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers of a text file, by column number, starting at 0.

    `heads` are the names of the columns and `values` their numbers, NaN for other cells. `lines` are the
    line numbers of the rows. `odd` has the text of irregular lines by line number: another number of cells,
    or a cell without a number. `words` are the cells of columns without numbers in most rows. `units` are
    the cells of a separate line of units, and `header` the lines before the rows. `gaps` are the line
    numbers of empty lines and of words between rows. `name` is the name of the sheet, or of one of several
    tables.
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
        """Return the name of a column, and kind and name of its unit."""
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
        """Return the plain unit of a column, as in `COLUMN_UNITS`, or an empty text."""
        return self.parted(column)[2]

    @property
    def key(self):
        """Headers and units. The same `columns=` applies to tables with equal keys."""
        return tuple(self.heads.items()), tuple(self.units.items()), tuple(self.words)

    def rows(self, chosen):
        """Return the table with the chosen rows, a slice or numbers, and irregular lines between them."""
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
        """Return the headers and the first rows, which an error message needs."""
        return replace(self.rows(slice(0, count)), odd={}, header=self.header[-_ABOVE:])


class _Lines:
    """Lines of a text that are not empty.

    `each` has a column for each line: its number, its begin and end in the text, the numbers of its cells,
    empty cells and cells with numbers, and the index of its first cell in `values`. `values` has NaN for
    words. Cells are split on each access, because storing them would need half a kilobyte per line.
    """

    def __init__(self, text, split, each, values):
        self.text, self.split, self.each, self.values = text, split, each, values
        self.number, self.begin, self.end = each[:3]
        self.cells, empty, self.finite, self.first = each[3:]
        #: Number of cells with words.
        self.spare = self.cells - empty - self.finite
        #: Number of cells of a row; 0 for other lines.
        self.width = np.where((self.finite > 0) & (self.finite >= self.spare), self.cells, 0)

    def __len__(self):
        return self.number.size

    def __getitem__(self, chosen):
        """Return the chosen lines: a slice, numbers or a mask."""
        return _Lines(self.text, self.split, self.each[:, chosen], self.values)

    def texts(self):
        """Return an iterator over the texts of the lines."""
        return _parts(self.text, self.begin, self.end)

    def rows(self):
        """Return an iterator over the cells of each line."""
        return map(self.split, self.texts())

    def by_number(self):
        """Return the texts of the lines by line number."""
        return dict(zip(self.number.tolist(), self.texts(), strict=True))


def _parts(text, begin, end):
    """Return an iterator over the parts of a text between two places."""
    # A memory view makes one integer at a time; a list would hold all integers at once.
    return map(text.__getitem__, map(slice, memoryview(begin), memoryview(end)))


def decoded(data):
    """Decode the bytes of a file in UTF-8, UTF-16 or Windows-1252."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    if b"\0" in data[:2]:
        return data.decode("utf-16-be" if data[0] == 0 else "utf-16-le", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def read_table(text, name, limit=_MOST_ROWS):
    """Return the table of a text: a header, and rows of numbers.

    Commas, semicolons, tabs or blanks separate the numbers. Lines that start with # belong to the header or
    are comments. More samples than `limit` raise ValueError.
    """
    return _table(_lines(text, name, limit), name, limit)


def read_tables(text, name, limit=_MOST_ROWS):
    """Return all tables of a text; each begins with a line that has a word for each column."""
    lines = _lines(text, name, limit)
    places, others = np.flatnonzero(lines.width), np.flatnonzero(lines.width == 0)
    whole = np.cumsum((lines.width > 0) & (lines.width == lines.finite))
    starts, before = [0], 0
    for i, line in zip(others.tolist(), lines[others].texts(), strict=True):
        if whole[i] > before + 1:
            k = np.searchsorted(places, i)
            if _is_header(line, *lines.width[places[k - 1 : k + 1]].tolist()):
                # Lines above a header, such as a title, belong to its table.
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
    """Return the `_Lines` of a text."""
    number, begin, end = _places(text, name, limit)
    if not number.size:
        raise MDRError(f"{name} is empty")
    if np.max(end - begin) > _LONGEST_LINE:
        raise MDRError(f"{name}: a line is longer than {_LONGEST_LINE} characters: use one line per sample")

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
    """Return number, begin and end of each line that is not empty."""
    found, begin, most = array("q"), 0, 2 * limit
    # Counting the usual line ends is fast.
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
    return ValueError(f"{name}: more than {limit} samples: give fewer samples")


def _cells(line):
    """Return the cells of a line, separated by tabs, semicolons or bars, or else by blanks or commas."""
    for sign in ("\t", ";", "|"):
        if sign in line:
            return [cell.strip() for cell in line.replace('"', "").strip(" ").split(sign)]
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line.strip()], skipinitialspace=True))]
    cells = line.replace('"', "").split()
    # A comma is a decimal sign if another sign separates the cells.
    if "," not in line or (len(cells) > 1 and any(map(with_comma, cells))):
        return cells
    return [cell.strip() for cell in line.replace('"', "").split(",")]


def _head_cells(line, width, open_end=True):
    """Return the `width` cells of a header line, or None; with `open_end`, rows end in a separator."""
    line = line.lstrip("#%/ ").rstrip(" ")
    label, found, after = line.partition(":")
    if found and label.strip().lower() in _LABELS:
        line = after
    splits = [_cells(line)]
    if "," in line:
        splits.append([cell.strip() for cell in line.split(",")])
    # If the rows end in a separator, the header may omit it. Otherwise a name is missing, perhaps the
    # first.
    splits += [[*cells, ""] for cells in splits[:1] if open_end and ("\t" in line or ";" in line)]
    splits += [cells[:-1] for cells in splits if cells and not cells[-1]]
    if not any(sign in line for sign in "\t;,|"):
        splits.append([cell.strip(' "') for cell in line.replace("  ", "\t").split("\t") if cell.strip()])
        ended = line.replace(")", ")\t").replace("]", "]\t").split("\t")
        splits.append([cell.strip() for cell in ended if cell.strip()])
    return next((cells for cells in splits if len(cells) == width), None)


def _table(lines, name, limit):
    """Return the `Table` of lines."""
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
    # The header may contain a row of numbers.
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
    """Return the number of columns of the rows, and the place of the first row."""
    if not lines.width.any():
        raise MDRError(f"{name}: no samples; expected rows of numbers")
    width = _most_common(lines.width[lines.width > 0])
    if width > _MOST_COLUMNS:
        raise MDRError(f"{name} has {width} columns: at most {_MOST_COLUMNS} are read")
    # Header lines, such as "Depth limit, 200", have fewer numbers than rows.
    some = lines.width == width
    whole = some & (lines.finite >= _most_common(lines.finite[some]))
    # The first two consecutive rows, apart from comments.
    kept = np.flatnonzero(lines.cells)
    for good in (whole, some):
        pairs = kept[:-1][good[kept[:-1]] & good[kept[1:]]]
        if pairs.size:
            return width, pairs[0]
    return width, np.argmax(some)


def _rows(lines, width):
    """Return the lines that are rows: the usual number of cells, but not words with a number ("Test 2")."""
    rows = lines[(lines.cells == width) & (lines.finite > 0)]
    usual = _most_common(rows.finite)
    words = _most_common(rows.spare[rows.finite == usual])
    return rows[(2 * rows.finite > usual) | (rows.spare <= words)]


def _most_common(numbers):
    """Return the most frequent number, the first of them in a tie."""
    return Counter(numbers.tolist()).most_common(1)[0][0]


def _has_numbers(known, column, lines):
    """Whether at least half of the cells of a column, or all cells with content, are numbers."""
    count = np.count_nonzero(known)
    return 2 * count >= known.size or (
        count > 1 and count == sum(bool(cells[column]) for cells in lines.rows())
    )


def _heads(header, width, open_end):
    """Return the names of the columns, and their units from a separate line, nearest to the rows."""
    near = []
    for line in [line for line in header if any(map(str.isalpha, line))][: -_ABOVE - 1 : -1]:
        cells = _head_cells(line, width, open_end)
        if cells is not None and 2 * sum(map(numeric, cells)) <= sum(map(bool, cells)):
            near.append(cells)
    nothing = [""] * width
    units = next((i for i, cells in enumerate(near) if _are_units(cells)), None)
    if units is None:
        return (near[0] if near else nothing), nothing
    # Names are above their units, or below them if nothing is above.
    names = near[units + 1] if units + 1 < len(near) else near[units - 1] if units else nothing
    return names, near[units]


def _are_units(cells):
    """Whether all cells of a line are units, or most are and a unit has more than one letter."""
    cells = [cleaned(cell[:80]).strip(_BRACKETS) for cell in cells]
    cells = [cell for cell in cells if cell]
    units = [cell for cell in cells if unit_alone(cell) or cell.lower() in _OTHER_UNITS]
    longer = any(len(cell) > 1 for cell in units) and 2 * len(units) >= len(cells)
    return longer or 1 < len(units) == len(cells)


def _refuse_decimal_commas(header, width, place):
    """Raise MDRError for rows with twice as many cells as names with units, such as "1,5,2,3"."""
    line = header[-1] if header else ""
    count = sum(bool(parted(cell.strip())[2]) for cell in line[:LONGEST_HEADER].split(","))
    if count > 1 and width == 2 * count and count == line.count(",") + 1:
        names = "two" if count == 2 else count
        raise MDRError(
            f"{place}: expected {names} numbers, as the header names {names} units, found {width}: "
            "if commas are decimal signs, separate columns by semicolons"
        )
