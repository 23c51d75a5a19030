"""Fronts of contact and of yield inside an element: corrections to the sum over whole elements.

A front is a radius at which contact or yield ends. At a contact front the line load jumps by 4ηḋ, at a
yield front it has a kink. On a virgin surface the contact front is the contact radius; on a relaxing one it
is where the gap between indenter and surface closes, extrapolated from the gaps of the free elements.

Everything is on one side of the axis. Radii x (m) are counted from the axis, those of the elements are
their midpoints, and `width` (m) is the length of an element; `load` is the line load q (N/m) at the
midpoints, 0 out of contact, and corrections are ∫ q dx minus the sum Σ q Δx over elements (N). Elements
have numbers from the axis outward: 0 is the one without width on the axis itself.
"""

import numpy as np


def force_and_radius(foundation):
    """Force (N) including the fronts, and outer radius (m) of the contact, 0 without contact."""
    contact, load = foundation._elements.contact, foundation._load
    total = float(load @ foundation._elements.width) + _yield_correction(foundation, load)
    radius = 0.0
    for i in np.flatnonzero(contact[1:] != contact[:-1]).tolist():
        # The element in contact next to the front, and the direction of the free one.
        last, step = (i, 1) if contact[i] else (i + 1, -1)
        radius = _contact_front(foundation, load, last, step)
        ring = _narrow_ring(foundation, load, last, radius) if step > 0 else None
        total += _contact_correction(foundation, load, last, step, radius) if ring is None else ring
    if contact[-1]:
        radius = min(foundation.half_width, _virgin_radius(foundation, foundation.depth))
    return 2 * total, radius


def _virgin_radius(foundation, depth):
    """Contact radius (m) at a depth on a virgin surface."""
    return float(foundation.profile.radius_at(np.asarray(max(depth, 0.0))))


def _yield_correction(foundation, load):
    """∫ q dx over the element with the yield front, minus that of its midpoint (N).

    The load is constant inside the front and falls linearly outside it, with the `slope` from the two
    elements outside the `last` one with a plastic part. The line reaches the load of that one at the
    `kink`; the part of the element between the kink and its nearer edge, of a `length`, is a triangle that
    the midpoint misses.
    """
    elements, x, width = foundation._elements, foundation._elements.x, foundation._elements.width
    last = int(np.count_nonzero(elements.plastic)) - 1
    if not 0 < last < len(x) - 3 or not elements.contact[last + 3]:
        return 0.0
    near, far = load[last] - load[last + 1], load[last] - load[last + 2]
    if not 0 < near < far:
        return 0.0
    slope = (far - near) / (x[last + 2] - x[last + 1])
    kink = x[last + 1] - near / slope
    i = last + int(kink > x[last] + width[last] / 2)
    length = width[i] / 2 - abs(kink - x[i])
    return -slope * max(length, 0.0) ** 2 / 2


def _narrow_ring(foundation, load, last, front):
    """Correction (N) where yield ends within three elements of a virgin contact front, else None.

    There are too few elements for a slope. The load is constant up to the `kink`, the radius at which
    g = d − u_c, and falls linearly from there to that of the dashpots, E* τḋ, at the `front`; the sum over
    elements from the edge of the last one that yielded on gives way to the integral of this.
    """
    elements, x, width = foundation._elements, foundation._elements.x, foundation._elements.width
    yielded = int(np.count_nonzero(elements.plastic)) - 1
    virgin = elements.elastic[last + 1] == 0 == elements.plastic[last + 1]
    lag, limit = foundation._current.lag, foundation._limit
    capped = lag >= 0 and elements.elastic[yielded] == limit
    if not (0 < yielded <= last < yielded + 3 and capped and virgin):
        return None
    edge = float(x[yielded] - width[yielded] / 2)
    kink = _virgin_radius(foundation, foundation.depth - limit)
    if not edge <= kink <= front:
        return None
    rim = foundation.medium.E_star * lag
    exact = load[yielded] * (kink - edge) + (load[yielded] + rim) / 2 * (front - kink)
    return exact - float(load[yielded : last + 1] @ width[yielded : last + 1])


def _contact_correction(foundation, load, last, step, front):
    """∫ q dx (N) from the edge of the last element in contact to the front, negative if that is inside.

    `step` is 1 where the contact lies inside the front, −1 where it lies outside, as around a released
    centre. The load is extrapolated from the last two elements in contact to the middle of the piece.
    """
    inner, x = last - step, foundation._elements.x
    edge = float(x[last] + step * foundation._elements.width[last] / 2)
    slope = 0.0
    if 0 <= inner < len(load) and foundation._elements.contact[inner]:
        slope = (load[last] - load[inner]) / (x[last] - x[inner])
    elif inner < 0 and front > 0:
        # Only the axis is in contact: the load falls to that of the dashpots at the front.
        slope = (foundation.medium.E_star * max(foundation._current.lag, 0.0) - load[last]) / front
    middle = float(load[last] + slope * ((front + edge) / 2 - x[last]))
    return step * (front - edge) * middle


def _contact_front(foundation, load, last, step):
    """Radius (m) of the front between the element `last` in contact and its free neighbour.

    On a virgin surface the contact radius; at release where the line through the last two loads is zero;
    else where the line through the gaps of the first two free elements is zero. Always between the two
    midpoints, and halfway if none of these is.
    """
    elements, x = foundation._elements, foundation._elements.x
    free, inner, outer = last + step, last - step, last + 2 * step
    lower, upper = sorted((float(x[last]), float(x[free])))
    if step > 0 and elements.elastic[free] == 0 and elements.plastic[free] == 0:
        return min(max(_virgin_radius(foundation, foundation.depth), lower), upper)
    if foundation._current.lag < 0 and 0 <= inner < len(x) and load[inner] > load[last]:
        # At release the load is zero.
        front = x[last] + load[last] * (x[last] - x[inner]) / (load[inner] - load[last])
        if lower <= front <= upper:
            return float(front)
    gap = elements.elastic - elements.penetration
    front = (lower + upper) / 2
    if 0 <= outer < len(x) and gap[outer] > gap[free] and np.isfinite(gap[outer]):
        front = float(x[free] - gap[free] * (x[outer] - x[free]) / (gap[outer] - gap[free]))
    return min(max(front, lower), upper)
