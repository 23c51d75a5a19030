"""Reference values in 45 digits, by other routes than the solver's.

The reduced profile g and its derivative are the textbook formulas, the contact radius a bisection
of g, and force and energy are sums over the 1D foundation, element by element, each compressed by
min(d − g(x), d − d_p).
"""

import itertools
from dataclasses import fields

from mpmath import mp, mpf
from numpy.polynomial.legendre import leggauss

mp.dps = 45


def _root(x, b):
    return mp.sqrt((x - b) * (x + b))


def _power_law(c, n):
    kappa = mp.sqrt(mp.pi) * n * mp.gamma(n / 2) / (2 * mp.gamma((n + 1) / 2))
    return lambda x: kappa * c * x**n, lambda x: kappa * c * n * x ** (n - 1)


# Per shape, from its parameters: g and g′ behind the flat face, if it has one.
_SHAPES = {
    "FlatPunch": lambda b: (lambda x: mpf(0), lambda x: mpf(0)),
    "Cone": lambda s: (lambda x: mp.pi / 2 * s * x, lambda x: mp.pi / 2 * s),
    "Paraboloid": lambda R: (lambda x: x * x / R, lambda x: 2 * x / R),
    "PowerLaw": _power_law,
    "Sphere": lambda R: (
        lambda x: x * mp.atanh(x / R),
        lambda x: mp.atanh(x / R) + x * R / ((R - x) * (R + x)),
    ),
    "Hyperboloid": lambda s, R: (
        lambda x: s * x * mp.atan(x / (s * R)),
        lambda x: s * (mp.atan(x / (s * R)) + x * s * R / (x**2 + (s * R) ** 2)),
    ),
    "TruncatedCone": lambda b, s: (
        lambda x: s * x * mp.acos(b / x),
        lambda x: s * (mp.acos(b / x) + b / _root(x, b)),
    ),
    "TruncatedParaboloid": lambda b, R: (
        lambda x: x * _root(x, b) / R,
        lambda x: (_root(x, b) + x * x / _root(x, b)) / R,
    ),
    "RoundedCone": lambda R, s: (
        lambda x: x / R * (x if x <= s * R else x - _root(x, s * R) + s * R * mp.acos(s * R / x)),
        lambda x: (2 * x if x <= s * R else 2 * (x - _root(x, s * R)) + s * R * mp.acos(s * R / x)) / R,
    ),
    "RoundedPunch": lambda b, R: (
        lambda x: x / R * (_root(x, b) - b * mp.acos(b / x)),
        lambda x: (2 * _root(x, b) - b * mp.acos(b / x)) / R,
    ),
    "ParabolicPunch": lambda R, b: (lambda x: x * x / R, lambda x: 2 * x / R),
}


def _polygon(r, z):
    """g and g′ of a polygon: a truncated cone from every vertex, by the change of slope there."""
    r, z = [mpf(each) for each in r], [mpf(each) for each in z]
    slopes = [(z[i + 1] - z[i]) / (r[i + 1] - r[i]) for i in range(len(r) - 1)]
    bends = [slopes[0]] + [b - a for a, b in itertools.pairwise(slopes)]

    def reduced(x):
        return x * sum(bend * mp.acos(k / x) for k, bend in zip(r, bends, strict=False) if k < x)

    def slope(x):
        return sum(
            bend * (mp.acos(k / x) + k / _root(x, k)) for k, bend in zip(r, bends, strict=False) if k < x
        )

    return reduced, slope


_SHAPES["Sampled"] = _polygon
_FLAT = {"FlatPunch", "TruncatedCone", "TruncatedParaboloid", "RoundedPunch"}
_WALL = {"FlatPunch": 0, "ParabolicPunch": 1}


def _quad(function):
    """∫ function(u) du over 0 < u < 1; scaled, for the quadrature's own tolerance is absolute.

    Twenty digits and more: a degree higher doubles the time for twice as many.
    """
    scale = function(mpf(1) / 2)
    parts = [0, mpf(1) / 1000, mpf(1) / 30, 1]
    return scale * mp.quad(lambda u: function(u) / scale, parts, maxdegree=5)


class Reference:
    """One state: an indenter taken to `deepest` and then to `depth`."""

    def __init__(self, profile, medium, depth, deepest=None):
        shape = type(profile).__name__
        values = [getattr(profile, field.name) for field in fields(profile)]
        values = [mpf(value) if isinstance(value, float) else value for value in values]
        self._behind, self._slope = _SHAPES[shape](*values)
        self.flat = values[0] if shape in _FLAT else mpf(0)
        self.wall = values[_WALL[shape]] if shape in _WALL else mp.inf
        self.limit = values[0] if shape == "Sphere" else self.wall
        if shape == "Sampled":
            self.limit, self.kinks = mpf(values[0][-1]), [mpf(r) for r in values[0][:-1]]
        else:
            self.kinks = [self.flat] + ([values[0] * values[1]] if shape == "RoundedCone" else [])
        self.modulus = mpf(medium.E_star)
        self.critical = mp.pi * mpf(medium.q_c) / (2 * self.modulus)
        self.depth = mpf(depth)
        deepest = self.depth if deepest is None else max(self.depth, mpf(deepest))
        self.plastic_depth = max(mpf(0), deepest - self.critical)
        self.live_interval = self.depth - self.plastic_depth
        self.a = self.radius(self.depth)
        self.c = self.radius(self.plastic_depth) if self.plastic_depth else mpf(0)

    def g(self, x):
        return self._behind(x) if x > self.flat else mpf(0)

    def radius(self, depth):
        """Largest x with g(x) ≤ depth, by bisection."""
        if self.limit == self.wall < mp.inf and self.g(self.wall) <= depth:
            return self.wall
        low, high = self.flat, self.limit
        if high == mp.inf:
            high = 2 * low or mpf(1)
            while self.g(high) < depth:
                high *= 2
        if low == 0:
            low = high
            while self.g(low) > depth or low == self.limit:
                low, high = low / 2, low
        while high - low > mpf(10) ** -42 * high:
            middle = (low + high) / 2
            low, high = (middle, high) if self.g(middle) <= depth else (low, middle)
        return low

    def _pieces(self, low, high):
        points = sorted({low, high, *(k for k in self.kinks if low < k < high)})
        return itertools.pairwise(points)

    def _over_contact(self, power, depth, low):
        total = low * self.live_interval**power if low == self.c else mpf(0)
        for left, right in self._pieces(low, self.radius(depth)):
            # x = left + h u⁴: fractional powers and square roots at the lower end unfolded.
            h = right - left
            total += _quad(
                lambda u, left=left, h=h: (depth - self.g(left + h * u**4)) ** power * 4 * h * u**3
            )
        return total

    @property
    def force(self):
        return 2 * self.modulus * self._over_contact(1, self.depth, self.c)

    @property
    def stored_energy(self):
        return self.modulus * self._over_contact(2, self.depth, self.c)

    @property
    def plastic_work(self):
        if not self.plastic_depth:
            return mpf(0)
        inside = self.plastic_depth * self.flat
        past = Reference.__new__(Reference)
        past.__dict__ = self.__dict__ | {"live_interval": mpf(0), "c": mpf(0)}
        return (
            2
            * self.modulus
            * self.critical
            * (inside + past._over_contact(1, self.plastic_depth, self.flat))
        )

    def pressure(self, r):
        """p(r) = (E*/π) ∫ g′(x)/√(x² − r²) dx from max(r, c) to a, Popov (2015), Eq. (10)."""
        r, total = mpf(r), mpf(0)
        for left, right in self._pieces(max(r, self.c, self.flat), self.a):
            # x² = left² + span u⁴: square roots at the lower end unfolded.
            span = (right - left) * (right + left)

            def integrand(u, left=left, span=span):
                t2 = span * u**4
                x = mp.sqrt(left**2 + t2)
                if x == left:
                    # A node that rounds to the end has no weight.
                    return mpf(0)
                return self._slope(x) / mp.sqrt((left - r) * (left + r) + t2) * 2 * span * u**3 / x

            total += _quad(integrand)
        if self.wall <= self.a:
            rim = self.depth - max(self.plastic_depth, self.g(self.wall))
            total += rim / mp.sqrt((self.wall - r) * (self.wall + r))
        return self.modulus / mp.pi * total

    def stress(self, r, z, nu):
        """σ_rr, σ_θθ, σ_zz, σ_rz at r and z > 0, each increment dg(x) a flat punch of radius x."""
        r, z, nu = mpf(r), mpf(z), mpf(nu)
        inner = max(self.c, self.flat)
        ends = sorted({inner, self.a, *(x for x in (r, *self.kinks) if inner < x < self.a)})
        # Panels that halve towards both ends, where the integrand is as narrow as z, or goes as a power.
        halves = [mpf(2) ** -k for k in range(70, 0, -1)]
        panels = [mpf(0), *halves, *(1 - half for half in halves[-2::-1]), mpf(1)]
        total = [mpf(0)] * 4
        for left, right in itertools.pairwise(ends):
            for low, high in itertools.pairwise(panels):
                for node, weight in _GAUSS:
                    x = left + (right - left) * (low + (high - low) * node)
                    share = self._slope(x) * weight * (right - left) * (high - low)
                    total = [
                        part + share * each for part, each in zip(total, _punch(x, r, z, nu), strict=True)
                    ]
        if self.wall <= self.a:
            rim = self.depth - max(self.plastic_depth, self.g(self.wall))
            total = [
                part + rim * each for part, each in zip(total, _punch(self.wall, r, z, nu), strict=True)
            ]
        return [self.modulus / mp.pi * part for part in total]


_GAUSS = [((1 + node) / 2, weight / 2) for node, weight in zip(*map(list, leggauss(14)), strict=True)]


def _punch(x, r, z, nu):
    """Stress of a flat punch of radius x, over E*/π and its depth; in its complex form, for z > 0."""
    w = mp.mpc(z, -x)
    S = mp.sqrt(r * r + w * w)
    J, K = mp.im(1 / S), z * mp.im(w / S**3)
    around = -(2 * nu * J + (1 - 2 * nu) * mp.im(1 / (S + w)) - z * mp.im(1 / (S * (S + w))))
    return -((1 + 2 * nu) * J - K) - around, around, -(J + K), -z * r * mp.im(1 / S**3)
