"""Layouts of instruments and of this package, each from a sample in the form of a public file."""

import numpy as np
import pytest

import mdr_core as mdr

from .curves import DEPTH, FORCE, PIEZO, SENSITIVITY, SMALL, STIFFNESS, TIME, assert_curve, rows

UP, DOWN = slice(0, 56), slice(56, None)


def jpk(columns, units, values, *extra, first=0):
    """A text as JPK's program exports it, extend and retract with a header each.

    In the form of the public export force-save-2011.03.22-18.41.44.txt of a CellHesion 200.
    """
    blocks = []
    for number, (segment, part) in enumerate((("extend", UP), ("retract", DOWN)), first):
        head = [
            f"segmentIndex: {number}", "recorded-num-points: 56", f"segment: {segment}",
            f"columns: {columns}",
            'fancyNames: "Height (measured)" "Vertical Deflection" "Height" "Segment Time"',
            "heightMultiplier: 0.6", "sensitivity: 6.0E-8", *extra,
            "calibrationSlots: nominal force nominal elapsed", f"units: {units}", "",
        ]  # fmt: skip
        lines = "".join(f"# {line}\n" for line in head)
        blocks.append(lines + rows(*(column[part] for column in values), between=" "))
    return "# TEXT EXPORT\n# xPosition: 1.0E-6\n# date: Tue Mar 22 17:41:56\n#\n" + "\n".join(blocks)


COLUMNS = "measuredHeight vDeflection height time"


@pytest.mark.parametrize(("unit", "size"), [("N", 1.0), ("m", STIFFNESS), ("V", STIFFNESS * SENSITIVITY)])
def test_text_of_jpk_has_its_own_constants(write, unit, size):
    """Extend and retract are one curve; the height is that of the piezo."""
    values = -PIEZO, SMALL / size, -PIEZO - 5e-9, TIME
    path = write(jpk(COLUMNS, f"m {unit} m s", values, f"springConstant: {STIFFNESS}"))
    curve = mdr.read_curve(path)
    assert_curve(curve, DEPTH, SMALL)
    assert curve.spring_constant == STIFFNESS
    assert curve.segment.tolist() == 56 * ["approach"] + 19 * ["retract"]
    assert curve.columns["piezo"] == (0, "−m")
    assert curve.source == "as JPK's text has them"
    assert "0.05 N/m" in " ".join(curve.remarks)
    np.testing.assert_allclose(curve.time, TIME)


def test_a_separation_of_jpk_is_the_depth(write):
    """It comes before a height, and nothing is subtracted from it."""
    text = jpk(
        "measuredHeight vDeflection tipSampleSeparation time", "m N m s", (-PIEZO, SMALL, -DEPTH, TIME)
    )
    curve = mdr.read_curve(write(text))
    assert curve.columns["depth"] == (2, "−m")
    assert_curve(curve, DEPTH, SMALL)


def test_text_of_jpk_without_a_stiffness_is_asked_about(write):
    path = write(jpk(COLUMNS, "m N m s", (-PIEZO, SMALL, -PIEZO, TIME)))
    with pytest.raises(mdr.UnknownColumns, match=r"'measuredHeight' .* give spring_cons") as error:
        mdr.read_curves(path)
    # Of a table the segments would be curves.
    assert error.value.suggestion == {}
    assert "Give the columns" not in str(error.value)
    assert_curve(mdr.read_curve(path, spring_constant=STIFFNESS), DEPTH, SMALL)


def test_a_map_of_jpk_begins_a_curve_with_each_first_segment(write):
    one = jpk(COLUMNS, "m N m s", (-PIEZO, SMALL, -PIEZO, TIME), f"springConstant: {STIFFNESS}")
    two = jpk(COLUMNS, "m N m s", (-PIEZO, SMALL, -PIEZO, TIME), f"springConstant: {2 * STIFFNESS}")
    first, second = mdr.read_curves(write(one + two))
    assert_curve(first, DEPTH, SMALL)
    assert second.spring_constant == 2 * STIFFNESS


def nanoscope(unit, size, sep=False, back=slice(None, 55, -1)):
    """A text as NanoScope Analysis exports it: the form that the public R package of fdafm reads.

    The retract is written from its end on; shorter columns end before the others.
    """
    place = DEPTH if sep else PIEZO
    columns = place[UP] * 1e9, place[back] * 1e9, SMALL[UP] / size, SMALL[back] / size
    names = ("Sep_nm_Ex", "Sep_nm_Rt") if sep else ("Calc_Ramp_Ex_nm", "Calc_Ramp_Rt_nm")
    lines = ["\t".join([*names, f"Defl_{unit}_Ex", f"Defl_{unit}_Rt"])]
    for i in range(56):
        lines.append("\t".join(f"{column[i]:.9g}" if i < column.size else "" for column in columns))
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("unit", "size"),
    [("pN", 1e-12), ("nN", 1e-9), ("nm", 1e-9 * STIFFNESS), ("V", STIFFNESS * SENSITIVITY)],
)
def test_text_of_nanoscope_has_approach_and_retract_side_by_side(write, unit, size):
    path = write(nanoscope(unit, size))
    given = {"spring_constant": STIFFNESS} | ({"sensitivity": SENSITIVITY} if unit == "V" else {})
    curve = mdr.read_curve(path, **given)
    assert_curve(curve, DEPTH, SMALL)
    assert curve.segment.tolist() == 56 * ["approach"] + 19 * ["retract"]
    with pytest.raises(mdr.UnknownColumns, match=r"give spring_constant= \(N/m\)"):
        mdr.read_curves(path)


def test_a_separation_of_nanoscope_is_the_depth(write):
    assert_curve(mdr.read_curve(write(nanoscope("pN", 1e-12, sep=True))), DEPTH, SMALL)


def test_ramps_of_nanoscope_that_run_against_each_other_do_not_meet(write):
    """The retract in the order of the approach,
    with the ramp of the approach: joined it would be nonsense."""
    lines = ["Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_pN_Ex\tDefl_pN_Rt"]
    z, f = 1e9 * PIEZO[UP], 1e12 * SMALL[UP]
    lines += ["\t".join(f"{x:.9g}" for x in row) for row in zip(z, z, f, f[::-1], strict=True)]
    with pytest.raises(mdr.UnknownColumns, match="approach and retract do not meet"):
        mdr.read_curves(write("\n".join(lines)), spring_constant=STIFFNESS)


@pytest.mark.parametrize("encoding", ["utf-8", "gbk"])
def test_an_export_of_anton_paar_has_several_tests(write, encoding):
    """In the form that public scripts read, X_name_Time_[s], Y_name_Fn_[mN],
    Y_name_Pd_[nm]; µ in GBK, too."""
    heads = []
    for name in ("A 1_1", "A 1_2"):
        heads += [f"X_{name}_Time_[s]", f"Y_{name}_Fn_[\u03bcN]", f"Y_{name}_Pd_[nm]"]
    columns = [TIME, 1e6 * FORCE, 1e9 * DEPTH]
    short = [np.append(each[:30], np.full(45, np.nan)) for each in (TIME, 2e6 * FORCE, 1e9 * DEPTH)]
    text = "\t".join(heads) + "\n" + rows(*columns, *short, between="\t").replace("nan", "")
    first, second = mdr.read_curves(write(text, encoding=encoding))
    assert_curve(first)
    assert_curve(second, DEPTH[:30], 2 * FORCE[:30])
    assert (first.name, second.name) == ("run.txt, A 1_1", "run.txt, A 1_2")
    np.testing.assert_allclose(second.time, TIME[:30])


PIUMA = """Date\t27/02/2020\tTime\t10:32\tStatus\tOK
Scan (#)\t1\tX (#)\t1\tY (#)\t2\tIndentation (#)\t1
X-position (um)\t3.988
Piezo position (nm) (Measured)\t0.3

k (N/m)\t0.510

Tip radius (um)\t10.000
Piezo Indentation Sweep Settings (Relative to piezo position setpoint at start):
D[Z1] (nm)\t0.000\tt[1] (s)\t0.500
P[max] (uN)\t0.766
E[eff] (Pa)\t43485.029

Time (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary
"""


def test_text_of_piuma_has_settings_above_its_table(write):
    """As the public 2NapFF files of the web-based dashboard for nanoindentation have them."""
    bent = 1e9 * SMALL / 0.51
    path = write(
        PIUMA + rows(TIME, 1e6 * SMALL, 1e9 * DEPTH, bent, 1e9 * DEPTH + bent, 0 * TIME, between="\t")
    )
    curve = mdr.read_curve(path)
    assert_curve(curve, DEPTH, SMALL)
    assert (curve.spring_constant, curve.remarks) == (0.51, ())
    np.testing.assert_allclose(curve.time, TIME)
    # `columns` tells of the table below the settings.
    told = mdr.read_curve(path, columns={"piezo": (4, "nm"), "force": (1, "uN")}, spring_constant=0.51)
    assert_curve(told, DEPTH, SMALL)


def test_what_is_not_as_a_format_has_it_is_read_as_a_table(write):
    text = "X_A_Pd_[V]\tDepth (nm)\tLoad (mN)\n" + rows(TIME, 1e9 * DEPTH, 1e3 * FORCE, between="\t")
    assert_curve(mdr.read_curve(write(text)))


# What this package writes.

INDENTED = mdr.indent(mdr.Cone(1.0), mdr.Medium(E_star=1e9, hardness=1e8), np.append(DEPTH[5:], 0.0))


def test_tables_of_results_are_read_in_si(tmp_path):
    """An indentation, the motion of an impact and a measured curve,
    as `to_pandas().to_csv()` writes them."""
    pytest.importorskip("pandas")
    path = tmp_path / "run.csv"
    INDENTED.to_pandas().to_csv(path)
    curve = mdr.read_curve(path)
    np.testing.assert_array_equal(curve.depth, INDENTED.depth)
    np.testing.assert_array_equal(curve.force, INDENTED.force)
    np.testing.assert_array_equal(curve.stiffness, INDENTED.stiffness)
    motion = mdr.impact(mdr.Cone(1.0), mdr.Medium(E_star=1e9, hardness=1e8), 1e-9, 1.0).motion()
    motion.to_pandas().to_csv(path)
    again = mdr.read_curve(path)
    np.testing.assert_array_equal(again.depth, motion.depth)
    np.testing.assert_array_equal(again.time, motion.time)
    curve.to_pandas().to_csv(path)
    np.testing.assert_array_equal(mdr.read_curve(path).force, INDENTED.force)


def test_paths_of_one_result_are_curves_each(tmp_path):
    pytest.importorskip("pandas")
    medium = mdr.Medium(E_star=np.array([[1e9], [2e9]]))
    paths = mdr.indent(mdr.Cone(1.0), medium, np.stack([DEPTH[5:], DEPTH[5:]]))
    paths.to_pandas().to_csv(tmp_path / "run.csv")
    first, second = mdr.read_curves(tmp_path / "run.csv")
    np.testing.assert_array_equal(second.force, paths.force[1])
    np.testing.assert_array_equal(first.depth, paths.depth[0])


def test_a_table_of_others_with_these_names_is_asked_about(asked):
    """Numbers in nm are no depths in m."""
    error = asked("sample,depth,force\n" + rows(np.arange(75), 1e9 * DEPTH, 1e3 * FORCE))
    assert error.suggestion["columns"] == {"depth": (1, "?"), "force": (2, "?")}


@pytest.mark.parametrize(
    ("title", "what"),
    [
        ("state at depth d = 1e-07 m, force F = 0.1 N", "the pressure of one state"),
        ("fit to run.csv, samples 1 to 9 of 9, 9 fitted", "the numbers of a fit"),
        ("curves of map.csv", "the moduli of a map"),
    ],
)
def test_files_of_the_pages_that_are_no_curves_are_refused_as_what_they_are(write, title, what):
    text = f"# mdr_core {mdr.__version__}: {title}\nradius r (m),line load q (N/m)\n" + rows(DEPTH, FORCE)
    with pytest.raises(ValueError, match=f"run.txt has {what}"):
        mdr.read_curves(write(text))
