"""Indentation along a prescribed path of depth or force, infinitely slowly."""

from itertools import pairwise

import numpy as np

from .. import _check
from .._check import ArrayLike
from ..medium import Medium, check_pair, paths_on
from ..numerics.roots import increasing_root
from ..profiles.profile import Profile
from . import adhesion
from .indentation import Indentation
from .integrals import integrals
from .live_interval import LiveInterval
from .yielding import yield_rule


@_check.keywords_explained
def indent(profile: Profile, medium: Medium, depth: ArrayLike) -> Indentation:
    """Press an indenter along a path of depths: loading, unloading and reloading in any order.

    The path is followed infinitely slowly, so that the dashpots of a viscous medium carry nothing; for a
    path in time see `indent_in_time`.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.
    depth : float or array_like
        Indentation depth d (m), one number or a path along the last axis; negative out of contact, or
        where adhesion holds the contact. Contact begins at d_p, the bottom of the imprint, also on
        reloading, and with adhesion is lost at the pull-off. Each
        row of a larger array is a path of its own on a virgin medium. Parameters of medium and profile may
        be arrays of shape (…, 1), for one path each.

    Returns
    -------
    Indentation
        Quantities of the shape of `depth`, computed when they are first read.

    Raises
    ------
    ValueError
        If a depth is not finite, or larger than the known depth of the profile.

    Examples
    --------
    A cone at twice the critical depth, F = 3 F_c (Popov 2015, Eqs. (20), (22)):

    >>> from mdr_core import Cone, Medium, critical_force
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)
    >>> state = indent(cone, medium, 2 * medium.critical_depth)
    >>> print(round(state.force / critical_force(cone, medium), 12))
    3.0
    """
    check_pair(profile, medium)
    depth = _check.finite_array("depth", depth, unit="m", most=_check.LONGEST)
    depth = profile._known(paths_on(profile, medium, depth))
    if np.any(medium.work_of_adhesion):
        return Indentation(profile, medium, depth, *adhesion.depth_path(profile, medium, depth))
    return Indentation(profile, medium, depth, yield_rule(profile, medium).path(depth))


@_check.keywords_explained
def indent_to_force(profile: Profile, medium: Medium, force: ArrayLike) -> Indentation:
    """Press an indenter along a path of forces, infinitely slowly: the inverse of `indent`.

    For a viscous medium under a force in time see `creep`.

    Parameters
    ----------
    profile, medium
        As for `indent`.
    force : float or array_like
        Normal force (N); one number or a path along the last axis. At 0 the indenter rests on the bottom
        of the imprint. With f_c above 0 the force on loading may fall after the onset of yield: the depth
        is the first one that carries it, and the path jumps there, which is said in `limits`. Negative
        only with adhesion: under more than the pull-off force the contact is lost, the force is 0 and the
        depth that of the imprint, until a force ≥ 0 closes it again.

    Returns
    -------
    Indentation
        Quantities of the shape of `force`.

    Raises
    ------
    ValueError
        If a force is not finite, negative without adhesion, larger than a flat face carries before all of
        it yields (π b² σ_c(b), Popov 2015, Eq. (11)) or than f_c carries alone (π f_c), or presses deeper
        than the known depth of the profile.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=1.0)
    >>> print(round(indent_to_force(cone, medium, indent(cone, medium, 5.0).force).depth, 12))
    5.0
    """
    check_pair(profile, medium, "an indentation")
    adhesive = medium.work_of_adhesion > 0
    if adhesive:
        force = _check.finite_array("force", force, unit="N", most=_check.LONGEST)
    else:
        force = _check.force("force", force)
    rule = yield_rule(profile, medium)
    limit = 2 * medium.E_star * rule.wall_integral()
    carrier = "the whole flat face yields" if profile.wall < np.inf else "all of the contact yields, π f_c"
    bound = f"must be less than the {limit:g} N at which {carrier}"
    _check.refuse("force", force, force >= limit, bound, unit="N", remedy="press to a depth instead")
    if adhesive:
        return Indentation(profile, medium, *adhesion.force_path(profile, medium, force))
    integral = force / (2 * medium.E_star)
    largest = np.maximum.accumulate(integral, axis=-1) if integral.ndim else integral
    branches = _growing_branches(rule)
    largest_depth = _loading_depth(rule, branches, largest)
    known = largest_depth <= min(profile.known_depth, _check.LONGEST)
    bound = f"presses {profile._too_deep()}"
    _check.refuse("force", force, ~known, bound, unit="N", remedy="press less")
    loaded, _ = rule.loading(largest_depth)
    length = np.where(integral == largest, loaded.length, _live_length(profile, loaded, integral))
    depth = np.where(integral == largest, largest_depth, loaded.lower + length)
    end = np.max(largest_depth, initial=0.0)
    jumps = tuple((one[1], other[0]) for one, other in pairwise(branches) if other[0] < end)
    return Indentation(profile, medium, depth, LiveInterval(loaded.lower, depth, length), jumps=jumps)


def _loading_depth(rule, branches, area):
    """The first depth (m) at which a first loading has ∫ a ds = `area` (m²), elementwise."""
    onset, result = rule.onset(), np.full(area.shape, np.inf)
    for low, high, least in branches:

        def loading(depth, low=low, least=least):
            interval, _ = rule.loading(depth)
            width = rule.yielding_width(interval)
            slope = np.where(interval.lower > 0, width, rule.profile._radius(depth))
            value = integrals(rule.profile).radius_integral(interval)
            # Shallower than the branch a straight line, which stays below what was not reached before.
            rate = least / max(low, 1e-300)
            return np.where(depth < low, rate * depth, value), np.where(depth < low, rate, slope)

        start = np.clip(onset if 0 < onset < np.inf else 1.0, low, high)
        depth = increasing_root(loading, area, start, high)
        # On the line no depth carries the force.
        result = np.where(depth >= low, np.minimum(result, depth), result)
    return result


def _growing_branches(rule):
    """Depths (m) between which the force of a first loading grows, and ∫ a ds (m²) at the first of them.

    With f_c above 0 the force may fall after the onset of yield.
    """
    end, onset = rule.profile.known_depth, float(rule.onset())
    branches = [(0.0, end, 0.0)]
    if not rule.falls or not onset < end:
        return branches

    @np.errstate(all="ignore")
    def growing(depth):
        interval, _ = rule.loading(depth)
        # Where the force goes to π f_c only the rounding of the radii is left of its slope.
        return rule.yielding_width(interval) >= -1e-14 * rule.profile._radius(interval.upper)

    depth = onset * (1 + np.geomspace(1e-9, 1e9, 721))
    depth = np.append(onset, np.append(depth[depth < end], end if end < np.inf else []))
    grows = growing(depth)
    # The elastic branch ends at the onset.
    grows[0] = True
    for i in np.flatnonzero(grows[1:] != grows[:-1]):
        low, high = depth[i], depth[i + 1]
        while high - low > 4e-16 * high and low < (middle := (low + high) / 2) < high:
            low, high = (middle, high) if growing(middle) == grows[i] else (low, middle)
        if grows[i]:
            branches[-1] = (branches[-1][0], low, branches[-1][2])
        else:
            least = integrals(rule.profile).radius_integral(rule.loading(high)[0])
            branches.append((high, end, float(least)))
    return branches


def _live_length(profile, largest, area):
    """Live depth (m) at which unloading from the live interval `largest` has ∫ a ds = `area` (m²)."""

    def unloading(length):
        interval = LiveInterval.above(largest.lower, np.minimum(length, largest.length))
        return integrals(profile).radius_integral(interval), profile._radius(interval.upper)

    limit = np.where(largest.length > 0, largest.length, 1.0)
    return np.minimum(increasing_root(unloading, area, limit, limit), largest.length)
