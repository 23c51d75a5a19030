"""Pressed to a depth or to a force, and taken back, infinitely slowly."""

import numpy as np

import mdr_core as mdr
from mdr_core.yielding import LiveInterval, live_interval

from ..trajectory import LAST_PROGRESS, Trajectory, nearest, rounded
from .drive import Drive
from .impact import printed

#: From 0 to 1, denser towards both ends.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2


def most_force(deepest):
    """The force of a state, if it is less than what a flat face carries."""
    most = 2 * deepest.medium.yield_line_load * deepest.profile.wall
    return min(float(deepest.force), 0.9 * most)


class Press(Drive):
    """To a largest value of what is prescribed, its `kind`, and back."""

    results = (
        "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure", "stiffness", "stored_energy",
        "plastic_work",
    )  # fmt: skip

    def make(self, explorer):
        return self.values[0](getattr(explorer, f"max_{self.kind}"))

    def owns(self, value):
        """Whether it is one value; what has vertices is a path."""
        return super().owns(value) and np.ndim(getattr(value, self.kind)) == 0

    def opened(self, scene):
        """One value, or one and on to a smaller one.

        All that the way there leaves behind is the largest depth: the last state is one of unloading.
        """
        path = np.atleast_1d(getattr(scene.drive, self.kind))
        choices = {"drive": self.kind, "surface": "virgin"}
        if path[-1] < max(path):
            solved = scene.solve().depth
            largest, rest = float(max(solved)), float(solved[-1])
            recovered = min(scene.medium.critical_depth, largest)
            back = (largest - rest) / recovered
            lifted = 2.2 - 0.2 * rest / max(largest - recovered, 1e-300)
            choices["progress"] = min(max(1 + back if back <= 1 else lifted, 1.0), LAST_PROGRESS)
        return choices, {f"max_{self.kind}": float(max(path))}

    def follow(self, scene, progress):
        """To the deepest state, back until the load is gone, and up to the undeformed surface."""
        deepest = scene.solve()
        depth, critical = float(deepest.depth), scene.medium.critical_depth
        share = min(critical / depth, 1.0) if depth > 0 else 1.0
        loading = np.concatenate([share * _SPREAD, share + (1 - share) * _SPREAD])
        lifted = 2 + 0.2 * np.linspace(0, 1, 9)
        way = np.unique(rounded(np.concatenate([loading, 1 + _SPREAD, lifted, [progress]])))
        live = live_interval((np.minimum(way, 1.0) * depth)[:, None], critical)[:, 0]
        # By its length, which is exactly zero where the load is gone.
        length = np.clip(2 - way, 0.0, 1.0) * live.length
        upper = np.where(way <= 1, live.upper, live.lower + length)
        lifted = np.where(way <= 2, upper, live.lower * np.maximum(2.2 - way, 0.0) / 0.2)
        interval = LiveInterval(live.lower, upper, length)
        states = mdr.Indentation(scene.profile, scene.medium, lifted, interval)
        return Trajectory(scene, way, states, nearest(way, progress), nearest(way, 1.0))

    def deepest(self, scene):
        return scene.solve()

    def snippet(self, way, given, prefix):
        path = way.states.depth[[way.peak, way.now] if way.now > way.peak else [way.now]].tolist()
        state = f"{prefix}state"
        solved = f"{state} = mdr.indent({given}, {path})[-1]  # m"
        return [solved, printed(state, ("force", "contact_radius", "plastic_radius"))]

    def saved(self, way):
        """Pressed to its largest value and, if need be, on to the present one."""
        drive, now, peak = way.scene.drive, way.now, way.peak
        if now == peak:
            return drive
        along = way.force if self.kind == "force" else way.states.depth
        return type(drive)(along[[now]] if now < peak else along[[peak, now]])


class Depth(Press):
    """Pressed to a depth."""

    kind, values, solver = "depth", (mdr.DepthPath,), ("indent", "max_depth")
    results = ("force", *Press.results)

    def alike(self, explorer, deepest):
        return {"max_depth": float(deepest.depth)}


class Force(Press):
    """Pressed to a force."""

    kind, values, solver = "force", (mdr.ForcePath,), ("indent_to_force", "max_force")
    results = ("depth", *Press.results)

    def alike(self, explorer, deepest):
        return {"max_force": most_force(deepest)}
