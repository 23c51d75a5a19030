"""E* and H over depth from a measured stiffness."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

E, CONE = 70e9, mdr.Cone(0.3)
EPSILON = 2 - 4 / np.pi
DEPTH = np.linspace(0, 400e-9, 200)
STATE = mdr.indent(CONE, mdr.Medium(E), DEPTH)
FORCE, STIFFNESS = STATE.force, STATE.stiffness


def test_of_an_elastic_cone_they_are_the_same_at_all_depths():
    """E* as it was given and H = E* s/2, to some roundings; without contact there is none."""
    result = mdr.oliver_pharr(CONE, DEPTH, FORCE, stiffness=STIFFNESS, epsilon=EPSILON)
    assert result.shape == DEPTH.shape
    assert np.isnan(result.E_star[0])
    assert result.E_star[1:] == approx(E, rel=1e-11)
    assert result.hardness[1:] == approx(0.15 * E, rel=1e-11)
    assert any("1 of 200 samples" in remark for remark in result.remarks)


def test_beta_and_samples_without_a_stiffness():
    stiffness = np.where(np.arange(200) % 10 == 5, np.nan, STIFFNESS)
    result = mdr.oliver_pharr(CONE, DEPTH, FORCE, stiffness=stiffness, epsilon=EPSILON, beta=1.034)
    assert np.count_nonzero(np.isnan(result.E_star)) == 21
    assert np.nanmax(result.E_star) == approx(E / 1.034, rel=1e-11)
    pytest.importorskip("pandas")
    table = result.to_pandas()
    assert table.index.name == "sample"
    assert len(table) == 200
    assert {"depth", "E_star", "hardness"} <= set(table)


def test_first_contact_is_found_here_too():
    depth = np.append(np.linspace(-90e-9, 0, 80, endpoint=False), DEPTH) + 90e-9
    force, stiffness = np.append(np.zeros(80), FORCE), np.append(np.zeros(80), STIFFNESS)
    result = mdr.oliver_pharr(CONE, depth, force, stiffness=stiffness, epsilon=EPSILON)
    assert result.contact_point[0] == approx(90e-9, rel=1e-6)
    assert result.E_star[85:] == approx(E, rel=1e-6)


def test_errors_are_the_scatter_of_neighbours():
    """That of 1 % noise of the stiffness, which is known to a tenth from 200 samples."""
    noise = 1 + 0.01 * np.random.default_rng(1).normal(size=200)
    result = mdr.oliver_pharr(
        CONE, DEPTH[50:], FORCE[50:], stiffness=(STIFFNESS * noise)[50:], epsilon=EPSILON
    )
    deviation = np.std(result.E_star - E)
    assert result.standard_errors["E_star"][0] == approx(deviation, rel=0.4)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"stiffness": STIFFNESS, "cycles": True}, "without time and cycles"),
        ({"stiffness": STIFFNESS, "time": DEPTH}, "without time and cycles"),
        ({"stiffness": STIFFNESS[1:]}, r"stiffness \(199,\) must have the same shape"),
        ({"stiffness": -STIFFNESS}, "no sample has a positive stiffness"),
        ({"stiffness": np.full(200, np.nan)}, "no sample has a positive stiffness"),
    ],
)
def test_what_has_no_meaning_is_refused(options, says):
    with pytest.raises(ValueError, match=says):
        mdr.oliver_pharr(CONE, DEPTH, FORCE, **options)
