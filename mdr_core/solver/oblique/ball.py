"""Angles of incidence and spinning balls for oblique impacts."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike, Parameter
from .oblique_impact import ObliqueImpact


def at_angle(speed: ArrayLike, angle: ArrayLike) -> "tuple[Array, Array]":
    """Compute the normal and the tangential speed of a body from its speed and its angle of incidence.

    For example: `oblique_impact(profile, medium, mass, *at_angle(speed, angle), friction)`.

    Parameters
    ----------
    speed : float or array_like
        Speed (m/s), positive.
    angle : float or array_like
        Angle (rad) to the normal, between −π/2 and π/2. It is π/2 minus the angle of attack.

    Returns
    -------
    tuple of float or numpy.ndarray
        Normal speed, speed · cos(angle), and tangential speed, speed · sin(angle), both in m/s, of the
        shape to which the arguments broadcast.

    Raises
    ------
    ValueError
        If the speed is not positive, or the angle is not within −π/2 … π/2, for example in degrees.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import at_angle
    >>> print(*(round(part, 9) for part in at_angle(2.0, np.radians(30.0))))
    1.732050808 1.0
    """
    speed = check.positive("speed", speed, unit="m/s")
    angle = check.finite_array("angle", angle, unit="rad")
    outside = np.abs(angle) >= np.pi / 2
    advice = "convert degrees by numpy.radians"
    check.raise_if("angle", angle, outside, "must lie within −π/2 … π/2", unit="rad", advice=advice)
    check.common_shape("at_angle", speed=speed, angle=angle)
    return check.frozen(speed * np.cos(angle)), check.frozen(speed * np.sin(angle))


@dataclass(frozen=True)
class Ball:
    """Ball that may spin, with the speed of its point of contact and the change of its spin in an impact.

    With spin Ω (rad/s) and the speed V of the centre, the point of contact has the speed v_t = V + RΩ.
    Backspin is positive, and the ball rolls if V = −RΩ.

    Parameters
    ----------
    mass, radius : float or array_like
        Mass m (kg), radius R (m).
    hollow : bool, optional
        A thin wall, with I = 2mR²/3, instead of a solid ball, with I = 2mR²/5.

    Examples
    --------
    >>> from mdr_core import Ball
    >>> solid, hollow = Ball(7.0, 1.0), Ball(5.0, 1.0, hollow=True)
    >>> print(round(solid.tangential_mass, 9), round(hollow.tangential_mass, 9))
    2.0 2.0
    """

    mass: Parameter
    radius: Parameter
    hollow: bool = False

    if TYPE_CHECKING:

        def __init__(self, mass: ArrayLike, radius: ArrayLike, hollow: bool = False) -> None: ...

    def __post_init__(self):
        mass = check.positive("Ball mass", self.mass, unit="kg")
        radius = check.positive("Ball radius", self.radius, unit="m")
        check.common_shape("Ball", mass=mass, radius=radius)
        check.store(self, mass=mass, radius=radius)

    @property
    def inertia(self) -> Array:
        """Moment of inertia I (kg m²) about an axis through the centre."""
        return (2 / 3 if self.hollow else 2 / 5) * self.mass * self.radius**2

    @property
    def tangential_mass(self) -> Array:
        """Effective mass m_t (kg) at the point of contact along the surface, 1/m_t = 1/m + R²/I."""
        return 1 / (1 / self.mass + self.radius**2 / self.inertia)

    def contact_speed(self, tangential_speed: ArrayLike, spin: ArrayLike) -> Array:
        """Return the speed v_t (m/s) of the point of contact, from the centre's speed and the spin."""
        speed = check.finite_array("tangential_speed", tangential_speed, unit="m/s")
        return (speed + self.radius * check.finite_array("spin", spin, unit="rad/s"))[()]

    def rebound(
        self, hit: ObliqueImpact, tangential_speed: ArrayLike, spin: ArrayLike = 0.0
    ) -> "tuple[Array, Array]":
        """Return the tangential speed of the centre (m/s) and the spin (rad/s) after an impact.

        The same impulse m_t ΔW changes both: m ΔV = m_t ΔW, I ΔΩ = R m_t ΔW.

        Examples
        --------
        >>> from mdr_core import Ball, FlatPunch, Medium, oblique_impact
        >>> ball = Ball(mass=1.0, radius=1.0)
        >>> hit = oblique_impact(FlatPunch(1.0), Medium(1.0), 1.0, 1.0, 3.5, 0.5, tangential_mass=2 / 7)
        >>> speed, spin = ball.rebound(hit, 3.5)
        >>> print(round(speed, 6), round(spin, 6))  # it rolls at 5/7 of its speed
        2.5 -2.5
        """
        impulse = hit.tangential_mass * hit.velocity_change
        speed = check.finite_array("tangential_speed", tangential_speed, unit="m/s") + impulse / self.mass
        spin = check.finite_array("spin", spin, unit="rad/s") + self.radius * impulse / self.inertia
        return speed[()], spin[()]
