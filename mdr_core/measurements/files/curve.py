"""Measured curves from the columns of a table, whatever the words of its header."""

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
    """Return functions that make the curves of a table, from `columns` and `by` or an unambiguous header.

    `given` has the constants of a cantilever, "spring_constant" and "sensitivity".
    """
    given, name = given or {}, ", ".join(filter(None, (file, table.name)))
    if isinstance(columns, list | tuple):
        return _side_by_side(table, file, [told(table, name, each) for each in columns], by, given)
    if by == "segments":
        raise MeasurementError(
            f"{name} has no further columns or tables with parts of a curve",
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
            # A column may not separate all curves.
            ask_for_parts(table, file, layout)
        called = f"{name}, {label}" if label else name
        found.append(curve_factory(part, called, layout, given, source, **options))
    return found


def _said(columns, by):
    """Return the arguments of `read_curves` for these columns."""
    return {"columns": columns} | ({} if by is None else {"by": by})


def _side_by_side(table, file, layouts, by, given):
    """Return functions that make a curve from each layout of a table, or one curve from all parts."""
    name = ", ".join(filter(None, (file, table.name)))
    layouts = [{each: column for each, column in layout.items() if column} for layout in layouts]
    if not layouts or not all("force" in each and {"depth", "piezo"} & each.keys() for each in layouts):
        raise check.MDRError(
            f"columns of {name}: each item of the list needs a depth (or piezo) and a force"
        )
    if by == "segments":
        if len(layouts) < 2:
            raise MeasurementError(
                f"a curve with parts needs two or more columns of depth and of force, but {name} has one",
                Remedy("give", "by"),
            )
        asked = _said(layouts, by)
        table, layout = joined(table, layouts, file)
        return [curve_factory(table, name, layout, given, "as told", asked=asked)]
    if by is not None:
        raise check.MDRError(
            f"by = {by!r:.80}: each item of the list of columns is a curve; leave out by, or give "
            "by='segments' for parts of one curve"
        )
    options = {"source": "as told", "asked": _said(layouts, by)}
    return [
        curve_factory(trimmed(table, each), f"{name}, columns {_numbers(each)}", each, given, **options)
        for each in layouts
    ]


def _numbers(layout):
    return f"{place_of(layout) + 1} and {layout['force'][0] + 1}"


def trimmed(table, layout):
    """Return a table without the rows below the end of a shorter curve."""
    rows = np.any([np.isfinite(table.values[column[0]]) for column in layout.values()], axis=0)
    numbers = {*table.lines.tolist()}
    odd = {number: line for number, line in table.odd.items() if number not in numbers}
    values = {k: each[rows] for k, each in table.values.items()}
    return replace(table, values=values, lines=table.lines[rows], odd=odd, words={})


def curve_factory(table, name, layout, given, source, *, asked=None, **options):
    """Return a function that makes the curve of a table; raise an error now if a constant is missing.

    `asked` are the arguments of `read_curves` that determine the columns, None for a known format.
    """
    cantilever = constants(table, name, layout, given, asked or {})
    return partial(curve_of, table, name, layout, cantilever, source, **options)


def curve_of(table, name, layout, cantilever, source, *, turn=True, segment=None, remarks=()):
    """Return the `MeasuredCurve` of a table with the columns and units of `layout`.

    The deflection is subtracted from the position of a "piezo" but not from a "depth". `source` is the
    source of the columns. The numbers determine the signs unless `turn` is False.
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
    """Return the numbers of a column in SI units."""
    return table.values[column[0]] * size_of(column[1])


def _in_time(values, rows, columns, remarks):
    """Return the rows in order of time; drop a time that does not ascend, with a remark."""
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
    """Return remarks on omitted columns and lines, all except `rows` and the column of `labels`."""
    lines = sorted({*table.odd, *table.lines.tolist()} - set(table.lines[rows].tolist()))
    listed = ", ".join(map(str, lines[:3])) + f" and {len(lines) - 3} more" * (len(lines) > 3)
    what = f"line{'s' * (len(lines) > 1)} {listed}: a cell is missing or not a number"
    if len(lines) > len(rows):
        raise check.MDRError(f"most lines of {name} are not rows of numbers, for example {what}")
    named = [column for column in table.words if column != labels and " " in column.strip()]
    left = [Remark(f"column {each}, which has no numbers, is left out", "left out") for each in named]
    return left + [Remark(f"left out {what}", "left out")] * bool(lines)


def _turned(depth, force):
    """Return the names of the quantities with reversed sign."""
    # Depth and force grow towards the largest or the smallest force, whichever is farther from the start in
    # depth; the extreme of adhesion is nearer. Noise in the air does not count, with 10 standard deviations
    # between its extremes.
    noise = np.median(np.abs(np.diff(force)))
    apart = np.ptp(force) * np.clip(10 * noise / (np.ptp(force) or 1.0), 0.05, 0.2)
    ends = [end for end in (force.argmax(), force.argmin()) if abs(force[end] - force[0]) >= apart]
    peak = max(ends, key=lambda end: abs(depth[end] - depth[0]))
    turned = ["depth"] * bool(depth[peak] < depth[0]) + ["force"] * bool(force[peak] < force[0])
    # In a record of unloading only, both fall from the largest force.
    return turned if len(turned) < 2 or abs(force[peak]) > abs(force[0]) else []
