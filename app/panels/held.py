"""Held scenes: links with names, and a table of their numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import panel as pn

from ..drives import Course
from ..plots.plot import DASHES
from ..solve import DRIVES, follow
from ..state import PRESETS, State, altered, link, used
from ..state.quantities import CHOICES, QUANTITIES, SHAPES
from ..state.units import written
from ..ui import WIDE, button, field, html, marked, show


@dataclass(frozen=True, eq=False)
class Held:
    """A held scene: its name and course."""

    name: str
    course: Course


def held_scene(query: str, known: dict) -> Held:
    """Held scene of a link; ValueError if the link is invalid."""
    scene, name = link.split_name(query)
    return Held(name, follow(link.read(link.arguments(scene)), known))


def _query(state: State) -> str:
    return link.write(state, DRIVES[state.drive].form, view=False)


def _same(query: str, state: State) -> bool:
    """Whether a link has the scene of a state, at any progress."""
    scene = link.read(link.arguments(link.split_name(query)[0]))
    return scene.replace(progress=1.0).scene_values == link.read(link.arguments(_query(state))).scene_values


def is_held(state: State) -> bool:
    return any(_same(query, state) for query in state.hold)


def toggle_hold(state: State) -> State:
    """Hold the present scene, or remove it; ValueError if there is no room."""
    others = tuple(query for query in state.hold if not _same(query, state))
    if len(others) < len(state.hold):
        return state.replace(hold=others)
    if len(others) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    return state.replace(hold=(*others, link.with_name(_query(state), difference(state))))


def difference(state: State) -> str:
    """Name of a scene: its differences from the preset, or the preset."""
    changed, names = altered(state), used(state, DRIVES[state.drive].form)
    words = [SHAPES[state.shape].label] if "shape" in changed else []
    words += [CHOICES[name][state[name]] for name in changed if name in CHOICES and name != "elasticity"]
    preset = PRESETS[state.preset].values
    numbers = [name for name in names if name in changed or name not in preset]
    numbers.sort(key=lambda name: name not in changed)
    words += [
        f"{QUANTITIES[n].symbol} = {written(state[n], QUANTITIES[n].kind, 3)}"
        for n in numbers
        if n != "density"
    ]
    return ", ".join(words) or PRESETS[state.preset].label


def renamed(state: State, k: int, name: str) -> State:
    hold = state.hold
    if k >= len(hold) or link.split_name(hold[k])[1] == name:
        return state
    return state.replace(hold=(*hold[:k], link.with_name(hold[k], name), *hold[k + 1 :]))


def removed(state: State, k: int) -> State:
    return state.replace(hold=(*state.hold[:k], *state.hold[k + 1 :]))


def numbers(course: Course) -> dict[str, str]:
    """Main numbers of a scene at its largest depth, by symbol."""
    medium, turning_point = course.scene.medium, course.turning_point
    found = {
        "E*": ("pressure", medium.E_star),
        "q_c": ("yield constant", medium.q_c),
        "η": ("viscosity", medium.eta),
        "d_max": ("length", turning_point.depth),
        "F_max": ("force", np.max(course.force)),
        "a_max": ("length", turning_point.contact_radius),
        "c": ("length", turning_point.plastic_radius),
        "p_m": ("pressure", turning_point.mean_pressure),
        "W_p": ("energy", course.plastic_work[-1]),
    }
    texts = {symbol: written(float(value), kind, 3) for symbol, (kind, value) in found.items()}
    return texts | {"e": "–" if course.hit is None else written(float(course.hit.restitution), "number", 3)}


def _dash(k: int) -> str:
    return f'<span class="held"><i class="lines {DASHES[k]}"></i></span>'


class Table:
    """The tab *Held*: held scenes, and their numbers beside the present ones."""

    def __init__(self, apply: Callable[..., None]):
        self._apply, self._names, self._rows = apply, [], []
        self._list, self._numbers = pn.Column(**WIDE), html("", "numbers-held")
        note = html("Hold keeps the present scene to compare with; its curves are drawn in every plot.")
        self.view = pn.Column(note, self._list, self._numbers, css_classes=["held"], visible=False, **WIDE)

    def show(self, course: Course, held: list[Held]) -> None:
        while len(self._rows) < len(held):
            self._rows.append(self._made(len(self._rows)))
            self._list.append(self._rows[-1])
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            if k < len(held):
                show(self._names[k], value=held[k].name)
        columns = [numbers(course), *(numbers(each.course) for each in held)]
        heads = "".join(f"<th>{_dash(k)}</th>" for k in range(len(held)))
        rows = "".join(
            f"<tr><th>{marked(symbol)}</th>" + "".join(f"<td>{each[symbol]}</td>" for each in columns)
            for symbol in columns[0]
        )
        table = f"<table><tr><th></th><th>now</th>{heads}</tr>{rows}</table>"
        show(self._numbers, object=table if held else "")

    def _made(self, k: int) -> Any:
        name = field(
            pn.widgets.TextInput, "called", "beside", label=f"held {k + 1}", width=164, sizing_mode=None
        )
        name.param.watch(lambda event: self._apply(lambda state: renamed(state, k, event.new)), "value")
        dash = html(_dash(k), "key", width=44, sizing_mode=None)
        remove = button(f"Remove {k + 1}", width=76)
        remove.on_click(lambda event: self._apply(lambda state: removed(state, k)))
        self._names.append(name)
        return pn.Row(dash, name, remove, css_classes=["head"], **WIDE)
