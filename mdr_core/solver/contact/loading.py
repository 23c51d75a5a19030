"""Indentation along a prescribed path of depth or force, infinitely slowly."""

from typing import NamedTuple

import numpy as np

from ...base import check
from ...base.check import ArrayLike
from ..applicability import check_hardness, check_pair, check_reached, check_shape, paths_on
from ..medium.medium import Medium
from ..numerics.roots import change_between, increasing_root
from ..profiles.profile import Profile, check_known
from . import adhesion
from .indentation import Indentation
from .integrals import integrals
from .live_interval import LiveInterval
from .yielding import ConstantCap, yield_rule


@check.keywords_explained
def indent(profile: Profile, medium: Medium, depth: ArrayLike) -> Indentation:
    """Press an indenter along a path of depths: loading, unloading and reloading in any order.

    The path is quasi-static, so that the dashpots of a viscous medium carry no load. For a path in time,
    see `indent_in_time`.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.
    depth : float or array_like
        Indentation depth d (m): one number, or a path along the last axis. It is negative out of contact,
        and may be negative while adhesion holds the contact. Contact begins at the bottom of the imprint,
        d_p, also on reloading; with adhesion it is lost at the pull-off. Each row of a larger array is a
        separate path on a virgin medium. Parameters of medium and profile may have the shape (…, 1), for
        one path each.

    Returns
    -------
    Indentation
        Quantities of the shape of `depth`, computed when they are first read.

    Raises
    ------
    ValueError
        If a depth is not finite or exceeds the known depth of the profile, or if a `HardnessLaw` is invalid
        (negative, jumps) below the reached contact radius.

    Examples
    --------
    A cone at twice the critical depth, F = 3 F_c (Popov 2015, Eqs. (20), (22)):

    >>> from mdr_core import Cone, Medium, yield_force, indent
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)
    >>> state = indent(cone, medium, 2 * medium.critical_depth)
    >>> print(round(state.force / yield_force(cone, medium), 12))
    3.0
    """
    check_pair(profile, medium)
    depth = check.finite_array("depth", depth, unit="m", most=check.LONGEST)
    depth = check_known(profile, paths_on(profile, medium, depth))
    check_reached(profile, medium, depth)
    if np.any(medium.work_of_adhesion):
        return Indentation(profile, medium, depth, *adhesion.depth_path(profile, medium, depth))
    return Indentation(profile, medium, depth, yield_rule(profile, medium).path(depth))


@check.keywords_explained
def indent_to_force(profile: Profile, medium: Medium, force: ArrayLike) -> Indentation:
    """Press an indenter quasi-statically along a path of forces: the inverse of `indent`.

    For a viscous medium under a force in time, see `creep`.

    Parameters
    ----------
    profile, medium
        As for `indent`.
    force : float or array_like
        Normal force (N); one number or a path along the last axis. At 0 the indenter rests on the bottom of
        the imprint. With f_c above 0, or a law of hardness, the force on loading may decrease after the
        onset of yield. The path then jumps to the smallest depth that carries the force, and `limits`
        report the jump. Negative forces need adhesion. Beyond the pull-off force the contact is lost. Then
        the force is 0 and the depth is the depth of the imprint, until a force ≥ 0 closes the contact.

    Returns
    -------
    Indentation
        Quantities of the shape of `force`.

    Raises
    ------
    ValueError
        If a force is not finite, is negative without adhesion, or presses deeper than the known depth of
        the profile. If a force is larger than a flat face carries before all of it yields (π b² σ_c(b),
        Popov 2015, Eq. (11)), or larger than f_c alone carries (π f_c). If a `HardnessLaw` is invalid
        (negative, jumps) below the reached contact radius.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, indent, indent_to_force
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=1.0)
    >>> print(round(indent_to_force(cone, medium, indent(cone, medium, 5.0).force).depth, 12))
    5.0
    """
    check_pair(profile, medium, "an indentation")
    adhesive = medium.work_of_adhesion > 0
    if adhesive:
        force = check.finite_array("force", force, unit="N", most=check.LONGEST)
    else:
        force = check.force("force", force)
    rule = yield_rule(profile, medium)
    limit = 2 * medium.E_star * rule.wall_integral()
    carrier = "the whole flat face yields" if profile.wall < np.inf else "all of the contact yields, π f_c"
    bound = f"must be less than the {limit:g} N at which {carrier}"
    check.raise_if("force", force, force >= limit, bound, unit="N", advice="press to a depth instead")
    if adhesive:
        states = adhesion.force_path(profile, medium, force)
        check_shape(profile, states[1].upper)
        return Indentation(profile, medium, *states)
    # Here and below, A = ∫ a ds over the live interval represents the force.
    area = force / (2 * medium.E_star)
    largest_area = np.maximum.accumulate(area, axis=-1) if area.ndim else area
    elastic_depth = _elastic_depth(profile, largest_area) if medium.has_own_law else None
    check_hardness(profile, medium, elastic_depth)
    branches = _growing_branches(rule, elastic_depth)
    largest_depth = _loading_depth(rule, branches, largest_area)
    _refuse_not_carried(profile, medium, rule, branches, force, largest_depth)
    check_reached(profile, medium, largest_depth)
    loaded, _ = rule.loading(largest_depth)
    on_loading = area == largest_area
    length = np.where(on_loading, loaded.length, live_length(profile, loaded, area))
    depth = np.where(on_loading, largest_depth, loaded.lower + length)
    interval = LiveInterval(loaded.lower, depth, length)
    return Indentation(profile, medium, depth, interval, jumps=branches.jumps(largest_depth))


def _refuse_not_carried(profile, medium, rule, branches, force, depth):
    """Raise an error if a force (N) has a `depth` (m) below the known depth, or if no depth carries it."""
    carried = depth <= min(profile.known_depth, check.LONGEST)
    bound = f"presses {profile.too_deep()}"
    if medium.has_own_law and profile.known_depth == np.inf and not np.all(carried):
        most = 2 * medium.E_star * np.max(_carried(rule, np.minimum(branches.high, check.LONGEST)))
        bound = f"is more than the {most:g} N that the contact carries on loading"
    check.raise_if("force", force, ~carried, bound, unit="N", advice="press less")


class _Branches(NamedTuple):
    """Branches of a first loading with growing force: arrays with one entry per branch, ascending.

    Depths (m) are counted from the undeformed surface, and A = ∫ a ds = F/(2E*) (m²) represents the force.
    Between `high` of one branch and `low` of the next branch the force falls.
    """

    #: Depths (m) at which branches begin and end; the first begins at 0, the last may be infinite.
    low: np.ndarray
    high: np.ndarray
    #: A (m²) at these depths.
    least: np.ndarray
    most: np.ndarray

    def first_with(self, area):
        """Return the number of the first branch that reaches A (m²), elementwise, or the last branch."""
        reached_so_far = np.maximum.accumulate(self.most)
        return np.minimum(np.searchsorted(reached_so_far, area), self.most.size - 1)

    def jumps(self, depth):
        """Return the jumps of loadings to depths (m): pairs of the end and the next beginning (m)."""
        end = np.max(depth, initial=0.0)
        pairs = zip(self.high[:-1].tolist(), self.low[1:].tolist(), strict=True)
        return tuple((before, after) for before, after in pairs if after < end)


def _one_branch(end):
    """Return the `_Branches` of a force that grows up to the depth (m) at which the profile ends."""
    return _Branches(np.array([0.0]), np.array([end]), np.array([0.0]), np.array([np.inf]))


def _loading_depth(rule, branches, area):
    """Find the first depth (m) at which a first loading has A = ∫ a ds = `area` (m²), elementwise.

    It is the root on the first branch that reaches `area`. Newton's method may try depths shallower than
    this branch. There A is replaced by the straight line from 0 to the beginning of the branch. This line
    stays below `area`, because no earlier branch has reached it. dA/ds is a − c dp/ds past the onset of
    yield, and a before it.
    """
    branch = branches.first_with(area)
    low, high, least = branches.low[branch], branches.high[branch], branches.least[branch]
    line_slope = least / np.maximum(low, 1e-300)

    def loading(depth):
        """Return A (m²) and dA/ds (m)."""
        interval, increase = rule.loading(depth)
        value = integrals(rule.profile).radius_integral(interval)
        slope = rule.loading_stiffness_radius(interval, increase)
        shallower = depth < low
        return np.where(shallower, line_slope * depth, value), np.where(shallower, line_slope, slope)

    onset = rule.onset()
    start = np.clip(onset if 0 < onset < np.inf else 1.0, low, high)
    return increasing_root(loading, area, start, high)


def _elastic_depth(profile, area):
    """Return the depth (m) of an elastic loading with ∫ a ds = `area` (m²), the least of any loading."""
    return _loading_depth(ConstantCap(profile, np.inf), _one_branch(profile.known_depth), area)


def _carried(rule, depth):
    """Return ∫ a ds (m²) of first loadings to depths (m)."""
    return integrals(rule.profile).radius_integral(rule.loading(np.asarray(depth))[0])


def _growing_branches(rule, elastic_depth=None):
    """Return the `_Branches` of a first loading.

    With f_c above 0, or a law of hardness, the force may fall after the onset of yield. The sign of its
    slope is computed on a grid of depths, and each change between neighbours is found by bisection. For a
    law of hardness, `elastic_depth` are the depths (m) that elastic loadings reach.
    """
    end, onset = rule.profile.known_depth, float(rule.onset())
    if not onset < end or not rule.may_fall(end):
        return _one_branch(end)

    def grows_at(depth):
        """Whether the force grows with depth at depths (m)."""
        interval, _ = rule.loading(depth)
        # As the force approaches π f_c, its slope is only the rounding of the radii.
        return rule.yielding_stiffness_radius(interval) >= -1e-14 * rule.profile.radius_at(interval.upper)

    depth = _depths_to_ask(onset, end, elastic_depth)
    grows = grows_at(depth)
    # The elastic branch ends at the onset.
    grows[0] = True
    turn = np.flatnonzero(grows[1:] != grows[:-1])
    grew = grows[turn]
    before, after = change_between(grows_at, depth[turn], depth[turn + 1], grew)
    low = np.append(0.0, after[~grew])
    # The last branch goes on to the end, unless the force falls there.
    high = np.append(before[grew], end)[: low.size]
    least = np.where(low > 0, _carried(rule, low), 0.0)
    finite = np.minimum(high, np.finfo(float).max ** 0.25)
    most = np.where(high < np.inf, _carried(rule, finite), np.inf)
    return _Branches(low, high, least, most)


def _depths_to_ask(onset, end, elastic_depth):
    """Return depths (m), ascending, from the onset of yield to the end of the profile, if it is finite.

    They are denser around the depths that elastic loadings reach, because a law of hardness may change
    anywhere. This also holds under a sharp tip that yields from first touch, with the onset 0.
    """
    depth = onset * (1 + np.geomspace(1e-9, 1e9, 721))
    if elastic_depth is not None:
        largest = np.max(elastic_depth, initial=0.0, where=elastic_depth < np.inf)
        far = largest * np.geomspace(1e-6, 1e9, 1201)
        depth = np.union1d(depth[depth > onset], far[far > onset])
    last = [end] if end < np.inf else []
    return np.concatenate([[onset], depth[depth < end], last])


def live_length(profile, largest, area):
    """Return the live depth (m) at which unloading from the interval `largest` has ∫ a ds = `area` (m²)."""

    def unloading(length):
        """Return A (m²) and dA/dℓ (m)."""
        interval = LiveInterval.above(largest.lower, np.minimum(length, largest.length))
        return integrals(profile).radius_integral(interval), profile.radius_at(interval.upper)

    limit = np.where(largest.length > 0, largest.length, 1.0)
    return np.minimum(increasing_root(unloading, area, limit, limit), largest.length)
