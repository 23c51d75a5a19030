"""Measured curves from the columns of a table."""

import re
from dataclasses import replace
from functools import partial

import numpy as np

from .. import _check
from ..measured_curve import MeasuredCurve, named_segments, segments_of
from . import words
from .columns import SIZES, NoCurve, UnknownColumns, columns_of, size_of, stiffness_of
from .headers import unit_of
from .results import as_results, of_tests
from .several import below_each_other, jumps, retract_of, side_by_side
from .text import Table
from .units import COLUMN_UNITS, cleaned

#: Largest force (N) below which an instrument may be one with a cantilever, whose deflection counts.
_SMALL = 1e-5
#: Numbers beyond this are written where there is none.
_NONE = 1e30
#: Constants of the cantilever in a header: their names, and the kinds of their units.
_CONSTANTS = {
    "spring_constant": (r"spring[\s_-]*constant|federkonstante|constante de raideur|constante de resorte|"
                        r"costante elastica|弹性常数|弹簧常数", "stiffness"),
    "sensitivity": (r"sensitivity|invols|empfindlichkeit|sensibilit[eéà]|灵敏度", "sensitivity"),
}  # fmt: skip


def curves_of(table, name, sheet="", *, columns=None, spring_constant=None, sensitivity=None):
    """Functions that make the curves of a table: one, or several below each other or side by side."""
    options = {"spring_constant": spring_constant, "sensitivity": sensitivity}
    cantilever, _ = _cantilever(table, options)
    given = _without_stiffness(columns)
    try:
        automatic, _ = columns_of(table, name, given, cantilever)
    except UnknownColumns:
        if not given and of_tests(table):
            raise NoCurve(
                _no_curve(name, f"a row for each test: {', '.join(of_tests(table)[:4])}")
            ) from None
        raise
    if not given:
        numbers = {each: column and column[0] for each, column in automatic.items()}
        reason = as_results(table, numbers, sheet)
        if reason:
            raise NoCurve(_no_curve(name, reason))
    makers = []
    for label, part in below_each_other(table, automatic, name):
        groups = [automatic] if given else side_by_side(part, automatic)
        if groups is None:
            raise UnknownColumns(
                f"{name} has several columns of the same name, but not as many of depth as of force, "
                f"{table.heads}: "
                'give columns={"depth": (0, "nm"), "force": (1, "mN")} for one curve',
                table,
            )
        for group in groups:
            several = len(groups) > 1
            labels = [name, *[label] * bool(label), *[f"columns {_numbers(group)}"] * several]
            rows, chosen = (_trimmed(part, group), group) if several else (part, columns)
            makers.append(partial(curve_of, rows, ", ".join(labels), chosen, **options))
    return makers


def _no_curve(name, reason):
    return (
        f"{name} is a table of results, not a curve, as it has {reason}: read the file with depth and "
        "force of a test, or give columns= if this is one"
    )


def _numbers(group):
    return " and ".join(str(group[each][0] + 1) for each in ("depth", "force"))


def _without_stiffness(columns):
    return {each: column for each, column in (columns or {}).items() if each != "stiffness"}


def _trimmed(table, group):
    """A table without the rows in which a shorter curve has ended."""
    known = [np.isfinite(table.values[column[0]]) for column in group.values() if column]
    rows = np.any(known, axis=0)
    numbers = set(table.lines.tolist())
    odd = {number: line for number, line in table.odd.items() if number not in numbers}
    return replace(
        table, values={k: each[rows] for k, each in table.values.items()}, lines=table.lines[rows], odd=odd,
        words={},
    )  # fmt: skip


def curve_of(table, name, columns=None, spring_constant=None, *, turn=True, segment=None, sensitivity=None):
    """`MeasuredCurve` of a table with given columns, and others by their units and names.

    Signs are found by the numbers unless `turn` is False.
    """
    options = {"spring_constant": spring_constant, "sensitivity": sensitivity}
    known, own = _cantilever(table, options) if segment is None and turn else (options, ())
    known = {each: value for each, value in known.items() if value is not None}
    table, joined = (table, []) if columns else _with_retract(table, name, known)
    given = dict(columns or {})
    contact = given.pop("stiffness", stiffness_of(table))
    columns, remarks = columns_of(table, name, given, known)
    remarks = [*own, *joined, *remarks]
    values = {each: table.values[column[0]] for each, column in columns.items() if column}
    rows = np.flatnonzero(np.isfinite(list(values.values())).all(axis=0))
    labels, segment = named_segments(table.words) if segment is None else ("", segment)
    remarks += _omissions(table, rows, name, labels)
    if rows.size < 2:
        raise ValueError(f"{name} has one row of numbers: give a curve, with one sample per line")
    rows = _in_time(table, name, values, rows, columns, remarks)
    values = {each: value[rows] * size_of(each, columns[each][1]) for each, value in values.items()}
    _deflected(table, name, values, columns, known, sensitivity, remarks)
    for each in _turned(values["depth"], values["force"]) if turn else ():
        values[each], (column, unit) = -values[each], columns[each]
        columns[each] = column, unit[1:] if unit[0] == "−" else f"−{unit}"
        remarks.append(f"the sign of {each} is reversed: {each} is positive in compression")
    head = table.heads[columns["depth"][0]]
    values["depth"], remark = _of_tip(head, values, known.get("spring_constant"), spring_constant is None)
    arrays = {"time": None} | {each: _check.frozen(value) for each, value in values.items()}
    arrays["stiffness"] = _contact_stiffness(table, contact, rows, columns)
    arrays["segment"] = segments_of(**values) if segment is None else _check.frozen(segment[rows])
    stiffness = known.get("spring_constant")
    return MeasuredCurve(name, stiffness, None, columns, (*remarks, *remark), table, **arrays)


def _in_time(table, name, values, rows, columns, remarks):
    """Rows in the order of time; without a time that does not ascend, with a remark."""
    steps = np.diff(values["time"][rows]) if "time" in values else np.ones(1)
    if np.all(steps <= 0) and np.any(steps):
        return rows[::-1]
    starts = np.flatnonzero(steps < 0) + 1
    few = 0 < starts.size <= len(rows) // 4 and np.diff([0, *starts, len(rows)]).min() > 2
    if few and jumps(values["depth"][rows], starts):
        raise ValueError(
            f"{name}: the time starts again at line {table.lines[rows[starts[0]]]}, where the depth jumps: "
            "for several curves use one file for each, a title like 'Test 2' above each, or a column "
            "'test' with numbers"
        )
    if starts.size or not np.any(steps):
        remarks.append("the time does not ascend and is left out: samples are in the order of the file")
        columns["time"] = None
        del values["time"]
    return rows


def _cantilever(table, options):
    """Constants of the cantilever that are given, else of the file's header, and remarks on the latter."""
    known, remarks = {each: value for each, value in options.items() if value is not None}, []
    for each, (names, kind) in _CONSTANTS.items():
        if each not in known:
            value = _constant(table.header, names, kind)
            if value is not None:
                known[each] = value
                if each == "spring_constant":
                    remarks.append(f"spring_constant = {value:.6g} N/m is taken from the file")
    return known, remarks


def _constant(header, names, kind):
    """Constant of the cantilever (SI) in a header, with a unit or as JPK writes it without one, or None."""
    for line in header:
        line = cleaned(line)
        match = re.match(
            rf"[#\s\"]*(?:{names})\b([^\d=:]*)[:=;,\s]\s*([-+]?[\d.,]+(?:[eE][-+]?\d+)?)\s*(\S*)",
            line,
            re.I,
        )
        if not match:
            continue
        value = float(match[2].rstrip(",.").replace(",", "."))
        unit = unit_of("", (match[3] or match[1]).strip(' ()[],;\t"'))
        jpk = re.match(r"#\s*(springConstant|sensitivity):\s", line) and not match[3]
        size = unit.size if unit.kind == kind else 1.0 if jpk else None
        if size is not None and value > 0:
            return value * size
    return None


def _deflected(table, name, values, columns, known, sensitivity, remarks):
    """Force (N) from a deflection (m or V) where the table has that."""
    column, unit = columns["force"]
    if unit in SIZES["force"]:
        if sensitivity is not None:
            raise ValueError(f"the forces of {name} are already in units of force: leave out sensitivity")
        return
    factor, text = known["spring_constant"], "the stiffness"
    if unit.lstrip("−") in COLUMN_UNITS["voltage"]:
        factor, text = factor * known["sensitivity"], "the sensitivity and the stiffness"
    elif sensitivity is not None:
        raise ValueError(f"the deflection of {name} is already a length, in {unit}: leave out sensitivity")
    values["force"] = values["force"] * factor
    remarks.append(f"the force is the deflection {table.heads[column]!r} times {text} of the cantilever")


def _of_tip(head, values, stiffness, own):
    """Depth (m) of the tip, without the deflection F/k of a cantilever, and a remark on what was done.

    `own` is whether the stiffness is that of the file, or there is none.
    """
    depth, force = values["depth"], values["force"]
    says, piezo = words.says_depth(head), words.says_piezo(head)
    if stiffness is not None and not says:
        what = (
            "is the position of the piezo"
            if piezo
            else "is not named as a depth, and is taken as the position of the piezo"
        )
        return depth - force / stiffness, [
            f"{head!r} {what}: the deflection, force over stiffness, is subtracted"
        ]
    if stiffness is not None:
        text = f"{head!r} is taken as the depth of the tip: no deflection is subtracted"
        return depth, [] if own else [text]
    if piezo:
        return depth, [f"{head!r} includes the deflection force/stiffness: give spring_constant= (N/m)"]
    if not says and np.abs(force).max() < _SMALL:
        text = f"{head!r} is not named as a depth: if it is the position of a piezo, it includes"
        return depth, [f"{text} the deflection force/stiffness: give spring_constant= (N/m)"]
    return depth, []


def _contact_stiffness(table, contact, rows, columns):
    """Contact stiffness (N/m) at each sample, or None, and its column beside the others."""
    if contact is None:
        return None
    column, size = contact
    if isinstance(size, str):
        unit = unit_of("", size)
        if column not in table.values or unit.kind != "stiffness" or unit.doubt:
            raise ValueError(
                f"columns: stiffness = {contact!r} must be the number of a column of {table.heads} and a "
                'unit of stiffness, as in (4, "N/m")'
            )
        size = unit.size
    unit = f"{size:g} N/m" if size != 1 else "N/m"
    columns["stiffness"] = column, table.unit_of(column).name or unit
    stiffness = table.values[column][rows] * size
    # Instruments write 1.8e308 where there is none.
    return _check.frozen(np.where(np.abs(stiffness) < _NONE, stiffness, np.nan))


def _with_retract(table, name, known):
    """A table with approach and retract below each other where they stand side by side, and a remark."""
    columns, _ = columns_of(table, name, {}, known)
    others = retract_of(table, columns)
    if others is None:
        return table, []
    rows = [
        np.flatnonzero(
            np.isfinite([table.values[part[each][0]] for each in ("depth", "force")]).all(axis=0)
        )
        for part in (columns, others)
    ]
    if min(map(len, rows)) < 2:
        return table, []
    first, second = rows
    force = table.values[columns["force"][0]][first]
    # An approach ends with the largest force.
    pressed = np.argmax(np.abs(force - np.median(force)))
    first = first[::-1] if pressed < len(first) // 2 else first
    depth = table.values[columns["depth"][0]][first]
    back = table.values[others["depth"][0]][second]
    second = second[::-1] if abs(back[-1] - depth[-1]) < abs(back[0] - depth[-1]) else second
    values = {
        columns[each][0]: np.append(
            table.values[columns[each][0]][first], table.values[others[each][0]][second]
        )
        for each in ("depth", "force")
    }
    heads = {k: table.heads[k] for k in sorted(values)}
    joined = Table(
        heads, values, np.append(table.lines[first], table.lines[second]),
        {n: line for n, line in table.odd.items() if n not in set(table.lines.tolist())},
        {f"{max(heads) + 2} segment": ["approach"] * len(first) + ["retract"] * len(second)},
        {k: unit for k, unit in table.units.items() if k in heads}, table.header,
    )  # fmt: skip
    retract = " and ".join(repr(table.heads[others[each][0]]) for each in ("depth", "force"))
    return joined, [f"the retract is taken from the columns {retract}"]


def _omissions(table, rows, name, labels):
    """Remarks on columns and lines that are left out; `rows` and the column of `labels` are not."""
    lines = sorted({*table.odd, *table.lines.tolist()} - set(table.lines[rows].tolist()))
    listed = ", ".join(map(str, lines[:3])) + f" and {len(lines) - 3} more" * (len(lines) > 3)
    what = f"line{'s' * (len(lines) > 1)} {listed}: a cell is missing or not a number"
    if len(lines) > len(rows):
        raise ValueError(f"most lines of {name} are not rows of numbers, for example {what}")
    named = [column for column in table.words if column != labels and " " in column.strip()]
    left = [f"column {column}, which has no numbers, is left out" for column in named]
    return left + [f"left out {what}"] * bool(lines)


def _turned(depth, force):
    """Names of the quantities that have the other sign."""
    # Depth and force grow to the farther one of the largest and the smallest force: adhesion is nearer.
    apart = 0.2 * np.ptp(force)
    ends = [end for end in (force.argmax(), force.argmin()) if abs(force[end] - force[0]) >= apart]
    peak = max(ends, key=lambda end: abs(depth[end] - depth[0]))
    turned = ["depth"] * bool(depth[peak] < depth[0]) + ["force"] * bool(force[peak] < force[0])
    # Both fall in an unloading alone, from the largest force on.
    return turned if len(turned) < 2 or abs(force[peak]) > abs(force[0]) else []
