"""Curves of the sheets of Excel files."""

from contextlib import suppress
from dataclasses import replace

from ..show.report import imported
from .packed import refuse_large
from .several import curves_of_tables
from .table import read_tables

#: Most sheets, and most cells (rows times columns) of one.
_SHEETS, _CELLS = 1_000, 10_000_000


def from_workbook(path, options):
    """Functions that make the curves of the sheets of an Excel file that have depth and force."""
    pandas = imported("pandas", f"reading {path.name}", "pandas openpyxl xlrd")
    engine = "xlrd" if path.suffix.lower() == ".xls" else "openpyxl"
    imported(engine, f"reading {path.name}", "openpyxl xlrd")
    refuse_large(path, sheets=_SHEETS)
    tables = []
    for sheet, text in _texts(pandas, path, engine):
        # Sheets of settings have no rows of numbers.
        with suppress(ValueError):
            for table in read_tables(text, f"{path.name}, {sheet}"):
                tables.append(replace(table, name=", ".join(filter(None, (sheet, table.name)))))
    if not tables:
        raise ValueError(f"{path.name} has no sheet with columns of depth and force and their units")
    return curves_of_tables(tables, path.name, options)


def _texts(pandas, path, engine):
    """Names of the sheets, and their cells as text separated by tabs."""
    try:
        with pandas.ExcelFile(path, engine=engine) as file:
            rows_of = _rows_of_xls if engine == "xlrd" else _rows_of_xlsx
            return [(str(name), _text(path, name, rows_of(file.book, name))) for name in file.sheet_names]
    except _TooLarge:
        raise
    except Exception as error:
        # Each engine has errors of its own for what is no Excel file.
        raise ValueError(f"{path.name} cannot be read as an Excel file: {error}") from error


class _TooLarge(ValueError):
    """A sheet with more cells than are read."""


def _text(path, name, rows):
    """Rows of cells as text."""
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
                f"{path.name}, {name}: {len(lines)} rows times {width} columns are more than {_CELLS} "
                "cells; save the columns of the curve as a CSV table"
            )
    # A row that ends in empty cells has as many as the others.
    return "\n".join(line + "\t" * (width - 1 - line.count("\t")) if line else "" for line in lines)


def _rows_of_xlsx(book, name):
    sheet = book[name]
    if hasattr(sheet, "reset_dimensions"):
        # What a file says of its size may be wrong.
        sheet.reset_dimensions()
    return sheet.iter_rows(values_only=True) if hasattr(sheet, "iter_rows") else ()


def _rows_of_xls(book, name):
    sheet = book.sheet_by_name(name)
    if sheet.nrows * sheet.ncols > _CELLS:
        raise _TooLarge(
            f"{name}: {sheet.nrows} rows times {sheet.ncols} columns are more than {_CELLS} cells"
        )
    numbers = {1, 2, 3}
    for i in range(sheet.nrows):
        yield [cell.value if cell.ctype in numbers else None for cell in sheet.row(i)]
