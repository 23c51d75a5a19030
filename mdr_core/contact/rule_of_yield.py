"""The rule of yield: the plastic depth that a loading leaves behind, and the work that it takes.

On loading to a depth s every 1D element is compressed elastically by at most u_c(s), the *cap*, which is
the same for all elements. An element at x keeps the plastic part max(0, p(s) − g(x)) with p = s − u_c(s).
One number therefore stands for the whole history: the plastic depth d_p = max(0, largest p). The state at
depth d is the live interval [d_p, d].

For the hardness q_c/a the cap is the critical depth d_c = π q_c/(2E*) at every depth (Popov 2015,
Eqs. (11), (12), (19)): `ConstantCap`. For the hardness σ_c(a) = H + q_c/a + f_c/a² a contact of radius a
that has yielded throughout carries π a² σ_c(a), so that its elements are compressed by

    u_c(a) = π a σ_c(a)/(2E*) = (π/2E*)(H a + q_c + f_c/a)

at most, where a is the contact radius on loading: `radius_cap`, and `own.cap` for a law of one's own.
`yielding` chooses among these.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from .. import _check
from ..medium import critical_depth
from ..profiles.profile import Profile
from .integrals import integrals
from .live_interval import LiveInterval


@dataclass(frozen=True, eq=False)
class YieldRule(_check.Parameters, ABC):
    """How a medium yields under a profile, elementwise for arrays of depths.

    A subclass gives the cap, the depth at which loading reaches a plastic depth, the rate of the plastic
    depth, and the plastic work.
    """

    profile: Profile

    #: Distances s past the onset of yield, over the penetration y₀ there, at which a loading is cut. The
    #: ends of the live interval are at about s and s + y₀, so that forces have powers of both: a second
    #: singular place at s = −y₀. Pieces whose ends have one ratio see it from equally far; a ratio of 25 is
    #: 2.9 in the cube root of s, in which nodes are even. With them contact times have errors of 5·10⁻¹¹ at
    #: most, without them 10⁻⁸, with the first alone 5·10⁻¹⁰, ten million critical depths deep. Those of
    #: `RadiusCap` give 4·10⁻¹³ against 6·10⁻⁹: `python -m tests.benchmarks.constants`.
    scales = 5 * 25.0 ** np.arange(6)
    #: A profile of the family, if the contact time over d_max/v₀ is the same function of d_p/ℓ for all, ℓ
    #: being the live depth at the turning point of an impact on a virgin medium.
    similar = None

    @abstractmethod
    def cap(self, depth):
        """Largest elastic compression u_c (m) of the elements on loading to a depth (m)."""

    @abstractmethod
    def penetration(self, plastic_depth, imprint):
        """Penetration (m) below the bottom of an imprint at which loading reaches a plastic depth (m)."""

    @abstractmethod
    def rate(self, depth):
        """dp/ds of the plastic depth by the depth (m) of loading."""

    @abstractmethod
    def plastic_integral(self, imprint, increase):
        """Plastic work over 2E* (m³) while the plastic depth grows from `imprint` by `increase` (m)."""

    @abstractmethod
    def in_units_of(self, unit, length, depth):
        """The rule for the `unit` profile of a profile with a length and a depth (m)."""

    def onset(self, imprint=0.0):
        """Depth (m) at which yield starts over an imprint of plastic depth `imprint` (m)."""
        return imprint + self.penetration(imprint, imprint)

    def plastic_depth(self, largest):
        """Plastic depth d_p (m) that a largest depth (m) leaves behind."""
        return np.maximum(largest - self.cap(largest), 0.0)

    def increase(self, penetration, imprint):
        """Increase (m) of the plastic depth at a penetration (m) below the bottom of an imprint."""
        return np.maximum(self.plastic_depth(imprint + penetration) - imprint, 0.0)

    def loading(self, penetration, imprint=0.0):
        """Live interval at a penetration y ≥ 0 (m) below the bottom of an imprint, and the `increase`."""
        increase = self.increase(penetration, imprint)
        lower = imprint + increase
        upper = np.maximum(imprint + penetration, lower)
        length = np.where(increase > 0, self.cap(upper), penetration)
        return LiveInterval(lower, upper, length), increase

    def may_fall(self, depth):
        """Whether the force on loading up to a depth (m) may fall after the onset of yield."""
        return False

    def path(self, depth):
        """Live interval after each point of a path of depths (m) along the last axis."""
        largest = np.maximum.accumulate(depth, axis=-1) if depth.ndim else depth
        return interval_at(largest, depth, self.cap(largest))

    def past_onset(self, imprint, onset, distance):
        """Live interval at a distance (m) of loading past the penetration `onset` (m) into an imprint."""
        return self.loading(onset + distance, imprint)[0]

    def yielding(self, interval):
        """Whether the elements of a state are at the cap, so that further loading yields."""
        # The cap is computed again, with other rounding where arrays have other lengths.
        return (interval.lower > 0) & (interval.length >= self.cap(interval.upper) * (1 - 1e-14))

    def yielding_width(self, interval):
        """a − c dp/ds (m) on loading at the cap: the stiffness over 2E*."""
        c = self.profile.radius_at(interval.lower)
        # At first touch the rate may be infinite, where c is 0.
        slower = np.where(c > 0, 1 - self.rate(interval.upper), 0.0)
        return integrals(self.profile).radius_drop(interval) + c * slower

    def loading_width(self, interval, increase):
        """a (m) on loading, a − c dp/ds where it increases the plastic depth: the stiffness over 2E*."""
        width, yields = self.profile.radius_at(interval.upper), increase > 0
        return np.where(yields, self.yielding_width(interval), width) if np.any(yields) else width

    def breaks(self, imprint, increase, onset):
        """Distances (m) past the penetration `onset` (m) at which a loading is cut into smooth pieces.

        A row for each loading, which increases the plastic depth of an imprint by `increase` (m).
        """
        return self.scales * onset

    def wall_integral(self):
        """∫ a ds (m²) of a contact that has yielded throughout behind a wall, infinite without a wall."""
        return self.profile.wall * self.cap(np.inf)

    @classmethod
    def at_ratio(cls, profile, ratio):
        """A rule for a `similar` profile, and a live interval at its cap with d_p/ℓ = `ratio`."""
        raise NotImplementedError

    def turning_interval(self, energy):
        """Live interval at the turning point of an impact on a virgin medium, None without a closed form.

        `energy` is the kinetic energy over 2E* (m³).
        """
        return None


@dataclass(frozen=True, eq=False)
class ConstantCap(YieldRule):
    """Hardness q_c/a: the cap is the critical depth (m), infinite where nothing yields."""

    critical_depth: np.ndarray | float

    @classmethod
    def of(cls, profile, E_star, q_c):
        """The rule for an effective modulus (Pa) and a yield constant (N/m)."""
        return cls(profile, critical_depth(E_star, q_c))

    def cap(self, depth):
        return self.critical_depth

    def penetration(self, plastic_depth, imprint):
        return (plastic_depth - imprint) + self.critical_depth

    def rate(self, depth):
        return 1.0

    def increase(self, penetration, imprint):
        # Without the rounding of the imprint's depth.
        return np.maximum(penetration - self.critical_depth, 0.0)

    def yielding_width(self, interval):
        return integrals(self.profile).radius_drop(interval)

    def plastic_integral(self, imprint, increase):
        integral = integrals(self.profile).radius_integral(LiveInterval.above(imprint, increase))
        # An infinite cap times 0 where nothing yields.
        with np.errstate(invalid="ignore"):
            return np.where(increase > 0, self.critical_depth * integral, 0.0)

    def past_onset(self, imprint, onset, distance):
        return LiveInterval.above(imprint + distance, self.critical_depth)

    similar = property(lambda self: integrals(self.profile).similar)

    @classmethod
    def at_ratio(cls, profile, ratio):
        return cls(profile, 1.0), LiveInterval.above(ratio, 1.0)

    def turning_interval(self, energy):
        return integrals(self.profile).turning_interval(energy, self.critical_depth)

    def in_units_of(self, unit, length, depth):
        return ConstantCap(unit, self.critical_depth / depth)


def interval_at(largest, depth, cap):
    """Live interval at each depth (m) where the largest depth so far (m) had this cap (m)."""
    lower = np.maximum(largest - cap, 0.0)
    # The length is the depth before the first yield, and afterwards the cap less the depth of unloading.
    length = np.maximum(np.minimum(depth, cap - (largest - depth)), 0.0)
    return LiveInterval(lower, np.maximum(depth, lower), length)
