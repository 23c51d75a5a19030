"""States, courses and views for tests without a browser."""

import numpy as np

from app import changes
from app.plots.plot import View
from app.solve import DRIVES, follow
from app.state import State, link, preset_state
from app.state.files import Curve

from .conftest import DROP, GOLD


def state_with(key=GOLD, drive=None, **choices) -> State:
    """A preset with a drive, and options of choices as a person takes them, one after the other."""
    state = changes.choose(preset_state(key), "drive", drive) if drive else preset_state(key)
    for name, option in choices.items():
        state = changes.choose(state, name, option)
    return state


def view_of(state: State, progress=1.0, *held: State, **view) -> View:
    """The view of a state."""
    state = state.replace(progress=progress, **view)
    return View(follow(state), [follow(each) for each in held], curve=Curve.of(state))


def linked_state(state: State) -> State:
    """What a link of a state says."""
    return link.read(written(state))


def written(state: State) -> str:
    return link.write(state, DRIVES[state.drive].form)


def solved(state: State):
    """The course of a state, in full."""
    course = follow(state)
    return DRIVES[state.drive].in_time(course.scene) if course.pending else course


def viscous(**more) -> State:
    return state_with(DROP, damping="tau", **more)


def tip(state: State | None = None) -> State:
    """With a measured tip, a paraboloid."""
    r = np.linspace(0, 100e-9, 30)
    return changes.take_tip(state or preset_state(), (r, r**2 / 200e-9), "")
