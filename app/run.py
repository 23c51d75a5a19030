"""One solved scene and the paths around it that are drawn. Asks the core, adds no physics."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

import mdr_core as mdr

#: Points of each stretch of a curve, denser towards its ends by the cosine.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 60))) / 2


@dataclass(frozen=True, eq=False)
class Run:
    """A scene with its present state, its curves and its largest state; made by `solve`.

    Parameters
    ----------
    scene : mdr.Scene
        What was solved: the largest depth, and the present one if that is smaller.
    state, deepest, onset : mdr.Indentation
        The present state, that at the largest depth, and that where yield starts.
    elastic, yielding, unloading : mdr.Indentation
        Loading up to the onset, loading beyond it (empty if nothing yields), and unloading.
    """

    scene: mdr.Scene
    state: mdr.Indentation
    deepest: mdr.Indentation
    onset: mdr.Indentation
    elastic: mdr.Indentation
    yielding: mdr.Indentation
    unloading: mdr.Indentation

    @property
    def yielded(self):
        """Whether anything has yielded."""
        return bool(self.state.plastic_depth > 0)

    @cached_property
    def mean_pressure(self):
        """Mean contact pressure F/(π a²) (Pa); 0 without contact."""
        return _mean_pressure(self.state)

    @cached_property
    def deepest_mean_pressure(self):
        """Mean contact pressure at the largest depth (Pa)."""
        return _mean_pressure(self.deepest)

    @cached_property
    def largest_slope(self):
        """Largest slope of the indenter within the largest contact, walls left out."""
        r = self.deepest.contact_radius * np.linspace(0, 1, 65)
        with np.errstate(invalid="ignore"):
            slope = np.diff(self.scene.profile.height(r)) / np.diff(r)
        return float(np.max(slope[np.isfinite(slope)], initial=0.0))


def solve(scene):
    """The run of a scene that presses to a depth and may draw back: one path for all its curves."""
    profile, medium = scene.profile, scene.medium
    path = np.atleast_1d(scene.drive.depth)
    largest, present = path.max(), path[-1]
    critical = min(medium.critical_depth, largest)
    elastic = critical * _SPREAD
    yielding = critical + (largest - critical) * _SPREAD if critical < largest else np.empty(0)
    # The last point in contact, the first without, and back to the surface.
    unloading = np.append(largest - critical * _SPREAD, [(largest - critical) * (1 - 1e-9), 0.0])
    parts = (elastic, yielding, [largest], unloading, [largest, present])
    edges = np.cumsum([0, *map(len, parts)])
    result = mdr.indent(profile, medium, np.concatenate(parts))
    stretch = [result[start:stop] for start, stop in pairwise(edges)]
    return Run(
        scene=scene,
        state=result[-1],
        deepest=stretch[2][0],
        onset=mdr.indent(profile, medium, medium.critical_depth),
        elastic=stretch[0],
        yielding=stretch[1],
        unloading=stretch[3],
    )


def _mean_pressure(state):
    return float(state.force / (np.pi * state.contact_radius**2)) if state.contact_radius > 0 else 0.0
