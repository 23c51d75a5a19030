"""The motion of one impact over time: the solution of its equation at any time, and its energy ledger."""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...base.motions import Motion, instants
from ...base.results import check_single
from ..applicability import refuse_adhesion
from ..contact.indentation import Indentation
from ..contact.live_interval import LiveInterval
from ..contact.yielding import yield_rule
from ..numerics.gauss import gauss_integrals
from .equation_of_motion import ON_MEDIUM, ON_STRUCTURE, Bodies, MotionState
from .motion_solver import solve

#: Number of parts of a step as starting intervals of Newton's method.
_CELLS = 64
#: Tolerance of a step, whose estimate is a bound: between nodes 150 random motions on media, plates and
#: supports are within 5·10⁻¹¹ of those with 10⁻¹², and take half of the time of 10⁻¹⁰ on a plate.
_TOLERANCE = 1e-7


def motion(hit, n, before_yield=0):
    """Return the `Motion` of one `Impact` at n instants, and at `before_yield` more up to the onset."""
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
    # Energy of the elements at the rim at their release, by parts: dissipated, or still stored.
    elastic = -medium.relaxation_time * np.minimum(state.velocity, 0.0)
    rim = elastic**2 * states.contact_radius / 2
    plastic = rule.plastic_integral(state.interval.lower - state.increase, state.increase)
    work = modulus * (state.work - rim - released)
    # The velocity of the equation of motion is the velocity of the body minus F/Z.
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
    """Return the energy over 2E* (m³) of the springs of released elements at times (s), 0 on loading.

    An element is released with the elastic part τ|v|, which relaxes as exp(−t/τ). Between two instants the
    radius of the rim and v² are linear in time.
    """
    tau = hit.medium.relaxation_time
    if tau == 0:
        return np.zeros_like(time)
    # Steps are short if the velocity falls quickly.
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
    # `finer` has all times of unloading; before them np.interp gives the first energy, 0.
    return np.interp(time, finer, energy)


def released_compression(states, time, i, height):
    """Return the elastic compression (m) left in released elements, at heights g (m) of the profile.

    It belongs to state i of the states of an impact at some times (s), and is 0 for elements in contact. At
    its release an element has the compression of the depth beyond the live interval, which relaxes as
    exp(−t/τ).
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


class Branch:
    """Loading or unloading of one impact, as polynomials: penetration y or live depth ℓ, and velocity."""

    def __init__(self, steps):
        self._steps = [step for _, step in steps]
        self._slopes = np.concatenate([step.slopes for step in self._steps])
        self.start, self.end = self._steps[0].start[0, 0], self._steps[-1].end()[0, 0]
        shares = np.linspace(0.0, 1.0, _CELLS + 1)
        self._places = np.add.outer(np.arange(len(self._steps)), shares).ravel()
        self._table = self._states(self._places)

    def at(self, time):
        """Return the `MotionState` at times (s)."""
        return self._where("time", time)

    def when(self, depth):
        """Return the times (s) at depths (m): of y on loading, of ℓ on unloading."""
        return self._where("depth", depth).time

    def nodes(self, count):
        """Return the `MotionState` at `count` equal shares of every step."""
        return self._states(np.linspace(0, len(self._steps), len(self._steps) * (count - 1) + 1))

    def _states(self, place):
        """Return the `MotionState` at places: the number of a step plus a share of it."""
        number = np.minimum(place.astype(int), len(self._steps) - 1)
        share, states = place - number, MotionState(*np.empty((4, place.size)))
        matrix = gauss_integrals(self._slopes.shape[2], share)
        integrals = np.einsum("kj,ksj->sk", matrix, self._slopes[number])
        for i, step in enumerate(self._steps):
            rows = number == i
            states = states.replaced(rows, step.state(share[None, rows], integrals[:, None, rows])[0])
        return states

    def _where(self, name, values):
        """Return the `MotionState` at given values of depth or time, which are monotonic."""
        start, end = getattr(self.start, name), getattr(self.end, name)
        sign = np.sign(end - start)
        table = np.maximum.accumulate(sign * getattr(self._table, name))
        place = np.interp(sign * values, table, self._places)
        low, states, rows = np.floor(place * _CELLS) / _CELLS, self._states(place), np.arange(values.size)
        for _ in range(20):
            # Newton's method, with a difference as the derivative. At an end of a step the depth is a cube
            # of δ, and the derivative may vanish. There, a miss within rounding must not move the place.
            miss = values[rows] - getattr(states, name)[rows]
            far = np.abs(miss) > 1e-14 * max(abs(start), abs(end))
            rows, miss = rows[far], miss[far]
            if not rows.size:
                break
            shift = np.where(place[rows] - np.floor(place[rows]) < 0.5, 1e-6, -1e-6)
            beside = getattr(self._states(place[rows] + shift), name)
            rate = np.maximum(sign * (beside - getattr(states, name)[rows]) / shift, 1e-300)
            place[rows] = np.clip(place[rows] + sign * miss / rate, low[rows], low[rows] + 1 / _CELLS)
            states = states.replaced(rows, self._states(place[rows]))
        # The exact ends are more accurate than the polynomials.
        states = states.replaced(sign * values <= sign * start, self.start)
        states = states.replaced(sign * values >= sign * end, self.end)
        return states


class DenseState(NamedTuple):
    """States of one impact (SI), with the velocity of the equation of motion.

    `work` (m³) is the work over 2E* of the dashpots, with the energy that released elements will lose, or
    of the waves of a plate.
    """

    depth: np.ndarray
    velocity: np.ndarray
    interval: LiveInterval
    increase: np.ndarray
    work: np.ndarray


@dataclass(frozen=True, eq=False)
class DenseMotion:
    """Motion of one impact to the loss of contact, with its two branches; made by `dense_motion`.

    `turning_point` is the state of largest depth, `imprint_depth` the plastic depth (m) before the impact,
    and `increase` (m) its increase by the impact.
    """

    turning_point: Indentation
    imprint_depth: np.ndarray
    increase: np.ndarray
    loading: Branch
    unloading: Branch

    @property
    def turning_time(self):
        """Time (s) of the turning point."""
        return self.loading.end.time

    @property
    def end_time(self):
        """Time (s) at which contact is lost."""
        return self.unloading.end.time

    def at(self, time):
        """Return the `DenseState` at an array of times (s) since first contact."""
        pressed = time <= self.turning_time
        state = MotionState(*np.empty((4, time.size)))
        for branch, rows in ((self.loading, pressed), (self.unloading, ~pressed)):
            state = state.replaced(rows, branch.at(time[rows]))
        # The penetration at the turning point equals the impact's to the last digit.
        largest = penetration_of(self.turning_point, self.increase)
        y = np.where(time < self.turning_time, np.minimum(state.depth, largest), largest)
        medium, final = self.turning_point.medium, self.turning_point.live_interval
        rule = yield_rule(self.turning_point.profile, medium)
        interval, increase = rule.loading(y, self.imprint_depth)
        lower = np.where(pressed, interval.lower, final.lower)
        length = np.where(pressed, interval.length, state.depth)
        upper = np.where(pressed, interval.upper, lower + length)
        unloading_depth = upper - medium.relaxation_time * np.minimum(state.velocity, 0.0)
        depth = np.where(pressed, self.imprint_depth + y, unloading_depth)
        increase = np.where(pressed, increase, self.increase)
        return DenseState(depth, state.velocity, LiveInterval(lower, upper, length), increase, state.work)


# The cache makes two motions of one impact 1.4 times as fast; friction needs them in each of its runs.
@lru_cache(maxsize=16)
def dense_motion(hit):
    """Return the `DenseMotion` of one `Impact`, by its equation of motion; the last results are cached."""
    increase = hit.plastic_depth_increase
    imprint_depth = np.asarray(hit.plastic_depth - increase)
    penetration = penetration_of(hit.turning_point, increase)
    given = hit.profile, hit.medium, hit.mass, hit.speed, imprint_depth, penetration, hit.structure
    equations = ON_MEDIUM if hit.structure.rigid else ON_STRUCTURE
    solution = solve(Bodies.of(*given), _TOLERANCE, equations, to_rest=True)
    loading, unloading = Branch(solution.loading), Branch(solution.unloading)
    return DenseMotion(hit.turning_point, imprint_depth, increase, loading, unloading)


def penetration_of(turning_point, increase):
    """Return the depth (m) from the imprint to a state, with the increase (m) of its plastic depth."""
    return turning_point.live_interval.length + increase
