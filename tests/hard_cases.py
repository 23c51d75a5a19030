"""States that are numerically hard (d ≫ d_c, d → d_c, r → 0, r → c, r → a), against 40 digits."""

import numpy as np

import mdr_core as mdr

from .reference import Reference
from .shapes import SHAPES

EXTREMES = (
    *SHAPES,
    mdr.PowerLaw(coefficient=4e-9, exponent=0.1),
    mdr.PowerLaw(coefficient=1e250, exponent=50.0),
    # Vertices at very different distances.
    mdr.Sampled([0.0, 1e-9, 1e-8, 1e-6, 2e-6, 1e-4, 10.0], [0.0, 1e-12, 1e-10, 4e-8, 2e-7, 4e-5, 9.0]),
)
# Depths in units of d_c, in the order of the path.
REGIMES = {
    "elastic, d = 0.1 d_c": (0.1,),
    "d = d_c (1 − 10⁻⁹)": (1 - 1e-9,),
    "d = d_c (1 + 10⁻⁹)": (1 + 1e-9,),
    "d = d_c (1 + 10⁻⁵)": (1 + 1e-5,),
    "d = 3 d_c": (3.0,),
    "3 d_c, back to 2.6 d_c": (3.0, 2.6),
    "d = 10⁴ d_c": (1e4,),
    "d = 2·10⁸ d_c": (2e8,),
    "2·10⁸ d_c, back by 0.4 d_c": (2e8, 2e8 - 0.4),
}
# Modulus (Pa) and yield constant (N/m): rubber, an engineering solid, diamond.
MEDIA = (mdr.Medium(1e6, q_c=1e-3), mdr.Medium(1e9, q_c=1.0), mdr.Medium(1e12, q_c=2000.0))
QUANTITIES = (
    "contact radius",
    "force",
    "stored energy",
    "plastic work",
    "pressure",
    "pressure at c",
    "pressure at a",
)
# What the solver promises, relative; pressure per unit of its own condition number in r.
BOUNDS = (
    dict.fromkeys(QUANTITIES[1:4], 1e-12) | dict.fromkeys(QUANTITIES[4:], 2e-11) | {"contact radius": 2e-14}
)


def bounds(regime):
    """Bounds of a regime: next to the threshold plastic depth and c have the digits that d_c leaves them.

    d − d_c is rounded to a few units of 10⁻¹⁶ d_c; radii and work are powers of it, up to the tenth.
    """
    excess = abs(REGIMES[regime][0] - 1)
    digits = "plastic work", "pressure", "pressure at c", "pressure at a"
    return BOUNDS | {quantity: max(BOUNDS[quantity], 1e-14 / excess) for quantity in digits}


def errors(shape, medium, regime):
    """Relative error of every quantity in one state."""
    path = np.array(REGIMES[regime]) * medium.critical_depth
    if isinstance(shape, mdr.Sphere) and path[0] > shape.radius:
        # A sphere is not pressed in by many radii: take one as large as the depth.
        shape = mdr.Sphere(radius=path[0])
    state, exact = mdr.indent(shape, medium, path)[-1], Reference(shape, medium, path[-1], path[0])
    result = {
        "contact radius": _relative(state.contact_radius, exact.a),
        "force": _relative(state.force, exact.force),
        "stored energy": _relative(state.stored_energy, exact.stored_energy),
        "plastic work": _relative(state.plastic_work, exact.plastic_work),
    }
    a, c = state.contact_radius, state.plastic_radius
    radii = {
        "pressure": (1e-9 * a, 0.5 * a),
        "pressure at a": (0.999999 * a,),
        "pressure at c": (c * (1 - 1e-6), c * (1 + 1e-6)),
    }
    for quantity, at in radii.items():
        result[quantity] = max(
            # Some 10⁹⁰ between c and a (n = 0.1 at the threshold) are beyond the reference.
            (_pressure_error(state, exact, r) for r in at if 1e-30 * a < r < float(exact.a)),
            default=0.0,
        )
    return result


def _relative(value, exact):
    return abs(float((value - exact) / exact)) if exact else abs(float(value))


def _pressure_error(state, exact, r):
    """Error per unit of condition number: the rounding of r itself counts for |r p′/p|."""
    step = 1e-7
    slope = (state.pressure(r * (1 + step)) - state.pressure(r * (1 - step))) / (
        2 * step * state.pressure(r)
    )
    return _relative(state.pressure(r), exact.pressure(r)) / max(1.0, abs(slope))
