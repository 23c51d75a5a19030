"""Reading and fitting without a page: jobs of a process, with arguments and results that can be pickled."""

import json
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

import mdr_core as mdr
from mdr_core.base.remark import Remark, Remedy
from mdr_core.measurements.fit.noise import depth_noise_of
from mdr_core.measurements.fit.remarks import remark_on_tension
from mdr_core.measurements.reading import UnknownColumns
from mdr_core.measurements.unloading.first_contact import LEAST_SAMPLES, first_seen
from mdr_core.show.units import format_quantity

from ..common.errors import text_and_remedy
from .choices import IN_TIME, MEDIA

#: Largest numbers of characters of a column name, and of a remark, which may quote the file.
_HEAD, _REMARK = 80, 500
#: Largest number of unread files in the list.
_UNREAD = 20
#: Largest number of samples to fit and draw; longer curves are thinned evenly.
MOST = 2000
#: Largest number of samples of a curve in the plot of all curves.
_DRAWN = 150
#: Kinds of remarks on effects that exceed the error of the number, by the source of the number.
_OF_THE_NUMBER = {
    "unloading": {"zero", "creep", "tip"}, "fit": {"drift", "drag", "tilt", "tip", "adhesion"},
}  # fmt: skip
#: Limits of E* (Pa): lowest of all materials of constant hardness, lowest of polymers, highest of rubber.
_NONE, _SOFT, _STIFF = 1e6, 1e8, 1e9
#: Ratio of E* of loading and unloading above which an elastic sample gets a remark, and no E* at all.
_DIFFERS, _NOT_ELASTIC = 1.5, 10.0


# Reading.


#: Path of a file, or paths of a set.
Paths = str | list[str]


@lru_cache(maxsize=1)
def _curves(given: str) -> Any:
    path, options = json.loads(given)
    return mdr.read_curves(path, **options)


def _read_curves(path: Paths, given: dict[str, Any]) -> Any:
    """Return the curves of a file or a set; read it once for all curves."""
    return _curves(json.dumps([path, given]))


class Row(NamedTuple):
    """Results of one of several curves: name, place, E* and H with errors (Pa) or None, reason, samples."""

    name: str
    file: str = ""
    number: int = 1
    position: Any = None
    E: float | None = None
    E_error: float | None = None
    H: float | None = None
    H_error: float | None = None
    source: str = ""
    reason: str = ""
    samples: Any = None


def read(path: Paths, options: dict[str, Any], number: int) -> tuple[Any, int, Any, list[str]]:
    """Return curve `number` or the last, the number of curves, a question or None, and unread files.

    The question has a text with remedies, the first rows of the table, and suggested options. If the
    suggestion is complete, it also has samples of the first curve.
    """
    count = 0
    try:
        curves = _read_curves(path, options)
        count = len(curves)
        curve = curves[min(number, count - 1)]
        unread = [_named(name, each.text)[:_REMARK] for name, each in curves.unread.items()][:_UNREAD]
        remarks = tuple(with_text(each, each.text[:_REMARK]) for each in curve.remarks)
        table = curve.table and _first_rows(curve.table)
        return replace(curve, table=table, remarks=remarks), count, None, unread
    except UnknownColumns as error:
        text, remedy = text_and_remedy(error)
        question = SimpleNamespace(
            text=text, remedy=remedy, table=_first_rows(error.table), suggestion=error.suggestion,
            preview=_preview(path, options, error),
        )  # fmt: skip
        return None, count, question, []
    except (ValueError, ImportError, MemoryError):
        raise
    except Exception as error:
        # Errors of packages about a damaged file.
        name = Path(path).name if isinstance(path, str) else "a file"
        raise ValueError(f"{name} cannot be read: {type(error).__name__}, {error}") from error


def _named(name: str, text: str) -> str:
    """Return a text with the name of its file."""
    return text if name in text else f"{name}: {text}"


def _first_rows(table: Any) -> Any:
    """Return only the first rows of a table, with shortened heads."""
    few = table.few()
    return replace(few, heads={column: head[:_HEAD] for column, head in few.heads.items()})


def _preview(path: Paths, options: dict[str, Any], error: UnknownColumns) -> Any:
    """Return the samples of the first curve that has the columns of a suggestion, or None."""
    if not error.complete:
        return None
    with suppress(ValueError):
        for curve in mdr.read_curves(path, **(options | error.suggestion)):
            if curve.table.heads == error.table.heads or len(error.suggestion) > 1:
                return samples(curve)
    return None


def with_text(remark: Remark, text: str) -> Remark:
    """Return a remark with another text."""
    return Remark(text, remark.kind, *remark.remedy, together=remark.together)


def samples(curve: Any, drift: float | None = None, frame: float | None = None) -> SimpleNamespace:
    """Return at most `MOST` samples of a curve: number from 1, depth, force, time, whether in a hold."""
    if drift and curve.time is not None:
        curve = curve.minus_drift(drift)
    if frame:
        curve = curve.minus_frame(frame)
    step = -(-len(curve) // MOST)
    columns = {"number": np.arange(1, len(curve) + 1), "held": curve.segment == "hold", "time": curve.time}
    columns |= {"depth": curve.depth, "force": curve.force}
    return SimpleNamespace(
        **{name: each if each is None else each[::step] for name, each in columns.items()}
    )


def ends_of(taken: SimpleNamespace, count: int, part: str) -> tuple[int, int]:
    """Return the numbers of the first and last sample of a part: "all", "loading" or "unloading"."""
    top = int(taken.number[np.argmax(taken.depth)])
    ends = {"all": (1, count), "loading": (1, top), "unloading": (top, count)}[part]
    return ends if ends[0] < ends[1] else (1, count)


def contact_depth(taken: SimpleNamespace, fit: Any = None) -> float | None:
    """Return the depth (m) of first contact, from the fit or from the end of the air in the loading.

    Return None for a loading that does not begin in the air.
    """
    if fit is not None:
        return float(fit.contact_point)
    loading = taken.force[: int(np.argmax(taken.force)) + 1]
    seen = first_seen(loading)[0] if loading.size > LEAST_SAMPLES else 0
    return float(taken.depth[seen]) if LEAST_SAMPLES <= seen < loading.size else None


# Fits.


def fit(curve: Any, asked: dict[str, Any]) -> SimpleNamespace:
    """Return the fit of a curve with its classes, the number to quote, and the remarks above and below.

    `asked` has the tip, the kind of sample, arguments of the fit, and corrections of the depth. Its
    `samples` are the first and last sample number, or () for the default part of the kind of sample.
    """
    asked = SimpleNamespace(**asked)
    medium, taken = MEDIA[asked.medium], samples(curve, **asked.corrections)
    arguments = dict(asked.arguments)
    if curve.time is None:
        arguments = {name: value for name, value in arguments.items() if name not in IN_TIME}
    if medium.letter and (noise := float(f"{depth_noise_of(taken.depth, taken.force)[0]:.2g}")):
        arguments.setdefault("depth_noise", noise)
    ends = asked.samples or ends_of(taken, len(curve), medium.part)
    used = (ends[0] <= taken.number) & (taken.number <= ends[1])
    _check_range(taken, used, arguments)
    found, remarks = _fitted(asked.profile, taken, used, arguments)
    remarks += _adhesion(found, taken, remarks) if asked.medium == "gel" else ()
    part = next((each for each in ("loading", "unloading") if ends_of(taken, len(curve), each) == ends), "")
    quoted, above, below = _plausible(found.quoted, asked, arguments, curve, taken, used, part)
    of_unloading = None
    if quoted.source and found.medium.q_c < np.inf and (of_unloading := found.unloading[0]):
        remarks += of_unloading.remarks
        above = above or tuple(each for each in of_unloading.remarks if each.kind == "units")
    below += tuple(each for each in remarks if each.kind in _OF_THE_NUMBER.get(quoted.source, ()))
    # The fit keeps the classes, and is sent with them.
    return SimpleNamespace(
        fit=found, quoted=quoted, above=above, below=below, remarks=remarks, unloading=of_unloading,
        verdict=found.class_of_hardness, ends=ends,
    )  # fmt: skip


def fit_all(
    path: Paths, given: dict[str, Any], asked: dict[str, Any], first: int = 0, last: int | None = None
) -> Iterator[Row]:
    """Yield a `Row` for each curve from `first` to before `last`: E* to quote, or the reason without E*."""
    curves = _read_curves(path, given)
    files = Counter(file for file, _ in curves.places)
    for i, (file, number) in list(enumerate(curves.places))[first:last]:
        alone = len(files) > 1 and files[file] == 1
        name = file if alone else f"{file}, {number}" if len(files) > 1 else f"{number}"
        row = Row(name, file, number)
        try:
            curve = curves[i]
            step = -(-len(curve) // _DRAWN)
            drawn = curve.depth[::step].tolist(), curve.force[::step].tolist()
            position = None if curve.position is None else curve.position.tolist()
            row = row._replace(position=position, samples=drawn)
            if doubt := deflection(curve):
                yield row._replace(reason=doubt.text)
                continue
            found = fit(curve, asked)
            quoted, H = found.quoted, found.unloading
            row = row._replace(E=quoted.value, E_error=quoted.standard_error, reason=quoted.reason)
            row = row._replace(source=quoted.source or "")
            if H is not None and quoted.value is not None:
                row = row._replace(H=float(H.hardness), H_error=float(H.standard_errors["hardness"]))
            yield row
        except ValueError as error:
            yield row._replace(reason=text_and_remedy(error)[0])


def deflection(curve: Any) -> Remark | None:
    """Return the remark that depths include the deflection of an unknown cantilever, or None."""
    return next((each for each in curve.remarks if each.kind == "deflection"), None)


def _check_range(taken: Any, used: np.ndarray, arguments: dict[str, Any]) -> None:
    """Raise ValueError if the fit needs samples before the range, for the largest depth or for rates."""
    if np.count_nonzero(used) < 2:
        raise ValueError("the range has fewer than two samples for the fit: choose a longer range")
    first, depth = int(np.argmax(used)), taken.depth
    if arguments.get("eta", 0.0) != 0 and first:
        raise ValueError(
            "with viscosity the force depends on all earlier samples: begin the range at sample 1"
        )
    largest, within = float(depth[: first + 1].max()), float(depth[used].max())
    # A thousandth of the range hardly matters, as for noise of the depth.
    if arguments.get("q_c") != np.inf and largest - within > 1e-3 * np.ptp(depth[used]):
        depths = f"{format_quantity(largest, 'length')} instead of {format_quantity(within, 'length')}"
        raise ValueError(
            f"the samples before the range reach deeper than the range, {depths}, and the fit would miss "
            "their yield: begin the range at the largest depth or before"
        )
    origin = arguments.get("contact_point")
    if origin is not None and origin >= within:
        raise ValueError(
            f"first contact z₀ = {format_quantity(origin, 'length')} must be less than "
            f"{format_quantity(within, 'length')}, the largest depth of the samples: "
            "let the fit find z₀, or type a smaller z₀"
        )


def _fitted(profile: Any, taken: Any, used: np.ndarray, arguments: dict[str, Any]) -> tuple[Any, Any]:
    """Return a fit and its remarks; fit without the times if a drift in them leaves no number to quote."""
    columns, time = (taken.depth[used], taken.force[used]), None if taken.time is None else taken.time[used]
    found = mdr.fit_indentation(profile, *columns, time=time, **arguments)
    timed = any(arguments.get(name, 0.0) != 0 for name in ("eta", "drag"))
    if found.quoted.value is None and time is not None and not timed:
        other = mdr.fit_indentation(profile, *columns, **arguments)
        if other.quoted.value is not None:
            return other, tuple(dict.fromkeys((*found.remarks, *other.remarks)))
    return found, found.remarks


def _adhesion(found: Any, taken: Any, remarks: tuple[Remark, ...]) -> tuple[Remark, ...]:
    """Return a remark on tension in the whole curve if no remark reports tension in the fitted samples."""
    error = found.standard_errors.get("E_star", 0.0) / float(found.medium.E_star)
    known = any(each.kind == "adhesion" for each in remarks)
    remark = None if known else remark_on_tension(taken.depth, taken.force, error)
    return () if remark is None else (remark,)


# Whether a modulus is plausible for the chosen kind of sample.


def _plausible(
    quoted: Any, asked: Any, arguments: Any, curve: Any, taken: Any, used: Any, part: str
) -> Any:
    """Return the number to quote (or no number), questions above it, and remarks below it."""
    E = quoted.value
    if E is None:
        return quoted, (), ()
    other = None
    if quoted.source == "fit" and asked.medium == "gel" and part:
        other = _of_other_part(asked.profile, taken, arguments, part)
    ratio = max(other / E, E / other) if other else np.inf
    below: tuple[Remark, ...] = ()
    if other and ratio >= _NOT_ELASTIC:
        text = "E* of loading and of unloading differ by a factor of ten or more, which is impossible for"
        text += " an elastic sample: choose a kind of sample that yields"
        return _none(quoted, Remark(text, "unloading", Remedy("class", "a"))), (), ()
    if other and ratio >= _DIFFERS:
        rest = {"loading": "unloading", "unloading": "loading"}[part]
        text = (
            f"E* is from the {part}; the {rest} alone gives {format_quantity(other, 'pressure', 2)}, "
            f"a ratio of {ratio:.2g}"
        )
        below = (Remark(f"{text}: the sample yields, sticks or loses energy", "unloading"),)
    if asked.medium == "constant" and E < _SOFT:
        text, remedy = _unit_to_look_at(asked.profile, curve, taken, used, E, (_SOFT, 2e12), 1e-3)
        if E < _NONE:
            text = f"E* is below 1 MPa, which no glass, metal or ceramic has: {text}"
            doubt = Remark(f"{text}, or choose another kind of sample", "units", *remedy)
            return _none(quoted, doubt), (), ()
        doubt = Remark(f"few samples of constant hardness are so soft: {text}", "units", *remedy)
        return quoted, (doubt,), below
    if asked.medium == "gel" and E > _STIFF and ratio >= _DIFFERS:
        text, remedy = _unit_to_look_at(asked.profile, curve, taken, used, E, (0.0, _STIFF), 1e3)
        doubt = Remark(f"few gels, cells and rubbers are so stiff: {text}", "units", *remedy)
        return quoted, (doubt,), below
    return quoted, (), below


def _none(quoted: Any, doubt: Remark) -> Any:
    nothing = {"value": None, "standard_error": None, "source": None}
    return replace(quoted, **nothing, reason=doubt.text, kind=doubt.kind, remedy=doubt.remedy)


def _of_other_part(profile: Any, taken: Any, arguments: dict[str, Any], part: str) -> float | None:
    """Return E* (Pa) of the unloading for a loading, or the reverse; None if it is uncertain."""
    if any(arguments.get(name, 0.0) is not None for name in ("E_star", "contact_point", "baseline")):
        return None
    later = taken.number >= taken.number[np.argmax(taken.depth)]
    other = (later if part == "loading" else ~later) & ~taken.held
    if np.count_nonzero(other) < 20:
        return None
    try:
        timed = taken.time is not None and any(arguments.get(name, 0.0) != 0 for name in ("eta", "drag"))
        time = taken.time[other] if timed else None
        found = mdr.fit_indentation(profile, taken.depth[other], taken.force[other], time=time, **arguments)
    except ValueError:
        return None
    E, error = float(found.medium.E_star), float(found.standard_errors["E_star"])
    return E if error <= 0.5 * E else None


def _unit_to_look_at(profile, curve, taken, used, E, plausible, size) -> tuple[str, tuple[Remedy, ...]]:
    """Return text and remedies about a unit: with an error of a factor `size`, E* would be plausible."""
    # The tip alone determines the change of E* with the unit of the depth.
    depth = float(np.ptp(taken.depth[used]))
    depths = np.minimum([depth, size * depth], profile.known_depth)
    forces = mdr.indent(profile, mdr.Medium(1.0), depths).force
    likely = {"depth": E * forces[0] / forces[1], "force": E / size}
    names = [name for name, E in likely.items() if plausible[0] <= E <= plausible[1]] or list(likely)
    columns = {"depth": curve.columns.get("piezo")} | curve.columns
    units = {name: columns[name][1].lstrip("−") for name in names if columns.get(name)}
    text = f"look at the unit{'s' * (len(names) > 1)} of {' and '.join(names)}"
    if units:
        text = f"the file is read with {' and '.join(f'{n} in {u}' for n, u in units.items())}; {text}"
    return text, tuple(Remedy("unit", name) for name in names)
