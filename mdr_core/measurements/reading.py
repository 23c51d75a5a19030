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
        or the first one of a table that `columns` describe.
    **given
        `spring_constant`, `sensitivity`, `columns` and `by` as in `read_curves`, where the file lacks them.

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
    """Number of the first curve of a table whose columns are given, 0 without one."""
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

    Many files are a folder, a list of paths, a pattern, or a zip of texts, which is read in memory. Their
    order is the natural one of their names. What cannot be read is listed in `unread`, with the reason,
    and the rest is read. A question is asked once for all files with the same heads and units, and its
    answer holds for these; what is told without a question holds for all files.

    A table is read where it says plainly what it is: depth and force each have one column with an exact
    name and a plain unit, as "Depth (nm)" and "Load (mN)", no other column may be meant, and the depth does
    not start anew. For any other table `UnknownColumns` is raised, with a suggestion that reads the file if
    it is right: ``read_curves(path, **error.suggestion)``. If a file has several tables or sheets, curves
    of plain ones come first. The error is raised when another curve is taken, or at once if none is plain.

    Signs are found by the numbers, as force and depth are positive in compression. `remarks` of a curve
    lists reversed signs, constants that are taken from the file, and lines that are left out. Numbers of
    10³⁰ and more are missing values. Depth counts as in the file. Layouts of JPK, NanoScope, Anton
    Paar and Optics11 and the files that this package writes are known exactly. Sheets without a curve, as
    of results, are left out, with a remark.

    Parameters
    ----------
    path : path-like, or list of path-like
        Of one file: a table as text in UTF-8, UTF-16 or Windows-1252, with columns separated by commas,
        semicolons, tabs or blanks; an Excel file (.xls, .xlsx), of which each sheet with a curve is read;
        or an AFM file (.jpk-…, .h5, .ibw, .zip, .tab; text of AFM Workshop, Optics11 and NT-MDT), by
        `afmformats`. Of AFM files the depth is minus the position of the tip, −(height + F/k) with the
        stiffness k of the cantilever, and its zero is not first contact.
    spring_constant : float, optional
        Stiffness k of the cantilever (N/m); the header of a text may have it, but this one goes first. The
        deflection F/k is subtracted from the position of a piezo, and a deflection (m or V) gives the
        force. A stiffness that nothing uses is refused.
    sensitivity : float, optional
        Deflection (m) of the cantilever for 1 V, where the file has its deflection in V; m/A for NT-MDT.
        Its files have no header: they are known by the two values that are given.
    columns : dict or list of dict, optional
        Columns of a table for "depth" and "force", and "time" and "stiffness" (of the contact): a number
        from 0 on, or a name in the header, and a unit, as in
        ``{"depth": (0, "nm"), "force": ("Kraft", "mN")}``; without a unit that of the header is taken. In
        the place of "depth" stands "piezo" for the position of a piezo. None leaves out the time. A list is
        of pairs side by side, a curve each. In a file of several tables it holds for those with the heads
        of the first one that is asked about, or that have these names.
    by : int, str or list, optional
        What tells several curves of a table apart: a column (number or name), or a list of columns, whose
        rows of the same values are a curve each; "gaps", empty lines or words between rows; "restart",
        where the depth starts anew. "whole" is for one curve, "segments" for parts of one curve, in a list
        of columns or in tables below each other.

    Returns
    -------
    MeasuredCurves

    Raises
    ------
    UnknownColumns
        If a table does not say plainly what its columns are, or may be of several curves or of results; if
        a stiffness or a sensitivity is needed. It is a ValueError.
    ValueError
        If no file of many can be read; if they are more than 1,000 or have more than 0.5 GB together; if
        most lines are no rows of numbers; if a stiffness or a sensitivity is given that nothing uses, or
        `by` separates nothing; if a file is too large; if it is binary and not read.
    OSError
        If there is no such file (FileNotFoundError), whatever its name ends with, or it may not be read.
    ImportError
        If the package is not installed that reads the format.

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
    """`MeasuredCurves` of one file."""
    # A file that is missing or may not be read is the system's error, whatever would read it.
    with path.open("rb"):
        pass
    if is_workbook(path):
        return MeasuredCurves(path.name, None, from_workbook(path, options))
    if path.suffix.lower().startswith(SUFFIXES):
        if options["columns"] or options["by"] is not None:
            raise MeasurementError(
                f"{path.name} is no table: leave out the choice of columns and of curves"
            )
        return from_afm(path, options["given"])
    return _of_text(path.name, path.read_bytes(), options, path)


def _of_text(name, data, options, path=None):
    """`MeasuredCurves` of the bytes of a text, of a file that an AFM may have written if it has a path."""
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
