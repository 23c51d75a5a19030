"""Integrals over the live interval that depend on the radius r, for one state and many radii.

    pressure_integral      ∫ ds/√(a(s)² − r²)     contact pressure, Popov (2015), Eq. (10)
    displacement_integral  ∫ h(r, a(s)) ds        surface displacement, residual imprint

Each increment of depth is a flat punch of radius a(s); see `superpose`.
"""

from functools import singledispatch

import numpy as np

from .panels import PANEL, gauss_panels
from .profiles import Cone, Paraboloid, PowerLaw
from .quadrature import NEGLIGIBLE, wall_length
from .superpose import depth_ratio, radius_drop
from .zones import root


@singledispatch
def pressure_integral(profile, live, r):
    """∫ ds/√(a(s)² − r²) over a(s) > r in the live interval, for one state and many r ≥ 0.

    Infinite where the contact pressure is: at the rim of a flat face, and under a sharp tip as
    long as nothing has yielded there.
    """
    return _pressure_by_quadrature(profile, live, r)


@pressure_integral.register
def _(profile: Cone, live, r):
    a, c, r, result, inside = _contact(profile, live, r)
    root_a = root(a, r)
    if c == 0:
        # Nothing has yielded: arccosh(a/r).
        logarithm = _log_beyond((a - r) + root_a, r)
    else:
        # arccosh(a/r) − arccosh(c/r), with the difference of the logarithms' arguments
        # written out.
        low = np.maximum(c, r)
        drop = np.where(r < c, radius_drop(profile, live), a - r)
        root_low = root(low, r)
        logarithm = _log_beyond(drop + drop * ((a + low) / (root_a + root_low)), low + root_low)
    result[inside] = np.pi / 2 * profile.slope * logarithm
    return result


@pressure_integral.register
def _(profile: Paraboloid, live, r):
    a, c, r, result, inside = _contact(profile, live, r)
    root_a = root(a, r)
    integral = 2 / profile.radius * root_a
    if c > 0:
        root_c = root(c, r)
        with np.errstate(invalid="ignore"):
            yielded = 2 * live.length / (root_a + root_c)
        integral = np.where(r < c, yielded, integral)
    result[inside] = integral
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
    logarithm = -depth_ratio(live) / profile.exponent
    mean = -np.expm1(-order * logarithm) / order if order else logarithm
    return profile.exponent * live.upper / a * mean


def _contact(profile, live, r):
    """Radii a and c of one state, the r < a, a result of zeros, and where r < a lies in it."""
    a = profile._radius(live.upper) if live.length > 0 else 0.0
    c = profile._radius(live.lower) if live.lower > 0 else 0.0
    # On the rim of a wall the pressure is infinite, elsewhere it vanishes at r = a.
    inside = (r <= a) & (a > 0) if a == profile.wall else r < a
    return float(a), float(c), r[inside], np.zeros_like(r), inside


def _pressure_by_quadrature(profile, live, r):
    a, _, r, result, inside = _contact(profile, live, r)
    at_wall = wall_length(profile, live)
    total, mass = np.zeros_like(r), np.zeros_like(r)
    for zone in profile.zones_between(live.lower, live.upper):
        t_low, t_high = (float(zone.coordinate(end)) for end in (live.lower, live.upper))
        reached = r < zone.radius(t_high)
        if t_low < t_high and reached.any():
            part = _zone_pressure(zone, t_low, t_high, r[reached])
            total[reached] += part[0]
            mass[reached] += part[1]
    # The increments that the whole interval holds are known: scaling by them takes out the
    # error of a − c, which has few digits in a short interval. Under a flat face c counts as its
    # radius.
    scaled = (r < profile._radius(live.lower)) & np.isfinite(total)
    smooth = live.length - at_wall
    np.divide(total * smooth, mass, out=total, where=scaled & (mass > 0))
    # An interval too short for its ends to differ is one flat punch.
    short = scaled & (mass == 0)
    total[short] = smooth / root(a, r[short])
    if at_wall > 0:
        with np.errstate(divide="ignore"):
            total += at_wall / root(a, r)
    result[inside] = total
    return result


def _zone_pressure(zone, t_low, t_high, r):
    """∫ dg/√(x² − r²) and ∫ dg over the part of one zone that lies beyond x = r.

    In the zone's coordinate x² − r² is t² ∓ β², with β the coordinate of r, or √(k² − r²) below
    the kink k (over an equator's stretch squared). With t = (e^λ ± β² e^(−λ))/2 the first
    integral is ∫ rate(t) dλ: smooth however close r comes to the kink, or to 0.
    """
    below = r < zone.kink
    beta = np.where(below, root(zone.kink, r), zone.coordinate_at(r))
    t_low = np.where(below, t_low, np.maximum(t_low, beta))
    root_high, root_low = (np.where(below, np.hypot(t, beta), root(t, beta)) for t in (t_high, t_low))
    bottom = t_low + root_low
    above = (t_high - t_low) + (root_high - root_low)
    width = _log_beyond(np.maximum(above, 0.0), bottom)
    if zone.order > 0:
        # t falls at least as fast as 2 e^λ below its largest.
        beyond = np.log(zone.stretch(t_high))
        width = np.minimum(width, NEGLIGIBLE / zone.order + np.log(2) + beyond)
    total, mass = np.full_like(r, np.inf), np.zeros_like(r)
    finite = np.isfinite(width)
    if finite.any():
        lam, weight, start = gauss_panels(-width[finite], _longest(zone.order))
        repeat = _repeater(start, len(lam))
        e = repeat((t_high + root_high)[finite]) * np.exp(lam)
        inverse = repeat(np.where(below, -beta, beta)[finite]) * (repeat(beta[finite]) / e)
        t = (e + inverse) / 2
        increment = weight * zone.rate(t)
        mass[finite] = np.add.reduceat((increment * (e - inverse) / 2).sum(axis=1), start)
        if zone.equator < np.inf:
            increment *= zone.stretch(t) * repeat(zone.stretch(beta[finite]))
        total[finite] = np.add.reduceat(increment.sum(axis=1), start)
    return total, mass


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
        ring = np.clip(live.upper - profile._reduced(np.minimum(r, a)), 0, live.length)
        result = np.where(r < c, live.length, ring)
        outside = r > c
    outer = _outside_displacement(profile, live, a, r[outside])
    result[outside] = np.where(r[outside] < a, result[outside], 0.0) + outer
    return result


def _outside_displacement(profile, live, a, r):
    """(2/π) ∫ arcsin(a(s)/r) ds over a(s) < r, for r > c."""
    total, mass = np.zeros_like(r), np.zeros_like(r)
    at_wall = wall_length(profile, live)
    for zone in profile.zones_between(live.lower, live.upper):
        t_low, t_high = (float(zone.coordinate(end)) for end in (live.lower, live.upper))
        reached = r > zone.radius(t_low)
        if t_low < t_high and reached.any():
            part = _zone_displacement(zone, t_low, t_high, r[reached])
            total[reached] += part[0]
            mass[reached] += part[1]
    scaled = (r > a) & (mass > 0)
    np.divide(total * (live.length - at_wall), mass, out=total, where=scaled)
    # An interval too short for its ends to differ is one flat punch.
    short = (r > a) & (mass == 0)
    total[short] = (live.length - at_wall) * np.arcsin(a / r[short])
    if at_wall > 0:
        total += np.where(r > a, at_wall * np.arcsin(np.minimum(a / r, 1.0)), 0.0)
    return 2 / np.pi * total


def _zone_displacement(zone, t_low, t_high, r):
    """∫ arcsin(x/r) dg and ∫ dg over the part of one zone that lies before x = r.

    With β the coordinate of r and t = β/cosh w, √(r² − x²) is smooth at x = r, and the nodes are
    graded towards the kink. Written from the upper end t_h downward, t = t_h/q with
    q = cosh ω + T sinh ω and T = √(1 − t_h²/β²), it also holds for r beyond an equator (T = 1).
    """
    beyond = r >= zone.equator
    beta = np.where(beyond, np.inf, zone.coordinate_at(np.where(beyond, zone.kink, r)))
    t_high = np.minimum(t_high, beta)
    x_high = np.where(t_high < beta, zone.radius(t_high), r)
    T = np.where(beyond, 1.0, root(beta, t_high) / np.where(beyond, 1.0, beta))
    with np.errstate(divide="ignore"):
        top = t_high / t_low if t_low > 0 else np.full_like(r, np.inf)
    width = np.log((top + np.sqrt((top - 1) * (top + 1) + T * T)) / (1 + T))
    decay = 1 + zone.order
    cut = NEGLIGIBLE / decay + np.log(zone.stretch(t_high))
    width = np.minimum(np.maximum(width, 0.0), cut)
    omega, weight, start = gauss_panels(width, _longest(decay))
    repeat = _repeater(start, len(omega))
    T, t_high, r, x_high = (repeat(part) for part in (T, t_high, r, x_high))
    tanh = np.tanh(omega)
    rise = 2 * np.sinh(omega / 2) ** 2 + T * np.sinh(omega)
    t = t_high / (1 + rise)
    x = zone.radius(t)
    # In units of r, whose square may underflow.
    square = (t / r / (zone.stretch(t) * zone.stretch(t_high))) ** 2 * rise * (2 + rise)
    angle = np.arctan2(x / r, np.sqrt(np.maximum(1 - x_high / r, 0.0) * (1 + x_high / r) + square))
    with np.errstate(divide="ignore", invalid="ignore"):
        # Radii that underflow count for nothing.
        increment = weight * np.where(t > 0, zone.rate(t) * t, 0.0) * ((T + tanh) / (1 + T * tanh))
    total = np.add.reduceat((increment * angle).sum(axis=1), start)
    return total, np.add.reduceat(increment.sum(axis=1), start)


def _log_beyond(above, below):
    """ln(1 + above/below), also where the quotient leaves double precision; infinite over 0."""
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        ratio = above / below
        return np.where(ratio < np.inf, np.log1p(ratio), np.log(above) - np.log(below))


def _longest(order):
    """Longest panel for a function that grows as e^(order·λ)."""
    return min(PANEL, 8 / max(order, 1.0))


def _repeater(start, rows):
    """Repeats a value per interval as a column, one row for each of its panels."""
    count = np.diff(start, append=rows)
    return lambda values: np.repeat(values, count)[:, None]
