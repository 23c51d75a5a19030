"""Bounds of the moduli and hardnesses of materials, beyond which a result is implausible."""

import numpy as np

from ..show.quantities import engineering

#: Moduli E* (Pa) of materials, from the softest gels to diamond (1.15 TPa), with a margin.
MODULI = 1.0, 2e12
#: Largest hardness (Pa), twice that of diamond.
HARDEST = 200e9


def is_modulus(E_star):
    """Whether a modulus E* (Pa) may be that of a material."""
    return MODULI[0] <= E_star <= MODULI[1]


def doubts(E_star, hardness):
    """Sentences on moduli E* and hardnesses (Pa) of unloadings that are those of no material."""
    E_star, hardness = np.ravel(E_star), np.ravel(hardness)
    soft, stiff = E_star.min(), E_star.max()
    numbers = []
    if not (is_modulus(soft) and is_modulus(stiff)):
        numbers.append(("E*", stiff if is_modulus(soft) else soft))
    if hardness.max() > HARDEST:
        numbers.append(("H", hardness.max()))
    remedy = "give depth in m and force in N, from first contact on"
    return [
        f"no material has {symbol} = {engineering(float(f'{value:.3g}'), 'Pa')}: {remedy}"
        for symbol, value in numbers
    ]
