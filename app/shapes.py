"""The indenter shapes of the explorer. A shape is one entry of `SHAPES`."""

from collections.abc import Callable
from dataclasses import dataclass

import mdr_core as mdr

from .quantities import NUMBERS, Quantity

LENGTH = (1e-10, 100.0)
SLOPE = (1e-4, 10.0)


_SHAPED = "It goes into the height z(r), and through (3) into the equivalent profile g(x)."


def _length(name, symbol, label, default, what):
    typical = "some contact radii a; nm at sharp tips, mm at balls"
    equation = "(3)  g(x) = x ∫ z′(r) dr/√(x² − r²)"
    return Quantity(
        name, symbol, label, "length", LENGTH, default, 30.0, f"{what} {_SHAPED}", equation, typical
    )


def _slope(default=0.2, label="slope of the generator"):
    what = (
        "Rise of the flank over its run: the cotangent of the half-angle. The model takes slopes as small."
    )
    typical = "0.36 Berkovich and Vickers, 0.1–0.3 blunt"
    return Quantity("slope", "s", label, "number", SLOPE, default, 10.0, what, "(13)  z = s r", typical)


@dataclass(frozen=True)
class Shape:
    """An indenter shape: its name, formulas and parameters, and how the core makes it of them."""

    label: str
    height: str
    reduced: str
    quantities: tuple[Quantity, ...]
    build: Callable[..., mdr.Profile]


def _power_law(height, width, exponent):
    return mdr.PowerLaw(coefficient=height / width**exponent, exponent=exponent)


_FLAT = _length(
    "flat_radius",
    "b",
    "radius of the flat face",
    0.6,
    "Radius of the flat face, the contact at first touch.",
)

_R = _length("radius", "R", "radius of curvature", 5.0, "Radius of curvature at the tip.")
_TIP = _length("tip_radius", "R", "radius of the tip", 2.0, "Radius to which the tip is blunted.")

SHAPES = {
    "cone": Shape("Cone", "z = s r", "g = (π/2) s x", (_slope(),), mdr.Cone),
    "paraboloid": Shape(
        "Paraboloid",
        "z = r²/(2R)",
        "g = x²/R",
        (_R,),
        mdr.Paraboloid,
    ),
    "sphere": Shape(
        "Sphere",
        "z = R − √(R² − r²)",
        "g = x artanh(x/R)",
        (_length("radius", "R", "radius", 5.0, "Radius of the ball, a true sphere."),),
        mdr.Sphere,
    ),
    "flat_punch": Shape(
        "Flat punch",
        "z = 0 for r ≤ b",
        "g = 0 for x ≤ b",
        (
            _length(
                "radius",
                "b",
                "radius of the flat end",
                1.0,
                "Radius of the flat end, the contact at every depth.",
            ),
        ),
        mdr.FlatPunch,
    ),
    "power_law": Shape(
        "Power law",
        "z = h (r/r_1)ⁿ",
        "g = κ_n h (x/r_1)ⁿ",
        (
            Quantity(
                *("exponent", "n", "exponent", "number", (0.2, 20.0), 3.0, 4.0),
                "Power of the radius with which the height grows: 1 a cone, 2 a paraboloid, large a punch. "
                "The equivalent profile g(x) has the same one.",
                "(5)  g = κ_n h (x/r_1)ⁿ",
                "1 to 4",
            ),
            _length("height", "h", "height at r_1", 0.2, "Height of the shape at the radius r_1."),
            _length("width", "r_1", "radius where z = h", 1.0, "Radius at which the height h is reached."),
        ),
        _power_law,
    ),
    "hyperboloid": Shape(
        "Hyperboloid",
        "z = √(s²r² + s⁴R²) − s²R",
        "g = s x arctan(x/(sR))",
        (_slope(0.3, "slope far out"), _TIP),
        mdr.Hyperboloid,
    ),
    "rounded_cone": Shape(
        "Cone with rounded tip",
        "z = r²/(2R), then s r − s²R/2",
        "g = x²/R, then (x/R)(x − √(x²−b²) + b arccos(b/x)), b = sR",
        (_TIP, _slope(0.25)),
        mdr.RoundedCone,
    ),
    "truncated_cone": Shape(
        "Truncated cone",
        "z = s (r − b), r > b",
        "g = s x arccos(b/x), x > b",
        (_FLAT, _slope()),
        mdr.TruncatedCone,
    ),
    "truncated_paraboloid": Shape(
        "Truncated paraboloid",
        "z = (r² − b²)/(2R), r > b",
        "g = (x/R) √(x² − b²), x > b",
        (_FLAT, _R),
        mdr.TruncatedParaboloid,
    ),
    "rounded_punch": Shape(
        "Punch with rounded edge",
        "z = (r − b)²/(2R), r > b",
        "g = (x/R)(√(x² − b²) − b arccos(b/x)), x > b",
        (
            _FLAT,
            _length("edge_radius", "R", "radius of the edge", 1.0, "Radius to which the edge is rounded."),
        ),
        mdr.RoundedPunch,
    ),
    "parabolic_punch": Shape(
        "Punch with parabolic end",
        "z = r²/(2R) for r ≤ b",
        "g = x²/R for x ≤ b",
        (
            _R,
            _length(
                "cylinder_radius",
                "b",
                "radius of the cylinder",
                1.0,
                "Radius of the cylinder, beyond which is a wall.",
            ),
        ),
        mdr.ParabolicPunch,
    ),
}


def shape_quantities(shape):
    """Names and quantities of the numbers of a shape; a measured tip has none."""
    return [(f"{shape}_{q.name}", q) for q in SHAPES[shape].quantities] if shape in SHAPES else []


#: Every quantity by its name; those of the shapes are named as in "cone_slope".
QUANTITIES = {quantity.name: quantity for quantity in NUMBERS} | {
    name: quantity for shape in SHAPES for name, quantity in shape_quantities(shape)
}
