"""Oblique impact of a free rigid body, on a medium with friction."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ...base import check, lazy
from ...base.check import Array, ArrayLike
from ...base.results import Entries, Limit, Limits, Model, Result, check_single
from ..applicability import check_pair, refuse_adhesion, shape_with
from ..contact.yielding import yield_rule
from ..impacts.impact import impact
from ..impacts.result import Impact
from ..medium.medium import Medium, refuse_transversely_isotropic
from ..profiles.profile import Profile
from .oblique_motion import ObliqueMotion, oblique_motion
from .tangential_motion import EXACT, SurfaceSolution, solve_surface

FRICTION = Model(
    "chain with friction",
    "the normal motion does not depend on the tangential motion and is solved separately; along the "
    "surface every element sticks or slips independently",
)


@check.keywords_explained
def oblique_impact(
    profile: Profile,
    medium: Medium,
    mass: ArrayLike,
    speed: ArrayLike,
    tangential_speed: ArrayLike,
    friction: ArrayLike,
    *,
    tangential_mass: ArrayLike | None = None,
    tolerance: float = 1e-5,
) -> "ObliqueImpact":
    """Solve the impact of a body with a normal and a tangential speed under Coulomb's friction.

    Every element of the foundation has a tangential element, κ = 2(1 − ν)/(2 − ν) times as stiff and as
    viscous (Mindlin; outlook of Popov 2015). It sticks while its load is at most μ times the normal load of
    spring and dashpot, and slips otherwise. Yield, of any hardness, limits only the normal springs. The
    body behind the medium is at rest; the `structure` of `impact` is not supported.

    Parameters
    ----------
    profile, medium
        The indenter, and the medium; its `poisson` is ν.
    mass, speed : float or array_like
        Mass m (kg) and normal speed v₀ (m/s) at first contact, positive.
    tangential_speed : float or array_like
        Speed v_t0 (m/s) of the point of contact along the surface, of any sign. See `at_angle`, and
        `Ball.contact_speed` for spinning bodies.
    friction : float or array_like
        Coefficient of friction μ, the same for stick and slip; 0 and infinity are allowed.
    tangential_mass : float or array_like, optional
        Effective mass m_t (kg) at the point of contact along the surface, 1/m_t = 1/m + R²/I, as in
        `Ball.tangential_mass`. The default is m, for a body that cannot turn.
    tolerance : float, optional
        Largest error of the tangential velocity, relative to the tangential speed, and of the largest
        force, relative to itself. On a viscous medium it also limits errors of works, relative to the work
        or to a hundredth of the tangential energy, if the work is less. `limits` report a missed tolerance.

    Returns
    -------
    ObliqueImpact
        Quantities of the shape to which all arguments broadcast, with estimates of their `errors`.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the indenter would go deeper than the known depth.

    Examples
    --------
    A ball that slips throughout, Maw, Barber & Fawcett (1976): with ψ = κv_t/(μv) and χ = κm/(2m_t),
    ψ₂ = ψ₁ − 4χ, here ψ₁ = 4 and χ = 7/6.

    >>> from mdr_core import Ball, Medium, Paraboloid, oblique_impact
    >>> ball, medium = Ball(mass=1e-3, radius=5e-3), Medium(E_star=1e9)
    >>> mass = ball.tangential_mass
    >>> hit = oblique_impact(Paraboloid(5e-3), medium, 1e-3, 1.0, 3.0, 0.5, tangential_mass=mass)
    >>> print(round(hit.tangential_velocity * (2 / 3) / 0.5, 9))
    -0.666666667
    """
    check_pair(profile, medium)
    refuse_adhesion(medium, "an oblique impact")
    refuse_transversely_isotropic(medium, "an oblique impact")
    mass = check.positive("mass", mass, unit="kg")
    speed = check.positive("speed", speed, unit="m/s")
    tangential_mass = mass if tangential_mass is None else tangential_mass
    signed = check.finite_array("tangential_speed", tangential_speed, unit="m/s", most=check.LARGEST)
    tiny = (signed != 0) & (np.abs(signed) < check.SMALLEST)
    bound = f"must be 0 or at least {check.SMALLEST:g}"
    surface = {
        "tangential_speed": check.raise_if("tangential_speed", signed, tiny, bound, unit="m/s"),
        "friction": check.positive("friction", friction, infinite=True, zero=True),
        "tangential_mass": check.positive("tangential_mass", tangential_mass, unit="kg"),
    }
    tolerance = check.positive_number("tolerance", tolerance)
    shape = shape_with("oblique_impact", profile, medium, mass=mass, speed=speed, **surface)
    surface = {name: check.frozen(np.broadcast_to(value, shape)) for name, value in surface.items()}
    hit = impact(profile, medium, np.broadcast_to(mass, shape)[()], np.broadcast_to(speed, shape)[()])
    return ObliqueImpact(normal=hit, **surface, _surface=solve_surface(hit, tolerance, **surface))


class ObliqueErrors(NamedTuple):
    """Estimated relative errors of an `ObliqueImpact`.

    Errors of coefficients of restitution are relative to 1, of the velocity to v_t0, and of the friction
    work to ½ m_t v_t0². The error of the viscous work is relative to the whole kinetic energy. All others
    are relative to the quantity.
    """

    restitution: Array
    tangential_velocity: Array
    tangential_restitution: Array
    max_tangential_force: Array
    contact_time: Array
    friction_work: Array
    plastic_work: Array
    viscous_work: Array


@dataclass(frozen=True, eq=False, repr=False)
class ObliqueImpact(Entries, Result):
    """Results of one or many oblique impacts, returned by `oblique_impact`; `result[i]` selects one.

    `normal` is the `Impact` along the normal, with all its quantities.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium, oblique_impact
    >>> hit = oblique_impact(FlatPunch(radius=0.5), Medium(E_star=1.0), 1.0, 0.1, 1.0, friction=0.1)
    >>> print(bool(hit.slips_throughout), round(hit.velocity_change, 6))  # −2 μ v₀
    True -0.02
    """

    normal: Impact
    #: Speed v_t0 (m/s) of the point of contact along the surface; friction coefficient μ; mass m_t (kg).
    tangential_speed: Array
    friction: Array
    tangential_mass: Array
    _surface: SurfaceSolution
    #: Method of solution of the tangential motion.
    model: ClassVar[Model] = FRICTION
    _quantities = (
        "mass", "speed", "tangential_speed", "friction", "tangential_mass", "restitution",
        "tangential_velocity", "tangential_restitution", "rebound_angle", "max_depth", "max_force",
        "max_tangential_force", "contact_time", "friction_work", "plastic_work", "viscous_work",
    )  # fmt: skip
    _shown = (
        "speed", "tangential_speed", "restitution", "tangential_velocity", "max_tangential_force",
        "friction_work", "plastic_work", "viscous_work",
    )  # fmt: skip
    _dimensions = ("impact",)

    @property
    def mass(self) -> Array:
        """Mass m (kg)."""
        return self.normal.mass

    @property
    def speed(self) -> Array:
        """Normal speed v₀ (m/s) before the impact."""
        return self.normal.speed

    @property
    def restitution(self) -> Array:
        """Normal coefficient of restitution e."""
        return self.normal.restitution

    @property
    def contact_time(self) -> Array:
        """Time (s) from first contact to the loss of contact."""
        return self.normal.contact_time

    @property
    def max_depth(self) -> Array:
        """Largest depth (m)."""
        return self.normal.max_depth

    @property
    def max_force(self) -> Array:
        """Largest normal force (N)."""
        return self.normal.max_force

    @property
    def plastic_work(self) -> Array:
        """Energy (J) dissipated by yielding."""
        return self.normal.plastic_work

    @property
    def max_tangential_force(self) -> Array:
        """Largest tangential force (N), without sign."""
        return self._surface.max_force

    @property
    def friction_work(self) -> Array:
        """Energy (J) dissipated by slip."""
        return self._surface.friction_work

    @property
    def profile(self) -> Profile:
        """The indenter."""
        return self.normal.profile

    @property
    def medium(self) -> Medium:
        """The medium."""
        return self.normal.medium

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model's assumptions, as data, for the normal impact and for friction.

        If elements stick, "tolerance" reports whether it is met. "depth" and "mass" limit the range in
        which errors of the tangential motion were measured.
        """
        limits = (x for x in self.normal.limits if x.concerns == "result")
        return Limits((*limits, *lazy.limits.friction_limits(self.medium), *self._stick_limits()))

    def _stick_limits(self):
        sticks, surface = ~np.asarray(self.slips_throughout), self._surface
        if not sticks.any():
            return ()
        error = np.maximum(surface.change_error, surface.force_error)
        cap = yield_rule(self.profile, self.medium).cap(self.max_depth)
        values = error, surface.tolerance, self.max_depth / cap
        values = (*values, self.mass / self.tangential_mass)
        largest = (float(np.max(np.broadcast_to(x, self.shape)[sticks])) for x in values)
        return lazy.limits.stick_limits(*largest)

    @property
    def slips_throughout(self) -> Any:
        """Whether all elements slip during the whole contact; then the velocity has a closed form."""
        return self._surface.slips_throughout

    @property
    def velocity_change(self) -> Array:
        """Change ΔW (m/s) of the velocity of the point of contact along the surface."""
        return (self._surface.relative_change * self.tangential_speed)[()]

    @property
    def tangential_velocity(self) -> Array:
        """Velocity v_t′ (m/s) of the point of contact along the surface after the impact, with its sign."""
        return (self.tangential_speed + self.velocity_change)[()]

    @property
    def tangential_restitution(self) -> Array:
        """Tangential restitution e_t = −v_t′/v_t0; −1 without friction; its limit for v_t0 → 0."""
        return (-1 - self._surface.relative_change)[()]

    @property
    def rebound_angle(self) -> Array:
        """Angle (rad) to the normal of the leaving point of contact, with the sign of its velocity."""
        return np.arctan2(self.tangential_velocity, self.normal.rebound_speed)[()]

    @property
    def viscous_work(self) -> Array:
        """Energy (J) dissipated by all dashpots, normal and tangential, during the contact and after it."""
        return (self.normal.viscous_work + self._surface.viscous_work)[()]

    @property
    def errors(self) -> ObliqueErrors:
        """Estimated relative errors by the name of the quantity, such as `errors.friction_work`."""
        surface, exact = self._surface, np.full(self.shape, EXACT)[()]
        energy = self.tangential_mass * self.tangential_speed**2 / 2
        viscous = surface.viscous_error * energy + EXACT * self.normal.viscous_work
        return ObliqueErrors(
            restitution=EXACT * self.restitution,
            tangential_velocity=surface.change_error,
            tangential_restitution=surface.change_error,
            max_tangential_force=surface.force_error,
            contact_time=exact,
            friction_work=surface.friction_error,
            plastic_work=exact,
            viscous_work=viscous / (energy + self.mass * self.speed**2 / 2),
        )

    def motion(self, n: int = 200) -> ObliqueMotion:
        """Return the motion of one impact at n instants, normal and tangential, with stick and slip.

        Instants are equally spaced before the turning point, and again after it. The motion is the finest
        run of the solver.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid, oblique_impact
        >>> hit = oblique_impact(Paraboloid(1.0), Medium(1.0), 1.0, 0.01, 0.01, 0.3, tangential_mass=2 / 7)
        >>> motion = hit.motion(50)
        >>> print(motion.stick_radius[0] == 0, (motion.stick_radius > 0).any())
        True True
        """
        check_single(self, "motion")
        return oblique_motion(self, self.normal.motion(n), max(int(self._surface.halvings), 3))
