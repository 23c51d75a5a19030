"""A family of shapes of one's own takes part in all that has closed forms, with one class."""

from dataclasses import dataclass

import numpy as np

import mdr_core as mdr
from mdr_core.solver.contact.integrals import Integrals, QuadratureIntegrals, integrals

from ...approx import approx

MEDIUM = mdr.Medium(E_star=1e9, q_c=10.0)


@dataclass(frozen=True)
class Wide(mdr.Profile):
    """A cone of the slope 1/2, and no entry."""

    def height_at(self, r):
        return r / 2

    def reduced_at(self, x):
        return np.pi / 4 * x

    def reduced_slope_at(self, x):
        return np.pi / 4 + 0 * x


@dataclass(frozen=True)
class Known(Wide):
    """The same with an entry."""


@integrals.register(Known)
class KnownIntegrals(Integrals):
    """a = 4 s/π; the others are left to quadrature."""

    def radius_integral(self, interval):
        return 2 / np.pi * interval.length * (interval.upper + interval.lower)

    def energy_integral(self, interval):
        return 2 / (3 * np.pi) * interval.length**2 * (interval.upper + 2 * interval.lower)

    def radius_difference(self, interval):
        return 4 / np.pi * interval.length


def test_a_family_of_its_own_takes_part():
    """States, fields, impacts and stress of a profile with an entry and of the same one without."""
    assert type(integrals(Wide())) is QuadratureIntegrals
    known, wide, cone = (mdr.indent(p, MEDIUM, 5e-8) for p in (Known(), Wide(), mdr.Cone(0.5)))
    for quantity in ("force", "stored_energy", "plastic_work", "stiffness"):
        assert getattr(known, quantity) == approx(getattr(wide, quantity), rel=1e-13, abs=0.0)
        assert getattr(known, quantity) == approx(getattr(cone, quantity), rel=1e-15, abs=0.0)
    r = known.contact_radius * np.linspace(0, 1.2, 8)
    np.testing.assert_allclose(known.pressure(r), cone.pressure(r), rtol=1e-12)
    np.testing.assert_allclose(known.stress(r, 1e-8).zz, cone.stress(r, 1e-8).zz, rtol=1e-9)
    hits = [mdr.impact(p, MEDIUM, 1e-9, [0.01, 0.1]) for p in (Known(), mdr.Cone(0.5))]
    for quantity in ("max_depth", "restitution"):
        np.testing.assert_allclose(*(getattr(hit, quantity) for hit in hits), rtol=1e-13)
    # What is promised of contact times.
    np.testing.assert_allclose(*(hit.contact_time for hit in hits), rtol=1e-9)
