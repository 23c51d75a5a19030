"""Tables of samples in text files, as instruments write them."""

import os
import re

import numpy as np

from .. import _check

_UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9}

#: Characters of a line: one that is longer is no sample.
_LONGEST_LINE = 10_000


def read_samples(path, unit, most):
    """Radii and heights (m) in a CSV file, at most so many; `unit` if its header names none."""
    # A whole number would be taken for a file that is open already, and closed in the end.
    path = os.fspath(path)
    name = str(path)
    with open(path, encoding="utf-8-sig", newline="") as file:
        try:
            return _read(_lines(file, name), unit, most, name)
        except UnicodeDecodeError as error:
            raise ValueError(f"{name} is not UTF-8 text ({error.reason}); save it as such") from None


def _lines(file, name):
    """The lines of a file, none of which may be endless."""
    while line := file.readline(_LONGEST_LINE + 1):
        if len(line) > _LONGEST_LINE:
            raise ValueError(
                f"{name}: a line is longer than {_LONGEST_LINE} characters; give a sample a line"
            )
        yield line


def _read(lines, unit, most, name):
    """Radii and heights (m) in a CSV file."""
    if unit is not None:
        _check.one_of("unit", unit, _UNITS)
    rows, named = [], []
    for number, line in enumerate(lines, start=1):
        cells = [cell for cell in re.split(r"[;,\s]+", line.strip()) if cell]
        try:
            values = [float(cell) for cell in cells]
        except ValueError:
            values = None
        if not rows and (values is None or line.startswith("#")):
            # A bracket in brackets begins anew: otherwise a line of brackets takes their number squared.
            named = re.findall(r"[(\[]\s*([^(\[)\]\s]+)\s*[)\]]", line) or named
        elif cells and not line.startswith("#"):
            if values is None or len(values) != 2:
                raise ValueError(
                    f"{name}, line {number}: expected two numbers r, z, found {line.strip()!r:.60}"
                )
            rows.append(values)
            if len(rows) > most:
                raise ValueError(f"{name}: more than {most} samples; thin them out")
    units = [unit, unit] if unit else named
    if len(units) != 2 or not set(units) <= set(_UNITS):
        raise ValueError(
            f"{name}: the header must name the units of r and z, as in 'r (nm), z (nm)', out of "
            f"{', '.join(_UNITS)}; or give unit='nm'"
        )
    if unit and named and set(named) != {unit}:
        raise ValueError(f"{name}: unit={unit!r} was given, but the header says {', '.join(named)}")
    if not rows:
        raise ValueError(f"{name}: no samples; expected rows of two numbers r, z")
    r, z = np.array(rows).T
    return r * _UNITS[units[0]], z * _UNITS[units[1]]
