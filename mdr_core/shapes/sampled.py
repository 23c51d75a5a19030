"""An indenter given by samples of its height, as a measured tip is."""

from dataclasses import dataclass
from functools import cached_property
from os import PathLike

import numpy as np

from .. import _check
from .._check import ArrayLike, Parameter
from .._numeric import chunks, root
from .profile import Profile
from .tables import area_samples, convex_fit, read_samples

#: Every sample meets every other one.
_MOST_SAMPLES = 5000
#: So many are listed.
_SHOWN = 6


@dataclass(frozen=True, repr=False)
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
    >>> print(round(tip.reduced(1.0), 12), tip.known_depth > 3)  # π/2
    1.570796326795 True
    """

    r: Parameter
    z: Parameter

    def __post_init__(self):
        r, z = _lists("Sampled", self.r, self.z, most=_check.LONGEST)
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

    def __repr__(self) -> str:
        if len(self.r) <= _SHOWN:
            return f"Sampled(r={self.r!r}, z={self.z!r})"
        return f"Sampled({len(self.r)} samples to r = {self.r[-1]:g} m, z = {self.z[-1]:g} m)"

    @classmethod
    def from_csv(cls, path: str | PathLike[str], unit: str | None = None) -> "Sampled":
        """The tip in a text file with columns radius and height, as spreadsheets write them.

        Parameters
        ----------
        path : path-like
            File with one sample a row: separated by commas, semicolons, tabs or blanks. Decimals may
            have a comma where something else separates. Further columns are left out, lines that
            begin with # passed over. A header may name the units: ``r (nm), z (nm)`` or ``r/nm; z/nm``.
        unit : {"m", "mm", "um", "µm", "nm"}, optional
            Unit of both columns, if the header does not name them.

        Raises
        ------
        ValueError
            If the file is not in UTF-8, a row is not two numbers, or no unit is given, or two that differ.
        """
        return cls(*read_samples(path, unit, _MOST_SAMPLES))

    @classmethod
    def convex_envelope(cls, r: ArrayLike, z: ArrayLike) -> "Sampled":
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
        r, z = _lists("Sampled.convex_envelope", r, z)
        hull = []
        for point in zip(r.tolist(), z.tolist(), strict=True):
            while len(hull) > 1 and _turns_down(*hull[-2:], point):
                hull.pop()
            hull.append(point)
        return cls(*zip(*hull, strict=True))

    @classmethod
    def fit(cls, r: ArrayLike, z: ArrayLike) -> "Sampled":
        """The convex tip that is nearest to noisy samples, by least squares in the height.

        Samples may lie on both sides of the axis at r = 0, in any order; the height of the tip is found
        with its shape. Noise makes it a little higher or lower, with no preference where the contact has
        many samples, while `convex_envelope` runs along the lowest ones. An apex is found no sharper than
        noise and spacing allow.

        Parameters
        ----------
        r, z : array_like
            Radii (m), negative on the other side of the axis, and heights (m); at least three radii.

        Examples
        --------
        >>> tip = Sampled.fit([-2.0, -1.0, 0.0, 1.0, 2.0], [2.1, 0.9, 0.0, 1.1, 1.9])
        >>> print(round(tip.height(2.0), 12))
        2.0
        """
        r, z = _lists("Sampled.fit", r, z)
        if np.unique(np.abs(r)).size < 3:
            raise ValueError("Sampled.fit needs three radii or more that differ")
        return cls(*convex_fit(np.abs(r), z))

    @classmethod
    def from_area_function(cls, coefficients: ArrayLike, height: float, samples: int = 400) -> "Sampled":
        """The tip whose cross-section is A(h) = C₀h² + C₁h + C₂h^(1/2) + C₃h^(1/4) + … at a height h.

        As instruments report their tips (Oliver and Pharr 1992), as a polygon up to some height. Where it
        is slightly concave, as calibrated ones are, neighbouring slopes are averaged.

        Parameters
        ----------
        coefficients : array_like
            C₀, C₁, … for A in m² and h in m; Cᵢ belongs to h^(2/2ⁱ).
        height : float
            Height (m) up to which the function was calibrated.
        samples : int, optional
            Vertices, closer to each other towards the tip, from 10⁻⁴ of the height on.

        Examples
        --------
        >>> tip = Sampled.from_area_function([24.5], 1e-6)  # an ideal Berkovich tip
        >>> print(round(tip.height(1e-6) / 1e-6, 6))
        0.35809
        """
        return cls(*area_samples(coefficients, height, samples, _MOST_SAMPLES))

    def _refuse_concave(self):
        r, z, slope = self._r, self._z, self._slope
        # Straight within the rounding of the heights counts as straight.
        concave = self._bend < 0
        if slope[0] < 0:
            raise ValueError(
                f"Sampled z[1] = {z[1]:g} m lies below the tip; order the samples from the tip out"
            )
        if np.any(concave):
            i = int(np.argmax(concave))
            raise ValueError(
                f"Sampled shape is concave at r[{i}] = {r[i]:g} m (slope {slope[i - 1]:g} before, "
                f"{slope[i]:g} after), so that the contact would not be compact; smooth the samples or "
                "take Sampled.fit(r, z)"
            )
        if not slope[-1] > 0:
            raise ValueError("Sampled z is flat throughout; use FlatPunch")

    # The polygon is a sum of truncated cones, one from each vertex, by the change of slope there.
    _r = cached_property(lambda self: np.array(self.r))
    _z = cached_property(lambda self: np.array(self.z))
    _slope = cached_property(lambda self: np.diff(self._z) / np.diff(self._r))

    @cached_property
    def _noise(self):
        """What rounding of the heights may make of the slopes."""
        z = np.abs(self._z)
        return 4 * np.finfo(float).eps * (z[1:] + z[:-1]) / np.diff(self._r)

    @cached_property
    def _bend(self):
        bend = np.diff(self._slope, prepend=0.0)
        straight = np.append(False, np.abs(bend[1:]) <= self._noise[1:] + self._noise[:-1])
        return np.where(straight, 0.0, bend)

    @cached_property
    def _g(self):
        """Reduced height at the vertices (m)."""
        return self._reduced(self._r)

    # The samples are one indenter, not many.
    shape = ()
    known_radius = property(lambda self: self.r[-1])
    known_depth = property(lambda self: float(self._g[-1]))
    face_radius = property(lambda self: float(self._r[np.count_nonzero(self._g == 0) - 1]))

    @cached_property
    def kinks(self):
        return tuple(g for g in self._g[1:-1].tolist() if g > 0)

    @cached_property
    def transition_depth(self):
        """Depth (m): a face's radius times the slope behind it; of a sharp tip that of the first kink."""
        if self._g[1] > 0:
            return self.kinks[0] if self.kinks else None
        return float(self._slope[np.argmax(self._slope > 0)] * self.face_radius)

    def _height(self, r):
        beyond = np.maximum(r - self._r[-1], 0.0)
        return np.interp(r, self._r, self._z) + self._slope[-1] * beyond

    def _reduced(self, x):
        return self._reduced_and_slope(x)[0]

    def _reduced_slope(self, x):
        return self._reduced_and_slope(x)[1]

    def _reduced_and_slope(self, x):
        """Sums over the vertices before x of their bends: times x arccos(r/x), and its slope."""
        flat, vertices = np.ravel(x), self._r[:-1][self._bend != 0]
        result, bends = np.empty((2, flat.size)), self._bend[self._bend != 0]
        for rows in chunks(flat.size, max(1, 2**15 // vertices.size)):
            place = flat[rows, None]
            before = np.searchsorted(vertices, place.max(), side="right")
            r, bend = vertices[:before], bends[:before]
            behind = root(place, r)
            angle = np.where(r > 0, np.arctan2(behind, r), np.pi / 2)
            with np.errstate(divide="ignore", invalid="ignore"):
                # Of a sharp tip the slope is that of its cone, down to the axis.
                rate = np.where(place >= r, angle + np.where(r > 0, r / behind, 0.0), 0.0)
            result[:, rows] = flat[rows] * (angle @ bend), rate @ bend
        return result.reshape(2, *np.shape(x))

    def _radius(self, depth):
        # Behind a vertex g begins as a square root, and is smooth in t = √(x − r) there.
        depth, shape = np.ravel(depth), np.shape(depth)
        zone, guess = self._first_guess(depth)
        vertex, end = self._r[zone], np.sqrt(np.diff(self._r))[zone]
        # On the next vertex the slope is infinite, and Newton's method would not leave it.
        before = np.nextafter(self._r[zone + 1], 0)
        t, rows = np.clip(np.nan_to_num(guess), np.sqrt(np.spacing(vertex)), end), np.arange(depth.size)
        # Before the first vertex the tip is a cone.
        with np.errstate(all="ignore"):
            t = np.where((zone > 0) | (depth == 0), t, np.sqrt(depth / (np.pi / 2 * self._slope[0])))
            for _ in range(50):
                way = t[rows]
                x = np.minimum(vertex[rows] + way * way, before[rows])
                reduced, slope = self._reduced_and_slope(x)
                step = np.nan_to_num((reduced - depth[rows]) / (2 * way * slope), posinf=0.0, neginf=0.0)
                t[rows] = new = np.clip(way - step, way / 8, end[rows])
                # The square of the last step is rounding.
                close = (np.abs(new - way) <= 1e-8 * new) | (np.abs(new**2 - way**2) <= 8 * np.spacing(x))
                rows = rows[~close]
                if not rows.size:
                    break
        radius = np.where(depth > 0, vertex + t * t, self.face_radius)
        return np.where(depth <= self.known_depth, radius, np.inf).reshape(shape)

    def _first_guess(self, depth):
        """Number of the vertex behind which the contact ends, and about the root of the way from it."""
        g, t, rate = self._table
        zone = np.clip(np.searchsorted(self._g, depth, side="right") - 1, 0, len(self.r) - 2)
        cell = np.clip((g[zone] <= depth[..., None]).sum(axis=-1) - 1, 0, 7)
        low, high = (zone, cell), (zone, cell + 1)
        width = g[high] - g[low]
        # Hermite's cubic; on a flat face it has no meaning.
        u = np.divide(depth - g[low], width, out=np.zeros_like(width), where=width > 0)
        rise = t[high] - t[low]
        bow = (1 - u) * (width * rate[low] - rise) - u * (width * rate[high] - rise)
        # Next to the vertex a little bend, β √(2r) t, gives way to what is square in t.
        bend, y = (self._bend * np.sqrt(2 * self._r[:-1]))[zone], np.maximum(depth - g[zone, 0], 0.0)
        with np.errstate(all="ignore"):
            square = (g[zone, 1] - g[zone, 0] - bend * t[zone, 1]) / t[zone, 1] ** 2
            near = 2 * y / (bend + np.sqrt(bend**2 + 4 * square * y))
        return zone, np.where(cell == 0, near, t[low] + u * (rise + (1 - u) * bow))

    @cached_property
    def _table(self):
        """g, t and dt/dg at nine t behind each vertex, up to the next one."""
        t = np.linspace(0, 1, 9) * np.sqrt(np.diff(self._r))[:, None]
        with np.errstate(all="ignore"):
            x = np.minimum(self._r[:-1, None] + t * t, np.nextafter(self._r[1:, None], 0))
            g, slope = self._reduced_and_slope(x)
            rate = 1 / (2 * t * slope)
            # On the vertex g begins as its bend times √(2r) t.
            rate[:, 0] = 1 / (self._bend * np.sqrt(2 * self._r[:-1]))
        rate = np.where(np.isfinite(rate), rate, np.append(rate[:, 1:], rate[:, -1:], axis=1))
        return g, t, rate


def _lists(what, r, z, **bounds):
    """Radii and heights (m) as arrays, if they are two lists of one length."""
    r, z = (_check.finite_array(f"{what} {n}", v, unit="m", **bounds) for n, v in (("r", r), ("z", z)))
    if r.ndim != 1 or r.shape != z.shape or r.size < 2:
        raise ValueError(
            f"{what} r and z must be two lists of one length ≥ 2, got shapes {r.shape}, {z.shape}"
        )
    return r, z


def _turns_down(first, middle, last):
    (r0, z0), (r1, z1), (r2, z2) = first, middle, last
    return (z1 - z0) * (r2 - r1) > (z2 - z1) * (r1 - r0)
