"""A path of depth or of force through some vertices; in time also ramp and hold, and creep."""

from itertools import pairwise

import numpy as np

import mdr_core as mdr

from ..quantities import QUANTITIES
from ..trajectory import Trajectory, nearest, rounded
from ..units import written
from .chain import ChainStates
from .drive import Drive
from .press import most_force

#: What is prescribed: its kind of quantity, and its value of a scene.
KIND = {"depth": "length", "force": "force"}
_VALUE = {"depth": mdr.DepthPath, "force": mdr.ForcePath}
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


def _make(explorer):
    if not explorer.path:
        raise ValueError("Give the path some vertices.")
    return _drive(checked(explorer.path, explorer.prescribed), explorer.prescribed)


def _parts(drive):
    """What is prescribed, its values, and times or None."""
    name = "force" if isinstance(drive, mdr.ForcePath) else "depth"
    return name, np.atleast_1d(getattr(drive, name)), drive.time and np.array(drive.time)


def _opened(scene):
    name, values, time = _parts(scene.drive)
    path = list(zip(values.tolist(), *(() if time is None else [time.tolist()]), strict=True))
    choices = {"drive": "path", "pattern": "own", "prescribed": name, "surface": "virgin"}
    return choices | {"path": checked(path, name)}, {}


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
        force = most_force(explorer, deepest)["max_force"]
        return {"prescribed": "force", "path": [(0.0, 0.0), (force, 0.1 * time), (force, 5 * time)]}
    if option == "hold":
        path = [(0.0, 0.0), (depth, time), (depth, 5 * time)]
    elif option == "cycles":
        path = [(d,) for k in range(1, 6) for peak in (depth * k / 5,) for d in (peak, back(peak))]
    else:
        path = [(0.7 * depth,), (back(0.7 * depth),), (depth,), (back(depth),)]
    return {"prescribed": "depth", "path": path}


def _alike(explorer, deepest):
    """A path that was drawn by hand is kept."""
    own = explorer.pattern == "own"
    if own and explorer.path:
        return {}
    option = "reload" if own else explorer.pattern
    return {"pattern": option} | pattern(explorer, option)


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
    solve = mdr.indent_to_force if isinstance(scene.drive, mdr.ForcePath) else mdr.indent
    return solve(scene.profile, scene.medium, values)


def _deepest(scene):
    return _slowly(scene, float(np.max(_parts(scene.drive)[1])))


def _along(values, time):
    """How far along the path its points are: times, or how much has been changed."""
    return np.append(0.0, np.cumsum(np.abs(np.diff(values)))) if time is None else time


def _refined(scene, chain):
    """Values and places along the path of its vertices, and of more points between them."""
    name, values, time = _parts(scene.drive)
    values = values if time is not None else np.append(0.0, values)
    along, most, places = _along(values, time), 0.0, []
    states = _SLOW if not chain else _DEPTHS if name == "depth" else _FORCES
    each = min(max(states // (len(values) - 1), 1 if chain else 4), 32)
    critical, start = scene.medium.critical_depth, scene.medium.critical_depth
    if name == "force" and start <= min(scene.profile.deepest, 1e300):
        start = float(mdr.indent(scene.profile, scene.medium, start).force)
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


def _follow(scene, progress):
    """All states; under a force in time that dashpots resist infinitely slowly at first, see `_in_time`."""
    _, _, time = _parts(scene.drive)
    viscous = time is not None and scene.medium.eta > 0
    pending = viscous and isinstance(scene.drive, mdr.ForcePath)
    words = "so far without dashpots" * pending
    return _solved(scene, progress, viscous and not pending, words)


def _in_time(scene):
    """All states of a path whose dashpots take longer than a move."""
    return _solved(scene, 1.0, True, "")


def _solved(scene, progress, chain, pending):
    name, _, time = _parts(scene.drive)
    values, along = _refined(scene, chain)
    if chain:
        solve = mdr.creep if name == "force" else mdr.indent_in_time
        path = solve(scene.profile, scene.medium, values, along, tolerance=_TOLERANCE)
        states = ChainStates(path)
    else:
        states = _slowly(scene, values)
    share = (along - along[0]) / ((along[-1] - along[0]) or 1.0)
    peak = int(np.argmax(states.depth))
    turn = share[peak]
    way = np.where(share <= turn, share / (turn or 1.0), 1 + (share - turn) / ((1 - turn) or 1.0))
    way[peak] = 1.0
    way = rounded(way)
    motion = None if time is None else _motion(states, along)
    return Trajectory(scene, way, states, nearest(way, progress), peak, None, motion, True, pending)


def _motion(states, time):
    """The same in time, with a ledger of what has been put in."""
    none, live = np.zeros_like(time), states.live
    rate = np.append(0.0, np.diff(states.depth) / np.diff(time))
    viscous = none if isinstance(states, mdr.Indentation) else states.viscous_work
    return mdr.Motion(
        time, states.depth, rate, states.force, states.contact_radius, states.plastic_radius,
        live.lower, live.length, none, states.stored_energy, states.plastic_work, viscous,
    )  # fmt: skip


def _snippet(way, given, prefix):
    """The vertices that have been passed, and the present state."""
    name, values, time = _parts(way.scene.drive)
    here = float((way.force if name == "force" else way.states.depth)[way.now])
    if time is None:
        # A path without times begins at first contact.
        along = _along(np.append(0.0, values), None)
        present = _along(np.append(0.0, _refined(way.scene, False)[0]), None)[1:][way.now]
        passed = along[1:] < present * (1 - 1e-12)
    else:
        present = float(way.motion.time[way.now])
        passed = time < present
    path, unit = [*values[passed].tolist(), here], {"depth": "m", "force": "N"}[name]
    chain = time is not None and way.scene.medium.eta > 0
    solve = {"depth": ("indent", "indent_in_time"), "force": ("indent_to_force", "creep")}[name][chain]
    state, times = f"{prefix}state", f", {[*time[passed].tolist(), present]}" if chain else ""
    return [
        f"{state} = mdr.{solve}({given}, {path}{times})[-1]  # {unit}{', s' * chain}",
        f"print({state}.depth, {state}.force, {state}.contact_radius, {state}.plastic_radius)",
    ]


def _cells(way):
    if not isinstance(way.states, ChainStates):
        return []
    work = ("W_v", "viscous work", "energy", way.motion.viscous_work)
    return [work, ("ε", "error of the chain", "number", way.states.error)]


def _words(explorer):
    sizes = [row[0] for row in explorer.path]
    most = written(max(sizes), KIND[explorer.prescribed], 3)
    time = f" in {written(_duration(explorer), 'time', 3)}" if _duration(explorer) else ""
    return [f"path of {len(sizes)} vertices to {most}{time}"]


def _duration(explorer):
    timed = explorer.path and len(explorer.path[0]) == 2
    return explorer.path[-1][1] - explorer.path[0][1] if timed else None


PATH = Drive(
    make=_make,
    owns=lambda value: isinstance(value, mdr.DepthPath | mdr.ForcePath),
    opened=_opened,
    follow=_follow,
    deepest=_deepest,
    alike=_alike,
    snippet=_snippet,
    form=("pattern", "prescribed", "vertices"),
    cells=_cells,
    words=_words,
    duration=_duration,
    in_time=_in_time,
)
