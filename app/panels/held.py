"""Held scenes: links, named by what differs from the preset, and a table of their numbers."""

from collections.abc import Callable
from dataclasses import replace

import panel as pn

from ..drives import Course
from ..plots.plot import DASHES
from ..solve import follow, scene_of
from ..state import PRESETS, State, altered, link, used
from ..state.quantities import CHOICES, QUANTITIES
from ..state.units import in_full
from ..ui import WIDE, button, html, marked, show, symbol
from .readouts import line, readings, text


def held_scene(query: str, known: dict) -> Course:
    """Course of a held scene from its link, with its name; ValueError if the link is invalid."""
    state = link.read(query)
    return replace(follow(state, known), name=difference(state))


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
    scene = state.replace(hold=(), tiles=(), dark=False)
    return state.replace(hold=(*others, link.write(scene)))


def difference(state: State) -> str:
    """Name of a scene: its differences from the preset, or the preset."""
    changed, preset = altered(state), PRESETS[state.preset]
    words = [CHOICES[name][state[name]] for name in changed if name in CHOICES and name != "elasticity"]
    numbers = [name for name in used(state) if name in changed or name not in preset.values]
    for name in sorted(numbers, key=lambda name: name not in changed):
        words.append(f"{QUANTITIES[name].symbol} = {in_full(state[name], QUANTITIES[name].kind)}")
    return ", ".join(words) or preset.label


def numbers(course: Course) -> dict[str, str]:
    """Readouts of a scene at its largest depth, by symbol."""
    values = readings(course)
    return {each.known.symbol: text(each, values[each], course.peak, 3) for each in line(course, values)}


def _dash(k: int) -> str:
    return f'<span class="held"><i class="lines {DASHES[k]}"></i></span>'


class Table:
    """The tab *Held*: held scenes, and their numbers beside the present ones."""

    def __init__(self, apply: Callable[..., None]):
        self._rows, self._numbers = [], html("", "key")
        for k in range(len(DASHES)):
            remove = button(f"Remove {k + 1}", width=76)
            remove.on_click(lambda event, k=k: apply(lambda state: _without(state, k)))
            self._rows.append(pn.Row(html("", "key"), remove, css_classes=["head"], visible=False, **WIDE))
        note = html("Hold keeps the present scene: its curves are drawn beside those of the next ones.")
        parts = (note, *self._rows, self._numbers)
        self.view = pn.Column(*parts, css_classes=["held"], visible=False, **WIDE)

    def show(self, course: Course, held: list[Course]) -> None:
        for k, row in enumerate(self._rows):
            show(row, visible=k < len(held))
            show(row[0], object=f"{_dash(k)}{marked(held[k].name)}" if k < len(held) else "")
        columns = [numbers(each) for each in (course, *held)]
        rows = [["", "now", *map(_dash, range(len(held)))]]
        rows += [[symbol(name), *(each.get(name, "–") for each in columns)] for name in columns[0]]
        cells = "".join(f"<tr><th>{head}</th><td>{'</td><td>'.join(row)}</td></tr>" for head, *row in rows)
        show(self._numbers, object=f"<table>{cells}</table>" if held else "")


def _without(state: State, k: int) -> State:
    return state.replace(hold=(*state.hold[:k], *state.hold[k + 1 :]))
