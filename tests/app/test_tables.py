"""Files of the page as a spreadsheet and the project's own reader open them."""

import csv
from io import StringIO

import numpy as np
import pytest

import mdr_core as mdr
from app.explorer.extras import share
from app.explorer.state import preset_state
from app.measurement.analysis import Row
from app.measurement.export import table_of
from mdr_core.show.csv_text import csv_text

from .states import view_of

#: Names of files that put a formula into a cell, where cells are parted at commas or semicolons.
NAMES = (
    'a,=HYPERLINK("http://evil.example","x").csv', "=1+1.csv", "@SUM(A1).csv", "a;=1+1.csv", 'a","=1+1.csv',
    "+cmd|' /C calc'!A0", "-2+3,+cmd", "a,\t=1+1",
)  # fmt: skip


@pytest.mark.parametrize("delimiter", [",", ";"])
def test_no_cell_of_somebodys_text_is_a_formula(delimiter):
    for name in NAMES:
        rows = [Row("1", name, E=1e9, E_error=2e7), Row("2", name, reason=f"{name}: no contact")]
        file = StringIO()
        table_of(rows, {"file": name}, None).to_csv(file)
        text = file.getvalue()
        for row in csv.reader(text.splitlines(), delimiter=delimiter):
            for cell in row:
                assert not cell.startswith(("=", "+", "-", "@", "\t")), cell
    # A number stays one.
    assert csv_text([], [[-1.5, "-1.5"]]) == "-1.5,'-1.5\n"


def test_what_the_page_writes_is_read_back(tmp_path):
    """States of a scene, below a header with commas and quotation marks."""
    view = view_of(preset_state())
    path = tmp_path / "curves.csv"
    path.write_text(share.csv(view), encoding="utf-8")
    curve = mdr.read_curve(path)
    assert np.array_equal(curve.depth, view.course.states.depth)
    assert np.array_equal(curve.force, view.course.states.force)
    # With a name as that of a file in its header.
    for name in NAMES:
        header = [f"made of {name}", "d (m), F (N)"]
        rows = zip(curve.depth.tolist(), curve.force.tolist(), strict=True)
        path.write_text(csv_text(header, [["depth (m)", "force (N)"], *rows]), encoding="utf-8")
        assert np.array_equal(mdr.read_curve(path).force, curve.force)
