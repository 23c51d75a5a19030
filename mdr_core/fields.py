"""Integrals over the live interval that depend on the radius r, for one state and many radii.

    pressure_integral      ∫ ds/√(a(s)² − r²) over a(s) > r    contact pressure, Popov (2015), Eq. (10)
    displacement_integral  ∫ h(r, a(s)) ds                     surface displacement, residual imprint

Each increment of depth is a flat punch of radius a(s); see `superposition`.
"""

import numpy as np

from ._numeric import chunks, root, tanh_sinh
from .closed_forms import closed_forms, log1p_ratio
from .superposition import nodes, pieces
from .yielding import elastic_interval


def _punches(profile, interval):
    """Where the pieces of a state begin beyond d_p (m); radii and increments (m) of their flat punches."""
    ends = (np.atleast_1d(part) for part in (interval.lower, interval.upper, interval.length))
    _, _, begin, *rest = pieces(profile, *ends)
    beyond, weight = nodes(begin, *rest, tanh_sinh())
    return begin, profile._radius(interval.lower + beyond), weight


def pressure_integral(profile, interval, r):
    """∫ ds/√(a(s)² − r²) over a(s) > r in the live interval (dimensionless), for one state and many r ≥ 0.

    Infinite where the contact pressure is: at the rim of a flat face, and under a sharp tip as
    long as nothing has yielded there.
    """
    forms = closed_forms(profile)
    result = forms and forms.pressure_integral(interval, r)
    if result is not None:
        return result
    result = np.zeros_like(r)
    if interval.length == 0:
        return result
    begin, a, weight = _punches(profile, interval)
    depth = interval.lower + np.append(begin, interval.length)
    edges = profile._radius(depth)
    # Next to a kink the rounding of r counts; a piece that ends without one begins a little before.
    kink = np.isclose(
        depth[:, None], [0.0, interval.lower, interval.upper, *profile.kinks], rtol=1e-9, atol=0.0
    ).any(axis=1)
    begins = np.where(kink, edges, np.maximum(edges * (1 - 1e-3), np.append(0.0, edges[:-1])))
    for rows in chunks(r.size, 1024):
        result[rows] = _pressure(profile, a, weight, edges, begins, r[rows])
    result[(r == edges[-1]) & (r == profile.wall)] = np.inf
    return result


def _pressure(profile, a, weight, edges, begins, r):
    """`pressure_integral` at some radii, from the nodes of all pieces and the radii between them."""
    total = np.zeros_like(r)
    # The piece that a radius lies in, −1 if it lies below all of them.
    own = np.searchsorted(begins, r, side="right") - 1
    with np.errstate(all="ignore"):
        sharp = profile._reduced_slope(np.zeros(1))[0] > 0
        # On the axis a tip that is not sharp has a pressure without a singularity to be kept away from.
        own = np.where((r == 0) & (own == 0) & ~sharp, -1, own)
        for piece in range(len(a)):
            beyond = own < piece
            if beyond.any():
                total[beyond] += (weight[piece] / root(a[piece], r[beyond, None])).sum(axis=1)
        rows = np.flatnonzero((own >= 0) & (own < len(a)))
        if rows.size:
            total[rows] += _pressure_from(profile, r[rows], edges[own[rows] + 1])
    return total


def _pressure_from(profile, r, end):
    """∫ g′(x) dx/√(x² − r²) from r > 0 to `end`, with x = r cosh λ; infinite where g′(r) is.

    In λ nothing is singular, however close r comes to a kink below it, to `end` or to 0.
    """
    node, weight = tanh_sinh()
    width = log1p_ratio(end - r + root(end, r), r)[:, None]
    way = width * node
    x = np.exp(way + np.log(r / 2)[:, None]) * (1 + np.exp(-2 * way))
    # Neither below r nor on a kink at the end itself, where g′ is that of its other side.
    x = np.clip(x, r[:, None], np.nextafter(end, 0.0)[:, None])
    integral = (width * weight * profile._reduced_slope(x)).sum(axis=1)
    return np.where(np.isinf(profile._reduced_slope(r)) | (r == 0), np.inf, integral)


def displacement_integral(profile, interval, r):
    """∫ h(r, a(s)) ds over the live interval (m), for one state and many r ≥ 0.

    h is the surface displacement of a flat punch of radius a per unit of its indentation: 1 for
    r < a and (2/π) arcsin(a/r) outside.
    """
    if interval.length == 0:
        return np.zeros_like(r)
    a, c = (profile._radius(np.asarray(part)) for part in (interval.upper, interval.lower))
    inside = r < a
    result = np.full_like(r, interval.length)
    # Under the indenter the displacements of the whole past add up to d − z(r).
    ring = inside if interval.lower == 0 else inside & (r >= c)
    if ring.any():
        result[ring] = interval.upper - profile._height(r[ring])
        if interval.lower > 0:
            result[ring] -= displacement_integral(profile, elastic_interval(interval.lower), r[ring])
        result[ring] = np.clip(result[ring], 0.0, interval.length)
    if not inside.all():
        _, radii, weight = (part.ravel() for part in _punches(profile, interval))
        outside = r[~inside]
        for rows in chunks(outside.size, 1024):
            outside[rows] = np.arcsin(np.minimum(radii / outside[rows, None], 1.0)) @ weight
        result[~inside] = 2 / np.pi * outside
    return result
