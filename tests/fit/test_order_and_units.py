"""Remarks on records whose samples are not in order, or not in SI units."""

import numpy as np
import pytest

import mdr_core as mdr

DEPTH = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 25e-9, 100))
TIPS = (mdr.Paraboloid(1e-6), mdr.Cone(0.3))


def record(tip, noise=0.004):
    force = mdr.indent(tip, mdr.Medium(10e9, 100.0), DEPTH).force
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


@pytest.mark.parametrize(("length", "load"), [(1e9, 1e9), (1e9, 1e6), (1e6, 1e3)])
@pytest.mark.parametrize("tip", TIPS, ids=repr)
def test_other_units_are_named(tip, length, load):
    """nm and nN, nm and µN, µm and mN."""
    text = remarks(tip, length * DEPTH, load * record(tip))
    assert "give depth in m and force in N" in text
    assert "units" not in kinds(tip, DEPTH, record(tip))
