"""The plot of force over depth: curves, areas, marks and the zone of yield."""

import numpy as np
import pytest

import mdr_core as mdr
from app.explorer.drives import follow
from app.explorer.figures import drawn
from app.explorer.page import Page
from app.explorer.plot import box, rows_of
from app.explorer.plots import PLOTS, D, P, force, pressure
from app.explorer.state import medium, preset_state, profile
from mdr_core.show.units import format_quantity

from ...approx import approx
from ..conftest import DROP, ELASTIC
from ..states import SHAPED, path, polygon, state_with, view_of, viscous


@pytest.mark.parametrize("shape", SHAPED)
def test_loading_curve_and_pressure_are_those_of_the_core(shape):
    state = state_with(shape=shape)
    view = view_of(state)
    for name in ("elastic", "yielding"):
        depth, curve = force(view, 0)[name]
        result = mdr.indent(profile(state), medium(state), depth[:, None])
        np.testing.assert_allclose(curve, result.force[:, 0], rtol=1e-9, atol=1e-30)
    r, p = pressure(view, view.course.now)["p(r)"]
    np.testing.assert_allclose(p, np.minimum(view.course.state.pressure(r), 1e3 * view.end(P)), rtol=1e-9)


@pytest.mark.parametrize("progress", [0.6, 1.7])
def test_areas_of_a_viscous_impact_are_its_energies(progress):
    """Hatched is what yield and dashpots have taken, blue what is stored, up to what has let go."""
    view = view_of(viscous(), progress)
    course, i = view.course, view.course.now
    rows, m = force(view, i), view.course.motion
    contact = float(course.states.stored_energy[i])
    assert polygon(*rows["stored"]) == approx(contact, rel=0.02, abs=1e-3 * m.kinetic_energy[0])
    lost = m.plastic_work[i] + m.viscous_work[i] + m.stored_energy[i] - contact
    # By the trapezoidal rule over 120 instants.
    assert polygon(*rows["dissipated"]) == approx(lost, rel=0.02)
    # The edge of what is stored is at the state.
    assert np.max(rows["stored"][0]) == approx(float(course.states.depth[i]), rel=1e-9)


def test_depths_with_a_plastic_zone_are_marked():
    view = view_of(preset_state())
    d, _ = view.places(PLOTS["force"], view.course.now)["plastic zone, on loading"]
    assert (d.min(), d.max()) == (float(view.course.onset.depth), float(view.course.states.depth.max()))
    course = follow(preset_state())
    yielded = course.states.plastic_radius[: course.peak + 1] > 0
    np.testing.assert_array_equal(yielded, course.states.depth[: course.peak + 1] > d.min())
    # An onset that is just ahead is on the axis; nothing is pressed into a zone beyond it.
    view = view_of(preset_state(ELASTIC))
    rows = view.places(PLOTS["force"], view.course.now)
    assert np.max(view.course.states.depth) < float(rows["onset of yield"][0][0]) < view.end(D)
    imprint = preset_state(DROP).replace(plastic_depth=1e-4)
    shallow = preset_state().replace(max_depth=1e-9)
    for state in (preset_state(ELASTIC), shallow, viscous(), imprint):
        view = view_of(state)
        assert np.isnan(view.places(PLOTS["force"], view.course.now)["plastic zone, on loading"]).all()
        assert "plastic zone, on loading" not in drawn(view, PLOTS["force"])


def test_the_mark_of_the_present_state_is_whole_at_zero_force():
    """It is 13 pixels wide, in a plot of at least 150 pixels."""
    page = Page("at=2")
    shown = page.layout.cards["force"].picture.figure.y_range
    assert -shown.start / (shown.end - shown.start) * 150 >= 6.5


def test_hysteresis_yields_once_a_cycle_and_reloads_elastically():
    state = path("cycles")
    # The first cycle ends where yield begins.
    depth = 5 * medium(state).critical_depth
    view = view_of(state.replace(max_depth=depth))
    assert len(force(view, 0)["path ahead"][0]) == len(view.course)
    rows = force(view, len(view.course) - 1)
    yielding, elastic = rows["yielding"][0], rows["elastic"][0]
    peaks = depth * np.arange(1, 6) / 5
    stretches = np.split(yielding, np.flatnonzero(np.isnan(yielding)))
    ends = [[part[~np.isnan(part)][k] for part in stretches] for k in (0, -1)]
    np.testing.assert_allclose(ends, [peaks[:-1], peaks[1:]], rtol=1e-9)
    # One goes back elastically to where the cycle before began to unload.
    assert np.nanmax(elastic) == approx(peaks[-2], rel=1e-9)


@pytest.mark.parametrize("ratio", [1.02, 1.2, 5.0])
def test_the_plastic_depth_is_written_at_its_point_and_within_the_plot(ratio):
    """At so many times the depth of yield; where d_p is small there is no room on its left."""
    state = preset_state()
    view = view_of(state.replace(max_depth=ratio * float(view_of(state).course.onset.depth)))
    depth, plot = float(view.course.state.plastic_depth), PLOTS["force"]
    x, y, text = view.places(plot, view.course.now)["dₚ"]
    assert text == f"dₚ = {format_quantity(depth, 'length', 3)}"
    (row,) = (each for each in rows_of(plot) if each.name == "dₚ")
    place = box(row, x, y, text, plot.axes_of(view))
    assert place.inside
    # Its end is at the point, or its beginning at the edge of the plot.
    assert place.left < 1 or abs(x - depth) < 0.01 * view.end(D)


@pytest.mark.parametrize("drive", ["impact", "oblique"])
def test_the_curve_changes_its_colour_at_the_onset_of_yield(drive):
    """Below the onset it is Hertz's curve, F ∝ d^(3/2), although yield begins after a few instants."""
    view = view_of(state_with(DROP, drive))
    rows = view.places(PLOTS["force"], view.course.now)
    (depth,), (force,) = rows["onset of yield"]
    elastic, yielding = rows["elastic"], rows["yielding"]
    # The largest depth, ten times that of the onset, is drawn in a hundred steps.
    assert np.nanmax(elastic[0]) == approx(depth, rel=5e-3)
    assert np.nanmin(yielding[0]) == approx(depth, rel=5e-3)
    d, inside = depth * np.linspace(0.05, 0.95, 30), np.isfinite(elastic[0])
    F = np.interp(d, elastic[0][inside], elastic[1][inside])
    # A twentieth of the depth apart, a chord is above the curve by 10⁻³ of the force at its end.
    np.testing.assert_allclose(F, force * (d / depth) ** 1.5, atol=5e-3 * force)
