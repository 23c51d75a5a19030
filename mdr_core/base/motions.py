"""Base classes of impacts, of motions, and the motion of one impact."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from . import lazy
from .check import Array, shown
from .errors import MDRError
from .results import Limit, Result


@dataclass(frozen=True)
class Hit:
    """One contact of an impact.

    Attributes
    ----------
    start, end : float
        Times (s) of first touch and of loss of contact, measured from the first touch of the impact.
    max_force : float
        Largest force (N).
    impulse : float
        Impulse (N·s).
    """

    start: float
    end: float
    max_force: float
    impulse: float


class ImpactResult(Result):
    """Base class of impacts along the normal, by `impact` and by `chain_impact`."""

    _quantities = (
        "mass", "speed", "restitution", "rebound_speed", "contact_time", "max_depth", "max_force",
        "contact_radius", "plastic_radius", "plastic_depth", "damaged_area", "stored_energy",
        "plastic_work", "viscous_work", "adhesive_work", "structure_work", "max_deflection",
    )  # fmt: skip
    _dimensions = ("impact",)

    medium: Any
    structure: Any
    mass: Array
    speed: Array
    max_force: Array
    restitution: Array
    contact_time: Array
    plastic_radius: Array

    @property
    def _shown(self):  # type: ignore[override]
        # Adhesion and dashpots exclude each other.
        adhesive = np.any(np.asarray(self.medium.work_of_adhesion) > 0)
        losses = ("adhesive_work",) if adhesive else ("viscous_work",)
        if not self.structure.rigid:
            viscous = np.any(np.asarray(self.medium.eta) > 0)
            losses = (*losses[: int(viscous)], "structure_work", "max_deflection")
        names = "speed", "restitution", "max_depth", "max_force", "contact_time"
        return *names, "stored_energy", "plastic_work", *losses

    @property
    def rebound_speed(self) -> Array:
        """Rebound speed e v₀ (m/s)."""
        return self.restitution * self.speed

    @property
    def captured(self) -> Any:
        """Whether the body does not rebound: adhesion holds it, or it never leaves a plate.

        The waves of a plate may take so much energy that the body's velocity goes to 0 with the force.
        Then e is 0, and the contact time is infinite.
        """
        return np.zeros(np.shape(self.speed), bool)[()]

    @property
    def max_deflection(self) -> Array:
        """Largest deflection (m) of the structure under the contact; 0 without a structure.

        On a plate it is m v₀ (1 + e)/Z, reached at the end of the contact; it remains. On a support it is
        F/K with the largest force F.
        """
        momentum = self.mass * self.speed * (1 + self.restitution)
        return momentum / self.structure.impedance + self.max_force / self.structure.stiffness

    @property
    def hits(self) -> Any:
        """Contacts: a tuple of `Hit` for one impact, an array of tuples for many.

        Without modes there is one `Hit`.
        """
        columns = self.contact_time, self.max_force, self.mass * self.speed * (1 + self.restitution)
        columns = np.broadcast_arrays(*columns)
        found = np.empty(columns[0].shape, object)
        for index in np.ndindex(*found.shape):
            found[index] = (Hit(0.0, *(float(column[index]) for column in columns)),)
        return found[()]

    @property
    def contacts(self) -> Any:
        """Number of contacts, 1 without modes.

        Contacts with less than 1 % of the momentum appear or vanish with the number of modes.
        """
        return np.ones(np.shape(self.speed), int)[()]

    @property
    def adhesive_work(self) -> Array:
        """Energy (J) lost to adhesion."""
        return np.zeros(np.shape(self.speed))[()]

    @property
    def damaged_area(self) -> Array:
        """Area π c² (m²) of the plastic zone; in the fast limit, the contact area π a²."""
        return np.pi * self.plastic_radius**2

    def speed_limit(self, density: float) -> Limit:
        """Return the speed over the wave speed √(E*/ρ) of a medium of density ρ (kg/m³), as a `Limit`."""
        return lazy.limits.speed_limit(self.speed, self.medium, density)


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
    """Motion of one impact from first contact to loss of contact, as arrays of equal length.

    If the body never leaves a plate, the motion ends when a thousandth of the largest live depth is left.

    The turning point is among the instants. On unloading from a viscous medium, g = d_p + ℓ at the edge of
    the contact, which is less than the depth d. Elements outside are released and relax. The sum of the
    energies is the same at every instant.

    Attributes
    ----------
    time : ndarray
        Time (s) since first contact; for a chain with a history, since the start.
    depth, velocity, force : ndarray
        Indentation depth d (m), its rate (m/s), force (N).
    contact_radius, plastic_radius : ndarray
        Radii a and c (m).
    plastic_depth, live_depth : ndarray
        Plastic depth d_p and length ℓ of the live interval [d_p, d_p + ℓ] (m); ℓ is the elastic
        compression of the spring at the axis under the load.
    kinetic_energy, stored_energy, plastic_work, viscous_work : ndarray
        Energies (J) of the body and of the medium. The stored energy includes released springs.
    deflection : ndarray
        Deflection w (m) of the structure under the contact; 0 without a structure.
    body_velocity : ndarray
        Velocity (m/s) of the body, the sum of the rates of depth and deflection.
    structure_work, support_energy : ndarray
        Energies (J) that waves of the structure have carried away, and that a support stores.
    states : Indentation or None
        States of the contact at each instant, with pressure and surface; None for the chain.
    impact : Impact, ChainImpact or None
        The impact.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium, impact
    >>> motion = impact(FlatPunch(radius=0.5), Medium(E_star=1.0), mass=1.0, speed=0.1).motion(5)
    >>> print(round(motion.time[motion.turning_index], 6))  # a quarter of a period: π/2
    1.570796
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
    deflection: Array
    body_velocity: Array
    structure_work: Array
    support_energy: Array
    states: Any = None
    impact: Any = None

    _quantities = (
        "time", "depth", "velocity", "force", "contact_radius", "plastic_radius", "plastic_depth",
        "live_depth", "kinetic_energy", "stored_energy", "plastic_work", "viscous_work", "deflection",
        "body_velocity", "structure_work", "support_energy",
    )  # fmt: skip
    _shown = ("time", "depth", "velocity", "force", "contact_radius", "plastic_radius")

    def __getitem__(self, index: Any) -> "Motion":
        values = {name: getattr(self, name)[index] for name in self._quantities}
        return replace(self, **values, states=self.states and self.states[index])


def instants(n, turn, end, start=0.0):
    """Return n times (s), equally spaced from `start` to `turn`, the turning point, and then to `end`.

    At least a fifth of them are up to the turning point, because a body may take long to leave a plate.
    """
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 2 <= n <= 10**7:
        raise MDRError(f"number of instants n = {shown(n)} must be a whole number from 2 to 10⁷")
    if n == 2:
        return np.array([start, end])
    count = min(max(round((n - 1) * (turn - start) / (end - start)), n // 5, 1), n - 2)
    return np.append(np.linspace(start, turn, count + 1), np.linspace(turn, end, n - count)[1:])
