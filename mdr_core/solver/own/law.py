"""Laws of hardness that a user wrote: whether they are admissible, their units, where they change fast.

`check_law` checks a law up to the contact radius of a calculation. `ScaledLaw` is the law in the units of a
cap, which a search may ask at any radius.
"""

from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any, Self

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike, shown
from ..medium.hardness import HardnessLaw
from .rows import largest_in_blocks, refuse_first, refused, values_of

#: Radii (m) between which a law is asked, whatever a search tries.
_NARROWEST, _WIDEST = 1e-30, check.FARTHEST
#: Radii at which a law is checked, over so many decades; relative step of its differences.
_RADII, _DECADES, _STEP = 200, 6, 2e-6
#: Radii (m), 34 in each decade, at which a law is looked at beforehand.
_LOOKED = np.geomspace(1e-18, 1e6, 817)
#: Largest number of pairs of radii that are halved at a time, and number of halvings at which a law still
#: changes as fast at a jump alone.
_WORST, _HALVINGS = 500, 40


def check_law(law, profile, depth):
    """Refuses a law of hardness that is not valid at the contact radii (m) of depths (m) up to the largest.

    Below it is checked from 10⁻⁶ of the radius, or a flat face, on. Depths that are not finite and positive
    are left out.
    """
    shape = np.broadcast_shapes(law.shape, profile.shape)
    for rows, depths in largest_in_blocks(profile, depth, shape):
        own, each = profile.flat_entries(rows, shape), law.flat_entries(rows, shape)
        radius = np.broadcast_to(own.contact_radius(depths), rows.shape)
        low = np.maximum(np.maximum(10.0**-_DECADES * radius, own.face_radius), _NARROWEST)
        column = (slice(None), None), rows.shape
        # One law for all is looked at once, over the radii of all.
        a = _radii(low, radius) if law.shape else _radii(np.min(low)[None], np.max(radius)[None])
        _check_values(each.entries(*column), a)
        _refuse_jumps(each, a)
        _refuse_growth(each.entries(*column), own.entries(*column), _radii(low, radius))


def _radii(low, high):
    """Radii (m) in ascending order from low to high ones, one row each."""
    share = np.log10(np.max(high / low)) / _DECADES
    return np.minimum(np.geomspace(low, high, int(_RADII * max(share, 1.0)), axis=-1), high[:, None])


def _check_values(law, a):
    """Refuses a law whose functions are not valid at radii (m) in ascending order along the last axis."""
    hardness = values_of(law, "at", a)
    refuse_first(
        law, ~((hardness > 0) & (hardness < np.inf)),
        lambda i: f"σ_c = {hardness[i]:g} Pa at a = {a[i]:g} m is not finite and above 0",
        "a contact of this calculation has that radius: correct its at(a)",
    )  # fmt: skip
    # The difference of a step back from each radius, over the step, and the derivative in its middle.
    change = (hardness - values_of(law, "at", a * (1 - _STEP))) / _STEP
    rate = a * values_of(law, "rate", a * (1 - _STEP / 2))
    refuse_first(
        law, ~(np.abs(change - rate) <= 1e-3 * np.abs(rate) + 1e-5 * hardness),
        lambda i: f"rate(a) = {rate[i] / a[i]:g} Pa/m at a = {a[i]:g} m, but at(a) changes by "
        f"{change[i] / a[i]:g} Pa/m there",
        "rate is the derivative of at, which has no jumps",
    )  # fmt: skip
    for name, power in (("line_load", 1), ("line_load_rate", 0), ("wall_load", 2)):
        if getattr(type(law), name) is getattr(HardnessLaw, name):
            continue
        own, made = values_of(law, name, a), getattr(HardnessLaw, name)(law, a)
        refuse_first(
            law, ~(np.abs(own - made) <= 1e-6 * a**power * hardness),
            lambda i, name=name, own=own, made=made: f"{name}(a) = {own[i]:g} at a = {a[i]:g} m, but by "
            f"at(a) and rate(a) it is {made[i]:g}",
            "leave it out, or correct it",
        )  # fmt: skip


def _refuse_jumps(law, a):
    """Refuses a law that jumps between neighbouring radii (m), however near these are; one row each."""
    _, (row, low, high) = _steep(law, a, 1e-5)
    if row.size:
        one = law.entries(row[0])
        below, above = values_of(one, "at", np.array([low[0], high[0]]))
        what = f"σ_c jumps from {below:.8g} to {above:.8g} Pa at a = {low[0]:g} m"
        raise refused(one, what, "a law is smooth in a: join its parts over a range of radii")


def _refuse_growth(law, profile, a):
    """Refuses a law of which a σ_c/g(a) grows between radii (m) in ascending order along the last axis."""
    # Depth over the elastic limit, which must not fall.
    depth = profile.reduced(a) / (a * values_of(law, "at", a))
    refuse_first(
        law, np.diff(depth, prepend=0.0) < -1e-9 * depth,
        lambda i: f"a σ_c/g(a) grows with the contact radius at a = {a[i]:g} m under "
        f"{shown(profile.entries(i, a.shape))}",
        "elements that have yielded would become elastic again on loading: take a law that grows less, or "
        "an indenter whose g grows more",
    )  # fmt: skip


def _steep(law, a, tolerance):
    """Where a law changes fast between radii (m) in ascending order, one row each.

    That is where the change of σ_c, over itself, is not that of the rates at both ends to a tolerance: of
    pairs of neighbours, then of their halves, and so on.

    Returns
    -------
    radii : list of ndarray
        Radii (m) of these pairs, and those at which they are halved.
    row, low, high : ndarray, shape (M,)
        Rows and radii (m) of the pairs that are left in the end, the fastest first. At a jump they are.
    """
    row = np.repeat(np.arange(len(a)), a.shape[1] - 1)
    low, high, radii = a[:, :-1].ravel(), a[:, 1:].ravel(), [a[0, :0]]
    for _ in range(_HALVINGS + 1):
        own = law.flat_entries(row, (len(a),))
        below, above = values_of(own, "at", low), values_of(own, "at", high)
        slope = (low * values_of(own, "rate", low) + high * values_of(own, "rate", high)) / 2
        miss = np.abs(above - below - slope * np.log(high / low)) / np.maximum(above, below)
        worst = np.argsort(-miss)[:_WORST]
        worst = worst[miss[worst] > tolerance]
        pairs = row, low, high = row[worst], low[worst], high[worst]
        if not worst.size:
            break
        middle = np.sqrt(low) * np.sqrt(high)
        radii += [low, middle, high]
        row, low, high = np.append(row, row), np.append(low, middle), np.append(middle, high)
    return radii, pairs


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
        return (np.empty(0) if self.law.shape else _known(self.law)[2]) / self.length

    def scaled(self, factor: ArrayLike, length: ArrayLike) -> Self:
        """`HardnessLaw.scaled` on top of these units."""
        return type(self)(self.law, self.factor * factor, self.length * length)

    def _asked(self, name, a):
        """The law's function of a name at radii; beyond the radii where it is a law, a σ_c is constant."""
        radius = np.minimum(np.maximum(self.length * a, _NARROWEST), _WIDEST)
        # Values are looked at here: a search may ask a law where its powers leave double precision.
        value = law_numbers(self.law, name, radius)
        bad = _is_none(name, value)
        if not np.any(bad):
            return value
        if not self.law.shape:
            # A search went there: `check_law` refuses the law if its result is there.
            inside = law_numbers(self.law, name, np.clip(radius, *_known(self.law)[:2]))
            value = np.where(bad, 0.0 if name == "line_load_rate" else inside, value)
            bad = _is_none(name, value)
        value, radius, bad = np.broadcast_arrays(value, radius, bad)
        refuse_first(
            self.law, bad & ~np.isnan(radius),
            lambda i: f"{name}(a) is {value[i]:g} at a = {radius[i]:g} m",
            "it must be a number, not negative, at every radius a > 0",
        )  # fmt: skip
        return value


def _is_none(name, value):
    """Where values of a law's function of a name are not finite, or negative ones of a hardness."""
    return ~np.isfinite(value) if name == "line_load_rate" else ~((value >= 0) & (value < np.inf))


# Kept, contact times are 1.4 times as fast for a law with a steep step, 1.1 times for a smooth one.
@lru_cache(maxsize=256)
def _known(law):
    """Radii (m) between which a law is finite and above 0, and those, ascending, where it changes fast.

    The first two are the ends of the longest range. Between the others it changes so little that its rates
    at both ends tell it.
    """
    hardness, rate = values_of(law, "at", _LOOKED), values_of(law, "rate", _LOOKED)
    bad = np.flatnonzero(~((hardness > 0) & (hardness < np.inf) & np.isfinite(rate)))
    edges = np.concatenate([[-1], bad, [_LOOKED.size]])
    longest = np.argmax(np.diff(edges))
    known = _LOOKED[edges[longest] + 1 : edges[longest + 1]]
    if not known.size:
        return _NARROWEST, _WIDEST, known
    return known[0], known[-1], np.unique(np.concatenate(_steep(law, known[None], 1e-3)[0]))


def law_numbers(law, name, a):
    """What a law's function of a name gives for radii (m), as an array of numbers, else refused."""
    return check.numbers_of(f"{name}()", getattr(law, name), a, partial(refused, law))
