"""The columns of measured curves that are given as arrays, or as curves that were read from a file."""

from dataclasses import dataclass, field
from types import EllipsisType
from typing import Any

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ...base.remark import MeasurementError, Remark
from ..measured_curve import MeasuredCurve, MeasuredCurves

#: What is given as times: ... is those of the curve.
Times = ArrayLike | EllipsisType | None


@dataclass(frozen=True)
class Columns:
    """Depth, force and time of one curve, or lists of those of many, as they were given.

    `remarks` has those of each curve that was read; `unread` those on curves that are refused when they are
    taken, by their numbers; `stiffness` that of a curve.
    """

    depth: Any
    force: Any
    time: Any
    remarks: tuple[tuple[Remark, ...], ...] = ()
    unread: dict[int, Remark] = field(default_factory=dict)
    stiffness: Any = None


def columns_of(depth, force, time, *, skip=False):
    """`Columns` of arrays, a `MeasuredCurve`, or many, of which those that are refused may be skipped."""
    if isinstance(depth, MeasuredCurve):
        _refuse_force(force)
        time = depth.time if time is ... else time
        return Columns(depth.depth, depth.force, time, (depth.remarks,), stiffness=depth.stiffness)
    if _are_curves(depth):
        _refuse_force(force)
        return _of_many(depth, time, skip)
    if force is None:
        raise check.MDRError(
            "force is missing: give depth and force, or a MeasuredCurve in the place of depth"
        )
    if depth is None:
        raise check.MDRError(
            "depth is missing: give depth and force, or a MeasuredCurve in the place of depth"
        )
    return Columns(depth, force, None if time is ... else time)


def _are_curves(depth):
    if isinstance(depth, MeasuredCurves):
        return True
    return isinstance(depth, list | tuple) and any(isinstance(each, MeasuredCurve) for each in depth)


def _refuse_force(force):
    if force is not None:
        raise check.MDRError(
            "a MeasuredCurve has its own force: leave out force, or give curve.depth and force"
        )


def _of_many(curves, time, skip):
    """`Columns` of many curves; their times where all of them have times."""
    taken, unread = [], {}
    for i in range(len(curves)):
        try:
            taken.append(curves[i])
        except ValueError as error:
            if not skip:
                raise
            taken.append(None)
            unread[i] = Remark.of(error, "invalid")
    read = [curve for curve in taken if curve is not None]
    if time is ... and any(curve.time is None for curve in read):
        time = None
    none = np.full(1, np.nan)

    def column(name):
        return [none if curve is None else getattr(curve, name) for curve in taken]

    remarks = tuple(() if curve is None else curve.remarks for curve in taken)
    return Columns(
        column("depth"), column("force"), column("time") if time is ... else time, remarks, unread
    )


def remarks_of_one(remarks):
    """The remarks of one curve that was read from a file."""
    if len(remarks) > 1:
        raise check.MDRError(
            f"oliver_pharr takes one curve, got {len(remarks)}: give one of them, as in curves[0]"
        )
    return remarks[0] if remarks else ()


def measured_stiffness(given, stiffness):
    """The measured stiffness that is given, or that of a curve."""
    if stiffness is not True:
        return None if stiffness is False else stiffness
    if given.stiffness is None:
        raise check.MDRError(
            "stiffness = True takes that of a MeasuredCurve, and there is none: give its values, or leave "
            "it out to evaluate the unloading"
        )
    return given.stiffness


def finite_columns(depth, force, time, stiffness):
    """Arrays by name of the samples in which all that is given is finite, but the stiffness."""
    given = {
        "depth": (depth, "m"),
        "force": (force, "N"),
        "time": (time, "s"),
        "stiffness": (stiffness, "N/m"),
    }
    arrays = {
        name: check.finite_array(name, values, unit=unit, most=check.LONGEST, missing=True)
        for name, (values, unit) in given.items()
        if values is not None
    }
    shapes = {array.shape for array in arrays.values()}
    if len(shapes) > 1 or arrays["depth"].ndim != 1:
        shown = " and ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise check.MDRError(f"{shown} must have the same shape, (N,) for one curve")
    used = np.logical_and.reduce(
        [np.isfinite(array) for name, array in arrays.items() if name != "stiffness"]
    )
    arrays = {name: array[used] for name, array in arrays.items()}
    if not arrays["depth"].size:
        text = "depth and force have no samples: an unloading needs five or more"
        raise MeasurementError(Remark(text, "no unloading"))
    if arrays["depth"].size > 1 and not np.ptp(arrays["depth"]):
        text = f"range of depth = 0 m: the depth is {arrays['depth'][0]:g} m throughout; check its column"
        raise MeasurementError(Remark(text, "no unloading"))
    if "time" in arrays:
        if arrays["time"].size > 1 and not np.ptp(arrays["time"]):
            time = arrays["time"][0]
            raise check.MDRError(
                f"range of time = 0 s: the time is {time:g} s throughout; check its column, or leave it out"
            )
        # Segments of a file may share the time at which one ends and the next begins.
        back = np.diff(arrays["time"], prepend=-np.inf) < 0
        advice = "sort the samples by time"
        check.refuse("time", arrays["time"], back, "does not increase", unit="s", advice=advice)
    return arrays
