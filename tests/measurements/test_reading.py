"""Measured curves from files as instruments write them."""

import sys
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx

SILICA = mdr.example("silica.csv")
DEPTH, FORCE, TIME = [-1.0, 0.0, 2.0, 4.0, 3.0], [0.0, 0.0, 1.5, 6.0, 2.0], range(5)


def text(columns, header, between=", ", comma=False):
    rows = "\n".join(between.join(f"{x:.3f}" for x in row) for row in zip(*columns, strict=True))
    return "\n".join([*header, rows.replace(".", ",") if comma else rows])


@pytest.fixture
def read(tmp_path):
    def read(content, name="run.csv", encoding="utf-8"):
        (tmp_path / name).write_text(content, encoding=encoding)
        return mdr.read_curve(tmp_path / name)

    return read


def assert_same(curve):
    np.testing.assert_allclose(curve.depth, np.array(DEPTH) * 1e-9, rtol=1e-12)
    np.testing.assert_allclose(curve.force, np.array(FORCE) * 1e-3, rtol=1e-12)


@pytest.mark.parametrize(
    ("content", "remark"),
    [
        (text((DEPTH, FORCE), ["Depth (nm), Load (mN)"]), ""),
        (text((FORCE, DEPTH), ["force [mN];Displacement [nm]"], ";", comma=True), ""),
        (text((TIME, DEPTH, FORCE), ["# run 7", "Time\th\tP", "s\tnm\tmN"], "\t"), ""),
        (text((TIME, DEPTH, FORCE), ["# columns: time depth load", "# units: s nm mN"], " "), ""),
        (text((DEPTH, FORCE), ["Operator, A. B.", "Date, 2020", "", "depth_nm, force_mN"]), ""),
        (text((DEPTH, FORCE, FORCE), ["h (nm), F (mN), Stiffness (N/m)"]), ""),
        (text((FORCE, DEPTH, FORCE), ["Loading rate (mN/s); Depth (nm); Load (mN)"], ";"), ""),
        (text((TIME[::-1], FORCE[::-1], DEPTH[::-1]), ["t/s,F/mN,h/nm"]), ""),
        (text((DEPTH, 1e3 * np.array(FORCE)), ["Depth (nm);Force (\u03bcN)"], ";"), ""),
        (text((DEPTH, 1e3 * np.array(FORCE)), ["h (nm); F (uN)"], "; "), ""),
        (text((DEPTH, [-f for f in FORCE]), ["h (nm), F (mN)"]), "the sign of force is reversed"),
        (text(([-d for d in DEPTH], FORCE), ["h_nm F_mN"], " "), "the sign of depth is reversed"),
        ("h (m); F (N); \n-1e-9; 0;\n0; 0;\n2e-9; 1.5e-3;\n4e-9; 6e-3;\n3e-9; 2e-3;\n", ""),
        ("\n\nDepth (nm)\tForce (mN)\r\n-1\t0\r\n0\t0\r\n2\t1.5\r\n\r\n4\t6\r\n3\t2\r\n", ""),
        ("h (nm), F (mN), phase\n-1, 0.0, 1\n0, 0.0, 1\n2, 1.5, 1\n4, 6.0, 2\n3, 2.0, 2\n", ""),
        (text((DEPTH, FORCE), ["Depth in nm\tForce in mN"], "\t").replace("\n0.0", "\n# hold\n0.0"), ""),
    ],
)
def test_tables_as_instruments_write_them(read, content, remark):
    curve = read(content)
    assert_same(curve)
    assert remark in " ".join(curve.remarks)
    assert bool(remark) == bool(curve.remarks)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
def test_encodings(read, encoding):
    assert_same(read(text((DEPTH, 1e3 * np.array(FORCE)), ["h (nm); F (µN)"], ";"), encoding=encoding))


def test_time_is_read_in_its_unit_and_left_out_where_it_starts_again(read):
    curve = read(text((DEPTH, FORCE, TIME), ["h (nm), F (mN), t (ms)"]))
    np.testing.assert_allclose(curve.time, 1e-3 * np.arange(5))
    assert curve.to_dict().keys() == {"depth", "force", "time"}
    again = read(text((DEPTH, FORCE, [0, 1, 2, 0, 1]), ["h (nm), F (mN), t (ms)"]))
    assert_same(again)
    assert again.time is None
    assert "the time does not ascend" in again.remarks[0]


def test_an_unloading_alone_keeps_its_signs(read):
    """Depth and force fall from the start on; where both are reversed the force is larger at the end."""
    down = read("h (nm), F (mN)\n9, 5\n8, 3\n7, 1\n")
    assert down.force.tolist() == approx([5e-3, 3e-3, 1e-3])
    reversed_ = read("h (nm), F (mN)\n0, 0\n-8, -3\n-9, -5\n")
    assert reversed_.depth.tolist() == approx([0, 8e-9, 9e-9])
    assert reversed_.columns["force"] == (1, "−mN")


def test_what_is_left_out_is_said_with_its_line(read):
    lines = ["tip; h (nm); F (mN)", *(f"new; {k}; {k * k}" for k in range(8)), "new; ; 9", "old; 9; 81"]
    curve = read("\n".join([*lines, "end"]))
    np.testing.assert_allclose(curve.depth, np.array([*range(8), 9]) * 1e-9, rtol=1e-12)
    column, lines = curve.remarks
    assert "column 1 tip" in column
    assert "lines 10, 12" in lines
    assert "'h (nm)' in nm" in repr(curve)
    assert "by its header" in repr(curve)
    # A gap in a column that is not used leaves out nothing.
    assert len(read("h (nm); F (mN); Temp\n1; 1; 20\n2; 2;\n3; 3; 20\n").depth) == 3


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("h (nm)\n1\n2\n", "run.csv has one column"),
        ("h (nm), F (nN)\n1,5,2,3\n", "line 2: expected two numbers.* separate columns by semicolons"),
        ("nothing", "run.csv: no samples"),
        (" \n", "run.csv is empty"),
        ("h (nm), F (mN)\n1, 2\n", "are the rows samples of one test"),
        ("h (nm), F (nN)\n1, 2\nx, 3\ny, 4\nz\n", "one column of numbers"),
        (
            "h (nm), F (mN)\n1, 2\n3, 4\n4, 7\nx\n5, z\ny\nend\n",
            "most lines of run.csv are not rows of numbers.* 5, 6, 7",
        ),
        ("h (nm), A (nm)\n1, 2\n3, 4\n", "which column is the force"),
        ("h (nm), T-B (V)\n1, 2\n3, 4\n", "which column is the force"),
    ],
)
def test_tables_without_a_curve_are_refused(read, content, says):
    with pytest.raises(ValueError, match=says):
        read(content)


def test_the_measured_example():
    """1220 rows of which the first and the last are as in the file."""
    curve = mdr.read_curve(SILICA)
    assert curve.shape == (1220,)
    assert (curve.depth[-1], curve.force[-1], curve.time[-1]) == approx((-793.566e-9, -1.532953e-3, 341.88))
    assert curve.remarks == ()


def test_sheets_of_an_excel_file(tmp_path):
    """One by one by their number; labels in front and at the end of a test are no numbers."""
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    head = [["Segment", "Displacement", "Load", "Time"], [None, "nm", "mN", "s"]]
    with pandas.ExcelWriter(tmp_path / "tests.xlsx") as file:
        for k in (1, 2):
            rows = [[None, d, k * F, t] for d, F, t in zip(DEPTH, FORCE, TIME, strict=True)]
            cells = pandas.DataFrame([*head, *rows, ["END", None, None, None]])
            cells.to_excel(file, sheet_name=f"Test {k}", header=False, index=False)
    first, second = (mdr.read_curve(tmp_path / "tests.xlsx", index) for index in (0, 1))
    assert_same(first)
    assert (first.name, first.remarks[0][:12]) == ("tests.xlsx, Test 1", "curve 0 of 2")
    np.testing.assert_allclose(second.force, 2 * first.force)
    with pytest.raises(ValueError, match="index = 2 must be from 0 to less than 2"):
        mdr.read_curve(tmp_path / "tests.xlsx", 2)
    (tmp_path / "page.xls").write_text("<html><table><tr><td>1</td></tr></table></html>")
    with pytest.raises(ValueError, match=r"page\.xls is HTML or XML.* save it as"):
        mdr.read_curve(tmp_path / "page.xls")
    (tmp_path / "zeros.xlsx").write_bytes(bytes(99))
    with pytest.raises(ValueError, match=r"zeros\.xlsx cannot be read as an Excel file: "):
        mdr.read_curve(tmp_path / "zeros.xlsx")


@pytest.mark.parametrize(
    "error", [KeyError("time"), UnicodeDecodeError("utf-8", b"\xb5", 0, 1, "start byte")]
)
def test_files_that_afmformats_does_not_read_are_refused(monkeypatch, tmp_path, error):
    """Whatever it raises, also of its own tables, which end in .tab."""

    def load_data(path):
        raise error

    module = ModuleType("afmformats")
    module.load_data = load_data
    module.errors = SimpleNamespace(AFMFileFormatError=TypeError, MissingMetaDataError=TypeError)
    monkeypatch.setitem(sys.modules, "afmformats", module)
    for name in ("run.zip", "run.tab"):
        (tmp_path / name).write_bytes(b"# afmformats 0.13.3\n\xb5")
        with pytest.raises(ValueError, match=f"{name} cannot be read by afmformats"):
            mdr.read_curve(tmp_path / name)


def test_missing_packages_are_named(monkeypatch, tmp_path):
    """Each with a command that works where the project is installed, though no index has it."""
    ways = {
        "jpk-force": ("afmformats", r'pip install "mdr-core\[afm\]"$'),
        "xlsx": ("openpyxl", "pip install openpyxl xlrd$"),
        "xls": ("xlrd", "pip install openpyxl xlrd$"),
    }
    for suffix, (package, install) in ways.items():
        path = tmp_path / f"run.{suffix}"
        path.write_bytes(b"")
        monkeypatch.setitem(sys.modules, package, None)
        with pytest.raises(ImportError, match=f"needs {package}, which is not installed: {install}"):
            mdr.read_curve(path)


@pytest.mark.parametrize(
    "suffix", ["csv", "txt", "xls", "xlsx", "jpk-force", "h5", "ibw", "zip", "tab", "spm"]
)
def test_a_missing_file_is_one_whatever_would_read_it(suffix, tmp_path):
    """Also where the package that would read it is not installed."""
    path = tmp_path / f"no such curve.{suffix}"
    for read in (mdr.read_curve, mdr.read_curves, mdr.Sampled.from_csv):
        with pytest.raises(FileNotFoundError, match="no such curve"):
            read(path)


def test_a_sensitivity_is_for_files_of_instruments(read, tmp_path):
    """A table has forces: what would be ignored is refused."""
    read(text((DEPTH, FORCE), ["h (nm), F (mN)"]))
    with pytest.raises(ValueError, match=r"run\.csv are already in units of force"):
        mdr.read_curve(tmp_path / "run.csv", sensitivity=6e-8)


@pytest.mark.parametrize(
    ("head", "size"),
    [
        ("Harmonic Contact Stiffness N/m", 1.0),
        ("Stiffness (N/m)", 1.0),
        ("S [mN/nm]", 1e6),
        ("Contact stiffness (µN/nm)", 1e3),
        ("Frame Stiffness (N/m)", None),
        ("Support Spring Stiffness N/m", None),
    ],
)
def test_a_measured_contact_stiffness_is_read(read, head, size):
    """1 mN/nm is 10⁶ N/m; the stiffness of the instrument is not that of the contact."""
    stiffness = [1.0, 2.0, 3.0, 4.0, 5.0]
    curve = read(text((DEPTH, FORCE, stiffness), [f"Depth (nm);Load (mN);{head}"], ";"))
    assert_same(curve)
    if size is None:
        assert curve.stiffness is None
    else:
        np.testing.assert_allclose(curve.stiffness, np.array(stiffness) * size)
        np.testing.assert_allclose(curve.retract.stiffness, curve.stiffness[4:])
