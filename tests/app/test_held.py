"""Scenes that are held: kept with their names in the link, told apart, and removed."""

import numpy as np
import pytest

from app import columns, export, link
from app.drives import follow
from app.explorer import Explorer
from app.held import Held, is_held, numbers, renamed, toggled
from app.held import held as opened
from app.plots import DASHES, PLOTS
from app.units import written
from app.view import View

from .conftest import DROP


def held(query):
    """What a query holds."""
    return opened(query, lambda explorer: follow(explorer.scene(), explorer.progress))


def holding(*depths):
    """An explorer that has held itself at some depths."""
    explorer = Explorer()
    for depth in depths:
        explorer.max_depth = depth
        explorer.hold = toggled(explorer)
    return explorer


def test_one_gesture_holds_a_scene_and_lets_it_go():
    explorer = holding(6e-9, 9e-9)
    assert [held(query).way.deepest.depth for query in explorer.hold] == [6e-9, 9e-9]
    explorer.progress = 0.4
    assert is_held(explorer)
    explorer.hold = toggled(explorer)
    assert [held(query).way.deepest.depth for query in explorer.hold] == [6e-9]
    assert not is_held(explorer)
    # How it is looked at makes no other scene of it.
    explorer.max_depth = 6e-9
    explorer.choose("axes", "ratio")
    assert is_held(explorer)


def test_springs_keep_their_height_beside_a_deeper_scene():
    explorer = holding(9e-9, 2e-9)
    way = follow(explorer.scene(), 1.0)
    alone, beside = View(way), View(way, [held(explorer.hold[0]).way])
    assert beside.end["z"] == alone.end["z"]
    assert beside.end["d"] > alone.end["d"]


def test_a_fifth_is_refused():
    explorer = holding(1e-9, 2e-9, 3e-9, 4e-9)
    assert len(explorer.hold) == len(DASHES) == 4
    explorer.max_depth = 5e-9
    with pytest.raises(ValueError, match="4 scenes are held: remove one"):
        toggled(explorer)
    explorer.hold = [*explorer.hold, explorer.hold[0]]
    with pytest.raises(ValueError, match="more than 4"):
        link.restore(Explorer(), link.arguments(link.query(explorer)))


def test_names_and_choices_of_the_view_come_back_from_the_link():
    explorer = holding(6e-9, 9e-9)
    explorer.hold = [explorer.hold[0], renamed(explorer.hold[1], "50 % & <b> + 1")]
    explorer.param.update(axes="ratio", references="all", heights="to_scale")
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    assert other.hold == explorer.hold
    assert [held(query).name for query in other.hold] == [f"{explorer.preset}, altered", "50 % & <b> + 1"]
    assert (other.axes, other.references, other.heights) == ("ratio", "all", "to_scale")
    # Undo leaves the view alone.
    other.type("max_depth", "7 nm")
    other.accept()
    other.choose("axes", "units")
    other.undo()
    assert other.axes == "units"


@pytest.mark.parametrize("query", ["", "preset=none", "preset=x&called=1", "a b", "&called="])
def test_what_is_no_scene_is_refused(query):
    with pytest.raises(ValueError, match="link"):
        held(query)


def test_the_numbers_are_those_of_the_deepest_state_and_of_the_impact():
    explorer = Explorer(DROP)
    hit, found = explorer.scene().solve(), numbers(follow(explorer.scene(), 0.3))
    assert found["e"] == f"{hit.restitution:.4f}"
    assert found["d_max"] == written(float(hit.max_depth), "length")
    assert found["F_max"] == written(float(hit.max_force), "force")
    assert found["W_p"] == written(float(hit.plastic_work), "energy")
    assert numbers(follow(Explorer().scene(), 1.0))["e"] == "–"


def test_each_has_its_own_row_in_every_plot():
    explorer = holding(3e-9, 6e-9, 9e-9, 12e-9)
    ways = [held(query).way for query in explorer.hold]
    view = View(follow(explorer.scene(), 1.0), ways)
    rows = columns.force_still(view)
    for k, way in enumerate(ways, 1):
        np.testing.assert_array_equal(rows[f"held {k}"][1], way.force)
        for name in ("pressure", "radii", "loglog"):
            row = f"held {k} a" if name == "radii" else f"held {k}"
            assert np.isfinite(view.columns(PLOTS[name], view.way.now)[row][1]).any()
    looks = {row.look["dash"] for row in PLOTS["force"].rows if row.role == "held"}
    assert len(looks) == len(ways)


def test_the_snippet_has_all_that_is_held(capsys):
    kept = [
        Held("one\nimport os", follow(Explorer().scene(), 1.0)),
        Held("two", follow(Explorer(DROP).scene(), 1.0)),
    ]
    text, values = export.python(kept[0].way, kept), {}
    assert "\nimport os" not in text
    exec(text, values)
    assert values["held_1_state"].force == pytest.approx(float(kept[0].way.state.force), rel=1e-12)
    assert values["held_2_hit"].restitution == pytest.approx(float(kept[1].way.hit.restitution), rel=1e-12)
