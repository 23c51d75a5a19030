"""Laws of hardness: the mean pressure σ_c(a) under a contact of radius a that has yielded throughout."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any, Self

import numpy as np

from . import _check, _read_only
from ._check import Array, ArrayLike, shown

_TINY = np.finfo(float).tiny
#: Radii (m) between which a law is asked, whatever a search tries.
NARROWEST, _WIDEST = 1e-30, _check.FARTHEST
#: Largest number of pairs of radii between which a jump is looked for.
_WORST = 500


@dataclass(frozen=True, eq=False)
class HardnessLaw(_check.Parameters, ABC):
    """Base class of laws of hardness σ_c(a), for `Medium(E_star, hardness=law)`.

    A law is a frozen dataclass with two functions of arrays of contact radii a > 0 (m), smooth in a, which
    do not change these arrays:
    `at(a)`, the hardness σ_c (Pa), and `rate(a)`, its derivative dσ_c/da (Pa/m). The base class makes the
    other three of them; a law may override these where its limits for a → 0 and a → ∞ need it.

    Under an indenter with the reduced profile g the elements are compressed elastically by at most
    u_c = π a σ_c(a)/(2E*), Popov (2015), Eqs. (11), (12). A law is valid while σ_c is finite and above 0
    and a σ_c/g(a) does not grow with a: otherwise elements that have yielded would become elastic again on
    loading. Every calculation checks this at 200 radii, from 10⁻⁶ of its largest contact radius up to it,
    and that `rate` is the derivative of `at`. Dips narrower than 7 % of the radius are not seen.

    Parameters may be arrays, which broadcast like the parameters of a `Medium`; give a table as a tuple.
    Laws are evaluated at radii of 10⁻³⁰ m and more.

    Examples
    --------
    Indentation size effect of metals, σ_c = H₀ √(1 + a*/a) (Nix and Gao 1998):

    >>> import numpy as np
    >>> from mdr_core import Cone, HardnessLaw, Medium, indent
    >>> from dataclasses import dataclass
    >>> from mdr_core import Cone, Medium, indent
    >>> @dataclass(frozen=True)
    ... class NixGao(HardnessLaw):
    ...     H0: float
    ...     a_star: float
    ...
    ...     def at(self, a):
    ...         return self.H0 * np.sqrt(1 + self.a_star / a)
    ...
    ...     def rate(self, a):
    ...         return -(self.H0**2) * self.a_star / (2 * a**2 * self.at(a))
    >>> copper = Medium(E_star=130e9, hardness=NixGao(H0=0.581e9, a_star=4.47e-6))
    >>> print(round(copper.hardness_at(1.49e-6) / 1e9, 9))  # a = a*/3: 2 H₀, in GPa
    1.162
    >>> state = indent(Cone.berkovich(), copper, [100e-9, 1e-6])
    >>> (state.mean_pressure / 1e9).round(4)
    array([2.8761, 1.0765])
    """

    def __init_subclass__(cls, **keywords: Any):
        super().__init_subclass__(**keywords)
        _read_only.guard_methods(cls, ("at", "rate", "line_load", "line_load_rate", "wall_load"))

    @abstractmethod
    def at(self, a: Any) -> Any:
        """Hardness σ_c (Pa) at contact radii a (m)."""

    @abstractmethod
    def rate(self, a: Any) -> Any:
        """dσ_c/da (Pa/m) at contact radii a (m)."""

    def line_load(self, a: Any) -> Any:
        """a σ_c (N/m): 2/π times the largest line load of an element, Popov (2015), Eq. (12)."""
        return a * self.at(a)

    def line_load_rate(self, a: Any) -> Any:
        """d(a σ_c)/da (Pa)."""
        return self.at(a) + a * self.rate(a)

    def wall_load(self, a: Any) -> Any:
        """a² σ_c (N): 1/π of the force of a contact that has yielded throughout, as behind a wall."""
        return a * self.line_load(a)

    def scaled(self, factor: ArrayLike, length: ArrayLike) -> "ScaledLaw":
        """The law of radii in units of a `length` (m), with line loads times a `factor`."""
        return ScaledLaw(self, factor, length)

    def stored(self) -> "HardnessLaw":
        """The law as a medium keeps it: with copies of its arrays. Refused if it may change."""
        kind, arrays = type(self), {}
        name, own = kind.__name__, {each.name for each in fields(self)}
        # Values that are computed once, by functools.cached_property, belong to the class.
        if any(key not in own and not hasattr(kind, key) for key in vars(self)):
            raise TypeError(f"{name} must not change: declare it with @dataclass(frozen=True)")
        for each in fields(self):
            if hasattr(HardnessLaw, each.name):
                raise TypeError(f"{name}: a parameter of a law cannot be named {each.name}")
            value = getattr(self, each.name)
            if isinstance(value, list | np.ndarray):
                arrays[each.name] = _check.frozen(_check.finite_array(f"{name} {each.name}", value))
        _check.common_shape(name, **arrays)
        return self._with(self.__getstate__() | arrays) if arrays else self

    def _with(self, values):
        # Not by the constructor: values that it derives from others are among these.
        new = object.__new__(type(self))
        _check.store(new, **values)
        return new


@dataclass(frozen=True, eq=False)
class SumOfClasses(HardnessLaw):
    """σ_c = H + q_c/a + f_c/a², the sum of the classes (a), (b), (c) of Popov (2015), section 1.

    Constants (Pa, N/m, N) are not negative; an infinite q_c means that nothing yields.
    """

    hardness: Any
    q_c: Any
    f_c: Any

    def at(self, a):
        return self.hardness + np.asarray(self.q_c) / a + np.asarray(self.f_c) / a / a

    def rate(self, a):
        return -(self.q_c + 2 * np.asarray(self.f_c) / a) / a / a

    # Searches ask at any radius, also 0 and ∞: a H is 0 there for H = 0, and f_c/a² for f_c = 0.
    def line_load(self, a):
        with np.errstate(over="ignore", invalid="ignore"):
            return self.hardness * a + self.q_c + self.f_c / np.maximum(a, _TINY)

    def line_load_rate(self, a):
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            return self.hardness - self.f_c / a / a

    def wall_load(self, a):
        # The limit for a → ∞ is f_c without the two others.
        parts = (self.hardness * a if np.any(self.hardness) else 0.0) + self.q_c
        return (parts * a if np.any(parts) else 0.0) + self.f_c

    def scaled(self, factor, length):
        return SumOfClasses(
            self.hardness * (factor * length), self.q_c * factor, self.f_c * (factor / length)
        )


@dataclass(frozen=True, eq=False)
class ScaledLaw(_check.Parameters):
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
        radius = np.minimum(np.maximum(self.length * a, NARROWEST), _WIDEST)
        # Values are looked at here: a search may ask a law where its powers leave double precision.
        value = law_numbers(self.law, name, radius)
        if not np.any(_is_none(name, value)):
            return value
        # A search went there: `check_law` refuses the law if its result is there.
        low, high = _range_of(self.law) if not self.law.shape else (NARROWEST, _WIDEST)
        inside = np.clip(radius, low, high)
        value = np.where(np.isnan(radius), np.nan, law_numbers(self.law, name, inside))
        if name == "line_load_rate":
            value = np.where(inside == radius, value, 0.0)
        bad = _is_none(name, value) & ~np.isnan(radius)
        if np.any(bad):
            value, radius, bad = np.broadcast_arrays(value, radius, bad)
            what = f"{name}(a) is {value[bad][0]:g} at a = {radius[bad][0]:g} m"
            raise refused_law(self.law, what, "it must be a number, not negative, at every radius a > 0")
        return value


def _is_none(name, value):
    """Where values of a law's function of a name are not finite, or negative ones of a hardness."""
    return ~np.isfinite(value) if name == "line_load_rate" else ~((value >= 0) & (value < np.inf))


def _range_of(law):
    """Radii (m) between which a law is finite and above 0: the longest range, in steps of 7 %."""
    radius = np.geomspace(NARROWEST, _WIDEST, 5786)
    hardness, rate = law_values(law, "at", radius), law_values(law, "rate", radius)
    good = (hardness > 0) & (hardness < np.inf) & np.isfinite(rate)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(int)))
    if not edges.size:
        return NARROWEST, _WIDEST
    first, last = max(edges.reshape(-1, 2).tolist(), key=lambda ends: ends[1] - ends[0])
    return radius[first], radius[last - 1]


def refused_law(law, what, advice):
    """The error of a law of hardness: what is wrong with it, and what to do."""
    text = f"{what}; {advice}"
    return _check.InvalidArgument(f"hardness {shown(law)}: {text}", "hardness", law, what, "", advice)


def law_numbers(law, name, a):
    """What a law's function of a name gives for radii (m), as an array of numbers, else refused."""
    try:
        with np.errstate(all="ignore"):
            value = getattr(law, name)(a)
    except _check.InvalidArgument:
        raise
    except (TypeError, ValueError, ArithmeticError) as error:
        what = f"{name}(a) fails for an array of radii ({type(error).__name__}: {error})"
        raise refused_law(law, what, "write it for arrays, with NumPy's functions") from error
    plain = not (hasattr(value, "units") or hasattr(value, "unit") or np.iscomplexobj(value))
    try:
        if plain:
            return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        pass
    raise refused_law(law, f"{name}(a) gives {shown(value)}", "give plain numbers in SI units")


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
    places, _ = steep_places(law, radii, law_values(law, "at", radii), 1e-3)
    return np.unique(places)


def steep_places(law, a, hardness, tolerance):
    """Radii (m) at which pairs of neighbouring radii were halved because the law changes fast between them.

    That is where the change of σ_c, over itself, is not that of the rates at both ends to a tolerance. And
    the hardness (Pa) at the ends of the pairs that are left after 40 halvings, with their lower ends (m).
    """
    row = np.repeat(np.arange(len(a)), a.shape[1] - 1)
    low, high, below, above = (
        part.ravel() for part in (a[:, :-1], a[:, 1:], hardness[:, :-1], hardness[:, 1:])
    )
    places = [low[:0]]
    for _ in range(40):
        own = law.flat_entries(row, (len(a), 1))
        slope = (low * law_values(own, "rate", low) + high * law_values(own, "rate", high)) / 2
        miss = np.abs(above - below - slope * np.log(high / low)) / np.maximum(above, below)
        worst = np.argsort(-miss)[:_WORST]
        worst = worst[miss[worst] > tolerance]
        row, low, high, below, above = (part[worst] for part in (row, low, high, below, above))
        if not worst.size:
            break
        middle, own = np.sqrt(low) * np.sqrt(high), law.flat_entries(row, (len(a), 1))
        between = law_values(own, "at", middle)
        places += [low, middle, high]
        row, low, high = np.append(row, row), np.append(low, middle), np.append(middle, high)
        below, above = np.append(below, between), np.append(between, above)
    return np.concatenate(places), (below, above, low)
