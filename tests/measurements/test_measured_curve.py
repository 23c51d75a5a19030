"""Segments of measured curves, and what is subtracted from their depth."""

from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx

DATA = Path(__file__).parents[1] / "data"
TIP, GLASS = mdr.Cone.berkovich(), mdr.Medium(E_star=80e9, hardness=14e9)
#: Rate of a drift (m/s), and frame compliance (m/N).
DRIFT, FRAME = 0.05e-9, 2e-8


def made():
    """Time, depth, force and segments: loading for 50 s, a hold, unloading to 10 %, a hold, withdrawal."""
    down = np.linspace(500e-9, 0, 2000)
    force = mdr.indent(TIP, GLASS, np.append(500e-9, down)).force[1:]
    low = down[np.argmax(force < 0.1 * force[0])]
    parts = [
        np.linspace(0, 500e-9, 500), np.full(60, 500e-9), np.linspace(500e-9, low, 150),
        np.full(600, low), np.linspace(low, low - 150e-9, 20),
    ]  # fmt: skip
    depth = np.concatenate(parts)
    names = ["approach", "hold", "retract", "hold", "retract"]
    names = np.repeat(names, [part.size for part in parts])
    return 0.1 * np.arange(depth.size), depth, mdr.indent(TIP, GLASS, depth).force, names


TIME, DEPTH, FORCE, SEGMENT = made()


def read(folder, depth, force=FORCE, labels=None):
    """A curve from a table, with a column of `labels` for some of its samples."""
    columns = {"Time (s)": TIME, "Depth (nm)": 1e9 * depth, "Load (mN)": 1e3 * force}
    head, rows = list(columns), np.column_stack(list(columns.values())).tolist()
    rows = [[f"{x:.12g}" for x in row] for row in rows]
    if labels is not None:
        head, rows = ["Step", *head], [[labels.get(k, ""), *row] for k, row in enumerate(rows)]
    path = folder / "run.csv"
    path.write_text("\n".join(";".join(row) for row in [head, *rows]), encoding="utf-8")
    return mdr.read_curve(path)


def test_a_curve_of_arrays_is_that_of_its_file(tmp_path):
    """Segments, quantities, corrections and the fit of the modulus are the same."""
    # The file has twelve digits.
    file, curve = read(tmp_path, DEPTH), mdr.MeasuredCurve(DEPTH, FORCE, TIME, name="arrays")
    assert curve.segment.tolist() == file.segment.tolist()
    assert curve.to_dict().keys() == file.to_dict().keys()
    assert curve.minus_frame(FRAME).depth == approx(file.minus_frame(FRAME).depth, rel=1e-9, abs=1e-18)
    E_star = [mdr.oliver_pharr(TIP, each).E_star for each in (curve, file)]
    assert E_star[0] == approx(E_star[1], rel=1e-8)
    assert "arrays" in repr(curve)


@pytest.mark.parametrize(
    ("arrays", "says"),
    [
        ((DEPTH, FORCE[1:]), r"depth \(1330,\), force \(1329,\) must have the same shape"),
        ((DEPTH, FORCE, TIME[:9]), "same shape"),
        ((DEPTH[None], FORCE[None]), "same shape"),
        (([], []), "same shape"),
    ],
)
def test_arrays_of_no_curve_raise(arrays, says):
    with pytest.raises(ValueError, match=says):
        mdr.MeasuredCurve(*arrays)


def test_segments_are_those_of_the_path(tmp_path):
    """Holds are found to half the 2 % of the samples that tell them, turns of the depth exactly."""
    curve = read(tmp_path, DEPTH)
    off = np.flatnonzero(curve.segment != SEGMENT)
    ends = np.flatnonzero(SEGMENT[1:] != SEGMENT[:-1])
    assert np.abs(off[:, None] - ends).min(axis=1).max() <= 0.02 * DEPTH.size
    assert set(curve.segment.tolist()) == {"approach", "hold", "retract"}
    # Without the first hold the approach ends with the largest depth.
    keep = (np.arange(DEPTH.size) < 500) | (np.arange(DEPTH.size) >= 560)
    segment = mdr.measurements.measured_curve.segments_of(DEPTH[keep], FORCE[keep])
    assert np.flatnonzero(segment == "approach")[-1] == 499


def test_cycles_are_approaches_and_retracts():
    """Seven cycles to growing loads on fused quartz, with holds at their tops and a tenth below."""
    curve = mdr.read_curve(DATA / "quartz.csv")
    changes = np.flatnonzero(curve.segment[1:] != curve.segment[:-1])
    order = [str(curve.segment[k]) for k in changes]
    assert order[:9] == 3 * ["approach", "hold", "retract"]
    tops = [curve.force[k] for k in changes if curve.segment[k] == "hold"]
    # Each load is twice the one before.
    np.testing.assert_allclose(np.divide(tops[1:], tops[:-1]), 2.0, rtol=0.1)


def test_segments_that_the_file_names_are_kept(tmp_path):
    """At their first samples, in the words of an instrument; "Unload" is no loading."""
    labels = {0: "Load Segment", 500: "Hold", 560: "Unload From Peak", 710: "Thermal Drift Hold Segment"}
    curve = read(tmp_path, DEPTH, labels=labels)
    # The instrument has no name for the withdrawal.
    np.testing.assert_array_equal(curve.segment[:1310], SEGMENT[:1310])
    assert set(curve.segment[1310:].tolist()) == {"hold"}
    assert curve.remarks == ()
    np.testing.assert_array_equal(curve.approach.depth, curve.depth[:500])
    np.testing.assert_array_equal(curve.retract.time, curve.time[560:710])
    assert curve.approach.segment.tolist() == 500 * ["approach"]
    with pytest.raises(ValueError, match=r"run\.csv has no retract: .* approach"):
        _ = curve.approach.retract


@pytest.mark.parametrize("labelled", [False, True])
def test_drift_and_frame_are_the_inverse_of_what_they_add(tmp_path, labelled):
    """Also where the withdrawal is counted to the last hold, the one below a fifth of the force."""
    names = {0: "load", 500: "hold", 560: "unload", 710: "hold"}
    measured = DEPTH + DRIFT * TIME + FRAME * FORCE
    curve = read(tmp_path, measured, labels=names if labelled else None)
    rate = curve.drift()
    # 20 of 620 samples are withdrawn: they shift the median of the slopes by less than the written digits.
    assert rate == approx(DRIFT, rel=1e-3)
    assert curve.drift(slice(720, 1300)) == approx(DRIFT, rel=1e-6)
    corrected = curve.minus_drift(DRIFT).minus_frame(FRAME)
    np.testing.assert_allclose(corrected.depth, DEPTH, atol=1e-11 * DEPTH.max() + 1e-19)
    np.testing.assert_array_equal(corrected.force, curve.force)
    assert [remark.split(" is ")[0] for remark in corrected.remarks[-2:]] == [
        "depth: a drift of 50 pm/s", "depth: a frame compliance of 20 nm/N"
    ]  # fmt: skip
    fit = mdr.fit_indentation(TIP, corrected.depth, corrected.force, hardness=None, contact_point=0.0)
    assert fit.medium.E_star == approx(GLASS.E_star, rel=1e-6)


def test_corrections_with_units(tmp_path):
    """As pint's quantities: 3 nm/min are 50 pm/s."""
    pint = pytest.importorskip("pint")
    unit, curve = pint.UnitRegistry(), read(tmp_path, DEPTH)
    plain = curve.minus_drift(DRIFT).minus_frame(FRAME)
    units = curve.minus_drift(3 * unit("nm/min")).minus_frame(20 * unit("nm/N"))
    np.testing.assert_allclose(units.depth, plain.depth, rtol=1e-12)


def test_drifts_without_a_hold_are_refused(tmp_path):
    loading = mdr.read_curve(DATA / "spot3-0.csv")
    with pytest.raises(ValueError, match=r"no hold .* below a fifth of it: give the"):
        loading.drift()
    curve = read(tmp_path, DEPTH)
    with pytest.raises(ValueError, match=r"slice\(5, 7, None\) has 2 samples of run\.csv"):
        curve.drift(slice(5, 7))
    with pytest.raises(ValueError, match="hold = 7 must be a slice"):
        curve.drift(7)
    with pytest.raises(ValueError, match="rate = inf m/s must be finite"):
        curve.minus_drift(np.inf)
    with pytest.raises(ValueError, match="compliance = -1 m/N must be finite and not negative"):
        curve.minus_frame(-1)
    (tmp_path / "timeless.csv").write_text("h (nm), F (mN)\n0,0\n1,1\n2,4\n")
    timeless = mdr.read_curve(tmp_path / "timeless.csv")
    for refused in (timeless.drift, lambda: timeless.minus_drift(DRIFT)):
        with pytest.raises(ValueError, match=r"timeless\.csv has no times: a drift needs"):
            refused()
