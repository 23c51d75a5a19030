"""Tables as text: how numbers are written, lines that are no rows, and files that are binary."""

import pytest

import mdr_core as mdr

from ...said import remark_of
from .curves import DEPTH, FORCE, TIME, assert_curve, rows


@pytest.mark.parametrize(
    ("head", "form"),
    [
        ("Depth (nm),Load (mN)", '"{0:,.2f}","{1:,.2f}"'),
        ("Depth (nm)\tLoad (mN)", "{0:,.2f}\t{1:,.2f}"),
        ("Depth (nm);Load (mN)", "{0:_.2f};{1:_.2f}"),
        ("Depth (nm);Force (mN)", "{0:|.2f};{1:|.2f}"),
        ("Depth (nm);Load (mN)", "{0:'.2f};{1:'.2f}"),
    ],
)
def test_thousands_are_separated_in_several_ways(write, head, form):
    """1,234.56; 1.234,56; 1 234,56; 1'234.56. Two decimals are written."""
    depth, force = 20 * DEPTH, 100 * FORCE
    lines = [head]
    for pair in zip(1e9 * depth, 1e3 * force, strict=True):
        line = form.translate(str.maketrans("_|'", ",,,")).format(*pair)
        if "_" in form:
            line = line.translate(str.maketrans(",.", ".,"))
        elif "|" in form:
            line = line.translate(str.maketrans(",.", "\u202f,"))
        elif "'" in form:
            line = line.replace(",", "'")
        lines.append(line)
    assert_curve(mdr.read_curve(write("\n".join(lines))), depth, force, digits=1e-5)


def test_a_comma_that_may_be_either_is_refused(write):
    with pytest.raises(ValueError, match=r"comma of '1,024' .* thousands"):
        mdr.read_curve(write("Depth (nm)\tLoad (mN)\n0\t0\n512\t2\n1,024\t8\n2,048\t32\n"))
    with pytest.raises(ValueError, match=r"'0,5' .* '1\.024' .* thousand"):
        mdr.read_curve(write("Depth (nm);Load (mN)\n0;0,5\n1.024;8,0\n2.048;32,0\n"))


def test_a_point_that_may_separate_thousands_is_refused(write):
    """512 and 1.024 nm, as Germans write whole numbers, were 512 and 1.024."""
    with pytest.raises(ValueError, match=r"point of '1\.024' .* thousands"):
        mdr.read_curve(write("Depth (nm);Load (mN)\n0;0.5\n512;2\n1.024;8.5\n2.048;32.5\n"))
    # A number below 1, or of other digits, has a decimal point.
    for other in ("0.512", "1.5"):
        curve = mdr.read_curve(write(f"Depth (nm);Load (mN)\n0;0.5\n{other};2\n3;8.5\n4.048;32.5\n"))
        assert curve.depth[-1] == pytest.approx(4.048e-9, rel=1e-12)


def test_a_line_of_numbers_is_no_header(write):
    head = "Hysitron\nTime (s)\tDisp (nm)\tForce (µN)\n0.5\t1.5\t2.5\neoh\n"
    curve = mdr.read_curve(write(head + rows(TIME, 1e9 * DEPTH, 1e6 * FORCE, between="\t")))
    assert_curve(curve)
    assert "line 3:" in remark_of(curve, "left out")


def test_settings_above_the_header_are_no_rows(write):
    head = "Depth limit (nm), 200\nLoad rate (mN/s), 5\nDepth (nm), Load (mN)\n"
    assert_curve(mdr.read_curve(write(head + rows(1e9 * DEPTH, 1e3 * FORCE))))


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("run.spm", "NanoScope Analysis of Bruker: export .* ASCII"), ("run.003", "NanoScope Analysis"),
        ("run.nid", "Nanosurf's program: export"), ("run.nhf", "Nanosurf's program: export"),
        ("run.tdms", "save depth, force and time as a CSV"), ("run.dat", "export depth, force and time"),
    ],
)  # fmt: skip
def test_binary_files_are_refused_with_the_export_to_make(write, name, says):
    """Also those whose header is text."""
    for data in (b"\x00\x01\x02\xff\xd8junk" * 50, b"\\*File list\r\n" * 500 + bytes(range(256))):
        with pytest.raises(ValueError, match=f"{name} is a binary file .* Use .*{says}"):
            mdr.read_curve(write(data, name))


def test_a_line_of_units_may_have_some_that_are_not_known(write):
    names = "Depth\tLoad\tArea\tStatus\tTemp\tSlope\tTime\n"
    units = "nm\tmN\tnm^2\t\tfoo\tN/m\ts\n"
    other = 0 * TIME + 1
    content = names + units + rows(1e9 * DEPTH, 1e3 * FORCE, other, other, other, other, TIME, between="\t")
    curve = mdr.read_curve(write(content))
    assert_curve(curve)
    assert curve.columns["time"] == (6, "s")


@pytest.mark.parametrize("name", ["run.xls", "run.xlsx"])
def test_text_with_the_suffix_of_a_workbook_is_read_as_text(write, name):
    """As programs of instruments write it, which Excel opens with a warning."""
    text = "Depth (nm)\tLoad (mN)\n" + rows(1e9 * DEPTH, 1e3 * FORCE, between="\t")
    assert_curve(mdr.read_curve(write(text, name=name)))
