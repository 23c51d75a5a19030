"""Onset of yield: force of an indentation and speed of an impact at which the first element yields."""

import numpy as np

from . import _check
from ._check import Array, ArrayLike
from .integrals import integrals
from .live_interval import LiveInterval
from .medium import Medium, check_pair, shape_with
from .shapes.profile import Profile
from .yielding import yield_rule


@_check.keywords_explained
def critical_force(profile: Profile, medium: Medium) -> Array:
    """Normal force F_c (N) at which yield starts, that of an elastic indentation to the critical depth.

    F_c = 2E* ∫ a(s) ds over 0 < s < d_c; for a cone Popov (2015), Eq. (20).

    Parameters
    ----------
    profile : Profile
        The indenter.
    medium : Medium
        The medium.

    Returns
    -------
    float or ndarray
        Force (N), of the shape to which the parameters of both broadcast; infinite where nothing yields.

    Raises
    ------
    ValueError
        If the critical depth is larger than the depth to which the profile is known.

    Examples
    --------
    >>> from mdr_core import Cone
    >>> print(round(critical_force(Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)), 12))  # π q_c²/(2E* s)
    6.28318530718
    """
    yields, interval = _at_onset("critical_force", profile, medium)
    force = 2 * medium.E_star * integrals(profile).radius_integral(interval)
    return _check.frozen(np.where(yields, force, np.inf))


@_check.keywords_explained
def yield_speed(profile: Profile, medium: Medium, mass: ArrayLike) -> Array:
    """Speed v_y (m/s) of a free body above which an impact on a virgin medium without viscosity yields.

    Its kinetic energy is the elastic energy at the critical depth: m v_y²/2 = 2E* ∫ (d_c − s) a(s) ds over
    0 < s < d_c (Johnson, Contact Mechanics, 11.4, with the yield criterion of Popov (2015), Eq. (12)). The
    dashpots of a viscous medium take part of the energy, so that yield starts at a higher speed.

    Parameters
    ----------
    profile, medium
        As for `critical_force`.
    mass : float or array_like
        Mass m (kg), positive.

    Returns
    -------
    float or ndarray
        Speed (m/s), of the shape to which mass and parameters broadcast; infinite where nothing yields.

    Raises
    ------
    ValueError
        If a mass is not positive, or the critical depth is larger than the known depth of the profile.

    Examples
    --------
    Cone of slope s: m v_y²/2 = 2E* d_c³/(3π s).

    >>> from mdr_core import Cone
    >>> medium = Medium.from_critical_depth(E_star=1.0, critical_depth=1.0)
    >>> print(round(yield_speed(Cone(slope=1.0), medium, mass=4 / (3 * np.pi)), 12))
    1.0
    """
    mass = _check.positive("mass", mass, unit="kg")
    yields, interval = _at_onset("yield_speed", profile, medium, mass=mass)
    speed = np.sqrt(4 * medium.E_star / mass * integrals(profile).energy_integral(interval))
    return _check.frozen(np.where(yields, speed, np.inf))


def _at_onset(what, profile, medium, **values):
    """Where the medium yields at all, and the live interval of an elastic indentation to the onset."""
    check_pair(profile, medium)
    shape = shape_with(what, profile, medium, **values)
    onset = np.broadcast_to(yield_rule(profile, medium).onset(), shape)
    yields = onset < np.inf
    return yields, LiveInterval.elastic(profile._known(np.where(yields, onset, 0.0)))
