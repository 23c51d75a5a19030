"""A path of depth or of force through some vertices; in time also ramp and hold, and creep."""

from itertools import pairwise

import numpy as np

import mdr_core as mdr

from ..quantities import QUANTITIES
from ..trajectory import Trajectory, nearest, onset, passed
from ..units import written
from .chain import ChainStates
from .drive import Drive
from .impact import printed
from .press import Depth, Force, most_force

#: What is prescribed: its kind of quantity, its value of a scene, its unit, and what of the core follows
#: it, infinitely slowly and in time.
KIND = {"depth": "length", "force": "force"}
_VALUE = {"depth": mdr.DepthPath, "force": mdr.ForcePath}
_UNIT = {"depth": "m", "force": "N"}
_SLOWLY = {"depth": "indent", "force": "indent_to_force"}
_IN_TIME = {"depth": "indent_in_time", "force": "creep"}
#: Most vertices, and about how many states are drawn: of a path without dashpots, on the chain under
#: prescribed depths, and under forces, where every one of them takes eight steps and more.
MOST, _SLOW, _DEPTHS, _FORCES = 60, 200, 48, 16
#: Error allowed on the chain: less than is seen.
_TOLERANCE = 3e-3


def _drive(path, prescribed):
    value, *time = zip(*path, strict=True)
    return _VALUE[prescribed](value, *time)


def checked(path, prescribed):
    """Vertices (SI), each a depth or force or such with its time, if they make a path within bounds."""
    if not 1 <= len(path) <= MOST or (len(path) == 1 and len(path[0]) == 2):
        raise ValueError(f"A path has 1 to {MOST} vertices, in time 2 at least; this one has {len(path)}.")
    if len({len(row) for row in path}) > 1:
        raise ValueError("Give a time at each vertex, or at none.")
    quantity = QUANTITIES[f"max_{prescribed}"]
    low, high = quantity.bounds
    if not low <= max(row[0] for row in path) or max(abs(row[0]) for row in path) > high:
        bounds = " to ".join(written(bound, quantity.kind) for bound in quantity.bounds)
        raise ValueError(f"The largest {prescribed} of a path is out of bounds: {bounds}.")
    _drive(path, prescribed)
    return [tuple(map(float, row)) for row in path]


def _parts(drive):
    """What is prescribed, its values, and times or None."""
    name = "force" if isinstance(drive, mdr.ForcePath) else "depth"
    return name, np.atleast_1d(getattr(drive, name)), drive.time and np.array(drive.time)


def pattern(explorer, option):
    """A path of some pattern whose deepest state is the present one, followed infinitely slowly."""
    if option == "own":
        return {}
    deepest, medium = explorer.solved(), explorer.medium()
    depth, time = float(deepest.depth), float(f"{medium.relaxation_time or 1.0:.2g}")

    def back(depth):
        # Until the load is gone.
        return max(depth - medium.critical_depth, 0.0)

    if option == "creep":
        force = most_force(deepest)
        return {"prescribed": "force", "path": [(0.0, 0.0), (force, 0.1 * time), (force, 5 * time)]}
    if option == "hold":
        path = [(0.0, 0.0), (depth, time), (depth, 5 * time)]
    elif option == "cycles":
        path = [(d,) for k in range(1, 6) for peak in (depth * k / 5,) for d in (peak, back(peak))]
    else:
        path = [(0.7 * depth,), (back(0.7 * depth),), (depth,), (back(depth),)]
    return {"prescribed": "depth", "path": path}


def prescribed(explorer, option):
    """The vertices by the other quantity, as they are infinitely slowly."""
    if explorer.drive != "path" or not explorer.path:
        return {}
    scene = explorer.scene()
    _, values, _ = _parts(scene.drive)
    states = _slowly(scene, values)
    found = np.maximum(getattr(states, option), 0.0 if option == "force" else -np.inf).tolist()
    path = [(value, *row[1:]) for value, row in zip(found, explorer.path, strict=True)]
    return {"path": checked(path, option), "pattern": "own"}


def _slowly(scene, values):
    solve = getattr(mdr, _SLOWLY[_parts(scene.drive)[0]])
    return solve(scene.profile, scene.medium, values)


def _course(drive):
    """Values of a path, without times from first contact on, and how far along it they are.

    That is their times, or how much has been changed.
    """
    _, values, time = _parts(drive)
    if time is not None:
        return values, time
    values = np.append(0.0, values)
    return values, np.append(0.0, np.cumsum(np.abs(np.diff(values))))


def _refined(scene, chain):
    """Values and places along the path of its vertices, and of more points between them."""
    (name, *_), (values, along) = _parts(scene.drive), _course(scene.drive)
    most, places = 0.0, []
    states = _SLOW if not chain else _DEPTHS if name == "depth" else _FORCES
    each = min(max(states // (len(values) - 1), 1 if chain else 4), 32)
    critical, begun = scene.medium.critical_depth, onset(scene)
    start = critical if name == "depth" or begun is None else float(begun.force)
    for (begin, first), (end, last) in pairwise(zip(along, values, strict=True)):
        share = np.linspace(0, 1, each + 1)
        # Dashpots change most where a piece begins.
        share = share**2 if chain else share
        if first != last and not (chain and name == "force"):
            # Just before yield begins or goes on, and on both sides of where the load is gone.
            gone, elastic = 0.0, most
            if name == "depth":
                gone, elastic = max(most - critical, 0.0), min(critical, most)
            before = 1 - 1e-12
            events = np.array([before * start, before * most, gone, gone + 1e-9 * elastic])
            events = (events - first) / (last - first)
            share = np.append(share, events[(events > 0) & (events < 1)])
        places.append(begin + (end - begin) * share)
        most = max(most, last)
    places = np.unique(np.append(np.concatenate(places), along))
    return np.interp(places, along, values), places


def _solved(scene, progress, chain, pending):
    name, _, time = _parts(scene.drive)
    values, along = _refined(scene, chain)
    if chain:
        solve = getattr(mdr, _IN_TIME[name])
        path = solve(scene.profile, scene.medium, values, along, tolerance=_TOLERANCE)
        states = ChainStates(path)
    else:
        states = _slowly(scene, values)
    peak = int(np.argmax(states.depth))
    way = passed(along, peak)
    motion = None if time is None else _motion(states, along)
    return Trajectory(scene, way, states, nearest(way, progress), peak, None, motion, True, pending)


def _motion(states, time):
    """The same in time, with a ledger of what has been put in."""
    none, live = np.zeros_like(time), states.live_interval
    rate = np.append(0.0, np.diff(states.depth) / np.diff(time))
    viscous = none if isinstance(states, mdr.Indentation) else states.viscous_work
    return mdr.Motion(
        time, states.depth, rate, states.force, states.contact_radius, states.plastic_radius,
        live.lower, live.length, none, states.stored_energy, states.plastic_work, viscous,
    )  # fmt: skip


class Path(Drive):
    """Pressed along a path."""

    values = (mdr.DepthPath, mdr.ForcePath)
    form = ("pattern", "prescribed", "vertices")

    def make(self, explorer):
        if not explorer.path:
            raise ValueError("Give the path some vertices.")
        return _drive(checked(explorer.path, explorer.prescribed), explorer.prescribed)

    def opened(self, scene):
        name, values, time = _parts(scene.drive)
        if time is None and (values.size == 1 or (values.size == 2 and values[1] < values[0])):
            return {"depth": Depth, "force": Force}[name]().opened(scene)
        path = list(zip(values.tolist(), *(() if time is None else [time.tolist()]), strict=True))
        choices = {"drive": "path", "pattern": "own", "prescribed": name, "surface": "virgin"}
        return choices | {"path": checked(path, name)}, {}

    def follow(self, scene, progress):
        """All states; under a force in time that dashpots resist infinitely slowly at first."""
        viscous = scene.drive.time is not None and scene.medium.eta > 0
        pending = viscous and isinstance(scene.drive, mdr.ForcePath)
        return _solved(scene, progress, viscous and not pending, "so far without dashpots" * pending)

    def in_time(self, scene):
        return _solved(scene, 1.0, True, "")

    def deepest(self, scene):
        return _slowly(scene, float(np.max(_parts(scene.drive)[1])))

    def alike(self, explorer, deepest):
        """A path that was drawn by hand is kept."""
        own = explorer.pattern == "own"
        if own and explorer.path:
            return {}
        option = "reload" if own else explorer.pattern
        return {"pattern": option} | pattern(explorer, option)

    def snippet(self, way, given, prefix):
        """The vertices that have been passed, and the present state."""
        name, _, time = _parts(way.scene.drive)
        values, along = _course(way.scene.drive)
        places = _refined(way.scene, False)[1] if time is None else way.motion.time
        here = way.force if name == "force" else way.states.depth
        # First contact is none of the vertices.
        passed = (along > 0) | (time is not None)
        passed &= along < places[way.now] - 1e-12 * (places[-1] - places[0])
        chain, state = time is not None and way.scene.medium.eta > 0, f"{prefix}state"
        given += f", {[*values[passed].tolist(), float(here[way.now])]}"
        given += f", {[*along[passed].tolist(), float(places[way.now])]}" * chain
        solve, unit = (_IN_TIME if chain else _SLOWLY)[name], _UNIT[name] + ", s" * chain
        told = ("depth", "force", "contact_radius", "plastic_radius")
        return [f"{state} = mdr.{solve}({given})[-1]  # {unit}", printed(state, told)]

    def cells(self, way):
        if not isinstance(way.states, ChainStates):
            return []
        work = ("W_v", "viscous work", "energy", way.motion.viscous_work)
        return [work, ("ε", "error of the chain", "number", way.states.error)]

    def words(self, explorer):
        sizes, time = [row[0] for row in explorer.path], self.duration(explorer)
        most = written(max(sizes), KIND[explorer.prescribed], 3)
        within = f" in {written(time, 'time', 3)}" if time else ""
        return [f"path of {len(sizes)} vertices to {most}{within}"]

    def duration(self, explorer):
        path = explorer.path
        return path[-1][1] - path[0][1] if path and len(path[0]) == 2 else None
