"""Impacts on the same spot again, and what is held or taken at the state that is seen."""

import json

import numpy as np
import pytest

import mdr_core as mdr
from app import export, link
from app.comparison import compare
from app.state import Explorer
from app.tip import read_tip
from app.trajectory import follow

from .person import Person, arguments
from .test_page import DROP


@pytest.fixture
def person():
    person = Person()
    person.ask("load", label=DROP)
    return person


def hit(person):
    return person.session.drawing.trajectory.hit


@pytest.mark.parametrize("damping", ["none", "tau"])
def test_every_hit_begins_on_the_imprint_of_the_one_before(person, damping):
    person.ask("choose", name="damping", option=damping)
    for _ in range(3):
        before = hit(person)
        meta = person.ask("again")
        expected = mdr.impact(
            before.profile, before.medium, before.mass, before.speed, plastic_depth=before.plastic_depth
        )
        assert hit(person).restitution == expected.restitution
        told = {name: value for name, _, _, value in meta["numbers"]}
        # It yields further where it would have yielded so deep had it been pressed there at once.
        onset = mdr.indent(before.profile, before.medium, before.plastic_depth + told["d_c"])
        assert told["F_c"] == pytest.approx(float(onset.force), rel=1e-9)


def test_ledger_of_a_repeated_impact_is_its_own(person):
    person.ask("again")
    energy = person.array("K") + person.array("U") + person.array("W") + person.array("V")
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)
    assert person.array("W")[0] == 0
    depth, c = person.array("d"), person.array("c")
    assert depth[0] == pytest.approx(person.array("dp")[0], rel=1e-6)
    assert c[0] > 0


def test_imprint_travels_in_link_scene_csv_and_snippet(person):
    meta = person.ask("again")
    left = person.number("plastic_depth")
    trajectory = person.session.drawing.trajectory
    linked = link.restore(arguments(meta["query"]))
    assert linked.drive() == mdr.FreeImpact(5.5, 1.0, left)
    opened = link.from_scene(link.scene_file(trajectory), Explorer())
    assert opened.drive().plastic_depth == pytest.approx(left, rel=1e-12)
    assert f"plastic_depth={left!r}" in export.csv(trajectory)
    scope = {}
    exec(export.python(trajectory), scope)
    assert scope["hit"].restitution == trajectory.hit.restitution
    assert all(row.model != "chain" for row in compare(trajectory.scene, trajectory.hit))
    assert any("first impact" in text for _, text in meta["lights"])
    person.ask("reset")
    assert person.session.state.drive().plastic_depth == 0


def test_what_cannot_be_repeated_is_refused():
    person = Person()
    assert "only an impact" in person.ask("again")["notice"]
    person.ask("choose", name="drive", option="impact")
    person.ask("choose", name="plasticity", option="none")
    assert "nothing has yielded" in person.ask("again")["notice"]
    person.ask("choose", name="surface", option="imprint")
    assert person.session.state.drive().plastic_depth > 0


def test_snippet_and_hold_are_of_the_state_that_is_seen(person):
    # The player tells where it is along with what is asked for.
    at = person.session.drawing.trajectory.progress[40]
    assert person.ask("hold", at=at)["now"] == 40
    person.ask("type", name="speed", text="0.5")
    person.ask("file", what="python", at=person.session.drawing.trajectory.progress[130])
    scope = {}
    exec(person.sent[-1]["text"], scope)
    here, held = person.session.drawing.trajectory, person.session.held.trajectory
    assert (here.now, held.now) == (130, 40)
    for prefix, trajectory in (("", here), ("held_", held)):
        instant = trajectory.now
        motion = scope[f"{prefix}motion"]
        assert motion.time[instant] == trajectory.motion.time[trajectory.now]
        assert motion.force[instant] == trajectory.motion.force[trajectory.now]


def test_pressure_of_a_measured_tip_is_exact_in_its_file_and_says_so():
    tip = read_tip("r (nm), z (nm)\n0 0\n10 1\n20 3\n40 12\n80 40\n")
    scene = mdr.Scene(mdr.Sampled(*tip), mdr.Medium(87e9, 100.0), mdr.DepthPath(5e-9))
    text = export.pressure_csv(follow(scene, 1.0))
    assert "straight lines between its samples" in text
    rows = [line.split(",") for line in text.splitlines() if not line.startswith("#")][1:]
    r, stress = np.array(rows, float)[1:, :2].T
    np.testing.assert_allclose(-stress, scene.solve().pressure(r), rtol=1e-12)


def test_scene_with_an_imprint_that_sticks_out_is_refused(person):
    data = json.loads(link.scene_file(person.session.drawing.trajectory))
    data["drive"]["plastic_depth"] = -1e-6
    assert "plastic_depth" in person.ask("upload", kind="scene", text=json.dumps(data))["notice"]
