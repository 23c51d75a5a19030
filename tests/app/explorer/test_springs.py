"""The plot of the springs: yielded, elastic, stretched and leaning springs, and its text."""

import re

import numpy as np
import pytest
from scipy.integrate import trapezoid

from app.common.quantities import CHOICES
from app.explorer.drives import follow
from app.explorer.extras import labels
from app.explorer.extras.oblique import leaning
from app.explorer.page import Page
from app.explorer.plot import View
from app.explorer.plots import PLOTS, X
from app.explorer.state import medium, preset_state
from mdr_core.show.springs import SPRINGS
from mdr_core.show.units import written

from ...approx import approx
from ..conftest import DROP, PUNCH
from ..states import oblique_state, solved, state_with, view_of


def test_yielded_springs_reach_to_c_and_elastic_ones_to_a():
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


@pytest.mark.parametrize("share", [10, 30, 100, 1000])
@pytest.mark.parametrize("shape", ["cone", "paraboloid"])
def test_the_elastic_ring_has_a_spring_on_each_side(share, shape):
    """However narrow it is: d/d_y = 1000."""
    state = state_with(DROP, "depth", shape=shape)
    state = state.replace(max_depth=share * float(medium(state).critical_depth))
    view = view_of(state)
    x = view.places(PLOTS["springs"], view.course.now)["elastic"][0].reshape(-1, 9)[:, 0]
    now = view.course.state
    inside = (np.abs(x) > now.plastic_radius) & (np.abs(x) < now.contact_radius)
    assert inside.all()
    assert (x > 0).sum() == (x < 0).sum() >= 1
    assert x.size <= 2 + 2 * (now.contact_radius - now.plastic_radius) / (2 * view.end(X) / 60)


def test_a_sentence_describes_the_state():
    """Popov (2015), Eq. (21): the ring of a cone is q_c/(E* s) wide, here 3.193 nm."""
    state = preset_state()
    made = medium(state)
    ring = float(made.q_c / made.E_star / state.cone_slope)
    course = follow(state)
    c = float(course.state.plastic_radius)
    text = f"yielded inside c = {c * 1e9:.1f} nm; elastic ring {ring * 1e9:.2f} nm wide"
    assert labels.sentence(course, course.now) == text
    view = view_of(state)
    assert view.places(PLOTS["springs"], course.now)["reading"][2] == text
    onset = float(made.critical_depth)
    early = f"elastic; the axis yields first, at d = {onset * 1e9:.2f} nm"
    assert {labels.sentence(course, i) for i in np.flatnonzero(course.states.depth[1:20] < onset) + 1} == {
        early
    }
    assert labels.sentence(course, 0) == "no contact"
    assert labels.sentence(course, len(course) - 1) == f"no contact; imprint of radius c = {c * 1e9:.1f} nm"
    punch = follow(preset_state(PUNCH))
    assert "the whole flat face yields first" in labels.sentence(punch, 1)
    assert labels.sentence(punch, punch.peak) == "yielded inside c = 2.00 mm"
    assert labels.sentence(follow(state_with(plasticity="none")), 9) == "elastic; nothing yields"
    # With adhesion the depth of the onset is not that of the springs.
    adhesive = follow(state_with("microsphere-pdms", adhesion="work"))
    assert labels.sentence(adhesive, 0) == "elastic; the axis yields first"


def test_springs_lean_as_far_as_they_are_loaded_and_stick_where_the_core_says():
    course = solved(oblique_state())
    view, m = View(oblique_state(), course), course.motion
    spacing = 2 * view.end(X) / SPRINGS
    share = m.stick_radius[1:-1] / m.contact_radius[1:-1]
    i = 1 + int(np.argmin(np.abs(share - 0.6)))
    rows = view.places(PLOTS["springs"], i)
    # The middles of the lines below the feet.
    stick, slip = (np.abs(rows[name][0].reshape(-1, 3)[:, :2].mean(axis=1)) for name in ("sticks", "slips"))
    assert stick.max() == approx(m.stick_radius[i], abs=1.5 * spacing)
    assert slip.min() > stick.max()
    # The springs carry the force: along the surface κE* times how far they lean.
    r = np.linspace(0, float(m.contact_radius[i]), 4001)
    lean, _ = leaning(course, i, r)
    made = course.scene.medium
    force = 2 * made.tangential_ratio * made.E_star * trapezoid(lean, r)
    assert force == approx(m.tangential_force[i], rel=0.01)


def test_the_yield_limit_is_beside_the_springs():
    """Class (b): d_c = π q_c/(2E*) = 1.796 nm. Constant hardness: π a H/(2E*), at the present radius."""

    def aside(state, at=1.0):
        return PLOTS["springs"].aside(view_of(state, at))

    assert aside(preset_state()) == "a spring yields at u = d_c = 1.796 nm"
    state = state_with(plasticity="constant")
    said = [aside(state, at) for at in (0.5, 1.0)]
    for text, at in zip(said, (0.5, 1.0), strict=True):
        now = view_of(state, at).course.state
        cap = np.pi * float(now.contact_radius) * state.volume_hardness / (2 * state.E_star)
        assert text.startswith(f"a spring yields at u = u_c = {written(cap, 'length')} for a = "), text
    assert said[0] != said[1]
    for nothing in (state_with(plasticity="none"), state_with("microsphere-pdms", adhesion="work")):
        assert aside(nothing) == ""
    page = Page()
    titles = [card.head.parts["formula"].look["object"] for card in page.layout.cards.values()]
    assert not [title for title in titles if re.search(r"\(\d+\)|∫", title)]
    for card in page.layout.cards.values():
        assert card.plot.title in page.layout.below.object
    assert "∫ a(s) ds" in page.layout.below.object


def test_a_tooltip_has_compression_and_load_of_a_spring(projector):
    """Near the axis it has yielded: u = d_c = π q_c/(2E*) = 1.796 nm, q = π q_c/2 = 157 N/m.

    d = 8.978 nm, so that the spring at x has the plastic part d − (π/2) s x − d_c; nothing else is told.
    """
    page = projector.page
    box = page.locator(".card.springs canvas").first.bounding_box()
    page.mouse.move(box["x"] + 0.52 * box["width"], box["y"] + 0.7 * box["height"])
    page.locator(".told").wait_for()
    said = page.locator(".told").inner_text().split("\n")
    assert said[0].startswith("yielded spring at x = ")
    assert said[1] == "elastic part u = 1.8 of at most 1.8 nm = dc"
    x, plastic = (
        float(re.search(r"(−?[\d.]+) nm", line)[1].replace("−", "-")) for line in (said[0], said[2])
    )
    assert said[2].startswith("plastic part ")
    # Three digits are written, of which x has half a percent.
    assert plastic == approx(8.978 - np.pi / 2 * 0.358 * abs(x) - 1.796, abs=0.02)
    assert said[3] == "q = 157 of at most 157 N/m"
    assert page.locator(".bk-Tooltip:visible").count() == 0
    assert "1.796 nm" in page.locator(".card.springs .formula").inner_text()
