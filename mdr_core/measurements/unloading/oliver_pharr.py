"""Modulus and hardness from unloadings or a measured stiffness, by the method of Oliver and Pharr."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ...base.remark import MeasurementError, Remark, Remedy
from ...show.progress import progress
from ...show.quantities import engineering
from ...solver.applicability import check_pair
from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from ...solver.medium.medium import Medium
from ...solver.profiles.profile import Profile
from ..common.columns import Times, are_curves, arrays_of, columns_of, places_of, unread_of
from ..common.curve_table import CurveTable, table_of
from ..common.doubts import apart, doubts, of_ideal_tip, out_of_order, saturated
from ..common.errors import roughness
from ..measured_curve import MeasuredCurve, MeasuredCurves, last_hold, rate_in, segments_of
from . import creep as creeping
from .first_contact import elastic_exponents
from .iso_14577 import iso_numbers, remark_on_beginning
from .moduli import moduli, not_from_contact, over_depth, remaining
from .oliver_pharr_result import ISO_14577, OliverPharr
from .unloading import last_at_top, laws_of, parts_of
from .zero import zero_of


@check.keywords_explained
def oliver_pharr(
    profile: Profile,
    depth: ArrayLike | MeasuredCurve | MeasuredCurves | Sequence[MeasuredCurve],
    force: ArrayLike | None = None,
    *,
    time: Times = ...,
    stiffness: ArrayLike | bool | None = None,
    epsilon: float = 0.75,
    beta: float = 1.0,
    cycles: bool = False,
) -> "OliverPharr | CurveTable":
    """Compute modulus and hardness from the unloadings of a force–depth curve by Oliver and Pharr (1992).

    F = α (h − h_f)^m is fitted to the upper half of the unloading. F and its slope S at the largest depth h
    give the contact depth h_c = h − ε F/S. The radius a of the profile at this height, z(a) = h_c, gives
    A = π a², E* = S √π/(2β √A) and H = F/A. The page *What a fit does* describes first contact, the
    correction for creep, and the quantities of ISO 14577.

    Parameters
    ----------
    profile : Profile
        The indenter.
    depth, force : array_like
        Depths (m) and forces (N), (N,), in order of time. Samples with NaN are omitted. First contact is
        subtracted if the record begins in the air. Alternatively, `depth` is one or many `MeasuredCurve`.
    time : array_like, optional
        Increasing times (s), to correct the stiffness for creep in a hold. The default is the time of a
        `MeasuredCurve`; None ignores it.
    stiffness : array_like or True, optional
        Measured contact stiffness S (N/m) at each sample, (N,), NaN for missing values. True takes the
        stiffness of a `MeasuredCurve`. Each sample then has a result. Not with `time` or `cycles`.
    epsilon : float, optional
        Constant ε: 1 for a flat punch, 3/4 for a paraboloid, 2 − 4/π for a cone.
    beta : float, optional
        Correction β of the stiffness, 1 for axisymmetric indenters.
    cycles : bool, optional
        Whether to evaluate each unloading, in order of time. Unloadings that do not follow a power law are
        omitted with a remark. By default only the unloading after the largest depth is evaluated.

    Returns
    -------
    OliverPharr
        With `stiffness`, an `OverDepth`. With many curves, a `CurveTable` with NaN and the reason for each
        curve that cannot be evaluated.

    Raises
    ------
    MDRError
        If the upper half of an unloading has fewer than five samples, or does not follow a power law. If
        the contact depth is not positive, or beyond the known profile. If times do not increase. If no
        sample has a positive stiffness.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, indent, oliver_pharr
    >>> d = np.append(np.linspace(0, 60e-9, 100), np.linspace(60e-9, 0, 100))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9), d).force
    >>> result = oliver_pharr(Cone(slope=0.3), d, F, epsilon=2 - 4 / np.pi)
    >>> print(f"{result.E_star:.6g} {result.hardness:.6g} {result.exponent:.6g}")  # H = E* s/2
    1e+10 1.5e+09 2
    """
    check_pair(profile, Medium(1.0), "an unloading")
    constants = check.positive_number("epsilon", epsilon, zero=True), check.positive_number("beta", beta)
    if are_curves(depth):
        if force is not None or stiffness is not None or cycles:
            text = "many curves are evaluated without force, stiffness and cycles: leave these out"
            raise check.MDRError(text)
        return _table(profile, depth, time, constants)
    given = columns_of(depth, force, None if stiffness is not None and time is ... else time)
    time = given.time
    read = given.remarks[0] if given.remarks else ()
    stiffness = _measured_stiffness(given, stiffness)
    if stiffness is not None and (time is not None or cycles):
        raise check.MDRError("stiffness is measured at each sample: give it without time and cycles")
    columns = _finite_columns(given.depth, given.force, time, stiffness)
    path = columns["depth"], columns["force"]
    read = (*read, *apart(*path), *saturated(*path))
    if stiffness is None:
        read = (*read, *out_of_order(*path))
    if "time" in columns:
        read = (*read, *_drift(columns["time"], *path))
    first, contact, found, in_contact = zero_of(profile, *path)
    columns = {name: values[first:] for name, values in columns.items()}
    depth, force = columns["depth"] - contact.depth, columns["force"] - contact.baseline
    found = () if found is None else (found,)
    if stiffness is not None:
        result = over_depth(profile, depth, force, columns["stiffness"], constants, contact, found)
        return _with_other_readings(result, read, in_contact, constants)
    parts, remarks = _of_parts(profile, depth, force, columns.get("time"), constants, contact, cycles)
    numbers, triples = zip(*parts.items(), strict=True)
    corrected, uncorrected, iso = zip(*triples, strict=True)
    numbers = check.frozen(numbers if cycles else numbers[0])
    result = _collected(profile, corrected, iso, contact, constants[0], numbers, (*remarks, *found))
    result = _with_other_readings(result, read, in_contact, constants)
    result = replace(result, samples=(depth, force))
    if time is None:
        return result
    before = _collected(profile, uncorrected, iso, contact, constants[0], numbers, ())
    return replace(result, uncorrected=before)


def _table(profile, curves, time, constants):
    """Return the `CurveTable` of many measured curves."""
    epsilon, beta = constants
    results = []
    with progress(len(curves), "curves") as done:
        for i in range(len(curves)):
            try:
                results.append(oliver_pharr(profile, curves[i], time=time, epsilon=epsilon, beta=beta))
            except ValueError as error:
                results.append(Remark.of(error, "invalid"))
            done(1)
    method = f"Oliver and Pharr, ε = {epsilon:g}, β = {beta:g}"
    settings = {"method": method} | unread_of(curves)
    return table_of(profile, places_of(curves), results, settings)


def _of_parts(profile, depth, force, time, constants, contact, cycles):
    """Return values and errors by unloading, with and without a correction for creep, and remarks."""
    parts, results, remarks = parts_of(force), {}, []
    taken = sum(part.start <= last_at_top(depth) for part in parts) or 1
    every = cycles and parts
    for number, part in enumerate(parts, 1) if every else [(taken, slice(None))]:
        which = f"unloading {number} of {len(parts)}"
        moments = None if time is None else time[part]
        try:
            both, notes = _with_creep(profile, depth[part], force[part], moments, constants, contact)
            if parts:
                whole = part if every else slice(0, parts[taken - 1].stop)
                iso, text = iso_numbers(profile, depth, force, time, whole, both)
            else:
                iso, text = None, remark_on_beginning(force)
            notes += [Remark(text, "left out")] if text else []
            results[number] = *both, iso
            remarks += [each.after(f"{which}: ") for each in notes] if cycles and len(parts) > 1 else notes
        except ValueError as error:
            if not cycles or len(parts) < 2:
                raise
            remarks.append(Remark.of(error, "left out", f"{which} is left out: "))
    if not results:
        raise MeasurementError(remarks[0])
    if len(parts) > 1 and not cycles:
        text = f"unloading {taken} of {len(parts)}, which follows the largest depth, was evaluated"
        remarks.insert(0, Remark(text, "taken", Remedy("give", "cycles", True)))
    return results, remarks


def _with_creep(profile, depth, force, time, constants, contact):
    """Return values and errors of one unloading with and without correction for creep, and remarks."""
    rise, notes = creeping.rise_of_depth(depth, force), []
    creep = None if time is None else creeping.creep(depth, force, time)
    try:
        laws = laws_of(depth, force)
        uncorrected = _values_and_errors(profile, depth, laws, constants, contact)
    except ValueError as error:
        if rise and creep is None:
            raise MeasurementError(creeping.of_rise(rise, time is not None)) from error
        if creep is None:
            raise
        uncorrected = np.full((2, 5), np.nan)
    if creep is None:
        if rise:
            notes.append(creeping.of_rise(rise, time is not None))
        elif remark := _exponent_remark(profile, depth.max(), laws, time is not None):
            notes.append(remark)
        if time is not None:
            notes.append(creeping.no_hold(depth, force, time))
        return (uncorrected, uncorrected), notes
    depths = [creep.without(depth, time, n) for n in (0, 1)]
    laws = [laws_of(each, force) for each in depths]
    corrected, shifted = (
        _values_and_errors(profile, *each, constants, contact) for each in zip(depths, laws, strict=True)
    )
    corrected[1] = np.hypot(corrected[1], shifted[0] - corrected[0])
    share = creeping.share_of_compliance(creep.rate, corrected[0, 0], force, time, creep.end)
    if rise or share > creeping.COUNTS:
        notes.append(creeping.of_share(share))
    if remark := _exponent_remark(profile, depth.max(), laws[0], True):
        notes.append(remark)
    notes.append(creeping.of_hold(creep.length))
    return (corrected, uncorrected), notes


def _values_and_errors(profile, depth, laws, constants, contact):
    """Return results and standard errors from the `Laws` of an unloading, (2, 5), as in `OliverPharr`."""
    epsilon, beta = constants

    def results(F, S, m, shift=0.0):
        contact_depth = depth.max() + shift - epsilon * F / S
        return np.stack([S, contact_depth, *moduli(profile, contact_depth, F, S, beta), m]).T

    solution = laws.solution
    values, *noisy = results(*np.column_stack([solution, solution[:, None] + laws.deviations]))
    # With a contact radius of 0 or ∞, the modulus or the hardness is also 0 or ∞.
    if not np.all((values[2:] > 0) & (values[2:] < np.inf)):
        contact_depth = engineering(values[1], "m")
        text = f"the contact depth h − ε F/S = {contact_depth} must be positive and within the profile"
        raise not_from_contact(text)
    others, further = (
        [part for part in (results(*each) for each in group) if np.isfinite(part).all()]
        for group in (laws.others, laws.further)
    )
    spread = np.ptp([values, *others], axis=0) / 2
    if laws.bends(depth.max()):
        spread = np.abs(np.array([values, *others, *further]) - values).max(axis=0)
    errors = np.maximum(np.linalg.norm(np.array(noisy) - values, axis=0), spread)
    if contact.depth_error:
        shifted = results(*solution, shift=-contact.depth_error)
        errors = np.hypot(errors, np.where(np.isfinite(shifted), shifted - values, np.inf))
    return np.array([values, errors])


def _collected(profile, results, iso, contact, epsilon, numbers, remarks):
    """Return the `OliverPharr` of one unloading, or of several if `numbers` is an array."""
    columns = np.array(results) if numbers.ndim else np.array(results[0])
    names = ("stiffness", "contact_depth", "E_star", "hardness", "exponent")
    values, errors = (
        dict(zip(names, map(check.frozen, each.T), strict=True))
        for each in (columns[..., 0, :], columns[..., 1, :])
    )
    shape = columns.shape[:-2]
    values |= {"contact_point": check.frozen(np.full(shape, contact.depth)), "unloading": numbers}
    if contact.depth_error:
        errors["contact_point"] = check.frozen(np.full(shape, contact.depth_error))
    # For an unloading that has hardly begun, all these numbers are NaN.
    begun, iso = iso[0] is not None, np.array([each or (np.nan,) * 3 for each in iso])
    for name, each in zip(ISO_14577, (iso if numbers.ndim else iso[0]).T, strict=True):
        # Omit a quantity without any value in the record.
        if not (begun and np.all(np.isnan(each))):
            values[name] = check.frozen(each)
    S, h_c, E, H, m = (values[name] for name in names)
    remains = remaining(profile, h_c, S, H, m, epsilon)
    remarks = [*remarks, *_impossible(profile, values, errors, epsilon), *doubts(E, H, remains)]
    remarks += [*profile.remarks, *of_ideal_tip(profile, values["contact_depth"])]
    return OliverPharr(profile=profile, **values, standard_errors=errors, remarks=tuple(remarks))


def _drift(time, depth, force):
    """Yield a remark on a significant drift of the depth in a hold after the unloading."""
    hold = last_hold(segments_of(depth, force), force)
    if hold is None or time[hold].size < _FEWEST:
        return
    rate, top = rate_in(time[hold], depth[hold]), int(np.argmax(force))
    noise, change = roughness(depth[None])[0, 0], rate * np.ptp(time[hold])
    share = rate * (time[top] - time[0]) / np.ptp(depth[: top + 1])
    if abs(share) > _DRIFTS and abs(change) > _CERTAIN * noise:
        text = (
            f"the depth changes by {engineering(rate, 'm/s')} in the hold after the unloading: such a "
            f"drift since the first sample is {100 * share:.2g} % of the depth"
        )
        yield Remark(text, "drift", Remedy("subtract", "drift", rate))


def _impossible(profile, values, errors, epsilon):
    """Yield remarks on an impossible exponent, or an impossible ratio of hardness to modulus."""
    h_c, E, H, m = (np.ravel(values[name]) for name in ("contact_depth", "E_star", "hardness", "exponent"))
    share = np.hypot(*(np.ravel(errors[name]) / each for name, each in (("E_star", E), ("hardness", H))))
    margin = _CERTAIN * np.ravel(errors["exponent"])
    least = 0.0 if np.all(profile.face_radius > 0) else 1.0
    most = 2 * max(elastic_exponents(profile, h_c.max())[1], 2.0)
    bad = (m + margin < least) | (m - margin > most)
    if bad.any():
        text = f"m = {m[bad][0]:.3g} must be {least:g} to {most:.2g} for an unloading of this tip"
        yield Remark(f"{text}. Depth and force are not from one unloading", "misfit")
    elastic = _elastic_ratio(profile, h_c, epsilon)
    bad = H / E * (1 - _CERTAIN * share) > (1 + _ROUNDING) * elastic
    if bad.any():
        text = f"H/E* = {(H / E)[bad][0]:.3g} exceeds that of an elastic contact, {elastic[bad][0]:.3g}"
        yield Remark(
            f"{text}: the tip or the zero of the depth is wrong", "misfit", Remedy("give", "profile")
        )


def _elastic_ratio(profile, contact_depth, epsilon):
    """Return H/E* by this method for elastic contacts at contact depths (m), such as 0.509 s for cones."""
    depth, known = contact_depth, profile.known_depth
    for _ in range(_ITERATIONS):
        interval = LiveInterval.elastic(np.minimum(depth, known))
        # F/E* and S/E* are twice these integrals.
        force = integrals(profile).radius_integral(interval)
        stiffness = profile.radius_at(interval.upper)
        depth = contact_depth + epsilon * force / stiffness
    return 2 * force / (np.pi * profile.radius_at_height(contact_depth) * stiffness)


def _with_other_readings(result, read, in_contact, constants):
    """Add remarks of the file, and on other first contacts if the depth is 0 at a force."""
    if in_contact is None:
        return replace(result, remarks=(*read, *result.remarks))
    epsilon, beta = constants
    S, h_c = result.stiffness, result.contact_depth
    F = result.hardness * np.pi * (S / (2 * beta * result.E_star)) ** 2
    shifted = F - in_contact.force
    pairs = (
        (result.E_star, result.hardness),
        moduli(result.profile, h_c - in_contact.depth, F, S, beta),
        moduli(result.profile, h_c + epsilon * in_contact.force / S, shifted, S, beta),
    )
    # Take the median of several unloadings or samples.
    remark = in_contact.remark(*(tuple(float(np.nanmedian(each)) for each in pair) for pair in pairs))
    return replace(result, remarks=(*read, remark, *result.remarks))


#: Smallest significant drift since the first sample, as a share of the depth, and smallest number of
#: samples of its hold.
_DRIFTS, _FEWEST = 0.003, 10
#: Standard deviations beyond which a number is impossible; steps to the depth of an elastic contact.
_CERTAIN, _ITERATIONS = 3.0, 100
#: Largest exponent of an unloading after which more than a share of the largest depth remains, and this
#: share.
_STEEP, _REMAINS = 1.7, 0.5
#: Smallest significant half-range of m over parts of the unloading.
_VARIES = 0.1
#: Standard deviations of the scatter about the power law that m and its half-range must exceed.
_BEYOND = 3.0
#: Largest difference of exponents due to rounding, and number of samples of an elastic unloading.
_ROUNDING, _SAMPLES = 1e-6, 100


def _exponent_remark(profile, depth, laws, in_time):
    """Return a `Remark` on an exponent m that is implausible for an unloading from a depth (m), or None.

    Without yield, F = α (h − h_f)^m has the m of an elastic contact. If the imprint fits the tip, m is
    smaller, 1.2 to 1.6 for most materials. Creep of the depth makes the beginning of the unloading steeper.
    Then m is larger and differs between the parts.
    """
    m, error = laws.exponent, _BEYOND * laws.scatter
    _, elastic = elastic_exponents(profile, depth)
    if m > elastic + error + _ROUNDING:
        elastic = max(elastic, _of_elastic_unloading(profile, depth))
    least, most = laws.exponents
    remaining = laws.remaining(depth)
    steep = _STEEP * max(elastic / 2, 1.0)
    if m > elastic + error + _ROUNDING:
        text = (
            f"m = {m:.3g} exceeds the exponent of an elastic unloading of this tip, {elastic:.3g}: E* is "
            "not that of a half-space, or the depth creeps"
        )
    elif remaining > _REMAINS and m > steep + error:
        text = (
            f"m = {m:.3g} is too large for an unloading after which {100 * remaining:.2g} % of the depth "
            "remain: the depth creeps, so the stiffness is too large"
        )
    elif (most - least) / 2 > max(_VARIES, error):
        text = (
            f"the unloading is not a power law, with m between {least:.3g} and {most:.3g} in its parts: "
            "the depth creeps, so the stiffness is too large"
        )
    else:
        return None
    return Remark(text, "creep", *[Remedy("give", "time")] * (not in_time))


def _of_elastic_unloading(profile, depth):
    """Return the largest exponent of the parts of an elastic unloading from a depth (m), with a fitted h_f.

    For a truncated cone, it is the exponent of a cone.
    """
    depths = np.linspace(min(depth, profile.known_depth), 0.0, _SAMPLES)
    force = integrals(profile).radius_integral(LiveInterval.elastic(depths))
    return laws_of(depths, force).exponents[1]


def _measured_stiffness(given, stiffness):
    """Return the measured stiffness, from the argument or from the curve."""
    if stiffness is not True:
        return None if stiffness is False else stiffness
    if given.stiffness is None:
        raise check.MDRError(
            "stiffness = True needs a MeasuredCurve with a stiffness: give its values, or leave it out to "
            "evaluate the unloading"
        )
    return given.stiffness


def _finite_columns(depth, force, time, stiffness):
    """Return arrays by name, with the samples in which all given values except the stiffness are finite."""
    given = {"depth": (depth, "m"), "force": (force, "N"), "time": (time, "s")}
    arrays, _ = arrays_of(given | {"stiffness": (stiffness, "N/m")}, single=True)
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
        # Two segments of a file may share the time between them.
        back = np.diff(arrays["time"], prepend=-np.inf) < 0
        advice = "sort the samples by time"
        check.raise_if("time", arrays["time"], back, "does not increase", unit="s", advice=advice)
    return arrays
