"""Words of the field for quantities of results, used in hints of errors and in the glossary."""

from typing import NamedTuple


class Synonyms(NamedTuple):
    """Words for one quantity.

    Attributes
    ----------
    words : tuple of str
        Terms of articles and instruments.
    meanings : tuple of tuple of str
        Names of quantities. The first tuple counts whose names are all in the result.
    note : str
        Further explanation in the glossary.
    """

    words: tuple[str, ...]
    meanings: tuple[tuple[str, ...], ...]
    note: str = ""


def _synonyms(words, meanings, note=""):
    """Return `Synonyms` from words between commas, and names with "and", separated by semicolons."""
    return Synonyms(
        tuple(words.split(", ")), tuple(tuple(each.split(" and ")) for each in meanings.split("; ")), note
    )


SYNONYMS = (
    _synonyms(
        "restitution, coefficient of restitution, restitution coefficient, COR",
        "restitution",
        "Rebound speed over impact speed.",
    ),
    _synonyms(
        "force, load, normal load, normal force, contact force, reaction",
        "force; max_force",
        "It is positive in compression.",
    ),
    _synonyms(
        "peak force, maximum force, max load, peak load, F max",
        "max_force; force",
        "For a drop weight on a laminate see :doc:`composites`.",
    ),
    _synonyms(
        "depth, penetration, penetration depth, indentation, indentation depth, displacement, approach, "
        "deformation, overlap",
        "depth; max_depth",
        "It begins at first contact. The displacement of the surface is `Indentation.surface`.",
    ),
    _synonyms(
        "maximum depth, peak depth, max displacement, max indentation, max penetration, h max, d max",
        "max_depth; depth",
    ),
    _synonyms(
        "residual depth, final depth, permanent depth, imprint depth, crater depth, dent depth, residual "
        "imprint, crater, dent, permanent indentation, h f",
        "plastic_depth",
        "`Indentation.imprint` is the depth of the imprint at any radius. See :doc:`composites`.",
    ),
    _synonyms(
        "maximum pressure, max pressure, peak pressure, p max, p 0",
        "max_pressure; pressure; states",
        "After yield it is usually at the radius c of the plastic zone, not on the axis.",
    ),
    _synonyms(
        "contact pressure, normal stress, pressure distribution",
        "pressure; turning_point",
        "A function of the radius. `Indentation.mean_pressure` is the mean.",
    ),
    _synonyms(
        "subsurface stress, maximum stress, max stress, von Mises, von Mises stress, max von Mises, "
        "maximum shear stress, Mises, Tresca",
        "stress_peak; turning_point",
        "`Indentation.stress`, `Indentation.largest_stress`: the elastic stresses of the present load.",
    ),
    _synonyms(
        "contact area, projected area, area",
        "contact_area; damaged_area",
        "π a². `Impact.damaged_area` is the area of the plastic zone, π c².",
    ),
    _synonyms(
        "contact stiffness, unloading stiffness",
        "stiffness",
        "The stiffness of a measured curve is ``OliverPharr.stiffness``.",
    ),
    _synonyms("contact time, duration, impact duration, impact time, collision time", "contact_time"),
    _synonyms(
        "velocity",
        "velocity; speed and rebound_speed; speed",
        "An impact has ``speed`` before it and ``rebound_speed`` after it.",
    ),
    _synonyms("impact velocity, impact speed, initial speed", "speed"),
    _synonyms("rebound velocity, final speed, final velocity, exit speed, exit velocity", "rebound_speed"),
    _synonyms(
        "absorbed energy, dissipated energy, dissipation, energy loss, lost energy",
        "plastic_work and structure_work; plastic_work and friction_work; plastic_work",
        "Also `Impact.viscous_work`, `Impact.adhesive_work`, and `ObliqueImpact.friction_work`; see "
        ":doc:`composites`.",
    ),
    _synonyms("elastic energy, elastic work, strain energy, potential energy", "stored_energy"),
    _synonyms(
        "wave energy, energy carried away by waves",
        "structure_work",
        "`Motion.support_energy` is the energy of a support.",
    ),
    _synonyms(
        "deflection of the plate, plate deflection",
        "deflection; max_deflection",
        "`Motion.body_velocity` is the velocity of the body, including the velocity of the plate.",
    ),
    _synonyms("pull-off, pull-off force, adhesion force", "pull_off_force; turning_point"),
    _synonyms(
        "reduced modulus, effective modulus, contact modulus, indentation modulus, E r, plane strain "
        "modulus",
        "E_star; medium",
        "E\\* (Pa) of `Medium`: 1/E\\* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂. Some instruments call it E_r.",
    ),
    _synonyms(
        "Young's modulus, elastic modulus, modulus",
        "E_star; medium",
        "`Medium.from_bodies` computes E\\* from Young's moduli and Poisson's ratios of both bodies. A "
        "fit gives E\\*; for a rigid tip Young's modulus of the sample is E\\*(1 − ν²).",
    ),
)


def plain(word: str) -> str:
    """Return a word or a name in lower case, with letters and digits only."""
    return "".join(letter for letter in word.lower() if letter.isalnum())


#: Meanings by plain words.
MEANINGS = {plain(word): row.meanings for row in SYNONYMS for word in row.words}
