"""Uploaded files, and measured tips in them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from mdr_core.files.tips import samples_of
from mdr_core.profiles.sampled import tip_through
from mdr_core.show.units import written

#: Most samples that are pressed without keeping everybody waiting, most that a tip is fitted to or that are
#: taken of a curve, most rows of a tip and most bytes of a file.
MAX_SAMPLES, FITTED, _MAX_ROWS, MAX_BYTES = 60, 2000, 20_000, 5_000_000
#: Share of the height of a tip below which a deviation from its samples is one of rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Uploaded:
    """A file from the browser: name, size (bytes), and data unless it is too large to be sent."""

    name: str
    size: int
    data: bytes | None

    def read(self) -> bytes:
        """Data of the file. Raises ValueError if it is too large."""
        if self.data is None or len(self.data) > MAX_BYTES:
            sizes = f"{self.size / 1e6:.3g} MB, more than {MAX_BYTES / 1e6:g} MB"
            raise ValueError(f"{self.name:.80} has {sizes}; thin out its samples")
        return self.data


def in_line(name: str) -> str:
    """Name of a file in a line of text."""
    return " ".join(name.split())[:80]


def read_tip(text: str, name: str = "the file") -> tuple[tuple[Any, Any], str]:
    """Radii and heights (m) of an uploaded tip, and a note; the header names the units.

    Long, noisy or two-sided data become the nearest convex tip. Raises ValueError.
    """
    name = in_line(name)
    r, z = samples_of(text, name, None, _MAX_ROWS)
    try:
        tip, scatter = tip_through(r, z, MAX_SAMPLES, FITTED)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    count = len(tip.r)
    note = f"{len(r)} rows reduced to {count} samples" if len(r) > count else f"{count} samples"
    # The fit is a sum of terms as large as the heights, of which rounding alone may be left.
    if scatter is not None and scatter > _ROUNDING * float(np.ptp(z)):
        note += f"; rms deviation {written(scatter, 'length', 2)}"
    elif len(r) == count:
        note += ", as in the file"
    return (tip.r, tip.z), note
