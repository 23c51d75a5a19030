"""The player: it moves through the states of a scene in the browser."""

import json
from collections.abc import Callable
from typing import Any

from . import readouts
from .draw import Picture
from .parts import Part
from .plot import View


def frames(view: View, pictures: list[Picture]) -> tuple[list[Any], str]:
    """Sources that move, and what they are in each state with readouts and times, as one text."""
    course, numbers = view.course, readouts.line(view.course)
    states = range(len(course))
    found = [[picture.frame(view, i) for picture in pictures] for i in states]
    sent = {
        "pictures": [[columns for frame in each for columns in frame.values()] for each in found],
        "words": [readouts.values(numbers, i) for i in states],
        "times": course.times.tolist(),
    }
    return [source for frame in found[0] for source in frame], json.dumps(sent).replace("NaN", "null")


def player(view: View, move: Callable[[Any], None]) -> Part:
    """A button and a slider that move through the states of a view, in the browser.

    `move` is called with None when one of them begins to, and with the index of the state in which it ends.
    """
    look = {"last": len(view.course) - 1, "now": view.course.now}
    return Part("player", "player", look, act=move)
