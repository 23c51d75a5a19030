"""Which tables are plain, and what is asked about the others."""

import ast
import copy
import pickle

import numpy as np
import pytest

import mdr_core as mdr

from .curves import DEPTH, FORCE, PIEZO, SENSITIVITY, SMALL, STIFFNESS, TIME, assert_curve, rows

NM, MN = 1e9 * DEPTH, 1e3 * FORCE


def table(*heads, columns=(NM, MN), between=";"):
    return between.join(heads) + "\n" + rows(*columns, between=between)


@pytest.mark.parametrize(
    "heads",
    [
        ("Depth (nm)", "Load (mN)"), ("depth_nm", "force_mN"), ("h [nm]", "P [mN]"), ("h / nm", "F / mN"),
        ("Depth, nm", "Load, mN"), ("Depth in nm", "Load in mN"),
        ("Displacement Into Surface nm", "Load mN"),
        ("Indentation depth (nanometers)", "Normal force (millinewton)"), ("Penetration {nm}", "Fn <mN>"),
        ("PD(nm)", "Applied Load(mN)"), ("h_nm", "P_mN"), ("h/nm", "F/mN"),
    ],
)  # fmt: skip
def test_exact_names_with_a_plain_unit_are_taken(write, heads):
    curve = mdr.read_curve(write(table(*heads)))
    assert_curve(curve)
    assert (curve.remarks, curve.source) == ((), "by its header")


@pytest.mark.parametrize(
    ("unit", "size"),
    [("µN", 1e-6), ("uN", 1e-6), ("\u03bcN", 1e-6), ("ÂµN", 1e-6),
     ("micro newtons", 1e-6), ("N", 1), ("kN", 1e3)],
)  # fmt: skip
def test_units_are_symbols_and_english_words(write, unit, size):
    curve = mdr.read_curve(write(table("Depth (nm)", f"Load ({unit})", columns=(NM, FORCE / size))))
    assert_curve(curve)


@pytest.mark.parametrize("encoding", ["gbk", "shift_jis", "euc_kr"])
def test_mu_is_known_as_other_encodings_leave_it(write, encoding):
    """As Anton Paar's and Shimadzu's programs write on Chinese, Japanese and Korean computers."""
    text = table("Depth (\u03bcm)", "Load (\u03bcN)", columns=(1e6 * DEPTH, 1e6 * FORCE))
    assert_curve(mdr.read_curve(write(text, encoding=encoding)))


@pytest.mark.parametrize(
    "head",
    [
        "Load*10 (mN)", "Load (mN) [x0.1]", "Load (mN)*1e3", "1000*Load (mN)", "Load (mN/10)",
        "Load x10 (mN)",
        "Load (0.1 mN)", "Load 100 mN", "Load (10^-3 N)", "Load (tenths of mN)", "log Load (mN)",
        "Load (mN)^2",
        "kForce (mN)", "Force m(N)", "Force (m N)", "Load (% of 10 mN)",
        "Load (ozf)", "Load (?N)",
        "Load (\ufffdN)", "LOAD (MN)", "F_N", "Load", "Load (mN/s)", "half Load (mN)",
    ],
)  # fmt: skip
def test_a_unit_with_a_number_or_a_prefix_beside_it_is_left_open(asked, write, head):
    """It is never invented: the suggestion has the columns, and "?" for the unit."""
    error = asked(table("Depth (nm)", head))
    assert error.suggestion == {"columns": {"depth": (0, "nm"), "force": (1, "?")}}
    assert not error.complete
    assert 'columns={"depth": (0, "nm"), "force": (1, "?")}' in str(error).splitlines()[-1]
    with pytest.raises(ValueError, match="its unit, as in"):
        mdr.read_curves(write(table("Depth (nm)", head)), **error.suggestion)
    told = {"depth": (0, "nm"), "force": (1, "mN")}
    assert_curve(mdr.read_curve(write(table("Depth (nm)", head)), columns=told))


@pytest.mark.parametrize(
    ("depth", "force"),
    [
        ("Tiefe", "Kraft"), ("Eindringtiefe h", "Prüfkraft F"), ("Profondeur", "Force"),
        ("Enfoncement", "Charge"), ("Profundidad", "Fuerza"), ("Spostamento", "Carico"),
        ("压入深度", "载荷"),
        ("変位", "荷重"), ("Глубина", "Нагрузка"), ("Depth measured", "Load cell"),
    ],
)  # fmt: skip
def test_other_names_are_asked_about_with_the_right_suggestion(asked, write, depth, force):
    text = table(f"{depth} (nm)", f"{force} (mN)")
    error = asked(text)
    assert error.complete
    assert error.why.startswith("which column is the depth")
    assert_curve(mdr.read_curve(write(text), **error.suggestion))


@pytest.mark.parametrize(
    ("heads", "columns", "given"),
    [
        (("Piezo (nm)", "Force (nN)"), (1e9 * PIEZO, 1e9 * SMALL), {"spring_constant": STIFFNESS}),
        (
            ("Z (nm)", "Deflection (V)"),
            (1e9 * PIEZO, SMALL / STIFFNESS / SENSITIVITY),
            {"spring_constant": STIFFNESS, "sensitivity": SENSITIVITY},
        ),
    ],
)
def test_a_line_to_paste_has_the_constants_that_its_columns_need(asked, write, heads, columns, given):
    """With them, and not without, the suggestion reads the file."""
    text = table(*heads, columns=columns)
    error = asked(text)
    *_, last = str(error).splitlines()
    assert [name in last for name in ("spring_constant=…", "sensitivity=…")] == [
        name in given for name in ("spring_constant", "sensitivity")
    ]
    again = asked(text, **error.suggestion)
    assert again.remedy == tuple(mdr.Remedy("give", name) for name in given)
    curve = mdr.read_curve(write(text), **error.suggestion, **given)
    # Six digits in the file, of a piezo that goes fifty times as far as the depth.
    np.testing.assert_allclose(curve.force, SMALL, rtol=1e-4, atol=1e-5 * SMALL.max())


@pytest.mark.parametrize(
    "other",
    ["Depth corrected (nm)", "DepthRaw (nm)", "Contact depth (nm)", "h corrected (nm)", "Target Load (mN)",
     "Max Load (mN)", "load_set_mN"],
)  # fmt: skip
@pytest.mark.parametrize("place", [0, 2])
def test_a_variant_of_a_name_beside_it_is_asked_about(asked, write, other, place):
    """Which of both is the curve's cannot be known; the exact name is suggested."""
    heads = ["h (nm)" if other.startswith("h ") else "Depth (nm)", "Load (mN)"]
    columns = [NM, MN]
    heads.insert(place, other)
    columns.insert(place, 2 * (NM if "nm" in other else MN))
    text = table(*heads, columns=columns)
    error = asked(text)
    assert repr(other) in error.why
    assert_curve(mdr.read_curve(write(text), **error.suggestion))


def test_a_second_set_of_columns_is_asked_about(asked, write):
    text = table("Depth (nm)", "Load (mN)", "Depth0 (nm)", "Load0 (mN)", columns=(NM, MN, NM, 2 * MN))
    error = asked(text)
    assert "'Depth0 (nm)' and 'Load0 (mN)'" in error.why
    first, second = mdr.read_curves(write(text), **error.suggestion)
    assert_curve(first)
    assert_curve(second, force=2 * FORCE)


def test_a_rate_and_a_voltage_are_of_other_kinds(write):
    """mN/s is no force, and V no depth (Hysitron writes both)."""
    heads = "Depth (nm)", "Load (mN)", "Loading rate (mN/s)", "Depth (V)", "Load (V)"
    assert_curve(mdr.read_curve(write(table(*heads, columns=(NM, MN, 0 * NM + 1, NM, MN)))))


@pytest.mark.parametrize(
    ("head", "suggested"),
    [
        ("Z", "piezo"),
        ("Piezo Z", "piezo"),
        ("Height", "piezo"),
        ("MeasuredHeight", "piezo"),
        ("Zero", "depth"),
    ],
)
def test_a_position_under_a_small_force_is_suggested_as_a_piezos(asked, head, suggested):
    """A short name counts as a whole word alone."""
    error = asked(table(f"{head} (nm)", "Force (nN)", columns=(1e9 * PIEZO, 1e9 * SMALL)))
    assert error.suggestion["columns"] == {suggested: (0, "nm"), "force": (1, "nN")}


@pytest.mark.parametrize(("head", "suggested"), [("Displacement", "piezo"), ("h", "depth")])
def test_a_displacement_of_a_small_force_may_be_a_piezos(asked, write, head, suggested):
    """Below 10 µN; a nanoindenter's displacement under 8 mN is a depth."""
    text = table(f"{head} (nm)", "Force (nN)", columns=(1e9 * PIEZO, 1e9 * SMALL))
    error = asked(text)
    assert "or the position of a piezo" in error.why
    assert error.suggestion["columns"] == {suggested: (0, "nm"), "force": (1, "nN")}
    assert_curve(mdr.read_curve(write(table(f"{head} (nm)", "Force (mN)"))))
    # A stiffness that is given is meant.
    with_k = asked(text, spring_constant=STIFFNESS)
    assert "piezo" in with_k.suggestion["columns"]
    assert_curve(mdr.read_curve(write(text), spring_constant=STIFFNESS, **with_k.suggestion), DEPTH, SMALL)


@pytest.mark.parametrize("head", ["Z", "Ramp", "Stage position", "Piezo", "Weg", ""])
def test_of_a_piezo_the_deflection_is_subtracted_once(write, head):
    text = (f"{head} (nm);Force (nN)\n" if head else "") + rows(1e9 * PIEZO, 1e9 * SMALL, between=";")
    columns, path = {"piezo": (0, "nm"), "force": (1, "nN")}, write(text)
    curve = mdr.read_curve(path, columns=columns, spring_constant=STIFFNESS)
    assert_curve(curve, DEPTH, SMALL)
    assert "piezo, minus force/(0.05 N/m)" in repr(curve)
    # A height above the sample falls where the tip goes down.
    falling = write(
        (f"{head} (nm);Force (nN)\n" if head else "") + rows(-1e9 * PIEZO, 1e9 * SMALL, between=";")
    )
    turned = mdr.read_curve(falling, columns=columns, spring_constant=STIFFNESS)
    assert_curve(turned, DEPTH, SMALL)
    assert (turned.columns["piezo"], turned.remarks[0].kind) == ((0, "−nm"), "changed")
    # What a curve says of its columns reads it again.
    path = write(text)
    assert_curve(mdr.read_curve(path, columns=curve.columns, spring_constant=STIFFNESS), DEPTH, SMALL)
    with pytest.raises(mdr.UnknownColumns, match=r"piezo.* give spring_constant= \(N/m\)"):
        mdr.read_curve(path, columns=columns)


def test_from_a_depth_nothing_is_subtracted(write):
    """A stiffness that nothing uses is refused: a second subtraction made 46 kPa of 15."""
    path = write(table("Indentation (nm)", "Force (nN)", columns=(NM, 1e9 * SMALL)))
    assert_curve(mdr.read_curve(path), DEPTH, SMALL)
    with pytest.raises(ValueError, match="spring constant is not used"):
        mdr.read_curve(path, spring_constant=STIFFNESS)
    with pytest.raises(ValueError, match=r'give "depth", or "piezo" .* not both'):
        mdr.read_curve(path, columns={"depth": (0, "nm"), "piezo": (0, "nm"), "force": (1, "nN")})


def test_a_stiffness_in_the_header_gives_way_to_the_one_that_is_given(write):
    for line in ("# Spring constant (N/m): 0.05", "Federkonstante: 0,05 N/m", "Spring Constant;50 mN/m"):
        text = f"{line}\nZ (nm);Kraft (nN)\n" + rows(1e9 * PIEZO, 1e9 * SMALL, between=";")
        path = write(text.replace(".", ",") if "," in line else text)
        columns = {"piezo": (0, "nm"), "force": (1, "nN")}
        curve = mdr.read_curve(path, columns=columns)
        assert_curve(curve, DEPTH, SMALL)
        assert ["0.05 N/m" in remark for remark in curve.remarks] == [True]
        other = mdr.read_curve(path, columns=columns, spring_constant=0.1)
        np.testing.assert_allclose(other.depth, PIEZO - SMALL / 0.1, atol=1e-14)
        assert [("0.1 N/m" in remark, "0.05 N/m" in remark) for remark in other.remarks] == [(True, True)]


@pytest.mark.parametrize(("unit", "size"), [("nm", 1e-9 * STIFFNESS), ("V", STIFFNESS * SENSITIVITY)])
@pytest.mark.parametrize("place", ["Height", "ZSnsr", "Position"])
def test_a_deflection_is_a_force_with_the_constants_of_the_cantilever(asked, write, place, unit, size):
    """A length beside it is the position of a piezo, whatever its name."""
    text = table(f"{place} (nm)", f"Deflection ({unit})", columns=(1e9 * PIEZO, SMALL / size))
    error = asked(text)
    columns = error.suggestion["columns"]
    assert columns == {"piezo": (0, "nm"), "force": (1, unit)}
    constants = {"spring_constant": STIFFNESS} | ({"sensitivity": SENSITIVITY} if unit == "V" else {})
    assert_curve(mdr.read_curve(write(text), columns=columns, **constants), DEPTH, SMALL)
    lacks = r"is a deflection in .*: give spring_constant= \(N/m\)" + r" and sensitivity= \(m/V\)" * (
        unit == "V"
    )
    with pytest.raises(mdr.UnknownColumns, match=lacks):
        mdr.read_curve(write(text), columns=columns)


TESTS = np.arange(1, 9), 200 + np.arange(8) * 3 % 7, 10 + 0.1 * (np.arange(8) * 7 % 5), np.full(8, 9.1)


@pytest.mark.parametrize("head", ["Hardness (GPa)", "Temp (C)"])
def test_a_table_of_results_is_asked_about(asked, head):
    """With and without a modulus: rows go to and fro as those of tests."""
    error = asked(table("Test", "Depth (nm)", "Load (mN)", head, columns=TESTS))
    assert error.results
    assert ("'Hardness (GPa)'" in error.why) == (head == "Hardness (GPa)")


def test_a_modulus_stands_beside_a_curve_that_falls_or_has_stiffness_and_time(asked, write):
    load = slice(0, 56)
    heads = ["Time (s)", "Depth (nm)", "Load (mN)", "Modulus (GPa)"]
    columns = [TIME, NM, MN, 0 * NM + 70]
    assert_curve(mdr.read_curve(write(table(*heads, columns=columns))))
    part = [each[load] for each in columns]
    error = asked(table(*heads, columns=part))
    assert "It has 'Modulus (GPa)'" in error.why
    assert_curve(
        mdr.read_curve(write(table(*heads, columns=part)), **error.suggestion), DEPTH[load], FORCE[load]
    )
    heads.append("Harmonic Contact Stiffness (N/m)")
    curve = mdr.read_curve(write(table(*heads, columns=[*part, part[0] + 2e4])))
    assert curve.stiffness[0] == 2e4


def test_a_question_shows_the_columns_and_what_to_paste(asked, write):
    text = "Displacement (m)*1e9,Load (mN)\n" + rows(NM, MN)
    error = asked(text)
    head, *lines, last = str(error).splitlines()
    assert head.startswith("run.txt: which column is the depth")
    assert [part.strip() for part in lines[0].split("'")] == [
        "0",
        "Displacement (m)*1e9",
        "-20, -16, -12, …",
    ]
    pasted = ast.literal_eval(last.partition("columns=")[2].partition(", and replace")[0])
    assert pasted == error.suggestion["columns"]
    for again in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert (str(again), again.suggestion, again.complete) == (str(error), error.suggestion, False)
    assert error.table.few().values[0].tolist() == pytest.approx([-20, -16, -12], abs=1e-12)


def test_columns_are_told_by_names_and_numbers(write):
    path = write("Zeit,Kraft,Weg\ns,mN,nm\n" + rows(TIME, MN, NM))
    for columns in (
        {"depth": "Weg", "force": "Kraft"}, {"depth": (2, "nm"), "force": ("Kraft", "millinewton")},
        {"depth": ["Weg nm", "nm"], "force": 1},
    ):  # fmt: skip
        curve = mdr.read_curve(path, columns=columns)
        assert_curve(curve)
        assert (curve.time, curve.source) == (None, "as told")
    curve = mdr.read_curve(path, columns={"depth": "Weg", "force": "Kraft", "time": (0, "ms")})
    np.testing.assert_allclose(curve.time, 1e-3 * TIME)


@pytest.mark.parametrize(
    ("columns", "says"),
    [
        ({"depth": 7, "force": 1}, "depth = 7 must be the number or the name of one column of {0: 'h'"),
        ({"depth": "h", "force": (1, "mN")}, r"and its unit, as in \('h', 'nm'\)"),
        ({"depth": (0, "V"), "force": (1, "mN")}, "from m, mm"),
        ({"depth": (0, "nm"), "force": (0, "mN")}, "column 0 is given twice"),
        ({"height": (0, "nm")}, "a key of columns = 'height' must be one of"),
        ({"depth": (True, "nm"), "force": (1, "mN")}, "must be the number or the name"),
        ("h", "must be like"),
        ([{"depth": (0, "nm")}], "needs a depth"),
    ],
)
def test_columns_that_are_none_are_refused(write, columns, says):
    path = write("h, F\n" + rows(NM, MN))
    with pytest.raises(ValueError, match=says):
        mdr.read_curve(path, columns=columns)


def test_the_question_about_a_constant_keeps_what_is_told(asked, write):
    """Approach and retract side by side stay both."""
    back = np.linspace(200e-9, 120e-9, 56)
    depth, force = np.append(DEPTH[:56], back), np.append(SMALL[:56], SMALL[55] - 0.1 * (200e-9 - back))
    piezo, deflection = 1e9 * (depth + force / STIFFNESS), 1e9 * force / STIFFNESS
    heads = [f"{part} {name} (nm)" for part in ("Approach", "Retract") for name in ("Z", "deflection")]
    text = table(*heads, columns=(piezo[:56], deflection[:56], piezo[56:], deflection[56:]))
    told = asked(text).suggestion
    assert told["by"] == "segments"
    again = asked(text, **told)
    assert again.suggestion == told
    (curve,) = mdr.read_curves(write(text), spring_constant=STIFFNESS, **again.suggestion)
    assert_curve(curve, depth, force)


@pytest.mark.parametrize("heads", [("Zeit (s)",), ("Time",), ("Time (s)", "Test time (s)")])
def test_times_that_are_not_taken_are_said(write, heads):
    """Their names or units are not exact, or there are two of them; one who leaves them out knows."""
    path = write(table(*heads, "Depth (nm)", "Load (mN)", columns=(*[TIME] * len(heads), NM, MN)))
    curve = mdr.read_curve(path)
    assert curve.time is None
    (remark,) = curve.remarks
    assert remark.kind == "left out"
    assert all(repr(head) in remark.text for head in heads)
    assert mdr.read_curve(path, columns={"time": None}).remarks == ()
    np.testing.assert_allclose(mdr.read_curve(path, columns={"time": (0, "s")}).time, TIME)


def test_suggestions_of_several_times_and_lengths(asked):
    """Each pair has the time beside it; the tip's indentation goes before a displacement."""
    heads = [f"{name} {k}" for k in (1, 2) for name in ("Depth (nm)", "Load (mN)", "Time (s)")]
    error = asked(table(*heads, columns=(NM, MN, TIME, NM, 2 * MN, 2 * TIME)))
    assert [each["time"] for each in error.suggestion["columns"]] == [(2, "s"), (5, "s")]
    error = asked(table("Displacement (nm)", "Load (mN)", "Indentation (nm)", columns=(2 * NM, MN, NM)))
    assert error.suggestion["columns"]["depth"] == (2, "nm")
    error = asked(table("Temps (s)", "Profondeur (nm)", "Force (mN)", columns=(TIME, NM, MN)))
    assert error.suggestion["columns"]["time"] == (0, "s")


@pytest.mark.parametrize("unit", ["n m", "µ m"])
def test_a_unit_in_two_words_is_left_open(asked, unit):
    assert asked(table(f"Depth ({unit})", "Load (mN)")).suggestion["columns"]["depth"] == (0, "?")


@pytest.mark.parametrize("share", [0.15, 1.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_an_adhesion_above_the_load_does_not_turn_the_force(write, share, sign):
    """The load is at the largest depth, the pull-off beside first contact, seven times as large or less."""
    depth, force = (
        np.append(DEPTH[:56], DEPTH[:56][::-1]),
        np.append(share * FORCE[:56], share * FORCE[:56][::-1]),
    )
    force[56:] += np.where(np.abs(depth[56:]) < 5e-9, -FORCE.max(), 0.0)
    curve = mdr.read_curve(
        write(table("Depth (nm)", "Load (mN)", columns=(sign * 1e9 * depth, 1e3 * force)))
    )
    assert_curve(curve, depth, force)


@pytest.mark.parametrize(
    ("names", "pairs"),
    [
        ("Weg A (nm),Weg B (nm),Kraft A (mN),F C (mN)", [(0, 3)]),
        ("z (nm),Weg B (nm),Tiefe C (nm),Kraft A (mN),Kraft B (mN),F C (mN)", [(0, 5), (1, 4), (2, 3)]),
    ],
)
def test_of_columns_that_are_nearly_as_likely_two_are_a_choice_and_three_are_curves(asked, names, pairs):
    """F C is a little more likely as a force than Kraft A: of two it is offered alone."""
    half = len(names.split(",")) // 2
    error = asked(f"{names}\n" + rows(*[NM] * half, *[MN] * half))
    columns = error.suggestion["columns"]
    columns = columns if isinstance(columns, list) else [columns]
    assert [(each["depth"][0], each["force"][0]) for each in columns] == pairs


@pytest.mark.parametrize(
    ("unit", "newton"),
    [("g", 9.80665e-3), ("gf", 9.80665e-3), ("kgf", 9.80665), ("lb", 4.4482216), ("lbf", 4.4482216)],
)
def test_units_of_scales_and_of_inches(tmp_path, unit, newton):
    """In brackets and in a row of units: "Depth in nm" is in nm."""
    path = tmp_path / "run.csv"
    for head in (f"Depth (in), Load ({unit})", f"Depth, Load\nin, {unit}"):
        path.write_text(f"{head}\n0, 0\n0.1, 2\n0.2, 8\n", encoding="utf-8")
        curve = mdr.read_curve(path)
        np.testing.assert_allclose(curve.depth, [0, 0.00254, 0.00508])
        np.testing.assert_allclose(curve.force, [0, 2 * newton, 8 * newton])
    path.write_text(f"Depth in nm, Load ({unit})\n0, 0\n1, 2\n2, 8\n", encoding="utf-8")
    np.testing.assert_allclose(mdr.read_curve(path).depth, [0, 1e-9, 2e-9])


def test_outliers_make_no_path_of_a_table_of_results(tmp_path):
    """Two outliers in 300 tests: nothing is suggested that would read them as curves."""
    rng = np.random.default_rng(0)
    depth, load = rng.normal(200, 20, 300), rng.normal(5, 0.5, 300)
    depth[[40, 200]], load[[40, 200]] = 4000, 90
    rows = "".join(f"{h:.3f},{F:.4f}\n" for h, F in zip(depth, load, strict=True))
    path = tmp_path / "results.csv"
    for head in ("Depth (nm),Load (mN)", "hmax (nm),Pmax (mN)"):
        path.write_text(f"{head}\n{rows}", encoding="utf-8")
        with pytest.raises(mdr.UnknownColumns) as error:
            mdr.read_curve(path)
        assert error.value.results
        assert not error.value.suggestion
