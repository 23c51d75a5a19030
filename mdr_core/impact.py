"""Impact of a free rigid body: from energy balance and quadrature, without time stepping."""

from dataclasses import dataclass

import numpy as np

from . import _check, superpose
from .indentation import Indentation, first_loading
from .inverse import increasing_root
from .medium import Medium
from .panels import chunks, integration_rule
from .profiles import Profile
from .yielding import LiveInterval


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

    >>> from mdr_core import Cone, Medium, indent
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
    with np.errstate(over="ignore", under="ignore"):
        energy = mass * speed**2 / 2
    bad = ~((energy > 0) & (energy < np.inf))
    _check.refuse("kinetic energy", energy, bad, "is outside double precision", unit="J")
    depth = _largest_depth(profile, medium, energy)
    deepest = first_loading(profile, medium, depth)
    return Impact(profile, medium, mass.copy()[()], speed.copy()[()], deepest)


def _positive(quantity, value, unit):
    value = _check.finite_array(quantity, value, unit=unit)
    return _check.refuse(quantity, value, value <= 0, "must be positive", unit=unit)


def _largest_depth(profile, medium, energy):
    """Depth (m) at which the work of pressing equals the energy."""

    def work(depth):
        state = first_loading(profile, medium, depth)
        return state.stored_energy + state.plastic_work, state.force

    depth = increasing_root(
        work,
        energy,
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

    def __getitem__(self, index):
        return Impact(self.profile, self.medium, self.mass[index], self.speed[index], self.deepest[index])

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

    @_check.frozen_property
    def restitution(self):
        """Coefficient of restitution e = √(U/(m v₀²/2)), U the energy stored at the turning point."""
        # U/(U + W_p) instead of U over the kinetic energy: never above 1.
        return np.sqrt(self.stored_energy / (self.stored_energy + self.plastic_work))

    @property
    def rebound_speed(self):
        """Speed e v₀ (m/s) at which the body leaves."""
        return self.restitution * self.speed

    @_check.frozen_property
    def contact_time(self):
        """Time (s) from first contact to the loss of contact."""
        return _contact_time(self)


_NODE, _WEIGHT, _TAIL = integration_rule(40)


def _contact_time(hit):
    """Contact time: ∫ dd/v over unloading and loading.

    Depths run from where a stretch begins to its turning point as τ³(2 − τ³): the square in
    1 − τ³ takes out the square root at the turning point, the cube the fractional powers where
    contact or yield begins. What is still to be spent is integrated from the turning point back,
    so that it never cancels.
    """
    live = hit.deepest.live
    deepest, lower, length = (np.ravel(part) for part in (live.upper, live.lower, live.length))
    kinks = np.array(hit.profile.kinks)
    time = np.empty_like(deepest)
    for rows in chunks(time.size, 512):
        time[rows] = _time_over_root(hit.profile, kinks, deepest[rows], lower[rows], length[rows])
    # m v²/2 = 2E* times the integral of a ds that is still to be spent.
    return time.reshape(np.shape(live.upper)) * np.sqrt(hit.mass / (4 * hit.medium.E_star))


def _time_over_root(profile, kinks, deepest, lower, length):
    """∫ ds/√(∫ a ds) over unloading and loading (√m), one impact a row."""
    base, whole = lower[:, None], length[:, None]
    nothing, end = np.zeros_like(deepest), np.ones_like(deepest)
    # Unloading over the live length, above the plastic depth.
    time, _ = _stretch(profile, length, kinks - base, lambda s: (base + 0 * s, s), end, nothing)
    # Loading beyond the critical depth: the interval moves. Its lower end has a scale of its own, d_c.
    breaks = np.hstack([kinks + 0 * base, kinks - whole, whole])
    beyond, spent = _stretch(profile, lower, breaks, lambda s: (s, whole + 0 * s), end, nothing)
    # Loading up to the critical depth: the same map about the turning point, cut at τ_c.
    cut = np.cbrt(length / deepest / (1 + np.sqrt(lower / deepest)))
    below, _ = _stretch(profile, deepest, kinks + 0 * base, lambda s: (0 * s, s), cut, spent)
    return time + beyond + below


def _stretch(profile, extent, breaks, interval, last, spent):
    """∫ ds/√spent over a stretch of depth, and what is spent when it ends, one impact a row.

    Parameters
    ----------
    extent : ndarray, shape (N,)
        Depth (m) from where the stretch begins to its turning point, at τ = 1.
    breaks : ndarray, shape (N, K)
        Depths (m) in it at which the force has a kink.
    interval : callable
        Lower end and length of the live interval at depths from the beginning.
    last : ndarray, shape (N,)
        End of the stretch in τ.
    spent : ndarray, shape (N,)
        What is still to be spent beyond `last`.
    """
    room = np.maximum(extent, np.finfo(float).tiny)[:, None]
    share = np.clip(breaks / room, 0, 1)
    # Inverse of τ³(2 − τ³), without cancellation for small shares.
    inner = np.minimum(np.cbrt(share / (1 + np.sqrt(1 - share))), last[:, None])
    edges = np.sort(np.hstack([np.zeros_like(room), inner, last[:, None]]), axis=1)
    time, spent = np.zeros_like(extent), spent.copy()
    for k in range(edges.shape[1] - 2, -1, -1):
        low, high = edges[:, k], edges[:, k + 1]
        rows = np.flatnonzero((high > low) & (extent > 0))
        if not rows.size:
            continue
        tau = low[rows, None] + (high - low)[rows, None] * _NODE
        depth = np.zeros((len(extent), _NODE.size))
        depth[rows] = extent[rows, None] * (tau**3 * (2 - tau**3))
        lower, length = (part[rows] for part in interval(depth))
        rate = extent[rows, None] * (high - low)[rows, None] * (6 * tau**2 * (1 - tau**3))
        flow = superpose.radius_integral(profile, LiveInterval(lower, lower + length, length)) * rate
        left = spent[rows, None] + np.einsum("ij,kj->ik", flow, _TAIL)
        time[rows] += np.einsum("ij,j->i", rate / np.sqrt(left), _WEIGHT)
        spent[rows] += np.einsum("ij,j->i", flow, _WEIGHT)
    return time, spent
