"""Measured force–depth curves from files of instruments."""

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

from ..base import check
from ..base.remark import MeasurementError, Remark, Remedy
from ..show.progress import progress
from .files.afm import SUFFIXES, from_afm, is_afm_text, refuse_binary
from .files.columns import SIZES
from .files.folder import curves_of_set, set_of
from .files.question import UnknownColumns
from .files.several import curves_of_text
from .files.split import WORDS
from .files.table import decoded
from .files.workbook import from_workbook, is_workbook
from .measured_curve import MeasuredCurve, MeasuredCurves

__all__ = ["SIZES", "WORDS", "UnknownColumns", "read_curve", "read_curves"]


def read_curve(path: str | PathLike[str], index: int | None = None, **given: Any) -> MeasuredCurve:
    """Read depth, force and time of one measured curve from a file of an instrument.

    Parameters
    ----------
    path : path-like
        A file, see `read_curves`.
    index : int, optional
        Number of the curve in a map, or in an Excel file with several sheets. By default the first curve,
        or the first curve of a table that `columns` describe.
    **given
        `spring_constant`, `sensitivity`, `columns` and `by` as in `read_curves`, if they are not in the
        file.

    Returns
    -------
    MeasuredCurve

    Raises
    ------
    ValueError, OSError, ImportError
        As in `read_curves`.

    Examples
    --------
    >>> from mdr_core import read_curve
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("Depth (nm);Load (mN)\\n0;0\\n10;1,5\\n;2\\n20;4\\n", encoding="utf-8")
    ...     curve = read_curve(path)
    >>> print(curve.depth.tolist(), curve.force.tolist(), curve.time)
    [0.0, 1e-08, 2e-08] [0.0, 0.0015, 0.004] None
    >>> curve.remarks
    ('left out line 4: a cell is missing or not a number',)
    """
    curves = read_curves(path, **given)
    if index is None:
        index = _first_told(curves) if given.get("columns") and len(curves) > 1 else 0
    if not 0 <= index < len(curves):
        raise check.MDRError(
            f"index = {index} must be from 0 to less than {len(curves)}, the curves of {path}"
        )
    curve = curves[index]
    if len(curves) == 1:
        return curve
    other = Remark(f"curve {index} of {len(curves)}, counted from 0", "taken", Remedy("give", "index"))
    return replace(curve, remarks=(other, *curve.remarks))


def _first_told(curves):
    """Return the number of the first curve of a table with given columns, or 0 without such a table."""
    for number in range(len(curves)):
        with suppress(UnknownColumns):
            if curves[number].source == "as told":
                return number
    return 0


def read_curves(
    path: str | PathLike[str] | Sequence[str | PathLike[str]],
    *,
    spring_constant: float | None = None,
    sensitivity: float | None = None,
    columns: dict[str, Any] | list[dict[str, Any]] | None = None,
    by: int | str | list[int | str] | None = None,
) -> MeasuredCurves:
    """Read all measured curves of a file of an instrument, or of many files.

    Many files are a folder, a list of paths, a pattern, or a zip of texts, which is read in memory. They
    are in the natural order of their names. `unread` lists files that cannot be read, with the reason; the
    other files are read. One `UnknownColumns` covers all files with the same headers and units, and
    `columns` and `by` apply to these files. If no file is ambiguous, they apply to all files.

    A table is read directly if it is unambiguous. Depth and force must each have one column with an exact
    name and a plain unit, such as "Depth (nm)" and "Load (mN)". No other column may match, and the depth
    must not start anew. Any other table raises `UnknownColumns` with a suggestion, which reads the file if
    it is right: ``read_curves(path, **error.suggestion)``. If a file has several tables or sheets, curves
    of unambiguous tables come first. Another curve raises the error when you take it. If no table is
    unambiguous, `read_curves` raises the error at once.

    The numbers determine the signs: force and depth are positive in compression. `remarks` of a curve
    lists reversed signs, constants from the file, and omitted lines. Numbers of 10³⁰ and more are missing
    values. The zero of the depth is that of the file. The layouts of JPK, NanoScope, Anton Paar and
    Optics11, and the files of this package, are known exactly. Sheets without a curve, for example with
    results, are omitted with a remark.

    Parameters
    ----------
    path : path-like, or list of path-like
        Three types of files are supported. Text is a table in UTF-8, UTF-16 or Windows-1252, with columns
        separated by commas, semicolons, tabs or blanks. In an Excel file (.xls, .xlsx), each sheet with a
        curve is read. `afmformats` reads AFM files (.jpk-…, .h5, .ibw, .zip, .tab; text of AFM Workshop,
        Optics11 and NT-MDT). The depth of an AFM file is minus the position of the tip, −(height + F/k)
        with the stiffness k of the cantilever, and its zero is not first contact.
    spring_constant : float, optional
        Stiffness k of the cantilever (N/m). This value takes precedence over a value in the header. The
        deflection F/k is subtracted from the position of a piezo, and a deflection (m or V) gives the
        force. An unused stiffness raises an error.
    sensitivity : float, optional
        Deflection (m) of the cantilever for 1 V, if the file has the deflection in V; m/A for NT-MDT.
        Files of NT-MDT have no header, so both values must be given to recognize them.
    columns : dict or list of dict, optional
        Columns of a table for "depth" and "force", and "time" and "stiffness" (of the contact). A column is
        a number, starting at 0, or a name in the header, and a unit:
        ``{"depth": (0, "nm"), "force": ("Kraft", "mN")}``. The default unit is the unit in the header. Use
        "piezo" instead of "depth" for the position of a piezo. None leaves out the time. A list has one
        dictionary for each pair of columns side by side, each with its curve. In a file of several tables,
        `columns` hold for tables with the same headers as the first ambiguous table, or with these names.
    by : int, str or list, optional
        Separation of several curves in a table. With a column (number or name) or a list of columns, rows
        with the same values are one curve. "gaps" separates at empty lines or words between rows, and
        "restart" where the depth starts anew. "whole" means one curve. "segments" means parts of one curve,
        in a list of columns or in tables below each other.

    Returns
    -------
    MeasuredCurves

    Raises
    ------
    UnknownColumns
        If the columns of a table are ambiguous, or a table may contain several curves or results. Also if a
        stiffness or a sensitivity is needed. It is a ValueError.
    ValueError
        If no file of many can be read, or there are more than 1,000 files or 0.5 GB. If most lines are not
        rows of numbers. If a given stiffness or sensitivity is not used, or `by` separates nothing. If a
        file is too large, or binary in an unknown format.
    OSError
        If the file does not exist (FileNotFoundError), whatever its suffix, or cannot be opened.
    ImportError
        If the package for the format is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from mdr_core import read_curves
    >>> text = "Test 1\\nDepth (nm);Load (mN)\\n0;0\\n10;1\\n20;4\\n"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "runs.csv"
    ...     _ = path.write_text(text + text.replace("Test 1", "Test 2"), encoding="utf-8")
    ...     curves = read_curves(path)
    >>> print(len(curves), round(curves[1].force.max(), 9))
    2 0.004
    """
    given = {"spring_constant": (spring_constant, "N/m"), "sensitivity": (sensitivity, "m/V")}
    given = {
        name: None if value is None else check.positive_number(name, value, unit=unit)
        for name, (value, unit) in given.items()
    }
    options = {"columns": columns or None, "by": by, "given": given}
    found = set_of(path, _of_path, _of_text)
    if found is None:
        return _of_path(Path(path), options)
    name, files = found
    with progress(len(files), "files") as done:
        curves, unread = curves_of_set(files, options, done)
    reasons = {each: Remark.of(error, "invalid") for each, error in unread.items()}
    return MeasuredCurves.joined(name, curves, reasons)


def _of_path(path, options):
    """Return the `MeasuredCurves` of one file."""
    # Raise the error of the system for a missing or forbidden file, whatever its format.
    with path.open("rb"):
        pass
    if is_workbook(path):
        return MeasuredCurves(path.name, None, from_workbook(path, options))
    if path.suffix.lower().startswith(SUFFIXES):
        if options["columns"] or options["by"] is not None:
            raise MeasurementError(
                f"{path.name} is not a table: leave out the choice of columns and of curves"
            )
        return from_afm(path, options["given"])
    return _of_text(path.name, path.read_bytes(), options, path)


def _of_text(name, data, options, path=None):
    """Return the `MeasuredCurves` of the bytes of a text; a text with a path may be an AFM file."""
    refuse_binary(Path(name), data)
    text, given = decoded(data), options["given"]
    of_nova = (
        name.lower().endswith(".txt")
        and None not in given.values()
        and not re.search("[A-Za-z]", text[:1000])
    )
    told = options["columns"] or options["by"] is not None
    if path is not None and not told and (of_nova or is_afm_text(text)):
        return from_afm(path, given)
    return MeasuredCurves(name, None, curves_of_text(text, name, options))
