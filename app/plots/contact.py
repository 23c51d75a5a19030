"""The contact in one state: springs, pressure, radii, and an oblique view of the pressure."""

import numpy as np

from mdr_core.results import figures
from mdr_core.results.figures import NOTHING, area, both, label, line, mark, split

from ..drives import Course
from ..state.units import written
from .plot import Plot, View, held_rows

#: Cuts through the pressure over the plane, points along each, and how far the last one is moved: to the
#: right in shares of the width, and up in shares of the height.
_CUTS, _POINTS, _RIGHT, _UP = 25, 61, 0.22, 0.25


def relaxing(course: Course, i: int, g):
    """Remaining elastic compression (m) of released elements."""
    tau = course.scene.medium.relaxation_time
    if course.chained:
        return course.states[i].relaxing(g)
    if course.hit is None or tau == 0 or i <= course.peak:
        return 0.0
    past = slice(course.peak, i + 1)
    upper, time = course.states.live_interval.upper[past], course.motion.time[past]
    ahead = course.states.depth[past] - upper
    released = np.minimum(np.searchsorted(-upper, -g), len(upper) - 1)
    return np.where(g >= upper[-1], ahead[released] * np.exp((time[released] - time[-1]) / tau), 0.0)


def leaning(course: Course, i: int, r):
    """Tangential displacement (m) of elements in state i, and whether they stick."""
    m, medium = course.oblique, course.scene.medium
    # The first element is a flat face; most shapes have none.
    first = int(m.x[0] == 0)
    load, sticks = (
        np.interp(r, m.x[first:], part[i, first:]) for part in (m.tangential_line_load, m.sticks)
    )
    return load / (medium.tangential_ratio * medium.E_star), sticks > 0.5


def springs(view: View, i: int) -> dict:
    """Springs by their state; under friction they lean, with marks of stick and slip."""
    course, state = view.course, view.course.states[i]
    size = view.end("x"), view.end("z")
    along = None if course.oblique is None else lambda r: leaning(course, i, r)
    rows = figures.springs(state, *size, lambda g: relaxing(course, i, g), along)
    rows["handle"] = _rim(state)
    return rows if along is None else rows | _feet(state, rows, *size)


def _rim(state):
    """Place of the rim of the contact; without contact, of the tip."""
    a = float(state.contact_radius)
    height = float(state.live_interval.upper) if a > 0 else 0.0
    return np.array([a]), np.array([height - float(state.depth)])


def _feet(state, rows: dict, half: float, height: float) -> dict:
    """Leaning springs, and lines below those that stick or slip."""
    found, width = {}, 0.8 * half / figures.SPRINGS
    paths = [np.reshape(part, (-1, 9)) for part in (np.hstack([rows["sticks"], rows["slips"]]))]
    yielded = figures.reduced(state.profile, np.abs(paths[0][:, 0])) < state.live_interval.lower
    for name, subset in (("elastic", ~yielded), ("yielded", yielded)):
        leaning = [part[subset].ravel() for part in paths]
        found[name] = tuple(np.append(part, more) for part, more in zip(rows[name], leaning, strict=True))
    for name in ("sticks", "slips"):
        foot = rows[name][0].reshape(-1, 9)[:, 0]
        ends = foot[:, None] + np.array([-width, width, np.nan])
        found[name] = ends.ravel(), np.full(ends.size, -0.97 * figures.REST * height)
    return found


def _spring_formula(course: Course) -> str:
    if course.adhesive:
        return "q = E* (u − Δl),  Δl = √(2π a w/E*)  § 19"
    law = "(1) (17) (18)  q = E* u + 4η du/dt" if course.dashpots else "(17) (18)  q = E* u"
    return f"{law},  u ≤ d_c the elastic part" + (";  |q_x| ≤ μ q  § 13" if course.oblique else "")


SPRINGS = Plot(
    "springs", "1D foundation", _spring_formula, ("x", "z"),
    (
        *figures.SPRING_ROWS, line("sticks", "stick", 4.0), line("slips", "slip", 4.0),
        mark("handle", legend=False),
    ),
    moving=springs,
)  # fmt: skip


def pressure(view: View, i: int) -> dict:
    half, top = view.end("x"), view.end("p")
    rows = figures.pressure(view.course.states[i], *view.pressure(i), half, top)
    return rows | {"exceeds": (-0.97 * half, 0.98 * top, view.exceeds(i))}


def _held_pressure(view: View) -> dict:
    def columns(course):
        r = figures.radii(course.state, view.end("x"))
        return both(r, -1), both(figures.cut(course.state.pressure(r), view.end("p")))

    return view.held_curves("", columns)


PRESSURE = Plot(
    "pressure", "Contact pressure", "(10)  σ_zz(r) = (1/π) ∫ q′(x) dx/√(x² − r²)", ("r", "p"),
    (*held_rows("−σzz"), *figures.PRESSURE_ROWS, label("exceeds")), _held_pressure, pressure,
)  # fmt: skip


def _loading(course: Course):
    """Depths and contact radii of loading, dense at the start, where a(d) is vertical."""
    depth, a = course.states.depth[: course.peak + 1], course.states.contact_radius[: course.peak + 1]
    if course.motion is None:
        return depth, a
    start = course.initial_plastic_depth
    fine = start + (depth[-1] - start) * np.linspace(0, 1, 81) ** 2
    return np.append(fine[:1], fine), np.append(a[:1], course.scene.profile.contact_radius(fine))


def zone(course: Course):
    """Loading, unloading and plastic radius over depth; a falls by a step when contact is lost."""
    depth, a, c = course.states.depth, course.states.contact_radius, course.states.plastic_radius
    deeper = depth >= np.maximum.accumulate(depth)
    if course.turns:
        rows = split(depth, a, depth, course.states.live_interval.lower)
        loading = np.concatenate([rows["elastic"], [[np.nan]] * 2, rows["yielding"]], axis=1)
        return tuple(loading), rows["unloading"], (depth[deeper], c[deeper])
    peak, released = course.peak, int(np.flatnonzero(course.states.live_interval.length > 0)[-1]) + 1
    last = c[-1:] if course.states.live_interval.lower[-1] > 0 else a[released : released + 1]
    back = np.append(depth[peak : released + 1], depth[released:])
    past = slice(peak + 1)
    falling = np.concatenate([a[peak:released], last, 0 * depth[released:]])
    return _loading(course), (back, falling), (depth[past], c[past])


def radii_still(view: View) -> dict:
    loading, back, (d, c) = zone(view.course)
    # From the last state on that has not yielded.
    yielded_states = np.flatnonzero(c > c[0])
    subset = slice(max(int(yielded_states[0]) - 1, 0), None) if yielded_states.size else slice(0, 0)
    d, c = d[subset], c[subset]
    rows = {"contact radius a": loading, "unloading": back, "plastic zone c": (d, c)}
    rows["zone"] = np.append(d, [*d[-1:], *d[:1]]), np.append(c, [0, 0][: 2 * len(d)])

    def held_a(course):
        return tuple(map(np.append, *zone(course)[:2]))

    return rows | view.held_curves(" a", held_a) | view.held_curves(" c", lambda course: zone(course)[2])


def radii_marks(view: View, i: int) -> dict:
    depth, a = view.mark(i, "d", "a")
    c = view.course.states.plastic_radius[[i]]
    return {"now": (depth, a), "c now": (depth, np.where(c > 0, c, np.nan))}


def _radii_formula(course: Course) -> str:
    if course.adhesive:
        return "(21)  g(a) = d + Δl,  g(c) = d_p  § 19"
    return "(16) (21)  g(a) = d,  g(c) = d_p"


RADII = Plot(
    "radii", "Contact and plastic zone", _radii_formula, ("d", "a"),
    (
        area("zone", "yielded", 0.13, legend=False),
        *held_rows("a", what=" a"),
        *held_rows("c", what=" c", width=0.9, legend=False),
        line("unloading", "elastic", 1.8, "dashed", "a"),
        line("contact radius a", "elastic", 2.2, symbol="a"),
        line("plastic zone c", "yielded", 3.0, symbol="c"),
        mark("now"),
        mark("c now", legend=False),
    ),
    radii_still, radii_marks, tab=("Radii", "a"),
)  # fmt: skip


def relief(view: View, i: int) -> dict:
    """Cuts through the pressure over the plane, from back to front."""
    state, half, end = view.course.states[i], view.end("across"), view.end("oblique")
    r, p = view.pressure(i)
    a, c = float(state.contact_radius), float(state.plastic_radius)
    rows = {}
    for k, y in enumerate(np.linspace(1, -1, _CUTS) * 1.02 * (a or 0.8 * half)):
        back = (y / half + 1) / 2
        edges = [np.sqrt(max(radius**2 - y * y, 0.0)) for radius in (a, c)]
        for name, reach in (("cut", half), ("zone", edges[1])):
            x = np.unique([*np.linspace(-reach, reach, _POINTS), *edges, *(-edge for edge in edges)])
            x = x[np.abs(x) <= reach]
            over = np.interp(np.hypot(x, y), r, np.clip(p, 0.0, view.end("p")), right=0.0)
            at = (1 - _RIGHT) * x + _RIGHT * half * (2 * back - 1)
            closed = np.append(at, at[::-1]), _UP * end * back + np.append(over, 0 * x)
            rows[f"{name} {k}"] = closed if reach > 0 else NOTHING
    text = f"largest −σzz: {written(float(np.max(p)), 'pressure', 3)}"
    return rows | {"largest": (-0.97 * half, 0.98 * end, text)}


_CUT_ROWS = tuple(
    area(f"{name} {k}", role, alpha, legend=False)
    for k in range(_CUTS)
    for name, role, alpha in (("cut", "cut", 1.0), ("zone", "yielded", 0.35))
)
RELIEF = Plot(
    "relief", "Pressure over the plane, seen obliquely", "(10)  −σ_zz(√(x² + y²));  zone: orange",
    ("across", "oblique"), (*_CUT_ROWS, label("largest")), moving=relief, tab=("Relief", "i"),
)  # fmt: skip
