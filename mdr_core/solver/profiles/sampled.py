"""Profile from height samples, such as a measured tip."""

from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np

from ...base import check, lazy
from ...base.check import ArrayLike
from .profile import Profile
from .samples import area_samples, axis_of_symmetry, convex_fit
from .vertex_sums import VertexSums

#: Largest number of samples; the time of an impact grows with it.
_MOST_SAMPLES = 5000


@dataclass(frozen=True, repr=False)
class Sampled(Profile):
    """A measured tip: the polygon through samples of its height, solved exactly.

    Its reduced height is x Σ sᵢ [arcsin(min(rᵢ₊₁, x)/x) − arcsin(rᵢ/x)] with slopes sᵢ, from Popov (2015),
    Eq. (3). It must be convex: outside a concave vertex g falls, and the contact would not be compact.

    Parameters
    ----------
    r, z : array_like
        Radii (m), strictly ascending from 0, at least two, and heights (m), counted from the first height.

    Raises
    ------
    ValueError
        If the samples are not as above, or if the tip is pressed deeper than the samples.

    Examples
    --------
    >>> from mdr_core import Sampled
    >>> profile = Sampled([0.0, 1.0, 2.0], [0.0, 1.0, 3.0])
    >>> print(round(profile.reduced(1.0), 12))  # π/2
    1.570796326795
    """

    r: tuple[float, ...]
    z: tuple[float, ...]

    if TYPE_CHECKING:

        def __init__(self, r: ArrayLike, z: ArrayLike) -> None: ...

    def __post_init__(self):
        r, z = _lists("Sampled", self.r, self.z, most=check.LONGEST)
        if r.size > _MOST_SAMPLES:
            advice = "thin them out, for example r[::10]"
            raise check.MDRError(f"Sampled has {r.size} samples, more than {_MOST_SAMPLES}; {advice}")
        if r[0] != 0:
            raise check.MDRError(f"Sampled r[0] = {r[0]:g} m must be 0: add the sample at the tip")
        tiny = (r > 0) & (r < check.SHORTEST)
        bound = f"must be 0 or at least {check.SHORTEST:g}"
        check.raise_if("Sampled r", r, tiny, bound, unit="m", advice="give it in SI units")
        back = np.append(False, np.diff(r) <= 0)
        check.raise_if(
            "Sampled r", r, back, "does not ascend", unit="m", advice="sort, and drop duplicates"
        )
        check.store(self, r=tuple(r.tolist()), z=tuple((z - z[0]).tolist()))
        self._refuse_concave()

    def __repr__(self) -> str:
        if len(self.r) <= 6:
            return f"Sampled(r={self.r!r}, z={self.z!r})"
        remarks = "".join(f"; {remark}" for remark in self.remarks)
        return f"Sampled({len(self.r)} samples to r = {self.r[-1]:g} m, z = {self.z[-1]:g} m{remarks})"

    __str__ = __repr__

    @classmethod
    @check.keywords_explained
    def from_csv(cls, path: str | PathLike[str], unit: str | None = None) -> "Sampled":
        """Read a text file with columns radius and height.

        Parameters
        ----------
        path : path-like
            File with one sample per row; commas, semicolons, tabs or blanks separate the numbers. The
            decimal sign may be a comma if commas do not separate numbers. Other columns, and lines that
            start with #, are ignored. A header may name the units: ``r (nm), z (nm)`` or ``r/nm; z/nm``.
        unit : {"m", "mm", "um", "µm", "nm", "pm", "Å"}, optional
            Unit of both columns, if the header does not name them.

        Raises
        ------
        ValueError
            If a row is not two numbers, or if no unit or two different units are given.
        """
        return cls(*lazy.tips.samples_in(path, unit, _MOST_SAMPLES))

    @classmethod
    @check.keywords_explained
    def fit(cls, r: ArrayLike, z: ArrayLike) -> "Sampled":
        """Fit the convex profile nearest to noisy samples, by least squares in the height.

        Samples may be on both sides of the axis at r = 0, in any order; the height of the tip is fitted.
        The fit is unbiased if the contact has many samples.

        An error is raised if the misfit on one side exceeds 0.5 % of the height and is not noise. For eight
        or more samples this is a misfit of more than four times the noise between neighbours. For 50 or
        more samples it is also a wave with about half of the variance of the misfit or more.

        Noise of the heights makes the tip uncertain. For 400 heights with a noise of 2 nm, at radii up to
        0.5 µm on a tip of 1 µm radius, forces at a depth of 20 nm scatter by 4 %.

        Parameters
        ----------
        r, z : array_like
            Radii (m), negative on the other side of the axis, and heights (m); at least three radii.

        Raises
        ------
        ValueError
            If heights do not rise outward from the axis, or no convex profile is near the samples.

        Examples
        --------
        >>> from mdr_core import Sampled
        >>> profile = Sampled.fit([-2.0, -1.0, 0.0, 1.0, 2.0], [2.1, 0.9, 0.0, 1.1, 1.9])
        >>> print(round(profile.height(2.0), 12))
        2.0
        """
        r, z = _lists("Sampled.fit", r, z)
        if np.unique(np.abs(r)).size < 3:
            count = np.unique(r).size
            raise check.MDRError(f"Sampled.fit needs three or more different radii |r|, got {count}")
        return cls(*convex_fit(r, z))

    @classmethod
    @check.keywords_explained
    def from_area_function(
        cls,
        coefficients: ArrayLike,
        height: float,
        samples: int = 400,
        *,
        unit: str = "m",
        from_depth: float | None = None,
    ) -> "Sampled":
        """Make a profile with the cross-section A(h) = C₀h² + C₁h + C₂h^(1/2) + C₃h^(1/4) + … at height h.

        This is the area function of instrumented indentation (Oliver and Pharr 1992). The profile is a
        polygon. If it is slightly concave, as calibrated functions are, neighbouring slopes are averaged.
        Near the tip, up to 5 % of the height, the function may fall or be negative; there the profile is a
        cone. ``tip.remarks`` and the text of the tip give the largest change of the heights.

        Parameters
        ----------
        coefficients : array_like
            C₀, C₁, … for A in unit² and h in a unit; Cᵢ belongs to h^(2/2ⁱ).
        height : float
            Height (m) up to which the function was calibrated.
        samples : int, optional
            Number of vertices, denser towards the tip, from 10⁻⁴ of the height.
        unit : {"m", "mm", "um", "µm", "nm", "pm", "Å"}, optional
            Unit of the coefficients; instruments give them in nm. The height is in m.
        from_depth : float, optional
            Smallest contact depth (m) at which the function is used, at most half of the height. Below it,
            the tip is a cone. Functions with negative terms may be convex only at larger depths.

        Raises
        ------
        ValueError
            If the area does not grow, or the tip is concave by more than 3 %. The error then names the
            least `from_depth` that helps. If the radius at the height is more than 100 times the height or
            less than a hundredth, for example because of coefficients in another unit. If the height is
            above 10⁶ of a given unit, for example because it is not in m.

        Examples
        --------
        >>> from mdr_core import Sampled
        >>> tip = Sampled.from_area_function([24.5, 100.0], 1e-6, unit="nm")  # blunt by 100 nm
        >>> print(f"{tip.r[-1]:.3g} {tip.z[-1]:.3g}")  # π r² = 24.6 h²
        2.8e-06 1e-06
        >>> profile = Sampled.from_area_function([24.5], 1e-6)  # an ideal Berkovich tip
        >>> print(round(profile.height(1e-6) / 1e-6, 6))
        0.35809
        """
        r, z, remarks = area_samples(coefficients, height, samples, _MOST_SAMPLES, unit, from_depth)
        profile = cls(r, z)
        check.store(profile, remarks=remarks)
        return profile

    def _refuse_concave(self):
        slope, concave = self._slope, self._bend < 0
        if slope[0] < 0:
            below = f"Sampled z[1] = {self.z[1]:g} m is below the tip"
            raise check.MDRError(f"{below}; order the samples from the tip outward")
        if np.any(concave):
            i = int(np.argmax(concave))
            raise check.MDRError(
                f"Sampled shape is concave at r[{i}] = {self.r[i]:g} m (slope {slope[i - 1]:g} before, "
                f"{slope[i]:g} after), so that the contact would not be compact; smooth the samples or "
                "take Sampled.fit(r, z)"
            )
        if not slope[-1] > 0:
            raise check.MDRError("Sampled z is flat throughout; use FlatPunch")

    # The polygon is a sum of truncated cones, one from each vertex with the change of slope there.
    # Cached, the arrays make single states 2.3 times as fast, `_g` 17 times, and `_slope_inside` 3 times.
    _r = cached_property(lambda self: np.array(self.r))
    _z = cached_property(lambda self: np.array(self.z))
    _slope = cached_property(lambda self: np.diff(self._z) / np.diff(self._r))

    #: Reduced height at the vertices (m).
    _g = cached_property(lambda self: self.reduced_at(self._r))

    @cached_property
    def _bend(self):
        """Change of the slope at each vertex; 0 if it may be rounding of the heights."""
        z, bend = np.abs(self._z), np.diff(self._slope, prepend=0.0)
        noise = 4 * np.finfo(float).eps * (z[1:] + z[:-1]) / np.diff(self._r)
        straight = np.append(False, np.abs(bend[1:]) <= noise[1:] + noise[:-1])
        return np.where(straight, 0.0, bend)

    # The samples are one indenter, not an ensemble.
    shape = ()
    polygonal = True
    known_radius = property(lambda self: self.r[-1])
    known_depth = property(lambda self: float(self._g[-1]))
    face_radius = property(lambda self: float(self._r[np.count_nonzero(self._g == 0) - 1]))

    @cached_property
    def kinks(self):
        """Depths (m) of the vertices with a change of slope, outside a flat face."""
        bent = (self._bend[1:] > 0) & (self._g[1:-1] > 0)
        return tuple(self._g[1:-1][bent].tolist())

    @property
    def transition_depth(self):
        """Radius of a face times the slope at its edge (m); without a face, depth of the first kink."""
        if self._g[1] > 0:
            return self.kinks[0] if self.kinks else None
        return float(self._slope[np.argmax(self._slope > 0)] * self.face_radius)

    def height_at(self, r):
        outside = np.maximum(r - self._r[-1], 0.0)
        return np.interp(r, self._r, self._z) + self._slope[-1] * outside

    def radius_at_height(self, height):
        return np.maximum(np.interp(height, self._z, self._r, right=np.inf), self.face_radius)

    def reduced_at(self, x):
        return self.sums_at(x)[1]

    def reduced_slope_at(self, x):
        return self.sums_at(x)[2]

    @cached_property
    def sums_at(self):
        """∫ g dx (m²), g (m) and g′ at lengths x (m), stacked."""
        bent = self._bend != 0
        return VertexSums(self._r[:-1][bent], self._bend[bent], self._r[-1])

    def radius_at(self, depth):
        # Outside a vertex, g starts as a square root, and is smooth in t = √(x − r).
        depth, shape = np.ravel(depth), np.shape(depth)
        zone, guess = self._first_guess(depth)
        vertex, end = self._r[zone], np.sqrt(np.diff(self._r))[zone]
        # On the next vertex the slope is infinite, and Newton's method would not leave it.
        highest = np.nextafter(self._r[zone + 1], 0)
        t, rows = np.clip(np.nan_to_num(guess), np.sqrt(np.spacing(vertex)), end), np.arange(depth.size)
        # Inside the first vertex the tip is a cone.
        with np.errstate(divide="ignore", invalid="ignore"):
            cone = np.sqrt(depth / (np.pi / 2 * self._slope[0]))
        t = np.where((zone > 0) | (depth == 0), t, cone)
        for _ in range(50):
            old = t[rows]
            x = np.minimum(vertex[rows] + old * old, highest[rows])
            _, reduced, slope = self.sums_at(x)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = (reduced - depth[rows]) / (2 * old * slope)
            step = np.nan_to_num(step, posinf=0.0, neginf=0.0)
            t[rows] = new = np.clip(old - step, old / 8, end[rows])
            # The square of the last step is only rounding.
            close = (np.abs(new - old) <= 1e-8 * new) | (np.abs(new**2 - old**2) <= 8 * np.spacing(x))
            rows = rows[~close]
            if not rows.size:
                break
        radius = np.where(depth > 0, vertex + t * t, self.face_radius)
        return np.where(depth <= self.known_depth, radius, np.inf).reshape(shape)

    def _first_guess(self, depth):
        """Return the number of the vertex inside the edge of the contact, and t = √(x − r) to some digits.

        Let u be t over its value at the outer vertex. Between two vertices g rises approximately as a cubic
        of u, with the bend β √(2r) t at the inner vertex, and with g and its rate at the outer vertex.
        `radius_at` then takes 2.5 evaluations of g per depth; from a parabola it takes 3.0.
        """
        zone = np.clip(np.searchsorted(self._g, depth, side="right") - 1, 0, len(self.r) - 2)
        end = np.sqrt(np.diff(self._r))
        first, whole = self._bend * np.sqrt(2 * self._r[:-1]) * end, np.diff(self._g)
        last = 2 * end**2 * self._slope_inside
        with np.errstate(divide="ignore", invalid="ignore"):
            third = last + first - 2 * whole
            first, second, third = first[zone], (whole - first - third)[zone], third[zone]
            rise = np.maximum(depth - self._g[zone], 0.0)
            # Newton's method from the parabola without the rate.
            u = 2 * rise / (first + np.sqrt(first**2 + 4 * (second + third) * rise))
            for _ in range(2):
                u -= (u * (first + u * (second + u * third)) - rise) / (
                    first + u * (2 * second + 3 * u * third)
                )
        return zone, u * end[zone]

    @cached_property
    def _slope_inside(self):
        """g′ just inside each vertex except the first."""
        return self.reduced_slope_at(np.nextafter(self._r[1:], 0))


def bent_vertices(profile: Sampled) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the vertices between the facets of a polygon, from the tip outward.

    Samples without a bend are not vertices. The result has the radii r and reduced heights g (m) of the N
    facets' ends, shape (N + 1,), and the changes of the slope at their inner ends, shape (N,).
    """
    bent = profile._bend != 0  # noqa: SLF001
    ends = np.append(bent, True)
    return profile._r[ends], profile._g[ends], profile._bend[bent]  # noqa: SLF001


def tip_through(r, z, most, averages):
    """Return the profile through measured radii r (m) and heights z (m), and their scatter (m) about it.

    At most `most` convex samples are used unchanged, and the scatter is None. Other samples are more, are
    noisy, or are on both sides of an axis that need not be at r = 0. They give the nearest convex profile
    of at most `most` samples, fitted to at most `averages` means.
    """
    try:
        if len(r) <= most:
            return Sampled(r, z), None
    except ValueError:
        # Noise makes any profile concave somewhere.
        pass
    if min(r) < 0 < max(r):
        r = r - axis_of_symmetry(r, z)
    parts = np.array_split(np.argsort(r, kind="stable"), min(len(r), averages))
    profile = Sampled.fit(*(np.array([np.mean(of[part]) for part in parts]) for of in (r, z)))
    # A polygon through some vertices of a convex polygon is also convex.
    subset = np.unique(np.linspace(0, len(profile.r) - 1, most).round().astype(int))
    profile = Sampled(np.array(profile.r)[subset], np.array(profile.z)[subset])
    return profile, float(np.std(z - np.interp(np.abs(r), profile.r, profile.z)))


def _lists(what, r, z, **bounds):
    """Check that radii and heights (m) are two lists of one length, and return them as arrays."""
    r = check.finite_array(f"{what} r", r, unit="m", **bounds)
    z = check.finite_array(f"{what} z", z, unit="m", **bounds)
    if r.ndim != 1 or r.shape != z.shape or r.size < 2:
        shapes = f"got shapes {r.shape}, {z.shape}"
        raise check.MDRError(f"{what} r and z must be two lists of the same length, 2 or more, {shapes}")
    return r, z
