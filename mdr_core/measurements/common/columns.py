"""Columns of measured curves, from arrays or from `MeasuredCurve`s."""

from dataclasses import dataclass, field
from os import PathLike
from types import EllipsisType
from typing import Any

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ...base.remark import Remark
from ..measured_curve import MeasuredCurve, MeasuredCurves

#: Type of the argument for times; ... stands for the times of the curve.
Times = ArrayLike | EllipsisType | None


@dataclass(frozen=True)
class Columns:
    """Depth, force and time of one curve, or lists for many curves, unchanged.

    `remarks` has the remarks of each curve. `unread` has the errors of invalid curves by curve number.
    `stiffness` is the stiffness of a single curve.
    """

    depth: Any
    force: Any
    time: Any
    remarks: tuple[tuple[Remark, ...], ...] = ()
    unread: dict[int, Remark] = field(default_factory=dict)
    stiffness: Any = None
    places: tuple[tuple[str, int], ...] = ()
    about: dict[str, str] = field(default_factory=dict)


def unread_of(curves):
    """Return the line of a table about files that were not read."""
    unread = getattr(curves, "unread", {})
    return (
        {"files not read": "; ".join(f"{name}: {each}" for name, each in unread.items())} if unread else {}
    )


def columns_of(depth, force, time, *, skip=False):
    """Return the `Columns` of arrays, or of one or many `MeasuredCurve`s; `skip` allows invalid curves."""
    if isinstance(depth, MeasuredCurve):
        _refuse_force(force)
        time = depth.time if time is ... else time
        return Columns(
            depth.depth,
            depth.force,
            time,
            (depth.remarks,),
            stiffness=depth.stiffness,
            places=((depth.name, 1),),
        )
    if are_curves(depth):
        _refuse_force(force)
        return _of_many(depth, time, skip)
    if isinstance(depth, str | PathLike):
        raise check.MDRError(
            f"depth is a path, {str(depth)!r}: read it first, with read_curve or read_curves"
        )
    if force is None:
        raise check.MDRError("force is missing: give depth and force, or a MeasuredCurve instead of depth")
    if depth is None:
        raise check.MDRError("depth is missing: give depth and force, or a MeasuredCurve instead of depth")
    return Columns(depth, force, None if time is ... else time)


def are_curves(depth):
    """Whether the argument `depth` is a collection of measured curves."""
    if isinstance(depth, MeasuredCurves):
        return True
    return isinstance(depth, list | tuple) and any(isinstance(each, MeasuredCurve) for each in depth)


def places_of(curves):
    """Return the file or the name of each curve, and its number in the file."""
    if isinstance(curves, MeasuredCurves):
        return curves.places
    return [(curve.name, 1) for curve in curves]


def _refuse_force(force):
    if force is not None:
        raise check.MDRError(
            "a MeasuredCurve has its own force: leave out force, or give curve.depth and force"
        )


def _of_many(curves, time, skip):
    """Return the `Columns` of many curves, with times if all curves have times."""
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
        column("depth"),
        column("force"),
        column("time") if time is ... else time,
        remarks,
        unread,
        places=tuple(places_of(curves)),
        about=unread_of(curves),
    )


def padded(name, values, unit):
    """Return an array, or the arrays of a list padded with NaN; NaN is a missing sample."""
    if np.ma.is_masked(values):
        raise check.MDRError(f"{name} has masked samples: leave them out of depth and force")
    if not isinstance(values, list | tuple) or not any(map(np.ndim, values)):
        return check.finite_array(name, values, unit=unit, most=check.LONGEST, missing=True)
    rows = [padded(f"{name}[{i}]", row, unit) for i, row in enumerate(values)]
    if any(row.ndim != 1 for row in rows):
        raise check.MDRError(f"{name} as a list must have one array (N,) for each curve")
    result = np.full((len(rows), max(row.size for row in rows)), np.nan)
    for target, row in zip(result, rows, strict=True):
        target[: row.size] = row
    return result


def arrays_of(given, *, single=False):
    """Return arrays of the same shape by name, from pairs of values and a unit, and the lengths of curves.

    The shape of one curve is (N,). Unless `single` is true, many curves are (R, N), or lists of R arrays.
    """
    given = {name: pair for name, pair in given.items() if pair[0] is not None}
    arrays = {name: padded(name, *pair) for name, pair in given.items()}
    shapes, ndim = {name: array.shape for name, array in arrays.items()}, arrays["depth"].ndim
    lengths = [tuple(map(np.size, rows)) for rows, _ in given.values()] if ndim > 1 else [shapes["depth"]]
    if len(set(shapes.values())) > 1 or len(set(lengths)) > 1 or not 1 <= ndim <= 2 - single:
        for i, counts in enumerate(zip(*lengths, strict=False) if ndim == 2 and not single else ()):
            if len(set(counts)) > 1:
                shown = ", ".join(f"{name}[{i}] {n}" for name, n in zip(given, counts, strict=True))
                raise check.MDRError(f"curve {i}: {shown} must have the same number of samples")
        shown = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        many = "" if single else " or (R, N) for many"
        raise check.MDRError(f"{shown} must have the same shape, (N,) for one curve{many}")
    return arrays, lengths[0]
