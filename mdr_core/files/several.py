"""Several curves in one table: below each other, distinguished by a column, or side by side."""

import re
from dataclasses import replace

import numpy as np

from . import words
from .columns import SIZES
from .units import unit_named

#: Names of the approach and the retract in the names of columns that stand side by side.
_PAIRS = (
    ("ex", "rt"), ("ext", "ret"), ("extend", "retract"), ("extension", "retraction"),
    ("approach", "retract"), ("approach", "withdraw"), ("trace", "retrace"), ("forward", "backward"),
    ("loading", "unloading"), ("app", "ret"), ("hin", "rück"), ("aller", "retour"),
)  # fmt: skip
#: Most curves that a column tells apart; and largest step at the edge of two parts of one curve, as a share
#: of the range of the depth, and in median steps.
_MOST, _EDGE, _STEPS = 10_000, 0.1, 5.0


def below_each_other(table, columns, name):
    """Names and tables of the curves of which a column of labels or of whole numbers tells the rows."""
    blocks = _blocks(table, columns, name)
    if blocks is None:
        return [("", table)]
    head, edges, labels = blocks
    # These cells are in the names of the curves.
    table = replace(
        table, words={key: cells for key, cells in table.words.items() if key.partition(" ")[2] != head}
    )
    return [
        (f"{head} {label}".strip(), _rows(table, slice(start, stop)))
        for (start, stop), label in zip(edges, labels, strict=True)
    ]


def _rows(table, part):
    """A part of the rows of a table, with the odd lines between them."""
    lines = table.lines[part]
    odd = {number: line for number, line in table.odd.items() if lines[0] <= number <= lines[-1]}
    cells = {key: cells[part] for key, cells in table.words.items()}
    values = {k: each[part] for k, each in table.values.items()}
    return replace(table, values=values, lines=lines, odd=odd, words=cells)


def _blocks(table, columns, name):
    """Name of the column that tells curves apart, their first and last rows, and labels; or None."""
    used = {column[0] for column in columns.values() if column}
    candidates = [(key.partition(" ")[2], cells) for key, cells in table.words.items()]
    for k, values in table.values.items():
        whole = k not in used and np.all(np.isfinite(values)) and np.all(values == np.round(values))
        if whole and not table.unit_of(k).kind:
            candidates.append((table.heads[k], [f"{value:.0f}" for value in values]))
    for head, cells in candidates:
        if len(cells) < 4 or not all(cell.strip() for cell in cells) or words.numbers_parts(head):
            continue
        changes = [i for i in range(1, len(cells)) if cells[i] != cells[i - 1]]
        if not changes or len(changes) >= min(_MOST, len(cells) // 3):
            continue
        edges = list(zip([0, *changes], [*changes, len(cells)], strict=True))
        labels = [cells[start] for start, _ in edges]
        if min(stop - start for start, stop in edges) < 3 or _of_segments(labels):
            continue
        if len(set(labels)) < len(labels):
            continue
        restarts = _restarts(table, columns, edges)
        if words.numbers_samples(head) and (restarts or _complete(table, columns, edges)):
            return (head if head else "curve"), edges, labels
        if not all(cell.lstrip("-").isdigit() for cell in labels) and restarts:
            return head, edges, labels
        if restarts:
            raise ValueError(
                f"{name}: depth and force start again where the column {head!r} changes, at line "
                f"{table.lines[changes[0]]}: if these are several curves, name it 'test', or give "
                "each a file"
            )
    return None


def _of_segments(labels):
    """Whether labels are names of segments, as load and unload."""
    return all(
        re.search("load|approach|retract|extend|hold|dwell|pause|withdraw|belast|entlast|halte|peak|begin|end|marker",
                  label, re.I)
        for label in labels
    )  # fmt: skip


def _restarts(table, columns, edges):
    """Whether the depth, and the time if there is one, jump back where each part begins."""
    depth = table.values[columns["depth"][0]]
    if columns["time"]:
        time = table.values[columns["time"][0]]
        if all(time[start] >= time[start - 1] for start, _ in edges[1:]):
            return False
        if all(time[start] < time[start - 1] for start, _ in edges[1:]):
            return True
    return jumps(depth, [start for start, _ in edges[1:]])


def jumps(depth, starts):
    """Whether the depth jumps before each of some samples, by more than its steps."""
    size = max(
        _EDGE * np.nanmax(depth) - _EDGE * np.nanmin(depth), _STEPS * np.nanmedian(np.abs(np.diff(depth)))
    )
    return all(abs(depth[start] - depth[start - 1]) > size for start in starts)


def _complete(table, columns, edges):
    """Whether the force of each part begins at less than half of its largest value."""
    force = np.abs(table.values[columns["force"][0]])
    for start, stop in edges:
        part = force[start:stop]
        if not part[0] < 0.5 * part.max():
            return False
    return True


def side_by_side(table, columns):
    """Columns of each curve where the names of depth and force occur as often as there are curves.

    The first entry are `columns`. Returns None where a name occurs in another number.
    """
    keys = {each: _key(table, columns[each][0]) for each in ("depth", "force")}
    same = {
        each: [k for k in table.heads if _key(table, k) == key and table.unit(k) in SIZES[each]]
        for each, key in keys.items()
    }
    if columns["force"][1].lstrip("−") not in SIZES["force"]:
        return [columns]
    count = len(same["depth"])
    if count == len(same["force"]) == 1:
        return [columns]
    if count != len(same["force"]):
        # One quantity in several units is that of one curve.
        units = [[table.unit(k) for k in each] for each in same.values()]
        return [columns] if all(len(set(each)) == len(each) for each in units) else None
    time = columns["time"]
    times = [
        k
        for k in table.heads
        if time and _key(table, k) == _key(table, time[0]) and table.unit(k) in SIZES["time"]
    ]
    groups = []
    for i in range(count):
        group = {each: (same[each][i], table.unit(same[each][i])) for each in ("depth", "force")}
        group["time"] = (times[i], table.unit(times[i])) if len(times) == count else time
        groups.append(group)
    return groups


def _key(table, column):
    """Name of a column without its unit and a number at its end."""
    head = table.heads[column].removesuffix(table.units.get(column, ""))
    head = re.sub(
        r"[(\[{]([^()\[\]{}]*)[)\]}]", lambda match: " " if unit_named(match[1]) else match[0], head
    )
    name = words.normal(re.sub(r"/.*$", " ", head))
    name = re.sub(r"[\s.]*\d+$", "", name)
    unit = table.unit(column)
    return re.sub(rf"\s*\b{re.escape(words.normal(unit))}$", "", name) if unit else name


def retract_of(table, columns):
    """Columns of the retract that stands beside the approach of `columns`, or None."""
    heads = {words.normal(head): k for k, head in table.heads.items()}
    for first, second in _PAIRS:
        pattern = re.compile(rf"(?<![^\W\d_]){first}(?![^\W\d_])")
        others = {}
        for each, column in columns.items():
            if each in ("depth", "force"):
                name = words.normal(table.heads[column[0]])
                other = heads.get(pattern.sub(second, name)) if pattern.search(name) else None
                if other is not None and table.unit(other) == table.unit(column[0]):
                    others[each] = (other, column[1])
        if len(others) == 2:
            return others | {"time": None}
    return None
