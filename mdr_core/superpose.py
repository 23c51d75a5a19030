"""Integrals over the live interval: each increment of depth is a flat punch of radius a(s).

Four integrals over the depths s in [d_p, d] give every rate-independent result (the moduli are
the caller's business, here is geometry only):

    radius_integral        ∫ a(s) ds                  force
    energy_integral        ∫ (d − s) a(s) ds          stored energy
    pressure_integral      ∫ ds/√(a(s)² − r²)         contact pressure
    displacement_integral  ∫ h(r, a(s)) ds            surface displacement, imprint

Far beyond the critical depth the interval is much shorter than the depths at its ends. Closed
forms are therefore written as the interval's length times a positive mean, never as a difference
of two elastic curves; quadratures are scaled so that the increments sum to that length.
"""

from functools import singledispatch

import numpy as np
from scipy.special import betainc

from .panels import gauss_panels
from .profiles import Cone, FlatPunch, Paraboloid, PowerLaw

# Contributions below e^(−40) of the largest are left out of a graded quadrature.
_NEGLIGIBLE = 40.0


@singledispatch
def radius_integral(profile, live):
    """∫ a(s) ds over the live interval (m²), elementwise."""
    raise NotImplementedError(type(profile).__name__)


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
    mean = (live.upper + A * C + live.lower) / np.maximum(A + C, np.finfo(float).tiny)
    return (2 / 3 * np.sqrt(profile.radius)) * mean * live.length


@radius_integral.register
def _(profile: PowerLaw, live):
    q = 1 + 1 / profile.exponent
    a = profile._radius(live.upper)
    return a * live.upper / q * _power_drop(q, _fraction(live))


@singledispatch
def energy_integral(profile, live):
    """∫ (d − s) a(s) ds over the live interval (m³), elementwise."""
    raise NotImplementedError(type(profile).__name__)


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
    e = live.length / np.maximum(np.sqrt(live.upper) + C, np.finfo(float).tiny)
    polynomial = ((4 / 15 * e + 4 / 3 * C) * e + 8 / 3 * C**2) * e + 2 * C**3
    return np.sqrt(profile.radius) * e**2 * polynomial


@energy_integral.register
def _(profile: PowerLaw, live):
    q = 1 + 1 / profile.exponent
    a = profile._radius(live.upper)
    return a * live.upper**2 * betainc(2, q, _fraction(live)) / (q * (q + 1))


@singledispatch
def radius_drop(profile, live):
    """a(d) − a(d_p) (m), elementwise: the width of the elastic ring."""
    raise NotImplementedError(type(profile).__name__)


@radius_drop.register
def _(profile: FlatPunch, live):
    return np.where((live.length > 0) & (live.lower == 0), profile.radius, 0.0)


@radius_drop.register
def _(profile: Cone, live):
    return live.length / (np.pi / 2 * profile.slope)


@radius_drop.register
def _(profile: Paraboloid, live):
    both = np.sqrt(live.upper) + np.sqrt(live.lower)
    return np.sqrt(profile.radius) * live.length / np.maximum(both, np.finfo(float).tiny)


@radius_drop.register
def _(profile: PowerLaw, live):
    return profile._radius(live.upper) * _power_drop(1 / profile.exponent, _fraction(live))


def _fraction(live):
    """Length of the live interval as a fraction of the depth, 0 where both vanish."""
    return np.divide(live.length, live.upper, out=np.zeros_like(live.upper), where=live.upper > 0)


def _power_drop(q, fraction):
    """1 − (1 − fraction)^q without cancellation."""
    with np.errstate(divide="ignore"):
        return -np.expm1(q * np.log1p(-fraction))


@singledispatch
def pressure_integral(profile, live, r):
    """∫ ds/√(a(s)² − r²) over a(s) > r in the live interval, for one state and many r ≥ 0.

    Infinite where the contact pressure is: at the rim of a flat face, and under a sharp tip as
    long as nothing has yielded there.
    """
    return _pressure_by_quadrature(profile, live, r)


def _pressure_by_quadrature(profile, live, r):
    a, c, r, result, inside = _contact(profile, live, r)
    total, mass = np.zeros_like(r), np.zeros_like(r)
    for zone in profile.zones:
        low, high = max(c, zone.kink), min(a, zone.end)
        reached = r < high
        if low < high:
            part = _zone_pressure(zone, low, high, r[reached])
            total[reached] += part[0]
            mass[reached] += part[1]
    # The increments that the whole interval holds are known: scaling by them takes out the
    # error of a − c, which has few digits in a short interval.
    smooth = live.length - _wall_length(profile, live)
    np.divide(total * smooth, mass, out=total, where=(r < c) & (mass > 0) & np.isfinite(total))
    if profile.wall <= a:
        with np.errstate(divide="ignore"):
            total += _wall_length(profile, live) / np.sqrt((a - r) * (a + r))
    result[inside] = total
    return result


@pressure_integral.register
def _(profile: Cone, live, r):
    a, c, r, result, inside = _contact(profile, live, r)
    # arccosh(a/r) − arccosh(c/r), with the difference of the logarithms' arguments written out.
    low = np.maximum(c, r)
    drop = np.where(r < c, radius_drop(profile, live), a - r)
    root_a, root_low = np.sqrt((a - r) * (a + r)), np.sqrt((low - r) * (low + r))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = (drop + drop * ((a + low) / (root_a + root_low))) / (low + root_low)
    result[inside] = np.pi / 2 * profile.slope * np.log1p(ratio)
    return result


@pressure_integral.register
def _(profile: Paraboloid, live, r):
    a, c, r, result, inside = _contact(profile, live, r)
    root_a, root_c = np.sqrt((a - r) * (a + r)), np.sqrt(np.maximum(c - r, 0) * (c + r))
    with np.errstate(invalid="ignore"):
        yielded = 2 * live.length / (root_a + root_c)
    result[inside] = np.where(r < c, yielded, 2 / profile.radius * root_a)
    return result


@pressure_integral.register
def _(profile: PowerLaw, live, r):
    result = _pressure_by_quadrature(profile, live, np.where(r > 0, r, np.inf))
    if live.length > 0 and np.any(r == 0):
        result[r == 0] = _power_law_axis(profile, live)
    return result


def _power_law_axis(profile, live):
    """∫ ds/a(s) for z = c rⁿ: finite if the axis has yielded, or n > 1."""
    a, order = profile._radius(live.upper), profile.exponent - 1
    if live.lower == 0:
        return profile.exponent / order * live.upper / a if order > 0 else np.inf
    logarithm = -np.log1p(-radius_drop(profile, live) / a)
    mean = -np.expm1(-order * logarithm) / order if order else logarithm
    return profile.exponent * live.upper / a * mean


def _contact(profile, live, r):
    """Radii a and c of one state, the r < a, a result of zeros, and where r < a lies in it."""
    a = profile._radius(live.upper) if live.length > 0 else 0.0
    c = profile._radius(live.lower) if live.lower > 0 else 0.0
    # On the rim of a wall the pressure is infinite, elsewhere it vanishes at r = a.
    inside = (r <= a) & (a > 0) if a == profile.wall else r < a
    return float(a), float(c), r[inside], np.zeros_like(r), inside


def _wall_length(profile, live):
    """Part of the live interval (m) in which the contact radius stays at the wall."""
    if profile.wall == np.inf:
        return 0.0
    foot = profile._reduced(np.asarray(profile.wall))
    return live.length if foot <= live.lower else max(live.upper - foot, 0.0)


def _zone_pressure(zone, low, high, r):
    """∫ dg/√(x² − r²) and ∫ dg over max(low, r) < x < high in one zone, for r < high.

    With β² = |r² − k²| and t = (e^λ ± β² e^(−λ))/2 the first is ∫ rate(t) dλ, and the root is
    (e^λ ∓ β² e^(−λ))/2: smooth however close r comes to the kink k, or to 0.
    """
    k = zone.kink
    sign = np.where(r < k, -1.0, 1.0)
    beta2 = np.abs((r - k) * (r + k))
    t_high, root_high = _root(high, k), _root(high, r)
    t_low, root_low = np.maximum(_root(low, k), np.sqrt(beta2) * (r > k)), _root(np.maximum(low, r), r)
    top, bottom = t_high + root_high, t_low + root_low
    rise = ((t_high - t_low) + (root_high - root_low)) / np.where(bottom > 0, bottom, 1.0)
    width = np.where(bottom > 0, np.log1p(np.maximum(rise, 0.0)), np.inf)
    if zone.order > 0:
        width = np.minimum(width, _NEGLIGIBLE / zone.order)
    total, mass = np.full_like(r, np.inf), np.zeros_like(r)
    finite = np.isfinite(width)
    if finite.any():
        lam, weight, start = gauss_panels(-width[finite], 8 / max(zone.order, 16 / 3))
        count = np.diff(start, append=len(lam))
        e = np.repeat(top[finite], count)[:, None] * np.exp(lam)
        inverse = np.repeat((sign * beta2)[finite], count)[:, None] / e
        increment = weight * zone.rate((e + inverse) / 2)
        total[finite] = np.add.reduceat(increment.sum(axis=1), start)
        mass[finite] = np.add.reduceat((increment * (e - inverse) / 2).sum(axis=1), start)
    return total, mass


def _root(x, r):
    """√(x² − r²) for x ≥ r, without cancellation."""
    return np.sqrt(np.maximum(x - r, 0.0) * (x + r))


def displacement_integral(profile, live, r):
    """∫ h(r, a(s)) ds over the live interval (m), for one state and many r ≥ 0.

    h is the surface displacement of a flat punch of radius a per unit of its indentation: 1 for
    r < a and (2/π) arcsin(a/r) outside.
    """
    if live.length == 0:
        return np.zeros_like(r)
    c = profile._radius(live.lower) if live.lower > 0 else 0.0
    a = profile._radius(live.upper)
    if live.lower == 0:
        # Nothing has yielded: the surface follows the indenter, d − z(r).
        result = live.upper - profile._height(np.minimum(r, a))
        outside = r > a
    else:
        result = np.where(r < c, live.length, np.clip(live.upper - profile._reduced(r), 0, live.length))
        outside = r > c
    outer = _outside_displacement(profile, live, a, c, r[outside])
    result[outside] = np.where(r[outside] < a, result[outside], 0.0) + outer
    return result


def _outside_displacement(profile, live, a, c, r):
    """(2/π) ∫ arcsin(a(s)/r) ds over a(s) < r, for r > c."""
    total, mass = np.zeros_like(r), np.zeros_like(r)
    for zone in profile.zones:
        low, high = max(c, zone.kink), np.minimum(min(a, zone.end), r)
        reached = high > low
        if reached.any():
            part = _zone_displacement(zone, low, high[reached], r[reached])
            total[reached] += part[0]
            mass[reached] += part[1]
    at_wall = _wall_length(profile, live)
    scaled = (r > a) & (mass > 0)
    np.divide(total * (live.length - at_wall), mass, out=total, where=scaled)
    if at_wall > 0:
        total += np.where(r > a, at_wall * np.arcsin(np.minimum(a / r, 1.0)), 0.0)
    return 2 / np.pi * total


def _zone_displacement(zone, low, high, r):
    """∫ arcsin(x/r) dg and ∫ dg over low < x < high ≤ r in one zone.

    With β² = r² − k² and t = β/cosh w the root √(r² − x²) is β tanh w: smooth at x = r, and
    graded towards the kink.
    """
    k = zone.kink
    beta = _root(r, k)
    w_low = np.arcsinh(_root(r, high) / _root(high, k))
    with np.errstate(divide="ignore"):
        w_high = np.arcsinh(_root(r, low) / _root(low, k))
    width = np.minimum(w_high - w_low, _NEGLIGIBLE / (1 + zone.order))
    w, weight, start = gauss_panels(width, 8 / max(zone.order + 1, 16 / 3))
    count = np.diff(start, append=len(w))
    w, beta, radius = (
        w + np.repeat(w_low, count)[:, None],
        *(np.repeat(part, count)[:, None] for part in (beta, r)),
    )
    t, root = beta / np.cosh(w), beta * np.tanh(w)
    increment = weight * zone.rate(t) * t * np.tanh(w)
    angle = np.arctan2(np.sqrt((radius - root) * (radius + root)), root)
    total = np.add.reduceat((increment * angle).sum(axis=1), start)
    return total, np.add.reduceat(increment.sum(axis=1), start)
