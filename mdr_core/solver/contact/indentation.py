"""States of an indentation, with all quantities and fields of the contact."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...base import check, lazy
from ...base.check import Array, ArrayLike
from ...base.results import CLOSED_FORM, Limit, Result, check_single
from ..medium.medium import Medium
from ..numerics.stable import root
from ..profiles.profile import Profile
from . import adhesion, stress
from .integrals import integrals, tabulated
from .live_interval import LiveInterval
from .pressure import displacement_integral, largest_pressure, pressure_integral
from .stress import Stress, StressPeak
from .yielding import yield_rule

#: Least number of states for a table. Making one takes as long as the integrals of 5,000 states on 200
#: samples, of 11,000 on 30 and of 14,000 on 1,000. With the table a state is 100 times as fast.
_MANY = 15_000


@dataclass(frozen=True, eq=False, repr=False)
class Indentation(Result):
    """States of an indentation at the points of its path, returned by `indent` or `indent_to_force`.

    Every quantity has the shape of `depth` (m); `result[i]` is one state. Pressure, line load, surface,
    imprint and stress are fields of one state.

    `live_interval` is [d_p, d_p + ℓ]. Its end is d, except on unloading from a viscous medium, which
    releases elements before their springs are relaxed. `uniform_load` is a line load (N/m) over the contact
    in addition to the live interval. On loading it is 4ηḋ of the dashpots. With adhesion it is −E*Δl, and
    the live interval is [d_p, D] with D = d + Δl. `in_time` is whether the states belong to a motion.
    `jumps` are depths (m) between which a path of prescribed force jumps, because the force decreases with
    depth there.

    Examples
    --------
    >>> from mdr_core import Medium, Paraboloid, indent
    >>> states = indent(Paraboloid(radius=1.0), Medium(E_star=1.0), [0.0, 0.01])
    >>> print(round(states[1].force, 9), round(states[1].contact_radius, 9))  # Hertz
    0.001333333 0.1
    """

    profile: Profile
    medium: Medium
    depth: Array
    live_interval: LiveInterval
    uniform_load: np.ndarray | float = 0.0
    in_time: bool = False
    jumps: tuple[tuple[float, float], ...] = ()

    #: Name of the model.
    model = CLOSED_FORM
    _quantities = (
        "depth", "force", "stiffness", "contact_radius", "contact_area", "plastic_radius", "plastic_depth",
        "mean_pressure", "stored_energy", "plastic_work", "surface_energy", "pull_off_force",
    )  # fmt: skip
    _shown = ("depth", "force", "contact_radius", "plastic_radius", "plastic_depth", "mean_pressure")
    _dimensions = ("path", "state")

    def __post_init__(self):
        # A copy: the caller may change the path later.
        check.store(self, depth=check.frozen(np.array(self.depth)))

    def __getitem__(self, index: Any) -> "Indentation":
        shape = np.shape(self.depth)
        profile, medium = self.profile.entries(index, shape), self.medium.entries(index, shape)
        load = self.uniform_load[index] if np.ndim(self.uniform_load) else self.uniform_load
        depth, interval = np.asarray(self.depth[index]), self.live_interval[index]
        return Indentation(profile, medium, depth, interval, load, self.in_time, self.jumps)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model for these states."""
        return lazy.limits.path_limits(self)

    @property
    def _rule(self):
        return yield_rule(self._quick, self.medium)

    @property
    def _quick(self):
        """The profile, with a table of its contact radius if there are many states."""
        if np.size(self.depth) < _MANY or self.profile.shape or not 0 < np.max(self.depth) < np.inf:
            return self.profile
        return tabulated(self.profile, np.max(self.depth))

    @property
    def _adhesive(self):
        return np.any(np.asarray(self.medium.work_of_adhesion) > 0)

    @property
    def _ahead(self):
        """Elastic compression (m) of all elements in contact, in addition to the live interval.

        It is −τḋ on unloading, balanced by the dashpots, and −Δl with adhesion.
        """
        if self._adhesive:
            return self.uniform_load / self.medium.E_star
        return np.where(self.live_interval.length > 0, self.depth - self.live_interval.upper, 0.0)

    @check.frozen_property
    def force(self):
        """Normal force F = 2E* ∫ a(s) ds (N), plus the uniform load; Popov (2015), Eqs. (20), (22)."""
        force = 2 * self.medium.E_star * integrals(self._quick).radius_integral(self.live_interval)
        return force + 2 * self.uniform_load * self.contact_radius if np.any(self.uniform_load) else force

    @check.frozen_property
    def contact_radius(self):
        """Contact radius a (m), Popov (2015), Eq. (16); 0 without contact."""
        touching = (self.live_interval.length > 0) | (self.uniform_load != 0)
        return np.where(touching, self._quick.radius_at(np.asarray(self.live_interval.upper)), 0.0)

    @check.frozen_property
    def plastic_radius(self):
        """Radius c (m) of the plastic zone, Popov (2015), Eq. (21); 0 if nothing has yielded."""
        depth = np.asarray(self.plastic_depth)
        return np.where(depth > 0, self._quick.radius_at(depth), 0.0)

    @check.frozen_property
    def contact_area(self):
        """Contact area A = π a² (m²); 0 without contact."""
        return np.pi * self.contact_radius**2

    @check.frozen_property
    def mean_pressure(self):
        """Mean contact pressure F/(π a²) (Pa); 0 without contact.

        It is less than the hardness at this radius, because the outer ring of the contact is elastic.
        """
        a = np.asarray(self.contact_radius)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(a > 0, self.force / a / a / np.pi, 0.0)

    @property
    def plastic_depth(self) -> Array:
        """Plastic depth d_p (m): the depth of the residual imprint in the 1D foundation."""
        return check.frozen(self.live_interval.lower)

    @check.frozen_property
    def stored_energy(self):
        """Elastic energy of the springs in contact, U = 2E* ∫ (d − s) a(s) ds (J)."""
        energy, ahead = integrals(self._quick).energy_integral(self.live_interval), self._ahead
        if np.any(ahead != 0):
            area = integrals(self._quick).radius_integral(self.live_interval)
            energy = energy + ahead * (area + ahead / 2 * self.contact_radius)
        return 2 * self.medium.E_star * energy

    @check.frozen_property
    def plastic_work(self):
        """Work W_p = 2E* ∫ u_c a(p) dp (J) dissipated by yielding so far.

        p is the plastic depth on loading and u_c the cap of the elements. For the hardness q_c/a, W_p is
        d_c φ(d_p) with the elastic force φ(d).
        """
        depth = np.asarray(self.plastic_depth)
        return 2 * self.medium.E_star * self._rule.plastic_integral(np.zeros_like(depth), depth)

    @check.frozen_property
    def surface_energy(self):
        """Energy −w π a² (J) of the surfaces that adhesion has joined."""
        return -self.medium.work_of_adhesion * self.contact_area

    @check.frozen_property
    def pull_off_force(self):
        """Pull-off force (N), positive: the largest tension that the contact carries on unloading.

        It is 3/2 π w R for a paraboloid and √(8π w E* b³) for a flat punch (Popov and Heß 2015, ch. 4).
        From the imprint of a deep indentation it is √(8π w E* c³), the pull-off force of a punch with the
        radius of the imprint. It is 0 without adhesion.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, indent
        >>> medium = Medium(E_star=1e9, work_of_adhesion=0.05)
        >>> state = indent(Paraboloid(radius=1e-6), medium, 0.0)
        >>> print(round(state.pull_off_force * 1e9, 6))  # 3/2 π w R, in nN
        235.619449
        """
        if not self._adhesive:
            return np.zeros(np.shape(self.depth))
        tension = adhesion.pull_off_integral(self.profile, self.medium, self.live_interval)
        return np.broadcast_to(2 * self.medium.E_star * tension, np.shape(self.depth))

    @check.frozen_property
    def stiffness(self):
        """Stiffness dF/dd (N/m): 2E* a, and 2E* (a − c dp/ds) for loading beyond the largest depth so far.

        For the hardness q_c/a the plastic depth p grows at the rate of the depth s, dp/ds = 1.
        """
        if self._adhesive:
            return adhesion.stiffness(self)
        width, interval = self.contact_radius, self.live_interval
        yielding = self._rule.yielding(interval)
        if np.any(yielding):
            width = np.where(yielding, self._rule.yielding_stiffness_radius(interval), width)[()]
        return 2 * self.medium.E_star * width

    @check.frozen_property
    def max_pressure(self):
        """Largest contact pressure p = −σ_zz (Pa) over all radii of the contact; 0 without contact.

        It is usually at the radius c of the plastic zone. If nothing has yielded, it is on the axis, at the
        edge of a flat face, or farther out under shapes that rise faster than a parabola. It is infinite
        under a sharp tip that has not yielded, at sharp edges and walls, and while dashpots carry load.
        Vertices of a `Sampled` tip are left out, although the pressure is infinite there. The result is the
        largest value at c, in the middle of each facet, and on the axis of a flat face. Kinks of custom
        shapes are not resolved. States are solved one by one, in up to 0.1 s each.

        Examples
        --------
        >>> from mdr_core import Cone, Medium, indent
        >>> gold = Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
        >>> state = indent(Cone(slope=0.3), gold, 8e-9)
        >>> print(round(state.max_pressure / 1e9, 1), round(state.pressure(0.0) / 1e9, 1))  # GPa
        10.1 3.3
        """
        shape = np.shape(self.depth)
        result = [largest_pressure(self[index] if shape else self) for index in np.ndindex(shape)]
        return np.reshape(result, shape)

    def pressure(self, r: ArrayLike) -> Array:
        """Return the contact pressure p = −σ_zz (Pa) at radii r (m), of the shape of `r`.

        p(r) = (E*/π) ∫ ds/√(a(s)² − r²), from Popov (2015), Eq. (10), plus the pressure of a flat punch for
        the uniform load. It is zero outside the contact. It is infinite at the rim of a flat face, at any
        rim while dashpots carry load, and under a sharp tip that has not yielded. With adhesion it is −∞ at
        the rim.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, indent
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0), 0.01)
        >>> print(round(state.pressure(0.0), 12))  # Hertz: (2/π) E* √(d/R)
        0.063661977237
        """
        check_single(self, "pressure")
        interval, r = self.live_interval, self._radii(r)
        pressure = self.medium.E_star / np.pi * pressure_integral(self.profile, interval, r.ravel())
        if self.uniform_load != 0:
            a, flat = self.contact_radius, r.ravel()
            with np.errstate(divide="ignore", invalid="ignore"):
                punch = self.uniform_load / np.pi / root(a, flat)
                pressure += np.where(flat <= a, punch, 0.0)
                # At the rim of a wall both are infinite; the load just inside determines the sign.
                rim = self.line_load(np.nextafter(a, 0.0)) / 0.0
            pressure = np.where(flat == a, rim, pressure)
        return pressure.reshape(r.shape)[()]

    def line_load(self, x: ArrayLike) -> Array:
        """Return the line load q(x) (N/m) of the 1D foundation at x (m).

        Popov (2015), Eqs. (1), (17), (18).
        """
        check_single(self, "line_load")
        interval, x = self.live_interval, self._radii(x, "coordinate x")
        ring = interval.upper - self.profile.reduced_at(np.minimum(x, self.contact_radius))
        # For x < c the compression is the length of the interval, without the rounding of a difference.
        inside = np.where(x < self.plastic_radius, interval.length, np.clip(ring, 0.0, interval.length))
        load = self.medium.E_star * inside + self.uniform_load
        return np.where(x < self.contact_radius, load, 0.0)[()]

    def surface(self, r: ArrayLike) -> Array:
        """Return the elastic displacement u(r) (m) of the surface at radii r (m), positive downward.

        Its sum with `imprint` is d − z(r) under the indenter. Displacements of released elements that relax
        in a viscous medium are not included.
        """
        check_single(self, "surface")
        r, radius = self._radii(r), self.contact_radius
        surface = self._displacement(self.live_interval, r)
        if self._ahead != 0:
            with np.errstate(divide="ignore"):
                surface += self._ahead * 2 / np.pi * np.arcsin(np.minimum(radius / r, 1.0))
        return surface

    def imprint(self, r: ArrayLike) -> Array:
        """Return the depth (m) of the residual imprint at radii r (m), after the load is removed."""
        check_single(self, "imprint")
        return self._displacement(LiveInterval.elastic(self.live_interval.lower), r)

    def _displacement(self, interval, r):
        r = self._radii(r)
        return displacement_integral(self.profile, interval, r.ravel()).reshape(r.shape)[()]

    def stress(self, r: ArrayLike, z: ArrayLike) -> Stress:
        """Return the stress tensor (Pa) at radii r and depths z ≥ 0 below the surface (m), which broadcast.

        It integrates the stress of a flat punch over the live interval, and adds one more punch for the
        uniform load. Residual stresses of the imprint are not included. The stress is even in r, with
        σ_zz = −p at z = 0. It is accurate to 10⁻⁸ of the largest stress, and to 10⁻⁶ for z < 10⁻³ a. Next
        to the axis of a profile of exponent n < 1/2 that has not yielded, it is accurate to 10⁻⁴.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, indent
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0), 0.01)
        >>> print(round(state.stress(0.0, state.contact_radius).zz / state.pressure(0.0), 9))  # Huber: −1/2
        -0.5
        """
        check_single(self, "stress")
        r, z = self._radii(r), stress.depths(z)
        check.common_shape("stress", r=r, z=z)
        return stress.stress(self, *np.broadcast_arrays(r, z))

    def stress_peak(self, quantity: str = "max_shear") -> StressPeak:
        """Find the largest shear stress of one state, or `quantity="von_mises"`, and its position.

        The `StressPeak` has the `value` (Pa), accurate to 10⁻⁸, and the position `r`, `z` (m), accurate to
        10⁻⁴ a. The value is infinite at the rim of a flat face, and at any rim while dashpots or adhesion
        carry load. For ν < 1/2 it is also infinite at an edge or a sharp tip that has not yielded.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, indent
        >>> state = indent(Paraboloid(radius=1.0), Medium(E_star=1.0, poisson=0.3), 0.01)
        >>> peak = state.stress_peak()
        >>> print(f"{peak.value / state.pressure(0.0):.3f} p0 at {peak.z / state.contact_radius:.3f} a")
        0.310 p0 at 0.481 a
        """
        check_single(self, "stress_peak")
        return stress.stress_peak(self, check.one_of("quantity", quantity, stress.SIZES))

    def largest_stress(self, z: ArrayLike, quantity: str = "max_shear") -> Array:
        """Return the largest shear stress (Pa), or `quantity="von_mises"`, at each depth z ≥ 0 (m).

        Depths are measured below the surface. It is the largest over all radii and all states of a path;
        for an impact take `motion.states`.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, impact, indent
        >>> medium = Medium(E_star=1.0, poisson=0.3)
        >>> hit = impact(Paraboloid(radius=1.0), medium, 1.0, 0.01)
        >>> largest = hit.motion(9).states.largest_stress(0.481 * hit.contact_radius)
        >>> print(f"{largest / hit.turning_point.pressure(0.0):.3f} p0")
        0.310 p0
        """
        check.one_of("quantity", quantity, stress.SIZES)
        return stress.largest_stress(self, stress.depths(z), quantity)

    def plot_pressure(self) -> Any:
        """Plot the pressure p(r) of one state with a, c and the mean pressure, as HoloViews elements."""
        return lazy.plots.plot_pressure(self)

    def plot_springs(self) -> Any:
        """Plot the 1D foundation in one state, springs below the profile g(x), as HoloViews elements."""
        return lazy.plots.plot_springs(self)

    @staticmethod
    def _radii(r, quantity="radius r"):
        return np.abs(check.finite_array(quantity, r, unit="m"))
