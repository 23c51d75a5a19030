"""Impacts with adhesion against energies summed over springs, across kinks of the tip."""

import itertools

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import name
from ...slow_reference import RATE, WAY, WithRadii

E, W, MASS = 1e9, 2e-3, 1e-12
MEDIUM = mdr.Medium(E, q_c=8.0, work_of_adhesion=W)
D_C = float(MEDIUM.critical_depth)
TIPS = (
    mdr.Paraboloid(1e-6),
    mdr.RoundedCone(1e-6, 0.1),
    mdr.TruncatedCone(1e-7, 0.2),
    mdr.Sampled([0.0, 1e-7, 2e-7, 8e-7], [0.0, 2e-8, 6e-8, 0.36e-6]),
    mdr.Smooth(lambda r: r / 1e-6),
)


class Sticky(WithRadii):
    """Springs that are stretched by Δl = √(2π a w/E*) at the rim."""

    def stretch(self, a):
        return np.sqrt(2 * np.pi * a * self.w / self.E)

    def depth(self, a):
        return self.g(a) - self.stretch(a)

    def energy(self, a, plastic_depth):
        """Energy (J) of springs and surfaces at radii a (m)."""
        c, p = self.radius(plastic_depth), np.asarray(plastic_depth)

        def load(x):
            return (self.depth(a)[..., None] - np.maximum(self.g(x), p[..., None])) ** 2

        inner = c * (self.depth(a) - p) ** 2
        return self.E * (inner + self.over_x(load, c, a)) - np.pi * self.w * a**2

    def plastic_work(self, p):
        """d_c φ(p) (J)."""
        return 2 * self.E * D_C * self.compressed(p, 0.0 * p, self.radius(p), 0.0 * p, 1)


def bisected(function, low, high):
    """Where a growing function passes 0."""
    for _ in range(70):
        middle = (low + high) / 2
        low, high = (low, middle) if function(np.asarray(middle)) >= 0 else (middle, high)
    return high


def rebound(springs, speed):
    """Time (s) from touching to the pull-off, and restitution, of an impact that yields and bounces."""
    x = max(springs.face, 1e-10) + springs.reach * np.linspace(1e-3, 0.99, 400)
    first = np.flatnonzero(springs.depth(x) < 0)[-1] if np.any(springs.depth(x) < 0) else 0
    touch = bisected(springs.depth, x[first] if first else max(springs.face, 1e-10), x[first + 1])
    start = MASS * speed**2 / 2 + float(springs.energy(np.asarray(touch), np.asarray(0.0)))

    def kinetic(a):
        p = np.maximum(springs.depth(a) - D_C, 0.0)
        return start - springs.energy(a, p) - springs.plastic_work(p)

    turn = bisected(lambda a: -kinetic(a), touch, x[-1])
    p = float(springs.depth(np.asarray(turn))) - D_C
    assert p > 0
    onsets = [0.0, *(float(springs.g(np.asarray(edge))) for edge in springs.edges)]
    cuts = [bisected(lambda a, k=k: springs.depth(a) - D_C - k, touch, turn) for k in onsets if k < p]
    last = float(springs.energy(np.asarray(turn), np.asarray(p)))
    # The rim of the imprint is what lets go.
    rim = max(float(springs.radius(p)), springs.face)
    stable = springs.depth(rim + (turn - rim) * np.linspace(0, 1, 2000)[1:] ** 4)
    assert np.all(np.diff(stable) > 0)

    def returned(a):
        return last - springs.energy(a, np.full(a.shape, p))

    time = passage(springs, kinetic, touch, turn, cuts) + passage(springs, returned, rim, turn, [])
    return time, np.sqrt(2 * float(returned(np.asarray(rim))) / MASS) / speed


def passage(springs, kinetic, low, high, cuts):
    """∫ (dd/da) da/v over contact radii a."""
    halves = [(low + high) / 2, low + 0.01 * (high - low)]
    edges = sorted({low, high, *(c for c in (*springs.edges, *halves, *cuts) if low < c < high)})
    total = 0.0
    for begin, end in itertools.pairwise(edges):
        a = begin + (end - begin) * WAY
        slope = springs.profile.reduced_slope(a)
        rate = np.where(np.isfinite(slope), slope - springs.stretch(a) / (2 * a), 0.0)
        energy = np.maximum(kinetic(a), 1e-300)
        total += np.sum(RATE * (end - begin) * rate / np.sqrt(2 * energy / MASS))
    return total


@pytest.mark.few(2)
@pytest.mark.parametrize("speed", [0.2, 0.3])
@pytest.mark.parametrize("tip", TIPS, ids=name)
def test_across_kinks(tip, speed):
    """The springs' kinetic energy is a difference next to the turning point: 10⁻⁸ of the time is left."""
    hit = mdr.impact(tip, MEDIUM, MASS, speed)
    time, restitution = rebound(Sticky(tip, MEDIUM, 7.5e-7), speed)
    assert hit.contact_time == approx(time, rel=2e-8)
    assert hit.restitution == approx(restitution, rel=1e-8)
    many = mdr.impact(tip, MEDIUM, MASS, [speed, 0.1, 0.25, 0.3])
    assert many.contact_time[0] == approx(hit.contact_time, rel=1e-10)


@pytest.mark.parametrize("tip", TIPS, ids=name)
def test_of_no_impacts_there_are_no_times(tip):
    none = mdr.impact(tip, MEDIUM, MASS, np.zeros((3, 0)))
    assert none.contact_time.shape == none.restitution.shape == (3, 0)
    assert "Impact" in str(none)
