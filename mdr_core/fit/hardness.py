"""The medium from hardness at several contact radii."""

from dataclasses import dataclass

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..impacts.scaling import class_of, straight_line
from ..medium import Medium, check_pair, yield_constant
from ..numerics.roots import increasing_root
from ..profiles.profile import Profile
from ..results.quantities import engineering
from .report import Fit


@_check.keywords_explained
def fit_hardness(
    profile: Profile, mean_pressure: ArrayLike, radius: ArrayLike, *, E_star: float
) -> "HardnessFit":
    """Fit the yield constant to mean pressures at several contact radii, and find the class of hardness.

    The mean pressure p_m = F/(π a²) under load, `Indentation.mean_pressure` on a first loading, is less
    than the hardness q_c/a, because the outer ring of the contact is elastic: q_c at each radius is the
    root of F(q_c) = π a² p_m at depth g(a), and the result their weighted mean for pressures of one
    relative error. The class follows from the power of a in q_c/a, the hardness of a fully yielded contact.

    Parameters
    ----------
    profile : Profile
        The indenter.
    mean_pressure : array_like
        Mean contact pressures p_m (Pa), positive.
    radius : array_like
        Contact radii a (m) at which they were measured, positive.
    E_star : float
        Effective modulus E* (Pa), which mean pressures do not determine.

    Returns
    -------
    HardnessFit
        The standard error is that of the mean, from the scatter of the values, infinite for a single one.

    Raises
    ------
    ValueError
        If no mean pressure is below that of an elastic contact: then nothing has yielded.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, indent
    >>> state = indent(Cone(slope=0.3), Medium(E_star=10e9, q_c=100.0), [20e-9, 40e-9, 80e-9, 160e-9])
    >>> fit = fit_hardness(Cone(slope=0.3), state.mean_pressure, state.contact_radius, E_star=10e9)
    >>> print(f"{fit.medium.q_c:.9g}", fit.hardness_class)
    100 b
    """
    E_star = _check.positive_number("effective modulus E_star", E_star, unit="Pa")
    check_pair(profile, Medium(E_star), "a fit")
    p_m, a = _measured(profile, mean_pressure, radius)
    depth, area = profile._reduced(a), np.pi * a**2 * p_m / (2 * E_star)
    d_c, yielded = _critical_depths(profile, depth, area)
    if not yielded.any():
        largest = engineering(p_m.max(), "Pa")
        raise ValueError(
            f"no mean pressure (the largest is {largest}) is below that of an elastic contact with "
            f"E* = {engineering(E_star, 'Pa')}: nothing has yielded; check E_star, or press deeper"
        )
    a, depth, area, d_c = a[yielded], depth[yielded], area[yielded], d_c[yielded]
    values = yield_constant(E_star, d_c)
    # ∂ ln F/∂ ln q_c = c d_c / ∫ a ds.
    weight = (profile._radius(depth - d_c) * d_c / area) ** 2
    mean = np.sum(weight * np.log(values)) / np.sum(weight)
    deviation = np.log(values) - mean
    variance = np.sum(weight * deviation**2) / max(a.size - 1, 1)
    error = float(np.sqrt(variance / np.sum(weight))) if a.size > 1 else np.inf
    q_c = float(np.exp(mean))
    power_law = _class(a, values)
    return HardnessFit(
        profile,
        Medium(E_star, q_c),
        standard_errors={"q_c": q_c * error},
        covariance=_check.frozen([[(q_c * error) ** 2]]),
        residuals=_check.frozen(deviation * np.sqrt(weight)),
        q_c_values=_check.frozen(values),
        remarks=tuple(_remarks(yielded, error, power_law)),
        **power_law,
    )


def _measured(profile, mean_pressure, radius):
    """Mean pressures (Pa) and contact radii (m) as arrays, checked against the profile."""
    p_m = np.atleast_1d(_check.positive("mean_pressure", mean_pressure, unit="Pa")).ravel()
    a = np.atleast_1d(_check.positive("radius", radius, unit="m")).ravel()
    if p_m.shape != a.shape or not p_m.size:
        raise ValueError(
            f"mean_pressure {p_m.shape} and radius {a.shape} must be of one shape, one value a radius"
        )
    bound = f"m is not between the flat face, {profile.face_radius:g} m, and the end of the profile"
    _check.refuse("radius", a, (a <= profile.face_radius) | (a > profile.known_radius), bound)
    _check.refuse("radius", a, a >= profile.wall, f"m is at the wall, {profile.wall:g} m, at any depth")
    return p_m, a


def _critical_depths(profile, depth, area):
    """Critical depth d_c (m) with ∫ a ds = `area` (m²) over [d − d_c, d], and whether there is one."""

    def integral(d_c):
        interval = LiveInterval(depth - d_c, depth, d_c)
        return integrals(profile).radius_integral(interval), profile._radius(interval.lower)

    d_c = increasing_root(integral, area, area / profile._radius(depth), depth, quantity="critical depth")
    return d_c, d_c < depth


def _class(a, q_c):
    """Power of the radius a in q_c/a with its error, the class that has this power, and the reason."""
    slope, error = np.nan, np.inf
    name, reason = None, "insufficient: one radius determines no class"
    if np.unique(a).size > 1:
        slope, error = straight_line(np.log(a), np.log(q_c / a))
        powers = {"a": (0.0, 0.1), "b": (-1.0, 0.1), "c": (-2.0, 0.1)}
        name, reason = class_of(powers, slope, error, "radii")
    return {"hardness_class": name, "reason": reason, "slope": slope, "slope_error": error}


def _remarks(yielded, error, power_law):
    name, reason = power_law["hardness_class"], power_law["reason"]
    if not yielded.all():
        count = f"{np.count_nonzero(~yielded)} of {yielded.size} measurements"
        yield f"{count} are as hard as an elastic contact: they do not determine q_c and were left out"
    if name not in ("b", None) or reason.startswith("none"):
        yield f"not class (b), which q_c is defined for: {reason}"
    if error == np.inf:
        yield "a single measurement determines no error of q_c: give three or more"


@dataclass(frozen=True, eq=False, repr=False)
class HardnessFit(Fit):
    """A medium fitted to mean pressures at several radii, a `Fit` returned by `fit_hardness`.

    Residuals are those of the mean pressure, relative; remarks name measurements that were left out.
    """

    standard_errors: dict[str, float]
    #: Class of hardness, "a", "b" or "c", None where none or several fit, and the reason in words.
    hardness_class: str | None
    reason: str
    #: Power of the radius in q_c/a, with its standard error.
    slope: float
    slope_error: float
    #: q_c (N/m) at each radius that has yielded.
    q_c_values: Array
    remarks: tuple[str, ...]

    def _quality(self):
        yield "class of hardness", self.reason
