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
    (legend,) = plots.force.legend
    named = {item.label.value: item.renderers[0].data_source.name for item in legend.items}
    assert named == {"not fitted": "others", "measured": "measured", "model": "model"}
    assert [item.visible for item in legend.items] == [False, True, True]
    choose_samples(page, 1, 350)
    assert [item.visible for item in legend.items] == [True, True, True]
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
