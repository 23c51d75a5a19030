"""Impacts on a plate or a support: the page has the numbers of the library."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq

import mdr_core as mdr
from app.common.host import last
from app.explorer import changes, link
from app.explorer.drives import follow, scene_of
from app.explorer.extras import notes, share, sweep
from app.explorer.extras import structure as structures
from app.explorer.extras import time as in_time
from app.explorer.extras.guide import step_state
from app.explorer.page import Page
from app.explorer.readouts import line
from app.explorer.search import exact
from app.explorer.state import PRESETS, changed_from_preset, medium, preset_state, profile

from ...approx import approx
from ..conftest import DROP, GOLD, PUNCH
from ..states import SIZES, linked_state, numbers, press, state_with, view_of

PLATE, SUPPORT = "small_ball-carbon_epoxy", "striker-glass_epoxy-plate"
EDGES = "ball-carbon_laminate"


def test_the_presets_are_what_they_name():
    """K is Navier's series of the plate that the preset has; the block alone has another force."""
    state = preset_state(SUPPORT)
    values = PRESETS[SUPPORT].values
    a, b, odd = 75e-3, 125e-3, np.arange(1, 2000, 2)
    D = values["structure.E"] * values["structure.thickness"] ** 3 / 12 / (1 - values["structure.nu"] ** 2)
    series = np.sum(1 / ((odd / a) ** 2 + (odd[:, None] / b) ** 2) ** 2)
    assert values["structure.stiffness"] == float(f"{np.pi**4 * D * a * b / 4 / series:.4g}")
    hit, block = (follow(each).hit for each in (state, state_with(SUPPORT, behind="block")))
    assert (round(float(hit.max_force)), round(float(hit.restitution), 2)) == (2763, 0.79)
    assert (round(float(block.max_force)), round(float(block.restitution), 3)) == (3735, 0.201)
    assert scene_of(state_with(SUPPORT, behind="block")) == scene_of(preset_state(DROP))
    # The impactor is far heavier than the plate of the test.
    assert state.mass > 10 * values["structure.density"] * values["structure.thickness"] * a * b
    laminate = mdr.Medium.from_transversely_isotropic(52e9, 9e9, 0.31, 0.06, 4e9)
    both = 1 / (1 / laminate.E_star + (1 - 0.3**2) / 210e9)
    assert float(preset_state(PLATE).E_star) == approx(float(both), rel=1e-3)
    for key in (PLATE, SUPPORT, EDGES):
        assert changed_from_preset(preset_state(key)) == []


def test_the_laminate_of_sun_and_chen_is_what_it_names():
    """Its stiffnesses are those of the plies; the ball hits twice, theory.md § 15."""
    state = preset_state(EDGES)
    values = PRESETS[EDGES].values
    E1, E2, G, nu, h = 120e9, 7.9e9, 5.5e9, 0.3, 2.69e-3
    Q = np.array([E1, E2, nu * E2, G * (1 - nu**2 * E2 / E1)]) / (1 - nu**2 * E2 / E1)
    z = np.linspace(-h / 2, h / 2, 11)
    cubes = np.diff(z**3) / 3
    turned = np.array([0, 1, 0, 1, 0, 0, 1, 0, 1, 0], bool)
    D11, D22 = (np.sum(np.where(turned ^ k, Q[1], Q[0]) * cubes) for k in (False, True))
    known = {"D11": D11, "D22": D22, "D12": Q[2] * cubes.sum(), "D66": Q[3] * cubes.sum()}
    for name, D in known.items():
        # Seven digits.
        assert values[f"structure.{name}"] == approx(D, rel=1e-6)
    assert values["structure.mass_per_area"] == approx(1580 * h)
    hit = exact(follow(state)).hit
    assert (round(float(hit.max_force), 1), round(float(hit.restitution), 3)) == (309.6, 0.175)
    assert hit.contacts == 2
    assert {"deflection", "dent"} <= {limit.what for limit in hit.limits}


def structure(state):
    return scene_of(state).drive.structure


def test_a_plate_with_edges_is_that_of_the_library_drawn_by_fewer_modes_at_first():
    state = preset_state(EDGES)
    drawn = follow(state)
    course = exact(drawn)
    given = (0.2, 0.2, 131.4233, 3.867273, 77.27888, 8.921508, 4.2502)
    made = mdr.Structure.supported_plate(*given, thickness=2.69e-3)
    assert structure(state) == made
    hit = mdr.impact(profile(state), medium(state), state.mass, state.speed, structure=made)
    assert float(course.hit.restitution) == float(hit.restitution)
    assert drawn.pending
    # Up to twice the swings of a contact leave 0.002 of e.
    assert float(drawn.hit.restitution) == approx(float(hit.restitution), abs=4e-3)
    # Both contacts are drawn, and the flight between them.
    time, force = course.motion.time, course.motion.force
    for each in hit.hits:
        inside = (time >= each.start) & (time <= each.end)
        assert force[inside].max() == approx(each.max_force, rel=5e-3)
    (first, second) = hit.hits
    assert (force[(time > first.end) & (time < second.start)] == 0).all()
    assert in_time.MOTION.aside(view_of(state)) == "2 contacts"
    total = sum(in_time.energies(course).values())
    np.testing.assert_allclose(total, state.mass * state.speed**2 / 2, rtol=1e-8)


@pytest.mark.parametrize("by", ["moduli", "bending"])
def test_an_isotropic_plate_with_edges_by_its_thickness_and_by_its_stiffness(by):
    h, E, nu, rho = 4e-3, 52e9, 0.31, 1600.0
    values = {"thickness": h, "E": E, "nu": nu, "density": rho, "width": 0.1, "length": 0.15}
    values |= {"D": E * h**3 / 12 / (1 - nu**2), "mass_per_area": rho * h}
    state = state_with(PLATE, behind="edges", plate=by)
    state = state.replace(**{f"structure.{name}": value for name, value in values.items()})
    plate = mdr.Structure.supported_isotropic_plate(0.1, 0.15, h, E, nu, rho)
    assert structure(state).stiffness == approx(plate.stiffness, rel=1e-12)
    assert structure(state).modes.frequency == approx(plate.modes.frequency, rel=1e-12)
    said = re.sub("<[^>]+>", "", structures.notes(view_of(state))["form"])
    mass = rho * h * 0.1 * 0.15
    assert f"M = {1e3 * mass:.2f} g" in said
    assert f"m/M = {state.mass / mass:.3g}" in said


def test_the_sweep_over_the_mass_goes_from_the_plate_without_edges_to_the_support():
    """And through what the library finds by all modes, to the width of a line, at resonances as well."""
    page = Page(f"preset={EDGES}")
    press(page, "e over m")
    state = page.state
    found = last(sweep.found(follow(state), sweep.asked(state)))
    mass, restitution = found.rows["this scene"]
    (_, endless), (_, support) = (found.rows[name] for name in sweep.LIMITING)
    made, M = structure(state), 0.2 * 0.2 * 4.2502
    light = mass < 0.015 * M
    assert light.sum() > 5
    assert restitution[light] == approx(endless[light], abs=0.006)
    assert support == approx(np.ones(mass.size), abs=1e-9)
    # Resonances stay below it.
    assert 0.85 < restitution[-1] < 1
    for k in range(0, mass.size, 3):
        hit = mdr.impact(profile(state), medium(state), mass[k], state.speed, structure=made)
        assert restitution[k] == approx(float(hit.restitution), abs=2e-3)
    # Not where the plate itself is swept.
    swept = state.replace(**{"sweep.swept": "structure.length"})
    assert not {*sweep.LIMITING} & {*last(sweep.found(follow(swept), sweep.asked(swept))).rows}


def cells(page):
    """Readouts above the plots, by their names: classes, text."""
    cell = re.compile(r'<output data-name="(\w+)"(?: class="(\w+)" title="[^"]+")?>(.*?)</output>')
    return {name: (classes, text) for name, classes, text in cell.findall(page.messages.words)}


def test_a_plate_that_is_the_wrong_model_marks_its_numbers_and_offers_the_right_one():
    """ASTM D7136 on a plate without edges: e = 1.1e-8, of which no digit is a result."""
    page = Page(f"preset={SUPPORT}")
    assert not any(classes for classes, _ in cells(page).values())
    page.choose("structure.behind", "plate")
    shown = cells(page)
    for name in ("force", "restitution", "contact_time", "structure_work"):
        assert shown[name][0] == "doubtful", name
    assert shown["restitution"][1] == "&lt; 0.001"
    assert {shown[name][0] for name in ("depth", "plastic_depth")} == {""}
    (said,) = (each for name, each in page.layout.line.parts.items() if name == "edges")
    assert said.look["object"].startswith("Take a plate with edges: ")
    # The export has the value.
    e = float(page.view.course.hit.restitution)
    assert 0 < e < 1e-6
    assert f"{e:.3g}"[:4] in share.csv(page.view)
    press(page, "Take a plate with edges")
    assert page.state["structure.behind"] == "edges"
    assert (page.state["structure.width"], page.state["structure.length"]) == (0.075, 0.125)
    assert not any(classes for classes, _ in cells(page).values())
    assert {*page.layout.line.parts} == {"heads", "words"}
    assert cells(page)["restitution"][1].endswith("<small>1 contact</small>")


@pytest.mark.parametrize(
    ("what", "reached"),
    [("deflection", "max_deflection"), pytest.param("dent", "plastic_depth", marks=pytest.mark.full)],
)
def test_a_limit_is_a_caution_above_three_times_its_bound(what, reached):
    """Half of the thickness is the bound of the deflection and of the dent."""
    state = state_with(SUPPORT, behind="edges")
    far = 1.5 * state["structure.thickness"]

    def beyond(log_speed):
        hit = follow(state.replace(speed=float(np.exp(log_speed)))).hit
        return float(getattr(hit, reached)) / far - 1

    speed = float(np.exp(brentq(beyond, np.log(state.speed), np.log(60 * state.speed), xtol=0.02)))
    for factor in (0.9, 1.1):
        course = follow(state.replace(speed=factor * speed))
        assert any(what in each.limits for each in course.cautions) == (factor > 1)
        assert ("force" in course.doubtful) >= (factor > 1)


def numbers_above(state):
    return [each.name for each in line(follow(state))]


def test_the_numbers_are_those_of_the_library():
    for key, made in (
        (PLATE, mdr.Structure.plate(4e-3, 52e9, 0.31, 1600.0, edge=0.075)),
        (SUPPORT, mdr.Structure(stiffness=2.332e6)),
    ):
        state = preset_state(key)
        assert structure(state) == made
        hit = mdr.impact(profile(state), medium(state), state.mass, state.speed, structure=made)
        course = follow(state)
        found, taken = numbers(course), "structure_work" if key == PLATE else "support_energy"
        assert float(found["restitution"]) == approx(float(hit.restitution), rel=1e-12)
        assert float(found["max_deflection"]) == approx(float(hit.max_deflection), rel=1e-12)
        assert {"deflection", taken} <= {*numbers_above(state)}
        # What waves carry away does not come back, what the support stores does.
        end = float(hit.structure_work) if key == PLATE else 0.0
        assert float(found[taken][-1]) == approx(end, rel=1e-9, abs=1e-12 * hit.mass)
        total = sum(in_time.energies(course).values())
        np.testing.assert_allclose(total, state.mass * state.speed**2 / 2, rtol=1e-8)
        csv = share.csv(view_of(state))
        assert f"mdr.Structure({'impedance' if key == PLATE else 'stiffness'}=" in csv
        assert "deflection w (m)" in csv
        assert "yield_speed" not in found


def test_a_plate_by_its_bending_stiffness_is_that_of_its_thickness():
    state = preset_state(PLATE)
    made = structure(state)
    values = {
        "D": made.impedance * made.wave_spread / 8,
        "mass_per_area": made.impedance / made.wave_spread / 8,
    }
    other = state_with(PLATE, plate="bending").replace(
        **{f"structure.{name}": float(value) for name, value in values.items()}
    )
    assert float(follow(other).hit.restitution) == approx(float(follow(state).hit.restitution), rel=1e-9)


def test_a_plate_says_what_its_numbers_make_and_a_support_has_none():
    """D = E h³/(12 (1 − ν²)) and ρh of 4 mm of a laminate; nearer edges than it says are felt."""
    view = view_of(preset_state(PLATE))
    said = re.sub("<[^>]+>", "", structures.notes(view)["form"])
    stiffness, mass, impedance, far = map(float, re.findall(r"(?:= |than )([\d.]+) ", said))
    D, per_area = 52e9 * 4e-3**3 / 12 / (1 - 0.31**2), 1600 * 4e-3
    # Four digits, of a distance two.
    assert (stiffness, mass, impedance) == approx((D, per_area, 8 * (D * per_area) ** 0.5), rel=1e-3)
    for ratio, felt in ((1.1, False), (0.9, True)):
        state = preset_state(PLATE).replace(**{"structure.edge": ratio * far * SIZES["mm"]})
        (limit,) = (each for each in follow(state).limits if each.what == "edges")
        assert limit.exceeded == felt
    assert structures.notes(view_of(preset_state(SUPPORT))) == {}


@pytest.mark.parametrize(
    "query",
    [f"preset={PLATE}&structure.thickness=0.002", f"preset={EDGES}&structure.length=0.25&structure.D=100"],
)
def test_links_undo_and_files_carry_it(query):
    page = Page(query)
    before = page.state
    page.choose("structure.behind", "support")
    page.choose("structure.behind", before["structure.behind"])
    assert structure(page.state) == structure(before)
    assert linked_state(page.state) == page.state
    scene, values = page.view.course.scene, {}
    exec(scene.to_python(), values)
    assert values["scene"] == mdr.Scene.from_json(scene.to_json()) == scene
    page.undo()
    assert page.state["structure.behind"] == "support"
    page.undo()
    assert page.state == before


@pytest.mark.parametrize(
    ("behind", "loss"),
    [("plate", ("damping", "eta")), ("edges", ("adhesion", "work")), ("support", ("damping", "eta"))],
)
def test_it_is_refused_in_words_with_dashpots_or_adhesion(behind, loss):
    word = {"damping": "viscosity", "adhesion": "adhesion"}[loss[0]]
    label = {"edges": "plate with edges"}.get(behind, behind)
    said = f"a {label} is not computed together with {word}: choose “thick block”"
    page = Page(f"preset={GOLD}&drive=impact")
    notices = []
    page.notify = notices.append
    for first, second in ((loss, ("structure.behind", behind)), (("structure.behind", behind), loss)):
        page.choose("preset", GOLD)
        page.choose("drive", "impact")
        page.choose(*first)
        before = page.state
        assert notices == []
        page.choose(*second)
        assert page.state == before
        assert said in notices.pop()
        assert "structure.behind" in page.layout.form.view.parts


@pytest.mark.parametrize("key", [GOLD, DROP, PUNCH])
def test_a_structure_that_nobody_has_set_matters(key):
    """Neither is the body caught at once, nor is it as on a block, at nanometres and at millimetres."""
    block = state_with(key, "impact")
    for behind in ("plate", "edges", "support"):
        hit = follow(changes.choose(block, "structure.behind", behind)).hit
        assert 0.2 < hit.max_depth / follow(block).hit.max_depth < 0.97
        assert 0.01 < hit.restitution <= 1


def test_another_drive_and_back_is_the_same_impact():
    for key in (PLATE, SUPPORT, EDGES):
        state = preset_state(key)
        back = changes.choose(changes.choose(state, "drive", "depth"), "drive", "impact")
        assert back.speed == approx(state.speed, rel=1e-4)
        assert structure(back) == structure(state)


def test_a_preset_has_no_structure_of_another_one():
    page = Page(f"preset={PLATE}")
    for key in (GOLD, DROP):
        page.choose("preset", key)
        assert page.state == preset_state(key)
    # Nor has a guided scene that says nothing of it.
    step = {"set": {"preset": DROP, "drive": "impact"}}
    assert structure(step_state(step, preset_state(PLATE))) is None


def test_a_body_that_stays_is_not_held_by_adhesion():
    state = state_with(PUNCH, "impact", behind="plate").replace(**{"structure.thickness": 1e-3})
    course = follow(state)
    assert course.hit.captured
    assert float(numbers(course)["restitution"]) == 0
    said = " ".join(sentence for _, sentence in notes.limits(course, state))
    assert "dhesion" not in said
    assert "The body never leaves the plate" in said


def test_the_sweep_over_the_thickness_goes_from_a_ball_that_stays_to_a_half_space():
    page = Page(f"preset={PLATE}")
    press(page, "e over h")
    state = page.state
    asked = sweep.asked(state)
    found = last(sweep.found(follow(state), asked))
    thickness, restitution = found.rows["this scene"]
    block = follow(state_with(PLATE, behind="block")).hit.restitution
    assert (thickness[0], thickness[-1]) == approx((4e-4, 4e-2))
    assert restitution[0] < 1e-3
    assert restitution[-1] == approx(float(block), abs=0.02)
    middle = linked_state(state.replace(**{"structure.thickness": float(thickness[15])}))
    assert restitution[15] == approx(float(follow(middle).hit.restitution), rel=1e-9)
    # The limit of fast impacts and the other classes are those of a half-space.
    seen = {name for name, (_, y, *_) in found.rows.items() if np.isfinite(y).any()}
    assert seen == {"this scene", "label this scene", "present value"}


def test_what_is_not_used_is_not_in_a_link():
    state = state_with(GOLD, "impact", behind="support")
    assert "structure.thickness" not in link.write(state)
    assert "structure.stiffness" in link.write(state)
