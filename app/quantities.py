"""Every number and every choice that can be set: symbol, name, unit, bounds, and what is said of it."""

from dataclasses import dataclass
from math import log

ELASTICITY, PLASTICITY, DAMPING = "elasticity", "plasticity", "damping"
DRIVE, INERTIA, SURFACE = "drive", "inertia", "surface"


@dataclass(frozen=True)
class Quantity:
    """A number that can be set.

    Parameters
    ----------
    name : str
        Name of the parameter.
    symbol, label : str
        As shown: "q_c", "yield constant".
    kind : str
        Kind of its units, a key of `units.UNITS`.
    bounds : tuple of float
        Smallest and largest value (SI).
    default : float
        Value to begin with: in SI, but for a length of a shape in contact radii of what is on the page,
        so that another shape begins at the same scale.
    span : float
        The slider reaches this factor below and above the value that it is reset to. 0: from
        bound to bound, on a linear scale.
    help, equation, typical : str
        What it is, in two sentences; the equation it stands in; a usual range.
    """

    name: str
    symbol: str
    label: str
    kind: str
    bounds: tuple[float, float]
    default: float
    span: float
    help: str
    equation: str = ""
    typical: str = ""

    @property
    def start(self):
        """The default within the bounds."""
        return min(max(self.default, self.bounds[0]), self.bounds[1])


#: The options of each choice but the shapes; the first is where the page begins.
CHOICES = {
    ELASTICITY: {"modulus": "E*", "bodies": "two bodies", "rigid_tip": "rigid tip"},
    PLASTICITY: {"q_c": "constant", "hardness": "hardness", "none": "none"},
    DAMPING: {"none": "none", "eta": "η", "tau": "τ"},
    DRIVE: {"depth": "to depth", "force": "to force", "impact": "impact"},
    INERTIA: {"unknown": "unknown", "density": "density"},
    SURFACE: {"virgin": "virgin", "imprint": "earlier imprint"},
}

LABELS = {
    ELASTICITY: "Elasticity",
    PLASTICITY: "Yield",
    DAMPING: "Viscosity",
    DRIVE: "Press",
    INERTIA: "Density",
    SURFACE: "Surface",
}

_MODULUS, _RATIO = (1.0, 1e14), (-0.99, 0.5)
_STIFF = "rubber 1 MPa, polymers 1–5 GPa, metals 50–400 GPa"

NUMBERS = (
    Quantity(
        "E_star", "E*", "effective modulus", "pressure", _MODULUS, 1e9, 10.0,
        "Stiffness of the contact, with the compliances of both bodies in it. "
        "Every spring of the foundation has the stiffness E* Δx.",
        "(2)  1/E* = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2", _STIFF,
    ),
    Quantity(
        "E_1", "E_1", "modulus of the medium", "pressure", _MODULUS, 1e9, 10.0,
        "Young's modulus of the half-space that is pressed. It enters the contact through E* alone.",
        "(2)  1/E* = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2", _STIFF,
    ),
    Quantity(
        "nu_1", "ν_1", "its Poisson ratio", "number", _RATIO, 0.3, 0.0,
        "How much the half-space bulges sideways. Springs hold for every ν, "
        "dashpots beside them for ν = ½ only.",
        "(2)  1/E* = (1 − ν_1²)/E_1 + …", "0.2 glass, 0.3 steel, 0.42 gold, 0.5 rubber",
    ),
    Quantity(
        "E_2", "E_2", "modulus of the indenter", "pressure", _MODULUS, 1e11, 10.0,
        "Young's modulus of the indenter. A stiff one hardly counts, because compliances add.",
        "(2)  1/E* = … + (1 − ν_2²)/E_2", "glass 63 GPa, steel 210 GPa, diamond 1141 GPa",
    ),
    Quantity(
        "nu_2", "ν_2", "its Poisson ratio", "number", _RATIO, 0.3, 0.0,
        "Poisson ratio of the indenter. It enters the contact through E* alone.",
        "(2)  1/E* = … + (1 − ν_2²)/E_2", "0.07 diamond, 0.2 glass, 0.3 steel",
    ),
    Quantity(
        "q_c", "q_c", "yield constant", "yield constant", (1e-9, 1e12), 1.0, 30.0,
        "Hardness times contact radius, the one material constant of this criterion of yield. "
        "A spring carries at most (π/2) q_c and yields at the compression d_c, wherever it stands.",
        "(11)  F = π a² σ_c = π q_c a,   (19)  d_c = π q_c/(2E*)",
        "1 N/m PDMS, 100 N/m gold at nanometres, 400 kN/m a laminate",
    ),
    Quantity(
        "hardness", "σ_c", "hardness", "pressure", (1e-3, 1e14), 1e9, 30.0,
        "Mean pressure of a fully yielded contact of radius a_c. It falls as 1/a: their product is q_c.",
        "(11)  σ_c = q_c/a_c", "polymers 0.1 GPa, metals 0.3–5 GPa",
    ),
    Quantity(
        "hardness_radius", "a_c", "measured at contact radius", "length", (1e-10, 100.0), 1e-6, 30.0,
        "Contact radius at which the hardness was measured. "
        "Without it a hardness says nothing in this class of media.",
        "(11)  q_c = σ_c a_c", "50 nm to 1 mm",
    ),
    Quantity(
        "eta", "η", "viscosity", "viscosity", (1e-15, 1e15), 1.0, 100.0,
        "Viscosity of the medium, in dashpots beside the springs. "
        "They resist an impact; pressing here is infinitely slow.",
        "(1)  Δγ = 4η Δx", "η = E*τ/4",
    ),
    Quantity(
        "tau", "τ", "relaxation time", "time", (1e-18, 1e9), 1e-3, 100.0,
        "Time in which a spring relaxes against its dashpot. "
        "What counts is how long that is beside the impact.",
        "(1)  τ = 4η/E*", "0.01 to 10 contact times show",
    ),
    Quantity(
        "density", "ρ", "density of the medium", "density", (1.0, 3e4), 2000.0, 5.0,
        "It changes no result. "
        "With it the page tells whether the impact is slow beside waves in the medium.",
        "v_0 ≪ √(E*/ρ)", "1000 polymers, 2000 laminates, 7800 steel, 19300 gold",
    ),
    Quantity(
        "max_depth", "d_max", "largest depth", "length", (1e-13, 10.0), 1e-6, 30.0,
        "How deep the indenter is pressed before it is taken back. Yield begins at d_c.",
        "(19)  d_c = π q_c/(2E*)", "0.1 to 100 d_c",
    ),
    Quantity(
        "max_force", "F_max", "largest force", "force", (1e-18, 1e15), 1.0, 30.0,
        "How hard the indenter is pressed before it is let go. "
        "A flat face carries less than the force at which all of it yields.",
        "(22)  F = 2E* ∫ a(s) ds  over d_p < s < d", "µN at nanometres, N to kN at millimetres",
    ),
    Quantity(
        "mass", "m", "mass", "mass", (1e-24, 1e9), 1.0, 30.0,
        "Mass of the free body that hits. Only the contact acts on it, no weight.",
        "m v_0²/2 = U + W_p + W_v  at the turning point", "",
    ),
    Quantity(
        "plastic_depth", "d_0", "plastic depth left before", "length", (1e-15, 10.0), 1e-6, 30.0,
        "Depth of the imprint that an earlier impact has left on this spot. Contact begins at its bottom, "
        "and yield again at d_0 + d_c.",
        "d_y = d_0 + d_c", "d_p of the impact before",
    ),
    Quantity(
        "speed", "v_0", "speed at first contact", "speed", (1e-12, 1e5), 1.0, 30.0,
        "Speed with which the body arrives. It leaves with e v_0.",
        "e = v_r/v_0", "mm/s to 10 m/s; slow beside √(E*/ρ)",
    ),
)  # fmt: skip

#: The numbers that each option uses.
USED = {
    ELASTICITY: {
        "modulus": ("E_star",),
        "bodies": ("E_1", "nu_1", "E_2", "nu_2"),
        "rigid_tip": ("E_1", "nu_1"),
    },
    PLASTICITY: {"q_c": ("q_c",), "hardness": ("hardness", "hardness_radius"), "none": ()},
    DAMPING: {"none": (), "eta": ("eta",), "tau": ("tau",)},
    DRIVE: {"depth": ("max_depth",), "force": ("max_force",), "impact": ("mass", "speed")},
    INERTIA: {"unknown": (), "density": ("density",)},
    SURFACE: {"virgin": (), "imprint": ("plastic_depth",)},
}


class Scale:
    """The steps of a slider and the values they stand for."""

    STEPS = 400

    def __init__(self, quantity, reset, value):
        low, high = quantity.bounds
        self.logarithmic = quantity.span > 0
        if self.logarithmic:
            # A value typed beyond the slider's reach becomes its new middle.
            middle = reset if reset / quantity.span <= value <= reset * quantity.span else value
            low, high = max(low, middle / quantity.span), min(high, middle * quantity.span)
        self.low, self.high = low, high

    def position(self, value):
        """The step nearest to a value."""
        if self.logarithmic:
            share = log(value / self.low) / log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return round(self.STEPS * min(max(share, 0.0), 1.0))

    def value(self, position):
        """The value of a step, with three digits."""
        share = min(max(position, 0), self.STEPS) / self.STEPS
        if self.logarithmic:
            value = self.low * (self.high / self.low) ** share
        else:
            value = self.low + (self.high - self.low) * share
        return min(max(float(f"{value:.3g}"), self.low), self.high)
