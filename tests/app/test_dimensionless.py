"""Dimensionless axes: one curve for all media, and titles that say over what."""

import numpy as np
import pytest

from app import columns, section
from app.drives import follow
from app.explorer import Explorer
from app.plots import PLOTS
from app.presets import PRESETS
from app.view import View

from .conftest import ELASTIC

GOLD, PDMS = "Berkovich-equivalent cone on gold", "Berkovich-equivalent cone on PDMS"
RATIO = {"axes": "ratio"}


def seen(explorer, *held, found=None, chosen=RATIO):
    ways = [follow(each.scene(), 1.0) for each in (explorer, *held)]
    return View(ways[0], ways[1:], found, chosen)


def test_a_cone_carries_nine_critical_forces_at_five_critical_depths():
    """Popov (2015), Eqs. (20), (22): F/F_c = 2 d/d_c − 1, whatever cone and medium."""
    view = seen(Explorer(GOLD))
    d, F = (
        values / view.axes[name].factor
        for name, values in (("d", view.way.states.depth), ("F", view.way.force))
    )
    past = slice(view.first, view.way.peak + 1)
    np.testing.assert_allclose(F[past], 2 * d[past] - 1, rtol=1e-9)
    assert (view.axes["d"].label, view.axes["F"].label) == (
        "d, indentation depth (× d at onset)",
        "F, normal force (× F at onset)",
    )
    assert view.axes["a"].label == "a, c, radius (× a at onset)"
    assert view.axes["p"].label == "−σzz, contact pressure (× mean pressure)"
    a = float(view.way.deepest.contact_radius)
    assert view.axes["r"].factor == view.axes["x"].factor == pytest.approx(a)


def test_cones_on_gold_and_pdms_are_one_curve():
    gold, pdms = Explorer(GOLD), Explorer(PDMS)
    ratio = gold.max_depth / gold.medium().critical_depth
    pdms.max_depth = ratio * pdms.medium().critical_depth
    view = seen(gold, pdms)
    for rows in (columns.force_still(view), columns.pressure_still(view), columns.radii_still(view)):
        assert any(name.startswith("held 1") for name in rows)
    d, F = columns.force_still(view)["held 1"]
    np.testing.assert_allclose(d, view.way.states.depth, rtol=1e-12)
    np.testing.assert_allclose(F, view.way.force, rtol=1e-9, atol=1e-12 * F.max())
    r, p = columns.pressure_still(view)["held 1"]
    # In double precision two media have their edges at radii that differ by rounding.
    away = np.min(
        np.abs(np.abs(r)[:, None] - [view.way.state.contact_radius, view.way.state.plastic_radius]), axis=1
    )
    away = (away > 1e-6 * r.max()) & (r != 0)
    np.testing.assert_allclose(p[away], view.way.state.pressure(r[away]), rtol=1e-6, atol=1e-6 * p.max())
    # With units they are not.
    assert columns.force_still(seen(gold, pdms, chosen={}))["held 1"][1].max() > 3 * view.way.force.max()


def test_where_nothing_yields_the_deepest_state_is_the_unit_and_the_title_says_so():
    explorer = Explorer(ELASTIC)
    explorer.choose("plasticity", "none")
    view = seen(explorer)
    assert view.axes["d"].label.endswith("(× largest d)")
    assert view.axes["F"].label.endswith("(× largest F)")
    assert view.axes["F"].factor == pytest.approx(view.way.force.max())


@pytest.mark.parametrize("label", PRESETS)
def test_every_plot_keeps_its_data_within_dimensionless_axes(label):
    plain, view = (seen(Explorer(label), chosen=chosen) for chosen in ({}, RATIO))
    for name, axis in view.axes.items():
        assert axis.label != plain.axes[name].label
    assert np.all(view.way.force <= view.end["F"])
    assert np.all(view.way.states.depth <= view.end["d"])


def test_what_was_found_at_rest_follows():
    way = follow(Explorer(GOLD).scene(), 1.0)
    (found,) = section.found(way, "zz")
    view = View(way, found={PLOTS["section"].title: found}, chosen=RATIO)
    labels = [axis.label for axis in view.axes_of(PLOTS["section"])]
    assert labels[:2] == ["r, radius (× largest a)", "z, height (× largest a)"]
    assert labels[2].endswith("(× mean pressure)")


@pytest.mark.parametrize("label", PRESETS)
def test_logarithmic_axes_begin_before_yield_and_have_no_zero(label):
    explorer = Explorer(label)
    view, plot = View(follow(explorer.scene(), 1.0), chosen={"references": "all"}), PLOTS["loglog"]
    d, F = view.axes_of(plot)
    assert 0 < d.start <= min(explorer.medium().critical_depth, view.end["d"]) / 10
    for i in range(0, len(view.way), 9):
        for x, y, *_ in view.columns(plot, i).values():
            shown = np.isfinite(x) & np.isfinite(y)
            assert np.all(np.asarray(x)[shown] >= d.start)
            assert np.all(np.asarray(y)[shown] >= F.start)


@pytest.mark.parametrize("pattern", ["hold", "creep"])
def test_a_path_in_time_has_the_most_that_is_put_in_for_its_energy(pattern):
    explorer = Explorer()
    explorer.choose("drive", "path")
    explorer.choose("pattern", pattern)
    view = seen(explorer)
    m = view.way.motion
    put_in = m.stored_energy + m.plastic_work + m.viscous_work
    assert view.axes["E"].factor == pytest.approx(np.max(put_in), rel=1e-12)
    assert view.axes["E"].label.endswith("(× energy put in)")
    # From its beginning on, whenever that is.
    explorer.path = [(row[0], row[1] - explorer.path[-1][1]) for row in explorer.path]
    again = seen(explorer)
    assert again.axes["t"].factor == pytest.approx(view.axes["t"].factor)
