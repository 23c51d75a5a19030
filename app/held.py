"""Scenes that are held to compare with: each a query with a name, its numbers in a row of a table."""

import re
from dataclasses import dataclass
from urllib.parse import quote, unquote

import numpy as np
import panel as pn

from . import link
from .explorer import Explorer
from .parts import WIDE, button, field, fill, html, marked
from .plots import DASHES
from .quantities import SHAPES
from .trajectory import Trajectory
from .units import written

_NAME, _LONGEST_NAME = "&called=", 60
_NAMED = 260


@dataclass(frozen=True, eq=False)
class Held:
    """One of them: its name, and the way that was solved for it."""

    name: str
    way: Trajectory


def held(query, follow):
    """What a query holds, with the way that `follow` finds; ValueError if it is not a scene."""
    scene, _, name = query.partition(_NAME)
    explorer = Explorer()
    link.restore(explorer, link.arguments(scene))
    return Held(unquote(name)[:_LONGEST_NAME], follow(explorer))


def renamed(query, name):
    """The query with another name."""
    return query.partition(_NAME)[0] + _NAME + quote(name.strip()[:_LONGEST_NAME], safe="")


def toggled(explorer):
    """What is held with the present scene besides, or without it if it is held.

    Raises ValueError if there is no room for it.
    """
    rest = [query for query in explorer.hold if not _same(query, explorer)]
    if len(rest) < len(explorer.hold):
        return rest
    query = link.query(explorer, view=False)
    if not query:
        raise ValueError("this tip has too many samples to be held")
    if len(rest) == len(DASHES):
        raise ValueError(f"{len(DASHES)} scenes are held: remove one of them first")
    name = explorer.preset or SHAPES[explorer.shape].label
    return [*rest, renamed(query, name + ", altered" * explorer.altered)]


def is_held(explorer):
    """Whether the present scene is held, in whatever state."""
    return any(_same(query, explorer) for query in explorer.hold)


def _same(query, explorer):
    one, two = (re.sub("&at=[^&]*", "", text) for text in (query, link.query(explorer, view=False)))
    return one.partition(_NAME)[0] == two


def numbers(way):
    """Symbols and numbers of a scene, with what it is where it is deepest."""
    medium, deepest = way.scene.medium, way.deepest
    found = {
        "E*": ("pressure", medium.E_star),
        "q_c": ("yield constant", medium.q_c),
        "η": ("viscosity", medium.eta),
        "d_max": ("length", deepest.depth),
        "F_max": ("force", np.max(way.force)),
        "a_max": ("length", deepest.contact_radius),
        "c": ("length", deepest.plastic_radius),
        "p_m": ("pressure", deepest.mean_pressure),
        "W_p": ("energy", way.plastic_work[-1]),
    }
    found = {symbol: written(float(value), kind) for symbol, (kind, value) in found.items()}
    return found | {"e": "–" if way.hit is None else written(float(way.hit.restitution), "number")}


class Table:
    """The table of what is held, with the present scene above; its rows are made when they are used."""

    def __init__(self, rename, remove):
        self._rename, self._remove, self._rows = rename, remove, []
        self._heads, self._now = _cells(), _cells()
        tops = _row(_fixed("", _NAMED), self._heads), _row(_fixed("now", _NAMED), self._now)
        self.view = pn.Column(*tops, css_classes=["away", "table"], visible=False, **WIDE)

    def show(self, way, all_held):
        """Show some scenes that are held, and the present one."""
        self.view.visible = bool(all_held)
        if not all_held:
            return
        shown = numbers(way)
        self._heads.object, self._now.object = _spans(map(marked, shown)), _spans(shown.values())
        for k in range(len(self._rows), len(all_held)):
            self._rows.append(self._made(k))
        for (name, _, cells, _), each in zip(self._rows, all_held, strict=False):
            name.value, cells.object = each.name, _spans(numbers(each.way).values())
        fill(self.view, [*self.view[:2], *self._rows[: len(all_held)]])

    def _made(self, k):
        look = {"name": f"held {k + 1}", "width": _NAMED, "sizing_mode": None}
        name = field(pn.widgets.TextInput, "beside", "called", **look)
        name.param.watch(lambda event: self._rename(k, event.new), "value")
        dash = _fixed(f'<span class="held"><i class="lines {DASHES[k]}"></i></span>', 44, "key")
        remove = button(f"Remove {k + 1}", width=80)
        remove.on_click(lambda event: self._remove(k))
        return _row(name, _cells(), dash, remove)


def _fixed(words, width, *classes):
    return html(words, *classes, width=width, sizing_mode=None)


def _row(name, cells, dash=None, remove=None):
    parts = (name, dash or _fixed("", 44), cells, remove or _fixed("", 80))
    return pn.Row(*parts, css_classes=["head"], **WIDE)


def _cells():
    return html("", "cells")


def _spans(texts):
    return "".join(f"<span>{text}</span>" for text in texts)
