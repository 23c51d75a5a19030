"""Hints on symbols, words and models of the field that have other names in this package."""

from .synonyms import MEANINGS, plain

_ANGLE = (
    "A slope is the tangent of the angle to the surface; Cone.from_half_angle(degrees) takes the angle "
    "between axis and generator"
)
_DEGREES = (
    "The half-angle `degrees` is between the axis and the generator of a cone, or a face of a pyramid"
)
_RADIUS = "A radius is half of the diameter, in m"
_MODULUS = "E_star is E/(1 − ν²) under a rigid indenter; Medium.from_bodies(E1, nu1) takes E and ν"
_BODIES = "`E1` and `nu1` are E and ν of the medium, `E2` and `nu2` those of an elastic indenter"
_SPEED = "The speed before the impact is `speed` (m/s); from an energy it is (2 energy/mass)**0.5"
_OBLIQUE = (
    "An impact at an angle is oblique_impact(profile, medium, mass, *at_angle(speed, angle), friction), "
    "with the angle to the normal in rad"
)
_FORCE = "indent_to_force(profile, medium, force) presses to a force (N)"
_DEPTH = "indent(profile, medium, depth) presses to a depth (m)"
_TIME = "indent_in_time(profile, medium, depth, time) takes depths over time, creep(…, force, time) forces"
_ADHESION = "The work of adhesion is `work_of_adhesion` (J/m²)"

#: Hints on keywords that are not parameters.
KEYWORDS = (
    dict.fromkeys(("angle", "half_angle", "alpha", "theta"), _ANGLE)
    | dict.fromkeys(("R", "r", "diameter", "D"), _RADIUS)
    | dict.fromkeys(("E", "modulus", "youngs_modulus", "nu"), _MODULUS)
    | dict.fromkeys(("velocity", "v", "v0", "energy"), _SPEED)
    | dict.fromkeys(("w", "gamma", "adhesion", "surface_energy"), _ADHESION)
    | {
        "critical_depth": "Medium.from_critical_depth(E_star, critical_depth) takes a critical depth",
        "viscosity": "The viscosity is `eta` (Pa·s)",
        "tau": "The viscosity is `eta` = E_star τ/4 (Pa·s)",
        "H": "The constant hardness is `hardness` (Pa)",
        "poisson_ratio": "The Poisson ratio is `poisson`",
    }
)

_ANGLES = ("angle", "degrees", "theta", "alpha")
_ALONG_THE_SURFACE = (*_ANGLES, "friction", "mu", "tangential_speed", "tangential_mass")
#: Hints on keywords of single functions, which take precedence.
KEYWORDS_OF = {
    "Medium.from_bodies": dict.fromkeys(
        ("E", "nu", "E_star", "modulus", "youngs_modulus", "poisson", "poisson_ratio"), _BODIES
    ),
    "Cone.from_half_angle": dict.fromkeys(("angle", "half_angle", "alpha", "theta"), _DEGREES),
    "Cone.pyramid": dict.fromkeys(("angle", "half_angle", "alpha", "theta"), _DEGREES),
    "impact": dict.fromkeys(_ALONG_THE_SURFACE, _OBLIQUE),
    "chain_impact": dict.fromkeys(_ALONG_THE_SURFACE, _OBLIQUE),
    "oblique_impact": dict.fromkeys(
        _ANGLES,
        "at_angle(speed, angle) gives `speed` and `tangential_speed` of an angle to the normal in rad",
    )
    | {"mu": "Coulomb's coefficient is `friction`"},
    "indent": dict.fromkeys(("force", "load", "F", "P"), _FORCE) | {"time": _TIME},
    "indent_to_force": dict.fromkeys(("depth", "displacement", "d", "h"), _DEPTH) | {"time": _TIME},
}

_CONE = "take mdr_core.Cone.from_half_angle({}), the cone with the area of {} at each depth"
_JKR = "take mdr_core.Paraboloid(radius) on a Medium(E_star, work_of_adhesion=w), which is the model of {}"
_RIM = (
    "adhesive forces must have a short range (Johnson, Kendall and Roberts): take mdr_core.Medium(E_star, "
    "work_of_adhesion=w), and see Tabor's parameter in the limits of the result"
)
_HALF_SPACE = "take mdr_core.Medium(E_star, …)"
_VISCOUS = "the viscous medium here is a Kelvin–Voigt medium: take mdr_core.Medium(E_star, eta=…)"
_FRICTION = "take mdr_core.oblique_impact(…, friction=μ)"
#: Replacements for names that the package does not have. The keys are lower case without underscores.
MODELS = {
    "berkovich": "take mdr_core.Cone.berkovich()",
    "brinell": "take mdr_core.Sphere(radius)",
    "cattaneo": _FRICTION,
    "conical": "take mdr_core.Cone(slope), or Cone.from_half_angle(degrees)",
    "conospherical": "take mdr_core.RoundedCone(tip_radius, slope)",
    "cor": "take mdr_core.impact(…).restitution",
    "coulomb": _FRICTION,
    "cubecorner": _CONE.format("42.28", "a cube corner"),
    "cylinder": "take mdr_core.FlatPunch",
    "dmt": _RIM,
    "e": "take mdr_core.impact(…).restitution",
    "halfspace": _HALF_SPACE,
    "hertz": "take mdr_core.Paraboloid",
    "jkr": _JKR.format("Johnson, Kendall and Roberts"),
    "johnson": "take mdr_core.impact with a Medium(E_star, hardness=H)",
    "kelvinvoigt": _VISCOUS,
    "load": "take mdr_core.indent_to_force, or mdr_core.Scene.from_json for a saved scene",
    "material": _HALF_SPACE,
    "maugis": _RIM,
    "maugisdugdale": _RIM,
    "maxwell": _VISCOUS,
    "mindlin": _FRICTION,
    "oblique": "take mdr_core.oblique_impact",
    "oliverpharr": "take mdr_core.oliver_pharr",
    "press": "take mdr_core.indent, or mdr_core.indent_to_force",
    "punch": "take mdr_core.FlatPunch(radius)",
    "pyramid": "take mdr_core.Cone.pyramid(degrees)",
    "readcsv": "take mdr_core.read_curve for a curve, mdr_core.Sampled.from_csv for a tip",
    "sample": _HALF_SPACE,
    "sneddon": "take mdr_core.Cone.from_half_angle(degrees), Sneddon's cone",
    "sphericalindenter": "take mdr_core.Sphere(radius)",
    "substrate": _HALF_SPACE,
    "thornton": "take mdr_core.impact with a Medium(E_star, hardness=H)",
    "vickers": "take mdr_core.Cone.berkovich(), which has the area of a Vickers pyramid to 0.1 %",
    "viscoelastic": _VISCOUS,
}

#: Symbols, case-sensitive, with the possible names as in `Synonyms`.
_SYMBOLS = {
    "e": (("restitution",),),
    **dict.fromkeys(("F", "P"), (("force",), ("max_force",))),
    **dict.fromkeys(("P_max", "Pmax"), (("max_force",), ("force",))),
    **dict.fromkeys(("d", "h"), (("depth",), ("max_depth",))),
    "a": (("contact_radius",),),
    "c": (("plastic_radius",),),
    "A": (("contact_area",), ("damaged_area",)),
    **dict.fromkeys(("E", "E_star"), (("E_star",), ("medium",))),
    **dict.fromkeys(("q_c", "qc", "eta"), (("medium",),)),
    "H": (("hardness",), ("mean_pressure",)),
    "S": (("stiffness",),),
    "p": (("pressure",), ("turning_point",)),
    "v": (("velocity",), ("speed", "rebound_speed"), ("speed",)),
    "t": (("time",), ("contact_time",)),
}
#: Explanations that follow the name of a quantity.
_EXPLANATIONS = {
    "pressure": ", a function of the radius",
    "turning_point": ", the state of largest depth, with its pressures and stresses",
    "medium": ", which has the modulus .E_star, the hardness and the viscosity",
    "stress_peak": ": .stress_peak('von_mises') is the largest stress below the surface",
    "speed": " (before the impact)",
    "rebound_speed": " (after it)",
    "states": ", the states of the contact, with their pressures",
}


def keyword_hint(function, keyword):
    """Return a sentence on a keyword that a function does not have, or an empty text."""
    return KEYWORDS_OF.get(function, {}).get(keyword) or KEYWORDS.get(keyword, "")


def quantity_hint(name, known):
    """Return a hint on the name of a quantity for a result with the `known` quantities.

    Return None if the name is not a term of the field, and an empty text if the result has no such
    quantity.
    """
    meanings = _SYMBOLS.get(name) or MEANINGS.get(plain(name))
    if meanings is None:
        return None
    meant = next((names for names in meanings if set(names) <= set(known)), ())
    names = " and ".join(f"{each!r}{_EXPLANATIONS.get(each, '')}" for each in meant)
    return f"did you mean {names}?" if names else ""


def model_hint(name):
    """Return a replacement for a name that the package does not have, or an empty text."""
    return MODELS.get(plain(name), "")
