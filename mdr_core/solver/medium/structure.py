"""The structure behind the medium, which gives way under the contact: a plate, a rod or a support.

A body presses the medium by d = y − w, where y is its way and w the deflection of the structure under the
contact. With the contact force F there are two models, one at a time.

A plate without edges, and the end of a long rod, carry waves away that do not come back:

    dw/dt = F/Z        energy carried away ∫F²/Z dt

with the impedance Z (N·s/m). A thin plate of bending stiffness D (N·m) and mass ρh per area (kg/m²) has
Z = 8√(D ρh) (Boussinesq; Zener 1941), a rod of cross-section A has Z = A√(Eρ). A support whose mass does
not matter has a stiffness K (N/m): w = F/K.
"""

from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from ...base import check
from ...base.check import ArrayLike, Parameter


@dataclass(frozen=True, eq=False)
class Structure(check.Parameters):
    """What carries the medium: a plate or a rod, by its impedance, or a support, by its stiffness.

    Give one of the two. In series they are not a plate on its support: under a constant force an endless
    plate would go on for ever. Take the plate for a light and fast body, whose contact is over before the
    waves are back from the edges, and the support for a body at least as heavy as the plate. Between a
    tenth of the mass of the plate and all of it neither model holds.

    Parameters
    ----------
    impedance : float, optional
        Impedance Z (N·s/m) of a plate without edges or of a long rod, positive; infinite, the default, is
        rigid. `plate`, `laminate` and `rod` compute it.
    stiffness : float, optional
        Static stiffness K (N/m) of a support under the contact, positive; infinite, the default, is rigid.
        A clamped disc of radius R in its middle has 16π D/R², a simply supported square D/(0.0116 L²), a
        simply supported beam 48 E I/L³.
    edge : float, optional
        Distance (m) from the point of contact to the nearest edge of the plate.
    thickness : float, optional
        Thickness h (m) of the plate.
    wave_spread : float, optional
        √(D/ρh) (m²/s) of the plate: bending waves are back from the edge after (2 edge)²/(7.70 √(D/ρh)).
    shear_speed : float, optional
        Speed (m/s) of shear waves in the plate.

    The last four change no number of an impact. `hit.limits` compares with them what the model neglects:
    the edges, and the thickness. None means that a value is not known. Parameters may be arrays that
    broadcast.

    Raises
    ------
    ValueError
        If a parameter is not a positive number, both `impedance` and `stiffness` are finite, or arrays do
        not broadcast.

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
            edge: ArrayLike | None = None,
            thickness: ArrayLike | None = None,
            wave_spread: ArrayLike | None = None,
            shear_speed: ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self):
        units = {"impedance": "N·s/m", "stiffness": "N/m"}
        told = {"edge": "m", "thickness": "m", "wave_spread": "m²/s", "shear_speed": "m/s"}
        units |= {name: unit for name, unit in told.items() if getattr(self, name) is not None}
        for name, unit in units.items():
            infinite = name not in told
            value = check.positive(name, getattr(self, name), unit=unit, infinite=infinite)
            check.store(self, **{name: value})
        shape = check.common_shape("structure", **{name: getattr(self, name) for name in units})
        stiffness = np.broadcast_to(self.stiffness, shape)
        both = np.isfinite(self.impedance) & np.isfinite(stiffness)
        bound = (
            "is finite beside a finite impedance: in series they are not a plate on its support, because "
            "an endless plate goes on for ever under a constant force"
        )
        advice = (
            "take the impedance for a light and fast body, whose contact is over before waves are back "
            "from the edges, or the stiffness for a body at least as heavy as the plate"
        )
        check.refuse("stiffness", stiffness, both, bound, unit="N/m", advice=advice)

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
        """A thin isotropic plate without edges: Z = 8√(D ρh) with D = E h³/(12 (1 − ν²)).

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
        nu = check.finite_array("Poisson ratio nu", nu)
        check.refuse("Poisson ratio nu", nu, (nu <= -1) | (nu >= 0.5), "must lie in −1 < ν < 0.5")
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
        """A thin orthotropic plate without edges, by its bending stiffnesses; exact without D₁₆ and D₂₆.

        Z = 8√(D m″) with the mass per area m″ and

            √D = (D₁₁ D₂₂)^(1/4) (π/2)/K((1 − A)/2)        A = (D₁₂ + 2 D₆₆)/√(D₁₁ D₂₂)

        where K is the complete elliptic integral of a parameter. 1/√D is the mean over all directions θ of
        1/√D(θ), D(θ) = D₁₁ cos⁴θ + 2 (D₁₂ + 2 D₆₆) cos²θ sin²θ + D₂₂ sin⁴θ. D₁₆ and D₂₆, which couple
        bending with twist, are left out: they are 0 in cross-ply laminates and small where layers
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
        D11 = check.positive("bending stiffness D11", D11, unit="N·m")
        D22 = check.positive("bending stiffness D22", D22, unit="N·m")
        D66 = check.positive("bending stiffness D66", D66, unit="N·m")
        D12 = check.finite_array("bending stiffness D12", D12, unit="N·m")
        mass = check.positive("mass_per_area", mass_per_area, unit="kg/m²")
        shape = check.common_shape("laminate", D11=D11, D12=D12, D22=D22, D66=D66, mass_per_area=mass)
        root = np.sqrt(D11) * np.sqrt(D22)
        bound = "is not below √(D11 D22): no laminate has such stiffnesses"
        D12 = np.broadcast_to(D12, shape)
        check.refuse(
            "bending stiffness D12", D12, np.abs(D12) >= root, bound, unit="N·m", advice="check it"
        )
        mean = np.sqrt(root) * (np.pi / 2) / scipy.special.ellipk((1 - (D12 + 2 * D66) / root) / 2)
        return cls(
            8 * np.sqrt(mass) * mean,
            edge=edge,
            thickness=thickness,
            # Of the faster of both waves along the axes.
            wave_spread=np.sqrt(np.maximum(D11, D22) / mass),
        )

    @classmethod
    @check.keywords_explained
    def rod(cls, area: ArrayLike, E: ArrayLike, density: ArrayLike) -> "Structure":
        """The end of a long rod that is hit along its axis: Z = A√(E ρ).

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

    @property
    def is_plate(self) -> Any:
        """Whether it carries waves away, as a plate or a rod does; an array for an ensemble."""
        return np.isfinite(self.impedance)

    @property
    def is_support(self) -> Any:
        """Whether it is a support that gives way; an array for an ensemble."""
        return np.isfinite(self.stiffness)

    @property
    def rigid(self) -> bool:
        """Whether nothing gives way, in no row of an ensemble: it is as if there were no structure."""
        return not (np.any(self.is_plate) or np.any(self.is_support))


#: No structure: the body behind the medium is at rest.
RIGID = Structure()


def structure_of(structure: Structure | None) -> Structure:
    """The structure of an impact, a rigid one where none is given; with an error on anything else."""
    if structure is None:
        return RIGID
    if not isinstance(structure, Structure):
        raise TypeError(
            f"structure must be a Structure such as Structure.plate(…), got {check.shown(structure)}"
        )
    return structure
