"""Tables of numbers from text files, and samples of a profile from heights or an area function."""

import re
from collections import Counter
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite, nan

import numpy as np
import scipy

from .. import _check
from .._check import Array
from ..results.quantities import engineering

#: Sizes of units (SI) by their kind.
UNITS = {
    "length": {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9, "pm": 1e-12, "Å": 1e-10},
    "force": {"kN": 1e3, "N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9, "pN": 1e-12},
    "time": {"min": 60.0, "s": 1.0, "ms": 1e-3, "µs": 1e-6},
    "voltage": {"V": 1.0, "mV": 1e-3},
}
_KNOWN = set().union(*UNITS.values())
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
# An opening bracket ends the one before it: a line of brackets would take quadratic time otherwise.
_BRACKETS = re.compile(r"[(\[]\s*(?:in\s+)?([^(\[)\]\s]+)\s*[)\]]")
#: Metres that are spelled, and their prefixes.
_PREFIXES = {"": "", "milli": "m", "micro": "µ", "nano": "n", "pico": "p"}
_SPELLED = re.compile(rf"({'|'.join(_PREFIXES)})met(?:re|er)s?", re.IGNORECASE)
#: Misfit of a convex profile, over the noise and over the height, above which samples have another shape.
#: Noise that is averaged over five neighbours looks 2.9 times smaller.
_MISFIT, _SHARE = 4.0, 0.005
#: Mean square of the autocorrelation of residuals above which they are waves, number of samples from which
#: it is known, and its lags. Noise that is averaged over five neighbours has none at these lags.
_WAVY, _ENOUGH_FOR_WAVES, _LAGS = 0.15, 50, range(6, 26)
#: Fewest samples whose noise is known.
_ENOUGH = 8
#: Share of the height below which an area function need not grow, and largest radius of a tip over its
#: height, and height over radius.
_BLUNT, _WIDEST = 0.05, 100.0
#: Largest number of characters of a line.
_LONGEST_LINE = 10_000


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers of a text file, by the number of the column from 0 on.

    `heads` are their names and `values` their numbers, NaN for cells that are none. `lines` are the line
    numbers of the rows, `odd` the text of lines with another number of cells or a cell that is no number,
    by their number. `words` are the cells of the columns that have no numbers in most rows.
    """

    heads: dict[int, str]
    values: dict[int, Array]
    lines: Array
    odd: dict[int, str]
    words: dict[str, list[str]]

    def unit(self, column):
        """Known unit in the name of a column, in brackets, after a slash or last; else the empty text."""
        head = self.heads[column]
        before, _, last = re.split(r"[\s,_]+", head)[-1].rpartition("/")
        # "N/m" is the unit of a stiffness.
        names = (*_BRACKETS.findall(head)[-1:], "" if unit_named(before) else last)
        return next(filter(None, map(unit_named, names)), "")


def decoded(data):
    """Text of the bytes of a file in UTF-8, UTF-16 or Windows-1252."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    if b"\0" in data[:2]:
        return data.decode("utf-16-be" if data[0] == 0 else "utf-16-le", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def read_table(text, name, limit=10**7):
    """`Table` of a text: a header, and rows of numbers separated by commas, semicolons, tabs or blanks.

    Lines that start with # belong to the header, or are comments. More samples than `limit` are refused.
    """
    lines = [pair for pair in enumerate(text.splitlines()[: 2 * limit], 1) if pair[1].strip()]
    if not lines:
        raise ValueError(f"{name} is empty")
    if any(len(line) > _LONGEST_LINE for _, line in lines):
        raise ValueError(f"{name}: a line is longer than {_LONGEST_LINE} characters; use a line a sample")
    cells = [[] if line.startswith("#") else _cells(line) for _, line in lines]
    rows = [[_number(cell) for cell in row] for row in cells]
    # Rows have numbers in half of their cells; a header may have some in one of its lines.
    counts = [len(row) if 2 * sum(map(isfinite, row)) >= len(row) else 0 for row in rows]
    if not any(counts):
        raise ValueError(f"{name}: no samples; expected rows of numbers")
    width = Counter(filter(None, counts)).most_common(1)[0][0]
    pairs = pairwise([i for i, row in enumerate(cells) if row])
    first = next((i for i, j in pairs if counts[i] == counts[j] == width), counts.index(width))
    heads = _heads([line for _, line in lines[:first]], width, f"{name}, line {lines[first][0]}")
    whole = [i for i in range(first, len(rows)) if len(rows[i]) == width]
    if len(whole) > limit:
        raise ValueError(f"{name}: more than {limit} samples; thin them out")
    values = np.array([rows[i] for i in whole])
    numeric = [k for k in range(width) if 2 * np.count_nonzero(np.isfinite(values[:, k])) >= len(values)]
    good = {i for i in whole if all(isfinite(rows[i][k]) for k in numeric)}
    return Table(
        {k: heads[k] for k in numeric}, {k: values[:, k] for k in numeric},
        np.array([lines[i][0] for i in whole]),
        {lines[i][0]: lines[i][1] for i in range(first, len(rows)) if rows[i] and i not in good},
        {f"{k + 1} {heads[k]}": [cells[i][k] for i in whole] for k in range(width) if k not in numeric},
    )  # fmt: skip


def _cells(line):
    """Cells of a line; a comma is a decimal sign where the cells are separated otherwise."""
    line = line.replace('"', "")
    separated = ";" in line or "\t" in line
    cells = re.split(r" *[;\t] *", line.strip(" ")) if separated else line.split()
    if len(cells) > 1 and any(map(_DECIMAL_COMMA.fullmatch, cells)):
        return [cell.replace(",", ".") for cell in cells]
    return cells if separated or "," not in line else line.split(",")


def _number(cell):
    try:
        return float(cell)
    except ValueError:
        return nan


def unit_named(text):
    """Name of a known unit as in `UNITS`, or None."""
    text = re.sub(r"^[uμ](?=[mNs]$)", "µ", text)
    if spelled := _SPELLED.fullmatch(text):
        text = _PREFIXES[spelled[1].lower()] + "m"
    return text if text in _KNOWN else None


def _heads(header, width, place):
    """Names of the columns: the last line of that width in a header, and the one above a line of units."""
    rows = []
    for line in header:
        line = re.sub(r"^#\s*(\w+:\s)?", "", line).replace('"', "").strip(" ")
        separator = next((s for s in ";\t," if s in line), None)
        cells = line.split(separator) if separator else re.split(r"\s{2,}", line)
        # Rows or header may end in a separator.
        splits = [cells, cells[:-1], *[[*cells, ""]] * (separator in (";", "\t"))]
        splits += [line.split()] * (separator is None)
        rows += [cells for cells in splits if len(cells) == width][:1]
    units = _BRACKETS.findall(header[-1]) if header else []
    if not rows and len(units) not in (0, 1, width):
        count = "two" if len(units) == 2 else len(units)
        raise ValueError(
            f"{place}: expected {count} numbers, as the header names {count} units, found {width}; where "
            "commas are decimal ones, separate columns by semicolons"
        )
    rows = rows or [units if len(units) == width else [""] * width]
    last = 2 if any(unit_named(cell.strip(" ()[]")) for cell in rows[-1]) else 1
    return [" ".join(words).strip() for words in zip(*rows[-last:], strict=True)]


def samples_of(text, name, unit, limit, remedy=""):
    """Radii and heights (m) in a text, at most `limit` of them; `unit` if its header names none.

    `remedy` is what else the caller can do where no unit is named.
    """
    if unit is not None:
        _check.one_of("unit", unit, (*UNITS["length"], "um"))
    table = read_table(text, name, limit)
    count = len(table.heads)
    if table.odd or count < 2:
        number = min(table.odd, default=table.lines[0])
        expected = "two numbers r, z" if count <= 2 else f"{count} numbers, r and z first"
        line = f", found {table.odd[number].strip()!r:.60}" if table.odd else ""
        raise ValueError(f"{name}, line {number}: expected {expected}{line}")
    columns = list(table.heads)[:2]
    named = [u if u in UNITS["length"] else None for u in map(table.unit, columns)]
    if unit is None and None in named:
        raise ValueError(
            f"{name}: the header must name the units of r and z, as in 'r (nm), z (nm)', out of "
            f"{', '.join(UNITS['length'])}{remedy}"
        )
    units = named if unit is None else [unit_named(unit)] * 2
    if any(named) and named != units:
        given = ", ".join(filter(None, named))
        raise ValueError(f"{name}: unit={unit!r} was given, but the header says {given}")
    r, z = map(table.values.get, columns)
    return r * UNITS["length"][units[0]], z * UNITS["length"][units[1]]


def axis_of_symmetry(r, z):
    """Radius (m) of the axis of noisy samples on both of its sides, near the lowest one."""
    order = np.argsort(r, kind="stable")
    r, z, width = r[order], z[order], np.ptp(r)
    lowest = np.clip(r[np.argmin(z)], r[0] + 0.2 * width, r[-1] - 0.2 * width)
    axes = lowest + 0.1 * width * np.linspace(-1, 1, 41)
    distance = np.linspace(0, min(axes[0] - r[0], r[-1] - axes[-1]), 400)
    sides = (np.interp(axes[:, None] + side * distance, r, z) for side in (1, -1))
    # Their difference grows as a square; with noise it has many minima.
    a, b, _ = np.polyfit(axes - lowest, np.mean(np.subtract(*sides) ** 2, axis=1), 2)
    return float(lowest + np.clip(-b / (2 * a), axes[0] - lowest, axes[-1] - lowest)) if a > 0 else lowest


def convex_fit(r, z):
    """Radii and heights (m) of the convex polygon nearest to samples at radii r (m) on one or both sides.

    Each side must be near a convex polygon of its own: waves of one would be taken for noise of the other.
    """
    fit = _nearest_convex(np.abs(r), z)
    for side in (r >= 0, r <= 0):
        if np.count_nonzero(side) >= _ENOUGH:
            x, y = np.abs(r[side]), z[side]
            vertices, heights = fit if side.all() else _nearest_convex(x, y)
            _refuse_misfit(x, y - np.interp(x, vertices, heights), np.ptp(y))
    return fit


def _nearest_convex(r, z):
    """Radii and heights (m) of the convex polygon nearest to samples at radii r ≥ 0 (m).

    z₀ + Σ bₖ (r − ρₖ)₊ with bends bₖ ≥ 0 at kinks ρₖ from the axis out, by non-negative least squares.
    """
    radii = np.unique(r)
    # At most 200 kinks; one at the last radius would have no samples outside it.
    kinks = np.unique(np.append(0.0, radii[:-1][:: max(1, -(-radii.size // 200))]))
    ramps = np.maximum(r[:, None] - kinks, 0.0) / radii[-1]
    # Two columns for the height at the axis, which has either sign.
    columns = np.column_stack([np.ones_like(r), -np.ones_like(r), ramps])
    size = np.ptp(z) or 1.0
    _, _, *bends = scipy.optimize.nnls(columns, (z - z.mean()) / size)[0]
    bends = np.array(bends) * size / radii[-1]
    if not np.any(bends > 0):
        raise ValueError("z does not rise from the axis outward: use FlatPunch, or turn its sign")
    used = (bends > 0) | (kinks == 0)
    kinks, bends = kinks[used], bends[used]
    vertices = np.append(kinks, radii[-1])
    return vertices, np.maximum(vertices[:, None] - kinks, 0.0) @ bends


def _refuse_misfit(r, residual, height):
    """Refuse samples of which no convex profile is near: residuals (m) that are a curve, not noise.

    Their third differences are those of noise alone: those of a wave of eight samples or more are a tenth.
    Waves of any length are correlated with themselves, also among noise.
    """
    order = np.argsort(r, kind="stable")
    residual = residual[order] - np.mean(residual)
    miss = np.std(residual)
    if miss <= _SHARE * height:
        return
    noise = np.sqrt(np.mean(np.diff(residual, 3) ** 2) / 20)
    if miss > _MISFIT * noise or (residual.size >= _ENOUGH_FOR_WAVES and _correlation(residual) > _WAVY):
        miss = engineering(float(f"{miss:.2g}"), "m")
        worst = engineering(float(f"{r[order][np.argmax(np.abs(residual))]:.2g}"), "m")
        raise ValueError(
            f"the nearest convex profile misses the samples by {miss} (rms, most at r = "
            f"{worst}), which is not noise: the tip is wavy or concave, so that the contact would "
            "not be compact; smooth the samples, or leave out those outside the convex part"
        )


def _correlation(residual):
    """Mean square of the autocorrelation of residuals: a²/2 for waves with a share a of the variance."""
    residual = residual / np.sqrt(np.sum(residual**2))
    return np.mean([np.dot(residual[lag:], residual[:-lag]) ** 2 for lag in _LAGS])


def area_samples(coefficients, height, samples, limit, unit):
    """Radii and heights (m) of a profile with A(h) = Σ Cᵢ h^(2/2ⁱ), of A in unit² and h in a unit."""
    coefficients = _check.finite_array("area coefficients", coefficients).ravel()
    height = _check.positive_number("height", height, unit="m")
    samples = _check.positive_number("samples", samples)
    _check.one_of("unit", unit, (*UNITS["length"], "um"))
    if not 2 <= samples <= limit or samples % 1:
        raise ValueError(f"samples = {samples:g} must be a whole number from 2 to {limit}")
    size = UNITS["length"][unit_named(unit)]
    h = height * np.geomspace(1e-4, 1.0, int(samples) - 1)
    powers = 2.0 / 2.0 ** np.arange(coefficients.size)
    area = size**2 * ((h[:, None] / size) ** powers @ coefficients)
    remedy = f"A must be positive and grow with h: check the coefficients and their unit, {unit}"
    back = (np.diff(area, prepend=0.0) <= 0) | (area <= 0)
    _check.refuse(
        "area A(h)", area, back & (h > _BLUNT * height), "does not grow", unit="m²", remedy=remedy
    )
    # Below its calibration a function may fall: from there to the axis the tip is a cone.
    first = int(np.flatnonzero(back)[-1]) + 1 if back.any() else 0
    h, radius = h[first:], np.sqrt(area[first:] / np.pi)
    wide = radius[-1] / height
    if not 1 / _WIDEST < wide < _WIDEST:
        raise ValueError(
            f"area coefficients: at height = {height:g} m the radius would be {radius[-1]:.3g} m, "
            f"{wide:.2g} times the height: check the unit of the coefficients, {unit}"
        )
    r, h = np.append(0.0, radius), np.append(0.0, h)
    slopes = scipy.optimize.isotonic_regression(np.diff(h) / np.diff(r), weights=np.diff(r)).x
    z = np.append(0.0, np.cumsum(slopes * np.diff(r)))
    far = np.abs(z - h) > 0.03 * np.maximum(h, 0.1 * height)
    bound = "is where the tip is concave by more than 3 %"
    remedy = "the contact would not be compact"
    _check.refuse("area function: height", h, far, bound, unit="m", remedy=remedy)
    return r, z
