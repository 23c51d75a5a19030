"""The chain with a cap that follows the contact radius, beside the integrals over the live interval."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

E, H, L = 70e9, 2e9, 1e-6
CASES = [
    (mdr.Cone(slope=0.3), {"hardness": H}),
    (mdr.Sphere(radius=1e-5), {"hardness": 0.5 * H, "q_c": 0.3 * H * L, "f_c": 0.2 * H * L * L}),
    (mdr.TruncatedCone(flat_radius=5e-7, slope=0.3), {"q_c": 0.7 * H * L, "f_c": 0.4 * H * L * L}),
]


@pytest.mark.slow
@pytest.mark.few(1)
@pytest.mark.parametrize(("shape", "given"), CASES, ids=["H", "H+q+f", "q+f"])
def test_a_path_of_the_chain(shape, given):
    """Loading, unloading, reloading: the work of the elements is of second order in a ramp."""
    medium = mdr.Medium(E, **given)
    largest = 1e-6
    live = mdr.indent(shape, medium, largest).live_interval.length
    path = [0.0, 0.4 * largest, largest, largest - 0.4 * live, 1.3 * largest, 1.3 * largest - 0.5 * live]
    exact = mdr.indent(shape, medium, path)
    chain = mdr.indent_in_time(shape, medium, path, np.arange(6.0), tolerance=1e-6)
    scale = exact.force.max()
    # Twice the tolerance.
    np.testing.assert_allclose(chain.force, exact.force, rtol=0, atol=2e-6 * scale)
    np.testing.assert_allclose(chain.plastic_depth, exact.plastic_depth, rtol=0, atol=1e-15)
    total = (exact.stored_energy + exact.plastic_work).max()
    np.testing.assert_allclose(chain.stored_energy, exact.stored_energy, rtol=0, atol=2e-6 * total)
    np.testing.assert_allclose(chain.plastic_work, exact.plastic_work, rtol=0, atol=2e-6 * total)


@pytest.mark.few(2)
@pytest.mark.parametrize("eta", [0.0, 5.0])
@pytest.mark.parametrize(("shape", "given"), CASES, ids=["H", "H+q+f", "q+f"])
def test_an_impact_of_the_chain(shape, given, eta):
    """Step by step in time, with errors that the chain estimates itself."""
    medium = mdr.Medium(E, eta=eta, **given)
    hit, chain = (
        mdr.impact(shape, medium, 1e-12, 20.0),
        mdr.chain_impact(shape, medium, 1e-12, 20.0, tolerance=1e-5),
    )
    assert hit.plastic_work > 0.05 * 0.5e-12 * 20.0**2
    assert hit.restitution == approx(chain.restitution, abs=1e-5)
    assert hit.max_depth == approx(chain.max_depth, rel=1e-5)
    assert hit.plastic_work == approx(chain.plastic_work, rel=3e-5)
    for name in ("contact_time", "max_force"):
        estimate = getattr(chain.errors, name)
        assert estimate < 1e-2
        assert getattr(chain, name) == approx(getattr(hit, name), rel=max(estimate, 1e-5))
    motion = chain.motion()
    energy = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    # To the tolerance of Newton's method in each step.
    np.testing.assert_allclose(energy, energy[0], rtol=1e-9)
