"""Files that would stop or fill a reader: long lines, packed files, and numbers that are none."""

import tracemalloc
import zipfile
from contextlib import suppress

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.files import packed
from mdr_core.measurements.files.table import read_tables

from ...said import remark_of
from .curves import DEPTH, FORCE, PIEZO, SMALL, STIFFNESS, assert_curve, rows

NM, MN = 1e9 * DEPTH, 1e3 * FORCE
#: Lines of 10 kB that patterns over a line may take long for.
LINES = {
    "blanks": " " * 9990 + "x", "title": "Test" + " " * 9980 + "1", "brackets": "(" * 9990,
    "cells": "a," * 4990,
    "digits": "1" * 9990, "groups": "1,123" * 1990, "quotes": "'\"," * 3300,
    "slashes": "a/" * 4990,
    "labels": "a:" * 4990, "constants": "k = " * 2490, "units": "nm,mN," * 1600,
    "names": "Depth (nm)," * 900,
    "wide": "ﷺ" * 9990, "bars": "a|" * 4990,
}  # fmt: skip


@pytest.mark.parametrize("line", LINES.values(), ids=LINES)
def test_a_hostile_line_is_answered(write, line):
    """Above the names, between the rows, and alone: with a curve, or a ValueError."""
    names, numbers = "Depth (nm),Load (mN)\n", rows(NM, MN)
    for text in (f"{line}\n{names}{numbers}", f"{names}{numbers}{line}\n{numbers}", f"{line}\n{line}\n"):
        path = write(text)
        for read in (mdr.read_curves, mdr.Sampled.from_csv):
            with suppress(ValueError):
                read(path)


def test_a_line_longer_than_a_header_has_no_constant(write):
    line = "Spring constant: 0.05 N/m" + " " * 2000 + "x"
    path = write(f"{line}\nZ (nm),F (nN)\n" + rows(NM, MN))
    with pytest.raises(mdr.UnknownColumns, match="give spring_constant="):
        mdr.read_curve(path, columns={"piezo": (0, "nm"), "force": (1, "nN")})


@pytest.mark.parametrize("value", ["0.05", "-0.05", "0", "none", "", "nan", "inf"])
def test_a_stiffness_of_a_header_is_a_positive_number_or_it_is_asked_for(write, value):
    """With a positive one the depth is the position minus the deflection F/k."""
    path = write(f"Spring constant: {value} N/m\nZ (nm),F (nN)\n" + rows(1e9 * PIEZO, 1e9 * SMALL))
    columns = {"piezo": (0, "nm"), "force": (1, "nN")}
    if value == f"{STIFFNESS}":
        assert_curve(mdr.read_curve(path, columns=columns), DEPTH, SMALL)
    else:
        with pytest.raises(mdr.UnknownColumns, match="give spring_constant="):
            mdr.read_curve(path, columns=columns)


def test_numbers_of_1e30_and_more_are_missing(write):
    """1.8e308 is how instruments write none; such a row is counted with those that have no number.

    It does not make another path of the curve, either.
    """
    lines = rows(NM, MN).splitlines()
    lines[3], lines[7], lines[9] = "1.8e308,2", "3,-1e40", "5,nan"
    curve = mdr.read_curve(write("Depth (nm),Load (mN)\n" + "\n".join(lines)))
    keep = [k for k in range(75) if k not in (3, 7, 9)]
    assert_curve(curve, DEPTH[keep], FORCE[keep])
    assert "5, 9, 11" in remark_of(curve, "left out")
    lines[3], lines[7], lines[9] = "1.797e308,2", "3,1.797e308", "5,-1.797e308"
    assert mdr.read_curve(write("Depth (nm),Load (mN)\n" + "\n".join(lines))).remarks == curve.remarks


def sheet_with(folder, cell, name="run.xlsx"):
    """A workbook of 1.5 kB with one number."""
    openpyxl = pytest.importorskip("openpyxl")
    pytest.importorskip("pandas")
    book = openpyxl.Workbook()
    book.active[cell] = 1.0
    book.save(folder / name)
    return folder / name


def test_a_number_in_the_last_cell_is_refused_by_its_rows_and_columns(tmp_path):
    with pytest.raises(ValueError, match=r"1048576 rows times 16384 columns .* 10000000 cells"):
        mdr.read_curves(sheet_with(tmp_path, "XFD1048576"))


def test_a_workbook_that_unpacks_to_gigabytes_is_refused(tmp_path, monkeypatch):
    """With a bound of 5 MB in place of 500, as zeros take their time to pack."""
    monkeypatch.setattr(packed, "_UNPACKED", 5_000_000)
    path = sheet_with(tmp_path, "A1")
    with (
        zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as file,
        file.open("xl/media/a.bin", "w") as zeros,
    ):
        zeros.write(bytes(6_000_000))
    with pytest.raises(ValueError, match=r"run\.xlsx .* 0\.006\d* GB.* 0\.005 GB"):
        mdr.read_curves(path)
    archive = path.rename(tmp_path / "run.zip")
    with pytest.raises(ValueError, match=r"run\.zip unpacks to 0\.006"):
        mdr.read_curves(archive)


def test_a_workbook_of_many_sheets_is_refused(tmp_path):
    path = sheet_with(tmp_path, "A1")
    with zipfile.ZipFile(path, "a") as file:
        for k in range(1_000):
            file.writestr(f"xl/worksheets/sheet{k + 2}.xml", "<worksheet/>")
    with pytest.raises(ValueError, match="has 1001 sheets: at most 1000 are read"):
        mdr.read_curves(path)


def test_a_packed_file_of_gigabytes_is_refused_before_it_is_opened(tmp_path):
    """The file has a hole: it takes no room on the disk."""
    pytest.importorskip("openpyxl")
    pytest.importorskip("pandas")
    for name in ("run.xlsx", "run.zip"):
        with (tmp_path / name).open("wb") as file:
            file.truncate(3_000_000_000)
        with pytest.raises(ValueError, match=f"{name} has 3 GB: at most 2 GB are read"):
            mdr.read_curves(tmp_path / name)


def test_the_size_that_a_workbook_claims_does_not_count(tmp_path):
    """A sheet may say that it reaches to XFD1048576 and have ten rows."""
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    path, other = tmp_path / "run.xlsx", tmp_path / "other.xlsx"
    pandas.DataFrame({"Depth (nm)": NM, "Load (mN)": MN}).to_excel(path, index=False)
    with zipfile.ZipFile(path) as file, zipfile.ZipFile(other, "w") as changed:
        for each in file.infolist():
            data = file.read(each)
            changed.writestr(each, data.replace(b'ref="A1:B76"', b'ref="A1:XFD1048576"'))
    assert_curve(mdr.read_curve(other))
    assert np.ptp(mdr.read_curve(path).depth) > 0


@pytest.mark.parametrize("suffix", ["xlsx", "jpk-force", "zip"])
def test_a_zip_of_a_version_that_python_does_not_know_is_a_clear_error(suffix, tmp_path):
    """Version 23.0 in the list of its files, as one of 150 damaged files has."""
    if suffix == "xlsx":
        pytest.importorskip("openpyxl")
    path = tmp_path / f"curve.{suffix}"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("header.properties", "a=1")
    data = bytearray(path.read_bytes())
    data[data.index(b"PK\x01\x02") + 6] = 230
    path.write_bytes(data)
    with pytest.raises(ValueError, match=rf"curve\.{suffix} is packed in an unsupported way"):
        mdr.read_curves(path)


def peak_of(read):
    """Most bytes that were held while something was read."""
    tracemalloc.start()
    try:
        read()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_table_of_too_many_lines_is_refused_before_it_takes_memory(end):
    """4 million lines of a digit would take 0.8 GB; to count them takes none."""
    text = f"1{end}" * 4_000_001

    def refused():
        with pytest.raises(ValueError, match="more than 2000000 samples"):
            read_tables(text, "curve.csv")

    assert peak_of(refused) < 1e6


@pytest.mark.parametrize("row", ["0.001,1.2345", "1.2345678901,3.4567890123,0.123", "0,001;1,234;loading"])
def test_a_table_takes_at_most_twenty_times_its_size(row):
    """Cells, which would take up to fifty times the size, are not kept."""
    text = "depth (nm), force (mN)\n" + f"{row}\n" * 5_000
    assert peak_of(lambda: read_tables(text, "curve.csv")) < 20 * len(text)
