"""The medium from hardness over contact radius."""

from dataclasses import dataclass

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..medium import Medium, check_pair
from ..quantities import engineering
from ..scaling import HardnessClass, class_of, straight_line
from ..shapes.profile import Profile
from ..superposition import radius_integral
from ..yielding import LiveInterval, elastic_interval
from .least_squares import Fit

#: Power of the contact radius that the hardness goes with in each class, and what is near to it.
_POWERS = {"a": (0.0, 0.1), "b": (-1.0, 0.1), "c": (-2.0, 0.1)}


@_check.keywords_explained
def fit_hardness(
    profile: Profile, hardness: ArrayLike, radius: ArrayLike, *, E_star: float
) -> "HardnessFit":
    """The yield constant from hardness at some contact radii, and the class of hardness that they tell.

    Hardness is the mean pressure F/(π a²) under load, `Indentation.mean_pressure` on a first loading. It is
    less than q_c/a, for the outer ring of the contact is elastic still (a cone lacks 25 % at twice the
    critical depth, 5 % at ten times): q_c of each measurement is the exact root of F(q_c) = π a² H at depth
    g(a), and the result their mean, weighted by how well each tells it where all hardnesses have the same
    relative error. The class is that of ln(q_c/a) over ln a, the hardness that a fully yielded contact has.

    Parameters
    ----------
    profile : Profile
        The indenter.
    hardness : array_like
        Mean contact pressures (Pa), positive.
    radius : array_like
        Contact radii a (m) at which they were measured, positive.
    E_star : float
        Effective modulus E* (Pa), which hardness does not tell.

    Returns
    -------
    HardnessFit

    Raises
    ------
    ValueError
        If no hardness is below the mean pressure of an elastic contact: then nothing tells of yield.

    Notes
    -----
    The standard error is that of the mean, from how the measurements scatter, and infinite for one.

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
    H, a = _places(profile, hardness, radius)
    depth, area = profile._reduced(a), np.pi * a**2 * H / (2 * E_star)
    ell, told = _critical_depths(profile, depth, area)
    if not told.any():
        worst = engineering(H.max(), "Pa")
        raise ValueError(
            f"no hardness (the largest is {worst}) is below the mean pressure of an elastic contact with "
            f"E* = {engineering(E_star, 'Pa')}: nothing has yielded; check E_star, or press deeper"
        )
    a, depth, area, ell = a[told], depth[told], area[told], ell[told]
    each = 2 / np.pi * E_star * ell
    # ∂ ln F/∂ ln q_c = c d_c / ∫ a ds.
    weight = (profile._radius(depth - ell) * ell / area) ** 2
    logs = np.log(each)
    mean = np.sum(weight * logs) / np.sum(weight)
    scatter = np.sum(weight * (logs - mean) ** 2) / max(a.size - 1, 1)
    share = float(np.sqrt(scatter / np.sum(weight))) if a.size > 1 else np.inf
    q_c, measured = float(np.exp(mean)), _class(a, each)
    covariance, residuals = np.array([[(q_c * share) ** 2]]), (logs - mean) * np.sqrt(weight)
    return HardnessFit(
        profile, Medium(E_star, q_c), {"q_c": q_c * share}, _check.frozen(covariance),
        _check.frozen(residuals), measured, _check.frozen(each), _remarks(told, measured, share),
    )  # fmt: skip


def _places(profile, hardness, radius):
    """Hardness (Pa) and contact radius (m) of each place, within the shape."""
    H, a = (
        np.atleast_1d(_check.positive(name, value, unit=unit)).ravel()
        for name, value, unit in (("hardness", hardness, "Pa"), ("radius", radius, "m"))
    )
    if H.shape != a.shape or not H.size:
        raise ValueError(
            f"hardness {H.shape} and radius {a.shape} must be of one shape, one of each a place"
        )
    bound = f"m is not between the flat face, {profile.face_radius:g} m, and where the shape ends"
    _check.refuse("radius", a, (a <= profile.face_radius) | (a > profile.known_radius), bound)
    _check.refuse("radius", a, a >= profile.wall, f"m is at the wall, {profile.wall:g} m, at any depth")
    return H, a


def _critical_depths(profile, depth, area):
    """Critical depth ℓ with ∫ a ds = `area` over [d − ℓ, d], and where there is one.

    The integral grows with ℓ and bends downward: Newton's method from area/a comes from below, and never
    too far.
    """
    told = area < radius_integral(profile, elastic_interval(depth))
    ell = np.minimum(area / profile._radius(depth), depth)
    for _ in range(200):
        interval = LiveInterval(depth - ell, depth, ell)
        step = (area - radius_integral(profile, interval)) / np.maximum(
            profile._radius(interval.lower), 1e-300
        )
        new = np.minimum(ell + np.maximum(step, 0.0), depth)
        if np.all((new - ell <= 1e-15 * new) | ~told):
            break
        ell = new
    return ell, told


def _class(a, q_c):
    if np.unique(a).size < 2:
        return HardnessClass(None, np.nan, np.inf, {}, "insufficient: one radius tells no class")
    slope, error = straight_line(np.log(a), np.log(q_c / a))
    found, reason = class_of(_POWERS, slope, error, "radii")
    return HardnessClass(found, slope, error, {}, reason)


def _remarks(told, measured, share):
    found = []
    if not told.all():
        found.append(
            f"{np.count_nonzero(~told)} of {told.size} places are as hard as an elastic contact: they tell "
            "of no yield and were left out"
        )
    if measured.hardness not in ("b", None) or measured.reason.startswith("none"):
        found.append(f"not class (b), for which q_c is: {measured.reason}")
    if share == np.inf:
        found.append("one place leaves no error of q_c: give three or more")
    return tuple(found)


@dataclass(frozen=True, eq=False, repr=False)
class HardnessFit(Fit):
    """A medium fitted to hardness over radius; made by `fit_hardness`.

    Attributes
    ----------
    medium : Medium
        With the E* that was given and the fitted q_c.
    standard_errors : dict
        Of q_c (N/m), by name; `covariance` is its square.
    residuals : ndarray
        Relative residuals of the hardness.
    class_ : HardnessClass
        Power of the radius that hardness goes with, `slope` ± `slope_error`, and the class as `hardness`.
    each : ndarray
        q_c (N/m) of each place.
    remarks : tuple of str
    """

    profile: Profile
    medium: Medium
    standard_errors: dict[str, float]
    covariance: Array
    residuals: Array
    class_: HardnessClass
    each: Array
    remarks: tuple[str, ...]

    def _quality(self):
        yield "class of hardness", self.class_.reason
