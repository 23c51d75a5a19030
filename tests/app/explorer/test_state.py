"""The state: its values, presets, undo, and numbers that a drive does not use."""

import re
from dataclasses import fields

import numpy as np
import pytest

from app.common import quantities
from app.common.quantities import QUANTITIES
from app.explorer import changes, drives, extra, link, plot, plots, state
from app.explorer.drives import DRIVES, scene_of, turning_point
from app.explorer.extras import share
from app.explorer.page import Page
from app.explorer.state import OPENING, PRESETS, medium, preset_state, used

from ...approx import approx
from ..states import part, put, state_with, view_of


def test_a_state_is_small_frozen_and_known():
    """All numbers of the page are of it; what is not one of them is refused."""
    state = preset_state()
    assert {name for name in QUANTITIES if "." not in name} <= {each.name for each in fields(state)}
    with pytest.raises(AttributeError, match="max_depth"):
        state.max_depth = 1.0
    with pytest.raises(TypeError, match="max_deph"):
        state.replace(max_deph=1.0)
    assert state.replace(max_depth=1.0).replace(max_depth=state.max_depth) == state


@pytest.mark.parametrize("drive", DRIVES)
def test_numbers_of_other_drives_are_neither_reported_nor_taken_away_nor_swept(drive):
    theirs = {"depth": {"max_depth"}, "force": {"max_force"}, "path": {"max_depth"}}
    theirs["impact"] = {"mass", "speed", "plastic_depth"}
    theirs["oblique"] = {"mass", "oblique.friction", "oblique.incoming_speed", "oblique.attack"}
    state = state_with(OPENING, drive)
    of_medium = {"E_1", "nu_1", "E_2", "nu_2", "density", "q_c"}
    assert set(used(state)) == {"cone_slope"} | of_medium | theirs[drive]
    taken = share.csv(view_of(state)) + link.write(state)
    for name in set().union(*theirs.values()) - theirs[drive]:
        assert f" {QUANTITIES[name].symbol} = " not in taken
        assert f"&{name}=" not in taken
        assert drive in ("oblique", "path") or name not in changes.options(state, "sweep.swept")


def test_depths_of_presets_are_so_many_times_the_depth_of_yield():
    """To the five digits that a field shows, where their sources say so."""
    told = {
        key: re.match(r"(\S+) times the depth", each.sources.get("max_depth", ""))
        for key, each in PRESETS.items()
    }
    told = {key: float(found[1]) for key, found in told.items() if found}
    assert told
    for key, times in told.items():
        depth = times * medium(preset_state(key)).critical_depth
        assert PRESETS[key].values["max_depth"] == float(f"{depth:.5g}"), key


def test_a_steel_ball_is_one():
    """16 mm of steel, 7850 kg/m³, hits with its mass, to three digits in grams."""
    (key,) = (
        key for key, preset in PRESETS.items() if preset.label.startswith("Steel ball 16 mm on glass")
    )
    state = changes.choose(preset_state(key), "drive", "impact")
    assert (state.shape, state.sphere_radius) == ("sphere", 8e-3)
    assert state.mass == approx(4 / 3 * np.pi * 0.008**3 * 7850, rel=3e-3)


@pytest.mark.few(4)
@pytest.mark.parametrize("key", PRESETS)
def test_every_drive_can_be_chosen_and_its_python_makes_the_scene_and_solves_it(key):
    state = preset_state(key)
    made, values = medium(state), PRESETS[key].values
    elastic = np.inf if state.plasticity == "none" else 0.0
    assert (made.q_c, made.hardness) == (values.get("q_c", elastic), values.get("volume_hardness", 0.0))
    for drive in DRIVES:
        state = changes.choose(state, "drive", drive)
        scene, values = scene_of(state), {}
        code = scene.to_python()
        exec(code, values)
        assert values["scene"] == scene
        assert values["result"].model == scene.models[0]
        assert float(turning_point(state).depth) > 0


def test_a_drag_is_one_change_and_undo_leaves_the_view(page):
    start = page.state.max_depth
    for value in (1.05e-8, 1.25e-8, 1.48e-8):
        part(page, "max_depth").act({"value": value, "dragged": True})
    assert page.state.max_depth > start
    page.apply(lambda state: state.replace(at=0.5))
    page.undo()
    assert (page.state.max_depth, page.state.at) == (start, 0.5)
    assert page.history.at == 0
    page.redo()
    assert page.state.max_depth > start


def test_a_drag_that_returns_to_its_start_is_undone_with_what_was_before(page):
    """The depth is as before the drag; one more step back is the mass."""
    put(page, "mass", 2.0)
    for value in (7e-9, preset_state().max_depth):
        page.apply(
            lambda state, value=value: changes.set_value(state, "max_depth", value), mark="max_depth"
        )
    page.undo()
    page.undo()
    assert page.state.mass == preset_state().mass
    assert page.history.at == 0


REGISTRIES = {
    "plots": plots.PLOTS,
    "overlays": plot.OVERLAYS,
    "drives": drives.DRIVES,
    "choices": quantities.CHOICES,
    "numbers": quantities.QUANTITIES,
    "values": state.OF_EXTRAS,
    "view": state.VIEW,
    "lists": state.LISTS,
    "extras": extra.EXTRAS,
}


def test_a_session_leaves_the_tables_of_extras_as_they_are():
    """They are those of all sessions."""
    before = {name: dict(each) for name, each in REGISTRIES.items()}
    page = Page()
    for name in state.PRESETS:
        page.apply(lambda now, name=name: state.preset_state(name))
    assert {name: dict(each) for name, each in REGISTRIES.items()} == before


def test_what_a_link_has_of_an_extra_is_of_the_state():
    page = Page("held.scenes=max_depth%3D5e-09&tiles=sweep&sweep.swept=mass")
    assert page.state["held.scenes"] == ("max_depth=5e-09",)
    assert [each.name for each in page.view.computed["held"]] == ["d_max = 5 nm"]
