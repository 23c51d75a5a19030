"""What one person can set, without a browser: numbers, choices, presets, links of both versions, tips."""

import re
from dataclasses import fields

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.common.quantities import CHOICES, QUANTITIES
from app.common.tip import read_tip
from app.common.upload import MAX_SAMPLES
from app.explorer import changes, link
from app.explorer.drives import DRIVES, follow, scene_of, turning_point
from app.explorer.extras import share
from app.explorer.page import Page
from app.explorer.state import OPENING, PRESETS, VIEW, altered, medium, preset_state, profile, used

from ..approx import approx
from .conftest import DROP
from .states import linked_state, part, side, state_with, table, view_of


def test_a_state_is_small_frozen_and_known():
    """Some 50 values, of which all numbers of the page are; what is not one of them is refused."""
    state = preset_state()
    assert 40 <= len(fields(state)) <= 60
    assert {name for name in QUANTITIES if "." not in name} <= {each.name for each in fields(state)}
    with pytest.raises(AttributeError, match="max_depth"):
        state.max_depth = 1.0
    with pytest.raises(TypeError, match="max_deph"):
        state.replace(max_deph=1.0)
    assert state.replace(max_depth=1.0).replace(max_depth=state.max_depth) == state


@pytest.mark.parametrize("shape", [shape for shape in CHOICES["shape"].options if shape != "sampled"])
def test_a_shape_that_was_looked_at_keeps_its_values(shape):
    state = state_with(shape=shape)
    state = changes.choose(state, "shape", "sphere" if shape == "cone" else "cone")
    assert state.cone_slope == 0.358
    assert not altered(changes.choose(state, "shape", "cone"))
    # A sphere has the radius of a paraboloid that was there before.
    state = state_with(shape="paraboloid")
    assert changes.choose(state, "shape", "sphere").sphere_radius == state.paraboloid_radius


def test_a_number_out_of_bounds_is_refused_with_its_symbol_and_bounds():
    with pytest.raises(ValueError, match=r"dₘₐₓ = 1000 m is out of bounds: .* to 10\.00 m"):
        changes.put(preset_state(), "max_depth", 1000.0)


def test_E_star_of_two_bodies_and_q_c_of_a_hardness_can_be_set():
    state = changes.put(preset_state(), "E_star", 5e10)
    assert state.elasticity == "bodies"
    assert medium(state).E_star == approx(5e10, rel=1e-12)
    assert medium(state).poisson == 0.42
    state = changes.put(state_with(plasticity="hardness"), "q_c", 50.0)
    assert medium(state).q_c == approx(50.0, rel=1e-12)


def test_the_link_of_a_preset_is_its_name():
    assert link.write(preset_state()) == ""
    assert link.write(preset_state(DROP)) == f"preset={DROP}"
    assert link.write(preset_state().replace(max_depth=2e-9)) == "max_depth=2e-09"


@pytest.mark.parametrize("drive", DRIVES)
def test_a_link_holds_the_whole_page(drive):
    state = state_with(DROP, drive, damping="eta", shape="sphere")
    state = state.replace(at=0.75, tiles=("sweep", "section"), **{"hardness.axes": "log"})
    others = {"held.scenes": (link.write(state),), "section.stress": "zz"}
    state = state.replace(**others)
    again = linked_state(state)
    assert scene_of(again) == scene_of(state)
    for name in (*VIEW, *others):
        assert again[name] == state[name], name
    assert scene_of(link.read(again["held.scenes"][0])) == scene_of(state)
    assert len(link.write(state)) < 700


#: Links, and what they say.
LINKS = {
    f"preset={DROP}&speed=2.0&at=1.5&tiles=sweep&sweep.swept=mass&sweep.against=restitution": {
        "speed": 2.0, "at": 1.5, "tiles": ("sweep",), "sweep.swept": "mass",
        "sweep.against": "restitution",
    },
    "drive=path&path.pattern=hold&path.ramp_time=0.5&damping=eta&eta=3.0": {
        "drive": "path", "path.pattern": "hold", "path.ramp_time": 0.5, "eta": 3.0,
    },
    f"preset={DROP}&drive=oblique&oblique.body=solid&oblique.incoming_speed=5.0&oblique.attack=0.5": {
        "oblique.body": "solid", "oblique.incoming_speed": 5.0, "oblique.attack": 0.5,
    },
    "tiles=section&section.stress=zz&held.scenes=shape%3Dcone%26cone_slope%3D0.2&dark=1": {
        "section.stress": "zz", "held.scenes": ("shape=cone&cone_slope=0.2",), "dark": True,
    },
    "tiles=hardness&hardness.axes=log": {"tiles": ("hardness",), "hardness.axes": "log"},
    # A hardness is that of class (b) at a radius.
    "plasticity=hardness&hardness=2000000000.0&hardness_radius=5e-08": {"q_c": 100.0, "hardness": 2e9},
}  # fmt: skip


@pytest.mark.parametrize("query", LINKS)
def test_links_are_read(query):
    state = link.read(query)
    assert {name: state[name] for name in LINKS[query]} == LINKS[query]
    assert link.unknown(query) == []


#: Links with names that are gone, which are told, and what is left of each.
GONE = {
    "max_depth=5e-09&tiles=radii+hardness+relief": (
        ["tiles=radii", "tiles=relief"],
        {"tiles": ("hardness",)},
    ),
    "max_depth=5e-09&log=force&hold=at%3D1": (["log", "hold"], {"held.scenes": ()}),
    "max_depth=5e-09&scales.keep=1&present.on=1": (["scales.keep", "present.on"], {"dark": False}),
    "max_depth=5e-09&fit.fixed=q_c&fit_note=fit": (["fit.fixed", "fit_note"], {"tiles": ()}),
}  # fmt: skip


@pytest.mark.parametrize("drive", ["depth", "force", "impact", "oblique"])
@pytest.mark.parametrize("key", PRESETS)
def test_a_link_without_the_size_of_its_drive_has_that_of_the_button(key, drive):
    """Mass, force or depth; a link that gives it keeps it, be it the one that a state has at first."""
    chosen = changes.choose(preset_state(key), "drive", drive)
    read = link.read(f"preset={key}&drive={drive}")
    if drive in ("depth", "force") or "mass" not in PRESETS[key].values:
        assert [read[name] for name in used(read)] == [chosen[name] for name in used(chosen)]
    else:
        assert read.mass == preset_state(key).mass
    of_default = chosen.replace(mass=1.0, max_force=1.0)
    again = link.read(link.write(of_default))
    assert [again[name] for name in used(again)] == [of_default[name] for name in used(again)]


def test_a_body_of_a_link_that_names_the_drive_alone_is_seen():
    """One of 1 kg went 42 mm into gold under the nanocone, and the plots were empty."""
    states = view_of(link.read("drive=impact")).course.states
    assert states.depth.max() < 1e-7
    assert states.force.max() > 0


@pytest.mark.parametrize("query", GONE)
def test_names_that_are_gone_are_left_out_of_a_link_with_one_line(query, monkeypatch):
    names, left = GONE[query]
    notices = []
    monkeypatch.setattr(Page, "notify", lambda page, text: notices.append(text))
    page = Page(query)
    assert notices == [f"Unknown names in this link are ignored: {', '.join(names)}"]
    assert page.state.max_depth == 5e-9
    assert {name: page.state[name] for name in left} == left
    assert not any(name in page.query()[0] for name in names)


@pytest.mark.parametrize(
    "query",
    [
        "preset=none", "cone_slope=1e9", "shape=ball", "at=7", "shape=cone&shape=cone", "at=nan",
        "shape=sampled&samples=0,0 1", "q_c=" + 9000 * "1", "held.scenes=a b c d e", "shape=sphere",
        "drive=path&path.pattern=own",
    ],
)  # fmt: skip
def test_a_hostile_link_is_refused(query):
    with pytest.raises(ValueError, match=r"link|bounds|samples|vertices"):
        link.read(query)


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("max_depth=1e400", "max_depth = “1e400” in this link is not a finite number"),
        ("max_depth=-1e400", "max_depth = “-1e400” in this link is not a finite number"),
        ("max_depth=deep", "max_depth = “deep” in this link is not a finite number"),
        ("max_depth=nan", "max_depth = “nan” in this link is not a finite number"),
        ("max_depth", "max_depth = “” in this link is not a finite number"),
        ("max_depth=+", "max_depth = “ ” in this link is not a finite number"),
        ("shape=", "shape = “” in this link is not known"),
        ("at=", "at = “” in this link is not a finite number"),
        ("at=7", "at = “7” in this link is not in 0 to 2.2"),
        ("preset=none", "preset = “none” in this link is not known"),
        ("shape=sampled", "this link has a shape without its numbers"),
        ("shape=sphere", "this link has a shape without its numbers"),
    ],
)
def test_a_link_is_refused_for_what_is_wrong(query, says):
    with pytest.raises(ValueError, match=f"^{re.escape(says)}$"):
        link.read(query)


def test_what_others_append_to_a_link_is_left_out_and_other_names_are_told():
    query = (
        "utm_source=teams&max_depth=5e-09&fbclid=IwAR"
        + 9000 * "0"
        + "&utm_source=a&foo=1&held.scenes=bar%3D2"
    )
    state = link.read(query)
    assert (state.max_depth, link.write(state.replace(**{"held.scenes": ()}))) == (5e-9, "max_depth=5e-09")
    assert link.unknown(query) == ["foo"]
    appended = "UTM_SOURCE=a&mkt_tok=b&mibextid=c&si=d&vero_id=e&ref=f&FBCLID=g"
    assert link.unknown(appended) == []
    assert link.read(appended) == preset_state()
    # Names that only begin like these, or like a number of the page, are told.
    assert link.unknown("size=1&refer=2&MAX_DEPTH=3") == ["size", "refer", "MAX_DEPTH"]
    state = preset_state(DROP).replace(at=0.5, tiles=("sweep",), dark=True)
    state = state.replace(**{"held.scenes": ("at=1",)})
    assert link.unknown(link.write(state)) == []


def test_a_measured_tip_is_taken_as_it_is_or_made_convex():
    few, note = read_tip(table({"r (nm)": [0, 1, 2, 4], "z (nm)": [0, 0.1, 0.3, 1]}))
    assert note == "4 samples, as in the file"
    assert few[1][-1] == approx(1e-9)
    state = changes.take_tip(preset_state(), few, note)
    assert state.max_depth < profile(state).known_depth
    assert follow(state).turning_point.force > 0
    rng, r = np.random.default_rng(3), np.linspace(0, 300, 20_000)
    z = r**2 / 2000 + 0.3 * rng.standard_normal(r.size)
    radii, heights = read_tip(table({"r (nm)": r, "z (nm)": z}, "\t"))[0]
    assert len(radii) <= MAX_SAMPLES
    assert heights[-1] == approx(45e-9, rel=0.01)
    # Few rows that noise has made concave.
    r = np.linspace(-50, 50, 41)
    z = 0.2 * np.abs(r) + 0.5 * rng.standard_normal(41)
    assert "41 rows reduced to" in read_tip(table({"r (nm)": r, "z (nm)": z}))[1]
    with pytest.raises(ValueError, match="does not increase with the radius r"):
        read_tip(table({"r (nm)": r, "z (nm)": -np.abs(r)}))


def test_a_noisy_tip_is_as_hard_as_the_one_that_is_nearest_to_it():
    """As `Sampled.fit` has it of the same rows about their axis."""
    r = np.linspace(-300, 300, 400)
    z = r**2 / 2000 + 0.3 * np.random.default_rng(2).standard_normal(r.size)
    samples, note = read_tip(table({"r (nm)": r + 20, "z (nm)": z}, "; ", comma=True))
    assert "rms deviation 290 pm" in note
    tips = mdr.Sampled(*samples), mdr.Sampled.fit(r * 1e-9, z * 1e-9)
    depths = [2e-9, 5e-9, 10e-9]
    read, fitted = (mdr.indent(tip, medium(preset_state()), depths).force for tip in tips)
    # The axis is found to about noise/(slope √rows), 0.1 nm.
    np.testing.assert_allclose(read, fitted, rtol=0.01)


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
    r, sigma, load, reduced = np.array(rows[1:], float).T
    now = follow(state).state
    np.testing.assert_allclose(-sigma, now.pressure(r), rtol=1e-12)
    # Both halves of the row of springs, by the trapezoidal rule over 320 of them; a cone has g = π s r/2.
    assert 2 * trapezoid(load, r) == approx(float(now.force), rel=0.01)
    np.testing.assert_allclose(reduced, np.pi / 2 * state.cone_slope * r, rtol=1e-12)


def test_numbers_link_and_python_follow_a_change_and_its_undoing():
    page = Page()
    shared = side(page, "share")

    def seen():
        field = part(page, "max_depth").look["text"]
        return field, str(page.messages.words), shared.link.value, shared.python.value

    opening = seen()
    page.apply(lambda state: changes.put(state, "max_depth", 5e-9))
    field, words, address, python = seen()
    assert field == "5 nm"
    assert '<output data-name="depth">5.000 nm</output>' in words
    assert "max_depth=5e-09" in address
    values = {}
    exec(python, values)
    assert values["scene"] == page.view.course.scene
    page.undo()
    assert seen() == opening


def test_depths_of_presets_are_so_many_times_the_depth_of_yield():
    """To the five digits that a field shows."""
    said = {}
    for key, preset in PRESETS.items():
        if found := re.fullmatch(
            r"(\S+) times the depth at which yield begins", preset.sources.get("max_depth", "")
        ):
            said[key] = float(found[1])
            depth = said[key] * medium(preset_state(key)).critical_depth
            assert preset.values["max_depth"] == float(f"{depth:.5g}")
    assert len(said) == 6


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
        assert len(code.splitlines()) <= 15
