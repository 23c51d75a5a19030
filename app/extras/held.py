"""Held scenes: up to four, kept as links, drawn beside the present one and listed with their numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import panel as pn

from mdr_core.results import figures
from mdr_core.results.figures import NOTHING, both, line

from .. import link
from ..courses import Course
from ..drives import follow, scene_of
from ..extra import Extra
from ..parts import Button
from ..plot import Along, Overlay, View
from ..plots import PLOTS, P, R, Z
from ..quantities import CHOICES
from ..readouts import line as readout_line
from ..readouts import readings, text
from ..shared.widgets import button
from ..state import PRESETS, State, altered, used
from ..ui import WIDE, html, marked, show, symbol
from ..units import with_symbol

#: Scenes that are held have each its own dashes.
DASHES = ("dotdash", "dashed", "dotted", "solid")


@dataclass(frozen=True)
class Held:
    """A held scene: its name and course."""

    name: str
    course: Course


# The scenes.


def held_scene(query: str, known: dict) -> Held:
    """A held scene from its link; ValueError if that is invalid."""
    state = link.read(query)
    return Held(difference(state), follow(state, known))


def _others(state: State) -> tuple[str, ...]:
    """Links of held scenes that are not the present one."""
    scene = scene_of(state)
    return tuple(query for query in state["held.scenes"] if scene_of(link.read(query)) != scene)


def is_held(state: State) -> bool:
    return len(_others(state)) < len(state["held.scenes"])


def toggle_hold(state: State) -> State:
    """Hold the present scene, or remove it; ValueError if there is no room."""
    others = _others(state)
    if len(others) < len(state["held.scenes"]):
        return state.replace(**{"held.scenes": others})
    if len(others) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    scene = state.replace(tiles=(), log=(), dark=False, **{"held.scenes": ()})
    return state.replace(**{"held.scenes": (*others, link.write(scene))})


def _without(state: State, k: int) -> State:
    scenes = state["held.scenes"]
    return state.replace(**{"held.scenes": (*scenes[:k], *scenes[k + 1 :])})


def difference(state: State) -> str:
    """Name of a scene: its differences from the preset, or the preset."""
    changed, preset = altered(state), PRESETS[state.preset]
    words = [CHOICES[name][state[name]] for name in changed if name in CHOICES and name != "elasticity"]
    numbers = [name for name in used(state) if name in changed or name not in preset.values]
    for name in sorted(numbers, key=lambda name: name not in changed):
        words.append(with_symbol(name, state[name]))
    return ", ".join(words) or preset.label


def numbers(course: Course) -> dict[str, str]:
    """Readouts of a scene at its largest depth, by symbol."""
    values = readings(course)
    shown = readout_line(course, values)
    return {each.known.symbol: text(each, values[each], course.peak, 3) for each in shown}


# What is drawn beside the present scene.


def scenes(view: View) -> list[Held]:
    return view.computed.get("held", [])


def _force(view: View, course: Course) -> dict:
    return {"": (course.states.depth, course.states.force)}


def _pressure(view: View, course: Course) -> dict:
    r = figures.radii(course.state, view.end(R))
    return {"": (both(r, -1), both(figures.cut(course.state.pressure(r), view.end(P))))}


def _radii(view: View, course: Course) -> dict:
    rows = PLOTS["radii"].still(View(view.state, course))
    whole = tuple(map(np.append, rows["contact radius a"], rows["unloading"]))
    return {" a": whole, " c": rows["plastic zone c"]}


def _over_time(plot: str, row: str) -> Callable[[View, Course], dict]:
    """A row of a plot over time, of scenes that have it."""

    def columns(view, course):
        other = View(view.state, course)
        return {"": PLOTS[plot].still(other)[row] if PLOTS[plot].applies(other) else NOTHING}

    return columns


def _reach(view: View, along: Along) -> tuple[float, float]:
    """Held scenes are within the axes; springs keep their height beside deeper ones."""
    courses = [each.course for each in scenes(view)] if along is not Z else []
    sizes, least = [0.0], [0.0]
    for course in courses:
        try:
            sizes.append(along.size(course))
        except AttributeError:
            # Another drive, which has not this quantity.
            continue
        least += [along.least(course), -along.below(course) * sizes[-1]]
    return min(least), max(sizes)


def _rows(symbol: str, what: str = "", width: float = 1.6, axis: int = 1, legend: bool = True) -> list:
    dashes = enumerate(DASHES, 1)
    return [line(f"held {k}{what}", "held", width, dash, symbol, axis, legend) for k, dash in dashes]


def _overlay(plot: str, rows: list, columns: Callable[[View, Course], dict]) -> Overlay:
    def still(view: View) -> dict:
        return {
            f"held {k}{what}": row
            for k, held in enumerate(scenes(view), 1)
            for what, row in columns(view, held.course).items()
        }

    return Overlay(plot, tuple(rows), still, reach=_reach)


# The panel and the button.


def _dash(k: int) -> str:
    return f'<span class="held"><i class="lines {DASHES[k]}"></i></span>'


class Table:
    """Held scenes, and their numbers beside the present ones."""

    def __init__(self, apply: Callable[..., None]):
        self._rows, self._numbers = [], html("", "key")
        for k in range(len(DASHES)):
            remove = button(f"Remove {k + 1}", width=76)
            remove.on_click(lambda event, k=k: apply(lambda state: _without(state, k)))
            self._rows.append(pn.Row(html("", "key"), remove, css_classes=["head"], visible=False, **WIDE))
        note = html("Hold keeps the present scene: its curves are drawn beside those of the next ones.")
        self.view = pn.Column(note, *self._rows, self._numbers, css_classes=["held"], **WIDE)

    def show(self, view: View) -> None:
        held = scenes(view)
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            show(row[0], object=f"{_dash(k)}{marked(held[k].name)}" if k < len(held) else "")
        columns = [numbers(course) for course in (view.course, *(each.course for each in held))]
        rows = [["", "now", *map(_dash, range(len(held)))]]
        rows += [[symbol(name), *(each.get(name, "–") for each in columns)] for name in columns[0]]
        cells = "".join(f"<tr><th>{head}</th><td>{'</td><td>'.join(row)}</td></tr>" for head, *row in rows)
        show(self._numbers, object=f"<table>{cells}</table>" if held else "")


class Hold:
    """The button *Hold*."""

    def __init__(self, page: Any):
        self.view = Button("Hold", lambda: page.apply(toggle_hold), pressed=False)

    def show(self, view: View) -> None:
        self.view.show(pressed=bool(view.state["held.scenes"]) and is_held(view.state))


def compute(state: State, before: View | None, known: dict) -> list[Held]:
    """Courses of the held scenes; those that are known are kept."""
    if before is not None and before.state["held.scenes"] == state["held.scenes"]:
        return scenes(before)
    return [held_scene(query, known) for query in state["held.scenes"]]


def check(state: State) -> str:
    too_many = len(state["held.scenes"]) > len(DASHES)
    return f"more than {len(DASHES)} scenes are held in this link" * too_many


def told(view: View) -> list[tuple[str, str]]:
    named = enumerate(scenes(view), 1)
    return [("Held scenes", "".join(f"<p>Held {k}: {marked(each.name)}.</p>" for k, each in named))]


EXTRA = Extra(
    "held",
    order=10,
    values={"held.scenes": ()},
    of_view=("held.scenes",),
    former={"hold": "held.scenes"},
    tab="Held",
    overlays=(
        _overlay("force", _rows("F"), _force),
        _overlay("pressure", _rows("−σzz"), _pressure),
        _overlay("radii", [*_rows("a", " a"), *_rows("c", " c", 0.9, legend=False)], _radii),
        _overlay("motion", _rows("F", axis=2), _over_time("motion", "force F")),
        _overlay("forces", _rows("F"), _over_time("forces", "tangential force Fₓ")),
    ),
    check=check,
    compute=compute,
    courses=lambda view: [each.course for each in scenes(view)],
    offered=lambda view: bool(view.state["held.scenes"]),
    header=Hold,
    side=lambda page: Table(page.apply),
    told=told,
)
