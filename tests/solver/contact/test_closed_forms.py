"""Closed forms are those of quadrature."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.contact.integrals import QuadratureIntegrals, integrals
from mdr_core.solver.contact.live_interval import LiveInterval

from ...shapes import POWER_LAWS, name


@pytest.mark.parametrize("profile", [*POWER_LAWS, mdr.FlatPunch(1e-6)], ids=name)
def test_closed_forms_are_those_of_quadrature(profile):
    """From whole depths to a billionth of them."""
    depth = np.geomspace(1e-12, 1e-3, 40)
    length = depth * np.tile([1.0, 0.5, 1e-3, 1e-9], 10)
    interval, quadrature = LiveInterval(depth - length, depth, length), QuadratureIntegrals(profile)
    for quantity in ("radius_integral", "energy_integral"):
        values, expected = (getattr(way, quantity)(interval) for way in (integrals(profile), quadrature))
        np.testing.assert_allclose(values, expected, rtol=1e-13)
