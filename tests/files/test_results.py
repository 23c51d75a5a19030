"""Tables of results, one row a test, are no curves."""

import numpy as np
import pytest

import mdr_core as mdr

from .test_texts import DEPTH, FORCE, TIME, assert_curve, rows

#: Sheets as of a workbook of a nanoindenter.
TEST = [
    ["Segment", "Displacement Into Surface", "Load On Sample", "Time On Sample",
     "Harmonic Contact Stiffness", "Hardness", "Modulus"],
    [None, "nm", "mN", "s", "N/m", "GPa", "GPa"],
    *[[None, 1e9 * d, 1e3 * F, t, 2e4, 9.5, 70.0] for d, F, t in zip(DEPTH, FORCE, TIME, strict=True)],
]  # fmt: skip
RESULTS = [
    ["Test", "E", "H", "Displacement", "Load", "Drift"], [None, "GPa", "GPa", "nm", "mN", "nm/s"],
    *[[k + 1, 72.0 + k, 9.5, 200 + 0.3 * (k % 3), 10 + 0.1 * (k % 2), 0.02] for k in range(6)],
    ["Mean", 74.5, 9.5, 200.3, 10.05, 0.02], ["Std. Dev.", 1.9, 0.1, 0.3, 0.05, 0.0],
]  # fmt: skip
SUMMARY = [
    ["Displacement Into Surface", "Load On Sample", "Std Load", "Modulus"], ["nm", "mN", "mN", "GPa"],
    *[[1e9 * d, 1e3 * F, 0.1, 70.0] for d, F in zip(DEPTH[6:56], FORCE[6:56], strict=True)],
]  # fmt: skip
PEAKS = [
    ["Test", "Avg Modulus", "Depth at max load", "Max Load"], [None, "GPa", "nm", "mN"],
    *[[k + 1, 72.0 + k, 200.0 + k % 3, 10.0 + 0.1 * (k % 2)] for k in range(6)],
]  # fmt: skip


def workbook(folder, sheets):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    with pandas.ExcelWriter(folder / "tests.xlsx") as file:
        for name, cells in sheets.items():
            pandas.DataFrame(cells).to_excel(file, sheet_name=name, header=False, index=False)
    return folder / "tests.xlsx"


@pytest.mark.parametrize(
    ("sheet", "cells"),
    [("Results", RESULTS), ("Sample Summary", SUMMARY), ("Ergebnisse", PEAKS), ("A", RESULTS)],
)
def test_sheets_of_results_are_left_out_and_named(tmp_path, sheet, cells):
    curves = mdr.read_curves(workbook(tmp_path, {sheet: cells, "Test 001": TEST}))
    (curve,) = curves
    assert_curve(curve)
    assert f"sheet {sheet!r} is left out, a table of results" in curve.remarks
    assert curve.stiffness.tolist() == [2e4] * DEPTH.size
    with pytest.raises(
        ValueError, match=f"no sheet with columns .* sheet {sheet!r} is left out, a table of results"
    ):
        mdr.read_curves(workbook(tmp_path, {sheet: cells}))


def test_a_sheet_that_is_refused_is_named(tmp_path):
    other = [["Depth (nm)", "Load (kgf)"], *[[1e9 * d, F] for d, F in zip(DEPTH, FORCE, strict=True)]]
    curve = mdr.read_curve(workbook(tmp_path, {"Test 1": TEST, "Test 2": other}))
    assert any("sheet 'Test 2' is left out: " in remark and "kgf" in remark for remark in curve.remarks)


def test_an_unloading_alone_is_a_curve_though_its_depth_hardly_changes(write):
    """As of a hard material in a stiff frame: the force falls to nothing over 7 % of the depth."""
    force = np.linspace(10.0, 0.0, 40)
    depth = 930.0 + 70.0 * (force / 10) ** (2 / 3)
    heads = "Displacement Into Surface (nm),Load (mN),Modulus (GPa)\n"
    curve = mdr.read_curve(write(heads + rows(depth, force, 0 * force + 200)))
    assert_curve(curve, 1e-9 * depth, 1e-3 * force)


BATCH = "".join(
    f"ind_{k}.hys\t{k}\t{100 + k}\t{180 + k % 3}\t{9990 + k * 7 % 5}\t{200 + k * 3 % 7}\t72.{k}\t9.{k}\t1\n"
    for k in range(9)
)
NUMBERED = "".join(f"{k + 1};{10 + 0.01 * (k * 7 % 5)};{200 + k % 3};9.1;70\n" for k in range(8))


@pytest.mark.parametrize(
    "content",
    [
        "File\tInd#\tS(µN/nm)\thc(nm)\tPmax(µN)\thmax(nm)\tEr(GPa)\tH(GPa)\tRate(µN/s)\n" + BATCH,
        "File\tInd#\tS(µN/nm)\thc(nm)\tLoad(µN)\tDepth(nm)\tEr(GPa)\tH(GPa)\tRate(µN/s)\n" + BATCH,
        "Test;Load (mN);Depth (nm);Hardness (GPa);Modulus (GPa)\n" + NUMBERED,
        "Nr.;Kraft (mN);Tiefe (nm);Härte (GPa);E-Modul (GPa)\n" + NUMBERED + "Mittelwert;10;201;9.1;70\n",
        # Loads that grow from test to test.
        "Test;Load (mN);Depth (nm);Hardness (GPa)\n"
        + "".join(f"{k};{k};{20 * k**0.5};9.1\n" for k in range(1, 9)),
        # Without moduli.
        "No.;Load (mN);Depth (nm)\n"
        + "".join(f"{k + 1};{10 + k * 7 % 5};{200 + k * 3 % 7}\n" for k in range(8)),
    ],
)
def test_texts_of_results_are_refused_as_such(write, content):
    path = write(content)
    with pytest.raises(ValueError, match=r"run\.txt is a table of results, not a curve"):
        mdr.read_curve(path)


@pytest.mark.parametrize("head", ["Time (s)", "Point", ""])
def test_moduli_over_depth_are_those_of_a_curve(write, head):
    """As by an oscillation on top of the loading; rows that are counted, too."""
    first = TIME if head == "Time (s)" else np.arange(1, TIME.size + 1)
    names = f"{head},Displacement (nm),Load (mN),Modulus (GPa),Hardness (GPa)\n"
    curve = mdr.read_curve(
        write(names + rows(first, 1e9 * DEPTH, 1e3 * FORCE, 0 * FORCE + 70, 0 * FORCE + 9))
    )
    assert_curve(curve)
