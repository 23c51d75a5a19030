"""Fit of a medium to measured force–depth curves."""

from collections.abc import Sequence
from types import EllipsisType

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ...base.remark import MeasurementError, Remark, Remedy
from ...show.progress import progress
from ...show.quantities import engineering
from ...solver.applicability import check_pair, refuse_own_law
from ...solver.contact.yielding import yield_rule
from ...solver.medium.hardness import HardnessLaw
from ...solver.medium.medium import Medium
from ...solver.profiles.profile import Profile
from ..common.columns import Times, columns_of
from ..measured_curve import MeasuredCurve, MeasuredCurves
from .measurement import measurement, rates
from .parameters import PARAMETERS, hardness_by_default, held_values, symbols
from .result import IndentationFit, collected
from .solution import problems, solved, table_depth


@check.keywords_explained
def fit_indentation(
    profile: Profile,
    depth: ArrayLike | MeasuredCurve | MeasuredCurves | Sequence[MeasuredCurve],
    force: ArrayLike | None = None,
    *,
    time: Times = ...,
    E_star: ArrayLike | None = None,
    q_c: ArrayLike | EllipsisType | None = ...,
    hardness: ArrayLike | EllipsisType | None = ...,
    f_c: ArrayLike | EllipsisType | None = ...,
    eta: ArrayLike | None = 0.0,
    contact_point: ArrayLike | None = None,
    baseline: ArrayLike | None = 0.0,
    tilt: ArrayLike | None = 0.0,
    drag: ArrayLike | None = 0.0,
    work_of_adhesion: ArrayLike | None = 0.0,
    depth_noise: float = 0.0,
    force_noise: ArrayLike | None = None,
    invalid: str = "raise",
) -> IndentationFit:
    """Fit a medium to a measured force–depth curve by least squares: the inverse of `indent`.

    A parameter with the value None is free, and a number holds it. The model is the force of the contact
    with a background F₀ + F₁ z + ζ ż at the measured depth z. The page *What a fit does* describes the
    model, its limits, its errors and remarks.

    Parameters
    ----------
    profile : Profile
        The indenter, one for all curves.
    depth, force : array_like
        Measured depths (m) and forces (N) in order of time: one curve (N,), many (R, N), or lists of R
        arrays. Samples with NaN are omitted. Alternatively, `depth` is a `MeasuredCurve` or
        `MeasuredCurves`.
    time : array_like, optional
        Increasing times (s), required for `eta` and `drag`. The default is the time of a `MeasuredCurve`;
        None ignores it.
    E_star : float, optional
        Effective modulus (Pa).
    q_c, hardness, f_c : float, optional
        Constants of the hardness σ_c = hardness + q_c/a + f_c/a² (N/m, Pa, N). By default q_c is free and
        the other constants are 0. Use `hardness=None` for a glass or a metal, and `q_c=np.inf` for an
        elastic medium.
    eta : float, optional
        Viscosity η (Pa·s) of the medium, 0 by default. Not with `hardness` or `f_c`.
    contact_point : float, optional
        Measured depth z₀ (m) at first contact.
    baseline, tilt, drag : float, optional
        Force F₀ (N) without contact, its slope F₁ (N/m), and the drag ζ (N·s/m) of a liquid; 0 by default.
    work_of_adhesion : float, optional
        Work of adhesion w (J/m²) of an elastic medium, 0 by default. Not with `eta` or `depth_noise`.
    depth_noise : float, optional
        Standard deviation (m) of the measured depth. Without it, noise counts as new largest depths.
    force_noise : float or array_like, optional
        Standard deviation (N) of the measured force; None estimates it from the residuals.
    invalid : {"raise", "nan"}
        Action for a curve that cannot be fitted: raise an error, or return NaN and a reason in
        `fit.invalid`.

    Returns
    -------
    IndentationFit

    Raises
    ------
    MDRError
        If data are infinite or have different shapes, no force above the baseline, or not more samples than
        free parameters. If times are missing or do not increase. If the combination of free parameters is
        not supported.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, fit_indentation, indent
    >>> d = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 30e-9, 50))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9, q_c=100.0), d).force
    >>> fit = fit_indentation(Cone(slope=0.3), d + 3e-9, F)
    >>> print(f"{fit.medium.E_star:.6g} {fit.medium.q_c:.6g} {fit.contact_point:.6g}")
    1e+10 100 3e-09
    """
    check_pair(profile, Medium(1.0), "a fit")
    check.one_of("invalid", invalid, ("raise", "nan"))
    if isinstance(hardness, HardnessLaw):
        instead = "fit its parameters with scipy.optimize.curve_fit and indent, as in the gallery"
        refuse_own_law(Medium(1.0, hardness=hardness), "a fit", instead)
    hardnesses = hardness_by_default(hardness=hardness, q_c=q_c, f_c=f_c)
    given = {"E_star": E_star} | hardnesses | {"eta": eta, "work_of_adhesion": work_of_adhesion}
    given |= {"contact_point": contact_point, "baseline": baseline, "tilt": tilt, "drag": drag}
    noise = check.positive_number("depth_noise", depth_noise, unit="m") if depth_noise else 0.0
    columns = columns_of(depth, force, time, skip=invalid == "nan")
    depth, force, time, reasons = columns.depth, columns.force, columns.time, dict(columns.unread)
    if invalid == "nan" and any(np.ndim(row) for row in depth):
        held = _held(profile, given, len(depth), noise, time)
        depth, force, time, reasons = _without_invalid(profile, depth, force, time, held, reasons)
    measured = measurement(depth, force, time, force_noise)
    held = _held(profile, given, len(measured.depth), noise, time)
    fitted = np.array([i for i in range(len(measured.depth)) if i not in reasons], int)
    held = {name: values[fitted] for name, values in held.items()}
    curves_to_fit = measured.rows(fitted)
    _refuse_empty(curves_to_fit, held)
    noise_known = measured.force_noise is not None or noise > 0
    solutions = []
    with progress(fitted.size, "curves") as done:
        for rows, curves in problems(profile, curves_to_fit, held, noise):
            solutions += _solutions(
                fitted[rows], curves, noise_known, reasons if invalid == "nan" else None
            )
            done(rows.size)
    _refuse_all_invalid(reasons, len(measured.depth))
    return collected(
        profile, measured, noise, solutions, reasons, columns.remarks, columns.places, columns.about
    )


def _solutions(rows, curves, noise_known, reasons):
    """Return solutions of the curves `rows`; add errors to `reasons`, unless this is None."""
    try:
        solution = solved(rows, curves, noise_known)
        solution.medium()
        return [solution]
    except ValueError as error:
        if reasons is None:
            raise
        if rows.size == 1:
            reasons[int(rows[0])] = Remark.of(error, "invalid")
            return []
    singles = ((rows[[i]], curves.rows([i])) for i in range(rows.size))
    return [each for single in singles for each in _solutions(*single, noise_known, reasons)]


def _held(profile, given, count, noise, time):
    """Return the values (R,) of the held parameters by name, checked against each other."""
    held = held_values(count, **given)
    _refuse_with_other_classes(profile, held)
    in_time = _in_time(held)
    if in_time and time is None:
        raise MeasurementError(
            f"{symbols(in_time)} need the times (s) of the samples",
            Remedy("give", "time"),
            *(Remedy("hold", name, 0.0) for name in in_time),
        )
    if "work_of_adhesion" not in held or held["work_of_adhesion"].any():
        _refuse_with_adhesion(held, noise)
    return held


def _in_time(held):
    """Return the names of the parameters that need times and are not held at 0."""
    needs_time = (name for name, parameter in PARAMETERS.items() if parameter.in_time)
    return [name for name in needs_time if name not in held or held[name].any()]


def _without_invalid(profile, depth, force, time, held, unread):
    """Return depths, forces and times, with NaN for invalid curves, and the reasons by number.

    `unread` has the reasons of curves that could not be read.
    """
    columns = [depth, force] if time is None else [depth, force, time]
    sizes = [len(column) for column in columns]
    if len(set(sizes)) > 1:
        raise check.MDRError(
            f"depth, force and time must have the same number of curves, got "
            f"{' and '.join(map(str, sizes))}"
        )
    curves, reasons = list(zip(*columns, strict=True)), dict(unread)
    for i, curve in enumerate(curves):
        if i in unread:
            continue
        try:
            measured = measurement(*curve, *[None] * (4 - len(curve)))
            own = {name: values[[i]] for name, values in held.items()}
            _refuse_empty(measured, own)
            if _in_time(own):
                rates(measured.depth[:, measured.used[0]], measured.time[:, measured.used[0]])
            table_depth(profile, measured.depth, own)
        except ValueError as error:
            reasons[i] = Remark.of(error, "invalid")
            curves[i] = [np.full(np.size(curve[0]), np.nan)] * len(curve)
    _refuse_all_invalid(reasons, len(curves))
    depth, force, *times = map(list, zip(*curves, strict=True))
    return depth, force, times[0] if times else None, reasons


def _refuse_all_invalid(reasons, count):
    if len(reasons) == count:
        raise MeasurementError(reasons[0].after(f"none of {count} curves can be fitted; curve 0: "))


def _refuse_with_adhesion(held, noise):
    """Raise MeasurementError for adhesion with yield, viscosity or noise of the depth."""
    q_c = held.get("q_c", np.array([np.nan]))
    if not np.all(np.isinf(q_c)):
        given = "free" if np.isnan(q_c[0]) else engineering(q_c, "N/m")
        raise MeasurementError(
            f"adhesion requires an elastic medium, but q_c is {given}",
            Remedy("class", "elastic"),
            Remedy("hold", "work_of_adhesion", 0.0),
        )
    for name, given in (("eta", "eta" not in held or held["eta"].any()), ("depth_noise", noise > 0)):
        if given:
            what = "a viscosity" if name == "eta" else "a noise of the depth"
            raise MeasurementError(
                f"the work of adhesion cannot be fitted together with {what}",
                Remedy("hold", "work_of_adhesion", 0.0),
                Remedy("hold" if name == "eta" else "give", name, 0.0),
            )


def _refuse_with_other_classes(profile, held):
    """Raise MeasurementError for combinations that require a hardness q_c/a, class (b)."""

    def used(name):
        return name not in held or held[name].any()

    if used("hardness"):
        try:
            yield_rule(profile, Medium(1.0, hardness=1.0))
        except check.MDRError as error:
            raise MeasurementError(error.text, Remedy("class", "b")) from None
    for name in ("eta", "work_of_adhesion"):
        if used(name) and (used("hardness") or used("f_c")):
            raise MeasurementError(
                f"{symbols([name])} cannot be fitted with a hardness of class (a) or (c)",
                Remedy("hold", name, 0.0),
                Remedy("class", "b"),
            )


def _refuse_empty(measured, held):
    depth, force = (np.where(measured.used, values, np.nan) for values in (measured.depth, measured.force))
    free = [name for name in PARAMETERS if name not in held]
    counts = np.count_nonzero(measured.used, axis=1)
    i = int(counts.argmin())
    if counts[i] <= len(free):
        which = "" if measured.single else f"curve {i}: "
        names = symbols(free) or "a residual"
        text = (
            f"{which}{counts[i]} samples do not determine {names}: hold some of these, or give more samples"
        )
        raise MeasurementError(text, Remedy("part", "all"))
    lowest, highest = np.nanmin(force, axis=1), np.nanmax(force, axis=1)
    width = np.nanmax(depth, axis=1) - np.nanmin(depth, axis=1)
    check.raise_if("range of depth", width, width == 0, "m: the indenter does not move", advice="check it")
    rise = highest - held.get("baseline", lowest)
    bound, advice = (
        "above the baseline: no contact",
        "forces are positive in compression; or free the baseline",
    )
    attracted, free = np.any(held.get("work_of_adhesion", 1.0)), (Remedy("free", "baseline"),)
    bad = (rise <= 0) & ~attracted
    check.raise_if("largest force", rise, bad, bound, unit="N", advice=advice, remedy=free)
    height = highest - lowest
    bound = f"must be at least {check.SHORTEST:g}"
    check.raise_if("range of force", height, height < check.SHORTEST, bound, unit="N", advice="check it")
