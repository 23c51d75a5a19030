"""Scaling laws of very fast impacts, and the class of hardness of a material.

Popov (2015), section 1, distinguishes three classes of plasticity: hardness (a) constant, (b) inversely
proportional to the contact radius, (c) inversely proportional to the contact area. In a fully yielded
contact the force is proportional to a^i with i = 2, 1, 0.
"""

from dataclasses import dataclass

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike
from ...base.results import Entries, Record
from ..contact.integrals import integrals
from ..contact.live_interval import LiveInterval
from ..medium.medium import refuse_other_classes
from ..numerics.roots import increasing_root

_FORCE_POWER = {"a": 2, "b": 1, "c": 0}
#: Largest relative error at which the fast limit holds.
MAX_ERROR = 0.1


@dataclass(frozen=True)
class ScalingLaw:
    """Power laws in the impact energy W for very fast impacts on a medium of one class of hardness.

    With F ∝ aⁱ and a ∝ d^(1/n), the work is proportional to d^((n + i)/n), the elastic energy to F²/a. The
    medium is on a rigid support: a `Structure` takes up a part of the energy that is not a power of W.

    Parameters
    ----------
    hardness_class : {"a", "b", "c"}
        Class: hardness constant, ∝ 1/radius, ∝ 1/area.
    exponent : float
        Exponent n of the indenter z = c rⁿ, positive: 1 for a cone, 2 for a paraboloid.

    Examples
    --------
    >>> from mdr_core import ScalingLaw
    >>> ScalingLaw("b", 1.0).area  # Popov (2015), Eq. (24)
    1.0
    """

    hardness_class: str
    exponent: float

    def __post_init__(self):
        check.one_of("hardness_class", self.hardness_class, _FORCE_POWER)
        exponent = check.positive_number("ScalingLaw exponent", self.exponent)
        check.store(self, exponent=exponent)

    @property
    def force(self) -> int:
        """Power i = 2, 1, 0 of the contact radius in the force at full yield."""
        return _FORCE_POWER[self.hardness_class]

    @property
    def radius(self) -> float:
        """Power of W in the contact radius."""
        return 1 / (self.exponent + self.force)

    @property
    def depth(self) -> float:
        """Power of W in the depth: 1 in class (c)."""
        return self.exponent * self.radius

    @property
    def area(self) -> float:
        """Power of W in the contact area: 1 for a cone in class (b)."""
        return 2 * self.radius

    @property
    def volume(self) -> float:
        """Power of W in the expelled volume: 1 in class (a)."""
        return (self.exponent + 2) * self.radius

    @property
    def restitution(self) -> float:
        """Power of the *speed* in the coefficient of restitution."""
        return (self.force - 1 - self.exponent) * self.radius


@dataclass(frozen=True)
class HardnessClass:
    """Class of hardness from measurements: imprints, mean pressures or a curve.

    `best` is the letter of the nearest class, or None if the measurements do not determine it. `possible`
    has the letters of all classes that are not ruled out. `describes` is whether the best class describes
    the measurements, and `reason` is the evidence in words.

    For imprints and mean pressures, `slope` is the measured power with its standard error `slope_error`,
    infinite for two points. For a curve both are None.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, hardness_class, impact
    >>> hit = impact(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), 1e-6, [1.0, 3.0, 10.0])
    >>> found = hardness_class(hit.plastic_work, hit.plastic_radius, exponent=1.0)
    >>> found.letter, found.possible, round(found.slope, 2)
    ('b', ('b',), 0.5)
    """

    best: str | None
    possible: tuple[str, ...]
    describes: bool
    reason: str
    slope: float | None = None
    slope_error: float | None = None

    @property
    def letter(self) -> str | None:
        """Letter of the class that alone describes the measurements, else None."""
        return self.best if self.describes and len(self.possible) == 1 else None

    hardness_class = check.former("hardness_class", "letter")

    def __str__(self) -> str:
        letters = ") or (".join(self.possible)
        answer = f"({letters})" if len(self.possible) == 1 else f"not determined, ({letters})"
        return answer if self.describes else f"{answer}, which describes the measurements poorly"


def hardness_class(energy: ArrayLike, radius: ArrayLike, exponent: float) -> HardnessClass:
    """Determine the class of hardness from the radii of imprints of fast impacts at several energies.

    The slope of ln(radius) over ln(energy) is compared with 1/(n + i). A class fits within two standard
    errors, or within 10 %, because real impacts are only approximately fast. The target must be thick and
    massive: a plate or a soft support takes a part of the energy. Popov (2015), section 1, defines the
    classes.

    Parameters
    ----------
    energy, radius : array_like
        Energies (J) dissipated by the impacts, with at least two different values, and radii (m) of the
        imprints.
    exponent : float
        Exponent n of the indenter z = c rⁿ, positive: 1 for a cone, 2 for a paraboloid.

    Returns
    -------
    HardnessClass
        The class, with its `letter` or None, and the reason in words.

    Raises
    ------
    ValueError
        If energies and radii are not positive or of different shapes, or all energies are the same.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, hardness_class, impact
    >>> hit = impact(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), 1e-6, [1.0, 3.0, 10.0])
    >>> hardness_class(hit.plastic_work, hit.plastic_radius, exponent=1.0).letter
    'b'
    """
    energy = np.atleast_1d(check.positive("energy", energy, unit="J"))
    radius = np.atleast_1d(check.positive("radius", radius, unit="m"))
    x, y = np.log(energy.ravel()), np.log(radius.ravel())
    if energy.shape != radius.shape or np.all(x == x[:1]):
        bound = "must be of the same shape, with at least two different energies"
        raise check.MDRError(f"energy {energy.shape} and radius {radius.shape} {bound}")
    powers = {name: ScalingLaw(name, exponent).radius for name in _FORCE_POWER}
    expected = {name: (power, MAX_ERROR * power) for name, power in powers.items()}
    return class_of(expected, x, y, "energies")


def class_of(expected, x, y, points):
    """Return the `HardnessClass` from the slope of y over x at some `points`.

    `expected` has the power of each class, and its tolerance if two standard errors are smaller.
    """
    slope, error = _straight_line(x, y)
    fits = [n for n, (power, limit) in expected.items() if abs(slope - power) <= max(2 * error, limit)]
    powers = ", ".join(f"{name}: {power:.3g}" for name, (power, _) in expected.items())
    measured = f"the slope {slope:.3g} ± {error:.2g}, where the classes have {powers}"
    if np.isnan(slope):
        reason = f"insufficient: {points} of one value determine no class"
        return HardnessClass(None, tuple(expected), False, reason, slope, error)
    best = min(fits or expected, key=lambda name: abs(slope - expected[name][0]))
    if error == np.inf:
        reason = f"insufficient: two {points} leave no error of the slope {slope:.3g}; give three or more"
    elif len(fits) == 1:
        reason = f"class {best} alone fits {measured}"
    else:
        reason = f"{'more than one class' if fits else 'none'} fits {measured}"
    return HardnessClass(best, tuple(fits) or (best,), bool(fits), reason, slope, error)


def _straight_line(x, y):
    """Return slope of y over x by least squares, NaN for one x, and standard error, infinite for two."""
    count = np.unique(x).size
    if count < 2:
        return np.nan, np.inf
    x, y = x - x.mean(), y - y.mean()
    slope = (x @ y) / (x @ x)
    residual = y - slope * x
    if count == 2:
        return float(slope), np.inf
    return float(slope), float(np.sqrt(residual @ residual / (x.size - 2) / (x @ x)))


@dataclass(frozen=True, eq=False, repr=False)
class FastLimit(Entries, Record):
    """Impact in the limit of a fully yielded contact, with its errors relative to the exact solution.

    Popov (2015), Eqs. (23), (24): the work is π q_c ∫ a dd, for a cone q_c d²/s, and the whole contact
    is damaged. The coefficient of restitution is √(U/W) with U = E* a d_c².

    It has the largest depth (m), the contact area (m²) and the coefficient of restitution in this limit,
    with their relative errors. The errors are large if the limit does not hold.
    """

    max_depth: Array
    contact_area: Array
    restitution: Array
    max_depth_error: Array
    contact_area_error: Array
    restitution_error: Array

    _quantities = _shown = (
        "max_depth", "contact_area", "restitution", "max_depth_error", "contact_area_error",
        "restitution_error",
    )  # fmt: skip
    _dimensions = ("impact",)


def depth_in_fast_limit(hit):
    """Return the depth (m) at which π q_c ∫ a dd is the energy of an `Impact`; ∞ below the known depth."""
    profile, energy = hit.profile, hit.mass * hit.speed**2 / 2
    target = np.broadcast_to(energy / (np.pi * hit.medium.q_c), np.shape(hit.max_depth))

    def work(depth):
        return integrals(profile).radius_integral(LiveInterval.elastic(depth)), profile.radius_at(depth)

    return increasing_root(work, target, hit.max_depth, profile.known_depth)


def fast_limit(hit):
    """Return the `FastLimit` of an `Impact`."""
    profile, medium = hit.profile, hit.medium
    if not hit.structure.rigid:
        raise check.MDRError(
            "the fast limit does not support impacts on a structure, which takes up a part of the energy; "
            "leave the structure out"
        )
    refuse_other_classes(medium, "the fast limit", "ScalingLaw has the powers of each class")
    d_c = np.asarray(medium.critical_depth)
    bound = "is infinite, so that nothing yields"
    check.raise_if("critical depth", d_c, np.isinf(d_c), bound, unit="m", advice="give the medium a q_c")
    depth = depth_in_fast_limit(hit)
    known = np.min(profile.known_depth, initial=check.LONGEST)
    bound = f"presses deeper than the known depth of the profile, {known:g} m, in this limit"
    speed = np.asarray(hit.speed)
    check.raise_if("speed", speed, np.isinf(depth), bound, unit="m/s", advice="reduce the speed")
    a = profile.radius_at(depth)
    area = np.pi * a**2
    energy = hit.mass * hit.speed**2 / 2
    restitution = np.sqrt(medium.E_star * a * d_c**2 / energy)
    # If adhesion holds the body, the restitution is 0.
    with np.errstate(divide="ignore"):
        return FastLimit(
            max_depth=check.frozen(depth),
            contact_area=check.frozen(area),
            restitution=check.frozen(restitution),
            max_depth_error=check.frozen(depth / hit.max_depth - 1),
            contact_area_error=check.frozen(area / (np.pi * hit.contact_radius**2) - 1),
            restitution_error=check.frozen(restitution / hit.restitution - 1),
        )
