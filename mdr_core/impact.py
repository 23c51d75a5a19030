"""Impact of a free rigid body: from energy balance and quadrature, without time stepping."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import _check, superpose
from .indentation import Indentation, indent
from .inverse import increasing_root
from .medium import Medium
from .panels import chunks, integration_rule
from .profiles import Profile
from .yielding import LiveInterval, live_interval


def impact(profile, medium, mass, speed):
    """Let a body of given mass hit the medium at given speed, with no other force acting.

    Contact begins at depth 0 and ends when the force returns to zero.

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium, with `eta = 0`.
    mass : float or array_like
        Mass m (kg), positive.
    speed : float or array_like
        Speed v₀ (m/s) at first contact, positive. Broadcasts against `mass`: one impact or many.

    Returns
    -------
    Impact
        Quantities of the broadcast shape, computed when asked for.

    Raises
    ------
    ValueError
        If a mass or a speed is not finite and positive, or the medium is viscous.

    Examples
    --------
    Restitution of a cone that is pressed five times as deep as where yield starts:

    >>> from mdr_core import Cone, Medium
    >>> medium = Medium(E_star=1.0, q_c=1.0)
    >>> state = indent(Cone(slope=1.0), medium, 5 * medium.critical_depth)
    >>> energy = state.stored_energy + state.plastic_work
    >>> print(round(impact(Cone(slope=1.0), medium, 2.0, energy**0.5).restitution, 9))
    0.461643536
    """
    if medium.eta > 0:
        raise ValueError(
            f"viscosity eta = {medium.eta:g} Pa·s must be 0 in an impact: the dry impact is solved by "
            "energy balance; use Medium(E_star, q_c)"
        )
    mass, speed = np.broadcast_arrays(_positive("mass", mass, "kg"), _positive("speed", speed, "m/s"))
    energy = mass * speed**2 / 2
    bad = ~((energy > 0) & (energy < np.inf))
    _check.refuse("kinetic energy", energy, bad, "is outside double precision", unit="J")
    depth = _largest_depth(profile, medium, energy)
    return Impact(profile, medium, mass[()], speed[()], indent(profile, medium, depth[..., None])[..., 0])


def _positive(quantity, value, unit):
    value = _check.finite_array(quantity, value, unit=unit)
    return _check.refuse(quantity, value, value <= 0, "must be positive", unit=unit)


def _work(profile, medium, depth):
    """Work of pressing to `depth` and force there, both over 2E* (m³, m²)."""
    live = live_interval(depth[..., None], *medium._critical_depth_parts)[..., 0]
    virgin = LiveInterval(np.zeros_like(depth), live.lower, live.lower)
    yielded = np.where(live.lower > 0, medium.critical_depth, 0.0)
    with np.errstate(invalid="ignore"):
        plastic = np.where(live.lower > 0, yielded * superpose.radius_integral(profile, virgin), 0.0)
    work = superpose.energy_integral(profile, live) + plastic
    return work, superpose.radius_integral(profile, live)


def _largest_depth(profile, medium, energy):
    """Depth (m) at which the work of pressing equals the energy."""
    depth = increasing_root(
        lambda depth: _work(profile, medium, depth),
        energy / (2 * medium.E_star),
        medium.critical_depth if medium.critical_depth < np.inf else 1.0,
        profile.deepest,
    )
    bound = f"presses deeper than the shape is known, {profile.deepest:g} m"
    _check.refuse("kinetic energy", energy, np.isinf(depth), bound, remedy="hit less hard")
    return depth


@dataclass(frozen=True, eq=False)
class Impact:
    """One impact or many; made by `impact`. Every quantity has the shape of mass and speed.

    `deepest` is the state at the turning point.
    """

    profile: Profile
    medium: Medium
    mass: np.ndarray
    speed: np.ndarray
    deepest: Indentation

    @property
    def max_depth(self):
        """Largest indentation depth d_max (m)."""
        return self.deepest.depth

    @property
    def max_force(self):
        """Largest force (N)."""
        return self.deepest.force

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
        """Elastic energy (J) at the turning point, all of it returned."""
        return self.deepest.stored_energy

    @property
    def plastic_work(self):
        """Energy (J) dissipated by yielding."""
        return self.deepest.plastic_work

    @property
    def viscous_work(self):
        """Energy (J) dissipated by viscosity: none in a dry impact."""
        return np.zeros_like(self.mass)[()]

    @cached_property
    def restitution(self):
        """Coefficient of restitution e = √(U/(m v₀²/2)), U the energy stored at the turning point."""
        # U/(U + W_p) instead of U over the kinetic energy: never above 1.
        return np.sqrt(self.stored_energy / (self.stored_energy + self.plastic_work))

    @property
    def rebound_speed(self):
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @cached_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact."""
        return _contact_time(self)


_NODE, _WEIGHT, _TAIL = integration_rule(40)


# Depth reached at each node, as a fraction of the largest, and its rate of change. It falls short by
# (1 − τ³)²: the square takes out the square root at the turning point, the cube the fractional
# powers where contact or yield begins.
_RISE, _RATE = _NODE**3 * (2 - _NODE**3), 6 * _NODE**2 * (1 - _NODE**3)


def _contact_time(hit):
    """Contact time: ∫ dd/v over each stretch in which the force is smooth."""
    live = hit.deepest.live
    deepest, lower, length = (np.ravel(part) for part in (live.upper, live.lower, live.length))
    time = np.empty_like(deepest)
    for rows in chunks(time.size, 512):
        time[rows] = _time_over_root(
            hit.profile, deepest[rows, None], lower[rows, None], length[rows, None]
        )
    # m v²/2 = 2E* times the integral of a ds that is still to be spent.
    return time.reshape(np.shape(live.upper)) * np.sqrt(hit.mass / (4 * hit.medium.E_star))


def _time_over_root(profile, deepest, lower, length):
    """∫ ds/√(∫ a ds) over unloading and loading (√m), one impact a row.

    What is still to be spent is integrated from the turning point back, so that it never cancels.
    """

    def force(lower, length):
        return superpose.radius_integral(profile, LiveInterval(lower, lower + length, length))

    def slowness(rate, spent):
        return np.einsum("ij,j->i", rate / np.sqrt(spent), _WEIGHT)

    def still_to_spend(flow):
        return np.einsum("ij,kj->ik", flow, _TAIL)

    # Unloading, over the live length.
    left = length * _RISE
    flow = force(lower + 0 * left, left) * (length * _RATE)
    time = slowness(length * _RATE, still_to_spend(flow))
    # Loading up to the critical depth: the map about the turning point, cut at τ_c.
    cut = np.cbrt(length / deepest / (1 + np.sqrt(lower / deepest)))
    tau = cut * _NODE
    depth = deepest * tau**3 * (2 - tau**3)
    rate = deepest * cut * 6 * tau**2 * (1 - tau**3)
    spent = still_to_spend(force(np.zeros_like(depth), depth) * rate)
    # Loading beyond the critical depth.
    rows = np.flatnonzero(lower[:, 0] > 0)
    beyond = lower[rows]
    flow = force(beyond * _RISE, length[rows] + 0 * _RISE) * (beyond * _RATE)
    time[rows] += slowness(beyond * _RATE, still_to_spend(flow))
    spent[rows] += np.einsum("ij,j->i", flow, _WEIGHT)[:, None]
    return time + slowness(rate, spent)
