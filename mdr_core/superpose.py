"""Integrals over the live interval: each increment of depth is a flat punch of radius a(s).

Here those that make the force, the energies and the stiffness,

    radius_integral   ∫ a(s) ds            over the depths s in [d_p, d]
    energy_integral   ∫ (d − s) a(s) ds
    radius_drop       a(d) − a(d_p)

for arrays of states; `fields` has those that depend on the radius r. Moduli are the caller's
business, here is geometry only.

Far beyond the critical depth the interval is much shorter than the depths at its ends. Closed
forms are therefore written as the interval's length times a positive mean, never as a difference
of two elastic curves; quadratures are scaled so that the increments sum to that length.
"""

from functools import singledispatch

import numpy as np
from scipy.special import betainc

from .panels import chunks
from .profiles import Cone, FlatPunch, Paraboloid, PowerLaw
from .quadrature import AREA, DROP, VOLUME, by_quadrature, scaled
from .rounded import Sphere
from .yielding import LiveInterval

_TINY = np.finfo(float).tiny


@singledispatch
def radius_integral(profile, live):
    """∫ a(s) ds over the live interval (m²), elementwise."""
    return by_quadrature(profile, live, AREA)


@radius_integral.register
def _(profile: FlatPunch, live):
    return profile.radius * live.length


@radius_integral.register
def _(profile: Cone, live):
    return (live.upper + live.lower) * live.length / (np.pi * profile.slope)


@radius_integral.register
def _(profile: Paraboloid, live):
    # A³ − C³ with A² − C² = length.
    A, C = np.sqrt(live.upper), np.sqrt(live.lower)
    mean = (live.upper + A * C + live.lower) / np.maximum(A + C, _TINY)
    return (2 / 3 * np.sqrt(profile.radius)) * mean * live.length


@radius_integral.register
def _(profile: PowerLaw, live):
    q = 1 + 1 / profile.exponent
    a = profile._radius(live.upper)
    return a * live.upper / q * _power_drop(q, _fraction(live))


@singledispatch
def energy_integral(profile, live):
    """∫ (d − s) a(s) ds over the live interval (m³), elementwise."""
    return by_quadrature(profile, live, VOLUME)


@energy_integral.register
def _(profile: FlatPunch, live):
    return profile.radius / 2 * live.length**2


@energy_integral.register
def _(profile: Cone, live):
    return live.length**2 * (live.upper + 2 * live.lower) / (3 * np.pi * profile.slope)


@energy_integral.register
def _(profile: Paraboloid, live):
    # ∫ 2x²(A² − x²) dx from C to A = C + e, as a polynomial with positive terms in e.
    C = np.sqrt(live.lower)
    e = live.length / np.maximum(np.sqrt(live.upper) + C, _TINY)
    polynomial = ((4 / 15 * e + 4 / 3 * C) * e + 8 / 3 * C**2) * e + 2 * C**3
    return np.sqrt(profile.radius) * e**2 * polynomial


@energy_integral.register
def _(profile: PowerLaw, live):
    q = 1 + 1 / profile.exponent
    a = profile._radius(live.upper)
    return a * live.upper**2 * betainc(2, q, _fraction(live)) / (q * (q + 1))


@singledispatch
def radius_drop(profile, live):
    """a(d) − a(d_p) (m), elementwise: where something has yielded, the width of the elastic ring."""
    return by_quadrature(profile, live, DROP)


@radius_drop.register
def _(profile: FlatPunch, live):
    return np.zeros_like(live.length)


@radius_drop.register
def _(profile: Cone, live):
    return live.length / (np.pi / 2 * profile.slope)


@radius_drop.register
def _(profile: Paraboloid, live):
    both = np.sqrt(live.upper) + np.sqrt(live.lower)
    return np.sqrt(profile.radius) * live.length / np.maximum(both, _TINY)


@radius_drop.register
def _(profile: PowerLaw, live):
    return -profile._radius(live.upper) * np.expm1(depth_ratio(live) / profile.exponent)


def _fraction(live):
    """Length of the live interval as a fraction of the depth, 0 where both vanish."""
    return np.divide(live.length, live.upper, out=np.zeros_like(live.upper), where=live.upper > 0)


def depth_ratio(live):
    """ln(d_p/d) without cancellation: from the length where that is short, else from the ends."""
    with np.errstate(divide="ignore"):
        fraction = _fraction(live)
        ends = np.log(
            np.divide(live.lower, live.upper, out=np.zeros_like(live.upper), where=live.upper > 0)
        )
        return np.where(fraction < 0.5, np.log1p(-np.minimum(fraction, 0.5)), ends)


def _power_drop(q, fraction):
    """1 − (1 − fraction)^q without cancellation."""
    with np.errstate(divide="ignore"):
        return -np.expm1(q * np.log1p(-fraction))


@radius_integral.register
def _(profile: Sphere, live):
    if profile.shape:
        unit, radius, depth = profile.unit
        return radius * depth * radius_integral(unit, scaled(live, depth))
    lower, upper, length = (np.ravel(part) for part in (live.lower, live.upper, live.length))
    result = np.empty_like(length)
    for rows in chunks(length.size):
        result[rows] = _sphere_area(profile, lower[rows], upper[rows], length[rows])
    return result.reshape(np.shape(live.length))


def _sphere_area(profile, lower, upper, length):
    R = profile.radius
    high, low = profile.latitude(upper), np.zeros_like(lower)
    yielded = np.flatnonzero(lower > 0)
    low[yielded] = profile.latitude(lower[yielded])
    area = R**2 * (_cap_moment(high) - _cap_moment(low))
    # In a short interval the difference cancels, but the mean radius is a matter of few nodes.
    short = np.flatnonzero(lower > 0.9 * upper)
    area[short] = R * _mean_tanh(high[short], low[short]) * length[short]
    return area


_SHORT_NODES, _SHORT_WEIGHTS = np.polynomial.legendre.leggauss(4)


def _mean_tanh(high, low):
    """Mean of a/R = tanh y over the depths R y tanh y between two near latitudes."""
    area, depth = np.zeros_like(high), np.zeros_like(high)
    for node, weight in zip(_SHORT_NODES, _SHORT_WEIGHTS, strict=True):
        y = (high + low) / 2 + node * (high - low) / 2
        tanh = np.tanh(y)
        rate = weight * (tanh + y * (1 - tanh) * (1 + tanh))
        depth += rate
        area += tanh * rate
    return area / np.maximum(depth, _TINY)


def _cap_moment(y):
    """[(1 + tanh²y) y − tanh y]/2, the elastic ∫ a ds of a sphere over R²."""
    tanh = np.tanh(y)
    result = ((1 + tanh * tanh) * y - tanh) / 2
    small = np.flatnonzero(tanh < 0.3)
    square = tanh[small] ** 2
    # Σ tanh^(2k+1) 2k/(4k² − 1) for small tanh, where the two terms cancel.
    series = np.zeros_like(square)
    for coefficient in _CAP_SERIES:
        series = series * square + coefficient
    result[small] = series * square * tanh[small]
    return result


_CAP_SERIES = [2 * k / (4 * k * k - 1) for k in range(14, 0, -1)]


@energy_integral.register
def _(profile: Sphere, live):
    if profile.shape:
        unit, radius, depth = profile.unit
        return radius * depth**2 * energy_integral(unit, scaled(live, depth))
    lower, upper, length = (np.ravel(part) for part in (live.lower, live.upper, live.length))
    result = np.empty_like(length)
    for rows in chunks(length.size):
        result[rows] = _sphere_energy(profile, LiveInterval(lower[rows], upper[rows], length[rows]))
    return result.reshape(np.shape(live.length))


# Widths in latitude up to which so many Gauss nodes give full accuracy, down to the axis, where the
# moment is y⁴ times a series in (2y/π)²: the first power that n nodes miss is (2y/π)^(2n − 4).
_LATITUDES = (0.0, 0.015, 0.3, 1.5)
_LATITUDE_RULES = [np.polynomial.legendre.leggauss(count) for count in (5, 8, 16)]


def _sphere_energy(profile, live):
    high, low = profile.latitude(live.upper), np.zeros_like(live.lower)
    yielded = np.flatnonzero(live.lower > 0)
    low[yielded] = profile.latitude(live.lower[yielded])
    width, energy = high - low, np.zeros_like(high)
    for least, most, rule in zip(_LATITUDES, _LATITUDES[1:], _LATITUDE_RULES, strict=False):
        rows = np.flatnonzero((width > least) & (width <= most))
        if rows.size:
            moment = _latitude_moment(high[rows], width[rows], *rule)
            energy[rows] = profile.radius * live.length[rows] ** 2 * moment
    rest = np.flatnonzero((width > _LATITUDES[-1]) | (width <= 0))
    if rest.size:
        energy[rest] = by_quadrature(profile, live[rest], VOLUME)
    return energy


def _latitude_moment(high, width, nodes, weights):
    """∫ (d − s) a ds over R times the square of ∫ ds, with a = R tanh y and s = R y tanh y.

    At y = Y − δ, with T and τ the hyperbolic tangents of Y and δ, a/R = (T − τ)/(1 − T τ), and d − s
    is δ T + y τ (1 − T tanh y): no differences but those of terms that vanish at the axis.
    """
    top, spent, moment = np.tanh(high), np.zeros_like(high), np.zeros_like(high)
    for node, weight in zip(nodes, weights, strict=True):
        delta = (1 - node) / 2 * width
        y, drop = high - delta, np.tanh(delta)
        tanh = (top - drop) / (1 - top * drop)
        rate = weight * (tanh + y * (1 - tanh) * (1 + tanh))
        spent += rate
        moment += rate * tanh * (delta * top + y * drop * (1 - top * tanh))
    return 2 / width * moment / spent**2
