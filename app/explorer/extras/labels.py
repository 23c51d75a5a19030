"""Labels on the curves and areas of the three plots, instead of a legend; and the state in words."""

from typing import Any

import numpy as np

from mdr_core.show.figures import NOTHING, label, line, word
from mdr_core.show.springs import reduced
from mdr_core.show.units import format_quantity
from mdr_core.solver.contact.unloading import unloading_curve

from ..courses import Course, onset_depth
from ..extra import Extra
from ..plot import HEIGHT, LINE, WIDTH, AxisSpec, Overlay, View, width
from ..plots import STRIP, D, F, P, R, X, Z


def sentence(course: Course, i: int) -> str:
    """Return the radius of yield and the width of the elastic ring, or place and depth of first yield."""
    a, c = (float(radii[i]) for radii in (course.states.contact_radius, course.states.plastic_radius))
    if a == 0:
        return f"no contact; imprint of radius c = {format_quantity(c, 'length', 3)}" if c else "no contact"
    if c == 0:
        return f"elastic; {_first(course)}"
    inside = f"yielded inside c = {format_quantity(c, 'length', 3)}"
    return inside if a <= c else f"{inside}; elastic ring {format_quantity(a - c, 'length', 3)} wide"


def _first(course: Course) -> str:
    """Return place and depth of first yield on a virgin surface."""
    depth = onset_depth(course.scene)
    if course.onset is None:
        return "nothing yields" if depth == np.inf else "yield begins deeper than the known tip"
    where = "the whole flat face" if course.scene.profile.face_radius else "the axis"
    # With adhesion the depth is smaller by the stretch of the rim.
    return f"{where} yields first" + f", at d = {format_quantity(depth, 'length', 3)}" * (
        not course.adhesive
    )


def words(view: View, i: int) -> dict:
    return {"reading": (0.0, 0.97 * view.end(Z), sentence(view.course, i))}


def zone(view: View, i: int) -> dict:
    """Return the depths of loading beyond the onset of yield, as a ribbon below the lowest force."""
    course, force = view.course, view.axis(F)
    known = course.onset is not None and not (course.dashpots or course.initial_plastic_depth)
    if not known or course.onset.depth >= np.max(course.states.depth):
        return {"plastic zone, on loading": NOTHING}
    ends = np.array([float(course.onset.depth), float(np.max(course.states.depth))])
    return {"plastic zone, on loading": (ends, np.full(2, _below(force)))}


def _below(force: Any) -> float:
    """Return the force (N) in the middle of the strip below the lowest force."""
    return force.start - 0.5 * STRIP * (force.end - force.start)


SPRINGS = (
    word("indenter", "ink", names=("profile g(x)",)),
    word("imprint", "yielded-text", names=("residual imprint",)),
    word("yielded", "yielded-text", baseline="bottom", alpha=0.85, names=("yielded",)),
    word("free", "soft", "left", "bottom", 0.85, names=("free",)),
    word("elastic", "elastic-text", "right", "bottom", 0.85, names=("elastic",)),
)
PRESSURE = (
    word("plastic zone", "yielded-text", names=("plastic zone r < c",)),
    # The axis names the other curve.
    word("mean", "ink", "left", names=("mean F/(πa²)", "p(r)")),
)
FORCE = (
    word("loading", "yielded-text", "right", "bottom", names=("yielding", "elastic", "now")),
    word("elastic", "elastic-text", "right", "bottom", names=("elastic", "unloading", "now")),
    word("unloading", "elastic-text", "right", names=("unloading",)),
    word("plastic work", "yielded-text", names=("plastic work Wₚ",)),
    word("dissipated", "yielded-text", names=("dissipated",)),
    word("stored", "elastic-text", names=("stored",)),
    word("plastic zone", "yielded-text", "center", names=("plastic zone, on loading", "onset of yield")),
    word("yield begins", "yielded-text", "left", "top", names=("onset of yield",)),
)


def _pixels(view: View, x: AxisSpec, y: AxisSpec) -> tuple[float, float]:
    """Return the size (SI) of a pixel of the smallest plot along both axes."""
    across, up = view.axis(x), view.axis(y)
    return (across.end - across.start) / WIDTH, (up.end - up.start) / HEIGHT


def _at(text: str, *points: tuple[float, float]) -> tuple[Any, Any, str]:
    """Return possible points of a label, the best point first, and its text."""
    xs, ys = zip(*points, strict=True) if points else NOTHING
    return np.array(xs), np.array(ys), text


def _by_row(places: dict[str, tuple]) -> dict[str, tuple]:
    """Return places by the names of the labels' rows."""
    return {f"label {name}": place for name, place in places.items()}


def of_springs(view: View, i: int) -> dict:
    """Return labels in the indenter and its imprint, and at the feet of the springs."""
    state, half, z = view.course.states[i], view.end(X), view.axis(Z)
    px, py = _pixels(view, X, Z)
    a, c, lower = (
        float(v) for v in (state.contact_radius, state.plastic_radius, state.live_interval.lower)
    )

    def free_height(text: str) -> float:
        """Return the height (m) of the profile at the ends of a label on the axis."""
        return float(reduced(state.profile, np.array([(width(text) / 2 + 4) * px]))[0])

    base, outer = z.start + 2 * py, max(a, c)
    body = free_height("indenter") - float(state.depth)
    hollow = lower - free_height("imprint")
    ring = a - min(a, c) > 0.12 * half
    bodies = [(0.0, share * z.end) for share in (0.35, 0.5) if body < share * z.end - LINE / 2 * py]
    return _by_row({
        "indenter": _at("indenter", *bodies),
        "imprint": _at("imprint", *[(0.0, -0.5 * hollow)] * (hollow > (LINE + 4) * py)),
        "yielded": _at("yielded", *[(0.0, base)] * (2 * c > (width("yielded") + 8) * px)),
        "free": _at("free", (outer + 4 * px, base)),
        "elastic": _at("elastic", *[(a - 2 * px if c else width("elastic") / 2 * px, base)] * ring),
    })  # fmt: skip


def of_pressure(view: View, i: int) -> dict:
    """Return labels in the plastic zone and next to the line of the mean pressure."""
    state = view.course.states[i]
    px, py = _pixels(view, R, P)
    a, c, mean = (float(v) for v in (state.contact_radius, state.plastic_radius, state.mean_pressure))
    wide = 2 * c > (width("plastic zone") + 8) * px
    # Outside the contact, or inside it above or below the line.
    middle = -width("mean") / 2 * px
    points = [(a + 3 * px, mean), (middle, mean + 9 * py), (middle, mean - 9 * py)]
    return _by_row({
        "plastic zone": _at("plastic zone", *[(0.0, share * mean) for share in (0.3, 0.15, 0.5)] * wide),
        "mean": _at("mean", *points * (a > 0)),
    })  # fmt: skip


def of_force(view: View, i: int) -> dict:
    """Return labels next to the curve of one loading, and in the areas of state i if wide enough."""
    course, states, peak = view.course, view.course.states, view.course.peak
    top = float(states.force[peak])
    if course.turns or course.chained or course.adhesive or not top > 0:
        return {}
    px, py = _pixels(view, D, F)
    # With dashpots the force falls again before the largest depth.
    up = slice(None, int(np.argmax(states.force[: peak + 1])) + 1)
    down = slice(None, peak - 1 if peak else None, -1)

    def loaded(force: float) -> float:
        return float(np.interp(force, states.force[up], states.depth[up]))

    def unloaded(force: float) -> float:
        return float(np.interp(force, states.force[down], states.depth[down]))

    yields = float(np.max(states.plastic_depth)) > course.initial_plastic_depth
    shares = (0.62, 0.75, 0.5, 0.35)
    beside = [(loaded(share * top) - 5 * px, share * top + 2 * py) for share in shares]
    # Below a curve that is too steep for a label on its left.
    right = (width("loading") + 8) * px
    beside += [(loaded(share * top) + right, (share - 0.1) * top) for share in shares]
    found = {"loading" if yields or course.dashpots else "elastic": beside}
    if yields or course.dashpots:
        # The word needs room on the left of the line.
        near = [(unloaded(share * top) - 4 * px, share * top) for share in (0.5, 0.62, 0.38)]
        room = (width("unloading") + 8) * px
        found["unloading"] = [(x, y) for x, y in near if x - room > loaded(y)]
    found |= _areas(view, i, loaded, px)
    if (onset := course.onset) is not None and not course.dashpots:
        ahead = float(onset.depth) >= float(np.max(states.depth)) or course.initial_plastic_depth > 0
        place = (float(onset.depth) + float(np.max(states.depth))) / 2, _below(view.axis(F))
        if ahead:
            place = float(onset.depth) + 8 * px, float(onset.force) - 4 * py
        found["yield begins" if ahead else "plastic zone"] = [place]
    return _by_row({name: _at(name, *points) for name, points in found.items()})


def _areas(view: View, i: int, loaded: Any, px: float) -> dict[str, list]:
    """Return points inside the areas of lost and stored energy in state i."""
    course = view.course
    depth, force = float(course.states.depth[i]), float(course.states.force[i])
    lost, found = "dissipated" if course.dashpots else "plastic work", {}
    if force <= 0:
        return {lost: [], "stored": []}
    back, falling = unloading_curve(course.states[i])
    for share in (0.22, 0.35, 0.5):
        at = share * force
        d = float(np.interp(at, falling[::-1], back[::-1]))
        left = loaded(at)
        if d - left > (width(lost) + 8) * px:
            found.setdefault(lost, []).append(((d + left) / 2, at))
        inside = depth - d > (width("stored") + 4) * px
        x = (d + depth) / 2 if inside else depth + (width("stored") / 2 + 5) * px
        found.setdefault("stored", []).append((x, at))
    return {lost: []} | found


EXTRA = Extra(
    "labels",
    order=90,
    overlays=(
        Overlay("springs", (label("reading", 0.0, "center"),), words),
        Overlay("force", (line("plastic zone, on loading", "yielded", 14.0, alpha=0.25),), zone),
        Overlay("springs", SPRINGS, of_springs),
        Overlay("pressure", PRESSURE, of_pressure),
        Overlay("force", FORCE, of_force),
    ),
)
