"""Checks of users' shapes: g starts at 0 and does not fall, g′ is its slope, and all are finite.

Shapes of the library are trusted. `sound_range` finds the end of a profile's functions once; this is its
known depth. `check_shape` checks one profile, or each profile of an ensemble, at the radii of a contact.

Between two neighbouring radii, the slope of g lies between the values of g′ at both, unless g′ turns in
between. At a kink, at a jump of g and in the first cells of a table it may lie outside. Therefore g′ is
wrong only if it is too large, or too small, by more than 30 % at three quarters of the radii of a contact.
A g′ with a missing factor of 2 or π/2, or z′ instead of g′, is wrong at all radii.
"""

from typing import NamedTuple

import numpy as np

from ...base import check
from ..numerics.roots import change_between
from ..profiles.profile import Profile
from .rows import largest_in_blocks, refuse_first, refused, values_of

#: Functions of a shape.
_FUNCTIONS = "reduced_at", "reduced_slope_at", "height_at"
#: Remedies for the faults of a shape.
_ENDS = "correct its functions, or give known_depth and known_radius, or wall, at the end of the shape"
_RADIUS = "correct radius_at(depth), or leave it out"
_RISE = "correct reduced_at(x): g must be 0 at the tip, and must not fall"
_SLOPE = "correct reduced_slope_at(x): it is the derivative of reduced_at(x), not of the height z"
#: Radii (m) at which one profile is evaluated: 33 per decade, neighbours less than 8 % apart.
_RADII = np.append(0.0, np.geomspace(1e-27, 1e12, 1300))
#: In a contact narrower than a cell of a table, g′ may differ everywhere. It is wrong only if it also
#: differs up to this multiple of the contact radius, within the known radius of the shape.
_WIDER = 5.0
#: Number of checked radii in a contact. Radii for an ensemble, over the contact radius: as many inside, as
#: near to each other as the radii of one profile, and others outside.
_COUNT = 200
_SHARES = np.append(np.geomspace(1e-6, 1.0, _COUNT), np.geomspace(1.07, _WIDER, 22))
#: Depths at which a contact radius is checked, over the largest depth; only the first one if the radius is
#: found from g. Share by which the radius may differ from the radius by g.
_DEPTHS, _SAME = 10.0 ** -np.arange(0.0, 6.0, 0.5), 1e-3
#: Share of the depth by which g may fall; the rounding of a formula such as √(x² + R²) − R next to the tip
#: is smaller. Height g (m) that is not more than such a rounding.
_ROUNDING, _LOWEST = 1e-6, 1e-12
#: Factor by which g′ may differ from the slope of g, and share of the radii at which it may differ by more.
#: Tables of powers of x up to the fourth may interpolate g and g′ in different ways. They differ by more at
#: half of the radii of a contact of three cells, and at a quarter of the radii for ten cells.
_FACTOR, _SHARE = 1.3, 0.75
#: Fewest pairs of radii to compare, and relative distance of radii in messages.
_FEWEST, _STEP = 4, 0.01


class ValidRange(NamedTuple):
    """Largest radius and depth (m) at which one profile is valid, infinite without an end, and the fault.

    `values` are the `_values` at ascending radii x (m) up to this radius. `right` has the numbers of these
    radii in contacts that were found to be right.
    """

    radius: float
    depth: float
    fault: str
    x: np.ndarray
    values: np.ndarray
    right: set


def sound_range(profile, end):
    """Return the `ValidRange` of a user's profile, evaluated up to the radius `end` (m).

    It ends before the first radius at which a function fails, g or z is not finite, or g′ is NaN. It also
    ends at the largest g, if g is smaller at all larger radii. An error is raised if the profile is invalid
    at the tip, or if g′ is wrong in all contacts.
    """
    check_tips(profile)
    x = np.append(_RADII[end > _RADII], end if end < _RADII[-1] else [])
    values = _values(profile, x)
    count = int(np.argmax(np.append(_bad(values), True)))
    reduced = values[0, :count]
    top = int(np.argmax(reduced))
    # At a wall the contact continues to any depth.
    ends_above = end < min(profile.wall, _RADII[-1])
    radius, depth, fault = np.inf, float(reduced[-1]) if ends_above else np.inf, ""
    if reduced[-1] < reduced[top] or top < count - 1 == _RADII.size - 1:
        # The edge of a contact does not pass the largest value of g.
        radius, depth = float(x[top]), float(reduced[top])
        fault = f"g(x) does not rise beyond {depth:g} m at x = {radius:g} m"
        if top == 0:
            raise refused(profile, fault, _RISE)
    elif count < x.size:
        ends = x[count - 1 : count], x[count : count + 1]
        last, bad = change_between(lambda x: _bad(_values(profile, x)), *ends, at_low=False)
        radius, depth = float(last[0]), float(_values(profile, last)[0, 0])
        fault = _said(bad[0], *_values(profile, bad)[:, 0])
    x, values = x[:count], values[:, :count]
    off, wrong, judged = _wrong_slopes(x, *values[:2])
    if np.any(wrong) and np.all(wrong == judged):
        raise refused(profile, _said_of_slope(profile, x[1:][off][0]), _SLOPE)
    return ValidRange(radius, depth, fault, x, values, set())


def check_tips(profile):
    """Raise an error if a shape's functions fail for arrays of radii, or are invalid at the tip.

    For one profile, `sound_range` calls this check.
    """
    x = np.zeros((2, *profile.shape))
    values = [values_of(profile, name, x) for name in _FUNCTIONS]
    if _gives_radius(profile):
        values_of(profile, "radius_at", x)
    _refuse_bad(profile, x, np.array(values))
    tip = np.abs(values[0]) > _LOWEST
    refuse_first(profile, tip, lambda i: f"g(x) is {values[0][i]:g} m at x = 0 m, the tip", _RISE)


def check_shape(profile, depth):
    """Raise an error if a user's shape is invalid in the contact with the largest of depths (m).

    For an ensemble this is the contact of each indenter. Depths that are not finite are left out.
    """
    for rows, depths in largest_in_blocks(profile, depth, profile.shape):
        if profile.shape:
            _check_ensemble(profile.flat_entries(rows, profile.shape), depths)
        else:
            _check_one(profile, depths[0])


def _check_one(profile, depth):
    """Check one profile, as in `check_shape`, at the radii of `sound_range`."""
    *_, x, values, right = profile.sound
    # The edge of the contact passes the radii up to the first radius with a larger g.
    count = max(int(np.argmax(np.append(values[0] > depth, True))), 1)
    if count not in right:
        if _gives_radius(profile):
            _contact_radius(profile, depth)
        start = max(count - _COUNT, 0)
        part = slice(start, int(np.searchsorted(x, _WIDER * x[count - 1])) + 1)
        _check(profile, x[part], values[:, part], count - start, np.max(values[0, : count + 1]))
        right.add(count)


def _check_ensemble(profile, depth):
    """Check an ensemble, as in `check_shape`, with one depth (m) per indenter."""
    radius = _contact_radius(profile, depth)[:, None]
    profile = profile.entries((slice(None), None), depth.shape)
    x = np.minimum(_SHARES * radius, np.minimum(profile.wall, profile.known_radius))
    values = _values(profile, x)
    _refuse_bad(profile, x[:, :_COUNT], values[..., :_COUNT])
    _check(profile, x, values, _COUNT, depth[:, None])


def _gives_radius(profile):
    """Whether a shape defines its contact radius, instead of the search from g."""
    return type(profile).radius_at is not Profile.radius_at


def _contact_radius(profile, depth):
    """Return contact radii (m) at depths (m); raise an error if g is not this depth there."""
    depth = np.multiply.outer(_DEPTHS if _gives_radius(profile) else _DEPTHS[:1], depth)
    radius = np.broadcast_to(profile.radius_at(depth), depth.shape)
    end = np.minimum(profile.wall, profile.known_radius)
    sides = np.array([(1 - _SAME) * radius, np.minimum((1 + _SAME) * radius, end)])
    inside, outside = _values(profile, sides)[0]
    right = (inside <= depth) & ((depth <= outside) & (outside < np.inf) | (radius >= end))
    refuse_first(
        profile, ~(right & (radius < np.inf)) & (depth > _LOWEST),
        lambda i: f"the contact radius is {radius[i]:g} m at depth = {depth[i]:g} m, but g(x) is "
        f"{inside[i]:g} m just inside and {outside[i]:g} m outside",
        _RADIUS if _gives_radius(profile) else _ENDS,
    )  # fmt: skip
    return radius[0]


def _check(profile, x, values, count, depth):
    """Raise an error for faults in contacts with depths (m), from `values` at ascending radii x (m).

    The first `count` of these radii are in the contact.
    """
    reduced, slope, _ = values
    falls = np.maximum.accumulate(reduced, axis=-1) - reduced > _ROUNDING * depth
    refuse_first(
        profile, falls[..., :count],
        lambda i: f"g(x) has fallen to {reduced[i]:g} m at x = {x[i]:g} m, so that the contact would not "
        "be compact",
        _RISE,
    )  # fmt: skip
    off, wrong, _ = _wrong_slopes(x, reduced, slope)
    off = off[..., : count - 1] & wrong[..., count - 2 : count - 1] & wrong[..., -1:]
    refuse_first(
        profile, off, lambda i: _said_of_slope(profile.entries(i, off.shape), x[..., 1:][i]), _SLOPE
    )


def _wrong_slopes(x, g, slope):
    """Return masks of the pairs of neighbouring radii x (m), which ascend: `off`, `wrong` and `judged`.

    `off` marks a g′ that is not the slope of g (m). `wrong` marks contacts up to this pair with a wrong g′,
    and `judged` marks contacts with enough pairs for this decision.
    """
    step, before, after = np.diff(x), slope[..., :-1], slope[..., 1:]
    # At the tip g′ may be infinite, and outside the contact there may be no values.
    with np.errstate(invalid="ignore"):
        rise = np.diff(g)
        low, high = step * np.minimum(before, after), step * np.maximum(before, after)
    judged = (g[..., 1:] > _LOWEST) & (np.maximum(rise, low) > _ROUNDING * g[..., 1:])
    large, small = judged & (low > _FACTOR * rise), judged & (rise > _FACTOR * high)
    # Each pair of radii represents a width of the contact.
    widths = [np.cumsum(step * pairs, axis=-1) for pairs in (judged, large, small)]
    enough = np.cumsum(judged, axis=-1) >= _FEWEST
    return large | small, enough & (np.maximum(*widths[1:]) > _SHARE * widths[0]), enough


def _values(profile, x):
    """Return g (m), g′ and z (m) at radii x (m); NaN if they fail, like an interpolation beyond its table.

    There are no warnings, because solvers may not reach these radii.
    """
    try:
        with np.errstate(all="ignore"):
            return np.array([np.broadcast_to(getattr(profile, name)(x), x.shape) for name in _FUNCTIONS])
    except check.InvalidArgument:
        raise
    except (ValueError, ArithmeticError):
        if x.shape[-1] == 1:
            return np.full((3, *x.shape), np.nan)
        return np.concatenate([_values(profile, x[..., i, None]) for i in range(x.shape[-1])], axis=-1)


def _bad(values):
    """Whether g or z is not finite, or g′ is NaN."""
    return ~np.isfinite(values[::2]).all(axis=0) | np.isnan(values[1])


def _refuse_bad(profile, x, values):
    """Raise an error at the first of the radii (m) at which the values of a shape are `_bad`."""
    refuse_first(profile, _bad(values), lambda i: _said(x[i], *values[(..., *i)]), _ENDS)


def _said(x, reduced, slope, height):
    """Return words for values that are `_bad` at a radius x (m)."""
    if not np.isfinite(reduced):
        return f"g(x) is {reduced:g} m at x = {x:g} m"
    if np.isnan(slope):
        return f"g′(x) is nan at x = {x:g} m"
    return f"z(r) is {height:g} m at r = {x:g} m"


def _said_of_slope(profile, x):
    """Return words for a g′ that is not the slope of g at a radius (m), over a step of 1 %."""
    x = np.array([(1 - _STEP) * x, x])
    reduced, slope, _ = _values(profile, x)
    own = (reduced[1] - reduced[0]) / (x[1] - x[0])
    return f"g′(x) is {slope[1]:g} at x = {x[1]:g} m, but g(x) rises with the slope {own:g} there"
