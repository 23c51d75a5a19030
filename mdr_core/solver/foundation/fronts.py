"""Fronts of contact and of yield inside an element: corrections to the sum over whole elements.

A front is a radius at which contact or yield ends. At a contact front the line load jumps by 4ηḋ, at a
yield front it has a kink. On a virgin surface the contact front is the contact radius. On a relaxing
surface the gap between indenter and surface closes there; it is extrapolated from the gaps of the free
elements.

Everything is on one side of the axis. Radii (m) are counted from the axis, and the load is the line load
q (N/m). Corrections are ∫ q dx minus the sum Σ q Δx over elements (N).
"""

from typing import NamedTuple

import numpy as np


class _Side(NamedTuple):
    """Data of a `Row` for the fronts: arrays with one entry per element, numbered from the axis outward.

    Element 0 is on the axis itself and has the width 0.
    """

    #: Radii of the midpoints and widths (m).
    x: np.ndarray
    width: np.ndarray
    #: q (N/m) at the midpoints, 0 out of contact, and whether the element is in contact.
    load: np.ndarray
    contact: np.ndarray
    #: Elastic and plastic part (m) of the compression, and depth (m) of the indenter below the surface of
    #: the relaxed element, negative above it.
    elastic: np.ndarray
    plastic: np.ndarray
    penetration: np.ndarray
    #: Load of the dashpots E* τḋ (N/m), negative on unloading.
    dashpot_load: float

    @classmethod
    def of(cls, row):
        """Return the data of a `Row` in its present state."""
        elements, load = row.elements, row.line_load
        parts = elements.elastic, elements.plastic, elements.penetration
        dashpot_load = row.medium.E_star * row.lag
        return cls(elements.x, elements.width, load, elements.contact, *parts, dashpot_load)

    def last_yielded(self):
        """Return the number of the outermost element with a plastic part, or −1."""
        return int(np.count_nonzero(self.plastic)) - 1

    def virgin(self, number):
        """Whether an element has neither an elastic nor a plastic part of the compression."""
        return self.elastic[number] == 0 and self.plastic[number] == 0


class _Boundary(NamedTuple):
    """A boundary between an element in contact and a free neighbour, by the numbers of the elements."""

    #: The element in contact.
    last: int
    #: 1 if the contact ends outward, −1 if it ends towards the axis, for example around a released centre.
    step: int

    @property
    def free(self):
        """The free neighbour."""
        return self.last + self.step

    @property
    def second_free(self):
        """The element after the free neighbour; it may not exist, or not be free."""
        return self.last + 2 * self.step

    @property
    def second_last(self):
        """The element before the last element in contact; it may not exist, or not be in contact."""
        return self.last - self.step

    @classmethod
    def all(cls, contact):
        """Return all boundaries, from the axis outward."""
        changes = np.flatnonzero(contact[1:] != contact[:-1]).tolist()
        return [cls(i, 1) if contact[i] else cls(i + 1, -1) for i in changes]


def force_and_radius(row):
    """Return the force (N) including the fronts, and the outer radius (m) of the contact or 0."""
    side = _Side.of(row)
    total = float(side.load @ side.width) + _yield_correction(side)
    radius = 0.0
    for boundary in _Boundary.all(side.contact):
        radius = _contact_front(row, side, boundary)
        ring = _narrow_ring(row, side, boundary, radius)
        total += _contact_correction(side, boundary, radius) if ring is None else ring
    if side.contact[-1]:
        radius = min(row.half_width, _virgin_radius(row, row.depth))
    return 2 * total, radius


def _virgin_radius(row, depth):
    """Return the contact radius (m) at a depth on a virgin surface."""
    return float(row.profile.radius_at(np.asarray(max(depth, 0.0))))


def _yield_correction(side):
    """Return the correction (N) for the element in which yield ends; 0 if it is not known.

    The load is constant inside the front. Outside, it falls on a straight line through the first two
    elements that have not yielded. The `kink` is the radius at which this line reaches the load of the last
    yielded element. It lies in the last yielded element or in the next element, between the midpoint and an
    edge. From the kink to this edge, the load is below the load at the midpoint by a triangle.
    """
    x, load = side.x, side.load
    yielded = side.last_yielded()
    first, second = yielded + 1, yielded + 2
    if not 0 < yielded < len(x) - 3 or not side.contact[yielded + 3]:
        return 0.0
    fall_to_first = load[yielded] - load[first]
    fall_to_second = load[yielded] - load[second]
    if not 0 < fall_to_first < fall_to_second:
        return 0.0
    slope = (fall_to_second - fall_to_first) / (x[second] - x[first])
    kink = x[first] - fall_to_first / slope
    outer_edge = x[yielded] + side.width[yielded] / 2
    own = first if kink > outer_edge else yielded
    length = max(side.width[own] / 2 - abs(kink - x[own]), 0.0)
    return -slope * length**2 / 2


def _narrow_ring(row, side, boundary, front):
    """Return the correction (N) if yield ends within three elements of a virgin contact front, else None.

    There are too few elements for the slope of the load. The load is constant up to the `kink`, the radius
    at which g = d − u_c. From there it falls linearly to the load of the dashpots at the `front`. Its
    integral from the inner edge of the last yielded element to the front replaces the sum.
    """
    yielded, last = side.last_yielded(), boundary.last
    if boundary.step < 0 or not 0 < yielded <= last < yielded + 3 or not side.virgin(boundary.free):
        return None
    limit = row.elastic_limit
    if side.dashpot_load < 0 or side.elastic[yielded] != limit:
        return None
    edge = float(side.x[yielded] - side.width[yielded] / 2)
    kink = _virgin_radius(row, row.depth - limit)
    if not edge <= kink <= front:
        return None
    plateau = side.load[yielded]
    exact = plateau * (kink - edge) + (plateau + side.dashpot_load) / 2 * (front - kink)
    ring = slice(yielded, last + 1)
    return exact - float(side.load[ring] @ side.width[ring])


def _contact_correction(side, boundary, front):
    """Return ∫ q dx (N) from the edge of the last element in contact to the front.

    It is negative if the front is inside this element. The load is extrapolated to the middle of this piece
    from the last two elements in contact.
    """
    x, load = side.x, side.load
    last, second = boundary.last, boundary.second_last
    edge = float(x[last] + boundary.step * side.width[last] / 2)
    slope = 0.0
    if 0 <= second < len(load) and side.contact[second]:
        slope = (load[last] - load[second]) / (x[last] - x[second])
    elif second < 0 and front > 0:
        # Only the axis is in contact: the load falls to the load of the dashpots at the front.
        slope = (max(side.dashpot_load, 0.0) - load[last]) / front
    middle = float(load[last] + slope * ((front + edge) / 2 - x[last]))
    return boundary.step * (front - edge) * middle


def _contact_front(row, side, boundary):
    """Return the radius (m) of the front between the last element in contact and its free neighbour.

    On a virgin surface it is the contact radius. At release it is the zero of the line through the last two
    loads, else the zero of the line through the gaps of the first two free elements. It is always between
    the two midpoints, and halfway if neither zero is.
    """
    last, free = boundary.last, boundary.free
    lower, upper = sorted((float(side.x[last]), float(side.x[free])))
    if boundary.step > 0 and side.virgin(free):
        return min(max(_virgin_radius(row, row.depth), lower), upper)
    if side.dashpot_load < 0:
        front = _zero(side.x, side.load, last, boundary.second_last)
        if front is not None and lower <= front <= upper:
            return front
    gap = side.elastic - side.penetration
    front = _zero(side.x, gap, free, boundary.second_free)
    return (lower + upper) / 2 if front is None else min(max(front, lower), upper)


def _zero(x, values, near, far):
    """Return the radius (m) at which the line through the values of two elements is zero.

    It is None if there is no far element, or if its value is not larger than the value of the near element.
    """
    if not 0 <= far < len(x) or not values[near] < values[far] < np.inf:
        return None
    return float(x[near] - values[near] * (x[far] - x[near]) / (values[far] - values[near]))
