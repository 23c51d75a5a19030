"""Check of shapes that users write: g starts at 0 and does not fall, g′ is its slope, all are finite.

Shapes of the library are trusted. `sound_range` finds, once for a profile, the radius up to which its
functions are valid, which ends its known depth. `check_shape` checks them at the radii that a calculation
reaches.
"""

from typing import NamedTuple

import numpy as np

from .. import _check
from .._check import shown
from .slope_check import misfit, words, wrong_contacts

#: Radii (m) between which a shape is looked at: 33 in each decade, no two 8 % apart.
_RADII = np.concatenate([[0.0], np.geomspace(1e-18, 1e12, 1000)])
#: Halvings of the gap between two of these, at which the end of a shape is found to rounding.
_HALVINGS = 50
#: Share of the largest depth by which g may fall, or be off 0 at the tip: the rounding of a formula, as of
#: √(x² + R²) − R next to the tip, is less; and height g (m) of a tip that is more than such a rounding.
_ROUNDING, _TIP = 1e-6, 1e-12
#: Share by which a contact radius may differ from that of g.
_SAME = 1e-3
#: Radii at which each indenter of an ensemble is checked below its contact radius, over so many decades;
#: pairs of radii at which its g′ is compared with g, and their distance over the larger one; indenters that
#: are checked at a time.
_COUNT, _DECADES, _PAIRS, _STEP, _ROWS = 200, 6, 12, 0.01, 512
#: What is wrong, and what to do about it.
_ENDS = "mend its functions, or give known_depth and known_radius, or wall, where the shape ends"
_RADIUS = "mend radius_at(depth), or leave it out"
_FALLS = "g(x) has fallen to {value:g} m at x = {place:g} m, so that the contact would not be compact"
_RISE = "mend reduced_at(x): g is 0 at the tip, and does not fall"
_SLOPE = "mend reduced_slope_at(x): it is the derivative of reduced_at(x), not of the height z"


def is_own(profile):
    """Whether a user wrote the class of a profile."""
    return not type(profile).__module__.startswith(f"{__package__}.")


class SoundRange(NamedTuple):
    """Radius and depth (m) up to which a shape is valid, infinite without an end, and the fault there.

    `levels` are the largest g (m) up to ascending radii, and `falls` the largest height (m) by which g has
    fallen below such a level, up to there; `places` are the radii (m) of these. `slopes` are radii (m) at
    which g′ is not the slope of g, for contacts up to ascending radii; NaN where it is.
    """

    radius: float
    depth: float
    fault: str
    levels: np.ndarray
    falls: np.ndarray
    places: np.ndarray
    slopes: np.ndarray


def sound_range(profile, end, own_radius):
    """The `SoundRange` of one profile that a user wrote, looked at up to the radius `end` (m).

    It ends before the first radius at which g or z is not finite, g′ is not a number, the contact radius is
    not that of g if the shape has its own (`own_radius`), or from which on g never again reaches a depth
    that it had. Refused if it is not valid at the tip.
    """
    x = np.append(_RADII[end > _RADII], end if end < _RADII[-1] else [])
    reduced, slope, fault = _values(profile, x)
    fault[0] |= abs(reduced[0]) > _TIP
    if fault[0]:
        raise _refused(profile, _said(profile, x[0]), _ENDS)
    count = int(np.argmax(fault)) if fault.any() else x.size
    x, reduced, slope, beyond = x[:count], reduced[:count], slope[:count], x[count:]
    levels = np.maximum.accumulate(reduced)
    falls = levels - reduced
    worst = np.maximum.accumulate(falls)
    places = x[np.maximum.accumulate(np.where(falls == worst, np.arange(count), 0))]
    if falls[-1] > 0:
        # The largest value of g that falls for good is the last one that the edge of a contact reaches.
        top = int(np.argmax(reduced))
        radius, depth = float(x[top]), float(reduced[top])
        fault = f"g(x) falls from {depth:g} m at x = {radius:g} m on"
    elif beyond.size:
        radius, bad = _last_sound(profile, x[-1], beyond[0])
        depth, fault = float(_values(profile, np.array([radius]))[0][0]), _said(profile, bad)
    else:
        radius, depth, fault = np.inf, float(reduced[-1]) if end < _RADII[-1] else np.inf, ""
    if own_radius:
        radius, depth, fault = _up_to_wrong_radius(profile, x, reduced, (radius, depth, fault))
    slopes = _wrong_slopes(profile, x, reduced, slope)
    if np.isfinite(slopes[-1]):
        # For a contact up to the next radius, and up to all larger ones, g′ is wrong.
        last = np.flatnonzero(np.isnan(slopes))[-1]
        if x[last] < radius:
            radius, depth = float(x[last]), float(levels[last])
            fault = _said_of_slope(profile, slopes[last + 1])
    return SoundRange(radius, depth, fault, levels, worst, places, slopes)


def _wrong_slopes(profile, x, reduced, slope):
    """The last radius (m) at which g′ is wrong for contacts up to each radius x (m), NaN if it is right.

    From g (m) and g′ at the radii. Refused if g′ is wrong for all contacts.
    """
    before = np.maximum(np.arange(x.size) - 1, 0)
    values = x, reduced, slope
    pairs = misfit([value[before] for value in values], values)
    wrong = wrong_contacts(x, pairs)
    places = x[np.maximum.accumulate(np.where(pairs.off, np.arange(x.size), 0))]
    if np.any(wrong) and np.all(wrong == pairs.enough):
        raise _refused(profile, _said_of_slope(profile, places[np.argmax(wrong)]), _SLOPE)
    return np.where(wrong, places, np.nan)


def _said_of_slope(profile, x):
    """Words for a g′ that is not the slope of g at a radius (m)."""
    x = np.array([(1 - _STEP) * x, x])
    g, slope, _ = functions_at(profile, x)
    return words(x, g, slope)


def _last_sound(profile, low, high):
    """The last radius (m) between two at which a shape is valid, and the first at which it is not."""
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        none = _values(profile, np.array([middle]))[2][0]
        low, high = (low, middle) if none else (middle, high)
    return float(low), float(high)


def _up_to_wrong_radius(profile, x, reduced, known):
    """The radius and depth (m) and fault that are `known`, or those of a contact radius that is wrong."""
    rises = np.diff(reduced) > 1e-6 * reduced[1:]
    # Radii at which g rises on both sides; at a jump the same radius belongs to a range of depths.
    inner = 1 + np.flatnonzero(rises[:-1] & rises[1:] & (x[1:-1] > 0) & (reduced[1:-1] <= known[1]))
    with np.errstate(all="ignore"):
        radius = np.broadcast_to(profile.radius_at(reduced[inner]), inner.shape)
    wrong = ~(np.abs(radius - x[inner]) <= _SAME * x[inner])
    if not wrong.any():
        return known
    first = np.argmax(wrong)
    depth = reduced[inner[first]]
    said = f"the contact radius is {radius[first]:g} m at depth = {depth:g} m, where g is not that depth"
    if not first:
        raise _refused(profile, said, _RADIUS)
    return float(x[inner[first] - 1]), float(reduced[inner[first] - 1]), said


def _values(profile, x):
    """g (m) and g′ at radii (m), and whether g or z is not finite, or g′ not a number, there."""
    try:
        reduced, slope, height = functions_at(profile, x)
    except _check.InvalidArgument:
        raise
    except (ValueError, ArithmeticError):
        if x.size == 1:
            return np.full(1, np.nan), np.full(1, np.nan), np.ones(1, bool)
        # It ends somewhere: an interpolation, say, fails beyond its table.
        each = [_values(profile, x[i : i + 1]) for i in range(x.size)]
        return tuple(np.concatenate(values) for values in zip(*each, strict=True))
    return reduced, slope, ~np.isfinite(reduced) | np.isnan(slope) | ~np.isfinite(height)


def functions_at(profile, x):
    """g (m), g′ and z (m) at radii (m), without warnings: also at radii that no solver reaches."""
    with np.errstate(all="ignore"):
        values = profile.reduced_at(x), profile.reduced_slope_at(x), profile.height_at(x)
    return [np.broadcast_to(value, x.shape).astype(float) for value in values]


def _said(profile, x):
    """Words for what is wrong with a shape at a radius (m)."""
    try:
        reduced, slope, height = (float(value[0]) for value in functions_at(profile, np.array([x])))
    except (ValueError, ArithmeticError) as error:
        return f"it fails at x = {x:g} m ({type(error).__name__}: {error})"
    if x == 0 or not np.isfinite(reduced):
        return f"g(x) is {reduced:g} m at x = {x:g} m"
    return (
        f"g′(x) is {slope:g} at x = {x:g} m" if np.isnan(slope) else f"z(r) is {height:g} m at r = {x:g} m"
    )


def check_shape(profile, depth):
    """Refuses a user's shape that is not valid at the contact radii (m) of depths (m) up to the largest.

    That of one profile is known from `sound_range` already, but for places where g falls and rises again,
    or g′ is not its slope. An indenter of an ensemble is checked from 10⁻⁶ of its contact radius on. Depths
    that are infinite or not positive are left out.
    """
    for some, depths in _in_blocks(profile, depth):
        if profile.shape:
            _check_each(some, depths)
            _check_slopes(some, depths)
        else:
            _check_falls(profile, np.max(depths))
            _check_slope(profile, np.max(depths))


def check_tips(profile):
    """Refuses an ensemble with an indenter whose g is not 0 at the tip; that of one profile is known."""
    if profile.shape and is_own(profile):
        every = profile.flat_entries(slice(None), profile.shape)
        x = np.zeros(every.shape)
        reduced, *_ = functions_at(every, x)
        bad = ~(np.abs(reduced) <= _TIP)
        _refuse(every, x, reduced, bad, "g(x) is {value:g} m at x = {place:g} m, the tip", _RISE)


def check_slopes(profile, depth):
    """Refuses an ensemble with an indenter whose g′ is not the slope of g up to its depth (m).

    That of one profile is known from `sound_range`.
    """
    if profile.shape:
        for some, depths in _in_blocks(profile, depth):
            _check_slopes(some, depths)


def _in_blocks(profile, depth):
    """Indenters of a class that a user wrote, and their depths (m), some hundreds at a time.

    One profile comes at once with all depths. Those that are infinite or not positive are left out.
    """
    if not is_own(profile):
        return
    depth = np.asarray(depth, dtype=float)
    shape = np.broadcast_shapes(depth.shape, profile.shape)
    depth = np.minimum(np.broadcast_to(depth, shape), profile.known_depth).ravel()
    rows = np.flatnonzero((depth > 0) & (depth <= _check.LONGEST))
    size = _ROWS if profile.shape else max(rows.size, 1)
    for start in range(0, rows.size, size):
        some = rows[start : start + size]
        yield profile.flat_entries(some, shape), depth[some]


def _check_falls(profile, depth):
    """Refuses one profile whose g falls, and rises again, by more than rounding above a depth (m)."""
    sound = profile.sound
    number = np.searchsorted(sound.levels, depth, side="right") - 1
    if sound.falls[number] > _ROUNDING * depth:
        x = sound.places[number]
        raise _refused(profile, _FALLS.format(place=x, value=profile.reduced_at(np.array([x]))[0]), _RISE)


def _check_slope(profile, depth):
    """Refuses one profile whose g′ is not the slope of g over the contact at a depth (m)."""
    sound = profile.sound
    place = sound.slopes[np.searchsorted(sound.levels, depth, side="right") - 1]
    if np.isfinite(place):
        raise _refused(profile, _said_of_slope(profile, place), _SLOPE)


def _check_slopes(profile, depth):
    """`check_slopes` with one depth (m) for each indenter."""
    radius = np.broadcast_to(profile.radius_at(depth), depth.shape)
    face = np.broadcast_to(profile.face_radius, radius.shape)
    x = face + (radius - face) * ((np.arange(_PAIRS)[:, None] + 0.5) / _PAIRS)
    x = np.stack([(1 - _STEP) * x, x])
    g, slope, _ = functions_at(profile, x)
    pairs = misfit((x[0], g[0], slope[0]), (x[1], g[1], slope[1]))
    wrong = pairs.wrong(1.0)[-1]
    if np.any(wrong):
        i = int(np.argmax(wrong))
        one, place = profile.entries((i,)), np.flatnonzero(pairs.off[:, i])[-1]
        raise _refused(one, _said_of_slope(one, x[1, place, i]), _SLOPE)


def _check_each(profile, depth):
    """`check_shape` of an ensemble, with one depth (m) for each indenter."""
    radius = np.broadcast_to(profile.radius_at(depth), depth.shape)
    wrong = "the contact radius is {value:g} m at depth = {place:g} m"
    _refuse(profile, depth, radius, ~(radius >= 0), wrong, _RADIUS)
    share = np.append(0.0, np.geomspace(10.0**-_DECADES, 1 - _SAME, _COUNT))
    # The last one is just outside, where g is larger than the depth, but at a wall.
    outside = np.where(radius < profile.wall, (1 + _SAME) * radius, radius)
    x = np.vstack([share[:, None] * radius, radius, outside])
    reduced, slope, height = functions_at(profile, np.minimum(x, profile.known_radius))
    _refuse(profile, x, reduced, ~np.isfinite(reduced), "g(x) is {value:g} m at x = {place:g} m", _ENDS)
    _refuse(profile, x, height, ~np.isfinite(height), "z(r) is {value:g} m at r = {place:g} m", _ENDS)
    bad = np.isnan(slope) | (slope == -np.inf)
    _refuse(profile, x, slope, bad, "g′(x) is {value:g} at x = {place:g} m", _ENDS)
    tip = np.abs(reduced[:1]) > _ROUNDING * depth
    _refuse(profile, x[:1], reduced[:1], tip, "g(x) is {value:g} m at x = {place:g} m, the tip", _RISE)
    falls = np.maximum.accumulate(reduced) - reduced > _ROUNDING * depth
    _refuse(profile, x, reduced, falls, _FALLS, _RISE)
    off = (radius > profile.face_radius) & (reduced[-3] > depth)
    off |= (radius < profile.wall) & ~(reduced[-1] >= depth)
    _refuse(profile, depth, radius, off, f"{wrong}, where g is not that depth", _RADIUS)


def _refuse(profile, places, values, bad, what, advice):
    """Refuses a profile at the first of the places (m) that is `bad`, with its value in words."""
    if np.any(bad):
        first = np.unravel_index(np.argmax(bad), bad.shape)
        one = profile.entries(first[-1:]) if profile.shape else profile
        raise _refused(one, what.format(place=places[first], value=values[first]), advice)


def _refused(profile, what, advice):
    """The error of a shape that is not valid: what is wrong with it, and what to do."""
    text = f"profile {shown(profile)}: {what}; {advice}"
    return _check.InvalidArgument(text, "profile", profile, what, "", advice)
