"""Quasi-static loading to a depth or force, and unloading."""

from dataclasses import replace

import numpy as np

import mdr_core as mdr

from . import Course, Drive, nearest, rounded, unloaded

#: Places from 0 to 1, dense at both ends, where radii change as a root of the depth.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2


def limited_force(turning_point):
    """Force (N) of a state, limited to 90 % of the yield load of a flat face."""
    most = 2 * turning_point.medium.yield_line_load * turning_point.profile.wall
    return min(float(turning_point.force), 0.9 * most)


def slow(scene, progress, turning_point, hit=None):
    """Course of slow loading to a state, unloading to the pull-off, and lifting of the indenter."""
    depth, critical = float(turning_point.depth), scene.medium.critical_depth
    share = min(critical / depth, 1.0) if depth > 0 else 1.0
    loading = np.concatenate([share * _SPREAD, share + (1 - share) * _SPREAD])
    # With adhesion the force jumps to zero at the pull-off.
    lifted = 2 + 0.2 * np.append(5e-5, np.linspace(0, 1, 9))
    places = np.unique(rounded(np.concatenate([loading, 1 + _SPREAD, lifted, [progress]])))
    path = mdr.indent(scene.profile, scene.medium, np.minimum(places, 1.0) * depth)
    touching = places <= 2
    states = unloaded(scene, path.live_interval, np.clip(2 - places, 0.0, 1.0), touching)
    start = states.depth[touching][-1]
    end = min(2 * start, 0.0)
    lifted = end + (start - end) * np.maximum(2.2 - places, 0.0) / 0.2
    states = replace(states, depth=np.where(touching, states.depth, lifted))
    return Course(scene, places, states, nearest(places, progress), nearest(places, 1.0), hit)


class Press(Drive):
    """Quasi-static loading to a depth or force, and unloading."""

    def follow(self, scene, progress):
        """Loading, unloading, and lifting of the indenter to the undeformed surface."""
        return slow(scene, progress, scene.solve())

    def turning_point(self, scene):
        return scene.solve()


class Depth(Press):
    """Pressed to a depth."""

    solver = ("indent", "max_depth")

    def make(self, state, medium):
        return mdr.DepthPath(state.max_depth)

    def equivalent(self, state, turning_point):
        return {"max_depth": float(turning_point.depth)}


class Force(Press):
    """Pressed to a force."""

    solver = ("indent_to_force", "max_force")

    def make(self, state, medium):
        return mdr.ForcePath(state.max_force)

    def equivalent(self, state, turning_point):
        return {"max_force": limited_force(turning_point)}
