"""States, courses and views for tests without a browser."""

import numpy as np

from app import changes
from app.plots.plot import View
from app.solve import DRIVES, follow
from app.state import State, link, opened
from app.state.files import Curve

from .conftest import DROP, GOLD


def chosen(key=GOLD, drive=None, /, **choices) -> State:
    """A preset with a drive, and options of choices as a person takes them, one after the other."""
    state = changes.choose(opened(key), "drive", drive) if drive else opened(key)
    for name, option in choices.items():
        state = changes.choose(state, name, option)
    return state


def seen(state: State, progress=1.0, *held: State, **view) -> View:
    """The view of a state."""
    state = state.but(progress=progress, **view)
    return View(follow(state), state, [follow(each) for each in held], curve=Curve.of(state))


def there(state: State) -> State:
    """What a link of a state says."""
    return link.read(link.arguments(written(state)))


def written(state: State) -> str:
    return link.write(state, DRIVES[state.drive].form)


def solved(state: State):
    """The course of a state, in full."""
    course = follow(state)
    return DRIVES[state.drive].in_time(course.scene) if course.pending else course


def viscous(**more) -> State:
    return chosen(DROP, damping="tau", **more)


def tip(state: State | None = None) -> State:
    """With a measured tip, a paraboloid."""
    r = np.linspace(0, 100e-9, 30)
    return changes.take_tip(state or opened(), (r, r**2 / 200e-9), "")
