"""The plot of the springs: yielded, elastic, stretched and leaning springs, and its text."""

import re

import numpy as np
import pytest
from scipy.integrate import trapezoid

from app.explorer.drives import follow
from app.explorer.extras import labels
from app.explorer.extras.oblique import leaning
from app.explorer.figures import drawn, legend
from app.explorer.page import Page
from app.explorer.plot import View
from app.explorer.plots import PLOTS, X
from app.explorer.state import medium, preset_state
from mdr_core.show.springs import SPRINGS
from mdr_core.show.units import format_quantity

from ...approx import approx
from ..conftest import DROP, PUNCH
from ..states import PDMS, adhesive, amounts, oblique_state, solved, state_with, view_of


def test_yielded_springs_reach_to_c_and_elastic_ones_to_a():
    """To the distance of two springs, in an oblique impact too."""
    for state, vertices in ((preset_state(), 1), (state_with(DROP, "oblique"), 9)):
        view = view_of(state)
        rows, now = view.places(PLOTS["springs"], view.course.now), view.course.state
        spacing = 2 * view.end(X) / SPRINGS
        for name, radius in (("yielded", now.plastic_radius), ("elastic", now.contact_radius)):
            assert np.nanmax(np.abs(rows[name][0][::vertices])) == approx(radius, abs=spacing)


@pytest.mark.parametrize("share", [10, 1000])
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
    made, course = medium(state), follow(state)
    ring, c = float(made.q_c / made.E_star / state.cone_slope), float(course.state.plastic_radius)
    text = view_of(state).places(PLOTS["springs"], course.now)["reading"][2]
    assert f"c = {c * 1e9:.1f} nm" in text
    assert f"{ring * 1e9:.2f} nm wide" in text
    onset = float(made.critical_depth)
    for i in np.flatnonzero(course.states.depth[1:20] < onset) + 1:
        assert labels.sentence(course, i).startswith("elastic")
        assert f"d = {onset * 1e9:.2f} nm" in labels.sentence(course, i)
    lifted = labels.sentence(course, len(course) - 1)
    assert labels.sentence(course, 0) == lifted.partition(";")[0] == "no contact"
    assert f"c = {c * 1e9:.1f} nm" in lifted
    punch = follow(preset_state(PUNCH))
    assert "whole flat face" in labels.sentence(punch, 1)
    assert "c = 2.00 mm" in labels.sentence(punch, punch.peak)
    assert "nothing yields" in labels.sentence(follow(state_with(plasticity="none")), 9)
    # With adhesion the depth of the onset is not that of the springs.
    assert "d =" not in labels.sentence(follow(state_with(PDMS, adhesion="work")), 0)


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

    assert "d_c = 1.796 nm" in aside(preset_state())
    state, caps = state_with(plasticity="constant"), []
    for at in (0.5, 1.0):
        now = view_of(state, at).course.state
        caps.append(np.pi * float(now.contact_radius) * state.volume_hardness / (2 * state.E_star))
        assert f"u_c = {format_quantity(caps[-1], 'length')}" in aside(state, at)
    assert caps[0] < caps[1]
    for nothing in (state_with(plasticity="none"), state_with(PDMS, adhesion="work")):
        assert aside(nothing) == ""


def test_equations_are_below_the_plots_and_not_in_their_titles():
    page = Page()
    titles = [card.head.parts["formula"].look["object"] for card in page.layout.cards.values()]
    assert not [title for title in titles if re.search(r"\(\d+\)|∫", title)]
    for card in page.layout.cards.values():
        assert card.plot.title in page.layout.below.object
    assert "∫ a(s) ds" in page.layout.below.object


def test_a_tooltip_has_compression_and_load_of_a_spring(explorer):
    """Near the axis it has yielded: u = d_c = π q_c/(2E*) = 1.796 nm, q = π q_c/2 = 157 N/m.

    d = 8.978 nm, so that the spring at x has the plastic part d − (π/2) s x − d_c; nothing else is told.
    """
    page = explorer.page
    box = page.locator(".card.springs canvas").first.bounding_box()
    page.mouse.move(box["x"] + 0.52 * box["width"], box["y"] + 0.7 * box["height"])
    page.locator(".told").wait_for()
    head, elastic, plastic, load = page.locator(".told").inner_text().split("\n")
    assert head.startswith("yielded")
    (x,), (left,) = amounts(head), amounts(plastic)
    # As much as the limit, in two digits.
    assert re.findall(r"[\d.]+", elastic) == ["1.8", "1.8"]
    assert left == approx(8.978e-9 - np.pi / 2 * 0.358 * abs(x) - 1.796e-9, abs=0.02e-9)
    assert re.findall(r"\d+", load) == ["157", "157"]
    assert page.locator(".bk-Tooltip:visible").count() == 0
    assert "1.796 nm" in page.locator(".card.springs .formula").inner_text()


def test_stretched_springs_are_not_drawn_as_yielded():
    """Springs above the undeformed surface or the imprint carry tension: from √(R d) on, or all."""
    state = adhesive(max_depth=1.7672e-6)
    view = view_of(state)
    spacing = 2 * view.end(X) / SPRINGS
    x = np.abs(view.places(PLOTS["springs"], view.course.now)["stretched"][0].reshape(-1, 9)[:, 0])
    assert x.min() == approx((state.paraboloid_radius * state.max_depth) ** 0.5, abs=1.1 * spacing)
    assert x.max() == approx(float(view.course.state.contact_radius), abs=1.1 * spacing)
    view = view_of(state, 1.9)
    assert view.course.state.force < 0
    rows = view.places(PLOTS["springs"], view.course.now)
    assert np.isfinite(rows["stretched"][0]).any()
    assert not np.isfinite([*rows["yielded"][0], *rows["elastic"][0]]).any()
    assert "stretched" in legend(PLOTS["springs"], drawn(view, PLOTS["springs"]))
