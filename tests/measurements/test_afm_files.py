"""AFM files that the tests write, read by afmformats."""

import re
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx

afmformats = pytest.importorskip("afmformats")

#: A cantilever of 0.05 N/m and 60 nm/V over a gel of 20 kPa, under a sphere of 5 µm.
STIFFNESS, SENSITIVITY, TIP, GEL = 0.05, 60e-9, mdr.Paraboloid(5e-6), mdr.Medium(E_star=20e3)
DEPTH = 1e-6 * np.append(np.linspace(-1.0, 0.6, 60), np.linspace(0.6, -1.0, 40)[1:])
FORCE = mdr.indent(TIP, GEL, DEPTH).force
#: Height of the piezo above contact: the cantilever is bent by F/k.
HEIGHT = -DEPTH - FORCE / STIFFNESS
#: Moduli of twelve gels, in units of that of the first.
MODULI = 1 + 0.2 * np.arange(12)
SEGMENT = np.repeat([0, 1], [60, 39]).astype(np.uint8)


def curve(number=0, modulus=1.0, **metadata):
    """A curve in memory, at the position (2 µm number, −1 µm)."""
    known = {
        "enum": number, "path": "made", "imaging mode": "force-distance", "position x": 2e-6 * number,
        "position y": -1e-6,
    }  # fmt: skip
    force = modulus * FORCE
    data = {"force": force, "height (measured)": -DEPTH - force / STIFFNESS, "segment": SEGMENT}
    data["time"] = 0.01 * np.arange(99)
    return afmformats.mod_force_distance.AFMForceDistance(data, known | metadata)


def recipe(name):
    """The block of the documentation that reads a file of this name."""
    page = Path(__file__).parents[2] / "assets" / "docs" / "afm.md"
    blocks = re.findall(r"```py\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    (block,) = (block for block in blocks if f'"{name}"' in block)
    return block


@pytest.fixture
def grid(tmp_path):
    """A file with the curves of twelve gels."""
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "map.h5"
    with h5py.File(path, "w") as file:
        for k, modulus in enumerate(MODULI):
            curve(k, modulus, **{"spring constant": STIFFNESS}).export_data(file, fmt="hdf5")
    return path


@pytest.mark.parametrize("suffix", ["h5", "tab"])
def test_depth_is_minus_the_position_of_the_tip(tmp_path, suffix):
    """Eight digits are in a .tab file."""
    path = tmp_path / f"run.{suffix}"
    curve(**{"spring constant": STIFFNESS}).export_data(path, fmt=suffix)
    read = mdr.read_curve(path)
    np.testing.assert_allclose(read.depth, DEPTH, atol=1e-7 * np.ptp(HEIGHT))
    np.testing.assert_allclose(read.force, FORCE, rtol=1e-7)
    np.testing.assert_allclose(read.time, 0.01 * np.arange(99))
    assert (read.spring_constant, read.position.tolist()) == (STIFFNESS, [0.0, -1e-6])
    np.testing.assert_array_equal(read.approach.depth, read.depth[:60])
    np.testing.assert_array_equal(read.retract.force, read.force[60:])
    with pytest.raises(ValueError, match=rf"run\.{suffix} cannot be read .* Its forces are in N"):
        mdr.read_curve(path, spring_constant=1.0)


def test_a_depth_with_the_deflection_in_it_is_not_quoted(tmp_path):
    """The piezo goes 1.4 times as far as the tip; with the stiffness the modulus is that of the gel."""
    path = tmp_path / "run.tab"
    curve().export_data(path, fmt="tab")
    read = mdr.read_curve(path)
    quoted = mdr.fit_indentation(TIP, read.approach, q_c=np.inf).quoted
    assert (quoted.value, quoted.source, quoted.kind) == (None, None, "deflection")
    assert quoted.remedy == (mdr.Remedy("give", "spring_constant"),)
    # Its arrays alone know nothing of it.
    alone = mdr.fit_indentation(TIP, read.approach.depth, read.approach.force, q_c=np.inf)
    assert alone.quoted.source == "fit"
    path = tmp_path / "known.tab"
    curve(**{"spring constant": STIFFNESS}).export_data(path, fmt="tab")
    fit = mdr.fit_indentation(TIP, mdr.read_curve(path).approach, q_c=np.inf)
    assert fit.quoted.value == approx(GEL.E_star, rel=1e-4)


def test_a_height_without_a_stiffness_has_a_remark(tmp_path):
    """The deflection is then that of a frame compliance of 1/k."""
    curve().export_data(tmp_path / "run.tab", fmt="tab")
    read = mdr.read_curve(tmp_path / "run.tab")
    assert read.spring_constant is None
    (remark,) = read.remarks
    assert "'height (measured)'" in remark
    assert remark.endswith("give spring_constant= (N/m)")
    np.testing.assert_allclose(read.depth, -HEIGHT, atol=1e-7 * np.ptp(HEIGHT))
    np.testing.assert_allclose(read.minus_frame(1 / STIFFNESS).depth, DEPTH, atol=2e-7 * np.ptp(HEIGHT))
    # It is subtracted where it is given.
    told = mdr.read_curve(tmp_path / "run.tab", spring_constant=STIFFNESS)
    assert (told.remarks, told.spring_constant) == ((), STIFFNESS)
    np.testing.assert_allclose(told.depth, DEPTH, atol=2e-7 * np.ptp(HEIGHT))
    # Of forces in N nothing uses a sensitivity.
    with pytest.raises(ValueError, match="are in N"):
        mdr.read_curve(tmp_path / "run.tab", spring_constant=STIFFNESS, sensitivity=SENSITIVITY)


def test_what_an_instrument_does_not_know_is_given(tmp_path):
    """Columns of AFM Workshop in V, approach and retract side by side; here each is the approach."""
    volts, path = FORCE / STIFFNESS / SENSITIVITY, tmp_path / "run.csv"
    lines = [
        "Force-Distance Curve", "Mode: Single", "Point: 1", "X, um: 3", "Y, um: 4",
        "Extend Z-Sense(nm),Extend T-B(V),Retract Z-Sense(nm),Retract T-B(V)",
    ]  # fmt: skip
    for height, volt in zip(HEIGHT[:60], volts[:60], strict=True):
        lines.append(",".join(2 * [f"{-1e9 * height:.9g},{volt:.9g}"]))
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(ValueError, match=r"give spring_constant= \(N/m\) and give sensitivity= \(m/V\)"):
        mdr.read_curve(path)
    read = mdr.read_curve(path, spring_constant=STIFFNESS, sensitivity=SENSITIVITY)
    np.testing.assert_allclose(read.approach.depth, DEPTH[:60], atol=1e-8 * np.ptp(HEIGHT))
    np.testing.assert_allclose(read.approach.force, FORCE[:60], rtol=1e-8)
    np.testing.assert_allclose(read.retract.force, FORCE[:60], rtol=1e-8)
    assert read.position.tolist() == [3e-6, 4e-6]


def test_columns_of_nova_are_known_by_the_constants_that_are_given(tmp_path):
    """NT-MDT: without a header, height (nm) and deflection (nA) of approach and retract, decimal commas."""
    current = FORCE[:60] / STIFFNESS / SENSITIVITY
    rows = [f"{1e9 * h:.6f}\t{1e9 * i:.6f}\t{1e9 * i:.6f}" for h, i in zip(HEIGHT, current, strict=False)]
    path = tmp_path / "run.txt"
    path.write_text("\n".join(rows[::-1]).replace(".", ","), encoding="utf-8")
    with pytest.raises(mdr.UnknownColumns):
        mdr.read_curve(path)
    read = mdr.read_curve(path, spring_constant=STIFFNESS, sensitivity=SENSITIVITY)
    # Six decimals of nm and nA; the package leaves out samples of one deflection at the beginning.
    force = read.approach.force
    np.testing.assert_allclose(force, FORCE[60 - force.size : 60], atol=1e-15 * SENSITIVITY * STIFFNESS)
    np.testing.assert_allclose(read.approach.depth, DEPTH[60 - force.size : 60], atol=1e-14)


def test_the_numbers_of_a_map_are_in_order(grid):
    """Also where ten and eleven stand before two in the file."""
    curves = mdr.read_curves(grid)
    assert len(curves) == 12
    np.testing.assert_allclose(curves.position, [[2e-6 * k, -1e-6] for k in range(12)], atol=1e-20)
    for k, read in enumerate(curves):
        assert read.force.max() == approx(MODULI[k] * FORCE.max())
        assert read.position.tolist() == curves.position[k].tolist()
    part = curves[-2:]
    assert (len(part), part.position[0, 0]) == (2, approx(20e-6))
    with pytest.raises(IndexError):
        curves[12]
    assert mdr.read_curve(grid, 3).remarks[0].text.startswith("curve 3 of 12")


def test_a_map_is_fitted_in_one_call(grid):
    approaches = [read.approach for read in mdr.read_curves(grid)]
    depth, force = ([getattr(each, name) for each in approaches] for name in ("depth", "force"))
    fit = mdr.fit_indentation(TIP, depth, force, q_c=np.inf)
    np.testing.assert_allclose(fit.medium.E_star, MODULI * GEL.E_star, rtol=1e-6)


def test_a_file_without_segments_has_those_of_its_depth(tmp_path):
    """As .ibw files, which count all samples to the approach."""
    data = curve(**{"spring constant": STIFFNESS})
    data["segment"] = np.zeros(99, dtype=np.uint8)
    data.export_data(tmp_path / "run.tab", fmt="tab")
    read = mdr.read_curve(tmp_path / "run.tab")
    assert read.segment.tolist() == 60 * ["approach"] + 39 * ["retract"]


def test_a_file_that_is_none_is_refused(tmp_path):
    for name in ("run.jpk-force", "run.ibw", "run.zip"):
        (tmp_path / name).write_bytes(b"PK\x03\x04 no curve")
        with pytest.raises(ValueError, match=f"{name} cannot be read by afmformats"):
            mdr.read_curve(tmp_path / name)


def test_the_recipe_of_the_documentation(tmp_path):
    """Under a paraboloid F ∝ E* R^(1/2): with 10 µm in place of 5 µm E* is smaller by the root of 2."""
    curve(**{"spring constant": STIFFNESS}).export_data(tmp_path / "run.tab", fmt="tab")
    code = recipe("fmt-jpk-fd_spot3-0192.jpk-force")
    found = {}
    exec(code.replace("fmt-jpk-fd_spot3-0192.jpk-force", str(tmp_path / "run.tab")), found)
    # Eight digits of the force.
    assert found["fit"].medium.E_star == approx(GEL.E_star / np.sqrt(2), rel=1e-5)
    assert found["fit"].baseline == approx(0, abs=1e-6 * FORCE.max())


def test_the_recipe_of_a_map(grid, tmp_path, monkeypatch):
    pandas = pytest.importorskip("pandas")
    monkeypatch.chdir(tmp_path)
    exec(recipe("map.jpk-force-map").replace("map.jpk-force-map", str(grid)), {})
    table = pandas.read_csv("moduli.csv")
    np.testing.assert_allclose(table["E_star"], MODULI * GEL.E_star, rtol=1e-5)
    np.testing.assert_allclose(table["x"], 2e-6 * np.arange(12), atol=1e-20)
