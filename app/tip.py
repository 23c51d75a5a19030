"""A measured tip from the text of a CSV file: noisy, two-sided or long ones are made fit to be pressed."""

import tempfile
from pathlib import Path

import numpy as np

import mdr_core as mdr
from mdr_core.shapes.tables import read_samples

from .units import written

#: Most samples that are pressed without keeping everybody waiting; most rows of a file.
MOST_SAMPLES, MOST_ROWS = 60, 20_000


def read_tip(text):
    """Radii and heights (m) of an uploaded tip, and a note on what was done to them.

    A header names the units, as in "r (nm), z (nm)". Both sides of a profile are folded onto one another,
    many rows are averaged to few, and what is not convex is replaced by the convex shape below it. Raises
    ValueError if the text is not two columns of numbers, or no tip.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tip.csv"
        # A decimal comma is one where something else stands between the columns.
        columns = text.replace(",", ".") if ";" in text or "\t" in text else text
        path.write_text(columns, encoding="utf-8")
        try:
            r, z = read_samples(path, None, MOST_ROWS)
        except ValueError as error:
            raise ValueError(str(error).replace(str(path), "the file")) from None
    return ((r, z), f"{len(r)} samples as they are") if len(r) <= MOST_SAMPLES else _averaged(r, z)


def _averaged(r, z):
    """A convex tip of few samples from many."""
    rows = len(r)
    if np.any(r < 0):
        r = np.abs(r - r[np.argmin(z)])
    order = np.argsort(r, kind="stable")
    # Averages over equal numbers of rows, the tip among them.
    parts = np.array_split(order, MOST_SAMPLES)
    mean_r, mean_z = (np.array([values[part].mean() for part in parts]) for values in (r, z))
    mean_r, first = np.unique(np.append(0.0, mean_r), return_index=True)
    mean_z = np.append(np.min(z[parts[0]]), mean_z)[first]
    tip = mdr.Sampled.convex_envelope(mean_r, mean_z - mean_z[0])
    moved = np.max(np.abs(np.interp(mean_r, tip.r, tip.z) - (mean_z - mean_z[0])))
    by = written(float(moved), "length", 2)
    note = f"{len(tip.r)} samples of {rows} rows: averaged, and made convex by at most {by}"
    return (np.array(tip.r), np.array(tip.z)), note
