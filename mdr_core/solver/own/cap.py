"""The rule of yield for a user's law of hardness, which may be any function."""

from dataclasses import dataclass

import numpy as np

from ..contact.yielding import Breaks, RadiusCap
from .rows import largest_in_blocks

#: Largest number of halvings of a piece of the plastic work: to 10⁻⁹ of its length, for example at a kink.
_HALVINGS = 30
#: A piece is halved again if it differs from its halves by more than the first share of its work, for
#: example at a kink. It is also halved if the difference is below the second share of its parent's
#: difference. A numerical derivative has a noise of 10⁻⁸, and a half has half of it; without this rule an
#: impact takes 200 times as long.
_KINKED = 1e-7
_HELPED = 0.25
#: Shares of a depth at which to search for a falling cap, each deeper by 7 %.
_SHARES = np.geomspace(1e-9, 1.0, 307)


@dataclass(frozen=True, eq=False)
class UserLawCap(RadiusCap):
    """`RadiusCap` of a user's law of hardness."""

    def may_fall(self, depth):
        if np.any(np.isinf(depth)):
            return True
        for rows, depths in largest_in_blocks(self.profile, depth, self.shape):
            own = self.flat_entries(rows, self.shape).entries((slice(None), None), rows.shape)
            if np.any(own.cap_rate_at(own.profile.radius_at(depths[:, None] * _SHARES)) < 0):
                return True
        return False

    def breaks(self, imprint, deepest):
        return UserLawBreaks(self, imprint, deepest)

    def _plastic_sums(self, imprint, increase):
        work, *_ = self.refined(imprint, increase)
        return work

    def refined(self, imprint, increase):
        """Compute the plastic work in pieces, halved until each is the sum of its halves.

        Returns
        -------
        work : ndarray, shape (N,)
            ∫ u_c a(p) dp (m³), one loading per row.
        row, halved_at : ndarray, shape (M,)
            Loadings, and the penetrations (m) at which their pieces were halved.
        """
        imprint, increase = np.broadcast_arrays(imprint, increase)
        cuts, size = self._cuts(imprint, increase), len(imprint)
        cuts = np.broadcast_to(cuts, (size, cuts.shape[1]))
        # If nothing yields, all cuts are infinite.
        row, number = np.nonzero(cuts[:, 1:] > cuts[:, :-1])
        start, stop = cuts[row, number, None], cuts[row, number + 1, None]
        whole, former = self._pieces(row, start, stop, imprint, increase), np.inf
        work, halved = np.zeros(size), []
        for _ in range(_HALVINGS):
            own, middle = row, (start + stop) / 2
            # The first halves of all pieces, followed by the second halves.
            row, start, stop = np.append(row, row), np.vstack([start, middle]), np.vstack([middle, stop])
            half = self._pieces(row, start, stop, imprint, increase)
            both = half[: own.size] + half[own.size :]
            miss = np.abs(both - whole)
            helps = (miss > _KINKED * np.abs(both)) | (miss <= _HELPED * former)
            # The rounding of the sum.
            scale = work + np.bincount(own, np.abs(both), size)
            rough = (miss > 1e-14 * scale[own]) & helps
            work += np.bincount(own[~rough], both[~rough], size)
            halved.append((own[rough], middle[rough, 0]))
            former, again = np.append(miss[rough], miss[rough]), np.append(rough, rough)
            row, start, stop, whole = row[again], start[again], stop[again], half[again]
            if not row.size:
                break
        return work + np.bincount(row, whole, size), *map(np.concatenate, zip(*halved, strict=True))

    def _pieces(self, row, start, stop, imprint, increase):
        """Return `piece` of loadings `row` of the ensemble, one piece per row of penetrations (M, 1)."""
        return self.entries(row).piece(start, stop, imprint[row], increase[row])

    def wall_integral(self):
        # Without a wall, the limit for a → ∞ is not known: a force that is too large has no depth.
        wall = np.asarray(self.profile.wall)
        load = self.law.wall_load(np.where(wall < np.inf, wall, 1.0))
        return np.where(wall < np.inf, load, np.inf)[()]


@dataclass(frozen=True, eq=False)
class UserLawBreaks(Breaks):
    """`Breaks` under a user's law."""

    @property
    def scales(self):
        """Penetrations at the rule's `scales`, and where the law changes fast at the upper end."""
        sharp = np.minimum(self.rule.law.sharp, self.rule.profile.known_radius)
        return np.hstack([super().scales, self.rule.profile.reduced_at(sharp) - self.imprint])

    @property
    def halved(self):
        increase = self.rule.increase(self.deepest - self.imprint, self.imprint)
        _, row, halved_at = self.rule.refined(self.imprint, increase)
        return _padded(row, halved_at, len(self.imprint))


def _padded(row, values, count):
    """Return values by the numbers of their rows, as rows of one length padded with zeros, (count, K)."""
    order = np.argsort(row, kind="stable")
    row = row[order]
    # Place of each value within its row.
    place = np.arange(row.size) - np.searchsorted(row, row)
    padded = np.zeros((count, np.max(place, initial=-1) + 1))
    padded[row, place] = values[order]
    return padded
