"""Friction on every class of hardness: closed limits, similarity, and ensembles."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

MASS, MU, KAPPA = 1e-9, 0.3, 2 / 3
#: χ = κ m/(2 m_t) is 7/6.
BALL = 2 * MASS / 7
MEDIA = {
    "(a)": mdr.Medium(1e9, hardness=2e7),
    "(b)": mdr.Medium(1e9, q_c=10.0),
    "(c)": mdr.Medium(1e9, f_c=1e-5),
    "(a) + (b)": mdr.Medium(1e9, q_c=4.0, hardness=1e7),
    "sum": mdr.Medium(1e9, q_c=4.0, hardness=5e6, f_c=2e-6),
}
OF_ALL = pytest.mark.parametrize("medium", MEDIA.values(), ids=MEDIA)


@pytest.mark.few(2)
@OF_ALL
def test_a_punch_without_slip(medium):
    """Width and stiffness along the surface stay the same, yield or not: W = W₀ cos ωt until contact ends.

    Yield makes the contact longer, so that this depends on the class.
    """
    b = 1e-6
    hit = mdr.oblique_impact(mdr.FlatPunch(b), medium, MASS, 0.1, 0.05, np.inf, tangential_mass=BALL)
    assert hit.plastic_work > 0
    omega = np.sqrt(2 * KAPPA * 1e9 * b / BALL)
    # What is asked for is 10⁻⁵.
    assert -hit.tangential_restitution == approx(np.cos(omega * hit.contact_time), abs=1e-5)
    assert hit.max_tangential_force == approx(BALL * omega * 0.05, rel=1e-5)


@pytest.mark.few(2)
@pytest.mark.parametrize("eta", [0.0, 5.0])
@pytest.mark.parametrize("psi", [0.3, 1.3])
def test_a_cone_of_constant_hardness_has_no_length_of_its_own(psi, eta):
    """Restitutions are the same at every speed if τ over the time is; e² = κ(3 − 2κ)/(2 − κ) for τ = 0."""
    cone, share = mdr.Cone(0.3), 0.2
    found = []
    for speed in (1e-3, 1.0):
        # Times go as d/v ∝ v^(−1/3).
        medium = mdr.Medium(1e9, hardness=share * 0.3e9, eta=eta * (speed / 1e-3) ** (-1 / 3))
        hit = mdr.oblique_impact(
            cone, medium, MASS, speed, psi * MU * speed / KAPPA, MU, tangential_mass=BALL, tolerance=1e-4
        )
        found.append(
            [hit.restitution, hit.tangential_restitution, hit.max_tangential_force / hit.max_force]
        )
    # The same steps in other units; viscous motions are solved to some 10⁻⁹.
    np.testing.assert_allclose(*found, rtol=1e-7)
    if not eta:
        assert found[0][0] ** 2 == approx(share * (3 - 2 * share) / (2 - share), rel=1e-9)


def test_no_hardness_that_is_reached_is_as_elastic():
    """Up to the onset, of every class, and under a cone that is too blunt to yield, κ = H/(E* s) ≥ 1."""
    elastic = mdr.Medium(1e9)
    for profile, medium, speed in (
        (
            mdr.Paraboloid(1e-5),
            MEDIA["(a)"],
            0.9 * mdr.yield_speed(mdr.Paraboloid(1e-5), MEDIA["(a)"], MASS),
        ),
        (
            mdr.Paraboloid(1e-5),
            MEDIA["sum"],
            0.9 * mdr.yield_speed(mdr.Paraboloid(1e-5), MEDIA["sum"], MASS),
        ),
        (mdr.Cone(0.02), MEDIA["(a)"], 0.1),
    ):
        hit, expected = (
            mdr.oblique_impact(
                profile, each, MASS, speed, MU * speed / KAPPA, MU, tangential_mass=BALL, tolerance=1e-5
            )
            for each in (medium, elastic)
        )
        assert hit.plastic_work == 0
        # The levels are the same but for that of the onset, which is not reached.
        assert hit.tangential_restitution == approx(expected.tangential_restitution, abs=2e-5)
        assert hit.max_tangential_force == approx(expected.max_tangential_force, rel=2e-5)


def test_slip_inside_ends_with_the_rate_of_the_bound():
    """Inside c elements slip until κW/μ = (1 − p′) v, on loading and before W is 0.

    Of a constant hardness under a paraboloid p = d − √(d_y d), so that 1 − p′ = √(d_y/d)/2.
    """
    profile, medium, speed = mdr.Paraboloid(1e-5), MEDIA["(a)"], 0.1
    hit = mdr.oblique_impact(
        profile, medium, MASS, speed, 1.5 * MU * speed / KAPPA, MU, tangential_mass=BALL, tolerance=1e-5
    )
    motion, onset = hit.motion(800), mdr.yield_depth(profile, medium)
    loading = np.arange(motion.normal.turning_index)
    along = KAPPA / MU * motion.tangential_velocity[loading]
    rate = np.sqrt(onset / np.maximum(motion.depth, onset))[loading] / 2 * motion.velocity[loading]
    ends = int(np.argmax(along < rate))
    # W is positive for some more instants, and the first elements stick before.
    assert (along[ends : ends + 5] > 0).all()
    assert (motion.stick_radius[ends - 5 : ends + 5] > motion.plastic_radius[ends]).all()
    assert (motion.slip_radius[ends - 5 : ends] > 0.9 * motion.plastic_radius[ends - 5 : ends]).all()
    assert (motion.slip_radius[ends + 1 : ends + 5] == 0).all()
