"""Tables of results with one row for each test, which are not curves."""

import numpy as np

from . import words

#: Names of sheets of results and settings.
_SHEETS = (
    "result", "summary", "statistic", "input", "analysis", "average", "ergebnis", "zusammenfassung",
    "auswertung", "résultat", "resultad", "risultat", "resumen", "riassunto", "résumé",
    "结果", "汇总", "统计",
)  # fmt: skip
#: Largest number of rows that a person would take for tests where the numbers go up and down smoothly.
_FEW = 100
#: Variation of the depth over its range, per row, above which it is scatter; and least one.
_SCATTER, _TURNS = 0.15, 3.0
#: Share of the largest value below which a range is the scatter of repeated tests.
_SAME = 0.3


def as_results(table, columns, sheet=""):
    """Why a table is one of results rather than a curve, in words; empty where it is a curve.

    `columns` are the numbers of the columns of "depth" and "force", and of "time" or None.
    """
    heads = [*table.heads.values(), *(key.partition(" ")[2] for key in table.words)]
    labels = [cell for cells in table.words.values() for cell in cells]
    marginal = [cell for cell in (*labels, *table.odd.values()) if cell and words.of_means(cell)]
    if any(words.of_means(cell) for cell in labels):
        return f"a row of {next(cell for cell in labels if words.of_means(cell)).strip()!r:.40}"
    mechanical = [head for head in heads if words.mechanical(head)]
    means = [head for head in heads if words.of_means(head)]
    numbered = _numbered(table)
    timed = columns["time"] is not None
    depth, force = (table.values[columns[each]] for each in ("depth", "force"))
    path = _is_path(depth, force)
    if path and (timed or _falls(force)):
        return ""
    deviations = [head for head in means if words.named("force", head) or words.named("depth", head)]
    if deviations and not timed:
        return f"a column of means or deviations, {deviations[0]!r}"
    signs = []
    if mechanical:
        signs.append(f"a column of {mechanical[0]!r}")
    if means or (marginal and mechanical):
        signs.append("means and deviations")
    if numbered:
        signs.append("a first column that counts the tests")
    if not path:
        signs.append("no rise and fall of the depth")
    if any(word in sheet.lower() for word in _SHEETS):
        signs.append(f"the name {sheet!r}")
    smooth = path and len(depth) > _FEW
    return " and ".join(signs) if len(signs) > 1 and not smooth else ""


def of_tests(table):
    """Names of columns that only a table of tests has, as of moduli; empty where there are not two."""
    heads = [*table.heads.values(), *(key.partition(" ")[2] for key in table.words)]
    mechanical = [head for head in heads if words.mechanical(head)]
    others = [head for head in heads if head not in mechanical and _of_whole_test(head)]
    return mechanical + others if mechanical and (others or _numbered(table)) else []


def _of_whole_test(head):
    """Whether a name is that of a mean, a largest value or another number of a whole test."""
    return words.of_means(head) or any(words.is_none(each, head) for each in ("force", "depth"))


def _falls(force):
    """Whether the force rises to a peak and falls again, some samples each."""
    force = np.abs(force[np.isfinite(force)])
    peak = int(np.argmax(force)) if force.size else 0
    return 3 <= peak < force.size - 3 and max(force[0], force[-1]) < 0.8 * force[peak]


def _numbered(table):
    """Whether the first column counts the rows from 1 on, or names them."""
    first = min([*table.heads, *(int(key.split()[0]) - 1 for key in table.words)])
    if first in table.heads:
        values, head = table.values[first], table.heads[first]
        known = np.isfinite(values)
        counted = np.array_equal(values[known], np.arange(1, known.sum() + 1))
        return counted and not words.quantity_of(head) and known.sum() > 1
    cells = next(cells for key, cells in table.words.items() if int(key.split()[0]) - 1 == first)
    filled = [cell for cell in cells if cell.strip()]
    return len(filled) > 0.8 * len(cells) and len(set(filled)) == len(filled) > 1


def _is_path(depth, force):
    """Whether depth and force go along a path: a few turns, and not the same value again and again."""
    known = np.isfinite(depth) & np.isfinite(force)
    depth, force = depth[known], force[known]
    if depth.size < 3:
        return False
    spread = [np.ptp(each) for each in (depth, force)]
    if any(each == 0 for each in spread):
        return False
    close = all(
        each < _SAME * np.abs(values).max() for each, values in zip(spread, (depth, force), strict=True)
    )
    variation = np.abs(np.diff(depth)).sum() / spread[0]
    return not close and variation <= max(_TURNS, _SCATTER * depth.size)
