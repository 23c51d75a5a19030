"""Indentation along a prescribed path of depth or force, infinitely slowly."""

import numpy as np

from . import _check, adhesion
from ._check import ArrayLike
from ._numeric import increasing_root
from .indentation import Indentation
from .integrals import integrals
from .live_interval import LiveInterval
from .medium import Medium, check_pair, paths_on
from .shapes.profile import Profile
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
        of the imprint. Negative only with adhesion: under more than the pull-off force the contact is
        lost, the force is 0 and the depth that of the imprint, until a force ≥ 0 closes it again.

    Returns
    -------
    Indentation
        Quantities of the shape of `force`.

    Raises
    ------
    ValueError
        If a force is not finite, negative without adhesion, larger than a flat face carries before all of
        it yields (π q_c b, Popov 2015, Eq. (11)), or presses deeper than the known depth of the profile.

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
    bound = f"must be less than the {limit:g} N at which the whole flat face yields"
    _check.refuse("force", force, force >= limit, bound, unit="N", remedy="press to a depth instead")
    if adhesive:
        return Indentation(profile, medium, *adhesion.force_path(profile, medium, force))
    integral = force / (2 * medium.E_star)
    largest = np.maximum.accumulate(integral, axis=-1) if integral.ndim else integral
    largest_depth = _loading_depth(rule, largest)
    known = largest_depth <= min(profile.known_depth, _check.LONGEST)
    bound = f"presses {profile._too_deep()}"
    _check.refuse("force", force, ~known, bound, unit="N", remedy="press less")
    loaded, _ = rule.loading(largest_depth)
    length = np.where(integral == largest, loaded.length, _live_length(profile, loaded, integral))
    depth = np.where(integral == largest, largest_depth, loaded.lower + length)
    return Indentation(profile, medium, depth, LiveInterval(loaded.lower, depth, length))


def _loading_depth(rule, area):
    """Depth (m) at which a first loading has ∫ a ds = `area` (m²), elementwise."""

    def loading(depth):
        interval, _ = rule.loading(depth)
        width = rule.yielding_width(interval)
        slope = np.where(interval.lower > 0, width, rule.profile._radius(depth))
        return integrals(rule.profile).radius_integral(interval), slope

    onset = rule.onset()
    return increasing_root(loading, area, onset if onset < np.inf else 1.0, rule.profile.known_depth)


def _live_length(profile, largest, area):
    """Live depth (m) at which unloading from the live interval `largest` has ∫ a ds = `area` (m²)."""

    def unloading(length):
        interval = LiveInterval.above(largest.lower, np.minimum(length, largest.length))
        return integrals(profile).radius_integral(interval), profile._radius(interval.upper)

    limit = np.where(largest.length > 0, largest.length, 1.0)
    return np.minimum(increasing_root(unloading, area, limit, limit), largest.length)
