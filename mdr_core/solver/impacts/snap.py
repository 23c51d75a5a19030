"""Whether a contact snaps on a support: where its force falls faster with depth than the support gives way.

On loading the body goes by S dd with S = 1 + F′/K. Where the force falls after the onset of yield, as with
a hardness f_c/a², S may be 0: there the depth jumps at a fixed place of the body, and energy is lost that
is in no term of the balance, which would close over the jump.
"""

import numpy as np

from ...base import check

#: Places between the onset of yield and the turning point at which S is looked at, and grids by which the
#: first one below 0 is closed in, or else the smallest one.
_PLACES = 65
_GRIDS = 5


def depth_before_snap(rule, imprint, interval, increase, energy, support_compliance, structure):
    """Penetrations (m) up to which the contact does not snap; impacts that reach them are refused.

    `interval` and `increase` (m) are those without a support, which are deeper, `energy` the kinetic energy
    over 2E* (m³), `support_compliance` 2E*/K (1/m). Infinite where it does not snap.
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
        shares = np.linspace(0, 1, _PLACES)
        fall = stiffness * np.reshape(
            1 - displacement_slope(start + (end - start) * shares**3).min(axis=1), shape
        )
        bound = (
            f"is no more than the {fall[snaps].flat[0]:.6g} N/m by which the force falls with depth after "
            "the onset of yield: the contact snaps, and the energy that it loses is not computed"
        )
        advice = "give a stiffer support, less speed, or a hardness without f_c"
        check.raise_if("stiffness", stiffness, snaps, bound, unit="N/m", advice=advice)
    return np.reshape(y, shape)


def snap(rule, imprint, end, support_compliance):
    """Penetrations (m) just before a contact snaps, infinite if not up to `end`; S, and the onsets (m)."""
    start = np.minimum(rule.penetration(imprint, imprint), end)

    def displacement_slope(y):
        """S at penetrations (m)."""
        return 1 + support_compliance * rule.loading_stiffness_radius(*rule.loading(y, imprint))

    # Just before it: at the very place the work has no slope.
    return (1 - 1e-9) * _first_snap(displacement_slope, start, end), displacement_slope, start


def _first_snap(displacement_slope, start, end):
    """Penetration (m) between `start` and `end` (N, 1) at which S is 0 first; infinite if nowhere."""
    rows = np.arange(len(start))
    low, high = np.zeros_like(start), np.ones_like(start)
    share = np.linspace(0, 1, _PLACES)
    for _ in range(_GRIDS):
        # Of third power: next to the onset S changes as a root of the distance.
        places = low + (high - low) * share
        value = displacement_slope(start + (end - start) * places**3)
        negative = value <= 0
        snapped = negative.any(axis=1)
        first = np.where(snapped, negative.argmax(axis=1), value.argmin(axis=1))
        below = np.maximum(first - 1, 0)
        above = np.where(snapped, first, np.minimum(first + 1, _PLACES - 1))
        low, high = places[rows, below, None], places[rows, above, None]
    return np.where(snapped[:, None], start + (end - start) * high**3, np.inf)
