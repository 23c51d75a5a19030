"""Remarks on records whose samples are not in order, or not in SI units."""

import numpy as np
import pytest

import mdr_core as mdr

from ...said import remark_of

DEPTH = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 25e-9, 100))
TIPS = (mdr.Paraboloid(1e-6), mdr.Cone(0.3))


def record(tip, noise=0.004):
    force = mdr.indent(tip, mdr.Medium(10e9, q_c=100.0), DEPTH).force
    return force + noise * force.max() * np.random.default_rng(0).normal(size=force.size)


def remarks(tip, depth, force, **given):
    return " ".join(mdr.fit_indentation(tip, depth, force, **given).remarks)


def kinds(tip, depth, force, **given):
    return {remark.kind for remark in mdr.fit_indentation(tip, depth, force, **given).remarks}


@pytest.mark.parametrize("tip", TIPS, ids=repr)
def test_the_order_is_named(tip):
    force = record(tip)
    shuffled = np.random.default_rng(1).permutation(DEPTH.size)
    assert "reversed record" in remarks(tip, DEPTH[::-1], force[::-1])
    assert "shuffled record" in remarks(tip, DEPTH[shuffled], force[shuffled])
    assert "order" not in kinds(tip, DEPTH, force)
    # Without yield the order does not matter.
    assert "order" not in kinds(tip, DEPTH[::-1], force[::-1], q_c=np.inf)


def test_a_reversed_record_has_no_unloading():
    """Its loading is taken for one: E* was 22 % too small and H 48 % too large without a remark."""
    tip, depth = mdr.Cone(0.358), np.append(np.linspace(0, 500e-9, 140), np.linspace(500e-9, 420e-9, 80))
    force = mdr.indent(tip, mdr.Medium(70e9, hardness=10e9), depth).force
    assert mdr.oliver_pharr(tip, depth, force).remarks == ()
    assert [each.kind for each in mdr.oliver_pharr(tip, depth[::-1], force[::-1]).remarks] == ["order"]


@pytest.mark.parametrize(("column", "number"), [("depth", -9999e-9), ("force", -9.999), ("force", 99.999)])
def test_a_number_that_stands_for_a_missing_one_is_named(column, number):
    """One sample of an export in nm and mN: with 99999 in the force E* is twice too large."""
    tip, depth = mdr.Cone(0.358), np.append(np.linspace(0, 500e-9, 140), np.linspace(500e-9, 420e-9, 80))
    columns = {
        "depth": depth,
        "force": mdr.indent(tip, mdr.Medium(70e9, hardness=10e9), depth).force.copy(),
    }
    assert mdr.oliver_pharr(tip, **columns).remarks == ()
    columns[column][60] = number
    assert "outliers" in [each.kind for each in mdr.oliver_pharr(tip, **columns).remarks]
    columns[column][60] = np.nan
    assert mdr.oliver_pharr(tip, **columns).remarks == ()


@pytest.mark.parametrize(("length", "load"), [(1e9, 1e9), (1e9, 1e6), (1e6, 1e3)])
@pytest.mark.parametrize("tip", TIPS, ids=repr)
def test_other_units_are_named(tip, length, load):
    """nm and nN, nm and µN, µm and mN."""
    text = remarks(tip, length * DEPTH, load * record(tip))
    assert "depth in m" in text
    assert "force in N" in text
    assert "units" not in kinds(tip, DEPTH, record(tip))


@pytest.mark.parametrize("factor", [(1.0, 1e6), (1e-9, 1.0)])
def test_units_of_measured_hardnesses_are_named(factor):
    """Radii in µm and pressures in GPa gave a q_c a million times too large, and an H of 1 Pa."""
    radius = np.geomspace(1e-7, 2e-6, 20)
    medium = mdr.Medium(70e9, hardness=1e9, q_c=50.0)
    state = mdr.indent(TIPS[1], medium, TIPS[1].reduced_at(radius))
    data = {"E_star": 70e9, "hardness": None, "q_c": None}
    assert mdr.fit_hardness(TIPS[1], state.mean_pressure, radius, **data).remarks == ()
    pressure, length = factor
    fit = mdr.fit_hardness(TIPS[1], pressure * state.mean_pressure, length * radius, **data)
    remark = remark_of(fit, "units")
    assert remark.remedy[0].what == ("radius" if length > 1 else "mean_pressure")


def test_columns_that_stand_still_or_lack_are_refused():
    tip, force = TIPS[1], record(TIPS[1])
    with pytest.raises(ValueError, match=r"range of depth = 0 m: the depth is 1e-07 m throughout"):
        mdr.oliver_pharr(tip, 0 * DEPTH + 1e-7, force)
    with pytest.raises(ValueError, match=r"range of time = 0 s: the time is 3 s throughout; check its col"):
        mdr.oliver_pharr(tip, DEPTH, force, time=0 * DEPTH + 3)
    # A fit needs its times for a drag alone.
    still = mdr.fit_indentation(tip, DEPTH, force, time=0 * DEPTH + 3).quoted
    assert still.value == mdr.fit_indentation(tip, DEPTH, force).quoted.value
    for function in (mdr.oliver_pharr, mdr.fit_indentation):
        with pytest.raises(ValueError, match="depth is missing: give depth and force"):
            function(tip, None, force)
