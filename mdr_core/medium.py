"""The medium: modulus, yield constant and viscosity, and what follows from them alone."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import _check

# π/2 as the sum of two doubles.
_HALF_PI = 1.5707963267948966, 6.123233995736766e-17


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

    Each may be an array for many impacts at once (`impact`); then every property is one too.

    Raises
    ------
    ValueError
        If a parameter is not a number or out of its range, or arrays do not broadcast.

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
        _check.common_shape("medium", E_star=self.E_star, q_c=self.q_c, eta=self.eta)
        depth = np.asarray(self.critical_depth)
        bad = ~((depth > 0) & ((depth < np.inf) | (self.q_c == np.inf)))
        bound = "m is outside double precision"
        remedy = "check the units of q_c and E_star, or leave q_c out for no yield"
        _check.refuse("critical depth π q_c/(2 E_star)", depth, bad, bound, remedy=remedy)
        with np.errstate(over="ignore", under="ignore"):
            time, line_load = np.asarray(self.relaxation_time), np.asarray(self.yield_line_load)
        bad, bound = np.isinf(time) | ((time == 0) & (self.eta > 0)), "s is outside double precision"
        _check.refuse("relaxation time 4 eta/E_star", time, bad, bound, remedy="check the units of eta")
        bad, bound = np.isinf(line_load) & (self.q_c < np.inf), "N/m is outside double precision"
        _check.refuse("yield line load π q_c/2", line_load, bad, bound, remedy="check the unit of q_c")

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
        _check.common_shape("medium", E1=E1, nu1=nu1, E2=E2, nu2=nu2)
        compliance = 0.0
        for i, (modulus, ratio) in enumerate(((E1, nu1), (E2, nu2)), start=1):
            modulus = _check.positive(f"Young's modulus E{i}", modulus, unit="Pa", infinite=True)
            quantity = f"Poisson ratio nu{i}"
            ratio = _check.finite_array(quantity, ratio)
            _check.refuse(quantity, ratio, ~((ratio > -1) & (ratio <= 0.5)), "must lie in −1 < ν ≤ 0.5")
            with np.errstate(over="ignore", under="ignore"):
                compliance = compliance + (1 - ratio) * (1 + ratio) / modulus
        if np.any(compliance == 0):
            raise ValueError("E1 and E2 are both infinite; at least one body must be elastic")
        with np.errstate(over="ignore"):
            return cls(1 / compliance, q_c, eta)

    @cached_property
    def shape(self):
        """Shape to which array-valued parameters broadcast, () for one medium."""
        return np.broadcast_shapes(np.shape(self.E_star), np.shape(self.q_c), np.shape(self.eta))

    def entries(self, index, shape=None):
        """The media at an index of the parameters, broadcast to `shape` before."""
        if not self.shape:
            return self
        shape = self.shape if shape is None else shape
        values = (self.E_star, self.q_c, self.eta)
        return Medium(*(np.broadcast_to(v, shape)[index] if np.ndim(v) else v for v in values))

    @property
    def critical_depth(self):
        """Indentation depth d_c = π q_c/(2E*) (m) at which yield starts, Popov (2015), Eq. (19)."""
        return self._critical_depth_parts[0]

    @cached_property
    def _critical_depth_parts(self):
        """d_c as the sum of a double and a small remainder.

        Just beyond the critical depth, d_p = d − d_c has the remainder's digits in front. On
        mantissas, so that nothing over- or underflows on the way.
        """
        q_c, q_exponent = np.frexp(np.where(np.isinf(self.q_c), 1.0, self.q_c))
        E, E_exponent = np.frexp(self.E_star)
        product, error = _exact_product(_HALF_PI[0], q_c)
        quotient = product / E
        back, back_error = _exact_product(quotient, E)
        remainder = ((product - back) - back_error + (error + _HALF_PI[1] * q_c)) / E
        nearest = quotient + remainder
        remainder = remainder - (nearest - quotient)
        with np.errstate(over="ignore", under="ignore"):
            nearest, remainder = (np.ldexp(part, q_exponent - E_exponent) for part in (nearest, remainder))
        never = np.isinf(self.q_c)
        remainder = np.where(never | np.isinf(nearest), 0.0, remainder)
        parts = np.where(never, np.inf, nearest), remainder
        return tuple(_check.frozen(part) if part.ndim else float(part) for part in parts)

    @property
    def yield_line_load(self):
        """Largest line load π q_c/2 (N/m) that a 1D element carries, Popov (2015), Eq. (12)."""
        return np.pi / 2 * self.q_c

    @property
    def relaxation_time(self):
        """Relaxation time τ = 4η/E* (s) of a spring and its dashpot, Popov (2015), Eq. (1)."""
        return 4 * self.eta / self.E_star


def _exact_product(a, b):
    """Product of two doubles of moderate size, and its rounding error (Veltkamp and Dekker)."""
    product = a * b
    a_high, b_high = (134217729.0 * part - (134217729.0 * part - part) for part in (a, b))
    a_low, b_low = a - a_high, b - b_high
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
