"""Base classes of results along a path, of impacts and of motions; the names of the models."""

from dataclasses import dataclass, fields, replace
from typing import Any, Self

import numpy as np

from .._check import Array, shown
from .limits import Limit, speed_limit
from .report import Report


class Model(str):
    """Name of a model, with the reason for choosing it in `reason`.

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
    "without viscosity, or infinitely slowly, the plastic depth is the only memory of the medium, and "
    "every result is an integral over the live interval",
)
SCALAR_ODE = Model(
    "scalar ODE",
    "a single viscous impact obeys one scalar equation of motion, because elements are released from the "
    "outside inward and do not come into contact again",
)
CREEP_LAW = Model(
    "scalar ODE",
    "while an indenter goes deeper, and while it recedes afterwards, its depth under a force obeys one "
    "scalar equation, because no element that was released comes into contact again",
)
CHAIN = Model(
    "chain",
    "on a viscous path released elements may come into contact again while they relax, so that each "
    "element has a memory of its own",
)


class Entries:
    """Base class of dataclasses whose fields all have one entry, or one row, for each impact."""

    def __getitem__(self, index: Any) -> Self:
        return type(self)(**{field.name: getattr(self, field.name)[index] for field in fields(self)})


class Result(Report):
    """Base class of results of one profile on one medium, along a path, over time or of impacts."""

    def plot(self, quantity: str = "force", over: str = "depth") -> Any:
        """One quantity over another as HoloViews elements, by default the force–depth curve.

        A path is shown in parts: loaded elastically, yielding, unloaded. Axes have names and units. Areas
        of a force–depth curve are the plastic work of the path and what its last state stores.

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
        from .elements import plot_curve

        return plot_curve(self, quantity, over)

    def _source(self):
        return self

    def _limits(self):
        return self.limits


class ImpactResult(Result):
    """Base class of impacts along the normal, by `impact` and by `chain_impact`."""

    _quantities = (
        "mass", "speed", "restitution", "rebound_speed", "contact_time", "max_depth", "max_force",
        "contact_radius", "plastic_radius", "plastic_depth", "damaged_area", "stored_energy",
        "plastic_work", "viscous_work", "adhesive_work",
    )  # fmt: skip
    _dimensions = ("impact",)

    medium: Any
    speed: Any
    restitution: Any
    contact_time: Any
    plastic_radius: Any

    @property
    def _shown(self):  # type: ignore[override]
        # Adhesion and dashpots exclude each other.
        adhesive = np.any(np.asarray(self.medium.work_of_adhesion) > 0)
        loss = "adhesive_work" if adhesive else "viscous_work"
        names = "speed", "restitution", "max_depth", "max_force", "contact_time"
        return *names, "stored_energy", "plastic_work", loss

    @property
    def rebound_speed(self) -> Array:
        """Rebound speed e v₀ (m/s)."""
        return self.restitution * self.speed

    @property
    def captured(self) -> Any:
        """Whether adhesion holds the body, so that it does not rebound."""
        return np.zeros(np.shape(self.speed), bool)[()]

    @property
    def adhesive_work(self) -> Array:
        """Energy (J) that adhesion takes."""
        return np.zeros(np.shape(self.speed))[()]

    @property
    def damaged_area(self) -> Array:
        """Area π c² (m²) of the plastic zone; in the fast limit that of the contact, π a²."""
        return np.pi * self.plastic_radius**2

    def speed_limit(self, density: float) -> Limit:
        """The speed over the wave speed √(E*/ρ) of a medium of density ρ (kg/m³), as a `Limit`."""
        return speed_limit(self.speed, self.medium, density)


class MotionResult(Result):
    """Base class of motions of one impact, normal or oblique."""

    _dimensions = ("time",)

    depth: Array
    impact: Any

    def _source(self):
        return self if self.impact is None else self.impact

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model for the impact."""
        return () if self.impact is None else self.impact.limits

    @property
    def turning_index(self) -> int:
        """Index of the turning point, the instant of largest depth."""
        return int(np.argmax(self.depth))


@dataclass(frozen=True, eq=False, repr=False)
class Motion(MotionResult):
    """Motion of one impact from first contact to loss of contact, as arrays of one length.

    The turning point is among the instants. On unloading from a viscous medium the edge of the contact is
    where g = d_p + ℓ, which is less than the depth d; elements outside are released and relax. The sum of
    the energies is the same at every instant.

    Attributes
    ----------
    time : ndarray
        Time (s) since first contact; since the start for a chain that has a history.
    depth, velocity, force : ndarray
        Indentation depth d (m), its rate (m/s), force (N).
    contact_radius, plastic_radius : ndarray
        Radii a and c (m).
    plastic_depth, live_depth : ndarray
        Plastic depth d_p and length ℓ of the live interval [d_p, d_p + ℓ] (m); ℓ is the elastic
        compression of the spring at the axis under the load.
    kinetic_energy, stored_energy, plastic_work, viscous_work : ndarray
        Energies (J). The stored energy is that of all springs, released ones included.
    states : Indentation or None
        States of the contact at each instant, with pressure and surface; None for the chain.
    impact : Impact, ChainImpact or None
        The impact.
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
    states: Any = None
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
    """n times (s): equally spaced from `start` to the turning point at `turn`, and from there to `end`."""
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 2 <= n <= 10**7:
        raise ValueError(f"number of instants n = {shown(n)} must be a whole number from 2 to 10⁷")
    if n == 2:
        return np.array([start, end])
    count = min(max(round((n - 1) * (turn - start) / (end - start)), 1), n - 2)
    return np.append(np.linspace(start, turn, count + 1), np.linspace(turn, end, n - count)[1:])
