"""Adhesion: force below zero, areas, marks, stretched springs, links and limits."""

import re

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from app.explorer import link
from app.explorer.drives import follow
from app.explorer.link import summary
from app.explorer.plots import PLOTS, D, F, P, springs
from app.explorer.state import medium, preset_state, profile

from ...approx import approx
from ..conftest import ELASTIC, GOLD
from ..states import PDMS, adhesive, amounts, numbers, polygon, state_with, view_of


@pytest.mark.parametrize(("drive", "share"), [("depth", 5 / 9), ("force", 1.0), ("impact", 5 / 9)])
def test_adhesion_is_drawn_below_zero_to_the_pull_off(drive, share):
    """A given force pulls off at 3/2 π w R (JKR), a given depth later, at 5/9 of that."""
    state = adhesive(drive, plasticity="none")
    view = view_of(state, 2.0)
    course, axis = view.course, view.axis(F)
    pull_off = 1.5 * np.pi * 0.05 * state.paraboloid_radius
    np.testing.assert_allclose(numbers(course)["pull_off_force"], pull_off, rtol=1e-12)
    # Three digits are written.
    assert amounts(view.places(PLOTS["force"], course.now)["Fₐ"][2]) == approx([pull_off], rel=5e-3)
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


def jkr_loss(E_star, w, R):
    """Energy (J) of the elastic springs and the surfaces lost at first contact and at the pull-off, of JKR.

    The springs at x are compressed by d − x²/R, with d = a²/R − √(2πaw/E*). At first contact d = 0, and at
    the pull-off dd/da = 0.
    """
    stretch = np.sqrt(2 * np.pi * w / E_star)
    a = (stretch * R * np.array([1, 1 / 4])) ** (2 / 3)
    d = a**2 / R - stretch * np.sqrt(a)
    stored = E_star * (d**2 * a - 2 * d * a**3 / (3 * R) + a**5 / (5 * R**2))
    first, last = stored - np.pi * w * a**2
    return last - first


@pytest.mark.parametrize(
    ("key", "radius", "depth"),
    [(ELASTIC, 1e-3, 1e-6), (ELASTIC, 1e-3, 1e-4), (PDMS, 50e-6, 3e-7)],
)
def test_elastic_adhesion_loses_what_jump_and_pull_off_take_at_every_depth(key, radius, depth):
    """Above first contact loading and unloading are one curve: nothing else is lost, nothing is gained."""
    shape = {"shape": "paraboloid", "paraboloid_radius": radius, "max_depth": depth}
    state = state_with(key, plasticity="none", adhesion="work").replace(work_of_adhesion=0.05, **shape)
    view, expected = view_of(state), jkr_loss(medium(state).E_star, 0.05, radius)
    for i in range(0, len(view.course), 10):
        rows = view.places(PLOTS["force"], i)
        assert np.isnan(rows["gained"][0]).all()
        # Chords of some 10⁻⁴, and three digits.
        assert polygon(*rows["dissipated"]) == approx(expected, rel=1e-3)
        assert re.findall("dissipated|gained", rows["W_a"][2]) == ["dissipated"]
        assert amounts(rows["W_a"][2]) == approx([expected], rel=5e-3)


def test_the_loop_of_yield_with_adhesion_is_plastic_work_and_what_the_surfaces_take():
    """Yield, the jump into contact of JKR and the rim of the imprint, π w c²; before yield JKR's alone.

    The energies are said where their areas are inside the axes.
    """
    state = state_with(PDMS, adhesion="work").replace(work_of_adhesion=0.05, max_depth=1.7672e-6)
    view, made, R = view_of(state), medium(state), 50e-6
    i, depth = view.course.peak, 1.7672e-6 - medium(state).critical_depth
    a = (2 * np.pi * 0.05 * R**2 / made.E_star) ** (1 / 3)
    plastic = made.critical_depth * 4 / 3 * made.E_star * R**0.5 * depth**1.5
    expected = plastic + 0.3 * made.E_star * a**5 / R**2 + np.pi * 0.05 * R * depth
    for each in (i, i + 20, len(view.course) - 1):
        rows = view.places(PLOTS["force"], each)
        said = amounts(rows["W_a"][2])
        assert said[:2] == approx([polygon(*rows[name]) for name in ("dissipated", "gained")], rel=5e-3)
        assert said[2] == approx(expected, rel=2e-3)
    # The loop of an early state is pulled off below the axis, on which the pull-off of the course is.
    early = int(np.argmax(view.course.states.depth > 0.9 * made.critical_depth))
    rows = view.places(PLOTS["force"], early)
    assert polygon(*rows["dissipated"]) == approx(jkr_loss(made.E_star, 0.05, R), rel=2e-3)
    assert rows["dissipated"][0].min() < view.axis(D).start
    assert rows["W_a"][2] == ""


@pytest.mark.parametrize("drive", ["force", "impact"])
def test_no_loop_with_adhesion_gains_and_energies_are_said_where_it_is_drawn(drive):
    """A cone under a force is pulled off above first contact: no loop is closed before it yields."""
    view = view_of(state_with(GOLD, drive, adhesion="work").replace(work_of_adhesion=0.5))
    said = []
    for i in range(0, len(view.course), 10):
        rows = view.places(PLOTS["force"], i)
        seen = {name for name in ("dissipated", "gained") if np.isfinite(rows[name][0]).any()}
        named = set(re.findall("dissipated|gained", rows["W_a"][2]))
        inside = bool(seen) and rows["dissipated"][0].min() > view.axis(D).start - 1e-6 * view.end(D)
        assert named == (seen if inside else set())
        said.append(amounts(rows["W_a"][2]))
        assert all(amount > 0 for amount in said[-1])
    assert not said[0]
    assert said[-1]


def test_jump_into_contact_and_pull_off_are_marked_and_what_comes_back_is_written():
    """JKR's −4/3 π w R at d = 0, and Kendall's √(8π w E* c³) of the imprint.

    Before tension the work of the largest depth comes back.
    """
    state = adhesive(max_depth=1.7672e-6)
    view, made = view_of(state), medium(state)
    rows, E, R, depth = view.places(PLOTS["force"], view.course.now), made.E_star, 50e-6, state.max_depth
    assert rows["jump into contact"][0] == approx([0], abs=1e-3 * depth)
    assert rows["jump into contact"][1] == approx([-4 / 3 * np.pi * 0.05 * R], rel=1e-3)
    c = np.sqrt(R * (depth - made.critical_depth))
    tension = np.sqrt(8 * np.pi * 0.05 * E * c**3)
    (x,), (y,) = rows["pull-off"]
    assert -y == approx(tension, rel=1e-3)
    assert x == approx(depth - made.critical_depth - np.sqrt(2 * np.pi * c * 0.05 / E), rel=1e-3)
    # Its label is beside it.
    assert amounts(rows["Fₐ"][2]) == approx([tension], rel=6e-3)
    for place, mark, along in zip(rows["Fₐ"], (x, y), (D, F), strict=False):
        assert abs(place - mark) < 0.1 * (view.axis(along).end - view.axis(along).start)
    back = np.linspace(depth, depth - made.critical_depth, 4000)
    force = np.maximum(mdr.indent(profile(state), made, back).force, 0.0)
    assert polygon(*rows["given back"]) == approx(-trapezoid(force, back), rel=1e-2)
    assert amounts(rows["W_U"][2])[0] == approx(-trapezoid(force, back), rel=1e-2)
    # The axis of tension alone is that of the tension: 3/2 π w R, of JKR.
    axis = view_of(adhesive(max_depth=2e-7)).axis(F)
    assert axis.end - axis.start < 2 * 1.5 * np.pi * 0.05 * R
