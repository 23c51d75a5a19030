"""Courses of scenes: their states along a path, with what a drive adds to them."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

import mdr_core as mdr
from mdr_core.contact.yielding import yield_rule
from mdr_core.impacts.motion import released_compression


def onset_depth(scene: mdr.Scene, imprint: float = 0.0) -> float:
    """Depth (m) at which yield begins over an imprint of some plastic depth; infinite if nothing yields."""
    return float(yield_rule(scene.profile, scene.medium).onset(imprint))


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """States of a scene along its path; every array has one value (SI) for each state.

    `states` are an `mdr.Indentation`, or have the same quantities; `states[i]` is one state. `progress` is
    0 at first contact, 1 at the largest depth, 2 at loss of contact and 2.2 with the indenter at the
    undeformed surface. `peak` is the index of the largest depth. `pending` describes the approximation used
    until the exact solution. The index `now` of the present state and the key `drive` are set by
    `drives.follow`.
    """

    scene: mdr.Scene
    progress: Any
    states: Any
    peak: int
    now: int = 0
    pending: str = ""
    drive: str = ""

    #: Whether the indenter can be pressed to another depth by hand, and whether the path may reverse
    #: several times.
    pressed: ClassVar[bool] = True
    turns: ClassVar[bool] = False
    #: Whether elements have separate memories, which one live interval does not describe.
    chained: ClassVar[bool] = False
    #: Whether dashpots carry load along this path, and what else the law of the springs has.
    dashpots: ClassVar[bool] = False
    more_law: ClassVar[str] = ""

    def __len__(self) -> int:
        return len(self.progress)

    @property
    def state(self) -> Any:
        return self.states[self.now]

    @cached_property
    def turning_point(self) -> Any:
        return self.states[self.peak]

    @property
    def times(self) -> Any:
        """When each state is played, from 0 to 1."""
        return np.linspace(0, 1, len(self))

    @property
    def notes(self) -> list[str]:
        """Sentences about the course."""
        return []

    def limits(self, density: float) -> list[Any]:
        """Assumptions of the model, for a medium of some density (kg/m³)."""
        return list(self.states.limits)

    @property
    def initial_plastic_depth(self) -> float:
        """Plastic depth (m) of an earlier imprint."""
        return getattr(self.scene.drive, "plastic_depth", 0.0)

    @property
    def adhesive(self) -> bool:
        return self.scene.medium.work_of_adhesion > 0

    @property
    def pull_off_force(self) -> Any:
        return self.states.pull_off_force if self.adhesive else None

    @property
    def ledger(self) -> Any:
        """What has the energies (J) of all states; plastic work of an impact is without earlier ones."""
        return self.states

    def relaxing(self, i: int, g: Any) -> Any:
        """Remaining elastic compression (m) of released elements at heights g (m), in state i."""
        return 0.0

    @cached_property
    def onset(self) -> mdr.Indentation | None:
        """State at which yield begins, or goes on below an earlier imprint; None if it is not reached."""
        profile, medium = self.scene.profile, self.scene.medium
        depth = onset_depth(self.scene, self.initial_plastic_depth)
        return mdr.indent(profile, medium, depth) if depth <= min(profile.known_depth, 1e300) else None

    @property
    def relative_depth(self) -> Any:
        onset = onset_depth(self.scene, self.initial_plastic_depth)
        return self.states.depth / onset if 0 < onset < np.inf else None

    @property
    def half_angle(self) -> Any:
        """Half-angle (rad) of a conical flank."""
        slope = getattr(self.scene.profile, "slope", None)
        return None if slope is None else np.arctan(1 / slope)


@dataclass(frozen=True, eq=False, kw_only=True)
class Timed(Course):
    """A course with times: `motion` has its energies."""

    motion: mdr.Motion
    pressed: ClassVar[bool] = False

    @property
    def ledger(self) -> Any:
        return self.motion

    @property
    def times(self) -> Any:
        time = self.motion.time
        return (time - time[0]) / np.ptp(time)

    @property
    def dashpots(self) -> bool:
        return self.scene.medium.eta > 0

    @property
    def viscous_work(self) -> Any:
        """Work (J) of dashpots, None without."""
        return self.ledger.viscous_work if self.dashpots else None


@dataclass(frozen=True, eq=False, kw_only=True)
class Hit(Course):
    """A course of an impact; with adhesion its states are those of slow unloading, without times."""

    hit: mdr.Impact
    pressed: ClassVar[bool] = False

    @property
    def yield_speed(self) -> Any:
        """Speed (m/s) above which the body makes a virgin medium without viscosity or adhesion yield."""
        scene, more = self.scene, self.dashpots or self.adhesive or self.initial_plastic_depth
        none = more or self.onset is None
        return None if none else mdr.yield_speed(scene.profile, scene.medium, scene.drive.mass)

    @property
    def notes(self) -> list[str]:
        if not self.hit.captured:
            return []
        return ["Adhesion holds the body: e = 0. Unloading is drawn as if it were pulled off."]

    def limits(self, density: float) -> list[Any]:
        return [*self.hit.limits, self.hit.speed_limit(density)]


@dataclass(frozen=True, eq=False, kw_only=True)
class HitInTime(Hit, Timed):
    """A course of an impact with its motion."""

    @property
    def kinetic_energy(self) -> Any:
        return self.ledger.kinetic_energy

    def relaxing(self, i: int, g: Any) -> Any:
        return released_compression(self.motion, i, g)


def nearest(progress: Any, at: float) -> int:
    """Index of the state nearest to a progress."""
    return int(np.argmin(np.abs(progress - at)))


def rounded(progress: Any) -> Any:
    """Progress rounded to six digits, the precision of links."""
    return np.array([float(f"{p:.6g}") for p in progress])


def path_progress(along: Any, peak: int) -> Any:
    """Progress of places along a path: 1 at the index `peak`, 2 at the end."""
    share = (along - along[0]) / ((along[-1] - along[0]) or 1.0)
    turn = share[peak]
    progress = np.where(share <= turn, share / (turn or 1.0), 1 + (share - turn) / ((1 - turn) or 1.0))
    progress[peak] = 1.0
    return rounded(progress)
