"""Indentation along a prescribed path of depth or force, infinitely slowly: functions and states."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from . import _check, fields, stress
from ._check import Array, ArrayLike
from ._numeric import root
from .medium import Medium, check_pair, paths_on
from .results.base import CLOSED_FORM, Result
from .results.limits import Limit, contact_limits
from .shapes.profile import Profile
from .stress import Stress, StressPeak
from .superposition import energy_integral, live_length, loading_depth, radius_drop, radius_integral
from .yielding import LiveInterval, elastic_interval, first_loading, path_intervals


@_check.keywords_explained
def indent(profile: Profile, medium: Medium, depth: ArrayLike) -> "Indentation":
    """Press an indenter along a path of depths: loading, unloading and reloading in any order.

    The path is followed infinitely slowly, so that the dashpots of a viscous medium carry nothing; for a
    path in time see `indent_in_time`.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.
    depth : float or array_like
        Indentation depth d (m), one number or a path along the last axis; negative out of contact. Each
        row of a larger array is a path of its own on a virgin medium. Parameters of medium and profile may
        be arrays of shape (…, 1), for one path each.

    Returns
    -------
    Indentation
        Quantities of the shape of `depth`, computed when they are first read.

    Raises
    ------
    ValueError
        If a depth is not finite, or larger than the known depth of the profile.

    Examples
    --------
    A cone at twice the critical depth, F = 3 F_c (Popov 2015, Eqs. (20), (22)):

    >>> from mdr_core import Cone, Medium, critical_force
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)
    >>> state = indent(cone, medium, 2 * medium.critical_depth)
    >>> print(round(state.force / critical_force(cone, medium), 12))
    3.0
    """
    check_pair(profile, medium)
    depth = _check.finite_array("depth", depth, unit="m", most=_check.LARGEST)
    depth = profile._known(paths_on(profile, medium, depth))
    return Indentation(profile, medium, depth, path_intervals(depth, medium.critical_depth))


@_check.keywords_explained
def indent_to_force(profile: Profile, medium: Medium, force: ArrayLike) -> "Indentation":
    """Press an indenter along a path of forces, infinitely slowly: the inverse of `indent`.

    For a viscous medium under a force in time see `creep`.

    Parameters
    ----------
    profile, medium
        As for `indent`.
    force : float or array_like
        Normal force (N), not negative; one number or a path along the last axis. At 0 the indenter
        rests on the bottom of the imprint.

    Returns
    -------
    Indentation
        Quantities of the shape of `force`.

    Raises
    ------
    ValueError
        If a force is negative or not finite, larger than a flat face carries before all of it yields
        (π q_c b, Popov 2015, Eq. (11)), or presses deeper than the known depth of the profile.

    Examples
    --------
    >>> from mdr_core import Cone, Medium
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=1.0)
    >>> print(round(indent_to_force(cone, medium, indent(cone, medium, 5.0).force).depth, 12))
    5.0
    """
    check_pair(profile, medium, "an indentation")
    force = _check.force("force", force)
    limit = 2 * medium.yield_line_load * profile.wall
    bound = f"must be less than the {limit:g} N at which the whole flat face yields"
    _check.refuse("force", force, force >= limit, bound, unit="N", remedy="press to a depth instead")
    integral = force / (2 * medium.E_star)
    largest = np.maximum.accumulate(integral, axis=-1) if integral.ndim else integral
    with np.errstate(all="ignore"):
        largest_depth = loading_depth(profile, medium.critical_depth, largest)
    known = largest_depth <= min(profile.known_depth, _check.LARGEST)
    bound = f"presses {profile._too_deep()}"
    _check.refuse("force", force, ~known, bound, unit="N", remedy="press less")
    loaded = first_loading(largest_depth, medium.critical_depth)
    length = np.where(integral == largest, loaded.length, live_length(profile, loaded, integral))
    depth = np.where(integral == largest, largest_depth, loaded.lower + length)
    return Indentation(profile, medium, depth, LiveInterval(loaded.lower, depth, length))


@dataclass(frozen=True, eq=False, repr=False)
class Indentation(Result):
    """States of an indentation, one for each point of its path; made by `indent` or `indent_to_force`.

    Every quantity has the shape of `depth` (m); `result[i]` is one state. Pressure, line load, surface,
    imprint and stress are fields of one state. `live_interval` is [d_p, d_p + ℓ]; its end is d, except on
    unloading from a viscous medium, where elements are released before their springs are relaxed.
    `dashpot_load` is the line load 4ηḋ (N/m) of the dashpots in contact on loading, 0 on an infinitely slow
    path; `in_time` says whether the states belong to a motion.
    """

    profile: Profile
    medium: Medium
    depth: Array
    live_interval: LiveInterval
    dashpot_load: np.ndarray | float = 0.0
    in_time: bool = False

    #: Name of the model.
    model = CLOSED_FORM
    _quantities = (
        "depth", "force", "stiffness", "contact_radius", "contact_area", "plastic_radius", "plastic_depth",
        "mean_pressure", "stored_energy", "plastic_work",
    )  # fmt: skip
    _shown = ("depth", "force", "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure")
    _dimensions = ("path", "state")

    def __post_init__(self):
        # A copy: the caller may change the path later.
        object.__setattr__(self, "depth", _check.frozen(np.array(self.depth)))

    def __getitem__(self, index: Any) -> "Indentation":
        shape = np.shape(self.depth)
        profile, medium = self.profile.entries(index, shape), self.medium.entries(index, shape)
        load = self.dashpot_load[index] if np.ndim(self.dashpot_load) else self.dashpot_load
        depth, interval = np.asarray(self.depth[index]), self.live_interval[index]
        return Indentation(profile, medium, depth, interval, load, self.in_time)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model for these states."""
        return contact_limits(self.profile, self.medium, self.contact_radius, slow=not self.in_time)

    @property
    def _ahead(self):
        """Elastic compression −τḋ (m) that the dashpots of elements in contact balance on unloading."""
        return np.where(self.live_interval.length > 0, self.depth - self.live_interval.upper, 0.0)

    @_check.frozen_property
    def force(self):
        """Normal force F = 2E* ∫ a(s) ds (N) with that of the dashpots; Popov (2015), Eqs. (20), (22)."""
        force = 2 * self.medium.E_star * radius_integral(self.profile, self.live_interval)
        return force + 2 * self.dashpot_load * self.contact_radius if np.any(self.dashpot_load) else force

    @_check.frozen_property
    def contact_radius(self):
        """Contact radius a (m), Popov (2015), Eq. (16); 0 without contact."""
        touching = (self.live_interval.length > 0) | (self.dashpot_load > 0)
        return np.where(touching, self.profile._radius(np.asarray(self.live_interval.upper)), 0.0)

    @_check.frozen_property
    def plastic_radius(self):
        """Radius c (m) of the plastic zone, Popov (2015), Eq. (21); 0 if nothing has yielded."""
        depth = np.asarray(self.plastic_depth)
        return np.where(depth > 0, self.profile._radius(depth), 0.0)

    @_check.frozen_property
    def contact_area(self):
        """Contact area A = π a² (m²); 0 without contact."""
        return np.pi * self.contact_radius**2

    @_check.frozen_property
    def mean_pressure(self):
        """Mean contact pressure F/(π a²) (Pa), the hardness at this radius; 0 without contact."""
        a = np.asarray(self.contact_radius)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(a > 0, self.force / a / a / np.pi, 0.0)

    @property
    def plastic_depth(self) -> Array:
        """Plastic depth d_p (m): the depth of the residual imprint in the 1D foundation."""
        return _check.frozen(self.live_interval.lower)

    @_check.frozen_property
    def stored_energy(self):
        """Elastic energy of the springs in contact, U = 2E* ∫ (d − s) a(s) ds (J)."""
        energy, ahead = energy_integral(self.profile, self.live_interval), self._ahead
        if np.any(ahead > 0):
            area = radius_integral(self.profile, self.live_interval)
            energy = energy + ahead * (area + ahead / 2 * self.contact_radius)
        return 2 * self.medium.E_star * energy

    @_check.frozen_property
    def plastic_work(self):
        """Work W_p = d_c φ(d_p) (J) dissipated by yielding so far; φ(d) is the elastic force."""
        depth = np.asarray(self.plastic_depth)
        # Every increment of d_p dissipates π q_c a; q_c may be infinite where nothing yields.
        yield_load = np.where(depth > 0, 2 * self.medium.yield_line_load, 0.0)
        return yield_load * radius_integral(self.profile, elastic_interval(depth))

    @_check.frozen_property
    def stiffness(self):
        """Stiffness dF/dd (N/m): 2E* a, and 2E* (a − c) for loading beyond the largest depth so far."""
        width, interval = self.contact_radius, self.live_interval
        yielding = (interval.lower > 0) & (interval.length == self.medium.critical_depth)
        if np.any(yielding):
            width = np.where(yielding, radius_drop(self.profile, interval), width)[()]
        return 2 * self.medium.E_star * width

    def pressure(self, r: ArrayLike) -> Array:
        """Contact pressure p = −σ_zz (Pa) at radii r (m), of the shape of `r`.

        p(r) = (E*/π) ∫ ds/√(a(s)² − r²), from Popov (2015), Eq. (10), with that of a flat punch for the
        dashpots. Zero outside the contact. Infinite at the rim of a flat face, at any rim while dashpots
        carry load, and under a sharp tip that has not yielded.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0), 0.01)
        >>> print(round(state.pressure(0.0), 12))  # Hertz: (2/π) E* √(d/R)
        0.063661977237
        """
        self._one("pressure")
        interval, r = self.live_interval, self._radii(r)
        pressure = self.medium.E_star / np.pi * fields.pressure_integral(self.profile, interval, r.ravel())
        if self.dashpot_load > 0:
            with np.errstate(divide="ignore"):
                punch = self.dashpot_load / np.pi / root(self.contact_radius, r.ravel())
            pressure += np.where(r.ravel() <= self.contact_radius, punch, 0.0)
        return pressure.reshape(r.shape)[()]

    def line_load(self, x: ArrayLike) -> Array:
        """Line load q(x) (N/m) of the 1D foundation at x (m); Popov (2015), Eqs. (1), (17), (18)."""
        self._one("line_load")
        interval, x = self.live_interval, self._radii(x)
        ring = interval.upper - self.profile._reduced(np.minimum(x, self.contact_radius))
        # For x < c the compression is the length of the interval, which has no rounding of a difference.
        inside = np.where(x < self.plastic_radius, interval.length, np.clip(ring, 0.0, interval.length))
        load = self.medium.E_star * inside + self.dashpot_load
        return np.where(x < self.contact_radius, load, 0.0)[()]

    def surface(self, r: ArrayLike) -> Array:
        """Elastic displacement u(r) (m) of the surface at radii r (m), positive downward.

        Its sum with `imprint` is d − z(r) under the indenter. Displacements of released elements that relax
        in a viscous medium are not included.
        """
        self._one("surface")
        r, radius = self._radii(r), self.contact_radius
        surface = self._displacement(self.live_interval, r)
        if self._ahead > 0:
            with np.errstate(divide="ignore"):
                surface += self._ahead * 2 / np.pi * np.arcsin(np.minimum(radius / r, 1.0))
        return surface

    def imprint(self, r: ArrayLike) -> Array:
        """Depth (m) of the residual imprint at radii r (m), after the load is removed."""
        self._one("imprint")
        return self._displacement(elastic_interval(self.live_interval.lower), r)

    def _displacement(self, interval, r):
        r = self._radii(r)
        return fields.displacement_integral(self.profile, interval, r.ravel()).reshape(r.shape)[()]

    def stress(self, r: ArrayLike, z: ArrayLike) -> Stress:
        """Stress tensor (Pa) at radii r and depths z ≥ 0 below the surface (m), which broadcast.

        The integral over the live interval of the stress of a flat punch, with one more for the dashpots;
        residual stresses of the imprint are not included. Even in r; σ_zz = −p at z = 0. Accurate to 10⁻⁸
        of the largest stress, to 10⁻⁶ for z < 10⁻³ a, and to 10⁻⁴ next to the axis of a profile of exponent
        n < 1/2 that has not yielded.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0), 0.01)
        >>> print(round(state.stress(0.0, state.contact_radius).zz / state.pressure(0.0), 9))  # Huber: −1/2
        -0.5
        """
        self._one("stress")
        r, z = self._radii(r), stress.depths(z)
        _check.common_shape("stress", r=r, z=z)
        return stress.stress(self, *np.broadcast_arrays(r, z))

    def stress_peak(self, quantity: str = "max_shear") -> StressPeak:
        """Largest shear stress of one state, or of `quantity="von_mises"`, and its position.

        A `StressPeak` with `value` (Pa), accurate to 10⁻⁸, and position `r`, `z` (m), accurate to 10⁻⁴ a.
        Infinite at the rim of a flat face and at any rim while dashpots carry load; for ν < 1/2 also at an
        edge and at a sharp tip that have not yielded.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0, poisson=0.3), 0.01)
        >>> peak = state.stress_peak()
        >>> print(f"{peak.value / state.pressure(0.0):.3f} p0 at {peak.z / state.contact_radius:.3f} a")
        0.310 p0 at 0.481 a
        """
        self._one("stress_peak")
        return stress.stress_peak(self, _check.one_of("quantity", quantity, stress.SIZES))

    def largest_stress(self, z: ArrayLike, quantity: str = "max_shear") -> Array:
        """Largest shear stress (Pa), or `quantity="von_mises"`, at each depth z ≥ 0 (m) below the surface.

        Over all radii and all states of a path; for an impact take `motion.states`.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, impact
        >>> medium = Medium(E_star=1.0, poisson=0.3)
        >>> hit = impact(Paraboloid(radius=1.0), medium, 1.0, 0.01)
        >>> largest = hit.motion(9).states.largest_stress(0.481 * hit.contact_radius)
        >>> print(f"{largest / hit.turning_point.pressure(0.0):.3f} p0")
        0.310 p0
        """
        _check.one_of("quantity", quantity, stress.SIZES)
        return stress.largest_stress(self, stress.depths(z), quantity)

    def plot_pressure(self) -> Any:
        """Contact pressure p(r) of one state with a, c and the mean pressure, as HoloViews elements."""
        from .results.figures import plot_pressure

        return plot_pressure(self)

    def plot_springs(self) -> Any:
        """The 1D foundation in one state, springs below the profile g(x), as HoloViews elements."""
        from .results.figures import plot_springs

        return plot_springs(self)

    @staticmethod
    def _radii(r):
        return np.abs(_check.finite_array("radius", r, unit="m"))
