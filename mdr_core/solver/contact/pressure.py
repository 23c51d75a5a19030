"""Integrals over the live interval that depend on the radius r, for one state and many radii.

    pressure_integral      ∫ ds/√(a(s)² − r²) over a(s) > r    contact pressure, Popov (2015), Eq. (10)
    largest_pressure       its largest value over r
    displacement_integral  ∫ h(r, a(s)) ds                     surface displacement, residual imprint

Each increment of depth is a flat punch of radius a(s), as in `integrals`.
"""

import numpy as np

from ..numerics.blocks import chunks
from ..numerics.gauss import tanh_sinh
from ..numerics.roots import largest_value
from ..numerics.stable import log1p_ratio, root
from .integrals import integrals
from .live_interval import LiveInterval
from .quadrature import nodes, pieces


def _punches(profile, interval):
    """Return starts of the pieces of a state above d_p (m); radii and increments (m) of their punches."""
    ends = (np.atleast_1d(end) for end in (interval.lower, interval.upper, interval.length))
    _, _, start, stop, offset = pieces(profile, *ends)
    node, weight = nodes(start, stop, offset, tanh_sinh())
    return start, profile.radius_at(interval.lower + node), weight


def pressure_integral(profile, interval, r):
    """Return ∫ ds/√(a(s)² − r²) over a(s) > r in the live interval of one state, at radii r ≥ 0 (m).

    The result is dimensionless. It is infinite at the rim of a flat face, and under a sharp tip if the
    medium has not yielded there.
    """
    result = integrals(profile).pressure_integral(interval, r)
    if result is not None:
        return result
    result = np.zeros_like(r)
    if interval.length == 0:
        return result
    start, radius, weight = _punches(profile, interval)
    depth = interval.lower + np.append(start, interval.length)
    edges = profile.radius_at(depth)
    # Next to a kink the rounding of r matters; other pieces overlap a little.
    kink = np.isclose(
        depth[:, None], [0.0, interval.lower, interval.upper, *profile.kinks], rtol=1e-9, atol=0.0
    ).any(axis=1)
    starts = np.where(kink, edges, np.maximum(edges * (1 - 1e-3), np.append(0.0, edges[:-1])))
    for rows in chunks(r.size, 1024):
        result[rows] = _pressure(profile, radius, weight, edges, starts, r[rows])
    result[(r == edges[-1]) & (r == profile.wall)] = np.inf
    return result


def _pressure(profile, radius, weight, edges, starts, r):
    """Return `pressure_integral` at radii r, from the punches and the edges of all pieces (m)."""
    total = np.zeros_like(r)
    # Number of the piece that contains r, −1 below all of them.
    own = np.searchsorted(starts, r, side="right") - 1
    sharp = profile.reduced_slope_at(np.zeros(1))[0] > 0
    # Under a tip that is not sharp the integrand has no singularity on the axis.
    own = np.where((r == 0) & (own == 0) & ~sharp, -1, own)
    for piece in range(len(radius)):
        rows = own < piece
        if rows.any():
            place = r[rows, None]
            # Next to r ≈ c the radius of the first punches rounds to r, but it is larger.
            outside = np.maximum(radius[piece], np.nextafter(place, np.inf))
            total[rows] += (weight[piece] / root(outside, place)).sum(axis=1)
    # On the axis, both the pressure of the piece at the tip and the pressure of its punches are infinite.
    total[(r == 0) & (own >= 0) & (own < len(radius))] = np.inf
    rows = np.flatnonzero((r > 0) & (own >= 0) & (own < len(radius)))
    if rows.size:
        total[rows] += _pressure_from(profile, r[rows], edges[own[rows] + 1])
    return total


def _pressure_from(profile, r, end):
    """Return ∫ g′(x) dx/√(x² − r²) from r > 0 to `end` (m), with x = r cosh λ; infinite if g′(r) is.

    In λ the integrand is not singular, however close r is to a smaller kink, to `end` or to 0.
    """
    node, weight = tanh_sinh()
    width = log1p_ratio(end - r + root(end, r), r)[:, None]
    angle = width * node
    x = np.exp(angle + np.log(r / 2)[:, None]) * (1 + np.exp(-2 * angle))
    # Not below r, and not on a kink at the end: there g′ is the slope of the other side.
    x = np.clip(x, r[:, None], np.nextafter(end, 0.0)[:, None])
    integral = (width * weight * profile.reduced_slope_at(x)).sum(axis=1)
    return np.where(np.isinf(profile.reduced_slope_at(r)), np.inf, integral)


def largest_pressure(state):
    """Return the largest contact pressure (Pa) of one state; 0 without contact.

    Within the plastic zone, and under a flat face, it is largest at one of both ends: its slope times
    (a² − r²)^(3/2)/r grows with r, also with the line load of adhesion. Outside, it falls towards the rim,
    but if g′(x)/x grows it may rise first.
    """
    profile, a, c = state.profile, state.contact_radius, state.plastic_radius
    if a == 0:
        return 0.0
    if state.uniform_load > 0:
        return np.inf
    inner = max(c, profile.face_radius)
    if profile.polygonal:
        return np.max(state.pressure(_between_vertices(profile, inner, a, c)))
    ends = np.max(state.pressure([0.0, a]))
    if ends == np.inf or inner >= a:
        return ends
    at_inner = _pressure_at_c(state) if c > 0 else state.pressure(inner)

    def pressure(share):
        # At c, a radius has too few digits.
        return np.where(share > 0, state.pressure(inner + (a - inner) * share), at_inner)

    # Four grids give the position to 10⁻⁴ of the width, and the pressure to rounding.
    return max(ends, at_inner, largest_value(pressure, np.zeros((1, 1)), np.ones((1, 1)), grids=4)[0])


def _between_vertices(profile, inner, a, c):
    """Return radii (m) at which to evaluate the pressure of a polygon, in a contact up to `a` (m).

    At vertices and on the axis of a sharp tip it is infinite. The radii are the middles of the facets
    outside c or a flat face, c itself, and the axis of a flat face.
    """
    vertices = np.append(profile.face_radius, profile.radius_at(np.asarray(profile.kinks, dtype=float)))
    middles = (vertices[1:] + vertices[:-1]) / 2
    places = middles[(middles > inner) & (middles < a)].tolist()
    if c > 0:
        places.append(c)
    if profile.face_radius > 0:
        places.append(0.0)
    return np.array(places or [(inner + a) / 2])


def _pressure_at_c(state):
    """Return the contact pressure (Pa) at the radius c of the plastic zone.

    It uses a(s) − c, without the rounding of both radii, because the pressure has a vertical tangent on
    the inner side of c.
    """
    profile, interval, c = state.profile, state.live_interval, state.plastic_radius
    ends = (np.atleast_1d(end) for end in (interval.lower, interval.upper, interval.length))
    _, _, start, stop, offset = pieces(profile, *ends)
    # Squared, the first node is 10⁻⁴¹: the integrand begins as 1/√s.
    node, weight = tanh_sinh()
    node, weight = nodes(start, stop, offset, (node * node, 2 * node * weight))
    # The last length is the whole interval, for the line load of adhesion.
    lengths = np.append(node, interval.length)
    weight = np.append(weight, state.uniform_load / state.medium.E_star)
    drop = integrals(profile).radius_difference(LiveInterval.above(interval.lower, lengths))
    return state.medium.E_star / np.pi * (weight @ (1 / np.sqrt(drop * (2 * c + drop))))


def displacement_integral(profile, interval, r):
    """Return ∫ h(r, a(s)) ds over the live interval (m), for one state and radii r ≥ 0 (m).

    h is the surface displacement of a flat punch of radius a per unit of its indentation: 1 for r < a, and
    (2/π) arcsin(a/r) outside.
    """
    if interval.length == 0:
        return np.zeros_like(r)
    a, c = (profile.radius_at(np.asarray(end)) for end in (interval.upper, interval.lower))
    inside = r < a
    result = np.full_like(r, interval.length)
    # Under the indenter, the sum of this displacement and the imprint is d − z(r).
    ring = inside if interval.lower == 0 else inside & (r >= c)
    if ring.any():
        result[ring] = interval.upper - profile.height_at(r[ring])
        if interval.lower > 0:
            result[ring] -= displacement_integral(profile, LiveInterval.elastic(interval.lower), r[ring])
        result[ring] = np.clip(result[ring], 0.0, interval.length)
    if not inside.all():
        _, radii, weight = (array.ravel() for array in _punches(profile, interval))
        outside = r[~inside]
        for rows in chunks(outside.size, 1024):
            outside[rows] = np.arcsin(np.minimum(radii / outside[rows, None], 1.0)) @ weight
        result[~inside] = 2 / np.pi * outside
    return result
