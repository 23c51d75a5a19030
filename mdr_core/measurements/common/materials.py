"""Bounds of the moduli and hardnesses of materials, beyond which a result is implausible."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering

#: Moduli E* (Pa) of materials, from the softest gels to diamond (1.15 TPa), with a margin.
MODULI = 1.0, 2e12
#: Least moduli (Pa) of unloadings that are not asked about: in general, and where more than a share of the
#: largest depth remains, as of plastics, metals and ceramics.
SOFTEST_OF_UNLOADINGS, SOFTEST_THAT_YIELDS, REMAINS = 1e3, 1e8, 0.25
#: Largest hardness (Pa), twice that of diamond.
HARDEST = 200e9
#: Least hardness over the modulus E*, a hundredth of that of annealed metals, and largest contact radius
#: (m) of measurements that are not asked about.
SOFTEST_OVER_MODULUS, WIDEST = 1e-5, 1e-2
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
        f"no material has {symbol} = {_short(value)}: a unit, or the zero of the depth, is wrong"
        for symbol, value in numbers
    ]
    yields = np.ravel(remaining)[int(E_star.argmin()) % np.size(remaining)] > REMAINS
    if is_modulus(soft) and soft < (SOFTEST_THAT_YIELDS if yields else SOFTEST_OF_UNLOADINGS):
        which = " that keep an imprint" if yields else ""
        found.append(f"E* = {_short(soft)} is less than that of nearly all materials{which}")
    return [Remark(text, "units", *UNITS, together=True) for text in found]


def doubts_of_measured(E_star, mean_pressure, radius):
    """Remarks on mean pressures (Pa) and contact radii (m), beside E* (Pa), that are in other units."""
    if not SOFTEST_OVER_MODULUS * E_star <= np.median(mean_pressure) <= HARDEST:
        given = _short(np.median(mean_pressure))
        text = f"no material with E* = {_short(E_star)} has a mean pressure of {given}"
        yield Remark(
            text, "units", Remedy("unit", "mean_pressure"), Remedy("unit", "E_star"), together=True
        )
    if np.median(radius) > WIDEST:
        text = f"a contact radius of {engineering(float(f'{np.median(radius):.3g}'), 'm')} is very large"
        yield Remark(text, "units", Remedy("unit", "radius"))


def _short(value):
    return engineering(float(f"{value:.3g}"), "Pa")
