"""Tables as CSV, as spreadsheets and `read_curves` open them."""

import csv
import re
from collections.abc import Iterable
from io import StringIO
from typing import Any

#: Beginnings of a cell that a spreadsheet takes for a formula, also where it parts cells at ";".
_FORMULA = re.compile(r"(^|[;\t])(?=[=+\-@\t\r])")


def csv_text(header: Iterable[str], rows: Iterable[Iterable[str | float | None]]) -> str:
    """A table below lines of a header, which begin with "# ".

    Numbers have all digits, and None and NaN are empty cells. A text that a spreadsheet would take for a
    formula, as the name of a file "=1+1.csv", has an apostrophe in front; so has one behind a comma of the
    header.

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
        # Quotation marks would take the "#" in, by which a comment is known.
        cells = f"# {line}".rstrip().replace('"', "'").split(",")
        writer.writerow(map(_cell, cells))
    writer.writerows(map(_cell, row) for row in rows)
    return text.getvalue()


def safe_cell(value: Any) -> Any:
    """A text that no spreadsheet takes for a formula; anything else as it is."""
    return _FORMULA.sub(r"\1'", value) if isinstance(value, str) else value


def _cell(value):
    if value is None or value != value:
        return ""
    return safe_cell(value) if isinstance(value, str) else repr(value)
