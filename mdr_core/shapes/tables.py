"""Samples of a profile from text files, from noisy measurements and from an area function."""

import os
import re

import numpy as np
import scipy

from .. import _check

_UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9}
# As in "height/nm".
_SLASHED = re.compile(r"/\s*(mm|um|µm|μm|nm|m)\b")
_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?|[+-]?\d+,([eE][+-]?\d+)?")
#: Largest number of characters of a line.
_LONGEST_LINE = 10_000


def read_samples(path, unit, limit):
    """Radii and heights (m) in a CSV file, at most `limit` of them; `unit` if its header names none."""
    # An integer would be taken for the descriptor of an open file.
    path = os.fspath(path)
    name = str(path)
    with open(path, encoding="utf-8-sig", newline="") as file:
        try:
            return _read(_lines(file, name), unit, limit, name)
        except UnicodeDecodeError as error:
            raise ValueError(f"{name} is not UTF-8 text ({error.reason}); save it as such") from None


def _lines(file, name):
    """Lines of a file of limited length."""
    while line := file.readline(_LONGEST_LINE + 1):
        if len(line) > _LONGEST_LINE:
            raise ValueError(
                f"{name}: a line is longer than {_LONGEST_LINE} characters; use a line a sample"
            )
        yield line


def _read(lines, unit, limit, name):
    """Radii and heights (m) in a CSV file."""
    if unit is not None:
        _check.one_of("unit", unit, _UNITS)

    def width(header, cells):
        return max(len(_named(header)) or (2 if unit is None else cells), 2)

    header, rows = _rows(lines, limit, name, width)
    named = _named(header)
    units = [unit, unit] if unit else named[:2]
    if len(units) != 2 or not set(units) <= set(_UNITS):
        raise ValueError(
            f"{name}: the header must name the units of r and z, as in 'r (nm), z (nm)', out of "
            f"{', '.join(_UNITS)}; or give unit='nm'"
        )
    if unit and named and set(named[:2]) != {unit}:
        raise ValueError(f"{name}: unit={unit!r} was given, but the header says {', '.join(named)}")
    if not rows:
        raise ValueError(f"{name}: no samples; expected rows of two numbers r, z")
    r, z = np.array(rows)[:, :2].T
    return r * _UNITS[units[0]], z * _UNITS[units[1]]


def _named(header):
    """Units in brackets, or after a slash, in the last line of a header with units."""
    for line in reversed(header):
        # An opening bracket ends the one before it: a line of brackets would take quadratic time otherwise.
        if named := re.findall(r"[(\[]\s*([^(\[)\]\s]+)\s*[)\]]", line) or _SLASHED.findall(line):
            return named
    return []


def read_columns(file, limit, name):
    """Names of the columns of an open text file, and their numbers (rows, columns), at most `limit` rows.

    A name joins the words of the last two lines of the header with as many cells; it is empty without such.
    """
    header, rows = _rows(_lines(file, name), limit, name, lambda header, cells: cells, "")
    if not rows:
        raise ValueError(f"{name}: no rows of numbers")
    width, units = len(rows[0]), _named(header)
    heads = [cells for line in header if len(cells := _heads(line)) == width]
    if not heads and len(units) == width:
        heads = [units]
    elif not heads and len(units) > 1:
        raise ValueError(
            f"{name}: the header names {len(units)} units, the rows have {width} columns: where commas are "
            "decimal ones, separate columns by semicolons"
        )
    names = [" ".join(words).strip() for words in zip(*heads[-2:], strict=True)] or [""] * width
    return names, np.array(rows)


def _heads(line):
    """Cells of a line of a header, which may contain spaces."""
    line = line.strip().lstrip("#").replace('"', "")
    return [cell.strip() for cell in re.split(next((s for s in ";\t," if s in line), r"\s{2,}"), line)]


def _rows(lines, limit, name, width_of, what=", r and z first"):
    """Lines of the header, and rows of numbers; `width_of` gives their count from header and first row."""
    header, rows, width = [], [], 0
    for number, line in enumerate(lines, start=1):
        cells = _cells(line)
        try:
            values = [float(cell) for cell in cells]
        except ValueError:
            values = None
        if not rows and (values is None or line.startswith("#")):
            header.append(line)
        elif cells and not line.startswith("#"):
            width = width or width_of(header, len(cells))
            if values is None or len(values) != width:
                expected = "two numbers r, z" if width == 2 and what else f"{width} numbers{what}"
                raise ValueError(f"{name}, line {number}: expected {expected}, found {line.strip()!r:.60}")
            rows.append(values)
            if len(rows) > limit:
                raise ValueError(f"{name}: more than {limit} samples; thin them out")
    return header, rows


def _cells(line):
    """Cells of a line; a comma is a decimal sign where the cells are separated otherwise."""
    line = line.strip().replace('"', "")
    cells = re.split(r"\s*[;\t]\s*", line) if ";" in line or "\t" in line else line.split()
    if any(map(_COMMA.fullmatch, cells)) and len(cells) > 1:
        cells = [cell.replace(",", ".") for cell in cells]
    else:
        cells = re.split(r"[;,\s]+", line)
    while cells and not cells[-1]:
        cells.pop()
    return cells


def convex_fit(r, z):
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
        raise ValueError(
            "Sampled.fit z does not rise from the axis outward: use FlatPunch, or turn its sign"
        )
    used = (bends > 0) | (kinks == 0)
    kinks, bends = kinks[used], bends[used]
    vertices = np.append(kinks, radii[-1])
    return vertices, np.maximum(vertices[:, None] - kinks, 0.0) @ bends


def area_samples(coefficients, height, samples, limit):
    """Radii and heights (m) of a profile with the cross-section A(h) = Σ Cᵢ h^(2/2ⁱ)."""
    coefficients = _check.finite_array("area coefficients", coefficients).ravel()
    height = _check.positive_number("height", height, unit="m")
    samples = _check.positive_number("samples", samples)
    if not 2 <= samples <= limit or samples % 1:
        raise ValueError(f"samples = {samples:g} must be a whole number from 2 to {limit}")
    h = height * np.geomspace(1e-4, 1.0, int(samples) - 1)
    area = sum(c * h ** (2 / 2**i) for i, c in enumerate(coefficients.tolist()))
    remedy = "A must be positive and grow with h: check the coefficients and their unit, m^(2 - 2/2^i)"
    back = np.diff(area, prepend=0.0) <= 0
    _check.refuse("area A(h)", area, back, "does not grow", unit="m²", remedy=remedy)
    r, h = np.append(0.0, np.sqrt(area / np.pi)), np.append(0.0, h)
    slopes = scipy.optimize.isotonic_regression(np.diff(h) / np.diff(r), weights=np.diff(r)).x
    z = np.append(0.0, np.cumsum(slopes * np.diff(r)))
    far = np.abs(z - h) > 0.03 * np.maximum(h, 0.1 * height)
    bound, remedy = "m is where the tip is concave by more than 3 %", "the contact would not be compact"
    _check.refuse("area function: height", h, far, bound, remedy=remedy)
    return r, z
