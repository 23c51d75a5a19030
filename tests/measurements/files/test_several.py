"""Several curves in one file: below each other, side by side, parts of one, and tables of a workbook."""

import numpy as np
import pytest

import mdr_core as mdr

from .curves import DEPTH, FORCE, TIME, assert_curve, rows

NM, MN = 1e9 * DEPTH, 1e3 * FORCE
COLUMNS = {"depth": (1, "nm"), "force": (2, "mN")}


def labelled(head, labels, *more):
    """Curves below each other, the k-th with k + 1 times the force, with columns of labels in front."""
    lines = [",".join([head, "Depth (nm)", "Load (mN)"])]
    for k, label in enumerate(labels):
        lines += [f"{label},{line}" for line in rows(NM, (k + 1) * MN).splitlines()]
    return "\n".join(lines)


def assert_curves(curves, count):
    assert len(curves) == count
    for k, curve in enumerate(curves):
        assert_curve(curve, force=(k + 1) * FORCE)


@pytest.mark.parametrize(
    ("head", "labels", "by"),
    [
        ("Test", [1, 2, 3], 0), ("Sample", ["glass", "steel"], 0), ("", [7, 9], 0), ("Q", [1, 2], 0),
        ("x (µm)", [0, 5, 10], 0), ("Cycle", [1, 2, 3], "whole"), ("Segment", ["a", "b"], "whole"),
    ],
)  # fmt: skip
def test_where_the_depth_starts_anew_is_asked_about(asked, write, head, labels, by):
    """A column that changes there tells the curves apart; cycles are suggested as one record."""
    text = labelled(head, labels)
    error = asked(text)
    assert "anew at line 77" in error.why
    assert error.suggestion == {"columns": COLUMNS, "by": by}
    curves = mdr.read_curves(write(text), **error.suggestion)
    if by == "whole":
        assert_curve(
            curves[0],
            np.tile(DEPTH, len(labels)),
            np.concatenate([k * FORCE for k in range(1, len(labels) + 1)]),
        )
    else:
        assert_curves(curves, len(labels))
        assert [curve.name for curve in curves] == [
            f"run.txt, {head or 'column 0'} {each}" for each in labels
        ]


def test_rows_of_a_map_are_told_by_two_columns(asked, write):
    """Neither x nor y alone has another value for each curve; the values stand in the order of the file."""
    text = labelled("x,y", ["0,0", "1,0", "0,1", "1,1"])
    error = asked(text)
    columns = {"depth": (2, "nm"), "force": (3, "mN")}
    assert error.suggestion == {"columns": columns, "by": [0, 1]}
    assert_curves(mdr.read_curves(write(text), **error.suggestion), 4)
    assert_curves(mdr.read_curves(write(text), columns=columns, by=["x", "y"]), 4)
    # What one of them leaves together starts anew.
    with pytest.raises(mdr.UnknownColumns, match="starts anew"):
        mdr.read_curves(write(text), columns=columns, by="x")


def test_rows_of_one_value_are_a_curve_wherever_they_stand(write):
    lines = [
        f"{1 + i % 2},{d:.9g},{(1 + i % 2) * f:.9g}"
        for i, (d, f) in enumerate(zip(np.repeat(NM, 2), np.repeat(MN, 2), strict=True))
    ]
    path = write("Test,Depth (nm),Load (mN)\n" + "\n".join(lines))
    assert_curves(mdr.read_curves(path, by="Test"), 2)


@pytest.mark.parametrize("between", ["\n", "\nSpot 2\n"])
def test_gaps_and_titles_part_curves(asked, write, between):
    text = "Depth (nm),Load (mN)\n" + rows(NM, MN) + between + rows(NM, 2 * MN)
    error = asked(text)
    assert error.suggestion["by"] == "gaps"
    assert_curves(mdr.read_curves(write(text), **error.suggestion), 2)


def test_without_a_mark_the_depth_alone_parts_curves(asked, write):
    text = "Depth (nm),Load (mN)\n" + rows(np.tile(NM, 3), np.concatenate([MN, 2 * MN, 3 * MN]))
    error = asked(text)
    assert "at line 77 and 1 times more" in error.why
    assert error.suggestion["by"] == "restart"
    assert_curves(mdr.read_curves(write(text), **error.suggestion), 3)


@pytest.mark.parametrize(("mark", "by"), [("label", 0), ("time", "restart"), ("gap", "gaps")])
def test_a_mark_where_the_depth_is_at_its_beginning_again_is_asked_about(asked, write, mark, by):
    """A full unloading does not jump back: without a mark two such curves are cycles of one."""
    depth, force = np.append(NM[:56], NM[:56][::-1]), np.append(MN[:56], MN[:56][::-1])
    columns = {"label": np.repeat([1, 2], 112), "time": np.tile(np.arange(112), 2), "gap": np.arange(224)}[
        mark
    ]
    both = rows(columns, np.tile(depth, 2), np.tile(force, 2)).splitlines()
    head = {"time": "Time (s)", "label": "Test", "gap": "n"}[mark]
    lines = [*both[:112], *[""] * (mark == "gap"), *both[112:]]
    text = f"{head},Depth (nm),Load (mN)\n" + "\n".join(lines)
    error = asked(text)
    assert "the depth is at its beginning again" in error.why
    assert error.suggestion["by"] == by
    first, second = mdr.read_curves(write(text), **error.suggestion)
    assert_curve(first, 1e-9 * depth, 1e-3 * force)
    assert_curve(second, 1e-9 * depth, 1e-3 * force)
    (whole,) = mdr.read_curves(write(text), by="whole")
    assert len(whole) == 224


@pytest.mark.parametrize(
    ("by", "says"),
    [
        (True, "must be the number or the name of one column"),
        ("no such", "must be the number or the name"),
        ("Load (mN)", "gives curves of fewer than 5 rows: 'Load \\(mN\\)' has"),
        (3, "'c' has one value in all rows.*by='whole'"),
        ("gaps", "no gaps"),
        ("segments", "parts of a curve"), ([], "must name columns"),
    ],
)  # fmt: skip
def test_what_parts_nothing_is_refused(write, by, says):
    path = write(
        "Test,Depth (nm),Load (mN),c\n"
        + rows(np.repeat([1, 2], 75), np.tile(NM, 2), np.tile(MN, 2), 0 * np.tile(NM, 2))
    )
    with pytest.raises(ValueError, match=says):
        mdr.read_curves(path, by=by)


def test_positions_with_noise_are_refused_with_their_number(write):
    x = np.repeat([0.0, 5.0], 75) + 1e-6 * np.arange(150)
    path = write(
        "x,Depth (nm),Load (mN)\n"
        + "\n".join(
            f"{a:.9f},{b:.9g},{c:.9g}" for a, b, c in zip(x, np.tile(NM, 2), np.tile(MN, 2), strict=True)
        )
    )
    with pytest.raises(ValueError, match=r"'x' has 150 values in 150 rows.* by='restart'"):
        mdr.read_curves(path, by="x")


def test_a_column_called_as_one_of_the_words_is_told_by_its_number(write):
    text = labelled("gaps", [1, 2])
    assert_curves(mdr.read_curves(write(text), by=0), 2)
    with pytest.raises(ValueError, match="there are no gaps"):
        mdr.read_curves(write(text), by="gaps")


def test_pairs_of_columns_are_a_curve_each(asked, write):
    """Shorter ones end before the others."""
    lines = rows(NM, MN, NM, 2 * MN, between=";").splitlines()
    lines = [line if i < 30 else ";".join(line.split(";")[:2]) + ";;" for i, line in enumerate(lines)]
    text = "Depth 1 (nm);Load 1 (mN);Depth 2 (nm);Load 2 (mN)\n" + "\n".join(lines)
    error = asked(text)
    assert error.suggestion.keys() == {"columns"}
    first, second = mdr.read_curves(write(text), **error.suggestion)
    assert_curve(first)
    assert_curve(second, DEPTH[:30], 2 * FORCE[:30])
    assert first.remarks == second.remarks == ()
    with pytest.raises(ValueError, match="list of columns is a curve"):
        mdr.read_curves(write(text), **error.suggestion, by="restart")


BACK = slice(None, 55, -1)


@pytest.mark.parametrize("names", [("Approach", "Retract"), ("Belastung", "Entlastung"), ("A", "B")])
@pytest.mark.parametrize("turned", [False, True])
def test_loading_beside_unloading_is_one_curve(asked, write, names, turned):
    """Also where the unloading is written from its end on: it begins where the loading ends."""
    down = [each[55:] for each in (NM, MN)]
    down = [each[::-1] for each in down] if turned else down
    lines = []
    for i in range(56):
        cells = [NM[i], MN[i], *(each[i] for each in down if i < each.size)]
        lines.append(";".join(f"{x:.9g}" for x in cells).ljust(1) + ";" * (4 - len(cells)))
    a, b = names
    text = f"{a} depth (nm);{a} load (mN);{b} depth (nm);{b} load (mN)\n" + "\n".join(lines)
    error = asked(text)
    assert error.suggestion["by"] == "segments"
    (curve,) = mdr.read_curves(write(text), **error.suggestion)
    assert_curve(curve, np.insert(DEPTH, 56, DEPTH[55]), np.insert(FORCE, 56, FORCE[55]))
    assert curve.segment.tolist() == 56 * ["approach"] + 20 * ["retract"]


def test_parts_that_do_not_meet_are_asked_about(write):
    """As of two ramps that run against each other: joined they would be nonsense."""
    text = "a;b;c;d\n" + rows(NM[:56], MN[:56], NM[:56], MN[:56][::-1], between=";")
    columns = [{"depth": (0, "nm"), "force": (1, "mN")}, {"depth": (2, "nm"), "force": (3, "mN")}]
    with pytest.raises(
        mdr.UnknownColumns,
        match=r"do not meet: .* 8\.944 .* 'a', and 0 .* 'c'",
    ):
        mdr.read_curves(write(text), columns=columns, by="segments")


HEAD = "Depth (nm),Load (mN)\n"


def test_tables_below_each_other_are_curves(write):
    """Each with its own units and order of columns; titles above headers are no rows."""
    one = HEAD + rows(NM, MN)
    two = "Test 2\nLoad,Depth\nN,um\n" + rows(2 * FORCE, 1e6 * DEPTH)
    three = "Time (s),Depth (nm),Load (mN)\n" + rows(TIME, NM, 3 * MN)
    curves = mdr.read_curves(write(f"Test 1\n{one}\n{two}\n{three}"))
    assert_curves(curves, 3)
    assert curves[1].remarks == ()
    assert [curve.name for curve in curves] == [f"run.txt, table {k}" for k in (1, 2, 3)]


def test_one_table_that_is_asked_about_does_not_stop_the_others(write):
    """What is told holds for the tables with its heads alone: here not for the first and the last."""
    tables = [HEAD, "Depth (nm),Load (ozf)\n", "Load (mN),Depth (nm)\n", "Depth (nm),Load (ozf)\n"]
    columns = [(NM, MN), (NM, 2 * MN), (3 * MN, NM), (NM, 4 * MN)]
    path = write("\n".join(head + rows(*each) for head, each in zip(tables, columns, strict=True)))
    curves = mdr.read_curves(path)
    assert len(curves) == 4
    assert_curve(curves[1], force=3 * FORCE)
    with pytest.raises(mdr.UnknownColumns, match="table 2: which column is the force") as error:
        curves[2]
    assert error.value.table.name == "table 2"
    told = mdr.read_curves(path, columns={"depth": (0, "nm"), "force": (1, "mN")})
    for curve, times in zip(told, (1, 3, 2, 4), strict=True):
        assert_curve(curve, force=times * FORCE)


def test_segments_with_a_header_each_are_parts_of_one_curve(asked, write):
    one = "".join(
        f"# {name}\n{HEAD}" + rows(NM[part], MN[part])
        for name, part in (("loading", slice(0, 56)), ("unloading", slice(56, None)))
    )
    error = asked(one)
    assert error.suggestion["by"] == "segments"
    (curve,) = mdr.read_curves(write(one), **error.suggestion)
    assert_curve(curve)
    assert [len(each) for each in mdr.read_curves(write(one + one), **error.suggestion)] == [75, 75]
    assert len(mdr.read_curves(write(one), by="whole")) == 2


def test_a_hold_is_a_segment_of_its_curve(asked, write):
    """Before the loading, at the largest depth and after the unloading; its own range is noise."""
    noise = 0.1 * np.sin(np.arange(9.0))
    depths = NM[0] + noise, NM[:56], NM[55] + noise, NM[56:], NM[-1] + noise
    forces = 0 * noise, MN[:56], 0 * noise + MN[55], MN[56:], 0 * noise + MN[-1]
    text = "".join(f"# part\n{HEAD}" + rows(*each) for each in zip(depths, forces, strict=True))
    error = asked(text + text)
    assert error.suggestion["by"] == "segments"
    for curve in mdr.read_curves(write(text + text), **error.suggestion):
        assert_curve(curve, 1e-9 * np.concatenate(depths), 1e-3 * np.concatenate(forces))


def workbook(folder, sheets):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    with pandas.ExcelWriter(folder / "tests.xlsx") as file:
        for name, cells in sheets.items():
            pandas.DataFrame(cells).to_excel(file, sheet_name=name, header=False, index=False)
    return folder / "tests.xlsx"


def sheet(heads, *columns):
    return [heads, *map(list, zip(*columns, strict=True))]


TEST = [
    ["Segment", "Displacement Into Surface", "Load On Sample", "Time On Sample",
     "Harmonic Contact Stiffness", "Hardness", "Modulus"],
    [None, "nm", "mN", "s", "N/m", "GPa", "GPa"],
    *[[None, 1e9 * d, 1e3 * F, t, 2e4, 9.5, 70.0] for d, F, t in zip(DEPTH, FORCE, TIME, strict=True)],
]  # fmt: skip
RESULTS = [
    ["Test", "E Average Over Defined Range", "H", "Drift"], [None, "GPa", "GPa", "nm/s"],
    *[[k + 1, 72.0 + k, 9.5, 0.02] for k in range(16)],
]  # fmt: skip
INPUTS = [
    ["Test", "Depth Limit", "X Position"],
    [None, "nm", "um"],
    *[[k + 1, 2000, 50.0 * k] for k in range(16)],
]


def test_sheets_of_results_and_settings_are_left_out_and_named(tmp_path):
    """As KLA's workbooks have them, between those of the tests."""
    path = workbook(tmp_path, {"Results": RESULTS, "Required Inputs": INPUTS, "Test 001": TEST})
    (curve,) = mdr.read_curves(path)
    assert_curve(curve)
    assert curve.stiffness.tolist() == [2e4] * DEPTH.size
    assert [remark.kind for remark in curve.remarks if "'Results'" in remark] == ["left out"]
    assert curve.name == "tests.xlsx, Test 001"


def test_a_sheet_that_is_asked_about_is_not_left_out(tmp_path):
    """It is asked about when it is taken, with its name; what is told of one holds for its heads alone."""
    sheets = {
        "Test 1": TEST,
        "Test 2": sheet(["Depth (nm)", "Load (ozf)"], NM, 2 * MN),
        "Test 3": sheet(["Zeit (s)", "Tiefe (nm)", "Kraft (mN)"], TIME, NM, 3 * MN),
        "Test 4": sheet(["Depth (nm)", "Load (ozf)"], NM, 4 * MN),
    }
    path = workbook(tmp_path, sheets)
    curves = mdr.read_curves(path)
    assert len(curves) == 4
    assert_curve(curves[0])
    with pytest.raises(
        mdr.UnknownColumns, match=r"tests\.xlsx, Test 2: which column is the force"
    ) as error:
        curves[1]
    assert error.value.table.name == "Test 2"
    told = mdr.read_curves(path, columns={"depth": (0, "nm"), "force": (1, "mN")})
    for k in (0, 1, 3):
        assert_curve(told[k], force=(k + 1) * FORCE)
    with pytest.raises(mdr.UnknownColumns, match="Test 3: which column is the depth") as error:
        told[2]
    # Numbers would be those of the second sheet: names are those of the third.
    assert error.value.suggestion["columns"]["depth"] == ("Tiefe (nm)", "nm")
    assert_curve(mdr.read_curves(path, **error.value.suggestion)[2], force=3 * FORCE)


def test_a_plain_sheet_is_taken_before_one_in_doubt(tmp_path):
    """Results and means of tests come first in the file; both functions take the first test."""
    means = [*sheet(["Depth Mean", "Depth StdDev", "Load Mean", "Load StdDev"], NM, NM / 99, MN, MN / 99)]
    test = [*sheet(["Markers", "Time", "Load", "Depth"], NM, TIME, MN, NM)]
    test = [test[0], ["", "s", "mN", "nm"], *(["", *row[1:]] for row in test[1:])]
    sheets = {
        "Results": [["Test", "Pmax", "Maximum Displacement", "E", "H"], ["", "mN", "nm", "GPa", "GPa"]]
        + [[i, 4 + i / 10, 70 + i, 70 + i, 9] for i in range(1, 6)],
        "Means": [means[0], ["nm", "nm", "mN", "mN"], *means[1:]],
        "Test 1": test,
        "Test 2": test,
    }
    path = workbook(tmp_path, sheets)
    curves = mdr.read_curves(path)
    assert [curve.name for curve in curves[:2]] == [f"{path.name}, Test {i}" for i in (1, 2)]
    assert_curve(curves[0])
    assert_curve(mdr.read_curve(path))
    with pytest.raises(mdr.UnknownColumns, match="Means") as error:
        curves[2]
    columns = error.value.suggestion["columns"][0]
    # The columns that are given are those of one sheet, which is meant.
    for index in (None, 2):
        assert mdr.read_curve(path, index, columns=columns).name == f"{path.name}, Means"


def test_where_no_sheet_is_plain_the_question_is_raised_at_once(tmp_path):
    path = workbook(tmp_path, {"Notes": [["a", "b"]], "Tests": sheet(["Tiefe (nm)", "Kraft (mN)"], NM, MN)})
    with pytest.raises(mdr.UnknownColumns, match="Tests: which column") as error:
        mdr.read_curves(path)
    assert_curve(mdr.read_curves(path, **error.value.suggestion)[0])


def test_the_table_with_a_length_a_force_and_the_most_rows_is_asked_about(write):
    """Not that of a motor's approach, nor that of a drift, which come first in the file."""
    motor = "Piezo (V),Path (µm)\n" + "".join(f"{k},{2 * k}\n" for k in range(40))
    drift = "Tiefe (nm),Last (mN)\n" + "".join(f"{0.1 * k},0.01\n" for k in range(12))
    test = "Tiefe (nm),Last (mN),Zeit (s)\n" + rows(NM, MN, np.arange(NM.size))
    path = write("\n".join((motor, drift, test)))
    with pytest.raises(mdr.UnknownColumns) as error:
        mdr.read_curve(path)
    assert "Zeit" in str(error.value.table.heads)
    assert error.value.table.name in str(error.value)
    curve = mdr.read_curve(path, **error.value.suggestion)
    assert_curve(curve)
