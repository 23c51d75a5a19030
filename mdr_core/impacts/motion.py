"""The motion of one impact over time, with its energy ledger."""

import numpy as np

from ..applicability import refuse_adhesion
from ..contact.indentation import Indentation
from ..contact.yielding import yield_rule
from ..numerics.motions import Motion, instants
from ..numerics.results import check_single
from .dense_motion import dense_motion


def motion(hit, n, before_yield=0):
    """The `Motion` of one `Impact` at n instants, and so many more up to the onset of yield."""
    refuse_adhesion(hit.medium, "the motion of an impact")
    check_single(hit, "motion")
    dense, medium, modulus = dense_motion(hit), hit.medium, 2 * hit.medium.E_star
    rule, imprint = yield_rule(hit.profile, medium), hit.plastic_depth - hit.plastic_depth_increase
    time = instants(n, dense.turning_time, dense.end_time)
    if before_yield and hit.plastic_depth_increase > 0:
        # Just before yield, at even steps of the depth.
        onset = rule.penetration(imprint, imprint) * (1 - 1e-9)
        time = np.union1d(time, dense.loading.when(onset * np.linspace(0, 1, before_yield + 1)[1:]))
    state, released, structure = dense.at(time), _released_energy(hit, dense, time), hit.structure
    uniform_load = 4 * medium.eta * np.maximum(state.velocity, 0.0)
    states = Indentation(hit.profile, medium, state.depth, state.interval, uniform_load, in_time=True)
    # Energy of the elements at the rim at their release, by parts: dissipated, or still stored in them.
    elastic = -medium.relaxation_time * np.minimum(state.velocity, 0.0)
    rim = elastic**2 * states.contact_radius / 2
    plastic = rule.plastic_integral(state.interval.lower - state.increase, state.increase)
    work = modulus * (state.work - rim - released)
    # The velocity of the equation of motion is that of the body less F/Z.
    body_velocity = state.velocity + states.force / structure.impedance
    velocity = state.velocity
    if structure.is_support:
        velocity = velocity / (1 + states.stiffness / structure.stiffness)
    deflection = states.force / structure.stiffness
    deflection = deflection + hit.mass * (hit.speed - body_velocity) / structure.impedance
    return Motion(
        time=time,
        depth=state.depth,
        velocity=velocity,
        force=states.force,
        contact_radius=states.contact_radius,
        plastic_radius=states.plastic_radius,
        plastic_depth=state.interval.lower,
        live_depth=state.interval.length,
        kinetic_energy=hit.mass * body_velocity**2 / 2,
        stored_energy=states.stored_energy + modulus * released,
        plastic_work=modulus * plastic,
        viscous_work=work if structure.rigid else np.zeros_like(work),
        deflection=deflection,
        body_velocity=body_velocity,
        structure_work=np.zeros_like(work) if structure.rigid else work,
        support_energy=states.force**2 / (2 * structure.stiffness),
        states=states,
        impact=hit,
    )


def _released_energy(hit, dense, time):
    """Energy over 2E* (m³) of the springs of released elements at times (s), 0 on loading.

    An element is released with the elastic part τ|v|, which relaxes as exp(−t/τ). Between two instants the
    radius of the rim and v² are linear in time.
    """
    tau = hit.medium.relaxation_time
    if tau == 0:
        return np.zeros_like(time)
    # Steps are short where the velocity falls quickly.
    even = np.linspace(dense.turning_time, dense.end_time, 400)
    finer = np.unique(np.concatenate([time, even, dense.unloading.nodes(33).time]))
    finer = finer[(finer >= dense.turning_time) & (finer <= dense.end_time)]
    state = dense.unloading.at(finer)
    radius = hit.profile.radius_at(hit.plastic_depth + state.depth)
    density, decay = (tau * state.velocity) ** 2 / 2, 2 * np.diff(finer) / tau
    remaining = np.exp(-decay)
    # Means of s and 1 − s with the weight exp(−decay (1 − s)).
    with np.errstate(invalid="ignore", divide="ignore"):
        late = np.where(decay > 1e-4, (decay - 1 + remaining) / decay**2, 0.5 - decay / 6)
        early = np.where(decay > 1e-4, (1 - remaining * (1 + decay)) / decay**2, 0.5 - decay / 3)
    newly = (radius[:-1] - radius[1:]) * (early * density[:-1] + late * density[1:])
    energy = np.zeros_like(finer)
    for i, (factor, new) in enumerate(zip(remaining, newly, strict=True)):
        energy[i + 1] = factor * energy[i] + new
    # At the end all remaining elements are released at once.
    energy[-1] += radius[-1] * density[-1]
    # All times of unloading are among the finer ones; before them the energy is that of the first, 0.
    return np.interp(time, finer, energy)


def released_compression(states, time, i, height):
    """Elastic compression (m) left in released elements, at heights g (m) of the profile.

    The state is that of index i among the states of an impact at some times (s). 0 of elements in contact.
    An element is released with the compression by which the depth is ahead of the live interval, which
    relaxes as exp(−t/τ).
    """
    tau, turn = states.medium.relaxation_time, int(np.argmax(states.depth))
    if tau == 0 or i <= turn:
        return np.zeros_like(height)
    past = slice(turn, i + 1)
    upper, time = states.live_interval.upper[past], time[past]
    ahead = states.depth[past] - upper
    released = np.minimum(np.searchsorted(-upper, -height), len(upper) - 1)
    left = ahead[released] * np.exp((time[released] - time[-1]) / tau)
    return np.where(height >= upper[-1], left, 0.0)
