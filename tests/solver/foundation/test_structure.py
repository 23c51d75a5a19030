"""Impacts of the chain on a structure, also on a viscous medium, against closed forms and an integrator."""

import numpy as np
import pytest
import scipy
from scipy.integrate import solve_ivp

import mdr_core as mdr

from ...approx import approx

E, R, MASS, SPEED = 10e9, 5e-3, 4.1e-3, 5.0
PLATE, SUPPORT = mdr.Structure(346.0), mdr.Structure(stiffness=2e7)
MEDIA = {
    "elastic": mdr.Medium(E),
    "b": mdr.Medium(E, q_c=2e5),
    "abc": mdr.Medium(E, q_c=5e4, hardness=1e8, f_c=20.0),
}


def covered(hit, expected):
    """Errors of a `ChainImpact` by name that are larger than it says, of quantities by name."""
    bounds = hit.errors._asdict()
    misses = {name: abs(getattr(hit, name) / value - 1) for name, value in expected.items()}
    return {name: miss for name, miss in misses.items() if miss > bounds[name]}


@pytest.mark.slow
@pytest.mark.few(2)
@pytest.mark.parametrize(
    "structure", [PLATE, mdr.Structure(60.0), SUPPORT], ids=["plate", "thin", "support"]
)
@pytest.mark.parametrize("medium", MEDIA.values(), ids=MEDIA)
@pytest.mark.parametrize("profile", [mdr.Paraboloid(R), mdr.FlatPunch(3e-4), mdr.Cone(0.3)], ids=repr)
def test_agrees_with_the_impact_that_it_knows_nothing_of(profile, medium, structure):
    hit = mdr.impact(profile, medium, MASS, SPEED, structure=structure)
    chain = mdr.chain_impact(profile, medium, MASS, SPEED, structure=structure, tolerance=1e-5)
    names = ["max_depth", "max_force", *(["restitution", "contact_time"] if not hit.captured else [])]
    assert not covered(chain, {name: getattr(hit, name) for name in names})
    assert chain.captured == hit.captured
    # Energies have the errors of the depth, of which they are powers.
    assert chain.structure_work == approx(hit.structure_work, rel=1e-4)
    assert chain.max_deflection == approx(hit.max_deflection, rel=1e-4)


@pytest.mark.few(2)
@pytest.mark.parametrize("structure", [PLATE, SUPPORT], ids=["plate", "support"])
@pytest.mark.parametrize("eta", [0.0, 1e3])
def test_its_ledger_closes_at_every_step(eta, structure):
    medium = mdr.Medium(E, q_c=2e5, eta=eta)
    chain = mdr.chain_impact(mdr.Paraboloid(R), medium, MASS, SPEED, structure=structure, tolerance=1e-2)
    motion = chain.motion()
    energy = motion.kinetic_energy + motion.stored_energy + motion.plastic_work + motion.viscous_work
    energy += motion.structure_work + motion.support_energy
    assert energy == approx(np.full(energy.size, MASS * SPEED**2 / 2), rel=1e-9)


def viscous_on_a_plate(tau, structure):
    """e, T and d_max of a paraboloid without yield, F = F_s + 8ηa ḋ on loading, released by force after it.

    (1 + 8ηa/Z) ḋ = V − F_s/Z, and on unloading s − d = τ (V − F_s(s)/Z).
    """
    Z = structure.impedance

    def springs(d):
        return 4 / 3 * E * np.sqrt(R) * max(d, 0.0) ** 1.5

    def loading(_, state):
        d, v = state
        drag = 2 * tau * E * np.sqrt(R * max(d, 0.0))
        rate = (v - springs(d) / Z) / (1 + drag / Z)
        return rate, -(springs(d) + drag * rate) / MASS

    def unloading(_, state):
        s = released(*state)
        return (s - state[0]) / tau, -springs(s) / MASS

    def released(d, v):
        def miss(s):
            return s - d - tau * (v - springs(s) / Z)

        # Below 0 there is no force.
        return scipy.optimize.brentq(miss, -1.0, 1.0, xtol=1e-18, rtol=4e-15)

    def turning(_, state):
        return state[1] - springs(state[0]) / Z

    def lost(_, state):
        return state[0] + tau * state[1]

    turning.terminal, turning.direction, lost.terminal, lost.direction = True, -1, True, -1
    options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-15}
    first = solve_ivp(loading, [0, 1.0], [0.0, SPEED], events=turning, first_step=1e-9, **options)
    state = first.y[:, -1]
    last = solve_ivp(unloading, [first.t[-1], 1.0], state, events=lost, first_step=1e-9, **options)
    return {"restitution": -last.y[1, -1] / SPEED, "contact_time": last.t[-1], "max_depth": state[0]}


def viscous_on_a_support(tau, structure):
    """The same on a support: K w = F with d = y − w, in the way y of the body and the depth."""
    K = structure.stiffness

    def springs(d):
        return 4 / 3 * E * np.sqrt(R) * max(d, 0.0) ** 1.5

    def loading(_, state):
        y, v, d = state
        drag = 2 * tau * E * np.sqrt(R * max(d, 1e-14))
        return v, -K * (y - d) / MASS, (K * (y - d) - springs(d)) / drag

    def unloading(_, state):
        y, v, d = state
        force = max(K * (y - d), 0.0)
        s = (force / (4 / 3 * E * np.sqrt(R))) ** (2 / 3)
        return v, -force / MASS, (s - d) / tau

    def turning(_, state):
        y, _, d = state
        return K * (y - d) - springs(d)

    def lost(_, state):
        return state[0] - state[2]

    turning.terminal, turning.direction, lost.terminal, lost.direction = True, -1, True, -1
    options = {"method": "Radau", "rtol": 1e-9, "atol": 1e-15}
    # Past the first picosecond, in which nearly all of the way is of the support.
    first = solve_ivp(
        loading, [0, 1.0], [1e-9 * SPEED, SPEED, 1e-11], events=turning, first_step=1e-12, **options
    )
    state = first.y[:, -1]
    last = solve_ivp(unloading, [first.t[-1], 1.0], state, events=lost, first_step=1e-9, **options)
    return {"restitution": -last.y[1, -1] / SPEED, "contact_time": last.t[-1] + 1e-9, "max_depth": state[2]}


@pytest.mark.few(2)
@pytest.mark.slow
@pytest.mark.parametrize("tau", [2e-6, 2e-5])
@pytest.mark.parametrize(
    ("by_integration", "structure"), [(viscous_on_a_plate, PLATE), (viscous_on_a_support, SUPPORT)]
)
def test_a_viscous_medium_on_a_structure(by_integration, structure, tau):
    expected = by_integration(tau, structure)
    medium = mdr.Medium(E, eta=E * tau / 4)
    chain = mdr.chain_impact(mdr.Paraboloid(R), medium, MASS, SPEED, structure=structure, tolerance=1e-4)
    bounds = chain.errors
    for name, value in expected.items():
        # The integrator on a support has 10⁻⁶: the force jumps into its stiff beginning.
        assert getattr(chain, name) == approx(value, rel=getattr(bounds, name) + 1e-6), name


def test_arrays_are_refused():
    with pytest.raises(ValueError, match="a single structure"):
        mdr.chain_impact(mdr.Paraboloid(R), MEDIA["b"], MASS, SPEED, structure=mdr.Structure([1.0, 2.0]))
