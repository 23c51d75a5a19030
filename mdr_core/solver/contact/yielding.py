"""The rule of yield: the plastic depth and the plastic work of a loading.

On loading to a depth s every 1D element is compressed elastically by at most u_c(s), the *cap*, which is
the same for all elements. An element at x keeps the plastic part max(0, p(s) − g(x)) with p = s − u_c(s).
One number therefore represents the whole history: the plastic depth d_p = max(0, largest p). The state at
depth d is the live interval [d_p, d].

For the hardness q_c/a the cap is the critical depth d_c = π q_c/(2E*) at every depth (Popov 2015,
Eqs. (11), (12), (19)): `ConstantCap`. For the hardness σ_c(a) = H + q_c/a + f_c/a², a fully yielded
contact of radius a carries π a² σ_c(a). Its elements are therefore compressed by at most

    u_c(a) = π a σ_c(a)/(2E*) = (π/2E*)(H a + q_c + f_c/a)

with the contact radius a on loading: `RadiusCap`, and `UserLawCap` for a user's law. For H alone some
profiles have closed forms. `yield_rule` chooses among these rules.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property, singledispatch
from typing import Any

import numpy as np

from ...base import check, lazy
from ..medium.medium import Medium, critical_depth
from ..numerics.blocks import broadcast_flat, chunks
from ..numerics.gauss import gauss_legendre
from ..numerics.roots import increasing_root
from ..profiles.profile import Profile
from .integrals import integrals
from .live_interval import LiveInterval

#: Depths between pieces, where a(s) changes from one power of the depth to another, in units of the
#: transition depth. Contact times of five shapes over seven decades of speed then have errors of at most
#: 5·10⁻¹¹. Without these depths the errors are 3·10⁻⁶, with halved depths 7·10⁻¹⁰, and with doubled depths
#: 5·10⁻¹².
TRANSITIONS = np.array([1.0, 6.0])
#: Gauss nodes of the plastic work in each piece. The work of five shapes over seven decades of speed then
#: has errors of at most 4·10⁻¹⁵, with 16 nodes 7·10⁻¹³.
_NODES = 24


@dataclass(frozen=True, eq=False)
class YieldRule(check.Parameters, ABC):
    """Yield of a medium under a profile, elementwise for arrays of depths.

    A subclass defines the cap, the depth at which loading reaches a plastic depth, the rate of the plastic
    depth, and the plastic work.
    """

    profile: Profile

    #: Distances s past the onset of yield, in units of the penetration y₀ there, at which a loading is cut.
    #: The ends of the live interval are at about s and s + y₀. Forces have powers of both, with a second
    #: singularity at s = −y₀. Pieces whose ends have the same ratio are equally far from it, relative to
    #: their length. The ratio 25 is 2.9 in the cube root of s, in which nodes are even. Contact times then
    #: have errors of at most 5·10⁻¹¹, ten million critical depths deep; without these distances 10⁻⁸, with
    #: the first alone 5·10⁻¹⁰. The distances of `RadiusCap` give 4·10⁻¹³ instead of 6·10⁻⁹.
    scales = 5 * 25.0 ** np.arange(6)
    #: A profile of the family, if the contact time over d_max/v₀ is the same function of d_p/ℓ for all of
    #: them, with the live depth ℓ at the turning point of an impact on a virgin medium.
    similar = None

    @abstractmethod
    def cap(self, depth):
        """Return the largest elastic compression u_c (m) of the elements on loading to a depth (m)."""

    @abstractmethod
    def penetration(self, plastic_depth, imprint):
        """Return the penetration (m) into an imprint at which loading reaches a plastic depth (m).

        Penetrations count from the bottom of the imprint.
        """

    @abstractmethod
    def rate(self, depth):
        """Return the derivative dp/ds of the plastic depth with respect to the depth s (m) of loading."""

    @abstractmethod
    def plastic_integral(self, imprint, increase):
        """Return the plastic work over 2E* (m³) as the plastic depth grows from `imprint` by `increase`."""

    @abstractmethod
    def in_units_of(self, unit, length, depth):
        """Return the rule for the `unit` profile of a profile with a length and a depth (m)."""

    def onset(self, imprint=0.0):
        """Return the depth (m) at which yield starts over an imprint of plastic depth `imprint` (m)."""
        return imprint + self.penetration(imprint, imprint)

    def plastic_depth(self, largest):
        """Return the plastic depth d_p (m) that a largest depth (m) leaves."""
        return np.maximum(largest - self.cap(largest), 0.0)

    def increase(self, penetration, imprint):
        """Return the increase (m) of the plastic depth at a penetration (m) into an imprint."""
        return np.maximum(self.plastic_depth(imprint + penetration) - imprint, 0.0)

    def loading(self, penetration, imprint=0.0):
        """Return the live interval at a penetration y ≥ 0 (m) into an imprint, and the `increase`."""
        increase = self.increase(penetration, imprint)
        lower = imprint + increase
        upper = np.maximum(imprint + penetration, lower)
        length = np.where(increase > 0, self.cap(upper), penetration)
        return LiveInterval(lower, upper, length), increase

    def turning(self, penetration, imprint):
        """Return `loading` to a turning point; the upper end is infinite if the penetration is infinite."""
        too_deep = np.isinf(penetration)
        interval, increase = self.loading(np.where(too_deep, 0.0, penetration), imprint)
        return replace(interval, upper=np.where(too_deep, np.inf, interval.upper)), increase

    def may_fall(self, depth):
        """Whether the force on loading up to a depth (m) may fall after the onset of yield."""
        return False

    def path(self, depth):
        """Return the live interval after each point of a path of depths (m) along the last axis."""
        largest = np.maximum.accumulate(depth, axis=-1) if depth.ndim else depth
        return interval_at(largest, depth, self.cap(largest))

    def past_onset(self, imprint, onset, distance):
        """Return the live interval at a distance (m) past the penetration `onset` (m) into an imprint."""
        return self.loading(onset + distance, imprint)[0]

    def yielding(self, interval):
        """Whether the elements of a state are at the cap, so that further loading yields."""
        # The cap is computed again; its rounding may differ for arrays of other lengths.
        return (interval.lower > 0) & (interval.length >= self.cap(interval.upper) * (1 - 1e-14))

    def yielding_stiffness_radius(self, interval):
        """Return the stiffness over 2E* on loading at the cap, a − c dp/ds (m)."""
        c = self.profile.radius_at(interval.lower)
        # At first touch c is 0, and the rate may be infinite.
        slower = np.where(c > 0, 1 - self.rate(interval.upper), 0.0)
        return integrals(self.profile).radius_difference(interval) + c * slower

    def loading_stiffness_radius(self, interval, increase, radius=None):
        """Return the stiffness over 2E* on loading: a (m), or a − c dp/ds if the plastic depth increases.

        `radius` is a (m), if it is known.
        """
        width, yields = self.profile.radius_at(interval.upper) if radius is None else radius, increase > 0
        return (
            np.where(yields, self.yielding_stiffness_radius(interval), width) if np.any(yields) else width
        )

    def work(self, penetration, imprint, compliance=None):
        """Return the work over 2E* (m³) up to a penetration (m), and its derivative.

        It is the stored energy, the plastic work and the work of a support. The support has the compliance
        κ = 2E*/K (1/m). Under Φ = ∫ a ds it takes κ Φ²/2, and moves by κ dΦ.
        """
        interval, increase = self.loading(penetration, imprint)
        force, stored = integrals(self.profile).radius_and_energy(interval)
        taken = stored + self.plastic_integral(imprint, increase)
        if compliance is None:
            return taken, force
        deflection = compliance * force
        return taken + deflection * force / 2, force + deflection * self.loading_stiffness_radius(
            interval, increase
        )

    def breaks(self, imprint, deepest):
        """Return the `Breaks` of loadings over imprints to the `deepest` depths (m), both (N, 1)."""
        return Breaks(self, imprint, deepest)

    def wall_integral(self):
        """Return ∫ a ds (m²) of a fully yielded contact bounded by a wall; infinite without a wall."""
        return self.profile.wall * self.cap(np.inf)

    @classmethod
    def at_ratio(cls, profile, ratio):
        """Return a rule for a `similar` profile, and a live interval at its cap with d_p/ℓ = `ratio`."""
        raise NotImplementedError

    def turning_interval(self, energy):
        """Return the live interval at the turning point of an impact on a virgin medium.

        It is None without a closed form. `energy` is the kinetic energy over 2E* (m³).
        """
        return None


@dataclass(frozen=True, eq=False)
class Breaks:
    """Penetrations (m) at which a loading is not smooth, or changes to another power of the depth.

    They count from the bottom of an imprint, and have one row per loading and one column per break. They
    may be beyond the end of the loading. The stiffness has a kink at the onset and at kinks of g; elsewhere
    it is smooth.

    Attributes
    ----------
    rule : YieldRule
        The rule, for one profile or for N profiles of shape (N, 1).
    imprint, deepest : ndarray, shape (N, 1)
        Plastic depth (m) of the imprint, and largest depth (m). Kinks below all `deepest` are left out.
    """

    rule: YieldRule
    imprint: np.ndarray
    deepest: np.ndarray

    @cached_property
    def onset(self):
        """Onset of yield, (N, 1); infinite if nothing yields."""
        return self.rule.penetration(self.imprint, self.imprint)

    @cached_property
    def upper(self):
        """Penetrations at which the upper end of the live interval, the depth, passes a kink of g."""
        return self._kinks_above(self.deepest) - self.imprint

    @cached_property
    def lower(self):
        """Penetrations at which the lower end, the plastic depth, passes a kink of g."""
        kinks = self._kinks_above(self.rule.plastic_depth(self.deepest))
        return self.rule.penetration(kinks, self.imprint) if kinks.size else kinks - self.imprint

    @property
    def transitions(self):
        """Penetrations at which a(s) at the upper end changes to another power, if they are known."""
        depth = self.rule.profile.transition_depth
        depths = np.empty((1, 0)) if depth is None else np.reshape(depth, (-1, 1)) * TRANSITIONS
        return depths - self.imprint

    @property
    def scales(self):
        """Penetrations whose distance past the onset is one of the rule's `scales`."""
        return self.onset * (1 + self.rule.scales)

    @property
    def halved(self):
        """Penetrations at which pieces of the plastic work were halved: none under laws of the library."""
        return np.empty((len(self.imprint), 0))

    def _kinks_above(self, depth):
        """Return the depths (m) of kinks from the undeformed surface, except kinks below all depths."""
        kinks = [np.reshape(kink, (-1, 1)) for kink in self.rule.profile.kinks if np.any(kink < depth)]
        return np.hstack(kinks) if kinks else np.empty((1, 0))


@dataclass(frozen=True, eq=False)
class ConstantCap(YieldRule):
    """Hardness q_c/a: the cap is the critical depth (m), infinite if nothing yields."""

    critical_depth: np.ndarray | float

    @classmethod
    def of(cls, profile, E_star, q_c):
        """Return the rule for an effective modulus (Pa) and a yield constant (N/m)."""
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

    def yielding_stiffness_radius(self, interval):
        return integrals(self.profile).radius_difference(interval)

    def plastic_integral(self, imprint, increase):
        integral = integrals(self.profile).radius_integral(LiveInterval.above(imprint, increase))
        # If nothing yields, this is an infinite cap times 0.
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
    """Return the live interval at each depth (m), from the largest depth so far (m) and its cap (m)."""
    lower = np.maximum(largest - cap, 0.0)
    # The length is the depth before the first yield, and afterwards the cap minus the depth of unloading.
    length = np.maximum(np.minimum(depth, cap - (largest - depth)), 0.0)
    return LiveInterval(lower, np.maximum(depth, lower), length)


@dataclass(frozen=True, eq=False)
class RadiusCap(YieldRule):
    """Hardness H + q_c/a + f_c/a²: the cap u_c = π a σ_c/(2E*) of the contact radius a on loading.

    `law` is the scaled hardness, with the cap u_c (m) as its line load a σ_c. If g(x)/x does not fall, or
    if H = 0, u_c/s falls with s. Then p = s − u_c grows after it has reached 0.
    """

    law: Any

    @classmethod
    def of(cls, profile, medium):
        """Return the rule for a medium."""
        return cls(profile, medium.law.scaled(np.pi / 2 / medium.E_star, 1.0))

    scales = 0.5 * 50.0 ** np.arange(6)

    def cap(self, depth):
        return self.cap_at(self.profile.radius_at(np.maximum(depth, 0.0)))

    def cap_at(self, a):
        """Return the cap u_c (m) at contact radii (m)."""
        return self.law.line_load(a)

    def may_fall(self, depth):
        # d(a σ_c)/da < 0 at small radii.
        return bool(np.any(self.law.f_c))

    def rate(self, depth):
        return 1 - self.cap_rate_at(self.profile.radius_at(depth))

    def cap_rate_at(self, a):
        """Return du_c/ds at contact radii (m)."""
        rate, slope = self.law.line_load_rate(a), self.profile.reduced_slope_at(a)
        # At first touch both may be 0, or infinite.
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = rate / slope
        return np.where(a < self.profile.wall, rate, 0.0)

    def penetration(self, plastic_depth, imprint):
        return self._penetration(imprint, plastic_depth - imprint)

    def _penetration(self, imprint, increase):
        """Return the penetration y = Δ + u_c (m) at which the plastic depth p₀ has grown by Δ.

        The growing function s/(p₀ + Δ + u_c(s)) of the depth s is 1 at s = p₀ + y.
        """
        plastic_depth = imprint + increase

        def ratio(depth):
            a = self.profile.radius_at(depth)
            total = plastic_depth + self.cap_at(a)
            return depth / total, (total - depth * self.cap_rate_at(a)) / total / total

        # Under a sharp tip that yields from first touch, the ratio is larger everywhere.
        sought = np.where(ratio(np.asarray(check.SHORTEST))[0] < 1, 1.0, 0.0)
        near = plastic_depth + self.cap(plastic_depth)
        start = np.where((plastic_depth > 0) & (near < np.inf), near, 1.0)
        depth = increasing_root(ratio, sought, start, self.profile.known_depth)
        reached = np.where(depth > 0, increase + self.cap(depth), 0.0)
        return np.where(depth < np.inf, reached, np.inf)

    def increase(self, penetration, imprint):
        # Without the rounding of the imprint's depth.
        return np.maximum(penetration - self.cap(imprint + penetration), 0.0)

    def wall_integral(self):
        return self.law.wall_load(np.asarray(self.profile.wall))

    def plastic_integral(self, imprint, increase):
        shape, (imprint, increase) = broadcast_flat(imprint, increase)
        result, yielding = np.zeros(imprint.size), np.flatnonzero(increase > 0)
        for block in chunks(yielding.size, max(1, 512 // (1 + len(self.profile.kinks)))):
            rows = yielding[block]
            rule = self.flat_entries(rows, shape).entries((slice(None), None), rows.shape)
            result[rows] = rule._plastic_sums(imprint[rows, None], increase[rows, None])  # noqa: SLF001
        return result.reshape(shape)[()]

    def _plastic_sums(self, imprint, increase):
        """Return ∫ u_c a(p) dp of loadings, one per row of (N, 1), from kink to kink of a(s) and a(p)."""
        cuts, total = self._cuts(imprint, increase), np.zeros(len(imprint))
        for start, stop in zip(cuts.T[:, :, None], cuts.T[1:, :, None], strict=False):
            if np.any(stop > start):
                total += self.piece(start, stop, imprint, increase)
        return total

    def _cuts(self, imprint, increase):
        """Return penetrations (m), ascending in each row, between which the plastic work is smooth."""
        last = np.minimum(self._penetration(imprint, increase), self.profile.known_depth - imprint)
        at = self.breaks(imprint, imprint + last)
        cuts = np.hstack([at.onset, at.upper, at.lower, at.scales, last])
        return np.sort(np.clip(cuts, at.onset, last), axis=1)

    def piece(self, start, stop, imprint, increase):
        """Return ∫ u_c a(p) dp between penetrations (m), one piece per row of (N, 1); 0 if empty."""
        node, weight = gauss_legendre(_NODES)
        # Past a kink and past the onset, a(p) is a power of the distance with an exponent of at least 1/4.
        y = start + (stop - start) * node**4
        dy = (stop - start) * 4 * node**3 * weight
        p = imprint + np.minimum(self.increase(y, imprint), increase)
        work = self.cap(imprint + y) * self.profile.radius_at(p) * self.rate(imprint + y) * dy
        return np.where(stop > start, work, 0.0).sum(axis=1)

    def in_units_of(self, unit, length, depth):
        return type(self)(unit, self.law.scaled(1 / depth, length))


def yield_rule(profile: Profile, medium: Medium) -> YieldRule:
    """Return the rule of yield for a medium and a profile.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core.solver.contact.yielding import yield_rule
    >>> from mdr_core import Cone, Medium
    >>> rule = yield_rule(Cone(slope=1.0), Medium.from_critical_depth(1.0, critical_depth=1.0))
    >>> rule.path(np.array([0.5, 3.0, 2.5, 1.0])).length.tolist()
    [0.5, 1.0, 0.5, 0.0]
    """
    if medium.inverse_to_radius:
        return ConstantCap.of(profile, medium.E_star, medium.q_c)
    if medium.has_own_law:
        return lazy.cap.UserLawCap.of(profile, medium)
    if np.any(medium.hardness) and not integrals(profile).convex:
        raise check.MDRError(
            "a hardness above 0 needs a convex shape: if g(x)/x falls, a contact that has yielded would "
            "become elastic again; set hardness = 0, or take a convex shape"
        )
    if np.any(medium.q_c) or np.any(medium.f_c):
        return RadiusCap.of(profile, medium)
    return constant_hardness(profile).of(profile, medium)


@singledispatch
def constant_hardness(profile: Profile) -> type[RadiusCap]:
    """Return the rule for a constant hardness alone, with closed forms if they are registered."""
    return RadiusCap
