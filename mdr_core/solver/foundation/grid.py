"""Grid of a foundation: its extent, and the edges between its elements.

With an edge at every kink and jump of the line load, sums over the elements are of second order.
"""

import numpy as np

from ...base import check
from ..numerics.roots import increasing_root
from .cap import elastic_limit


def cell_edges(profile, count, half_width, nodes=()):
    """Return the edges (m) of `count` elements from 0 to `half_width`, also at kinks and nodes."""
    fixed = _fixed_edges(profile, half_width, nodes)
    share = np.diff(fixed) / half_width
    if len(share) > count:
        raise check.MDRError(
            f"n = {2 * count} elements are too few for the {len(share)} intervals between axis, kinks of "
            f"the profile and nodes on each side; give at least n = {2 * len(share)}"
        )
    # Half of the elements by length, half equally: the interval just outside a flat face is short.
    share = (share + 1 / len(share)) / 2
    # One element per interval; the numbers of the others are rounded so that the sum is right.
    extra = np.diff(np.floor((count - len(share)) * np.append(0, np.cumsum(share)) + 0.5).astype(int))
    extra[-1] += count - len(share) - extra.sum()
    power = _grading(profile, fixed)
    edges = []
    for i, n in enumerate(1 + extra):
        edges.append(fixed[i] + (fixed[i + 1] - fixed[i]) * (np.arange(n) / n) ** power[i])
    return np.concatenate([*edges, [half_width]])


def _fixed_edges(profile, half_width, nodes):
    """Return the distinct radii (m) of axis, flat face, kinks, wall, nodes and half-width."""
    # At depth 0 the contact radius is the radius of the flat face.
    own = profile.contact_radius(np.array([0.0, *profile.kinks]))
    radii = np.concatenate([own, [profile.wall], np.asarray(nodes, dtype=float)])
    radii = np.unique(radii[(radii > 0) & (radii < half_width * (1 - 1e-12))])
    distinct = np.diff(radii, prepend=0.0) > 1e-12 * half_width
    return np.concatenate([[0.0], radii[distinct], [half_width]])


def _grading(profile, fixed):
    """Return the power p of the edges ξ^p within each interval, 1 for equal elements.

    If g rises as (x − lower)^n with n < 1, p = 3/(1 + n) makes h³ g″ the same for all elements.
    """
    lower, length = fixed[:-1], np.diff(fixed)
    base, near, far = profile.reduced(lower + length * np.array([[0.0], [2.0**-20], [2.0**-19]]))
    with np.errstate(divide="ignore", invalid="ignore"):
        exponent = np.log2((far - base) / (near - base))
    return np.where((exponent > 0) & (exponent < 0.99), 3 / (1 + exponent), 1.0)


def depth_bound(profile, medium, quantity, amount, start=0.0):
    """Return the depth (m), plus 5 %, at which a quantity has grown by an amount since the depth `start`.

    The quantity is "force" (N) or "work" (J) of the springs, ∫F dd = 2E* ∫ (u_e²/2 + d_c u_p) dx, or
    "momentum" (N s) of the dashpots, 8η ∫ a dd = 8η ∫ u dx. The depth is at most the known depth.
    """
    if quantity == "work" and not medium.inverse_to_radius:
        return _depth_of_work(profile, medium, amount, start)
    limit = elastic_limit(profile, medium, start)

    def taken_up(depth):
        """Return the quantity at a depth, and its approximate derivative."""
        radius = profile.contact_radius(depth)
        limit = elastic_limit(profile, medium, max(depth, start))
        width = radius / 64
        u = np.maximum(depth - profile.reduced((np.arange(64) + 0.5) * width), 0.0)
        if quantity == "momentum":
            return 8 * medium.eta * width * np.sum(u), 8 * medium.eta * radius
        elastic, stiffness = np.minimum(u, limit), 2 * medium.E_star * width
        force = stiffness * np.sum(elastic)
        if quantity == "force":
            return force, stiffness * np.count_nonzero(u < limit)
        # u_e²/2 + d_c u_p, with u_e = d_c wherever u_p > 0.
        return stiffness * (elastic @ (u - elastic / 2)), force

    if quantity == "momentum" and medium.eta == 0:
        return profile.known_depth
    known = min(profile.known_depth, check.LONGEST)
    target = amount + (taken_up(start)[0] if start > 0 else 0.0)
    # The elastic limit of a sharp tip on a medium of constant hardness starts from 0.
    guess = min(limit if limit > 0 else 1.0, known, 1.0)
    depth = increasing_root(taken_up, target, max(guess, start), known)
    return min(1.05 * float(depth), profile.known_depth)


def _depth_of_work(profile, medium, amount, start):
    """Return `depth_bound` of a work (J) if the elastic limit changes with depth: a sum of forces."""
    share = (np.arange(64) + 0.5) / 64

    def work(end):
        depth = start + (end - start) * share[:, None]
        radius = profile.contact_radius(depth)
        u = np.maximum(depth - profile.reduced(share * radius), 0.0)
        springs = np.minimum(u, elastic_limit(profile, medium, depth))
        return 2 * medium.E_star * np.mean(springs * radius) * (end - start)

    low, high = start, min(max(2 * start, check.SHORTEST), profile.known_depth)
    while work(high) < amount and high < min(profile.known_depth, check.LONGEST):
        low, high = high, min(2 * high, profile.known_depth)
    for _ in range(6):
        middle = (low + high) / 2
        low, high = (middle, high) if work(middle) < amount else (low, middle)
    return min(1.05 * high, profile.known_depth)
