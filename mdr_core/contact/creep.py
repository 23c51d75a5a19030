"""Viscous indentation under a prescribed force in time: creep.

Three solvers answer. Without viscosity the path is that of `indent_to_force`. With it the scalar laws of
`creep_law` hold up to the first time at which the force rises after the indenter has receded; from
there on `chain_creep` follows every element, from the state that the scalar laws have reached.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy

from .. import _check
from .._check import ArrayLike
from ..foundation.depth_path import Ramps, TimedIndentation
from ..foundation.force_path import Start, chain_creep, check_creep
from ..medium import Medium
from ..numerics.results import CLOSED_FORM, CREEP_LAW, Model
from ..profiles.profile import Profile
from ..profiles.shape_check import check_shape
from .creep_law import Loading, Retreat
from .integrals import integrals, tabulated
from .live_interval import LiveInterval
from .loading import indent_to_force
from .yielding import yield_rule

#: Number of runs of the scalar laws, each a hundred times as precise as the one before, and the first.
_RUNS, _PRECISION = 4, 1e-1
#: Smallest error that is said: that of the rounding of radii and integrals.
_ROUNDING = 1e-12
_ENDS = ("lower", "upper", "length")


@_check.keywords_explained
def creep(
    profile: Profile, medium: Medium, force: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-4
) -> TimedIndentation:
    """Press an indenter into a viscous medium along a path of force in time, under which it creeps.

    While the indenter goes deeper, and while it recedes afterwards, its depth obeys a scalar law: closed
    as long as nothing yields, else solved by an integrator of SciPy. This covers a force that is ramped,
    held and taken away, in milliseconds. Where the force rises again before, released elements may come
    into contact while they relax: from there on the chain goes on, in seconds. `result.model` is "scalar
    ODE", or "chain" where the chain was needed, and without viscosity "closed form".

    Parameters
    ----------
    profile, medium
        The indenter and the medium, of hardness H + q_c/a.
    force : array_like, shape (N,)
        Forces (N), not negative, linear in between; the first one is applied infinitely slowly.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Largest error of the depth, relative to the largest depth.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimated `error`. On the chain contact radius and
        fields are those of a foundation that follows the extrapolated depths and carries the force.

    Raises
    ------
    ValueError
        If a force is negative or not finite, or needs more than the known depth of the profile; if the
        first one, or without viscosity any, is as large as the π b² σ_c(b) at which a whole flat face
        yields (Popov 2015, Eq. (11)); if times do not increase; with adhesion, or with f_c above 0, with
        which the force may fall by itself.

    Examples
    --------
    A flat punch under a force that increases for a time τ and is then constant for as long,
    d = F/(2E*b) (1 − (e − 1)/e²):

    >>> from mdr_core import Cone, FlatPunch, Medium, creep
    >>> medium = Medium(E_star=1.0, eta=0.25)
    >>> state = creep(FlatPunch(1.0), medium, [0.0, 2.0, 2.0], [0.0, 1.0, 2.0])
    >>> print(round(float(state.depth[-1]), 9))
    0.767455842

    A cone of slope s on a medium of constant hardness H: d² relaxes with the time τ/(κ(2 − κ)), where
    κ = H/(E* s); here to 1/(κ(2 − κ)) = 4/3 of that without yield:

    >>> state = creep(Cone(1.0), Medium(1.0, hardness=0.5, eta=0.25), [0.0, 1.0, 1.0], [0.0, 1e-6, 1e3])
    >>> print(round(float(state.depth[-1] ** 2 * 2 / 3.141592653589793), 6))
    1.333333
    """
    force, time, tolerance = check_creep(profile, medium, force, time, tolerance)
    if medium.eta == 0:
        return _without_viscosity(profile, medium, force, time)
    path, count, error = _by_scalar_laws(profile, medium, force, time, tolerance)
    first = path.states(time[:count], force[:count], error)
    if count == len(time):
        return first
    later = chain_creep(
        profile, medium, force[count - 1 :], time[count - 1 :], tolerance=tolerance, start=path.last
    )
    check_shape(profile, later.depth)
    return _joined(first, later, force, time)


@dataclass(frozen=True, eq=False)
class ScalarPath:
    """States by the scalar laws, arrays of one entry each; the `History` of a `TimedIndentation`.

    Live intervals, the lead e = d − D (m) over the edge of the contact, τḋ (m), energies (J), and the
    `Retreat`, if there is one, whose last states are the last ones of the path.
    """

    profile: Profile
    medium: Medium
    interval: LiveInterval
    lead: np.ndarray
    lag: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray
    retreat: Retreat | None = None

    @property
    def model(self) -> Model:
        """Name of the model."""
        return CREEP_LAW if self.medium.eta > 0 else CLOSED_FORM

    @property
    def depth(self):
        """Depth d (m)."""
        return self.interval.upper + self.lead

    def elements(self, x, count):
        """Line load (N/m) and elastic compression (m) at x (m) in the first states, shape (count, M)."""
        columns = np.array([
            self.interval.upper, self.interval.length, self.lead, self.lag,
        ])[:, :count, None]  # fmt: skip
        edge, length, lead, lag = columns
        height = np.asarray(self.profile.reduced(x))
        springs = np.clip(edge - height, 0.0, length)
        contact = height < edge
        elastic = np.where(contact, springs + lead, self._released(height)[:count])
        # The dashpots of a retreating contact take the lead off.
        load = np.where(contact, springs + np.maximum(lag, 0.0), 0.0)
        return self.medium.E_star * load, elastic

    def _released(self, height):
        """Compressions (m) of released elements of reduced heights (m) in all states."""
        result = np.zeros((len(self.lead), height.size))
        if self.retreat is not None:
            later = self.retreat.released(height)
            # The turning point need not be at one of the times.
            result[len(result) - len(later) + 1 :] = later[1:]
        return result

    def states(self, time, force, error):
        """The `TimedIndentation` of this path."""
        edge = np.asarray(self.interval.upper)
        radius = np.where(force > 0, self.profile.radius_at(edge), 0.0)
        return TimedIndentation(
            self.profile, self.medium, time, self.depth, force, radius,
            stored_energy=self.stored_energy, plastic_work=self.plastic_work,
            viscous_work=self.viscous_work, plastic_depth=self.interval.lower, error=error,
            _index=np.arange(len(time)), _history=self,
        )  # fmt: skip

    @property
    def last(self):
        """The last state, for the chain to go on from."""
        return Start(
            depth=float(self.depth[-1]),
            largest=float(self.retreat.interval.upper),
            plastic_depth=float(self.interval.lower[-1]),
            edge=float(self.interval.upper[-1]),
            elastic=lambda x: self.elements(x, len(self.lead))[1][-1],
            plastic_work=float(self.plastic_work[-1]),
            viscous_work=float(self.viscous_work[-1]),
        )


@dataclass(frozen=True, eq=False)
class _Joined:
    """A path by the scalar laws up to the first state of one on the chain."""

    first: ScalarPath
    later: Ramps

    model = property(lambda self: self.later.model)

    def elements(self, x, count):
        """Line load (N/m) and elastic compression (m) at x (m) in the first states, shape (count, M)."""
        before = len(self.first.lead)
        parts = [self.first.elements(x, min(count, before))]
        if count > before:
            parts.append([values[1:] for values in self.later.elements(x, count - before + 1)])
        return tuple(np.concatenate(values) for values in zip(*parts, strict=True))


def _joined(first, later, force, time):
    """`TimedIndentation` of a part by the scalar laws and one by the chain, from its last state on."""
    count = len(first.time)
    names = ("depth", "contact_radius", "stored_energy", "plastic_work", "viscous_work", "plastic_depth")
    values = {name: np.append(getattr(first, name), getattr(later, name)[1:]) for name in names}
    return TimedIndentation(
        first.profile, first.medium, time=time, force=force, **values, error=first.error + later.error,
        _index=np.append(np.arange(count), count - 1 + later._index[1:]),
        _history=_Joined(first._history, later._history),
    )  # fmt: skip


def _without_viscosity(profile, medium, force, time):
    """`TimedIndentation` of a path on a medium without dashpots, on which times do not matter."""
    slow = indent_to_force(profile, medium, force)
    none = np.zeros_like(force)
    energies = slow.stored_energy, slow.plastic_work, none
    path = ScalarPath(profile, medium, slow.live_interval, none, none, *energies)
    return path.states(time, force, _ROUNDING)


def _by_scalar_laws(profile, medium, force, time, tolerance):
    """The `ScalarPath` of the times that the scalar laws cover, their number, the error of the depth."""
    rule, area = yield_rule(profile, medium), force / (2 * medium.E_star)
    onset, ds = float(rule.onset()), np.diff(time) / medium.relaxation_time
    first, bound = _first_and_bound(profile, medium, rule, force, ds)
    rule = replace(rule, profile=tabulated(profile, bound))
    depth, error = None, np.inf
    for level in range(_RUNS):
        precision = max(_PRECISION * min(tolerance, 1e-2) / 100**level, _ROUNDING)
        law = Loading(rule, area, ds, bound, onset, precision)
        pressed = law.solve(first)
        _refuse_unknown(profile, pressed, force)
        retreat = _retreat(law, pressed, 12 * (1 + level)) if pressed.turned else None
        coarse, depth = depth, pressed.depth
        if retreat is not None:
            depth = np.append(depth, retreat.depth[1:])
        if level:
            count = min(depth.size, coarse.size)
            change = np.abs(depth[:count] - coarse[:count]).max()
            error = max(change / max(np.max(depth), _check.SHORTEST), _ROUNDING)
        if error <= tolerance:
            break
    path = _pressed_states(profile, medium, law, pressed)
    if retreat is not None:
        path = _retreating(path, law, pressed, retreat)
    return path, len(path.lead), float(error)


def _first_and_bound(profile, medium, rule, force, ds):
    """First depth (m), and one (m) that is not exceeded.

    By the springs alone, as of an infinitely slow path, and by the dashpots alone.
    """
    slow = replace(medium, eta=0.0)
    first = float(indent_to_force(profile, slow, force[0]).depth)
    modulus, largest = 2 * medium.E_star, np.max(force)
    by_springs = np.inf
    if largest < modulus * rule.wall_integral() and largest <= _force_at(profile, rule) * modulus:
        by_springs = float(indent_to_force(profile, slow, largest).depth)
    guess = max(first, min(by_springs, profile.known_depth, 1.0))
    law = Loading(rule, force, ds, guess, onset=0.0, precision=1.0)
    y = law.elastic(first)[0] + scipy.integrate.trapezoid(force, np.append(0.0, np.cumsum(ds))) / modulus
    by_dashpots = float(law.depth_of(y))
    bound = min(by_springs, by_dashpots, profile.known_depth, _check.LONGEST)
    return first, max(bound, first) or _check.SHORTEST


def _force_at(profile, rule):
    """F/(2E*) (m²) on a first loading to the known depth."""
    if profile.known_depth == np.inf:
        return np.inf
    interval, _ = rule.loading(np.asarray(profile.known_depth))
    return float(integrals(profile).radius_integral(interval))


def _refuse_unknown(profile, pressed, force):
    """Refuses forces that press deeper than the profile is known."""
    known = pressed.depth <= min(profile.known_depth, _check.LONGEST)
    known[-1] &= not pressed.turned or pressed.turning_depth <= profile.known_depth
    bound = f"presses {profile.too_deep()}"
    _check.refuse("force", force[: known.size], ~known, bound, unit="N", remedy="press less")
    check_shape(profile, pressed.depth)


def _pressed_states(profile, medium, law, pressed):
    """`ScalarPath` of a growing depth."""
    rule, modulus, f = law.rule, 2 * medium.E_star, law.area[: pressed.depth.size]
    interval, _ = rule.loading(pressed.depth)
    area, radius = law.pressed(pressed.depth)
    with np.errstate(divide="ignore", invalid="ignore"):
        lag = np.where(radius > 0, np.maximum(f - area, 0.0) / radius, 0.0)
    stored = integrals(rule.profile).energy_integral(interval)
    plastic = rule.plastic_integral(np.zeros_like(interval.lower), interval.lower)
    viscous = _lost(pressed.depth, f, pressed.moment, stored + plastic)
    return ScalarPath(
        profile, medium, interval, np.zeros_like(lag), lag,
        modulus * stored, modulus * plastic, modulus * viscous,
    )  # fmt: skip


def _lost(depth, area, moment, energy):
    """Work of the dashpots over 2E* (m³): that of the force less the `energy` stored and taken by yielding.

    ∫ f dd is f d − ∫ d df; the first state is reached infinitely slowly.
    """
    work = area * depth - area[0] * depth[0] - moment
    return np.maximum.accumulate(np.maximum(work - (energy - energy[0]), 0.0))


def _retreat(law, pressed, count):
    """The `Retreat` from a turning point up to the time from which on the force rises."""
    interval, _ = law.rule.loading(np.asarray(pressed.turning_depth))
    largest = integrals(law.rule.profile).radius_integral(interval)
    # The first time after the turning point; the force falls up to there.
    first = len(pressed.depth)
    rises = np.flatnonzero(np.diff(law.area[first:]) > 0)
    stop = first + 1 + int(rises[0]) if rises.size else len(law.area)
    area = np.append(largest, np.minimum(law.area[first:stop], largest))
    whole = law.ds[first - 1]
    ds = np.append(max(whole - pressed.age, 1e-12 * whole), law.ds[first : stop - 1])
    return Retreat(law.rule, interval, area, ds, count)


def _retreating(before, law, pressed, retreat):
    """`ScalarPath` that goes on from the states `before` a turning point."""
    rule, modulus, interval = law.rule, 2 * before.medium.E_star, retreat.interval
    lead, remainder, work = retreat.states[:, 1:]
    held = LiveInterval.above(interval.lower, retreat.length[1:])
    stored = integrals(rule.profile).energy_integral(held) + lead * retreat.area[1:] + remainder / 2
    taken = float(rule.plastic_integral(np.zeros_like(interval.lower), interval.lower))
    energy = float(integrals(rule.profile).energy_integral(interval)) + taken
    at_turn = _lost(
        np.append(before.depth, pressed.turning_depth),
        np.append(law.area[: pressed.depth.size], retreat.area[0]),
        np.append(pressed.moment, pressed.turning_moment),
        np.append((before.stored_energy + before.plastic_work) / modulus, energy),
    )[-1]
    ends = (np.append(getattr(before.interval, end), getattr(held, end)) for end in _ENDS)
    return replace(
        before,
        interval=LiveInterval(*ends),
        lead=np.append(before.lead, lead),
        lag=np.append(before.lag, -lead),
        stored_energy=np.append(before.stored_energy, modulus * stored),
        plastic_work=np.append(before.plastic_work, np.full(len(lead), modulus * taken)),
        viscous_work=np.append(before.viscous_work, modulus * (at_turn + work)),
        retreat=retreat,
    )
