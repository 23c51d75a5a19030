"""Random arguments: plausible ones, and some that no function can take."""

from dataclasses import fields
from decimal import Decimal
from fractions import Fraction

import numpy as np

import mdr_core as mdr


def _nested(depth):
    value = 1.0
    for _ in range(depth):
        value = [value]
    return value


ODD = (
    0, 0.0, -0.0, -1.0, 1, True, None, "1", "", b"1", 1j, [], [[]], {}, object(), np.nan, np.inf, -np.inf,
    1e300, 1e-300, 1e140, 1e-140, 5e-324, 1.7e308, 10**400, np.float32(1e-3), np.int8(1), np.uint64(3),
    np.bool_(True), np.array(1e-6), np.array([]), np.array([1e-6]), np.array([[1e-6, np.nan]]), "nan",
    np.zeros((2, 0)), (1e-6, 2e-6), [1e-6, [2e-6]], np.array([1e-6], dtype=object), np.datetime64("2020"),
    Fraction(1, 3), Decimal("1e-6"), np.float16(0.01), np.longdouble("1e4000"), np.ma.array(1.0, mask=True),
    {1e-6}, range(3), np.array(["1"]), _nested(40), _nested(2000), np.zeros((1,) * 20), float, lambda: 1.0,
)  # fmt: skip
SCALARS = ("FlatPunch", "Cone", "Paraboloid", "PowerLaw", "Sphere", "Hyperboloid", "RoundedCone",
           "ParabolicPunch", "TruncatedCone", "TruncatedParaboloid", "RoundedPunch")  # fmt: skip
COUNTS = {name: len(fields(getattr(mdr, name))) for name in SCALARS}
# Shapes given by their slope remember what they have fitted, at a second or so each: made once.
_RADII = (1e-8, 3e-7, 2e-5, 1e-3)
_SMOOTH = [mdr.Smooth(lambda r, R=R: r / R) for R in _RADII]
_SMOOTH += [mdr.Smooth(lambda r, R=R: 0.3 * r / np.hypot(r, R)) for R in _RADII]


class Source:
    """Random arguments: mostly plausible ones, at the rate `odd` some that are not.

    `most` is the length that arrays stay below.
    """

    def __init__(self, seed, odd=0.05, most=6):
        self.rng, self.odd, self.most = np.random.default_rng(seed), odd, most

    def chance(self, share):
        return self.rng.random() < share

    def pick(self, values):
        return values[self.rng.integers(len(values))]

    def number(self, low=-9.0, high=1.0):
        """A number between powers of ten, of any type that users hand in."""
        if self.chance(self.odd):
            return self.pick(ODD)
        value = 10.0 ** self.rng.uniform(low, high)
        kind = self.rng.random()
        if kind < 0.05 and 1e-37 < value < 1e37:
            return np.float32(value)
        return np.array(value) if kind < 0.1 else value

    def numbers(self, low=-9.0, high=1.0):
        """A number or an array."""
        if self.chance(0.5) or self.chance(self.odd):
            return self.number(low, high)
        values = 10.0 ** self.rng.uniform(low, high, self.rng.integers(0, self.most))
        values = values.astype(np.float32) if self.chance(0.1) else values
        values.setflags(write=False)
        return values.tolist() if self.chance(0.3) else values

    def column(self, count, low, high):
        """One number, or as many as there are of something."""
        values = 10.0 ** self.rng.uniform(low, high, count)
        return values if self.chance(0.5) else values[0]

    def samples(self):
        """A convex polygon."""
        r = np.append(0, np.cumsum(10.0 ** self.rng.uniform(-9, -5, self.rng.integers(1, 8))))
        slopes = np.cumsum(10.0 ** self.rng.uniform(-3, 0, len(r) - 1))
        return mdr.Sampled(r, np.append(0, np.cumsum(slopes * np.diff(r))))

    def shape(self):
        """An indenter of lengths that fit each other, or of odd arguments."""
        draw = self.rng.random()
        if draw < 0.1:
            return self.samples()
        if draw < 0.12:
            return self.pick(_SMOOTH)
        name = self.pick(SCALARS)
        if name == "PowerLaw":
            n = 10.0 ** self.rng.uniform(-1, 1.7)
            return mdr.PowerLaw(10.0 ** self.rng.uniform(-2, 2) * 1e-6 ** (1 - n), n)
        return getattr(mdr, name)(*(self.number(-8, -1) for _ in range(COUNTS[name])))

    def shapes(self, count):
        """Many indenters of one kind."""
        name = self.pick(SCALARS)
        if name == "PowerLaw":
            n = self.column(count, -1, 1.7)
            return mdr.PowerLaw(self.column(count, -2, 2) * 1e-6 ** (1 - n), n)
        return getattr(mdr, name)(*(self.column(count, -8, -1) for _ in range(COUNTS[name])))

    def medium(self, viscous=False):
        q_c = np.inf if self.chance(0.2) else self.number(-4, 4)
        return mdr.Medium(self.number(4, 12), q_c, self.number(-6, 6) if viscous else 0.0)

    def media(self, count, viscous=False):
        """Many media, at most half of them without yield."""
        q_c = self.column(count, -4, 4)
        q_c = np.where(self.rng.random(np.shape(q_c)) < 0.2, np.inf, q_c)
        return mdr.Medium(self.column(count, 4, 12), q_c, self.column(count, -6, 6) if viscous else 0.0)


def finite(*values, infinite=False):
    """Refuses NaN, and infinity where it has no place."""
    for value in values:
        value = np.asarray(value)
        assert value.dtype.kind in "fiu", value
        assert not np.isnan(value).any(), value
        assert infinite or np.isfinite(value).all(), value
