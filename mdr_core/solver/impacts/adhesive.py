"""Impacts with adhesion by the energy balance.

The surfaces touch at the bottom of the imprint with the kinetic energy T. There the contact jumps to a
radius a₀, with the energy E₀. On loading T + E₀ = E + W_p + kinetic energy. From the turning point, E plus
kinetic energy is conserved up to E₁ at the pull-off. Therefore T (1 − e²) = W_p + W_a with W_a = E₁ − E₀,
and the body is captured if E at the turning point is not larger than E₁. Energies here are over 2E* (m³).
"""

from dataclasses import dataclass

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike
from ..applicability import check_pair
from ..contact.adhesion import (
    AT_DEPTH,
    contact_interval,
    last_interval,
    loaded_interval,
    single_range,
    stretch,
    stretch_rate,
    tension_and_energy,
)
from ..contact.indentation import Indentation
from ..contact.integrals import tabulated_for
from ..contact.live_interval import LiveInterval
from ..contact.yielding import TRANSITIONS, ConstantCap, yield_rule
from ..medium.medium import Medium
from ..numerics.blocks import LONG, chunks
from ..numerics.gauss import gauss_legendre
from ..numerics.roots import change_between, crossing
from ..profiles.profile import Profile
from .contact_time import places
from .energy_balance import turning_interval
from .result import Impact

#: Gauss nodes of the contact time in each piece.
_NODES = 32


@dataclass(frozen=True, eq=False, repr=False)
class AdhesiveImpact(Impact):
    """Impacts on a medium with adhesion."""

    @property
    def _rebound_energy(self):
        """Energy over 2E* (m³) after the pull-off, negative for a captured body."""
        return rebound_energy(self.profile, self.medium, self.turning_point.live_interval)

    @check.frozen_property
    def captured(self):
        """Whether adhesion holds the body, so that it does not rebound."""
        return self._rebound_energy <= 0

    @check.frozen_property
    def restitution(self):
        """Coefficient of restitution e; 0 for a captured body."""
        kinetic = self.mass * self.speed**2 / (4 * self.medium.E_star)
        return np.sqrt(np.maximum(self._rebound_energy, 0.0) / kinetic)

    @check.frozen_property
    def adhesive_work(self):
        """Energy (J) lost to adhesion: the work between touching and pull-off.

        For a captured body it is the kinetic energy minus the plastic work.
        """
        first = touching(self.profile, self.medium, self.plastic_depth - self.plastic_depth_increase)[1]
        last = pull_off(self.profile, self.medium, self.plastic_depth)[1]
        kinetic = self.mass * self.speed**2 / 2
        work = 2 * self.medium.E_star * (last - first)
        return np.where(self.captured, kinetic - self.plastic_work, work)

    @check.frozen_property
    def contact_time(self):
        """Time (s) from touching to the pull-off; infinite for a captured body."""
        inertia = self.mass / (2 * self.medium.E_star)
        arguments = self.speed, self.turning_point.live_interval, self.plastic_depth_increase
        return adhesive_contact_time(self.profile, self.medium, inertia, *arguments)


def adhesive_impact(profile, medium, mass, speed, imprint_depth):
    """Solve impacts over imprints of given plastic depth (m)."""
    energy = mass * speed**2 / (4 * medium.E_star)
    interval, stretched = adhesive_turning_interval(profile, medium, energy, imprint_depth)
    increase = interval.lower - imprint_depth
    onset = yield_rule(profile, medium).onset(interval.lower)
    depth = np.where(increase > 0, onset, interval.upper - stretched)
    load = -medium.E_star * stretched
    turning_point = Indentation(profile, medium, depth, interval, load, in_time=True)
    return AdhesiveImpact(mass[()], speed[()], turning_point, increase)


def _energy(profile, medium, interval):
    radius = profile.radius_at(interval.upper)
    return tension_and_energy(profile, interval, radius, stretch(medium, radius))[1]


def touching(profile, medium, before):
    """Return live interval (m) and energy (m³) after the jump into contact at the depth `before`."""
    before = np.asarray(before) if np.any(before) else np.zeros(())
    low = single_range(profile, medium, AT_DEPTH)
    interval, _ = contact_interval(profile, medium, before, np.zeros_like(before), low, np.inf)
    return interval, _energy(profile, medium, interval)


def pull_off(profile, medium, lower):
    """Return live interval (m) and energy (m³) at the loss of contact over an imprint of depth `lower`."""
    interval = last_interval(np.asarray(lower), single_range(profile, medium, AT_DEPTH))
    return interval, _energy(profile, medium, interval)


def _loading(profile, medium, upper, before):
    """Return E + W_p (m³) on loading up to D = `upper` (m), and its derivative (m²)."""
    interval, stretched = loaded_interval(profile, medium, upper, before)
    radius = profile.radius_at(upper)
    tension, energy = tension_and_energy(profile, interval, radius, stretched)
    plastic = yield_rule(profile, medium).plastic_integral(before, interval.lower - before)
    rate = 1 - stretch_rate(profile, radius, stretched) / (2 * radius)
    return energy + plastic, tension * rate


def adhesive_turning_interval(profile, medium, target, before):
    """Return live interval (m) and stretch Δl (m) at the turning point for kinetic energies `target` (m³).

    The interval is infinite if the turning point is deeper than the known depth.
    """
    shape = target.shape
    profile = tabulated_for(profile, target.size, lambda: profile.known_depth)
    start, energy = touching(profile, medium, before)
    # The springs at the rim take more energy than the jump gives. This guess needs 4 steps instead of 10.
    guess, _ = turning_interval(yield_rule(profile, medium), target - 3 * energy, before)
    guess = guess.upper + stretch(medium, profile.radius_at(np.minimum(guess.upper, profile.known_depth)))
    arrays = (target + energy, np.maximum(guess, start.upper), start.upper, before)
    arrays = [np.broadcast_to(array, shape).ravel() for array in arrays]
    upper, too_deep = np.empty(target.size), np.zeros(target.size, bool)
    for rows in chunks(target.size, LONG):
        goal, first, least, imprint = (array[rows] for array in arrays)
        entries, own = profile.flat_entries(rows, shape), medium.flat_entries(rows, shape)

        def work(x, goal=goal, imprint=imprint, entries=entries, own=own):
            value, slope = _loading(entries, own, x, imprint)
            return value - goal, slope

        known = np.broadcast_to(entries.known_depth, goal.shape)
        upper[rows] = crossing(work, np.minimum(first, known), least, known)
        ends = known < np.inf
        if ends.any():
            too_deep[rows] = ends & (work(np.where(ends, known, upper[rows]))[0] < 0)
    interval, stretched = loaded_interval(profile, medium, upper.reshape(shape), before)
    reached = np.where(too_deep.reshape(shape), np.inf, interval.upper)
    return LiveInterval(interval.lower, reached, interval.length), stretched


def rebound_energy(profile, medium, interval):
    """Return the energy (m³) of a body after the pull-off, negative if it is captured."""
    return _energy(profile, medium, interval) - pull_off(profile, medium, interval.lower)[1]


def adhesive_contact_time(profile, medium, inertia, speed, interval, increase):
    """Return the time (s) from touching to pull-off, infinite for captured bodies, by quadrature over D.

    `inertia` is the mass over 2E*.
    """
    before, turn, yields = interval.lower - increase, interval.upper, increase > 0
    start, energy = touching(profile, medium, before)
    end, lost = pull_off(profile, medium, interval.lower)
    total, last = inertia * speed**2 / 2 + energy, _energy(profile, medium, interval)
    low = single_range(profile, medium, AT_DEPTH)
    kinks = [kink for kink in profile.kinks if np.any(kink < turn)]

    def passing(plastic_depth):
        """Return D (m) at which loading reaches a plastic depth (m), or else at the turning point."""
        live_depth = np.where(yields, medium.critical_depth, 0.0)
        reached, _ = contact_interval(profile, medium, plastic_depth, live_depth, low, np.inf)
        return np.where(yields & (plastic_depth >= before), reached.upper, turn)

    def loading(upper):
        return total - _loading(profile, medium, upper, before)[0]

    def unloading(upper):
        return last - _energy(profile, medium, last_interval(interval.lower, upper))

    breaks = []
    if profile.transition_depth is not None:
        breaks = [profile.transition_depth * share for share in TRANSITIONS]
    onset = passing(before)
    yielded = [onset, *(passing(kink) for kink in kinks)]
    scales = [onset + share * onset for share in ConstantCap.scales]
    time = _passage(profile, medium, inertia, loading, start.upper, turn, kinks + yielded, breaks + scales)
    time = time + _passage(profile, medium, inertia, unloading, end.upper, turn, kinks, breaks)
    return np.where(last > lost, time, np.inf)


def _passage(profile, medium, inertia, kinetic_energy, low, turn, kinks, breaks):
    """Return the time (s) between D = `low` and the turning point D = `turn` (m), elementwise.

    `kinetic_energy` (m³) is a function of D. Pieces end at `breaks` and at `kinks`. Past a kink, a(D) or
    the energy is a power of the distance.
    """
    node, weight = gauss_legendre(_NODES)
    low, turn, *cuts = np.broadcast_arrays(low, turn, *kinks, *breaks)
    node, weight = (each.reshape(-1, *(1,) * low.ndim) for each in (node, weight))
    cuts = np.clip(np.reshape(cuts, (len(cuts), *low.shape)), low, turn)
    order = np.argsort(cuts, axis=0)
    edges = np.concatenate([low[None], np.take_along_axis(cuts, order, axis=0), turn[None]])
    # The last kink below each piece, or the tip.
    origins = np.where((order < len(kinks)) & (edges[1:-1] > low), edges[1:-1], 0.0)
    origins = np.maximum.accumulate(np.concatenate([0.0 * low[None], origins]), axis=0)
    time = np.zeros_like(low)
    for begin, end, origin in zip(edges[:-1], edges[1:], origins, strict=True):
        if np.any(end > begin):
            with np.errstate(invalid="ignore"):
                depth, rate = places(begin - origin, end - begin, turn - end, node)
            upper = np.where(end > begin, np.minimum(begin + depth, end), begin)
            steps = _step(profile, medium, upper, kinetic_energy(upper), inertia)
            time += np.where(end > begin, np.sum(weight * rate * steps, axis=0), 0.0)
    return time


def _step(profile, medium, upper, kinetic, inertia):
    """Return dt/dD (s/m) at D = `upper` (m) with a kinetic energy (m³)."""
    radius = profile.radius_at(upper)
    rate = 1 - stretch_rate(profile, radius, stretch(medium, radius)) / (2 * radius)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(kinetic > 0, rate * np.sqrt(inertia / (2 * kinetic)), 0.0)


@check.keywords_explained
def capture_speeds(profile: Profile, medium: Medium, mass: ArrayLike) -> tuple[Array, Array]:
    """Compute the speeds (m/s) between which a body rebounds from a virgin medium with adhesion.

    Slower bodies are captured because their kinetic energy is less than the work of adhesion. On a medium
    that yields, faster bodies are captured because the imprint holds them.

    Parameters
    ----------
    profile, medium
        One indenter and one medium.
    mass : float or array_like
        Mass m (kg), positive.

    Returns
    -------
    low, high : float or ndarray
        The two speeds, of the shape of `mass`. Without a lower or upper end they are 0 or infinite. Both
        are NaN if bodies of all speeds are captured.

    Raises
    ------
    ValueError
        If a mass is not positive, or parameters are arrays.

    Examples
    --------
    An elastic paraboloid needs 7.092196 (w⁵R⁴/E*²)^(1/3) (Johnson and Pollock 1994):

    >>> from mdr_core import Medium, Paraboloid, capture_speeds
    >>> medium = Medium(E_star=1.0, work_of_adhesion=1.0)
    >>> low, high = capture_speeds(Paraboloid(radius=1.0), medium, mass=2.0)
    >>> print(round(low**2, 6), high)
    7.092196 inf
    """
    check_pair(profile, medium, "a pair of capture speeds")
    mass = check.positive("mass", mass, unit="kg")
    if medium.work_of_adhesion == 0:
        return check.frozen(np.zeros(np.shape(mass))), check.frozen(np.full(np.shape(mass), np.inf))
    d_c, (start, energy) = medium.critical_depth, touching(profile, medium, 0.0)

    def rebound(upper):
        return rebound_energy(profile, medium, loaded_interval(profile, medium, upper)[0])

    known = min(float(np.min(profile.known_depth)), check.LONGEST)
    scales = [float(start.upper)]
    if d_c < np.inf:
        # The imprint holds a body when Δl(c) is about d_c.
        radius = medium.E_star * d_c**2 / (2 * np.pi * medium.work_of_adhesion)
        scales += [d_c, float(profile.reduced_at(np.asarray(min(radius, profile.known_radius))))]
    spaced = np.geomspace(1e-6, 1e6, 601)
    upper = np.unique(np.concatenate([scale * spaced for scale in scales if scale < np.inf]))
    upper = start.upper + upper[start.upper + upper <= known]
    bounces = rebound(upper) > 0
    change = np.flatnonzero(bounces[1:] != bounces[:-1])
    between = upper[change], upper[change + 1]
    low, _ = change_between(lambda upper: rebound(upper) > 0, *between, bounces[change])
    speed = np.sqrt(2 * np.maximum(_loading(profile, medium, low, 0.0)[0] - energy, 0.0))
    ends = np.array([np.nan, np.nan])
    if bounces.any():
        ends[:] = (0.0 if bounces[0] else speed[0]), (np.inf if bounces[-1] else speed[-1])
    low, high = (end * np.sqrt(2 * medium.E_star / mass) for end in ends)
    return check.frozen(low), check.frozen(high)
