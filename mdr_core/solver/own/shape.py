"""Check of shapes that users write: g starts at 0 and does not fall, g′ is its slope, all are finite.

Shapes of the library are trusted. `sound_range` finds, once for a profile, the radius up to which its
functions are valid, which ends its known depth. `check_shape` checks them at the radii that a calculation
reaches.

Between two radii that are near each other, the slope of g lies between the values of g′ at both, unless g′
turns in between. At a kink, at a jump of g and in the first cells of a table it may lie outside. So g′ is
wrong only if it is too large, or too small, by more than 30 % at three quarters of the radii of a contact.
A g′ that lacks a factor of 2 or π/2, or is z′, is wrong at all radii.
"""

from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from ...base import check
from ...base.check import shown
from ..numerics.roots import change_between

#: Radii (m) between which a shape is looked at: 33 in each decade, no two 8 % apart.
_RADII = np.concatenate([[0.0], np.geomspace(1e-18, 1e12, 1000)])
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
_ENDS = "correct its functions, or give known_depth and known_radius, or wall, where the shape ends"
_RADIUS = "correct radius_at(depth), or leave it out"
_FALLS = "g(x) has fallen to {value:g} m at x = {place:g} m, so that the contact would not be compact"
_RISE = "correct reduced_at(x): g is 0 at the tip, and does not fall"
_SLOPE = "correct reduced_slope_at(x): it is the derivative of reduced_at(x), not of the height z"
#: Factor by which g′ may differ from the slope of g, and share of the radii at which it may differ by more.
#: Tables of powers of x up to the fourth, whose g is interpolated in another way than g′, differ by more at
#: half of the radii of a contact that is three cells wide, at a quarter of those of ten cells.
_FACTOR, _SHARE = 1.3, 0.75
#: Fewest pairs that are judged, and the heights g (m), and shares of g, below which they are rounding.
_FEWEST, _LOWEST, _RISE_OF_ROUNDING = 4, 1e-12, 1e-6
#: Over a contact that is less than a cell of a table wide, g′ may differ everywhere. It is wrong only if it
#: is so up to this multiple of the contact radius, too, as far as the shape is known.
_WIDER = 5.0


class _Looked(NamedTuple):
    """g (m) and g′ of a shape at ascending radii x (m), from the tip outward."""

    x: np.ndarray
    reduced: np.ndarray
    slope: np.ndarray


class _End(NamedTuple):
    """Radius and depth (m) up to which a shape is valid, infinite without an end, and the fault there."""

    radius: float
    depth: float
    fault: str


@dataclass(frozen=True)
class SoundRange:
    """Up to where a shape is valid, and what is wrong with contacts that end before."""

    end: _End
    looked: _Looked

    @cached_property
    def levels(self):
        """The largest g (m) up to each of the radii."""
        return np.maximum.accumulate(self.looked.reduced)

    @cached_property
    def lowest(self):
        """Numbers of the radii at which, up to each of the radii, g has fallen most below its level."""
        falls = self.levels - self.looked.reduced
        most = np.maximum.accumulate(falls)
        return np.maximum.accumulate(np.where(falls == most, np.arange(falls.size), 0))

    @cached_property
    def wrong_slopes(self):
        """The last radius (m) at which g′ is wrong for contacts up to each radius, NaN if it is right."""
        x, pairs = self.looked.x, _pairs_of(self.looked)
        places = x[np.maximum.accumulate(np.where(pairs.off, np.arange(x.size), 0))]
        return np.where(_wrong_contacts(x, pairs), places, np.nan)

    def reached(self, depth):
        """Number of the last radius that the edge of a contact passes up to a depth (m)."""
        return np.searchsorted(self.levels, depth, side="right") - 1


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
    looked, beyond = _Looked(x[:count], reduced[:count], slope[:count]), x[count:]
    if looked.reduced[-1] < np.max(looked.reduced):
        # The largest value of g that falls for good is the last one that the edge of a contact reaches.
        top = int(np.argmax(looked.reduced))
        radius, depth = float(x[top]), float(reduced[top])
        last = _End(radius, depth, f"g(x) falls from {depth:g} m at x = {radius:g} m on")
    elif beyond.size:
        radius, bad = _last_sound(profile, looked.x[-1], beyond[0])
        depth = float(_values(profile, np.array([radius]))[0][0])
        last = _End(radius, depth, _said(profile, bad))
    else:
        last = _End(np.inf, float(looked.reduced[-1]) if end < _RADII[-1] else np.inf, "")
    sound = SoundRange(last, looked)
    ends = [last, _end_of_slopes(profile, sound)]
    if own_radius:
        ends.append(_end_of_own_radius(profile, looked, last.depth))
    return SoundRange(min((each for each in ends if each), key=lambda each: each.radius), looked)


def _pairs_of(looked):
    """The `_Misfit` of each radius that was looked at with the one before it, of the first with itself."""
    before = np.maximum(np.arange(looked.x.size) - 1, 0)
    return _misfit([values[before] for values in looked], looked)


def _end_of_slopes(profile, sound):
    """The `_End` from which on g′ is wrong for all contacts; None if there is none.

    Refused if it is wrong for all of those that can be judged.
    """
    wrong, x = ~np.isnan(sound.wrong_slopes), sound.looked.x
    if np.any(wrong) and np.all(wrong == _pairs_of(sound.looked).enough):
        raise _refused(profile, _said_of_slope(profile, sound.wrong_slopes[np.argmax(wrong)]), _SLOPE)
    if not wrong[-1]:
        return None
    last = np.flatnonzero(~wrong)[-1]
    said = _said_of_slope(profile, sound.wrong_slopes[last + 1])
    return _End(float(x[last]), float(sound.levels[last]), said)


def _end_of_own_radius(profile, looked, known):
    """The `_End` before the first depth (m), up to the one that is known, of a wrong contact radius."""
    x, reduced, _ = looked
    rises = np.diff(reduced) > 1e-6 * reduced[1:]
    # Radii at which g rises on both sides; at a jump the same radius belongs to a range of depths.
    inner = 1 + np.flatnonzero(rises[:-1] & rises[1:] & (x[1:-1] > 0) & (reduced[1:-1] <= known))
    with np.errstate(all="ignore"):
        radius = profile.radius_at(reduced[inner])
    radius = np.broadcast_to(check.doubles("radius_at", radius, partial(_refused, profile)), inner.shape)
    wrong = ~(np.abs(radius - x[inner]) <= _SAME * x[inner])
    if not wrong.any():
        return None
    first = np.argmax(wrong)
    depth = reduced[inner[first]]
    said = f"the contact radius is {radius[first]:g} m at depth = {depth:g} m, where g is not that depth"
    if not first:
        raise _refused(profile, said, _RADIUS)
    return _End(float(x[inner[first] - 1]), float(reduced[inner[first] - 1]), said)


def _said_of_slope(profile, x):
    """Words for a g′ that is not the slope of g at a radius (m)."""
    x = np.array([(1 - _STEP) * x, x])
    g, slope, _ = _functions_at(profile, x)
    return _words(x, g, slope)


def _last_sound(profile, low, high):
    """The last radius (m) between two at which a shape is valid, and the first at which it is not."""
    low, high = change_between(lambda x: ~_values(profile, x)[2], np.array([low]), np.array([high]), True)
    return float(low[0]), float(high[0])


def _values(profile, x):
    """g (m) and g′ at radii (m), and whether g or z is not finite, or g′ not a number, there."""
    try:
        reduced, slope, height = _functions_at(profile, x)
    except check.InvalidArgument:
        raise
    except (ValueError, ArithmeticError):
        if x.size == 1:
            return np.full(1, np.nan), np.full(1, np.nan), np.ones(1, bool)
        # It ends somewhere: an interpolation, say, fails beyond its table.
        each = [_values(profile, x[i : i + 1]) for i in range(x.size)]
        _check_for_arrays(profile, x, ~np.concatenate([fault for *_, fault in each]))
        return tuple(np.concatenate(values) for values in zip(*each, strict=True))
    return reduced, slope, ~np.isfinite(reduced) | np.isnan(slope) | ~np.isfinite(height)


def _check_for_arrays(profile, x, sound):
    """Refuses a shape whose functions fail for two radii (m), though they do not for each alone."""
    if np.any(sound):
        pair = x[[np.argmax(sound)] * 2]
        try:
            _functions_at(profile, pair)
        except (ValueError, ArithmeticError) as error:
            what = f"its functions fail for an array of radii ({type(error).__name__}: {error})"
            raise _refused(profile, what, "write them for arrays, with NumPy's functions") from error


def _functions_at(profile, x):
    """g (m), g′ and z (m) at radii (m), without warnings: also at radii that no solver reaches."""
    values = []
    for name in ("reduced_at", "reduced_slope_at", "height_at"):
        try:
            with np.errstate(all="ignore"):
                value = getattr(profile, name)(x)
        except TypeError as error:
            what = f"{name} fails for an array of radii (TypeError: {error})"
            raise _refused(profile, what, "write it for arrays, with NumPy's functions") from error
        value = check.doubles(name, value, partial(_refused, profile))
        values.append(np.broadcast_to(value, x.shape).copy())
    return values


def _said(profile, x):
    """Words for what is wrong with a shape at a radius (m)."""
    try:
        reduced, slope, height = (float(value[0]) for value in _functions_at(profile, np.array([x])))
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
    if profile.shape:
        every = profile.flat_entries(slice(None), profile.shape)
        x = np.zeros(every.shape)
        reduced, *_ = _functions_at(every, x)
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
    depth = np.asarray(depth, dtype=float)
    shape = np.broadcast_shapes(depth.shape, profile.shape)
    depth = np.minimum(np.broadcast_to(depth, shape), profile.known_depth).ravel()
    rows = np.flatnonzero((depth > 0) & (depth <= check.LONGEST))
    size = _ROWS if profile.shape else max(rows.size, 1)
    for start in range(0, rows.size, size):
        some = rows[start : start + size]
        yield profile.flat_entries(some, shape), depth[some]


def _check_falls(profile, depth):
    """Refuses one profile whose g falls, and rises again, by more than rounding above a depth (m)."""
    sound = profile.sound
    lowest = sound.lowest[sound.reached(depth)]
    x, value = sound.looked.x[lowest], sound.looked.reduced[lowest]
    if sound.levels[lowest] - value > _ROUNDING * depth:
        raise _refused(profile, _FALLS.format(place=x, value=value), _RISE)


def _check_slope(profile, depth):
    """Refuses one profile whose g′ is not the slope of g over the contact at a depth (m)."""
    sound = profile.sound
    place = sound.wrong_slopes[sound.reached(depth)]
    if np.isfinite(place):
        raise _refused(profile, _said_of_slope(profile, place), _SLOPE)


def _check_slopes(profile, depth):
    """`check_slopes` with one depth (m) for each indenter."""
    radius = np.broadcast_to(profile.radius_at(depth), depth.shape)
    face = np.broadcast_to(profile.face_radius, radius.shape)
    x = face + (radius - face) * ((np.arange(_PAIRS)[:, None] + 0.5) / _PAIRS)
    x = np.stack([(1 - _STEP) * x, x])
    g, slope, _ = _functions_at(profile, x)
    pairs = _misfit((x[0], g[0], slope[0]), (x[1], g[1], slope[1]))
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
    reduced, slope, height = _functions_at(profile, np.minimum(x, profile.known_radius))
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
    return check.InvalidArgument(text, "profile", profile, what, "", advice)


class _Misfit(NamedTuple):
    """Pairs of radii, one an entry: which can be judged, and at which g′ is too large or too small."""

    judged: np.ndarray
    large: np.ndarray
    small: np.ndarray

    @property
    def off(self):
        """At which pairs g′ is wrong."""
        return self.large | self.small

    @property
    def enough(self):
        """Whether enough pairs can be judged up to each of them."""
        return np.cumsum(self.judged, axis=0) >= _FEWEST

    def wrong(self, width):
        """Whether g′ is wrong for contacts up to each pair along the first axis.

        A pair stands for a width (m) of the contact.
        """
        judged, large, small = (np.cumsum(width * pairs, axis=0) for pairs in self)
        return self.enough & (np.maximum(large, small) > _SHARE * judged)


def _misfit(below, above):
    """The `_Misfit` of pairs of radii, from x (m), g (m) and g′ at the smaller and at the larger ones."""
    step, rise = above[0] - below[0], above[1] - below[1]
    # At the tip g′ may be infinite.
    with np.errstate(invalid="ignore"):
        low, high = (step * extreme(below[2], above[2]) for extreme in (np.minimum, np.maximum))
    judged = (above[1] > _LOWEST) & (np.maximum(rise, low) > _RISE_OF_ROUNDING * above[1])
    return _Misfit(judged, judged & (low > _FACTOR * rise), judged & (rise > _FACTOR * high))


def _wrong_contacts(x, pairs):
    """Whether g′ of one profile is wrong for contacts with each of the radii x (m), from the tip outward.

    `pairs` is the `_Misfit` of each of these radii with the one before it, and of the first with itself.
    """
    wrong = pairs.wrong(np.diff(x, prepend=0.0))
    wider = np.minimum(np.searchsorted(x, _WIDER * x), x.size - 1)
    return wrong & wrong[wider]


def _words(x, g, slope):
    """Words for a wrong g′ at the larger one of two radii x (m), from g (m) and g′ at both."""
    own = (g[1] - g[0]) / (x[1] - x[0])
    return f"g′(x) is {slope[1]:g} at x = {x[1]:g} m, but g(x) rises with the slope {own:g} there"
