"""Tips, kinds of samples and numbers that a person chooses, by their names in links."""

from collections.abc import Callable
from math import inf, radians, tan
from typing import NamedTuple

import mdr_core as mdr
from mdr_core.measurements.fit.parameters import PARAMETERS
from mdr_core.show.units import KINDS


class Number(NamedTuple):
    """A number that is typed: symbol, name, kind of unit, unit while it is empty, and bounds (SI)."""

    symbol: str
    label: str
    kind: str
    unit: str = ""
    low: float = -inf
    high: float = inf


#: Numbers of tips, of Young's modulus, of the reader of a file, and corrections before the fit.
NUMBERS = {
    "radius": Number("R", "tip radius", "length", "µm", 1e-10, 1.0),
    "half_angle": Number("α", "half-angle", "angle", "°", radians(1), radians(89.9)),
    "poisson": Number("ν", "Poisson's ratio of the sample", "number", "", 0.0, 0.5),
    "tip_modulus": Number("E_t", "Young's modulus of the tip", "pressure", "GPa", 1e3, 1e13),
    "tip_poisson": Number("ν_t", "Poisson's ratio of the tip", "number", "", 0.0, 0.5),
    "spring_constant": Number("k", "spring constant of the cantilever", "yield constant", "N/m", 1e-6, 1e9),
    "sensitivity": Number("s", "sensitivity, deflection for 1 V", "length", "nm", 1e-13, 1e-2),
    "drift": Number("v_d", "drift of the depth", "speed", "nm/s", -1.0, 1.0),
    "frame": Number("C_f", "frame compliance", "compliance", "nm/mN", 0.0, 1e6),
    "depth_noise": Number("σ_d", "noise of the depth", "length", "nm", 0.0, 1e-3),
}
MODULI = ("poisson", "tip_modulus", "tip_poisson")
CANTILEVER = ("spring_constant", "sensitivity")
CORRECTIONS = ("drift", "frame", "depth_noise")
#: Parameters of the fit, which are fitted while their fields are empty.
FITTED = {
    name: Number(
        each.quantity.symbol,
        each.quantity.long_name,
        KINDS[each.quantity.unit],
        "nm" * (name == "contact_point"),
    )
    for name, each in PARAMETERS.items()
}
#: What needs the times of the samples.
IN_TIME = ("drift", *(name for name, each in PARAMETERS.items() if each.in_time))
#: Parts of a curve, by their labels.
PARTS = {"All": "all", "Loading": "loading", "Unloading": "unloading"}


class Tip(NamedTuple):
    """A kind of tip: its name, its numbers, and the profile that they make."""

    label: str
    numbers: tuple[str, ...]
    profile: Callable[..., mdr.Profile]


def slope_of(half_angle: float) -> float:
    """Return the slope of a cone."""
    return 1 / tan(half_angle)


TIPS = {
    "berkovich": Tip("Berkovich or Vickers (cone of 70.3°)", (), lambda: mdr.Cone.from_half_angle(70.3)),
    "cube_corner": Tip("Cube corner (cone of 42.28°)", (), lambda: mdr.Cone.from_half_angle(42.28)),
    "paraboloid": Tip("Paraboloid: a colloid or a blunt tip", ("radius",), mdr.Paraboloid),
    "sphere": Tip("Sphere", ("radius",), mdr.Sphere),
    "cone": Tip("Cone", ("half_angle",), lambda angle: mdr.Cone(slope_of(angle))),
    "rounded_cone": Tip(
        "Cone with a rounded tip", ("half_angle", "radius"),
        lambda angle, radius: mdr.RoundedCone(tip_radius=radius, slope=slope_of(angle)),
    ),
    "flat_punch": Tip("Flat punch", ("radius",), mdr.FlatPunch),
    "measured": Tip("Measured tip, from a file", (), mdr.Sampled),
}  # fmt: skip


class Medium(NamedTuple):
    """A kind of sample: name, parameters that are fitted at first, part of the curve, class of hardness."""

    label: str
    fitted: tuple[str, ...]
    part: str = "all"
    letter: str = ""

    @property
    def at_zero(self) -> list[str]:
        """Parameters that are 0 unless they are to be fitted."""
        others = ("baseline", "tilt", "drag")
        return [name for name in others if name not in self.fitted]


MEDIA = {
    "constant": Medium(
        "Glass, metal or ceramic: constant hardness", ("E_star", "hardness", "contact_point"), letter="a"
    ),
    "composite": Medium("Composite, PDMS: hardness ∝ 1/a", ("E_star", "q_c", "contact_point"), letter="b"),
    "line": Medium("Hardness ∝ 1/a²", ("E_star", "f_c", "contact_point"), letter="c"),
    "gel": Medium("Gel, cell, rubber: elastic", ("E_star", "contact_point", "baseline"), "loading"),
    "viscous": Medium(
        "Viscous gel in a liquid (with times)", ("E_star", "eta", "contact_point", "baseline", "drag")
    ),
    "sticky": Medium(
        "Elastic with adhesion (pull-off)", ("E_star", "work_of_adhesion", "contact_point", "baseline")
    ),
}
#: The kind of sample with the hardness of each class, and what each is called.
OF_CLASS = {each.letter: name for name, each in MEDIA.items() if each.letter}
CLASS_NAMES = {"a": "constant hardness", "b": "hardness ∝ 1/a", "c": "hardness ∝ 1/a²"}


class Example(NamedTuple):
    """A measured curve of the library: button, file, name, tip, kind of sample and numbers."""

    button: str
    file: str
    name: str
    tip: str
    medium: str
    numbers: dict[str, float | None]

    def read(self) -> bytes:
        """Return what is in the file."""
        return mdr.example(self.file).read_bytes()


EXAMPLES = {
    # Depths of this file count from first contact; the tip is of diamond.
    "silica": Example(
        "Sample: fused silica", "silica.csv", "Fused silica, Berkovich tip.csv", "berkovich", "constant",
        {"contact_point": 0.0, "poisson": 0.17, "tip_modulus": 1141e9, "tip_poisson": 0.07},
    ),
    "gel": Example(
        "Sample: gel by AFM", "gel.csv", "Gel, AFM, colloid of 10 µm.csv", "paraboloid", "gel",
        {"radius": 10e-6, "poisson": 0.5},
    ),
}  # fmt: skip
