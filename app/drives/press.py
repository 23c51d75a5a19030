"""Quasi-static loading to a depth or force, and unloading."""

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval, path_intervals

from . import Course, Drive, nearest, rounded

#: Places from 0 to 1, dense at both ends, where radii change as a root of the depth.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2


def limited_force(turning_point):
    """Force (N) of a state, limited to 90 % of the yield load of a flat face."""
    most = 2 * turning_point.medium.yield_line_load * turning_point.profile.wall
    return min(float(turning_point.force), 0.9 * most)


class Press(Drive):
    """Quasi-static loading to a depth or force (`kind`), and unloading."""

    kind: str
    results = (
        "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure", "stiffness", "stored_energy",
        "plastic_work",
    )  # fmt: skip

    def make(self, state):
        return self.values[0](state[f"max_{self.kind}"])

    def owns(self, value):
        return super().owns(value) and np.ndim(getattr(value, self.kind)) == 0

    def follow(self, scene, progress):
        """Loading, unloading, and lifting of the indenter to the undeformed surface."""
        turning_point = scene.solve()
        depth, critical = float(turning_point.depth), scene.medium.critical_depth
        share = min(critical / depth, 1.0) if depth > 0 else 1.0
        loading = np.concatenate([share * _SPREAD, share + (1 - share) * _SPREAD])
        lifted = 2 + 0.2 * np.linspace(0, 1, 9)
        places = np.unique(rounded(np.concatenate([loading, 1 + _SPREAD, lifted, [progress]])))
        live = path_intervals((np.minimum(places, 1.0) * depth)[:, None], critical)[:, 0]
        # The length is exactly zero without contact.
        length = np.clip(2 - places, 0.0, 1.0) * live.length
        upper = np.where(places <= 1, live.upper, live.lower + length)
        lifted = np.where(places <= 2, upper, live.lower * np.maximum(2.2 - places, 0.0) / 0.2)
        interval = LiveInterval(live.lower, upper, length)
        states = mdr.Indentation(scene.profile, scene.medium, lifted, interval)
        return Course(scene, places, states, nearest(places, progress), nearest(places, 1.0))

    def turning_point(self, scene):
        return scene.solve()


class Depth(Press):
    """Pressed to a depth."""

    key = kind = "depth"
    values, solver = (mdr.DepthPath,), ("indent", "max_depth")
    results = ("force", *Press.results)

    def equivalent(self, state, turning_point):
        return {"max_depth": float(turning_point.depth)}


class Force(Press):
    """Pressed to a force."""

    key = kind = "force"
    values, solver = (mdr.ForcePath,), ("indent_to_force", "max_force")
    results = ("depth", *Press.results)

    def equivalent(self, state, turning_point):
        return {"max_force": limited_force(turning_point)}
