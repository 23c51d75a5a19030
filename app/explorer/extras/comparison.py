"""Compared scenes: up to four, held as links, on common axes with the present scene; and their numbers."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import panel as pn
from markupsafe import Markup

from mdr_core.show import figures
from mdr_core.show.figures import NOTHING, Axis, both, label, line
from mdr_core.show.springs import spring_line

from ...common import ui as widgets
from ...common.ui import WIDE, html, html_subscripts, show, symbol
from .. import link
from ..courses import Course
from ..drives import follow, scene_of
from ..extra import Entries, Extra
from ..link import with_symbol
from ..plot import AxisSpec, Overlay, View, cached
from ..plots import PLOTS, D, F, P, R, X
from ..readouts import line as readout_line
from ..readouts import text
from ..search import Searching
from ..state import MEDIUM_CHOICES, OPENING, PRESETS, State, changed_from_preset, form_choices, used
from ..widgets import Part, button

#: Dashes of the held scenes.
DASHES = ("dotdash", "dashed", "dotted", "solid")
#: Colours of the held scenes, by their roles.
ROLES = ("held", "held-2", "held-3", "held-4")
#: Message after *Compare*.
KEPT = "Kept for comparison. Now change something."
#: Share of both axes below which a curve looks like a point.
_SEEN = 0.01


@dataclass(frozen=True)
class Held:
    """Held scene: its name, course and state."""

    name: str
    course: Course
    state: State | None = None


# The scenes.


def held_scene(query: str) -> Held:
    """Return the held scene of a link. Raises ValueError if the link is invalid."""
    state = link.read(query)
    return Held(difference(state), follow(state), state)


def is_scene(entry: str) -> bool:
    """Whether an entry of a link can be a scene."""
    return "=" in entry


def _others(state: State) -> tuple[str, ...]:
    """Return the links of held scenes other than the present scene."""
    scene = scene_of(state)
    return tuple(query for query in state["held.scenes"] if scene_of(link.read(query)) != scene)


def is_held(state: State) -> bool:
    return len(_others(state)) < len(state["held.scenes"])


def toggle_hold(state: State) -> State:
    """Hold the present scene, or remove it. Raises ValueError if too many scenes are held."""
    others = _others(state)
    if len(others) < len(state["held.scenes"]):
        return state.replace(**{"held.scenes": others})
    if len(others) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    scene = state.scene_values.replace(at=state.at)
    return state.replace(**{"held.scenes": (*others, link.write(scene) or f"preset={OPENING}")})


def _without(state: State, k: int) -> State:
    scenes = state["held.scenes"]
    return state.replace(**{"held.scenes": (*scenes[:k], *scenes[k + 1 :])})


def difference(state: State, now: State | None = None) -> str:
    """Return the name of a scene: its differences from the present scene `now`.

    For the same scene, or another preset, they are from its preset; another preset is part of the name.
    """
    preset, known = PRESETS[state.preset], changed_from_preset(state)
    choices = ("shape", *MEDIUM_CHOICES, "drive", *form_choices(state))
    other = now is not None and now.preset != state.preset
    if now is not None and not other and scene_of(now) != scene_of(state):
        changed = {name for name in (*choices, *used(state)) if state[name] != now[name]}
    else:
        changed = {*known, *(name for name in used(state) if name not in preset.values)}
    words = [state.chosen(name).label for name in choices if name in changed and name != "elasticity"]
    for name in sorted(used(state), key=lambda name: name not in known):
        if name in changed:
            words.append(with_symbol(name, state[name]))
    return ", ".join([preset.label] * other + words) or preset.label


def numbers(course: Course) -> dict[str, str]:
    """Return the readouts of a scene at its largest depth, by symbol."""
    shown = readout_line(course).items()
    return {each.symbol: text(each, values, course.peak, 3) for each, values in shown}


# Curves of the held scenes.


def scenes(view: View) -> list[Held]:
    return view.computed.get("held", [])


def _reach(view: View, along: AxisSpec) -> tuple[float, float]:
    """Return the range of the compared scenes along an axis of their plots."""
    drawn = (PLOTS[overlay.on] for overlay in OVERLAYS if overlay.on in PLOTS)
    plots = [plot for plot in drawn if along in plot.axes]
    courses = (each.course for each in scenes(view))
    known = [c for c in courses if any(plot.applies(View(view.state, c)) for plot in plots)]
    lowest, largest = zip((0.0, 0.0), *map(along.span, known), strict=True)
    return min(lowest), max(largest)


def _springs(view: View, course: Course) -> dict:
    return {"": spring_line(course.state, view.end(X), lambda g: course.relaxing(course.now, g))}


def _force(view: View, course: Course) -> dict:
    return {"": (course.states.depth, course.states.force)}


def _pressure(view: View, course: Course) -> dict:
    half = max(view.end(R), 1.01 * float(course.state.contact_radius))
    r = figures.radii(course.state, half)
    return {"": (both(r, -1), both(figures.cut(course.state.pressure(r), view.end(P))))}


def _over_time(plot: str, row: str) -> Callable[[View, Course], dict]:
    """Return a function for a row of a plot over time, empty for scenes without it."""

    def columns(view, course):
        other = View(view.state, course)
        return {"": PLOTS[plot].places(other, 0)[row] if PLOTS[plot].applies(other) else NOTHING}

    return columns


def _hardness(view: View, course: Course) -> dict:
    """Return the mean pressure over the contact radius, and the hardness at that radius."""
    states, made = course.states, course.scene.medium
    a = np.where(states.contact_radius > 0, states.contact_radius, np.nan)
    found = {"": (a, states.mean_pressure), " hardness": NOTHING}
    if made.q_c < np.inf:
        r = np.nanmax(a) * np.geomspace(0.01, 1.0, 81)
        found[" hardness"] = r, made.hardness_at(r)
    return found


def _rows(symbol: str, what: str = "", width: float = 1.6, axis: int = 1, legend: bool = True) -> list:
    looks = enumerate(zip(ROLES, DASHES, strict=True), 1)
    return [line(f"held {k}{what}", role, width, dash, symbol, axis, legend) for k, (role, dash) in looks]


def _beyond(axes: list[Axis], rows: list[tuple]) -> str:
    """Return a remark in brackets on an invisible part of a scene: axes stay fixed during a drag."""
    small = True
    for k, axis in enumerate(axes):
        columns = np.concatenate([row[k] for row in rows])
        some = columns[np.isfinite(columns)]
        near = 1e-9 * axis.end
        if (some < axis.start - near).any() or (some > axis.end + near).any():
            return " (partly beyond the axes)"
        small &= bool((np.abs(some) < _SEEN * axis.end).all())
    return " (too small to be seen)" * small


def _kept(view: View, i: int) -> dict:
    """Return the message after *Compare*, until the present scene differs from the held scene."""
    same = any(each.course.scene == view.course.scene for each in scenes(view))
    left = view.axis(D).start + 0.02 * (view.end(D) - view.axis(D).start)
    return {"kept": (left, 0.84 * view.end(F), KEPT if same else "")}


def _overlay(plot: str, rows: list, columns: Callable[[View, Course], dict]) -> Overlay:
    @cached
    def places(view: View) -> dict:
        known, found = PLOTS[plot].axes_of(view), {}
        axes = [known[k] for k in (0, rows[0].axis)] if known else []
        for k, held in enumerate(scenes(view), 1):
            parts = columns(view, held.course)
            name = held.name + _beyond(axes, list(parts.values()))
            found |= {f"held {k}{what}": (*part, name) for what, part in parts.items()}
        return found

    return Overlay(plot, tuple(rows), places, _reach if plot == "springs" else Overlay.reach)


OVERLAYS = (
    _overlay("springs", _rows("z", width=2.2), _springs),
    _overlay("force", _rows("F"), _force),
    _overlay("pressure", _rows("p"), _pressure),
    Overlay("force", (label("kept"),), _kept),
    _overlay("hardness", [*_rows("pₘ"), *_rows("σ", " hardness", width=1.0, legend=False)], _hardness),
    _overlay("motion", _rows("F", axis=2), _over_time("motion", "force F")),
    _overlay("forces", _rows("F"), _over_time("forces", "tangential force Fₓ")),
)


# The table and the button.


def _dash(k: int) -> Markup:
    return Markup('<span class="{}"><i class="lines {}"></i></span>').format(ROLES[k], DASHES[k])


class Table:
    """Table of the held scenes, with their numbers next to the present numbers."""

    def __init__(self, apply: Callable[..., None]):
        self._rows, self._numbers = [], html("", "key")
        for k in range(len(DASHES)):
            act = partial(apply, partial(_without, k=k))
            remove = widgets.button(f"Remove {k + 1}", act, width=76)
            self._rows.append(pn.Row(html("", "key"), remove, css_classes=["head"], visible=False, **WIDE))
        self.view = pn.Column(*self._rows, self._numbers, css_classes=["held"], **WIDE)

    def show(self, view: View) -> None:
        held = scenes(view)
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            show(row[0], object=_dash(k) + html_subscripts(held[k].name) if k < len(held) else "")
        columns = [numbers(course) for course in (view.course, *(each.course for each in held))]
        rows = [[Markup("at d<sub>max</sub>"), "now", *map(_dash, range(len(held)))]]
        found = [[name, *(each.get(name, "–") for each in columns)] for name in columns[0]]
        # Only numbers that differ.
        rows += [[symbol(name), *texts] for name, *texts in found if len({*texts}) > 1]
        cells = (
            Markup("<tr><th>{}</th><td>{}</td></tr>").format(head, Markup("</td><td>").join(row))
            for head, *row in rows
        )
        table = Markup("<table>{}</table>").format(Markup("").join(cells))
        same = Markup('<p role="status">{} All numbers are the same so far.</p>').format(KEPT)
        show(self._numbers, object=table if len(rows) > 1 else same)


def compare(page: Any, view: View) -> Part:
    """Return the button *Compare*, which holds the present scene for comparison."""
    pressed = bool(view.state["held.scenes"]) and is_held(view.state)
    return button("Compare", lambda: page.apply(toggle_hold), pressed=pressed)


def computed(state: State, before: View | None = None) -> list[Held]:
    """Return the held scenes, named by their differences from the present scene; reuse exact courses."""
    shown = {} if before is None else dict(zip(before.state["held.scenes"], scenes(before), strict=True))
    kept = {query: each for query, each in shown.items() if not each.course.pending}
    found = [kept.get(query) or held_scene(query) for query in state["held.scenes"]]
    return [replace(each, name=difference(each.state, state)) for each in found]


class Holding(Searching):
    """Computes the held scenes, and finds their exact courses."""

    def compute(self, state: State, course: Course) -> dict[str, Any]:
        return {"held": computed(state, self.page.view)}

    def rest(self, view: View) -> None:
        self.find_exact([each.course for each in scenes(view)])


def _paragraph(held: Held) -> Markup:
    return Markup("<p>{}.</p>").format(html_subscripts(held.name))


def scene_file_texts(view: View) -> list[tuple[str, str]]:
    return [("Held scenes", Markup("").join(map(_paragraph, scenes(view))))]


EXTRA = Extra(
    "comparison",
    order=10,
    values={"held.scenes": Entries(is_scene, len(DASHES))},
    overlays=OVERLAYS,
    place="top",
    service=Holding,
    offered=lambda view: bool(view.state["held.scenes"]),
    header=compare,
    side=lambda page: Table(page.apply),
    scene_file_texts=scene_file_texts,
)
