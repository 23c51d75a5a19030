"""Curves in the sheets of Excel files."""

import warnings
from contextlib import closing
from dataclasses import replace

from ...base.errors import MDRError
from ...show.report import imported
from .packed import is_binary, refuse_large
from .several import curves_of_tables
from .table import read_tables

_SUFFIXES = ".xls", ".xlsx", ".xlsm"
#: Largest number of sheets, and of cells (rows times columns) in a sheet.
_SHEETS, _CELLS = 1_000, 10_000_000


def is_workbook(path):
    """Whether a file is an Excel file: programs of instruments also give the suffix to text."""
    if path.suffix.lower() not in _SUFFIXES:
        return False
    with path.open("rb") as file:
        head = file.read(4096)
    if head.lstrip(b"\xef\xbb\xbf \r\n").startswith(b"<"):
        raise MDRError(
            f"{path.name} is HTML or XML, not an Excel file: open it in a program for spreadsheets, and "
            "save it as .xlsx or as a CSV table"
        )
    return not head.strip() or is_binary(head)


def from_workbook(path, options):
    """Return functions that make the curves of all sheets of an Excel file with depth and force."""
    engine = "xlrd" if path.suffix.lower() == ".xls" else "openpyxl"
    reader = imported(engine, f"reading {path.name}", "openpyxl xlrd")
    refuse_large(path, sheets=_SHEETS)
    tables, refusals = [], []
    for sheet, text in _texts(path, reader, _rows_of_xls if engine == "xlrd" else _rows_of_xlsx):
        try:
            for table in read_tables(text, f"{path.name}, {sheet}"):
                tables.append(replace(table, name=", ".join(filter(None, (sheet, table.name)))))
        except ValueError as error:
            # Sheets of settings have no rows of numbers.
            refusals.append(error)
    if not tables:
        if len(refusals) == 1:
            raise refusals[0]
        raise MDRError(f"{path.name} has no sheet with columns of depth and force and their units")
    return curves_of_tables(tables, path.name, options)


def _texts(path, reader, texts_of):
    """Return the names of the sheets, and their cells as text separated by tabs."""
    try:
        with warnings.catch_warnings():
            # The warnings concern styles and other things without numbers.
            warnings.simplefilter("ignore")
            return [(name, _text(path, name, rows)) for name, rows in texts_of(reader, path)]
    except _TooLarge:
        raise
    except Exception as error:
        # Each package raises different errors for invalid Excel files.
        raise MDRError(f"{path.name} cannot be read as an Excel file: {error}") from error


class _TooLarge(MDRError):
    """Error for a sheet with too many cells."""


def _text(path, name, rows):
    """Return rows of cells as text."""
    lines, width = [], 0
    for row in rows:
        if not row:
            lines.append("")
            continue
        cells = ["" if cell is None else " ".join(str(cell).split()) for cell in row]
        line = "\t".join(cells).rstrip("\t")
        width = max(width, line.count("\t") + 1)
        lines.append(line)
        if line and width * len(lines) > _CELLS:
            raise _TooLarge(
                f"{path.name}, {name}: {len(lines)} rows times {width} columns exceed {_CELLS} cells: "
                "save the columns of the curve as a CSV table"
            )
    # Pad rows that end in empty cells to the common width.
    return "\n".join(line + "\t" * (width - 1 - line.count("\t")) if line else "" for line in lines)


def _rows_of_xlsx(openpyxl, path):
    """Yield the names and rows of the sheets; a chart has no rows."""
    book = openpyxl.load_workbook(path, read_only=True, data_only=True, keep_links=False)
    with closing(book):
        for name in book.sheetnames:
            sheet = book[name]
            if hasattr(sheet, "reset_dimensions"):
                # The size in the file may be wrong.
                sheet.reset_dimensions()
            yield name, sheet.iter_rows(values_only=True) if hasattr(sheet, "iter_rows") else ()


def _rows_of_xls(xlrd, path):
    """Yield the names and rows of the sheets."""
    with xlrd.open_workbook(path) as book:
        for name in book.sheet_names():
            yield name, _rows_of_sheet(book.sheet_by_name(name), name)


def _rows_of_sheet(sheet, name):
    if sheet.nrows * sheet.ncols > _CELLS:
        raise _TooLarge(f"{name}: {sheet.nrows} rows times {sheet.ncols} columns exceed {_CELLS} cells")
    numbers = {1, 2, 3}
    for i in range(sheet.nrows):
        yield [cell.value if cell.ctype in numbers else None for cell in sheet.row(i)]
