"""Sets of files: a folder, a list, a pattern, a zip; one table of their curves."""

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.files import folder

from ..approx import approx
from .files.curves import DEPTH, FORCE, SMALL, STIFFNESS, rows

HEAD, NAMES = "Depth (nm),Load (mN)\n", ["test 1.csv", "test 2.csv", "test 10.csv"]
#: A record with an unloading, of which the k-th curve has k times the modulus and the hardness.
TIP, MEDIUM = mdr.Cone.berkovich(), mdr.Medium(E_star=80e9, hardness=8e9)
PATH = 1e-9 * np.append(np.linspace(0, 500, 200), np.linspace(500, 0, 200)[1:])
LOAD = mdr.indent(TIP, MEDIUM, PATH).force


def table(k=1, head=HEAD, depth=DEPTH, force=FORCE):
    return head + rows(1e9 * depth, 1e3 * k * force)


@pytest.fixture
def files(tmp_path):
    """A folder with three tables; another file that is none, one of a system, and an open workbook."""
    for k, name in enumerate(NAMES, 1):
        (tmp_path / name).write_text(table(k), encoding="utf-8")
    (tmp_path / "notes.txt").write_text("Sample 7, on glass", encoding="utf-8")
    (tmp_path / ".DS_Store").write_bytes(b"\0\0\0\1Bud1")
    (tmp_path / "~$test.xlsx").write_bytes(b"\5lab")
    return tmp_path


def zipped(files):
    path = files / "all.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for each in [*NAMES, "notes.txt"]:
            file.write(files / each, f"lab/{each}")
        file.writestr("__MACOSX/lab/._test 1.csv", b"\0\5\26\7")
    return path


@pytest.mark.parametrize(
    ("given", "unread"),
    [
        (lambda files: files, ["notes.txt"]),
        (lambda files: str(files / "*.*"), ["notes.txt"]),
        (lambda files: str(files / "test *.csv"), []),
        (lambda files: [files / name for name in reversed(NAMES)], []),
        (zipped, ["lab/notes.txt"]),
    ],
    ids=["folder", "pattern", "narrower pattern", "list", "zip"],
)
def test_a_set_has_the_curves_of_its_files_in_natural_order(files, given, unread):
    curves = mdr.read_curves(given(files))
    assert [(Path(name).name, number) for name, number in curves.places] == [(name, 1) for name in NAMES]
    assert list(curves.unread) == unread
    for curve, name in zip(curves, NAMES, strict=True):
        alone = mdr.read_curve(files / name)
        assert curve.depth.tolist() == alone.depth.tolist()
        assert curve.force.tolist() == alone.force.tolist()
    assert curves[1:].places == curves.places[1:]


def test_files_with_several_curves_count_them(files):
    text = table() + "\n" + table(2)
    (files / NAMES[1]).write_text(text.replace(HEAD, "Test\n" + HEAD), encoding="utf-8")
    places = mdr.read_curves(str(files / "test*")).places
    assert places == [(NAMES[0], 1), (NAMES[1], 1), (NAMES[1], 2), (NAMES[2], 1)]


def test_a_question_is_asked_once_for_all_files_with_the_same_heads(tmp_path):
    for k in range(3):
        (tmp_path / f"a{k}.csv").write_text(table(k + 1, "Tiefe (nm),Kraft (mN)\n"), encoding="utf-8")
    (tmp_path / "b.csv").write_text(table(5, "Weg (nm),Last (mN)\n"), encoding="utf-8")
    (tmp_path / "c.csv").write_text(table(6), encoding="utf-8")
    with pytest.raises(mdr.UnknownColumns, match="3 files have this header") as error:
        mdr.read_curves(tmp_path)
    curves = mdr.read_curves(tmp_path, **error.value.suggestion)
    assert list(curves.unread) == ["b.csv"]
    assert [curve.force.max() / FORCE.max() for curve in curves] == approx([1, 2, 3, 6], rel=1e-6)
    # What is told where nothing is asked holds for all files.
    told = {"depth": (0, "nm"), "force": (1, "µN")}
    curves = mdr.read_curves([tmp_path / "c.csv"], columns=told)
    assert curves[0].force.max() == approx(6e-3 * FORCE.max(), rel=1e-6)


def test_constants_of_a_cantilever_hold_for_all_files(tmp_path):
    for k in (1, 2):
        piezo = DEPTH + k * SMALL / STIFFNESS
        text = "Piezo (nm),Force (nN)\n" + rows(1e9 * piezo, 1e9 * k * SMALL)
        (tmp_path / f"{k}.csv").write_text(text, encoding="utf-8")
    columns = {"piezo": (0, "nm"), "force": (1, "nN")}
    curves = mdr.read_curves(tmp_path, columns=columns, spring_constant=STIFFNESS)
    for curve in curves:
        np.testing.assert_allclose(curve.depth, DEPTH, atol=1e-15)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (lambda files: [], "has no files.*give a folder"),
        (lambda files: str(files / "*.tdms"), "has no files"),
        (lambda files: [files / "notes.txt"], "no samples"),
        (lambda files: [files / NAMES[0]] * 1001, "at most 1000"),
    ],
)
def test_a_set_without_a_curve_is_refused(files, given, message):
    with pytest.raises(ValueError, match=message):
        mdr.read_curves(given(files))


@pytest.mark.parametrize("given", [lambda files: files, zipped], ids=["folder", "zip"])
def test_the_size_of_all_files_is_bounded(files, given, monkeypatch):
    path = given(files)
    monkeypatch.setattr(folder, "_BYTES", 2000)
    with pytest.raises(ValueError, match="GB are read: give a part of it"):
        mdr.read_curves(path)


def test_a_damaged_zip_is_refused(files):
    path = zipped(files)
    data = bytearray(path.read_bytes())
    data[60:90] = bytes(30)
    path.write_bytes(data)
    with pytest.raises(ValueError, match=r"all\.zip cannot be unpacked.*give its folder"):
        mdr.read_curves(path)


def curves(count=3):
    return [mdr.MeasuredCurve(PATH, k * LOAD, name=f"{k}.csv") for k in range(1, count + 1)]


FLAT = mdr.MeasuredCurve(PATH, 0 * LOAD, name="flat.csv")


@pytest.mark.parametrize("tip", [TIP, mdr.Paraboloid(1e-6), mdr.RoundedCone(TIP.slope, 1e-7)])
def test_many_curves_are_evaluated_as_each_of_them(tip):
    table = mdr.oliver_pharr(tip, [*curves(), FLAT])
    for i, curve in enumerate(curves()):
        alone = mdr.oliver_pharr(tip, curve)
        assert table.results[i].to_dict() == alone.to_dict()
        numbers = table.E_star[i], table.hardness[i], table.E_star_error[i], table.hardness_error[i]
        errors = alone.standard_errors
        assert numbers == (alone.E_star, alone.hardness, errors["E_star"], errors["hardness"])
    assert np.isnan(table.E_star[3])
    assert "unloading" in table.reason[3]


def unloaded(given):
    return mdr.oliver_pharr(TIP, given)


def fitted(given):
    return mdr.fit_indentation(TIP, given, invalid="nan").table()


@pytest.mark.parametrize("evaluate", [unloaded, fitted])
def test_a_table_has_a_row_for_each_curve_and_what_is_quoted(evaluate, tmp_path):
    pandas = pytest.importorskip("pandas")
    given = [*curves(), FLAT]
    nu, diamond = 0.2, (1141e9, 0.07)
    table = evaluate(given).sample_modulus(nu, diamond)
    frame = table.to_pandas()
    assert frame["file"].tolist() == ["1.csv", "2.csv", "3.csv", "flat.csv"]
    singles = [evaluate([curve]).results[0] for curve in given[:3]]
    numbers = [getattr(each, "quoted", each) for each in singles]
    E = np.array([getattr(each, "value", None) or each.E_star for each in numbers])
    assert frame["E_star"].tolist()[:3] == approx(E, rel=1e-9)
    # Johnson (1985), Eq. (4.5).
    sample = (1 - nu**2) / (1 / E - (1 - diamond[1] ** 2) / diamond[0])
    assert frame["E"].tolist()[:3] == approx(sample, rel=1e-9)
    unloadings = [each.unloading[0] if hasattr(each, "quoted") else each for each in singles]
    H = [each.hardness for each in unloadings]
    assert frame["hardness"].tolist()[:3] == approx(H, rel=1e-9)
    assert np.isnan(frame[["E_star", "hardness", "E"]].to_numpy(float)[3]).all()
    assert frame["reason"][3]
    summary = table.summary()
    assert summary.loc["E*", ["n", "mean", "median"]].tolist() == approx([3, E.mean(), E[1]], rel=1e-9)
    assert summary.loc["E*", "standard deviation"] == approx(np.std(E, ddof=1), rel=1e-9)
    assert summary.loc["E*", "lower quartile"] == approx((E[0] + E[1]) / 2, rel=1e-9)
    table.to_csv(tmp_path / "table.csv")
    again = pandas.read_csv(tmp_path / "table.csv", comment="#")
    assert again["E of the sample (Pa)"].tolist()[:3] == approx(sample, rel=1e-9)
    head = (tmp_path / "table.csv").read_text(encoding="utf-8")
    assert "# sample: Poisson ratio 0.2, tip with 1.141 TPa and 0.07" in head
    pytest.importorskip("openpyxl")
    table.to_excel(tmp_path / "table.xlsx")
    cells = pandas.read_excel(tmp_path / "table.xlsx", header=None)
    numbers = [each for each in cells.to_numpy().ravel() if isinstance(each, float)]
    # A workbook keeps 15 digits.
    assert any(each == approx(E[2], rel=1e-14) for each in numbers)


def test_a_table_says_what_is_missing_and_what_is_doubted(files, tmp_path):
    """Files that are not read, curves without a result, and units that no material has."""
    curves = mdr.read_curves(files)
    table = mdr.oliver_pharr(TIP, [*curves, FLAT])
    told = mdr.oliver_pharr(TIP, curves).settings
    assert "notes.txt" in told["files not read"]
    assert "none 1" in str(table)
    soft = mdr.oliver_pharr(TIP, [mdr.MeasuredCurve(1e3 * PATH, LOAD, name=f"{k}.csv") for k in range(3)])
    assert "3 of 3 curves: E* = " in str(soft)
    pytest.importorskip("pandas")
    soft.to_csv(tmp_path / "soft.csv")
    assert "# remark units: 3 of 3 curves" in (tmp_path / "soft.csv").read_text(encoding="utf-8")


def test_a_curve_that_is_stiffer_than_the_tip_has_no_modulus_of_the_sample():
    table = mdr.oliver_pharr(TIP, curves())
    low, middle, _ = table.E_star
    tip = (low + middle) / 2, 0.0
    sample = table.sample_modulus(0.2, tip)
    assert np.isfinite(sample.E).tolist() == [True, False, False]
    assert sample.E[0] == approx(0.96 / (1 / low - 1 / tip[0]), rel=1e-12)
    assert "2 of 3 curves" in sample.settings["sample"]
    with pytest.raises(ValueError, match="must be stiffer than the contact"):
        table.sample_modulus(0.2, (low / 2, 0.0))


def test_a_name_of_a_file_is_no_formula_in_a_table(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    table = mdr.oliver_pharr(TIP, [mdr.MeasuredCurve(PATH, LOAD, name="=1+1.csv")])
    table = replace(table, settings={"file": "=1+1.csv"})
    table.to_excel(tmp_path / "table.xlsx")
    cells = [cell for row in openpyxl.load_workbook(tmp_path / "table.xlsx").active for cell in row]
    assert "'=1+1.csv" in [cell.value for cell in cells]
    assert not any(cell.data_type == "f" for cell in cells)
    table.to_csv(tmp_path / "table.csv")
    assert "\n'=1+1.csv," in (tmp_path / "table.csv").read_text(encoding="utf-8")


def drawn(overlay, label):
    (element,) = [each for each in overlay if each.label == label]
    return np.array([element.dimension_values(k) for k in (0, 1)])


def test_a_plot_of_an_unloading_shows_the_law_and_the_contact_depth():
    """The law has the slope S and the largest depth, and is within its scatter of the record."""
    pytest.importorskip("holoviews")
    result = mdr.oliver_pharr(TIP, PATH, LOAD)
    plot = result.plot()
    h, F = drawn(plot, "unloading")
    # Axes are in nm and mN.
    assert h[-1] == approx(500, rel=1e-9)
    assert 1e6 * (F[-1] - F[-2]) / (h[-1] - h[-2]) == approx(result.stiffness, rel=0.01)
    measured = np.interp(450e-9, PATH[:198:-1], LOAD[:198:-1])
    assert 1e-3 * np.interp(450, h, F) == approx(measured, rel=0.01)
    assert drawn(plot, "contact depth h_c")[0] == approx(1e9 * result.contact_depth, rel=1e-9)


def test_a_plot_of_many_shows_all_curves():
    pytest.importorskip("holoviews")
    (element,) = mdr.oliver_pharr(TIP, curves()).plot()
    forces = element.dimension_values(1)
    gaps = np.flatnonzero(np.isnan(forces))
    assert [part.max() for part in (forces[: gaps[0]], forces[gaps[0] + 1 : gaps[1]])] == approx(
        [1e3 * LOAD.max(), 2e3 * LOAD.max()], rel=1e-9
    )
    (element,) = mdr.MeasuredCurve(PATH, LOAD).plot()
    assert element.dimension_values(1) == approx(1e3 * LOAD, abs=1e-12, nan_ok=True)
