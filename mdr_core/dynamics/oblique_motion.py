"""The motion of one oblique impact over time: the normal one, and the row of friction beside it."""

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from .._check import Array
from ..results import Motion, MotionResult
from .friction import grip, slide
from .levels import levels

if TYPE_CHECKING:
    from .oblique import ObliqueImpact


@dataclass(frozen=True, eq=False, repr=False)
class ObliqueMotion(MotionResult):
    """One oblique impact from first contact to its loss, as arrays of one length.

    Within `slip_radius` and from `stick_radius` to the contact radius the surface slips, between them it
    sticks. The turning point is among the instants. The energies sum to the same at every instant.

    Attributes
    ----------
    time, depth, velocity, force, contact_radius, plastic_radius : ndarray
        As in `Motion`.
    tangential_velocity, tangential_force : ndarray
        Velocity W (m/s) of the contact point along the surface, and the force (N) against it.
    stick_radius, slip_radius : ndarray
        Outer and inner radius (m) of the region that sticks, to within an element; both 0 if all slips.
    kinetic_energy, stored_energy, plastic_work, viscous_work, friction_work : ndarray
        The ledger (J): ½mv² + ½m_t W², the energy of all springs, normal and tangential, and what is lost.
    x : ndarray, shape (N,)
        Places (m) of the elements along the foundation.
    tangential_line_load : ndarray, shape (n, N)
        Load q_x(x) (N/m) of every element along the surface at every instant.
    sticks : ndarray of bool, shape (n, N)
        Whether an element is in contact and sticks.
    normal : Motion
        The normal motion, with `normal.states`.
    impact : ObliqueImpact
        The impact whose motion it is.
    """

    time: Array
    depth: Array
    velocity: Array
    force: Array
    contact_radius: Array
    plastic_radius: Array
    tangential_velocity: Array
    tangential_force: Array
    stick_radius: Array
    slip_radius: Array
    kinetic_energy: Array
    stored_energy: Array
    plastic_work: Array
    viscous_work: Array
    friction_work: Array
    x: Array
    tangential_line_load: Array
    sticks: "np.ndarray[Any, np.dtype[np.bool_]]"
    normal: Motion
    impact: "ObliqueImpact"

    _quantities = (
        "time", "depth", "velocity", "force", "contact_radius", "plastic_radius", "tangential_velocity",
        "tangential_force", "stick_radius", "slip_radius", "kinetic_energy", "stored_energy",
        "plastic_work", "viscous_work", "friction_work",
    )  # fmt: skip
    _shown = ("time", "depth", "force", *_quantities[6:10], "friction_work")

    def __getitem__(self, index: Any) -> "ObliqueMotion":
        whole = {"x": self.x, "impact": self.impact}
        return ObliqueMotion(
            *(whole[f.name] if f.name in whole else getattr(self, f.name)[index] for f in fields(self))
        )


def oblique_motion(hit, n, halvings):
    """The `ObliqueMotion` of one `ObliqueImpact` at n instants, on levels halved so often."""
    parts = float(hit.tangential_speed), float(hit.friction), float(hit.tangential_mass)
    return along_surface(hit.normal, *parts, n, halvings, hit)


def along_surface(hit, speed, friction, mass, n, halvings, impact=None):
    """The `ObliqueMotion` under a normal `Impact`, of one run; its errors are known of an `impact` only."""
    normal = hit.motion(n)
    stiffness = 2 * float(hit.medium.tangential_ratio) * float(hit.medium.E_star)
    grid = levels(hit, stiffness / mass, halvings, normal.time)
    run = slide(hit, grid, stiffness / mass, grip(hit, speed, friction), normal.time)
    at, edges = run.instants, np.append(0.0, run.row.edge[: run.row.width.size])
    load, sticks = np.zeros((n, edges.size - 1)), np.zeros((n, edges.size - 1), bool)
    for k, i in enumerate(at):
        count = run.seen[i][0].size
        load[k, :count], sticks[k, :count] = run.seen[i]
    sticks &= run.row.width > 0
    stuck = sticks.any(axis=1)
    first, last = sticks.argmax(axis=1), sticks.shape[1] - sticks[:, ::-1].argmax(axis=1)
    velocity, energy = run.velocity[at] * speed, stiffness * speed**2
    return ObliqueMotion(
        *(getattr(normal, name) for name in ObliqueMotion._quantities[:6]),
        tangential_velocity=velocity,
        tangential_force=stiffness * speed * run.force[at],
        stick_radius=np.where(stuck, edges[last], 0.0),
        slip_radius=np.where(stuck, edges[first], 0.0),
        kinetic_energy=normal.kinetic_energy + mass * velocity**2 / 2,
        stored_energy=normal.stored_energy + energy * run.stored[at],
        plastic_work=normal.plastic_work,
        viscous_work=normal.viscous_work + energy * run.viscous[at],
        friction_work=energy * run.friction[at],
        x=(edges[1:] + edges[:-1]) / 2,
        tangential_line_load=stiffness / 2 * speed * load,
        sticks=sticks,
        normal=normal,
        impact=impact,
    )
