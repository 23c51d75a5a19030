"""Impact as a result: the paper's fast limit, arrays, refusals."""

import math

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from .test_energy_balance import D_C, MEDIUM, hit_to_depth


@pytest.mark.parametrize(("shape", "n"), [(mdr.Cone(0.3), 1.0), (mdr.Paraboloid(1e-3), 2.0)])
class TestFastLimit:
    def test_restitution(self, shape, n):
        """e² → (1 + 1/n) d_c/(2 d_max), with a relative error of order d_c/d_max."""
        hit = hit_to_depth(shape, MEDIUM, 1e6 * D_C)
        assert hit.restitution**2 == approx((1 + 1 / n) / 2e6, rel=2e-6)

    def test_slope_of_restitution_against_speed(self, shape, n):
        """e ∝ v^(−1/2) for the cone, v^(−2/3) for the paraboloid; −1/4 at constant hardness."""
        hit = mdr.impact(shape, MEDIUM, 1.0, [1e4, 1e5])
        slope = np.diff(np.log(hit.restitution)) / np.diff(np.log(hit.speed))
        # d_max ∝ v^(2/(1 + 1/n)) and e² ∝ 1/d_max.
        assert slope[0] == approx(-n / (n + 1), rel=1e-4)


def test_eq_23_24_work_and_damaged_area_of_a_fast_cone():
    slope, speed = 0.3, np.array([10.0, 20.0, 40.0])
    hit = mdr.impact(mdr.Cone(slope), MEDIUM, 1e-3, speed)
    energy = 1e-3 * speed**2 / 2
    # The corrections are of relative order d_c/d_max.
    tolerance = 3 * D_C / hit.max_depth
    assert np.all(np.abs(MEDIUM.q_c * hit.max_depth**2 / slope / energy - 1) < tolerance)
    assert np.all(np.abs(hit.damaged_area / (4 * energy / (math.pi * MEDIUM.q_c * slope)) - 1) < tolerance)


@pytest.mark.parametrize("eta", [0.0, 1e-3])
def test_indices_are_those_of_arrays(eta):
    """A permutation, a mask, a repeated entry and a slice pick what they pick of the speeds."""
    speed = np.array([0.1, 1.0, 10.0])
    hit = mdr.impact(mdr.Sphere(1e-5), mdr.Medium(1e9, q_c=10.0, eta=eta), 1e-12, speed)
    for index in (np.array([2, 0, 1]), speed > 0.5, np.array([1, 1, 1]), slice(None, None, -1)):
        for name in ("speed", "restitution", "contact_time", "plastic_work", "viscous_work"):
            # Dry ones are solved again, as arrays of another length.
            np.testing.assert_allclose(getattr(hit[index], name), getattr(hit, name)[index], rtol=1e-14)
