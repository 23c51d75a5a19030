"""States, courses and views for tests without a browser."""

import numpy as np

import mdr_core as mdr
from app import changes
from app.panels.guide import TOURS, step_state
from app.panels.readouts import readings
from app.plots.plot import View
from app.solve import follow, in_time, turning_point
from app.state import State, link, medium, preset_state, profile
from app.state.files import read_curve
from app.state.units import fitting

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
    return View(state, follow(state), [follow(each) for each in held])


def stepped(title: str) -> list:
    """The course of each step of a guided scene."""
    return [follow(step_state(step, preset_state())) for step in TOURS[title]]


def linked_state(state: State) -> State:
    """What a link of a state says."""
    return link.read(written(state))


def written(state: State) -> str:
    return link.write(state)


def solved(state: State):
    """The course of a state, in full."""
    course = follow(state)
    return in_time(course) if course.pending else course


def viscous(**more) -> State:
    return state_with(DROP, damping="eta", **more)


def tip(state: State | None = None) -> State:
    """With a measured tip, a paraboloid."""
    r = np.linspace(0, 100e-9, 30)
    return changes.take_tip(state or preset_state(), (r, r**2 / 200e-9), "")


def example_curve(state: State):
    """The present tip on a medium of 1.3 E* and 0.8 q_c, begun at a tenth of its depth; 0.4 % noise."""
    tip, made, depth = profile(state), medium(state), float(turning_point(state).depth)
    other = mdr.Medium(1.3 * made.E_star, 0.8 * made.q_c)
    back = depth - 0.8 * min(depth, other.critical_depth)
    path = np.append(np.linspace(-0.05, 1, 240) * depth, np.linspace(depth, back, 160))
    force = mdr.indent(tip, other, path).force
    force = force + 0.004 * force.max() * np.random.default_rng(1).standard_normal(path.size)
    units = fitting(depth, "length"), fitting(force.max(), "force")
    columns = (path + 0.1 * depth) / units[0].factor, force / units[1].factor
    rows = [f"{x:.6g}; {y:.6g}" for x, y in zip(*columns, strict=True)]
    text = "\n".join([f"depth ({units[0].name}); force ({units[1].name})", *rows])
    return read_curve(text.encode(), "A made curve, no measurement")


def numbers(course) -> dict:
    """Values of all readouts of a course, by name."""
    return {each.name: values for each, values in readings(course).items()}
