"""What results share: the model that was solved and why that one, and the motion of a body in time."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._check import shown

if TYPE_CHECKING:
    from .indentation import Indentation


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


@dataclass(frozen=True, eq=False)
class Motion:
    """One impact from first contact to its loss, as arrays of one length, its turning point among them.

    On a virgin medium elements of the foundation under the contact radius are in contact. On
    unloading of a viscous one its edge is where g = d_p + ℓ, ahead of the depth d itself; elements
    outside have let go and relax. The energies sum to the same, at every instant.

    Attributes
    ----------
    time : ndarray
        Time (s) since first contact; of a chain that is not virgin, since the start.
    depth, velocity, force : ndarray
        Indentation depth d (m), its rate (m/s), force (N).
    contact_radius, plastic_radius : ndarray
        Radii a and c (m).
    plastic_depth, live_depth : ndarray
        Plastic depth d_p and length ℓ of the live interval [d_p, d_p + ℓ] (m): what the load has
        compressed the spring at the axis by.
    kinetic_energy, stored_energy, plastic_work, viscous_work : ndarray
        The ledger (J). Stored is the energy of all springs, of those too that have let go.
    states : Indentation or None
        The states of contact: load, pressure and surface at each instant; None for the chain, whose
        elements each have a state of their own.
    """

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    contact_radius: np.ndarray
    plastic_radius: np.ndarray
    plastic_depth: np.ndarray
    live_depth: np.ndarray
    kinetic_energy: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray
    states: "Indentation | None" = None

    @property
    def turning_point(self):
        """Number of the instant at which the body turns round."""
        return int(np.argmax(self.depth))


def instants(n, turn, end, begin=0.0):
    """n times (s) at equal steps from `begin` to `turn`, and about the same ones from there to `end`."""
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 2 <= n <= 10**7:
        raise ValueError(f"number of instants n = {shown(n)} must be a whole number from 2 to 10⁷")
    down = min(max(round((n - 1) * (turn - begin) / (end - begin)), 1), n - 2)
    if n == 2:
        return np.array([begin, end])
    return np.append(np.linspace(begin, turn, down + 1), np.linspace(turn, end, n - down)[1:])
