"""Plots of a curve and its fit: units, ranges, zoom, and the saved figure."""

import re
from io import BytesIO

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.show.figures import ROLES

from ..measuring import choose, choose_samples, curve_file, opened, page_of, plain, shown_number, take_file
from ..states import SIZES


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


def seen(page):
    """Ends of the axis of depth (m), and those of the whole record."""
    plots = page.results.plots
    depth, length = plots.force.x_range, unit(plots.residual.xaxis)
    return tuple(length * end for end in (depth.start, depth.end, depth.reset_start, depth.reset_end))


#: Depths (m) of which two thirds are in the air.
AIR = 1e-6 * np.append(np.linspace(-2, 1, 600), np.linspace(1, 0.7, 60))


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


Image = pytest.importorskip("PIL.Image")


def test_the_figure_is_saved_as_one_picture(measurement):
    """960 × 720 points of two pixels: samples over the model, the residuals, and a text at the bottom."""
    page = measurement.page
    measurement.press("Sample: fused silica")
    shown_number(measurement, "69")
    page.locator(".of-residual canvas").first.wait_for()
    before = page.locator(".of-force").bounding_box()
    with page.expect_download() as download:
        measurement.press("Save figure")
    assert download.value.suggested_filename == "Fused silica, Berkovich tip_fit.png"
    image = np.asarray(Image.open(BytesIO(download.value.path().read_bytes())).convert("RGB"), int)
    assert image.shape == (1440, 1920, 3)

    def where(role):
        wanted = [int(ROLES[role][0][k : k + 2], 16) for k in (1, 3, 5)]
        return np.nonzero((np.abs(image - wanted).max(axis=2) < 8).any(axis=1))[0]

    model, measured = where("elastic"), where("measured")
    # A swatch in the legend, above the plot; the residuals have no model.
    assert 60 < model.min() < 100 < model.max() < 928
    assert measured.min() < 100
    assert 1000 < measured.max() < 1392
    text = np.abs(image[1396:] - image[0, 0]).max(axis=2) > 100
    assert np.count_nonzero(text.any(axis=0)) > 900
    # The plots have their size on the page again.
    height = "explorer.all().find((each) => each.matches('.of-force')).offsetHeight"
    measurement.wait(f"(before) => Math.abs({height} - before) < 2", before["height"])


def test_a_double_click_shows_the_whole_record(measurement):
    page = measurement.page
    measurement.press("Sample: gel by AFM")
    shown_number(measurement, "kPa")
    page.locator(".of-force canvas").first.wait_for()
    start = "Bokeh.documents[0].get_model_by_name('force plot').x_range.start"
    # µm: the record has two of air, and 0.14 of contact.
    assert -0.1 < page.evaluate(start) < 0
    box = page.locator(".of-residual").bounding_box()
    page.mouse.dblclick(box["x"] + box["width"] / 2, box["y"] + box["height"] / 3)
    measurement.wait(f"{start} < -1.9")
