"""Remarks, limits and cautions in the notes, and the links of equations to the theory."""

import re
from itertools import product

import numpy as np
import pytest

from app.common.quantities import CHOICES, QUANTITIES
from app.common.tip import read_tip
from app.common.ui import html_subscripts, linked
from app.explorer import changes, theory
from app.explorer.changes import repeat_impact, set_value
from app.explorer.drives import follow
from app.explorer.extras import notes
from app.explorer.page import Page
from app.explorer.plots import PLOTS
from app.explorer.readouts import READOUTS
from app.explorer.search import AsyncPlot
from app.explorer.state import PRESETS, medium, preset_state

from ...approx import approx
from ..conftest import DROP, GOLD
from ..states import adhesive, note, state_with, view_of, viscous


def test_the_note_compares_an_impact_with_the_limit_of_fast_impacts():
    """W = π q_c ∫ √(R s) ds makes the area π R d of the limit, and the depth of the impact its own."""
    state = preset_state(DROP)
    course, R = follow(state), state.paraboloid_radius
    energy = state.mass * state.speed**2 / 2
    depth = (1.5 * energy / (np.pi * state.q_c * R**0.5)) ** (2 / 3)
    more = depth / float(course.turning_point.depth) - 1
    (text,) = (text for _, text in notes.limits(course, state) if "(23), (24)" in text)
    (said,) = re.findall(r"−([\d.]+) %", text.partition("in the")[0])
    assert -float(said) / 100 == approx(more, abs=1e-3)
    # It is one without adhesion.
    state = adhesive("impact")
    assert not any("(23), (24)" in text for _, text in notes.limits(follow(state), state))


def test_only_exceeded_assumptions_are_seen_and_the_rest_folds():
    def poisson(state):
        return {level for level, text in notes.limits(follow(state), state) if "ν = ½" in text}

    state = viscous()
    assert poisson(state) == {"beyond"}
    assert poisson(state.replace(nu_1=0.5)) == {"good"}
    given = changes.choose(state, "elasticity", "modulus")
    assert poisson(given) == {"note"}
    assert medium(given).poisson == 0.5
    html = notes.below(view_of(preset_state()))
    assert html.index("<details>") == 0
    steep = preset_state(DROP).replace(speed=500.0)
    html = notes.below(view_of(steep))
    assert html[: html.index("<details>")].count('class="beyond"') >= 2


def test_a_hold_of_a_medium_without_viscosity_says_that_nothing_changes():
    """Creep of an elastic-plastic medium: depth and force are constant over the whole hold."""
    for damping, pattern in product(("none", "eta"), ("creep", "hold", "cycles")):
        state = state_with(GOLD, "path", pattern=pattern, damping=damping)
        course = follow(state)
        said = [text for _, text in notes.limits(course, state) if "Without viscosity" in text]
        assert len(said) == (damping == "none" and pattern != "cycles")
        if said:
            held = course.motion.time >= state["path.ramp_time"]
            for values in (course.states.depth[held], course.states.force[held]):
                # To the rounding of the search for the depth under a force.
                assert np.ptp(values) <= 1e-9 * values.max()


def test_quasi_static_pressing_is_said_where_it_is_so():
    """Not of creep that is being computed with viscosity, nor of an impact."""
    pressed = state_with(GOLD, damping="eta")
    creeping = state_with(GOLD, "path", damping="eta", pattern="creep")
    hit = state_with(GOLD, "impact", damping="eta")
    for state, says in ((pressed, True), (creeping, False), (hit, False)):
        sentences = " ".join(text for _, text in notes.limits(follow(state), state))
        assert ("quasi-static here" in sentences) is says


def test_presets_are_within_what_the_model_assumes():
    for key in PRESETS:
        levels = [level for level, _ in notes.limits(follow(preset_state(key)), preset_state(key))]
        assert "beyond" not in levels, key


def test_over_an_imprint_yield_goes_on_below_it():
    """Class (b): at the imprint and d_c = π q_c/(2E*), which is where a virgin surface begins to yield."""
    page = Page(f"preset={DROP}")
    assert "dy = 59.90 µm" in note(page, "medium")
    page.apply(lambda state: set_value(state, "plastic_depth", 3e-4))
    # 0.3 mm and 59.90 µm.
    assert "d = 359.9 µm" in note(page, "medium")
    page.apply(repeat_impact)
    assert "59.90" not in note(page, "medium")


def places(html):
    """Where the links to the theory of a text lead to."""
    return re.findall(r'href="app/theory\.html#([\w-]+)"', html)


def test_every_equation_leads_to_the_theory():
    html = theory.html()
    ids = set(re.findall(r'id="((?:eq|section)-\d+)"', html))
    views = [view_of(state_with(DROP, drive, damping="eta")) for drive in ("depth", "impact", "oblique")]
    formulas = [
        plot.formula_of(view.course) for plot in PLOTS.values() for view in views if plot.applies(view)
    ]
    texts = formulas + [choice.help for choice in CHOICES.values()]
    texts += [part for q in (*QUANTITIES.values(), *READOUTS) for part in (q.help, q.equation)]
    led = {place for text in texts for place in places(linked(text))}
    assert len(led) > 20
    assert led <= ids
    # Each plot leads somewhere.
    assert all(places(linked(formula)) for formula in formulas)


def test_half_angle_beside_the_slope_and_drop_height_beside_the_speed():
    page = Page()
    assert "70.30°" in note(page, "shape")
    page.apply(lambda state: changes.choose(state, "preset", DROP))
    # 5.5 kg at 1 m/s: half a joule a kilogram; v²/2g is 1 m²/s² over 19.6133 m/s².
    assert "2.750 J" in note(page, "drive")
    assert "50.99 mm" in note(page, "drive")
    assert "°" not in note(page, "shape")
    # They are those of the speed along the normal, which other drives do not have.
    for drive in ("depth", "path", "oblique"):
        page.choose("drive", drive)
        assert note(page, "drive") == ""


def test_the_hardness_leads_to_a_law_of_your_own():
    """Its explanation names the class of the library, and links to the section that explains it."""
    html = str(linked(CHOICES["plasticity"].help))
    (place,) = re.findall(r'HardnessLaw[^.]*<a href="app/theory.html#(section-\d+)"', html)
    assert "HardnessLaw" in theory.html().partition(f'id="{place}"')[2].partition('id="section-')[0]


def test_python_and_raw_indices_are_not_on_the_page():
    # Laws of the hardness are texts of a list, and Unicode has no lowered c.
    choices = [each for name, each in CHOICES.items() if name != "plasticity"]
    shown = [option.label for choice in choices for option in choice.options.values()]
    shown.append(CHOICES["shape"].help)
    shown += [quantity.label for quantity in QUANTITIES.values()]
    view = view_of(preset_state())
    plots = [plot for plot in PLOTS.values() if plot.applies(view) and not isinstance(plot, AsyncPlot)]
    shown += [axis.label for plot in plots for axis in plot.axes_of(view)]
    assert [text for text in shown if "_" in text] == []
    for shape in CHOICES["shape"].options.values():
        assert "_" not in html_subscripts(shape.height + shape.reduced)
    with pytest.raises(ValueError, match=r"E₁ = 1\.000 mPa is out of bounds"):
        changes.set_value(preset_state(), "E_1", 1e-3)
    with pytest.raises(ValueError, match="header must name") as refused:
        read_tip("0, 0\n1, 1\n")
    assert "m, mm, µm, nm, pm, Å" in str(refused.value)
