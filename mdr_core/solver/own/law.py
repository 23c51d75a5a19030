"""Users' laws of hardness: their checks, their units, and the radii at which they change fast.

`check_law` checks a law up to the contact radius of a calculation. `ScaledLaw` is the law in the units of a
cap; a search may evaluate it at any radius.
"""

from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any, Self

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike, shown
from ..medium.hardness import HardnessLaw
from .rows import largest_in_blocks, refuse_first, refused, values_of

#: Smallest and largest radius (m) at which a law is evaluated, whatever a search tries.
_NARROWEST, _WIDEST = 1e-30, check.FARTHEST
#: Number of radii and of decades of the check of a law; relative step of its differences.
_RADII, _DECADES, _STEP = 200, 6, 2e-6
#: Radii (m), 34 per decade, at which a law is evaluated beforehand.
_LOOKED = np.geomspace(1e-18, 1e6, 817)
#: Largest number of pairs of radii halved at a time, and number of halvings after which only a jump of the
#: law still changes as fast.
_WORST, _HALVINGS = 500, 40


def check_law(law, profile, depth):
    """Raise an error if a law of hardness is invalid up to the largest contact radius of depths (m).

    The check begins at 10⁻⁶ of this radius, or at a flat face. Depths that are not finite and positive are
    left out.
    """
    shape = np.broadcast_shapes(law.shape, profile.shape)
    for rows, depths in largest_in_blocks(profile, depth, shape):
        own, each = profile.flat_entries(rows, shape), law.flat_entries(rows, shape)
        radius = np.broadcast_to(own.contact_radius(depths), rows.shape)
        low = np.maximum(np.maximum(10.0**-_DECADES * radius, own.face_radius), _NARROWEST)
        column = (slice(None), None), rows.shape
        # A common law is checked once, over the radii of all entries.
        a = _radii(low, radius) if law.shape else _radii(np.min(low)[None], np.max(radius)[None])
        _check_values(each.entries(*column), a)
        _refuse_jumps(each, a)
        _refuse_growth(each.entries(*column), own.entries(*column), _radii(low, radius))


def _radii(low, high):
    """Return radii (m) in ascending order from low to high radii, one row each."""
    share = np.log10(np.max(high / low)) / _DECADES
    return np.minimum(np.geomspace(low, high, int(_RADII * max(share, 1.0)), axis=-1), high[:, None])


def _check_values(law, a):
    """Raise an error if a law's functions are invalid at radii (m), ascending along the last axis."""
    hardness = values_of(law, "at", a)
    refuse_first(
        law, ~((hardness > 0) & (hardness < np.inf)),
        lambda i: f"σ_c = {hardness[i]:g} Pa at a = {a[i]:g} m must be finite and above 0",
        "a contact of this calculation has this radius: correct its at(a)",
    )  # fmt: skip
    # The difference quotient of a step back from each radius, and the derivative in the middle of the step.
    change = (hardness - values_of(law, "at", a * (1 - _STEP))) / _STEP
    rate = a * values_of(law, "rate", a * (1 - _STEP / 2))
    refuse_first(
        law, ~(np.abs(change - rate) <= 1e-3 * np.abs(rate) + 1e-5 * hardness),
        lambda i: f"rate(a) = {rate[i] / a[i]:g} Pa/m at a = {a[i]:g} m, but at(a) changes by "
        f"{change[i] / a[i]:g} Pa/m there",
        "correct rate, the derivative of at, which must have no jumps",
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
    """Raise an error if a law jumps between neighbouring radii (m), however near; one row each."""
    _, (row, low, high) = _steep(law, a, 1e-5)
    if row.size:
        one = law.entries(row[0])
        below, above = values_of(one, "at", np.array([low[0], high[0]]))
        what = f"σ_c jumps from {below:.8g} to {above:.8g} Pa at a = {low[0]:g} m"
        raise refused(one, what, "a law is smooth in a: join its parts over a range of radii")


def _refuse_growth(law, profile, a):
    """Raise an error if a σ_c/g(a) of a law grows between radii (m), ascending along the last axis."""
    # The ratio of depth and elastic limit, which must not fall.
    depth = profile.reduced(a) / (a * values_of(law, "at", a))
    refuse_first(
        law, np.diff(depth, prepend=0.0) < -1e-9 * depth,
        lambda i: f"a σ_c/g(a) grows with the contact radius at a = {a[i]:g} m under "
        f"{shown(profile.entries(i, a.shape))}",
        "elements that have yielded would become elastic again on loading: take a law that grows less, or "
        "an indenter with a steeper g",
    )  # fmt: skip


def _steep(law, a, tolerance):
    """Find the radii at which a law changes fast, between radii (m) in ascending order, one row each.

    There the relative change of σ_c differs from the change by the rates at both ends by more than a
    tolerance. The search takes pairs of neighbours, then their halves, and so on.

    Returns
    -------
    radii : list of ndarray
        Radii (m) of these pairs, and the radii at which they are halved.
    row, low, high : ndarray, shape (M,)
        Rows and radii (m) of the pairs that remain in the end, the fastest first. Jumps remain.
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
    """A law of radii in units of a length (m), with line loads times a factor; it raises errors on NaN."""

    law: HardnessLaw
    factor: Any
    length: Any

    def line_load(self, a: Array) -> Array:
        """Return `HardnessLaw.line_load` in these units."""
        return self.factor * self._asked("line_load", a)

    def line_load_rate(self, a: Array) -> Array:
        """Return `HardnessLaw.line_load_rate` in these units."""
        return self.factor * self.length * self._asked("line_load_rate", a)

    def wall_load(self, a: Array) -> Array:
        """Return `HardnessLaw.wall_load` in these units."""
        return self.factor / self.length * self._asked("wall_load", a)

    @property
    def sharp(self) -> np.ndarray:
        """Radii along the last axis at which the law changes fast; empty for an ensemble of laws."""
        return (np.empty(0) if self.law.shape else _known(self.law)[2]) / self.length

    def scaled(self, factor: ArrayLike, length: ArrayLike) -> Self:
        """Return `HardnessLaw.scaled` on top of these units."""
        return type(self)(self.law, self.factor * factor, self.length * length)

    def _asked(self, name, a):
        """Return a law's named function at radii; beyond its valid radii, a σ_c is constant."""
        radius = np.minimum(np.maximum(self.length * a, _NARROWEST), _WIDEST)
        # Values are checked here: in a search, powers of a law may overflow.
        value = law_numbers(self.law, name, radius)
        bad = _is_none(name, value)
        if not np.any(bad):
            return value
        if not self.law.shape:
            # A search went there: `check_law` raises an error if its result is there.
            inside = law_numbers(self.law, name, np.clip(radius, *_known(self.law)[:2]))
            value = np.where(bad, 0.0 if name == "line_load_rate" else inside, value)
            bad = _is_none(name, value)
        value, radius, bad = np.broadcast_arrays(value, radius, bad)
        refuse_first(
            self.law, bad & ~np.isnan(radius),
            lambda i: f"{name}(a) = {value[i]:g} at a = {radius[i]:g} m must be a number, not negative",
            "correct it for every radius a > 0",
        )  # fmt: skip
        return value


def _is_none(name, value):
    """Whether values of a law's named function are not finite, or negative for a hardness."""
    return ~np.isfinite(value) if name == "line_load_rate" else ~((value >= 0) & (value < np.inf))


# The cache makes contact times 1.4 times as fast for a law with a steep step, 1.1 times for a smooth law.
@lru_cache(maxsize=256)
def _known(law):
    """Return the radii (m) between which a law is finite and above 0, and radii of fast changes.

    The first two are the ends of the longest range. The others are ascending. Between them the law changes
    so little that its rates at both ends determine the change.
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
    """Return a law's named function at radii (m) as an array of numbers; raise an error otherwise."""
    return check.numbers_of(f"{name}()", getattr(law, name), a, partial(refused, law))
