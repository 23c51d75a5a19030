"""Reading and fitting, without a page: what the process of `worker` does, and what it answers.

Arguments and answers are numbers, texts, arrays and objects of `mdr_core`, which can be sent. Classes of
the page cannot: they have another name where it is served.
"""

import json
import logging
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.files.table import decoded
from mdr_core.fit.classes import HardnessVerdict
from mdr_core.fit.indentation import IndentationFit
from mdr_core.fit.oliver_pharr_result import OliverPharr
from mdr_core.fit.quoted import Quoted, unloading
from mdr_core.measured_curve import MeasuredCurves
from mdr_core.numerics.remark import Remark
from mdr_core.reading import UnknownColumns
from mdr_core.show.units import written

from ..tip import read_tip
from .asked import Asked, Each, refuse_range, samples
from .judged import judged
from .refusals import changed, deflection, refusal

#: Most characters of the name of a column, and of a remark, which may quote the file, that are shown.
_HEAD, _REMARK = 80, 500
#: Kinds of remarks on what changes a number by more than its error, by the source of that. A drift changes
#: the model's E* beside an unloading, which hardly depends on it.
_OF_THE_NUMBER = {"unloading": {"zero", "creep", "tip"}, "fit": {"drift", "drag", "tilt", "tip"}}


# Jobs of the process: each is called with what can be sent.


@dataclass(frozen=True)
class Question:
    """What is asked about a file: why, the first rows of its table, and what is suggested.

    `why` has the values of a `Message`. `preview` has depth (m) and force (N) of the first curve as it is
    suggested, None if it lacks something.
    """

    why: tuple[Any, ...]
    table: Any
    suggestion: dict[str, Any]
    preview: tuple[np.ndarray, np.ndarray] | None = None


@lru_cache(maxsize=1)
def _curves(path: str, given: str) -> MeasuredCurves:
    return mdr.read_curves(path, **json.loads(given))


def opened(path: str, given: dict[str, Any]) -> MeasuredCurves:
    """The curves of a file, which is read once for all of them."""
    return _curves(path, json.dumps(given))


def _few(table: Any) -> Any:
    """What the page shows of a table: heads, of some length, and three rows."""
    few = table.few()
    return replace(few, heads={column: head[:_HEAD] for column, head in few.heads.items()})


def read(path: str, given: dict[str, Any], number: int) -> Any:
    """One curve of a file, their number, and None; or None, the number, and the values of a `Question`."""
    count = 0
    try:
        curves = opened(path, given)
        count = len(curves)
        if number >= count:
            raise ValueError(f"the file has {count} curves, and no curve {number + 1}")
        curve = curves[number]
        remarks = tuple(changed(each, lambda text: text[:_REMARK]) for each in curve.remarks)
        return replace(curve, table=curve.table and _few(curve.table), remarks=remarks), count, None
    except UnknownColumns as error:
        asked = {"why": refusal(error), "table": _few(error.table), "suggestion": error.suggestion}
        return None, count, asked | {"preview": _preview(path, given, error)}
    except (ValueError, ImportError, MemoryError):
        raise
    except Exception as error:
        # What packages raise about a damaged file.
        raise ValueError(f"{Path(path).name} cannot be read: {type(error).__name__}, {error}") from error


def tip(path: str, name: str) -> tuple[tuple[Any, Any], str]:
    """Radii and heights (m) of a tip in a file, and a note."""
    return read_tip(decoded(Path(path).read_bytes()), name)


def _preview(path: str, given: dict[str, Any], error: UnknownColumns) -> Any:
    """Depth and force of the first curve that has the columns of a suggestion, or None."""
    if not error.complete:
        return None
    try:
        for curve in mdr.read_curves(path, **(given | error.suggestion)):
            if curve.table.heads == error.table.heads or len(error.suggestion) > 1:
                taken = samples(curve)
                return taken.depth, taken.force
    except ValueError:
        pass
    return None


@dataclass(frozen=True)
class Told:
    """What is said beside a fit, found where it does not keep others waiting."""

    #: The number to quote, questions that stand above it, and what is said below it.
    quoted: Quoted
    above: tuple[Remark, ...]
    below: tuple[Remark, ...]
    remarks: tuple[Remark, ...]
    #: Results of Oliver and Pharr, and which class of hardness the curve has; None where there are none.
    unloading: OliverPharr | None
    of_class: HardnessVerdict | None


def fit(given: dict[str, Any]) -> tuple[IndentationFit, dict[str, Any]]:
    """A fit of what is `Asked`, by its values, with its classes, and the values of `Told`."""
    asked = Asked(**given)
    refuse_range(asked)
    found, remarks = _fitted(asked)
    quoted, above, below = judged(found.quoted, asked)
    told: dict[str, Any] = {"quoted": quoted, "unloading": None}
    if quoted.source == "unloading":
        told["unloading"], _ = unloading(found)
        remarks += told["unloading"].remarks
        # The modulus is asked about once.
        above = above or tuple(each for each in told["unloading"].remarks if each.kind == "units")
    below += tuple(each for each in remarks if each.kind in _OF_THE_NUMBER.get(quoted.source, ()))
    # Classes are kept in the object that is sent.
    told |= {"above": above, "below": below, "remarks": remarks, "of_class": found.class_of_hardness}
    return found, told


def _fitted(asked: Asked) -> tuple[IndentationFit, tuple[Remark, ...]]:
    """A fit and its remarks.

    The times of the samples tell a drift, which a remark names, and of which the unloading of a known
    contact is independent: where they alone leave no number to quote, the fit is the one without them.
    """
    used = asked.used
    samples, time = (asked.depth[used], asked.force[used]), None if asked.time is None else asked.time[used]
    found = mdr.fit_indentation(asked.profile, *samples, time=time, **asked.arguments)
    if found.quoted.value is not None or time is None or asked.needs_time:
        return found, found.remarks
    other = mdr.fit_indentation(asked.profile, *samples, **asked.arguments)
    if other.quoted.value is None:
        return found, found.remarks
    return other, tuple(dict.fromkeys((*found.remarks, *other.remarks)))


def fit_all(path: str, given: dict[str, Any], each: dict[str, Any]) -> Iterator[Any]:
    """Of each curve of a file its number, E* and its error to quote (Pa), or why there is none.

    `each` are the values of `Each`.
    """
    curves, asked = opened(path, given), Each(**each)
    for number in range(len(curves)):
        try:
            curve = curves[number]
            if doubt := deflection(curve.remarks):
                yield number, None, None, doubt.text
                continue
            quoted = fit(vars(asked.of(curve)))[1]["quoted"]
            yield number, quoted.value, quoted.standard_error, quoted.reason
        except ValueError as error:
            yield number, None, None, refusal(error)[0]


#: By their names, as they are asked.
JOBS = {"read": read, "fit": fit, "fit_all": fit_all, "tip": tip}


def quiet() -> None:
    """Leave out messages of readers, and warnings, which are in nobody's sight."""
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")


def modulus_of_sample(
    E_star: float, error: float, poisson: float, tip_modulus: float | None, tip_poisson: float | None
) -> tuple[float, float]:
    """Young's modulus (Pa) of the sample and its error, by 1/E* = (1 − ν²)/E + (1 − ν_t²)/E_t.

    A tip without a modulus is rigid. Johnson (1985), Contact Mechanics, Eq. (4.5). Raises ValueError if
    the tip alone is as soft as E*.

    Examples
    --------
    >>> E, error = modulus_of_sample(69.6e9, 0.2e9, 0.17, 1141e9, 0.07)  # fused silica under diamond
    >>> print(f"{E / 1e9:.1f} ± {error / 1e9:.1f} GPa")
    72.0 ± 0.2 GPa
    """
    of_tip = 0.0 if tip_modulus is None else (1 - (tip_poisson or 0.0) ** 2) / tip_modulus
    rest = 1 / E_star - of_tip
    if rest <= 0:
        raise ValueError(
            f"a tip of {written(tip_modulus or 0.0, 'pressure')} is softer than the contact, E* = "
            f"{written(E_star, 'pressure')}: type its modulus again"
        )
    E = (1 - poisson**2) / rest
    return E, E / rest / E_star**2 * error
