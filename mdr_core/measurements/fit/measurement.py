"""Measured curves: their samples, omitted samples, and rates of depth from times."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...base import check
from ...solver.numerics.blocks import chunks
from ..common.columns import arrays_of, padded

#: A rate jumps if it changes by more than this share of the largest rate, and by more than this multiple of
#: its changes two samples before and after.
_JUMP, _ISOLATED = 0.03, 10.0


@dataclass(frozen=True)
class Measurement:
    """Measured curves, one in each row (R, N), NaN for missing samples.

    `lengths` (R,) are the given lengths. `single` is true if one curve was given. `used` (R, N) marks the
    samples to fit.
    """

    depth: np.ndarray
    force: np.ndarray
    time: np.ndarray | None
    force_noise: np.ndarray | None
    lengths: np.ndarray
    single: bool

    @cached_property
    def used(self):
        """Mask of samples with finite values (R, N)."""
        given = (self.depth, self.force, self.time, self.force_noise)
        return np.logical_and.reduce([np.isfinite(values) for values in given if values is not None])

    def rows(self, rows):
        """Return the curves at some rows."""
        values = (self.depth, self.force, self.time, self.force_noise, self.lengths)
        return Measurement(*(v if v is None else v[rows] for v in values), single=self.single)

    def groups(self):
        """Yield curves with equally many samples: their numbers, depth, force, time and force noise.

        They are arrays (R, N) of at most 64 curves, or None for missing times and noise.
        """
        counts = np.count_nonzero(self.used, axis=1)
        for count in np.unique(counts):
            same = np.flatnonzero(counts == count)
            for rows in (same[part] for part in chunks(same.size, 64)):
                given = self.depth, self.force, self.time, self.force_noise
                used = self.used[rows]
                yield rows, *(v if v is None else v[rows][used].reshape(-1, count) for v in given)


def measurement(depth, force, time, force_noise):
    """Return the `Measurement` of arrays, one curve (N,) or many (R, N), or of lists of arrays."""
    given = {"depth": (depth, "m"), "force": (force, "N"), "time": (time, "s")}
    values, lengths = arrays_of(given)
    shape = values["depth"].shape
    if not values["depth"].size:
        raise check.MDRError("depth and force are empty: a curve needs more samples than free parameters")
    if force_noise is not None:
        force_noise = padded("force_noise", force_noise, "N")
        check.common_shape("fit_indentation", depth=values["depth"], force_noise=force_noise)
        check.raise_if("force_noise", force_noise, force_noise <= 0, "must be positive", unit="N")
        values["force_noise"] = np.broadcast_to(force_noise, shape)
    values = {name: np.atleast_2d(array) for name, array in values.items()}
    values = {name: values.get(name) for name in ("depth", "force", "time", "force_noise")}
    measured = Measurement(**values, lengths=np.array(lengths), single=len(shape) == 1)
    if not measured.used.any():
        raise check.MDRError("no sample has finite values of both depth and force")
    return measured


def rates(depth, time):
    """Return rates (m/s) by central differences, and a mask of their jumps, arrays (R, N)."""
    advice = "sort the samples, drop repeated times, and continue the time from one segment to the next"
    back = np.diff(time, prepend=-np.inf, axis=1) <= 0
    check.raise_if("time", time, back, "does not increase", unit="s", advice=advice)
    rate = np.array([np.gradient(z, t) for z, t in zip(depth, time, strict=True)])
    jump = np.zeros_like(depth)
    jump[:, 1:-1] = np.abs(np.diff(np.diff(depth, axis=1) / np.diff(time, axis=1), axis=1))
    around = np.pad(jump, ((0, 0), (2, 2)))
    around = np.maximum(around[:, :-4], around[:, 4:])
    largest = np.abs(rate).max(axis=1, keepdims=True)
    return rate, (jump > _JUMP * largest) & (jump > _ISOLATED * around)
