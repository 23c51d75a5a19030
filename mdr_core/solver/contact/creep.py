"""Viscous indentation under a prescribed force in time: creep.

There are three solvers. Without viscosity, `indent_to_force` gives the path. With viscosity, the scalar
laws hold: `creep_loading` while the indenter goes deeper, and `creep_retreat` while it recedes afterwards.
When the force rises again, `chain_creep` follows every element from the last state of the scalar laws.
"""

from dataclasses import replace

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ..applicability import check_shape
from ..foundation.depth_path import TimedIndentation, joined
from ..foundation.force_path import chain_creep, check_creep
from ..medium.medium import Medium
from ..numerics.stable import trapezoid
from ..profiles.profile import Profile
from .creep_loading import Loading
from .creep_retreat import Retreat
from .creep_states import ScalarPath, pressed_states, retreating_states
from .integrals import integrals, tabulated
from .loading import indent_to_force
from .yielding import yield_rule

#: Largest number of runs of the scalar laws, each a hundred times as precise as the previous run.
_RUNS = 4
#: Precision of the integrator in the first run, over the tolerance.
_PRECISION = 0.1
#: Smallest reported error, the rounding of radii and integrals.
_ROUNDING = 1e-12


@check.keywords_explained
def creep(
    profile: Profile, medium: Medium, force: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-4
) -> TimedIndentation:
    """Press an indenter into a viscous medium under a prescribed force in time.

    While the indenter goes deeper, and while it recedes afterwards, its depth obeys a scalar law. The law
    has a closed form as long as nothing yields, else SciPy integrates it. This solves a force that is
    ramped, held and removed, in milliseconds. If the force rises again earlier, released elements may come
    into contact while they relax; then the chain continues, in seconds. `result.model` is "scalar ODE",
    "chain" if the chain was needed, or "closed form" without viscosity.

    Parameters
    ----------
    profile, medium
        The indenter and the medium, of hardness H + q_c/a.
    force : array_like, shape (N,)
        Forces (N), not negative, linear between times. The first force is applied quasi-statically.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Largest error of the depth, relative to the largest depth.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimated `error`. On the chain, contact radius and
        fields are taken from a foundation that follows the extrapolated depths and carries the force.

    Raises
    ------
    ValueError
        If a force is negative or not finite, or needs more than the known depth of the profile. If times do
        not increase. If the first force reaches π b² σ_c(b), at which a whole flat face yields (Popov 2015,
        Eq. (11)); without viscosity, this holds for any force. With adhesion, or with f_c above 0, which
        may make the force fall on loading.

    Examples
    --------
    A flat punch under a force that increases for a time τ and is then constant for another τ,
    d = F/(2E*b) (1 − (e − 1)/e²):

    >>> from mdr_core import Cone, FlatPunch, Medium, creep
    >>> medium = Medium(E_star=1.0, eta=0.25)
    >>> state = creep(FlatPunch(1.0), medium, [0.0, 2.0, 2.0], [0.0, 1.0, 2.0])
    >>> print(round(float(state.depth[-1]), 9))
    0.767455842

    A cone of slope s on a medium of constant hardness H: d² relaxes with the time τ/(κ(2 − κ)), where
    κ = H/(E* s); here to 1/(κ(2 − κ)) = 4/3 of its value without yield:

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
    return joined(first, later, force, time)


def _without_viscosity(profile, medium, force, time):
    """Return the `TimedIndentation` of a path on a medium without dashpots; times do not matter there."""
    slow = indent_to_force(profile, medium, force)
    none = np.zeros_like(force)
    energies = slow.stored_energy, slow.plastic_work, none
    path = ScalarPath(profile, medium, slow.live_interval, none, none, *energies)
    return path.states(time, force, _ROUNDING)


def _by_scalar_laws(profile, medium, force, time, tolerance):
    """Return the `ScalarPath` of the times covered by the scalar laws, their number, the depth error."""
    rule, area = yield_rule(profile, medium), force / (2 * medium.E_star)
    onset, ds = float(rule.onset()), np.diff(time) / medium.relaxation_time
    first, bound = _first_and_bound(profile, medium, rule, force, ds)
    rule = replace(rule, profile=tabulated(profile, bound))
    # The error is the change of the depth by a run that is a hundred times as precise.
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
            error = max(change / max(np.max(depth), check.SHORTEST), _ROUNDING)
        if error <= tolerance:
            break
    path = pressed_states(profile, medium, law, pressed)
    if retreat is not None:
        path = retreating_states(path, law, pressed, retreat)
    return path, len(path.depth_excess), float(error)


def _first_and_bound(profile, medium, rule, force, ds):
    """Return the first depth (m), and an upper bound of all depths (m).

    The bound follows from the springs alone, as on an infinitely slow path, or from the dashpots alone.
    """
    slow = replace(medium, eta=0.0)
    first = float(indent_to_force(profile, slow, force[0]).depth)
    modulus, largest = 2 * medium.E_star, np.max(force)
    by_springs = np.inf
    if largest < modulus * rule.wall_integral() and largest <= _force_at(profile, rule) * modulus:
        by_springs = float(indent_to_force(profile, slow, largest).depth)
    guess = max(first, min(by_springs, profile.known_depth, 1.0))
    law = Loading(rule, force, ds, guess, onset=0.0, precision=1.0)
    y = law.elastic(first)[0] + trapezoid(force, np.append(0.0, np.cumsum(ds))) / modulus
    by_dashpots = float(law.depth_of(y))
    bound = min(by_springs, by_dashpots, profile.known_depth, check.LONGEST)
    return first, max(bound, first) or check.SHORTEST


def _force_at(profile, rule):
    """Return F/(2E*) (m²) on a first loading to the known depth."""
    if profile.known_depth == np.inf:
        return np.inf
    interval, _ = rule.loading(np.asarray(profile.known_depth))
    return float(integrals(profile).radius_integral(interval))


def _refuse_unknown(profile, pressed, force):
    """Raise an error for forces that press deeper than the known depth of the profile."""
    known = pressed.depth <= min(profile.known_depth, check.LONGEST)
    known[-1] &= not pressed.turned or pressed.turning_depth <= profile.known_depth
    bound = f"presses {profile.too_deep()}"
    check.raise_if("force", force[: known.size], ~known, bound, unit="N", advice="press less")
    check_shape(profile, pressed.depth)


def _retreat(law, pressed, count):
    """Return the `Retreat` from a turning point up to the time at which the force begins to rise."""
    interval, _ = law.rule.loading(np.asarray(pressed.turning_depth))
    largest = integrals(law.rule.profile).radius_integral(interval)
    # The first time after the turning point; up to this time the force falls.
    first = len(pressed.depth)
    rises = np.flatnonzero(np.diff(law.area[first:]) > 0)
    stop = first + 1 + int(rises[0]) if rises.size else len(law.area)
    area = np.append(largest, np.minimum(law.area[first:stop], largest))
    whole = law.ds[first - 1]
    ds = np.append(max(whole - pressed.age, 1e-12 * whole), law.ds[first : stop - 1])
    return Retreat(law.rule, interval, area, ds, count)
