"""Scenes that are held to compare with: each a link with a name, and their numbers side by side."""

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
    """One of them: its name, and the course that was solved for it."""

    name: str
    course: Course


def opened(query: str, known: dict) -> Held:
    """What is held by a link; ValueError if it is not a scene."""
    scene, name = link.name_of(query)
    return Held(name, follow(link.read(link.arguments(scene)), known))


def _query(state: State) -> str:
    return link.write(state, DRIVES[state.drive].form, view=False)


def _same(query: str, state: State) -> bool:
    """Whether a link is that of a scene, in whatever state."""
    scene = link.read(link.arguments(link.name_of(query)[0]))
    return scene.but(progress=1.0).scene_values == link.read(link.arguments(_query(state))).scene_values


def is_held(state: State) -> bool:
    """Whether the present scene is held."""
    return any(_same(query, state) for query in state.hold)


def toggled(state: State) -> State:
    """With the present scene held besides, or without it if it is held.

    Raises ValueError if there is no room for it.
    """
    rest = tuple(query for query in state.hold if not _same(query, state))
    if len(rest) < len(state.hold):
        return state.but(hold=rest)
    if len(rest) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    return state.but(hold=(*rest, link.named(_query(state), difference(state))))


def difference(state: State) -> str:
    """What a scene differs in from its preset, as its name; its preset, where it is that."""
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
    """With another name of one that is held."""
    hold = state.hold
    return state.but(hold=(*hold[:k], link.named(hold[k], name), *hold[k + 1 :]))


def removed(state: State, k: int) -> State:
    """Without one that is held."""
    return state.but(hold=(*state.hold[:k], *state.hold[k + 1 :]))


def numbers(course: Course) -> dict[str, str]:
    """Symbols and numbers of a scene, with what it is where it is deepest."""
    medium, deepest = course.scene.medium, course.deepest
    found = {
        "E*": ("pressure", medium.E_star),
        "q_c": ("yield constant", medium.q_c),
        "η": ("viscosity", medium.eta),
        "d_max": ("length", deepest.depth),
        "F_max": ("force", np.max(course.force)),
        "a_max": ("length", deepest.contact_radius),
        "c": ("length", deepest.plastic_radius),
        "p_m": ("pressure", deepest.mean_pressure),
        "W_p": ("energy", course.plastic_work[-1]),
    }
    texts = {symbol: written(float(value), kind, 3) for symbol, (kind, value) in found.items()}
    return texts | {"e": "–" if course.hit is None else written(float(course.hit.restitution), "number", 3)}


class Table:
    """The scenes that are held, and their numbers beside those of the present one."""

    def __init__(self, tell: Callable[..., None]):
        self._tell, self._names, self._rows = tell, [], []
        self._list, self._numbers = pn.Column(**WIDE), html("", "numbers-held")
        note = html("Hold keeps the present scene to compare with; its curves are drawn in every plot.")
        self.view = pn.Column(note, self._list, self._numbers, css_classes=["held"], visible=False, **WIDE)

    def show(self, course: Course, held: list[Held]) -> None:
        """Show some scenes that are held, and the present one."""
        while len(self._rows) < len(held):
            self._rows.append(self._made(len(self._rows)))
            self._list.append(self._rows[-1])
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            if k < len(held):
                show(self._names[k], value=held[k].name)
        columns = [numbers(course), *(numbers(each.course) for each in held)]
        heads = "".join(
            f'<th><span class="held"><i class="lines {dash}"></i></span></th>'
            for dash in DASHES[: len(held)]
        )
        rows = "".join(
            f"<tr><th>{marked(symbol)}</th>" + "".join(f"<td>{each[symbol]}</td>" for each in columns)
            for symbol in columns[0]
        )
        show(
            self._numbers,
            object=f"<table><tr><th></th><th>now</th>{heads}</tr>{rows}</table>" if held else "",
        )

    def _made(self, k: int) -> Any:
        name = field(
            pn.widgets.TextInput, "called", "beside", label=f"held {k + 1}", width=164, sizing_mode=None
        )
        name.param.watch(lambda event: self._rename(k, event.new), "value")
        dash = html(
            f'<span class="held"><i class="lines {DASHES[k]}"></i></span>',
            "key",
            width=44,
            sizing_mode=None,
        )
        remove = button(f"Remove {k + 1}", width=76)
        remove.on_click(lambda event: self._tell(lambda state: removed(state, k)))
        self._names.append(name)
        return pn.Row(dash, name, remove, css_classes=["head"], **WIDE)

    def _rename(self, k: int, name: str) -> None:
        def act(state: State) -> State:
            known = k < len(state.hold) and link.name_of(state.hold[k])[1] != name
            return renamed(state, k, name) if known else state

        self._tell(act)
