"""How deep a force or a body can press a chain: stopped by springs and caps, or dashpots, alone."""

from typing import NamedTuple

import numpy as np


class Resistance(NamedTuple):
    """What a virgin chain opposes to being pressed to some depth.

    `work` (J) and `force` (N) of springs and caps, and `momentum` (N·s) that the dashpots take.
    """

    work: float
    force: float
    momentum: float


def resistance(profile, medium, depth):
    """The `Resistance` up to a depth (m), within a few parts in a hundred: 64 equal elements.

    Springs and caps take ∫F dd = 2E* ∫ (u_e²/2 + d_c u_p) dx, dashpots 8η ∫ a dd = 8η ∫ u dx.
    """
    if depth <= 0:
        return Resistance(0.0, 0.0, 0.0)
    width = profile.contact_radius(depth) / 64
    u = np.maximum(depth - profile.reduced((np.arange(64) + 0.5) * width), 0.0)
    elastic = np.minimum(u, medium.critical_depth)
    # u_e²/2 + d_c u_p, with u_e = d_c wherever u_p > 0.
    work = 2 * medium.E_star * width * float(elastic @ (u - elastic / 2))
    force = 2 * medium.E_star * width * float(np.sum(elastic))
    return Resistance(work, force, 8 * medium.eta * width * float(np.sum(u)))


def least_depth(profile, medium, stops, above=0.0):
    """The least depth (m) beyond `above` at which stops(resistance) is true, rounded up by up to 10 %.

    As deep as the shape is known, if nothing stops it before.
    """

    def stopped(depth):
        return stops(resistance(profile, medium, depth))

    high = max(min(medium.critical_depth, profile.deepest, 1.0), above)
    while high > above and stopped(high) and high > 1e-120:
        high /= 16
    high = max(high, above)
    while not stopped(high):
        if high >= profile.deepest or high > 1e120:
            return min(high, profile.deepest)
        high *= 16
    low = max(high / 16, above)
    high = min(high, profile.deepest)
    while high > 1.05 * low:
        middle = np.sqrt(low * high)
        low, high = (low, middle) if stopped(middle) else (middle, high)
    # The margin covers the 64 elements.
    return min(1.05 * high, profile.deepest)
