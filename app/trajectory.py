"""All states of one scene from first contact to the end, as arrays. Asks the core, adds no physics."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mdr_core as mdr
from mdr_core.dynamics.oblique_motion import ObliqueMotion
from mdr_core.yielding import LiveInterval

#: From first contact (0) over the deepest state (1) to the loss of contact (2) and the tip back at the
#: height of the undeformed surface.
LAST_PROGRESS = 2.2
#: Points of an unloading curve from one state.
_RELEASE = np.linspace(1, 0, 13)


@dataclass(frozen=True, eq=False)
class Trajectory:
    """States of a scene along its way; made by `drives.follow`. Every array has one value for each state.

    `progress` is where on the way a state stands: 0 first contact, 1 deepest, 2 loss of contact, and 2.2
    the tip back at the height of the undeformed surface. `now` is the number of the present state, `peak`
    that of the deepest one. What has times has them, with speeds and energies, in `motion`; an impact has
    a `hit`, and an `oblique` one its motion with friction. A path that may turn round several times
    `turns`; what is `pending` says how roughly it is followed until it has been solved in full.
    """

    scene: mdr.Scene
    progress: np.ndarray
    states: mdr.Indentation
    now: int
    peak: int
    hit: mdr.Impact | None = None
    motion: mdr.Motion | None = None
    turns: bool = False
    pending: str = ""
    oblique: ObliqueMotion | None = None

    def __len__(self):
        return len(self.progress)

    @property
    def force(self):
        """Normal force (N), with that of the dashpots."""
        return self.states.force

    @cached_property
    def deeper(self):
        """Whether each state is at the largest depth so far."""
        return self.states.depth >= np.maximum.accumulate(self.states.depth)

    @property
    def before(self):
        """Plastic depth (m) that was left on this spot before."""
        return getattr(self.scene.drive, "plastic_depth", 0.0)

    @property
    def plastic_work(self):
        """Work (J) lost to yield so far, of an impact its own only."""
        return self.states.plastic_work if self.motion is None else self.motion.plastic_work

    @property
    def stored_energy(self):
        """Energy (J) of all springs, of those too that have let go of a viscous rebound."""
        return self.states.stored_energy if self.motion is None else self.ledger.stored_energy

    @property
    def ledger(self):
        """The motion with all energies, those along the surface too; None of what has no times."""
        return self.motion if self.oblique is None else self.oblique

    @property
    def energy(self):
        """All that is there and has been lost so far (J), of what has times."""
        m = self.ledger
        energy = m.kinetic_energy + m.stored_energy + m.plastic_work + m.viscous_work
        return energy if self.oblique is None else energy + m.friction_work

    @cached_property
    def on(self):
        """Values (SI) of all states by the names of the axes that they are on."""
        values = {"d": self.states.depth, "F": self.force, "a": self.states.contact_radius}
        if self.motion is not None:
            values["t"] = self.motion.time
        if self.oblique is not None:
            m = self.oblique
            values |= {"force": m.tangential_force, "W": m.tangential_velocity, "v": -m.velocity}
        return values

    @property
    def state(self):
        """The present state."""
        return self.states[self.now]

    @cached_property
    def deepest(self):
        """The deepest state."""
        return self.states[self.peak]

    @cached_property
    def onset(self):
        """The state where yield starts; None if nothing yields or the shape is not known so deep."""
        return onset(self.scene, self.before)

    def released(self, index):
        """Depths and elastic forces of unloading from one state."""
        live = self.states.live_interval[index]
        length = live.length * _RELEASE
        interval = LiveInterval(np.full_like(length, live.lower), live.lower + length, length)
        states = mdr.Indentation(self.states.profile, self.states.medium, interval.upper, interval)
        return interval.upper, states.force


def onset(scene, before=0.0):
    """The state where yield starts above some plastic depth (m); None if there is no such state."""
    depth = before + scene.medium.critical_depth
    reached = depth <= min(scene.profile.known_depth, 1e300)
    return mdr.indent(scene.profile, scene.medium, depth) if reached else None


def nearest(way, progress):
    """Number of the state next to some progress."""
    return int(np.argmin(np.abs(way - progress)))


def rounded(way):
    """Six digits: what the page says about where it stands is read back as the same number."""
    return np.array([float(f"{p:.6g}") for p in way])


def passed(along, peak):
    """The progress at some places along a way, of which one is the deepest: 1 there, 2 at the end."""
    share = (along - along[0]) / ((along[-1] - along[0]) or 1.0)
    turn = share[peak]
    way = np.where(share <= turn, share / (turn or 1.0), 1 + (share - turn) / ((1 - turn) or 1.0))
    way[peak] = 1.0
    return rounded(way)
