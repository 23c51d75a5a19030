"""The rule of yield for a law of hardness that a user wrote, of which nothing is known beforehand."""

from dataclasses import dataclass

import numpy as np

from ..contact.yielding import Breaks, RadiusCap
from ..numerics.blocks import broadcast_flat, chunks

#: Halvings of a piece of the plastic work: to 10⁻⁹ of its length, as at a kink.
_HALVINGS = 30
#: A piece is halved again while it differs from its halves by more than this share of its work, as at a
#: kink, or by less than this share of what the piece differed of which it is a half. A derivative that is a
#: difference has a noise of 10⁻⁸, of which a half has half: without this an impact takes 200 times as long.
_KINKED = 1e-7
_HELPED = 0.25
#: A falling cap is looked for from this share of a depth on, in so many steps, each deeper by 7 %.
_SHALLOWEST = 1e-6
_STEPS = 200
_STEP = 1.07


@dataclass(frozen=True, eq=False)
class OwnCap(RadiusCap):
    """`RadiusCap` of a law of hardness that a user wrote."""

    def may_fall(self, depth):
        depth = np.asarray(depth, dtype=float)
        if np.any(depth == np.inf):
            return True
        if self.shape:
            return self._any_may_fall(depth)
        largest = np.max(depth, initial=0.0)
        if largest == 0:
            return False
        smallest = np.min(depth)
        steps = int(np.log(largest / smallest) / np.log(_STEP)) + _STEPS
        return self._falls(np.geomspace(_SHALLOWEST * smallest, largest, steps))

    def _any_may_fall(self, depth):
        """`may_fall` of an ensemble, up to a depth (m) each."""
        shape, (depth,) = broadcast_flat(
            np.broadcast_to(depth, np.broadcast_shapes(depth.shape, self.shape))
        )
        share = np.geomspace(_SHALLOWEST, 1.0, _STEPS)
        for rows in chunks(depth.size, 512):
            own = self.flat_entries(rows, shape).entries((slice(None), None), depth[rows].shape)
            if own._falls(depth[rows][:, None] * share):
                return True
        return False

    def _falls(self, depth):
        """Whether the cap falls at any of the depths (m)."""
        return bool(np.any(self.cap_rate_at(self.profile.radius_at(depth)) < 0))

    def breaks(self, imprint, deepest):
        return OwnBreaks(self, imprint, deepest)

    def _plastic_sums(self, imprint, increase):
        work, *_ = self.refined(imprint, increase)
        return work

    def refined(self, imprint, increase):
        """The plastic work in pieces, halved until each is the sum of its halves; one loading a row.

        Returns
        -------
        work : ndarray, shape (N,)
            ∫ u_c a(p) dp (m³).
        row, halved_at : ndarray, shape (M,)
            Loadings, and the penetrations (m) at which pieces of theirs were halved.
        """
        imprint, increase = np.broadcast_arrays(imprint, increase)
        cuts = self._cuts(imprint, increase)
        cuts = np.broadcast_to(cuts, (len(imprint), cuts.shape[1]))
        # Where nothing yields all cuts are infinite.
        row, number = np.nonzero(cuts[:, 1:] > cuts[:, :-1])
        start, stop = cuts[row, number, None], cuts[row, number + 1, None]
        whole = self._pieces(row, start, stop, imprint, increase)
        work, former = np.zeros(len(imprint)), np.full(row.size, np.inf)
        halved_row, halved_at = [row[:0]], [start[:0, 0]]
        for _ in range(_HALVINGS):
            middle = (start + stop) / 2
            # The first halves of all pieces, and then the second ones.
            half_row = np.append(row, row)
            half_start, half_stop = np.vstack([start, middle]), np.vstack([middle, stop])
            half = self._pieces(half_row, half_start, half_stop, imprint, increase)
            both = half[: row.size] + half[row.size :]
            scale = work + np.bincount(row, np.abs(both), len(work))
            miss = np.abs(both - whole)
            helps = (miss > _KINKED * np.abs(both)) | (miss <= _HELPED * former)
            # To the rounding of the sum.
            rough = (miss > 1e-14 * scale[row]) & helps
            work += np.bincount(row[~rough], both[~rough], len(work))
            halved_row.append(row[rough])
            halved_at.append(middle[rough, 0])
            again = np.append(rough, rough)
            former = np.append(miss[rough], miss[rough])
            row, start, stop, whole = half_row[again], half_start[again], half_stop[again], half[again]
            if not row.size:
                break
        work += np.bincount(row, whole, len(work))
        return work, np.concatenate(halved_row), np.concatenate(halved_at)

    def _pieces(self, row, start, stop, imprint, increase):
        """`piece` of loadings `row` of the ensemble, one piece a row of the penetrations (M, 1)."""
        own = self.entries(row) if self.shape else self
        return own.piece(start, stop, imprint[row], increase[row])

    def wall_integral(self):
        # Without a wall its limit for a → ∞ is not known: a force that is too large has no depth.
        wall = np.asarray(self.profile.wall)
        load = self.law.wall_load(np.where(wall < np.inf, wall, 1.0))
        return np.where(wall < np.inf, load, np.inf)[()]


@dataclass(frozen=True, eq=False)
class OwnBreaks(Breaks):
    """`Breaks` under a law that a user wrote."""

    @property
    def scales(self):
        """Those of the rule, and where the law itself changes fast at the upper end."""
        sharp = np.minimum(self.rule.law.sharp, self.rule.profile.known_radius)
        return np.hstack([super().scales, self.rule.profile.reduced_at(sharp) - self.imprint])

    @property
    def halved(self):
        increase = self.rule.increase(self.deepest - self.imprint, self.imprint)
        _, row, halved_at = self.rule.refined(self.imprint, increase)
        return _padded(row, halved_at, len(self.imprint))


def _padded(row, values, count):
    """Values by the numbers of their rows, as rows of one length that end in zeros: shape (count, K)."""
    order = np.argsort(row, kind="stable")
    row = row[order]
    # Place of each value among those of its row.
    place = np.arange(row.size) - np.searchsorted(row, row)
    padded = np.zeros((count, np.max(place, initial=-1) + 1))
    padded[row, place] = values[order]
    return padded
