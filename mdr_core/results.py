"""Base classes of results: the model that was solved, the limits of its validity, the motion in time."""

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from . import _check
from ._check import Array, shown
from .report import Report, engineering
from .shapes.power import Cone

if TYPE_CHECKING:
    from .indentation import Indentation
    from .medium import Medium

#: Slopes up to which they count as small, beyond which results are estimates, and beyond which they hardly
#: are what was meant; contact radius over that of the body, and share of the wave speed that is slow.
_SMALL, _STEEP, _NEEDLE, _BODY, _SLOW = 0.3, 0.5, 3.0, 0.5, 0.1


class Model(str):
    """Name of a model, and in `reason` what makes it the one for a result.

    Examples
    --------
    >>> CLOSED_FORM == "closed form"
    True
    """

    __slots__ = ("reason",)

    def __new__(cls, name, reason):
        model = super().__new__(cls, name)
        model.reason = reason
        return model

    def __getnewargs__(self):
        return str(self), self.reason


CLOSED_FORM = Model(
    "closed form",
    "without viscosity, or infinitely slowly, all that the past leaves behind is the plastic depth, and "
    "every result is an integral over the live interval",
)
SCALAR_ODE = Model(
    "scalar ODE",
    "a viscous body that comes in at one go obeys one equation of motion, because elements let go from "
    "outside inward and are not met again",
)
CHAIN = Model(
    "chain",
    "on a viscous path elements that have let go may be met again while they relax, so that every one "
    "has a memory of its own",
)


@dataclass(frozen=True)
class Limit:
    """An assumption of the model, and how far a result goes towards its end; an entry of `result.limits`.

    Attributes
    ----------
    what : str
        What is bounded: "slope", "contact radius", "Poisson ratio", "viscosity", "speed", "fast limit",
        and of friction "coupling", "slip direction".
    value, bound : float
        Its worst value over all states, and the one up to which the assumption usually is good.
    exceeded : bool
        Whether the value is beyond the bound.
    sentence : str
        The same in words, with what to do.
    concerns : str
        "result", or the formula of the paper that it is about while the result itself is exact.
    severe : bool
        Whether what is exceeded leaves of the result an estimate, and not most of its digits.
    """

    what: str
    value: float
    bound: float
    exceeded: bool
    sentence: str
    concerns: str = "result"
    severe: bool = True

    @property
    def holds(self) -> bool:
        """Whether the value is within the bound."""
        return not self.exceeded

    @property
    def level(self) -> str:
        """In a word: "good", "note" where the result is hardly touched, else "beyond"."""
        if self.holds:
            return "good"
        return "beyond" if self.severe and self.concerns == "result" else "note"


def contact_limits(profile, medium, radius, *, slow=False):
    """Limits of a contact that has reached some radii (m); `slow` its dashpots have carried nothing."""
    found = [_slope_limit(profile, radius), *_body_limit(profile, radius)]
    if np.any(np.asarray(medium.eta) > 0):
        found.append(_viscosity_limit(medium) if slow else _poisson_limit(medium))
    return tuple(found)


def _slope_limit(profile, radius):
    """The largest slope of the indenter within the contact: at its edge, or on the way there."""
    a = np.asarray(radius) if profile.shape else np.max(radius, initial=0.0)
    with np.errstate(all="ignore"):
        top = profile._height(a)
        edge = (top - profile._height(a * (1 - 1e-6))) / (1e-6 * a)
        slope = np.where(a > 0, np.fmax(edge, top / a), 0.0)
    # A difference has nine digits.
    value = float(f"{np.max(slope, initial=0.0):.9g}")
    text = f"Slopes reach {value:.3g} within the contact"
    if value > _NEEDLE and isinstance(profile, Cone):
        text += (
            ": a needle, far from a half-space. A slope is the tangent of the angle to the surface; for a "
            "cone by its half-angle in degrees take Cone.from_half_angle(degrees)."
        )
    elif value > _SMALL:
        text += f": small slopes are an approximation, good to about s² = {100 * value**2:.2g} %."
    else:
        text += ", which is small."
    return Limit("slope", value, _SMALL, value > _SMALL, text, severe=value > _STEEP)


def _body_limit(profile, radius):
    """Contact radius over the radius of the body that the tip belongs to, if it has one."""
    if np.all(profile.body_radius == np.inf):
        return
    value = float(np.max(radius / profile.body_radius, initial=0.0))
    text = f"The contact radius reaches {value:.3g} R"
    far = (
        f": it is of the order of the radius, the equator is at R; up to {_BODY:g} R a half-space is near."
    )
    yield Limit("contact radius", value, _BODY, value > _BODY, text + (far if value > _BODY else "."))


def _poisson_limit(medium):
    value = float(np.min(medium.poisson))
    text = f"Dashpots beside springs are exact for ν = ½ only, and ν = {value:.3g}"
    text += ": take viscous results as an estimate." if value < 0.5 else "."
    return Limit("Poisson ratio", value, 0.5, value < 0.5, text)


def _viscosity_limit(medium):
    value = float(np.max(medium.relaxation_time))
    text = (
        "Without times the path is followed infinitely slowly: the viscosity carries nothing; τ = "
        f"{engineering(value, 's')}. With times (indent_in_time, creep) it is felt."
    )
    return Limit("viscosity", value, 0.0, True, text, severe=False)


def friction_limits(medium):
    """What is assumed of friction; ν/(4 − 2ν) is the ratio of slip across the speed to slip along it."""
    nu = float(np.min(medium.poisson))
    value = (1 - 2 * nu) / (2 - 2 * nu)
    text = "Normal and tangential displacements are taken as uncoupled, which is exact for ν = ½"
    text += f", and ν = {nu:.3g}." if value > 0 else "."
    yield Limit("coupling", value, 0.0, value > 0, text, severe=False)
    value = float(np.max(np.abs(medium.poisson / (4 - 2 * medium.poisson))))
    text = f"Slip is along the speed, stick a disc or ring: up to {value:.2g} of the slip goes across."
    yield Limit("slip direction", value, 0.2, value > 0.2, text, severe=False)


class Entries:
    """Base class of dataclasses whose fields all have one entry, or one row, for each impact."""

    def __getitem__(self, index: Any) -> Self:
        return type(self)(**{field.name: getattr(self, field.name)[index] for field in fields(self)})


class Result(Report):
    """Base class of results along a path, over time, or of several impacts."""

    def plot(self, quantity: str = "force", over: str = "depth") -> Any:
        """One quantity over another as HoloViews elements, by default the force–depth curve.

        A path is shown in parts: loaded elastically, yielding, unloaded. Axes have names and units.

        Parameters
        ----------
        quantity, over : str
            Names of two quantities of this result, as in `to_dict()`.

        Raises
        ------
        ValueError
            If a name is unknown, or the result has other than one dimension.
        """
        # Plots stand above results, and HoloViews is needed for them only.
        from .figures import plot_curve

        return plot_curve(self, quantity, over)


class ImpactResult(Result):
    """Base class of impacts along the normal."""

    _quantities = (
        "mass", "speed", "restitution", "rebound_speed", "contact_time", "max_depth", "max_force",
        "contact_radius", "plastic_radius", "plastic_depth", "damaged_area", "stored_energy",
        "plastic_work", "viscous_work",
    )  # fmt: skip
    _shown = (
        "speed", "restitution", "max_depth", "max_force", "contact_time", "stored_energy", "plastic_work",
        "viscous_work",
    )  # fmt: skip
    _dimensions = ("impact",)

    medium: "Medium"
    speed: Any
    restitution: Any
    plastic_radius: Any

    @property
    def rebound_speed(self) -> Array:
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @property
    def damaged_area(self) -> Array:
        """Area π c² (m²) of the plastic zone; in the fast limit that of the contact, π a²."""
        return np.pi * self.plastic_radius**2

    def speed_limit(self, density: float) -> Limit:
        """The speed over the wave speed √(E*/ρ) of a medium of some density ρ (kg/m³)."""
        density = _check.positive("density", density, unit="kg/m³")
        value = float(np.max(self.speed / np.sqrt(self.medium.E_star / density)))
        text = f"The speed is {value:.3g} of the wave speed √(E*/ρ)"
        text += ": waves carry energy away." if value > _SLOW else ": quasi-static."
        return Limit("speed", value, _SLOW, value > _SLOW, text)


class MotionResult(Result):
    """Base class of motions of one impact, normal or oblique."""

    _dimensions = ("time",)

    depth: Array
    impact: Any

    def _source(self):
        return self if self.impact is None else self.impact

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model's validity, as those of the impact."""
        return () if self.impact is None else self.impact.limits

    @property
    def turning_index(self) -> int:
        """Index of the instant of the turning point."""
        return int(np.argmax(self.depth))


@dataclass(frozen=True, eq=False, repr=False)
class Motion(MotionResult):
    """One impact from first contact to the loss of contact, as arrays of one length.

    The turning point is one of the instants. On a virgin medium elements of the foundation within the
    contact radius are in contact. While a viscous medium is unloaded, the edge of the contact is where
    g = d_p + ℓ, below the depth d; elements outside are released and relax. The sum of all energies is
    constant.

    Attributes
    ----------
    time : ndarray
        Time (s) since first contact; for a chain that is not virgin, since the start.
    depth, velocity, force : ndarray
        Indentation depth d (m), its rate (m/s), force (N).
    contact_radius, plastic_radius : ndarray
        Radii a and c (m).
    plastic_depth, live_depth : ndarray
        Plastic depth d_p and length ℓ of the live interval [d_p, d_p + ℓ] (m): the compression under
        load of the spring at the axis.
    kinetic_energy, stored_energy, plastic_work, viscous_work : ndarray
        The ledger (J). The stored energy is that of all springs, also of released elements.
    states : Indentation or None
        The states of contact: load, pressure and surface at each instant; None for the chain, where
        every element has a state of its own.
    impact : Impact, ChainImpact or None
        The impact whose motion it is.
    """

    time: Array
    depth: Array
    velocity: Array
    force: Array
    contact_radius: Array
    plastic_radius: Array
    plastic_depth: Array
    live_depth: Array
    kinetic_energy: Array
    stored_energy: Array
    plastic_work: Array
    viscous_work: Array
    states: "Indentation | None" = None
    impact: Any = None

    _quantities = (
        "time", "depth", "velocity", "force", "contact_radius", "plastic_radius", "plastic_depth",
        "live_depth", "kinetic_energy", "stored_energy", "plastic_work", "viscous_work",
    )  # fmt: skip
    _shown = ("time", "depth", "velocity", "force", "contact_radius", "plastic_radius")

    def __getitem__(self, index: Any) -> "Motion":
        values = {name: getattr(self, name)[index] for name in self._quantities}
        return replace(self, **values, states=self.states and self.states[index])


def instants(n, turn, end, start=0.0):
    """n times (s): equally spaced from `start` to `turn`, and again from there to `end`."""
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 2 <= n <= 10**7:
        raise ValueError(f"number of instants n = {shown(n)} must be a whole number from 2 to 10⁷")
    if n == 2:
        return np.array([start, end])
    count = min(max(round((n - 1) * (turn - start) / (end - start)), 1), n - 2)
    return np.append(np.linspace(start, turn, count + 1), np.linspace(turn, end, n - count)[1:])
