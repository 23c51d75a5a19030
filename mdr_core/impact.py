"""Impact of a free rigid body.

A dry one is solved by energy balance and quadrature, without time stepping; a viscous one by its
equation of motion (`rebound`).
"""

from dataclasses import dataclass

import numpy as np

from . import _check
from .arguments import check_types
from .contact_time import contact_time
from .indentation import Indentation
from .medium import Medium
from .model import CLOSED_FORM, SCALAR_ODE
from .profiles import Profile
from .replay import motion
from .scaling import fast_limit
from .turning import dry_restitution, plastic_integral, turning_point
from .viscous import Rebound, impacts_in_time


def impact(profile, medium, mass, speed, *, plastic_depth=0.0):
    """Let a body of given mass hit the medium at given speed, with no other force acting.

    Contact begins at the bottom of the imprint that is there, on a virgin medium at depth 0, and
    ends when the force returns to zero.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium; viscous if `eta` is positive.
    mass : float or array_like
        Mass m (kg), positive.
    speed : float or array_like
        Speed v₀ (m/s) at first contact, positive.
    plastic_depth : float or array_like, optional
        Plastic depth (m) of an imprint of the same indenter that is there already and has relaxed:
        for repeated impacts, the `plastic_depth` of the one before. 0 (the default) is a virgin medium.

    Returns
    -------
    Impact
        Quantities of the shape to which mass, speed, plastic depth and the parameters of profile
        and medium broadcast: one impact or a million.

    Raises
    ------
    ValueError
        If a mass or a speed is not finite and positive, shapes do not broadcast, or the indenter
        goes deeper than its shape is known.

    Examples
    --------
    Restitution of a cone that is pressed five times as deep as where yield starts:

    >>> from mdr_core import Cone, Medium, indent
    >>> medium = Medium(E_star=1.0, q_c=1.0)
    >>> state = indent(Cone(slope=1.0), medium, 5 * medium.critical_depth)
    >>> energy = state.stored_energy + state.plastic_work
    >>> hit = impact(Cone(slope=1.0), medium, 2.0, energy**0.5)
    >>> print(round(hit.restitution, 9))
    0.461643536

    The second impact on the same spot loses less:

    >>> again = impact(Cone(slope=1.0), medium, 2.0, energy**0.5, plastic_depth=hit.plastic_depth)
    >>> bool(again.restitution > hit.restitution)
    True
    """
    return solve_impact(profile, medium, mass, speed, plastic_depth)


def solve_impact(profile, medium, mass, speed, plastic_depth=0.0, *, in_time=False):
    """`impact`; `in_time` the equation of motion is solved also where there is no viscosity."""
    check_types(profile, medium)
    mass = _check.positive("mass", mass, unit="kg")
    speed = _check.positive("speed", speed, unit="m/s")
    before = _check.positive("plastic_depth", plastic_depth, unit="m", zero=True)
    shape = _check.common_shape(
        "impact",
        mass=mass,
        speed=speed,
        plastic_depth=before,
        profile=np.empty(profile.shape),
        medium=np.empty(medium.shape),
    )
    with np.errstate(over="ignore", under="ignore"):
        energy = np.asarray(mass * speed**2 / 2)
    bad = ~((energy > 0) & (energy < np.inf))
    _check.refuse("kinetic energy", energy, bad, "is outside double precision", unit="J")
    mass, speed, before = (np.broadcast_to(part, shape) for part in (mass, speed, before))
    bound = f"is deeper than the shape is known, {np.min(profile.deepest, initial=np.inf):g} m"
    _check.refuse("plastic_depth", before, before > profile.deepest, bound, unit="m")
    if in_time or np.any(np.asarray(medium.eta) > 0):
        live, growth, rebound = impacts_in_time(profile, medium, mass, speed, before, in_time)
    else:
        target = np.broadcast_to(energy / (2 * medium.E_star), shape)
        # The search may begin far from the root, where powers leave double precision.
        with np.errstate(all="ignore"):
            live, growth = turning_point(profile, target, *medium._critical_depth_parts, before)
        rebound = None
    known = np.minimum(profile.deepest, _check.LARGEST)
    deep = ~(live.upper <= known)
    bound = f"m/s presses deeper than the shape is known, {np.min(known, initial=np.inf):g} m"
    _check.refuse("speed", speed, deep, bound, remedy="hit less hard")
    deepest = Indentation(profile, medium, live.upper, live)
    return Impact(profile, medium, mass[()], speed[()], deepest, growth, rebound)


@dataclass(frozen=True, eq=False)
class Impact:
    """One impact or many; made by `impact`. Every quantity has the shape of the ensemble.

    `deepest` is the state at the turning point, `growth` what the impact added to the plastic depth
    (m), `rebound` what a viscous impact ends with, None for a dry one. `result[i]` picks one impact.
    """

    profile: Profile
    medium: Medium
    mass: np.ndarray
    speed: np.ndarray
    deepest: Indentation
    growth: np.ndarray
    rebound: Rebound | None = None

    def __getitem__(self, index):
        deepest = self.deepest[index]
        mass, speed, growth = self.mass[index], self.speed[index], self.growth[index]
        rebound = self.rebound and self.rebound[index]
        return Impact(deepest.profile, deepest.medium, mass, speed, deepest, growth, rebound)

    @property
    def model(self):
        """How it was found: energy balance in closed form, or the equation of motion."""
        return CLOSED_FORM if self.rebound is None else SCALAR_ODE

    @property
    def max_depth(self):
        """Largest indentation depth d_max (m), from the virgin surface."""
        return self.deepest.depth

    @property
    def max_force(self):
        """Largest force (N); a viscous impact has it before the turning point."""
        return self.deepest.force if self.rebound is None else self.rebound.max_force

    @property
    def contact_radius(self):
        """Largest contact radius a (m)."""
        return self.deepest.contact_radius

    @property
    def plastic_radius(self):
        """Radius c (m) of the plastic zone that remains."""
        return self.deepest.plastic_radius

    @property
    def plastic_depth(self):
        """Plastic depth d_p (m) that remains."""
        return self.deepest.plastic_depth

    @property
    def damaged_area(self):
        """Area π c² (m²) of the plastic zone; in the fast limit that of the contact, π a²."""
        return np.pi * self.plastic_radius**2

    @property
    def stored_energy(self):
        """Elastic energy (J) at the turning point; a dry impact returns all of it."""
        return self.deepest.stored_energy

    @_check.frozen_property
    def plastic_work(self):
        """Energy (J) dissipated by yielding in this impact."""
        d_c = self.medium.critical_depth
        return 2 * self.medium.E_star * plastic_integral(self.profile, self.deepest.live, d_c, self.growth)

    @property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity, with what the foundation relaxes after the contact."""
        return np.zeros(self.mass.shape)[()] if self.rebound is None else self.rebound.viscous_work

    @_check.frozen_property
    def restitution(self):
        """Coefficient of restitution e, speed after over speed before."""
        if self.rebound is not None:
            return self.rebound.restitution
        return dry_restitution(self.profile, self.deepest.live, self.medium.critical_depth, self.growth)

    @property
    def rebound_speed(self):
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @_check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact."""
        if self.rebound is not None:
            return self.rebound.contact_time
        inertia = self.mass / (2 * self.medium.E_star)
        return contact_time(self.profile, inertia, self.speed, self.deepest.live, self.growth)

    @property
    def fast_limit(self):
        """The impact in the limit of Popov (2015), Eqs. (23), (24), with its error: a `FastLimit`.

        Examples
        --------
        >>> from mdr_core import Cone, Medium
        >>> hit = impact(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), 1e-6, 30.0)
        >>> limit = hit.fast_limit
        >>> print(round(limit.contact_area / (4 * 1e-6 * 30.0**2 / 2 / (np.pi * 10.0 * 0.3)), 12))  # (24)
        1.0
        >>> print(f"{limit.max_depth_error:.1e}")  # −d_c/(2 d_max)
        -2.1e-06
        """
        return fast_limit(self)

    def motion(self, n=200):
        """The motion of one impact at n equal steps of time, from first contact to its loss.

        Parameters
        ----------
        n : int
            Number of instants, at least 2.

        Returns
        -------
        Motion
            Time, depth, velocity, force, radii and the energy ledger as arrays.

        Examples
        --------
        >>> from mdr_core import Medium, Paraboloid
        >>> hit = impact(Paraboloid(radius=1.0), Medium(E_star=1.0), 1.0, 0.01)
        >>> motion = hit.motion(101)
        >>> print(round(motion.time[-1] / (hit.max_depth / 0.01), 6))  # Hertz
        2.943275
        >>> print(round(motion.depth[50] / hit.max_depth, 9))  # half way
        1.0
        """
        return motion(self, n)
