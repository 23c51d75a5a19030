"""The motion of one oblique impact over time: the normal motion, and one run along the surface."""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ...base.check import Array
from ...base.motions import Motion, MotionResult
from .dry_friction import DryRun, first_counts
from .dry_levels import NormalMotions
from .tangential_motion import slip_throughout
from .viscous_friction import bound_ratio, levels, slide


@dataclass(frozen=True, eq=False, repr=False)
class ObliqueMotion(MotionResult):
    """One oblique impact from first contact to the loss of contact, as arrays of one length.

    The surface sticks between `slip_radius` and `stick_radius`, and slips in the remaining contact.
    The turning point is one of the instants. The sum of all energies is constant.

    Attributes
    ----------
    time, depth, velocity, force, contact_radius, plastic_radius, plastic_work : ndarray
        As in the normal `Motion`.
    tangential_velocity, tangential_force : ndarray
        Velocity v_t (m/s) of the point of contact along the surface, and the force (N) against it.
    stick_radius, slip_radius : ndarray
        Outer and inner radius (m) of the sticking region, to within an element; both 0 if all slips.
    kinetic_energy, stored_energy, viscous_work, friction_work : ndarray
        Energy balance (J): ½mv² + ½m_t v_t², the energy of all springs, normal and tangential, and losses.
    x : ndarray, shape (N,)
        Coordinates (m) of the elements of the foundation.
    tangential_line_load : ndarray, shape (n, N)
        Load q_x(x) (N/m) of every element along the surface at every instant.
    sticks : ndarray of bool, shape (n, N)
        Whether an element is in contact and sticks.
    normal, impact
        The normal `Motion`, with `normal.states`, and the `ObliqueImpact`.
    """

    time: Array
    depth: Array
    velocity: Array
    force: Array
    contact_radius: Array
    plastic_radius: Array
    plastic_work: Array
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
        names = *self._quantities, "tangential_line_load", "sticks", "normal"
        return replace(self, **{name: getattr(self, name)[index] for name in names})


def oblique_motion(hit, normal, halvings):
    """Return the `ObliqueMotion` of one `ObliqueImpact` at the instants of its normal `Motion`.

    It comes from a run with the number `halvings` of halved steps.
    """
    surface = float(hit.tangential_speed), float(hit.friction), float(hit.tangential_mass)
    return along_surface(normal, *surface, halvings, hit)


def along_surface(normal, speed, friction, mass, halvings, impact=None):
    """Return the `ObliqueMotion` under a normal `Motion` from one run; only an `impact` has errors."""
    hit = normal.impact
    same = "time", "depth", "velocity", "force", "contact_radius", "plastic_radius", "plastic_work"
    stiffness = 2 * float(hit.medium.tangential_ratio) * float(hit.medium.E_star)
    inertia, ratio = stiffness / mass, bound_ratio(hit, speed, friction)
    solve = _viscous_run if hit.medium.eta > 0 else _dry_run
    run, width, states = solve(hit, normal, inertia, ratio, halvings)
    edges, load = np.append(0.0, np.cumsum(width)), np.zeros((len(states), width.size))
    sticks = np.zeros(load.shape, bool)
    for row, (loads, sticking) in enumerate(states):
        load[row, : loads.size], sticks[row, : loads.size] = loads, sticking
    # If nothing sticks, the load of an element differs from its bound by rounding.
    given = (np.array([value]) for value in (abs(speed), friction, mass))
    sticks &= (width > 0) & ~slip_throughout(hit, *given)["slips_throughout"]
    stuck, first = sticks.any(axis=1), sticks.argmax(axis=1)
    last = width.size - sticks[:, ::-1].argmax(axis=1)
    velocity, energy = run.velocity * speed, stiffness * speed**2
    # Otherwise rounding errors would remain at loss of contact.
    most = friction * np.abs(normal.force)
    return ObliqueMotion(
        **{name: getattr(normal, name) for name in same},
        tangential_velocity=velocity,
        tangential_force=np.clip(stiffness * speed * run.force, -most, most),
        stick_radius=np.where(stuck, edges[last], 0.0),
        slip_radius=np.where(stuck, edges[first], 0.0),
        kinetic_energy=normal.kinetic_energy + mass * velocity**2 / 2,
        stored_energy=normal.stored_energy + energy * run.stored,
        viscous_work=normal.viscous_work + energy * run.viscous,
        friction_work=energy * run.friction,
        x=(edges[1:] + edges[:-1]) / 2,
        tangential_line_load=stiffness / 2 * speed * load,
        sticks=sticks,
        normal=normal,
        impact=impact,
    )


class _Run(NamedTuple):
    """A run along the surface at the instants of a motion, for an initial speed of 1.

    The force over 2κE* is in m s, stored energy and works over 2κE* in m s².
    """

    velocity: np.ndarray
    force: np.ndarray
    stored: np.ndarray
    viscous: np.ndarray
    friction: np.ndarray


def _viscous_run(hit, normal, inertia, ratio, halvings):
    """Return the `_Run`, widths of elements (m), and at each instant loads over κE* (s) and stick flags."""
    run = slide(hit, levels(hit, inertia, halvings, normal.time), inertia, ratio, normal.time)
    quantities = run.velocities, run.forces, run.energies, run.viscous, run.friction
    states = [run.element_states[i] for i in run.instants]
    return _Run(*(x[run.instants] for x in quantities)), run.elements.width, states


def _dry_run(hit, normal, inertia, ratio, halvings):
    """Return the same as `_viscous_run`, without viscosity."""
    motions, inertia = NormalMotions.of(hit, np.array([0])), np.array([inertia])
    counts = first_counts(motions, inertia)[:, 0] * 2 ** int(halvings)
    # At higher speeds all elements also slip, with the same loads, but the loads would be lost to rounding.
    start = 1 / np.maximum(ratio, 1 / (2 * (1 + inertia / motions.rate) * motions.speed))
    run = DryRun(motions, inertia, start, counts, normal.depth)
    time, width = run.levels.time[::2, 0], run.width[:, 0]
    at = [int(np.argmin(np.abs(time - instant))) for instant in normal.time]
    run.solve(recorded=at)
    states, forces, stored = [], [], []
    for i, normal_force in zip(at, normal.force / (2 * hit.medium.E_star), strict=True):
        load, bound = (values[:, 0] for values in run.element_states[i])
        covered = width[: load.size]
        states.append((ratio * load, np.abs(load) < bound * (1 - 1e-9)))
        # The sum of all bounds is the normal force, which is known.
        forces.append(ratio * covered @ load / max(covered @ bound, 1e-300) * normal_force)
        stored.append(ratio**2 * covered @ load**2 / 2)
    loss = ratio * (start - run.velocities[at, 0])
    friction = loss * (2 - loss) / (2 * inertia) - stored
    return _Run(1 - loss, np.array(forces), np.array(stored), 0 * loss, friction), width, states
