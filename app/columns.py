"""Columns of the plots (SI), by the names of their rows, from a `View` and the number of a state.

x and y of a line, an area or a mark; x, y and text of a label; ends along x and y and values of an image.
Rows that are not given are empty.
"""

from functools import partial
from itertools import pairwise

import numpy as np

from mdr_core.results import figures
from mdr_core.results.figures import both, split

from . import friction, measured, references
from .drives.chain import ChainStates

#: Pixels of the map along each side.
PIXELS = 64


def _relaxing(view, i, g):
    """What is left (m) of the elastic compression of elements that have let go of a viscous rebound."""
    way, tau = view.way, view.way.scene.medium.relaxation_time
    if isinstance(way.states, ChainStates):
        return way.states[i].relaxing(g)
    if way.hit is None or tau == 0 or i <= way.peak:
        return 0.0
    past = slice(way.peak, i + 1)
    upper, time = way.states.live_interval.upper[past], way.motion.time[past]
    ahead = way.states.depth[past] - upper
    gone = np.minimum(np.searchsorted(-upper, -g), len(upper) - 1)
    return np.where(g >= upper[-1], ahead[gone] * np.exp((time[gone] - time[-1]) / tau), 0.0)


def springs(view, i):
    state = view.way.states[i]
    along = None if view.way.oblique is None else partial(friction.leaning, view.way, i)
    size = view.end["x"], view.end["z"]
    return figures.springs(state, *size, lambda g: _relaxing(view, i, g), along)


def _curve(way, until=None):
    """The curve of force and depth in parts, all of it or until some state."""
    depth, past = way.states.depth, slice(until)
    return split(depth[past], way.force[past], depth[past], way.states.live_interval.lower[past])


def force_still(view):
    way, onset = view.way, view.way.onset
    rows = {"path ahead": (way.states.depth, way.force)} if way.turns else _curve(way)
    if onset is not None and (way.motion is None or way.scene.medium.eta == 0):
        rows["onset of yield"] = np.array([onset.depth]), np.array([onset.force])
    if view.curve is not None:
        rows["measured"] = measured.row(view.curve.depth, view.curve.force)
    return rows | view.held_on("d", "F") | references.curves(view)


def force(view, i):
    way, right, lower = view.way, 0.02 * view.end["d"], float(view.way.states.live_interval.lower[i])
    rows = {"now": view.mark(i, "d", "F"), "dₚ": (np.nan, np.nan, "")}
    if lower > 0:
        rows["dₚ"] = max(lower - 3 * right, right), 0.09 * view.end["F"], "dₚ"
    rows |= _curve(way, i + 1) if way.turns else {}
    if isinstance(way.states, ChainStates):
        # Areas below these curves are energies of the dashpots, too.
        return rows
    past = np.flatnonzero(way.deeper[: i + 1])
    (lost_d, lost_F), (back_d, back_F) = (way.released(k) for k in (past[-1], i))
    d, F = way.states.depth[past], way.force[past]
    lost = np.concatenate([d[:1], d, lost_d]), np.concatenate([[0.0], F, lost_F])
    elastic = lower == way.before and way.scene.medium.eta == 0
    return rows | {
        "dissipated": figures.NOTHING if elastic else lost,
        "recoverable": (np.append(back_d[:1], back_d), np.append(0.0, back_F)),
    }


def logarithmic_still(view):
    return {name: _beyond_zero(view, *row) for name, row in force_still(view).items()}


def logarithmic(view, i):
    return {"now": _beyond_zero(view, *view.mark(i, "d", "F"))}


def _beyond_zero(view, d, F):
    """A curve as far as logarithmic axes reach towards zero."""
    seen = np.minimum(d / view.axes["log d"].start, F / view.axes["log F"].start) >= 1
    return np.where(seen, d, np.nan), np.where(seen, F, np.nan)


def pressure(view, i):
    half, top = view.end["x"], view.end["p"]
    rows = figures.pressure(view.way.states[i], *view.pressure(i), half, top)
    return rows | {"beyond": (-0.97 * half, 0.98 * top, view.beyond(i))}


def pressure_still(view):
    def held(way, over):
        r = figures.radii(way.state, view.end["x"] / over("r", 1.0))
        p = np.minimum(over("p", way.state.pressure(r)), 1e3 * view.end["p"])
        return both(over("r", r), -1), both(p)

    return view.of_held("", held)


def _zone(way):
    """Loading, unloading and plastic zone: the contact radius falls by a step where the load is gone."""
    depth, a, c = way.states.depth, way.states.contact_radius, way.states.plastic_radius
    if way.turns:
        rows = split(depth, a, depth, way.states.live_interval.lower)
        loading = np.concatenate([rows["elastic"], [[np.nan]] * 2, rows["yielding"]], axis=1)
        return tuple(loading), rows["unloading"], (depth[way.deeper], c[way.deeper])
    peak, gone = way.peak, int(np.flatnonzero(way.states.live_interval.length > 0)[-1]) + 1
    last = c[-1:] if way.states.live_interval.lower[-1] > 0 else a[gone : gone + 1]
    back = np.append(depth[peak : gone + 1], depth[gone:])
    past = slice(peak + 1)
    falling = np.concatenate([a[peak:gone], last, 0 * depth[gone:]])
    return (depth[past], a[past]), (back, falling), (depth[past], c[past])


def radii_still(view):
    loading, back, (d, c) = _zone(view.way)
    # From the last state on that has not yielded.
    first = int(np.searchsorted(np.flatnonzero(view.way.deeper), view.first))
    some = slice(max(first - 1, 0), None) if view.first <= view.way.peak else slice(0, 0)
    d, c = d[some], c[some]
    rows = {"contact radius a": loading, "unloading": back, "plastic zone c": (d, c)}
    rows["zone"] = np.append(d, [*d[-1:], *d[:1]]), np.append(c, [0, 0][: 2 * len(d)])

    def held_a(way, over):
        loading, back, _ = _zone(way)
        d, a = map(np.append, loading, back)
        return over("d", d), over("a", a)

    def held_c(way, over):
        d, c = _zone(way)[2]
        return over("d", d), over("a", c)

    return rows | view.of_held(" a", held_a) | view.of_held(" c", held_c)


def radii_marks(view, i):
    depth, a = view.mark(i, "d", "a")
    c = view.way.states.plastic_radius[[i]]
    return {"now": (depth, a), "c now": (depth, np.where(c > 0, c, np.nan))}


def motion_still(view):
    on = view.way.on
    return {"depth d": (on["t"], on["d"]), "force F": (on["t"], on["F"])} | view.held_on("t", "F")


def motion(view, i):
    marks = {"now": view.mark(i, "t", "d"), "F now": view.mark(i, "t", "F")}
    return marks | {"time": view.time(i, "d")}


def energy_still(view):
    m = view.way.ledger
    slip = 0 * m.time if view.way.oblique is None else m.friction_work
    parts = slip, m.plastic_work, m.viscous_work, m.stored_energy, m.kinetic_energy
    sums = np.cumsum([np.zeros_like(m.time), *parts], axis=0)
    time = np.append(m.time, m.time[::-1])
    between = [(time, np.append(upper, lower[::-1])) for lower, upper in pairwise(sums)]
    # What is nothing but rounding is not in the legend.
    some = [part.max() > 1e-9 * sums.max() for part in parts]
    rows = [row if there else figures.NOTHING for row, there in zip(between, some, strict=True)]
    return dict(zip(("friction", "plastic", "viscous", "stored", "kinetic"), rows, strict=True))


def plane(view, i):
    half, state = view.end["x"], view.way.states[i]
    r, p = view.pressure(i)
    at = half * (2 * (np.arange(PIXELS) + 0.5) / PIXELS - 1)
    image = np.interp(np.hypot(at, at[:, None]), r, np.minimum(p, view.end["p"]), right=0.0)
    turn, ends = np.linspace(0, 2 * np.pi, 73), np.array([-half, half])
    a, c = state.contact_radius, state.plastic_radius or np.nan
    return {
        "image": (ends, ends, image),
        "contact radius a": (a * np.cos(turn), a * np.sin(turn)),
        "plastic zone c": (c * np.cos(turn), c * np.sin(turn)),
    }
