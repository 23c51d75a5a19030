"""Laws of hardness: the mean pressure σ_c(a) under a fully yielded contact of radius a."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ...base import check, lazy, read_only
from ...base.check import ArrayLike, shown

_TINY = np.finfo(float).tiny


@dataclass(frozen=True, eq=False)
class HardnessLaw(check.Parameters, ABC):
    """Base class of laws of hardness σ_c(a), for `Medium(E_star, hardness=law)`.

    A law is a frozen dataclass with two functions of arrays of contact radii a > 0 (m): `at(a)`, the
    hardness σ_c (Pa), and `rate(a)`, its derivative dσ_c/da (Pa/m). Both must be smooth in a, and must not
    change these arrays. The base class derives three other functions from them. A law may override these
    if its limits for a → 0 and a → ∞ require it.

    Under an indenter with the reduced profile g the elements are compressed elastically by at most
    u_c = π a σ_c(a)/(2E*), Popov (2015), Eqs. (11), (12). A law is valid while σ_c is finite and above 0
    and a σ_c/g(a) does not grow with a. Otherwise elements that have yielded would become elastic again on
    loading. Every calculation checks this at 200 radii, from 10⁻⁶ of its largest contact radius up to it.
    It also checks that `rate` is the derivative of `at`. It does not detect dips narrower than 7 % of the
    radius, and jumps of less than 10⁻⁵ of σ_c.

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
        read_only.guard_methods(cls, ("at", "rate", "line_load", "line_load_rate", "wall_load"))

    @abstractmethod
    def at(self, a: Any) -> Any:
        """Return the hardness σ_c (Pa) at contact radii a (m)."""

    @abstractmethod
    def rate(self, a: Any) -> Any:
        """Return dσ_c/da (Pa/m) at contact radii a (m)."""

    def line_load(self, a: Any) -> Any:
        """Return a σ_c (N/m), 2/π times the largest line load of an element, Popov (2015), Eq. (12)."""
        return a * self.at(a)

    def line_load_rate(self, a: Any) -> Any:
        """Return d(a σ_c)/da (Pa)."""
        return self.at(a) + a * self.rate(a)

    def wall_load(self, a: Any) -> Any:
        """Return a² σ_c (N), 1/π times the force of a fully yielded contact, such as at a wall."""
        return a * self.line_load(a)

    def scaled(self, factor: ArrayLike, length: ArrayLike) -> Any:
        """Return the law for radii in units of a `length` (m), with line loads times a `factor`."""
        return lazy.law.ScaledLaw(self, factor, length)

    def stored(self) -> "HardnessLaw":
        """Return the law for a medium, with copies of its arrays; raise an error if it is mutable."""
        kind, arrays = type(self), {}
        name, own = kind.__name__, {each.name for each in fields(self)}
        # Cached values, by functools.cached_property, have a name in the class.
        if any(key not in own and not hasattr(kind, key) for key in vars(self)):
            raise TypeError(f"{name} must not change: declare it with @dataclass(frozen=True)")
        for each in fields(self):
            if hasattr(HardnessLaw, each.name):
                raise TypeError(f"{name}: a parameter of a law cannot be named {each.name}")
            value = getattr(self, each.name)
            if isinstance(value, list | np.ndarray):
                arrays[each.name] = check.frozen(check.finite_array(f"{name} {each.name}", value))
        check.common_shape(name, **arrays)
        return self._with(self.__getstate__() | arrays) if arrays else self

    def _with(self, values):
        # Without the constructor, because `values` include the values that it derives.
        new = object.__new__(type(self))
        check.store(new, **values)
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

    # Searches use any radius, including 0 and ∞: a H must be 0 for H = 0, and f_c/a² for f_c = 0.
    def line_load(self, a):
        with np.errstate(over="ignore", invalid="ignore"):
            return self.hardness * a + self.q_c + self.f_c / np.maximum(a, _TINY)

    def line_load_rate(self, a):
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            return self.hardness - self.f_c / a / a

    def wall_load(self, a):
        # The limit for a → ∞ is f_c if the two other constants are 0.
        parts = (self.hardness * a if np.any(self.hardness) else 0.0) + self.q_c
        return (parts * a if np.any(parts) else 0.0) + self.f_c

    def scaled(self, factor, length):
        return SumOfClasses(
            self.hardness * (factor * length), self.q_c * factor, self.f_c * (factor / length)
        )


def hardness_constants(q_c, hardness, f_c):
    """Return the three checked constants of a `Medium`: 0 if not given, and q_c = ∞ without any."""
    if isinstance(hardness, HardnessLaw):
        return _law_alone(q_c, hardness, f_c)
    if callable(hardness):
        wanted = "must be a number (Pa) or a HardnessLaw with its parameters"
        raise check.InvalidArgument(
            f"hardness {wanted}, got {shown(hardness)}", "hardness", hardness, wanted, "Pa"
        )
    elastic = hardness is None and f_c is None
    given = {
        "q_c": (np.inf if elastic else 0.0) if q_c is None else q_c,
        "hardness": 0.0 if hardness is None else hardness,
        "f_c": 0.0 if f_c is None else f_c,
    }
    return {
        "q_c": check.positive(
            "yield constant q_c", given["q_c"], unit="N/m", infinite=True, zero=not elastic
        ),
        "hardness": check.positive("hardness", given["hardness"], unit="Pa", zero=True),
        "f_c": check.positive("yield constant f_c", given["f_c"], unit="N", zero=True),
    }


def _law_alone(q_c, law, f_c):
    """Return the constants of a medium with a law of hardness; raise an error if q_c or f_c is given.

    An infinite q_c counts as not given.
    """
    law = law.stored()
    for name, value, unit, term in (("q_c", q_c, "N/m", "q_c/a"), ("f_c", f_c, "N", "f_c/a²")):
        quantity, value = f"yield constant {name}", 0.0 if value is None else value
        value = check.positive(quantity, value, unit=unit, zero=True, infinite=name == "q_c")
        beside = (np.asarray(value) > 0) & (np.asarray(value) < np.inf)
        bound = f"cannot be combined with the law of hardness {shown(law)}"
        advice = f"write {term} into its at(a), or take hardness = 0 with {name}"
        check.raise_if(quantity, np.asarray(value), beside, bound, unit=unit, advice=advice)
    return {"q_c": 0.0, "hardness": law, "f_c": 0.0}


def refuse_sum(medium):
    """Raise an error if the hardness of a `Medium` is 0, or has an infinite q_c with another class."""
    if isinstance(medium.hardness, HardnessLaw):
        return
    q_c, others = medium.q_c, medium.hardness + medium.f_c
    for bad, bound, advice in (
        (
            (q_c == 0) & (others == 0),
            "leaves no hardness, because the other constants are 0",
            "give a constant above 0",
        ),
        (
            (q_c == np.inf) & (others > 0),
            "means that nothing yields, which contradicts a hardness or f_c above 0",
            "give q_c = 0 or a finite q_c",
        ),
    ):
        check.raise_if("yield constant q_c", q_c, bad, bound, unit="N/m", advice=advice)


def refuse_beside_adhesion(medium):
    """Raise an error if a `Medium` has adhesion and a law, viscosity, H or f_c, also in different entries.

    One method solves all entries of an ensemble, and the method for adhesion supports none of these.
    """
    sticks = medium.work_of_adhesion > 0
    if not np.count_nonzero(sticks):
        return
    if isinstance(medium.hardness, HardnessLaw):
        raise check.MDRError(
            "adhesion supports only the hardness q_c/a, not the law "
            f"{shown(medium.hardness)}; set the work of adhesion work_of_adhesion to 0, or give q_c"
        )
    for quantity, value, unit in (
        ("viscosity eta", medium.eta, "Pa·s"),
        ("hardness", medium.hardness, "Pa"),
        ("yield constant f_c", medium.f_c, "N"),
    ):
        value, sticks = (np.broadcast_to(each, medium.shape) for each in (value, sticks))
        bound, advice = "is not supported with adhesion", "set it or work_of_adhesion to 0"
        check.raise_if(quantity, value, (value > 0) & sticks, bound, unit=unit, advice=advice)
        bound = "is not supported together with entries that have adhesion"
        advice = "solve these separately"
        check.raise_if(quantity, value, value > 0, bound, unit=unit, advice=advice)
