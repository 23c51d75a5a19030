"""Creep under a force in time, against the equations of a Kelvin–Voigt foundation."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.foundation.force_path import chain_creep

from ...approx import approx

MEDIUM = mdr.Medium(E_star=1e9, q_c=1.0, eta=0.25)
DRY = mdr.Medium(E_star=1e9, q_c=1.0)
D_C, TAU = MEDIUM.critical_depth, MEDIUM.relaxation_time


@pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Sphere(1e-5)])
def test_creep_ends_at_the_depth_of_the_slow_path_and_recovery_at_the_imprint(shape):
    slow = mdr.indent(shape, DRY, 3 * D_C)
    force = np.array([0, 1, 1, 0, 0]) * slow.force
    time = np.array([0, 0.1, 100.0, 100.1, 140.0]) * TAU
    result = mdr.creep(shape, MEDIUM, force, time, tolerance=1e-3)
    assert np.all(np.diff(result.depth[:3]) > 0)
    assert result.depth[1] < 0.9 * 3 * D_C
    # The springs of the ring relax all dashpots: e^(−100(a − c)/a), less than e^(−18), remains.
    assert result.depth[2] == approx(3 * D_C, rel=1e-3)
    assert result.depth[4] == approx(slow.plastic_depth, rel=2e-3)
    assert result.plastic_depth[4] == approx(slow.plastic_depth, rel=2e-3)
    x = np.linspace(0, 1.1, 20) * slow.contact_radius
    # Springs have the error of the depth, 10⁻³ of 3 d_c, and dashpots compensate for it.
    atol = 6e-3 * MEDIUM.yield_line_load
    np.testing.assert_allclose(result[2].line_load(x), slow.line_load(x), rtol=0, atol=atol)


@pytest.mark.slow
def test_the_path_that_elements_follow_carries_the_force():
    """It is a path of depth in time; other elements carry on it what is prescribed."""
    cone, soft = mdr.Cone(0.3), mdr.Medium(1e6, q_c=1.0, eta=2.5e5)
    path = chain_creep(cone, soft, [0.0, 0.1, 0.1, 0.01, 0.01], [0.0, 0.1, 5.0, 5.5, 9.0])
    again = mdr.indent_in_time(cone, soft, path._history.depth, path._history.time, tolerance=1e-5)
    # Both are chains of a finite number of elements: their errors in force are some 10⁻³.
    np.testing.assert_allclose(again.force[path._index], path.force, rtol=0, atol=2e-3 * 0.1)


def test_no_force_makes_no_contact():
    path = mdr.creep(mdr.Sphere(1e-3), MEDIUM, [0.0, 0.0], [0.0, 1.0])
    assert path.depth.tolist() == path.contact_radius.tolist() == [0.0, 0.0]


def test_a_force_has_a_contact_also_where_unloading_is_steep():
    """At millions of critical depths the tolerance of the depth exceeds the recovery of the springs."""
    shape, medium = mdr.TruncatedParaboloid(1e-6, 1e-5), mdr.Medium(3.5e9, q_c=3.2)
    force = [3.1e-3, 0.0, 5.4e-3, 4.8e-3, 6.2e-3]
    path = mdr.creep(shape, medium, force, [0.1, 0.3, 0.4, 1.0, 2.2])
    assert np.all(path.depth > 1e6 * medium.critical_depth)
    # Without dashpots the slow path is exact; its contact is nearly constant until the load is zero.
    slow = mdr.indent_to_force(shape, medium, force)
    pressed = np.array(force) > 0
    np.testing.assert_allclose(path.contact_radius[pressed], slow.contact_radius[pressed], rtol=1e-4)


def test_bad_arguments_are_refused():
    with pytest.raises(ValueError, match=r"time\[1\] = 0 s does not increase"):
        mdr.creep(mdr.Cone(0.3), MEDIUM, [0.0, 1e-6], [0, 0])
    with pytest.raises(ValueError, match=r"force\[1\] = -1e-06 N is negative"):
        mdr.creep(mdr.Cone(0.3), MEDIUM, [0.0, -1e-6], [0, 1])
    with pytest.raises(ValueError, match=r"force\[1\] = 2 N must be less than"):
        mdr.creep(mdr.FlatPunch(1e-6), DRY, [0.0, 2.0], [0, 1])
    with pytest.raises(ValueError, match=r"force\[0\] = 1 N must be less than"):
        mdr.creep(mdr.FlatPunch(1e-6), MEDIUM, [1.0, 1.0], [0, 1])
