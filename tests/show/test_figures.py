"""Plots in a notebook: what their elements hold is what the results say, on axes with names and units."""

import sys

import numpy as np
import pytest
from scipy.integrate import trapezoid

import mdr_core as mdr
from mdr_core.show.figures import ROLES, split

from ..approx import approx

hv = pytest.importorskip("holoviews")

MEDIUM = mdr.Medium(1e11, q_c=100.0)
D_C = MEDIUM.critical_depth
DEPTH = D_C * np.array([0.0, 0.5, 1.0, 2.0, 3.0, 2.5, 2.8, 3.0, 4.0, 3.5])
PATH = mdr.indent(mdr.Sphere(1e-6), MEDIUM, DEPTH)


def element(plot, kind, label):
    """The one element of a kind with a label."""
    (found,) = [each for each in plot if isinstance(each, kind) and each.label == label]
    return found


def columns(curve):
    return [curve.dimension_values(dimension) for dimension in curve.dimensions()[:2]]


def test_a_path_is_told_apart_by_what_happens():
    """Pressed elastically, yielding, unloaded, pressed again elastically, yielding, unloaded."""
    rows = split(DEPTH, PATH.force, PATH.depth, PATH.plastic_depth)
    told = {name: (x / D_C).round(9).tolist() for name, (x, _) in rows.items()}
    gap = approx(np.nan, nan_ok=True)
    assert told["elastic"] == [0, 0.5, 1, gap, 2.5, 2.8, 3]
    assert told["yielding"] == [1, 2, 3, gap, 3, 4]
    assert told["unloading"] == [3, 2.5, gap, 4, 3.5]


def test_the_curve_is_force_over_depth_in_fitting_units():
    plot = PATH.plot()
    depth, force = columns(element(plot, hv.Curve, "yielding"))
    np.testing.assert_allclose(depth[:3] * 1e-9, DEPTH[2:5], rtol=1e-14)
    np.testing.assert_allclose(force[:3] * 1e-6, PATH.force[2:5], rtol=1e-14)
    assert [d.pprint_label for d in plot.get(0).dimensions()] == [
        "d, indentation depth (nm)",
        "F, normal force (µN)",
    ]
    assert [d.name for d in plot.get(0).dimensions()] == ["depth", "force"]
    figure = hv.render(plot, backend="bokeh")
    assert figure.xaxis.axis_label == "d, indentation depth (nm)"
    named = {item.label.value: item.renderers[0].glyph.line_color for item in figure.legend[0].items}
    assert named["yielding"] == ROLES["yielded"][0]
    assert named["elastic"] == named["unloading"] == ROLES["elastic"][0]


def test_any_quantity_over_any_other():
    motion = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-12, 1.0).motion(30)
    plot = motion.plot("contact_radius", over="time")
    time = np.concatenate([columns(curve)[0] for curve in plot])
    assert np.nanmax(time) * 1e-9 == approx(motion.time[-1], rel=1e-12)
    assert plot.get(0).vdims[0].pprint_label == "a, contact radius (nm)"
    hits = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-12, [0.1, 1.0, 10.0])
    speed, restitution = columns(hits.plot("restitution", over="speed").get(0))
    assert restitution.tolist() == hits.restitution.tolist()
    np.testing.assert_allclose(speed, [0.1, 1, 10])


def test_pressure_with_the_radii_of_the_contact():
    state = PATH[4]
    plot = state.plot_pressure()
    r, p = columns(element(plot, hv.Curve, "p(r)"))
    np.testing.assert_allclose(p * 1e9, state.pressure(r * 1e-9), rtol=1e-9)
    # The force is the integral of what is drawn, by trapezia at radii dense at the edges.
    inner = r >= 0
    force = trapezoid(2 * np.pi * r[inner] * p[inner], r[inner]) * 1e-9
    assert force == approx(state.force, rel=0.01)
    edges = {float(abs(x) * 1e-9) for each in plot if each.label == "" for x in ends(each)}
    for radius in (state.contact_radius, state.plastic_radius):
        assert min(abs(edge - radius) for edge in edges) < 1e-12 * radius
    assert [d.pprint_label for d in plot.get(0).dimensions()[:2]] == [
        "r, radius (nm)",
        "p, contact pressure (GPa)",
    ]


def ends(element):
    return element.dimension_values(0)[:1] if isinstance(element, hv.Curve) else []


def test_springs_are_yielded_elastic_or_free_where_the_state_says():
    state = PATH[4]
    plot = state.plot_springs()
    spacing = 2 * 1.25 * state.contact_radius / 60
    for name, radius in (("yielded", state.plastic_radius), ("elastic", state.contact_radius)):
        x, z = columns(element(plot, hv.Curve, name))
        assert np.nanmax(np.abs(x)) * 1e-9 == approx(radius, abs=spacing)
        # Nothing is drawn above the indenter's tip and below the base.
        assert -state.depth <= np.nanmax(z) * 1e-9 <= 0
    assert plot.get(0).label == "profile g(x)"


def test_a_motion_along_the_surface_is_plotted_over_time():
    hit = mdr.oblique_impact(mdr.Paraboloid(1e-5), mdr.Medium(1e9), 1e-12, 0.1, 0.1, 0.3, tolerance=1e-2)
    motion = hit.motion(9)
    (curve,) = motion.plot("tangential_velocity", "time")
    time, velocity = columns(curve)
    # In ns, and in mm/s.
    np.testing.assert_allclose(time * 1e-9, motion.time, rtol=1e-12, atol=1e-24)
    np.testing.assert_allclose(velocity * 1e-3, motion.tangential_velocity, rtol=1e-12, atol=1e-15)


def test_a_plot_shows_a_pressure_without_bound_cut_at_its_axis():
    plot = mdr.indent(mdr.FlatPunch(1e-6), mdr.Medium(1e9), 1e-9).plot_pressure()
    _, p = columns(element(plot, hv.Curve, "p(r)"))
    assert np.isfinite(p).all()
    assert "yielded" not in {each.label for each in plot}


@pytest.mark.parametrize(
    ("act", "says"),
    [
        (lambda: PATH.plot("radius"), "Indentation has no 'radius' to plot: .* depth, force"),
        (lambda: PATH[0].plot(), r"needs a single path, but this result has shape \(\)"),
        (lambda: PATH.plot_pressure(), "plot_pressure needs a single state"),
        (lambda: PATH[0].plot_springs(), "needs a contact or an imprint, and there is none at d = 0 m"),
    ],
)
def test_what_cannot_be_plotted_is_refused(act, says):
    with pytest.raises(ValueError, match=says):
        act()


def test_without_holoviews_it_is_said_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "holoviews", None)
    with pytest.raises(ImportError, match="pip install holoviews bokeh"):
        PATH.plot()


def test_a_fit_is_drawn_with_its_residuals():
    """Measured samples and the model over the measured depth, below them the residual and its noise."""
    cone, noise = mdr.Cone(0.3), 2e-9
    depth = np.append(np.linspace(0.0, 60e-9, 60), np.linspace(60e-9, 50e-9, 30))
    force = mdr.indent(cone, mdr.Medium(1e10, q_c=100.0), depth).force
    force = force + noise * np.random.default_rng(5).standard_normal(depth.size)
    fit = mdr.fit_indentation(cone, depth + 3e-9, force, force_noise=noise, depth_noise=1e-11)
    curve, below = fit.plot()
    measured = columns(element(curve, hv.Scatter, "measured"))
    np.testing.assert_allclose(measured, [(depth + 3e-9) * 1e9, force * 1e6], rtol=1e-14)
    model = columns(element(curve, hv.Curve, "fit"))
    np.testing.assert_allclose(model, [(depth + 3e-9) * 1e9, (force - fit.residuals) * 1e6], rtol=1e-14)
    (points,) = [each for each in below if isinstance(each, hv.Scatter)]
    np.testing.assert_allclose(columns(points), [(depth + 3e-9) * 1e9, fit.residuals * 1e9], rtol=1e-14)
    # The band is the standard deviation of both noises, on both sides.
    (band,) = [each for each in below if isinstance(each, hv.Polygons)]
    largest = np.hypot(noise, 1e-11 * fit.path.stiffness.max())
    np.testing.assert_allclose(np.ptp(band.dimension_values(1)), 2e9 * largest, rtol=1e-12)


def shoelace(x, y):
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


def polygon(plot, label):
    """Columns (nm, µN) of the one area with a label."""
    (found,) = [each for each in plot if isinstance(each, hv.Polygons) and each.label == label]
    return [found.dimension_values(dimension) for dimension in found.dimensions()[:2]]


def test_areas_of_a_force_depth_curve_are_the_energies_of_its_last_state():
    """Pressed past the onset, half unloaded, and reloaded: areas to the chords of the curve."""
    depth = D_C * np.concatenate(
        [np.linspace(0, 4, 400), np.linspace(4, 3.5, 50), np.linspace(3.5, 3.8, 50)]
    )
    path = mdr.indent(mdr.Sphere(1e-6), MEDIUM, depth)
    plot, last = path.plot(), path[-1]
    lost, stored = (shoelace(*polygon(plot, name)) * 1e-15 for name in ("plastic work Wₚ", "stored"))
    assert lost == approx(last.plastic_work, rel=2e-3)
    assert stored == approx(last.stored_energy, rel=2e-3)
    elastic = {each.label for each in path[:100].plot()}
    assert elastic == {"stored", "elastic"}
    assert all(not isinstance(each, hv.Polygons) for each in path.plot("contact_radius"))


def test_a_plot_says_which_pressure_its_axis_does_not_reach():
    def said(profile, medium, depth):
        plot = mdr.indent(profile, medium, depth).plot_pressure()
        texts = [text for each in plot if isinstance(each, hv.Labels) for text in each.dimension_values(2)]
        return [text for text in texts if " p " in text]

    assert said(mdr.FlatPunch(1e-6), mdr.Medium(1e9), 1e-9) == ["↑ p → ∞ at the rim"]
    assert said(mdr.Cone(0.3), mdr.Medium(1e9), 1e-9) == ["↑ p → ∞ at the axis"]
    sphere = mdr.Paraboloid(1e-6)
    assert said(sphere, mdr.Medium(1e9), 1e-9) == []
    adhesive = mdr.indent(sphere, mdr.Medium(1e9, work_of_adhesion=0.05), 0.0)
    assert said(sphere, adhesive.medium, 0.0) == ["↓ p → −∞ at the rim"]
    # Tension is below zero on the axis of pressures.
    low, high = hv.Store.lookup_options("bokeh", adhesive.plot_pressure(), "plot").kwargs["ylim"]
    assert low == -high < 0
