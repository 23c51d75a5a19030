"""Pressed to a depth or to a force, and taken back, infinitely slowly."""

from functools import partial

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval, live_interval

from ..trajectory import LAST_PROGRESS, Trajectory, nearest, rounded
from .drive import Drive


def spread(count):
    """From 0 to 1, denser towards both ends."""
    return (1 - np.cos(np.linspace(0, np.pi, count))) / 2


def _follow(scene, progress):
    """To the deepest state, back until the load is gone, and up to the undeformed surface."""
    deepest = scene.solve()
    depth, critical = float(deepest.depth), scene.medium.critical_depth
    share = min(critical / depth, 1.0) if depth > 0 else 1.0
    loading = np.concatenate([share * spread(41), share + (1 - share) * spread(41)])
    lifted = 2 + 0.2 * np.linspace(0, 1, 9)
    way = np.unique(rounded(np.concatenate([loading, 1 + spread(41), lifted, [progress]])))
    live = live_interval((np.minimum(way, 1.0) * depth)[:, None], critical)[:, 0]
    # By its length, which is exactly zero where the load is gone.
    length = np.clip(2 - way, 0.0, 1.0) * live.length
    upper = np.where(way <= 1, live.upper, live.lower + length)
    lifted = np.where(way <= 2, upper, live.lower * np.maximum(2.2 - way, 0.0) / 0.2)
    states = mdr.Indentation(scene.profile, scene.medium, lifted, LiveInterval(live.lower, upper, length))
    return Trajectory(scene, way, states, nearest(way, progress), nearest(way, 1.0))


def _single(value, kind):
    """Whether a path presses once: to one value, or on from it to a smaller one."""
    path = np.atleast_1d(getattr(value, kind, ()))
    return not value.time and (path.size == 1 or (path.size == 2 and path[1] < path[0]))


def _quantity(drive):
    """What is prescribed, "depth" or "force", and its path as an array."""
    name = "force" if isinstance(drive, mdr.ForcePath) else "depth"
    return name, np.atleast_1d(getattr(drive, name))


def _opened(scene):
    """All that the way there leaves behind is the largest depth: the last state is one of unloading."""
    kind, path = _quantity(scene.drive)
    choices = {"drive": kind, "surface": "virgin"}
    if path[-1] < max(path):
        solved = mdr.Scene(scene.profile, scene.medium, type(scene.drive)(path)).solve().depth
        largest, rest = float(max(solved)), float(solved[-1])
        recovered = min(scene.medium.critical_depth, largest)
        back = (largest - rest) / recovered
        lifted = 2.2 - 0.2 * rest / max(largest - recovered, 1e-300)
        choices["progress"] = min(max(1 + back if back <= 1 else lifted, 1.0), LAST_PROGRESS)
    return choices, {f"max_{kind}": float(max(path))}


def most_force(explorer, deepest):
    """The force of a state, if it is less than what a flat face carries."""
    most = 2 * deepest.medium.yield_line_load * deepest.profile.wall
    return {"max_force": min(float(deepest.force), 0.9 * most)}


def _snippet(way, given, prefix):
    path = way.states.depth[[way.peak, way.now] if way.now > way.peak else [way.now]].tolist()
    state = f"{prefix}state"
    return [
        f"{state} = mdr.indent({given}, {path})[-1]  # m",
        f"print({state}.force, {state}.contact_radius, {state}.plastic_radius)",
    ]


def _saved(way):
    """Pressed to its largest value and, if need be, on to the present one."""
    drive, now, peak = way.scene.drive, way.now, way.peak
    if now == peak:
        return drive
    along = way.force if isinstance(drive, mdr.ForcePath) else way.states.depth
    return type(drive)(along[[now]] if now < peak else along[[peak, now]])


_RESULTS = (
    "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure", "stiffness", "stored_energy",
    "plastic_work",
)  # fmt: skip
_PRESSED = partial(
    Drive,
    opened=_opened, follow=_follow, deepest=lambda scene: scene.solve(), snippet=_snippet, saved=_saved,
)  # fmt: skip
DEPTH = _PRESSED(
    make=lambda explorer: mdr.DepthPath(explorer.max_depth),
    owns=lambda value: isinstance(value, mdr.DepthPath) and _single(value, "depth"),
    alike=lambda explorer, deepest: {"max_depth": float(deepest.depth)},
    solver=("indent", "max_depth"),
    results=("force", *_RESULTS),
)
FORCE = _PRESSED(
    make=lambda explorer: mdr.ForcePath(explorer.max_force),
    owns=lambda value: isinstance(value, mdr.ForcePath) and _single(value, "force"),
    alike=most_force,
    solver=("indent_to_force", "max_force"),
    results=("depth", *_RESULTS),
)
