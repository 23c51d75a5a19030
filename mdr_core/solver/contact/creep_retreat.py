"""The scalar law of creep for a receding indenter.

a(s) is the contact radius, f = F/(2E*), and A = ∫ a ds over the live interval [d_p, D]. Elements are
released from the rim inward, at the height g = D = d + τḋ, and

    A = f     as long as the force does not rise.

The edge of the contact follows the force at once. The depth excess e = d − D of the indenter obeys
τ ė = −e − τ Ḋ. A released element relaxes from the e at its release, and does not touch the indenter again.
Times are in units of τ, and f is linear between the given times.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..numerics.gauss import gauss_legendre
from .integrals import integrals
from .live_interval import LiveInterval
from .loading import live_length
from .quadrature import nodes
from .yielding import YieldRule

#: Ages (τ) between which the memory of a retreating edge is integrated; older ages contribute e⁻⁶⁴.
_AGES = np.array([0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0])


@dataclass(frozen=True, eq=False)
class Retreat:
    """The law of a falling depth after a turning point, with states at the times of `area`, f (m²).

    The first state is the turning point, with the live interval `interval`. `ds` (τ) are the times between
    states, and `count` is the number of Gauss nodes in each piece.
    """

    rule: YieldRule
    interval: LiveInterval
    area: np.ndarray
    ds: np.ndarray
    count: int

    # Cached, `length` makes creep 2.5 times as fast, `_edges` 3.7 times, and `states` elements 2.5 times.
    @cached_property
    def length(self):
        """D − d_p (m) of the states."""
        return self._lengths(self.area)

    @property
    def depth(self):
        """Depths d (m) of the states."""
        return self.interval.lower + (self.length + self.states[0])

    def _lengths(self, area):
        """Return D − d_p (m) at which A has values (m²)."""
        return live_length(self.rule.profile, self.interval, area)

    @property
    def fall(self):
        """−df/ds (m²) between the states."""
        return -np.diff(self.area) / self.ds

    @cached_property
    def _edges(self):
        """D − d_p (m) at the `_AGES` before each state except the first: one ascending row per state.

        Ages end at the preceding state.
        """
        ages = np.minimum(_AGES, self.ds[:, None])
        area = np.minimum(self.area[1:, None] + self.fall[:, None] * ages, self.area[:-1, None])
        edges = np.where(ages < self.ds[:, None], self._lengths(area), self.length[:-1, None])
        edges[:, 0] = self.length[1:]
        return np.maximum.accumulate(edges, axis=1)

    def _memory(self, k, low):
        """Return ∫ e⁻ᵛ dD, ∫ e⁻ᵛ (1 − e⁻ᵛ) dD and ∫ (1 − e⁻ᵛ) dD (m) between states k and k + 1.

        The shape is (3, M). The edge of the contact went from the D of state k down to D − d_p = `low` (m),
        shape (M,). The age v (τ) is the time from the edge at D to state k + 1: v = (A(D) − f)/(−df/ds),
        with the f of state k + 1.
        """
        start = np.maximum(self._edges[k, :-1], low[:, None])
        stop = np.broadcast_to(self._edges[k, 1:], start.shape)
        row, piece = np.nonzero(stop > start)
        result = np.zeros((3, low.size))
        # Edges older than the largest age.
        result[2] = self.length[k] - np.maximum(self._edges[k, -1], low)
        if not row.size:
            return result
        start, stop, lower = start[row, piece], stop[row, piece], self.interval.lower
        length, weight = nodes(start, stop, lower + start, gauss_legendre(self.count))
        area = integrals(self.rule.profile).radius_integral(LiveInterval.above(lower, length))
        age = np.maximum(area - self.area[k + 1], 0.0) / self.fall[k]
        share, faded = weight * np.exp(-age), -np.expm1(-age)
        for sums, values in zip(result, (share, share * faded, weight * faded), strict=True):
            sums += np.bincount(row, values.sum(axis=1), minlength=low.size)
        return result

    @cached_property
    def states(self):
        """e (m), R (m³) and work of the dashpots over 2E* (m³) of the states, shape (3, N).

        E* R is the energy e² a E* that e adds to 2E* (∫ (D − s) a ds + e A) of the contact, plus the energy
        of the released elements. dR/ds = −2R + 2e(−df/ds), and the dashpots take 2 · E* R ds.
        """
        states = np.zeros((3, len(self.area)))
        for k, (ds, fall) in enumerate(zip(self.ds, self.fall, strict=True)):
            depth_excess, remainder, work = states[:, k]
            decay, passed = np.exp(-ds), -np.expm1(-ds)
            memory, released, followed = self._memory(k, self.length[k + 1 : k + 2])[:, 0]
            later = remainder * decay**2 + 2 * fall * (depth_excess * decay * passed + released)
            # ∫ e ds, the distance by which the indenter recedes.
            travel = depth_excess * passed + followed
            taken = np.maximum((remainder - later) / 2 + fall * travel, 0.0)
            states[:, k + 1] = depth_excess * decay + memory, later, work + taken
        return states

    def released(self, height):
        """Return compressions (m) of released elements of heights g (m) in all states, shape (N, M)."""
        place, result = height - self.interval.lower, np.zeros((len(self.area), height.size))
        for k, ds in enumerate(self.ds):
            decay, depth_excess = np.exp(-ds), self.states[0, k]
            free = place >= self.length[k]
            result[k + 1, free] = result[k, free] * decay
            # Without the elements that were never in contact.
            now = np.flatnonzero(~free & (place >= self.length[k + 1]))
            if now.size:
                result[k + 1, now] = depth_excess * decay + self._memory(k, place[now])[0]
        return result
