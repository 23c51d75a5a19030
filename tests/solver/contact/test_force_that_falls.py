"""Paths of force with f_c, under which the force of a loading may fall after the onset of yield."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx


def test_a_force_below_the_onset_leads_to_the_elastic_depth():
    """A later branch, past the fall, is no solution for forces below its own."""
    tip, medium = mdr.RoundedCone(1e-6, 0.3), mdr.Medium(1e10, f_c=1e-5)
    depth = np.array([1e-10, 1e-9, 1e-8])
    assert np.all(depth < mdr.yield_depth(tip, medium))
    force = mdr.indent(tip, medium, depth).force
    # Rounding of the radii.
    np.testing.assert_allclose(mdr.indent_to_force(tip, medium, force).depth, depth, rtol=1e-13)


@pytest.mark.slow
@pytest.mark.few(2)
@pytest.mark.parametrize("seed", range(6))
def test_the_first_depth_that_carries_it(seed):
    """Under random polygons; forces of 2,000 depths tell whether a smaller one carries it."""
    rng = np.random.default_rng(seed)
    r = np.append(0.0, np.cumsum(10 ** rng.uniform(-7.5, -6.3, 5)))
    slope = np.sort(rng.uniform(0.02, 0.5, 5))
    tip = mdr.Sampled(r, np.append(0.0, np.cumsum(slope * np.diff(r))))
    top = 0.9 * tip.known_depth
    a = float(tip.contact_radius(0.2 * top))
    medium = mdr.Medium(1e10, f_c=1e10 * a * top * 10 ** rng.uniform(-2.5, -1))
    depth = np.geomspace(1e-4 * top, top, 2000)
    forces = mdr.indent(tip, medium, depth[:, None]).force[:, 0]
    for i in rng.choice(2000, 4):
        found = mdr.indent_to_force(tip, medium, forces[i])
        again = mdr.indent(tip, medium, found.depth).force
        assert again == approx(forces[i], rel=1e-10)
        enough = depth[np.argmax(forces >= forces[i] * (1 - 1e-12))]
        assert found.depth <= enough * (1 + 1e-9)
