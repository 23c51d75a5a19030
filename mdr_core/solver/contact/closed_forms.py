"""Closed forms of profiles, one class per family, such as powers of the radius.

Profiles with a class here are solved by its formulas, all others by quadrature or from a table. To add a
family, write a subclass of `Integrals` and register it for the class of its profiles:

    @integrals.register(Wedge)
    class WedgeForms(Integrals): ...

Register rules of yield for a constant hardness alone in the same way, with `constant_hardness`.

The live interval is [d_p, d], and a(s) is the contact radius at the depth s. A difference of two elastic
curves would lose its digits in a short interval. Each formula is therefore the length of the interval
times a positive mean.
"""

import numpy as np
import scipy

from ..medium.hardness import SumOfClasses
from ..numerics.blocks import chunks
from ..numerics.stable import cube_rise, log1p_ratio, root
from ..profiles.power import Cone, FlatPunch, Paraboloid, PowerLaw
from ..profiles.sampled import Sampled
from .integrals import Integrals, QuadratureIntegrals, integrals
from .live_interval import LiveInterval
from .yielding import RadiusCap, constant_hardness

_TINY = np.finfo(float).tiny


@integrals.register(FlatPunch)
class FlatPunchIntegrals(Integrals):
    """a = b."""

    polynomial = True
    elastic_exponent = 1.0

    def radius_integral(self, interval):
        return self.profile.radius * interval.length

    def energy_integral(self, interval):
        return self.profile.radius / 2 * interval.length**2

    def radius_difference(self, interval):
        return np.zeros_like(interval.length)


@integrals.register(Cone)
class ConeIntegrals(Integrals):
    """a = 2 s/(π slope)."""

    polynomial = True
    similar = Cone(1.0)
    elastic_exponent = 2.0

    def radius_integral(self, interval):
        return (interval.upper + interval.lower) * interval.length / (np.pi * self.profile.slope)

    def energy_integral(self, interval):
        return interval.length**2 * (interval.upper + 2 * interval.lower) / (3 * np.pi * self.profile.slope)

    def radius_difference(self, interval):
        return interval.length / (np.pi / 2 * self.profile.slope)

    def pressure_integral(self, interval, r):
        a, c = (self.profile.radius_at(depth) for depth in (interval.upper, interval.lower))
        inside, result = (r < a) & (interval.length > 0), np.zeros_like(r)
        r = r[inside]
        root_a = root(a, r)
        if c == 0:
            # Nothing has yielded: arccosh(a/r).
            logarithm = log1p_ratio((a - r) + root_a, r)
        else:
            # arccosh(a/r) − arccosh(c/r), with an explicit difference of the arguments of the logarithms.
            low = np.maximum(c, r)
            drop = np.where(r < c, self.radius_difference(interval), a - r)
            root_low = root(low, r)
            logarithm = log1p_ratio(drop + drop * ((a + low) / (root_a + root_low)), low + root_low)
        result[inside] = np.pi / 2 * self.profile.slope * logarithm
        return result

    def turning_interval(self, target, d_c):
        # d³/3 = πs·target; yielding, with X = d_p/d_c: X² + X = (λ³ − 1)/3.
        elastic = np.cbrt(3 * np.pi * self.profile.slope * target)
        ratio = elastic / d_c
        surplus = np.maximum((ratio * ratio * ratio - 1) / 3, 0.0)
        return _turning_interval(elastic, 2 * surplus / (1 + np.sqrt(1 + 4 * surplus)), d_c)


@integrals.register(Paraboloid)
class ParaboloidIntegrals(Integrals):
    """a = √(R s)."""

    polynomial = True
    similar = Paraboloid(1.0)
    elastic_exponent = 1.5

    def radius_integral(self, interval):
        # A³ − C³ with A² = d and C² = d_p.
        A, C = np.sqrt(interval.upper), np.sqrt(interval.lower)
        mean = (interval.upper + A * C + interval.lower) / np.maximum(A + C, _TINY)
        return (2 / 3 * np.sqrt(self.profile.radius)) * mean * interval.length

    def energy_integral(self, interval):
        # ∫ 2x²(A² − x²) dx from C to A = C + e, as a polynomial with positive terms in e.
        C = np.sqrt(interval.lower)
        e = interval.length / np.maximum(np.sqrt(interval.upper) + C, _TINY)
        polynomial = ((4 / 15 * e + 4 / 3 * C) * e + 8 / 3 * C**2) * e + 2 * C**3
        return np.sqrt(self.profile.radius) * e**2 * polynomial

    def radius_difference(self, interval):
        A, C = np.sqrt(interval.upper), np.sqrt(interval.lower)
        return np.sqrt(self.profile.radius) * interval.length / np.maximum(A + C, _TINY)

    def pressure_integral(self, interval, r):
        a, c = (self.profile.radius_at(depth) for depth in (interval.upper, interval.lower))
        root_a, root_c = root(a, r), root(c, r)
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(
                r < c, 2 * interval.length / (root_a + root_c), 2 / self.profile.radius * root_a
            )

    def turning_interval(self, target, d_c):
        # (4/15) √R d^(5/2) = target; yielding, with X = d_p/d_c: (X + 1)^(5/2) − X^(5/2) = λ^(5/2).
        elastic = (target * 3.75 / np.sqrt(self.profile.radius)) ** 0.4
        ratio = elastic / d_c
        work = np.maximum(ratio * ratio * np.sqrt(ratio), 1.0).ravel()
        X = np.empty_like(work)
        for rows in chunks(work.size):
            X[rows] = _plastic_ratio(work[rows])
        return _turning_interval(elastic, X.reshape(elastic.shape), d_c)


@integrals.register(PowerLaw)
class PowerLawIntegrals(Integrals):
    """a = (s/(κₙ c))^(1/n)."""

    elastic_exponent = property(lambda self: 1 + 1 / self.profile.exponent)

    def radius_integral(self, interval):
        q = 1 + 1 / self.profile.exponent
        # 1 − (1 − fraction)^q without cancellation.
        with np.errstate(divide="ignore"):
            drop = -np.expm1(q * np.log1p(-_fraction(interval)))
        return self.profile.radius_at(interval.upper) * interval.upper / q * drop

    def energy_integral(self, interval):
        q = 1 + 1 / self.profile.exponent
        a = self.profile.radius_at(interval.upper)
        return a * interval.upper**2 * scipy.special.betainc(2, q, _fraction(interval)) / (q * (q + 1))

    def radius_difference(self, interval):
        fraction = _fraction(interval)
        # ln(d_p/d) without cancellation: from the length if it is short, else from the ends.
        with np.errstate(divide="ignore", invalid="ignore"):
            logarithm = np.where(
                fraction < 0.5, np.log1p(-fraction), np.log(interval.lower / interval.upper)
            )
        return -self.profile.radius_at(interval.upper) * np.expm1(logarithm / self.profile.exponent)


def _fraction(interval):
    """Return the length of the live interval as a fraction of the depth; 0 if both vanish."""
    return np.divide(
        interval.length, interval.upper, out=np.zeros_like(interval.upper), where=interval.upper > 0
    )


def _plastic_ratio(work):
    """Return X with (X + 1)^(5/2) − X^(5/2) = `work` ≥ 1."""
    # With A² = X + 1, C² = X and h = A + C it is (5h³ + 10/h + 1/h⁵)/16, nearly a cube.
    h = np.cbrt(3.2 * work - 2.2)
    X = ((h - 1 / h) / 2) ** 2
    for _ in range(4):
        A, C = np.sqrt(X + 1), np.sqrt(X)
        cubes = (X + 1 + A * C + X) / (A + C)
        fifths = ((X + 1) ** 2 + X * X + X * (X + 1) + A * C * (2 * X + 1)) / (A + C)
        X = np.maximum(X - (fifths - work) / (2.5 * cubes), 0.0)
    return X


def _turning_interval(elastic, plastic_ratio, d_c):
    """Return the live interval from the depth (m) without yield, and d_p/d_c if the medium yields."""
    with np.errstate(invalid="ignore"):
        lower = np.where(elastic > d_c, plastic_ratio * d_c, 0.0)
    length = np.minimum(elastic, d_c)
    return LiveInterval.above(lower, length)


@integrals.register(Sampled)
class SampledIntegrals(QuadratureIntegrals):
    """A polygon, g = Σ β x arccos(r/x) over its vertices r with the changes β of the slope there.

    From the tip, ∫ a ds = a d − ∫ g dx. Under a convex shape this difference is at least half of a d, and
    an error of a has an effect of second order. ∫ x arccos(r/x) dx = (x² arccos(r/x) − r √(x² − r²))/2. The
    first force of 3000 samples is computed 50 times as fast as by quadrature.
    """

    def radius_integral(self, interval):
        elastic = np.asarray(interval.lower == 0) & (interval.upper > 0)
        if not elastic.any():
            return super().radius_integral(interval)
        result = np.empty(elastic.shape)
        result[elastic] = self._from_the_tip(np.asarray(interval.upper)[elastic])
        if not elastic.all():
            result[~elastic] = super().radius_integral(interval[~elastic])
        return result

    def _from_the_tip(self, depth):
        """Return ∫ a ds (m²) from the tip to depths (m), shape (N,)."""
        a = self.profile.radius_at(depth)
        # The radius is infinite below the known depth.
        with np.errstate(invalid="ignore"):
            return a * depth - self.profile.sums_at(a)[0]


@constant_hardness.register(Cone)
def _(profile):
    return ConeOfHardness


@constant_hardness.register(Paraboloid)
def _(profile):
    return ParaboloidOfHardness


class ConeOfHardness(RadiusCap):
    """Constant hardness under a cone: u_c = κ s with κ = H/(E* slope), the same at all depths.

    The cone yields from first touch, or for κ ≥ 1 never. In units of 2E*, U = κ²(3 − 2κ) d³/(3π slope) and
    W_p = 2κ(1 − κ)² d³/(3π slope). The coefficient of restitution is √(κ(3 − 2κ)/(2 − κ)) at every speed.
    """

    similar = Cone(1.0)

    @property
    def _kappa(self):
        return np.divide(self.law.hardness, np.pi / 2 * self.profile.slope)

    @classmethod
    def at_ratio(cls, profile, ratio):
        kappa = 1 / (1 + ratio)
        law = SumOfClasses(np.pi / 2 * profile.slope * kappa, 0.0, 0.0)
        return cls(profile, law), LiveInterval.above(ratio, 1.0)

    def _penetration(self, imprint, increase):
        kappa = self._kappa
        with np.errstate(divide="ignore", invalid="ignore"):
            y = increase + kappa / (1 - kappa) * (imprint + increase)
        return np.where(kappa < 1, y, np.inf)

    def plastic_integral(self, imprint, increase):
        # ∫ u_c a(p) dp with u_c = κ p/(1 − κ).
        kappa = np.minimum(self._kappa, 1 - 1e-16)
        factor = kappa / (1 - kappa) * 2 / (3 * np.pi * self.profile.slope)
        return np.where(increase > 0, factor * cube_rise(imprint, increase), 0.0)[()]

    def turning_interval(self, energy):
        kappa = np.minimum(self._kappa, 1.0)
        depth = np.cbrt(3 * np.pi * self.profile.slope * energy / (kappa * (2 - kappa)))
        return LiveInterval(*np.broadcast_arrays((1 - kappa) * depth, depth, kappa * depth))


class ParaboloidOfHardness(RadiusCap):
    """Constant hardness under a paraboloid: u_c = √(d_y s), with the onset depth d_y = R (π H/(2E*))².

    With r = √(s/d_y) the plastic depth is d_y (r² − r), and r = (1 + cosh t)/2 past the onset.
    """

    similar = Paraboloid(1.0)

    @property
    def _onset(self):
        return self.law.hardness**2 * self.profile.radius

    @classmethod
    def at_ratio(cls, profile, ratio):
        r = 1 + ratio
        law = SumOfClasses(np.sqrt(1 / profile.radius), 0.0, 0.0)
        return cls(profile, law), LiveInterval(r * ratio, r * r, r)

    def _penetration(self, imprint, increase):
        onset = self._onset
        root_s = (np.sqrt(onset) + np.sqrt(onset + 4 * (imprint + increase))) / 2
        return increase + np.sqrt(onset) * root_s

    def plastic_integral(self, imprint, increase):
        if np.any(imprint):
            return super().plastic_integral(imprint, increase)
        # ∫ u_c a(p) dp = √R d_y^(5/2) ∫ r √(r² − r) (2r − 1) dr.
        onset = self._onset
        sinh = 2 * np.sqrt(increase / onset)
        t = np.arcsinh(sinh)
        # (sinh 4t − 4t)/32, as a series if it would cancel.
        square = t * t
        series = t * square * (1 / 3 + square * (4 / 15 + square * (32 / 315 + square * (64 / 2835))))
        cosh = np.sqrt(1 + sinh * sinh)
        power = np.where(t < 0.02, series, (sinh * cosh * (1 + 2 * sinh * sinh) - t) / 8)
        return np.sqrt(self.profile.radius * onset) * onset**2 / 8 * (sinh**3 / 3 + power)

    def turning_interval(self, energy):
        onset = self._onset
        work = (energy / (np.sqrt(self.profile.radius * onset) * onset**2)).ravel()
        r = np.empty_like(work)
        for rows in chunks(work.size):
            r[rows] = _root_of_depth(work[rows])
        r = r.reshape(np.shape(energy))
        lower = onset * np.maximum(r * r - r, 0.0)
        return LiveInterval(lower, onset * r * r, onset * np.minimum(r * r, r))


def _root_of_depth(work):
    """Return r = √(d/d_y) for a work of loading in units of √R d_y^(5/2)."""
    elastic = (3.75 * work) ** 0.2
    r = np.maximum(np.maximum(elastic, (2 * work) ** 0.25), 1.0)
    for _ in range(6):
        # 4/15 (r⁵ − q⁵) − ∫ sinh⁴ t dt/24 with q = √(r² − r), and its derivative 4/3 r (r³ − q³).
        with np.errstate(divide="ignore"):
            fall = np.log1p(-1 / r)
        sinh = 2 * np.sqrt(r * r - r)
        powers = sinh * (2 * r - 1) * (2 * sinh * sinh - 3) / 8 + 0.375 * np.arcsinh(sinh)
        value = -(4 / 15) * r**5 * np.expm1(2.5 * fall) - powers / 24
        slope = -(4 / 3) * r**4 * np.expm1(1.5 * fall)
        r = np.maximum(r - (value - work) / slope, 1.0)
    return np.where(elastic < 1, elastic, r)
