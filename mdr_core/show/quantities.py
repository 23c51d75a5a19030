"""Names, symbols and units of all quantities, and the text of their values."""

from dataclasses import dataclass

import numpy as np

from ..base import check
from ..solver.medium.modes import Modes
from ..solver.medium.structure import Structure
from .units import KINDS, Unit, fitting, with_unit


@dataclass(frozen=True)
class Quantity:
    """Symbol, unit and long name of a quantity."""

    symbol: str
    unit: str
    long_name: str

    @property
    def title(self):
        """Symbol and long name, for an axis."""
        return f"{self.symbol}, {self.long_name}"

    @property
    def attributes(self):
        """Attributes of the variable in an xarray.Dataset."""
        return {"units": self.unit or "1", "long_name": self.long_name, "symbol": self.symbol}


QUANTITIES = {
    name: Quantity(*description)
    for name, *description in (
        ("time", "t", "s", "time"),
        ("depth", "d", "m", "indentation depth"),
        ("velocity", "v", "m/s", "indentation rate"),
        ("force", "F", "N", "normal force"),
        ("stiffness", "dF/dd", "N/m", "contact stiffness"),
        ("contact_radius", "a", "m", "contact radius"),
        ("plastic_radius", "c", "m", "radius of the plastic zone"),
        ("plastic_depth", "d_p", "m", "plastic depth"),
        ("live_depth", "ℓ", "m", "live depth"),
        ("mean_pressure", "p_m", "Pa", "mean contact pressure"),
        ("kinetic_energy", "W_k", "J", "kinetic energy"),
        ("stored_energy", "U", "J", "stored elastic energy"),
        ("plastic_work", "W_p", "J", "plastic work"),
        ("viscous_work", "W_v", "J", "viscous work"),
        ("surface_energy", "U_s", "J", "surface energy"),
        ("adhesive_work", "W_a", "J", "work of adhesion of an impact"),
        ("structure_work", "W_s", "J", "work of the waves of a structure"),
        ("support_energy", "U_s", "J", "energy of a support"),
        ("deflection", "w", "m", "deflection of the structure"),
        ("max_deflection", "w_max", "m", "largest deflection of the structure"),
        ("body_velocity", "V", "m/s", "velocity of the body"),
        ("pull_off_force", "F_a", "N", "pull-off force"),
        ("mass", "m", "kg", "mass"),
        ("speed", "v₀", "m/s", "impact speed"),
        ("restitution", "e", "", "coefficient of restitution"),
        ("rebound_speed", "v_r", "m/s", "rebound speed"),
        ("tangential_speed", "v_t0", "m/s", "tangential speed"),
        ("friction", "μ", "", "coefficient of friction"),
        ("tangential_mass", "m_t", "kg", "tangential mass"),
        ("tangential_velocity", "v_t", "m/s", "tangential velocity"),
        ("tangential_restitution", "e_t", "", "tangential restitution"),
        ("rebound_angle", "β", "rad", "rebound angle"),
        ("tangential_force", "F_x", "N", "tangential force"),
        ("max_tangential_force", "F_x,max", "N", "largest tangential force"),
        ("friction_work", "W_f", "J", "friction work"),
        ("stick_radius", "r_o", "m", "outer radius of stick"),
        ("slip_radius", "r_i", "m", "inner radius of stick"),
        ("contact_time", "T", "s", "contact time"),
        ("max_depth", "d_max", "m", "largest depth"),
        ("max_force", "F_max", "N", "largest force"),
        ("damaged_area", "A", "m²", "damaged area"),
        ("contact_area", "A", "m²", "contact area"),
        ("max_depth_error", "Δd/d", "", "relative error of the largest depth"),
        ("contact_area_error", "ΔA/A", "", "relative error of the contact area"),
        ("restitution_error", "Δe/e", "", "relative error of the restitution"),
        # Parameters of media and shapes.
        ("impedance", "Z", "N·s/m", "impedance"),
        ("edge", "x_e", "m", "distance to the edge"),
        ("thickness", "h", "m", "thickness"),
        ("wave_spread", "√(D/ρh)", "m²/s", "spread of bending waves"),
        ("shear_speed", "c_s", "m/s", "speed of shear waves"),
        ("E_star", "E*", "Pa", "effective modulus"),
        ("q_c", "q_c", "N/m", "yield constant"),
        ("hardness", "H", "Pa", "constant hardness"),
        ("f_c", "f_c", "N", "yield constant of class (c)"),
        ("eta", "η", "Pa·s", "viscosity"),
        ("poisson", "ν", "", "Poisson ratio"),
        ("work_of_adhesion", "w", "J/m²", "work of adhesion"),
        ("slope", "s", "", "slope"),
        ("exponent", "n", "", "exponent"),
        ("coefficient", "c", "m^(1-n)", "coefficient"),
        *((name, symbol, "m", name.replace("_", " ")) for name, symbol in (
            ("radius", "R"), ("tip_radius", "R"), ("cylinder_radius", "b"), ("flat_radius", "b"),
            ("edge_radius", "R"), ("r", "r"), ("z", "z"),
        )),
    )
}  # fmt: skip


def engineering(values, unit):
    """Return a number, or the range of an array, as text: four digits, and a unit with a prefix.

    Examples
    --------
    >>> from mdr_core.show.quantities import engineering
    >>> engineering(1.33472e-5, "N"), engineering([0.0, 2e-13], "m²"), engineering(1e-12, "kg")
    ('13.35 µN', '0 … 0.2 µm²', '1 ng')
    """
    values = np.asarray(values, dtype=float)
    if not values.size:
        return "none"
    ends = [float(np.min(values)), float(np.max(values))] if values.ndim else [float(values)]
    # 999.96 nm is written as 1 µm.
    fit = unit_of(float(f"{max(map(abs, ends)):.4g}"), unit)
    written = [_digits(end / fit.factor) for end in ends]
    text = written[0] if len(written) == 1 or written[0] == written[1] else " … ".join(written)
    return with_unit(text, fit.name)


def unit_of(largest, unit):
    """Return the multiple of an SI unit in which a value has one to three digits before the point.

    Examples
    --------
    >>> from mdr_core.show.quantities import unit_of
    >>> unit_of(2e-8, "m")
    Unit(name='nm', factor=1e-09)
    """
    return fitting(largest, KINDS[unit]) if unit in KINDS else Unit(unit, 1.0)


def _digits(value):
    """Return a number as text with four digits, without a power of ten below a million."""
    text = f"{value:.4g}"
    return f"{float(text):.0f}" if "e+05" in text or "e+04" in text else text


def at_default(field, value):
    """Whether a parameter has its default value; the default of a hardness constant becomes 0 or ∞."""
    if field.name in ("q_c", "hardness", "f_c"):
        return value in (0.0, np.inf)
    return value == field.default


#: Parameters of structures that are quantities of contacts under the same name.
_OF_STRUCTURE = {"stiffness": Quantity("K", "N/m", "stiffness of the support")}


def described(thing):
    """Describe a profile, a medium or a structure in one line: its name, and parameters not at defaults."""
    parts = [type(thing).__name__]
    own = _OF_STRUCTURE if isinstance(thing, Structure) else {}
    for name, field in thing.__dataclass_fields__.items():
        known, value = own.get(name, QUANTITIES.get(name)), getattr(thing, name)
        if np.ndim(value) == 0 and at_default(field, value):
            continue
        if value is None:
            parts.append(f"no {known.long_name}")
            continue
        if isinstance(value, Modes):
            low, high = (engineering(end(value.frequency), "Hz") for end in (min, max))
            parts.append(f"{len(value.frequency)} modes from {low} to {high}")
            continue
        if isinstance(value, check.Parameters):
            kind, *given = described(value).split(", ")
            parts.append(f"σ_c by {kind}({', '.join(given)})")
            continue
        try:
            text = engineering(value, known.unit if known else "")
            count = f" ({np.size(value)})" if np.ndim(value) else ""
        except (TypeError, ValueError):
            text, count = check.shown(value), ""
        parts.append(f"{known.symbol if known else name} {text}{count}")
    return ", ".join(parts)
