"""The medium from hardness at several contact radii."""

from dataclasses import dataclass

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from .._numeric import increasing_root
from ..integrals import integrals
from ..live_interval import LiveInterval
from ..medium import Medium, check_pair, yield_constant
from ..results.quantities import engineering
from ..scaling import HardnessClass, class_of, straight_line
from ..shapes.profile import Profile
from .report import Fit


@_check.keywords_explained
def fit_hardness(
    profile: Profile, hardness: ArrayLike, radius: ArrayLike, *, E_star: float
) -> "HardnessFit":
    """Fit the yield constant to hardness at several contact radii, and find the class of hardness.

    Hardness is the mean pressure F/(π a²) under load, `Indentation.mean_pressure` on a first loading. It is
    less than q_c/a, because the outer ring of the contact is elastic: q_c at each radius is the root of
    F(q_c) = π a² H at depth g(a), and the result their weighted mean for hardnesses of one relative error.
    The class follows from the power of a in q_c/a, the hardness of a fully yielded contact.

    Parameters
    ----------
    profile : Profile
        The indenter.
    hardness : array_like
        Mean contact pressures (Pa), positive.
    radius : array_like
        Contact radii a (m) at which they were measured, positive.
    E_star : float
        Effective modulus E* (Pa), which hardness does not determine.

    Returns
    -------
    HardnessFit
        The standard error is that of the mean, from the scatter of the values, infinite for a single one.

    Raises
    ------
    ValueError
        If no hardness is below the mean pressure of an elastic contact: then nothing has yielded.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, indent
    >>> state = indent(Cone(slope=0.3), Medium(E_star=10e9, q_c=100.0), [20e-9, 40e-9, 80e-9, 160e-9])
    >>> fit = fit_hardness(Cone(slope=0.3), state.mean_pressure, state.contact_radius, E_star=10e9)
    >>> print(f"{fit.medium.q_c:.9g}", fit.class_.hardness)
    100 b
    """
    E_star = _check.positive_number("effective modulus E_star", E_star, unit="Pa")
    check_pair(profile, Medium(E_star), "a fit")
    H, a = _measured(profile, hardness, radius)
    depth, area = profile._reduced(a), np.pi * a**2 * H / (2 * E_star)
    d_c, yielded = _critical_depths(profile, depth, area)
    if not yielded.any():
        largest = engineering(H.max(), "Pa")
        raise ValueError(
            f"no hardness (the largest is {largest}) is below the mean pressure of an elastic contact with "
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
    q_c, hardness_class = float(np.exp(mean)), _class(a, values)
    return HardnessFit(
        profile, Medium(E_star, q_c), {"q_c": q_c * error}, _check.frozen([[(q_c * error) ** 2]]),
        _check.frozen(deviation * np.sqrt(weight)), class_=hardness_class, q_c_values=_check.frozen(values),
        remarks=tuple(_remarks(yielded, hardness_class, error)),
    )  # fmt: skip


def _measured(profile, hardness, radius):
    """Hardness (Pa) and contact radius (m) as arrays, checked against the profile."""
    H = np.atleast_1d(_check.positive("hardness", hardness, unit="Pa")).ravel()
    a = np.atleast_1d(_check.positive("radius", radius, unit="m")).ravel()
    if H.shape != a.shape or not H.size:
        raise ValueError(
            f"hardness {H.shape} and radius {a.shape} must be of one shape, one value a radius"
        )
    bound = f"m is not between the flat face, {profile.face_radius:g} m, and the end of the profile"
    _check.refuse("radius", a, (a <= profile.face_radius) | (a > profile.known_radius), bound)
    _check.refuse("radius", a, a >= profile.wall, f"m is at the wall, {profile.wall:g} m, at any depth")
    return H, a


def _critical_depths(profile, depth, area):
    """Critical depth d_c (m) with ∫ a ds = `area` (m²) over [d − d_c, d], and whether there is one."""

    def integral(d_c):
        interval = LiveInterval(depth - d_c, depth, d_c)
        return integrals(profile).radius_integral(interval), profile._radius(interval.lower)

    d_c = increasing_root(integral, area, area / profile._radius(depth), depth, quantity="critical depth")
    return d_c, d_c < depth


def _class(a, q_c):
    """`HardnessClass` by the power of the radius a in q_c/a, each with its tolerance."""
    if np.unique(a).size < 2:
        return HardnessClass(None, np.nan, np.inf, {}, "insufficient: one radius determines no class")
    slope, error = straight_line(np.log(a), np.log(q_c / a))
    powers = {"a": (0.0, 0.1), "b": (-1.0, 0.1), "c": (-2.0, 0.1)}
    name, reason = class_of(powers, slope, error, "radii")
    return HardnessClass(name, slope, error, {}, reason)


def _remarks(yielded, hardness_class, error):
    if not yielded.all():
        count = f"{np.count_nonzero(~yielded)} of {yielded.size} measurements"
        yield f"{count} are as hard as an elastic contact: they do not determine q_c and were left out"
    if hardness_class.hardness not in ("b", None) or hardness_class.reason.startswith("none"):
        yield f"not class (b), which q_c is defined for: {hardness_class.reason}"
    if error == np.inf:
        yield "a single measurement determines no error of q_c: give three or more"


@dataclass(frozen=True, eq=False, repr=False)
class HardnessFit(Fit):
    """A medium fitted to hardness at several radii, a `Fit` returned by `fit_hardness`.

    Residuals are those of the hardness, relative; remarks name measurements that were left out.
    """

    standard_errors: dict[str, float]
    #: Power of the radius, `slope` ± `slope_error`, and the class as `hardness`.
    class_: HardnessClass
    #: q_c (N/m) at each radius that has yielded.
    q_c_values: Array
    remarks: tuple[str, ...]

    def _quality(self):
        yield "class of hardness", self.class_.reason
