"""Measured force–depth curves from files of instruments."""

import re
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

import numpy as np

from ._check import Array, frozen
from .profiles.samples import UNITS, Table, decoded, read_table
from .results.report import Report, imported

#: Kind of the units of each quantity, and words in the names of its columns.
_KINDS = {"depth": "length", "force": "force", "time": "time"}
_WORDS = {
    "depth": r"depth|displ|indent|tiefe|weg|\b[hdz]\b",
    "force": r"force|load|deflection|kraft|last|\b[fp]\b",
    "time": r"time|zeit|\bt\b",
}
#: Names of columns of the depth itself, not of the position of a piezo or of the depth below the contact.
_DEPTH = re.compile("(?!.*(piezo|displ|height|contact)).*(depth|indent|tiefe)", re.I)
#: Names of columns of the position of the piezo, in which the deflection of the cantilever is included.
_PIEZO = re.compile("piezo|height|sens|scanner", re.I)
#: Sizes of the units of each quantity (SI); a minus turns the sign of a column.
SIZES = {
    name: UNITS[kind] | {f"−{unit}": -size for unit, size in UNITS[kind].items()}
    for name, kind in _KINDS.items()
}


def read_curve(path: str | PathLike[str], index: int = 0) -> "MeasuredCurve":
    """Read depth, force and time of a measured curve from a file of an instrument.

    Columns and units are found by the names in the header, in which units stand in brackets, after the
    names or in a line of their own; signs by the numbers, as force and depth are positive in compression.
    `remarks` has everything that was guessed, turned round or left out. Depth counts as in the file.

    Parameters
    ----------
    path : path-like
        Text in UTF-8, UTF-16 or Windows-1252, with columns separated by commas, semicolons, tabs or blanks;
        an Excel file, for which pandas is needed; or an AFM file (.jpk-…, .h5, .ibw, .nid, .zip), for which
        `afmformats` is needed. Of these the depth is minus the position of the tip, −(height + F/k) with
        the stiffness k of the cantilever, and its zero is not the contact point.
    index : int, optional
        Number of the curve in an Excel file with several sheets, or in a map.

    Returns
    -------
    MeasuredCurve

    Raises
    ------
    ValueError
        If most lines are no rows of numbers, or there is no column of depth or force.
    ImportError
        If the package is not installed that reads the format.

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
    path = Path(path)
    suffix, name = path.suffix.lower(), path.name
    if suffix in (".xls", ".xlsx"):
        return _from_sheets(path, index)
    if suffix.startswith((".jpk", ".h5", ".ibw", ".nid", ".zip")):
        return _from_afm(path, index)
    data = path.read_bytes()
    if suffix == ".tab" and data.startswith(b"# afmformats"):
        return _from_afm(path, index)
    return curve_of(read_table(decoded(data), name), name)


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredCurve(Report):
    """A measured curve, returned by `read_curve`, and how its file was understood."""

    #: Name of the file.
    name: str
    #: Depth (m), force (N) and time (s), None for a time that the file does not have.
    depth: Array
    force: Array
    time: Array | None
    #: Numbers of the columns in the table, None for no time, and their units, "−nm" for a reversed sign.
    columns: dict[str, int | None]
    units: dict[str, str]
    #: Guesses, reversed signs, lines and columns that are left out.
    remarks: tuple[str, ...]
    table: Table

    _shown = ("depth", "force")
    _dimensions = ("sample",)

    @property
    def _quantities(self):  # type: ignore[override]
        return tuple(name for name in _KINDS if getattr(self, name) is not None)

    def _rows(self):
        yield "file", self.name
        for name in self._quantities:
            column = self.columns[name]
            yield name, f"{self.table.heads[column] or f'column {column + 1}'!r} in {self.units[name]}"
        yield from (("remark", remark) for remark in self.remarks)


def curve_of(table, name, columns=None, units=None):
    """`MeasuredCurve` of a table, with given columns and units, or those of its names and numbers."""
    columns, remarks = (columns, []) if columns else _columns(table, name)
    used = {quantity: column for quantity, column in columns.items() if column is not None}
    values = {quantity: table.values[:, column] for quantity, column in used.items()}
    rows = np.flatnonzero(np.isfinite(list(values.values())).all(axis=0))
    remarks = _omissions(table, rows, name) + remarks
    if rows.size < 2:
        raise ValueError(f"{name} has one row of numbers: give a curve, a sample a line")
    if "time" in values:
        steps = np.diff(values["time"][rows])
        if np.all(steps <= 0) and np.any(steps):
            rows = rows[::-1]
        elif np.any(steps < 0) or not np.any(steps):
            remarks.append("the time does not ascend and is left out: samples are in the order of the file")
            del values["time"]
    values = {quantity: value[rows] for quantity, value in values.items()}
    if units is None:
        units, guesses = _units(table, used, values)
        remarks += guesses
    values = {
        quantity: frozen(value * SIZES[quantity][units[quantity]]) for quantity, value in values.items()
    }
    values.setdefault("time", None)
    return MeasuredCurve(name, **values, columns=columns, units=units, remarks=tuple(remarks), table=table)


def _columns(table, name):
    """Columns of depth, force and time by their units, names and order, and remarks on the choice."""
    units, count = [table.unit(column) for column in range(len(table.heads))], len(table.heads)
    if count < 2:
        raise ValueError(f"{name} has one column of numbers: give one of depth and one of force")
    columns, left, remarks = {}, list(range(count)), []
    named_at_all = any(units) or re.search("|".join(_WORDS.values()), "\n".join(table.heads), re.I)
    for quantity in ("time", "force", "depth"):
        kind, score = UNITS[_KINDS[quantity]], {}
        for column in left:
            unit, head = units[column], table.heads[column]
            named = bool(re.search(_WORDS[quantity], head, re.I))
            # Units of other kinds exclude a column, unknown ones if it is not named either.
            if unit is None or unit in kind or (unit == "" and named):
                score[column] = 2 * (unit in kind) + named
        best = max(score, key=lambda i: (score[i], *_preference(table.heads[i])), default=None)
        others = [i for i in score if i != best and score[i] >= max(1, min(2, score[best]))]
        if others:
            text = ", ".join(repr(table.heads[i]) for i in others)
            remarks.append(f"{quantity} is taken from {table.heads[best]!r}, not from {text}")
        if quantity == "time" and count > 2 and not named_at_all:
            best = _ascending_column(table.values)
            if best is not None:
                remarks.append(f"no names: column {best + 1} is taken as time, as it grows in equal steps")
        elif quantity == "time" and (count < 3 or not score.get(best)):
            best = None
        elif quantity == "force" and score.get(best) == 0 and len(score) > 1:
            # Without names depth stands first.
            best = list(score)[1]
        elif best is None:
            heads = ", ".join(table.heads)
            raise ValueError(
                f"{name} has no column of {quantity} among {heads}: name it and its unit in the header"
            )
        if quantity == "depth" and _PIEZO.search(table.heads[best]):
            remarks.append(
                f"{table.heads[best]!r} is the position of the piezo: it includes the deflection of the "
                "cantilever, force over stiffness; subtract that from the depth"
            )
        columns[quantity] = best
        left = [column for column in left if column != best]
    return {quantity: columns[quantity] for quantity in _KINDS}, remarks


def _preference(head):
    """Whether a column is no raw one, and says that it is the depth; of those that fit otherwise."""
    return "raw" not in head.lower(), _DEPTH.match(head) is not None


def _ascending_column(values):
    """The first column that grows in equal steps, if two others turn round by a fifth; else None."""
    values = values[np.isfinite(values).all(axis=1)]
    if len(values) < 3:
        return None
    steps, (first, last) = np.diff(values, axis=0), values[[0, -1]]
    even = np.all((steps > 0) & (steps > 0.5 * steps.mean(axis=0)), axis=0)
    high, low = values.max(axis=0), values.min(axis=0)
    turn = np.maximum(high - np.maximum(first, last), np.minimum(first, last) - low)
    turns = np.count_nonzero(turn > 0.2 * (high - low)) >= 2
    return int(np.argmax(even)) if turns and even.any() else None


def _omissions(table, rows, name):
    """Remarks on columns and lines that are left out; `rows` are those that are not."""
    lines = sorted({*table.odd, *table.lines.tolist()} - set(table.lines[rows].tolist()))
    listed = ", ".join(map(str, lines[:3])) + f" and {len(lines) - 3} more" * (len(lines) > 3)
    what = f"line{'s' * (len(lines) > 1)} {listed}: a cell is missing or no number"
    if len(lines) > len(rows):
        raise ValueError(f"most lines of {name} are no rows of numbers, as {what}")
    remarks = [f"column {column}, which has no numbers, is left out" for column in table.omitted]
    return remarks + [f"left out {what}"] * bool(lines)


def _units(table, used, values):
    """Units of the quantities, with a minus for columns of the other sign, and remarks on both."""
    # Depths below 10⁻³ are in m, as no curve is 10⁻³ nm deep.
    guess = ("m", "N", "s") if np.max(np.abs(values["depth"])) < 1e-3 else ("nm", "µN", "s")
    units, remarks = dict(zip(_KINDS, guess, strict=True)), []
    known = {quantity: table.unit(column) for quantity, column in used.items()}
    guessed = [f"{quantity} in {units[quantity]}" for quantity, unit in known.items() if not unit]
    units |= {quantity: unit for quantity, unit in known.items() if unit}
    if guessed:
        remarks.append(f"no unit in the header: {' and '.join(guessed)} is a guess")
    # Depth and force grow to the farther one of the largest and the smallest force: adhesion is nearer.
    depth, force = values["depth"], values["force"]
    apart = 0.2 * np.ptp(force)
    ends = [end for end in (force.argmax(), force.argmin()) if abs(force[end] - force[0]) >= apart]
    peak = max(ends, key=lambda end: abs(depth[end] - depth[0]))
    turned = [quantity for quantity in ("depth", "force") if values[quantity][peak] < values[quantity][0]]
    # Both fall in an unloading alone, from the largest force on.
    if len(turned) < 2 or abs(force[peak]) > abs(force[0]):
        units |= {quantity: f"−{units[quantity]}" for quantity in turned}
        remarks += [f"{quantity} turned round: it is positive in compression" for quantity in turned]
    return units, remarks


def _from_sheets(path, index):
    """Curve of one of the sheets of an Excel file that name the units of depth and force."""
    pandas = imported("pandas", f"reading {path.name}", "mdr-core[tables]")
    try:
        sheets = pandas.read_excel(path, sheet_name=None, header=None)
    except Exception as error:
        # Each engine has errors of its own for what is no Excel file.
        raise ValueError(f"{path.name} cannot be read as an Excel file: {error}") from error
    curves = []
    for sheet, frame in sheets.items():
        try:
            table = read_table(frame.to_csv(sep="\t", header=False, index=False), f"{path.name}, {sheet}")
            curve = curve_of(table, f"{path.name}, {sheet}")
        except ValueError:
            continue
        # Sheets of results and settings have columns of numbers, too.
        if all(table.unit(curve.columns[quantity]) for quantity in ("depth", "force")):
            curves.append(curve)
    curve, remarks = _picked(curves, index, path.name)
    return replace(curve, remarks=(*remarks, *curve.remarks))


def _from_afm(path, index):
    """Curve of a file that `afmformats` reads, approach and retract in the order of time."""
    afmformats = imported("afmformats", f"reading {path.name}", "mdr-core[afm]")
    try:
        curves = afmformats.load_data(path)
    # Errors of this package are none that `except Exception` would handle; of a damaged or unknown file it
    # raises any error.
    except (
        Exception,
        afmformats.errors.AFMFileFormatError,
        afmformats.errors.MissingMetaDataError,
    ) as error:
        raise ValueError(f"{path.name} is not read by afmformats: {error}") from None
    data, remarks = _picked(curves, index, path.name)
    if "tip position" in data:
        depth = -data["tip position"]
    else:
        stiffness = data.metadata.get("spring constant", np.nan)
        depth = -data["height (measured)"] - np.nan_to_num(data["force"] / stiffness)
        if np.isnan(stiffness):
            remarks.append("the stiffness of the cantilever is missing: the depth includes its deflection")
    columns = {"depth (m)": depth, "force (N)": data["force"]}
    columns |= {"time (s)": data["time"]} if "time" in data else {}
    values = np.column_stack(list(columns.values()))
    table = Table(tuple(columns), values, np.arange(1, len(values) + 1), {}, ())
    # Signs are known here.
    units = {"depth": "m", "force": "N", "time": "s"}
    curve = curve_of(table, path.name, units=units)
    return replace(curve, remarks=(*remarks, *curve.remarks))


def _picked(curves, index, name):
    """One of the curves of a file, and a list with a remark if there are several."""
    if not 0 <= index < len(curves):
        raise ValueError(f"index = {index} must be from 0 to less than {len(curves)}, the curves of {name}")
    return curves[index], [f"curve {index} of {len(curves)}: index= picks another one"] * (len(curves) > 1)
