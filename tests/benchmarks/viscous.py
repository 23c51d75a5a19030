"""Impact of a cone on a viscous medium that does not yield: the solver beside time stepping."""

import numpy as np
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

import mdr_core as mdr

from .exact import Exact
from .harness import Method, Problem
from .shapes import CONE

_MEDIUM, _MASS = mdr.Medium(1e9, eta=50.0), 1e-9
_TITLE = "cone on a viscous medium"


def problems(quick=False):
    """Restitution and contact time, for impacts in which the dashpots take most of the energy."""
    speeds = np.linspace(0.5, 2.0, 100 if quick else 1000)
    # A reference takes seconds.
    step = len(speeds) // (1 if quick else 2)
    probes = speeds[::step]
    references = _exact(probes)
    return tuple(
        _problem(quantity, speeds, step, reference)
        for quantity, reference in zip(("restitution", "contact time"), references, strict=True)
    )


def _problem(quantity, speeds, step, reference):
    probes = speeds[::step]

    def error(values):
        return reference.error(values if len(values) == len(probes) else values[::step])

    def solved():
        return getattr(mdr.impact(CONE, _MEDIUM, _MASS, speeds), quantity.replace(" ", "_"))

    def looped(solver, tolerance):
        hits = np.array([_stepped(speed, solver, tolerance) for speed in probes])
        return hits[:, int(quantity == "contact time")]

    methods = [Method("mdr_core", "", lambda: solved)]
    for solver, tolerances in (("RK45", (1e-3, 1e-6)), ("DOP853", (1e-3, 1e-6, 1e-9, 1e-12))):
        for tolerance in tolerances:
            methods.append(
                Method(
                    "solve_ivp " + solver,
                    f"rtol = {tolerance:g}",
                    lambda how=(solver, tolerance): lambda: looped(*how),
                    items=len(probes),
                )
            )
    return Problem(quantity, "viscous", _TITLE, len(speeds), error, tuple(methods))


def _units(speed, pi=np.pi, number=float):
    """Length L = (m v₀²/k)^(1/3) with φ = k d², time L/v₀, and θ, the relaxation time in it."""
    stiffness = 2 * number(_MEDIUM.E_star) / (pi * number(CONE.slope))
    length = (number(_MASS) * number(speed) ** 2 / stiffness) ** (number(1) / 3)
    time = length / number(speed)
    return time, 4 * number(_MEDIUM.eta) / number(_MEDIUM.E_star) / time


def _stepped(speed, solver, tolerance):
    """d̈ = −(d² + 2θ d ḋ) on the way down, −(d + θ ḋ)² on the way up."""
    unit, theta = _units(speed)

    def run(force, state, event):
        event.terminal = True
        options = {"method": solver, "rtol": tolerance, "atol": 1e-3 * tolerance, "events": event}
        flow = solve_ivp(lambda t, y: (y[1], -force(*y)), (0.0, 1e9), state, **options)
        return flow.t[-1], flow.y[:, -1]

    down, state = run(lambda d, v: d * (d + 2 * theta * v), (0.0, 1.0), lambda t, y: y[1])
    up, state = run(lambda d, v: (d + theta * v) ** 2, state, lambda t, y: y[0] + theta * y[1])
    return -state[1], (down + up) * unit


def _exact(speeds):
    with mp.workdps(50):
        pairs = [_by_series(speed) for speed in speeds.tolist()]
    return tuple(Exact(values) for values in zip(*pairs, strict=True))


def _by_series(speed):
    """Taylor series of 50 digits for both ways, and their ends by the secant method."""
    unit, theta = _units(speed, mp.pi, mpf)
    down = mp.odefun(lambda t, y: [y[1], -y[0] * (y[0] + 2 * theta * y[1])], 0, [mpf(0), mpf(1)])
    turn = _root(lambda t: down(t)[1])
    deepest = down(turn)[0]
    up = mp.odefun(lambda t, y: [y[1], -((y[0] + theta * y[1]) ** 2)], 0, [deepest, mpf(0)])
    end = _root(lambda t: up(t)[0] + theta * up(t)[1])
    return -up(end)[1], (turn + end) * unit


def _root(function):
    """First zero of a function that is positive at 0."""
    high = mpf(1) / 4
    while function(high) > 0:
        high += mpf(1) / 4
    return mp.findroot(function, (high - mpf(1) / 4, high), solver="anderson")
