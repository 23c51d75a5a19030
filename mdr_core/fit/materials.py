"""Bounds of the moduli and hardnesses of materials, beyond which a result is implausible."""

import numpy as np

from ..numerics.remark import Remark, Remedy
from ..show.quantities import engineering

#: Moduli E* (Pa) of materials, from the softest gels to diamond (1.15 TPa), with a margin.
MODULI = 1.0, 2e12
#: Least moduli (Pa) of unloadings that are not asked about: in general, and where more than a share of the
#: largest depth remains, as of plastics, metals and ceramics.
SOFTEST_OF_UNLOADINGS, SOFTEST_THAT_YIELDS, REMAINS = 1e3, 1e8, 0.25
#: Largest hardness (Pa), twice that of diamond.
HARDEST = 200e9
#: Where to look for another unit.
UNITS = Remedy("unit", "depth"), Remedy("unit", "force")


def is_modulus(E_star):
    """Whether a modulus E* (Pa) may be that of a material."""
    return MODULI[0] <= E_star <= MODULI[1]


def doubts(E_star, hardness, remaining=0.0):
    """Remarks on moduli E* and hardnesses (Pa) of unloadings that are those of no material, or of few.

    `remaining` is the share of the largest depth that remains after each.
    """
    E_star, hardness = np.ravel(E_star), np.ravel(hardness)
    soft, stiff = E_star.min(), E_star.max()
    numbers = []
    if not (is_modulus(soft) and is_modulus(stiff)):
        numbers.append(("E*", stiff if is_modulus(soft) else soft))
    if hardness.max() > HARDEST:
        numbers.append(("H", hardness.max()))
    found = [
        (f"no material has {symbol} = {_short(value)}", ", from first contact on")
        for symbol, value in numbers
    ]
    yields = np.ravel(remaining)[int(E_star.argmin()) % np.size(remaining)] > REMAINS
    if is_modulus(soft) and soft < (SOFTEST_THAT_YIELDS if yields else SOFTEST_OF_UNLOADINGS):
        which = " that keep an imprint" if yields else ""
        found.append((f"E* = {_short(soft)} is less than that of nearly all materials{which}", ""))
    return [
        Remark(
            f"{text}: give depth in m and force in N{more}",
            "units",
            f"{text}: look at the units of depth and force{more and ', and at first contact'}",
            UNITS,
        )
        for text, more in found
    ]


def _short(value):
    return engineering(float(f"{value:.3g}"), "Pa")
