"""One impact of a cone as one would write it down with SciPy, dry or viscous: depth, e and T each.

In units of length L = (m v₀²/k)^(1/3), with φ = k d², and of time L/v₀; τ and d_c in them are θ and D.
"""

from dataclasses import dataclass

import numpy as np
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

from .exact import Exact, critical_depth

#: Methods of `solve_ivp` and their relative tolerances.
STEPPING = {"RK45": (1e-3, 1e-6), "DOP853": (1e-6, 1e-9, 1e-12)}


@dataclass(frozen=True)
class _Units:
    """Length (m) and time (s), θ and D."""

    length: object
    time: object
    theta: object
    critical: object


def _units(cone, medium, mass, speed, pi=np.pi, number=float):
    stiffness = 2 * number(medium.E_star) / (pi * number(cone.slope))
    length = (number(mass) * number(speed) ** 2 / stiffness) ** (number(1) / 3)
    theta = 4 * number(medium.eta) / number(medium.E_star) * number(speed) / length
    return _Units(length, length / number(speed), theta, number(critical_depth(medium)) / length)


def _stages(units):
    """Decelerations: elastic, yielding, and on the way up in the live depth ℓ = d − P.

    d (d + 2θ ḋ), then D (2d − D) + 2θ d ḋ; on the way up (d + θ ḋ)² − P² = (ℓ + θ ḋ)(ℓ + θ ḋ + 2P).
    """
    theta, D = units.theta, units.critical

    def elastic(d, v):
        return d * (d + 2 * theta * v)

    def yielding(d, v):
        return D * (2 * d - D) + 2 * theta * d * v

    def unloading(plastic):
        return lambda live, v: (live + theta * v) * (live + theta * v + 2 * plastic)

    return elastic, yielding, unloading


def _flown(units, run):
    """Three smooth stretches between events: yield, the turning point, the loss of contact."""
    elastic, yielding, unloading = _stages(units)
    first, state = run(elastic, (0, 1), lambda d, v: units.critical - d)
    second, state = run(yielding, state, lambda d, v: v)
    plastic = state[0] - units.critical
    third, last = run(unloading(plastic), (units.critical, 0), lambda depth, v: depth + units.theta * v)
    return state[0] * units.length, -last[1], (first + second + third) * units.time


def stepped(cone, medium, mass, speed, solver, tolerance):
    """Largest depth, restitution and contact time of an impact that yields, by `solve_ivp`."""

    def run(deceleration, state, left):
        def event(t, y):
            return left(*y)

        event.terminal, event.direction = True, -1
        # The way back is only a critical depth long.
        least = 1e-3 * tolerance * max(map(abs, state))
        options = {"method": solver, "rtol": tolerance, "atol": least, "events": event}
        flow = solve_ivp(lambda t, y: (y[1], -deceleration(*y)), (0.0, 1e9), state, **options)
        return flow.t[-1], flow.y[:, -1]

    return _flown(_units(cone, medium, mass, speed), run)


def exact(cone, medium, mass, speeds, digits):
    """The same as three lists of so many digits, by Taylor series for each stretch."""

    def run(deceleration, state, left):
        flow = mp.odefun(lambda t, y: [y[1], -deceleration(*y)], 0, [mpf(part) for part in state])
        end = _root(lambda t: left(*flow(t)))
        return end, flow(end)

    with mp.workdps(digits):
        flights = [_flown(_units(cone, medium, mass, speed, mp.pi, mpf), run) for speed in speeds]
    return tuple(Exact(values) for values in zip(*flights, strict=True))


def _root(function):
    """First zero of a function that is positive at 0 and negative for good behind it."""
    high = mpf(1) / 1024
    while function(high) > 0:
        high *= 2
    return mp.findroot(function, (high / 2, high), solver="anderson")
