"""The law of one element: its events and work against small steps, and independence of the step."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

import mdr_core as mdr

from ...approx import approx
from .small_steps import SmallSteps

# τ = 1 ns.
VISCOUS = mdr.Medium(E_star=1e9, q_c=1.0, eta=0.25)
D_C, TAU = VISCOUS.critical_depth, VISCOUS.relaxation_time
# Reversals, holds and a lift-off; rates from a tenth to ten times d_c/τ.
PATH = np.array([0, 2.5, 2.5, 1.9, 2.2, 1.0, 1.3, -0.5, 1.9, 1.75, 4.0]) * D_C
MOVES = ((1e-7, 1.0), (0.0, 1e-60), (1e-250, 1e60), (5e-324, 1e60), (1e-7, 1e-60), (-1e-7, 1e60))


@pytest.mark.few(3)
@pytest.mark.parametrize("pace", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("reduced", [0.0, 0.9 * D_C, 1.8 * D_C])
def test_every_event_of_an_element(pace, reduced):
    """Yield, release, relaxation, re-contact: against the law in small steps."""
    time = np.cumsum([0, 1.0, 0.5, 0.2, 0.4, 1.5, 0.6, 1.0, 0.8, 0.1, 2.0]) * pace * TAU
    punch = mdr.FlatPunch(1e-6)
    for last in (4, 5, 7, 9, 11):
        foundation = mdr.Foundation(punch, VISCOUS, 2, 1e-6)
        for k in range(1, last):
            foundation = foundation.advance(PATH[k] - reduced, time[k] - time[k - 1])
        steps = SmallSteps(VISCOUS, reduced).follow(time[:last], PATH[:last], 300)
        assert foundation.plastic[0] == approx(float(steps.plastic), abs=1e-14 * D_C)
        # The small steps delay an event by up to one, at most 3.3 d_c/300.
        assert foundation.elastic[0] == approx(float(steps.elastic), abs=1.2e-2 * D_C)
        assert foundation.contact[0] == steps.contact


@pytest.mark.parametrize("pace", [0.1, 10.0])
def test_work_of_the_force_goes_into_the_ledger(pace):
    """Spring, cap and dashpot take ∫F dd, through every event of the path."""
    time = np.cumsum([0, 1.0, 0.5, 0.2, 0.4, 1.5, 0.6, 1.0, 0.8, 0.1, 2.0]) * pace * TAU
    foundation, work = mdr.Foundation(mdr.FlatPunch(1e-6), VISCOUS, 2, 1e-6), 0.0
    for k in range(1, len(PATH)):
        rise, dt = PATH[k] - PATH[k - 1], time[k] - time[k - 1]

        def force(s, foundation=foundation, rise=rise, dt=dt):
            return foundation.advance(foundation.depth + s * rise, s * dt).force

        work += rise * quad(force, 0, 1, limit=200, epsabs=0, epsrel=1e-8)[0] if rise else 0.0
        foundation = foundation.advance(PATH[k], dt)
        # Jumps of the force where contact begins limit quad to 1e-8 of the largest contribution.
        energy = foundation.stored_energy + foundation.plastic_work + foundation.viscous_work
        assert energy == approx(work, rel=1e-6)


@pytest.mark.parametrize("tau", [1e-8, 1e-3, 1.0, 1e3, 1e8])
def test_a_ramp_in_one_step_or_in_many(tau):
    """Straight ramps are exact whatever the step, from τ far below to far above it."""
    medium = mdr.Medium(1e9, q_c=1.0, eta=tau * 1e9 / 4)
    whole = parts = mdr.Foundation(mdr.Paraboloid(1e-5), medium, 200, 4e-7)
    for depth in (5.0, 5.0, 4.2, 4.6, 3.0, 4.9, 2.0):
        start = parts.depth
        whole = whole.advance(depth * D_C, 1.0)
        for k in range(1, 51):
            parts = parts.advance(start + (depth * D_C - start) * k / 50, 1 / 50)
        # Fifty roundings of depths, and of lags that are τ/s times larger.
        np.testing.assert_allclose(whole.elastic, parts.elastic, rtol=0, atol=1e-13 * D_C)
        np.testing.assert_allclose(whole.plastic, parts.plastic, rtol=0, atol=1e-13 * D_C)
        np.testing.assert_array_equal(whole.contact, parts.contact)
        assert whole.viscous_work == approx(parts.viscous_work, rel=1e-10)


@pytest.mark.few(24)
@pytest.mark.parametrize("moves", list(itertools.product(MOVES, repeat=3)))
def test_moves_that_are_tiny_or_fast(moves):
    """All quantities are finite and not negative at any rate; a warning is an error."""
    foundation = mdr.Foundation(mdr.Cone(1.0), VISCOUS, 4, 1e-6)
    for move in moves:
        foundation = foundation.advance(*move)
        numbers = (
            foundation.force,
            foundation.viscous_work,
            foundation.stored_energy,
            foundation.plastic_work,
        )
        assert np.isfinite(numbers).all()
        assert min(numbers) >= 0
