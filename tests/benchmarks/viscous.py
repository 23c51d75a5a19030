"""Impact of a cone on a viscous medium, elastic or yielding: the solver beside time stepping."""

from dataclasses import dataclass

import numpy as np
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

import mdr_core as mdr

from .exact import Exact, critical_depth
from .harness import Method, Problem, ladder
from .shapes import CONE
from .stepping import STEPPING, chained

_MASS = 1e-9
_MEDIA = {
    "cone on a viscous medium": mdr.Medium(1e9, eta=50.0),
    "cone on a viscous medium, some hundred critical depths deep": mdr.Medium(1e9, 6.0, eta=2.0),
}


def problems(quick=False):
    """Restitution and contact time, with and without yield."""
    speeds = np.linspace(0.5, 2.0, 100 if quick else 1000)
    # A reference of 50 digits takes seconds, one that does for a quick look less.
    step, digits = (len(speeds), 24) if quick else (len(speeds) // 2, 50)
    return tuple(
        _problem(quantity, title, speeds, step, reference, quick)
        for title, medium in _MEDIA.items()
        for quantity, reference in zip(
            ("restitution", "contact time"), _exact(medium, speeds[::step], digits), strict=True
        )
    )


def _problem(quantity, title, speeds, step, reference, quick):
    medium, probes, attribute = _MEDIA[title], speeds[::step], quantity.replace(" ", "_")

    def error(values):
        return reference.error(values if len(values) == len(probes) else values[::step])

    def solved():
        return getattr(mdr.impact(CONE, medium, _MASS, speeds), attribute)

    def steps(method):
        def run(tolerance):
            hits = np.array([_stepped(medium, speed, method, tolerance) for speed in probes])
            return hits[:, int(quantity == "contact time")]

        return run

    def chain(tolerance):
        return chained(CONE, medium, _MASS, probes, tolerance, attribute)

    methods = [Method("mdr_core", "", lambda: solved)]
    for method, tolerances in STEPPING.items():
        methods += ladder("solve_ivp " + method, "rtol = {:g}", tolerances, steps(method), len(probes))
    tolerances = (1e-4,) if quick else (1e-4, 1e-6)
    methods += ladder("chain_impact", "tolerance = {:g}", tolerances, chain, len(probes))
    return Problem(quantity, "viscous", title, len(speeds), error, tuple(methods))


@dataclass(frozen=True)
class _Units:
    """Length L = (m v₀²/k)^(1/3) with φ = k d², time L/v₀; τ and d_c in them, as θ and D."""

    time: object
    theta: object
    critical: object


def _units(medium, speed, pi=np.pi, number=float):
    stiffness = 2 * number(medium.E_star) / (pi * number(CONE.slope))
    length = (number(_MASS) * number(speed) ** 2 / stiffness) ** (number(1) / 3)
    theta = 4 * number(medium.eta) / number(medium.E_star) * number(speed) / length
    critical = number(critical_depth(medium)) / length if medium.q_c < np.inf else number("inf")
    return _Units(length / number(speed), theta, critical)


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


def _stepped(medium, speed, solver, tolerance):
    """Stretches between events: yield, the turning point, the loss of contact."""
    units = _units(medium, speed)
    elastic, yielding, unloading = _stages(units)
    elapsed = 0.0

    def run(deceleration, state, event):
        nonlocal elapsed
        event.terminal, event.direction = True, -1
        options = {"method": solver, "rtol": tolerance, "atol": 1e-3 * tolerance, "events": event}
        flow = solve_ivp(lambda t, y: (y[1], -deceleration(*y)), (0.0, 1e9), state, **options)
        elapsed += flow.t[-1]
        return flow.y[:, -1]

    state = run(elastic, (0.0, 1.0), lambda t, y: min(units.critical - y[0], y[1]))
    if state[1] > 1e-9:
        state = run(yielding, state, lambda t, y: y[1])
    plastic = max(state[0] - units.critical, 0.0)
    state = run(unloading(plastic), (state[0] - plastic, 0.0), lambda t, y: y[0] + units.theta * y[1])
    return -state[1], elapsed * units.time


def _exact(medium, speeds, digits):
    with mp.workdps(digits):
        pairs = [_by_series(medium, speed) for speed in speeds.tolist()]
    return tuple(Exact(values) for values in zip(*pairs, strict=True))


def _by_series(medium, speed):
    """Taylor series of many digits for each stretch, and their ends by the secant method."""
    units = _units(medium, speed, mp.pi, mpf)
    elastic, yielding, unloading = _stages(units)
    elapsed = mpf(0)

    def run(deceleration, state, left):
        nonlocal elapsed
        flow = mp.odefun(lambda t, y: [y[1], -deceleration(*y)], 0, state)
        end = _root(lambda t: left(*flow(t)))
        elapsed += end
        return flow(end)

    state = [mpf(0), mpf(1)]
    if units.critical < mp.inf:
        state = run(elastic, state, lambda d, v: units.critical - d)
        state = run(yielding, state, lambda d, v: v)
    else:
        state = run(elastic, state, lambda d, v: v)
    plastic = max(state[0] - units.critical, mpf(0))
    live = [state[0] - plastic, mpf(0)]
    state = run(unloading(plastic), live, lambda depth, v: depth + units.theta * v)
    return -state[1], elapsed * units.time


def _root(function):
    """First zero of a function that is positive at 0 and negative for good behind it."""
    high = mpf(1) / 1024
    while function(high) > 0:
        high *= 2
    return mp.findroot(function, (high / 2, high), solver="anderson")
