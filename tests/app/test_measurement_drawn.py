"""What the page for measurements draws, in the units of its axes, and what is gone with the next file."""

import re

import numpy as np

import mdr_core as mdr

from .measuring import (
    choose,
    choose_samples,
    curve_file,
    headline,
    opened,
    page_of,
    plain,
    saved,
    take_file,
    take_tip,
    text,
)
from .states import table
from .test_drawn import SIZES


def unit(axis):
    """Size (SI) of the unit of an axis, by its label."""
    return SIZES[re.search(r"\((\S+)\)$", axis.axis_label)[1]]


def test_measured_model_residuals_and_noise_are_named_and_in_the_units_of_their_axes():
    """The model is `indent` of what was found; two of three residuals are within their noise.

    Samples that are not fitted are in the legend where there are some.
    """
    page = opened(curve_file(noise=2e-4))
    plots = page.results.plots
    named = {each.name: each.data_source.name for each in plots.force.renderers}
    assert named == {"not fitted": "others", "measured": "measured", "model": "model"}
    assert plain(plots.head.object) == "Force and depth measured model"
    choose_samples(page, 1, 350)
    assert plain(plots.head.object) == "Force and depth not fitted measured model"
    axes, fit = (plots.residual.xaxis, plots.force.yaxis, plots.residual.yaxis), page.found.fit
    length, force, small = map(unit, axes)
    # Otherwise a wrong unit would not be seen.
    assert small < force
    fitted = (page.ends[0] <= page.taken.number) & (page.taken.number <= page.ends[1])
    drawn = {name: (source.data["x"] * length, source.data["y"]) for name, source in plots.sources.items()}
    for name, used in (("measured", fitted), ("others", ~fitted)):
        np.testing.assert_allclose(drawn[name][0], page.taken.depth[used], rtol=1e-12)
        np.testing.assert_allclose(drawn[name][1] * force, page.taken.force[used], rtol=1e-12)
    model = mdr.indent(fit.profile, fit.medium, fit.depth - fit.contact_point).force
    # To the rounding of a curve of 400 samples.
    np.testing.assert_allclose(drawn["model"][1] * force, model, atol=1e-9 * model.max())
    np.testing.assert_allclose(drawn["residuals"][1] * small, fit.force - model, atol=1e-9 * model.max())
    depth, band = drawn["noise"]
    count, order = len(fit.depth), np.argsort(fit.depth)
    np.testing.assert_array_equal(band[:count], -band[count + 1 :])
    np.testing.assert_allclose(depth[:count], fit.depth[order], rtol=1e-12)
    # One standard deviation has 68 % of 350 samples, give or take 2.5 %.
    assert 0.6 < np.mean(np.abs(drawn["residuals"][1][order]) < band[:count]) < 0.76


#: Depths (m) of which two thirds are in the air.
AIR = 1e-6 * np.append(np.linspace(-2, 1, 600), np.linspace(1, 0.7, 60))


def seen(page):
    """Ends of the axis of depth (m), and those of the whole record."""
    plots = page.results.plots
    depth, length = plots.force.x_range, unit(plots.residual.xaxis)
    return tuple(length * end for end in (depth.start, depth.end, depth.reset_start, depth.reset_end))


def test_the_curve_is_drawn_from_a_third_of_the_contact_before_it_on():
    """Before a fit where the force leaves the air, then from the fitted first contact, 50 nm on."""
    page = page_of()
    take_file(page, "run.csv", curve_file(depth=AIR, offset=50e-9, noise=1e-4))
    starts = [seen(page)[0]]
    choose(page, tip="berkovich", medium="constant")
    starts.append(seen(page)[0])
    contact = page.found.fit.contact_point
    assert abs(contact - 50e-9) < 5e-9
    for start in starts:
        # The share of the contact, and the margin of the axis; the force is seen later than it begins.
        assert 0.25 < (contact - start) / (1.05e-6 - contact) < 0.4
    assert starts[0] != starts[1]
    _, end, *whole = seen(page)
    assert 1.05e-6 < end < 1.15e-6
    assert whole[0] < -1.95e-6
    assert whole[1] > 1.05e-6
    # Both plots have one axis.
    assert page.results.plots.residual.x_range is page.results.plots.force.x_range


def test_a_curve_without_air_is_drawn_whole():
    page = page_of()
    depth = 1e-6 * np.append(np.linspace(0, 1, 240), np.linspace(1, 0.7, 160))
    take_file(page, "run.csv", curve_file(depth=depth))
    for medium in ("", "constant"):
        choose(page, tip="berkovich", medium=medium)
        start, end, *whole = seen(page)
        assert [start, end] == whole


def test_a_zoom_stays_while_the_record_stays():
    """Also one to the whole record; another record is drawn around its contact."""
    page = opened(curve_file(depth=AIR))
    depth = page.results.plots.force.x_range
    ends = depth.start, depth.end
    depth.update(start=depth.reset_start, end=depth.reset_end)
    choose(page, contact_point=10e-9)
    assert (depth.start, depth.end) == (depth.reset_start, depth.reset_end) != ends
    take_file(page, "next.csv", curve_file(depth=AIR, offset=1e-7))
    assert depth.start > depth.reset_start


def test_the_modulus_of_the_sample_goes_with_its_poisson_ratio():
    page = opened(curve_file(), poisson=0.2)
    assert re.search(r"E = [\d.]+ .*GPa", headline(page))
    assert "E_sample" in saved(page, "json")
    choose(page, poisson=None)
    assert "Give ν on the left" in headline(page)
    assert "E = " not in headline(page)
    assert "E_sample" not in saved(page, "json")


def test_what_was_said_of_a_file_is_gone_with_the_next():
    """Of a curve, also where the next file cannot be read; of a tip."""
    page = opened(curve_file())
    choose(page, contact_point=1e-3)
    assert "First contact" in text(page.results.errors)
    take_file(page, "damaged.csv", b"nothing")
    assert text(page.results.errors) == ""
    assert "damaged.csv" in text(page.form.errors)
    choose(page, tip="measured")
    take_tip(page, "wrong.csv", b"nothing")
    assert "wrong.csv" in text(page.form.tip_about)
    r = np.linspace(0, 1000, 30)
    take_tip(page, "tip.csv", table({"r (nm)": r, "z (nm)": r**2 / 1e4}).encode())
    assert text(page.form.tip_about) == "30 samples, as in the file"
