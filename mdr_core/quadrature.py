"""Integrals over the live interval by quadrature, for shapes without closed forms.

Each sum runs over the zones of the reduced profile, in panels on which it is smooth, and is
scaled so that its increments make up the length of the interval (see `superpose`).
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .panels import NODES, PANEL, TAIL, WEIGHTS
from .yielding import LiveInterval

#: Contributions below e^(−40) of the largest are left out of a graded quadrature.
NEGLIGIBLE = 40.0


def wall_length(profile, live):
    """Part of the live interval (m) in which the contact radius stays at the wall, elementwise."""
    if np.all(profile.wall == np.inf):
        return np.zeros_like(live.length)
    foot = profile._reduced(np.asarray(profile.wall))
    beyond = np.maximum(live.upper - foot, 0.0)
    return np.where(foot <= live.lower, live.length, np.minimum(beyond, live.length))


def by_quadrature(profile, live, integral):
    """One of the three integrals for a shape without closed forms, elementwise.

    Raises
    ------
    ValueError
        For a pure power: it has no scale to set the panels by, and closed forms.
    """
    if profile.shape:
        unit, radius, depth = profile.unit
        return by_quadrature(unit, scaled(live, depth), integral) * (radius * depth**integral.units)
    ends = [np.ravel(part) for part in (live.lower, live.upper, live.length, wall_length(profile, live))]
    result = np.zeros_like(ends[0])
    for rows in profile.batches(ends[1]):
        lower, upper, length, at_wall = (part[rows] for part in ends)
        zones = profile.zones_between(lower.min(initial=np.inf), upper.max(initial=0.0))
        if any(zone.scale == np.inf for zone in zones):
            raise ValueError(f"{profile!r} has no scale for panels; register its closed form in superpose")
        total, spent = _quadrature(profile, zones, lower, upper, at_wall, integral)
        short = np.flatnonzero(~(spent > 0))
        spent[short] = length[short]
        if short.size:
            # An interval too short for its ends to differ is one flat punch.
            total[short] = integral.short(profile._radius(upper[short]), length[short])
        scale = np.divide(length, spent, out=np.ones_like(spent), where=spent > 0)
        result[rows] = total * scale**integral.degree
    return result.reshape(np.shape(live.length))


def scaled(live, unit):
    """The live interval in another unit of depth."""
    return LiveInterval(*np.broadcast_arrays(live.lower / unit, live.upper / unit, live.length / unit))


class Integral(NamedTuple):
    """What is summed over the panels of a state, from the depth d downward."""

    #: What the wall adds, from its radius and length.
    wall: Callable
    #: What a node adds, from the zone, t, dt, the depth increment and the depth above it.
    node: Callable
    #: The whole of an interval too short to divide, from its radius and length.
    short: Callable
    #: Power of the interval's length to which the sum is proportional.
    degree: int
    #: Power of the unit of depth in it, besides one length.
    units: int
    #: Whether the depth above each node is needed.
    cumulative: bool = False


AREA = Integral(
    wall=lambda b, length: b * length,
    node=lambda zone, t, dt, ds, above: zone.radius(t) * ds,
    short=lambda a, length: a * length,
    degree=1,
    units=1,
)
VOLUME = Integral(
    wall=lambda b, length: b * length**2 / 2,
    node=lambda zone, t, dt, ds, above: zone.radius(t) * ds * above,
    short=lambda a, length: a * length**2 / 2,
    degree=2,
    units=2,
    cumulative=True,
)
DROP = Integral(
    wall=lambda b, length: np.zeros_like(length),
    node=lambda zone, t, dt, ds, above: zone.radius_rate(t) * dt,
    short=lambda a, length: np.zeros_like(length),
    degree=1,
    units=0,
)


def _quadrature(profile, zones, lower, upper, at_wall, integral):
    """Sum of one integral over panels, and the depth that they hold.

    In u = arsinh(t/scale) every zone is smooth to a distance of about π/2 from the real axis.
    Sums run over the nodes of one state alone: the result does not depend on its neighbours.
    """
    spent = at_wall.copy()
    total = integral.wall(profile.wall, at_wall) if at_wall.any() else np.zeros_like(at_wall)
    for zone in reversed(zones):
        t_high, t_low = zone.coordinate(upper), zone.coordinate(lower)
        whole = (t_low == 0) & (t_high == zone.end)
        if whole.any():
            area, own, held = _whole_zone(zone, integral)
            total[whole] += own + (spent[whole] * area if integral.cumulative else 0.0)
            spent[whole] += held
            t_high = np.where(whole, t_low, t_high)
        if np.any(t_high > t_low):
            _add_zone(zone, t_high, t_low, total, spent, integral)
    return total, spent


@lru_cache(maxsize=1024)
def _whole_zone(zone, integral):
    """∫ a ds, one integral and the depth of a zone that lies inside the contact, as for all such states."""
    ends = np.array([zone.end]), np.zeros(1)
    area, own, held = np.zeros((3, 1))
    _add_zone(zone, *ends, area, held, AREA)
    if integral is AREA:
        return area, area, held
    _add_zone(zone, *ends, own, np.zeros(1), integral)
    return area, own, held


def _add_zone(zone, t_high, t_low, total, spent, integral):
    """Adds what one zone gives to the totals, and the depth that it holds, in place."""
    high, low = np.arcsinh(t_high / zone.scale), np.arcsinh(t_low / zone.scale)
    width = np.minimum(high - low, NEGLIGIBLE + np.log(zone.stretch(t_high)))
    count = np.ceil(width / PANEL).astype(int)
    step = width / np.maximum(count, 1)
    for panel in range(count.max(initial=0)):
        rows = np.flatnonzero(count > panel)
        u = high[rows, None] - step[rows, None] * (panel + NODES)
        t = zone.scale * np.sinh(u)
        dt = step[rows, None] * (zone.scale * np.cosh(u))
        ds = zone.rate(t) * dt
        above = None
        if integral.cumulative:
            above = spent[rows, None] + np.einsum("ij,kj->ik", ds, WEIGHTS - TAIL)
        total[rows] += np.einsum("ij,j->i", integral.node(zone, t, dt, ds, above), WEIGHTS)
        spent[rows] += np.einsum("ij,j->i", ds, WEIGHTS)
