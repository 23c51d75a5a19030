"""The motion of one oblique impact over time: the normal motion, and one run along the surface."""

from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

import numpy as np

from .._check import Array
from ..impacts.impact import quantity_of
from ..results.base import Motion, MotionResult
from .depth_levels import levels
from .dry_friction import DryRun, first_counts
from .dry_levels import NormalMotions
from .viscous_friction import bound_ratio, slide


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


def oblique_motion(hit, normal, halvings):
    """The `ObliqueMotion` of one `ObliqueImpact` at the instants of its normal `Motion`.

    From a run with so many halvings.
    """
    surface = float(hit.tangential_speed), float(hit.friction), float(hit.tangential_mass)
    return along_surface(normal, *surface, halvings, hit)


def along_surface(normal, speed, friction, mass, halvings, impact=None):
    """The `ObliqueMotion` under a normal `Motion` from one run; errors are known of an `impact` only."""
    hit = normal.impact
    stiffness = 2 * float(hit.medium.tangential_ratio) * float(hit.medium.E_star)
    inertia, ratio = stiffness / mass, bound_ratio(hit, speed, friction)
    records = (_viscous_records if hit.medium.eta > 0 else _dry_records)(
        hit, normal, inertia, ratio, halvings
    )
    stuck, edges = records.sticks.any(axis=1), records.edges
    first = records.sticks.argmax(axis=1)
    last = records.sticks.shape[1] - records.sticks[:, ::-1].argmax(axis=1)
    velocity, energy = records.velocity * speed, stiffness * speed**2
    # Rounding errors would be left at loss of contact.
    most = friction * np.abs(normal.force)
    return ObliqueMotion(
        tangential_velocity=velocity,
        tangential_force=np.clip(stiffness * speed * records.force, -most, most),
        stick_radius=np.where(stuck, edges[last], 0.0),
        slip_radius=np.where(stuck, edges[first], 0.0),
        kinetic_energy=normal.kinetic_energy + mass * velocity**2 / 2,
        stored_energy=normal.stored_energy + energy * records.stored,
        viscous_work=normal.viscous_work + energy * records.viscous,
        friction_work=energy * records.friction,
        x=(edges[1:] + edges[:-1]) / 2,
        tangential_line_load=stiffness / 2 * speed * records.load,
        sticks=records.sticks,
        normal=normal,
        impact=impact,
    )


class _Records(NamedTuple):
    """A run along the surface at the instants of a motion, for an initial speed of 1.

    Velocity, force over 2κE* (m s), stored energy and works over 2κE* (m s²), edges of elements (m), their
    loads over κE* (s), and whether they stick.
    """

    velocity: np.ndarray
    force: np.ndarray
    stored: np.ndarray
    viscous: np.ndarray
    friction: np.ndarray
    edges: np.ndarray
    load: np.ndarray
    sticks: np.ndarray

    @classmethod
    def of(cls, *quantities, width, states):
        """From quantities, widths of elements, and loads and stick of the elements in contact."""
        load, sticks = np.zeros((len(states), width.size)), np.zeros((len(states), width.size), bool)
        for row, (loads, sticking) in enumerate(states):
            load[row, : loads.size], sticks[row, : loads.size] = loads, sticking
        return cls(*quantities, np.append(0.0, np.cumsum(width)), load, sticks & (width > 0))


def _viscous_records(hit, normal, inertia, ratio, halvings):
    run = slide(hit, levels(hit, inertia, halvings, normal.time), inertia, ratio, normal.time)
    quantities = run.velocities, run.forces, run.energies, run.viscous, run.friction
    states = [run.element_states[i] for i in run.instants]
    return _Records.of(*(x[run.instants] for x in quantities), width=run.elements.width, states=states)


def _dry_records(hit, normal, inertia, ratio, halvings):
    motions, inertia = NormalMotions.of(hit, np.array([0])), np.array([inertia])
    counts = first_counts(motions, inertia)[:, 0] * 2 ** int(halvings)
    # At higher speeds all elements slip as well, with the same loads, but these would be lost to rounding.
    start = 1 / np.maximum(ratio, 1 / (2 * (1 + inertia / motions.rate) * motions.speed))
    run = DryRun(motions, inertia, start, counts, normal.depth[:, None])
    at = [int(np.argmin(np.abs(run.time[:, 0] - time))) for time in normal.time]
    run.solve(recorded=at)
    states = [(ratio * load[:, 0], sticks[:, 0]) for load, sticks in map(run.element_states.get, at)]
    loss, width = ratio * (start - run.velocities[at, 0]), run.width[:, 0]
    stored = np.array([width[: load.size] @ load**2 / 2 for load, _ in states])
    friction = loss * (2 - loss) / (2 * inertia) - stored
    quantities = 1 - loss, ratio * run.forces[at, 0], stored, np.zeros(len(at)), friction
    return _Records.of(*quantities, width=width, states=states)
