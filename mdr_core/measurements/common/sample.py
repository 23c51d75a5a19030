"""Young's modulus of a sample from the effective modulus of its contact."""

from typing import Any, NamedTuple

import numpy as np

from ...base import check
from ...show.quantities import engineering
from ...solver.medium.medium import poisson_ratio


class SampleModulus(NamedTuple):
    """Young's modulus of a sample and its standard error (Pa)."""

    value: Any
    standard_error: Any


def sample_modulus(E_star, standard_error, nu, tip=None):
    """Return the `SampleModulus` by 1/E* = (1 − ν²)/E + (1 − ν_t²)/E_t.

    Johnson (1985), Contact Mechanics, Eq. (4.5). `nu` is the Poisson ratio of the sample. `tip` is the
    modulus (Pa) and the Poisson ratio of the tip, or None for a rigid tip. If only some of many contacts
    are stiffer than the tip, their results are NaN.
    """
    nu = poisson_ratio("Poisson ratio nu", nu)
    compliance = 0.0
    if tip is not None:
        modulus, ratio = tip
        modulus = check.positive_number("modulus of the tip", modulus, unit="Pa")
        compliance = (1 - poisson_ratio("Poisson ratio of the tip", ratio) ** 2) / modulus
    rest = 1 / np.asarray(E_star) - compliance
    if np.any(rest <= 0) and not np.any(rest > 0):
        raise check.MDRError(
            f"the tip, E_t = {engineering(modulus, 'Pa')}, must be stiffer than the contact, E* = "
            f"{engineering(np.nanmax(E_star), 'Pa')}: give the modulus of its material"
        )
    rest = np.where(rest > 0, rest, np.nan)[()]
    E = (1 - nu**2) / rest
    return SampleModulus(E, E / rest / E_star**2 * standard_error)
