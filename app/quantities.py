"""Every number and every choice that can be set, with symbols, units and bounds."""

from .shapes import SHAPES, Quantity

ELASTICITY, PLASTICITY, DAMPING = "elasticity", "plasticity", "damping"
DRIVE, INERTIA, SURFACE = "drive", "inertia", "surface"

#: The options of each choice; the first is where the page begins.
CHOICES = {
    "shape": {key: shape.label for key, shape in SHAPES.items()} | {"sampled": "Measured tip (CSV)"},
    ELASTICITY: {"modulus": "E*", "bodies": "two bodies", "rigid_tip": "under a rigid tip"},
    PLASTICITY: {"q_c": "q_c", "hardness": "hardness at a radius", "none": "none"},
    DAMPING: {"none": "none", "eta": "η", "tau": "τ"},
    DRIVE: {"depth": "to a depth", "force": "to a force", "impact": "impact"},
    INERTIA: {"unknown": "unknown", "density": "density"},
    SURFACE: {"virgin": "virgin", "imprint": "earlier imprint"},
}

_MODULUS, _RATIO = (1.0, 1e14), (-0.99, 0.5)

_NUMBERS = (
    Quantity("E_star", "E*", "effective modulus (2)", "pressure", _MODULUS, 1e9, 10.0),
    Quantity("E_1", "E_1", "modulus of the medium", "pressure", _MODULUS, 1e9, 10.0),
    Quantity("nu_1", "ν_1", "its Poisson ratio", "number", _RATIO, 0.3, 0.0),
    Quantity("E_2", "E_2", "modulus of the indenter", "pressure", _MODULUS, 1e11, 10.0),
    Quantity("nu_2", "ν_2", "its Poisson ratio", "number", _RATIO, 0.3, 0.0),
    Quantity("q_c", "q_c", "yield constant (11)", "yield constant", (1e-9, 1e12), 1.0, 30.0),
    Quantity("hardness", "σ_c", "hardness (11)", "pressure", (1e-3, 1e14), 1e9, 30.0),
    Quantity("hardness_radius", "a_c", "measured at contact radius", "length", (1e-10, 100.0), 1e-6, 30.0),
    Quantity("eta", "η", "viscosity (1)", "viscosity", (1e-15, 1e15), 1.0, 100.0),
    Quantity("tau", "τ", "relaxation time 4η/E* (1)", "time", (1e-18, 1e9), 1e-3, 100.0),
    Quantity("density", "ρ", "density of the medium", "density", (1.0, 3e4), 2000.0, 5.0),
    Quantity("max_depth", "d_max", "largest depth", "length", (1e-13, 10.0), 1e-6, 30.0),
    Quantity("max_force", "F_max", "largest force", "force", (1e-18, 1e15), 1.0, 30.0),
    Quantity("mass", "m", "mass", "mass", (1e-24, 1e9), 1.0, 30.0),
    Quantity("plastic_depth", "d_0", "plastic depth left before", "length", (1e-15, 10.0), 1e-6, 30.0),
    Quantity("speed", "v_0", "speed at first contact", "speed", (1e-12, 1e5), 1.0, 30.0),
)


def shape_quantities(shape):
    """Names and quantities of the numbers of a shape; a measured tip has none."""
    return [(f"{shape}_{q.name}", q) for q in SHAPES[shape].quantities] if shape in SHAPES else []


#: Every quantity by its name.
QUANTITIES = {quantity.name: quantity for quantity in _NUMBERS} | {
    name: quantity for shape in SHAPES for name, quantity in shape_quantities(shape)
}

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


def used(choices):
    """Names of the numbers that a set of choices uses."""
    names = [name for name, _ in shape_quantities(choices["shape"])]
    return names + [name for choice, options in USED.items() for name in options[choices[choice]]]
