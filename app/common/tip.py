"""Measured tips in files."""

from pathlib import Path
from typing import Any

import numpy as np

from mdr_core.measurements.files.table import decoded
from mdr_core.measurements.files.tips import samples_of
from mdr_core.show.units import format_quantity
from mdr_core.solver.profiles.sampled import tip_through

from .upload import MAX_SAMPLES, in_line

#: Largest numbers of samples in the fit of a tip, and of rows of a file.
_FITTED, _MAX_ROWS = 2000, 20_000
#: Deviation from the samples, relative to the height of the tip, below which it is rounding.
_ROUNDING = 1e-12


def read(path: str, name: str) -> tuple[tuple[Any, Any], str]:
    """Return radii and heights (m) of the tip in a file, and a note; see `read_tip`."""
    return read_tip(decoded(Path(path).read_bytes()), name)


def read_tip(text: str, name: str = "the file") -> tuple[tuple[Any, Any], str]:
    """Return radii and heights (m) of an uploaded tip, and a note; the header names the units.

    Long, noisy or two-sided data become the nearest convex tip. Raises ValueError.
    """
    name = in_line(name)
    r, z = samples_of(text, name, None, _MAX_ROWS)
    try:
        tip, scatter = tip_through(r, z, MAX_SAMPLES, _FITTED)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    count = len(tip.r)
    note = f"{len(r)} rows reduced to {count} samples" if len(r) > count else f"{count} samples"
    # The fit sums terms as large as the heights: the deviation may be rounding alone.
    if scatter is not None and scatter > _ROUNDING * float(np.ptp(z)):
        note += f"; rms deviation {format_quantity(scatter, 'length', 2)}"
    elif len(r) == count:
        note += ", as in the file"
    return (tip.r, tip.z), note
