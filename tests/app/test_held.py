"""Scenes that are held: kept with their names in the link, told apart, and removed."""

import numpy as np
import pytest

from app.drives import follow
from app.extras.held import DASHES, held_scene, is_held, numbers, toggle_hold
from app.plot import rows_of
from app.plots import PLOTS, D, Z
from app.state import preset_state as preset
from app.units import written

from .conftest import DROP
from .states import linked_state, view_of


def holding(*depths):
    """A state that has held itself at some depths."""
    state = preset()
    for depth in depths:
        state = toggle_hold(state.replace(max_depth=depth))
    return state


def depths(state):
    """Largest depths of the scenes that are held."""
    return [held_scene(query, {}).course.turning_point.depth for query in state["held.scenes"]]


def test_one_gesture_holds_a_scene_and_lets_it_go():
    state = holding(6e-9, 9e-9)
    assert [held_scene(query, {}).course.turning_point.depth for query in state["held.scenes"]] == [
        6e-9,
        9e-9,
    ]
    assert is_held(state.replace(progress=0.4))
    assert all(len(query) < 100 for query in state["held.scenes"])
    state = toggle_hold(state)
    assert depths(state) == [6e-9]
    assert not is_held(state)


def test_a_fifth_is_refused():
    state = holding(1e-9, 2e-9, 3e-9, 4e-9)
    assert len(state["held.scenes"]) == len(DASHES) == 4
    with pytest.raises(ValueError, match="4 scenes are held: remove one"):
        toggle_hold(state.replace(max_depth=5e-9))
    with pytest.raises(ValueError, match="more than 4"):
        linked_state(state.replace(**{"held.scenes": (*state["held.scenes"], state["held.scenes"][0])}))


def test_the_numbers_are_those_of_the_deepest_state_and_of_the_impact():
    course = follow(preset(DROP).replace(progress=0.3))
    found = numbers(course)
    assert found["e"] == written(float(course.hit.restitution), "number", 3)
    assert found["d"] == written(float(course.hit.max_depth), "length", 3)
    assert "e" not in numbers(follow(preset()))


def test_each_has_its_own_row_in_every_plot():
    states = [preset().replace(max_depth=depth) for depth in (3e-9, 6e-9, 9e-9, 12e-9)]
    view = view_of(states[0], 1.0, *states)
    # Springs keep their height beside deeper scenes.
    assert view.end(Z) == view_of(states[0]).end(Z)
    assert view.end(D) > view_of(states[0]).end(D)
    rows = view.rows(PLOTS["force"], 0)
    for k, held in enumerate(view.computed["held"], 1):
        np.testing.assert_array_equal(rows[f"held {k}"][1], held.course.states.force)
        for name in ("pressure", "radii"):
            row = f"held {k} a" if name == "radii" else f"held {k}"
            assert np.isfinite(view.rows(PLOTS[name], view.course.now)[row][1]).any()
    looks = {row.look["dash"] for row in rows_of(PLOTS["force"]) if row.role == "held"}
    assert len(looks) == len(states)
