"""Uploaded files, and measured tips in them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.profiles.samples import axis_of_symmetry, samples_of

from .units import written

#: Most samples that are pressed without keeping everybody waiting, most that a tip is fitted to or that are
#: taken of a curve, most rows of a tip and most bytes of a file.
MAX_SAMPLES, FITTED, _MAX_ROWS, MAX_BYTES = 60, 2000, 20_000, 5_000_000


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

    Long, noisy or two-sided data become the nearest convex tip, see `mdr.Sampled.fit`. Raises ValueError.
    """
    name = in_line(name)
    r, z = samples_of(text, name, None, _MAX_ROWS)
    try:
        if len(r) <= MAX_SAMPLES:
            return (mdr.Sampled(r, z).r, z - z[0]), f"{len(r)} samples, as in the file"
    except ValueError:
        # Noise makes any tip concave somewhere.
        pass
    rows = len(r)
    if min(r) < 0 < max(r):
        r = r - axis_of_symmetry(r, z)
    parts = np.array_split(np.argsort(r, kind="stable"), min(rows, FITTED))
    averages = [np.array([np.mean(of[part]) for part in parts]) for of in (r, z)]
    try:
        tip = mdr.Sampled.fit(*averages)
    except ValueError as error:
        raise ValueError(f"{name}: {str(error).removeprefix('Sampled.fit: ')}") from None
    # On a convex polygon every other one of its vertices is convex too.
    subset = np.unique(np.linspace(0, len(tip.r) - 1, MAX_SAMPLES).round().astype(int))
    samples = np.array(tip.r)[subset], np.array(tip.z)[subset]
    by = written(float(np.std(z - np.interp(np.abs(r), *samples))), "length", 2)
    return samples, f"{rows} rows reduced to {len(subset)} samples; rms deviation {by}"
