"""Measured curves from the columns of a table. Nothing here looks at a word of a header."""

from dataclasses import replace
from functools import partial

import numpy as np

from ...base import check
from ...base.remark import MeasurementError, Remark, Remedy
from ..measured_curve import MeasuredCurve, named_segments
from .cantilever import constants
from .columns import ask_for_parts, ask_for_results, exact_columns, taken, time_left_out, told
from .split import WORDS, joined, parts, place_of, several
from .units import is_deflection, size_of


def curves_of(table, file, columns=None, by=None, given=None):
    """Functions that make the curves of a table: those that `columns` and `by` tell, or of a plain table.

    `given` has the constants of a cantilever, "spring_constant" and "sensitivity".
    """
    given, name = given or {}, ", ".join(filter(None, (file, table.name)))
    if isinstance(columns, list | tuple):
        return _side_by_side(table, file, [told(table, name, each) for each in columns], by, given)
    if by == "segments":
        raise MeasurementError(
            f"{name} has no second columns or tables that are parts of a curve",
            Remedy("give", "by"),
        )
    layout, source = told(table, name, columns or {}), "as told" if columns else "by its header"
    by_person = "force" in layout and bool({"depth", "piezo"} & layout.keys())
    without_time = "time" in layout and layout["time"] is None
    if by_person:
        layout = {
            each: column for each, column in (layout | exact_columns(table, layout)).items() if column
        }
    else:
        layout = taken(table, file, layout, given.get("spring_constant"))
    options = {"asked": _said(layout, by)}
    if "time" not in layout and not without_time:
        options["remarks"] = time_left_out(table, layout)
    found = []
    for label, part in parts(table, by, layout):
        if not by_person:
            ask_for_results(part, file, layout)
        if by is None or (by not in [*WORDS] and several(part, layout)):
            # Also where a column does not tell all of them apart.
            ask_for_parts(table, file, layout)
        called = f"{name}, {label}" if label else name
        found.append(curve_factory(part, called, layout, given, source, **options))
    return found


def _said(columns, by):
    """Arguments of `read_curves` that say the same."""
    return {"columns": columns} | ({} if by is None else {"by": by})


def _side_by_side(table, file, layouts, by, given):
    """Functions that make the curves of several columns of a table, or the one of which they are parts."""
    name = ", ".join(filter(None, (file, table.name)))
    layouts = [{each: column for each, column in layout.items() if column} for layout in layouts]
    if not layouts or not all("force" in each and {"depth", "piezo"} & each.keys() for each in layouts):
        raise check.MDRError(f"columns of {name}: each of the list needs a depth (or piezo) and a force")
    if by == "segments":
        if len(layouts) < 2:
            raise MeasurementError(
                f"a curve of parts has two or more columns of depth and of force, {name} has one",
                Remedy("give", "by"),
            )
        asked = _said(layouts, by)
        table, layout = joined(table, layouts, file)
        return [curve_factory(table, name, layout, given, "as told", asked=asked)]
    if by is not None:
        raise check.MDRError(
            f"by = {by!r:.80}: a list of columns is a curve each; leave it out, or give by='segments' for "
            "parts of one curve"
        )
    options = {"source": "as told", "asked": _said(layouts, by)}
    return [
        curve_factory(trimmed(table, each), f"{name}, columns {_numbers(each)}", each, given, **options)
        for each in layouts
    ]


def _numbers(layout):
    return f"{place_of(layout) + 1} and {layout['force'][0] + 1}"


def trimmed(table, layout):
    """A table without the rows in which a shorter curve has ended."""
    rows = np.any([np.isfinite(table.values[column[0]]) for column in layout.values()], axis=0)
    numbers = {*table.lines.tolist()}
    odd = {number: line for number, line in table.odd.items() if number not in numbers}
    values = {k: each[rows] for k, each in table.values.items()}
    return replace(table, values=values, lines=table.lines[rows], odd=odd, words={})


def curve_factory(table, name, layout, given, source, *, asked=None, **options):
    """Function that makes the curve of a table; what a cantilever lacks is asked for at once.

    `asked` are the arguments of `read_curves` that say what the columns are, None where a format does.
    """
    cantilever = constants(table, name, layout, given, asked or {})
    return partial(curve_of, table, name, layout, cantilever, source, **options)


def curve_of(table, name, layout, cantilever, source, *, turn=True, segment=None, remarks=()):
    """`MeasuredCurve` of a table with the columns and units of `layout`.

    From a "piezo", the position of one, the deflection is subtracted; a "depth" stays as it is. `source`
    says how the columns are known. Signs are found by the numbers unless `turn` is False.
    """
    place = "piezo" if "piezo" in layout else "depth"
    columns, remarks = {each: layout.get(each) for each in (place, "force", "time")}, [*remarks]
    values = {each: _in_si(table, column) for each, column in columns.items() if column}
    rows = np.flatnonzero(np.isfinite([*values.values()]).all(axis=0))
    labels, segment = named_segments(table.words) if segment is None else ("", segment)
    remarks += [*cantilever.remarks, *_omissions(table, rows, name, labels)]
    if rows.size < 2:
        raise check.MDRError(f"{name} has one row of numbers: give a curve, with one sample per line")
    rows = _in_time(values, rows, columns, remarks)
    values = {each: value[rows] for each, value in values.items()}
    if is_deflection(columns["force"][1]):
        values["force"] = values["force"] * cantilever.force_per_deflection(columns["force"][1])
    for each in _turned(values[place], values["force"]) if turn else ():
        key = place if each == "depth" else each
        values[key], (column, unit) = -values[key], columns[key]
        columns[key] = column, unit[1:] if unit[0] == "−" else f"−{unit}"
        text = f"the sign of {each} is reversed: {each} is positive in compression"
        remarks.append(Remark(text, "changed"))
    depth = values.pop(place)
    values["depth"] = depth - values["force"] / cantilever.stiffness if place == "piezo" else depth
    if layout.get("stiffness"):
        columns["stiffness"] = layout["stiffness"]
        values["stiffness"] = _in_si(table, layout["stiffness"])[rows]
    return MeasuredCurve(
        **values, segment=None if segment is None else check.frozen(segment[rows]), name=name,
        spring_constant=cantilever.stiffness, columns=columns, remarks=tuple(remarks), table=table,
        source=source,
    )  # fmt: skip


def _in_si(table, column):
    """Numbers of a column in SI units."""
    return table.values[column[0]] * size_of(column[1])


def _in_time(values, rows, columns, remarks):
    """Rows in the order of time; without a time that does not ascend, with a remark."""
    steps = np.diff(values["time"][rows]) if "time" in values else np.ones(1)
    if np.all(steps <= 0) and np.any(steps):
        return rows[::-1]
    if (steps < 0).any() or not np.any(steps):
        text = "the time does not ascend and is left out: samples are in the order of the file"
        remarks.append(Remark(text, "left out"))
        columns["time"] = None
        del values["time"]
    return rows


def _omissions(table, rows, name, labels):
    """Remarks on columns and lines that are left out; `rows` and the column of `labels` are not."""
    lines = sorted({*table.odd, *table.lines.tolist()} - set(table.lines[rows].tolist()))
    listed = ", ".join(map(str, lines[:3])) + f" and {len(lines) - 3} more" * (len(lines) > 3)
    what = f"line{'s' * (len(lines) > 1)} {listed}: a cell is missing or not a number"
    if len(lines) > len(rows):
        raise check.MDRError(f"most lines of {name} are not rows of numbers, for example {what}")
    named = [column for column in table.words if column != labels and " " in column.strip()]
    left = [Remark(f"column {each}, which has no numbers, is left out", "left out") for each in named]
    return left + [Remark(f"left out {what}", "left out")] * bool(lines)


def _turned(depth, force):
    """Names of the quantities that have the other sign."""
    # Depth and force grow to the farther one of the largest and the smallest force: adhesion is nearer.
    # Forces of the air are none of these, by their noise of 10 standard deviations between extremes.
    noise = np.median(np.abs(np.diff(force)))
    apart = np.ptp(force) * np.clip(10 * noise / (np.ptp(force) or 1.0), 0.05, 0.2)
    ends = [end for end in (force.argmax(), force.argmin()) if abs(force[end] - force[0]) >= apart]
    peak = max(ends, key=lambda end: abs(depth[end] - depth[0]))
    turned = ["depth"] * bool(depth[peak] < depth[0]) + ["force"] * bool(force[peak] < force[0])
    # Both fall in an unloading alone, from the largest force on.
    return turned if len(turned) < 2 or abs(force[peak]) > abs(force[0]) else []
