"""What one person can set, without a browser: numbers, choices, presets, undo, links, files, tips."""

import json
from dataclasses import asdict

import numpy as np
import pytest

import mdr_core as mdr
from app import export, link
from app.drives import DRIVES, follow
from app.explorer import FROM_FILE, Explorer
from app.presets import OPENING, PRESETS
from app.quantities import QUANTITIES, SHAPES
from app.tip import MOST_SAMPLES, read_tip
from app.units import fitting, read


def changed(explorer, act, *arguments):
    act(*arguments)
    explorer.accept()


def test_every_preset_gives_its_scene():
    for label, preset in PRESETS.items():
        scene = Explorer(label).scene()
        assert scene.medium.q_c == preset.values["q_c"]
        assert len(follow(scene, 1.0)) > 50


def test_every_number_says_what_it_is():
    for quantity in QUANTITIES.values():
        assert quantity.help.count(". ") >= 1
        assert quantity.help.endswith(".")
        assert quantity.equation


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "sampled"])
def test_a_shape_that_was_looked_at_keeps_its_values(shape):
    explorer = Explorer()
    changed(explorer, explorer.choose, "shape", shape)
    changed(explorer, explorer.choose, "shape", "sphere" if shape == "cone" else "cone")
    assert explorer.cone_slope == 0.358
    changed(explorer, explorer.choose, "shape", "cone")
    assert explorer.cone_slope == 0.358
    assert not explorer.altered


@pytest.mark.parametrize("label", PRESETS)
def test_every_drive_can_be_chosen_from_every_preset(label):
    explorer = Explorer(label)
    for drive in ("force", "impact", "depth"):
        explorer.choose("drive", drive)
        assert float(explorer.solved().depth) > 0


@pytest.mark.parametrize(
    ("text", "value", "surprising"),
    [
        ("25", 25e-9, False),
        ("2,5", 2.5e-9, False),
        ("1e-6", 1e-6, True),
        ("0.012 µm", 12e-9, False),
        ("3e-3um", 3e-9, False),
    ],
)
def test_typed_numbers(text, value, surprising):
    read_value, told = read(text, "length", fitting(9e-9, "length"))
    assert read_value == pytest.approx(value, rel=1e-14)
    assert told == surprising


@pytest.mark.parametrize("text", ["", "abc", "1e999", "nan", "3 MPa", "1,5,2", "1.000,5", "<img src=x>"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", fitting(9e-9, "length"))


def test_undo_leaves_the_player_where_it_stands():
    explorer = Explorer()
    changed(explorer, explorer.type, "max_depth", "20 nm")
    explorer.progress = 0.5
    explorer.undo()
    assert explorer.progress == 0.5
    assert explorer.max_depth == PRESETS[OPENING].values["max_depth"]
    explorer.redo()
    assert explorer.max_depth == pytest.approx(20e-9)


def test_a_drag_is_one_change():
    explorer = Explorer()
    for position in (210, 220, 230):
        changed(explorer, explorer.slide, "max_depth", position)
    explorer.undo()
    assert explorer.max_depth == PRESETS[OPENING].values["max_depth"]
    assert not explorer.past


def test_a_number_out_of_bounds_is_refused_by_name():
    explorer = Explorer()
    with pytest.raises(ValueError, match=r"dₘₐₓ = 1000 m is out of bounds: .* to 10\.00 m"):
        explorer.type("max_depth", "1000 m")


def test_link_holds_the_whole_page():
    explorer = Explorer()
    explorer.type("max_depth", "12 nm")
    explorer.param.update(hold=[link.query(explorer, view=False)], plots=["map", "speed"], dark=True)
    explorer.progress = 0.75
    other = Explorer()
    link.restore(other, link.arguments(link.query(explorer)))
    for name in ("hold", "plots", "dark", "progress", "max_depth", "preset"):
        assert getattr(other, name) == getattr(explorer, name), name
    assert other.scene() == explorer.scene()


@pytest.mark.parametrize(
    "query",
    [
        "preset=none",
        "preset={p}&cone_slope=1e9",
        "preset={p}&shape=ball",
        "preset={p}&at=7",
        "preset={p}&x=1",
        "preset={p}&shape=cone&shape=cone",
        "preset={p}&shape=sampled&samples=0,0 1",
        "preset={p}&q_c=" + 9000 * "1",
    ],
)
def test_a_hostile_link_is_refused(query):
    with pytest.raises(ValueError, match=r"link|bounds|samples"):
        link.restore(Explorer(), link.arguments(query.format(p=OPENING)))


def test_a_scene_file_has_no_preset_of_its_own():
    explorer = Explorer("Steel ball 16 mm on glass-fibre epoxy")
    scene = explorer.scene()
    other = Explorer()
    changed(other, link.load_scene, other, scene.to_json())
    assert other.preset == FROM_FILE
    again = other.scene()
    assert (again.profile, again.drive) == (scene.profile, scene.drive)
    assert asdict(again.medium) == pytest.approx(asdict(scene.medium), rel=1e-15)
    assert again.medium.poisson == 0.3
    assert not other.altered
    other.type("E_1", "1 GPa")
    assert other.altered


def test_a_scene_file_comes_back_where_it_stood():
    explorer = Explorer()
    way = follow(explorer.scene(), 1.5)
    other = Explorer()
    link.load_scene(other, link.scene_file(way))
    assert other.progress == pytest.approx(1.5, rel=1e-6)
    assert other.max_depth == explorer.max_depth


@pytest.mark.parametrize("text", ["", "{}", "[1", "null", json.dumps({"format": "mdr-scene"})])
def test_what_is_no_scene_is_refused(text):
    with pytest.raises(ValueError, match="scene"):
        link.load_scene(Explorer(), text)


@pytest.mark.parametrize("part", ["profile", "drive"])
def test_a_scene_with_a_long_list_is_refused(part):
    many = np.linspace(0, 1e-6, 200)
    tip = mdr.Sampled(many, many**2 / 1e-5) if part == "profile" else mdr.Cone(0.1)
    scene = mdr.Scene(tip, mdr.Medium(1e9), mdr.DepthPath(1e-9 if part == "profile" else many))
    with pytest.raises(ValueError, match=f"a list of 200 numbers, and at most {MOST_SAMPLES}"):
        link.load_scene(Explorer(), scene.to_json())


def table(r, z, between=", ", comma=False):
    rows = [f"{x:.6f}{between}{y:.6f}" for x, y in zip(r, z, strict=True)]
    text = "\n".join([f"r (nm){between}z (nm)", *rows]) + "\n"
    return text.replace(".", ",") if comma else text


def test_measured_tips_as_instruments_write_them():
    r = np.linspace(-200, 200, 801)
    z = 0.2 * np.abs(r) + 0.5 * np.random.default_rng(1).standard_normal(r.size)
    for text in (table(r, z), table(r, z, "; ", comma=True), table(r, z, "\t")):
        (radii, heights), note = read_tip(text)
        assert len(radii) <= MOST_SAMPLES
        assert "801 rows" in note
        tip = mdr.Sampled(radii, heights)
        assert float(tip.height(100e-9)) == pytest.approx(20e-9, rel=0.1)
    few, note = read_tip(table([0, 1, 2, 4], [0, 0.1, 0.3, 1]))
    assert note == "4 samples as they are"
    assert few[1][-1] == pytest.approx(1e-9)
    with pytest.raises(ValueError, match="header must name the units"):
        read_tip("0, 0\n1, 1\n")


@pytest.mark.parametrize("axis", [0, 20])
def test_a_noisy_tip_is_as_hard_as_the_one_that_is_nearest_to_it(axis):
    """As `Sampled.fit` has it of the same rows, wherever the axis is; near the tip without noise."""
    r, medium = np.linspace(-300, 300, 400), Explorer().medium()
    z = r**2 / 2000 + 0.3 * np.random.default_rng(2).standard_normal(r.size)
    samples, note = read_tip(table(r + axis, z, "; ", comma=True))
    assert len(samples[0]) <= MOST_SAMPLES
    assert "which scatter by 290 pm" in note
    depths = [2e-9, 5e-9, 10e-9]
    read, fitted, smooth = (
        mdr.indent(tip, medium, depths).force
        for tip in (mdr.Sampled(*samples), mdr.Sampled.fit(r * 1e-9, z * 1e-9), mdr.Paraboloid(1e-6))
    )
    # The axis is found to about noise/(slope √rows), 0.1 nm.
    np.testing.assert_allclose(read, fitted, rtol=0.01)
    np.testing.assert_allclose(read, smooth, rtol=0.06)


def test_a_tip_of_many_or_of_few_rows():
    rng = np.random.default_rng(3)
    r = np.linspace(0, 300, 20_000)
    radii, heights = read_tip(table(r, r**2 / 2000 + 0.3 * rng.standard_normal(r.size)))[0]
    assert len(radii) <= MOST_SAMPLES
    assert heights[-1] == pytest.approx(45e-9, rel=0.01)
    # Without noise there are more vertices than are kept; between them it is a little too high.
    radii, heights = read_tip(table(r, r**2 / 2000))[0]
    assert len(radii) == MOST_SAMPLES
    np.testing.assert_allclose(heights, radii**2 / 2e-6, atol=0.005e-9)
    # Few rows that noise has made concave.
    r = np.linspace(-50, 50, 41)
    assert "nearest to 41 rows" in read_tip(table(r, 0.2 * np.abs(r) + 0.5 * rng.standard_normal(41)))[1]
    for upside_down in (-np.abs(r), 0 * r):
        with pytest.raises(ValueError, match="does not rise"):
            read_tip(table(r, upside_down))


def test_a_tip_is_pressed_no_deeper_than_it_reaches():
    explorer = Explorer()
    samples, note = read_tip(table([0, 1, 2, 4], [0, 0.1, 0.3, 1]))
    changed(explorer, explorer.take_tip, samples, note)
    assert explorer.max_depth < explorer.profile().known_depth
    assert explorer.scene().solve().force > 0


@pytest.mark.parametrize("drive", DRIVES)
def test_numbers_of_other_drives_are_neither_reported_nor_taken_away_nor_swept(drive):
    theirs = {
        "depth": {"max_depth"},
        "force": {"max_force"},
        "path": set(),
        "impact": {"mass", "speed", "density"},
        "oblique": {"mass", "friction", "incoming_speed", "attack", "density"},
    }
    explorer = Explorer()
    explorer.choose("drive", drive)
    explorer.choose("inertia", "density")
    medium = {"cone_slope", "E_1", "nu_1", "E_2", "nu_2", "q_c"}
    assert set(explorer.used()) == medium | theirs[drive]
    taken = export.csv(follow(explorer.scene(), 1.0), explorer) + link.query(explorer)
    for name in set().union(*theirs.values()) - theirs[drive]:
        assert f" {name} = " not in taken
        assert f"&{name}=" not in taken
        assert drive in ("oblique", "path") or name not in explorer.options("swept")
    # The noise that a fit is given is in the link, whatever the drive.
    explorer.choose("noise", "given")
    assert "depth_noise=" in link.query(explorer)


def test_exports_say_what_the_medium_was_made_of():
    explorer = Explorer()
    text = export.csv(follow(explorer.scene(), 1.0), explorer)
    for part in (
        "poisson = 0.42",
        "E_1 = 78000000000.0",
        "nu_1 = 0.42",
        "E_2 = 1141000000000.0",
        "nu_2 = 0.07",
        OPENING,
    ):
        assert part in text
    data = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
    depth, force = np.array(data[1:], float)[:, :2].T
    expected = mdr.indent(explorer.profile(), explorer.medium(), depth)
    np.testing.assert_allclose(force, expected.force, rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize(
    ("drive", "progress"), [("depth", 0.5), ("depth", 1.5), ("impact", 1.0), ("impact", 1.6)]
)
def test_the_snippet_comes_to_the_state(drive, progress, capsys):
    explorer = Explorer()
    explorer.choose("drive", drive)
    way = follow(explorer.scene(), progress)
    values = {}
    exec(export.python(way), values)
    capsys.readouterr()
    assert values["medium"] == explorer.medium()
    assert values["medium"].poisson == 0.42
    if drive == "impact" and progress != 1.0:
        assert values["motion"].force[values["i"]] == pytest.approx(float(way.state.force), rel=1e-9)
    elif drive == "depth":
        assert values["state"].force == pytest.approx(float(way.state.force), rel=1e-9)
