"""Search for several curves, or parts of a curve, in the numbers of a table of one depth and force."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...base.errors import MDRError
from ...base.remark import MeasurementError, Remedy
from .question import UnknownColumns

#: Smallest jump of the depth back to its beginning, and smallest rise after it, as shares of the range.
#: Smallest jump in median steps.
_JUMP, _RISE, _STEPS = 0.2, 0.3, 5.0
#: Largest step of the force between approach and retract, as a share of its range.
_MEET = 0.3
#: Largest distance between the end of a part and the beginning of the next part, and largest range of a
#: hold, as shares of the range.
_NEXT, _STILL = 0.1, 0.02
#: Largest path of depth or force over its range: per row, and in a table with few rows. Above it, the rows
#: are scattered.
_SCATTER, _TURNS = 0.2, 3.0
#: Share of the values at each end that may be outliers.
_EXTREMES = 0.02
#: Repeated tests have a smaller range, as a share of the largest value, and fewer rows.
_SAME, _MANY = 0.3, 100
#: Smallest number of rows of a curve.
FEWEST = 5
#: Words that `by=` accepts.
WORDS = "gaps", "restart", "segments", "whole"


def place_of(columns):
    """Return the number of the column of the depth, or of the position of the piezo."""
    return (columns.get("depth") or columns["piezo"])[0]


def restarts(depth):
    """Return the rows at which the depth starts anew: it jumps back to its beginning and rises again."""
    known = np.flatnonzero(np.isfinite(depth))
    depth = depth[known]
    span = np.ptp(depth) if depth.size else 0.0
    if not span:
        return []
    steps = np.diff(depth)
    size = max(_JUMP * span, _STEPS * np.median(np.abs(steps)))
    # A column of heights falls while the depth grows.
    ends = depth[: max(2, depth.size // 20)]
    low = ends.mean() < np.median(depth) or depth[0] - depth.min() < 0.5 * span
    sign = 1.0 if low else -1.0
    jumps = (np.flatnonzero(sign * steps < -size) + 1).tolist()
    found = []
    for row, stop in pairwise([*jumps, depth.size]):
        part = sign * depth[row:stop]
        if part.size >= 3 and part.max() - part[0] > _RISE * span:
            found.append(int(known[row]))
    return found


def is_path(depth, force):
    """Whether depth and force follow a path, like one test, and are not scattered."""
    known = np.isfinite(depth) & np.isfinite(force)
    depth, force = (_without_extremes(each[known]) for each in (depth, force))
    # A dead curve of a map is a curve with constant force.
    moving = [each for each in (depth, force) if each.size and np.ptp(each)]
    if depth.size < 3 or not moving:
        return False
    same = all(np.ptp(each) < _SAME * np.abs(each).max() for each in (depth, force))
    turns = max(np.abs(np.diff(each)).sum() / np.ptp(each) for each in moving)
    return not (same and depth.size < _MANY) and turns <= max(_TURNS, _SCATTER * depth.size)


def _without_extremes(values):
    """Clip a fiftieth of the values at each end, as outliers, unless the other values are all equal."""
    if values.size < FEWEST:
        return values
    low, high = np.quantile(values, [_EXTREMES, 1 - _EXTREMES])
    return np.clip(values, low, high) if low < high else values


def has_path(table):
    """Whether two columns follow a path, one of them without equal steps or stairs, unlike a map."""
    paths, bent = 0, 0
    for values in table.values.values():
        good = values[np.isfinite(values)]
        steps = np.diff(good)
        most = max(_TURNS, _SCATTER * good.size) * np.ptp(good) if good.size else 0.0
        if good.size >= 2 * FEWEST and np.abs(steps).sum() <= most:
            paths += np.ptp(good) > 0
            bent += np.ptp(steps) > 0.1 * np.abs(steps).max() and 2 * np.unique(good).size > good.size
    return paths > 1 and bent > 0


def several(table, columns):
    """Return the reason to split a table into several curves, and their first rows, or None."""
    depth = table.values[place_of(columns)]
    rows = restarts(depth)
    if rows:
        more = f" and {len(rows) - 1} times more" * (len(rows) > 1)
        return f"the depth starts anew at line {table.lines[rows[0]]}{more}", rows
    for where, rows in _marks(table, columns):
        if _begin_again(depth, rows):
            return f"the depth is at its beginning again where {where}", rows
    return None


def _marks(table, columns):
    """Yield possible separations of curves without a jump of the depth: gaps, labels, restarts of time."""
    yield "empty lines or words separate the rows", _gaps(table)
    for number, cells in labels(table, columns).items():
        yield f"column {number} changes", _changes(cells)
    if columns.get("time"):
        yield "the time starts again", _falls(table.values[columns["time"][0]])


def _begin_again(depth, rows):
    """Whether the parts with the given first rows all begin at the depth of the first part, and rise."""
    edges = [0, *rows, depth.size]
    if not rows or len(rows) > depth.size // 4 or min(np.diff(edges)) < 3:
        return False
    span = np.ptp(depth[np.isfinite(depth)])
    far = np.abs(depth - depth[0])
    rises = [np.nanmax(far[a:b]) for a, b in pairwise(edges)]
    return bool(np.all(far[edges[:-1]] < _JUMP * span) and min(rises) > _RISE * span)


def labels(table, columns):
    """Return the cells of all unused columns, which may distinguish curves, by column number."""
    used = {column[0] for column in columns.values() if column}
    found = {k: values for k, values in table.values.items() if k not in used}
    for key, cells in table.words.items():
        filled = [cells[0]]
        for cell in cells[1:]:
            # A name may occur only at the first sample.
            filled.append(cell or filled[-1])
        found[int(key.split()[0]) - 1] = np.array(filled)
    return found


def _changes(cells):
    return (np.flatnonzero(cells[1:] != cells[:-1]) + 1).tolist()


def _falls(values):
    return (np.flatnonzero(np.diff(values) < 0) + 1).tolist()


def _gaps(table):
    """Return the rows after an empty line or words between rows."""
    return sorted({int(np.searchsorted(table.lines, gap)) for gap in table.gaps})


def key_columns(table, columns, rows):
    """Return the columns, or the first pair of columns, whose values distinguish some curves.

    The curves begin at `rows`. The columns are in order of their numbers.
    """
    edges, found = {*rows}, {}
    for number, cells in labels(table, columns).items():
        if (changes := {*_changes(cells)}) and changes <= edges:
            found[number] = [str(cells[i]) for i in (0, *rows)]
    single = [k for k, cells in sorted(found.items()) if len({*cells}) == len(cells)]
    if single:
        return single
    known = sorted(found)
    pairs = ((i, j) for i in known for j in known if i < j)
    both = ([i, j] for i, j in pairs if len({*zip(found[i], found[j], strict=True)}) == len(rows) + 1)
    pair = next(both, None)
    return [pair] if pair else []


def at_gaps(table, rows):
    """Whether curves begin exactly after the gaps."""
    return set(_gaps(table)) == set(rows)


def parts(table, by, columns):
    """Return the names and tables of the curves of a table, separated by `by`."""
    if by in (None, "whole"):
        return [("", table)]
    if by not in ("restart", "gaps"):
        return _grouped(table, by)
    depth = table.values[place_of(columns)]
    rows = restarts(depth) if by == "restart" else _gaps(table)
    if by == "restart" and not rows and columns.get("time"):
        falls = _falls(table.values[columns["time"][0]])
        rows = falls if _begin_again(depth, falls) else []
    if not rows:
        what = "the depth does not start anew" if by == "restart" else "there are no gaps between the rows"
        raise MeasurementError(
            f"nothing separates curves: {what}",
            Remedy("give", "by", "whole"),
        )
    edges = [0, *rows, len(table.lines)]
    return [(f"curve {i}", table.rows(slice(a, b))) for i, (a, b) in enumerate(pairwise(edges), 1)]


def _grouped(table, by):
    """Return the names and tables of rows with the same values in one or more columns."""
    chosen = [_column(table, each) for each in (by if isinstance(by, list | tuple) else [by])]
    if not chosen:
        raise MDRError("by = [] must name columns")
    codes = np.stack([np.unique(cells, return_inverse=True)[1].ravel() for _, cells in chosen])
    _, first, group = np.unique(codes, axis=1, return_index=True, return_inverse=True)
    group, heads = group.ravel(), " and ".join(repr(head) for head, _ in chosen)
    if first.size < 2:
        raise MeasurementError(
            f"{heads} has one value in all rows and separates no curves",
            Remedy("give", "by", "whole"),
        )
    counts = np.bincount(group)
    if counts.min() < FEWEST:
        text = (
            f"curves of fewer than {FEWEST} rows: {heads} has {first.size} values in {group.size} rows, "
            "perhaps with noise in their last digits"
        )
        raise MeasurementError(
            f"that gives {text}",
            Remedy("give", "by", "restart"),
            Remedy("give", "by", "gaps"),
        )
    found = []
    order = np.argsort(group, kind="stable")
    ends = np.cumsum(counts)
    for k in np.argsort(first):
        rows = order[ends[k] - counts[k] : ends[k]]
        names = [f"{head} {_shown(cells[rows[0]])}".strip() for head, cells in chosen]
        found.append((", ".join(names), table.rows(rows)))
    return found


def _shown(cell):
    return cell if isinstance(cell, str) else f"{cell:g}"


def _column(table, which):
    """Return the name and the cells of a column with a given number or name."""
    cells = labels(table, {})
    names = {int(key.split()[0]) - 1: key.partition(" ")[2] for key in table.words} | table.heads
    found = [k for k, head in names.items() if which in (k, head)]
    if isinstance(which, bool) or len(found) != 1:
        raise MDRError(
            f"by = {which!r:.80} must be the number or the name of one column of {names}, a list of these, "
            f"or one of {', '.join(map(repr, WORDS))}"
        )
    return names[found[0]] or f"column {found[0]}", cells[found[0]]


def goes_on(before, table, columns, span):
    """Whether a table begins where the tables before end.

    Unless these are a hold, it must not begin where they begin. `span` is the range of the depth of a
    curve; the range of a hold is a small share of it.
    """
    first, second = (known_depths(each, columns) for each in (before, [table]))
    if not first.size or not second.size or abs(second[0] - first[-1]) >= _NEXT * span:
        return False
    return bool(np.ptp(first) < _STILL * span or abs(second[0] - first[0]) > _NEXT * span)


def known_depths(tables, columns):
    """Return the depths of tables below each other, without missing values."""
    depth = np.concatenate([table.values[place_of(columns)] for table in tables])
    return depth[np.isfinite(depth)]


def below(tables):
    """Return one table from several tables with the same columns."""
    first = tables[0]
    values = {k: np.concatenate([table.values[k] for table in tables]) for k in first.values}
    words = {key: [c for t in tables for c in t.words.get(key, [""] * len(t.lines))] for key in first.words}
    odd = {number: line for table in tables for number, line in table.odd.items()}
    lines = np.concatenate([table.lines for table in tables])
    return replace(first, values=values, lines=lines, words=words, odd=odd, gaps=())


def joined(table, layouts, file):
    """Return one table of the parts of a curve that are side by side, and its columns.

    Each part is below the part before. The first part ends with its largest force, and each other part
    begins where the part before ends.
    """
    ordered, end = [], None
    for layout in layouts:
        used = [table.values[column[0]] for column in layout.values() if column]
        rows = np.flatnonzero(np.isfinite(used).all(axis=0))
        if rows.size < 2:
            raise MDRError(f"{file}: a part has fewer than two rows of numbers, {layout}")
        place, force = table.values[place_of(layout)][rows], table.values[layout["force"][0]][rows]
        if end is None:
            back = np.argmax(np.abs(force - np.median(force))) < rows.size // 2
        else:
            back = abs(place[-1] - end) < abs(place[0] - end)
        ordered.append(rows[::-1] if back else rows)
        end = place[0] if back else place[-1]
    _refuse_step(table, layouts, ordered, file)
    first = layouts[0]
    keys = [each for each in first if first[each] and all(layout.get(each) for layout in layouts)]
    parts = list(zip(layouts, ordered, strict=True))
    values = {
        first[each][0]: np.concatenate([table.values[layout[each][0]][rows] for layout, rows in parts])
        for each in keys
    }
    names = ["approach", "retract", *map(str, range(2, len(ordered)))]
    words = np.repeat(names[: len(ordered)], [rows.size for rows in ordered]).tolist()
    return replace(
        table, heads={k: table.heads[k] for k in sorted(values)}, values=values, odd={}, gaps=(),
        lines=table.lines[np.concatenate(ordered)], words={f"{max(values) + 2} segment": words},
    ), {each: first[each] for each in keys}  # fmt: skip


def _refuse_step(table, layouts, ordered, file):
    """Raise `UnknownColumns` if the force of the second part does not begin where the first part ends."""
    first, second = (
        table.values[layout["force"][0]][rows]
        for layout, rows in zip(layouts[:2], ordered[:2], strict=True)
    )
    if abs(second[0] - first[-1]) > _MEET * np.ptp(first):
        a, b = (table.heads[place_of(layout)] for layout in layouts[:2])
        why = (
            f"approach and retract do not meet: the force is {first[-1]:.4g} at the end of {a!r}, and "
            f"{second[0]:.4g} at the same place of {b!r}; one of the two may be in reversed order"
        )
        raise UnknownColumns(why, table, file, {"columns": layouts})


def continues_beside(table, layouts):
    """Whether the second of two pairs of columns begins or ends at the largest force of the first pair."""
    if len(layouts) != 2:
        return False
    tops = []
    for layout in layouts:
        place, force = table.values[place_of(layout)], np.abs(table.values[layout["force"][0]])
        known = np.flatnonzero(np.isfinite(place) & np.isfinite(force))
        if not known.size:
            return False
        top = int(np.argmax(force[known]))
        tops.append((place[known][top], np.ptp(place[known]), force[known][top], top / known.size))
    (first, span, largest, _), (second, _, other, at) = tops
    at_an_end = at < 0.1 or at > 0.9
    return bool(abs(first - second) < 0.05 * span and abs(largest - other) < 0.05 * largest and at_an_end)
