"""How deep a force or a body can press a chain: stopped by springs and caps, or dashpots, alone."""

import numpy as np

from .. import _check
from .._numeric import increasing_root


def reach(profile, medium, quantity, amount, above=0.0):
    """The depth (m) at which a virgin chain has taken an amount of a quantity beyond `above`, and 5 % more.

    The quantity is "work" (J) or "force" (N) of springs and caps, or "momentum" (N s) of dashpots. As deep
    as the shape is known, if that is less. Good to a few parts in a hundred, from 64 equal elements:
    springs and caps take ∫F dd = 2E* ∫ (u_e²/2 + d_c u_p) dx, dashpots 8η ∫ a dd = 8η ∫ u dx.
    """
    d_c = medium.critical_depth

    def taken(depth):
        """The quantity at a depth, and its derivative by it."""
        radius = profile.contact_radius(depth)
        width = radius / 64
        u = np.maximum(depth - profile.reduced((np.arange(64) + 0.5) * width), 0.0)
        if quantity == "momentum":
            return 8 * medium.eta * width * np.sum(u), 8 * medium.eta * radius
        elastic, modulus = np.minimum(u, d_c), 2 * medium.E_star * width
        force = modulus * np.sum(elastic)
        # u_e²/2 + d_c u_p, with u_e = d_c wherever u_p > 0.
        work = modulus * (elastic @ (u - elastic / 2))
        return (work, force) if quantity == "work" else (force, modulus * np.count_nonzero(u < d_c))

    if quantity == "momentum" and medium.eta == 0:
        return profile.known_depth
    deepest = min(profile.known_depth, _check.LARGEST)
    start = max(min(d_c, deepest, 1.0), above)
    before = taken(above)[0] if above > 0 else 0.0
    depth = increasing_root(taken, before + amount, start, deepest)
    return min(1.05 * float(depth), profile.known_depth)
