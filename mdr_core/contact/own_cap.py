"""The rule of yield for a law of hardness of one's own, of which nothing is known beforehand."""

from dataclasses import dataclass

import numpy as np

from ..numerics.blocks import broadcast_flat, chunks
from .radius_cap import RadiusCap

#: Halvings of a piece for a law of one's own: to 10⁻⁹ of its length, as at a kink.
_HALVINGS = 30


@dataclass(frozen=True, eq=False)
class OwnCap(RadiusCap):
    """`RadiusCap` of a law of hardness of one's own, of which nothing is known beforehand."""

    def may_fall(self, depth):
        # Falling caps are looked for from 10⁻⁶ of the depths on, in steps of 7 %.
        depth = np.asarray(depth, dtype=float)
        if np.any(depth == np.inf):
            return True
        if not self.shape:
            depth = np.array([np.min(depth, initial=np.inf), np.max(depth, initial=0.0)])
            steps = np.log(depth[1] / depth[0]) / np.log(1.07) + 200 if depth[1] > 0 else 1
            return self._falls(np.geomspace(1e-6 * depth[0], depth[1], int(steps)) if steps > 1 else depth)
        shape, (depth,) = broadcast_flat(
            np.broadcast_to(depth, np.broadcast_shapes(depth.shape, self.shape))
        )
        return any(
            self.flat_entries(rows, shape)
            .entries((slice(None), None), depth[rows].shape)
            ._falls(depth[rows][:, None] * np.geomspace(1e-6, 1.0, 200))
            for rows in chunks(depth.size, 512)
        )

    @np.errstate(all="ignore")
    def _falls(self, depth):
        return bool(np.any(self.cap_rate_at(self.profile.radius_at(depth)) < 0))

    def _cuts(self, imprint, increase):
        cuts = super()._cuts(imprint, increase)
        sharp = np.minimum(self.law.sharp, self.profile.known_radius)
        depth = self.profile.reduced_at(sharp) - imprint
        return np.sort(np.hstack([cuts, np.clip(depth, cuts[:, :1], cuts[:, -1:])]), axis=1)

    def _plastic_sums(self, imprint, increase):
        return self._refined(imprint, increase)[0]

    def breaks(self, imprint, increase, onset):
        cuts, (_, rows, middles) = self._cuts(imprint, increase), self._refined(imprint, increase)
        order = np.argsort(rows, kind="stable")
        rows, middles = rows[order], middles[order]
        place = np.arange(rows.size) - np.searchsorted(rows, rows)
        padded = np.zeros((len(cuts), np.max(place, initial=-1) + 1))
        padded[rows, place] = middles
        return np.hstack([cuts, padded]) - onset

    @np.errstate(all="ignore")
    def _refined(self, imprint, increase):
        """`RadiusCap._plastic_sums` in pieces that are halved until the sum is that of the halves.

        Also the middles (m) of pieces that were halved, and their rows.
        """
        imprint, increase = np.broadcast_arrays(imprint, increase)
        cuts, total = self._cuts(imprint, increase), np.zeros(len(imprint))
        cuts = np.broadcast_to(cuts, (len(imprint), cuts.shape[1]))
        rows, k = np.nonzero(np.diff(cuts) > 0)
        start, stop = cuts[rows, k, None], cuts[rows, k + 1, None]
        halved, middles = [rows[:0]], [start[:0, 0]]
        whole = self._pieces(rows, start, stop, imprint, increase)
        for _ in range(_HALVINGS):
            middle = (start + stop) / 2
            halves = (np.append(rows, rows), np.append(start, middle, 0), np.append(middle, stop, 0))
            parts = self._pieces(*halves, imprint, increase)
            both = parts[: rows.size] + parts[rows.size :]
            scale = total + np.bincount(rows, np.abs(both), len(total))
            # To the rounding of the sum.
            rough = np.abs(both - whole) > 1e-14 * scale[rows]
            total += np.bincount(rows[~rough], both[~rough], len(total))
            halved.append(rows[rough])
            middles.append(middle[rough, 0])
            again = np.append(rough, rough)
            rows, start, stop = (part[again] for part in halves)
            whole = parts[again]
            if not rows.size:
                break
        total += np.bincount(rows, whole, len(total))
        return total, np.concatenate(halved), np.concatenate(middles)

    def _pieces(self, rows, start, stop, imprint, increase):
        """`_piece` of rows of the ensemble."""
        own = self.entries(rows) if self.shape else self
        return own._piece(start, stop, imprint[rows], increase[rows])

    def wall_integral(self):
        # Without a wall its limit for a → ∞ is not known: a force that is too large has no depth.
        wall = np.asarray(self.profile.wall)
        load = self.law.wall_load(np.where(wall < np.inf, wall, 1.0))
        return np.where(wall < np.inf, load, np.inf)[()]
