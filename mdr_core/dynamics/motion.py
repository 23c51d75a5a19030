"""The motion of one impact over time: its equation of motion solved anew, and read off."""

import numpy as np

from ..indentation import Indentation
from ..results import Motion, instants
from ..yielding import LiveInterval
from .energy_balance import loading_interval, plastic_integral
from .equation_of_motion import Bodies, solve

#: What the polynomials between the nodes may leave, and instants at which what has let go is followed.
_TOLERANCE, _INSTANTS, _PARTS = 1e-10, 400, 33
#: Places of a step that bracket an instant; Newton's method from there: most trials, and error of the time.
_GRID, _MOST_TRIALS, _CLOSE = 65, 20, 1e-14


def motion(hit, n):
    """The `Motion` of one `Impact` at n instants."""
    hit._one("motion")
    before = np.asarray(hit.plastic_depth - hit.plastic_depth_increase)
    deepest = hit.turning_point.live_interval.length + hit.plastic_depth_increase
    bodies = Bodies.of(hit.profile, hit.medium, hit.mass, hit.speed, before, deepest)
    course = solve(bodies, _TOLERANCE)
    turn, end = float(course.unloading[0][1].start[2, 0, 0]), float(course.time[0])
    time = instants(n, turn, end)
    count = int(np.searchsorted(time, turn, side="right"))
    y, velocity, work = _states(course.loading, time[:count])
    # First contact and the turning point are known better than from the polynomials.
    y[0], velocity[0], work[0] = 0.0, hit.speed, 0.0
    y = np.minimum(y, deepest)
    y[time[:count] == turn], velocity[time[:count] == turn] = deepest, 0.0
    loading, increase = loading_interval(y, hit.medium.critical_depth, before)
    length, *falling = _unloading(hit, course, time[count:], turn, end)
    interval = _appended(loading, hit.turning_point.live_interval.lower, length)
    increase = np.append(increase, np.full(length.size, hit.plastic_depth_increase))
    velocity, work, free = map(np.append, (velocity, work, np.zeros(count)), falling)
    depth = interval.upper - hit.medium.relaxation_time * np.minimum(velocity, 0.0)
    depth[:count] = before + y
    return _ledger(hit, time, depth, velocity, interval, increase, work, free)


def _unloading(hit, course, time, turn, end):
    """Live depth, velocity, and over 2E* the work so far and the energy of what has let go, at instants."""
    # Where the velocity falls quickly, the steps are short.
    share = np.linspace(0.0, 1.0, _PARTS)[None]
    within = [step.at(share)[2, 0] for _, step in course.unloading]
    finer = np.unique(np.concatenate([time, np.linspace(turn, end, _INSTANTS), *within]).clip(turn, end))
    length, velocity, work = _states(course.unloading, finer)
    length[-1] = 0.0
    free = _let_go(hit, finer, length, velocity)
    asked = np.searchsorted(finer, time)
    return length[asked], velocity[asked], work[asked], free[asked]


def _appended(loading, lower, length):
    """The live intervals on loading, then those of some `length` from a plastic depth `lower` on."""
    lower = np.append(loading.lower, np.full(length.size, lower))
    length = np.append(loading.length, length)
    return LiveInterval(lower, lower + length, length)


def _ledger(hit, time, depth, velocity, interval, increase, work, free):
    """The `Motion` from its states; `work` and `free` are over 2E* (m³)."""
    medium, modulus = hit.medium, 2 * hit.medium.E_star
    load = 4 * medium.eta * np.maximum(velocity, 0.0)
    states = Indentation(hit.profile, medium, depth, interval, load, in_time=True)
    # What the elements that have let go took with them has been dissipated, or is still theirs.
    taken = (medium.relaxation_time * np.minimum(velocity, 0.0)) ** 2 * states.contact_radius / 2
    return Motion(
        time=time,
        depth=depth,
        velocity=velocity,
        force=states.force,
        contact_radius=states.contact_radius,
        plastic_radius=states.plastic_radius,
        plastic_depth=interval.lower,
        live_depth=interval.length,
        kinetic_energy=hit.mass * velocity**2 / 2,
        stored_energy=states.stored_energy + modulus * free,
        plastic_work=modulus * plastic_integral(hit.profile, interval, medium.critical_depth, increase),
        viscous_work=modulus * (work - taken - free),
        states=states,
        impact=hit,
    )


def _let_go(hit, time, length, velocity):
    """Energy over 2E* (m³) of the springs that have let go, at instants of unloading.

    Each lets go with an elastic part τ|v|, and relaxes as exp(−2t/τ); between two instants as many do at
    every radius, with a squared speed that goes straight.
    """
    tau, energy = hit.medium.relaxation_time, np.zeros_like(time)
    if tau == 0:
        return energy
    a = hit.profile._radius(hit.turning_point.live_interval.lower + length)
    taken = (tau * velocity) ** 2 / 2
    fade = 2 * np.diff(time) / tau
    kept = np.exp(-fade)
    # Means of s and 1 − s with the weight exp(−fade (1 − s)).
    with np.errstate(invalid="ignore", divide="ignore"):
        late = np.where(fade > 1e-4, (fade - 1 + kept) / fade**2, 0.5 - fade / 6)
        early = np.where(fade > 1e-4, (1 - kept * (1 + fade)) / fade**2, 0.5 - fade / 3)
    fresh = (a[:-1] - a[1:]) * (early * taken[:-1] + late * taken[1:])
    for i, (share, more) in enumerate(zip(kept, fresh, strict=True)):
        energy[i + 1] = share * energy[i] + more
    # In the end all that are left do at once.
    energy[-1] += a[-1] * taken[-1]
    return energy


def _states(steps, time):
    """Depth, velocity and viscous work over 2E* at instants along the steps of one impact."""
    result, begins = np.empty((3, time.size)), np.array([step.start[2, 0, 0] for _, step in steps])
    owner = np.maximum(np.searchsorted(begins, time, side="right") - 1, 0)
    for i in np.unique(owner):
        _, step = steps[i]
        result[:, owner == i] = _states_within(step, time[owner == i])[[0, 1, 3]]
    return result


def _states_within(step, time):
    """The states (4, n) at n instants within one step of one impact.

    By Newton's method, which needs the slope of the time. By the depth it is 1/ḋ, by the velocity 1/v̇, and
    a step runs in the one of both that changes more quickly. By the share θ of the step it may be zero at
    an end, because the depth goes with the cube of δ; there one unit of rounding in the time would lead
    Newton's method away from the solution.
    """
    own, grid = 0 if step.deep else 1, step.at(np.linspace(0, 1, _GRID)[None])[:, 0]
    cell = np.clip(np.searchsorted(grid[2], time, side="right") - 1, 0, _GRID - 2)
    low, high = np.sort([grid[own, cell], grid[own, cell + 1]], axis=0)
    place = np.interp(time, grid[2], grid[own])
    for _ in range(_MOST_TRIALS):
        state = step.at(step.share(place[None]))
        late = time - state[2, 0]
        if np.all(np.abs(late) <= _CLOSE * grid[2, -1]):
            break
        depth, velocity = state[:2]
        rate = step.bodies.rates(*step.bodies.loads(depth)[:2], velocity)[own][0]
        place = np.clip(place + late * rate, low, high)
    return state[:, 0]
