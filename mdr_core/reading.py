"""Measured force–depth curves from files of instruments."""

import logging
import re
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from . import _check
from .measured_curve import MODALITIES, MeasuredCurve, MeasuredCurves, named_segments, segments_of
from .profiles.samples import UNITS, Table, decoded, read_table, unit_named
from .results.report import imported

# Without a handler its errors would be printed beside the refusals.
logging.getLogger("afmformats").addHandler(logging.NullHandler())

#: Words in the names of the columns of each quantity.
_WORDS = {
    "depth": r"depth|displ|indent|tiefe|weg|\b[hdz]\b",
    "force": r"force|load|deflection|kraft|last|\b[fp]\b",
    "time": r"time|zeit|\bt\b",
}
#: Names of columns of the depth itself, not of the position of a piezo or of the depth below the contact.
_DEPTH = re.compile("(?!.*(piezo|displ|height|contact)).*(depth|indent|tiefe)", re.I)
#: Names of columns of the position of the piezo, in which the deflection of the cantilever is included.
_PIEZO = re.compile("piezo|height|sens|scanner", re.I)
#: Beginnings of the suffixes of AFM files that are no text.
_AFM = ".jpk", ".h5", ".hdf5", ".ibw", ".nid", ".zip"
#: Text that only files of AFM instruments have.
_OF_AFM = re.compile(r"# afmformats |Force-Distance Curve|Device:\tChiaro")
#: Sizes of the units of each quantity (SI); a minus turns the sign of a column.
SIZES = {
    each: UNITS[kind] | {f"−{unit}": -size for unit, size in UNITS[kind].items()}
    for each, kind in {"depth": "length", "force": "force", "time": "time"}.items()
}
#: Sizes of units of a contact stiffness (N/m), and names of its column; of a frame or a spring it is none.
_STIFFNESS = {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "N/mm": 1e3, "N/µm": 1e6, "mN/µm": 1e3, "mN/nm": 1e6,
              "µN/nm": 1e3, "nN/nm": 1.0, "pN/nm": 1e-3, "µN/µm": 1.0, "mN/m": 1e-3}  # fmt: skip
_OF_CONTACT = re.compile(
    r"(?!.*(frame|spring|machine|support|squared|correct))(.*contact.*stiff|.*\bstiffness\b|s\b)", re.I
)
#: What to do about errors of `afmformats`.
_REMEDIES = {
    "MissingMetaDataError": " Give spring_constant= (N/m) and sensitivity= (m/V)",
    "NotImplementedError": " Its forces are in N: give neither. minus_frame(1 / k) subtracts a deflection",
    "UnicodeDecodeError": "; if it is packed, unpack it and read its files",
}


class UnknownColumns(ValueError):
    """A table whose header does not tell the columns of depth and force, or their units."""

    def __init__(self, message: str, table: Table) -> None:
        super().__init__(message)
        self.table = table


def read_curve(path: str | PathLike[str], index: int = 0, **given: Any) -> MeasuredCurve:
    """Read depth, force and time of one measured curve from a file of an instrument.

    Parameters
    ----------
    path : path-like
        A file, see `read_curves`.
    index : int, optional
        Number of the curve in a map, or in an Excel file with several sheets.
    **given
        `spring_constant`, `sensitivity` and `columns` as in `read_curves`, where the file lacks them.

    Returns
    -------
    MeasuredCurve

    Raises
    ------
    ValueError, ImportError
        As in `read_curves`.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("Depth (nm);Load (mN)\\n0;0\\n10;1,5\\n;2\\n20;4\\n", encoding="utf-8")
    ...     curve = read_curve(path)
    >>> print(curve.depth.tolist(), curve.force.tolist(), curve.time)
    [0.0, 1e-08, 2e-08] [0.0, 0.0015, 0.004] None
    >>> curve.remarks
    ('left out line 4: a cell is missing or no number',)
    """
    curves = read_curves(path, **given)
    if not 0 <= index < len(curves):
        raise ValueError(f"index = {index} must be from 0 to less than {len(curves)}, the curves of {path}")
    curve = curves[index]
    several = [f"curve {index} of {len(curves)}: index= picks another one"] * (len(curves) > 1)
    return replace(curve, remarks=(*several, *curve.remarks))


def read_curves(
    path: str | PathLike[str],
    *,
    spring_constant: float | None = None,
    sensitivity: float | None = None,
    columns: dict[str, Any] | None = None,
) -> MeasuredCurves:
    """Read all measured curves of a file of an instrument, which is opened once.

    Columns of a table are found by the units in its header, in brackets, after the names or in a line of
    their own, and then by their names. Signs are found by the numbers, as force and depth are positive in
    compression. `remarks` of a curve has what was turned round or left out. Depth counts as in the file.

    Parameters
    ----------
    path : path-like
        A table as text in UTF-8, UTF-16 or Windows-1252, with columns separated by commas, semicolons, tabs
        or blanks; an Excel file (.xls, .xlsx), of which each sheet with a curve is read, by pandas; or an
        AFM file (.jpk-…, .h5, .ibw, .zip, .tab; text of AFM Workshop, Optics11 and NT-MDT), by
        `afmformats`. Of AFM files the depth is minus the position of the tip, −(height + F/k) with the
        stiffness k of the cantilever, and its zero is not the contact point.
    spring_constant : float, optional
        Stiffness of the cantilever (N/m) that the file lacks. With it the deflection F/k is subtracted from
        a column of a table that is the position of the piezo: its name has piezo, height, sens or scanner.
    sensitivity : float, optional
        Deflection (m) of the cantilever for 1 V that an AFM file lacks; m/A for NT-MDT. Its files have no
        header: they are known by the two values that are given.
    columns : dict, optional
        Columns of a table for "depth", "force" and "time": a name in the header, as in
        ``{"depth": "Z-Sense (nm)"}``, or a number from 0 on and a unit, as in ``{"depth": (0, "nm")}``,
        where the header lacks them. None leaves out the time.

    Returns
    -------
    MeasuredCurves

    Raises
    ------
    ValueError
        If most lines are no rows of numbers, or there is no column of depth or force with a unit; if a
        stiffness or a sensitivity is needed that is not given, or given where the file has its own forces.
    ImportError
        If the package is not installed that reads the format.
    """
    path = Path(path)
    suffix, given = path.suffix.lower(), {}
    if spring_constant is not None:
        given["spring constant"] = _check.positive_number("spring_constant", spring_constant, unit="N/m")
    if sensitivity is not None:
        given["sensitivity"] = _check.positive_number("sensitivity", sensitivity, unit="m/V")
    text = "" if suffix.startswith((*_AFM, ".xls")) else decoded(path.read_bytes())
    of_nova = suffix == ".txt" and len(given) == 2 and not re.search("[A-Za-z]", text[:1000])
    if suffix.startswith(_AFM) or (columns is None and (of_nova or _OF_AFM.search(text[:2000]))):
        return _from_afm(path, given)
    if sensitivity is not None:
        raise ValueError(f"{path.name} is a table, with forces in units of force: leave out sensitivity")
    options = {"columns": columns, "spring_constant": given.get("spring constant")}
    if suffix in (".xls", ".xlsx"):
        return MeasuredCurves(path.name, None, _sheets(path, options))
    make = partial(curve_of, read_table(text, path.name), path.name, **options)
    return MeasuredCurves(path.name, None, [make])


def curve_of(table, name, columns=None, spring_constant=None, *, turn=True, segment=None):
    """`MeasuredCurve` of a table with given columns, and others by their units and names.

    Signs are found by the numbers unless `turn` is False.
    """
    given = {each: column for each, column in (columns or {}).items() if each != "stiffness"}
    columns, remarks = _columns(table, name, given)
    values = {each: table.values[column[0]] for each, column in columns.items() if column}
    rows = np.flatnonzero(np.isfinite(list(values.values())).all(axis=0))
    labels, segment = named_segments(table.words) if segment is None else ("", segment)
    remarks += _omissions(table, rows, name, labels)
    if rows.size < 2:
        raise ValueError(f"{name} has one row of numbers: give a curve, a sample a line")
    steps = np.diff(values["time"][rows]) if "time" in values else np.ones(1)
    if np.all(steps <= 0) and np.any(steps):
        rows = rows[::-1]
    elif np.any(steps < 0) or not np.any(steps):
        remarks.append("the time does not ascend and is left out: samples are in the order of the file")
        columns["time"] = None
        del values["time"]
    values = {each: value[rows] * SIZES[each][columns[each][1]] for each, value in values.items()}
    for each in _turned(values["depth"], values["force"]) if turn else ():
        values[each], (column, unit) = -values[each], columns[each]
        columns[each] = column, unit[1:] if unit[0] == "−" else f"−{unit}"
        remarks.append(f"{each} turned round: it is positive in compression")
    head = table.heads[columns["depth"][0]]
    if _PIEZO.search(head) and spring_constant is not None:
        values["depth"] = values["depth"] - values["force"] / spring_constant
        remarks.append(f"{head!r} is of the piezo: the deflection, force over stiffness, is subtracted")
    elif _PIEZO.search(head):
        remarks.append(f"{head!r} includes the deflection force/stiffness: give spring_constant= (N/m)")
    elif spring_constant is not None and "tip" not in head:
        remarks.append(f"{head!r} is taken as the depth of the tip: no deflection is subtracted")
    arrays = {"time": None, "stiffness": None} | {
        each: _check.frozen(value) for each, value in values.items()
    }
    measured = _stiffness(table)
    if measured is not None:
        column, unit = columns["stiffness"] = measured
        measure = table.values[column][rows] * _STIFFNESS[unit]
        # Instruments write 1.8e308 where there is none.
        arrays["stiffness"] = _check.frozen(np.where(np.abs(measure) < 1e30, measure, np.nan))
    arrays["segment"] = segments_of(**values) if segment is None else _check.frozen(segment[rows])
    return MeasuredCurve(name, spring_constant, None, columns, tuple(remarks), table, **arrays)


def _columns(table, name, given):
    """Number and unit of the column of each quantity, None for no time, and remarks on the choice."""
    free, columns, remarks = dict(table.heads), {}, []
    if len(free) < 2:
        raise ValueError(f"{name} has one column of numbers: give one of depth and one of force")
    for each in given:
        _check.one_of("a key of columns", each, tuple(_WORDS))
        columns[each] = _given(table, each, given[each], free)
        free.pop(columns[each] and columns[each][0], None)
    for each in [each for each in ("time", "force", "depth") if each not in columns]:
        fits = [column for column in free if table.unit(column) in SIZES[each]]
        best = max(fits, key=lambda column: _rank(each, free[column]), default=None)
        if best is None and each != "time":
            raise UnknownColumns(
                f"{name} has no column of {each} with a unit in its header, {table.heads}: give columns="
                '{"depth": (0, "nm"), "force": (1, "mN")}, numbers and units; a deflection is no force. '
                "NT-MDT's files need spring_constant= (N/m) and sensitivity= (m/A)",
                table,
            )
        others = ", ".join(repr(free[column]) for column in fits if column != best)
        remarks += [f"{each} is taken from {free[best]!r}, not from {others}"] if others else []
        columns[each] = None if best is None else (best, table.unit(best))
        free.pop(best, None)
    return {each: columns[each] for each in _WORDS}, remarks


def _stiffness(table):
    """Number and unit of the column of a contact stiffness, or None; "Harmonic Contact" comes first."""
    found = []
    for column, head in table.heads.items():
        unit = re.sub("[uμ]N", "µN", re.split(r"[\s(\[]+", head.strip(" )]"))[-1])
        if unit in _STIFFNESS and _OF_CONTACT.match(head):
            found.append((column, unit))
    return max(found, key=lambda each: "contact" in table.heads[each[0]].lower(), default=None)


def _rank(each, head):
    """Whether a column has the name of a quantity, is no raw one, and says that it is the depth."""
    named = re.search(_WORDS[each], head, re.I)
    return bool(named), "raw" not in head.lower(), _DEPTH.match(head) is not None


def _given(table, each, column, free):
    """Number and unit of one of the `free` columns that is given by its name or number."""
    if column is None and each == "time":
        return None
    which, unit = column if isinstance(column, tuple | list) else (column, None)
    number = next((k for k, head in free.items() if which in (k, head)), None)
    if number is not None:
        unit = unit_named(unit) or unit if unit else table.unit(number)
    if number is None or unit not in SIZES[each]:
        raise ValueError(
            f"columns: {each} = {column!r} must be a number or name of {free}, and a unit where "
            f"that has none, ({which!r}, {list(SIZES[each])[1]!r}), out of {', '.join(SIZES[each])}"
        )
    return number, unit


def _omissions(table, rows, name, labels):
    """Remarks on columns and lines that are left out; `rows` and the column of `labels` are not."""
    lines = sorted({*table.odd, *table.lines.tolist()} - set(table.lines[rows].tolist()))
    listed = ", ".join(map(str, lines[:3])) + f" and {len(lines) - 3} more" * (len(lines) > 3)
    what = f"line{'s' * (len(lines) > 1)} {listed}: a cell is missing or no number"
    if len(lines) > len(rows):
        raise ValueError(f"most lines of {name} are no rows of numbers, as {what}")
    named = [column for column in table.words if column != labels and " " in column.strip()]
    words = [f"column {column}, which has no numbers, is left out" for column in named]
    return words + [f"left out {what}"] * bool(lines)


def _turned(depth, force):
    """Names of the quantities that have the other sign."""
    # Depth and force grow to the farther one of the largest and the smallest force: adhesion is nearer.
    apart = 0.2 * np.ptp(force)
    ends = [end for end in (force.argmax(), force.argmin()) if abs(force[end] - force[0]) >= apart]
    peak = max(ends, key=lambda end: abs(depth[end] - depth[0]))
    turned = ["depth"] * bool(depth[peak] < depth[0]) + ["force"] * bool(force[peak] < force[0])
    # Both fall in an unloading alone, from the largest force on.
    return turned if len(turned) < 2 or abs(force[peak]) > abs(force[0]) else []


def _sheets(path, options):
    """Functions that make the curves of the sheets of an Excel file that have depth and force."""
    pandas = imported("pandas", f"reading {path.name}", "mdr-core[tables]")
    try:
        sheets = pandas.read_excel(path, sheet_name=None, header=None)
    except Exception as error:
        # Each engine has errors of its own for what is no Excel file.
        raise ValueError(f"{path.name} cannot be read as an Excel file: {error}") from error
    curves = []
    for sheet, frame in sheets.items():
        name = f"{path.name}, {sheet}"
        # Sheets of results and settings are passed over.
        with suppress(ValueError):
            table = read_table(frame.to_csv(sep="\t", header=False, index=False), name)
            curves.append(partial(replace, curve_of(table, name, **options)))
    if not curves:
        raise ValueError(f"{path.name} has no sheet with columns of depth and force and their units")
    return curves


@contextmanager
def _refused(errors, name):
    """Errors of `afmformats` as ValueErrors that say what to give."""
    try:
        yield
    # Most errors of this package are none that `except Exception` would handle.
    except (Exception, errors.AFMFileFormatError, errors.MissingMetaDataError) as error:
        remedy = _REMEDIES.get(type(error).__name__, "")
        raise ValueError(f"{name} is not read by afmformats: {error}{remedy}") from None


def _from_afm(path, given):
    """`MeasuredCurves` of a file that `afmformats` reads."""
    afmformats = imported("afmformats", f"reading {path.name}", "mdr-core[afm]")
    with _refused(afmformats.errors, path.name):
        curves = sorted(afmformats.load_data(path, meta_override=given), key=lambda data: data.enum)
        position = [[data.metadata.get(f"position {axis}", np.nan) for axis in "xy"] for data in curves]
    position = None if np.isnan(position).any() else _check.frozen(position)
    makers = [partial(_afm_curve, afmformats.errors, data) for data in curves]
    return MeasuredCurves(path.name, position, makers)


def _afm_curve(errors, data):
    """`MeasuredCurve` of a curve in `afmformats`, approach and retract in the order of time."""
    name = data.path.name
    with _refused(errors, name):
        heights = [head for head in ("tip position", "height (measured)", "height (piezo)") if head in data]
        heads = [heights[0], "force", *(["time"] if "time" in data else [])]
        values = {k: np.asarray(data[head], dtype=float) for k, head in enumerate(heads)}
        number = np.asarray(data["segment"], dtype=int)
        # Where all have one number the file does not know the segments.
        segment = np.array(MODALITIES[data.modality])[number] if number.any() else None
        stiffness = data.metadata.get("spring constant")
    table = Table(dict(enumerate(heads)), values, np.arange(1, number.size + 1), {}, {})
    columns = {"depth": (0, "−m"), "force": (1, "N"), "time": (2, "s") if 2 in values else None}
    return curve_of(table, name, columns, stiffness, turn=False, segment=segment)
