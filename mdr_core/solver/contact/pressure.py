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
    """Starts of the pieces of a state above d_p (m); radii and increments (m) of their flat punches."""
    ends = (np.atleast_1d(end) for end in (interval.lower, interval.upper, interval.length))
    _, _, start, stop, offset = pieces(profile, *ends)
    node, weight = nodes(start, stop, offset, tanh_sinh())
    return start, profile.radius_at(interval.lower + node), weight


def pressure_integral(profile, interval, r):
    """∫ ds/√(a(s)² − r²) over a(s) > r in the live interval (dimensionless), at radii r ≥ 0 (m).

    Of one state. Infinite where the contact pressure is: at the rim of a flat face, and under a sharp tip
    as long as the medium has not yielded there.
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
    # Next to a kink the rounding of r counts; between other pieces they overlap a little.
    kink = np.isclose(
        depth[:, None], [0.0, interval.lower, interval.upper, *profile.kinks], rtol=1e-9, atol=0.0
    ).any(axis=1)
    starts = np.where(kink, edges, np.maximum(edges * (1 - 1e-3), np.append(0.0, edges[:-1])))
    for rows in chunks(r.size, 1024):
        result[rows] = _pressure(profile, radius, weight, edges, starts, r[rows])
    result[(r == edges[-1]) & (r == profile.wall)] = np.inf
    return result


def _pressure(profile, radius, weight, edges, starts, r):
    """`pressure_integral` at radii r, from the punches of all pieces and the edges of the pieces (m)."""
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
    # On the axis the pressure of the piece at the tip is infinite, and so is that of its flat punches.
    total[(r == 0) & (own >= 0) & (own < len(radius))] = np.inf
    rows = np.flatnonzero((r > 0) & (own >= 0) & (own < len(radius)))
    if rows.size:
        total[rows] += _pressure_from(profile, r[rows], edges[own[rows] + 1])
    return total


def _pressure_from(profile, r, end):
    """∫ g′(x) dx/√(x² − r²) from r > 0 to `end` (m), with x = r cosh λ; infinite where g′(r) is.

    In λ the integrand is not singular, however close r is to a kink below it, to `end` or to 0.
    """
    node, weight = tanh_sinh()
    width = log1p_ratio(end - r + root(end, r), r)[:, None]
    angle = width * node
    x = np.exp(angle + np.log(r / 2)[:, None]) * (1 + np.exp(-2 * angle))
    # Not below r, and not on a kink at the end, where g′ is the slope on its other side.
    x = np.clip(x, r[:, None], np.nextafter(end, 0.0)[:, None])
    integral = (width * weight * profile.reduced_slope_at(x)).sum(axis=1)
    return np.where(np.isinf(profile.reduced_slope_at(r)), np.inf, integral)


def largest_pressure(state):
    """Largest contact pressure (Pa) of one state; 0 without contact.

    Within the plastic zone, and under a flat face, it is largest at one of both ends: its slope times
    (a² − r²)^(3/2)/r grows with r, also with the line load of adhesion. Outside it falls towards the rim,
    or rises before where g′(x)/x grows.
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
        # At c the radius itself has too few digits.
        return np.where(share > 0, state.pressure(inner + (a - inner) * share), at_inner)

    # With four grids the best place is known to 10⁻⁴ of the width, and the pressure to rounding.
    return max(ends, at_inner, largest_value(pressure, np.zeros((1, 1)), np.ones((1, 1)), grids=4)[0])


def _between_vertices(profile, inner, a, c):
    """Radii (m) at which the pressure of a polygon is looked at, in a contact up to `a` (m).

    At vertices and on the axis of a sharp tip it is infinite. These are the middles of the facets outside
    of c or of a flat face, c itself, and the axis of a face.
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
    """Contact pressure (Pa) at the radius c of the plastic zone.

    a(s) − c is free of the rounding of both radii: on its inner side the pressure has a vertical tangent.
    """
    profile, interval, c = state.profile, state.live_interval, state.plastic_radius
    ends = (np.atleast_1d(end) for end in (interval.lower, interval.upper, interval.length))
    _, _, start, stop, offset = pieces(profile, *ends)
    # Squared, the first node is 10⁻⁴¹: the integrand begins as 1/√s.
    node, weight = tanh_sinh()
    node, weight = nodes(start, stop, offset, (node * node, 2 * node * weight))
    # The last length is that of the whole contact, for the line load of adhesion.
    lengths = np.append(node, interval.length)
    weight = np.append(weight, state.uniform_load / state.medium.E_star)
    drop = integrals(profile).radius_difference(LiveInterval.above(interval.lower, lengths))
    return state.medium.E_star / np.pi * (weight @ (1 / np.sqrt(drop * (2 * c + drop))))


def displacement_integral(profile, interval, r):
    """∫ h(r, a(s)) ds over the live interval (m), for one state and radii r ≥ 0 (m).

    h is the surface displacement of a flat punch of radius a per unit of its indentation: 1 for
    r < a and (2/π) arcsin(a/r) outside.
    """
    if interval.length == 0:
        return np.zeros_like(r)
    a, c = (profile.radius_at(np.asarray(end)) for end in (interval.upper, interval.lower))
    inside = r < a
    result = np.full_like(r, interval.length)
    # Under the indenter this displacement and the imprint add up to d − z(r).
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
