"""Snap of a contact on a support: its force falls with depth faster than the stiffness of the support.

On loading the body moves by S dd with S = 1 + F′/K. If the force falls after the onset of yield, as with a
hardness f_c/a², S may reach 0. Then the depth jumps at a fixed position of the body. The jump loses energy,
but no term of the energy balance includes this loss.
"""

import numpy as np

from ...base import check

#: Places between the onset of yield and the turning point at which S is evaluated, and number of grids that
#: enclose the first place with S ≤ 0, or else the place of the smallest S.
_PLACES = 65
_GRIDS = 5


def depth_before_snap(rule, imprint, interval, increase, energy, support_compliance, structure):
    """Return penetrations (m) up to which the contact does not snap; raise an error if impacts reach them.

    `interval` and `increase` (m) are those of the deeper impact without a support. `energy` is the kinetic
    energy over 2E* (m³), and `support_compliance` is 2E*/K (1/m). Without a snap the result is infinite.
    """
    if not rule.may_fall(interval.upper):
        return np.inf
    shape = energy.shape
    rule = rule.flat_entries(slice(None), shape).entries((slice(None), None), (energy.size,))
    columns = (
        np.broadcast_to(each, shape).reshape(-1, 1) for each in (imprint, support_compliance, energy)
    )
    imprint, support_compliance, energy = columns
    stiffness = np.broadcast_to(structure.stiffness, shape)
    end = (interval.length + increase).reshape(-1, 1)
    end = np.minimum(end, rule.profile.known_depth - imprint)
    y, displacement_slope, start = snap(rule, imprint, end, support_compliance)
    snaps = np.reshape(
        (y < np.inf) & (rule.work(np.minimum(y, end), imprint, support_compliance)[0] <= energy), shape
    )
    if np.any(snaps):
        # The steepest fall on the way to the depth that the impact has without a support.
        _, smallest = _first_at_most(-np.inf, displacement_slope, start, end)
        fall = stiffness * np.reshape(1 - smallest, shape)
        bound = (
            f"must exceed {fall[snaps].flat[0]:.6g} N/m, the slope at which the force falls after the "
            "onset of yield: below it the contact snaps, with an energy loss that is not computed"
        )
        advice = "give a stiffer support, less speed, or a hardness without f_c"
        check.raise_if("stiffness", stiffness, snaps, bound, unit="N/m", advice=advice)
    return np.reshape(y, shape)


def snap(rule, imprint, end, support_compliance):
    """Return penetrations (m) just before a snap, infinite if none up to `end`; S; and the onsets (m)."""
    start = np.minimum(rule.penetration(imprint, imprint), end)

    def displacement_slope(y):
        """Return S at penetrations (m)."""
        return 1 + support_compliance * rule.loading_stiffness_radius(*rule.loading(y, imprint))

    y, value = _first_at_most(0.0, displacement_slope, start, end)
    # Just before the snap: at the snap itself the work has no slope.
    return np.where(value <= 0, (1 - 1e-9) * y, np.inf), displacement_slope, start


def _first_at_most(bound, displacement_slope, start, end):
    """Return the first penetration (m) with S ≤ bound between `start` and `end` (N, 1), and S there.

    If there is none, return the penetration of the smallest S and this S.
    """
    rows = np.arange(len(start))
    low, high = np.zeros_like(start), np.ones_like(start)
    share = np.linspace(0, 1, _PLACES)
    for _ in range(_GRIDS):
        # A third power, because S changes as a root of the distance next to the onset.
        places = low + (high - low) * share
        y = start + (end - start) * places**3
        value = displacement_slope(y)
        reached = value <= bound
        found = reached.any(axis=1)
        first = np.where(found, reached.argmax(axis=1), value.argmin(axis=1))
        below = np.maximum(first - 1, 0)
        above = np.where(found, first, np.minimum(first + 1, _PLACES - 1))
        low, high = places[rows, below, None], places[rows, above, None]
    return y[rows, first, None], value[rows, first, None]
