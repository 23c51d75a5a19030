"""What one person can set, without a browser: numbers, choices, presets, links of both versions, tips."""

from math import pi, radians, tan
from urllib.parse import urlencode

import numpy as np
import pytest

import mdr_core as mdr
from app import changes
from app.panels import share
from app.solve import DRIVES, follow, numbers_of, scene_of, turning_point
from app.state import OPENING, PRESETS, VIEW, State, altered, link, medium, preset_state, profile
from app.state.files import MAX_SAMPLES, read_tip
from app.state.quantities import QUANTITIES, SHAPES, Scale
from app.state.units import entry, fitting, read, written

from .conftest import DROP, PUNCH
from .states import linked_state, state_with
from .states import written as link_of


def test_every_preset_gives_its_scene():
    for key, preset in PRESETS.items():
        assert medium(preset_state(key)).q_c == preset.values["q_c"]
        assert len(follow(preset_state(key))) > 50


def test_a_state_is_small_frozen_and_known():
    """About 75 values; what is not one of them is refused."""
    state = preset_state()
    assert 60 <= len(state) <= 100
    with pytest.raises(AttributeError, match="max_depth"):
        state.max_depth = 1.0
    with pytest.raises(KeyError, match="no max_deph"):
        state.replace(max_deph=1.0)
    assert state == State(dict(state))


def test_every_number_says_what_it_is():
    for quantity in QUANTITIES.values():
        assert quantity.help.count(". ") >= 1
        assert quantity.help.endswith(".")
        assert quantity.equation


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "sampled"])
def test_a_shape_that_was_looked_at_keeps_its_values(shape):
    state = state_with(shape=shape)
    state = changes.choose(state, "shape", "sphere" if shape == "cone" else "cone")
    assert state.cone_slope == 0.358
    state = changes.choose(state, "shape", "cone")
    assert state.cone_slope == 0.358
    assert not altered(state)


def test_a_sphere_has_the_radius_of_the_paraboloid_before():
    state = state_with(shape="paraboloid")
    assert changes.choose(state, "shape", "sphere").sphere_radius == state.paraboloid_radius


@pytest.mark.parametrize("key", PRESETS)
def test_every_drive_can_be_chosen_from_every_preset(key):
    state = preset_state(key)
    for drive in ("force", "impact", "depth", "oblique", "path"):
        state = changes.choose(state, "drive", drive)
        assert float(turning_point(state).depth) > 0


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("25", "length", 25e-9),
        ("2,5", "length", 2.5e-9),
        ("1e-6", "length", 1e-6),
        ("0.012 µm", "length", 12e-9),
        ("3e-3um", "length", 3e-9),
        ("10 000 nm", "length", 1e-5),
        ("10\u202f000 nm", "length", 1e-5),
        ("5 Å", "length", 5e-10),
        ("70.3°", "slope", 1 / tan(radians(70.3))),
        ("0.36", "slope", 0.36),
        ("90", "angle", pi / 2),
    ],
)
def test_typed_numbers(text, kind, value):
    shown = fitting(9e-9 if kind == "length" else 0.3, kind)
    assert read(text, kind, shown) == pytest.approx(value, rel=1e-14)


def test_an_angle_of_90_degrees_is_taken():
    state = changes.typed(state_with(DROP, "oblique"), "attack", "90")
    assert state.attack == pi / 2
    assert scene_of(state).drive.tangential_speed == pytest.approx(0.0, abs=1e-12)


def test_a_zero_has_the_unit_of_its_column():
    """A bare 5 typed over it is 5 nm, not 5 m."""
    assert entry(0.0, "length", 9e-9) == "0 nm"
    assert written(float("inf"), "length") == "∞"
    state = changes.typed(preset_state(), "contact_point", "5", like=9e-9)
    assert state.contact_point == pytest.approx(5e-9)


@pytest.mark.parametrize(
    "text", ["", "abc", "1e999", "nan", "3 MPa", "1,5,2", "1.000,5", "<img src=x>", "5°"]
)
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", fitting(9e-9, "length"))


def test_a_number_out_of_bounds_is_refused_by_name():
    with pytest.raises(ValueError, match=r"dₘₐₓ = 1000 m is out of bounds: .* to 10\.00 m"):
        changes.typed(preset_state(), "max_depth", "1000 m")


def test_E_star_of_two_bodies_and_q_c_of_a_hardness_can_be_set():
    state = changes.put(preset_state(), "E_star", 5e10)
    assert state.elasticity == "bodies"
    assert medium(state).E_star == pytest.approx(5e10, rel=1e-12)
    assert medium(state).poisson == 0.42
    state = changes.put(state_with(plasticity="hardness"), "q_c", 50.0)
    assert medium(state).q_c == pytest.approx(50.0, rel=1e-12)


def test_a_slider_begins_where_the_preset_does_and_reaches_what_is_typed():
    scale = Scale(QUANTITIES["q_c"], 100.0)
    assert scale.position(100.0) == scale.STEPS // 2
    assert scale.reaches(3000.0)
    assert not scale.reaches(3001.0)
    assert scale.value(scale.STEPS) == 3000.0


# Links.


def test_the_link_of_a_preset_is_its_name():
    assert link_of(preset_state()) == ""
    assert link_of(preset_state(DROP)) == f"preset={DROP}"
    assert link_of(preset_state().replace(max_depth=2e-9)) == "max_depth=2e-09"


@pytest.mark.parametrize("drive", DRIVES)
def test_a_link_holds_the_whole_page(drive):
    state = state_with(DROP, drive, damping="tau", shape="sphere")
    state = state.replace(progress=0.75, hold=(link_of(state),), tiles=("sweep", "section"))
    state = state.replace(dark=True, keep=True, fit_note="a < b")
    state = state.replace(section="zz")
    again = linked_state(state)
    assert scene_of(again) == scene_of(state)
    for name in (*VIEW, "section", "fit_note"):
        assert again[name] == state[name], name
    assert scene_of(link.read(again.hold[0])) == scene_of(state)
    assert len(link_of(state)) < 700


def test_a_link_of_version_0_3_is_read():
    label = PRESETS[DROP].label
    hold = urlencode({"preset": label, "shape": "cone", "cone_slope": 0.2, "at": 1}) + "&called=blunt"
    old = {
        "preset": label, "shape": "paraboloid", "drive": "impact", "elasticity": "bodies",
        "plasticity": "q_c",
        "damping": "none", "swept": "energy", "paraboloid_radius": "0.008", "E_1": "1e10", "speed": "2.0",
        "energy_from": "0.1", "mass_to": "9.0", "at": "1.5", "plots": "map sweep", "dark": "1",
        "hold": hold, "axes": "ratio", "references": "all", "heights": "to_scale",
    }  # fmt: skip
    state = link.read(urlencode(old))
    assert (state.speed, state.progress, state.swept) == (2.0, 1.5, "energy")
    assert (state.tiles, state.dark) == (("map", "sweep"), True)
    assert link.read(state.hold[0]).cone_slope == 0.2
    with pytest.raises(ValueError, match=r"version 0\.3 took from a file"):
        link.read("preset=")


@pytest.mark.parametrize(
    "query",
    [
        "preset=none", "cone_slope=1e9", "shape=ball", "at=7", "x=1", "shape=cone&shape=cone", "at=nan",
        "shape=sampled&samples=0,0 1", "q_c=" + 9000 * "1", "hold=a b c d e", "shape=sphere",
        "fixed=everything", "drive=path&pattern=own&path=1e-8 2e-8",
    ],
)  # fmt: skip
def test_a_hostile_link_is_refused(query):
    with pytest.raises(ValueError, match=r"link|bounds|samples|vertices"):
        link.read(query)


# Measured tips.


def table(r, z, between=", ", comma=False):
    rows = [f"{x:.6f}{between}{y:.6f}" for x, y in zip(r, z, strict=True)]
    text = "\n".join([f"r (nm){between}z (nm)", *rows]) + "\n"
    return text.replace(".", ",") if comma else text


def test_measured_tips_as_instruments_write_them():
    r = np.linspace(-200, 200, 801)
    z = 0.2 * np.abs(r) + 0.5 * np.random.default_rng(1).standard_normal(r.size)
    for text in (table(r, z), table(r, z, "; ", comma=True), table(r, z, "\t")):
        (radii, heights), note = read_tip(text)
        assert len(radii) <= MAX_SAMPLES
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
    r, gold = np.linspace(-300, 300, 400), medium(preset_state())
    z = r**2 / 2000 + 0.3 * np.random.default_rng(2).standard_normal(r.size)
    samples, note = read_tip(table(r + axis, z, "; ", comma=True))
    assert len(samples[0]) <= MAX_SAMPLES
    assert "which scatter by 290 pm" in note
    depths = [2e-9, 5e-9, 10e-9]
    read, fitted, smooth = (
        mdr.indent(tip, gold, depths).force
        for tip in (mdr.Sampled(*samples), mdr.Sampled.fit(r * 1e-9, z * 1e-9), mdr.Paraboloid(1e-6))
    )
    # The axis is found to about noise/(slope √rows), 0.1 nm.
    np.testing.assert_allclose(read, fitted, rtol=0.01)
    np.testing.assert_allclose(read, smooth, rtol=0.06)


def test_a_tip_of_many_or_of_few_rows():
    rng = np.random.default_rng(3)
    r = np.linspace(0, 300, 20_000)
    radii, heights = read_tip(table(r, r**2 / 2000 + 0.3 * rng.standard_normal(r.size)))[0]
    assert len(radii) <= MAX_SAMPLES
    assert heights[-1] == pytest.approx(45e-9, rel=0.01)
    # Without noise there are more vertices than are kept; between them it is a little too high.
    radii, heights = read_tip(table(r, r**2 / 2000))[0]
    assert len(radii) == MAX_SAMPLES
    np.testing.assert_allclose(heights, radii**2 / 2e-6, atol=0.005e-9)
    # Few rows that noise has made concave.
    r = np.linspace(-50, 50, 41)
    assert "nearest to 41 rows" in read_tip(table(r, 0.2 * np.abs(r) + 0.5 * rng.standard_normal(41)))[1]
    for upside_down in (-np.abs(r), 0 * r):
        with pytest.raises(ValueError, match="does not rise"):
            read_tip(table(r, upside_down))


def test_a_tip_is_pressed_no_deeper_than_it_reaches():
    samples, note = read_tip(table([0, 1, 2, 4], [0, 0.1, 0.3, 1]))
    state = changes.take_tip(preset_state(), samples, note)
    assert state.max_depth < profile(state).known_depth
    assert follow(state).turning_point.force > 0


# What is taken away.


@pytest.mark.parametrize("drive", DRIVES)
def test_numbers_of_other_drives_are_neither_reported_nor_taken_away_nor_swept(drive):
    theirs = {
        "depth": {"max_depth"},
        "force": {"max_force"},
        "path": {"max_depth"},
        "impact": {"mass", "speed", "density"},
        "oblique": {"mass", "friction", "incoming_speed", "attack", "density"},
    }
    state = state_with(OPENING, drive, inertia="density")
    used = {"cone_slope", "E_1", "nu_1", "E_2", "nu_2", "q_c"}
    assert set(numbers_of(state)) == used | theirs[drive]
    taken = share.csv(follow(state), state) + link_of(state)
    for name in set().union(*theirs.values()) - theirs[drive]:
        assert f" {QUANTITIES[name].symbol} = " not in taken
        assert f"&{name}=" not in taken
        assert drive in ("oblique", "path") or name not in changes.options(state, "swept")


def test_the_csv_has_the_scene_and_its_states():
    state = preset_state()
    lines = share.csv(follow(state), state).splitlines()
    assert any("poisson=0.42" in line for line in lines)
    heads, *rows = (line.split(",") for line in lines if line[0] != "#")
    assert heads[:2] == ["normal force F (N)", "indentation depth d (m)"]
    force, depth = np.array(rows, float)[:, :2].T
    expected = mdr.indent(profile(state), medium(state), depth)
    np.testing.assert_allclose(force, expected.force, rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize("key", PRESETS)
@pytest.mark.parametrize("drive", DRIVES)
def test_the_python_makes_the_scene_and_solves_it(key, drive):
    scene, values = scene_of(state_with(key, drive)), {}
    code = share.python(scene)
    exec(code, values)
    assert values["scene"] == scene
    assert values["result"].model == scene.models[0]
    assert len(code.splitlines()) <= 15


def test_the_pressure_of_a_state_is_taken_away():
    state = preset_state(PUNCH)
    rows = [
        r.split(",") for r in share.pressure_csv(follow(state), state).splitlines() if not r.startswith("#")
    ]
    r, sigma = np.array(rows[1:], float)[:, :2].T
    np.testing.assert_allclose(-sigma, follow(state).state.pressure(r), rtol=1e-12)
