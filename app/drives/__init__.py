"""Base class of drives, and the course of a scene: one interface for the whole page."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.contact import adhesion
from mdr_core.contact.live_interval import LiveInterval
from mdr_core.oblique.oblique_motion import ObliqueMotion

#: States of unloading at which a loop with adhesion is evaluated: its area is good to three digits.
_LOOP = 80


@dataclass(frozen=True, eq=False)
class Course:
    """States of a scene along its path; every array has one value (SI) for each state.

    `states` are an `mdr.Indentation`, or `PathStates` with the same quantities; `states[i]` is one state.
    `progress` is 0 at first contact, 1 at the largest depth, 2 at loss of contact and 2.2 with the indenter
    at the undeformed surface. `now` and `peak` are the indices of the present state and of the largest
    depth. `turns`: the path may reverse several times. `pending` describes the approximation used until the
    exact solution. `drive` is the key of the drive, `name` that of a held scene.
    """

    scene: mdr.Scene
    progress: Any
    states: Any
    now: int
    peak: int
    hit: mdr.Impact | None = None
    motion: mdr.Motion | None = None
    turns: bool = False
    pending: str = ""
    oblique: ObliqueMotion | None = None
    drive: str = ""
    name: str = ""

    def __len__(self) -> int:
        return len(self.progress)

    @property
    def state(self) -> Any:
        return self.states[self.now]

    @cached_property
    def turning_point(self) -> Any:
        return self.states[self.peak]

    @property
    def initial_plastic_depth(self) -> float:
        """Plastic depth (m) of an earlier imprint."""
        return getattr(self.scene.drive, "plastic_depth", 0.0)

    @property
    def dashpots(self) -> bool:
        """Whether dashpots carry load along this path."""
        return self.motion is not None and self.scene.medium.eta > 0

    @property
    def adhesive(self) -> bool:
        return self.scene.medium.work_of_adhesion > 0

    @property
    def pull_off_force(self) -> Any:
        return self.states.pull_off_force if self.adhesive else None

    @property
    def chained(self) -> bool:
        """Whether elements have separate memories, which one live interval does not describe."""
        return not isinstance(self.states, mdr.Indentation)

    @property
    def ledger(self) -> Any:
        """Motion with all energies, including those along the surface; None without times."""
        return self.motion if self.oblique is None else self.oblique

    @property
    def plastic_work(self) -> Any:
        """Work (J) of yield; of an impact without earlier ones."""
        return self.states.plastic_work if self.motion is None else self.motion.plastic_work

    @property
    def viscous_work(self) -> Any:
        return self.ledger.viscous_work if self.dashpots else None

    @property
    def kinetic_energy(self) -> Any:
        return None if self.hit is None or self.motion is None else self.ledger.kinetic_energy

    @property
    def stored_energy(self) -> Any:
        """Energy (J) of all springs, including released elements."""
        return self.states.stored_energy if self.motion is None else self.ledger.stored_energy

    @property
    def energies(self) -> dict[str, Any]:
        """Losses (J) so far, stored and kinetic energy, by the names of their areas."""
        m = self.ledger
        friction = 0 * m.time if self.oblique is None else m.friction_work
        parts = friction, m.plastic_work, m.viscous_work, m.stored_energy, m.kinetic_energy
        return dict(zip(("friction", "plastic", "viscous", "stored", "kinetic"), parts, strict=True))

    @cached_property
    def on_axes(self) -> dict[str, Any]:
        """Values of all states by the names of their axes."""
        values = {"d": self.states.depth, "F": self.states.force, "a": self.states.contact_radius}
        if self.motion is not None:
            values["t"] = self.motion.time
        if self.oblique is not None:
            values["force"] = self.oblique.tangential_force
        return values

    @cached_property
    def onset(self) -> mdr.Indentation | None:
        """State at which yield begins, or goes on below an earlier imprint; None if it is not reached."""
        profile, medium = self.scene.profile, self.scene.medium
        depth = self.initial_plastic_depth + medium.critical_depth
        return mdr.indent(profile, medium, depth) if depth <= min(profile.known_depth, 1e300) else None

    @property
    def relative_depth(self) -> Any:
        critical = self.scene.medium.critical_depth
        return self.states.depth / critical if critical < np.inf else None

    @cached_property
    def rebound(self) -> SimpleNamespace | None:
        """Results (SI) of an oblique impact, of the contact point and of the body."""
        if self.oblique is None:
            return None
        drive, hit, motion = self.scene.drive, self.oblique.impact, self.oblique
        after = float(motion.tangential_velocity[-1] if hit is None else hit.tangential_velocity)
        largest = np.max(np.abs(motion.tangential_force)) if hit is None else hit.max_tangential_force
        # The impulse changes the speed of the body and its spin.
        impulse = drive.tangential_mass * (after - drive.tangential_speed)
        body = drive.tangential_speed + impulse / drive.mass
        found = {"contact_velocity": after, "body_speed": body, "max_tangential_force": float(largest)}
        found["body_angle"] = float(np.arctan2(float(self.hit.rebound_speed), body))
        found["tangential_restitution"] = -after / (drive.tangential_speed or np.nan)
        if drive.tangential_mass < drive.mass:
            radius, spin = float(self.scene.profile.body_radius), after - body
            found |= {"spin_speed": spin} if radius == np.inf else {"spin": spin / radius}
        return SimpleNamespace(**found)

    def unloading_curve(self, index: int) -> tuple[Any, Any]:
        """Depths (m) and forces (N) of elastic unloading; the area below is the stored energy.

        With adhesion it is less by what separates the surfaces up to the pull-off.
        Elements held back by dashpots are compressed further than their load indicates.
        """
        live, depth = self.states.live_interval[index], float(self.states.depth[index])
        touching = self.states.contact_radius[index] > 0
        states = unloaded(self.scene, live, np.linspace(1, 0, 25), touching)
        d, force = states.depth, states.force
        if live.length > 0 and depth > live.upper * (1 + 1e-9):
            stiff = 2 * self.scene.medium.E_star * self.states.contact_radius[index]
            d, force = np.append(depth, d), np.append(force[0] + stiff * (depth - d[0]), force)
        return d, force

    def adhesive_loop(self, index: int) -> tuple[Any, Any, Any]:
        """Depths (m), ascending, and forces (N) of loading and of unloading at each of them.

        Loading is to a state, or to the largest depth if that is before it, and unloading to the pull-off.
        The depths are the same, so that the forces differ only where the curves do; they end there.
        """
        return self._largest_loop if index >= self.peak else self._loop(index)

    @cached_property
    def _largest_loop(self):
        return self._loop(self.peak)

    def _loop(self, turn):
        states = self.states
        # Below first contact the path is a small part of a deep one.
        whole, below = (
            unloaded(self.scene, states.live_interval[start], np.linspace(1, 0, _LOOP), True)
            for start in (turn, 0)
        )
        largest, end = states.depth[turn], whole.depth[-1]
        # The force jumps at first contact and at the pull-off.
        step = 1e-9 * states.depth[self.peak]
        even = largest * np.linspace(0, 1, _LOOP)
        d = np.concatenate([states.depth[: turn + 1], even, whole.depth, below.depth])
        d = np.concatenate([d[(d > end + step) | (d >= 0)], [-step, end, end - step]])
        d = np.unique(np.minimum(d, largest))
        bodies = self.scene.profile, self.scene.medium
        loading = mdr.indent(*bodies, d).force
        unloading = mdr.indent(*bodies, np.append(largest, d[::-1])).force[:0:-1]
        unloading = np.where(d > end, unloading, np.where(d == end, whole.force[-1], 0.0))
        # Both are found to about 10⁻¹².
        unloading = np.where(np.isclose(loading, unloading, rtol=1e-9, atol=0), loading, unloading)
        apart = slice(np.max(np.flatnonzero(loading != unloading), initial=0) + 2)
        return d[apart], loading[apart], unloading[apart]


def unloaded(scene: mdr.Scene, live: LiveInterval, share: Any, touching: Any) -> mdr.Indentation:
    """States on unloading from live intervals, at shares (1 to 0) of the distance to the pull-off."""
    profile, medium, end = scene.profile, scene.medium, 0.0
    if medium.work_of_adhesion > 0:
        # Weak adhesion is seen only just before the pull-off.
        share = share**3
        held = adhesion.AT_FORCE if isinstance(scene.drive, mdr.ForcePath) else adhesion.AT_DEPTH
        low = adhesion.stable_ranges(profile, medium, held)[0][0]
        end = adhesion.last_interval(live.lower, low).length
    length = np.where(touching, end + share * (live.length - end), 0.0)
    interval = LiveInterval(*np.broadcast_arrays(live.lower, live.lower + length, length))
    stretched = np.where(touching, adhesion.stretch(medium, profile.contact_radius(interval.upper)), 0.0)
    load = -medium.E_star * stretched
    return mdr.Indentation(profile, medium, interval.upper - stretched, interval, load)


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


class Drive(ABC):
    """A drive of the indenter, as set on the page and as in `mdr.Scene`.

    `solver`: function of the core and its arguments, if it can be swept. Its choices, numbers, readouts and
    results are in assets/quantities.json.
    """

    solver: tuple[str, ...] = ()

    @abstractmethod
    def make(self, state: Any, medium: mdr.Medium) -> Any:
        """Drive of a scene, from the state of the page."""

    @abstractmethod
    def follow(self, scene: mdr.Scene, progress: float) -> Course:
        """States of a scene; may be approximate where an exact solution is slow."""

    def in_time(self, scene: mdr.Scene) -> Course:
        """Exact states of a scene whose course is pending."""
        return self.follow(scene, 1.0)

    @abstractmethod
    def turning_point(self, scene: mdr.Scene) -> mdr.Indentation:
        """State of largest depth of a scene."""

    @abstractmethod
    def equivalent(self, state: Any, turning_point: mdr.Indentation) -> dict[str, Any]:
        """Numbers of this drive that lead to the same largest depth."""
