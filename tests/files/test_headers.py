"""Units in headers: read with what scales them, or refused."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.files.headers import unit_of

from ..approx import approx

#: Units as they stand in a header, and their sizes (SI).
READ = {
    "Depth (nm)": 1e-9, "depth_nm": 1e-9, "Tiefe / µm": 1e-6, "Tiefe in nm": 1e-9,
    "h [nm]": 1e-9, "h/nm": 1e-9,
    "Depth, nm": 1e-9, "Displacement Into Surface nm": 1e-9, "Depth (Å)": 1e-10,
    "Depth (angstrom)": 1e-10,
    "Depth (micron)": 1e-6, "Depth in microns": 1e-6, "Calc_Ramp_Ex_nm": 1e-9, "Defl_pN_Rt": 1e-12,
    "load_micro_N": 1e-6, "Force-mN": 1e-3, "Load (micronewtons)": 1e-6, "Kraft (mikro N)": 1e-6,
    "Force (milli-Newton)": 1e-3, "Fuerza (nanonewtons)": 1e-9, "Force (pN)": 1e-12,
    "Load (kilonewton)": 1e3,
    "Load (meganewton)": 1e6, "Kraft (Piconewton)": 1e-12, "Load (ÂµN)": 1e-6, "Load (\u03bcN)": 1e-6,
    "Load (Î¼N)": 1e-6, "Load ($\\mu$N)": 1e-6, "载荷（毫牛）": 1e-3, "压入深度 (微米)": 1e-6,
    "Load 10^-3 N": 1e-3,
    "Load (10^-3 N)": 1e-3, "Load [10⁻³ N]": 1e-3, "Load (10**-3 N)": 1e-3, "Depth (10-9 m)": 1e-9,
    "Depth (m)*1e9": 1e-9, "Depth x1e-6 (m)": 1e-6, "Force (N) x1e-6": 1e-6, "Depth [×10⁻⁶ m]": 1e-6,
    "Force (N*1e-9)": 1e-9, "Force (N·10^-3)": 1e-3, "Force (N)/1e-3": 1e-3, "F / 10^-6 N": 1e-6,
    "Force (10^3 N)": 1e3, "Load [1E-3 N]": 1e-3, "Depth (m) 10^-9": 1e-9,
    "DEPTH (NM)": 1e-9, "LOAD (UN)": 1e-6,
    "Load (mN, corrected)": 1e-3, "Time (min)": 60.0, "Zeit in Sekunden": 1.0, "Time (h)": 3600.0,
    "Stiffness (N/m)": 1.0, "S [mN/nm]": 1e6, "Load (mN) 1": 1e-3,
    "k (mN/m)": 1e-3, "S (µN/nm)": 1e3, "S (N/nm)": 1e9, "Deflection (V)": 1.0, "Deflection (mV)": 1e-3,
    "Load (kN)": 1e3, "Force (nN)": 1e-9, "Depth (mm)": 1e-3, "Depth (cm)": 1e-2, "Depth (pm)": 1e-12,
    "Time (ms)": 1e-3, "Time (µs)": 1e-6, "Time (msec)": 1e-3, "Time (µsec)": 1e-6, "Time (hr)": 3600.0,
    "Zeit (Minuten)": 60.0, "Profondeur (centimètres)": 1e-2, "位移 (纳米)": 1e-9, "时间 (毫秒)": 1e-3,
}  # fmt: skip
#: Units with something beside them that is not understood, or that has two readings.
DOUBTFUL = (
    "Load (kgf)", "Load gf", "Load (lbf)", "Load (dyn)", "Depth (µin)",
    "Load (N)*1e-3", "Load (N x 10^3)",
    "Load (mN)*1e3", "Load (10e-3 N)", "Load (0.1 mN)", "Load 100 mN",
    "Load x10 (mN)", "Load (mN) x 1000",
    "Load (mN)/10", "Load (mN/10)", "Load [mN / 10.0]", "Load mN/1000", "Depth (nm/10)",
    "1000*Load (mN)", "10 Load (mN)", "2F (mN)", "Load (thousand N)", "Load deca N",
    "Depth (hundreds of nm)", "Load (tenths of mN)", "log Force (N)", "sqrt(Load) (mN)", "Load (mN)^2",
    "Load (mN) normalised", "Load scaled (mN)", "LOAD (MN)", "Force (m N)", "Force m(N)", "kForce (N)",
    "Depth (\ufffdm)", "Force ?N", "Force N e-3", "Load (% of 10 mN)", "Depth (nm) [µm]",
)  # fmt: skip
#: Units of other quantities.
OTHERS = (
    "Load (µN/s)", "Load µN/s", "Load rate mN / s", "Area (nm^2)", "Area (nm²)",
    "1/Depth (1/nm)", "E (GPa)",
    "Load (mN^0.5)", "Depth nm-1", "Height (measured & smoothed)", "Load", "h",
)  # fmt: skip


@pytest.mark.parametrize(("head", "size"), READ.items())
def test_units_are_read_with_what_scales_them(head, size):
    unit = unit_of(head)
    assert not unit.doubt
    assert unit.size == approx(size, rel=1e-12)


@pytest.mark.parametrize("head", DOUBTFUL)
def test_what_is_not_understood_is_a_doubt(head):
    assert unit_of(head).doubt


@pytest.mark.parametrize("head", OTHERS)
def test_other_quantities_have_no_unit_of_the_curve(head):
    """µN/s is no time."""
    unit = unit_of(head)
    assert unit.kind not in ("length", "force", "time")


@pytest.mark.parametrize("head", [each for each in DOUBTFUL if each[0] in "LF"])
def test_a_doubt_is_refused_with_what_to_give(tmp_path, head):
    path = tmp_path / "run.csv"
    path.write_text(f"Depth (nm);{head}\n0;0\n10;1\n20;4\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r'columns=\{"(force": \(1, "mN"\)|depth": \(0, "nm"\))'):
        mdr.read_curve(path)
    given = mdr.read_curve(path, columns={"depth": (0, "nm"), "force": (1, "mN")})
    np.testing.assert_allclose(given.force, [0, 1e-3, 4e-3])


def test_a_column_with_a_known_unit_comes_before_one_in_doubt(tmp_path):
    """And a friction does not stand in for a load in kgf."""
    path = tmp_path / "run.csv"
    rows = "\n0,0,0\n10,1,0.5\n20,4,2\n"
    path.write_text(f"Depth (nm),Load (kgf),Load (N){rows}")
    curve = mdr.read_curve(path)
    assert curve.force.tolist() == [0, 0.5, 2]
    assert "force is taken from 'Load (N)', not from 'Load (kgf)'" in curve.remarks
    path.write_text(f"Depth (nm),Load (kgf),Friction (N){rows}")
    with pytest.raises(ValueError, match=r"'Load \(kgf\)' is not understood: 'kgf'"):
        mdr.read_curve(path)


@pytest.mark.parametrize(
    ("header", "doubt"),
    [("Depth (nm),Load (mN/10),Other (mN)", "mN/10"), ("Depth (nm/10),Load (mN),Height (nm)", "nm/10")],
)
def test_no_column_stands_in_for_one_whose_unit_is_scaled(tmp_path, header, doubt):
    """A height may be that of a piezo, and an unnamed force anything."""
    path = tmp_path / "run.csv"
    path.write_text(f"{header}\n0,0,0\n10,1,5\n20,4,20\n")
    with pytest.raises(ValueError, match=f"'{doubt}' is not a unit"):
        mdr.read_curve(path)


@pytest.mark.parametrize("units", ["s;1e-9 m;10^-3 N", "[s];[nm];[mN]", "sec;nanometer;millinewton"])
def test_a_line_of_units_has_scales_too(tmp_path, units):
    path = tmp_path / "run.txt"
    path.write_text(f"Time;Depth;Force\n{units}\n0;0;0\n1;10;1\n2;20;4\n")
    curve = mdr.read_curve(path)
    np.testing.assert_allclose(curve.depth, [0, 1e-8, 2e-8])
    np.testing.assert_allclose(curve.force, [0, 1e-3, 4e-3])
    assert curve.time.tolist() == [0, 1, 2]
