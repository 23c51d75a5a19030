"""Courses of scenes: their states along a path, with what a drive adds to them."""

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
    """Depth (m) at which yield begins over an imprint of some plastic depth; infinite if nothing yields."""
    return float(yield_rule(scene.profile, scene.medium).onset(imprint))


#: Terms of the balance of energy.
_ENERGIES = (
    "stored_energy", "plastic_work", "viscous_work", "kinetic_energy", "friction_work", "structure_work",
    "support_energy",
)  # fmt: skip


@dataclass(frozen=True)
class Caution:
    """A limit that is exceeded so far that some readouts are no results."""

    #: The limits (`Limit.what`) that it stands for, itself first.
    limits: tuple[str, ...]
    #: What to do, and why.
    sentence: str
    readouts: tuple[str, ...]
    #: Choice and option that do it, if there is one.
    choice: str = ""
    option: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """States of a scene along its path; every array has one value (SI) for each state.

    `states` are an `mdr.Indentation`, or the `PathStates` of a path in time, which lack a few of its
    quantities, such as the stiffness; `states[i]` is one state. `progress` is 0 at first contact, 1 at the
    largest depth, 2 at loss of contact and `LAST_PROGRESS` with the indenter at the undeformed surface.
    `motion` has times and energies where the path is one in time, and `hit` is the impact; else they are
    None. `turns` says whether the path may
    reverse several times, `chained` whether elements have separate memories, which one live interval does
    not describe. `pending` describes the approximation used until the exact solution, `notes` are other
    sentences about the course. The index `now` of the present state and the key `drive` are set by
    `drives.follow`.
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

    #: What the law of the springs has besides elasticity, dashpots and yield.
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
        """When each state is played, from 0 to 1."""
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
        """Names of the readouts that are no results, each with what to do."""
        return {name: each.sentence for each in self.cautions for name in each.readouts}

    @property
    def asides(self) -> dict[str, str]:
        """Words in the cells of readouts, by their names."""
        return {}

    @property
    def initial_plastic_depth(self) -> float:
        """Plastic depth (m) of an earlier imprint."""
        return getattr(self.scene.drive, "plastic_depth", 0.0)

    @property
    def structure(self) -> mdr.Structure | None:
        """What gives way behind the medium; None for a body at rest."""
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
        """Readouts above the plots that have the place of others."""
        # The damaged area is known from c.
        return {"damaged_area": "viscous_work"} if self.dashpots else {}

    @property
    def ledger(self) -> Any:
        """What has the energies (J) of all states; plastic work of an impact is without earlier ones."""
        return self.states if self.motion is None else self.motion

    def relaxing(self, i: int, g: Any) -> Any:
        """Remaining elastic compression (m) of released elements at heights g (m), in state i."""
        # On a path in time nothing is released.
        if self.hit is None or not self.dashpots:
            return 0.0
        return released_compression(self.states, self.motion.time, i, g)

    @cached_property
    def onset(self) -> mdr.Indentation | None:
        """State at which yield begins, or goes on below an earlier imprint; None if it is not reached."""
        profile, medium = self.scene.profile, self.scene.medium
        depth = onset_depth(self.scene, self.initial_plastic_depth)
        return mdr.indent(profile, medium, depth) if depth <= min(profile.known_depth, 1e300) else None

    # Numbers that are read.

    @cached_property
    def largest_terms(self) -> dict[str, Any]:
        """Of readouts that are sums, by name: the largest term of the sum, in every state."""
        states, ledger = self.states, self.ledger
        length = np.fmax(np.fmax(states.live_interval.upper, states.plastic_depth), np.abs(states.depth))
        a, modulus = np.asarray(states.contact_radius), 2 * self.scene.medium.E_star
        found = dict.fromkeys(("depth", "plastic_depth"), length)
        found |= dict.fromkeys(("force", "tangential_force"), modulus * a * length)
        found["mean_pressure"] = modulus * length / np.where(a > 0, np.pi * a, np.inf)
        # `hasattr` would look for a name that is like a missing one, 0.3 ms a move.
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
        """Speed (m/s) above which the body makes a virgin medium yield, without viscosity or adhesion.

        None on a structure, which takes a part of the energy.
        """
        more = self.dashpots or self.adhesive or self.initial_plastic_depth or self.structure
        if self.hit is None or self.onset is None or more:
            return None
        return mdr.yield_speed(self.scene.profile, self.scene.medium, self.scene.drive.mass)


def nearest(progress: Any, at: float) -> int:
    """Index of the state nearest to a progress."""
    return int(np.argmin(np.abs(progress - at)))


def path_progress(along: Any, depth: Any) -> Any:
    """Progress at places along a path of depths: 1 at the largest one, 2 at the end."""
    peak = int(np.argmax(depth))
    progress = np.interp(along, along[[0, peak, -1]], [0.0, 1.0, 2.0])
    progress[peak] = 1.0
    return progress
