"""The largest force on a free body, inside of the steps of its flight."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import minimize_scalar

from . import elements
from .foundation import Foundation
from .fronts import force_and_radius


@dataclass(frozen=True, eq=False)
class Step:
    """A step of a flight: the chain before it, velocities (m/s) before and after, its time (s)."""

    row: Foundation
    before: float
    after: float
    time: float

    @property
    def acceleration(self):
        """v̇ (m/s²)."""
        return (self.after - self.before) / self.time

    def force(self, time):
        """Force (N) at a time (s) from its beginning."""
        velocity = self.before + self.acceleration * time
        ramp = self.row._ramp((self.before + velocity) / 2 * time, time)
        moved = self.row._after(ramp, *elements.advance(self.row._elements, ramp), velocity)
        return force_and_radius(moved)[0]

    def until(self, depth):
        """Time (s) at which a depth (m) is reached on the way down, if it is."""
        way, v = depth - self.row.depth, self.before
        if way == np.inf:
            return np.inf
        return 2 * way / (v + np.sqrt(max(v**2 + 2 * self.acceleration * way, 0.0))) if v > 0 else 0.0


def largest_force(steps, first_yield, known):
    """The largest force (N) during some steps.

    Parameters
    ----------
    steps : sequence of Step
        Those before and after the largest force at the end of a step.
    first_yield : float
        Depth (m) at which the force has a kink, because yield begins.
    known : float
        That largest force (N).
    """
    for step in steps:
        # Just after first touch a flat face carries all that the dashpots take.
        times = [1e-9 * step.time, step.time]
        kink = step.until(first_yield)
        if times[0] < kink < times[1]:
            times.insert(1, kink)
        ends = [step.force(time) for time in times]
        known = max(known, *ends)
        for piece, values in zip(pairwise(times), pairwise(ends), strict=True):
            known = max(known, _largest(step.force, *piece, *values))
    return known


def _largest(function, low, high, first, last):
    """The largest value of a function between two places with known values; at once, if a parabola."""
    middle, half = (low + high) / 2, (high - low) / 2
    value = function(middle)
    bend, slope = first - 2 * value + last, last - first
    if not abs(slope) < -2 * bend:
        return value
    top, found = value - slope**2 / (8 * bend), function(middle - slope / (2 * bend) * half)
    if abs(found - top) <= 1e-7 * top:
        return found
    search = minimize_scalar(lambda place: -function(place), bounds=(low, high), method="bounded")
    return max(found, -search.fun)
