"""What one person can set, without a browser: numbers, choices, presets, links of both versions, tips."""

import re
from dataclasses import fields
from math import pi, radians, tan
from urllib.parse import urlencode

import numpy as np
import pytest

import mdr_core as mdr
from app import changes
from app.panels import share
from app.solve import DRIVES, follow, scene_of, turning_point
from app.state import OPENING, PRESETS, VIEW, altered, link, medium, preset_state, profile, used
from app.state.files import MAX_SAMPLES, read_tip
from app.state.quantities import QUANTITIES, SHAPES
from app.state.units import entry, fitting, read, written

from .conftest import DROP
from .states import linked_state, state_with, table, view_of


def test_a_state_is_small_frozen_and_known():
    """About 75 values; what is not one of them is refused."""
    state = preset_state()
    assert 60 <= len(fields(state)) <= 100
    with pytest.raises(AttributeError, match="max_depth"):
        state.max_depth = 1.0
    with pytest.raises(TypeError, match="max_deph"):
        state.replace(max_deph=1.0)
    assert state.replace(max_depth=1.0).replace(max_depth=state.max_depth) == state


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "sampled"])
def test_a_shape_that_was_looked_at_keeps_its_values(shape):
    state = state_with(shape=shape)
    state = changes.choose(state, "shape", "sphere" if shape == "cone" else "cone")
    assert state.cone_slope == 0.358
    assert not altered(changes.choose(state, "shape", "cone"))
    # A sphere has the radius of a paraboloid that was there before.
    state = state_with(shape="paraboloid")
    assert changes.choose(state, "shape", "sphere").sphere_radius == state.paraboloid_radius


TYPED = [
    ("25", "length", 25e-9), ("2,5", "length", 2.5e-9), ("1e-6", "length", 1e-6), ("5 Å", "length", 5e-10),
    ("0.012 µm", "length", 12e-9), ("3e-3um", "length", 3e-9), ("10 000 nm", "length", 1e-5),
    ("10\u202f000 nm", "length", 1e-5), ("70.3°", "slope", 1 / tan(radians(70.3))), ("0.36", "slope", 0.36),
    ("90", "angle", pi / 2), ("0,125", "length", 0.125e-9), ("1234,567 nm", "length", 1234.567e-9),
]  # fmt: skip


@pytest.mark.parametrize(("text", "kind", "value"), TYPED)
def test_typed_numbers(text, kind, value):
    shown = fitting(9e-9 if kind == "length" else 0.3, kind)
    assert read(text, kind, shown)[0] == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize("text", ["1,500 nm", "-12,345", "−999,000 nm"])
def test_a_comma_that_may_separate_thousands_is_refused_with_both_readings(text):
    whole, part = (text.replace(",", instead).replace("−", "-") for instead in ("", "."))
    with pytest.raises(ValueError, match=f"“{text}” can be {whole} or {part}: type one of these"):
        read(text, "length", fitting(9e-9, "length"))


def test_a_zero_has_the_unit_of_its_column():
    """A bare 5 typed over it is 5 nm, not 5 m."""
    unit = fitting(0.0, "length", 9e-9)
    assert entry(0.0, unit) == "0 nm"
    assert written(float("inf"), "length") == "∞"
    assert read("5", "length", unit) == (5e-9, unit)


@pytest.mark.parametrize("text", ["", "abc", "1e999", "nan", "3 MPa", "1,5,2", "1.000,5", "<b>", "5°"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", fitting(9e-9, "length"))
    with pytest.raises(ValueError, match=r"dₘₐₓ = 1000 m is out of bounds: .* to 10\.00 m"):
        changes.put(preset_state(), "max_depth", 1000.0)


def test_E_star_of_two_bodies_and_q_c_of_a_hardness_can_be_set():
    state = changes.put(preset_state(), "E_star", 5e10)
    assert state.elasticity == "bodies"
    assert medium(state).E_star == pytest.approx(5e10, rel=1e-12)
    assert medium(state).poisson == 0.42
    state = changes.put(state_with(plasticity="hardness"), "q_c", 50.0)
    assert medium(state).q_c == pytest.approx(50.0, rel=1e-12)


def test_the_link_of_a_preset_is_its_name():
    assert link.write(preset_state()) == ""
    assert link.write(preset_state(DROP)) == f"preset={DROP}"
    assert link.write(preset_state().replace(max_depth=2e-9)) == "max_depth=2e-09"


@pytest.mark.parametrize("drive", DRIVES)
def test_a_link_holds_the_whole_page(drive):
    state = state_with(DROP, drive, damping="eta", shape="sphere")
    state = state.replace(progress=0.75, hold=(link.write(state),), tiles=("sweep", "section"))
    state = state.replace(dark=True, fit_note="a < b", section="zz")
    again = linked_state(state)
    assert scene_of(again) == scene_of(state)
    for name in (*VIEW, "section", "fit_note"):
        assert again[name] == state[name], name
    assert scene_of(link.read(again.hold[0])) == scene_of(state)
    assert len(link.write(state)) < 700


def test_links_of_earlier_versions_are_read():
    old = {
        "preset": PRESETS[DROP].label, "paraboloid_radius": "0.008", "speed": "2.0", "energy_from": "0.1",
        "at": "1.5", "plots": "map sweep", "hold": "shape=cone&cone_slope=0.2&called=blunt",
        "axes": "ratio", "references": "all", "sweep_axes": "linear", "keep": "1", "inertia": "unknown",
    }  # fmt: skip
    state = link.read(urlencode(old))
    assert (state.speed, state.progress, state.tiles) == (2.0, 1.5, ("map", "sweep"))
    assert link.read(state.hold[0]).cone_slope == 0.2
    with pytest.raises(ValueError, match=r"version 0\.3 took from a file"):
        link.read("preset=")
    # τ = 4η/E*, a rigid tip, and the components of an oblique speed are converted.
    state = link.read(f"preset={DROP}&damping=tau&tau=0.0002&swept=tau")
    assert medium(state).relaxation_time == pytest.approx(2e-4, rel=1e-12)
    assert state.swept == "eta"
    state = link.read("elasticity=rigid_tip&E_1=2e9&nu_1=0.5")
    assert medium(state).E_star == pytest.approx(2e9 / 0.75, rel=1e-12)
    state = link.read(f"preset={DROP}&drive=oblique&aim=components&speed=3&tangential_speed=4&friction=0.2")
    drive = scene_of(state).drive
    assert (drive.speed, drive.tangential_speed) == pytest.approx((3, 4), rel=1e-12)
    assert link.read(f"preset={DROP}&surface=imprint&noise=given").plastic_depth == 1e-6
    # A compliance of the frame, which a fit had up to version 0.6.
    state = link.read("frame_compliance=1e-05&fixed=q_c+frame_compliance&baseline=1e-08")
    assert (state.fixed, state.baseline) == (("q_c",), 1e-8)


@pytest.mark.parametrize(
    "query",
    [
        "preset=none", "cone_slope=1e9", "shape=ball", "at=7", "shape=cone&shape=cone", "at=nan",
        "shape=sampled&samples=0,0 1", "q_c=" + 9000 * "1", "hold=a b c d e", "shape=sphere",
        "fixed=everything", "drive=path&pattern=own&path=1e-8 2e-8",
    ],
)  # fmt: skip
def test_a_hostile_link_is_refused(query):
    with pytest.raises(ValueError, match=r"link|bounds|samples|vertices"):
        link.read(query)


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("max_depth=1e400", "max_depth = 1e400 in this link is too large"),
        ("max_depth=-1e400", "max_depth = -1e400 in this link is too large"),
        ("max_depth=deep", "max_depth = deep in this link is not a number"),
        ("max_depth=nan", "max_depth = nan in this link is not a number"),
        ("max_depth", "max_depth in this link has no value"),
        ("max_depth=+", "max_depth in this link has no value"),
        ("shape=", "shape in this link has no value"),
        ("at=", "at in this link has no value"),
    ],
)
def test_a_link_is_refused_for_what_is_wrong(query, says):
    with pytest.raises(ValueError, match=f"^{re.escape(says)}$"):
        link.read(query)


def test_what_others_append_to_a_link_is_left_out_and_other_names_are_told():
    query = "utm_source=teams&max_depth=5e-09&fbclid=IwAR" + 9000 * "0" + "&utm_source=a&foo=1&hold=bar%3D2"
    state = link.read(query)
    assert (state.max_depth, link.write(state.replace(hold=()))) == (5e-9, "max_depth=5e-09")
    assert link.unknown(query) == ["foo", "bar"]
    appended = "UTM_SOURCE=a&mkt_tok=b&mibextid=c&si=d&vero_id=e&ref=f&FBCLID=g&references=all"
    assert link.unknown(appended) == []
    assert link.read(appended) == preset_state()
    # Names that only begin like these, or like a number of the page, are told.
    assert link.unknown("size=1&refer=2&MAX_DEPTH=3") == ["size", "refer", "MAX_DEPTH"]
    state = preset_state(DROP).replace(progress=0.5, tiles=("sweep",), dark=True, hold=("at=1",))
    assert link.unknown(f"{link.write(state)}&tau=1&aim=speed&references=all&sweep_from=1") == []


def test_a_measured_tip_is_taken_as_it_is_or_made_convex():
    few, note = read_tip(table({"r (nm)": [0, 1, 2, 4], "z (nm)": [0, 0.1, 0.3, 1]}))
    assert note == "4 samples as they are"
    assert few[1][-1] == pytest.approx(1e-9)
    state = changes.take_tip(preset_state(), few, note)
    assert state.max_depth < profile(state).known_depth
    assert follow(state).turning_point.force > 0
    rng, r = np.random.default_rng(3), np.linspace(0, 300, 20_000)
    z = r**2 / 2000 + 0.3 * rng.standard_normal(r.size)
    radii, heights = read_tip(table({"r (nm)": r, "z (nm)": z}, "\t"))[0]
    assert len(radii) <= MAX_SAMPLES
    assert heights[-1] == pytest.approx(45e-9, rel=0.01)
    # Few rows that noise has made concave.
    r = np.linspace(-50, 50, 41)
    z = 0.2 * np.abs(r) + 0.5 * rng.standard_normal(41)
    assert "nearest to 41 rows" in read_tip(table({"r (nm)": r, "z (nm)": z}))[1]
    with pytest.raises(ValueError, match="does not rise"):
        read_tip(table({"r (nm)": r, "z (nm)": -np.abs(r)}))


def test_a_noisy_tip_is_as_hard_as_the_one_that_is_nearest_to_it():
    """As `Sampled.fit` has it of the same rows about their axis."""
    r = np.linspace(-300, 300, 400)
    z = r**2 / 2000 + 0.3 * np.random.default_rng(2).standard_normal(r.size)
    samples, note = read_tip(table({"r (nm)": r + 20, "z (nm)": z}, "; ", comma=True))
    assert "which scatter by 290 pm" in note
    tips = mdr.Sampled(*samples), mdr.Sampled.fit(r * 1e-9, z * 1e-9)
    depths = [2e-9, 5e-9, 10e-9]
    read, fitted = (mdr.indent(tip, medium(preset_state()), depths).force for tip in tips)
    # The axis is found to about noise/(slope √rows), 0.1 nm.
    np.testing.assert_allclose(read, fitted, rtol=0.01)


@pytest.mark.parametrize("drive", DRIVES)
def test_numbers_of_other_drives_are_neither_reported_nor_taken_away_nor_swept(drive):
    theirs = {"depth": {"max_depth"}, "force": {"max_force"}, "path": {"max_depth"}}
    theirs["impact"] = {"mass", "speed", "plastic_depth", "density"}
    theirs["oblique"] = {"mass", "friction", "incoming_speed", "attack", "density"}
    state = state_with(OPENING, drive)
    assert set(used(state)) == {"cone_slope", "E_1", "nu_1", "E_2", "nu_2", "q_c"} | theirs[drive]
    taken = share.csv(view_of(state)) + link.write(state)
    for name in set().union(*theirs.values()) - theirs[drive]:
        assert f" {QUANTITIES[name].symbol} = " not in taken
        assert f"&{name}=" not in taken
        assert drive in ("oblique", "path") or name not in changes.options(state, "swept")


def test_the_csv_has_the_scene_and_its_states():
    state = preset_state()
    lines = share.csv(view_of(state)).splitlines()
    assert any("poisson=0.42" in line for line in lines)
    heads, *rows = (line.split(",") for line in lines if line[0] != "#")
    assert heads[:2] == ["normal force F (N)", "indentation depth d (m)"]
    force, depth = np.array(rows, float)[:, :2].T
    expected = mdr.indent(profile(state), medium(state), depth)
    np.testing.assert_allclose(force, expected.force, rtol=1e-9, atol=1e-20)
    rows = [line.split(",") for line in share.pressure_csv(view_of(state)).splitlines() if line[0] != "#"]
    r, sigma = np.array(rows[1:], float)[:, :2].T
    np.testing.assert_allclose(-sigma, follow(state).state.pressure(r), rtol=1e-12)


@pytest.mark.parametrize("key", PRESETS)
def test_every_drive_can_be_chosen_and_its_python_makes_the_scene_and_solves_it(key):
    state = preset_state(key)
    assert medium(state).q_c == PRESETS[key].values["q_c"]
    for drive in DRIVES:
        state = changes.choose(state, "drive", drive)
        scene, values = scene_of(state), {}
        code = scene.to_python()
        exec(code, values)
        assert values["scene"] == scene
        assert values["result"].model == scene.models[0]
        assert float(turning_point(state).depth) > 0
        assert len(code.splitlines()) <= 15
