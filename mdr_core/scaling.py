"""Scaling laws of very fast impacts, and which class of hardness a material belongs to.

Popov (2015), section 1, divides plasticity into three classes: hardness (a) constant, (b) inversely
proportional to the contact radius, (c) inversely proportional to the contact area, governed by
volume, surface and line processes. Under a fully yielded contact the force goes as a^i with
i = 2, 1, 0. For a shape z = c rⁿ that gives powers of the impact energy.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _check
from ._check import Array, ArrayLike
from ._numeric import increasing_root
from .limits import Limit
from .report import Report
from .superposition import radius_integral
from .yielding import elastic_interval

_FORCE_POWER = {"a": 2, "b": 1, "c": 0}
#: Relative error up to which the fast limit is near.
_NEAR = 0.1


@dataclass(frozen=True)
class ScalingLaw:
    """Powers of the impact energy W in the limit of very fast impacts on a class of hardness.

    With F ∝ aⁱ and a ∝ d^(1/n), the work goes as d^((n + i)/n); the energy that comes back as F²/a.

    Parameters
    ----------
    hardness : {"a", "b", "c"}
        Class: hardness constant, ∝ 1/radius, ∝ 1/area.
    exponent : float
        Exponent n of the indenter z = c rⁿ, positive: 1 for a cone, 2 for a paraboloid.

    Examples
    --------
    In class (b) the area that a cone damages is proportional to the energy (Popov 2015, Eq. (24)),
    and the coefficient of restitution falls as the root of the speed:

    >>> law = ScalingLaw("b", 1.0)
    >>> law.area, law.restitution
    (1.0, -0.5)
    """

    hardness: str
    exponent: float

    def __post_init__(self):
        _check.one_of("hardness class", self.hardness, _FORCE_POWER)
        exponent = _check.positive_number("ScalingLaw exponent", self.exponent)
        object.__setattr__(self, "exponent", exponent)

    @property
    def force(self) -> int:
        """Power of the contact radius that the force goes with under full yield: i = 2, 1, 0."""
        return _FORCE_POWER[self.hardness]

    @property
    def radius(self) -> float:
        """Power of W that the contact radius goes with."""
        return 1 / (self.exponent + self.force)

    @property
    def depth(self) -> float:
        """Power of W that the depth goes with: 1 in class (c)."""
        return self.exponent * self.radius

    @property
    def area(self) -> float:
        """Power of W that the contact area goes with: 1 for a cone in class (b)."""
        return 2 * self.radius

    @property
    def volume(self) -> float:
        """Power of W that the expelled volume goes with: 1 in class (a)."""
        return (self.exponent + 2) * self.radius

    @property
    def restitution(self) -> float:
        """Power of the *speed* that the coefficient of restitution goes with."""
        return (self.force - 1 - self.exponent) * self.radius


@dataclass(frozen=True)
class HardnessClass:
    """Which class measured imprints belong to; made by `hardness_class` and `fit_hardness`.

    `hardness` is the class, None where none fits or the data do not tell, and `reason` says why; `slope`
    the measured power with its standard error `slope_error`, infinite from two places; `laws` the
    `ScalingLaw` of each class, where it is a power of the energy.
    """

    hardness: str | None
    slope: float
    slope_error: float
    laws: dict[str, ScalingLaw] = field(repr=False)
    reason: str


def hardness_class(energy: ArrayLike, radius: ArrayLike, exponent: float) -> HardnessClass:
    """The class of hardness that imprints of fast impacts tell: how their radius grows with energy.

    Fits ln(radius) against ln(energy) and compares the slope with 1/(n + i): a class fits within two
    standard errors, or a tenth, for impacts are never quite fast. The answer is None where no class fits or
    more than one, and from two energies alone, which leave no error to judge by.

    Parameters
    ----------
    energy : array_like
        Energies (J) that were lost in the impacts, positive; at least two that differ.
    radius : array_like
        Radii (m) of the imprints, positive.
    exponent : float
        Exponent n of the indenter z = c rⁿ.

    Returns
    -------
    HardnessClass

    Examples
    --------
    >>> from mdr_core import Cone, Medium, impact
    >>> hit = impact(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), 1e-6, [1.0, 3.0, 10.0])
    >>> hardness_class(hit.plastic_work, hit.plastic_radius, exponent=1.0).hardness
    'b'
    """
    energy, radius = (
        np.atleast_1d(_check.positive(name, value, unit=unit))
        for name, value, unit in (("energy", energy, "J"), ("radius", radius, "m"))
    )
    x, y = np.log(energy.ravel()), np.log(radius.ravel())
    if energy.shape != radius.shape or np.all(x == x[:1]):
        raise ValueError(
            f"energy {energy.shape} and radius {radius.shape} must be of one shape, with two energies or "
            "more that differ"
        )
    laws = {name: ScalingLaw(name, exponent) for name in _FORCE_POWER}
    slope, error = straight_line(x, y)
    expected = {name: (law.radius, _NEAR * law.radius) for name, law in laws.items()}
    found, reason = class_of(expected, slope, error)
    return HardnessClass(found, slope, error, laws, reason)


def straight_line(x, y):
    """Slope of y over x by least squares, and its standard error: infinite from two places."""
    x, y = x - x.mean(), y - y.mean()
    slope = (x @ y) / (x @ x)
    rest = y - slope * x
    enough = np.unique(x).size > 2
    return float(slope), float(np.sqrt(rest @ rest / (x.size - 2) / (x @ x)) if enough else np.inf)


def class_of(expected, slope, error, places="energies"):
    """The one class that a measured power fits, if it is one, and the reason.

    `expected` has the power in each class, and what is near to it however small the error is.
    """
    powers = ", ".join(f"{name}: {power:.3g}" for name, (power, _) in expected.items())
    measured = f"the slope {slope:.3g} ± {error:.2g}, where the classes have {powers}"
    if error == np.inf:
        return (
            None,
            f"insufficient: two {places} leave no error of the slope {slope:.3g}; give three or more",
        )
    fits = [n for n, (power, near) in expected.items() if abs(slope - power) <= max(2 * error, near)]
    if len(fits) == 1:
        return fits[0], f"class {fits[0]} alone fits {measured}"
    return None, f"{'none' if not fits else 'more than one class'} fits {measured}"


@dataclass(frozen=True, eq=False, repr=False)
class FastLimit(Report):
    """An impact in the limit in which everything under the indenter yields, beside the exact one.

    Popov (2015), Eqs. (23), (24): the work is π q_c ∫ a dd, for a cone q_c d²/s, and all of the
    contact is damaged. Restitution is √(U/W) with U = E* a d_c².

    Attributes
    ----------
    max_depth, contact_area, restitution : float or ndarray
        Depth (m), area (m²), coefficient of restitution in that limit.
    max_depth_error, contact_area_error, restitution_error : float or ndarray
        Their relative errors against the exact impact; large where the limit does not hold.
    """

    max_depth: Array
    contact_area: Array
    restitution: Array
    max_depth_error: Array
    contact_area_error: Array
    restitution_error: Array

    _quantities = (
        "max_depth", "contact_area", "restitution", "max_depth_error", "contact_area_error",
        "restitution_error",
    )  # fmt: skip
    _shown = _quantities
    _dimensions = ("impact",)

    def __getitem__(self, index: Any) -> "FastLimit":
        return FastLimit(*(getattr(self, name)[index] for name in self._quantities))


def fast_limit(hit):
    """The `FastLimit` of an `Impact`."""
    profile, medium = hit.profile, hit.medium
    d_c = np.asarray(medium.critical_depth)
    _check.refuse("critical depth", d_c, np.isinf(d_c), "m: nothing yields", remedy="give q_c")
    shape = np.shape(hit.max_depth)
    energy = hit.mass * hit.speed**2 / 2
    target = np.broadcast_to(energy / (np.pi * medium.q_c), shape)

    def work(depth):
        return radius_integral(profile, elastic_interval(depth)), profile._radius(depth)

    with np.errstate(over="ignore", under="ignore"):
        depth = increasing_root(work, target, hit.max_depth, profile.known_depth)
    known = np.min(profile.known_depth, initial=_check.LARGEST)
    bound = f"m/s presses deeper than the shape is known, {known:g} m, in this limit"
    _check.refuse("speed", np.asarray(hit.speed), np.isinf(depth), bound, remedy="hit less hard")
    a = profile._radius(depth)
    area, restitution = np.pi * a**2, np.sqrt(medium.E_star * a * d_c**2 / energy)
    exact = hit.max_depth, np.pi * hit.contact_radius**2, hit.restitution
    errors = (limit / value - 1 for limit, value in zip((depth, area, restitution), exact, strict=True))
    return FastLimit(*(_check.frozen(part) for part in (depth, area, restitution, *errors)))


def how_fast(hit):
    """How far the fast limit (23), (24) is off for an `Impact`, as `Limit`s: none where nothing yields."""
    if np.any(np.isinf(hit.medium.critical_depth)) or not np.any(hit.plastic_depth_increase > 0):
        return ()
    equations, first = "Eqs. (23), (24)", np.all(hit.plastic_depth == hit.plastic_depth_increase)
    try:
        limit = hit.fast_limit
    except ValueError as error:
        return (Limit("fast limit", np.inf, _NEAR, True, f"{equations} do not hold: {error}.", equations),)
    area, depth = (
        float(np.ravel(error)[np.argmax(np.abs(error))])
        for error in (limit.contact_area_error, limit.max_depth_error)
    )
    # All of the energy is to go into yield: errors that cross zero because it does not tell nothing.
    viscous = float(np.max(hit.viscous_work / (hit.mass * hit.speed**2 / 2)))
    value = max(abs(area), abs(depth), viscous)
    exceeded = value > _NEAR or not first
    text = f"The fast limit, {equations}, {'does not hold' if exceeded else 'holds'}: "
    text += f"{_percent(area)} of the area, {_percent(depth)} of the depth"
    if viscous > _NEAR:
        text += f", and viscosity takes {100 * viscous:.3g} % of the energy"
    if not first:
        text += ", for it is for the first impact on a spot"
    return (Limit("fast limit", value, _NEAR, exceeded, f"{text}.", equations),)


def _percent(share):
    """A share with its sign, as text."""
    return f"{100 * share:+.3g} %".replace("-", "−")
