"""The medium: modulus, hardness, viscosity, Poisson ratio and work of adhesion."""

from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import check, lazy
from ...base.check import Array, ArrayLike, Parameter, shown
from .hardness import (
    HardnessLaw,
    SumOfClasses,
    hardness_constants,
    refuse_beside_adhesion,
    refuse_sum,
)
from .transverse_isotropy import effective_modulus


def refuse_other_classes(medium, what, instead):
    """Raise an error unless the hardness is q_c/a, for a quantity `what` of class (b)."""
    if not medium.inverse_to_radius:
        law = f", not the law {shown(medium.hardness)}" if medium.has_own_law else ""
        raise check.MDRError(f"{what} supports only the hardness q_c/a, class (b){law}; {instead}")


def refuse_transversely_isotropic(medium, what):
    """Raise an error if the medium has no Poisson ratio, for `what`, which needs more than E*."""
    if medium.poisson is None:
        raise check.MDRError(
            f"{what} needs more elastic constants than E*, and does not support a transversely isotropic "
            "medium (poisson = None). For an estimate take an isotropic medium, Medium(E_star, poisson=0.3)"
        )


def critical_depth(E_star, q_c):
    """Return the depth d_c = π q_c/(2E*) (m) at which yield starts, Popov (2015), Eq. (19)."""
    return np.pi / 2 * (q_c / E_star)


def yield_constant(E_star, critical_depth):
    """Return the yield constant q_c = 2E* d_c/π (N/m), the inverse of `critical_depth`."""
    return 2 / np.pi * E_star * critical_depth


def poisson_ratio(quantity, ratio):
    """Return a Poisson ratio as a float array, −1 < ν ≤ 1/2; raise an error otherwise."""
    ratio = check.finite_array(quantity, ratio)
    return check.raise_if(quantity, ratio, (ratio <= -1) | (ratio > 0.5), "must lie in −1 < ν ≤ 0.5")


@dataclass(frozen=True, eq=False)
class Medium(check.Parameters):
    """A half-space: elastic or viscoelastic, with a hardness that is a function of the contact radius.

    The mean pressure under a fully yielded contact of radius a is the hardness

        σ_c(a) = hardness + q_c/a + f_c/a²

    This is the sum of the three classes of Popov (2015), section 1: (a) constant, (b) inversely
    proportional to the radius, which the paper treats, (c) inversely proportional to the area. Omitted
    constants are 0. If all are omitted, nothing yields.

    Parameters
    ----------
    E_star : float
        Effective modulus E* (Pa), positive. A rigid indenter on a body of modulus E and
        Poisson ratio ν has E* = E/(1 − ν²).
    q_c : float, optional
        Yield constant of class (b) (N/m = J/m²), not negative. Infinite means that nothing yields; this is
        the default if neither `hardness` nor `f_c` is given.
    eta : float, optional
        Dynamic viscosity η (Pa·s), not negative; 0 (the default) means rate-independent.
    poisson : float or None, optional
        Poisson ratio ν of the half-space, −1 < ν ≤ 1/2, for the stress below the surface and for friction.
        The dashpots are exact for 1/2. None is a transversely isotropic half-space
        (`from_transversely_isotropic`), which supports neither.
    work_of_adhesion : float, optional
        Work of adhesion w (J/m²), not negative: the energy that separates a unit area of the surfaces.
        0 (the default) means no adhesion. Adhesion excludes viscosity, and yield of classes other than (b),
        in all entries of an ensemble.
    hardness : float or HardnessLaw, optional
        Constant hardness H of class (a) (Pa), finite and not negative: glass, metals, ceramics. Or a custom
        law σ_c(a), a `HardnessLaw`, without `q_c`, `f_c` and adhesion.
    f_c : float, optional
        Yield constant of class (c) (N = J/m), finite and not negative.

    Parameters may be arrays that broadcast, for many impacts at once; properties are then arrays.

    Raises
    ------
    ValueError
        If a parameter is not a number or out of its range, arrays do not broadcast, or the hardness is 0.
        If `q_c` is infinite and `hardness` or `f_c` positive, or `q_c` or `f_c` is given with a law. If
        `work_of_adhesion` is positive and one of `eta`, `hardness` and `f_c` is also positive, even in
        other entries. A calculation raises an error if a law is not valid at its contact radii.

    Examples
    --------
    >>> from mdr_core import Medium
    >>> medium = Medium(E_star=100e9, q_c=2000.0)
    >>> print(round(medium.critical_depth * 1e9, 6))  # π q_c / (2 E*), in nm
    31.415927
    >>> glass = Medium(E_star=70e9, hardness=9e9)
    >>> print(glass.q_c, glass.hardness_at(1e-6))
    0.0 9000000000.0
    """

    E_star: Parameter
    _: KW_ONLY
    q_c: Parameter = None
    eta: Parameter = 0.0
    poisson: Parameter | None = 0.5
    work_of_adhesion: Parameter = 0.0
    hardness: Any = None
    f_c: Parameter = None

    if TYPE_CHECKING:

        def __init__(
            self,
            E_star: ArrayLike,
            *,
            q_c: ArrayLike | None = None,
            eta: ArrayLike = 0.0,
            poisson: ArrayLike | None = 0.5,
            work_of_adhesion: ArrayLike = 0.0,
            hardness: ArrayLike | HardnessLaw | None = None,
            f_c: ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self):
        poisson = self.poisson
        if poisson is not None:
            poisson = check.frozen(poisson_ratio("Poisson ratio poisson", poisson))
        check.store(
            self,
            E_star=check.positive("effective modulus E_star", self.E_star, unit="Pa"),
            **hardness_constants(self.q_c, self.hardness, self.f_c),
            eta=check.positive("viscosity eta", self.eta, unit="Pa·s", zero=True),
            poisson=float(poisson) if isinstance(poisson, np.floating) else poisson,
            work_of_adhesion=check.positive(
                "work of adhesion work_of_adhesion", self.work_of_adhesion, unit="J/m²", zero=True
            ),
        )
        parameters = {name: value for name, value in self.__getstate__().items() if value is not None}
        if self.has_own_law:
            parameters |= {"hardness": np.empty(self.hardness.shape)}
        check.common_shape("medium", **parameters)
        refuse_sum(self)
        refuse_beside_adhesion(self)

    @classmethod
    @check.keywords_explained
    def from_hardness(
        cls, E_star: ArrayLike, hardness: ArrayLike, radius: ArrayLike, **other: ArrayLike
    ) -> "Medium":
        """Make a medium of class (b) from a hardness measured at one contact radius: q_c = σ_c a.

        For a hardness that is the same at every radius, take `Medium(E_star, hardness=…)`.

        Parameters
        ----------
        E_star : float
            Effective modulus E* (Pa).
        hardness : float
            Mean pressure σ_c (Pa) under a fully yielded contact, Popov (2015), Eq. (11).
        radius : float
            Contact radius a (m) of the measurement.
        **other
            `eta`, `poisson` and `work_of_adhesion`, as in `Medium`.

        Raises
        ------
        ValueError
            If a parameter is out of its range, or `q_c` or `f_c` is also given.

        Examples
        --------
        >>> from mdr_core import Medium
        >>> print(Medium.from_hardness(95e9, hardness=1e9, radius=100e-9).q_c)
        100.0
        """
        if "q_c" in other or "f_c" in other:
            raise check.MDRError(
                "q_c or f_c and hardness both determine the onset of yield; give one of them"
            )
        hardness = check.positive("hardness", hardness, unit="Pa")
        radius = check.positive("radius of the hardness", radius, unit="m")
        check.common_shape("medium", hardness=hardness, radius=radius)
        return cls(E_star, q_c=hardness * radius, **other)

    @classmethod
    @check.keywords_explained
    def from_critical_depth(
        cls, E_star: ArrayLike, critical_depth: ArrayLike, **other: ArrayLike
    ) -> "Medium":
        """Make a medium of class (b) in which yield starts at a given depth: q_c = 2E* d_c/π, Eq. (19).

        Parameters
        ----------
        E_star : float
            Effective modulus E* (Pa).
        critical_depth : float
            Indentation depth d_c (m) at which yield starts; also the recovered depth on unloading.
        **other
            `eta`, `poisson` and `work_of_adhesion`, as in `Medium`.

        Raises
        ------
        ValueError
            If a parameter is out of its range, or `q_c`, `hardness` or `f_c` is also given.

        Examples
        --------
        >>> from mdr_core import Medium
        >>> medium = Medium.from_critical_depth(1e9, critical_depth=2e-9)
        >>> print(round(medium.q_c, 9), round(medium.critical_depth * 1e9, 9))
        1.273239545 2.0
        """
        if {"q_c", "hardness", "f_c"} & other.keys():
            raise check.MDRError(
                "q_c, hardness or f_c and critical_depth both determine the onset of yield; give one"
            )
        E_star = check.positive("effective modulus E_star", E_star, unit="Pa")
        depth = check.positive("critical depth", critical_depth, unit="m")
        check.common_shape("medium", E_star=E_star, critical_depth=depth)
        return cls(E_star, q_c=yield_constant(E_star, depth), **other)

    @classmethod
    @check.keywords_explained
    def from_bodies(
        cls,
        E1: ArrayLike,
        nu1: ArrayLike,
        E2: ArrayLike = np.inf,
        nu2: ArrayLike = 0.0,
        *,
        q_c: ArrayLike | None = None,
        eta: ArrayLike = 0.0,
        work_of_adhesion: ArrayLike = 0.0,
        hardness: "ArrayLike | HardnessLaw | None" = None,
        f_c: ArrayLike | None = None,
    ) -> "Medium":
        """Make the medium that is equivalent to two elastic bodies in contact.

        1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Popov (2015), Eq. (2).

        Parameters
        ----------
        E1, E2 : float
            Young's moduli (Pa), positive; infinite for a rigid body. Not both infinite.
        nu1, nu2 : float
            Poisson ratios, −1 < ν ≤ 1/2. The first is the medium's `poisson`: stresses are in body 1.
        q_c, eta, work_of_adhesion, hardness, f_c : float
            As in `Medium`.

        Raises
        ------
        ValueError
            If a parameter is out of its range, or both bodies are rigid.

        Examples
        --------
        >>> from mdr_core import Medium
        >>> print(round(Medium.from_bodies(210e9, 0.3).E_star / 1e9, 6))  # steel under a rigid indenter
        230.769231
        """
        check.common_shape("medium", E1=E1, nu1=nu1, E2=E2, nu2=nu2)
        compliance = 0.0
        for i, (modulus, ratio) in enumerate(((E1, nu1), (E2, nu2)), start=1):
            modulus = check.positive(f"Young's modulus E{i}", modulus, unit="Pa", infinite=True)
            ratio = poisson_ratio(f"Poisson ratio nu{i}", ratio)
            compliance = compliance + (1 - ratio) * (1 + ratio) / modulus
        if np.any(compliance == 0):
            raise check.MDRError("E1 and E2 are both infinite; at least one body must be elastic")
        other = {"q_c": q_c, "hardness": hardness, "f_c": f_c, "work_of_adhesion": work_of_adhesion}
        return cls(1 / compliance, eta=eta, poisson=nu1, **other)

    @classmethod
    @check.keywords_explained
    def from_transversely_isotropic(
        cls,
        E_in_plane: ArrayLike,
        E_axial: ArrayLike,
        nu_in_plane: ArrayLike,
        nu_axial: ArrayLike,
        G_axial: ArrayLike,
        *,
        q_c: ArrayLike | None = None,
        hardness: "ArrayLike | HardnessLaw | None" = None,
        f_c: ArrayLike | None = None,
        eta: ArrayLike = 0.0,
        work_of_adhesion: ArrayLike = 0.0,
    ) -> "Medium":
        """Make the medium of a laminate, a ply, wood or a crystal that is isotropic in its surface plane.

        A rigid indenter presses it along its axis of symmetry. It has the exact
        E* = 2 √((C₁₁C₃₃ − C₁₃²)/C₁₁ / (1/C₄₄ + 2/(√(C₁₁C₃₃) + C₁₃))) with its stiffnesses C (Hanson 1992;
        Delafargue and Ulm 2004). Its `poisson` is None: the stress below the surface and friction need more
        constants than E*, and raise an error.

        Parameters
        ----------
        E_in_plane, E_axial : float
            Young's moduli E_p in the plane of the surface and E_z along the axis (Pa), positive.
        nu_in_plane : float
            Poisson ratio ν_p in the plane, −1 < ν_p < 1.
        nu_axial : float
            Poisson ratio ν_zp for a stress along the axis: strain in the plane over strain along the axis,
            ε_p = −ν_zp σ_z/E_z. It is ν_pz E_z/E_p. 1 − ν_p − 2ν_zp² E_p/E_z must be positive, or 0 for an
            incompressible medium.
        G_axial : float
            Shear modulus G_z (Pa) of planes that contain the axis, positive.
        eta : float, optional
            Dynamic viscosity η (Pa·s). All elastic constants relax with the same time τ = 4η/E*.
        q_c, hardness, f_c, work_of_adhesion : float, optional
            As in `Medium`.

        Raises
        ------
        ValueError
            If a parameter is out of its range, or no material can have these constants together.

        Examples
        --------
        A quasi-isotropic carbon laminate, through its thickness:

        >>> from mdr_core import Medium
        >>> laminate = Medium.from_transversely_isotropic(52e9, 9e9, 0.31, 0.06, 4e9)
        >>> print(round(laminate.E_star / 1e9, 4))
        10.7269
        """
        E_star = effective_modulus(E_in_plane, E_axial, nu_in_plane, nu_axial, G_axial)
        other = {"q_c": q_c, "hardness": hardness, "f_c": f_c, "work_of_adhesion": work_of_adhesion}
        return cls(E_star, eta=eta, poisson=None, **other)

    @property
    def inverse_to_radius(self) -> bool:
        """Whether the hardness is q_c/a alone, class (b) of the paper, or nothing yields."""
        return not (self.has_own_law or np.any(self.hardness) or np.any(self.f_c))

    @property
    def has_own_law(self) -> bool:
        """Whether `hardness` is a `HardnessLaw` instead of a constant."""
        return isinstance(self.hardness, HardnessLaw)

    @property
    def law(self) -> HardnessLaw:
        """The law of hardness σ_c(a): `hardness` if it is a law, else the sum of the three classes."""
        return self.hardness if self.has_own_law else SumOfClasses(self.hardness, self.q_c, self.f_c)

    @property
    def critical_depth(self) -> Array:
        """Indentation depth d_c = π q_c/(2E*) (m) at which yield starts, Popov (2015), Eq. (19).

        For class (b) only. For any class, use `mdr_core.yield_depth(profile, medium)`.
        """
        refuse_other_classes(self, "the critical depth", "take yield_depth(profile, medium)")
        return critical_depth(self.E_star, self.q_c)

    @property
    def yield_line_load(self) -> Array:
        """Largest line load π q_c/2 (N/m) that a 1D element carries, Popov (2015), Eq. (12).

        For class (b) only. For any class it is π a σ_c(a)/2 in a contact of radius a, with `hardness_at`.
        """
        refuse_other_classes(self, "the largest line load", "it is π a σ_c(a)/2 by hardness_at(a)")
        return np.pi / 2 * self.q_c

    def hardness_at(self, radius: ArrayLike) -> Array:
        """Return the hardness σ_c = H + q_c/a + f_c/a² (Pa) at a contact radius a (m).

        See Popov (2015), section 1. With a law of hardness it is the value of the law. It is the mean
        pressure under a fully yielded contact; infinite if nothing yields.

        Examples
        --------
        >>> from mdr_core import Medium
        >>> print(Medium(E_star=1e9, q_c=2.0, hardness=1e6).hardness_at(1e-6))
        3000000.0
        """
        a = check.positive("radius", radius, unit="m")
        check.common_shape("hardness_at", radius=a, medium=np.empty(self.shape))
        law = self.law
        hardness = lazy.law.law_numbers(law, "at", a) if self.has_own_law else law.at(a)
        bound = "must be above 0"
        check.raise_if("hardness", hardness, ~(hardness > 0), bound, unit="Pa", advice="correct the law")
        return check.frozen(hardness + np.zeros(np.shape(a)))

    @property
    def relaxation_time(self) -> Array:
        """Relaxation time τ = 4η/E* (s) of a spring and its dashpot, Popov (2015), Eq. (1)."""
        return 4 * self.eta / self.E_star

    @property
    def tangential_ratio(self) -> Array:
        """Tangential over normal stiffness, Mindlin's κ = 2(1 − ν)/(2 − ν): 2/3 for ν = 1/2."""
        refuse_transversely_isotropic(self, "the tangential stiffness")
        return 2 * (1 - self.poisson) / (2 - self.poisson)
