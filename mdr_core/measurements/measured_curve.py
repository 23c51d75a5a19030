"""Measured force–depth curves, and corrections of their depth before a fit."""

import re
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import Any, Self, overload

import numpy as np
from numpy.typing import NDArray

from ..base import check
from ..base.check import Array, frozen, number, positive_number
from ..base.errors import MDRError
from ..base.remark import Remark
from ..base.results import Record
from ..show.measured import plot_measured
from ..show.quantities import engineering
from ..show.report import rows
from ..show.units import KINDS

#: Shares of the ranges of depth and force: a turn of the depth, largest changes in a hold, and smallest
#: force of a hold above the smallest force. Smallest share and smallest number of the samples in a hold.
_TURN, _STILL, _PRESSED, _HOLD, _FEW = 0.05, 0.01, 0.05, 0.02, 10
#: Largest mean force of a hold for the drift, as a share of the largest force.
_LOW = 0.2
#: Approximate number of samples of a hold for slopes.
_SLOPES = 500


#: Words in the names of segments: the hold first, and the retract before the approach, as "unload" contains
#: "load".
_SEGMENTS = {
    "hold": "hold|dwell|pause|halte",
    "retract": "unload|retract|withdraw|entlast",
    "approach": "load|approach|extend|belast",
}
#: Segments of the modalities of `afmformats` by segment number.
MODALITIES = {
    "force-distance": ["approach", "retract"],
    "creep-compliance": ["approach", "hold", "retract"],
    "stress-relaxation": ["hold", "approach", "hold", "retract"],
}


#: Quantities of a curve and their units.
_UNITS = {"depth": "m", "force": "N", "time": "s", "stiffness": "N/m"}


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredCurve(Record):
    """Measured curve from arrays, or from a file by `read_curve`.

    `approach` and `retract` are parts of the curve. `minus_drift` and `minus_frame` return a new curve
    whose depth is corrected for a drift or for the frame compliance.

    Parameters
    ----------
    depth, force, time : array_like
        Depth (m), force (N) and time (s) of the samples, of shape (N,). The time is optional.
    stiffness : array_like, optional
        Contact stiffness dF/dh (N/m) at each sample, NaN if it was not measured.
    name : str, optional
        Name of the curve in tables and messages.

    Raises
    ------
    ValueError
        If the arrays have different shapes, or a value that is not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import MeasuredCurve
    >>> depth = np.array([0.0, 20e-9, 10e-9])
    >>> curve = MeasuredCurve(depth, force=[0.0, 4e-3, 1e-3])
    >>> curve.retract.depth.tolist()
    [1e-08]

    A file, and a drift of the depth:

    >>> import tempfile
    >>> from pathlib import Path
    >>> import mdr_core as mdr
    >>> rows = ["t (s), h (nm), F (mN)", "0, 0, 0", "1, 20, 4", "2, 21, 4", "3, 22, 4", "4, 5, 0"]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("\\n".join(rows), encoding="utf-8")
    ...     curve = mdr.read_curve(path)
    >>> rate = curve.drift(slice(1, 4))  # m/s, of the samples of a hold
    >>> (1e9 * curve.minus_drift(rate).minus_frame(1e-7).depth).round(6).tolist()
    [0.0, 18.6, 18.6, 18.6, 1.0]
    """

    depth: Array
    force: Array
    #: None if the file has no time.
    time: Array | None = None
    _: KW_ONLY
    #: From a continuous stiffness measurement, None without one.
    stiffness: Array | None = None
    name: str = "curve"
    #: "approach", "hold" or "retract" for each sample, from the file if it names them. If not, approach
    #: and retract end where the depth turns by more than 5 % of its range. In a hold depth and force stay
    #: within 1 % of their ranges, for 2 % of the samples or more.
    segment: NDArray[np.str_] | None = None
    #: Stiffness of the cantilever (N/m) and position on the sample (m, m), None if unknown.
    spring_constant: float | None = None
    position: Array | None = None
    #: Number of the column in the file, starting at 0, and unit of each quantity, "−nm" for a reversed
    #: sign. The position of a piezo has the key "piezo" instead of "depth". `read_curve(path, columns=…)`
    #: accepts this dictionary.
    columns: dict[str, tuple[int, str] | None] = field(default_factory=dict)
    #: Reversed signs, corrections, and omitted lines and columns.
    remarks: tuple[Remark, ...] = ()
    table: Any = None
    #: Source of the columns: "by its header", "as told", or a format.
    source: str = ""

    _shown = ("depth", "force")
    _dimensions = ("sample",)

    def __post_init__(self):
        arrays = {
            name: check.finite_array(
                name, values, unit=unit, most=check.LONGEST, missing=name == "stiffness"
            )
            for name, unit in _UNITS.items()
            if (values := getattr(self, name)) is not None
        }
        shapes = {name: array.shape for name, array in arrays.items()}
        if len(set(shapes.values())) > 1 or arrays["depth"].ndim != 1 or not arrays["depth"].size:
            shown = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
            raise MDRError(f"{shown} must have the same shape, (N,): give one value for each sample")
        if self.segment is None:
            arrays["segment"] = segments_of(arrays["depth"], arrays["force"])
        check.store(self, **{name: frozen(array) for name, array in arrays.items()})

    @property
    def _quantities(self):  # type: ignore[override]
        return tuple(name for name in _UNITS if getattr(self, name) is not None)

    def _rows(self):
        yield "name", self.name
        if self.source:
            yield "columns", self.source
        for name, known in self.columns.items():
            if known is None:
                continue
            column, unit = known
            text = f"{self.table.heads[column] or f'column {column + 1}'!r} in {unit}"
            if name == "piezo":
                text += f", the position of a piezo, minus force/({self.spring_constant:.6g} N/m)"
            elif name == "force" and KINDS.get(unit.lstrip("−")) not in (None, "force"):
                text += f", a deflection, times {self.spring_constant:.6g} N/m"
            yield {"piezo": "depth"}.get(name, name), text
        yield from (("remark", remark) for remark in self.remarks)

    @property
    def approach(self) -> Self:
        """Samples of the approach, or of loading. Raises ValueError if there are none."""
        return self._part("approach")

    @property
    def retract(self) -> Self:
        """Samples of the retract, or of unloading. Raises ValueError if there are none."""
        return self._part("retract")

    def _part(self, name):
        rows = self.segment == name
        if not rows.any():
            known = ", ".join(sorted(set(self.segment.tolist())))
            raise MDRError(f"{self.name} has no {name}: the segments of its samples are {known}")
        arrays = {each: frozen(getattr(self, each)[rows]) for each in (*self._quantities, "segment")}
        return replace(self, **arrays)

    def plot(self) -> Any:
        """Plot the force over depth as a HoloViews element."""
        return plot_measured(self.name, [(self.depth, self.force)])

    def drift(self, hold: slice | None = None) -> float:
        """Return the drift (m/s) of the depth in a hold: the median of the slopes between its samples.

        A few samples outside the hold, for example of the withdrawal after it, do not change the median
        (Theil 1950, Sen 1968). A medium that recovers from its unloading also drifts: leave out the
        beginning of such a hold.

        Parameters
        ----------
        hold : slice, optional
            Samples of the hold, for example ``slice(800, 900)``. By default the last hold of `segment`
            after the largest force whose mean force is below a fifth of the largest force.

        Raises
        ------
        ValueError
            If there are no times, no such hold, or fewer than three samples in it.
        """
        time = self._times()
        if hold is None:
            hold = last_hold(self.segment, self.force)
        if hold is None:
            raise MDRError(
                f"{self.name} has no hold after the largest force and below a fifth of it: give the "
                "samples of a hold, as in curve.drift(slice(800, 900)), or give the rate itself"
            )
        if not isinstance(hold, slice):
            raise MDRError(f"hold = {hold!r:.60} must be a slice of samples, as in slice(800, 900)")
        if time[hold].size < 3:
            raise MDRError(
                f"{hold} has {time[hold].size} samples of {self.name}: a hold needs three or more"
            )
        return rate_in(time[hold], self.depth[hold])

    def minus_drift(self, rate: float) -> Self:
        """Return the curve without a drift: depth minus rate times time, starting at the first sample.

        Parameters
        ----------
        rate : float
            Rate of the drift (m/s), for example from `drift`; positive if the depth grows.

        Raises
        ------
        ValueError
            If there are no times.
        """
        time, rate = self._times(), number("rate", rate, "m/s")
        if not np.isfinite(rate):
            raise MDRError(f"rate = {rate:g} m/s must be finite")
        text = f"a drift of {engineering(rate, 'm/s')}"
        return self._minus(rate * (time - time[0]), text)

    def minus_frame(self, compliance: float) -> Self:
        """Return the curve without frame compliance: depth minus compliance times force.

        Parameters
        ----------
        compliance : float
            Frame compliance (m/N), 0 or positive.
        """
        compliance = positive_number("compliance", compliance, unit="m/N", zero=True)
        text = f"a frame compliance of {engineering(compliance, 'm/N')}"
        return self._minus(compliance * self.force, text)

    def _times(self):
        if self.time is None:
            raise MDRError(f"{self.name} has no times: a drift needs the time of each sample")
        return self.time

    def _minus(self, depth, text):
        remarks = (*self.remarks, Remark(f"depth: {text} is subtracted", "changed"))
        return replace(self, depth=frozen(self.depth - depth), remarks=remarks)


def last_hold(segment, force):
    """Return the last hold after the largest force as a slice, or None.

    The mean force of the hold must be below a fifth of the largest force.
    """
    edges = np.flatnonzero(np.diff(segment == "hold", prepend=False, append=False))
    holds, peak = [slice(*ends) for ends in edges.reshape(-1, 2).tolist()], np.argmax(force)
    low = [part for part in holds if part.start > peak and np.mean(force[part]) < _LOW * force[peak]]
    return low[-1] if low else None


def rate_in(time, depth):
    """Return the rate (m/s) of the depth: the median of the slopes between samples."""
    thin = max(1, time.size // _SLOPES)
    steps, rises = (np.subtract.outer(each[::thin], each[::thin]) for each in (time, depth))
    return float(np.median(rises[steps > 0] / steps[steps > 0]))


def segments_of(depth, force):
    """Return the segment of each sample from depth (m) and force (N), for files without segments."""
    turns, extreme, sign = [], 0, 1
    values, least = depth.tolist(), _TURN * np.ptp(depth)
    for i, value in enumerate(values):
        if sign * (value - values[extreme]) > 0:
            extreme = i
        elif sign * (values[extreme] - value) > least:
            # If the record begins with the retract, there is no sample before the turn.
            turns.append(extreme or -1)
            extreme, sign = i, -sign
    passed = np.searchsorted(turns, np.arange(depth.size))
    width = max(_FEW, int(_HOLD * depth.size)) | 1
    still = force > force.min() + _PRESSED * np.ptp(force)
    for part in (depth, force):
        still &= _running_max(part, width) + _running_max(-part, width) < _STILL * np.ptp(part)
    holds = _running_max(still, width) > 0
    return frozen(np.where(holds, "hold", np.array(["approach", "retract"])[passed % 2]))


def _running_max(values, width):
    """Return the largest value within half an odd width on either side of each sample.

    Each window consists of the end of a block of its width and the beginning of the next block (van Herk,
    Pattern Recognit. Lett. 13, 1992, 517).
    """
    half, rest = width // 2, -(values.size + width - 1) % width
    blocks = np.pad(values.astype(float), (half, half + rest), constant_values=-np.inf).reshape(-1, width)
    ends = np.maximum.accumulate(blocks[:, ::-1], axis=1)[:, ::-1].ravel()
    beginnings = np.maximum.accumulate(blocks, axis=1).ravel()
    return np.maximum(ends[: values.size], beginnings[width - 1 :][: values.size])


def named_segments(words):
    """Return the name of the column with segment names, and the segment of each sample.

    The column names the segment at each sample, or only at the first sample of a segment.
    """
    for column, cells in words.items():
        names = [""]
        for cell in cells:
            known = (name for name, words in _SEGMENTS.items() if re.search(words, cell, re.I))
            names.append(next(known, names[-1]))
        if all(names[1:]):
            return column, np.array(names[1:])
    return "", None


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredCurves(Sequence[MeasuredCurve]):
    """All curves of a file, or of a set of files, returned by `read_curves`.

    It is a sequence: length, index, slices and iteration.

    An index or an iteration reads the columns of a curve. Thus an error in one curve does not affect the
    other curves.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import mdr_core as mdr
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("h (nm), F (mN)\\n0, 0\\n10, 1\\n20, 4\\n", encoding="utf-8")
    ...     curves = mdr.read_curves(path)
    >>> print(curves, len(curves[0].depth))
    MeasuredCurves: 1 of run.csv 3
    """

    #: Name of the file, the folder, the pattern or the zip.
    name: str
    #: Positions of the curves on the sample (N, 2) in m, None if the file does not have them.
    position: Array | None
    #: Functions that make the curves.
    _makers: Sequence[Callable[[], MeasuredCurve]]
    #: File of each curve, and its number in the file, starting at 1; empty for one file.
    _places: Sequence[tuple[str, int]] = ()
    #: Errors by the names of files in a set that were not read.
    unread: dict[str, Remark] = field(default_factory=dict)

    @classmethod
    def joined(cls, name: str, files: "dict[str, MeasuredCurves]", unread: dict[str, Remark]) -> Self:
        """Join the curves of several files, given by file name; `unread` has the errors of other files."""
        positions = [each.position for each in files.values() if each.position is not None]
        position = frozen(np.concatenate(positions)) if len(positions) == len(files) else None
        makers = [make for each in files.values() for make in each._makers]  # noqa: SLF001
        places = [(file, i) for file, each in files.items() for i in range(1, len(each) + 1)]
        return cls(name, position, makers, places, unread)

    def __repr__(self) -> str:
        count = len(self.unread)
        unread = f"; {count} file{'s are' if count > 1 else ' is'} not read, see .unread" if count else ""
        return f"MeasuredCurves: {len(self)} of {self.name}{unread}"

    @property
    def places(self) -> list[tuple[str, int]]:
        """File of each curve, and its number in that file, starting at 1."""
        return [*self._places] or [(self.name, i) for i in range(1, len(self) + 1)]

    def __len__(self) -> int:
        return len(self._makers)

    @overload
    def __getitem__(self, index: int) -> MeasuredCurve: ...
    @overload
    def __getitem__(self, index: slice) -> "MeasuredCurves": ...
    def __getitem__(self, index):
        position = None if self.position is None else frozen(self.position[index])
        if isinstance(index, slice):
            places = self.places[index]
            return replace(self, _makers=self._makers[index], position=position, _places=places)
        return replace(self._makers[index](), position=position)


@rows.register
def _rows_of_curve(curve: MeasuredCurve):
    return curve._rows()  # noqa: SLF001
