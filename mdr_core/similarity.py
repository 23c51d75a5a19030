"""Many elastic impacts on a viscous medium at once, for shapes that are a power of the radius.

With d₀ the depth that the body would reach without viscosity, every result over its dry value is a
function of one number, ζ = τ v₀/d₀. Here these functions are Chebyshev series in ln ζ, on panels that are
made from the equation of motion when they are first needed.
"""

from functools import lru_cache

import numpy as np

from . import superpose
from .course import Bodies
from .panels import chunks
from .profiles import Cone, FlatPunch, Paraboloid, PowerLaw
from .rebound import solve
from .turning import turning_point
from .yielding import LiveInterval

#: From so many impacts on, making the panels pays.
WORTHWHILE = 1000
_DEGREE = 15
_NODES = np.polynomial.chebyshev.chebpts1(_DEGREE + 1)
#: Largest |ln ζ| that has panels.
_LARGEST = 80


def by_similarity(bodies):
    """Elastic impacts, and which of all they hold for: nothing yields, and the shape is one power.

    Returns
    -------
    holds : ndarray of bool
    depth, time, restitution, loss, force : ndarray
        Largest depth (m), contact time (s), coefficient of restitution, what viscosity takes of the
        kinetic energy, largest force over 2E* (m²); meaningless where they do not hold.
    """
    exponent = _exponent(bodies.profile)
    if exponent is None or np.ndim(exponent):
        return np.zeros(bodies.speed.shape, bool), *np.zeros((5, bodies.speed.size))
    forever, nothing = np.full_like(bodies.speed, np.inf), np.zeros_like(bodies.speed)
    dry, _ = turning_point(bodies.profile, bodies.inertia * bodies.speed**2 / 2, forever, nothing, nothing)
    zeta = np.log(bodies.relaxation_time) + np.log(bodies.speed) - np.log(dry.upper)
    holds = (bodies.before == 0) & (np.abs(zeta) < _LARGEST)
    depth, time, restitution, loss, force = np.exp(_series(exponent, np.where(holds, zeta, 0.0)))
    depth, time = depth * dry.upper, time * (dry.upper / bodies.speed)
    holds &= depth <= bodies.critical_depth
    return holds, depth, time, restitution, loss, force * superpose.radius_integral(bodies.profile, dry)


def _exponent(profile):
    """Exponent n of a power-law shape, infinite for a flat punch, None for others."""
    known = {FlatPunch: np.inf, Cone: 1.0, Paraboloid: 2.0}
    return profile.exponent if isinstance(profile, PowerLaw) else known.get(type(profile))


def _series(exponent, zeta):
    """Logarithms of the five functions at ln ζ, on panels of length 1."""
    panel = np.floor(zeta).astype(int)
    result = np.empty((5, zeta.size))
    for number in np.unique(panel):
        rows = np.flatnonzero(panel == number)
        coefficients = _panel(exponent, int(number))
        for part in chunks(rows.size):
            x = 2 * (zeta[rows[part]] - number) - 1
            result[:, rows[part]] = np.polynomial.chebyshev.chebval(x, coefficients)
    return result


@lru_cache(maxsize=4096)
def _panel(exponent, number):
    """Chebyshev coefficients of the five functions on one panel, (degree, function)."""
    zeta = np.exp(number + (1 + _NODES) / 2)
    one, nothing = np.ones_like(zeta), np.zeros_like(zeta)
    profile = FlatPunch(1.0) if exponent == np.inf else PowerLaw(1.0, exponent)
    dry = LiveInterval(nothing, one, one)
    inertia = 2 * superpose.energy_integral(profile, dry)
    course = solve(Bodies(profile, zeta, inertia, one, np.inf * one, nothing, nothing))
    loss = zeta * (course.slid + course.released) / (inertia / 2)
    force = course.peak * inertia / superpose.radius_integral(profile, dry)
    values = np.log([course.deepest, course.time, -course.velocity, loss, force])
    return np.polynomial.chebyshev.chebfit(_NODES, values.T, _DEGREE)
