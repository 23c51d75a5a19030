"""References of 50 digits for the benchmarks, from textbook formulas that the solver does not use.

Differences of elastic curves, (φ(d) − φ(d_p)), lose digits where d ≫ d_c; here that costs nothing
but more digits to begin with.
"""

import itertools
from functools import cache, wraps

import numpy as np
from mpmath import mp, mpf

# A square of the distance, to 55 digits, from the turning point is still told from rounding.
_DIGITS = 180


def _precise(function):
    @wraps(function)
    def at_full_precision(*args):
        with mp.workdps(_DIGITS):
            return function(*args)

    return at_full_precision


class Exact:
    """Values of 50 digits, as an unevaluated sum of two doubles."""

    def __init__(self, values):
        with mp.workdps(50):
            values = np.atleast_1d(np.array(values, dtype=object))
            self.high = values.astype(float)
            self.low = (values - self.high).astype(float)

    def error(self, values):
        """Root mean square of the error over that of the values."""
        difference = (np.atleast_1d(values) - self.high) - self.low
        return float(np.linalg.norm(difference) / np.linalg.norm(self.high))


@_precise
def critical_depth(medium):
    """d_c = π q_c/(2E*), Popov (2015), Eq. (19)."""
    return mp.pi * mpf(medium.q_c) / (2 * mpf(medium.E_star))


class Power:
    """Elastic curves of z = c rⁿ: cone (c the slope), paraboloid (c = 1/(2R)), or any n."""

    def __init__(self, profile, medium):
        with mp.workdps(_DIGITS):
            if hasattr(profile, "exponent"):
                self.n, c = mpf(profile.exponent), mpf(profile.coefficient)
            elif hasattr(profile, "slope"):
                self.n, c = mpf(1), mpf(profile.slope)
            else:
                self.n, c = mpf(2), 1 / (2 * mpf(profile.radius))
            # g = k xⁿ, from Eqs. (4)–(8).
            half = self.n / 2
            self.k = c * mp.sqrt(mp.pi) * self.n * mp.gamma(half) / (2 * mp.gamma(half + mpf(1) / 2))
            self.p = 1 + 1 / self.n
            self.modulus = mpf(medium.E_star)
            self.critical = critical_depth(medium) if medium.q_c < np.inf else mp.inf

    def radius(self, depth):
        return (depth / self.k) ** (1 / self.n)

    def force(self, depth):
        """Elastic force φ(d)."""
        return 2 * self.modulus * depth * self.radius(depth) / self.p

    def work(self, depth):
        """Elastic work ∫ φ."""
        return self.force(depth) * depth / (self.p + 1)

    def before(self, depth):
        """Plastic depth of a first loading."""
        return max(mpf(0), depth - self.critical) if self.critical < mp.inf else mpf(0)

    def spent(self, depth):
        """Work of a first loading, U + W_p."""
        return self.work(depth) - self.work(self.before(depth))


@_precise
def force(profile, medium, depths):
    """Forces of a first loading."""
    power = Power(profile, medium)
    return Exact([power.force(depth) - power.force(power.before(depth)) for depth in map(mpf, depths)])


@_precise
def pressure(profile, medium, depth, radii):
    """Pressure of a cone under first loading; 0 outside the contact."""
    power = Power(profile, medium)
    modulus, depth = power.modulus, mpf(depth)
    a, lower = power.radius(depth), power.before(depth)
    c = power.radius(lower) if lower else mpf(0)

    def elastic(radius, r):
        if r >= radius:
            return mpf(0)
        return modulus * power.k / mp.pi * mp.acosh(radius / r)

    return Exact([elastic(a, r) - elastic(c, r) for r in map(mpf, radii)])


@cache
@_precise
def impacts(profile, medium, mass, speeds):
    """Largest depth, restitution and contact time of dry impacts at a tuple of speeds."""
    power = Power(profile, medium)
    pairs = [_impact(power, mpf(mass), mpf(speed)) for speed in speeds]
    return tuple(Exact(values) for values in zip(*pairs, strict=True))


def _impact(power, mass, speed):
    energy = mass * speed**2 / 2
    guess = _bisected(lambda depth: power.spent(depth) - energy)
    deepest = mp.findroot(lambda depth: (power.spent(depth) - energy) / energy, guess)
    lower = power.before(deepest)
    returned = energy - (power.critical * power.force(lower) if lower else 0)

    def loading(depth):
        return energy - power.spent(depth)

    def unloading(depth):
        return returned - power.work(depth) + power.work(lower) + power.force(lower) * (depth - lower)

    ends = [mpf(0), power.critical, deepest] if lower else [mpf(0), deepest]
    time = _duration(loading, ends) + _duration(unloading, [lower, deepest])
    return deepest, mp.sqrt(returned / energy), mp.sqrt(mass / 2) * time


def _bisected(function):
    low, high = mpf(10) ** -30, mpf(1)
    while high / low > 1.01:
        middle = mp.sqrt(low * high)
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return low


def _duration(left, ends):
    """∫ dd/√left, with the square root at the last end and fractional powers at the others unfolded."""
    total = mpf(0)
    for low, high in itertools.pairwise(ends):

        @_precise
        def integrand(t, low=low, high=high):
            # A node that rounds to the turning point has no weight.
            rate = 6 * t * (1 - t)
            return (
                (high - low) * rate / mp.sqrt(left(high - (high - low) * (1 - t) ** 2 * (1 + 2 * t)))
                if rate
                else rate
            )

        with mp.workdps(55):
            total += mp.quad(integrand, [0, mpf(1) / 2, 1])
    return total
