"""An indenter given by samples of its height, as a measured tip is."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import _check
from .inverse import newton
from .panels import chunks
from .profiles import Profile
from .table import read_samples
from .zones import Zone

#: Every sample meets every other one.
_MOST_SAMPLES = 5000


@dataclass(frozen=True)
class Sampled(Profile):
    """The polygon through samples of the height, solved exactly.

    Its reduced height is x Σ sᵢ [arcsin(min(rᵢ₊₁, x)/x) − arcsin(rᵢ/x)] with the slopes sᵢ, from
    Popov (2015), Eq. (3). The polygon must be convex: behind a vertex at which the slope falls,
    g falls with a vertical tangent, and the contact would not be compact.

    Parameters
    ----------
    r : array_like
        Radii (m), strictly ascending from 0; at least two.
    z : array_like
        Heights (m) at `r`; they count from the first one.

    Raises
    ------
    ValueError
        If the samples are not as above, or pressed deeper than they reach.

    Examples
    --------
    >>> tip = Sampled([0.0, 1.0, 2.0], [0.0, 1.0, 3.0])
    >>> print(round(tip.reduced(1.0), 12), tip.deepest > 3)  # π/2
    1.570796326795 True
    """

    r: tuple[float, ...]
    z: tuple[float, ...]

    def __post_init__(self):
        r, z = (
            _check.finite_array(f"Sampled {what}", values, unit="m", most=_check.LONGEST)
            for what, values in (("r", self.r), ("z", self.z))
        )
        if r.ndim != 1 or r.shape != z.shape or r.size < 2:
            raise ValueError(
                f"Sampled r and z must be two lists of one length ≥ 2, got shapes {r.shape}, {z.shape}"
            )
        if r.size > _MOST_SAMPLES:
            raise ValueError(
                f"Sampled has {r.size} samples, more than {_MOST_SAMPLES}; thin them out, as in r[::10]"
            )
        if r[0] != 0:
            raise ValueError(f"Sampled r[0] = {r[0]:g} m must be 0: add the sample at the tip")
        tiny, remedy = (r > 0) & (r < _check.SHORTEST), "give it in SI units"
        bound = f"must be 0 or at least {_check.SHORTEST:g}"
        _check.refuse("Sampled r", r, tiny, bound, unit="m", remedy=remedy)
        back = np.append(False, np.diff(r) <= 0)
        _check.refuse("Sampled r", r, back, "does not ascend", unit="m", remedy="sort, and drop duplicates")
        object.__setattr__(self, "r", tuple(r.tolist()))
        object.__setattr__(self, "z", tuple((z - z[0]).tolist()))
        self._refuse_concave()

    @classmethod
    def from_csv(cls, path, unit=None):
        """The tip in a CSV file with two columns, radius and height.

        Parameters
        ----------
        path : path-like
            File with one sample a row: separated by commas, semicolons, tabs or blanks. Lines that
            begin with # are passed over. A header may name the units, as in ``r (nm), z (nm)``.
        unit : {"m", "mm", "um", "µm", "nm"}, optional
            Unit of both columns, if the header does not name them.

        Raises
        ------
        ValueError
            If the file is not in UTF-8, a row is not two numbers, or no unit is given, or two that differ.
        """
        return cls(*read_samples(path, unit, _MOST_SAMPLES))

    @classmethod
    def convex_envelope(cls, r, z):
        """The largest convex shape under the samples: what is left of a noisy tip for a compact contact.

        Parameters
        ----------
        r, z : array_like
            As for `Sampled`, convex or not.

        Examples
        --------
        >>> Sampled.convex_envelope([0, 1, 2, 3], [0, 2, 2.5, 6]).r
        (0.0, 2.0, 3.0)
        """
        r, z = (_check.finite_array(f"Sampled {n}", v, unit="m") for n, v in (("r", r), ("z", z)))
        if r.ndim != 1 or r.shape != z.shape or r.size < 2:
            raise ValueError(f"r, z must be two lists of one length ≥ 2, got shapes {r.shape}, {z.shape}")
        hull = []
        for point in zip(r.tolist(), z.tolist(), strict=True):
            while len(hull) > 1 and _turns_down(*hull[-2:], point):
                hull.pop()
            hull.append(point)
        return cls(*zip(*hull, strict=True))

    def _refuse_concave(self):
        r, z, slope = self._r, self._z, self._slope
        # Straight within the rounding of the heights counts as straight.
        noise = 4 * np.finfo(float).eps * (np.abs(z[1:]) + np.abs(z[:-1])) / np.diff(r)
        fall = slope[:-1] - slope[1:]
        concave = np.append(False, fall > noise[1:] + noise[:-1])
        if slope[0] < 0:
            raise ValueError(
                f"Sampled z[1] = {z[1]:g} m lies below the tip; order the samples from the tip out"
            )
        if np.any(concave):
            i = int(np.argmax(concave))
            raise ValueError(
                f"Sampled shape is concave at r[{i}] = {r[i]:g} m (slope {slope[i - 1]:g} before, "
                f"{slope[i]:g} after), so that the contact would not be compact; smooth the samples or "
                "take Sampled.convex_envelope(r, z)"
            )
        if not slope[-1] > 0:
            raise ValueError("Sampled z is flat throughout; use FlatPunch")

    # The polygon is a sum of truncated cones, one from each vertex, by the change of slope there.
    _r = cached_property(lambda self: np.array(self.r))
    _z = cached_property(lambda self: np.array(self.z))
    _slope = cached_property(lambda self: np.diff(self._z) / np.diff(self._r))
    _bend = cached_property(lambda self: np.diff(self._slope, prepend=0.0))

    @cached_property
    def _g(self):
        """Reduced height at the vertices (m)."""
        return self._reduced(self._r)

    # The samples are one indenter, not many.
    shape = ()
    known_radius = property(lambda self: self.r[-1])
    kinks = property(lambda self: tuple(g for g in self._g[1:-1].tolist() if g > 0))
    deepest = property(lambda self: float(self._g[-1]))

    @cached_property
    def zones(self):
        return tuple(self._zone(j) for j in range(len(self.r) - 1))

    def zones_between(self, lower, upper):
        first = max(np.searchsorted(self._g, lower, side="right") - 1, 0)
        last = np.searchsorted(self._g, upper, side="left")
        return tuple(zone for zone in self.zones[first:last] if zone.scale > 0)

    def _zone(self, j):
        kink, height = float(self._r[j]), self._g[j + 1] - self._g[j]
        if self._g[j + 1] == 0:
            # Under a flat face no depth is gained.
            return Zone(np.zeros_like, np.zeros_like, order=0, kink=kink, scale=0.0)
        step = _VertexSum(self._r[: j + 1], self._bend[: j + 1])
        end = float(np.sqrt((self._r[j + 1] - kink) * (self._r[j + 1] + kink)))

        def coordinate(depth):
            depth = np.asarray(depth)
            result = np.where(depth > self._g[j], end, 0.0)
            inside = (depth > self._g[j]) & (depth < self._g[j + 1])
            if inside.any():
                result[inside] = step.inverse(depth[inside] - self._g[j], end, height)
            return result

        return Zone(step.rate, coordinate, order=0, kink=kink, scale=step.scale, end=end)

    def _height(self, r):
        beyond = np.maximum(r - self._r[-1], 0.0)
        return np.interp(r, self._r, self._z) + self._slope[-1] * beyond

    def _reduced(self, x):
        x = np.asarray(x)
        total = np.pi / 2 * self._bend[0] * x
        farthest = np.max(x, initial=0.0)
        for radius, bend in zip(self._r[1:-1], self._bend[1:], strict=True):
            if radius >= farthest:
                break
            behind = np.sqrt(np.maximum(x - radius, 0.0) * (x + radius))
            total = total + bend * x * np.arctan2(behind, radius)
        return total

    def _radius(self, depth):
        depth = np.asarray(depth)
        flat = depth.ravel()
        result = np.full(flat.shape, self._r[np.count_nonzero(self._g == 0) - 1])
        index = np.clip(np.searchsorted(self._g, flat, side="left") - 1, 0, len(self.r) - 2)
        for j in np.unique(index[flat > 0]):
            rows = (index == j) & (flat > 0)
            result[rows] = self.zones[j].radius(self.zones[j].coordinate(flat[rows]))
        return result.reshape(depth.shape)


class _VertexSum:
    """Reduced height behind the last of some vertices, as a sum over them, in t = √(x² − r_j²)."""

    def __init__(self, r, bend):
        self.r, self.bend = float(r[-1]), bend[-1]
        self.inner_r, self.inner_bend = r[1:-1], bend[1:-1]
        self.tip = np.pi / 2 * bend[0]
        self.inner = (self.r - self.inner_r) * (self.r + self.inner_r)
        self.scale = float(np.sqrt(self.inner[-1])) if len(self.inner) else self.r or 1.0
        self._table = None

    def rate(self, t):
        """dg/dt."""
        if self.r == 0:
            return np.full_like(t, self.tip)
        x = np.hypot(self.r, t)
        w = np.sqrt(np.square(t)[..., None] + self.inner)
        others = self.tip + (np.arctan2(w, self.inner_r) + self.inner_r / w) @ self.inner_bend
        return (self.bend * (np.arctan2(t, self.r) * t + self.r) + others * t) / x

    def rise(self, t):
        """g − g(r_j), without cancellation however small t is."""
        x = np.hypot(self.r, t)
        square = np.square(t)[..., None]
        w, w0 = np.sqrt(square + self.inner), np.sqrt(self.inner)
        dx = t * t / (x + self.r)
        turn = np.arctan2(self.inner_r * square / (w + w0), self.inner_r**2 + w * w0)
        others = (dx[..., None] * np.arctan2(w, self.inner_r) + self.r * turn) @ self.inner_bend
        return self.bend * x * np.arctan2(t, self.r) + self.tip * dx + others

    def inverse(self, rise, end, height):
        """t at a rise between 0 and `height`, which is reached at `end`."""
        if self.r == 0:
            return rise / self.tip
        table, root = self._start(end)
        result = np.empty_like(rise)
        for rows in chunks(rise.size, 1024):
            target = rise[rows]

            def step(t, target=target):
                # A bend that is rounding only may have the wrong sign next to the vertex.
                return (self.rise(t) - target) / np.maximum(self.rate(t), target / end)

            # g is convex in t: from the right Newton's method only descends.
            result[rows] = newton(step, np.interp(np.sqrt(target), root, table), largest=end)
        return result

    def _start(self, end):
        """t from 0 to `end`, and the root of the rise there, which is nearly straight between them."""
        if self._table is None:
            near = np.geomspace(1e-3 * min(self.scale / end, 1.0), 1.0, 48)
            t = end * np.unique(np.concatenate([[0.0], near, np.linspace(0, 1, 48)]))
            self._table = t, np.sqrt(np.maximum.accumulate(np.maximum(self.rise(t), 0.0)))
        return self._table


def _turns_down(first, middle, last):
    (r0, z0), (r1, z1), (r2, z2) = first, middle, last
    return (z1 - z0) * (r2 - r1) > (z2 - z1) * (r1 - r0)
