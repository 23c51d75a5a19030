"""Abel transforms between the 3D and the 1D problem, for functions and samples.

Popov (2015), Eqs. (3), (7) and (10).

An example:

>>> from mdr_core import abel
>>> print(round(abel.reduce_slope(lambda r: 2 * r, 3.0), 9))  # z = r² has g = 2x²
18.0
"""

from .solver.numerics.abel import (
    height_from_slope,
    kappa,
    reduce_slope,
    stress_from_line_load,
    surface_displacement,
)

__all__ = [
    "height_from_slope",
    "kappa",
    "reduce_slope",
    "stress_from_line_load",
    "surface_displacement",
]
