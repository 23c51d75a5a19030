"""Curves of the sheets of Excel files."""

from dataclasses import replace
from functools import partial

from ..show.report import imported
from .columns import NoCurve, UnknownColumns
from .curve import curves_of
from .text import read_tables


def from_workbook(path, options):
    """Functions that make the curves of the sheets of an Excel file that have depth and force."""
    pandas = imported("pandas", f"reading {path.name}", "pandas openpyxl xlrd")
    reader = "xlrd" if path.suffix.lower() == ".xls" else "openpyxl"
    imported(reader, f"reading {path.name}", "openpyxl xlrd")
    try:
        sheets = pandas.read_excel(path, sheet_name=None, header=None)
    except Exception as error:
        # Each engine has errors of its own for what is no Excel file.
        raise ValueError(f"{path.name} cannot be read as an Excel file: {error}") from error
    curves, left = [], []
    for sheet, frame in sheets.items():
        name = f"{path.name}, {sheet}"
        try:
            text = frame.to_csv(sep="\t", header=False, index=False)
            for title, table in read_tables(text, name):
                curves += curves_of(table, f"{name}, {title}" if title else name, sheet, **options)
        except NoCurve as error:
            if "results" in str(error):
                left.append(f"sheet {sheet!r} is left out, a table of results")
        except UnknownColumns as error:
            if error.named:
                left.append(f"sheet {sheet!r} is left out: {error}")
        except ValueError:
            # Sheets of settings have no rows of numbers.
            pass
    if not curves:
        reasons = "; ".join(left)
        raise ValueError(
            f"{path.name} has no sheet with columns of depth and force and their units"
            f"{': ' * bool(left)}{reasons}"
        )
    return [partial(_said, make, tuple(left)) for make in curves]


def _said(make, left):
    """A curve that also says which sheets are left out."""
    curve = make()
    return replace(curve, remarks=(*curve.remarks, *left))
