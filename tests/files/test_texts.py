"""Tables as text: numbers, headers of instruments, cantilevers, and several curves in one text."""

import numpy as np
import pytest

import mdr_core as mdr

#: A loading and an unloading: depth (m), force (N), time (s).
DEPTH = 1e-9 * np.append(np.linspace(-20, 200, 56), np.linspace(200, 120, 20)[1:])
FORCE = np.append(np.maximum(DEPTH[:56], 0) ** 1.5 * 1e8, np.maximum(DEPTH[56:] - 110e-9, 0) * 1e5)
TIME = 0.1 * np.arange(DEPTH.size)
#: Force on a cantilever of 0.05 N/m, and the position of the piezo.
STIFFNESS, SENSITIVITY = 0.05, 60e-9
SMALL = 1e-6 * FORCE
PIEZO = DEPTH + SMALL / STIFFNESS


def rows(*columns, between=","):
    return "\n".join(between.join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)) + "\n"


def assert_curve(curve, depth=DEPTH, force=FORCE, digits=1e-7):
    np.testing.assert_allclose(curve.depth, depth, rtol=0, atol=digits * np.ptp(depth))
    np.testing.assert_allclose(curve.force, force, rtol=0, atol=digits * np.ptp(force))


@pytest.mark.parametrize(
    ("head", "form"),
    [
        ("Depth (nm),Load (mN)", '"{0:,.2f}","{1:,.2f}"'),
        ("Depth (nm)\tLoad (mN)", "{0:,.2f}\t{1:,.2f}"),
        ("Tiefe (nm);Kraft (mN)", "{0:_.2f};{1:_.2f}"),
        ("Profondeur (nm);Force (mN)", "{0:|.2f};{1:|.2f}"),
        ("Tiefe (nm);Kraft (mN)", "{0:'.2f};{1:'.2f}"),
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


def test_a_column_of_a_rate_is_not_taken_for_the_quantity(write):
    """mN/s is no force: the one column in mN is."""
    heads = "Depth (nm),Load (mN/s),Channel 3 (mN)\n"
    assert_curve(mdr.read_curve(write(heads + rows(1e9 * DEPTH, 0 * DEPTH + 0.5, 1e3 * FORCE))))


def test_columns_are_named_without_the_units_of_their_line(write):
    """A name that two columns have is not taken."""
    columns = 1e9 * DEPTH, 0 * DEPTH, 1e3 * FORCE
    path = write("Depth,Load,Force\nnm,mN,mN\n" + rows(*columns))
    assert_curve(mdr.read_curve(path, columns={"depth": "Depth", "force": "Force"}))
    path = write("Depth,Force,Force\nnm,mN,mN\n" + rows(*columns))
    with pytest.raises(ValueError, match="'Force'"):
        mdr.read_curve(path, columns={"depth": "Depth", "force": "Force"})


def test_a_comma_that_may_be_either_is_refused(write):
    with pytest.raises(
        ValueError, match="the comma of '1,024' may be a decimal sign, or separate thousands"
    ):
        mdr.read_curve(write("Depth (nm)\tLoad (mN)\n0\t0\n512\t2\n1,024\t8\n2,048\t32\n"))
    with pytest.raises(ValueError, match=r"beside '0,5' .* '1.024' may be a thousand times larger"):
        mdr.read_curve(write("Tiefe (nm);Kraft (mN)\n0;0,5\n1.024;8,0\n2.048;32,0\n"))


def jpk(columns, names, units, values, *extra):
    """A text as JPK's program exports it, extend and retract with a header each."""
    blocks = []
    for number, (segment, part) in enumerate((("extend", slice(0, 56)), ("retract", slice(56, None)))):
        head = [
            f"segmentIndex: {number}", f"segment: {segment}", f"columns: {columns}", f"fancyNames: {names}",
            "sensitivity: 6.0E-8", *extra, "calibrationSlots: nominal force nominal elapsed",
            f"units: {units}", "",
        ]  # fmt: skip
        lines = "".join(f"# {line}\n" for line in head)
        blocks.append(lines + rows(*(column[part] for column in values), between=" "))
    return "# xPosition: 1.0E-6\n# date: Tue Mar 22 17:41:56\n#\n" + "\n".join(blocks)


NAMES = '"Height (measured)" "Vertical Deflection" "Height" "Segment Time"'
COLUMNS = "measuredHeight vDeflection height time"


@pytest.mark.parametrize(("unit", "size"), [("N", 1.0), ("m", STIFFNESS), ("V", STIFFNESS * SENSITIVITY)])
def test_text_of_jpk_has_its_own_stiffness(write, unit, size):
    """Names stand above other lines of as many words; extend and retract are one curve."""
    values = -PIEZO, SMALL / size, -PIEZO - 5e-9, TIME
    content = jpk(COLUMNS, NAMES, f"m {unit} m s", values, f"springConstant: {STIFFNESS}")
    curve = mdr.read_curve(write(content))
    assert_curve(curve, DEPTH, SMALL)
    assert curve.spring_constant == STIFFNESS
    assert curve.segment.tolist() == 56 * ["approach"] + 19 * ["retract"]
    assert curve.columns["depth"] == (0, "−m")
    assert "spring_constant = 0.05 N/m is taken from the file" in curve.remarks


def test_text_of_jpk_without_a_stiffness_has_a_remark(write):
    path = write(jpk(COLUMNS, NAMES, "m N m s", (-PIEZO, SMALL, -PIEZO, TIME)))
    curve = mdr.read_curve(path)
    assert_curve(curve, PIEZO, SMALL)
    assert any("includes the deflection" in remark for remark in curve.remarks)
    assert_curve(mdr.read_curve(path, spring_constant=STIFFNESS), DEPTH, SMALL)


def test_a_separation_comes_before_a_height(write):
    values = -PIEZO, SMALL, -DEPTH, TIME
    columns, names = (
        COLUMNS.replace("height", "tipSampleSeparation"),
        NAMES.replace('"Height"', '"Separation"'),
    )
    curve = mdr.read_curve(write(jpk(columns, names, "m N m s", values, f"springConstant: {STIFFNESS}")))
    assert curve.columns["depth"] == (2, "−m")
    assert_curve(curve, DEPTH, SMALL)


def test_a_line_of_numbers_is_no_header(write):
    head = "Hysitron\nTime (s)\tDisp (nm)\tForce (µN)\n0.5\t1.5\t2.5\neoh\n"
    curve = mdr.read_curve(write(head + rows(TIME, 1e9 * DEPTH, 1e6 * FORCE, between="\t")))
    assert_curve(curve)
    assert curve.remarks == ("left out line 3: a cell is missing or not a number",)


def test_settings_above_the_header_are_no_rows(write):
    head = "Depth limit (nm), 200\nLoad rate (mN/s), 5\nDepth (nm), Load (mN)\n"
    assert_curve(mdr.read_curve(write(head + rows(1e9 * DEPTH, 1e3 * FORCE))))


@pytest.mark.parametrize(
    "head",
    ["Z", "Ramp", "Extension", "Stage position", "Zpos", "Displacement", "Weg", "Hub", "Q", "Piezo", ""],
)
def test_a_stiffness_that_is_given_is_meant(write, head):
    """Also for a column that is given by its number; without a stiffness there is a remark."""
    name = f"{head} (nm),Force (nN)\n" if head else ""
    columns = {} if head else {"columns": {"depth": (0, "nm"), "force": (1, "nN")}}
    path = write(name + rows(1e9 * PIEZO, 1e9 * SMALL))
    curve = mdr.read_curve(path, spring_constant=STIFFNESS, **columns)
    assert_curve(curve, DEPTH, SMALL)
    assert any("is subtracted" in remark for remark in curve.remarks)
    without = mdr.read_curve(path, **columns)
    assert_curve(without, PIEZO, SMALL)
    assert any("give spring_constant= (N/m)" in remark for remark in without.remarks)


@pytest.mark.parametrize(
    "head", ["Depth", "Indentation", "Tip position", "Tip-sample separation", "Eindringtiefe", "h"]
)
def test_a_depth_stays_as_it_is(write, head):
    path = write(f"{head} (nm),Force (nN)\n" + rows(1e9 * DEPTH, 1e9 * SMALL))
    curve = mdr.read_curve(path, spring_constant=STIFFNESS)
    assert_curve(curve, DEPTH, SMALL)
    assert curve.remarks == (
        f"'{head} (nm)' is taken as the depth of the tip: no deflection is subtracted",
    )
    assert mdr.read_curve(path).remarks == ()


def test_forces_above_those_of_cantilevers_have_no_remark(write):
    """A displacement under 8 mN is that of a nanoindenter."""
    assert (
        mdr.read_curve(write("Displacement (nm),Load (mN)\n" + rows(1e9 * DEPTH, 1e3 * FORCE))).remarks
        == ()
    )


@pytest.mark.parametrize(
    ("unit", "size", "needed"),
    [
        ("pN", 1e-12, ""),
        ("nm", 1e-9 * STIFFNESS, "spring"),
        ("V", STIFFNESS * SENSITIVITY, "spring sensitivity"),
    ],
)
def test_text_of_nanoscope_has_approach_and_retract_side_by_side(write, unit, size, needed):
    """Here the retract is written from its end on; shorter columns end before the others."""
    back = slice(None, 55, -1)
    columns = PIEZO[:56] * 1e9, PIEZO[back] * 1e9, SMALL[:56] / size, SMALL[back] / size
    lines = [f"Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_{unit}_Ex\tDefl_{unit}_Rt"]
    for i in range(56):
        lines.append("\t".join(f"{column[i]:.9g}" if i < column.size else "" for column in columns))
    path = write("\n".join(lines))
    given = {"spring_constant": STIFFNESS} | ({"sensitivity": SENSITIVITY} if unit == "V" else {})
    curve = mdr.read_curve(path, **given)
    assert_curve(curve, DEPTH, SMALL)
    assert curve.segment.tolist() == 56 * ["approach"] + 19 * ["retract"]
    if needed:
        says = r"but a deflection in .*: give spring_constant= \(N/m\)"
        with pytest.raises(ValueError, match=says + r" and sensitivity= \(m/V\)" * (unit == "V")):
            mdr.read_curve(path)


def test_a_deflection_that_is_given_as_force(write):
    path = write(rows(1e6 * PIEZO, SMALL / STIFFNESS / SENSITIVITY))
    columns = {"depth": (0, "um"), "force": (1, "V")}
    constants = {"spring_constant": STIFFNESS, "sensitivity": SENSITIVITY}
    assert_curve(mdr.read_curve(path, columns=columns, **constants), DEPTH, SMALL)
    with pytest.raises(ValueError, match="give spring_constant="):
        mdr.read_curve(path, columns=columns)


@pytest.mark.parametrize(
    "line", ["# Spring constant (N/m): 0.05", "Federkonstante: 0,05 N/m", "Spring Constant;50 mN/m"]
)
def test_a_header_with_a_stiffness(write, line):
    content = f"{line}\nZ (nm);Kraft (nN)\n" + rows(1e9 * PIEZO, 1e9 * SMALL, between=";")
    curve = mdr.read_curve(write(content.replace(".", ",") if "," in line else content))
    assert_curve(curve, DEPTH, SMALL)


NM, UM = rows(1e9 * DEPTH, 1e3 * FORCE), rows(1e6 * DEPTH, 2 * FORCE)
TWO = np.tile(DEPTH, 2), np.append(FORCE, 2 * FORCE)


def labelled(head, labels):
    """Two curves below each other, with a column of labels in front."""
    cells = np.repeat(labels, DEPTH.size)
    lines = rows(1e9 * TWO[0], 1e3 * TWO[1]).splitlines()
    return head + "\n" + "\n".join(f"{cell},{line}" for cell, line in zip(cells, lines, strict=True))


@pytest.mark.parametrize(
    "content",
    [
        f"Depth (nm),Load (mN)\n{NM}\nDepth (µm),Load (N)\n{UM}",
        f"Test 1\nDepth,Load\nnm,mN\n{NM}Test 2\nDepth,Load\num,N\n{UM}",
        f"Tiefe (nm);Kraft (mN)\nMessung 1\n{NM.replace(',', ';')}# Messung Nr. 2\n"
        + rows(1e9 * DEPTH, 2e3 * FORCE, between=";"),
        "Depth (nm),Load (mN),Depth (nm),Load (mN)\n"
        + rows(1e9 * DEPTH, 1e3 * FORCE, 1e9 * DEPTH, 2e3 * FORCE),
        "h,P,h,P\nnm,mN,um,N\n" + rows(1e9 * DEPTH, 1e3 * FORCE, 1e6 * DEPTH, 2 * FORCE),
        labelled("Sample,Depth (nm),Load (mN)", ["glass", "steel"]),
        labelled("Material,Depth (nm),Load (mN)", ["glass", "steel"]),
        labelled("Versuch,Tiefe (nm),Kraft (mN)", [1, 2]),
        labelled("curve_id,Depth (nm),Load (mN)", [7, 9]),
    ],
)
def test_several_curves_in_one_text(write, content):
    first, second = mdr.read_curves(write(content))
    assert_curve(first)
    assert_curve(second, force=2 * FORCE)
    assert first.name != second.name


def test_columns_that_are_shorter_end_before_the_others(write):
    lines = rows(1e9 * DEPTH, 1e3 * FORCE, 1e9 * DEPTH, 2e3 * FORCE, between=";").splitlines()
    lines = [line if i < 30 else ";".join(line.split(";")[:2]) + ";;" for i, line in enumerate(lines)]
    head = "Depth 1 (nm);Load 1 (mN);Depth 2 (nm);Load 2 (mN)\n"
    first, second = mdr.read_curves(write(head + "\n".join(lines)))
    assert_curve(first)
    assert_curve(second, DEPTH[:30], 2 * FORCE[:30])
    assert first.remarks == second.remarks == ()


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (
            labelled("Q,Depth (nm),Load (mN)", [1, 2]),
            "start again where the column 'Q' changes, at line 77",
        ),
        (
            "t (s),Depth (nm),Load (mN)\n" + rows(np.tile(TIME, 2), 1e9 * TWO[0], 1e3 * TWO[1]),
            "time starts again",
        ),
        (
            "Depth (nm),Load (mN),Load (mN)\n" + rows(1e9 * DEPTH, FORCE, FORCE),
            "not as many of depth as of force",
        ),
    ],
)
def test_several_curves_that_the_text_does_not_tell_apart_are_refused(write, content, says):
    with pytest.raises(ValueError, match=says):
        mdr.read_curve(write(content))


def test_cycles_are_one_curve(write):
    assert len(mdr.read_curves(write(labelled("Cycle,Depth (nm),Load (mN)", [1, 2])))) == 1


def test_one_table_that_is_refused_does_not_stop_the_others(write):
    content = f"Depth (nm),Load (mN)\n{NM}\nDepth (nm),Load (kgf)\n{NM}\nDepth (µm),Load (N)\n{UM}"
    curves = mdr.read_curves(write(content))
    assert_curve(curves[2], force=2 * FORCE)
    with pytest.raises(ValueError, match="'kgf' is not a unit"):
        curves[1]


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


def test_segments_with_a_header_each_are_one_curve_and_the_next_loading_another(write):
    head = "Depth (nm),Load (mN)\n"
    one = "".join(
        f"# {name}\n{head}" + rows(1e9 * DEPTH[part], 1e3 * FORCE[part])
        for name, part in (("loading", slice(0, 56)), ("unloading", slice(56, None)))
    )
    (curve,) = mdr.read_curves(write(one))
    assert_curve(curve)
    assert curve.segment.tolist() == 56 * ["approach"] + 19 * ["retract"]
    assert [len(each) for each in mdr.read_curves(write(one + one))] == [75, 75]
