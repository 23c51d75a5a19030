"""The indenter shapes of the explorer. A shape is one entry of `SHAPES`."""

from collections.abc import Callable
from dataclasses import dataclass

import mdr_core as mdr

LENGTH = (1e-10, 100.0)
SLOPE = (1e-4, 10.0)


@dataclass(frozen=True)
class Quantity:
    """A number that can be set.

    Parameters
    ----------
    name : str
        Name of the parameter.
    symbol, label : str
        As shown: "R", "radius of curvature".
    kind : str
        Kind of its units, a key of `units.UNITS`.
    bounds : tuple of float
        Smallest and largest value (SI).
    default : float
        Value to begin with: in SI, but for a length in contact radii of what is on the page, so
        that another shape begins at the same scale.
    span : float
        The slider reaches this factor below and above the value that it is reset to. 0: from
        bound to bound, on a linear scale.
    """

    name: str
    symbol: str
    label: str
    kind: str
    bounds: tuple[float, float]
    default: float
    span: float = 30.0

    @property
    def start(self):
        """The default within the bounds."""
        return min(max(self.default, self.bounds[0]), self.bounds[1])


def _length(name, symbol, label, default):
    return Quantity(name, symbol, label, "length", LENGTH, default)


def _slope(default=0.2, symbol="s", label="slope of the generator"):
    return Quantity("slope", symbol, label, "number", SLOPE, default, 10.0)


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


_FLAT = _length("flat_radius", "b", "radius of the flat face", 0.6)

SHAPES = {
    "cone": Shape("Cone", "z = s r", "g = (π/2) s x", (_slope(),), mdr.Cone),
    "paraboloid": Shape(
        "Paraboloid",
        "z = r²/(2R)",
        "g = x²/R",
        (_length("radius", "R", "radius of curvature", 5.0),),
        mdr.Paraboloid,
    ),
    "sphere": Shape(
        "Sphere",
        "z = R − √(R² − r²)",
        "g = x artanh(x/R)",
        (_length("radius", "R", "radius", 5.0),),
        mdr.Sphere,
    ),
    "flat_punch": Shape(
        "Flat punch",
        "z = 0 for r ≤ b",
        "g = 0 for x ≤ b",
        (_length("radius", "b", "radius of the flat end", 1.0),),
        mdr.FlatPunch,
    ),
    "power_law": Shape(
        "Power law",
        "z = h (r/r₁)ⁿ",
        "g = κₙ h (x/r₁)ⁿ",
        (
            Quantity("exponent", "n", "exponent", "number", (0.2, 20.0), 3.0, 4.0),
            _length("height", "h", "height at r₁", 0.2),
            _length("width", "r₁", "radius where z = h", 1.0),
        ),
        _power_law,
    ),
    "hyperboloid": Shape(
        "Hyperboloid",
        "z = √(s²r² + s⁴R²) − s²R",
        "g = s x arctan(x/(sR))",
        (_slope(0.3, label="slope far out"), _length("tip_radius", "R", "radius of the tip", 2.0)),
        mdr.Hyperboloid,
    ),
    "rounded_cone": Shape(
        "Cone with rounded tip",
        "z = r²/(2R), then s r − s²R/2",
        "g = x²/R, then (x/R)(x − √(x²−b²) + b arccos(b/x)), b = sR",
        (_length("tip_radius", "R", "radius of the tip", 2.0), _slope(0.25)),
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
        (_FLAT, _length("radius", "R", "radius of curvature", 5.0)),
        mdr.TruncatedParaboloid,
    ),
    "rounded_punch": Shape(
        "Punch with rounded edge",
        "z = (r − b)²/(2R), r > b",
        "g = (x/R)(√(x² − b²) − b arccos(b/x)), x > b",
        (_FLAT, _length("edge_radius", "R", "radius of the edge", 1.0)),
        mdr.RoundedPunch,
    ),
    "parabolic_punch": Shape(
        "Punch with parabolic end",
        "z = r²/(2R) for r ≤ b",
        "g = x²/R for x ≤ b",
        (
            _length("radius", "R", "radius of curvature", 5.0),
            _length("cylinder_radius", "b", "radius of the cylinder", 1.0),
        ),
        mdr.ParabolicPunch,
    ),
}
