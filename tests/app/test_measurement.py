"""The page for a measurement, without a browser: what it reads, fits, says and saves."""

import csv
import json
import pickle
import re
import struct
import zipfile
from html import unescape
from io import BytesIO
from pathlib import Path
from time import monotonic

import numpy as np
import pandas
import panel as pn
import pytest

import mdr_core as mdr
from app.common import folders
from app.common.process import Here, Replaced
from app.explorer import link
from app.explorer.state import medium, profile
from app.measurement import query
from app.measurement.choices import MEDIA
from app.measurement.export import rounded

from ..approx import approx
from .conftest import ROOT
from .measuring import (
    DEPTH,
    GLASS,
    TIP,
    buttons,
    choose,
    choose_samples,
    curve_file,
    headline,
    link_of,
    opened,
    page_of,
    plain,
    press,
    said,
    saved,
    take_file,
    take_sample,
    take_tip,
    text,
    workbook,
)  # fmt: skip
from .states import table


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
    assert "The curve is of class (a), constant hardness." in text(page.results.aside)
    # The model's own E* is another one, which is said once.
    assert "own E*, 84.53 ± 0.42 GPa, and H, 14.901 ± 0.053 GPa, are not to be quoted" in (
        page.results.why.object
    )
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


def test_tip_and_sample_are_asked_for_one_after_the_other():
    page = page_of()
    take_file(page, "run.csv", curve_file())
    assert headline(page).startswith("Give the tip")
    choose(page, tip="paraboloid")
    assert headline(page).startswith("Give the tip radius R")
    choose(page, tip="berkovich")
    assert headline(page).startswith("Give the sample")
    assert page.found is None
    page.form.medium.value = "constant"
    assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
    # What was told holds for the next file; that of an example does not.
    take_file(page, "other.csv", curve_file(offset=5e-9))
    assert page.found.fit.contact_point == approx(5e-9, abs=1e-12)
    take_sample(page, "gel")
    take_file(page, "run.csv", curve_file())
    assert headline(page).startswith("Give the tip")


@pytest.mark.parametrize(
    ("made", "name"),
    [
        (GLASS, "constant"), (mdr.Medium(80e9, q_c=5000.0), "composite"),
        (mdr.Medium(80e9, f_c=2e-3), "line"),
    ],
)  # fmt: skip
def test_the_class_that_fits_five_times_better_is_taken_by_a_button(made, name):
    """A curve without noise is fitted by its own class alone, with the constant it was made with."""
    own = MEDIA[name].letter
    data = curve_file(made)
    for other in ("constant", "composite", "line"):
        page = opened(data, other)
        assert f"of class ({own})" in text(page.results.aside)
        button = page.results.take
        assert button.visible == (other != name)
        if button.visible:
            assert f"Take class ({own})" in button.label
            press(button)
        assert page.form.medium.value == name
        assert page.found.fit.medium.E_star == approx(80e9, rel=1e-4)
        constant = MEDIA[name].fitted[1]
        assert getattr(page.found.fit.medium, constant) == approx(getattr(made, constant), rel=1e-4)


def test_a_class_that_cannot_be_told_is_not_offered():
    """In 20 % of noise all classes are as good."""
    page = opened(curve_file(noise=0.2))
    assert "This curve does not determine the class of hardness." in text(page.results.aside)
    assert not page.results.take.visible


def test_a_number_without_a_unit_has_that_of_the_number_in_its_field():
    """Also of a result, and of the one before it is emptied."""
    page = page_of()
    take_sample(page, "silica")
    modulus, frame = page.form.numbers["E_star"], page.form.numbers["frame"]
    for _ in range(2):
        assert modulus.placeholder.endswith(" GPa")
        modulus.value = "70"
        assert (modulus.value, page.found.fit.medium.E_star) == ("70 GPa", 70e9)
        modulus.value = ""
    frame.value = "1e-9 m/N"
    assert frame.si == 1e-9
    frame.value = ""
    frame.value = "0.1"
    assert frame.si == approx(0.1e-6, rel=1e-12)


def test_a_wrong_entry_goes_with_its_field_its_sample_and_its_file():
    page = page_of()
    take_sample(page, "silica")
    field = page.form.numbers["E_star"]
    field.value = "abc"
    assert field.error
    take_sample(page, "gel")
    assert (field.value, field.error) == ("", "")
    page.form.numbers["radius"].value = "xx"
    choose(page, tip="berkovich")
    assert page.form.numbers["radius"].error == ""


def test_a_link_to_a_curve_beyond_the_file_shows_the_last_one():
    page = page_of("file=map.xlsx&tip=paraboloid&radius=1e-5&medium=gel&curve=7")
    take_file(page, "map.xlsx", workbook())
    assert (page.results.number.value, link_of(page).curve) == (3, 2)
    assert page.found.fit.medium.E_star == approx(3e4, rel=1e-4)


def take_set(page, files):
    """Drop files together; the action of the last one reads them all."""
    now = monotonic()
    for name, data in files.items():
        page.do(page.take_file, name, data, now)


def test_files_that_come_together_are_one_set_and_the_next_drop_is_another():
    page = page_of()
    choose(page, tip="berkovich", medium="constant")
    files = {f"lab/run {k}.csv": curve_file(mdr.Medium(k * 40e9, hardness=14e9)) for k in (1, 2, 10)}
    take_set(page, files | {"lab/notes.txt": b"nothing"})
    assert (page.file, page.count) == ("4 files", 3)
    assert "notes.txt" in text(page.form.about)
    # In the order of their names, 2 before 10.
    page.do(page.fit_all)
    assert [row.name for row in page.rows] == ["lab run 1.csv", "lab run 2.csv", "lab run 10.csv"]
    assert [row.E / GLASS.E_star for row in page.rows] == approx([0.5, 1, 5], rel=1e-3)
    take_file(page, "next.csv", curve_file())
    assert (page.file, page.count, page.rows) == ("next.csv", 1, [])
    assert "notes.txt" not in text(page.form.about)
    # A file that is dropped after one that was refused is another one.
    take_file(page, "wrong.csv", b"nothing")
    take_file(page, "right.csv", curve_file())
    assert page.file == "right.csv"


def test_a_set_asks_once_and_a_zip_is_one_too():
    force = mdr.indent(TIP, GLASS, DEPTH).force
    rows = "\n".join(f"{1e9 * h:.6f};{1e3 * f:.9f}" for h, f in zip(DEPTH, force, strict=True))
    files = {f"{k}.csv": f"Tiefe (nm);Kraft (mN)\n{rows}".encode() for k in range(3)}
    archive = BytesIO()
    with zipfile.ZipFile(archive, "w") as file:
        for name, data in files.items():
            file.writestr(name, data)
    for drop in (
        lambda page: take_set(page, files),
        lambda page: take_file(page, "a.zip", archive.getvalue()),
    ):
        page = page_of()
        choose(page, tip="berkovich", medium="constant")
        drop(page)
        assert page.question is not None
        assert not page.form.reader.collapsed
        press(page.form.columns.confirm)
        assert page.form.reader.collapsed
        assert page.count == 3
        press(page.results.all)
        assert [row.E for row in page.rows] == approx([GLASS.E_star] * 3, rel=1e-3)


@pytest.mark.parametrize("tip_modulus", [60e9, 20e9])
def test_a_set_is_fitted_and_saved_under_a_tip_that_is_softer_than_its_samples(tip_modulus):
    """Softer than some of them, or than all."""
    page = page_of()
    choose(page, tip="berkovich", medium="constant")
    take_set(page, {f"{k}.csv": curve_file(mdr.Medium(k * 20e9, hardness=14e9)) for k in (2, 4, 5)})
    choose(page, poisson=0.2, tip_modulus=tip_modulus)
    press(page.results.all)
    assert [row.E for row in page.rows] == approx([40e9, 80e9, 100e9], rel=1e-3)
    assert "3 of 3 curves fitted" in page.results.summary.object
    csv_file, _ = (each.callback() for each in page.results.curves_files)
    assert "softer than the contact of 2 of 3" in csv_file.read() or tip_modulus < 40e9


def test_a_set_has_bounds(monkeypatch):
    monkeypatch.setattr(folders, "SET_FILES", 2)
    page = page_of()
    take_set(page, {f"{k}.csv": curve_file() for k in range(3)})
    # Those before the bound are not read without a word.
    assert "At most 2 files" in text(page.form.errors)
    assert page.curve is None
    take_file(page, "next.csv", curve_file())
    assert page.curve is not None


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
    assert "is not a number with one of the units" in text(below)
    assert page.found.fit.contact_point == 4.5e-9
    field.value = "4.5 nm"
    assert below not in page.form.model
    choose(page, contact_point=1e-3)
    assert "First contact z₀ = 1.000 mm is held, and the samples reach only" in text(page.results.errors)
    assert page.found is None


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
    assert "begin the range at sample 1" in text(page.results.errors)
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
    assert "The samples before the range reach deeper" in text(page.results.errors)
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


def test_a_table_without_a_header_asks_for_its_columns_and_units():
    """Nothing is fitted until depth and force have both; then as if the header named them."""
    page = page_of()
    F = mdr.indent(TIP, GLASS, DEPTH).force
    rows = "\n".join(f"{1e3 * f:.9g},{1e9 * h:.9g}" for f, h in zip(F, DEPTH, strict=True))
    take_file(page, "bare.csv", rows.encode())
    assert "bare.csv: which column is the depth and which the force?" in text(page.form.errors)
    form = page.form
    assert form.reader.visible
    assert not form.reader.collapsed
    assert page.curve is None
    form.columns.columns["depth"].value, form.columns.units["depth"].value = 1, "nm"
    form.columns.columns["force"].value = 0
    assert page.curve is None
    form.columns.units["force"].value = "mN"
    press(form.columns.confirm)
    np.testing.assert_allclose(page.curve.depth, DEPTH, rtol=1e-8, atol=1e-16)
    assert not text(page.form.errors)
    # The link has the columns, and asks for the same file.
    again = page_of(page.link().query())
    assert "drop that file here" in text(again.form.about)
    take_file(again, "bare.csv", rows.encode())
    np.testing.assert_allclose(again.curve.force, F, rtol=1e-8, atol=1e-12)
    # A wrong unit is corrected.
    form.columns.units["force"].value = "µN"
    np.testing.assert_allclose(page.curve.force, 1e-3 * F, rtol=1e-8, atol=1e-12)


def german(scale=1.0):
    """A curve whose names are no exact ones."""
    F = scale * mdr.indent(TIP, GLASS, DEPTH).force
    return table({"Tiefe (nm)": 1e9 * DEPTH, "Kraft (mN)": 1e3 * F}).encode()


def test_a_question_is_one_click_and_a_folder_of_files_is_asked_about_once():
    """The choosers have the suggestion, which is drawn; the link has what was told."""
    page = page_of()
    take_file(page, "eine_datei_1.csv", german())
    form = page.form
    assert "eine_datei_1.csv: which column is the depth" in text(page.form.errors)
    assert (form.columns.columns["depth"].value, form.columns.units["force"].value) == (0, "mN")
    assert (form.columns.meaning.value, form.columns.by.value, form.columns.confirm.visible) == (
        "depth",
        "whole",
        True,
    )
    # The suggestion is drawn, and stands beside the choosers, to which no button has to lead.
    assert page.results.figures.visible
    np.testing.assert_allclose(
        page.results.plots.sources["measured"].data["x"], 1e6 * DEPTH, rtol=1e-6, atol=1e-9
    )
    assert buttons(form.errors) == {}
    # It is a suggestion: nothing is read before it is confirmed.
    form.columns.meaning.value = "depth"
    assert page.curve is None
    press(form.columns.confirm)
    np.testing.assert_allclose(page.curve.depth, DEPTH, rtol=1e-7, atol=1e-15)
    assert (text(form.errors), form.columns.confirm.visible) == ("", False)
    assert link_of(page).options == {"columns": {"depth": (0, "nm"), "force": (1, "mN"), "time": None}}
    take_file(page, "eine_datei_2.csv", german(2.0))
    assert not text(page.form.errors)
    F = 2 * mdr.indent(TIP, GLASS, DEPTH).force
    np.testing.assert_allclose(page.curve.force, F, atol=1e-9)
    # Other heads are another question.
    take_file(page, "autre.csv", german().replace(b"Tiefe", b"Profondeur"))
    assert "autre.csv: which column is the depth" in text(page.form.errors)


def test_a_piezo_is_asked_for_its_spring_constant():
    F = 1e-6 * mdr.indent(TIP, GLASS, DEPTH).force
    page = page_of()
    data = table({"Piezo (nm)": 1e9 * (DEPTH + F / 0.05), "Force (nN)": 1e9 * F}).encode()
    take_file(page, "afm.csv", data)
    form = page.form
    assert form.columns.meaning.value == "piezo"
    press(form.columns.confirm)
    assert "give the spring constant" in text(page.form.errors)
    assert "Give the spring constant of the cantilever" in buttons(form.errors)
    choose(page, spring_constant=0.05)
    np.testing.assert_allclose(page.curve.depth, DEPTH, rtol=1e-6, atol=1e-13)
    # The next file of the folder has the same instrument.
    take_file(page, "afm2.csv", data)
    assert page.curve.spring_constant == 0.05


def test_a_deflection_in_volts_asks_for_spring_constant_and_sensitivity():
    """A gel of 20 kPa, 0.05 N/m and 50 nm/V, as an AFM writes it."""
    tip, depth = (
        mdr.Paraboloid(5e-6),
        1e-6 * np.append(np.linspace(-1, 0.6, 300), np.linspace(0.6, -1, 300)),
    )
    deflection = mdr.indent(tip, mdr.Medium(20e3), depth).force / 0.05
    columns = {"Piezo (nm)": 1e9 * (depth + deflection), "Deflection (V)": deflection / 50e-9}
    page = opened(table(columns).encode(), "gel", "paraboloid", radius=5e-6)
    form = page.form
    form.columns.units["force"].value = "V"
    press(form.columns.confirm)
    wanted = {"Give the spring constant of the cantilever", "Give the sensitivity, deflection for 1 V"}
    assert wanted <= buttons(form.errors).keys()
    form.numbers["spring_constant"].value = "0,05"
    form.numbers["sensitivity"].value = "50"
    assert (form.numbers["spring_constant"].value, form.numbers["sensitivity"].value) == (
        "0.05 N/m",
        "50 nm",
    )
    # Volts have six decimals.
    assert page.found.quoted.value == approx(20e3, rel=1e-3)


@pytest.mark.parametrize("kind", ["map", "pairs", "segments", "restart"])
def test_several_curves_are_one_click(kind):
    F = mdr.indent(TIP, GLASS, DEPTH).force
    two = np.tile(1e9 * DEPTH, 2), np.append(1e3 * F, 2e3 * F)
    top = int(np.argmax(DEPTH))
    columns = {
        "map": {"x (um)": np.repeat([0, 5], DEPTH.size), "Depth (nm)": two[0], "Load (mN)": two[1]},
        "restart": {"Depth (nm)": two[0], "Load (mN)": two[1]},
        "pairs": {"Depth 1 (nm)": 1e9 * DEPTH, "Load 1 (mN)": 1e3 * F, "Depth 2 (nm)": 1e9 * DEPTH,
                  "Load 2 (mN)": 2e3 * F},
        "segments": {"Loading depth (nm)": 1e9 * DEPTH[: top + 1], "Loading load (mN)": 1e3 * F[: top + 1],
                     "Unloading depth (nm)": np.linspace(1e9 * DEPTH[top], 1e9 * DEPTH[-1], top + 1),
                     "Unloading load (mN)": np.linspace(1e3 * F[top], 0, top + 1)},
    }[kind]  # fmt: skip
    page = page_of()
    take_file(page, "run.csv", table(columns).encode())
    form = page.form
    ways = {"map": 0, "pairs": "", "segments": "segments", "restart": "restart"}
    assert form.columns.by.value == ways[kind]
    assert "=" not in text(page.form.errors)
    press(form.columns.confirm)
    assert not text(page.form.errors)
    assert page.count == (1 if kind == "segments" else 2)
    page.results.number.value = page.count
    again = page_of(page.link().query())
    take_file(again, "run.csv", table(columns).encode())
    assert again.count == page.count
    np.testing.assert_array_equal(again.curve.force, page.curve.force)


def test_a_column_of_words_tells_curves_apart_where_it_is_chosen():
    """Two places, on one of which the sample is twice as stiff."""
    F, head = mdr.indent(TIP, GLASS, DEPTH).force, "Depth (nm),place,Load (mN)"
    rows = [
        f"{1e9 * depth:.6f},{place},{1e3 * size * force:.6f}"
        for place, size in (("left", 1), ("right", 2))
        for depth, force in zip(DEPTH, F, strict=True)
    ]
    page = page_of()
    take_file(page, "run.csv", "\n".join([head, *rows]).encode())
    parts = page.form.columns.by
    parts.value = parts.options["a curve for each value of 2: place"]
    press(page.form.columns.confirm)
    assert page.count == 2
    page.results.number.value = 2
    # Six digits of it.
    np.testing.assert_allclose(page.curve.force, 2 * F, atol=1e-8)


def test_a_sheet_is_asked_about_when_it_is_chosen(tmp_path):
    """Each kind of heads is one question, and the curves of the others stay."""
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    F = mdr.indent(TIP, GLASS, DEPTH).force
    with pandas.ExcelWriter(tmp_path / "run.xlsx") as file:
        for name, heads in (("A", ("Depth (nm)", "Load (mN)")), ("B", ("Tiefe (nm)", "Kraft (mN)"))):
            frame = pandas.DataFrame(dict(zip(heads, (1e9 * DEPTH, 1e3 * F), strict=True)))
            frame.to_excel(file, sheet_name=name, index=False)
    page = page_of()
    take_file(page, "run.xlsx", (tmp_path / "run.xlsx").read_bytes())
    assert (page.count, page.curve.name[-3:]) == (2, ", A")
    page.results.number.value = 2
    assert "which column is the depth" in text(page.form.errors)
    press(page.form.columns.confirm)
    assert page.curve.name.endswith(", B")
    page.results.number.value = 1
    assert page.curve.name.endswith(", A")


def test_files_that_are_none_are_refused_in_words_and_the_next_one_is_read():
    """Zeros, words, a table of results, a damaged and an empty archive, a name that is none."""
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("a.txt", "nothing")
    page = page_of()
    results = b"Sample,E (GPa),H (GPa)\nglass,70.1,9.1\nsteel,210,3\n"
    for name, data in (
        ("zeros.csv", bytes(10_000)), ("words.txt", b"force after\ndepth\n"), ("none.csv", b""),
        ("results.csv", results), ("a.zip", packed.getvalue()), ("b.zip", b"PK\x03\x04" + bytes(99)),
        ("c.xlsx", b"PK\x03\x04xx"), ("d.jpk-force", b"PK\x03\x04"),
        ("e.h5", struct.pack("100d", *range(100))),
        ("../x\0y/<img src=x>.csv", b"1"), ("f.ibw", b"\0\5" * 50), ("g" * 300, b"\xff\xfe\0"),
    ):  # fmt: skip
        take_file(page, name, data)
        said = text(page.form.errors)
        assert len(said) > 15, name
        assert "<img" not in "".join(each.object for each in page.form.view.select(pn.pane.HTML))
        assert not re.search(r"\w+_\w+=|file \d+\.", said), said
        assert page.busy == ""
    take_file(page, "run.csv", curve_file())
    choose(page, tip="berkovich")
    choose(page, medium="constant")
    assert page.found is not None
    assert not text(page.form.errors)


def test_a_full_disk_is_said_on_the_page(monkeypatch):
    """The curve before it is gone; nothing else is."""

    def full(self, data):
        raise OSError(28, "No space left on device")

    page = opened(curve_file())
    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", full)
        take_file(page, "other.csv", curve_file())
        assert "its disk is full" in text(page.form.errors)
        take_tip(page, "tip.csv", b"r (nm), z (nm)\n0, 0\n1, 1\n")
        assert "its disk is full" in plain(page.form.tip_about.object)
    take_file(page, "other.csv", curve_file())
    assert page.found is not None


def test_a_refusal_names_the_file_and_no_folder_of_the_server():
    page = page_of()
    for name in (
        "damaged.jpk-force",
        "damaged.xlsx",
        "damaged.ibw",
        "damaged.h5",
        "damaged.zip",
        "damaged.csv",
    ):
        take_file(page, name, b"PK\x03\x04 \0\xff" * 20)
        error = text(page.form.errors)
        assert "damaged" in error
        assert not re.search(r"mdr-explorer-|/tmp|file \d", error), error


def test_what_comes_back_of_a_table_is_what_is_shown_of_it():
    """Heads and three rows, of a table whose columns are known and of one that asks for them."""
    rows = "".join(f"{k},{2 * k}\n" for k in range(1000))
    for head in ("h (nm),F (mN)", f"{'x' * 500},y"):
        page = page_of()
        take_file(page, "run.csv", f"{head}\n{rows}".encode())
        assert list(map(len, page.table.values.values())) == [3, 3]
        assert max(map(len, page.table.heads.values())) <= 80
        # Beside the names of its fields.
        assert len(pickle.dumps(page.table)) < 2000


def test_a_tip_is_read_from_a_file():
    r = np.linspace(0, 1e-6, 30)
    page = opened(curve_file(), tip="measured")
    assert headline(page).startswith("Give the file of the tip")
    take_tip(page, "<b>tip.csv", table({"r (nm)": 1e9 * r, "z (nm)": 1e9 * r**2 / 1e-5}).encode())
    assert text(page.form.tip_about) == "30 samples, as in the file"
    E = page.found.fit.medium.E_star
    take_tip(page, "<b>tip.csv", b"nothing")
    assert "<b>tip.csv" in text(page.form.tip_about)
    assert "<b>" not in page.form.tip_about.object
    # The tip before it stays.
    choose(page, frame=1e-12)
    assert page.found.fit.medium.E_star == approx(E, rel=1e-3)


def test_the_files_of_a_fit_have_its_numbers():
    """Values and errors of the result, digit for digit; held ones have no error."""
    page = opened(curve_file(noise=0.004))
    choose_samples(page, 1, 350)
    found = page.found.fit
    told = json.loads(saved(page, "json"), parse_constant=pytest.fail)
    rows = saved(page, "csv").splitlines()
    heads = [line for line in rows if line.startswith("# ")]
    lines = {row["name"]: row for row in csv.DictReader(rows[len(heads) :])}
    for name, value in found.to_dict().items():
        kind = "standard_error" if name.endswith("_error") else "value"
        name = name.removesuffix("_error")
        assert told["numbers"][name][kind] == value
        assert float(lines[name][kind.replace("_", " ")]) == value
    assert lines["baseline"]["standard error"] == ""
    assert told["numbers"]["quoted"]["value"] == found.quoted.value
    assert told["quoted"]["source"] == "fit"
    for letter, each in found.classes.items():
        assert told["numbers"][f"misfit_{letter}"]["value"] == float(each.misfit)
    assert told["samples"] == {"first": 1, "last": 350, "of": 400, "fitted": 350}
    assert heads[0].startswith(f"# mdr_core {mdr.__version__}: fit to run.csv, samples 1 to 350 of 400")
    scene = mdr.Scene.from_json(json.dumps(told["scene"]))
    assert (scene.profile, scene.medium) == (found.profile, found.medium)
    assert told["samples_fitted"]["depth"]["values"] == found.depth.tolist()
    # An elastic medium has q_c = ∞, which JSON has no number for.
    choose(page, medium="gel")
    assert json.loads(saved(page, "json"))["numbers"]["q_c"]["value"] is None


def test_the_link_asks_for_the_same_file_with_everything_that_was_told():
    page = opened(curve_file(timed=True), "constant", "rounded_cone", radius=5e-8, half_angle=1.2)
    choose(page, E_star=81e9)
    choose(page, baseline=None)
    choose(page, frame=1e-7)
    choose(page, poisson=0.2, tip_modulus=1.1e12)
    choose_samples(page, 1, 300)
    again = page_of("fit=&" + page.link().query())
    assert again.link() == page.link()
    take_file(again, "run.csv", curve_file(timed=True))
    assert again.link() == page.link()
    assert again.found.fit.to_dict() == page.found.fit.to_dict()
    assert page.address.value == f"?fit&{page.link().query()}"
    example = page_of(
        "fit&file=Fused+silica,+Berkovich+tip.csv&tip=berkovich&medium=constant&contact_point=0.0"
    )
    assert headline(example).startswith("E* = 69.6")


def test_links_of_the_last_version_open():
    """Columns of one table and of pairs, words and numbers that part curves, parameters free and held."""
    for old, options in (
        ("depth_column=0,nm&force_column=1,mN&time_column=none&by=gaps",
         {"columns": {"depth": (0, "nm"), "force": (1, "mN"), "time": None}, "by": "gaps"}),
        ("piezo_column=2,µm&force_column=3,nN&by=0,4",
         {"columns": {"piezo": (2, "µm"), "force": (3, "nN")}, "by": [0, 4]}),
        ("depth_column=0,nm;2,nm&force_column=1,mN;3,mN&by=segments",
         {"columns": [{"depth": (0, "nm"), "force": (1, "mN")}, {"depth": (2, "nm"), "force": (3, "mN")}],
          "by": "segments"}),
    ):  # fmt: skip
        assert query.read(f"file=a.csv&{old}").options == options
        assert query.Link("a.csv", options=options).query().replace("%C2%B5", "µ") == f"file=a.csv&{old}"
    asked = "file=run.csv&tip=sphere&medium=gel&radius=5e-06&tilt=free&baseline=0.0"
    asked += "&samples=3-90&curve=2&frame=1e-07"
    link = page_of(asked).link()
    assert (link.file, link.tip, link.medium, link.samples, link.curve) == (
        "run.csv",
        "sphere",
        "gel",
        (3, 90),
        2,
    )
    assert link.numbers == {"radius": 5e-6, "tilt": None, "baseline": 0.0, "frame": 1e-7}


@pytest.mark.parametrize(
    "asked",
    [
        "tip=none&medium=x&radius=nan&half_angle=1e999&samples=9-3&curve=-5&held=1", "radius=-1&poisson=7",
        "depth_column=0,<b>&force_column=²,nm&curve=99999999999999", "E_star=abc&medium=gel&samples=1-²",
        "file=" + "<img src=x>" * 999, "&".join("medium=gel" for _ in range(999)), "%00=%00&file=%00",
    ],
)  # fmt: skip
def test_a_hostile_link_opens_the_page(asked):
    page = page_of(asked)
    assert page.found is None
    assert "<img" not in page.form.about.object
    take_file(page, "run.csv", curve_file())
    assert page.busy == ""


def way_to_explorer(page):
    return unescape(re.search(r'href="\?(.*?)"', page.results.explorer.object)[1])


def test_the_way_to_the_explorer_has_tip_and_medium_in_their_digits_and_nothing_else():
    page = opened(curve_file(noise=0.004, timed=True), poisson=0.2)
    state = link.read(way_to_explorer(page))
    E, error = page.found.fit.medium.E_star, page.found.fit.standard_errors["E_star"]
    assert state.E_star == approx(E, abs=0.06 * error)
    assert state.E_star != E
    assert len(f"{state.E_star:.15g}".rstrip("0")) <= 6
    assert (profile(state), medium(state).E_star) == (page.found.fit.profile, state.E_star)
    assert medium(state).hardness == approx(page.found.fit.medium.hardness, rel=1e-2)
    names = set(dict(part.split("=") for part in way_to_explorer(page).split("&")))
    own = {"elasticity", "plasticity", "shape", "cone_slope", "E_star", "volume_hardness", "max_depth"}
    assert names <= own
    # As deep as the curve is from first contact on.
    assert state.max_depth == approx(1e-6, rel=1e-3)
    gel = page_of()
    take_sample(gel, "gel")
    state = link.read(way_to_explorer(gel))
    assert (state.shape, state.paraboloid_radius, state.plasticity) == ("paraboloid", 10e-6, "none")
    assert state.E_star == 19700.0
    assert rounded(12345.678, None) == 12350.0
    assert rounded(-12345.678, 3.21) == -12345.7


class Watched(Here):
    """Jobs that are done at once; after each part of an answer `then` is called, which may stop the job."""

    stopped = False

    def then(self):
        """Look at the page."""

    async def run(self, job, *arguments, part=print, **options):
        def watched(answer):
            part(answer)
            self.then()
            if self.stopped:
                raise Replaced

        self.stopped = False
        return await super().run(job, *arguments, part=watched, **options)

    def stop(self):
        self.stopped = True


def test_all_curves_of_a_file_are_fitted_and_a_dead_one_says_why():
    page = page_of(worker=Watched())
    take_file(page, "map.xlsx", workbook())
    choose(page, tip="paraboloid", radius=1e-5)
    choose(page, medium="gel")
    assert page.count == 3
    assert "curve 1 of 3" in text(page.form.about)
    assert page.found.fit.medium.E_star == approx(2e4, rel=1e-4)
    # The dead curve alone has a reason, and the next one is a click away.
    page.results.number.value = 2
    assert page.found is None
    assert len(text(page.results.errors)) > 20
    page.results.number.value = 3
    assert page.found.fit.medium.E_star == approx(3e4, rel=1e-4)
    seen = []

    def look():
        assert page.results.all.disabled
        seen.append((headline(page), page.results.progress.value, page.results.cancel.visible))
        press(page.results.cancel)

    page.worker.then = look
    press(page.results.all)
    assert seen == [("Fitting curve 2 of 3 …", 1, True)]
    assert not page.results.cancel.visible
    assert text(page.results.errors) == ""
    assert "1 of 3 curves fitted" in page.results.summary.object
    page.worker.then = lambda: None
    press(page.results.all)
    values = [row.E for row in page.rows]
    assert values[0] == approx(2e4, rel=1e-4)
    assert values[1] is None
    assert values[2] == approx(3e4, rel=1e-4)
    assert "E* = 25.0" in page.results.summary.object
    assert "1 without a number" in page.results.summary.object
    rows = re.findall(r"<th>(\d)</th><td>(.*?)</td><td>(.*?)</td><td>(.*?)</td>", page.results.list.object)
    # Those without a number stand first.
    assert [row[0] for row in rows] == ["2", "1", "3"]
    assert rows[0][1] == "–"
    assert len(plain(rows[0][3])) > 20
    csv_file, excel_file = (each.callback() for each in page.results.curves_files)
    table = pandas.read_csv(csv_file, comment="#")
    assert table["E* (Pa)"].tolist() == approx([*values[:1], np.nan, *values[2:]], rel=1e-12, nan_ok=True)
    cells = pandas.read_excel(excel_file, header=None).to_numpy().ravel().tolist()
    # A workbook keeps 15 digits.
    assert any(isinstance(each, float) and each == approx(values[2], rel=1e-14) for each in cells)
    drawn = page.results.all_curves.curves.data
    assert max(map(np.max, drawn["y"])) > 0
    # They are of this tip: of another one all are to be fitted again.
    assert page.results.curves_files.visible
    choose(page, radius=2e-5)
    assert not page.results.list.visible
    assert not page.results.curves_files.visible
    assert page.results.summary.object == ""
    # So are those of columns that the file is no longer read by.
    press(page.results.all)
    assert page.results.list.visible
    page.do(page.read_with, {"columns": {"depth": (0, "m"), "force": (7, "N")}})
    assert page.curve is None
    assert not page.results.list.visible
    assert page.results.summary.object == ""


def test_remarks_have_words_in_the_place_of_names_of_python():
    """Depths that go back and forth, taken as exact; a minus is a minus."""
    noise = np.random.default_rng(3).standard_normal((2, DEPTH.size))
    F = mdr.indent(TIP, GLASS, DEPTH).force
    data = table({"h (nm)": 1e9 * DEPTH + 5 * noise[0], "F (mN)": 1e3 * F * (1 + 0.01 * noise[1])}).encode()
    page = opened(data)
    choose(page, depth_noise=0.0)
    text = said(page) + page.results.report.value
    assert re.findall(r"[A-Za-z]{2,}_[a-z]+|E_star|\w=\w", text) == []
    assert "goes back and forth" in text
