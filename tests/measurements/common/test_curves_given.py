"""A measured curve in the place of depth and force: its columns are taken, and what was said of it kept."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ..unloading.test_creep import record

CONE, BERKOVICH = mdr.Cone(0.3), mdr.Cone.berkovich()
TABLE = "Depth (nm);Load (mN);Time (s)\n"


def text_of(depth, force, time, head=TABLE):
    """A table in nm, mN and s."""
    rows = zip(1e9 * depth, 1e3 * force, time, strict=True)
    return head + "\n".join(f"{d:.9g};{F:.9g};{t:.9g}" for d, F, t in rows) + "\n"


@pytest.fixture
def curve(tmp_path):
    """A record with creep in its hold: its times change the results of Oliver and Pharr."""
    path = tmp_path / "run.csv"
    time, depth, force = record(0.2, "viscous")
    path.write_text(text_of(depth, force, time) + ";;\n", encoding="utf-8")
    return mdr.read_curve(path)


def test_its_columns_are_taken(curve):
    """As by the arrays themselves; without its times where None is given."""
    for time in (curve.time, None):
        given = {} if time is not None else {"time": None}
        result = mdr.oliver_pharr(BERKOVICH, curve, **given)
        arrays = mdr.oliver_pharr(BERKOVICH, curve.depth, curve.force, time=time)
        assert (result.E_star, result.hardness) == (arrays.E_star, arrays.hardness)
        fit = mdr.fit_indentation(BERKOVICH, curve, hardness=None, contact_point=0.0, **given)
        of_arrays = mdr.fit_indentation(
            BERKOVICH, curve.depth, curve.force, time=time, hardness=None, contact_point=0.0
        )
        assert fit.medium == of_arrays.medium
        assert (fit.time is None) == (time is None)
    assert result.E_star > 1.1 * mdr.oliver_pharr(BERKOVICH, curve).E_star


def test_its_remarks_come_first_and_once(curve):
    (said,) = curve.remarks
    assert said.kind == "left out"
    for result in (mdr.oliver_pharr(BERKOVICH, curve), mdr.fit_indentation(BERKOVICH, curve)):
        assert result.remarks[0] == said
        assert result.remarks.count(said) == 1
        assert len(result.remarks) > 1


def test_its_stiffness_is_taken_where_it_is_asked_for(tmp_path):
    """Of an elastic contact with its ε every sample has E*; by default the unloading is evaluated."""
    depth = np.append(np.linspace(1e-6, 3e-6, 50), np.linspace(3e-6, 1e-6, 50))
    state = mdr.indent(CONE, mdr.Medium(10e9), depth)
    rows = zip(1e9 * depth, 1e3 * state.force, state.stiffness, np.arange(100), strict=True)
    path = tmp_path / "run.csv"
    head = "Depth (nm);Load (mN);Stiffness (N/m);Time (s)\n"
    path.write_text(head + "\n".join(";".join(f"{x:.12g}" for x in row) for row in rows), encoding="utf-8")
    curve = mdr.read_curve(path)
    over = mdr.oliver_pharr(CONE, curve, stiffness=True, epsilon=2 - 4 / np.pi)
    assert over.shape == (100,)
    # Nine digits of the file, and E* goes with the square of the depth at most.
    assert over.E_star == approx(10e9, rel=1e-6)
    assert mdr.oliver_pharr(CONE, curve, epsilon=2 - 4 / np.pi).shape == ()
    with pytest.raises(ValueError, match="without time"):
        mdr.oliver_pharr(CONE, curve, stiffness=True, time=curve.time)


def test_what_has_no_meaning_is_refused(curve):
    with pytest.raises(ValueError, match="has its own force"):
        mdr.oliver_pharr(BERKOVICH, curve, curve.force)
    with pytest.raises(ValueError, match="has its own force"):
        mdr.fit_indentation(BERKOVICH, curve, force=curve.force)
    with pytest.raises(ValueError, match="force is missing"):
        mdr.fit_indentation(BERKOVICH, curve.depth)
    with pytest.raises(ValueError, match="without force, stiffness and cycles"):
        mdr.oliver_pharr(BERKOVICH, [curve, curve], cycles=True)
    with pytest.raises(ValueError, match="stiffness = True needs a MeasuredCurve"):
        mdr.oliver_pharr(BERKOVICH, curve, stiffness=True)


@pytest.fixture
def many(tmp_path):
    """Three tables with another sign of the depth; that in the middle is asked about, and comes last."""
    depth = np.append(np.linspace(0, 60e-9, 60), np.linspace(60e-9, 0, 60))
    texts = []
    for E in (10e9, 20e9):
        force = mdr.indent(CONE, mdr.Medium(E), depth).force
        texts.append(text_of(-depth, force, np.linspace(0.0, 1.0, 120), f"Test {E:.0e}\n{TABLE}"))
    unclear = "Test x\nTiefe;Kraft\n" + "\n".join(f"{i};{i**2}" for i in range(20)) + "\n"
    path = tmp_path / "runs.csv"
    path.write_text(texts[0] + unclear + texts[1], encoding="utf-8")
    return mdr.read_curves(path)


def test_curves_of_a_file_are_fitted_at_once(many):
    assert len(many) == 3
    with pytest.raises(mdr.UnknownColumns):
        mdr.fit_indentation(CONE, many, q_c=np.inf)
    fit = mdr.fit_indentation(CONE, many, q_c=np.inf, invalid="nan")
    assert fit.medium.E_star[[0, 1]] == approx([10e9, 20e9], rel=1e-6)
    assert np.isnan(fit.medium.E_star[2])
    assert list(fit.invalid) == [2]
    assert fit.invalid[2].remedy == (mdr.Remedy("give", "columns"),)
    assert "columns=" not in fit.invalid[2].text
    # What was said of its file is said first of a curve, and once of all.
    assert fit[0].remarks[0] == many[0].remarks[0]
    assert [remark.kind for remark in fit.remarks] == ["changed", "invalid"]
    assert fit.remarks[0].startswith("curve 0 (2 of 3 curves): the sign of depth is reversed")
    assert fit.remarks[0].text.endswith(many[0].remarks[0].text)


def test_a_list_of_curves_is_many(many):
    fit = mdr.fit_indentation(CONE, [many[0], many[1]], q_c=np.inf, time=None)
    assert fit.medium.E_star == approx([10e9, 20e9], rel=1e-6)
    assert fit.time is None
