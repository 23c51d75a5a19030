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

    Parameters that are None are free, numbers are held. If the medium yields, the unloading determines E*
    and the loading the hardness. If it is elastic, `q_c=inf`, an approach is enough. The model is the force
    of the contact with a background F₀ + F₁ z + ζ ż, where z is the measured depth.

    Parameters
    ----------
    profile : Profile
        The indenter, one for all curves.
    depth, force : array_like
        Measured depths (m) and forces (N) in the order of time, of the same shape: one curve (N,), or many
        (R, N) with one indenter, each on a virgin medium; or lists of R arrays of different lengths.
        Samples with NaN are left out. A drift and frame compliance are subtracted before, by
        `MeasuredCurve.minus_drift` and `minus_frame`. With `q_c=inf`, without `time` and without adhesion
        the order does not matter. In the place of depth and force a `MeasuredCurve`, as of `read_curve`, or
        `MeasuredCurves`, whose remarks come first in those of the fit.
    time : array_like, optional
        Increasing times (s) of the samples, of the same shape; needed for `eta` and `drag`, and for remarks
        on drag and drift that are left out. The rate ż is the central difference of the depths, so that a
        noisy depth makes a noisy rate: average neighbouring samples first. Where the rate jumps from one
        sample to the next, the sample has no weight. Those of a `MeasuredCurve` are taken unless this is
        None.
    E_star : float, optional
        Effective modulus (Pa).
    q_c, hardness, f_c : float, optional
        Constants of the hardness σ_c(a) = hardness + q_c/a + f_c/a² (N/m, Pa, N) as in `Medium`: those that
        are not given are 0, and if none is given q_c is free. Give `hardness=None` for a glass or a metal,
        class (a), and `q_c=None, hardness=None` for a hardness with a size effect. With `q_c=inf` the
        medium is elastic. `hardness` and `f_c` are not fitted together with `eta` or `work_of_adhesion`.
        For a `HardnessLaw` take `scipy.optimize.curve_fit` over `indent`: the gallery has an example.
    eta : float, optional
        Viscosity η (Pa·s) of the medium, 0 by default; see Notes.
    contact_point : float, optional
        Measured depth z₀ (m) at first contact, searched over the record and 30 of its ranges below.
    baseline, tilt, drag : float, optional
        Background: force F₀ (N) without contact, its slope F₁ (N/m) over depth, and the drag ζ (N·s/m) of
        a liquid, which shifts approach and retract apart. 0 by default.
    work_of_adhesion : float, optional
        Work of adhesion w (J/m²) of an elastic medium, 0 by default; see Notes.
    depth_noise : float, optional
        Standard deviation (m) of the measured depth. Without it noise is taken for new largest depths, and
        E* is biased.
    force_noise : float or array_like, optional
        Standard deviation (N) of the measured force, for all samples or for each sample; samples are
        weighted by its inverse. None estimates it from the residuals, or with `depth_noise` from third
        differences of the force, which requires fine sampling.
    invalid : {"raise", "nan"}
        If one of many curves cannot be fitted, "raise" raises an error, and "nan" gives NaN as its results;
        `fit.invalid` has the reasons by the numbers of these curves. If no curve can be fitted, the first
        reason is raised.

    Returns
    -------
    IndentationFit

    Raises
    ------
    ValueError
        If data are infinite, of different shapes, have no force above the baseline, or fewer samples than
        free parameters; if `eta` or `drag` are not 0 and `time` is missing or does not increase; if
        `hardness` or `f_c` is not 0 and `eta` or `work_of_adhesion` is not, or `hardness` is not 0 and the
        shape is not convex, or is a law.

    Notes
    -----
    **Viscosity.** For ḋ ≥ 0, F = 2E* ∫ a(s) ds + 8η a(d) ḋ with the integral from d_p to d. For ḋ < 0
    elements are released at d + τḋ, τ = 4η/E*, and F = 2E* ∫ a(s) ds ends at this depth. This is the force
    of `indent_in_time` (Popov (2015), Eq. (1)) on an approach, a hold and a retract, and on a second
    indentation after all elements have relaxed.

    A solid whose modulus relaxes by E₁ in a time t₁ much shorter than the record has nearly the same force:
    E* is then the relaxed modulus, and η = E₁ t₁/4. With E₁ = E* and t₁ equal to a twentieth of the loading
    time, E* is 2 to 6 % too large without a remark; with a fifth it is 12 to 36 % too large, and most
    records have a remark.

    **Holds.** With `time`, a hold at constant depth (m) stays in the record: ḋ is 0 there, and from its
    first sample on only the springs contribute to the force (N). A force that goes on falling, or a depth
    that creeps, is a relaxation that the model does not describe: cut these samples out of all arrays,
    ``keep = (time < start) | (time > stop)`` (s) with ``depth[keep], force[keep], time=time[keep]``. Rates
    at the edges of the gap are computed from the nearer samples.

    **Adhesion** is fitted for an elastic medium only, `q_c=inf`, because the retract from a medium that
    yields does not determine it. The states are computed as by `indent`; the record must extend from before
    contact to after the pull-off. E*, w and z₀ follow from the forces in contact. The samples in contact
    are found from the data, because a soft cantilever loses contact earlier than the model, in which the
    depth is prescribed; a remark gives the difference in depth. The samples next to a jump into or out of
    contact have no weight; `path` and `residuals` have the jumps of the model. Adhesion cannot be fitted
    together with `eta` or `depth_noise`.

    **Classes.** Glass, metals and ceramics have a constant hardness, class (a); composites, PDMS and gold
    at the nanoscale q_c/a, class (b); a hardness that is larger when the contact is small is the sum of
    both. `fit.classes` has the fits of each class alone, and the report of one curve those that its samples
    do not rule out. This assumes a known tip, one loading without pop-ins and one unloading. A curve often
    does not distinguish two free constants; a remark reports this.

    E* and the hardness belong to the model, whose contact radius on loading has the sink-in of an elastic
    contact. Plastic flow has less sink-in: on fused silica E* is 82.7 GPa, by Oliver and Pharr 69.6 GPa.
    The hardness is the mean pressure of a fully yielded contact, 14.3 GPa. The mean pressure of the contact
    in the model, whose rim is elastic, is 10.9 GPa. Oliver and Pharr's hardness, which instruments report,
    refers to a larger contact and is 9.1 GPa. The report gives all three.

    **Not in the model**: relaxation over more than one time, adhesion that changes between approach and
    retract, poroelastic flow, layers, finite thickness. Residuals are then systematic; a remark reports
    them if they exceed 5 % of the force, or 1 % if the medium yields. A tilt, a drag, a drift of the depth
    and a force that is different on unloading (creep, hysteresis) are reported with the change of E* where
    they would lower the residuals in contact clearly, or change E* by more than its error at 3.3 standard
    deviations; drag and drift only if `time` is given. Such a remark is made on 0.3 % of clean curves. If
    the medium yields, the drift is measured in a hold; without a hold it is not seen, and 0.1 nm/s over two
    minutes changes the E* of a metal by some per cent. If E* is held, or with adhesion, these effects are
    not tested. The report has the numbers of Oliver and Pharr if the model fits the curve, without
    viscosity and adhesion.

    **Standard errors** come from the Jacobian at the solution, with the variance σ_F² + (S σ_d)², S the
    slope. In simulated curves deviations over errors have standard deviations of 0.9 to 1.2; with depth
    noise above 1/15 of the depth or above the critical depth 1.5 to 3, and E* is wrong by a sixth. Where
    neighbouring residuals are correlated, errors are computed from block-wise sums of the score (Newey &
    West, Econometrica 55, 1987, 703); the report states this, and `block_length` is the number of samples
    in a block. Remarks name outliers, too few samples in contact, and too few blocks. `assets/fits.md`
    lists how often E* is within its errors on curves that deviate from the model, and the deviations that
    no test finds.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, fit_indentation, indent
    >>> d = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 30e-9, 50))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9, q_c=100.0), d).force
    >>> fit = fit_indentation(Cone(slope=0.3), d + 3e-9, F)
    >>> print(f"{fit.medium.E_star:.6g} {fit.medium.q_c:.6g} {fit.contact_point:.6g}")
    1e+10 100 3e-09

    A viscous medium in a liquid, from approach, hold and retract:

    >>> from mdr_core import indent_in_time
    >>> t = np.linspace(0.0, 1.0, 161)
    >>> d = np.interp(t, [0.0, 0.4, 0.6, 1.0], [-10e-9, 50e-9, 50e-9, -10e-9])
    >>> F = indent_in_time(Cone(slope=0.3), Medium(E_star=10e9, eta=1e8), d, t).force
    >>> F = F + 2.0 * np.gradient(d, t)
    >>> fit = fit_indentation(Cone(slope=0.3), d, F, time=t, q_c=np.inf, eta=None, drag=None)
    >>> print(f"{fit.medium.E_star:.3g} {fit.medium.eta:.3g} {fit.drag:.3g}")
    1e+10 1e+08 2

    A medium with adhesion, from before contact to after the pull-off:

    >>> d = np.append(np.linspace(-10e-9, 60e-9, 100), np.linspace(60e-9, -20e-9, 120))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=1e9, work_of_adhesion=0.2), d).force
    >>> fit = fit_indentation(Cone(slope=0.3), d, F, q_c=np.inf, work_of_adhesion=None)
    >>> print(f"{fit.medium.E_star:.6g} {fit.medium.work_of_adhesion:.6g}")
    1e+09 0.2

    A map with a curve that cannot be fitted:

    >>> F = np.stack([F, 0 * F])
    >>> fit = fit_indentation(Cone(slope=0.3), [d, d], F, q_c=np.inf, invalid="nan")
    >>> print(fit.invalid[1][:28], fit.medium.E_star[1])
    not fitted: largest force[0] nan
    """
    check_pair(profile, Medium(1.0), "a fit")
    check.one_of("invalid", invalid, ("raise", "nan"))
    if isinstance(hardness, HardnessLaw):
        instead = "find its parameters by scipy.optimize.curve_fit over indent, as the gallery does"
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
    return collected(profile, measured, noise, solutions, reasons, columns.remarks)


def _solutions(rows, curves, noise_known, reasons):
    """Solutions of curves with numbers `rows`; those that have none are added to `reasons` if there are."""
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
    """Values (R,) of the held parameters by name, checked against each other."""
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
    """Names of the parameters that need times and are not held at 0."""
    needs_time = (name for name, parameter in PARAMETERS.items() if parameter.in_time)
    return [name for name in needs_time if name not in held or held[name].any()]


def _without_invalid(profile, depth, force, time, held, unread):
    """Depths, forces and times with NaN for the curves that cannot be fitted, and the reasons by number.

    `unread` are the reasons of those that could not be read.
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
    """Refuses adhesion with what its curves are not fitted with."""
    q_c = held.get("q_c", np.array([np.nan]))
    if not np.all(np.isinf(q_c)):
        given = "free" if np.isnan(q_c[0]) else engineering(q_c, "N/m")
        raise MeasurementError(
            f"adhesion is fitted for an elastic medium only, and q_c is {given}",
            Remedy("class", "elastic"),
            Remedy("hold", "work_of_adhesion", 0.0),
        )
    for name, given in (("eta", "eta" not in held or held["eta"].any()), ("depth_noise", noise > 0)):
        if given:
            what = "the viscosity" if name == "eta" else "a noise of the depth"
            raise MeasurementError(
                f"the work of adhesion is not fitted together with {what}",
                Remedy("hold", "work_of_adhesion", 0.0),
                Remedy("hold" if name == "eta" else "give", name, 0.0),
            )


def _refuse_with_other_classes(profile, held):
    """Refuses what is fitted with a hardness q_c/a only, class (b)."""

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
                f"{symbols([name])} is fitted with a hardness of class (b) only",
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
        text = f"{which}{counts[i]} samples do not determine {names}: hold some of these, or give more"
        raise MeasurementError(text, Remedy("part", "all"))
    lowest, highest = np.nanmin(force, axis=1), np.nanmax(force, axis=1)
    width = np.nanmax(depth, axis=1) - np.nanmin(depth, axis=1)
    check.refuse("range of depth", width, width == 0, "m: the indenter does not move", advice="check it")
    rise = highest - held.get("baseline", lowest)
    bound, advice = (
        "above the baseline: no contact",
        "forces are positive in compression; or free the baseline",
    )
    attracted, free = np.any(held.get("work_of_adhesion", 1.0)), (Remedy("free", "baseline"),)
    bad = (rise <= 0) & ~attracted
    check.refuse("largest force", rise, bad, bound, unit="N", advice=advice, remedy=free)
    height = highest - lowest
    bound = f"must be at least {check.SHORTEST:g}"
    check.refuse("range of force", height, height < check.SHORTEST, bound, unit="N", advice="check it")
