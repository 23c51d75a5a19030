"""The structure behind the medium, which deflects under the contact: a plate, a rod, a support, or modes.

A body indents the medium by d = y − w, with the displacement y of the body and the deflection w of the
structure under the contact. With the contact force F there are three models, one at a time.

A plate without edges, and the end of a long rod, carry waves away that do not come back:

    dw/dt = F/Z        energy carried away ∫F²/Z dt

with the impedance Z (N·s/m). A thin plate of bending stiffness D (N·m) and mass ρh per area (kg/m²) has
Z = 8√(D ρh) (Boussinesq; Zener 1941). A rod of cross-section A has Z = A√(Eρ). A support with a negligible
mass has a stiffness K (N/m): w = F/K. A structure with edges has modes (`modes`), and its waves come back.
"""

from dataclasses import KW_ONLY, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from ...base import check
from ...base.check import ArrayLike, Parameter
from .modes import Modes, compliance_of_plate, modes_of_beam, modes_of_plate


@dataclass(frozen=True, eq=False)
class Structure(check.Parameters):
    """Structure that carries the medium: a plate without edges, a support without mass, or modes.

    The first two are limits. A plate without edges (or a rod) is right for a light and fast body: its
    contact ends before the waves return from the edges. A support without mass is right if the contact is
    slow or yields. The general case is a structure with modes: `modal`, `supported_plate`,
    `supported_isotropic_plate`, `beam`. `hit.limits` reports if a limit does not hold.

    Parameters
    ----------
    impedance : float, optional
        Impedance Z (N·s/m) of a plate without edges or of a long rod, positive; infinite, the default, is
        rigid. `plate`, `laminate` and `rod` compute it.
    stiffness : float, optional
        Static stiffness K (N/m) of a support under the contact, positive; infinite, the default, is rigid.
        In its middle, a clamped disc of radius R has 16π D/R², a simply supported square D/(0.0116 L²), and
        a simply supported beam 48 E I/L³. With modes it is the stiffness of the whole structure.
    modes : Modes, optional
        Modes of a structure with edges, made by `modal`.
    mass : float, optional
        Mass (kg) that moves with a support: a quarter of the mass of a plate, half of the mass of a beam.
    edge : float, optional
        Distance (m) from the point of contact to the nearest edge of the plate.
    thickness : float, optional
        Thickness h (m) of the plate.
    wave_spread : float, optional
        √(D/ρh) (m²/s) of the plate: bending waves return from the edge after (2 edge)²/(7.70 √(D/ρh)).
    shear_speed : float, optional
        Speed (m/s) of shear waves in the plate.

    The last five parameters do not change the results of an impact. `hit.limits` uses them for effects that
    the model neglects: the mass of a support, the edges, and the thickness. None means an unknown value.
    Parameters may be arrays that broadcast; modes belong to one structure.

    Raises
    ------
    ValueError
        If a parameter is not a positive number, `impedance` is finite together with `stiffness` or `modes`,
        the stiffness is above the stiffness of the modes alone, or arrays do not broadcast.

    Examples
    --------
    A steel ball of 10 mm at 5 m/s on 4 mm of a carbon laminate returns with 0.39 of its speed:

    >>> from mdr_core import Medium, Paraboloid, Structure, impact
    >>> plate = Structure.laminate(D11=293.0, D12=87.9, D22=293.0, D66=102.55, mass_per_area=6.4)
    >>> hit = impact(Paraboloid(radius=5e-3), Medium(10e9), mass=4.1e-3, speed=5.0, structure=plate)
    >>> print(round(plate.impedance, 1), round(hit.restitution, 2))
    346.4 0.39
    """

    impedance: Parameter = np.inf
    stiffness: Parameter = np.inf
    _: KW_ONLY
    modes: Modes | None = None
    mass: Parameter | None = None
    edge: Parameter | None = None
    thickness: Parameter | None = None
    wave_spread: Parameter | None = None
    shear_speed: Parameter | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            impedance: ArrayLike = np.inf,
            stiffness: ArrayLike = np.inf,
            *,
            modes: Modes | None = None,
            mass: ArrayLike | None = None,
            edge: ArrayLike | None = None,
            thickness: ArrayLike | None = None,
            wave_spread: ArrayLike | None = None,
            shear_speed: ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self):
        units = {"impedance": "N·s/m", "stiffness": "N/m"}
        told = {"mass": "kg", "edge": "m", "thickness": "m", "wave_spread": "m²/s", "shear_speed": "m/s"}
        units |= {name: unit for name, unit in told.items() if getattr(self, name) is not None}
        for name, unit in units.items():
            infinite = name not in told
            value = check.positive(name, getattr(self, name), unit=unit, infinite=infinite)
            check.store(self, **{name: value})
        shape = check.common_shape("structure", **{name: getattr(self, name) for name in units})
        stiffness = np.broadcast_to(self.stiffness, shape)
        both = np.isfinite(self.impedance) & np.isfinite(stiffness)
        bound = (
            "must be infinite with a finite impedance: in series they do not model a plate on its support, "
            "because an endless plate moves forever under a constant force"
        )
        advice = "give modes, by Structure.supported_plate or Structure.modal"
        check.raise_if("stiffness", stiffness, both, bound, unit="N/m", advice=advice)
        if self.modes is not None:
            self._check_modes(shape)

    def _check_modes(self, shape):
        """Raise an error for modes with arrays or an impedance, or modes softer than the stiffness."""
        if not isinstance(self.modes, Modes):
            raise TypeError(f"modes must be made by Structure.modal, got {check.shown(self.modes)}")
        if shape:
            raise check.MDRError(
                f"a structure with modes needs numbers, not parameters of shape {shape}; give numbers"
            )
        impedance = np.asarray(self.impedance)
        bound, advice = "must be infinite with modes, which carry the waves", "leave it out"
        check.raise_if("impedance", impedance, np.isfinite(impedance), bound, unit="N·s/m", advice=advice)
        if self.stiffness < np.inf and self.residual_compliance < -1e-9 / self.stiffness:
            soft = 1 / self.modes.compliance
            bound = f"must not exceed {soft:g} N/m, the stiffness of the given modes: more modes are softer"
            advice = "check modal masses and frequencies, or leave the stiffness out"
            if not soft:
                bound, advice = (
                    "must be infinite with a rigid motion, a mode of frequency 0",
                    "leave it out",
                )
            stiffness = np.asarray(self.stiffness)
            check.raise_if("stiffness", stiffness, True, bound, unit="N/m", advice=advice)

    @classmethod
    @check.keywords_explained
    def plate(
        cls,
        thickness: ArrayLike,
        E: ArrayLike,
        nu: ArrayLike,
        density: ArrayLike,
        *,
        edge: ArrayLike | None = None,
    ) -> "Structure":
        """Make a thin isotropic plate without edges: Z = 8√(D ρh) with D = E h³/(12 (1 − ν²)).

        Parameters
        ----------
        thickness : float
            Thickness h (m).
        E : float
            Young's modulus (Pa).
        nu : float
            Poisson ratio, −1 < ν < 1/2.
        density : float
            Density ρ (kg/m³).
        edge : float, optional
            Distance (m) from the point of contact to the nearest edge, for `hit.limits`.

        Examples
        --------
        >>> from mdr_core import Structure
        >>> print(round(Structure.plate(2e-3, E=70e9, nu=0.33, density=2700.0).impedance, 2))
        134.53
        """
        thickness = check.positive("thickness", thickness, unit="m")
        modulus = check.positive("Young's modulus E", E, unit="Pa")
        nu = _poisson(nu)
        density = check.positive("density", density, unit="kg/m³")
        check.common_shape("plate", thickness=thickness, E=modulus, nu=nu, density=density)
        # √(D/ρh) over h, and √(D ρh) over h².
        speed = np.sqrt(modulus / density / 12 / (1 - nu) / (1 + nu))
        return cls(
            8 * density * thickness * thickness * speed,
            edge=edge,
            thickness=thickness,
            wave_spread=thickness * speed,
            shear_speed=np.sqrt(modulus / density / 2 / (1 + nu)),
        )

    @classmethod
    @check.keywords_explained
    def laminate(
        cls,
        D11: ArrayLike,
        D12: ArrayLike,
        D22: ArrayLike,
        D66: ArrayLike,
        mass_per_area: ArrayLike,
        *,
        edge: ArrayLike | None = None,
        thickness: ArrayLike | None = None,
    ) -> "Structure":
        """Make a thin orthotropic plate without edges from its bending stiffnesses.

        It is exact without D₁₆ and D₂₆.

        Z = 8√(D m″) with the mass per area m″ and

            √D = (D₁₁ D₂₂)^(1/4) (π/2)/K((1 − A)/2)        A = (D₁₂ + 2 D₆₆)/√(D₁₁ D₂₂)

        where K is the complete elliptic integral as a function of the parameter. 1/√D is the mean over all
        directions θ of 1/√D(θ), D(θ) = D₁₁ cos⁴θ + 2 (D₁₂ + 2 D₆₆) cos²θ sin²θ + D₂₂ sin⁴θ. D₁₆ and D₂₆,
        which couple bending with twist, are left out. They are 0 in cross-ply laminates and small if layers
        alternate.

        Parameters
        ----------
        D11, D12, D22, D66 : float
            Bending stiffnesses (N·m) of laminate theory, with D₁₁, D₂₂, D₆₆ positive and D₁₁ D₂₂ > D₁₂².
        mass_per_area : float
            Mass per area (kg/m²).
        edge, thickness : float, optional
            Distance (m) from the point of contact to the nearest edge, and thickness (m), for `hit.limits`.

        Examples
        --------
        >>> from mdr_core import Structure
        >>> print(round(Structure.laminate(135.0, 2.7, 9.0, 5.0, mass_per_area=3.2).impedance, 3))
        76.962
        """
        mass = check.positive("mass_per_area", mass_per_area, unit="kg/m²")
        D11, D12, D22, D66 = _of_laminate(D11, D12, D22, D66, mass_per_area=mass)
        root = np.sqrt(D11) * np.sqrt(D22)
        mean = np.sqrt(root) * (np.pi / 2) / scipy.special.ellipk((1 - (D12 + 2 * D66) / root) / 2)
        return cls(
            8 * np.sqrt(mass) * mean,
            edge=edge,
            thickness=thickness,
            # The faster of both waves along the axes.
            wave_spread=np.sqrt(np.maximum(D11, D22) / mass),
        )

    @classmethod
    @check.keywords_explained
    def rod(cls, area: ArrayLike, E: ArrayLike, density: ArrayLike) -> "Structure":
        """Make the end of a long rod, hit along its axis: Z = A√(E ρ).

        Parameters
        ----------
        area : float
            Cross-section A (m²).
        E : float
            Young's modulus (Pa).
        density : float
            Density ρ (kg/m³).

        Examples
        --------
        >>> from mdr_core import Structure
        >>> print(round(Structure.rod(area=1e-4, E=200e9, density=8000.0).impedance, 6))
        4000.0
        """
        area = check.positive("area", area, unit="m²")
        modulus = check.positive("Young's modulus E", E, unit="Pa")
        density = check.positive("density", density, unit="kg/m³")
        check.common_shape("rod", area=area, E=modulus, density=density)
        return cls(area * np.sqrt(modulus) * np.sqrt(density))

    @classmethod
    @check.keywords_explained
    def modal(
        cls,
        frequency: ArrayLike,
        mass: ArrayLike,
        *,
        damping: ArrayLike = 0.0,
        stiffness: float | None = None,
        thickness: float | None = None,
    ) -> "Structure":
        """Make a structure from computed or measured modes, such as the list of a finite-element program.

        Parameters
        ----------
        frequency : array_like
            Natural frequencies (Hz); 0 is a rigid motion, for example of a plate that hangs on threads.
        mass : array_like
            Modal masses (kg) at the contact: M/φ² for a mode of modal mass M with the displacement φ there,
            and 1/φ² for a mode normalized by mass.
        damping : array_like, optional
            Damping ratios, 0 ≤ ζ < 1.
        stiffness : float, optional
            Static stiffness K (N/m) at the contact. The difference of 1/K and the compliance of the given
            modes acts without delay. Nine modes with K are as good as a thousand modes without K.
        thickness : float, optional
            Thickness (m), for `hit.limits`.

        Examples
        --------
        A body of 0.1 kg on a light mass of 0.1 g on a spring:

        >>> import numpy as np
        >>> from mdr_core import Medium, Paraboloid, Structure, impact
        >>> spring = Structure.modal(np.sqrt(1e5 / 1e-4) / (2 * np.pi), 1e-4)
        >>> hit = impact(Paraboloid(radius=8e-3), Medium(10e9), 0.1, 1.0, structure=spring)
        >>> print(round(hit.restitution, 6), hit.contacts)
        0.999592 14
        """
        modes = Modes(frequency, mass, damping)
        return cls(stiffness=np.inf if stiffness is None else stiffness, modes=modes, thickness=thickness)

    @classmethod
    @check.keywords_explained
    def supported_plate(
        cls,
        width: float,
        length: float,
        D11: float,
        D12: float,
        D22: float,
        D66: float,
        mass_per_area: float,
        *,
        at: tuple[float, float] = (0.5, 0.5),
        damping: float = 0.0,
        modes: int = 100,
        thickness: float | None = None,
    ) -> "Structure":
        """Make a rectangular orthotropic plate, simply supported at its edges.

        It has Navier's modes and Lévy's stiffness.

        Parameters
        ----------
        width, length : float
            Sides a and b (m), along the first and the second axis of the laminate.
        D11, D12, D22, D66 : float
            Bending stiffnesses (N·m), as for `laminate`.
        mass_per_area : float
            Mass per area (kg/m²).
        at : tuple of float, optional
            Point of contact as shares of the sides, each between 0 and 1; by default the middle.
        damping : float, optional
            Damping ratio of all modes.
        modes : int, optional
            Number of modes with inertia: the lowest modes without a node at the contact. The other modes
            act without delay.
        thickness : float, optional
            Thickness (m), for `hit.limits`.

        Examples
        --------
        >>> from mdr_core import Structure
        >>> plate = Structure.supported_plate(0.2, 0.2, 131.4, 3.867, 77.28, 8.92, 4.25)
        >>> print(f"{plate.stiffness:.5g} N/m, {plate.modes.frequency[0]:.4g} Hz")
        1.393e+05 N/m, 302.4 Hz
        """
        sides = [check.positive_number(*each, unit="m") for each in (("width", width), ("length", length))]
        mass = check.positive_number("mass_per_area", mass_per_area, unit="kg/m²")
        D11, D12, D22, D66 = _of_laminate(D11, D12, D22, D66)
        if np.shape(D12):
            raise check.MDRError("a structure with modes needs numbers: give single bending stiffnesses")
        if np.shape(at) != (2,):
            raise check.MDRError(
                f"at must be two shares of the sides, such as (0.5, 0.5), got {check.shown(at)}"
            )
        at = [_inside("at", share) for share in at]
        stiffness = float(D11), float(D12 + 2 * D66), float(D22)
        frequency, modal = modes_of_plate(np.array(sides), stiffness, mass, at, _count(modes))
        K = 1 / compliance_of_plate(sides, stiffness, at)
        return cls.modal(frequency, modal, damping=damping, stiffness=K, thickness=thickness)

    @classmethod
    @check.keywords_explained
    def supported_isotropic_plate(
        cls,
        width: float,
        length: float,
        thickness: float,
        E: float,
        nu: float,
        density: float,
        *,
        at: tuple[float, float] = (0.5, 0.5),
        damping: float = 0.0,
        modes: int = 100,
    ) -> "Structure":
        """Make a rectangular isotropic plate, simply supported at its edges, by `supported_plate`.

        Parameters
        ----------
        width, length, thickness : float
            Sides and thickness h (m).
        E, nu, density : float
            Young's modulus (Pa), Poisson ratio, density (kg/m³).
        at, damping, modes : optional
            As for `supported_plate`.

        Examples
        --------
        >>> from mdr_core import Structure
        >>> plate = Structure.supported_isotropic_plate(0.12, 0.12, 4e-3, E=50e9, nu=0.3, density=1600.0)
        >>> print(f"{plate.stiffness:.6g} N/m")  # D/(0.0116008 L²)
        1.75419e+06 N/m
        """
        h = check.positive_number("thickness", thickness, unit="m")
        modulus = check.positive_number("Young's modulus E", E, unit="Pa")
        nu = float(_poisson(nu))
        density = check.positive_number("density", density, unit="kg/m³")
        D = modulus * h**3 / 12 / (1 - nu) / (1 + nu)
        given = {"at": at, "damping": damping, "modes": modes, "thickness": h}
        plate = cls.supported_plate(width, length, D, nu * D, D, (1 - nu) / 2 * D, density * h, **given)
        return replace(plate, shear_speed=np.sqrt(modulus / density / 2 / (1 + nu)))

    @classmethod
    @check.keywords_explained
    def beam(
        cls,
        length: float,
        bending_stiffness: float,
        mass_per_length: float,
        *,
        at: float = 0.5,
        damping: float = 0.0,
        modes: int = 50,
        thickness: float | None = None,
    ) -> "Structure":
        """Make a simply supported beam, with the static stiffness K = 3 E I L/(x (L − x))².

        Parameters
        ----------
        length : float
            Length L (m).
        bending_stiffness : float
            Bending stiffness E I (N·m²).
        mass_per_length : float
            Mass per length (kg/m).
        at : float, optional
            Point of contact x/L, between 0 and 1.
        damping, modes, thickness : optional
            As for `supported_plate`.

        Examples
        --------
        >>> from mdr_core import Structure
        >>> print(round(Structure.beam(1.0, 100.0, 1.0).stiffness))  # 48 E I/L³
        4800
        """
        L = check.positive_number("length", length, unit="m")
        EI = check.positive_number("bending_stiffness", bending_stiffness, unit="N·m²")
        mass, share = (
            check.positive_number("mass_per_length", mass_per_length, unit="kg/m"),
            _inside("at", at),
        )
        frequency, modal = modes_of_beam(L, EI, mass, share, _count(modes))
        K = 3 * EI / L**3 / (share * (1 - share)) ** 2
        return cls.modal(frequency, modal, damping=damping, stiffness=K, thickness=thickness)

    @property
    def residual_compliance(self) -> float:
        """Compliance r (m/N) of the omitted modes: 1/K minus the compliance of the given modes."""
        return 1 / float(self.stiffness) - self.modes.compliance if self.stiffness < np.inf else 0.0

    @property
    def is_plate(self) -> Any:
        """Whether it carries waves away, like a plate or a rod; an array for an ensemble."""
        return np.isfinite(self.impedance)

    @property
    def is_support(self) -> Any:
        """Whether it is an elastic support without mass; an array for an ensemble."""
        return np.isfinite(self.stiffness) & (self.modes is None)

    @property
    def rigid(self) -> bool:
        """Whether all entries of an ensemble are rigid, which means no structure."""
        return self.modes is None and not (np.any(self.is_plate) or np.any(self.is_support))


def _poisson(nu):
    """Return a Poisson ratio, −1 < ν < 1/2; raise an error otherwise."""
    nu = check.finite_array("Poisson ratio nu", nu)
    check.raise_if("Poisson ratio nu", nu, (nu <= -1) | (nu >= 0.5), "must lie in −1 < ν < 0.5")
    return nu


def _of_laminate(D11, D12, D22, D66, **beside):
    """Return valid bending stiffnesses (N·m) of a laminate, which broadcast with the other arguments."""
    D11 = check.positive("bending stiffness D11", D11, unit="N·m")
    D22 = check.positive("bending stiffness D22", D22, unit="N·m")
    D66 = check.positive("bending stiffness D66", D66, unit="N·m")
    D12 = check.finite_array("bending stiffness D12", D12, unit="N·m")
    shape = check.common_shape("laminate", D11=D11, D12=D12, D22=D22, D66=D66, **beside)
    bound = "must be below √(D11 D22) in size: no laminate has such stiffnesses"
    bad, D12 = np.abs(D12) >= np.sqrt(D11) * np.sqrt(D22), np.broadcast_to(D12, shape)
    check.raise_if("bending stiffness D12", D12, bad, bound, unit="N·m", advice="check it")
    return D11, D12, D22, D66


def _inside(name, share):
    """Return a share of a side between 0 and 1; raise an error otherwise."""
    share = check.positive_number(name, share)
    bound = "must lie between 0 and 1; 0.5 is the middle"
    check.raise_if(name, np.asarray(share), share >= 1, bound)
    return share


def _count(modes):
    """Return a valid number of modes."""
    if isinstance(modes, bool) or not isinstance(modes, int | np.integer) or not 1 <= modes <= 10_000:
        raise check.MDRError(f"modes = {check.shown(modes)} must be a whole number from 1 to 10,000")
    return int(modes)


#: No structure: the body behind the medium is at rest.
RIGID = Structure()


def structure_of(structure: Structure | None) -> Structure:
    """Return the structure of an impact, rigid for None; raise an error on anything else."""
    if structure is None:
        return RIGID
    if not isinstance(structure, Structure):
        raise TypeError(
            f"structure must be a Structure such as Structure.plate(…), got {check.shown(structure)}"
        )
    return structure
