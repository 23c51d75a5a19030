"""Files of curves: columns, units, several curves, and files that cannot be read."""

import re
import struct
import zipfile
from io import BytesIO
from pathlib import Path

import numpy as np
import panel as pn
import pytest

import mdr_core as mdr

from ...approx import approx
from ..measuring import (
    DATA,
    DEPTH,
    GLASS,
    TIP,
    afm_curve,
    buttons,
    choose,
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
    take_tip,
    text,
)
from ..states import table


def test_a_table_without_a_header_asks_for_its_columns_and_units():
    """Nothing is fitted until depth and force have both; then as if the header named them."""
    page = page_of()
    F = mdr.indent(TIP, GLASS, DEPTH).force
    rows = "\n".join(f"{1e3 * f:.9g},{1e9 * h:.9g}" for f, h in zip(F, DEPTH, strict=True))
    take_file(page, "bare.csv", rows.encode())
    assert "bare.csv: which column is the depth" in text(page.form.errors)
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
        # By its name, or that within an archive, and not by that of a folder of the server.
        assert {"a.zip": "a.txt"}.get(name, name) in said or len(name) > 60 or "\0" in name, name
        assert not re.search(r"mdr-explorer-|/tmp|file \d", said), said
        assert "<img" not in "".join(each.object for each in page.form.view.select(pn.pane.HTML))
        assert not re.search(r"\w+_\w+=", said), said
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


def test_a_name_of_a_file_is_no_symbol():
    """“d_c” is typeset with an index, “d_c.csv” is not."""
    page = page_of()
    for data in (b"nothing", b"a,b\n1,2\n2,3\n3,5\n"):
        take_file(page, "d_c.csv", data)
        (error,) = page.form.errors
        assert "d_c.csv" in error.object
        assert "<sub>" not in error.object.partition(":")[0]


def test_remarks_name_the_file_that_was_dropped():
    """In a file that is kept under another name, in a folder of the server."""
    page = opened((DATA / "steel.csv").read_bytes(), name="steel_1.csv")
    texts = said(page) + saved(page, "json") + saved(page, "csv")
    assert not re.search(r"file \d+\.csv|/tmp|mdr-explorer-", texts)


def test_an_afm_file_without_a_stiffness_is_asked_for_it_and_not_fitted(tmp_path):
    pytest.importorskip("h5py")
    afm_curve().export_data(tmp_path / "gel_1.h5", fmt="hdf5")
    page = opened((tmp_path / "gel_1.h5").read_bytes(), "gel", "paraboloid", "gel_1.h5", radius=5e-6)
    assert headline(page).startswith("Give the spring constant k")
    assert "includes the deflection" in text(page.results.below)
    assert page.found is None
    # The curve is seen.
    assert page.results.figures.visible
    assert "Pa" not in said(page)
    press(buttons(page.results.below)["Give the spring constant of the cantilever"])
    assert page.form.reader.visible
    assert not page.form.reader.collapsed
    assert not page.form.columns.view.visible
    # A browser may tell a number twice: without a unit it is still in that in which it was typed.
    stiffness = page.form.numbers["spring_constant"]
    for _ in range(2):
        stiffness.value = "0.05"
        assert stiffness.value == "0.05 N/m"
    assert headline(page).startswith("E* = 20")
    assert page.found.quoted.value == approx(20e3, rel=1e-3)
    # The link has it.
    assert link_of(page).numbers["spring_constant"] == 0.05


def test_a_map_without_a_stiffness_is_not_fitted(tmp_path):
    """Nor is one of its curves, where others have it."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "map.h5", "w") as file:
        for k in range(2):
            made = afm_curve()
            made.metadata["enum"] = k
            made.export_data(file, fmt="hdf5")
    page = opened((tmp_path / "map.h5").read_bytes(), "gel", "paraboloid", "map.h5", radius=5e-6)
    assert page.count == 2
    assert page.results.all.disabled
    page.do(page.fit_all)
    assert [row.E for row in page.rows] == [None, None]
    assert all("includes the deflection" in row.reason for row in page.rows)
    choose(page, spring_constant=0.05)
    assert not page.results.all.disabled
    page.do(page.fit_all)
    assert [row.E for row in page.rows] == approx([20e3, 20e3], rel=1e-3)
