"""The rule of yield for the hardness H + q_c/a + f_c/a²: its cap depends on the contact radius."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _check
from ..numerics.blocks import broadcast_flat, chunks
from ..numerics.gauss import gauss_legendre
from ..numerics.roots import increasing_root
from .rule_of_yield import YieldRule

#: Gauss nodes of the plastic work in each piece. Works of five shapes over seven decades of speed then have
#: errors of 4·10⁻¹⁵ at most, with 16 nodes 7·10⁻¹³: measured by `python -m tests.benchmarks.constants`.
_NODES = 24


@dataclass(frozen=True, eq=False)
class RadiusCap(YieldRule):
    """Hardness H + q_c/a + f_c/a²: the cap u_c = π a σ_c/(2E*) of the contact radius a on loading.

    `law` is that of the cap: the hardness scaled so that u_c (m) is its line load a σ_c. Where g(x)/x does
    not fall, nor for H = 0 anywhere, u_c/s falls with s: p = s − u_c grows once it is 0.
    """

    law: Any

    @classmethod
    def of(cls, profile, medium):
        """The rule for a medium."""
        return cls(profile, medium.law.scaled(np.pi / 2 / medium.E_star, 1.0))

    scales = 0.5 * 50.0 ** np.arange(6)

    def cap(self, depth):
        return self.cap_at(self.profile.radius_at(np.maximum(depth, 0.0)))

    def cap_at(self, a):
        """The cap u_c (m) at contact radii (m)."""
        return self.law.line_load(a)

    def may_fall(self, depth):
        # d(a σ_c)/da < 0 at small radii.
        return bool(np.any(self.law.f_c))

    def rate(self, depth):
        return 1 - self.cap_rate_at(self.profile.radius_at(depth))

    def cap_rate_at(self, a):
        """du_c/ds at contact radii (m)."""
        rate, slope = self.law.line_load_rate(a), self.profile.reduced_slope_at(a)
        # At first touch both may be 0, or infinite.
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = rate / slope
        return np.where(a < self.profile.wall, rate, 0.0)

    def penetration(self, plastic_depth, imprint):
        return self._penetration(imprint, plastic_depth - imprint)

    def _penetration(self, imprint, increase):
        """Penetration (m) at which loading increases the plastic depth p₀ of an imprint: y = Δ + u_c.

        The depth is s = p₀ + y, at which s/(p₀ + Δ + u_c(s)), a growing function of s, is 1.
        """
        plastic_depth = imprint + increase

        def ratio(depth):
            a = self.profile.radius_at(depth)
            total = plastic_depth + self.cap_at(a)
            return depth / total, (total - depth * self.cap_rate_at(a)) / total / total

        # Under a sharp tip that yields from first touch on the ratio is larger everywhere.
        sought = np.where(ratio(np.asarray(_check.SHORTEST))[0] < 1, 1.0, 0.0)
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
            result[rows] = rule._plastic_sums(imprint[rows, None], increase[rows, None])
        return result.reshape(shape)[()]

    def _plastic_sums(self, imprint, increase):
        """∫ u_c a(p) dp of loadings, one a row of (N, 1), from kink to kink of a(s) and a(p)."""
        cuts, total = self._cuts(imprint, increase), np.zeros(len(imprint))
        for start, stop in zip(cuts.T[:, :, None], cuts.T[1:, :, None], strict=False):
            if np.any(stop > start):
                total += self.piece(start, stop, imprint, increase)
        return total

    def _cuts(self, imprint, increase):
        """Penetrations (m), ascending in each row, between which the plastic work is smooth."""
        first = self._penetration(imprint, 0 * increase)
        last = np.minimum(self._penetration(imprint, increase), self.profile.known_depth - imprint)
        # Those that neither end of the live interval reaches would cut nothing.
        kinks = [kink - imprint for kink in self.profile.kinks if np.any(kink < imprint + last)]
        passed_by_lower = [self._penetration(imprint, kink) for kink in kinks if np.any(kink < increase)]
        cuts = np.hstack([first, *kinks, *passed_by_lower, first * (1 + self.scales), last])
        return np.sort(np.clip(cuts, first, last), axis=1)

    def piece(self, start, stop, imprint, increase):
        """∫ u_c a(p) dp between two penetrations (m), one piece a row of (N, 1); 0 where stop is start."""
        node, weight = gauss_legendre(_NODES)
        # Past a kink and past the onset a(p) is a power of the distance, of a fourth at least.
        y = start + (stop - start) * node**4
        dy = (stop - start) * 4 * node**3 * weight
        p = imprint + np.minimum(self.increase(y, imprint), increase)
        work = self.cap(imprint + y) * self.profile.radius_at(p) * self.rate(imprint + y) * dy
        return np.where(stop > start, work, 0.0).sum(axis=1)

    def in_units_of(self, unit, length, depth):
        return type(self)(unit, self.law.scaled(1 / depth, length))
