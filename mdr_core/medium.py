"""The medium: modulus, yield constant and viscosity, and what follows from them alone."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from . import _check

# π/2 to 48 digits.
_HALF_PI = Fraction(157079632679489661923132169163975144209858469968, 10**47)


@dataclass(frozen=True)
class Medium:
    """A visco-elastic half-space with hardness inversely proportional to the contact radius.

    Parameters
    ----------
    E_star : float
        Effective modulus E* (Pa), positive. A rigid indenter on a body of modulus E and
        Poisson ratio ν has E* = E/(1 − ν²).
    q_c : float, optional
        Yield constant (N/m = J/m²): the mean pressure under a fully yielded contact of radius a
        is q_c/a. Positive; infinite (the default) means that nothing yields.
    eta : float, optional
        Dynamic viscosity η (Pa·s), not negative; 0 (the default) means rate-independent.

    Raises
    ------
    ValueError
        If a parameter is not a number or out of its range.

    Examples
    --------
    >>> medium = Medium(E_star=100e9, q_c=2000.0)
    >>> print(round(medium.critical_depth * 1e9, 6))  # π q_c / (2 E*), in nm
    31.415927
    """

    E_star: float
    q_c: float = np.inf
    eta: float = 0.0

    def __post_init__(self):
        set_ = object.__setattr__
        set_(self, "E_star", _check.positive("effective modulus E_star", self.E_star, unit="Pa"))
        q_c = _check.positive("yield constant q_c", self.q_c, unit="N/m", infinite=True)
        set_(self, "q_c", q_c)
        set_(self, "eta", _check.positive("viscosity eta", self.eta, unit="Pa·s", zero=True))
        if q_c < np.inf and not 0 < self.critical_depth < np.inf:
            raise ValueError(
                f"yield constant q_c = {q_c:g} N/m over E_star = {self.E_star:g} Pa gives a critical "
                "depth outside double precision; check the units, or leave q_c out for no yield"
            )

    @classmethod
    def from_bodies(cls, E1, nu1, E2=np.inf, nu2=0.0, q_c=np.inf, eta=0.0):
        """The medium equivalent to two elastic bodies in contact.

        1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Popov (2015), Eq. (2).

        Parameters
        ----------
        E1, E2 : float
            Young's moduli (Pa), positive; infinite for a rigid body. Not both infinite.
        nu1, nu2 : float
            Poisson ratios, −1 < ν ≤ 1/2.
        q_c, eta : float
            As in `Medium`.

        Examples
        --------
        >>> print(round(Medium.from_bodies(210e9, 0.3).E_star / 1e9, 6))  # steel under a rigid indenter
        230.769231
        """
        compliance = 0.0
        for i, (modulus, ratio) in enumerate(((E1, nu1), (E2, nu2)), start=1):
            modulus = _check.positive(f"Young's modulus E{i}", modulus, unit="Pa", infinite=True)
            ratio = _check.number(f"Poisson ratio nu{i}", ratio)
            if not -1 < ratio <= 0.5:
                raise ValueError(f"Poisson ratio nu{i} = {ratio:g} must lie in −1 < ν ≤ 0.5")
            compliance += (1 - ratio) * (1 + ratio) / modulus
        if compliance == 0:
            raise ValueError("E1 and E2 are both infinite; at least one body must be elastic")
        return cls(1 / compliance, q_c, eta)

    @property
    def critical_depth(self):
        """Indentation depth d_c = π q_c/(2E*) (m) at which yield starts, Popov (2015), Eq. (19)."""
        return self._critical_depth_parts[0]

    @cached_property
    def _critical_depth_parts(self):
        """d_c as the sum of a double and a small remainder.

        Just beyond the critical depth, d_p = d − d_c has the remainder's digits in front.
        """
        if self.q_c == np.inf:
            return np.inf, 0.0
        exact = _HALF_PI * Fraction(self.q_c) / Fraction(self.E_star)
        try:
            nearest = float(exact)
        except OverflowError:
            return np.inf, 0.0
        return nearest, float(exact - Fraction(nearest))

    @property
    def yield_line_load(self):
        """Largest line load π q_c/2 (N/m) that a 1D element carries, Popov (2015), Eq. (12)."""
        return np.pi / 2 * self.q_c

    @property
    def relaxation_time(self):
        """Relaxation time τ = 4η/E* (s) of a spring and its dashpot, Popov (2015), Eq. (1)."""
        return 4 * self.eta / self.E_star
