"""Fits: samples of the page, parameters that are fitted or fixed, corrections, the range."""

import json
import re

import numpy as np

import mdr_core as mdr

from ...approx import approx
from ..conftest import ROOT
from ..measuring import (
    DEPTH,
    GLASS,
    TIP,
    choose,
    choose_samples,
    curve_file,
    headline,
    opened,
    page_of,
    take_file,
    take_sample,
    text,
)
from ..states import table


def test_fused_silica_is_one_click_and_its_number_is_that_of_the_unloading():
    """69.6 GPa by micromechanics; with ν = 0.17 and a diamond E is that of the handbooks, 72 GPa."""
    page = page_of()
    take_sample(page, "silica")
    value, error = map(
        float, re.search(r"E\* = ([\d.]+) GPa.* ± ([\d.]+) GPa of noise", headline(page)).groups()
    )
    assert value == approx(69.6, abs=max(0.2, error))
    assert "Oliver and Pharr" in headline(page)
    young = float(re.search(r"E = ([\d.]+) GPa ± ", headline(page))[1])
    assert young == approx(72, rel=0.01)
    hardness = float(
        re.search(r"H = ([\d.]+) GPa ± [\d.]+ GPa, hardness by Oliver", headline(page).replace(" ,", ","))[
            1
        ]
    )
    assert hardness == approx(9.1, abs=0.1)
    assert "of class (a)" in text(page.results.aside)
    # The model's own E* and H are others, which are not to be quoted.
    for own in ("84.53", "14.901"):
        assert own in page.results.why.object
        assert own not in headline(page)
    assert not page.results.take.visible


def test_the_unloading_of_silica_has_its_numbers_in_a_fold():
    """Those of ISO 14577 beside those of Oliver and Pharr, ratios in per cent; a gel has none."""
    page = page_of()
    take_sample(page, "silica")
    result, shown = page.found.unloading, page.results.unloading.object
    assert page.results.folds[0].visible
    assert f"{100 * result.elastic_work_ratio:.4g} %" in shown
    assert f"{100 * result.indentation_creep:.4g} %" in shown
    assert f"{result.martens_hardness / 1e9:.4g} GPa" in shown
    assert all(name in shown for name in ("elastic work ratio", "indentation creep", "Martens hardness"))
    assert "elastic work ratio n_IT" in page.results.report.value
    take_sample(page, "gel")
    assert not page.results.folds[0].visible


def test_the_gel_is_one_click_and_its_number_is_that_of_hertz():
    """nanite's E* of the same samples, from 60 first contacts."""
    reference = json.loads((ROOT / "tests/data/reference.json").read_text())["spot3-0"]
    page = page_of()
    take_sample(page, "gel")
    found = re.search(r"E\* = ([\d.]+) kPa.* ± ([\d.]+) kPa of noise", headline(page))
    value, error = map(float, found.groups())
    assert value * 1e3 == approx(reference["approach"]["hertz_para"]["E_star"], rel=5e-3)
    assert 0.2 < error < 0.8
    assert "from the fit" in headline(page)
    # A gel has no hardness, and so no classes.
    assert not page.results.aside.visible
    assert page.part == "loading"


def test_what_is_held_stays_and_what_is_freed_is_found():
    page = opened(curve_file(offset=4e-9))
    # Another class of hardness leaves what is held as it is; another kind of sample does not.
    choose(page, contact_point=1e-9)
    choose(page, medium="composite")
    assert page.found.fit.contact_point == 1e-9
    choose(page, medium="gel")
    choose(page, medium="constant")
    assert page.found.fit.contact_point == approx(4e-9, abs=1e-12)
    choose(page, E_star=70e9)
    assert page.found.fit.medium.E_star == 70e9
    assert "E_star" not in page.found.fit.standard_errors
    assert headline(page).startswith("E* = ") or "No E* to quote" in headline(page)
    choose(page, E_star=None)
    assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
    # What is found is seen in the empty field.
    field = page.form.numbers["contact_point"]
    assert (field.value, field.placeholder[:3]) == ("", "4 n")
    field.value = "4,5 nm"
    assert page.found.fit.contact_point == 4.5e-9
    field.value = "4.5 furlongs"
    # The error stands below the field, until a number is typed.
    below = page.form.model[list(page.form.model).index(field) + 1]
    assert "furlongs" in text(below)
    assert page.found.fit.contact_point == 4.5e-9
    field.value = "4.5 nm"
    assert below not in page.form.model
    choose(page, contact_point=1e-3)
    assert "z₀ = 1.000 mm" in text(page.results.errors)
    assert page.found is None


def test_the_table_of_classes_marks_the_class_of_the_fit_and_gives_the_misfit_of_each():
    page = opened(curve_file())
    for medium, letter in (("constant", "a"), ("composite", "b"), ("line", "c")):
        choose(page, medium=medium)
        cells = re.findall(r"<th>\((\w)\).*?<td>(.*?)</td><td>(.*?)</td>", page.results.classes.object)
        assert [each for each, _, mark in cells if mark == "fitted"] == [letter]
        misfits = {each: f"{100 * float(fit.misfit):.2g} %" for each, fit in page.found.fit.classes.items()}
        assert {each: misfit for each, misfit, _ in cells} == misfits


def test_a_drag_and_a_viscosity_are_fitted_where_there_are_times():
    """A viscous gel in a liquid, from before contact and back."""
    made, tip = mdr.Medium(20e3, eta=500.0), mdr.Paraboloid(10e-6)
    t = np.linspace(0, 2, 401)
    d = 1e-6 * np.sin(np.pi * t / 2) - 0.2e-6
    F = mdr.indent_in_time(tip, made, d, t).force
    drag = 0.05 * F.max() / (1e-6 * np.pi / 2)
    columns = {"t (s)": t, "Depth (nm)": 1e9 * d, "F (pN)": 1e12 * (F + drag * np.gradient(d, t))}
    page = opened(table(columns).encode(), "viscous", "paraboloid", radius=10e-6)
    assert page.found.fit.medium.E_star == approx(20e3, rel=0.01)
    assert page.found.fit.drag == approx(drag, rel=0.05)
    choose_samples(page, 5, 401)
    assert "sample 1" in text(page.results.errors)
    # Without times they are not offered.
    page = opened(
        table({n: v for n, v in columns.items() if n != "t (s)"}).encode(), "gel", "paraboloid", radius=1e-5
    )
    assert not page.form.numbers["drag"].visible
    assert not page.form.numbers["drift"].visible


def test_adhesion_is_fitted_from_a_pull_off():
    made = mdr.Medium(1e9, work_of_adhesion=0.2)
    d = np.append(np.linspace(-10e-9, 60e-9, 100), np.linspace(60e-9, -20e-9, 120))
    F = mdr.indent(mdr.Cone(0.3), made, d).force
    data = table({"Depth (nm)": 1e9 * d, "F (nN)": 1e9 * F}).encode()
    page = opened(data, "sticky", "cone", half_angle=float(np.arctan(1 / 0.3)))
    assert page.found.fit.medium.work_of_adhesion == approx(0.2, rel=1e-2)
    assert page.found.fit.medium.E_star == approx(1e9, rel=1e-2)


def test_a_drift_and_the_frame_compliance_are_subtracted():
    """E* of a curve with both is that of the curve without."""
    F = mdr.indent(TIP, GLASS, DEPTH).force
    t = 0.1 * np.arange(DEPTH.size)
    drift, frame = 0.05e-9, 20e-9 / F.max()
    z = DEPTH + drift * t + frame * F
    data = table({"t (s)": t, "h (nm)": 1e9 * z, "F (mN)": 1e3 * F}).encode()
    page = opened(data)
    assert page.found.fit.medium.E_star != approx(80e9, rel=1e-2)
    choose(page, drift=drift)
    choose(page, frame=frame)
    assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
    np.testing.assert_allclose(page.taken.depth, DEPTH, atol=1e-14)
    # Another file has neither.
    take_file(page, "next.csv", curve_file())
    assert page.form.given("drift", "frame", "depth_noise") == {}


def test_only_the_chosen_samples_are_fitted_and_the_others_are_faint():
    """A force that is half as large again from the 151st of 300 samples on: the film and its substrate."""
    d = 1e-6 * np.append(np.linspace(-0.05, 1, 200), np.linspace(1, 0.9, 100))
    F = mdr.indent(TIP, GLASS, d).force * np.where(np.arange(300) < 150, 1.0, 1.5)
    page = opened(table({"h (nm)": 1e9 * d, "F (mN)": 1e3 * F}).encode())
    choose(page, E_star=80e9)
    assert page.found.fit.medium.hardness != approx(14e9, rel=0.05)
    # As the browser sends it when a handle is let go.
    choose_samples(page, 1, 150)
    assert page.found.fit.medium.hardness == approx(14e9, rel=1e-4)
    assert len(page.found.fit.depth) == 150
    sources = page.results.plots.sources
    assert [len(sources[name].data["x"]) for name in ("measured", "others", "residuals")] == [150, 150, 150]
    assert "samples=1-150" in page.link().query()
    for part, ends in (("loading", (1, 200)), ("unloading", (200, 300)), ("all", (1, 300))):
        page.results.part.value = part
        assert (page.ends, page.results.ends.value) == (ends, ends)
        assert f"samples {ends[0]} (" in page.results.fitted.object
    choose_samples(page, 240, 300)
    assert text(page.results.errors)
    assert page.found is None
    # An elastic medium has no memory.
    choose(page, medium="gel")
    choose_samples(page, 240, 300)
    assert page.found is not None


def test_noise_of_the_depth_counts_where_it_is_no_rounding_and_no_trifle():
    """Noise of a hundredth of the recovered depth is found; of a ten-thousandth, or none, it is 0."""
    d = np.append(np.linspace(-2, 15, 600), np.linspace(15, 12, 200))
    force = np.maximum(d, 0) ** 2
    for size, expected in ((0.03, 0.03), (3e-4, 0.0), (0.0, 0.0)):
        depth = d + size * np.random.default_rng(3).standard_normal(d.size)
        page = opened(table({"h (nm)": depth, "F (µN)": force}).encode())
        # A standard deviation of 800 samples, from third differences.
        assert page.found.fit.depth_noise == approx(1e-9 * expected, rel=0.2, abs=1e-30)
