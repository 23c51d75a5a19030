"""The player: it moves through the states of a scene in the browser."""

import json
from collections.abc import Callable, Iterator
from typing import Any

from . import readouts
from .draw import PLACES, Picture
from .parts import Part
from .plot import View


def frames(view: View, pictures: list[Picture]) -> list[Any]:
    """Sources that move, the places of their rows in each state as texts, readouts, and times."""
    *_, found = frames_in_steps(view, pictures)
    return found


def frames_in_steps(view: View, pictures: list[Picture]) -> Iterator[list[Any]]:
    """`frames`, after an empty list for each state that has been computed: all of them take 0.2 s."""
    numbers, states = readouts.line(view.course), range(len(view.course))
    found: dict[Any, list[str]] = {}
    for i in states:
        yield []
        for picture in pictures:
            for source, columns in picture.columns(view, i).items():
                places = json.dumps({name: columns[name] for name in PLACES if name in columns})
                found.setdefault(source, []).append(places.replace("NaN", "null"))
    moving = {source: texts for source, texts in found.items() if len(set(texts)) > 1}
    words = [readouts.values(numbers, i) for i in states]
    yield [[*moving], [*moving.values()], words, view.course.times.tolist()]


def player(view: View, move: Callable[[Any], None]) -> Part:
    """A button and a slider that move through the states of a view, in the browser.

    `move` is called with None when one of them begins to, and with the index of the state in which it ends.
    """
    return Part("player", "player", {"last": len(view.course) - 1, "now": view.course.now}, move)
