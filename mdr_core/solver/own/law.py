"""Laws of hardness that a user wrote: whether they are admissible, their units, where they change fast.

`check_law` checks a law up to the contact radius of a calculation. `ScaledLaw` is the law in the units of a
cap, which a search may ask at any radius.
"""

from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import islice
from typing import Any, NamedTuple, Self

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike, shown
from ..medium.hardness import HardnessLaw

#: Radii (m) between which a law is asked, whatever a search tries.
_NARROWEST, _WIDEST = 1e-30, check.FARTHEST
#: Largest number of pairs of radii that are halved at a time, and number of halvings at which the law still
#: changes as fast at a jump alone.
_WORST, _HALVINGS = 500, 40
#: Radii at which a law is checked, over so many decades; relative step of its differences.
_RADII, _DECADES, _STEP = 200, 6, 2e-6
#: Indenters of an ensemble that are checked at a time.
_ROWS = 512


def check_law(law, profile, depth):
    """Refuses a law of hardness that is not valid at the contact radii (m) of depths (m) up to the largest.

    Below them it is checked from 10⁻⁶ of the radius on; depths that are infinite or not positive are left
    out.
    """
    depth = np.asarray(depth, dtype=float)
    shape = np.broadcast_shapes(depth.shape, law.shape, profile.shape)
    depth = np.minimum(np.broadcast_to(depth, shape), profile.known_depth).ravel()
    rows = np.flatnonzero((depth > 0) & (depth <= check.LONGEST))
    if not rows.size:
        return
    if not law.shape:
        # One law for all: its values are looked at once, over all radii.
        if profile.shape:
            radius = profile.flat_entries(rows, shape).contact_radius(depth[rows])
        else:
            radius = profile.contact_radius([np.min(depth[rows]), np.max(depth[rows])])
        ends = np.array([[np.min(radius)], [np.max(radius)]])
        radii = _radii_below(*ends, np.min(profile.face_radius))
        _check_values(law, radii)
        if not profile.shape:
            _refuse_growth(law, profile, radii)
            return
    for start in range(0, rows.size, _ROWS):
        some = rows[start : start + _ROWS]
        own = profile.flat_entries(some, shape)
        radius = np.broadcast_to(own.contact_radius(depth[some]), some.shape)
        face = np.broadcast_to(own.face_radius, some.shape)
        radii = _radii_below(radius, radius, face)
        column = (slice(None), None), some.shape
        each = law.flat_entries(some, shape).entries(*column)
        if law.shape:
            _check_values(each, radii)
        _refuse_growth(each, own.entries(*column), radii)


def _radii_below(least, largest, face):
    """Radii (m), one row each, from 10⁻⁶ of the least contact radius, or a flat face, to the largest."""
    low = np.maximum(np.maximum(10.0**-_DECADES * least, face), _NARROWEST)
    share = np.max(np.log10(largest / low)) / _DECADES
    radii = np.geomspace(low, largest, int(np.ceil(_RADII * max(share, 1.0))), axis=-1)
    return np.minimum(radii, largest[:, None])


def _check_values(law, a):
    """Refuses a law whose functions are not valid at radii (m) in ascending order along the last axis."""
    hardness = law_values(law, "at", a)
    _refuse_radii(
        law, a, ~((hardness > 0) & (hardness < np.inf)),
        lambda i: f"σ_c = {hardness[i]:g} Pa at a = {a[i]:g} m is not finite and above 0",
        "a contact of this calculation has that radius: correct its at(a)",
    )  # fmt: skip
    # The difference of a step back from each radius, over the step, and the derivative in its middle.
    change = (hardness - law_values(law, "at", a * (1 - _STEP))) / _STEP
    rate = a * law_values(law, "rate", a * (1 - _STEP / 2))
    _refuse_radii(
        law, a, ~(np.abs(change - rate) <= 1e-3 * np.abs(rate) + 1e-5 * hardness),
        lambda i: f"rate(a) = {rate[i] / a[i]:g} Pa/m at a = {a[i]:g} m, but at(a) changes by "
        f"{change[i] / a[i]:g} Pa/m there",
        "rate is the derivative of at, which has no jumps",
    )  # fmt: skip
    _refuse_jumps(law, a, hardness)
    for name in ("line_load", "line_load_rate", "wall_load"):
        if getattr(type(law), name) is not getattr(HardnessLaw, name):
            own, made = law_values(law, name, a), getattr(HardnessLaw, name)(law, a)
            scale = a * hardness if name == "line_load" else np.maximum(hardness, a * a * hardness)
            _refuse_radii(
                law, a, ~(np.abs(own - made) <= 1e-6 * scale),
                lambda i, name=name, own=own, made=made: f"{name}(a) = {own[i]:g} at a = {a[i]:g} m, "
                f"but by at(a) and rate(a) it is {made[i]:g}",
                "leave it out, or correct it",
            )  # fmt: skip


def _refuse_growth(law, profile, a):
    """Refuses a law of which a σ_c/g(a) grows between radii (m) in ascending order along the last axis."""
    # Depth over the elastic limit, which must not fall.
    depth = profile.reduced(a) / (a * law_values(law, "at", a))
    falls = np.zeros(a.shape, bool)
    falls[:, 1:] = depth[:, 1:] < depth[:, :-1] * (1 - 1e-9)
    _refuse_radii(
        law, a, falls,
        lambda i: f"a σ_c/g(a) grows with the contact radius at a = {a[i]:g} m under "
        f"{shown(profile.entries(i, a.shape))}",
        "elements that have yielded would become elastic again on loading: take a law that grows less, or "
        "an indenter whose g grows more",
    )  # fmt: skip


def _refuse_radii(law, a, bad, what, advice):
    """Refuses a law at the first of the radii (m) that are `bad`; `what` says so for its index."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), bad.shape)
        one = law.entries(index, a.shape) if law.shape else law
        raise refused_law(one, what(index), advice)


def _refuse_jumps(law, a, hardness):
    """Refuses a law that jumps between neighbouring radii (m), however near these are."""
    steep = _steep_pairs(law, a, hardness, 1e-7)
    for low, _, below, above in islice(steep, _HALVINGS, _HALVINGS + 1):
        i = np.argmax(np.abs(above - below) / np.maximum(above, below))
        what = f"σ_c jumps from {below[i]:g} to {above[i]:g} Pa at a = {low[i]:g} m"
        raise refused_law(law, what, "a law is smooth in a: join its parts over a range of radii")


@dataclass(frozen=True, eq=False)
class ScaledLaw(check.Parameters):
    """A law of radii in units of a length (m), with line loads times a factor; a NaN of it is refused."""

    law: HardnessLaw
    factor: Any
    length: Any

    def line_load(self, a: Array) -> Array:
        """`HardnessLaw.line_load` in these units."""
        return self.factor * self._asked("line_load", a)

    def line_load_rate(self, a: Array) -> Array:
        """`HardnessLaw.line_load_rate` in these units."""
        return self.factor * self.length * self._asked("line_load_rate", a)

    def wall_load(self, a: Array) -> Array:
        """`HardnessLaw.wall_load` in these units."""
        return self.factor / self.length * self._asked("wall_load", a)

    @property
    def sharp(self) -> np.ndarray:
        """Radii along the last axis where the law changes fast; none are known of an ensemble of laws."""
        radii = np.empty(0) if self.law.shape else _sharp_radii(self.law)
        return radii / self.length

    def scaled(self, factor: ArrayLike, length: ArrayLike) -> Self:
        """`HardnessLaw.scaled` on top of these units."""
        return type(self)(self.law, self.factor * factor, self.length * length)

    def _asked(self, name, a):
        """The law's function of a name at radii; beyond the radii where it is a law, a σ_c is constant."""
        radius = np.minimum(np.maximum(self.length * a, _NARROWEST), _WIDEST)
        # Values are looked at here: a search may ask a law where its powers leave double precision.
        value = law_numbers(self.law, name, radius)
        if not np.any(_is_none(name, value)):
            return value
        # A search went there: `check_law` refuses the law if its result is there.
        low, high = _range_of(self.law) if not self.law.shape else (_NARROWEST, _WIDEST)
        inside = np.clip(radius, low, high)
        value = np.where(np.isnan(radius), np.nan, law_numbers(self.law, name, inside))
        if name == "line_load_rate":
            value = np.where(inside == radius, value, 0.0)
        bad = _is_none(name, value) & ~np.isnan(radius)
        if np.any(bad):
            value, radius, bad = np.broadcast_arrays(value, radius, bad)
            first = np.unravel_index(np.argmax(bad), bad.shape)
            what = f"{name}(a) is {value[first]:g} at a = {radius[first]:g} m"
            one = self.law.entries(first, bad.shape) if self.law.shape else self.law
            raise refused_law(one, what, "it must be a number, not negative, at every radius a > 0")
        return value


def _is_none(name, value):
    """Where values of a law's function of a name are not finite, or negative ones of a hardness."""
    return ~np.isfinite(value) if name == "line_load_rate" else ~((value >= 0) & (value < np.inf))


def _range_of(law):
    """Radii (m) between which a law is finite and above 0: the longest range, in steps of 7 %."""
    radius = np.geomspace(_NARROWEST, _WIDEST, 5786)
    hardness, rate = law_values(law, "at", radius), law_values(law, "rate", radius)
    good = (hardness > 0) & (hardness < np.inf) & np.isfinite(rate)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(int)))
    if not edges.size:
        return _NARROWEST, _WIDEST
    first, last = max(edges.reshape(-1, 2).tolist(), key=lambda ends: ends[1] - ends[0])
    return radius[first], radius[last - 1]


def refused_law(law, what, advice):
    """The error of a law of hardness: what is wrong with it, and what to do."""
    text = f"{what}; {advice}"
    return check.InvalidArgument(f"hardness {shown(law)}: {text}", "hardness", law, what, "", advice)


def law_numbers(law, name, a):
    """What a law's function of a name gives for radii (m), as an array of numbers, else refused."""
    return check.numbers_of(f"{name}(a)", getattr(law, name), a, partial(refused_law, law))


def law_values(law, name, a):
    """`law_numbers` at an array of radii (m), refused unless one for each radius."""
    value = law_numbers(law, name, a)
    try:
        return np.broadcast_to(value, a.shape)
    except ValueError:
        what = f"{name}(a) has the shape {np.shape(value)} for radii of shape {a.shape}"
        raise refused_law(law, what, "give one value for each radius") from None


# Kept, contact times are 1.4 times as fast for a law with a steep step, 1.1 times for a smooth one.
@lru_cache(maxsize=256)
def _sharp_radii(law):
    """Radii (m), ascending, between which a law changes so little that its rates at both ends tell it."""
    low, high = _range_of(law)
    radii = np.geomspace(max(low, 1e-18), min(high, 1e6), 817)[None]
    steep = islice(_steep_pairs(law, radii, law_values(law, "at", radii), 1e-3), _HALVINGS)
    return np.unique(np.concatenate([[], *(pairs.radii for pairs in steep)]))


class _Pairs(NamedTuple):
    """Pairs of neighbouring radii (m), one an entry: the lower and the higher one, and σ_c (Pa) at each."""

    low: np.ndarray
    high: np.ndarray
    below: np.ndarray
    above: np.ndarray

    @property
    def middle(self):
        return np.sqrt(self.low) * np.sqrt(self.high)

    @property
    def radii(self):
        """All radii of the pairs, and those at which they are halved."""
        return np.concatenate([self.low, self.middle, self.high])


def _steep_pairs(law, a, hardness, tolerance):
    """Yields the `_Pairs` between which a law changes fast, then those of their halves, until none is left.

    That is where the change of σ_c, over itself, is not that of the rates at both ends to a tolerance. At a
    jump this never ends. From σ_c (Pa) at radii (m), one row each.
    """
    row = np.repeat(np.arange(len(a)), a.shape[1] - 1)
    pairs = _Pairs(*(part.ravel() for part in (a[:, :-1], a[:, 1:], hardness[:, :-1], hardness[:, 1:])))
    while True:
        low, high, below, above = pairs
        own = law.flat_entries(row, (len(a), 1))
        slope = (low * law_values(own, "rate", low) + high * law_values(own, "rate", high)) / 2
        miss = np.abs(above - below - slope * np.log(high / low)) / np.maximum(above, below)
        worst = np.argsort(-miss)[:_WORST]
        worst = worst[miss[worst] > tolerance]
        if not worst.size:
            return
        row, pairs = row[worst], _Pairs(*(part[worst] for part in pairs))
        yield pairs
        low, high, below, above = pairs
        middle = pairs.middle
        between = law_values(law.flat_entries(row, (len(a), 1)), "at", middle)
        row = np.append(row, row)
        low, high = np.append(low, middle), np.append(middle, high)
        pairs = _Pairs(low, high, np.append(below, between), np.append(between, above))
