"""What an earlier page said wrong: each statement is read here as it is drawn or said now."""

import numpy as np
import pytest

from app.common import ui
from app.common.quantities import CHOICES, QUANTITIES
from app.explorer import changes, link, readouts
from app.explorer.drives import follow
from app.explorer.extras import comparison, notes
from app.explorer.extras.guide import TOURS, step_state, step_text
from app.explorer.link import summary
from app.explorer.page import Page
from app.explorer.plots import PLOTS, D, F, P, X, force, springs, visible
from app.explorer.state import preset_state
from mdr_core.show.springs import SPRINGS

from ..approx import approx
from .conftest import DROP
from .states import numbers, part, solved, state_with, view_of, viscous
from .test_drives import oblique_state, path


def area(row):
    """The area that a closed row encloses."""
    x, y = row
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(np.roll(x, -1), y))


@pytest.mark.parametrize("progress", [0.6, 1.0, 1.3, 1.7])
def test_1_areas_of_a_viscous_impact_are_its_energies(progress):
    """Hatched is what yield and dashpots have taken, blue what is stored, up to what has let go."""
    view = view_of(viscous(), progress)
    course, i = view.course, view.course.now
    rows, m = force(view, i), view.course.motion
    contact = float(course.states.stored_energy[i])
    assert abs(area(rows["stored"])) == approx(contact, rel=0.02, abs=1e-3 * m.kinetic_energy[0])
    lost = m.plastic_work[i] + m.viscous_work[i] + m.stored_energy[i] - contact
    # By the trapezoidal rule over 120 instants.
    assert abs(area(rows["dissipated"])) == approx(lost, rel=0.02)
    # The edge of what is stored is at the state.
    assert np.max(rows["stored"][0]) == approx(float(course.states.depth[i]), rel=1e-9)


def test_2_the_fast_limit_is_compared_with_the_contact_area():
    course = follow(preset_state(DROP))
    text = " ".join(sentence for _, sentence in notes.limits(course, preset_state(DROP)))
    more = float(course.hit.fast_limit.contact_area / course.hit.turning_point.contact_area) - 1
    assert f"The fast-impact limit, Eqs. (23), (24), differs by −{-100 * more:.3g} % in the area" in text
    # It is one without adhesion.
    state = adhesive("impact")
    assert "fast limit" not in str(list(notes.limits(follow(state), state)))


def test_3_the_guide_says_of_which_shape_the_area_goes_with_the_energy():
    steps = TOURS["A fast impact, and what it destroys"]
    assert len(steps) == 6
    assert "under a cone the area is proportional to the energy" in steps[4]["says"]
    assert step_state(steps[5], preset_state()).tiles == ("sweep",)
    assert "ball of 5.5 kg" not in str(TOURS)


def test_8_formulas_are_those_of_the_drive():
    dry, wet = follow(preset_state(DROP)), follow(viscous())
    for name in ("force", "springs"):
        assert "η" not in PLOTS[name].formula_of(dry)
        assert "η" in PLOTS[name].formula_of(wet)
    assert "W_v" in PLOTS["energy"].formula_of(wet)
    assert "W_v" not in PLOTS["energy"].formula_of(dry)
    assert "W_f" in PLOTS["energy"].formula_of(follow(oblique_state()))


@pytest.mark.parametrize("progress", [0.7, 1.0, 1.5])
def test_9_the_numbers_of_a_state_sum_up(progress):
    course = follow(viscous().replace(at=progress))
    parts = ("stored_energy", "plastic_work", "viscous_work", "kinetic_energy")
    assert sum(numbers(course)[name][course.now] for name in parts) == approx(2.75, rel=1e-6)
    helps = {each.name: each.help for each in readouts.READOUTS}
    assert "Without dashpots" in helps["stored_energy"]
    assert "Without dashpots" in helps["mean_pressure"]


def test_10_held_scenes_are_named_by_what_differs():
    drop = preset_state(DROP)
    for state, name in (
        (drop, "Round striker 16 mm on glass-fibre epoxy, drop weight"),
        (drop.replace(speed=2.0), "v_0 = 2 m/s"),
        (drop.replace(q_c=2e5), "q_c = 200 kN/m"),
        (state_with(DROP, shape="cone").replace(cone_slope=0.2), "Cone, s = 0.2"),
    ):
        assert comparison.difference(state) == name


def test_11_small_things_are_said_right():
    assert "never cut" not in (ui.HERE / "explorer" / "extras" / "guide.html").read_text(encoding="utf-8")
    course = follow(state_with(plasticity="none"))
    said = {readouts.text(each, values, course.now) for each, values in readouts.readings(course).items()}
    assert "∞ m" not in said
    assert "line load" in QUANTITIES["q_c"].help
    equations = {each.name: each.equation for each in readouts.READOUTS}
    assert equations["yield_force"].startswith("(22)")


def test_12_curves_with_a_vertical_start_are_no_chords():
    course = solved(path("creep", damping="eta"))
    time = course.motion.time
    assert len(time) > 20
    # Half of the states of the hold are in its first tenth.
    held_at = np.flatnonzero(course.states.force >= 0.999 * course.states.force.max())
    share = (time[held_at] - time[held_at[0]]) / np.ptp(time[held_at])
    assert np.mean(share < 0.1) > 0.5


def test_13_springs_are_elastic_or_yielded_also_in_an_oblique_impact():
    """Yielded ones reach to c, elastic ones to a, within the distance of two."""
    for state, vertices in ((preset_state(), 1), (state_with(DROP, "oblique"), 9)):
        view = view_of(state)
        rows, now = view.places(PLOTS["springs"], view.course.now), view.course.state
        spacing = 2 * view.end(X) / SPRINGS
        for name, radius in (("yielded", now.plastic_radius), ("elastic", now.contact_radius)):
            assert np.nanmax(np.abs(rows[name][0][::vertices])) == approx(radius, abs=spacing)
    assert "speed" not in PLOTS
    assert "Speed" not in [choice.label for choice in CHOICES.values()]
    assert CHOICES["drive"].options["depth"].label == "depth"


def test_14_a_tile_is_drawn_where_a_drive_has_it_and_a_preset_stands_deepest():
    page = Page()
    page.apply(lambda state: state.replace(tiles=("forces",)))
    assert visible(page.view) == [PLOTS[name] for name in ("springs", "pressure", "force")]
    assert "Friction" not in [text for _, text in part(page, "fourth plot").look["options"]]
    page.apply(lambda state: changes.put(state, "max_depth", 5e-9))
    assert page.state.max_depth == 5e-9
    page.choose("drive", "oblique")
    assert "forces" in [plot.name for plot in visible(page.view)]
    page.choose("drive", "depth")
    assert "forces" not in [plot.name for plot in visible(page.view)]
    # A measured tip can be chosen where there is one only.
    assert "sampled" not in dict(page.choice("shape").look["options"])
    page.apply(lambda state: state.replace(at=0.0))
    page.choose("preset", page.state.preset)
    assert page.state.at == 1.0
    assert step_text(TOURS["First yield"][0], page.view.course)


def adhesive(drive="depth", **more):
    """A glass ball on rubber, w = 50 mJ/m², pressed to many times the critical depth."""
    state = state_with("microsphere-pdms", drive, adhesion="work")
    return changes.put(state, "work_of_adhesion", 0.05).replace(**more)


@pytest.mark.parametrize(("drive", "share"), [("depth", 5 / 9), ("force", 1.0), ("impact", 5 / 9)])
def test_adhesion_is_drawn_below_zero_to_the_pull_off(drive, share):
    """A given force pulls off at 3/2 π w R (JKR), a given depth later, at 5/9 of that."""
    state = adhesive(drive, plasticity="none")
    view = view_of(state, 2.0)
    course, axis = view.course, view.axis(F)
    pull_off = 1.5 * np.pi * 0.05 * state.paraboloid_radius
    np.testing.assert_allclose(numbers(course)["pull_off_force"], pull_off, rtol=1e-12)
    assert view.places(PLOTS["force"], course.now)["Fₐ"][2] == "Fₐ = 11.8 µN"
    # The largest tension is between two states; it is flat there.
    assert -np.min(course.states.force) == approx(pull_off, rel=1e-2)
    assert axis.start <= -pull_off
    assert view.axis(D).start <= np.min(course.states.depth) < 0
    assert -course.states.force[course.progress <= 2][-1] == approx(share * pull_off, rel=1e-9)
    assert course.states.force[-1] == 0


def test_after_yield_the_whole_imprint_is_pulled_off():
    view = view_of(adhesive(), 2.0)
    course = view.course
    c = float(course.state.plastic_radius)
    kendall = np.sqrt(8 * np.pi * 0.05 * course.scene.medium.E_star * c**3)
    assert float(course.state.force) == approx(-kendall, rel=1e-12)
    # All springs reach above the flat bottom of the imprint, to the lifted indenter.
    x, z = (part.reshape(-1, 9) for part in springs(view, course.now)["yielded"])
    stretch = np.sqrt(2 * np.pi * c * 0.05 / course.scene.medium.E_star)
    places = np.abs(x[:, 0])
    left = course.states.plastic_depth[-1] - course.scene.profile.reduced(places)
    np.testing.assert_allclose(z[places < c, 7] + left, stretch, rtol=1e-9)
    _, p = view.places(PLOTS["pressure"], course.now)["p(r)"]
    assert np.min(p) == view.axis(P).start == -view.axis(P).end
    assert "−∞ at the rim" in view.places(PLOTS["pressure"], course.now)["exceeds"][2]


def test_adhesion_has_a_link_and_is_refused_where_it_is_not_computed():
    state = adhesive()
    again = link.read(link.write(state))
    assert (again.adhesion, again.work_of_adhesion) == ("work", 0.05)
    assert "w = 50 mJ/m²" in summary(again)
    assert "adhesion" not in link.write(preset_state())
    again, hold = {"drive": "impact", "plastic_depth": 1e-7}, {"drive": "path", "path.pattern": "hold"}
    for choices in ({"drive": "oblique"}, {"damping": "eta"}, again, hold):
        with pytest.raises(ValueError, match="adhesion"):
            follow(adhesive().replace(**choices))
