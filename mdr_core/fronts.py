"""Where contact ends inside an element of a chain: what the sum over whole elements leaves out.

A front of contact is a jump of the line load by 4ηḋ. Between two elements of which one is in
contact, it stands where the indenter just touches: on a virgin surface at the contact radius
itself, on a relaxing one where the gap, taken straight from the elements not yet met, closes.
"""

import numpy as np


def beyond_edges(row):
    """Load (N) on one side between the elements' edges and the fronts of contact."""
    state, load = row._elements, row._load
    total = 0.0
    for inner in np.flatnonzero(state.contact[1:] != state.contact[:-1]):
        met, step = (inner, 1) if state.contact[inner] else (inner + 1, -1)
        back = met - step
        edge = row._middle[met] + step * row._width[met] / 2
        slope = 0.0
        if 0 <= back < len(load) and state.contact[back]:
            slope = (load[met] - load[back]) / (row._middle[met] - row._middle[back])
        front = _front(row, met, step)
        # The load is straight from the last element in contact to the front.
        middle = load[met] + slope * ((front + edge) / 2 - row._middle[met])
        total += step * (front - edge) * max(middle, 0.0)
    return total


def edge_of_contact(row):
    """Outermost radius (m) in contact, 0 if there is none."""
    touching = np.flatnonzero(row._elements.contact)
    if not touching.size:
        return 0.0
    last = touching[-1]
    if last == len(row._middle) - 1:
        return min(row.half_width, float(row.profile.contact_radius(max(row.depth, 0.0))))
    return _front(row, last, 1)


def _front(row, met, step):
    """Place (m) where contact ends between the element `met` and its neighbour on one side."""
    state, x = row._elements, row._middle
    free, back = met + step, met - step
    low, high = sorted((x[met], x[free]))
    if state.elastic[free] == 0 and state.plastic[free] == 0 and step > 0:
        return float(np.clip(row.profile.contact_radius(max(row.depth, 0.0)), low, high))
    load = row._load
    if row._lag < 0 and 0 <= back < len(x) and load[back] > load[met]:
        # Letting go: the load falls to zero there.
        front = x[met] + load[met] * (x[met] - x[back]) / (load[back] - load[met])
        if low <= front <= high:
            return float(front)
    gap, further = state.elastic - state.above, free + step
    front = (x[met] + x[free]) / 2
    if 0 <= further < len(x) and gap[further] > gap[free] and np.isfinite(gap[further]):
        front = x[free] - gap[free] * (x[further] - x[free]) / (gap[further] - gap[free])
    return float(np.clip(front, low, high))
