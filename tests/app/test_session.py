"""What a person asks for and gets, message by message, without a browser."""

import json
import math

import numpy as np
import pytest

import mdr_core as mdr
from app import link
from app.packet import SPRINGS
from app.presets import OPENING, PRESETS
from app.quantities import CHOICES
from app.shapes import SHAPES
from app.state import Explorer

from .person import Person, arguments


@pytest.fixture
def person():
    return Person()


def test_what_is_sent_is_what_the_core_says(person):
    meta = person.ask("type", name="max_depth", text="20 nm")
    axes, state = meta["axes"], person.session.state
    scene = state.scene()
    deepest = mdr.indent(scene.profile, scene.medium, 20e-9)
    peak = meta["peak"]
    assert meta["now"] == peak
    assert person.array("d")[peak] * axes["d"]["factor"] == pytest.approx(20e-9, rel=1e-6)
    assert person.array("F")[peak] * axes["F"]["factor"] == pytest.approx(deepest.force, rel=1e-6)
    assert person.array("a")[peak] * axes["a"]["factor"] == pytest.approx(deepest.contact_radius, rel=1e-6)
    assert person.array("c")[peak] * axes["a"]["factor"] == pytest.approx(deepest.plastic_radius, rel=1e-6)
    spots = person.array("spot") * axes["x"]["factor"]
    assert len(spots) == SPRINGS // 2
    assert person.array("spot g") * axes["z"]["factor"] == pytest.approx(
        scene.profile.reduced(spots), rel=1e-5
    )
    assert meta["answered"] == 7


@pytest.mark.parametrize("preset", PRESETS)
def test_nothing_leaves_its_axis(preset):
    person = Person()
    meta = person.ask("load", label=preset)
    for array, axis in (("d", "d"), ("F", "F"), ("a", "a"), ("c", "a"), ("spot", "x"), ("t", "t")):
        if array in meta["places"]:
            assert np.max(person.array(array)) <= meta["axes"][axis]["end"]


def test_frames_hold_the_fields_of_every_state(person):
    person.ask("frames")
    message = person.sent[-1]
    places, values = json.loads(message["places"]), message["values"].astype(float)
    part = {name: values[start : start + length] for name, (start, length) in places.items()}
    meta = person.meta
    assert message["frames"] == meta["seq"]
    assert len(part["count"]) == len(meta["progress"])
    way = person.session.drawing.trajectory
    ends = np.cumsum(part["count"]).astype(int)
    for index in (5, meta["peak"], meta["peak"] + 10):
        rows = slice(ends[index] - int(part["count"][index]), ends[index])
        r = part["r"][rows] * meta["axes"]["x"]["factor"]
        p = part["p"][rows] * meta["axes"]["p"]["factor"]
        middle = np.abs(r / way.states.contact_radius[index] - 0.3) < 0.1
        assert p[middle] == pytest.approx(way.states[index].pressure(r[middle]), rel=1e-3)


def test_a_refusal_says_why_and_loses_nothing(person):
    before = person.session.state.snapshot()
    wrong = (
        ("type", {"name": "max_depth", "text": "<b>abc"}),
        ("type", {"name": "max_depth", "text": "1e9 m"}),
        ("type", {"name": "nobody", "text": "1"}),
        ("type", {"name": "max_depth"}),
        ("move", {"name": "max_depth", "position": "x"}),
        ("stand", {"at": 5.0}),
        ("upload", {"kind": "tip", "text": "r (nm), z (nm)\n0, 0\n1, x\n"}),
        ("upload", {"kind": "tip", "text": "0 0\n1 1\n"}),
        ("upload", {"kind": "tip", "text": "r (nm), z (nm)\n0, 0\n1, 5\n2, 6\n"}),
        ("upload", {"kind": "scene", "text": "{"}),
        ("upload", {"kind": "scene", "text": "x" * 2_100_000}),
        ("choose", {"name": "drive", "option": "by magic"}),
        ("choose", {"name": "shape", "option": "sampled"}),
    )
    for do, message in wrong:
        assert person.ask(do, **message)["notice"], do
        assert person.session.state.snapshot() == before
        assert not person.meta["undo"][0]
    assert person.ask("hold")["notice"] == ""


def test_a_flat_punch_that_yields_all_over_is_refused_as_a_force(person):
    person.ask("choose", name="shape", option="flat_punch")
    meta = person.ask("choose", name="drive", option="force")
    assert "whole flat face yields" in meta["notice"]
    assert person.session.state.choices["drive"] == "depth"


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"do": None},
        {"do": ["move"]},
        {"do": "choose"},
        {"do": "choose", "name": [], "option": {}},
        {"do": "load", "label": "<img src=x>"},
        {"do": "move", "name": {}, "position": 1},
        {"do": "move", "name": "max_depth", "position": float("nan")},
        {"do": "stand", "at": "x"},
        {"do": "stand", "at": float("nan")},
        {"do": "double", "name": ["q_c"]},
        {"do": "file", "what": ["curves"]},
        {"do": "upload", "kind": "tip", "text": 7},
        {"do": "upload", "kind": "scene", "text": "[" * 100_000},
    ],
)
def test_message_of_any_form_changes_nothing(person, message):
    before = person.session.state.snapshot()
    person.session.receive(message)
    assert person.session.state.snapshot() == before
    assert person.ask("type", name="max_depth", text="5 nm")["notice"] == ""


def test_a_fault_is_told_logged_once_with_its_scene_and_over(person, monkeypatch, caplog):
    before = person.session.state.snapshot()

    def broken(scene, progress):
        raise ZeroDivisionError

    with monkeypatch.context() as patch:
        patch.setattr("app.session.follow", broken)
        assert "fault of the explorer" in person.ask("type", name="max_depth", text="5 nm")["notice"]
    assert [record.levelname for record in caplog.records] == ["ERROR"]
    logged = caplog.records[0].getMessage().partition("scene ")[2]
    assert mdr.Scene.from_json(logged).drive.depth == pytest.approx(5e-9)
    assert person.session.state.snapshot() == before
    assert person.ask("type", name="max_depth", text="6 nm")["notice"] == ""


@pytest.mark.parametrize("rows", [450, 20_001])
def test_tip_that_would_keep_everybody_waiting_is_refused(person, rows):
    text = "r (nm), z (nm)\n" + "".join(f"{k}, {k * k / 1e4}\n" for k in range(rows))
    assert person.ask("upload", kind="tip", text=text)["notice"]
    assert person.session.state.shape == "cone"


@pytest.mark.parametrize(
    ("drive", "said"),
    [
        (mdr.DepthPath(np.linspace(0, 1e-9, 400)), "400 numbers"),
        (mdr.DepthPath((0.0, 1e-9), (0.0, 1.0)), "in time"),
    ],
)
def test_scene_that_cannot_be_shown_is_refused(person, drive, said):
    scene = mdr.Scene(mdr.Cone(0.3), mdr.Medium(1e9, 1.0, 1.0), drive)
    assert said in person.ask("upload", kind="scene", text=scene.to_json())["notice"]
    assert person.session.state.choices["damping"] == "none"


def test_impact_of_a_tip_with_many_samples_is_refused(person):
    text = "r (nm), z (nm)\n" + "".join(f"{k}, {k * k / 400}\n" for k in range(80))
    assert person.ask("upload", kind="tip", text=text)["notice"] == ""
    assert "80 samples is too much" in person.ask("choose", name="drive", option="impact")["notice"]
    assert person.session.state.choices["drive"] == "depth"


def test_undo_and_redo(person):
    start = person.number("max_depth")
    for position in (210, 220, 230):
        person.ask("move", name="max_depth", position=position)
    moved = person.number("max_depth")
    person.ask("choose", name="shape", option="sphere")
    assert person.ask("undo")["undo"] == [True, True]
    assert person.session.state.shape == "cone"
    # One drag is one step.
    assert person.ask("undo")["undo"] == [False, True]
    assert person.number("max_depth") == start
    person.ask("undo")
    person.ask("redo")
    assert person.number("max_depth") == moved
    person.ask("reset")
    assert person.number("max_depth") == start


def test_double_click_resets_one_number(person):
    start = person.number("q_c")
    person.ask("type", name="q_c", text="250")
    assert person.number("q_c") == 250
    person.ask("double", name="q_c")
    assert person.number("q_c") == start


def test_held_curves_stay_and_the_axes_hold_both(person):
    force = person.array("F").max() * person.meta["axes"]["F"]["factor"]
    person.ask("hold")
    meta = person.ask("type", name="max_depth", text="4 nm")
    assert meta["held"]
    assert person.array("held F").max() * meta["axes"]["F"]["factor"] == pytest.approx(force, rel=1e-6)
    assert meta["axes"]["d"]["end"] * meta["axes"]["d"]["factor"] > 8e-9
    assert person.ask("hold")["held"] is None


@pytest.mark.parametrize("drive", CHOICES["drive"])
@pytest.mark.parametrize("shape", SHAPES)
def test_link_restores_the_page(shape, drive):
    person = Person()
    person.ask("choose", name="shape", option=shape)
    if shape == "flat_punch" and drive == "force":
        person.ask("type", name="max_depth", text="1 nm")
    person.ask("choose", name="drive", option=drive)
    person.ask("choose", name="plasticity", option="hardness")
    person.ask("stand", at=1.25)
    other = Person(arguments(person.meta["query"]))
    assert other.meta["notice"] == ""
    assert other.meta["query"] == person.meta["query"]
    assert other.session.state.scene() == person.session.state.scene()
    assert other.array("F") == pytest.approx(person.array("F"))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("max_depth=8.97", "max_depth=-8.97"),
        ("max_depth=8.97", "max_depth=nan"),
        ("cone_slope=0.358", "cone_slope=1e9"),
        ("shape=cone", "shape=<script>"),
        ("shape=cone", "shape=sampled"),
        ("drive=depth", "drive=magic"),
        ("preset=Berkovich", "preset=Vickers"),
        ("at=1", "at=7"),
        ("at=1", "at=1&wings=2"),
        ("at=1", "at=1&samples=0,0 1"),
        ("at=1", "at=1&samples=0,0 0,1"),
        ("at=1", "at=" + "1" * 9000),
    ],
)
def test_tampered_link_is_refused_with_a_message(person, old, new):
    query = person.meta["query"]
    assert old in query
    other = Person(arguments(query.replace(old, new)))
    assert other.meta["notice"].startswith("The link was not opened")
    assert other.session.state.snapshot() == person.session.state.snapshot()


def test_measured_tip_is_drawn_linked_and_saved(person):
    r = np.linspace(0, 60, 41)
    text = "# AFM\nr (nm), z (nm)\n" + "\n".join(f"{x}, {x * x / 400:.6g}" for x in r)
    meta = person.ask("upload", kind="tip", text=text)
    assert meta["notice"] == ""
    state = person.session.state
    tip = state.profile()
    assert isinstance(tip, mdr.Sampled)
    assert "sampled" in meta["form"]["groups"][0]["rows"][0]["options"]
    result = mdr.indent(tip, state.medium(), state.numbers["max_depth"])
    factor = meta["axes"]["F"]["factor"]
    assert person.array("F").max() * factor == pytest.approx(float(result.force), rel=1e-6)
    other = Person(arguments(meta["query"]))
    assert other.session.state.profile() == tip
    assert Person().ask("upload", kind="tip", text="r (nm), z (nm)\n" + "1,1\n" * 20_001)["notice"]


def test_validity_is_told():
    person = Person()
    lights = person.meta["lights"]
    assert [good for good, _ in lights] == [False, False]
    person.ask("load", label="Steel ball 16 mm on glass-fibre epoxy, drop weight")
    person.ask("choose", name="inertia", option="density")
    lights = person.meta["lights"]
    assert lights[-1][0]
    assert "wave speed" in lights[-1][1]
    assert not person.ask("type", name="speed", text="900 m/s")["notice"]
    assert not person.meta["lights"][-1][0]


def test_infinite_yield_constant_travels_as_null(person):
    meta = person.ask("choose", name="plasticity", option="none")
    assert meta["numbers"][0][3] is None
    assert meta["onset"] is None
    assert math.isinf(link.restore(arguments(meta["query"])).medium().q_c)


def test_everything_of_a_person_stays_with_them():
    one, two = Person(), Person()
    one.ask("type", name="max_depth", text="30 nm")
    assert two.number("max_depth") == Explorer(OPENING).numbers["max_depth"]
