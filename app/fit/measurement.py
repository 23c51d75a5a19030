"""Reading and fitting, without a page: what the process of `worker` does, and what it answers.

Arguments and answers are numbers, texts, arrays and objects of `mdr_core`, which can be sent.
"""

import json
import logging
import re
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
from mdr_core.fit.noise import jitter
from mdr_core.fit.oliver_pharr_result import OliverPharr
from mdr_core.fit.quoted import unloading as unloading_of
from mdr_core.measured_curve import MeasuredCurve, MeasuredCurves
from mdr_core.reading import UnknownColumns
from mdr_core.show.units import written

from ..tip import read_tip

#: Most samples that are fitted and drawn: of more, one in two, three … is taken.
MOST = 2000
#: Most characters of the name of a column, and of a remark, which may quote the file, that are shown.
_HEAD, _REMARK = 80, 500


@dataclass(frozen=True)
class Samples:
    """The samples of a curve that are taken: numbers from 1 on, depth (m), force (N), and time (s)."""

    number: np.ndarray
    depth: np.ndarray
    force: np.ndarray
    time: np.ndarray | None

    @property
    def deepest(self) -> int:
        """Number of the sample with the largest depth."""
        return int(self.number[np.argmax(self.depth)])

    @property
    def depth_noise(self) -> float:
        """Standard deviation (m) of depths that go back and forth, 0 where it hardly counts."""
        return float(f"{jitter(self.depth, self.force)[0]:.2g}")

    def within(self, ends: tuple[int, ...]) -> np.ndarray:
        """Which samples are between two numbers."""
        return (ends[0] <= self.number) & (self.number <= ends[1])


def samples(curve: MeasuredCurve, drift: float = 0.0, frame: float = 0.0) -> Samples:
    """Samples of a curve without a drift (m/s) and the compliance of a frame (m/N)."""
    if drift and curve.time is not None:
        curve = curve.minus_drift(drift)
    if frame:
        curve = curve.minus_frame(frame)
    step = -(-len(curve) // MOST)
    number = np.arange(1, len(curve) + 1)
    parts = (None if each is None else each[::step] for each in (curve.depth, curve.force, curve.time))
    return Samples(number[::step], *parts)


def first_and_last(taken: Samples, count: int, part: str) -> tuple[int, int]:
    """Numbers of the first and the last sample of a part: "all", "loading" or "unloading"."""
    top = taken.deepest
    ends = {"all": (1, count), "loading": (1, top), "unloading": (top, count)}[part]
    return ends if ends[0] < ends[1] else (1, count)


# Jobs of the process: each is called with what can be sent.


@dataclass(frozen=True)
class Question:
    """What is asked about a file: in words, the first rows of its table, and what is suggested.

    `preview` has depth (m) and force (N) of the first curve as it is suggested, None if it lacks something.
    """

    why: str
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
        remarks = tuple(each[:_REMARK] for each in curve.remarks)
        return replace(curve, table=curve.table and _few(curve.table), remarks=remarks), count, None
    except UnknownColumns as error:
        asked = {"why": error.text, "table": _few(error.table), "suggestion": error.suggestion}
        return None, count, asked | {"preview": _preview(path, given, error)}
    except (ValueError, ImportError, MemoryError):
        raise
    except Exception as error:
        # What packages raise about a damaged file.
        raise ValueError(f"{Path(path).name} cannot be read: {type(error).__name__}, {error}") from error


def tip(path: str, name: str) -> tuple[tuple[Any, Any], str]:
    """Radii and heights (m) of a tip in a file, and a note."""
    return read_tip(decoded(Path(path).read_bytes()), name)


def without_folders(text: str) -> str:
    """A message without the folders of the server, in which the paths of files begin."""
    return re.sub(r"(?<![\w.)])(?:[A-Za-z]:)?[/\\](?:[^/\\\s'\":]+[/\\]+)+", "", text)


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

    remarks: tuple[str, ...]
    #: Results of Oliver and Pharr, and which class of hardness the curve has; None where there are none.
    unloading: OliverPharr | None
    of_class: HardnessVerdict | None


def fit(
    profile: mdr.Profile, taken: dict[str, Any], arguments: dict[str, Any]
) -> tuple[IndentationFit, dict[str, Any]]:
    """A fit, with its classes and the number to quote, and the values of `Told`.

    The times of the samples tell a drift, which a remark names, and of which the unloading of a known
    contact is independent: where they alone leave no number to quote, the fit is the one without them.
    """
    _refuse_range(arguments, taken)
    used = taken["used"]
    depth, force = taken["depth"][used], taken["force"][used]
    time = None if taken["time"] is None else taken["time"][used]
    found = mdr.fit_indentation(profile, depth, force, time=time, **arguments)
    remarks = found.remarks
    needs_time = any(arguments.get(name, 0.0) != 0 for name in ("eta", "drag"))
    if found.quoted.value is None and time is not None and not needs_time:
        other = mdr.fit_indentation(profile, depth, force, **arguments)
        if other.quoted.value is not None:
            found, remarks = other, tuple(dict.fromkeys((*remarks, *other.remarks)))
    # Classes and what to quote are kept in the object that is sent.
    told = {"remarks": remarks, "unloading": None, "of_class": found.class_of_hardness}
    if found.quoted.source == "unloading":
        told["unloading"], _ = unloading_of(found)
    return found, told


def fit_all(
    path: str, given: dict[str, Any], asked: dict[str, Any], profile: mdr.Profile, arguments: dict[str, Any]
) -> Iterator[Any]:
    """Of each curve of a file its number, E* and its error to quote (Pa), or why there is none."""
    curves = opened(path, given)
    for number in range(len(curves)):
        try:
            curve = curves[number]
            taken = samples(curve, **asked["corrections"])
            own = dict(arguments)
            if curve.time is None:
                own = {name: value for name, value in own.items() if name not in ("eta", "drag")}
            if asked["noise"] and taken.depth_noise:
                own["depth_noise"] = taken.depth_noise
            ends = asked["samples"] or first_and_last(taken, len(curve), asked["part"])
            told = {
                "depth": taken.depth,
                "force": taken.force,
                "time": taken.time,
                "used": taken.within(ends),
            }
            quoted = fit(profile, told, own)[0].quoted
            yield number, quoted.value, quoted.standard_error, quoted.reason
        except ValueError as error:
            yield number, None, None, str(error)


def _refuse_range(arguments: dict[str, Any], taken: dict[str, Any]) -> None:
    """Refuse samples that need those before them: a medium remembers the largest depth, and rates."""
    depth, used = taken["depth"], taken["used"]
    if np.count_nonzero(used) < 2:
        raise ValueError("the range has fewer than two samples to be fitted: choose a longer range")
    first = int(np.argmax(used))
    if arguments.get("eta", 0.0) != 0 and first:
        raise ValueError(
            "with viscosity the force depends on all samples before: begin the range at sample 1"
        )
    largest, within = float(depth[: first + 1].max()), float(depth[used].max())
    # As for noise of the depth, a thousandth of the range hardly counts.
    if arguments.get("q_c") != np.inf and largest - within > 1e-3 * np.ptp(depth[used]):
        raise ValueError(
            f"the samples before the range reach deeper, {written(largest, 'length')}, than the range, "
            f"{written(within, 'length')}, and their yield would not be fitted: begin the range at the "
            "largest depth or before"
        )
    origin = arguments.get("contact_point")
    if origin is not None and origin >= depth[used].max():
        raise ValueError(
            f"the contact point z₀ = {written(origin, 'length')} is held, and the samples reach only to "
            f"{written(within, 'length')}: let the fit find z₀, or type a smaller z₀"
        )


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
