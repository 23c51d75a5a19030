"""The motion of one oblique impact over time: the normal motion, and one run along the surface."""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from .._check import Array
from ..results.base import Motion, MotionResult
from .friction import bound_ratio, slide
from .impact import quantity_of
from .levels import levels


@dataclass(frozen=True, eq=False, repr=False)
class ObliqueMotion(MotionResult):
    """One oblique impact from first contact to the loss of contact, as arrays of one length.

    The surface sticks between `slip_radius` and `stick_radius`, and slips in the remaining contact.
    The turning point is one of the instants. The sum of all energies is constant.

    Attributes
    ----------
    tangential_velocity, tangential_force : ndarray
        Velocity W (m/s) of the contact point along the surface, and the force (N) against it.
    stick_radius, slip_radius : ndarray
        Outer and inner radius (m) of the region that sticks, to within an element; both 0 if all slips.
    kinetic_energy, stored_energy, viscous_work, friction_work : ndarray
        The ledger (J): ½mv² + ½m_t W², the energy of all springs, normal and tangential, and losses.
    x : ndarray, shape (N,)
        Coordinates (m) of the elements of the foundation.
    tangential_line_load : ndarray, shape (n, N)
        Load q_x(x) (N/m) of every element along the surface at every instant.
    sticks : ndarray of bool, shape (n, N)
        Whether an element is in contact and sticks.
    normal, impact
        The normal `Motion`, with `normal.states`, and the `ObliqueImpact`.
    """

    tangential_velocity: Array
    tangential_force: Array
    stick_radius: Array
    slip_radius: Array
    kinetic_energy: Array
    stored_energy: Array
    viscous_work: Array
    friction_work: Array
    x: Array
    tangential_line_load: Array
    sticks: "np.ndarray[Any, np.dtype[np.bool_]]"
    normal: Motion
    impact: Any

    time = quantity_of("normal.time", "Time (s) since first contact.")
    depth = quantity_of("normal.depth", "Indentation depth (m).")
    velocity = quantity_of("normal.velocity", "Rate (m/s) of the depth.")
    force = quantity_of("normal.force", "Normal force (N).")
    contact_radius = quantity_of("normal.contact_radius", "Contact radius (m).")
    plastic_radius = quantity_of("normal.plastic_radius", "Radius (m) of the plastic zone.")
    plastic_work = quantity_of("normal.plastic_work", "Energy (J) dissipated by yielding.")
    _quantities = (
        "time", "depth", "velocity", "force", "contact_radius", "plastic_radius", "tangential_velocity",
        "tangential_force", "stick_radius", "slip_radius", "kinetic_energy", "stored_energy",
        "plastic_work", "viscous_work", "friction_work",
    )  # fmt: skip
    _shown = (
        "time", "depth", "force", "tangential_velocity", "tangential_force", "stick_radius", "slip_radius",
        "friction_work",
    )  # fmt: skip

    def __getitem__(self, index: Any) -> "ObliqueMotion":
        names = set(self._quantities) & {field.name for field in fields(self)}
        instants = {name: getattr(self, name)[index] for name in names}
        load, sticks, normal = self.tangential_line_load[index], self.sticks[index], self.normal[index]
        return replace(self, **instants, tangential_line_load=load, sticks=sticks, normal=normal)


def oblique_motion(hit, n, halvings):
    """The `ObliqueMotion` of one `ObliqueImpact` at n instants, from a run with so many halvings."""
    surface = float(hit.tangential_speed), float(hit.friction), float(hit.tangential_mass)
    return along_surface(hit.normal, *surface, n, halvings, hit)


def along_surface(hit, speed, friction, mass, n, halvings, impact=None):
    """The `ObliqueMotion` under a normal `Impact` from one run; errors are known of an `impact` only."""
    normal, stiffness = hit.motion(n), 2 * float(hit.medium.tangential_ratio) * float(hit.medium.E_star)
    grid = levels(hit, stiffness / mass, halvings, normal.time)
    run = slide(hit, grid, stiffness / mass, bound_ratio(hit, speed, friction), normal.time)
    at, edges = run.instants, np.append(0.0, run.elements.edge[: run.elements.width.size])
    load, sticks = np.zeros((n, edges.size - 1)), np.zeros((n, edges.size - 1), bool)
    for k, i in enumerate(at):
        count = run.element_states[i][0].size
        load[k, :count], sticks[k, :count] = run.element_states[i]
    sticks &= run.elements.width > 0
    stuck = sticks.any(axis=1)
    first, last = sticks.argmax(axis=1), sticks.shape[1] - sticks[:, ::-1].argmax(axis=1)
    velocity, energy = run.velocities[at] * speed, stiffness * speed**2
    return ObliqueMotion(
        tangential_velocity=velocity,
        tangential_force=stiffness * speed * run.forces[at],
        stick_radius=np.where(stuck, edges[last], 0.0),
        slip_radius=np.where(stuck, edges[first], 0.0),
        kinetic_energy=normal.kinetic_energy + mass * velocity**2 / 2,
        stored_energy=normal.stored_energy + energy * run.energies[at],
        viscous_work=normal.viscous_work + energy * run.viscous[at],
        friction_work=energy * run.friction[at],
        x=(edges[1:] + edges[:-1]) / 2,
        tangential_line_load=stiffness / 2 * speed * load,
        sticks=sticks,
        normal=normal,
        impact=impact,
    )
