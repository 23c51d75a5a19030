"""The plots of the pressure, of the surface and of the stress in a section."""

from dataclasses import replace

import numpy as np
import pytest

from app.explorer.drives import follow
from app.explorer.extras.section import section
from app.explorer.extras.surface import Z as FAR_Z
from app.explorer.extras.surface import surface
from app.explorer.plots import PLOTS, P, R, pressure
from app.explorer.state import preset_state, profile
from mdr_core.show.figures import radii

from ...approx import approx
from ..conftest import DROP, ELASTIC, PUNCH
from ..states import SHAPED, amounts, state_with, view_of


def test_a_peak_that_the_axis_does_not_reach_is_named():
    view = view_of(preset_state())
    states, half = view.course.states, view.end(R)
    tops = {i: states[i].pressure(radii(states[i], half)) for i in range(1, view.course.peak)}
    said = {i: pressure(view, i)["exceeds"][2] for i in tops}
    cut = [i for i, p in tops.items() if np.max(p) > view.end(P)]
    assert [i for i in tops if said[i]] == cut
    first = next(i for i in cut if np.isfinite(tops[i]).all())
    assert max(amounts(said[first])) == approx(np.max(tops[first]), rel=0.01)
    assert "∞ at the rim" in pressure(view_of(preset_state(PUNCH)), 50)["exceeds"][2]


def test_a_plot_without_contact_says_so():
    """Before first contact and after its loss, where the pressure is zero everywhere."""
    view = view_of(preset_state())
    said = [pressure(view, i)["exceeds"][2] == "no contact" for i in range(len(view.course))]
    assert said == (view.course.states.contact_radius == 0).tolist()
    assert said[0]
    assert said[-1]


@pytest.mark.parametrize("shape", SHAPED)
def test_the_surface_lies_on_the_tip_in_contact_and_below_it_beside(shape):
    state = state_with(shape=shape)
    view, made = view_of(state, 1.4), profile(state)
    now = view.course.state
    r, z = surface(view, view.course.now)["deformed surface"]
    gap = made.height(np.minimum(np.abs(r), made.known_radius)) - now.depth - z
    inside, scale = np.abs(r) <= now.contact_radius, view.end(FAR_Z)
    assert inside.sum() > 10
    # To the rounding of a depth.
    assert np.max(np.abs(gap[inside])) < 1e-14 * scale
    assert np.all(gap[~inside] > -1e-12 * scale)


@pytest.mark.parametrize("quantity", ["max_shear", "von_mises", "zz"])
@pytest.mark.parametrize("key", [ELASTIC, DROP])
def test_the_section_shows_the_stress_of_the_core(key, quantity):
    course = follow(preset_state(key))
    found = section(course, (quantity,))
    state, (r, z, colours) = course.state, found.axes
    (left, right), (bottom, top), image = found.rows["image"]
    assert (left, right, bottom, top) == (r.start, r.end, z.start, z.end) == (0, r.end, -r.end, 0)
    assert image.shape == PLOTS["section"].image
    down, along = (30 + 0.5) / image.shape[0], (50 + 0.5) / image.shape[1]
    stress = state.stress(r.end * along, -bottom * (1 - down))
    expected = {"zz": -stress.zz, "max_shear": stress.max_shear, "von_mises": stress.von_mises}[quantity]
    assert image[30, 50] == approx(expected, rel=1e-12)
    drawn_radii = [found.rows[name][0][0] for name in ("contact radius a", "plastic zone c")]
    # Where nothing has yielded no zone is drawn.
    np.testing.assert_array_equal(drawn_radii, [state.contact_radius, state.plastic_radius or np.nan])
    place = found.rows["largest"]
    if quantity == "zz":
        assert np.isnan(place[0]).all()
    else:
        peak = state.stress_peak(quantity)
        assert (place[0][0], place[1][0]) == (peak.r, -peak.z)
        assert image.max() <= peak.value <= colours.end
    if (key, quantity) == (ELASTIC, "max_shear"):
        # Hertz, ν of the preset: 0.3 to 0.33 p₀ on the axis, 0.4 to 0.6 a deep; the note says so.
        assert peak.value / state.pressure(0.0) == approx(0.31, abs=0.02)
        assert f"{peak.value / 1e6:.1f} MPa" in found.note
    unloaded = section(replace(course, now=len(course) - 1), (quantity,))
    assert (unloaded.rows, unloaded.note) == ({}, "No contact, and so no stress.")


def test_pressure_has_one_name_and_what_is_below_the_surface_no_height():
    for name, plot in PLOTS.items():
        titles = [along.title for along in plot.axes]
        rows = [row.name + row.symbol for row in plot.rows]
        assert not [text for text in (*titles, *rows) if "zz" in text or "height" in text], name
    assert PLOTS["pressure"].axes[1].title == "p, pressure"
    # What p is stands with the equation.
    assert "p(r) = −σ_zz(r)" in PLOTS["pressure"].formula_of(view_of(preset_state()).course)
