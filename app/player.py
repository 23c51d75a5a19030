"""The player: it moves through the states of a scene in the browser."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from . import readouts
from .courses import Course
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


def look(course: Course) -> dict[str, Any]:
    """What the browser is told of a course: the last state, the present one, and states to mark."""
    return {"last": len(course) - 1, "now": course.now, "marks": marked_states(course)}


def marked_states(course: Course) -> dict[str, int]:
    """States that are marked on the slider, by their names: the largest depth, and the loss of contact."""
    found = {"largest depth": course.peak}
    # A path that turns again may lose contact several times.
    lost = np.flatnonzero(course.states.contact_radius[course.peak :] == 0)
    if lost.size and not course.turns:
        found["loss of contact"] = course.peak + int(lost[0])
    return found


def player(view: View, move: Callable[[Any], None]) -> Part:
    """A button and a slider that move through the states of a view, in the browser.

    `move` is called with None when one of them begins to, and with the index of the state in which it ends.
    """
    return Part("player", "player", look(view.course), move)
