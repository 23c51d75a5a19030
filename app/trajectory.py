"""All states of one scene from first contact to the end, as arrays. Asks the core, adds no physics."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval, live_interval

#: Instants of an impact.
INSTANTS = 120
_PLACES = (1 - np.cos(np.linspace(0, np.pi, 201))) / 2
_EDGE = (1 - np.cos(np.linspace(0, np.pi, 40))) / 2
#: Points of an unloading curve from one state.
_RELEASE = np.linspace(1, 0, 13)


def _spread(count):
    """From 0 to 1, denser towards both ends: enough to be played at 30 frames a second."""
    return (1 - np.cos(np.linspace(0, np.pi, count))) / 2


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
    now, peak : int
        The present one, and the deepest one.
    hit : mdr.Impact or None
        The impact.
    motion : mdr.Motion or None
        Time, speeds and energies of an impact.
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
        span = medium.critical_depth
        depth = self.before + span
        if not depth <= min(profile.deepest, 1e300):
            return None
        live = LiveInterval(*map(np.asarray, (self.before, depth, span)))
        return mdr.Indentation(profile, medium, depth, live)

    @cached_property
    def largest_slope(self):
        """Largest slope of the indenter within the largest contact, walls left out."""
        r = self.deepest.contact_radius * np.linspace(0, 1, 65)
        with np.errstate(invalid="ignore"):
            slope = np.diff(self.scene.profile.height(r)) / np.diff(r)
        return float(np.max(slope[np.isfinite(slope)], initial=0.0))

    def nearest(self, progress):
        """Number of the state nearest to a progress."""
        return int(np.argmin(np.abs(self.progress - progress)))

    def pressure(self, index, r):
        """Contact pressure (Pa) of a state, that of the dashpots included."""
        state = self.states[index]
        if not isinstance(self.scene.profile, mdr.Sampled) or not state.live.length > 0:
            return state.pressure(r)
        pressure = _from_line_load(state, r)
        a, load = float(state.contact_radius), float(state.dashpot_load)
        if load > 0:
            with np.errstate(divide="ignore", invalid="ignore"):
                pressure += np.where(r <= a, load / np.pi / np.sqrt((a - r) * (a + r)), 0.0)
        return pressure

    def radii(self, index, half):
        """Radii from 0 to `half`, dense where the pressure has an edge: at 0, c, a and at kinks."""
        a, c = float(self.states.contact_radius[index]), float(self.states.plastic_radius[index])
        kinks = () if isinstance(self.scene.profile, mdr.Sampled) else self.scene.profile.kinks[:3]
        inner = [float(self.scene.profile.contact_radius(kink)) for kink in kinks]
        edges = np.array(sorted({0.0, half, *(e for e in (a, c, *inner) if e <= half)}))
        return np.unique(np.append(edges[:-1, None] + np.diff(edges)[:, None] * _EDGE, edges))

    def released(self, index):
        """Depths and elastic forces of unloading from one state."""
        live = self.states.live[index]
        length = live.length * _RELEASE
        interval = LiveInterval(np.full_like(length, live.lower), live.lower + length, length)
        states = mdr.Indentation(self.states.profile, self.states.medium, interval.upper, interval)
        return interval.upper, states.force


def _from_line_load(state, r):
    """Contact pressure (Pa) of the springs by Eq. (10), the line load straight between places.

    For measured tips: their kinks each have an integral of their own, too many of them to wait for.
    """
    a, c = float(state.contact_radius), float(state.plastic_radius)
    x = np.unique(np.concatenate([c * _PLACES, c + (a - c) * _PLACES]))
    # The load of the springs goes to zero at the rim; only that of the dashpots ends there with a jump.
    springs = np.where(x < a, state.line_load(x) - state.dashpot_load, 0.0)
    return 0.0 - mdr.abel.stress_from_line_load(x, np.maximum(springs, 0.0), r)


def follow(scene, progress):
    """The trajectory of a scene, with a state at the progress where the page stands."""
    if isinstance(scene.drive, mdr.FreeImpact):
        return _impact(scene, progress)
    deepest = scene.solve()
    depth, length = float(deepest.depth), float(deepest.live.length)
    way = _way(scene, depth, progress)
    down = np.minimum(way, 1.0) * depth
    live = live_interval(down[:, None], scene.medium.critical_depth)[:, 0]
    lower, back = float(deepest.live.lower), np.maximum(2.0 - way, 0.0) * length
    lower = np.where(way < 1, live.lower, lower)
    length = np.where(way < 1, live.length, back)
    lifted = np.where(way > 2, lower * np.maximum(2.2 - way, 0.0) / 0.2, lower + length)
    states = mdr.Indentation(
        scene.profile,
        scene.medium,
        np.where(way == 1, depth, lifted),
        LiveInterval(lower, lower + length, length),
    )
    now, peak = (int(np.argmin(np.abs(way - place))) for place in (progress, 1.0))
    return Trajectory(scene, way, states, now, peak)


def _way(scene, largest, progress):
    """Progress of every state of a scene that is pressed to a largest depth (m)."""
    # A measured tip has an integral for each of its samples.
    count = 13 if isinstance(scene.profile, mdr.Sampled) else 41
    share = min(scene.medium.critical_depth / largest, 1.0) if largest > 0 else 1.0
    loading = np.concatenate([share * _spread(count), share + (1 - share) * _spread(count)])
    lifted = 2 + 0.2 * np.linspace(0, 1, 9)
    # Six digits: what the page says about where it stands is read back as the same number.
    way = np.concatenate([loading, 1 + _spread(count), lifted, [progress]])
    return np.unique([float(f"{p:.6g}") for p in way])


def _impact(scene, progress):
    hit = scene.solve()
    motion = hit.motion(INSTANTS)
    peak = motion.turning_point
    turn, end = motion.time[peak], motion.time[-1]
    way = np.where(motion.time <= turn, motion.time / turn, 1 + (motion.time - turn) / (end - turn))
    way = np.array([float(f"{p:.6g}") for p in way])
    now = int(np.argmin(np.abs(way - progress)))
    return Trajectory(scene, way, motion.states, now, peak, hit, motion)
