"""Onset of yield: depth, force and impact speed at which the first element yields."""

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike
from ..applicability import check_hardness, check_pair, check_shape, shape_with
from ..medium.medium import Medium
from ..profiles.profile import Profile
from .integrals import integrals
from .live_interval import LiveInterval
from .yielding import yield_rule


@check.keywords_explained
def yield_depth(profile: Profile, medium: Medium) -> Array:
    """Compute the indentation depth d_y (m) at which yield starts: the smallest root of s = u_c(a(s)).

    u_c(a) = π a σ_c(a)/(2E*) is the largest elastic compression of the elements in a contact of radius a.
    For the hardness q_c/a it is `medium.critical_depth` under every indenter, Popov (2015), Eq. (19).

    Parameters
    ----------
    profile, medium
        The indenter and the medium.

    Returns
    -------
    float or ndarray
        Depth (m), of the shape to which the parameters of both broadcast; infinite if nothing yields, and
        0 if a sharp tip yields from first touch.

    Raises
    ------
    ValueError
        If yield starts deeper than the known depth of the profile, or if a law of hardness is not valid up
        to the contact radius there.

    Examples
    --------
    Under a paraboloid on a medium of constant hardness H, d_y = R (π H/(2E*))²:

    >>> import numpy as np
    >>> from mdr_core import Medium, Paraboloid, yield_depth
    >>> from mdr_core import Paraboloid
    >>> medium = Medium(E_star=np.pi, hardness=0.2)
    >>> print(round(yield_depth(Paraboloid(radius=1.0), medium), 12))
    0.01
    """
    return check.frozen(_onset("yield_depth", profile, medium)[()])


@check.keywords_explained
def yield_force(profile: Profile, medium: Medium) -> Array:
    """Compute the normal force F_c (N) at which yield starts.

    F_c = 2E* ∫ a(s) ds over 0 < s < d_y, the `yield_depth`. For a cone and the hardness q_c/a this is
    Popov (2015), Eq. (20).

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.

    Returns
    -------
    float or ndarray
        Force (N), of the shape to which the parameters of both broadcast; infinite if nothing yields.

    Raises
    ------
    ValueError
        If yield starts deeper than the known depth of the profile.

    Examples
    --------
    >>> from mdr_core import Cone, Medium, yield_force
    >>> print(round(yield_force(Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)), 12))  # π q_c²/(2E* s)
    6.28318530718
    """
    yields, interval = _at_onset("yield_force", profile, medium)
    force = 2 * medium.E_star * integrals(profile).radius_integral(interval)
    return check.frozen(np.where(yields, force, np.inf))


@check.keywords_explained
def yield_speed(profile: Profile, medium: Medium, mass: ArrayLike) -> Array:
    """Compute the speed v_y (m/s) of a free body above which a virgin medium without viscosity yields.

    Its kinetic energy is the elastic energy at the `yield_depth`: m v_y²/2 = 2E* ∫ (d_y − s) a(s) ds over
    0 < s < d_y (Johnson, Contact Mechanics, 11.4, with the yield criterion of Popov (2015), Eq. (12)). The
    dashpots of a viscous medium take part of the energy, so that yield starts at a higher speed.

    Parameters
    ----------
    profile, medium
        As for `yield_force`.
    mass : float or array_like
        Mass m (kg), positive.

    Returns
    -------
    float or ndarray
        Speed (m/s), of the shape to which mass and parameters broadcast; infinite if nothing yields.

    Raises
    ------
    ValueError
        If a mass is not positive, or yield starts deeper than the known depth of the profile.

    Examples
    --------
    Cone of slope s: m v_y²/2 = 2E* d_c³/(3π s).

    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, yield_speed
    >>> from mdr_core import Cone
    >>> medium = Medium.from_critical_depth(E_star=1.0, critical_depth=1.0)
    >>> print(round(yield_speed(Cone(slope=1.0), medium, mass=4 / (3 * np.pi)), 12))
    1.0
    """
    mass = check.positive("mass", mass, unit="kg")
    yields, interval = _at_onset("yield_speed", profile, medium, mass=mass)
    speed = np.sqrt(4 * medium.E_star / mass * integrals(profile).energy_integral(interval))
    return check.frozen(np.where(yields, speed, np.inf))


def _at_onset(what, profile, medium, **values):
    """Return whether the medium yields, and the live interval of an elastic indentation to the onset."""
    onset = _onset(what, profile, medium, **values)
    yields = onset < np.inf
    return yields, LiveInterval.elastic(np.where(yields, onset, 0.0))


def _onset(what, profile, medium, **values):
    """Return the depth (m) of the onset, infinite if nothing yields; raise an error if it is not known."""
    check_pair(profile, medium)
    shape = shape_with(what, profile, medium, **values)
    rule = yield_rule(profile, medium)
    onset = np.broadcast_to(rule.onset(), shape)
    # Below the known depth of the profile an onset may be infinite, although the cap is finite.
    unknown = (onset > profile.known_depth) & (rule.cap(profile.known_depth) < np.inf)
    bound = f"is {profile.too_deep()}"
    check.raise_if("yield depth", onset, unknown, bound, unit="m")
    check_shape(profile, onset)
    # If a sharp tip yields from first touch, the law is checked next to the tip.
    check_hardness(profile, medium, np.where(onset > 0, onset, 1e-20))
    return onset
