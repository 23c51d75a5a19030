"""Held scenes: links, named by what differs from the preset, and a table of their numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import panel as pn

from ..drives import Course
from ..plots.plot import DASHES
from ..solve import DRIVES, follow, numbers_of, scene_of
from ..state import PRESETS, State, altered, link, preset_state
from ..state.quantities import CHOICES, QUANTITIES, SHAPES
from ..state.units import written
from ..ui import WIDE, button, html, marked, show, symbol
from .readouts import line, readings, text


@dataclass(frozen=True, eq=False)
class Held:
    """A held scene: its name and course."""

    name: str
    course: Course


def held_scene(query: str, known: dict) -> Held:
    """Held scene of a link; ValueError if the link is invalid."""
    state = link.read(query)
    return Held(difference(state), follow(state, known))


def _others(state: State) -> tuple[str, ...]:
    """Links of held scenes that are not the present one."""
    scene = scene_of(state)
    return tuple(query for query in state.hold if scene_of(link.read(query)) != scene)


def is_held(state: State) -> bool:
    return len(_others(state)) < len(state.hold)


def toggle_hold(state: State) -> State:
    """Hold the present scene, or remove it; ValueError if there is no room."""
    others = _others(state)
    if len(others) < len(state.hold):
        return state.replace(hold=others)
    if len(others) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    scene = preset_state(state.preset, **state.scene_values, progress=state.progress)
    return state.replace(hold=(*others, link.write(scene, DRIVES[state.drive].form)))


def difference(state: State) -> str:
    """Name of a scene: its differences from the preset, or the preset."""
    changed, preset = altered(state), PRESETS[state.preset]
    words = [SHAPES[state.shape].label] if "shape" in changed else []
    words += [CHOICES[name][state[name]] for name in changed if name in CHOICES and name != "elasticity"]
    numbers = [name for name in numbers_of(state) if name in changed or name not in preset.values]
    for name in sorted(numbers, key=lambda name: name not in changed):
        words.append(f"{QUANTITIES[name].symbol} = {written(state[name], QUANTITIES[name].kind, 3)}")
    return ", ".join(words) or preset.label


def removed(state: State, k: int) -> State:
    return state.replace(hold=(*state.hold[:k], *state.hold[k + 1 :]))


def numbers(course: Course) -> dict[str, str]:
    """Readouts of a scene at its largest depth, by symbol."""
    values = readings(course)
    return {each.known.symbol: text(each, values[each], course.peak, 3) for each in line(course, values)}


def _row(name: str, texts: list[str]) -> str:
    return f"<tr><th>{symbol(name)}</th>{''.join(f'<td>{text}</td>' for text in texts)}</tr>"


def _dash(k: int) -> str:
    return f'<span class="held"><i class="lines {DASHES[k]}"></i></span>'


class Table:
    """The tab *Held*: held scenes, and their numbers beside the present ones."""

    def __init__(self, apply: Callable[..., None]):
        self._apply, self._names = apply, [html("", "key") for _ in DASHES]
        self._rows = [self._row(k, name) for k, name in enumerate(self._names)]
        self._numbers = html("", "key")
        note = html("Hold keeps the present scene to compare with; its curves are drawn in every plot.")
        parts = (note, *self._rows, self._numbers)
        self.view = pn.Column(*parts, css_classes=["held"], visible=False, **WIDE)

    def show(self, course: Course, held: list[Held]) -> None:
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            show(self._names[k], object=f"{_dash(k)}{marked(held[k].name)}" if k < len(held) else "")
        columns = [numbers(course), *(numbers(each.course) for each in held)]
        heads = "".join(f"<th>{_dash(k)}</th>" for k in range(len(held)))
        rows = "".join(_row(name, [each.get(name, "–") for each in columns]) for name in columns[0])
        table = f"<table><tr><th></th><th>now</th>{heads}</tr>{rows}</table>"
        show(self._numbers, object=table if held else "")

    def _row(self, k: int, name: Any) -> pn.Row:
        remove = button(f"Remove {k + 1}", width=76)
        remove.on_click(lambda event: self._apply(lambda state: removed(state, k)))
        return pn.Row(name, remove, css_classes=["head"], visible=False, **WIDE)
