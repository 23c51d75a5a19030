"""The rule of yield: the plastic depth that a loading leaves behind, and the work that it takes.

On loading to a depth s every 1D element is compressed elastically by at most u_c(s), the *cap*, which is
the same for all elements. An element at x keeps the plastic part max(0, p(s) − g(x)) with p = s − u_c(s).
One number therefore stands for the whole history: the plastic depth d_p = max(0, largest p). The state at
depth d is the live interval [d_p, d].

For the hardness q_c/a the cap is the critical depth d_c = π q_c/(2E*) at every depth (Popov 2015,
Eqs. (11), (12), (19)).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from .integrals import integrals
from .live_interval import LiveInterval
from .medium import Medium, critical_depth
from .shapes.profile import Profile


@dataclass(frozen=True)
class YieldRule(ABC):
    """How a medium yields under a profile, elementwise for arrays of depths.

    A subclass gives the cap, the depth at which loading reaches a plastic depth, the rate of the plastic
    depth, and the plastic work.
    """

    profile: Profile

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
    def entries(self, index, shape):
        """The rule at an index of an ensemble of this shape."""

    @abstractmethod
    def flat_entries(self, rows, shape):
        """The rule at rows of the flattened `shape` of an ensemble."""

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

    def at(self, largest, depth):
        """Live interval at each depth (m) where the largest depth so far is `largest` (m)."""
        return interval_at(largest, depth, self.cap(largest))

    def path(self, depth):
        """Live interval after each point of a path of depths (m) along the last axis."""
        largest = np.maximum.accumulate(depth, axis=-1) if depth.ndim else depth
        return self.at(largest, depth)

    def yielding(self, interval):
        """Whether states are at the cap, so that loading goes on to yield."""
        return (interval.lower > 0) & (interval.length == self.cap(interval.upper))

    def yielding_width(self, interval):
        """a − c dp/ds (m) on loading at the cap: the stiffness over 2E*."""
        c = self.profile._radius(interval.lower)
        return integrals(self.profile).radius_drop(interval) + c * (1 - self.rate(interval.upper))

    def wall_integral(self):
        """∫ a ds (m²) of a contact that has yielded throughout behind a wall, infinite without a wall."""
        return self.profile.wall * self.cap(np.inf)

    def turning_interval(self, energy):
        """Live interval at the turning point of an impact on a virgin medium, None without a closed form.

        `energy` is the kinetic energy over 2E* (m³).
        """
        return None


@dataclass(frozen=True)
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

    def turning_interval(self, energy):
        return integrals(self.profile).turning_interval(energy, self.critical_depth)

    def entries(self, index, shape):
        cap = np.broadcast_to(self.critical_depth, shape)[index]
        return ConstantCap(self.profile.entries(index, shape), cap)

    def flat_entries(self, rows, shape):
        cap = np.broadcast_to(self.critical_depth, shape).reshape(-1)[rows]
        return ConstantCap(self.profile.flat_entries(rows, shape), cap)

    def in_units_of(self, unit, length, depth):
        return ConstantCap(unit, self.critical_depth / depth)


def yield_rule(profile: Profile, medium: Medium) -> YieldRule:
    """The rule by which a medium yields under a profile.

    Examples
    --------
    >>> from mdr_core import Cone
    >>> rule = yield_rule(Cone(slope=1.0), Medium.from_critical_depth(1.0, critical_depth=1.0))
    >>> rule.path(np.array([0.5, 3.0, 2.5, 1.0])).length.tolist()
    [0.5, 1.0, 0.5, 0.0]
    """
    return ConstantCap.of(profile, medium.E_star, medium.q_c)


def interval_at(largest, depth, cap):
    """Live interval at each depth (m) where the largest depth so far (m) had this cap (m)."""
    lower = np.maximum(largest - cap, 0.0)
    # The length is the depth before the first yield, and afterwards the cap less the depth of unloading.
    length = np.maximum(np.minimum(depth, cap - (largest - depth)), 0.0)
    return LiveInterval(lower, np.maximum(depth, lower), length)
