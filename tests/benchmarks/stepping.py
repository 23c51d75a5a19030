"""One impact as one would write it down with SciPy, or with the chain: each gives e and T."""

import math
import warnings

import numpy as np
from scipy.integrate import IntegrationWarning, quad, solve_ivp
from scipy.optimize import brentq

import mdr_core as mdr

#: Methods of `solve_ivp` and their relative tolerances.
STEPPING = {"RK45": (1e-3, 1e-6), "DOP853": (1e-3, 1e-6, 1e-9, 1e-12)}


class Curve:
    """Force and work of a cone or a paraboloid, in units of d_c, v₀ and m v₀²."""

    def __init__(self, profile, medium, mass, speed):
        self.profile, self.medium = profile, medium
        unit = medium.critical_depth
        self.time, self.length = unit / speed, unit
        self.power = 2 if hasattr(profile, "slope") else 1.5
        radius = float(profile.contact_radius(unit))
        self.energy = mass * speed**2
        self.scale = 2 * medium.E_star * unit**2 * radius / self.energy / self.power

    def elastic(self, d):
        return self.scale * max(d, 0.0) ** self.power

    def work(self, d):
        return self.elastic(d) * d / (self.power + 1)

    def yielded(self, d):
        """Force beyond the critical depth; for the cone Popov (2015), Eq. (22)."""
        return self.scale * (2 * d - 1) if self.power == 2 else self.elastic(d) - self.elastic(d - 1)

    def unloading(self, live, lower):
        """Force at a depth above the plastic depth, written without cancellation for the cone."""
        if self.power == 2:
            return self.scale * live * (2 * lower + live)
        return self.elastic(lower + live) - self.elastic(lower)

    def loss(self, d):
        """Work of loading to d, 1/2 at the turning point."""
        return self.work(d) - (self.work(d - 1) if d > 1 else 0.0)

    def stored(self, live, lower):
        """Elastic energy at a depth above the plastic depth."""
        return self.work(lower + live) - self.work(lower) - self.elastic(lower) * live


def stepped(curve, solver, tolerance):
    """Three smooth stretches between events, the last in the depth above the plastic depth."""

    def run(force, state, event):
        event.terminal = True
        flow = solve_ivp(
            lambda t, y: (y[1], -force(y[0])),
            (0.0, 1e9),
            state,
            method=solver,
            rtol=tolerance,
            atol=1e-3 * tolerance,
            events=event,
        )
        return flow.t[-1], flow.y[:, -1]

    first, state = run(curve.elastic, (0.0, 1.0), lambda t, y: y[0] - 1)
    second, (deepest, _) = run(curve.yielded, state, lambda t, y: y[1])
    third, state = run(lambda live: curve.unloading(live, deepest - 1), (1.0, 0.0), lambda t, y: y[0])
    return -state[1], (first + second + third) * curve.time


def integrated(curve, tolerance):
    """The turning point from the energy, contact time from dd/v as it stands."""
    deepest = brentq(lambda d: curve.loss(d) - 0.5, 1.0, 1e9, xtol=1e-300, rtol=1e-15)
    stored = curve.stored(1.0, deepest - 1)

    def loading(d):
        return 1 / math.sqrt(max(1 - 2 * curve.loss(d), 1e-30))

    def unloading(live):
        return 1 / math.sqrt(max(2 * (stored - curve.stored(live, deepest - 1)), 1e-30))

    with warnings.catch_warnings():
        # Where rounding stops it, the error tells.
        warnings.simplefilter("ignore", IntegrationWarning)
        time = sum(
            quad(function, *ends, epsabs=0, epsrel=tolerance, limit=200)[0]
            for function, ends in ((loading, (0, 1)), (loading, (1, deepest)), (unloading, (0, 1)))
        )
    return math.sqrt(2 * stored), time * curve.time


def chained(profile, medium, mass, speeds, tolerance, attribute):
    """The row of springs, dashpots and sliders under a mass, one impact after the other."""
    hits = [
        mdr.chain_impact(profile, medium, mass, speed, tolerance=tolerance) for speed in speeds.tolist()
    ]
    return np.array([getattr(hit, attribute) for hit in hits])
