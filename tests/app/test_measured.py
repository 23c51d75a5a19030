"""A measured curve: read as instruments write it, laid over the model, and fitted."""

import numpy as np
import pytest

import mdr_core as mdr
from app import export, measured
from app.drives import follow
from app.explorer import Explorer
from app.measured import Curve, read_curve
from app.plots import PLOTS
from app.view import View

from .test_page import unit as unit_of

DEPTH, FORCE = [-1.0, 0.0, 2.0, 4.0, 3.0], [0.0, 0.0, 1.5, 6.0, 2.0]


def file(columns, header, between=", ", comma=False):
    rows = [between.join(f"{x:.3f}" for x in row) for row in zip(*columns, strict=True)]
    text = "\n".join(rows)
    return "\n".join([*header, text.replace(".", ",") if comma else text]).encode()


@pytest.mark.parametrize(
    ("data", "note"),
    [
        (file((DEPTH, FORCE), ["Depth (nm), Load (mN)"]), "5 samples"),
        (file((FORCE, DEPTH), ["Load [mN];Displacement [nm]"], ";", comma=True), "5 samples"),
        (file((range(5), DEPTH, FORCE), ["# run 7", "Time\th\tP", "s\tnm\tmN"], "\t"), "5 samples"),
        (file((range(5, 0, -1), FORCE[::-1], DEPTH[::-1]), ["t/s,F/mN,d/nm"]), "5 samples"),
        (file((DEPTH, 1e3 * np.array(FORCE)), ["Weg (nm);Kraft (µN)"], ";"), "5 samples"),
        (file((DEPTH, 1e3 * np.array(FORCE)), [""]), "depth in nm and force in µN is a guess"),
        (file((DEPTH, [-f for f in FORCE]), ["h (nm), F (mN)"]), "force turned round"),
        (file(([-d for d in DEPTH], FORCE), ["z (nm) F (mN)"], " "), "depth turned round"),
        (file((DEPTH, 1e3 * np.array(FORCE)), ["h (nm); F (\u03bcN)"], "; "), "5 samples"),
    ],
)
def test_curves_as_instruments_write_them(data, note):
    curve = read_curve(data, "run.csv")
    depth, force = curve.data
    np.testing.assert_allclose(depth, np.array(DEPTH) * 1e-9, rtol=1e-12)
    np.testing.assert_allclose(force, np.array(FORCE) * 1e-3, rtol=1e-12)
    assert note in curve.note


def test_old_encodings_and_long_files():
    rows = 5000
    depth = np.linspace(0, 10, rows)
    data = file((depth, depth**2), ["h (µm), F (µN)"]).decode()
    for encoding in ("utf-16", "cp1252"):
        curve = read_curve(data.encode(encoding), "run.csv")
    assert "5000 samples, one in 3 of them taken" in curve.note
    assert curve.data[0][-1] == pytest.approx(10e-6, rel=1e-3)
    assert len(curve.data[0]) <= 2000


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"h (nm)\n1\n2\n", "one column"),
        (b"h (nm), F (nN)\n1, 2\n2, nan\n", "row 2 of the numbers"),
        (b"h (nm), F (nN)\n1,5,2,3\n", "separate columns by semicolons"),
        (b"h (nm), F (nN)\n1, 2\nx, 3\n", "line 3: expected 2 numbers, found 'x, 3'"),
        (b"nothing", "no rows of numbers"),
        (b"h (nm), F (nN)\n1, 2\n", "one row of numbers"),
        (b" \n", "the file is empty"),
    ],
)
def test_what_is_no_curve_is_refused(data, says):
    with pytest.raises(ValueError, match=says):
        read_curve(data, "run.csv")


def test_columns_and_units_are_corrected():
    curve = read_curve(file((DEPTH, FORCE, FORCE), ["h (nm), F (mN), more"]), "run.csv")
    deeper = curve.corrected("depth", "µm").data[0]
    np.testing.assert_allclose(deeper, 1e3 * curve.data[0])
    np.testing.assert_allclose(curve.corrected("depth", "−nm").data[0], -curve.data[0])
    assert curve.corrected("depth", 1).columns == {"depth": 1, "force": 0, "time": -1}
    assert curve.corrected("time", 2).columns["time"] == 2
    with pytest.raises(ValueError, match="that is the column of force"):
        curve.corrected("time", 1)


def fitted(**changes):
    explorer = Explorer()
    before = explorer.medium()
    explorer.take_curve(measured.example(explorer))
    explorer.param.update(**changes)
    explorer.accept()
    measured.fit(explorer)
    explorer.accept()
    return explorer, before


def view(explorer):
    return View(follow(explorer.scene(), 1.0), curve=Curve.of(explorer))


def test_a_fit_moves_the_page_to_the_medium_and_is_undone():
    explorer, before = fitted()
    # Ten standard errors of 0.4 % noise in 400 samples.
    assert explorer.E_star == pytest.approx(1.3 * before.E_star, rel=1e-2)
    assert explorer.q_c == pytest.approx(0.8 * before.q_c, rel=5e-3)
    deepest = float(np.max(explorer.measured.fit.path.depth))
    assert explorer.scene().drive == mdr.DepthPath(deepest)
    assert measured.agrees(explorer)
    explorer.undo()
    assert explorer.medium() == before
    assert explorer.measured.fit is None
    assert explorer.contact_point == 0
    explorer.undo()
    assert explorer.measured is None


def test_what_is_held_stays():
    explorer, before = fitted(holds=["E_star", "frame_compliance"], noise="given", depth_noise=1e-11)
    assert explorer.medium().E_star == before.E_star
    assert explorer.elasticity == "bodies"
    assert explorer.measured.fit.standard_errors.keys() == {"q_c", "contact_point", "baseline"}
    assert explorer.baseline == explorer.measured.fit.baseline != 0


def test_what_cannot_be_fitted_is_refused_as_it_was():
    explorer = Explorer()
    explorer.take_curve(read_curve(file((range(6), [0] * 6), ["h (nm), F (nN)"]), "flat"))
    with pytest.raises(ValueError, match="no contact in it"):
        measured.fit(explorer)


def test_the_curve_lies_where_it_is_set_to_and_its_residual_is_of_what_is_set():
    explorer, _ = fitted()
    still = view(explorer)
    np.testing.assert_allclose(still.residual, explorer.measured.fit.residuals)
    rows = still.columns(PLOTS["residual"], 0)
    np.testing.assert_allclose(rows["± noise"][1][0], explorer.measured.fit.force_noise)
    z, F = explorer.measured.data
    explorer.param.update(E_star=2e11, baseline=1e-8, contact_point=1e-9, frame_compliance=1e-5)
    moved = view(explorer)
    d = z - 1e-9 - 1e-5 * (F - 1e-8)
    x, y = moved.columns(PLOTS["force"], 0)["measured"]
    np.testing.assert_allclose((x, y), (d, F - 1e-8), rtol=1e-12)
    expected = F - 1e-8 - mdr.indent(explorer.profile(), explorer.medium(), d).force
    np.testing.assert_allclose(moved.residual, expected, rtol=1e-9, atol=1e-15)
    assert np.isnan(moved.columns(PLOTS["residual"], 0)["± noise"][0]).all()
    assert moved.axes["ΔF"].end >= np.abs(expected).max()
    assert moved.axes["ΔF"].start == -moved.axes["ΔF"].end


def test_a_tip_that_ends_above_the_measured_depth_says_so():
    explorer = Explorer()
    explorer.take_curve(measured.example(explorer))
    r = np.linspace(0, 5e-9, 20)
    explorer.take_tip((r, 0.1 * r), "")
    assert view(explorer).columns(PLOTS["residual"], 0)["missing"][2] == "no model at these depths"


@pytest.mark.parametrize("holds", [["baseline"], ["E_star", "baseline", "frame_compliance"], []])
def test_csv_and_python_reproduce_the_fit(holds, tmp_path, monkeypatch):
    explorer, _ = fitted(holds=holds)
    way, found = follow(explorer.scene(), 1.0), explorer.measured.fit
    text = export.fit_csv(way, explorer)
    assert f"# q_c = {found.to_dict()['q_c']!r}" in text
    assert f"# q_c_error = {found.to_dict()['q_c_error']!r}" in text
    (tmp_path / "fit.csv").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    values = {}
    exec(export.python(way) + export.fit_python(explorer.measured), values)
    # The same data by the same way.
    assert values["fit"].to_dict() == pytest.approx(found.to_dict(), rel=1e-9)


def test_a_curve_is_dropped_corrected_and_fitted(explorer, tmp_path):
    page, path = explorer.page, tmp_path / "run.csv"
    d = np.append(np.linspace(-1e-9, 9e-9, 120), np.linspace(9e-9, 7.5e-9, 60))
    F = mdr.indent(mdr.Cone(0.358), mdr.Medium(60e9, 80.0), d).force
    path.write_bytes(file((d * 1e9 + 0.5, F * 1e9), ["h (nm); F (µN)"], "; "))
    page.locator("h1").click()
    page.keyboard.press("f")
    with explorer.change():
        page.get_by_label("CSV file of a measured curve: depth, force").set_input_files(path)
    explorer.choose("Unit of force", "nN")
    assert explorer.hover("force", "measured", 60)[0] == "measured"
    with explorer.change():
        explorer.press("Fit")
    # The file has three decimals, of 1.5 nm of unloading.
    modulus, unit = explorer.field("E*").input_value().split()
    assert float(modulus) == pytest.approx(60, rel=1e-3)
    assert unit == "GPa"
    assert explorer.readout("d") == "9.000 nm"
    y = explorer.row("residual", "measured − model")[1]
    size = unit_of(explorer.axis("residual")["labels"][1], "force")
    assert np.nanmax(np.abs(y)) * size < 1e-3 * F.max()
    with explorer.change():
        explorer.type("q_c", "100 N/m")
    page.get_by_text("What is set on the page is not this fit any more.").wait_for()
    explorer.press("Take with you")
    page.get_by_label("Link to this page, without the measured curve").wait_for()
