"""Tables as CSV text for spreadsheets and `read_curves`."""

import csv
import re
from collections.abc import Iterable
from io import StringIO
from typing import Any

#: Beginnings of a cell that a spreadsheet takes for a formula, also if it splits cells at ";".
_FORMULA = re.compile(r"(^|[;\t])(?=[=+\-@\t\r])")


def csv_text(header: Iterable[str], rows: Iterable[Iterable[str | float | None]]) -> str:
    """Return a table as CSV text, below header lines that begin with "# ".

    Numbers have all digits. None and NaN are empty cells. An apostrophe precedes texts that a spreadsheet
    would take for a formula, such as the file name "=1+1.csv", also behind a comma of the header.

    Examples
    --------
    >>> print(csv_text(["curves of a,=1+1.csv"], [["name", "E* (Pa)"], ["=1+1", -2.0]]), end="")
    # curves of a,'=1+1.csv
    name,E* (Pa)
    '=1+1,-2.0
    """
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for line in header:
        # Quotation marks would enclose the "#", which marks a comment.
        cells = f"# {line}".rstrip().replace('"', "'").split(",")
        writer.writerow(map(_cell, cells))
    writer.writerows(map(_cell, row) for row in rows)
    return text.getvalue()


def safe_cell(value: Any) -> Any:
    """Return a text that no spreadsheet takes for a formula, and any other value unchanged."""
    return _FORMULA.sub(r"\1'", value) if isinstance(value, str) else value


def _cell(value):
    if value is None or value != value:
        return ""
    return safe_cell(value) if isinstance(value, str) else repr(value)
