"""A measured tip from the text of a CSV file: noisy, two-sided or long ones are made fit to be pressed."""

import tempfile
from pathlib import Path

import numpy as np

import mdr_core as mdr
from mdr_core.shapes.tables import read_samples

from .units import written

#: Most samples that are pressed without keeping everybody waiting, most that a tip is fitted to, and most
#: rows of a file.
MOST_SAMPLES, _FITTED, MOST_ROWS = 60, 2000, 20_000


def read_tip(text):
    """Radii and heights (m) of an uploaded tip, and a note on what was done to them.

    A header names the units, as in "r (nm), z (nm)". What is long, noisy or has both sides becomes the
    convex tip that is nearest to it, see `mdr.Sampled.fit`. Raises ValueError if the text is not two
    columns of numbers, or no tip.
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
    try:
        if len(r) <= MOST_SAMPLES:
            return (mdr.Sampled(r, z).r, z - z[0]), f"{len(r)} samples as they are"
    except ValueError:
        # Noise makes any tip concave somewhere.
        pass
    return _fitted(r, z)


def _fitted(r, z):
    """A convex tip of few samples from many."""
    rows = len(r)
    if min(r) < 0 < max(r):
        r = r - _axis(r, z)
    order = np.argsort(np.abs(r), kind="stable")
    parts = np.array_split(order, min(rows, _FITTED))
    tip = mdr.Sampled.fit(*(np.array([np.mean(of[part]) for part in parts]) for of in (np.abs(r), z)))
    # On a convex polygon every other one of its vertices is convex too.
    some = np.unique(np.linspace(0, len(tip.r) - 1, MOST_SAMPLES).round().astype(int))
    samples = np.array(tip.r)[some], np.array(tip.z)[some]
    apart = z - np.interp(np.abs(r), *samples)
    by = written(float(np.std(apart)), "length", 2)
    return samples, f"{len(some)} samples, nearest to {rows} rows, which scatter by {by} about them"


def _axis(r, z):
    """The radius about which both sides of a profile are most alike, near its lowest sample."""
    order = np.argsort(r, kind="stable")
    r, z, reach = r[order], z[order], np.ptp(r)
    lowest = np.clip(r[np.argmin(z)], r[0] + 0.2 * reach, r[-1] - 0.2 * reach)
    axes = lowest + 0.1 * reach * np.linspace(-1, 1, 41)
    away = np.linspace(0, min(axes[0] - r[0], r[-1] - axes[-1]), 400)
    sides = (np.interp(axes[:, None] + side * away, r, z) for side in (1, -1))
    # How unlike they are grows as a square; noise makes many least ones.
    a, b, _ = np.polyfit(axes - lowest, np.mean(np.subtract(*sides) ** 2, axis=1), 2)
    return float(lowest + np.clip(-b / (2 * a), axes[0] - lowest, axes[-1] - lowest)) if a > 0 else lowest
