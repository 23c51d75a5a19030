"""Courses of scenes: their states along a path, and results that depend on the drive."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

import mdr_core as mdr
from mdr_core.solver.contact.yielding import yield_rule
from mdr_core.solver.impacts.motion import released_compression

#: Progress at the end of slow unloading, with the indenter at the height of the undeformed surface.
LAST_PROGRESS = 2.2


def onset_depth(scene: mdr.Scene, imprint: float = 0.0) -> float:
    """Return the depth (m) at which yield begins over an imprint (plastic depth, m), or infinity."""
    return float(yield_rule(scene.profile, scene.medium).onset(imprint))


#: Terms of the balance of energy.
_ENERGIES = (
    "stored_energy", "plastic_work", "viscous_work", "kinetic_energy", "friction_work", "structure_work",
    "support_energy",
)  # fmt: skip


@dataclass(frozen=True)
class Caution:
    """Limit that is exceeded so far that some readouts are no results."""

    #: The limits (`Limit.what`) that it replaces, itself first.
    limits: tuple[str, ...]
    #: Advice with its reason.
    sentence: str
    readouts: tuple[str, ...]
    #: Choice and option that follow the advice, if they exist.
    choice: str = ""
    option: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """States of a scene along its path; every array has one value (SI) for each state.

    `states` are an `mdr.Indentation`, or the `PathStates` of a path in time, without a few of its
    quantities, such as the stiffness; `states[i]` is one state. `progress` is 0 at first contact, 1 at the
    largest depth, 2 at loss of contact and `LAST_PROGRESS` with the indenter at the undeformed surface.
    `motion` has times and energies of a path in time, and `hit` is the impact; otherwise they are None.
    `turns` is whether the path may reverse several times, `chained` whether elements have separate
    memories, which one live interval does not describe. `pending` describes the approximation before the
    exact solution, and `notes` are other sentences about the course. `drives.follow` sets the index `now`
    of the present state and the key `drive`.
    """

    scene: mdr.Scene
    progress: Any
    states: Any
    motion: Any = None
    hit: mdr.Impact | None = None
    turns: bool = False
    chained: bool = False
    pending: str = ""
    notes: tuple[str, ...] = ()
    now: int = 0
    drive: str = ""

    #: Further terms of the law of the springs, after elasticity, dashpots and yield.
    more_law: ClassVar[str] = ""

    def __len__(self) -> int:
        return len(self.progress)

    @property
    def state(self) -> Any:
        return self.states[self.now]

    @cached_property
    def peak(self) -> int:
        """Index of the largest depth."""
        return int(np.argmax(self.states.depth))

    @cached_property
    def turning_point(self) -> Any:
        return self.states[self.peak]

    @property
    def times(self) -> Any:
        """Time of each state in the player, from 0 to 1."""
        time = np.arange(len(self)) if self.motion is None else self.motion.time
        return (time - time[0]) / np.ptp(time)

    @property
    def limits(self) -> list[Any]:
        """Assumptions of the model."""
        return list(self.states.limits if self.hit is None else self.hit.limits)

    @property
    def cautions(self) -> tuple[Caution, ...]:
        """Limits that are exceeded so far that some readouts are no results."""
        return ()

    @cached_property
    def doubtful(self) -> dict[str, str]:
        """Names of the readouts that are no results, each with its advice."""
        return {name: each.sentence for each in self.cautions for name in each.readouts}

    @property
    def asides(self) -> dict[str, str]:
        """Remarks in the cells of readouts, by the names of the readouts."""
        return {}

    @property
    def initial_plastic_depth(self) -> float:
        """Plastic depth (m) of an earlier imprint."""
        return getattr(self.scene.drive, "plastic_depth", 0.0)

    @property
    def structure(self) -> mdr.Structure | None:
        """Structure behind the medium; None for a body at rest."""
        return getattr(self.scene.drive, "structure", None)

    @property
    def adhesive(self) -> bool:
        return self.scene.medium.work_of_adhesion > 0

    @property
    def dashpots(self) -> bool:
        """Whether dashpots carry load along this path."""
        return self.motion is not None and self.scene.medium.eta > 0

    @property
    def in_place(self) -> dict[str, str]:
        """Readouts above the plots that replace others, by the names of the others."""
        # The damaged area follows from c.
        return {"damaged_area": "viscous_work"} if self.dashpots else {}

    @property
    def ledger(self) -> Any:
        """Object with the energies (J) of all states, without the plastic work of earlier impacts."""
        return self.states if self.motion is None else self.motion

    def relaxing(self, i: int, g: Any) -> Any:
        """Return the remaining elastic compression (m) of released elements at heights g (m) in state i."""
        # A path in time releases no elements.
        if self.hit is None or not self.dashpots:
            return 0.0
        return released_compression(self.states, self.motion.time, i, g)

    @cached_property
    def onset(self) -> mdr.Indentation | None:
        """State at which yield begins or continues below an earlier imprint, None if out of reach."""
        profile, medium = self.scene.profile, self.scene.medium
        depth = onset_depth(self.scene, self.initial_plastic_depth)
        return mdr.indent(profile, medium, depth) if depth <= min(profile.known_depth, 1e300) else None

    # Numbers of the readouts.

    @cached_property
    def largest_terms(self) -> dict[str, Any]:
        """Largest term of each readout that is a sum, in every state, by the names of the readouts."""
        states, ledger = self.states, self.ledger
        length = np.fmax(np.fmax(states.live_interval.upper, states.plastic_depth), np.abs(states.depth))
        a, modulus = np.asarray(states.contact_radius), 2 * self.scene.medium.E_star
        found = dict.fromkeys(("depth", "plastic_depth"), length)
        found |= dict.fromkeys(("force", "tangential_force"), modulus * a * length)
        found["mean_pressure"] = modulus * length / np.where(a > 0, np.pi * a, np.inf)
        # `hasattr` would search for a similar name, which takes 0.3 ms a move.
        known = set(_ENERGIES).intersection(dir(ledger))
        energies = {name: getattr(ledger, name) for name in known}
        found |= dict.fromkeys(energies, sum(map(np.abs, energies.values())))
        for name, values in (
            ("relative_depth", self.relative_depth),
            ("velocity", getattr(self.motion, "velocity", None)),
        ):
            if values is not None:
                found[name] = np.max(np.abs(values))
        return found

    @property
    def relative_depth(self) -> Any:
        onset = onset_depth(self.scene, self.initial_plastic_depth)
        return self.states.depth / onset if 0 < onset < np.inf else None

    @property
    def yield_speed(self) -> Any:
        """Speed (m/s) above which a virgin medium without viscosity or adhesion yields.

        None on a structure, which takes part of the energy.
        """
        more = self.dashpots or self.adhesive or self.initial_plastic_depth or self.structure
        if self.hit is None or self.onset is None or more:
            return None
        return mdr.yield_speed(self.scene.profile, self.scene.medium, self.scene.drive.mass)


def nearest(progress: Any, at: float) -> int:
    """Return the index of the state nearest to a progress."""
    return int(np.argmin(np.abs(progress - at)))


def path_progress(along: Any, depth: Any) -> Any:
    """Return the progress at places along a path of depths: 1 at the largest depth, 2 at the end."""
    peak = int(np.argmax(depth))
    progress = np.interp(along, along[[0, peak, -1]], [0.0, 1.0, 2.0])
    progress[peak] = 1.0
    return progress
