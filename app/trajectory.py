"""All states of one scene from first contact to the end, as arrays. Asks the core, adds no physics."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval

#: Denser towards both ends of a stretch by the cosine, enough to be played at 30 frames a second.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 49))) / 2
#: Instants of an impact, its turning point among them.
INSTANTS = 161
_PLACES = (1 - np.cos(np.linspace(0, np.pi, 201))) / 2
#: Points of an unloading curve from one state.
_RELEASE = np.linspace(1, 0, 13)


@dataclass(frozen=True, eq=False)
class Trajectory:
    """States of a scene along its way; made by `follow`. Every array has one value for each state.

    Parameters
    ----------
    scene : mdr.Scene
        What was solved.
    progress : ndarray
        Where on the way a state stands: 0 first contact, 1 deepest, 2 loss of contact, beyond that
        the tip goes back to the height of the undeformed surface.
    states : mdr.Indentation
        The states with what is elastic of them.
    now : int
        The present one.
    motion : Motion or None
        Time, speeds and energies of an impact.
    hit : mdr.Impact or None
        The impact.
    """

    scene: mdr.Scene
    progress: np.ndarray
    states: mdr.Indentation
    now: int
    motion: mdr.Motion | None = None
    hit: mdr.Impact | None = None

    @cached_property
    def force(self):
        """Normal force (N), with that of the dashpots."""
        return self.states.force if self.motion is None else self.motion.force

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

    @cached_property
    def peak(self):
        """Number of the deepest state."""
        return int(np.argmax(self.states.depth))

    @property
    def state(self):
        """The present state."""
        return self.states[self.now]

    @property
    def deepest(self):
        """The deepest state."""
        return self.states[self.peak]

    @cached_property
    def onset(self):
        """The state where yield starts; None if nothing yields or the shape is not known so deep."""
        medium, profile = self.scene.medium, self.scene.profile
        span = medium.critical_depth
        depth = self.before + span
        if not depth <= min(profile.deepest, 1e300):
            return None
        return mdr.Indentation(
            profile, medium, depth, LiveInterval(*map(np.asarray, (self.before, depth, span)))
        )

    @cached_property
    def largest_slope(self):
        """Largest slope of the indenter within the largest contact, walls left out."""
        r = self.deepest.contact_radius * np.linspace(0, 1, 65)
        with np.errstate(invalid="ignore"):
            slope = np.diff(self.scene.profile.height(r)) / np.diff(r)
        return float(np.max(slope[np.isfinite(slope)], initial=0.0))

    def pressure(self, index, r, exact=False):
        """Contact pressure (Pa) of a state, that of the dashpots included.

        That of a measured tip is numerical unless it is to be `exact`, which takes a hundred times as long.
        """
        state = self.states[index]
        measured = isinstance(self.scene.profile, mdr.Sampled) and float(state.contact_radius) > 0
        measured = measured and not exact
        return _from_line_load(state, r) if measured else state.pressure(r)

    def released(self, indices):
        """Depths and elastic forces of unloading from each of some states: two arrays, a row each."""
        live = self.states[indices].live
        length = live.length[:, None] * _RELEASE
        lower = np.broadcast_to(live.lower[:, None], length.shape)
        interval = LiveInterval(lower, lower + length, length)
        states = mdr.Indentation(self.states.profile, self.states.medium, interval.upper, interval)
        return interval.upper, states.force


def _from_line_load(state, r):
    """Contact pressure (Pa) by Eq. (10) of Popov (2015), the line load straight between its places.

    For measured tips: their kinks each have an integral of their own, too many of them to wait for.
    """
    a, c = float(state.contact_radius), float(state.plastic_radius)
    x = np.unique(np.concatenate([c * _PLACES, c + (a - c) * _PLACES]))
    # The line load goes to zero at the rim but for a wall, where it ends with a jump.
    q = state.line_load(np.minimum(x, a * (1 - 1e-12)))
    return 0.0 - mdr.abel.stress_from_line_load(x, q, r)


def follow(scene, progress):
    """The trajectory of a scene, with a state at the progress where the page stands."""
    if isinstance(scene.drive, mdr.FreeImpact):
        return _impact(scene, progress)
    deepest = scene.solve()
    largest = float(deepest.depth)
    critical = min(scene.medium.critical_depth, largest)
    share = critical / largest if largest > 0 else 1.0
    loading = np.concatenate([share * _SPREAD, share + (1 - share) * _SPREAD])
    way = np.concatenate([loading, 1 + _SPREAD, [2 + 1e-6], 2 + 0.2 * np.linspace(0, 1, 9)[1:], [progress]])
    # Six digits: what the page says about where it stands is read back as the same number.
    way = np.unique([float(f"{p:.6g}") for p in way])
    depth = np.where(way <= 1, way * largest, largest - (np.clip(way, 1, 2) - 1) * critical)
    depth = np.where(way > 2, (largest - critical) * np.maximum(2.2 - way, 0) / 0.2, depth)
    return Trajectory(scene, way, mdr.indent(scene.profile, scene.medium, depth), _nearest(way, progress))


def _impact(scene, progress):
    hit = scene.solve()
    path = hit.motion(INSTANTS)
    peak = int(np.argmax(path.depth))
    turn, end = path.time[peak], path.time[-1]
    way = np.where(path.time <= turn, path.time / turn, 1 + (path.time - turn) / (end - turn))
    way = np.array([float(f"{p:.6g}") for p in way])
    return Trajectory(scene, way, path.states, _nearest(way, progress), path, hit)


def _nearest(way, progress):
    return int(np.argmin(np.abs(way - progress)))
