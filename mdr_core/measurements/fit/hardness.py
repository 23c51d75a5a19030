"""Fit of the hardness of a medium to mean pressures at several contact radii."""

from dataclasses import dataclass
from types import EllipsisType

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike
from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ...solver.applicability import check_pair
from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from ...solver.contact.yielding import yield_rule
from ...solver.impacts.scaling import HardnessClass, class_of
from ...solver.medium.medium import Medium, yield_constant
from ...solver.numerics.roots import increasing_root
from ...solver.profiles.profile import Profile
from ..common.doubts import doubts_of_measured
from ..common.errors import covariances
from ..common.least_squares import least_squares
from .parameters import CLASSES, hardness_by_default, held_values, symbols
from .report import Fit

#: Power of the contact radius in the hardness of each class, and its tolerance.
_POWERS = {"a": (0.0, 0.1), "b": (-1.0, 0.1), "c": (-2.0, 0.1)}


@check.keywords_explained
def fit_hardness(
    profile: Profile,
    mean_pressure: ArrayLike,
    radius: ArrayLike,
    *,
    E_star: float,
    q_c: float | EllipsisType | None = ...,
    hardness: float | EllipsisType | None = ...,
    f_c: float | EllipsisType | None = ...,
) -> "HardnessFit":
    """Fit the hardness to mean pressures at several contact radii, and find its class.

    The mean pressure p_m = F/(π a²) under load, `Indentation.mean_pressure` on a first loading, is less
    than the hardness σ_c(a) = hardness + q_c/a + f_c/a², because the outer ring of the contact is elastic.
    Thus σ_c at each radius is the root of F(σ_c) = π a² p_m at depth g(a). The constants minimize the
    squared residuals of ln σ_c, for pressures of equal relative error. The class follows from the power of
    a in σ_c.

    Parameters
    ----------
    profile : Profile
        The indenter.
    mean_pressure : array_like
        Mean contact pressures p_m (Pa), positive.
    radius : array_like
        Contact radii a (m) of these pressures, positive.
    E_star : float
        Effective modulus E* (Pa), which mean pressures do not determine.
    q_c, hardness, f_c : float, optional
        Constants of the hardness (N/m, Pa, N). None is free, a number is held, and other constants are 0.
        If no constant is given, the constant of the class is free. If no single class fits, it is the
        constant with the nearest power of a; at a single radius it is q_c.

    Returns
    -------
    HardnessFit
        Standard errors follow from the scatter of the values; for a single value they are infinite.

    Raises
    ------
    ValueError
        If no mean pressure is below that of an elastic contact, so nothing has yielded. If several
        constants are free, and there are not more measurements, or fewer radii, than constants. If a
        hardness is free under a shape that is not convex.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, fit_hardness, indent
    >>> medium = Medium(E_star=10e9, hardness=0.5e9)
    >>> state = indent(Cone(slope=0.3), medium, [20e-9, 40e-9, 80e-9, 160e-9])
    >>> fit = fit_hardness(Cone(slope=0.3), state.mean_pressure, state.contact_radius, E_star=10e9)
    >>> print(f"{fit.medium.hardness:.9g}", fit.class_of_hardness)
    500000000 (a)

    A size effect with two constants:

    >>> medium = Medium(E_star=10e9, hardness=0.5e9, q_c=20.0)
    >>> state = indent(Cone(slope=0.3), medium, [20e-9, 40e-9, 80e-9, 160e-9])
    >>> data = state.mean_pressure, state.contact_radius
    >>> fit = fit_hardness(Cone(slope=0.3), *data, E_star=10e9, hardness=None, q_c=None)
    >>> print(f"{fit.medium.hardness:.9g} {fit.medium.q_c:.9g}")
    500000000 20
    """
    E_star = check.positive_number("effective modulus E_star", E_star, unit="Pa")
    check_pair(profile, Medium(E_star), "a fit")
    p_m, a = _measured(profile, mean_pressure, radius)
    radii, depth, area = a, profile.reduced_at(a), np.pi * a**2 * p_m / (2 * E_star)
    cap, yielded = _caps(profile, depth, area)
    if not yielded.any():
        largest = engineering(p_m.max(), "Pa")
        raise check.MDRError(
            f"all mean pressures (up to {largest}) are as large as in an elastic contact with E* = "
            f"{engineering(E_star, 'Pa')}: nothing has yielded; check E_star, or press deeper"
        )
    a, depth, area, cap = a[yielded], depth[yielded], area[yielded], cap[yielded]
    values = yield_constant(E_star, cap)
    found = class_of(_POWERS, np.log(a), np.log(values / a), "radii")
    given = {"hardness": hardness, "q_c": q_c, "f_c": f_c}
    if all(value is ... for value in given.values()):
        given = {CLASSES[found.best or "b"]: None}
    given = hardness_by_default(**{name: given.get(name, ...) for name in CLASSES.values()})
    held = {name: float(value[0]) for name, value in held_values(1, **given).items()}
    # ∂ ln F/∂ ln σ_c = c u_c / ∫ a ds.
    weight = profile.radius_at(depth - cap) * cap / area
    constants, minimum, covariance = _constants(a, values / a, weight, held)
    medium = Medium(E_star, **constants)
    # Raises an error for shapes that are not convex.
    yield_rule(profile, medium)
    free = [name for name in constants if name not in held]
    errors = np.sqrt(np.diag(covariance))
    return HardnessFit(
        profile,
        medium,
        standard_errors=dict(zip(free, errors.tolist(), strict=True)),
        covariance=check.frozen(covariance),
        residuals=check.frozen(minimum.residual[0]),
        q_c_values=check.frozen(values),
        remarks=(
            *doubts_of_measured(E_star, p_m, radii),
            *_remarks(yielded, constants, errors, free, found),
        ),
        class_of_hardness=found,
    )


def _constants(a, hardness, weight, held):
    """Return the hardness constants by name, the `Minimum` of the weighted ln σ_c, and their covariance."""
    powers = {name: a**-power for power, name in enumerate(CLASSES.values())}
    free = [name for name in powers if name not in held]
    if not free:
        raise check.MDRError("hardness, q_c and f_c are all held: give None for each constant to fit")
    if len(free) > 1 and (a.size <= len(free) or np.unique(a).size < len(free)):
        raise check.MDRError(
            f"{a.size} measurements with yield, at {np.unique(a).size} radii, do not determine "
            f"{' and '.join(free)}: give more, or fit one constant"
        )
    units = np.array([np.median(hardness / powers[name]) for name in free])
    columns = units[:, None] * np.array([powers[name] for name in free])
    remainder = sum(held[name] * powers[name] for name in held)

    def residuals(x, _):
        model = x @ columns + remainder
        return weight * np.log(hardness / model), -(weight * columns / model).T[None]

    start = np.full((1, len(free)), 1 / len(free))
    with np.errstate(divide="ignore", invalid="ignore"):
        minimum = least_squares(residuals, start, 0 * start, start + np.inf)
    excess = a.size - len(free)
    variance = minimum.sum_of_squares[0] / excess if excess else np.inf
    covariance = covariances(minimum.jacobian, variance)[0] * units[:, None] * units
    values = dict(zip(free, (minimum.x[0] * units).tolist(), strict=True))
    return {name: values.get(name, held.get(name)) for name in powers}, minimum, covariance


def _measured(profile, mean_pressure, radius):
    """Return mean pressures (Pa) and contact radii (m) as arrays, checked against the profile."""
    p_m = np.atleast_1d(check.positive("mean_pressure", mean_pressure, unit="Pa")).ravel()
    a = np.atleast_1d(check.positive("radius", radius, unit="m")).ravel()
    if p_m.shape != a.shape or not p_m.size:
        raise check.MDRError(
            f"mean_pressure {p_m.shape} and radius {a.shape} must have the same shape, one value for "
            "each radius"
        )
    bound = f"m is not between the flat face, {profile.face_radius:g} m, and the end of the profile"
    check.raise_if("radius", a, (a <= profile.face_radius) | (a > profile.known_radius), bound)
    check.raise_if("radius", a, a >= profile.wall, f"m is at the wall, {profile.wall:g} m, at any depth")
    return p_m, a


def _caps(profile, depth, area):
    """Return the cap u_c (m) with ∫ a ds = `area` (m²) over [d − u_c, d], and whether it exists."""

    def integral(cap):
        interval = LiveInterval(depth - cap, depth, cap)
        return integrals(profile).radius_integral(interval), profile.radius_at(interval.lower)

    cap = increasing_root(integral, area, area / profile.radius_at(depth), depth, quantity="cap")
    return cap, cap < depth


def _remarks(yielded, constants, errors, free, found):
    if not yielded.all():
        count = f"{np.count_nonzero(~yielded)} of {yielded.size} measurements"
        text = (
            "have the pressure of an elastic contact: they do not determine the hardness and are left out"
        )
        yield Remark(f"{count} {text}", "left out")
    used = [letter for letter, constant in CLASSES.items() if constants[constant] or constant in free]
    if len(used) == 1 and found.best and not (found.describes and used[0] in found.possible):
        text = f"not of class ({used[0]}) alone: {found.reason}; two constants of the hardness may fit"
        yield Remark(
            text, "misfit", *(Remedy("free", each) for each in CLASSES.values() if each not in free)
        )
    for constant, error in zip(free, errors, strict=True):
        if len(free) > 1 and constants[constant] < 2 * error:
            text = f"the radii do not distinguish {symbols(free)}: {symbols([constant])} may be 0"
            yield Remark(text, "constant", Remedy("hold", constant, 0.0))
    if np.isinf(errors).any():
        text = f"the standard error of {symbols(free[:1])} cannot be determined from one measurement"
        yield Remark(f"{text}: give three or more", "errors")


@dataclass(frozen=True, eq=False, repr=False)
class HardnessFit(Fit):
    """Medium fitted to mean pressures at several radii, a `Fit` returned by `fit_hardness`.

    Residuals are the relative residuals of the mean pressure. Remarks report omitted measurements.

    Examples
    --------
    >>> from mdr_core import Cone, fit_hardness
    >>> fit = fit_hardness(Cone(slope=0.3), [1e-6, 2e-6, 4e-6], [2e9, 1e9, 5e8], E_star=70e9, q_c=None)
    >>> print(fit.class_of_hardness, f"{fit.class_of_hardness.slope:.1f}")
    (b) -1.0
    """

    standard_errors: dict[str, float]
    #: Class of hardness, with the power of the radius in σ_c as its slope.
    class_of_hardness: HardnessClass
    #: a σ_c (N/m) at each radius with yield: q_c for class (b).
    q_c_values: Array
    remarks: tuple[Remark, ...]

    hardness_class = check.former("hardness_class", "class_of_hardness.letter")
    reason = check.former("reason", "class_of_hardness.reason")
    slope = check.former("slope", "class_of_hardness.slope")
    slope_error = check.former("slope_error", "class_of_hardness.slope_error")
    _zero_unless_asked = tuple(CLASSES.values())

    def _quality(self):
        yield "class of hardness", self.class_of_hardness.reason
