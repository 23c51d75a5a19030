"""Oblique impact: a body that comes with a speed along the surface too, on a medium with friction.

The normal motion is that of `impact`: it does not feel the tangential one, and is solved once. The
tangential one is solved in closed form where all elements slip throughout, else on the row of `friction`,
in runs with twice the elements and half the steps of the one before.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..medium import Medium, check_pair, shape_with
from ..report import Report
from ..results import Limit, Model, friction_limits
from ..shapes.profile import Profile
from .friction import changes, grip, slide
from .impact import Impact, impact
from .levels import MOST_LEVELS, levels
from .oblique_motion import ObliqueMotion, oblique_motion

FRICTION = Model(
    "chain with friction",
    "the normal motion does not feel the tangential one and is solved on its own; along the surface every "
    "element sticks or slips for itself",
)

#: Most halvings of the first run's steps.
_MOST_RUNS = 8
#: Relative error of the normal motion, and of what follows from it in closed form.
_EXACT = 1e-9


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
    """Let a body hit the medium with a speed along the surface as well, under Coulomb's friction.

    Popov's outlook (2015): beside every element of the foundation stands one along the surface, κ =
    2(1 − ν)/(2 − ν) as stiff and as viscous (Mindlin). It sticks as long as its load is no more than the
    friction coefficient times the normal load, and slips else. Yield caps the normal springs only; friction
    feels the load that there is.

    Parameters
    ----------
    profile, medium
        The indenter, and the medium: elastic, yielding, viscous; its `poisson` is ν.
    mass, speed : float or array_like
        Mass m (kg) and normal speed v₀ (m/s) at first contact, positive.
    tangential_speed : float or array_like
        Speed W₀ (m/s) of the contact point along the surface, of any sign; that of the body if it does not
        spin, else `Ball.contact_speed`. `at_angle` makes both speeds from one and an angle.
    friction : float or array_like
        Coefficient of friction μ, the same for stick and slip; 0 and infinity are allowed.
    tangential_mass : float or array_like, optional
        Mass m_t (kg) that is felt at the contact point along the surface, 1/m_t = 1/m + R²/I; by default m,
        that of a body that cannot turn. `Ball.tangential_mass` is that of a ball.
    tolerance : float, optional
        Error allowed in the tangential velocity relative to the tangential speed, and in work and largest
        force relative to themselves (or to a hundredth of the tangential energy, where work is less).

    Returns
    -------
    ObliqueImpact
        Quantities of the shape to which all arguments broadcast, with estimates of their `errors`.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the indenter goes deeper than its shape is known.

    Examples
    --------
    A ball that slips throughout, Maw, Barber & Fawcett (1976): with ψ = κW/(μv) and χ = κm/(2m_t),
    ψ₂ = ψ₁ − 4χ, here for κ = 2/3 and χ = 7/6.

    >>> from mdr_core import Ball, Medium, Paraboloid
    >>> ball = Ball(mass=1e-3, radius=5e-3)
    >>> medium = Medium(E_star=1e9)
    >>> hit = oblique_impact(
    ...     Paraboloid(5e-3), medium, 1e-3, 1.0, 3.0, 0.5, tangential_mass=ball.tangential_mass
    ... )
    >>> print(round(hit.tangential_velocity * (2 / 3) / 0.5, 9), round(3.0 * (2 / 3) / 0.5 - 4 * 7 / 6, 9))
    -0.666666667 -0.666666667
    """
    check_pair(profile, medium)
    mass = _check.positive("mass", mass, unit="kg")
    speed = _check.positive("speed", speed, unit="m/s")
    tangential_speed = _signed(tangential_speed)
    friction = _check.positive("friction", friction, infinite=True, zero=True)
    own = mass if tangential_mass is None else tangential_mass
    own = _check.positive("tangential_mass", own, unit="kg")
    tolerance = _check.positive_number("tolerance", tolerance)
    given = {"mass": mass, "speed": speed, "tangential_speed": tangential_speed, "friction": friction}
    shape = shape_with("oblique_impact", profile, medium, **given, tangential_mass=own)
    hit = impact(profile, medium, np.broadcast_to(mass, shape)[()], np.broadcast_to(speed, shape)[()])
    parts = [np.broadcast_to(part, shape) for part in (tangential_speed, friction, own)]
    found = np.empty((10, *shape))
    for index in np.ndindex(shape):
        one = hit[index] if shape else hit
        found[(slice(None), *index)] = _solve(one, *(float(part[index]) for part in parts), tolerance)
    return ObliqueImpact(hit, *map(_check.frozen, parts), *map(_check.frozen, found))


def _signed(speed):
    """A tangential speed (m/s) of any sign as a float array; 0, or of a size that squares bear."""
    speed = _check.finite_array("tangential_speed", speed, unit="m/s", most=_check.LARGEST)
    tiny = (speed != 0) & (np.abs(speed) < _check.SMALLEST)
    bound = f"must be 0 or at least {_check.SMALLEST:g}"
    return _check.refuse("tangential_speed", speed, tiny, bound, unit="m/s")


def _solve(hit, speed, friction, mass, tolerance):
    """Of one impact: change of the velocity over W₀, largest force, friction and viscous work, and more.

    That is: errors of these four, in the same units; how often steps were halved, −1 in closed form;
    whether all slips throughout.
    """
    medium, v, e = hit.medium, float(hit.speed), float(hit.restitution)
    ratio, size = float(medium.tangential_ratio), abs(speed) or 1.0
    stiffness, loss = 2 * ratio * float(medium.E_star), friction * float(hit.mass) / mass
    units = np.array([1.0, stiffness * abs(speed), stiffness * speed**2, stiffness * speed**2])
    hold = grip(hit, speed, friction)
    slips = size >= friction / ratio * v and size - loss * (1 + e) * v >= -friction / ratio * e * v
    if friction == 0 or (speed and slips):
        change = -loss * (1 + e) * v / size
        lost = mass * abs(change) * (2 + change) / 2 * speed**2
        viscous, error, count = friction**2 / ratio * hit.viscous_work, 0.0, -1
        if medium.eta > 0 and hit.plastic_work > 0 and friction > 0:
            values, errors, count = _limits(hit, stiffness / mass, hold, tolerance)
            viscous, error = values[3] * units[3], errors[3] * units[3]
        found = np.array([change, friction * hit.max_force, lost - viscous, viscous])
        errors = _EXACT * np.abs(found) + [0.0, 0.0, error, error]
        return (*found, *errors, count, True)
    values, errors, count = _limits(hit, stiffness / mass, hold, tolerance)
    values[1] = min(values[1], friction * float(hit.max_force) / units[1]) if speed else 0.0
    return (*values * units, *errors * units, count, False)


def _limits(hit, inertia, hold, tolerance):
    """Limits of the quantities of ever finer runs, their estimated errors, and the number of halvings."""
    grid = levels(hit, inertia, 0)
    run, before, limit = slide(hit, grid, inertia, hold), None, None
    for count in range(1, _MOST_RUNS):
        # The first run tells at which instants stick begins.
        grid = levels(hit, inertia, count, changes(hit, run, hold))
        coarse, run = run.quantities, slide(hit, grid, inertia, hold)
        if count == 1:
            continue
        before, limit = limit, run.quantities + (run.quantities - coarse) / 3
        least = np.abs(limit - run.quantities) * (0.5 if before is None else 0.1)
        # Work is counted against itself, or a hundredth of the energy that there was along the surface.
        least_work = 0.005 / inertia
        scale = np.array([1.0, limit[1], max(limit[2], least_work), max(limit[2] + limit[3], least_work)])
        errors = np.maximum(
            least if before is None else np.maximum(least, np.abs(limit - before)), tolerance / 2 * scale
        )
        if np.all(errors <= tolerance * scale) or 2 * grid.depth.size > MOST_LEVELS:
            break
    return np.append(limit[0], np.maximum(limit[1:], 0.0)), errors, count


class ObliqueErrors(NamedTuple):
    """Estimated errors of the quantities of an `ObliqueImpact`, each in the unit of its quantity."""

    restitution: Array
    tangential_velocity: Array
    tangential_restitution: Array
    max_tangential_force: Array
    contact_time: Array
    friction_work: Array
    plastic_work: Array
    viscous_work: Array


@dataclass(frozen=True, eq=False, repr=False)
class ObliqueImpact(Report):
    """Oblique impacts, one or many; made by `oblique_impact`. `result[i]` picks one of many.

    `normal` is the `Impact` along the normal, with all of its quantities.
    """

    normal: Impact
    #: Speed W₀ (m/s) of the contact point along the surface before; friction coefficient μ; mass m_t (kg).
    tangential_speed: Array
    friction: Array
    tangential_mass: Array
    _change: Array
    #: Largest tangential force (N), by its size.
    max_tangential_force: Array
    #: Energy (J) dissipated by slip.
    friction_work: Array
    _viscous: Array
    _change_error: Array
    _force_error: Array
    _friction_error: Array
    _viscous_error: Array
    _halvings: Array
    #: Whether all elements slip from first contact to its loss: then the velocity is known in closed form.
    slips_throughout: Array
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

    def __getitem__(self, index: Any) -> "ObliqueImpact":
        return ObliqueImpact(*(getattr(self, part.name)[index] for part in fields(self)))

    @property
    def profile(self) -> Profile:
        """The indenter."""
        return self.normal.profile

    @property
    def medium(self) -> Medium:
        """The medium."""
        return self.normal.medium

    @property
    def model(self) -> Model:
        """How the tangential motion was found."""
        return FRICTION

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Where the model's assumptions end, as data: those of the normal impact, and those of friction.

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> hit = oblique_impact(Cone(0.1), Medium(1e9, 10.0, poisson=0.3), 1e-12, 0.1, 0.1, 0.3)
        >>> for limit in hit.limits:
        ...     print(limit.what, round(limit.value, 3), limit.holds)
        slope 0.1 True
        coupling 0.286 False
        slip direction 0.088 True
        """
        return (*(x for x in self.normal.limits if x.concerns == "result"), *friction_limits(self.medium))

    @property
    def mass(self) -> Array:
        """Mass m (kg)."""
        return self.normal.mass

    @property
    def speed(self) -> Array:
        """Normal speed v₀ (m/s) before."""
        return self.normal.speed

    @property
    def restitution(self) -> Array:
        """Normal coefficient of restitution e."""
        return self.normal.restitution

    @property
    def contact_time(self) -> Array:
        """Time (s) from first contact to its loss."""
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
    def velocity_change(self) -> Array:
        """Change ΔW (m/s) of the contact point's velocity along the surface."""
        return (self._change * self.tangential_speed)[()]

    @property
    def tangential_velocity(self) -> Array:
        """Velocity W′ (m/s) of the contact point along the surface after, with its sign."""
        return (self.tangential_speed + self.velocity_change)[()]

    @property
    def tangential_restitution(self) -> Array:
        """Tangential restitution e_t = −W′/W₀: −1 without friction; of W₀ = 0, that of a slow one."""
        return (-1 - self._change)[()]

    @property
    def rebound_angle(self) -> Array:
        """Angle (rad) from the normal at which the contact point leaves, with the sign of its velocity."""
        return np.arctan2(self.tangential_velocity, self.normal.rebound_speed)[()]

    @property
    def viscous_work(self) -> Array:
        """Energy (J) dissipated by dashpots, normal and tangential, with what relaxes after the contact."""
        return (self.normal.viscous_work + self._viscous)[()]

    @property
    def errors(self) -> ObliqueErrors:
        """Estimated errors, each in the unit of its quantity: a few names, as `errors.friction_work`."""
        normal = self.normal
        restitution, time = _EXACT * normal.restitution, _EXACT * normal.contact_time
        change = self._change_error * np.abs(self.tangential_speed)
        viscous = self._viscous_error + _EXACT * normal.viscous_work
        parts = restitution, change, self._change_error, self._force_error, time
        return ObliqueErrors(*parts, self._friction_error, _EXACT * normal.plastic_work, viscous)

    def motion(self, n: int = 200) -> ObliqueMotion:
        """The motion of one impact at n instants, normal and tangential, with stick and slip.

        At equal steps up to the turning point, and from there on, about the same ones; on elements as fine
        as the tolerance needed, whose own ledger closes at every instant.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> hit = oblique_impact(Paraboloid(1.0), Medium(1.0), 1.0, 0.01, 0.01, 0.3, tangential_mass=2 / 7)
        >>> motion = hit.motion(50)
        >>> print(motion.stick_radius[0] == 0, (motion.stick_radius > 0).any())
        True True
        """
        self._one("motion")
        return oblique_motion(self, n, max(int(self._halvings), 3))
