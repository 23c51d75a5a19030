"""All states of one scene from first contact to the end, as arrays. Asks the core, adds no physics."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval, live_interval

#: Instants of an impact.
INSTANTS = 120
#: Points of an unloading curve from one state.
_RELEASE = np.linspace(1, 0, 13)


def _spread(count):
    """From 0 to 1, denser towards both ends."""
    return (1 - np.cos(np.linspace(0, np.pi, count))) / 2


@dataclass(frozen=True, eq=False)
class Trajectory:
    """States of a scene along its way; made by `follow`. Every array has one value for each state.

    `progress` is where on the way a state stands: 0 first contact, 1 deepest, 2 loss of contact, and 2.2
    the tip back at the height of the undeformed surface. `now` is the number of the present state, `peak`
    that of the deepest one. An impact has a `hit`, and times, speeds and energies in `motion`.
    """

    scene: mdr.Scene
    progress: np.ndarray
    states: mdr.Indentation
    now: int
    peak: int
    hit: mdr.Impact | None = None
    motion: mdr.Motion | None = None

    def __len__(self):
        return len(self.progress)

    @property
    def force(self):
        """Normal force (N), with that of the dashpots."""
        return self.states.force

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
        return self.states.stored_energy if self.motion is None else self.motion.stored_energy

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
        medium, profile = self.scene.medium, self.scene.profile
        depth = self.before + medium.critical_depth
        return mdr.indent(profile, medium, depth) if depth <= min(profile.deepest, 1e300) else None

    def released(self, index):
        """Depths and elastic forces of unloading from one state."""
        live = self.states.live[index]
        length = live.length * _RELEASE
        interval = LiveInterval(np.full_like(length, live.lower), live.lower + length, length)
        states = mdr.Indentation(self.states.profile, self.states.medium, interval.upper, interval)
        return interval.upper, states.force


def follow(scene, progress):
    """The trajectory of a scene, with a state at the progress where the page stands."""
    result = scene.solve()
    if not isinstance(result, mdr.Impact):
        return _pressed(scene, result, progress)
    motion = result.motion(INSTANTS)
    time, peak = motion.time, motion.turning_point
    turn, end = time[peak], time[-1]
    way = _rounded(np.where(time <= turn, time / turn, 1 + (time - turn) / (end - turn)))
    return Trajectory(scene, way, motion.states, _nearest(way, progress), peak, result, motion)


def _pressed(scene, deepest, progress):
    """To the deepest state, back until the load is gone, and up to the undeformed surface."""
    depth, critical = float(deepest.depth), scene.medium.critical_depth
    share = min(critical / depth, 1.0) if depth > 0 else 1.0
    loading = np.concatenate([share * _spread(41), share + (1 - share) * _spread(41)])
    lifted = 2 + 0.2 * np.linspace(0, 1, 9)
    way = np.unique(_rounded(np.concatenate([loading, 1 + _spread(41), lifted, [progress]])))
    live = live_interval((np.minimum(way, 1.0) * depth)[:, None], critical)[:, 0]
    # By its length, which is exactly zero where the load is gone.
    length = np.clip(2 - way, 0.0, 1.0) * live.length
    upper = np.where(way <= 1, live.upper, live.lower + length)
    lifted = np.where(way <= 2, upper, live.lower * np.maximum(2.2 - way, 0.0) / 0.2)
    states = mdr.Indentation(scene.profile, scene.medium, lifted, LiveInterval(live.lower, upper, length))
    return Trajectory(scene, way, states, _nearest(way, progress), _nearest(way, 1.0))


def _nearest(way, progress):
    return int(np.argmin(np.abs(way - progress)))


def _rounded(way):
    """Six digits: what the page says about where it stands is read back as the same number."""
    return np.array([float(f"{p:.6g}") for p in way])
