"""Where contact or yield ends inside an element of a chain: what the sum over whole elements leaves out.

A front of contact is a jump of the line load by 4ηḋ. Between two elements of which one is in
contact, it stands where the indenter just touches: on a virgin surface at the contact radius
itself, on a relaxing one where the gap, taken straight from the elements not yet met, closes. A
front of yield is a kink.
"""

import numpy as np


def force_and_radius(row):
    """Force (N) of a chain with what its fronts add, and outermost radius (m) in contact, 0 without any."""
    contact, load = row._elements.contact, row._load
    total, radius = float(load @ row._width) + _beyond_kink(row, load), 0.0
    for inner in np.flatnonzero(contact[1:] != contact[:-1]).tolist():
        met, step = (inner, 1) if contact[inner] else (inner + 1, -1)
        radius = _front(row, load, met, step)
        ring = _thin_ring(row, load, met, radius) if step > 0 else None
        total += _beyond_edge(row, load, met, step, radius) if ring is None else ring
    if contact[-1]:
        radius = min(row.half_width, _touched(row))
    return 2 * total, radius


def _touched(row):
    """Contact radius (m) at the present depth on a virgin surface."""
    return float(row.profile._radius(np.asarray(max(row.depth, 0.0))))


def _beyond_kink(row, load):
    """What the load of the element in which yield ends lacks (N), because it is not straight there."""
    state, x = row._elements, row._middle
    last = int(np.count_nonzero(state.plastic)) - 1
    if not 0 < last < len(x) - 3 or not state.contact[last + 3]:
        return 0.0
    yielded = load[last]
    one, two = yielded - load[last + 1], yielded - load[last + 2]
    if not 0 < one < two:
        return 0.0
    slope = (two - one) / (x[last + 2] - x[last + 1])
    kink = x[last + 1] - one / slope
    inside = last + int(kink > x[last] + row._width[last] / 2)
    short = row._width[inside] / 2 - abs(kink - x[inside])
    return -slope * max(short, 0.0) ** 2 / 2


def _thin_ring(row, load, met, front):
    """What elements lack (N) while yield follows the front on a virgin surface within three of them."""
    state, x, width = row._elements, row._middle, row._width
    last, critical = int(np.count_nonzero(state.plastic)) - 1, row.medium.critical_depth
    virgin = state.elastic[met + 1] == 0 == state.plastic[met + 1]
    if not (0 < last <= met < last + 3 and row._lag >= 0 and state.elastic[last] == critical and virgin):
        return None
    edge = float(x[last] - width[last] / 2)
    kink = float(row.profile._radius(np.asarray(row.depth - critical)))
    if not edge <= kink <= front:
        return None
    rim = row.medium.E_star * row._lag
    exact = load[last] * (kink - edge) + (load[last] + rim) / 2 * (front - kink)
    return exact - float(load[last : met + 1] @ width[last : met + 1])


def _beyond_edge(row, load, met, step, front):
    """Load (N) between the outer edge of the element `met` and the front."""
    back, x = met - step, row._middle
    edge = float(x[met] + step * row._width[met] / 2)
    slope = 0.0
    if 0 <= back < len(load) and row._elements.contact[back]:
        slope = (load[met] - load[back]) / (x[met] - x[back])
    elif back < 0 and front > 0:
        # Only the axis is met: down to what the dashpots carry at the front.
        slope = (row.medium.E_star * max(row._lag, 0.0) - load[met]) / front
    # The load is straight from the last element in contact to the front: beyond it the line goes on.
    middle = float(load[met] + slope * ((front + edge) / 2 - x[met]))
    return step * (front - edge) * middle


def _front(row, load, met, step):
    """Place (m) where contact ends between the element `met` and its neighbour on one side."""
    state, x = row._elements, row._middle
    free, back = met + step, met - step
    low, high = sorted((float(x[met]), float(x[free])))
    if step > 0 and state.elastic[free] == 0 and state.plastic[free] == 0:
        return min(max(_touched(row), low), high)
    if row._lag < 0 and 0 <= back < len(x) and load[back] > load[met]:
        # Letting go: the load falls to zero there.
        front = x[met] + load[met] * (x[met] - x[back]) / (load[back] - load[met])
        if low <= front <= high:
            return float(front)
    gap, further = state.elastic - state.above, free + step
    front = (low + high) / 2
    if 0 <= further < len(x) and gap[further] > gap[free] and np.isfinite(gap[further]):
        front = float(x[free] - gap[free] * (x[further] - x[free]) / (gap[further] - gap[free]))
    return min(max(front, low), high)
